//! Strand direction and confidence of masked pixels, from the responses of Gabor banks (Chai et al. 2012, 3.2.1).

use rayon::prelude::*;
use std::f32::consts::{FRAC_PI_2, PI};

use crate::error::ImageError;
use crate::gabor::{BLOCK, BlockResponses, GaborBank};
use crate::raster_view::Plane;

/// Orientation and unscaled confidence of every masked pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Oriented {
    /// Direction of the strand in [0, π), NaN outside the mask.
    pub angle: Vec<f32>,
    /// Eq. 3 before scaling; 0 outside the mask.
    pub weight: Vec<f32>,
}

/// How responses become orientations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientSettings {
    /// The best of a bank's angles is refined by the parabola through its two neighbours.
    pub between_bins: bool,
    /// Negative responses count as none. Eq. 3 as published also rises in the dark valleys beside a strand, where only
    /// kernels across the strand do not answer negatively, and so gives false confidence to the direction across.
    pub ridges_only: bool,
}

/// What one bank finds at one pixel.
#[derive(Clone, Copy)]
struct Found {
    angle: f32,
    weight: f32,
    response: f32,
}

/// The strand direction with the largest response, and its confidence by eq. 3, at masked pixels.
///
/// Of several banks, each pixel takes the one that answers most strongly: since all kernels have unit norm, that is the
/// one whose shape fits best. Refuses masks of another size and pictures with numbers that are not finite.
pub fn orient(
    image: Plane<'_>,
    mask: &[bool],
    banks: &[GaborBank],
    settings: OrientSettings,
) -> Result<Oriented, ImageError> {
    image.check(mask.len())?;
    let width = image.width;
    let mut angle = vec![f32::NAN; mask.len()];
    let mut weight = vec![0.0; mask.len()];
    let rows = angle.par_chunks_mut(width).zip(weight.par_chunks_mut(width)).enumerate();
    rows.for_each(|(y, (angle, weight))| {
        let mask = &mask[y * width..(y + 1) * width];
        let mut best: Vec<Option<Found>> = vec![None; width];
        banks.iter().for_each(|bank| orient_row(image, y, mask, bank, settings, &mut best));
        for (x, found) in best.iter().enumerate() {
            if let Some(found) = found {
                (angle[x], weight[x]) = (found.angle, found.weight);
            }
        }
    });
    Ok(Oriented { angle, weight })
}

fn orient_row(
    image: Plane<'_>,
    y: usize,
    mask: &[bool],
    bank: &GaborBank,
    settings: OrientSettings,
    best: &mut [Option<Found>],
) {
    let (mut scratch, mut responses) = (bank.scratch(), BlockResponses::new());
    let mut x = 0;
    while let Some(skip) = mask[x..].iter().position(|&inside| inside) {
        x += skip;
        bank.responses(image, x, y, &mut scratch, &mut responses);
        if settings.ridges_only {
            responses.iter_mut().flatten().for_each(|response| *response = response.max(0.0));
        }
        let block = strongest(&responses, settings.between_bins);
        let end = (x + BLOCK).min(mask.len());
        for (column, found) in (x..end).zip(block) {
            if mask[column] && best[column].is_none_or(|old| found.response > old.response) {
                best[column] = Some(found);
            }
        }
        x = end;
    }
}

/// Direction, confidence and response of each pixel of a block.
fn strongest(responses: &BlockResponses, between_bins: bool) -> [Found; BLOCK] {
    let count = responses.len() as f32;
    let mut peak = [0.0f32; BLOCK];
    let mut top = responses[0];
    for (k, row) in responses.iter().enumerate() {
        for i in 0..BLOCK {
            if row[i] > top[i] {
                (top[i], peak[i]) = (row[i], k as f32);
            }
        }
    }
    let mut sum = [0.0f32; BLOCK];
    for (k, row) in responses.iter().enumerate() {
        for i in 0..BLOCK {
            let apart = (k as f32 - peak[i]).abs();
            let angle = apart.min(count - apart) * (PI / count);
            sum[i] += angle * (row[i] - top[i]) * (row[i] - top[i]);
        }
    }
    std::array::from_fn(|i| {
        let shift = if between_bins { peak_shift(responses, peak[i] as usize, i) } else { 0.0 };
        let normal = PI * (peak[i] + shift) / count;
        let angle = (normal + FRAC_PI_2).rem_euclid(PI);
        Found { angle: if angle < PI { angle } else { 0.0 }, weight: sum[i].sqrt(), response: top[i] }
    })
}

/// Where the parabola through the peak and its neighbours has its top, in bins.
fn peak_shift(responses: &BlockResponses, peak: usize, pixel: usize) -> f32 {
    let count = responses.len();
    let (before, after) = (responses[(peak + count - 1) % count][pixel], responses[(peak + 1) % count][pixel]);
    let bend = before - 2.0 * responses[peak][pixel] + after;
    if bend < -1e-12 { 0.5 * (before - after) / bend } else { 0.0 }
}
