//! The B-splines that are not zero on one span, and their derivatives.
//!
//! Source: Cox 1972, de Boor 1972. All rows run from B-spline `span - degree` to B-spline `span`.

use super::Knots;

/// The highest degree.
pub const MAX_DEGREE: usize = 7;

/// One number for each of the at most eight B-splines that are not zero on a span; the rest are zero.
pub(crate) type Row = [f64; MAX_DEGREE + 1];

/// The B-splines at one parameter: control points `first ..= first + degree` have a share in its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Index of the first control point with a share.
    pub first: usize,
    /// Shares of the control points.
    pub values: Row,
}

impl Sample {
    /// The B-splines at `t`, which lies in the domain.
    pub fn new(knots: &Knots, t: f64) -> Self {
        let span = knots.span(t);
        Self { first: span - knots.degree(), values: blended(knots, span, |_| t) }
    }
}

/// The B-splines of full degree where the recurrence of degree q is taken at `parameter(q)`.
///
/// With one and the same parameter these are the B-splines there; with successive new knots they are discrete B-splines.
pub(crate) fn blended(knots: &Knots, span: usize, parameter: impl Fn(usize) -> f64) -> Row {
    let mut row = unit();
    for q in 1..=knots.degree() {
        row = raised(knots.values(), span, q, &row, parameter(q));
    }
    row
}

/// The B-splines at `t` and their first and second derivatives.
pub(crate) fn derivatives(knots: &Knots, span: usize, t: f64) -> [Row; 3] {
    let (values, degree) = (knots.values(), knots.degree());
    let mut lower = unit();
    for q in 1..degree.saturating_sub(1) {
        lower = raised(values, span, q, &lower, t);
    }
    // `lower` has degree p - 2; a straight line (degree 1) has none, and no second derivative.
    let (middle, second) = if degree == 1 {
        (lower, Row::default())
    } else {
        let slope = differentiated(values, span, degree - 1, &lower);
        (raised(values, span, degree - 1, &lower, t), differentiated(values, span, degree, &slope))
    };
    [raised(values, span, degree, &middle, t), differentiated(values, span, degree, &middle), second]
}

/// The one B-spline of degree 0.
fn unit() -> Row {
    let mut row = Row::default();
    row[0] = 1.0;
    row
}

/// Takes the B-splines of degree q - 1 at a parameter to those of degree q.
fn raised(knots: &[f64], span: usize, q: usize, lower: &Row, t: f64) -> Row {
    let mut row = Row::default();
    for k in 0..q {
        let (left, right) = (knots[span + 1 + k - q], knots[span + 1 + k]);
        let share = lower[k] / (right - left);
        row[k] += (right - t) * share;
        row[k + 1] += (t - left) * share;
    }
    row
}

/// The derivatives of the B-splines of degree q, from the B-splines of degree q - 1 or their derivatives.
fn differentiated(knots: &[f64], span: usize, q: usize, lower: &Row) -> Row {
    let mut row = Row::default();
    for k in 0..q {
        let share = q as f64 * lower[k] / (knots[span + 1 + k] - knots[span + 1 + k - q]);
        row[k] -= share;
        row[k + 1] += share;
    }
    row
}
