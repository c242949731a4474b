//! Closest points of a mesh.

use glam::DVec3;
use rayon::prelude::*;

use crate::{Bvh, barycentric_point, closest_on_triangle};

/// The point of a mesh that is closest to a query.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Triangle on which it lies; the lowest slot of the tree where several are equally close.
    pub triangle: u32,
    /// Its barycentric coordinates there.
    pub barycentric: [f64; 3],
    /// The point.
    pub point: DVec3,
    /// Distance from the query.
    pub distance: f64,
}

impl Bvh {
    /// The closest point of the mesh.
    pub fn closest(&self, query: DVec3) -> Closest {
        let mut best = Closest { triangle: 0, barycentric: [0.0; 3], point: query, distance: f64::INFINITY };
        let mut best_sq = f64::INFINITY;
        let mut stack = vec![(0usize, self.nodes[0].bounds.distance_sq(query))];
        while let Some((index, bound_sq)) = stack.pop() {
            if bound_sq >= best_sq {
                continue;
            }
            let node = &self.nodes[index];
            if node.count == 0 {
                self.push_children(node.first as usize, query, best_sq, &mut stack);
            }
            for slot in Self::slots(node) {
                let barycentric = closest_on_triangle(&self.corners[slot], query);
                let point = barycentric_point(&self.corners[slot], barycentric);
                let distance_sq = point.distance_squared(query);
                if distance_sq < best_sq {
                    best_sq = distance_sq;
                    best = Closest { triangle: self.triangle_of_slot[slot], barycentric, point, distance: 0.0 };
                }
            }
        }
        Closest { distance: best_sq.sqrt(), ..best }
    }

    /// The nearer child is pushed last, so that it is visited first.
    fn push_children(&self, first: usize, query: DVec3, best_sq: f64, stack: &mut Vec<(usize, f64)>) {
        let left = (first, self.nodes[first].bounds.distance_sq(query));
        let right = (first + 1, self.nodes[first + 1].bounds.distance_sq(query));
        let (near, far) = if left.1 <= right.1 { (left, right) } else { (right, left) };
        if far.1 < best_sq {
            stack.push(far);
        }
        if near.1 < best_sq {
            stack.push(near);
        }
    }
}

/// Closest points of many queries, in parallel.
pub fn closest_points(bvh: &Bvh, queries: &[DVec3]) -> Vec<Closest> {
    queries.par_iter().map(|&query| bvh.closest(query)).collect()
}
