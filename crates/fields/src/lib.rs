//! Orientation and scalar fields on pixels and voxels: diffusion and streamlines.

pub mod axes;
pub mod depth;
pub mod diffuse;
mod diffusion_system;
pub mod distance;
mod error;
mod front_sheet;
mod grid;
pub mod mesh_depth;
pub mod nearest;
pub mod neighbours;
pub mod principal;
pub mod sample;
mod sums;
pub mod trace;
mod voxel_field;

pub use error::FieldError;
pub use front_sheet::FrontSheet;
pub use grid::GridShape;
pub use voxel_field::VoxelField;
