//! Colours of the strands' points with which the picture comes out as it should (analysis by synthesis).
//!
//! The picture is linear in the colours: a pixel shows the mean of its fragments' colours. SIRT hands each pixel's error
//! back to the points in the shares in which they show, as a weighted mean; Nesterov's momentum makes it fast. Both ways
//! are gathers, over pixels and over points, so that the sums have one order on any number of threads.

use rayon::prelude::*;

use crate::splat::SegmentFragments;

/// Pixels that one core takes at a time.
const CHUNK: usize = 4096;

/// A fragment: the row of the other side that it belongs to, and how much its segment's two points show in it.
#[derive(Clone, Copy, Default)]
struct Entry {
    at: u32,
    shares: [f32; 2],
}

/// Entries in rows of unequal length.
struct Rows {
    offsets: Vec<u32>,
    entries: Vec<Entry>,
}

impl Rows {
    fn row(&self, index: usize) -> &[Entry] {
        &self.entries[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }
}

/// Which points show in which pixels, from both sides. Points that show, and their neighbours within segments that
/// show, are numbered anew: a segment whose first point is `i` ends at `i + 1` also there.
struct Shares {
    /// Points, ascending.
    points: Vec<u32>,
    /// Pixels that count and show hair, ascending.
    pixels: Vec<u32>,
    /// Per pixel the segments, by the number of their first point; the shares add up to 1.
    of_pixel: Rows,
    /// Per segment the pixels, in shares as they show and count.
    of_segment: Rows,
    /// Per point the sum of its shares.
    weight: Vec<f32>,
}

impl Shares {
    fn new(fragments: &SegmentFragments, pixel_weight: &[f32], points: usize) -> Self {
        let hairy = |pixel: u32| {
            let range = fragments.of_pixel(pixel as usize);
            pixel_weight[pixel as usize] > 0.0 && fragments.kind[range].contains(&0)
        };
        let pixels: Vec<u32> = (0..pixel_weight.len() as u32).into_par_iter().filter(|pixel| hairy(*pixel)).collect();
        let (points, number) = numbered(fragments, &pixels, points);
        let parts: Vec<Part> =
            pixels.par_chunks(CHUNK).map(|pixels| Part::new(fragments, pixels, pixel_weight, &number)).collect();
        let (of_pixel, counts) = joined(parts);
        let of_segment = transposed(&of_pixel, &counts, points.len());
        let weight = (0..points.len())
            .into_par_iter()
            .map(|point| of_point(&of_segment, point, 0.0, |sum, _, share| *sum += share).max(1e-12))
            .collect();
        Self { points, pixels, of_pixel, of_segment, weight }
    }

    /// The mean colour of the hair in a pixel.
    fn shown(&self, pixel: usize, colors: &[[f32; 3]]) -> [f32; 3] {
        let mut sum = [0.0f32; 3];
        for entry in self.of_pixel.row(pixel) {
            let (a, b) = (&colors[entry.at as usize], &colors[entry.at as usize + 1]);
            (0..3).for_each(|c| sum[c] += entry.shares[0] * a[c] + entry.shares[1] * b[c]);
        }
        sum
    }

    /// The mean of the pixels' values where a point shows.
    fn mean(&self, point: usize, values: &[[f32; 3]]) -> [f32; 3] {
        let sum = of_point(&self.of_segment, point, [0.0f32; 3], |sum, pixel, share| {
            let value = &values[pixel as usize];
            (0..3).for_each(|c| sum[c] += share * value[c]);
        });
        sum.map(|value| value / self.weight[point])
    }
}

/// Ends of the segments that show in the pixels, ascending, and the place of every point among them.
fn numbered(fragments: &SegmentFragments, pixels: &[u32], points: usize) -> (Vec<u32>, Vec<u32>) {
    let mut seen = vec![false; points];
    for pixel in pixels {
        for i in fragments.of_pixel(*pixel as usize) {
            if fragments.kind[i] == 0 {
                let first = fragments.primitive[i] as usize;
                seen[first..first + 2].fill(true);
            }
        }
    }
    let mut number = vec![0u32; points];
    let mut found = Vec::new();
    for (point, _) in seen.iter().enumerate().filter(|(_, seen)| **seen) {
        number[point] = found.len() as u32;
        found.push(point as u32);
    }
    (found, number)
}

/// The rows of some pixels.
#[derive(Default)]
struct Part {
    entries: Vec<Entry>,
    ends: Vec<u32>,
    /// Per pixel how much hair it shows, times how much it counts.
    counts: Vec<f32>,
}

impl Part {
    fn new(fragments: &SegmentFragments, pixels: &[u32], pixel_weight: &[f32], number: &[u32]) -> Self {
        let mut part = Self::default();
        for pixel in pixels.iter().map(|pixel| *pixel as usize) {
            let hair = || fragments.of_pixel(pixel).filter(|i| fragments.kind[*i] == 0);
            let coverage: f32 = hair().map(|i| fragments.weight[i]).sum();
            part.entries.extend(hair().map(|i| {
                let (share, t) = (fragments.weight[i] / coverage.max(1e-12), fragments.parameter[i][0]);
                Entry { at: number[fragments.primitive[i] as usize], shares: [share * (1.0 - t), share * t] }
            }));
            part.ends.push(part.entries.len() as u32);
            part.counts.push(coverage * pixel_weight[pixel]);
        }
        part
    }
}

fn joined(parts: Vec<Part>) -> (Rows, Vec<f32>) {
    let mut entries = Vec::with_capacity(parts.iter().map(|part| part.entries.len()).sum());
    let (mut offsets, mut counts) = (vec![0], Vec::new());
    for part in parts {
        let before = entries.len() as u32;
        offsets.extend(part.ends.iter().map(|end| before + end));
        entries.extend(part.entries);
        counts.extend(part.counts);
    }
    (Rows { offsets, entries }, counts)
}

/// The same entries by segment: `at` becomes the old row, and shares are multiplied by the old row's `weight`.
fn transposed(rows: &Rows, weight: &[f32], segments: usize) -> Rows {
    let mut offsets = vec![0u32; segments + 1];
    rows.entries.iter().for_each(|entry| offsets[entry.at as usize + 1] += 1);
    (0..segments).for_each(|row| offsets[row + 1] += offsets[row]);
    let mut next = offsets.clone();
    let mut entries = vec![Entry::default(); rows.entries.len()];
    for (old, weight) in weight.iter().enumerate() {
        for entry in rows.row(old) {
            let place = &mut next[entry.at as usize];
            entries[*place as usize] = Entry { at: old as u32, shares: entry.shares.map(|share| share * weight) };
            *place += 1;
        }
    }
    Rows { offsets, entries }
}

/// Folds the pixels in which a point shows: of the segment that ends there, then of the one that begins there.
fn of_point<T>(of_segment: &Rows, point: usize, start: T, add: impl Fn(&mut T, u32, f32)) -> T {
    let mut sum = start;
    if point > 0 {
        of_segment.row(point - 1).iter().for_each(|entry| add(&mut sum, entry.at, entry.shares[1]));
    }
    of_segment.row(point).iter().for_each(|entry| add(&mut sum, entry.at, entry.shares[0]));
    sum
}

/// Colours in [0, `most`] with which the hair's mean colour in every pixel of positive weight nears `target`.
///
/// Points that do not show keep their colour; the others move by the share `freedom`, in [0, 1], of what is asked of
/// them. Cost: linear in the fragments for each of the `iterations`.
pub fn fit_colors(
    fragments: &SegmentFragments,
    colors: &[[f32; 3]],
    freedom: &[f32],
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
            .with_min_len(1024)
            .map(|pixel| {
                let shown = shares.shown(pixel, &ahead);
                let wanted = target[shares.pixels[pixel] as usize];
                [0, 1, 2].map(|c| wanted[c] - shown[c])
            })
            .collect();
        let next_pace = 0.5 * (1.0 + (1.0 + 4.0 * pace * pace).sqrt());
        let momentum = (pace - 1.0) / next_pace;
        pace = next_pace;
        (found, ahead) = (0..found.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|point| {
                let step = shares.mean(point, &residual);
                let share = freedom[shares.points[point] as usize];
                let new = clipped([0, 1, 2].map(|c| ahead[point][c] + share * step[c]));
                (new, clipped([0, 1, 2].map(|c| new[c] + momentum * (new[c] - found[point][c]))))
            })
            .unzip();
    }
    shares.points.iter().zip(&found).for_each(|(point, color)| all[*point as usize] = *color);
    all
}
