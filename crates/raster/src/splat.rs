//! From the picture back to the vertices of the strands: the transpose of shading.
//!
//! A fragment of a segment shows a mix of its two points, `(1 - t)` and `t`. Whatever is known of its pixel is handed back
//! to the two points in the same shares. Sums run in the order of the fragments, so that they are the same bits always.

/// Fragments of segments, as flat arrays.
#[derive(Debug, Clone, Copy)]
pub struct SegmentFragments<'a> {
    /// First fragment of every pixel, and the number of fragments.
    pub pixel_offsets: &'a [i64],
    /// 0 where the fragment is a segment.
    pub kind: &'a [u8],
    /// First point of the segment.
    pub primitive: &'a [i32],
    /// Position along the segment, and one more number that is not used.
    pub parameter: &'a [[f32; 2]],
    /// Share of the pixel.
    pub weight: &'a [f32],
}

impl SegmentFragments<'_> {
    /// The fragments of a pixel.
    pub(crate) fn of_pixel(&self, pixel: usize) -> std::ops::Range<usize> {
        self.pixel_offsets[pixel] as usize..self.pixel_offsets[pixel + 1] as usize
    }

    /// Calls `visit(pixel, point, share)` for both points of every fragment of a segment.
    pub(crate) fn for_each_share(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for pixel in 0..self.pixel_offsets.len().saturating_sub(1) {
            self.for_each_share_of(pixel, |point, share| visit(pixel, point, share.into()));
        }
    }

    /// Calls `visit(point, share)` for both points of every fragment of a segment in one pixel.
    #[inline]
    pub(crate) fn for_each_share_of(&self, pixel: usize, mut visit: impl FnMut(usize, f32)) {
        for i in self.of_pixel(pixel) {
            if self.kind[i] == 0 {
                let (first, t) = (self.primitive[i] as usize, self.parameter[i][0]);
                visit(first, self.weight[i] * (1.0 - t));
                visit(first + 1, self.weight[i] * t);
            }
        }
    }
}

/// How much every point shows in the picture, in pixels.
pub fn visible_weight(fragments: &SegmentFragments, points: usize) -> Vec<f32> {
    let mut sum = vec![0.0f64; points];
    fragments.for_each_share(|_, point, share| sum[point] += share);
    sum.into_iter().map(|s| s as f32).collect()
}
