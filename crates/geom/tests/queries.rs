//! Queries against brute force and closed forms.

use glam::DVec3;
use proptest::prelude::*;
use tress_geom::{
    Bvh, Ray, TriangleMesh, barycentric_point, closest_on_triangle, closest_points, first_hits, signed_distances,
    winding_numbers,
};

/// A sphere of radius 1 about the origin; the rings below `first_ring` are left out, so that it is open at the bottom.
fn sphere(rings: usize, first_ring: usize) -> TriangleMesh {
    let sectors = 2 * rings;
    let point = |ring: usize, sector: usize| {
        let polar = std::f64::consts::PI * (1.0 - ring as f64 / rings as f64);
        let azimuth = std::f64::consts::TAU * sector as f64 / sectors as f64;
        DVec3::new(polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos())
    };
    let mut positions = Vec::new();
    for ring in 0..=rings {
        positions.extend((0..sectors).map(|sector| point(ring, sector)));
    }
    let mut triangles = Vec::new();
    for ring in first_ring..rings {
        for sector in 0..sectors {
            let next = (sector + 1) % sectors;
            let [a, b] = [ring * sectors + sector, ring * sectors + next].map(|v| v as u32);
            let (c, d) = (b + sectors as u32, a + sectors as u32);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(positions, triangles).expect("a valid sphere")
}

fn grid(count: usize, reach: f64) -> Vec<DVec3> {
    let at = |i: usize| reach * ((i as f64 + 0.37) / count as f64 * 2.0 - 1.0);
    (0..count.pow(3)).map(|i| DVec3::new(at(i % count), at(i / count % count), at(i / count / count))).collect()
}

#[test]
fn closest_points_equal_brute_force() {
    let mesh = sphere(12, 0);
    let bvh = Bvh::new(&mesh).expect("triangles");
    let queries = grid(7, 1.6);
    for (query, found) in queries.iter().zip(closest_points(&bvh, &queries)) {
        let brute = (0..mesh.triangles().len())
            .map(|t| {
                barycentric_point(&mesh.corners(t), closest_on_triangle(&mesh.corners(t), *query)).distance(*query)
            })
            .fold(f64::INFINITY, f64::min);
        assert!((found.distance - brute).abs() < 1e-12);
        let there = barycentric_point(&mesh.corners(found.triangle as usize), found.barycentric);
        assert!((there.distance(*query) - brute).abs() < 1e-12);
    }
}

#[test]
fn inside_of_a_closed_and_of_an_open_sphere() {
    let queries = grid(9, 1.4);
    for (first_ring, lowest) in [(0, -2.0), (3, -0.6)] {
        let mesh = sphere(24, first_ring);
        let bvh = Bvh::new(&mesh).expect("triangles");
        let distances = signed_distances(&bvh, &queries);
        for (query, found) in queries.iter().zip(distances) {
            let exact = query.length() - 1.0;
            if query.z > lowest && exact.abs() > 0.02 {
                assert_eq!(found.distance < 0.0, exact < 0.0, "{query}");
                let expected_error = if first_ring == 0 { 0.01 } else { f64::INFINITY };
                assert!((found.distance - exact).abs() < expected_error, "{query}");
            }
        }
    }
}

#[test]
fn fast_winding_numbers_are_near_one_and_zero() {
    let mesh = sphere(32, 0);
    let bvh = Bvh::new(&mesh).expect("triangles");
    let queries = grid(9, 1.5);
    for (query, winding) in queries.iter().zip(winding_numbers(&bvh, &queries)) {
        if (query.length() - 1.0).abs() > 0.02 {
            let exact = if query.length() < 1.0 { 1.0 } else { 0.0 };
            assert!((winding - exact).abs() < 0.02, "{query}: {winding}");
        }
    }
}

#[test]
fn a_plane_parallel_to_the_ray_is_missed_and_either_side_is_hit() {
    let mesh = TriangleMesh::from_flat(&[0., 0., 0., 1., 0., 0., 0., 1., 0.], &[0, 1, 2]).expect("a triangle");
    let bvh = Bvh::new(&mesh).expect("a triangle");
    let ray = |origin: [f64; 3], direction: [f64; 3]| Ray {
        origin: DVec3::from_array(origin),
        direction: DVec3::from_array(direction),
        limit: f64::INFINITY,
    };
    let rays = [
        ray([0.25, 0.25, 1.0], [0.0, 0.0, -2.0]),
        ray([0.25, 0.25, -1.0], [0.0, 0.0, 1.0]),
        ray([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]),
        ray([0.25, 0.25, 1.0], [0.0, 0.0, 1.0]),
    ];
    let hits = first_hits(&bvh, &rays);
    assert_eq!(hits.iter().map(|h| h.map(|h| h.t)).collect::<Vec<_>>(), [Some(0.5), Some(1.0), None, None]);
    assert!(!bvh.any_hit(&Ray { limit: 0.4, ..rays[0] }));
    assert!(bvh.any_hit(&rays[0]));
}

proptest! {
    #[test]
    fn rays_from_the_middle_hit_the_sphere_once(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -0.999..0.999f64) {
        prop_assume!(x * x + y * y > 1e-4);
        let mesh = sphere(16, 0);
        let bvh = Bvh::new(&mesh).expect("triangles");
        let direction = DVec3::new(x, y, z);
        let hit = bvh.first_hit(&Ray { origin: DVec3::ZERO, direction, limit: f64::INFINITY });
        let hit = hit.expect("the sphere is closed");
        prop_assert!((hit.t * direction.length() - 1.0).abs() < 0.02);
        let there = barycentric_point(&mesh.corners(hit.triangle as usize), hit.barycentric);
        prop_assert!(there.distance(direction * hit.t) < 1e-9);
    }
}
