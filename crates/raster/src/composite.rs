//! From fragments to a picture.

use rayon::prelude::*;

use crate::splat::SegmentFragments;

/// Sums of weight times colour over the fragments of every pixel: premultiplied RGBA, `pixels` x 4.
///
/// `rgba` has four numbers a fragment: colour, not premultiplied, and the share of its weight that counts. Fragments of a
/// pixel cover different samples, so their order does not matter to the picture; the sum runs in the order of the list.
pub fn composite(pixel_offsets: &[i64], weight: &[f32], rgba: &[[f32; 4]]) -> Vec<[f32; 4]> {
    pixel_offsets
        .par_windows(2)
        .with_min_len(4096)
        .map(|range| {
            let mut sum = [0.0f32; 4];
            for i in range[0] as usize..range[1] as usize {
                let share = weight[i] * rgba[i][3];
                for channel in 0..3 {
                    sum[channel] += share * rgba[i][channel];
                }
                sum[3] += share;
            }
            sum
        })
        .collect()
}

/// The strands alone in the colours of their points, before nothing: premultiplied RGBA, `pixels` x 4.
pub fn strand_picture(fragments: &SegmentFragments, colors: &[[f32; 3]]) -> Vec<[f32; 4]> {
    (0..fragments.pixel_offsets.len().saturating_sub(1))
        .into_par_iter()
        .with_min_len(4096)
        .map(|pixel| {
            let mut sum = [0.0f32; 4];
            fragments.for_each_share_of(pixel, |point, share| {
                let color = &colors[point];
                (0..3).for_each(|channel| sum[channel] += share * color[channel]);
                sum[3] += share;
            });
            sum
        })
        .collect()
}
