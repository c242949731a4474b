//! From metres to the screen.
//!
//! A projected vertex keeps a depth that is *linear on the screen*, so that it can be interpolated between vertices
//! without a division: metres along the view axis for an affine camera, the negative inverse of the distance for a
//! perspective one (the GPU's z). Both grow away from the camera. `scale` is the number of pixels a metre covers there; it
//! is proportional to the inverse distance, and serves to interpolate attributes in perspective.

use glam::DVec3;
use rayon::prelude::*;

use crate::RasterError;

/// x and y in pixels (first pixel centre at 0.5), depth away from the viewer and linear on the screen, pixels a metre.
/// A `scale` of 0 marks a vertex behind the camera: what hangs on it is not drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ProjectedVertex {
    /// Pixels to the right.
    pub x: f32,
    /// Pixels down.
    pub y: f32,
    /// Grows away from the viewer, linear on the screen.
    pub depth: f32,
    /// Pixels a metre; positive.
    pub scale: f32,
}

impl From<[f32; 4]> for ProjectedVertex {
    fn from([x, y, depth, scale]: [f32; 4]) -> Self {
        Self { x, y, depth, scale }
    }
}

impl From<ProjectedVertex> for [f32; 4] {
    fn from(vertex: ProjectedVertex) -> Self {
        [vertex.x, vertex.y, vertex.depth, vertex.scale]
    }
}

/// Projects points in metres by the matrix `[u w, v w, w] = M [x, y, z, 1]`, row by row, affine or perspective.
///
/// # Errors
/// A projection that is not finite.
pub fn project(points: &[[f32; 3]], matrix: &[[f64; 4]; 3]) -> Result<Vec<ProjectedVertex>, RasterError> {
    let camera = Camera::new(matrix);
    let projected: Vec<ProjectedVertex> =
        points.par_iter().map(|p| camera.project(DVec3::new(p[0].into(), p[1].into(), p[2].into()))).collect();
    let finite = |v: &ProjectedVertex| v.x.is_finite() && v.y.is_finite() && v.depth.is_finite();
    match projected.par_iter().position_first(|v| !finite(v)) {
        Some(vertex) => Err(RasterError::NotFinite(vertex)),
        None => Ok(projected),
    }
}

struct Camera {
    rows: [DVec3; 3],
    shift: [f64; 3],
    /// Unit vector away from the camera.
    away: DVec3,
    perspective: bool,
    /// Pixels a metre where w is 1.
    side: f64,
    w_sign: f64,
}

impl Camera {
    fn new(matrix: &[[f64; 4]; 3]) -> Self {
        let rows = matrix.map(|r| DVec3::new(r[0], r[1], r[2]));
        let shift = matrix.map(|r| r[3]);
        let perspective = rows[2].length() > 1e-9 * rows[0].length();
        let away = if perspective { rows[2].normalize() } else { rows[0].cross(rows[1]).normalize_or_zero() };
        let side = (rows[0] - away * rows[0].dot(away)).length();
        Self { rows, shift, away, perspective, side, w_sign: if perspective { 1.0 } else { shift[2].signum() } }
    }

    fn project(&self, point: DVec3) -> ProjectedVertex {
        let w = self.rows[2].dot(point) + self.shift[2];
        if w * self.w_sign <= 0.0 {
            return ProjectedVertex::default();
        }
        let depth = if self.perspective { -self.rows[2].length() / w } else { self.away.dot(point) };
        ProjectedVertex {
            x: ((self.rows[0].dot(point) + self.shift[0]) / w) as f32,
            y: ((self.rows[1].dot(point) + self.shift[1]) / w) as f32,
            depth: depth as f32,
            scale: (self.side / w.abs()) as f32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AFFINE: [[f64; 4]; 3] = [[500.0, 0.0, 0.0, 50.0], [0.0, -500.0, 0.0, 40.0], [0.0, 0.0, 0.0, 1.0]];
    // Camera at z = 2, looking along -z, 1000 px focal length.
    const PERSPECTIVE: [[f64; 4]; 3] =
        [[1000.0, 0.0, -50.0, 100.0], [0.0, -1000.0, -40.0, 80.0], [0.0, 0.0, -1.0, 2.0]];

    #[test]
    fn affine_keeps_scale_and_looks_along_minus_z() {
        let v = project(&[[0.1, 0.02, 0.3]], &AFFINE).expect("finite")[0];
        assert_eq!([v.x, v.y, v.depth, v.scale], [100.0, 30.0, -0.3, 500.0]);
    }

    #[test]
    fn perspective_divides_and_orders_by_distance() {
        let found = project(&[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.5]], &PERSPECTIVE).expect("finite");
        assert_eq!([found[0].x, found[0].y, found[0].scale], [50.0, 40.0, 500.0]);
        assert_eq!([found[0].depth, found[1].depth], [-0.5, -1.0]);
        assert_eq!(found[1].scale, 1000.0);
        assert_eq!(found[2].scale, 0.0);
    }
}
