//! Why numbers make no curve or surface.

use thiserror::Error;

use super::MAX_DEGREE;

/// Why numbers make no curve or surface, or a question about one has no answer.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum NurbsError {
    /// The degree is not supported.
    #[error("the degree is {0}; 1 to {MAX_DEGREE} was expected")]
    Degree(usize),
    /// A curve of degree p needs p + 1 control points.
    #[error("{count} control points were given for degree {degree}; at least {} were expected", degree + 1)]
    TooFewPoints {
        /// The degree.
        degree: usize,
        /// Number of control points.
        count: usize,
    },
    /// The number of knots is not that of the control points, plus the degree, plus 1.
    #[error("{length} knots were given for {count} control points of degree {degree}; {} were expected", count + degree + 1)]
    KnotCount {
        /// Number of knots.
        length: usize,
        /// Number of control points.
        count: usize,
        /// The degree.
        degree: usize,
    },
    /// A knot is NaN or infinite.
    #[error("knot {0} is not finite")]
    KnotNotFinite(usize),
    /// A knot is less than the one before it.
    #[error("knot {index} is {value}, less than the {before} before it")]
    Decreasing {
        /// Index of the knot.
        index: usize,
        /// Its value.
        value: f64,
        /// The value before it.
        before: f64,
    },
    /// The first and the last parameter are the same.
    #[error("the knots span no interval: the domain runs from {0} to {0}")]
    NoDomain(f64),
    /// A knot occurs so often that the curve would break apart.
    #[error("knot {value} occurs {multiplicity} times; at most {limit} times was expected")]
    Multiplicity {
        /// Value of the knot.
        value: f64,
        /// How often it occurs.
        multiplicity: usize,
        /// How often it may.
        limit: usize,
    },
    /// A weight is zero, negative or not finite.
    #[error("weight {index} is {value}; a positive number was expected")]
    Weight {
        /// Index of the control point.
        index: usize,
        /// Its weight.
        value: f64,
    },
    /// A control point is NaN or infinite.
    #[error("control point {0} is not finite")]
    PointNotFinite(usize),
    /// Arrays that belong together differ in length.
    #[error("{found} {what} were given; {expected} were expected")]
    Length {
        /// What the array holds.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length that belongs to the others.
        expected: usize,
    },
    /// A parameter lies outside the domain.
    #[error("parameter {value} lies outside the domain from {low} to {high}")]
    OutsideDomain {
        /// The parameter.
        value: f64,
        /// Start of the domain.
        low: f64,
        /// End of the domain.
        high: f64,
    },
    /// The new knots do not contain the old ones.
    #[error("the new knots lack the old knot {0}")]
    KnotLost(f64),
    /// A projection needs control points in front of the camera.
    #[error("a control point lies behind the camera")]
    BehindCamera,
    /// A length along a curve is negative or exceeds the curve.
    #[error("length {value} lies outside 0 to {total}, the length of the curve")]
    OutsideLength {
        /// The length asked for.
        value: f64,
        /// Length of the curve.
        total: f64,
    },
    /// A curve whose points all coincide has no parametrisation by length.
    #[error("the curve has no length")]
    NoLength,
    /// A fit needs at least as many points as control points.
    #[error("{points} points were given to fit {count} control points; at least {count} were expected")]
    TooFewToFit {
        /// Number of points.
        points: usize,
        /// Number of control points.
        count: usize,
    },
    /// The points leave a control point free.
    #[error(
        "control point {0} is not determined by the points; give more points near it, fewer control points, or smoothness"
    )]
    Undetermined(usize),
}
