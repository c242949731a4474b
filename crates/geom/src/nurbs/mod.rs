//! B-spline and NURBS curves and tensor-product surfaces, of degree 1 to 7, clamped or not.
//!
//! Control points are kept homogeneous, (w x, w y, w z, w), so that every algorithm is linear and the division by w
//! comes last. One recurrence carries the room: `basis::raised` takes the B-splines of one degree to the next. With the
//! same parameter at every degree it evaluates; with the new knots one after the other it is the Oslo algorithm; with
//! differences in place of products it differentiates.

mod arc_length;
mod banded;
mod basis;
mod batch;
mod budget;
mod by_arc_length;
mod closest_on_curve;
mod closest_on_surface;
mod curve;
mod error;
mod fit;
mod flatness;
mod knots;
mod net;
mod normal;
mod oslo;
mod patch_mesh;
mod surface;
mod tessellate;

pub use arc_length::ArcLength;
pub use basis::{MAX_DEGREE, Sample};
pub use batch::{
    BatchError, FlatSurfaces, Query, grids, jets_at, meshes, normals_at, points_at, queries, segments_within,
};
pub use by_arc_length::{ByArcLength, by_arc_length};
pub use closest_on_curve::ClosestOnCurve;
pub use closest_on_surface::ClosestOnSurface;
pub use curve::Curve;
pub use error::NurbsError;
pub use fit::{FitSettings, chord_parameters, fit_curve, fit_surface, knots_for};
pub use knots::Knots;
pub use oslo::Refinement;
pub use patch_mesh::PatchMesh;
pub use surface::{Jet, Surface};
pub use tessellate::Grid;
