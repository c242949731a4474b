//! What hair must not enter: spheres, capsules, distance fields of meshes, and the hair beside it.

pub mod collider;
pub mod distance_field;
pub mod pairs;

pub use collider::{Collider, Moving, Pose, Shape};
pub use distance_field::DistanceField;
