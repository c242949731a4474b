//! The control net that knot insertion gives between grid lines.
//!
//! Every grid line becomes a knot that occurs `degree` times, so the net has control points on the line, which are points
//! of the surface, and others between two lines, in whose hull the surface lies there.

use glam::DVec4;

use super::{Knots, NurbsError, Refinement, Surface};

/// Knots of full multiplicity at grid lines, and the control points that lie on the lines.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    /// The parameters of the lines: both ends of the domain, and what lies between them, increasing.
    pub parameters: Vec<f64>,
    knots: Knots,
    /// Index of the control point on each line.
    pub on_line: Vec<usize>,
}

impl Lines {
    /// The knots for lines at increasing parameters, which start and end with the domain.
    pub fn new(old: &Knots, parameters: Vec<f64>) -> Result<Self, NurbsError> {
        let (low, high) = old.domain();
        let mut breaks = vec![low];
        let mut on_line = vec![0];
        let mut others = old.values().iter().copied().filter(|&k| low < k && k < high).peekable();
        for &line in &parameters[1..] {
            while let Some(knot) = others.next_if(|&k| k <= line) {
                if knot < line {
                    breaks.push(knot);
                }
            }
            on_line.push(breaks.len() + old.degree() - 1);
            let often = if line < high { old.degree() } else { 1 };
            breaks.extend(std::iter::repeat_n(line, often));
        }
        Ok(Self { parameters, knots: Knots::clamped(old.degree(), &breaks)?, on_line })
    }

    /// The way from the old control points to those on the lines.
    pub fn to_lines(&self, old: &Knots) -> Result<Refinement, NurbsError> {
        Refinement::of(old, &self.knots, &self.on_line)
    }

    /// The knots that make these lines.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// Number of intervals between lines.
    pub fn intervals(&self) -> usize {
        self.parameters.len() - 1
    }
}

/// A refined control net, and where its lines run.
pub(crate) struct Net {
    /// Homogeneous control points, row by row along u.
    pub points: Vec<DVec4>,
    /// Number of control points in a row.
    pub columns: usize,
}

impl Net {
    /// All control points between the lines.
    pub fn new(surface: &Surface, u: &Lines, v: &Lines) -> Result<Self, NurbsError> {
        let along_u = Refinement::new(surface.u(), &u.knots)?;
        let along_v = Refinement::new(surface.v(), &v.knots)?;
        Ok(Self { points: surface.refined_points(&along_u, &along_v), columns: v.knots.count() })
    }

    /// The control points from one row and column to another, both included.
    pub fn block(&self, rows: [usize; 2], columns: [usize; 2]) -> impl Iterator<Item = DVec4> + '_ {
        let row = move |row: usize| &self.points[row * self.columns + columns[0]..=row * self.columns + columns[1]];
        (rows[0]..=rows[1]).flat_map(row).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_points_on_lines_lie_on_the_surface() {
        let knots = Knots::new(3, 7, vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0]).expect("valid");
        let points: Vec<f64> = (0..7).map(|i| (i * i % 5) as f64).collect();
        for lines in [vec![0.0, 1.0], vec![0.0, 0.3, 0.4, 0.5, 1.0], vec![0.0, 0.2, 0.9, 1.0]] {
            let lines = Lines::new(&knots, lines).expect("valid");
            let all = Refinement::new(&knots, &lines.knots).expect("contains the old knots").apply(&points);
            for (&index, &t) in lines.on_line.iter().zip(&lines.parameters) {
                let sample = super::super::Sample::new(&knots, t);
                let expected: f64 = (0..4).map(|k| points[sample.first + k] * sample.values[k]).sum();
                assert!((all[index] - expected).abs() < 1e-14, "line {t}");
            }
        }
    }
}
