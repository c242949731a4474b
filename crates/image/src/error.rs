//! What the image kernels refuse.

use thiserror::Error;

/// Input that the image kernels refuse.
#[derive(Debug, Error, PartialEq)]
pub enum ImageError {
    /// Arrays that should have the same number of pixels do not, or have none.
    #[error("a picture has {found} values; {expected}, and at least one, were expected")]
    Size {
        /// Pixels of the picture.
        expected: usize,
        /// Values found.
        found: usize,
    },
    /// A picture holds NaN or an infinity.
    #[error("a picture holds a number that is not finite")]
    NotFinite,
    /// Gabor sizes outside (0, 64] pixels.
    #[error("the Gabor sizes are {sigma_u}, {sigma_v} and {wavelength} px; numbers above 0 and up to 64 were expected")]
    KernelSize {
        /// Along the oscillation.
        sigma_u: f64,
        /// Along the strand.
        sigma_v: f64,
        /// Wavelength.
        wavelength: f64,
    },
    /// A number of orientations that is odd or outside 4 to 128.
    #[error("the number of orientations is {orientations}; an even number from 4 to 128 was expected")]
    Orientations {
        /// The number.
        orientations: usize,
    },
    /// Tracing parameters that cannot work.
    #[error("{name} is {value}; a finite number above 0 was expected")]
    Trace {
        /// Parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Nothing to copy from.
    #[error("no patch of {size} x {size} px lies wholly inside the source; mark more of the picture as source")]
    NoSource {
        /// Patch size.
        size: usize,
    },
    /// A patch size that is even or out of range.
    #[error("the patch size is {size}; an odd number from 3 to 21 was expected")]
    PatchSize {
        /// Patch size.
        size: usize,
    },
}
