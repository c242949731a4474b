//! Least-squares curves and surfaces through points whose parameters are known.
//!
//! The normal equations are banded; one step of refinement with the residuals of the points themselves gives back the
//! digits that squaring the matrix has cost. Fixed control points are taken out. `smoothness` adds the squares of the
//! second differences of the control points, which also determines those that no point is near.

use glam::DVec3;

use super::banded::Banded;
use super::basis::Sample;
use super::{Curve, Knots, NurbsError, Surface};

/// Settings of a fit.
#[derive(Debug, Clone, Copy, Default)]
pub struct FitSettings {
    /// How much second differences of control points count beside distances; 0 is plain least squares.
    pub smoothness: f64,
    /// Whether the first and last control point (or the four corners) are those of the first and last point given
    /// (or the points nearest to the corners in parameters).
    pub fix_ends: bool,
}

/// Parameters from 0 to 1 in proportion to the lengths of the chords between points.
pub fn chord_parameters(points: &[DVec3]) -> Vec<f64> {
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
    }
    let (total, last) = (lengths[lengths.len() - 1], lengths.len().saturating_sub(2).max(1));
    let spaced = (0..points.len()).map(|i| i as f64 / last as f64);
    if total > 0.0 { lengths.iter().map(|l| l / total).collect() } else { spaced.collect() }
}

/// Clamped knots for `count` control points, with about as many of the sorted parameters in every span.
///
/// # Errors
/// As [`Knots::new`]; fewer parameters than control points.
pub fn knots_for(parameters: &[f64], degree: usize, count: usize) -> Result<Knots, NurbsError> {
    super::knots::refuse_sizes(degree, count)?;
    if parameters.len() < count {
        return Err(NurbsError::TooFewToFit { points: parameters.len(), count });
    }
    let mut breaks = vec![parameters[0]];
    let step = parameters.len() as f64 / (count - degree) as f64;
    for j in 1..count - degree {
        let at = j as f64 * step;
        let (index, part) = (at.floor() as usize, at.fract());
        breaks.push(parameters[index - 1] * (1.0 - part) + parameters[index] * part);
    }
    breaks.push(parameters[parameters.len() - 1]);
    Knots::clamped(degree, &breaks)
}

/// The curve over `knots`, with weights 1, that is nearest to points at parameters.
///
/// # Errors
/// Parameters outside the domain; control points that the points do not determine.
pub fn fit_curve(
    knots: Knots,
    parameters: &[f64],
    points: &[DVec3],
    settings: FitSettings,
) -> Result<Curve, NurbsError> {
    let inside: Result<Vec<f64>, _> = parameters.iter().map(|&t| knots.inside(t)).collect();
    let rows = inside?.into_iter().map(|t| Equation::on_curve(&Sample::new(&knots, t), knots.degree())).collect();
    let mut fit = Fit { rows, points, shape: [knots.count(), 1], band: knots.degree().max(2), fixed: Vec::new() };
    if settings.fix_ends && !points.is_empty() {
        fit.fixed = vec![(0, points[0]), (knots.count() - 1, points[points.len() - 1])];
    }
    let found = fit.solve(settings.smoothness)?;
    Curve::new(knots, &found, &vec![1.0; found.len()])
}

/// The surface over knots, with weights 1, that is nearest to points at pairs of parameters.
///
/// # Errors
/// Parameters outside the domain; control points that the points do not determine.
pub fn fit_surface(
    u: Knots,
    v: Knots,
    parameters: &[[f64; 2]],
    points: &[DVec3],
    settings: FitSettings,
) -> Result<Surface, NurbsError> {
    let equation = |uv: &[f64; 2]| {
        let samples = [Sample::new(&u, u.inside(uv[0])?), Sample::new(&v, v.inside(uv[1])?)];
        Ok(Equation::on_surface(&samples, [u.degree(), v.degree()], v.count()))
    };
    let rows = parameters.iter().map(equation).collect::<Result<Vec<_>, NurbsError>>()?;
    let band = (u.degree().max(2) * v.count() + v.degree()).max(2);
    let mut fit = Fit { rows, points, shape: [u.count(), v.count()], band, fixed: Vec::new() };
    if settings.fix_ends && !points.is_empty() {
        fit.fixed = corners(&u, &v, parameters, points);
    }
    let found = fit.solve(settings.smoothness)?;
    Surface::new(u, v, &found, &vec![1.0; found.len()])
}

/// The four corners and the points nearest to them in parameters.
fn corners(u: &Knots, v: &Knots, parameters: &[[f64; 2]], points: &[DVec3]) -> Vec<(usize, DVec3)> {
    let ((u0, u1), (v0, v1)) = (u.domain(), v.domain());
    let columns = v.count();
    let last = u.count() * columns;
    let places = [(0, u0, v0), (columns - 1, u0, v1), (last - columns, u1, v0), (last - 1, u1, v1)];
    let nearest = |u: f64, v: f64| {
        let far = |uv: &[f64; 2]| ((uv[0] - u) / (u1 - u0)).powi(2) + ((uv[1] - v) / (v1 - v0)).powi(2);
        let index = (0..points.len()).min_by(|&a, &b| far(&parameters[a]).total_cmp(&far(&parameters[b])));
        points[index.unwrap_or(0)]
    };
    places.into_iter().map(|(index, u, v)| (index, nearest(u, v))).collect()
}

/// The shares of control points in one point.
struct Equation(Vec<(usize, f64)>);

impl Equation {
    fn on_curve(sample: &Sample, degree: usize) -> Self {
        Self((0..=degree).map(|k| (sample.first + k, sample.values[k])).collect())
    }

    fn on_surface([u, v]: &[Sample; 2], degrees: [usize; 2], columns: usize) -> Self {
        let row = |k: usize| {
            (0..=degrees[1]).map(move |l| ((u.first + k) * columns + v.first + l, u.values[k] * v.values[l]))
        };
        Self((0..=degrees[0]).flat_map(row).collect())
    }
}

/// A least-squares problem for a grid of control points.
struct Fit<'a> {
    rows: Vec<Equation>,
    points: &'a [DVec3],
    shape: [usize; 2],
    band: usize,
    fixed: Vec<(usize, DVec3)>,
}

impl Fit<'_> {
    fn solve(&self, smoothness: f64) -> Result<Vec<DVec3>, NurbsError> {
        let differences = self.second_differences(smoothness);
        let mut matrix = Banded::new(self.shape[0] * self.shape[1], self.band);
        for Equation(row) in self.rows.iter().chain(&differences) {
            for &(i, a) in row {
                row.iter().filter(|(j, _)| *j <= i).for_each(|&(j, b)| matrix.add(i, j, a * b));
            }
        }
        self.fixed.iter().for_each(|&(unknown, _)| matrix.take_out(unknown));
        let factor = matrix.factor().map_err(NurbsError::Undetermined)?;
        let mut found = vec![DVec3::ZERO; self.shape[0] * self.shape[1]];
        self.fixed.iter().for_each(|&(unknown, point)| found[unknown] = point);
        // The second round repairs what squaring the matrix has cost.
        for _ in 0..2 {
            let gradient = self.gradient(&found, &differences);
            for axis in 0..3 {
                let mut step: Vec<f64> = gradient.iter().map(|g| g[axis]).collect();
                factor.solve(&mut step);
                found.iter_mut().zip(step).for_each(|(point, step)| point[axis] += step);
            }
        }
        Ok(found)
    }

    /// What remains of the points, brought back to the control points; zero at fixed ones.
    fn gradient(&self, found: &[DVec3], differences: &[Equation]) -> Vec<DVec3> {
        let mut gradient = vec![DVec3::ZERO; found.len()];
        let targets = self.points.iter().copied().chain(std::iter::repeat(DVec3::ZERO));
        for (Equation(row), target) in self.rows.iter().chain(differences).zip(targets) {
            let residual = row.iter().fold(target, |rest, &(i, share)| rest - found[i] * share);
            row.iter().for_each(|&(i, share)| gradient[i] += residual * share);
        }
        self.fixed.iter().for_each(|&(unknown, _)| gradient[unknown] = DVec3::ZERO);
        gradient
    }

    /// Equations that ask control points to be the middle of their neighbours, along rows and along columns. They are
    /// weighted as if there were as many of them as points.
    fn second_differences(&self, smoothness: f64) -> Vec<Equation> {
        let [rows, columns] = self.shape;
        if smoothness <= 0.0 {
            return Vec::new();
        }
        let weight = (smoothness * self.points.len() as f64 / (rows * columns) as f64).sqrt();
        let middle =
            |i: usize, stride: usize| Equation(vec![(i - stride, weight), (i, -2.0 * weight), (i + stride, weight)]);
        let along_u = (columns..rows.saturating_sub(1) * columns).map(|i| middle(i, columns));
        let inner = |i: &usize| (1..columns.saturating_sub(1)).contains(&(i % columns));
        along_u.chain((0..rows * columns).filter(inner).map(|i| middle(i, 1))).collect()
    }
}
