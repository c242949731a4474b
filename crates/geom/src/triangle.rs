//! Closest point of a triangle.
//!
//! Voronoi regions of corners, edges and the face are told apart by signs of dot products: Ericson, Real-Time
//! Collision Detection, section 5.1.5.

use glam::DVec3;

/// The point with these barycentric coordinates.
pub fn barycentric_point(corners: &[DVec3; 3], barycentric: [f64; 3]) -> DVec3 {
    corners[0] * barycentric[0] + corners[1] * barycentric[1] + corners[2] * barycentric[2]
}

/// Barycentric coordinates of the point of the triangle that is closest to `point`; they are not negative and sum to 1.
///
/// A triangle without area counts as its longest edge or its single point.
pub fn closest_on_triangle(corners: &[DVec3; 3], point: DVec3) -> [f64; 3] {
    let [a, b, c] = *corners;
    let (ab, ac, ap) = (b - a, c - a, point - a);
    if ab.cross(ac).length_squared() <= 1e-24 * ab.length_squared().max(ac.length_squared()).powi(2) {
        return closest_on_edges(corners, point);
    }
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let (v, w) = (vb / (va + vb + vc), vc / (va + vb + vc));
    [1.0 - v - w, v, w]
}

fn closest_on_edges(corners: &[DVec3; 3], point: DVec3) -> [f64; 3] {
    let mut best = ([1.0, 0.0, 0.0], f64::INFINITY);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let edge = corners[j] - corners[i];
        let length_sq = edge.length_squared();
        let t = if length_sq > 0.0 { ((point - corners[i]).dot(edge) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
        let distance_sq = (corners[i] + edge * t).distance_squared(point);
        if distance_sq < best.1 {
            let mut barycentric = [0.0; 3];
            barycentric[i] = 1.0 - t;
            barycentric[j] = t;
            best = (barycentric, distance_sq);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn no_point_of_the_triangle_is_closer(a in vector(), b in vector(), c in vector(), q in vector(),
                                              u in 0.0..1.0f64, v in 0.0..1.0f64) {
            let corners = [a, b, c];
            let barycentric = closest_on_triangle(&corners, q);
            prop_assert!(barycentric.iter().all(|&x| x >= -1e-12));
            prop_assert!((barycentric.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let other = barycentric_point(&corners, [1.0 - u - v, u, v]);
            prop_assert!(barycentric_point(&corners, barycentric).distance(q) <= other.distance(q) + 1e-9);
        }
    }

    #[test]
    fn flat_triangles_count_as_edges() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
        let found = barycentric_point(&corners, closest_on_triangle(&corners, DVec3::new(1.5, 1.0, 0.0)));
        assert!(found.distance(DVec3::new(1.5, 0.0, 0.0)) < 1e-12);
        let point = [DVec3::ONE; 3];
        assert_eq!(barycentric_point(&point, closest_on_triangle(&point, DVec3::ZERO)), DVec3::ONE);
    }
}
