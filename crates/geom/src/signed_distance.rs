//! Distance from a mesh with the sign of the winding number.

use glam::DVec3;
use rayon::prelude::*;

use crate::{Bvh, Closest, WindingTree};

/// The closest point, and the distance: negative inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedDistance {
    /// Distance from the mesh, negative where the winding number exceeds 1/2.
    pub distance: f64,
    /// The closest point.
    pub closest: Closest,
}

/// Signed distances of many points, in parallel.
///
/// Next to a hole the sign changes at the level 1/2 of the winding number, where the distance is not 0: there, and only
/// there, the result jumps.
pub fn signed_distances(bvh: &Bvh, queries: &[DVec3]) -> Vec<SignedDistance> {
    let tree = WindingTree::new(bvh);
    queries
        .par_iter()
        .map(|&query| {
            let closest = bvh.closest(query);
            let inside = tree.winding_number(query) > 0.5;
            SignedDistance { distance: if inside { -closest.distance } else { closest.distance }, closest }
        })
        .collect()
}
