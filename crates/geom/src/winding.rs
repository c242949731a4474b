//! Generalised winding number: how often a surface goes around a point, for open meshes too.
//!
//! The solid angle of all triangles over 4 pi is 1 inside a closed surface and 0 outside. Where the surface is open it
//! falls smoothly through the hole, so that the level 1/2 closes the hole by a gentle cap: that makes it the robust
//! answer to "inside?" for a head that ends at the neck, where ray parity depends on the ray. (Jacobson et al. 2013.)
//! Far groups of triangles count as one dipole at their area-weighted centroid (Barill et al. 2018, first order); a group
//! is far at `ACCEPTANCE` times its radius, which keeps the error below 0.02 in the tests.

use glam::DVec3;
use rayon::prelude::*;

use crate::Bvh;
use crate::bvh::Node;

const ACCEPTANCE: f64 = 3.0;

/// A tree with the dipole of every node.
#[derive(Debug, Clone)]
pub struct WindingTree<'a> {
    bvh: &'a Bvh,
    dipoles: Vec<Dipole>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Dipole {
    centre: DVec3,
    area_normal: DVec3,
    area: f64,
    /// Square of the distance from which it stands for its triangles.
    far_sq: f64,
}

impl<'a> WindingTree<'a> {
    /// Sums up the dipoles in O(n log n).
    pub fn new(bvh: &'a Bvh) -> Self {
        let mut dipoles = vec![Dipole::default(); bvh.nodes.len()];
        for index in (0..bvh.nodes.len()).rev() {
            dipoles[index] = match bvh.nodes[index] {
                node @ Node { count: 0, .. } => {
                    joined(&dipoles[node.first as usize], &dipoles[node.first as usize + 1], &node)
                }
                node => leaf_dipole(&bvh.corners[Bvh::slots(&node)], &node),
            };
        }
        Self { bvh, dipoles }
    }

    /// The winding number at a point: about 1 inside, 0 outside, 1/2 on the surface and in the middle of a hole.
    pub fn winding_number(&self, query: DVec3) -> f64 {
        let mut sum = 0.0;
        let mut stack = Vec::with_capacity(64);
        stack.push(0usize);
        while let Some(index) = stack.pop() {
            let dipole = &self.dipoles[index];
            let offset = dipole.centre - query;
            let distance_sq = offset.length_squared();
            if distance_sq > dipole.far_sq {
                sum += dipole.area_normal.dot(offset) / (distance_sq * distance_sq.sqrt());
                continue;
            }
            let node = &self.bvh.nodes[index];
            if node.count == 0 {
                stack.extend([node.first as usize + 1, node.first as usize]);
                continue;
            }
            sum += solid_angles(&self.bvh.corners[Bvh::slots(node)], query);
        }
        sum / (4.0 * std::f64::consts::PI)
    }
}

/// Winding numbers of many points, in parallel.
pub fn winding_numbers(bvh: &Bvh, queries: &[DVec3]) -> Vec<f64> {
    let tree = WindingTree::new(bvh);
    queries.par_iter().map(|&query| tree.winding_number(query)).collect()
}

fn joined(a: &Dipole, b: &Dipole, node: &Node) -> Dipole {
    let area = a.area + b.area;
    let centre = if area > 0.0 { (a.centre * a.area + b.centre * b.area) / area } else { node.bounds.centre() };
    Dipole { centre, area_normal: a.area_normal + b.area_normal, area, far_sq: far_sq(centre, node) }
}

fn leaf_dipole(triangles: &[[DVec3; 3]], node: &Node) -> Dipole {
    let mut sum = Dipole::default();
    for [a, b, c] in triangles {
        let area_normal = (*b - *a).cross(*c - *a) * 0.5;
        let area = area_normal.length();
        sum.area += area;
        sum.area_normal += area_normal;
        sum.centre += (*a + *b + *c) * (area / 3.0);
    }
    sum.centre = if sum.area > 0.0 { sum.centre / sum.area } else { node.bounds.centre() };
    Dipole { far_sq: far_sq(sum.centre, node), ..sum }
}

/// Square of `ACCEPTANCE` times the distance of the box's farthest corner.
fn far_sq(centre: DVec3, node: &Node) -> f64 {
    ACCEPTANCE * ACCEPTANCE * (centre - node.bounds.min).max(node.bounds.max - centre).length_squared()
}

/// Signed solid angles of triangles (van Oosterom and Strackee 1983), added up; positive seen from behind.
///
/// Half of each is the angle of a complex number. Where that is within an eighth of a turn, four of them add up without
/// going round as the angle of their product, and one arctangent does for all.
fn solid_angles(triangles: &[[DVec3; 3]], query: DVec3) -> f64 {
    let (mut real, mut imaginary, mut factors, mut sum) = (1.0, 0.0, 0, 0.0);
    for corners in triangles {
        let (re, im) = half_solid_angle(corners, query);
        if re <= im.abs() {
            sum += im.atan2(re);
            continue;
        }
        // Of length 1 to 1.5, so that products neither vanish nor overflow.
        (real, imaginary) = (real - imaginary * (im / re), imaginary + real * (im / re));
        factors += 1;
        if factors == 4 {
            sum += f64::atan2(imaginary, real);
            (real, imaginary, factors) = (1.0, 0.0, 0);
        }
    }
    2.0 * (sum + imaginary.atan2(real))
}

/// A complex number whose angle is half the triangle's solid angle.
fn half_solid_angle(corners: &[DVec3; 3], query: DVec3) -> (f64, f64) {
    let [a, b, c] = corners.map(|p| p - query);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    (la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb, a.dot(b.cross(c)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of all sizes around the origin, from pseudo-random corners.
    fn triangles(count: usize) -> Vec<[DVec3; 3]> {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        let mut point = |size: f64| DVec3::new(next(), next(), next()) * size;
        (0..count)
            .map(|k| {
                let (middle, size) = (point(2.0), [0.05, 0.5, 3.0][k % 3]);
                [0; 3].map(|_| middle + point(size))
            })
            .collect()
    }

    #[test]
    fn one_arctangent_for_many_gives_the_sum_of_theirs() {
        let triangles = triangles(3000);
        for leaf in triangles.chunks(5) {
            let one_by_one: f64 = leaf
                .iter()
                .map(|corners| half_solid_angle(corners, DVec3::ZERO))
                .map(|(re, im)| 2.0 * im.atan2(re))
                .sum();
            assert!((solid_angles(leaf, DVec3::ZERO) - one_by_one).abs() < 1e-12);
        }
    }

    #[test]
    fn an_octant_has_an_eighth_of_the_sphere() {
        let found = solid_angles(&[[DVec3::X, DVec3::Y, DVec3::Z]], DVec3::ZERO);
        assert!((found.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
    }
}
