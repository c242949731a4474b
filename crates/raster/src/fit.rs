//! Colours of the strands' points with which the picture comes out as it should (analysis by synthesis).
//!
//! The picture is linear in the colours: a pixel shows the mean of its fragments' colours. SIRT hands each pixel's error
//! back to the points in the shares in which they show, as a weighted mean; Nesterov's momentum makes it fast. Both ways
//! are gathers, over pixels and over points, so that the sums have one order on any number of threads.

use rayon::prelude::*;

use crate::splat::SegmentFragments;

/// A share of a pixel's colour: which visible point, and how much.
type Share = (u32, f32);

/// Which points show in which pixels, from both sides.
struct Shares {
    /// Points that show, ascending.
    points: Vec<u32>,
    /// Pixels that count and show hair, ascending.
    pixels: Vec<u32>,
    /// Per pixel of `pixels`: visible point and share of the pixel's hair; the shares add up to 1.
    of_pixel: Rows,
    /// Per point of `points`: pixel and weight; the weights add up to 1.
    of_point: Rows,
}

/// Rows of unequal length.
struct Rows {
    offsets: Vec<usize>,
    entries: Vec<Share>,
}

impl Rows {
    fn row(&self, index: usize) -> &[Share] {
        &self.entries[self.offsets[index]..self.offsets[index + 1]]
    }

    /// The weighted sum of `values` in a row.
    fn sum(&self, index: usize, values: &[[f32; 3]]) -> [f32; 3] {
        let mut sum = [0.0f32; 3];
        for (at, share) in self.row(index) {
            let value = &values[*at as usize];
            (0..3).for_each(|c| sum[c] += share * value[c]);
        }
        sum
    }

    /// Rows of the transposed matrix, each entry scaled by `weight` of its old row, each new row scaled to sum 1.
    fn transposed(&self, weight: &[f32], rows: usize) -> Self {
        let mut offsets = vec![0usize; rows + 1];
        self.entries.iter().for_each(|(at, _)| offsets[*at as usize + 1] += 1);
        (0..rows).for_each(|row| offsets[row + 1] += offsets[row]);
        let mut next = offsets.clone();
        let mut entries = vec![(0, 0.0); self.entries.len()];
        for (old, weight) in weight.iter().enumerate() {
            for (at, share) in self.row(old) {
                let place = &mut next[*at as usize];
                entries[*place] = (old as u32, share * weight);
                *place += 1;
            }
        }
        for row in 0..rows {
            let row = &mut entries[offsets[row]..offsets[row + 1]];
            let sum: f32 = row.iter().map(|(_, share)| share).sum();
            row.iter_mut().for_each(|(_, share)| *share /= sum.max(1e-12));
        }
        Self { offsets, entries }
    }
}

impl Shares {
    fn new(fragments: &SegmentFragments, pixel_weight: &[f32], points: usize) -> Self {
        let mut seen = vec![false; points];
        fragments.for_each_share(|pixel, point, _| seen[point] |= pixel_weight[pixel] > 0.0);
        let points: Vec<u32> = (0..points as u32).filter(|point| seen[*point as usize]).collect();
        let mut number = vec![0u32; seen.len()];
        points.iter().enumerate().for_each(|(index, point)| number[*point as usize] = index as u32);
        let (mut pixels, mut weight) = (Vec::new(), Vec::new());
        let (mut offsets, mut entries) = (vec![0], Vec::<Share>::new());
        fragments.for_each_share(|pixel, point, share| {
            if pixel_weight[pixel] > 0.0 {
                if pixels.last() != Some(&(pixel as u32)) {
                    pixels.push(pixel as u32);
                    weight.push(pixel_weight[pixel]);
                    offsets.push(entries.len());
                }
                entries.push((number[point], share as f32));
                *offsets.last_mut().expect("never empty") = entries.len();
            }
        });
        let mut coverage = Vec::with_capacity(pixels.len());
        for pair in offsets.windows(2) {
            let row = &mut entries[pair[0]..pair[1]];
            let sum: f32 = row.iter().map(|(_, share)| share).sum();
            row.iter_mut().for_each(|(_, share)| *share /= sum.max(1e-12));
            coverage.push(sum);
        }
        let of_pixel = Rows { offsets, entries };
        let counts: Vec<f32> = weight.iter().zip(&coverage).map(|(weight, coverage)| weight * coverage).collect();
        let of_point = of_pixel.transposed(&counts, points.len());
        Self { points, pixels, of_pixel, of_point }
    }
}

/// Colours in [0, `most`] with which the hair's mean colour in every pixel of positive weight nears `target`.
///
/// Points that do not show keep their colour. Cost: linear in the fragments for each of the `iterations`.
pub fn fit_colors(
    fragments: &SegmentFragments,
    colors: &[[f32; 3]],
    target: &[[f32; 3]],
    pixel_weight: &[f32],
    iterations: usize,
    most: f32,
) -> Vec<[f32; 3]> {
    let shares = Shares::new(fragments, pixel_weight, colors.len());
    let clipped = |color: [f32; 3]| color.map(|value| value.clamp(0.0, most));
    let mut all: Vec<[f32; 3]> = colors.iter().map(|color| clipped(*color)).collect();
    let mut found: Vec<[f32; 3]> = shares.points.iter().map(|point| all[*point as usize]).collect();
    let mut ahead = found.clone();
    let mut pace = 1.0f32;
    for _ in 0..iterations {
        let residual: Vec<[f32; 3]> = (0..shares.pixels.len())
            .into_par_iter()
            .map(|pixel| {
                let shown = shares.of_pixel.sum(pixel, &ahead);
                let wanted = target[shares.pixels[pixel] as usize];
                [0, 1, 2].map(|c| wanted[c] - shown[c])
            })
            .collect();
        let next_pace = 0.5 * (1.0 + (1.0 + 4.0 * pace * pace).sqrt());
        let momentum = (pace - 1.0) / next_pace;
        pace = next_pace;
        (found, ahead) = (0..found.len())
            .into_par_iter()
            .map(|point| {
                let step = shares.of_point.sum(point, &residual);
                let new = clipped([0, 1, 2].map(|c| ahead[point][c] + step[c]));
                (new, clipped([0, 1, 2].map(|c| new[c] + momentum * (new[c] - found[point][c]))))
            })
            .unzip();
    }
    shares.points.iter().zip(&found).for_each(|(point, color)| all[*point as usize] = *color);
    all
}
