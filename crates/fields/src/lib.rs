//! Orientation and scalar fields on pixels and voxels: diffusion and streamlines.

pub mod axes;
pub mod depth;
pub mod diffuse;
pub mod distance;
mod error;
mod grid;
pub mod mesh_depth;
pub mod neighbours;
pub mod principal;
pub mod sample;
mod sums;
pub mod trace;

pub use error::FieldError;
pub use grid::GridShape;
