//! Orientation and scalar fields on pixels and voxels: diffusion and streamlines.

pub mod depth;
pub mod diffuse;
pub mod distance;
mod error;
mod grid;
pub mod mesh_depth;
pub mod neighbours;
pub mod principal;
mod sums;
pub mod trace;

pub use error::FieldError;
pub use grid::GridShape;
