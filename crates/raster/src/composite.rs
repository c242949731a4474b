//! From fragments to a picture.

use rayon::prelude::*;

use crate::splat::SegmentFragments;

/// Fragments that one core takes at a time.
const CHUNK: usize = 4096;

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

/// Values of the points, `channels` numbers each, at the places `t` from the points `first` to those after them.
pub fn interpolated(first: &[i32], t: &[f32], values: &[f32], channels: usize) -> Vec<f32> {
    let mut found = vec![0.0; first.len() * channels];
    found.par_chunks_mut(channels * CHUNK).zip(first.par_chunks(CHUNK).zip(t.par_chunks(CHUNK))).for_each(
        |(found, (first, t))| {
            for ((found, first), t) in found.chunks_exact_mut(channels).zip(first).zip(t) {
                let begin = *first as usize * channels;
                let (a, b) = values[begin..begin + 2 * channels].split_at(channels);
                for ((found, a), b) in found.iter_mut().zip(a).zip(b) {
                    *found = a * (1.0 - t) + b * t;
                }
            }
        },
    );
    found
}
