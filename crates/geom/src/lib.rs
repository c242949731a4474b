//! Meshes, bounding volume hierarchies, frames and curves: arrays in, arrays out.

mod aabb;
mod bvh;
mod closest;
mod mesh;
pub mod nurbs;
mod ray;
mod signed_distance;
mod triangle;
mod winding;

pub use aabb::Aabb;
pub use bvh::Bvh;
pub use closest::{Closest, closest_points};
pub use mesh::{MeshError, TriangleMesh};
pub use ray::{Hit, Ray, any_hits, first_hits};
pub use signed_distance::{SignedDistance, signed_distances};
pub use triangle::{barycentric_point, closest_on_triangle};
pub use winding::{WindingTree, winding_numbers};
