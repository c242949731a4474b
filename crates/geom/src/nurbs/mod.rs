//! B-spline and NURBS curves and tensor-product surfaces, of degree 1 to 7, clamped or not.
//!
//! Control points are kept homogeneous, (w x, w y, w z, w), so that every algorithm is linear and the division by w
//! comes last. One recurrence carries the room: `basis::raised` takes the B-splines of one degree to the next. With the
//! same parameter at every degree it evaluates; with the new knots one after the other it is the Oslo algorithm; with
//! differences in place of products it differentiates.

mod basis;
mod batch;
mod curve;
mod error;
mod knots;
mod normal;
mod oslo;
mod surface;

pub use basis::{MAX_DEGREE, Sample};
pub use batch::{BatchError, FlatSurfaces, Query, grids, jets_at, normals_at, points_at, queries};
pub use curve::Curve;
pub use error::NurbsError;
pub use knots::Knots;
pub use oslo::Refinement;
pub use surface::{Jet, Surface};
