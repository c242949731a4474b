//! First hits of rays: Moeller and Trumbore's test in the leaves of the tree.

use glam::DVec3;
use rayon::prelude::*;

use crate::Bvh;

/// Half-line from `origin` along `direction` (any length but 0), up to `limit` times the direction.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Start.
    pub origin: DVec3,
    /// Direction; its length is the unit of `limit` and of `Hit::t`.
    pub direction: DVec3,
    /// Largest multiple of the direction that counts; infinite for a half-line.
    pub limit: f64,
}

/// Where a ray meets a mesh: at `origin + t * direction`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Multiple of the direction.
    pub t: f64,
    /// Triangle that is hit.
    pub triangle: u32,
    /// Barycentric coordinates of the hit.
    pub barycentric: [f64; 3],
}

impl Bvh {
    /// The first hit, on either side of the surface.
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.visit_hits(ray, |hit| {
            if best.is_none_or(|b| hit.t < b.t) {
                best = Some(hit);
            }
            best.map_or(ray.limit, |b| b.t)
        });
        best
    }

    /// Whether anything is hit: faster than the first hit.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        let mut found = false;
        self.visit_hits(ray, |_| {
            found = true;
            f64::NEG_INFINITY
        });
        found
    }

    /// Calls `limit_after` for hits up to the limit that it returned last; near boxes come first.
    fn visit_hits(&self, ray: &Ray, mut limit_after: impl FnMut(Hit) -> f64) {
        let inverse = ray.direction.recip();
        let mut limit = ray.limit;
        let mut stack = vec![(0usize, self.nodes[0].bounds.entry(ray.origin, inverse, limit))];
        while let Some((index, entry)) = stack.pop() {
            if entry > limit || entry.is_infinite() {
                continue;
            }
            let node = &self.nodes[index];
            if node.count == 0 {
                let first = node.first as usize;
                let entries = [first, first + 1].map(|n| (n, self.nodes[n].bounds.entry(ray.origin, inverse, limit)));
                let nearer = usize::from(entries[1].1 < entries[0].1);
                stack.extend([entries[1 - nearer], entries[nearer]]);
                continue;
            }
            for slot in Self::slots(node) {
                if let Some((t, barycentric)) = hit_triangle(&self.corners[slot], ray, limit) {
                    limit = limit_after(Hit { t, triangle: self.triangle_of_slot[slot], barycentric });
                }
            }
        }
    }
}

fn hit_triangle(corners: &[DVec3; 3], ray: &Ray, limit: f64) -> Option<(f64, [f64; 3])> {
    let [a, b, c] = *corners;
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = ray.origin - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(ab);
    let v = ray.direction.dot(q) / determinant;
    let t = ac.dot(q) / determinant;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= limit;
    inside.then_some((t, [1.0 - u - v, u, v]))
}

/// First hits of many rays, in parallel.
pub fn first_hits(bvh: &Bvh, rays: &[Ray]) -> Vec<Option<Hit>> {
    rays.par_iter().map(|ray| bvh.first_hit(ray)).collect()
}

/// Whether rays hit anything, in parallel.
pub fn any_hits(bvh: &Bvh, rays: &[Ray]) -> Vec<bool> {
    rays.par_iter().map(|ray| bvh.any_hit(ray)).collect()
}
