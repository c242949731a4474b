//! NURBS curves.

use glam::{DVec3, DVec4};

use super::basis::{self, Sample};
use super::{Knots, NurbsError, Refinement};

/// A rational B-spline curve; its weights are positive, its control points finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    knots: Knots,
    points: Vec<DVec4>,
}

impl Curve {
    /// A curve of control points and weights.
    ///
    /// # Errors
    /// Another number of points or weights than the knots are for, points that are not finite, weights not positive.
    pub fn new(knots: Knots, points: &[DVec3], weights: &[f64]) -> Result<Self, NurbsError> {
        let points = homogeneous(points, weights, knots.count())?;
        Ok(Self { knots, points })
    }

    /// The knots.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// Control points and weights.
    pub fn control(&self) -> (Vec<DVec3>, Vec<f64>) {
        self.points.iter().map(|&p| (projected(p), p.w)).unzip()
    }

    /// Control points times their weights, and the weights.
    pub(crate) fn homogeneous(&self) -> &[DVec4] {
        &self.points
    }

    /// The point at a parameter of the domain.
    pub fn point(&self, t: f64) -> DVec3 {
        let sample = Sample::new(&self.knots, t);
        projected(blend(&self.points[sample.first..], &sample.values, self.knots.degree()))
    }

    /// The point and the first and second derivatives at a parameter of the domain.
    pub fn derivatives(&self, t: f64) -> [DVec3; 3] {
        self.derivatives_on(self.knots.span(t), t)
    }

    /// The same as seen from one span, which tells the sides of a crease apart.
    pub(crate) fn derivatives_on(&self, span: usize, t: f64) -> [DVec3; 3] {
        let degree = self.knots.degree();
        let rows = basis::derivatives(&self.knots, span, t);
        let [h, h1, h2] = rows.map(|row| blend(&self.points[span - degree..], &row, degree));
        let point = projected(h);
        let first = (h1.truncate() - h1.w * point) / h.w;
        [point, first, (h2.truncate() - 2.0 * h1.w * first - h2.w * point) / h.w]
    }

    /// The same curve with more knots, all inserted at once.
    ///
    /// # Errors
    /// Knots outside the open domain, or more often than the degree allows.
    pub fn refined(&self, more: &[f64]) -> Result<Self, NurbsError> {
        self.over(self.knots.with(more)?)
    }

    /// The same curve over other knots, which contain the old ones inside their domain.
    ///
    /// # Errors
    /// As [`Refinement::new`].
    pub fn over(&self, knots: Knots) -> Result<Self, NurbsError> {
        let points = Refinement::new(&self.knots, &knots)?.apply(&self.points);
        Ok(Self { knots, points })
    }

    /// The same curve with knots that are clamped at both ends.
    pub fn clamped(&self) -> Result<Self, NurbsError> {
        self.over(clamped(&self.knots)?)
    }

    /// The same curve run through backwards.
    pub fn reversed(&self) -> Self {
        Self { knots: self.knots.reversed(), points: self.points.iter().rev().copied().collect() }
    }
}

/// The clamped knots that hold the same inner knots.
pub(crate) fn clamped(knots: &Knots) -> Result<Knots, NurbsError> {
    let (low, high) = knots.domain();
    let mut breaks = vec![low];
    breaks.extend(knots.values().iter().filter(|&&k| low < k && k < high));
    breaks.push(high);
    Knots::clamped(knots.degree(), &breaks)
}

/// Control points and weights as homogeneous points.
pub(crate) fn homogeneous(points: &[DVec3], weights: &[f64], count: usize) -> Result<Vec<DVec4>, NurbsError> {
    for (what, found) in [("control points", points.len()), ("weights", weights.len())] {
        if found != count {
            return Err(NurbsError::Length { what, found, expected: count });
        }
    }
    if let Some(index) = points.iter().position(|p| !p.is_finite()) {
        return Err(NurbsError::PointNotFinite(index));
    }
    match weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
        Some(index) => Err(NurbsError::Weight { index, value: weights[index] }),
        None => Ok(points.iter().zip(weights).map(|(&p, &w)| (p * w).extend(w)).collect()),
    }
}

/// The point that a homogeneous one stands for.
pub(crate) fn projected(point: DVec4) -> DVec3 {
    point.truncate() / point.w
}

/// The sum of the first `degree + 1` points by their shares.
pub(crate) fn blend(points: &[DVec4], shares: &[f64], degree: usize) -> DVec4 {
    points[..=degree].iter().zip(shares).fold(DVec4::ZERO, |sum, (&point, &share)| sum + point * share)
}
