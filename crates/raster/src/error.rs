//! Why a scene cannot be rasterised.

use thiserror::Error;

/// Why a scene cannot be rasterised.
#[derive(Debug, Error, PartialEq)]
pub enum RasterError {
    /// Arrays that belong together differ in length.
    #[error("{what} has {given} entries; {expected} were expected")]
    Length {
        /// Name of the array.
        what: &'static str,
        /// Its length.
        given: usize,
        /// The length that was expected.
        expected: usize,
    },
    /// Offsets do not rise from 0 to the number of points.
    #[error("offsets do not rise from 0 to the number of points, {0}")]
    Offsets(usize),
    /// A triangle names no vertex.
    #[error("triangle {0} names a vertex that does not exist")]
    NoSuchVertex(usize),
    /// A triangle names no picture of opacity, or one that is empty or no rectangle.
    #[error("triangle {0} names a picture of opacity that does not exist or holds no rectangle of texels")]
    NoSuchCutout(usize),
    /// A picture without pixels, or too large for the coordinates' precision.
    #[error("the picture is {0} x {1} pixels; 1 to 16384 were expected")]
    Size(usize, usize),
    /// The camera gives a point a position that is not finite.
    #[error("the projection of vertex {0} is not finite")]
    NotFinite(usize),
}
