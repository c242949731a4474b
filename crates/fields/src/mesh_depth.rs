//! Nearest and farthest depth of a mesh in every cell of a picture.

use crate::FieldError;
use glam::{DVec2, DVec3};

/// Largest and smallest z of the mesh in each cell of a picture; NaN where the mesh is not.
#[derive(Clone, Debug)]
pub struct MeshDepth {
    /// Largest z (towards the camera), rows x columns.
    pub front: Vec<f64>,
    /// Smallest z.
    pub back: Vec<f64>,
}

/// Depths of the triangles under every cell's centre (column + 0.5, row + 0.5). `vertices` holds x and y in cells and any z.
///
/// Costs the number of cells under all triangles.
///
/// # Errors
/// A triangle names a vertex that is not there.
pub fn mesh_depth(
    vertices: &[DVec3],
    triangles: &[[i32; 3]],
    rows: usize,
    columns: usize,
) -> Result<MeshDepth, FieldError> {
    let mut out = MeshDepth { front: vec![f64::NAN; rows * columns], back: vec![f64::NAN; rows * columns] };
    for (number, triangle) in triangles.iter().enumerate() {
        let mut corner = [DVec3::ZERO; 3];
        for (corner, &v) in corner.iter_mut().zip(triangle) {
            *corner = *usize::try_from(v).ok().and_then(|v| vertices.get(v)).ok_or(FieldError::Vertex {
                triangle: number,
                vertex: v as u32,
                vertices: vertices.len(),
            })?;
        }
        splat(&mut out, corner, rows, columns);
    }
    Ok(out)
}

fn splat(out: &mut MeshDepth, corner: [DVec3; 3], rows: usize, columns: usize) {
    let [a, b, c] = corner.map(DVec3::truncate);
    let area = (b - a).perp_dot(c - a);
    if !area.is_finite() || area == 0.0 {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let span = |low: f64, high: f64, size: usize| {
        let first = (low - 0.5).ceil().clamp(0.0, size as f64) as usize;
        let end = ((high - 0.5).floor() + 1.0).clamp(0.0, size as f64) as usize;
        first..end
    };
    for row in span(low.y, high.y, rows) {
        for column in span(low.x, high.x, columns) {
            let p = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let u = (b - p).perp_dot(c - p) / area;
            let v = (c - p).perp_dot(a - p) / area;
            let w = 1.0 - u - v;
            if u < -1e-12 || v < -1e-12 || w < -1e-12 {
                continue;
            }
            let z = u * corner[0].z + v * corner[1].z + w * corner[2].z;
            let cell = row * columns + column;
            out.front[cell] = out.front[cell].max(z);
            out.back[cell] = out.back[cell].min(z);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilted_triangle_gives_its_plane() {
        let plane = |x: f64, y: f64| 0.5 * x - 0.25 * y + 1.0;
        let vertices: Vec<DVec3> =
            [(-1.0, -1.0), (30.0, -1.0), (-1.0, 30.0)].iter().map(|&(x, y)| DVec3::new(x, y, plane(x, y))).collect();
        let out = mesh_depth(&vertices, &[[0, 1, 2]], 10, 10).expect("fits");
        for cell in 0..100 {
            let z = plane((cell % 10) as f64 + 0.5, (cell / 10) as f64 + 0.5);
            assert!((out.front[cell] - z).abs() < 1e-9 && (out.back[cell] - z).abs() < 1e-9);
        }
    }

    #[test]
    fn a_missing_vertex_is_refused() {
        assert!(mesh_depth(&[DVec3::ZERO], &[[0, 0, 4]], 2, 2).is_err());
    }
}
