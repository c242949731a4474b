//! Signed distances on a box of points, with the slope between them.

use glam::DVec3;

/// Distances to a surface, metres, negative inside, on a lattice of points.
#[derive(Clone, Copy, Debug)]
pub struct DistanceField<'a> {
    /// First point of the lattice.
    pub origin: DVec3,
    /// Way from point to point, metres.
    pub spacing: f64,
    /// Points along x, y and z.
    pub counts: [usize; 3],
    /// x fastest, then y, then z.
    pub values: &'a [f32],
}

impl DistanceField<'_> {
    /// Trilinear distance, and the unit slope of it; `None` outside the box.
    #[must_use]
    pub fn at(&self, point: DVec3) -> Option<(f64, DVec3)> {
        let q = (point - self.origin) / self.spacing;
        let inside = (0..3).all(|k| q[k] >= 0.0 && q[k] < (self.counts[k] - 1) as f64);
        if !inside {
            return None;
        }
        let low = q.floor();
        let f = q - low;
        let [nx, ny, _] = self.counts;
        let base = (low.z as usize * ny + low.y as usize) * nx + low.x as usize;
        let value = |x: usize, y: usize, z: usize| f64::from(self.values[base + (z * ny + y) * nx + x]);
        let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let edges = [[value(0, 0, 0), value(1, 0, 0)], [value(0, 1, 0), value(1, 1, 0)]];
        let far = [[value(0, 0, 1), value(1, 0, 1)], [value(0, 1, 1), value(1, 1, 1)]];
        let along = |face: &[[f64; 2]; 2], y: usize| lerp(face[y][0], face[y][1], f.x);
        let near_rows = [along(&edges, 0), along(&edges, 1)];
        let far_rows = [along(&far, 0), along(&far, 1)];
        let (near, beyond) = (lerp(near_rows[0], near_rows[1], f.y), lerp(far_rows[0], far_rows[1], f.y));
        let rise = |face: &[[f64; 2]; 2]| lerp(face[0][1] - face[0][0], face[1][1] - face[1][0], f.y);
        let slope = DVec3::new(
            lerp(rise(&edges), rise(&far), f.z),
            lerp(near_rows[1] - near_rows[0], far_rows[1] - far_rows[0], f.z),
            beyond - near,
        );
        Some((lerp(near, beyond, f.z), slope.normalize_or_zero()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_read_exactly_and_nothing_is_known_outside() {
        let normal = DVec3::new(2.0, -1.0, 2.0) / 3.0;
        let counts = [4, 5, 6];
        let mut values = Vec::new();
        for z in 0..6 {
            for y in 0..5 {
                for x in 0..4 {
                    values.push((normal.dot(DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * 0.5) - 0.3) as f32);
                }
            }
        }
        let field = DistanceField { origin: DVec3::ZERO, spacing: 0.5, counts, values: &values };
        let point = DVec3::new(0.7, 1.1, 2.2);
        let (distance, slope) = field.at(point).expect("inside");
        assert!((distance - (normal.dot(point) - 0.3)).abs() < 1e-6);
        assert!((slope - normal).length() < 1e-6);
        assert!(field.at(DVec3::new(-0.01, 1.0, 1.0)).is_none());
        assert!(field.at(DVec3::new(1.5, 1.0, 1.0)).is_none());
    }
}
