//! What is rasterised: projected strands and triangles.

use crate::{ProjectedVertex, RasterError};

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
    /// Corners of the triangles; both sides are drawn, opaque.
    pub triangles: &'a [[u32; 3]],
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
            None => Ok(()),
        }
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
