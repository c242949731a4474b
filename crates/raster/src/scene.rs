//! What is rasterised: projected strands and triangles.

use crate::{Cutout, ProjectedVertex, RasterError};

/// Strands and triangles on the screen, flat. Strand i has the points `offsets[i]..offsets[i + 1]`.
#[derive(Debug, Clone, Copy)]
pub struct ProjectedScene<'a> {
    /// Points of all strands, each the fields of a `ProjectedVertex` in their order.
    pub strand_points: &'a [[f32; 4]],
    /// First point of every strand, and the number of points.
    pub offsets: &'a [i64],
    /// Half of the strand's width at every point, in pixels. Strands narrower than `min_width_px` are drawn that wide
    /// with as much less opacity.
    pub half_width_px: &'a [f32],
    /// Opacity at every point, 0 to 1.
    pub alpha: &'a [f32],
    /// Vertices of all triangles.
    pub mesh_vertices: &'a [ProjectedVertex],
    /// Corners of the triangles; both sides are drawn.
    pub triangles: &'a [[u32; 3]],
    /// Pictures of opacity that triangles may name.
    pub cutouts: &'a [Cutout<'a>],
    /// The picture of every triangle, -1 for one that is opaque; empty where all are.
    pub cutout_of_triangle: &'a [i32],
    /// Texture coordinates (u, v) of the three corners of every triangle; empty where all are opaque.
    pub corner_uv: &'a [[f32; 6]],
    /// Least width of a strand on the screen, in pixels.
    pub min_width_px: f32,
    /// Width of the picture, in pixels.
    pub width: usize,
    /// Height of the picture, in pixels.
    pub height: usize,
}

impl ProjectedScene<'_> {
    /// Refuses arrays that do not fit together.
    ///
    /// # Errors
    /// The first thing that does not fit.
    pub fn check(&self) -> Result<(), RasterError> {
        const LARGEST: usize = 16384;
        if !(1..=LARGEST).contains(&self.width) || !(1..=LARGEST).contains(&self.height) {
            return Err(RasterError::Size(self.width, self.height));
        }
        let expected = self.strand_points.len();
        for (what, given) in [("half_width_px", self.half_width_px.len()), ("alpha", self.alpha.len())] {
            if given != expected {
                return Err(RasterError::Length { what, given, expected });
            }
        }
        self.check_offsets()?;
        let count = self.mesh_vertices.len();
        match self.triangles.iter().position(|t| t.iter().any(|&v| v as usize >= count)) {
            Some(triangle) => Err(RasterError::NoSuchVertex(triangle)),
            None => self.check_cutouts(),
        }
    }

    /// The picture of opacity of a triangle; None where it is opaque.
    pub(crate) fn cutout(&self, triangle: usize) -> Option<&Cutout<'_>> {
        self.cutout_of_triangle.get(triangle).and_then(|&cutout| self.cutouts.get(usize::try_from(cutout).ok()?))
    }

    fn check_cutouts(&self) -> Result<(), RasterError> {
        let expected = self.triangles.len();
        if self.cutout_of_triangle.is_empty() {
            return Ok(());
        }
        let given = [("cutout_of_triangle", self.cutout_of_triangle.len()), ("corner_uv", self.corner_uv.len())];
        if let Some(&(what, given)) = given.iter().find(|(_, given)| *given != expected) {
            return Err(RasterError::Length { what, given, expected });
        }
        let fits = |&cutout: &i32| {
            usize::try_from(cutout).map_or(cutout == -1, |i| self.cutouts.get(i).is_some_and(Cutout::fits))
        };
        self.cutout_of_triangle
            .iter()
            .position(|cutout| !fits(cutout))
            .map_or(Ok(()), |i| Err(RasterError::NoSuchCutout(i)))
    }

    fn check_offsets(&self) -> Result<(), RasterError> {
        let count = self.strand_points.len();
        let ends = (self.offsets.first().copied().unwrap_or(0), self.offsets.last().copied().unwrap_or(0));
        if ends != (0, count as i64) || !self.offsets.is_sorted() {
            return Err(RasterError::Offsets(count));
        }
        Ok(())
    }
}
