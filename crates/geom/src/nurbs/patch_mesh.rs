//! The triangles over the grid lines of a surface.
//!
//! Corners are the control points that knot insertion puts on the crossings of the lines. Where the first or last row
//! or column has collapsed to a point (the tip of a strip), each cell gets a corner of its own there, at the middle of
//! its side, so that textures are not skewed, and one triangle in place of two; no triangle has two corners in one place.

use glam::DVec3;

use super::curve::projected;
use super::net::Lines;
use super::{Grid, NurbsError, Surface};

/// Corners closer than this share of the surface's extent are one.
const SAME_PLACE: f64 = 1e-9;

/// Triangles that stand for a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PatchMesh {
    /// Corners, on the surface.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals of the surface there, du x dv.
    pub normals: Vec<[f64; 3]>,
    /// Parameters there.
    pub uv: Vec<[f64; 2]>,
    /// Indices of three corners, counter-clockwise about the normal.
    pub triangles: Vec<[u32; 3]>,
    /// Number of intervals along u and v.
    pub segments: [usize; 2],
    /// Bound of the distance from the surface, where the grid has one.
    pub error: Option<f64>,
}

impl PatchMesh {
    /// The triangles over grid lines.
    ///
    /// # Errors
    /// Lines that do not increase from one end of the domain to the other.
    pub fn new(surface: &Surface, grid: &Grid) -> Result<Self, NurbsError> {
        let u = Lines::new(surface.u(), grid.u.clone())?;
        let v = Lines::new(surface.v(), grid.v.clone())?;
        let crossings = surface.refined_points(&u.to_lines(surface.u())?, &v.to_lines(surface.v())?);
        let crossings: Vec<DVec3> = crossings.into_iter().map(projected).collect();
        Ok(Builder::new(surface, grid, &crossings).mesh())
    }
}

/// Which corners stand where, while a mesh is made.
struct Builder<'a> {
    surface: &'a Surface,
    grid: &'a Grid,
    crossings: &'a [DVec3],
    /// Corners closer than the root of this are one.
    same_sq: f64,
    mesh: PatchMesh,
    /// The corner on every crossing; none where a side has collapsed.
    on_crossing: Vec<u32>,
    /// The corners of cells at the first and last row, where these have collapsed.
    row_tips: [Option<Vec<u32>>; 2],
    /// The corners of cells at the first and last column, where these have collapsed.
    column_tips: [Option<Vec<u32>>; 2],
}

impl<'a> Builder<'a> {
    fn new(surface: &'a Surface, grid: &'a Grid, crossings: &'a [DVec3]) -> Self {
        let segments = [grid.u.len() - 1, grid.v.len() - 1];
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = crossings.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
        let same_sq = (SAME_PLACE * (high - low).length()).powi(2);
        let mesh = PatchMesh { segments, error: grid.error, ..PatchMesh::default() };
        let (row_tips, column_tips) = ([None, None], [None, None]);
        Self { surface, grid, crossings, same_sq, mesh, on_crossing: Vec::new(), row_tips, column_tips }
    }

    fn mesh(mut self) -> PatchMesh {
        let [rows, columns] = self.mesh.segments;
        self.add_tips();
        self.add_crossings();
        for i in 0..rows {
            for j in 0..columns {
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(k, l)| self.corner([i, j], [i + k, j + l]));
                self.add_triangle([a, b, c]);
                self.add_triangle([a, c, d]);
            }
        }
        self.mesh
    }

    /// The corners at sides that have collapsed: one a cell, all at the place of the first.
    fn add_tips(&mut self) {
        let [rows, columns] = self.mesh.segments;
        let (u, v) = (&self.grid.u, &self.grid.v);
        for (side, row) in [0, rows].into_iter().enumerate() {
            let line: Vec<DVec3> = (0..=columns).map(|j| self.crossing(row, j)).collect();
            let uv = v.windows(2).map(|w| [u[row], 0.5 * (w[0] + w[1])]).collect();
            self.row_tips[side] = self.tips(&line, uv);
        }
        for (side, column) in [0, columns].into_iter().enumerate() {
            let line: Vec<DVec3> = (0..=rows).map(|i| self.crossing(i, column)).collect();
            let uv = u.windows(2).map(|w| [0.5 * (w[0] + w[1]), v[column]]).collect();
            self.column_tips[side] = self.tips(&line, uv);
        }
    }

    fn tips(&mut self, line: &[DVec3], uv: Vec<[f64; 2]>) -> Option<Vec<u32>> {
        let collapsed = line.iter().all(|p| p.distance_squared(line[0]) <= self.same_sq);
        collapsed.then(|| uv.into_iter().map(|uv| self.add_corner(line[0], uv)).collect())
    }

    fn add_crossings(&mut self) {
        let [rows, columns] = self.mesh.segments;
        for i in 0..=rows {
            for j in 0..=columns {
                let tip = self.row_tip(i).or(self.column_tip(j)).is_some();
                let uv = [self.grid.u[i], self.grid.v[j]];
                let corner = if tip { u32::MAX } else { self.add_corner(self.crossing(i, j), uv) };
                self.on_crossing.push(corner);
            }
        }
    }

    fn add_corner(&mut self, position: DVec3, [u, v]: [f64; 2]) -> u32 {
        self.mesh.positions.push(position.to_array());
        self.mesh.normals.push(self.surface.normal(u, v).to_array());
        self.mesh.uv.push([u, v]);
        self.mesh.positions.len() as u32 - 1
    }

    /// Leaves out triangles with two corners in one place.
    fn add_triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|corner| DVec3::from_array(self.mesh.positions[corner as usize]));
        let apart = |p: DVec3, q: DVec3| p.distance_squared(q) > self.same_sq;
        if apart(a, b) && apart(b, c) && apart(c, a) {
            self.mesh.triangles.push(corners);
        }
    }

    /// The corner of a cell at a crossing.
    fn corner(&self, cell: [usize; 2], [row, column]: [usize; 2]) -> u32 {
        match (self.row_tip(row), self.column_tip(column)) {
            (Some(tips), _) => tips[cell[1]],
            (None, Some(tips)) => tips[cell[0]],
            (None, None) => self.on_crossing[row * (self.mesh.segments[1] + 1) + column],
        }
    }

    fn row_tip(&self, row: usize) -> Option<&Vec<u32>> {
        tip(&self.row_tips, row, self.mesh.segments[0])
    }

    fn column_tip(&self, column: usize) -> Option<&Vec<u32>> {
        tip(&self.column_tips, column, self.mesh.segments[1])
    }

    fn crossing(&self, row: usize, column: usize) -> DVec3 {
        self.crossings[row * (self.mesh.segments[1] + 1) + column]
    }
}

/// The tips at a line, if it is the first or the last and has collapsed.
fn tip(tips: &[Option<Vec<u32>>; 2], line: usize, last: usize) -> Option<&Vec<u32>> {
    let first = (line == 0).then_some(&tips[0]);
    first.or((line == last).then_some(&tips[1])).and_then(Option::as_ref)
}
