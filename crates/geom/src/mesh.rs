//! A triangle mesh whose indices are known to be valid.

use glam::DVec3;
use thiserror::Error;

/// Why arrays are no mesh.
#[derive(Debug, Error, PartialEq)]
pub enum MeshError {
    /// A flat array does not consist of triples.
    #[error("{what} has {length} numbers; a multiple of 3 was expected")]
    NotTriples {
        /// Name of the array.
        what: &'static str,
        /// Its length.
        length: usize,
    },
    /// A corner names no vertex.
    #[error("triangle {triangle} names vertex {vertex} of {count}")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {0} is not finite")]
    NotFinite(usize),
    /// Queries need a surface.
    #[error("the mesh has no triangles")]
    Empty,
}

/// Vertices and triangles, counter-clockwise seen from outside; every index is in range, every coordinate finite.
#[derive(Debug, Clone)]
pub struct TriangleMesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// A mesh of flat arrays: x, y, z of every vertex, three indices of every triangle.
    ///
    /// # Errors
    /// Lengths that are no multiples of three, indices out of range, coordinates that are not finite.
    pub fn from_flat(positions: &[f64], triangles: &[u32]) -> Result<Self, MeshError> {
        let positions = triples(positions, "positions")?.map(DVec3::from_array).collect();
        let triangles = triples(triangles, "triangles")?.collect();
        Self::new(positions, triangles)
    }

    /// A mesh of vertices and triangles.
    ///
    /// # Errors
    /// Indices out of range, coordinates that are not finite.
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite(vertex));
        }
        let count = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= count) {
                return Err(MeshError::NoSuchVertex { triangle, vertex, count });
            }
        }
        Ok(Self { positions, triangles })
    }

    /// The vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The corners of the triangles, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of one triangle as points.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

fn triples<'a, T: Copy>(flat: &'a [T], what: &'static str) -> Result<impl Iterator<Item = [T; 3]> + 'a, MeshError> {
    if !flat.len().is_multiple_of(3) {
        return Err(MeshError::NotTriples { what, length: flat.len() });
    }
    Ok(flat.chunks_exact(3).map(|c| [c[0], c[1], c[2]]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_arrays_are_refused() {
        let refused = |p: &[f64], t: &[u32]| TriangleMesh::from_flat(p, t).err();
        assert_eq!(refused(&[0.0; 4], &[]), Some(MeshError::NotTriples { what: "positions", length: 4 }));
        let no_such = MeshError::NoSuchVertex { triangle: 0, vertex: 2, count: 2 };
        assert_eq!(refused(&[0.0; 6], &[0, 1, 2]), Some(no_such));
        assert_eq!(refused(&[0.0, f64::NAN, 0.0], &[]), Some(MeshError::NotFinite(0)));
    }
}
