//! What can be wrong with the arrays that come in.

/// Refused input.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum FieldError {
    /// An array is too short or too long.
    #[error("{name} has {found} entries; {expected} were expected")]
    Length {
        /// Name of the argument.
        name: &'static str,
        /// Its length.
        found: usize,
        /// The length that fits the other arguments.
        expected: usize,
    },
    /// Offsets do not start at 0, decrease, or do not end at the number of points.
    #[error("offsets must rise from 0 to the number of points ({points})")]
    Offsets {
        /// Number of points.
        points: usize,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} names vertex {vertex} of {vertices}")]
    Vertex {
        /// The triangle.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A number that must be finite and not negative is not.
    #[error("{name} is {value}; a finite number >= 0 was expected")]
    Number {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}

pub(crate) fn check_offsets(offsets: &[i64], points: usize) -> Result<(), FieldError> {
    let rising = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
    let ends = offsets.first() == Some(&0) && offsets.last() == Some(&(points as i64));
    (rising && ends).then_some(()).ok_or(FieldError::Offsets { points })
}

pub(crate) fn check_number(name: &'static str, value: f64) -> Result<(), FieldError> {
    (value.is_finite() && value >= 0.0).then_some(()).ok_or(FieldError::Number { name, value })
}
