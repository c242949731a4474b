//! Grid lines for a wanted accuracy: knots are inserted until the control net is within it.
//!
//! Lines run through the whole surface, so neighbouring cells share their corners and no crack can open. All knots of a
//! pass are inserted at once; a pass multiplies the number of intervals by the root of how much their bound exceeds the
//! accuracy, because the bound shrinks with the square of the interval.
//!
//! Source: `strips`, section 3.1.

use glam::{DMat4, DVec4};

use super::flatness::{CellError, cell_errors};
use super::net::{Lines, Net};
use super::{Knots, NurbsError, Surface};

/// More cells than this are not made of one surface; its bound then tells what was reached.
const MAX_CELLS: usize = 1 << 17;
/// In one pass a number of intervals grows at most so many times, for the estimate is only good nearby; by less where
/// that would make too many cells.
const GROWTH_LIMITS: [f64; 3] = [6.0, 2.0, 1.25];

/// Grid lines of a surface and the chord error that they leave.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Parameters of the lines along u, both ends of the domain included.
    pub u: Vec<f64>,
    /// Parameters of the lines along v, both ends of the domain included.
    pub v: Vec<f64>,
    /// Bound of the distance from the surface to the triangles, where it was asked for.
    pub error: Option<f64>,
}

impl Grid {
    /// Lines that divide the domain into equal intervals.
    pub fn uniform(surface: &Surface, segments: [usize; 2]) -> Self {
        let lines = |knots: &Knots, count: usize| {
            (0..=count.max(1)).map(|i| knots.at_fraction(i as f64 / count.max(1) as f64)).collect()
        };
        Self { u: lines(surface.u(), segments[0]), v: lines(surface.v(), segments[1]), error: None }
    }

    /// Lines at every knot, and so many equal intervals between two.
    pub fn by_span(surface: &Surface, per_span: [usize; 2]) -> Self {
        let lines = |knots: &Knots, count: usize| divided(&knots.breaks(), |_| count.max(1));
        Self { u: lines(surface.u(), per_span[0]), v: lines(surface.v(), per_span[1]), error: None }
    }

    /// As few lines as keep the triangles within `accuracy` of the surface, at least those along creases.
    ///
    /// With a `projection`, whose first two rows give the picture's x and y and whose fourth the homogeneous divisor,
    /// `accuracy` is one in the picture, in its unit; all control points must lie in front of the camera.
    ///
    /// # Errors
    /// Control points behind the camera.
    pub fn within(surface: &Surface, accuracy: f64, projection: Option<DMat4>) -> Result<Self, NurbsError> {
        let (mut u, mut v) = (Axis::new(surface.u()), Axis::new(surface.v()));
        loop {
            let mut grid = Self { u: u.lines(), v: v.lines(), error: None };
            let (errors, columns) = grid.cell_errors(surface, accuracy, projection)?;
            let error = errors.iter().fold(0.0, |worst: f64, cell| worst.max(cell.total));
            grid.error = Some(error);
            if error <= accuracy {
                return Ok(grid);
            }
            let (growth_u, growth_v) = growth(&errors, columns, accuracy);
            let grown = |limit: f64| (u.grown(&growth_u, limit), v.grown(&growth_v, limit));
            let fits = |(u, v): &(Axis, Axis)| u.count() * v.count() <= MAX_CELLS;
            match GROWTH_LIMITS.into_iter().map(grown).find(fits) {
                Some(next) => (u, v) = next,
                None => return Ok(grid),
            }
        }
    }

    /// Bound of the distance from the surface to the triangles over these lines.
    ///
    /// # Errors
    /// Control points behind the camera of a projection.
    pub fn chord_error(&self, surface: &Surface, projection: Option<DMat4>) -> Result<f64, NurbsError> {
        let (errors, _) = self.cell_errors(surface, f64::INFINITY, projection)?;
        Ok(errors.iter().fold(0.0, |worst, cell| cell.total.max(worst)))
    }

    fn cell_errors(
        &self,
        surface: &Surface,
        enough: f64,
        projection: Option<DMat4>,
    ) -> Result<(Vec<CellError>, usize), NurbsError> {
        let u = Lines::new(surface.u(), self.u.clone())?;
        let v = Lines::new(surface.v(), self.v.clone())?;
        let net = Net::new(surface, &u, &v)?;
        let errors = match projection {
            None => cell_errors(&net, &u, &v, enough, |p| p),
            Some(matrix) => {
                let seen = |p: DVec4| (matrix * p).with_z(0.0);
                if net.points.iter().any(|&p| seen(p).w <= 0.0) {
                    return Err(NurbsError::BehindCamera);
                }
                cell_errors(&net, &u, &v, enough, seen)
            }
        };
        Ok((errors, v.intervals()))
    }
}

/// How many times as many intervals are wanted along u and along v; a failing cell asks along its worse direction.
fn growth(errors: &[CellError], columns: usize, accuracy: f64) -> (Vec<f64>, Vec<f64>) {
    let mut u = vec![1.0; errors.len() / columns];
    let mut v = vec![1.0; columns];
    for (i, cell) in errors.iter().enumerate().filter(|(_, cell)| cell.total > accuracy) {
        let wanted = (cell.total / accuracy).sqrt();
        let part = if cell.along_u >= cell.along_v { &mut u[i / columns] } else { &mut v[i % columns] };
        *part = wanted.max(*part);
    }
    (u, v)
}

/// Parts of a domain and the number of equal intervals in each: at first the parts between creases, which fall into
/// their spans as soon as they have that many intervals.
#[derive(Debug, Clone)]
struct Axis {
    parts: Vec<Part>,
}

#[derive(Debug, Clone)]
struct Part {
    /// The knots of the part, both ends included.
    breaks: Vec<f64>,
    intervals: usize,
}

impl Axis {
    fn new(knots: &Knots) -> Self {
        let breaks = knots.breaks();
        let last = breaks.len() - 1;
        let crease = |i: &usize| *i == last || knots.multiplicity(breaks[*i]) >= knots.degree();
        let mut start = 0;
        let part = |end: usize| {
            let part = Part { breaks: breaks[start..=end].to_vec(), intervals: 1 };
            start = end;
            part
        };
        Self { parts: (1..=last).filter(crease).map(part).collect() }
    }

    fn count(&self) -> usize {
        self.parts.iter().map(|part| part.intervals).sum()
    }

    fn lines(&self) -> Vec<f64> {
        let ends: Vec<f64> = self.parts.iter().map(|part| part.breaks[0]).chain(self.last()).collect();
        divided(&ends, |i| self.parts[i].intervals)
    }

    fn last(&self) -> Option<f64> {
        self.parts.last().and_then(|part| part.breaks.last()).copied()
    }

    /// More intervals in each part whose intervals ask for it, at most `limit` times as many, or one more.
    fn grown(&self, growth: &[f64], limit: f64) -> Self {
        let mut parts = Vec::with_capacity(self.parts.len());
        let mut rest = growth;
        for part in &self.parts {
            let (own, others) = rest.split_at(part.intervals);
            rest = others;
            let wanted = own.iter().copied().fold(1.0, f64::max);
            parts.extend(part.grown(wanted, limit));
        }
        Self { parts }
    }
}

impl Part {
    fn grown(&self, wanted: f64, limit: f64) -> Vec<Self> {
        if wanted <= 1.0 {
            return vec![self.clone()];
        }
        let most = ((self.intervals as f64 * limit) as usize).max(self.intervals + 1);
        let intervals = ((self.intervals as f64 * wanted).ceil() as usize).clamp(self.intervals + 1, most);
        let spans = self.breaks.len() - 1;
        if spans == 1 || intervals < spans {
            return vec![Self { breaks: self.breaks.clone(), intervals }];
        }
        let span = |ends: &[f64]| Self { breaks: ends.to_vec(), intervals: intervals / spans };
        self.breaks.windows(2).map(span).collect()
    }
}

/// Lines with more between them: interval i in `parts(i)` equal ones.
fn divided(lines: &[f64], parts: impl Fn(usize) -> usize) -> Vec<f64> {
    let mut found = vec![lines[0]];
    for (i, ends) in lines.windows(2).enumerate() {
        let count = parts(i);
        let step = (ends[1] - ends[0]) / count as f64;
        found.extend((1..count).map(|k| ends[0] + step * k as f64));
        found.push(ends[1]);
    }
    found
}
