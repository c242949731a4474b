//! What can be wrong with what comes in.

/// Refused input.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum DynamicsError {
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
    /// Offsets do not start at 0, decrease, or do not end at the number of particles.
    #[error("offsets must rise from 0 to the number of particles ({particles})")]
    Offsets {
        /// Number of particles.
        particles: usize,
    },
    /// A number outside its range.
    #[error("{name} is {value}; {expected} was expected")]
    Number {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// A link names a particle that is not there.
    #[error("a link names particle {particle} of {particles}")]
    Link {
        /// The particle that it names.
        particle: usize,
        /// Number of particles.
        particles: usize,
    },
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), DynamicsError> {
    let fits = value.is_finite() && value > 0.0;
    fits.then_some(()).ok_or(DynamicsError::Number { name, value, expected: "a number > 0" })
}

pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), DynamicsError> {
    (value >= 0.0).then_some(()).ok_or(DynamicsError::Number { name, value, expected: "a number >= 0" })
}
