//! From shaded fragments to a picture.

use rayon::prelude::*;

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
