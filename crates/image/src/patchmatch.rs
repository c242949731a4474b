//! Holes filled with patches from elsewhere in the picture.
//!
//! From coarse to fine (Wexler, Shechtman and Irani 2007), two steps alternate: every patch that touches the hole looks
//! for its most similar patch in the source (`nearest`, Barnes et al. 2009), then every pixel of the hole becomes the
//! weighted mean of what the patches over it say (`vote`). A guide, further channels that are known everywhere, steers
//! which source is chosen and is not changed.
//!
//! Barnes' scan passes a good match along in the order of pixels, which only one thread can do. Here all pixels look at
//! once at the matches that their neighbours at growing distances had in the round before, and then at random places;
//! random numbers are a function of seed, level, round and pixel. So the result does not depend on the number of threads.
//!
//! Limits: it copies, it does not invent; structures wider than the hole's own coarsest picture are not continued.

use rayon::prelude::*;

use crate::error::ImageError;
use crate::patch_level::Level;
use crate::patch_search::{Match, nearest};

/// How completion works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompletionParams {
    /// Side of the patches, pixels: odd, 3 to 21.
    pub patch: usize,
    /// Number of levels, each half the size of the one before; fewer are used where the picture is small.
    pub levels: usize,
    /// Rounds of search and vote on the finest level; each coarser level has two more.
    pub rounds: usize,
    /// Seed of all random numbers.
    pub seed: u64,
}

/// A picture of several channels, interleaved: `values[(y * width + x) * channels + c]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The numbers.
    pub values: Vec<f32>,
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Numbers a pixel; the guide's come last.
    pub channels: usize,
    /// Of these, how many belong to the guide and are known everywhere.
    pub guides: usize,
}

/// The picture with its hole filled; what is outside stays as it is, bit for bit.
///
/// Patches are copied from where `source` holds, the hole excluded. Refuses sizes that do not fit, numbers that are not
/// finite outside the hole, and pictures where no whole patch lies in the source.
pub fn complete(
    picture: &Picture,
    hole: &[bool],
    source: &[bool],
    params: CompletionParams,
) -> Result<Picture, ImageError> {
    check(picture, hole, source, params)?;
    if !hole.contains(&true) {
        return Ok(picture.clone());
    }
    let radius = params.patch / 2;
    let mut levels = vec![Level::finest(picture, hole, source, radius)];
    while levels.len() < params.levels.max(1) {
        match levels.last().and_then(Level::halved) {
            Some(coarser) => levels.push(coarser),
            None => break,
        }
    }
    if levels[0].sources.is_empty() {
        return Err(ImageError::NoSource { size: params.patch });
    }
    let mut coarser: Option<(Level, Vec<Match>)> = None;
    for (number, mut level) in levels.into_iter().enumerate().rev() {
        let mut matches = match &coarser {
            Some((below, matches)) => {
                let start = level.upsampled_matches(below, matches, params.seed);
                vote(&mut level, &start);
                start
            }
            None => {
                level.fill_smoothly();
                level.random_matches(params.seed)
            }
        };
        for round in 0..params.rounds.max(1) + 2 * number {
            matches = nearest(&level, matches, params.seed ^ ((number as u64) << 40) ^ ((round as u64) << 32));
            vote(&mut level, &matches);
        }
        coarser = Some((level, matches));
    }
    let mut filled = picture.clone();
    if let Some((level, _)) = coarser {
        level.copy_hole_into(&mut filled, hole);
    }
    Ok(filled)
}

fn check(picture: &Picture, hole: &[bool], source: &[bool], params: CompletionParams) -> Result<(), ImageError> {
    let pixels = picture.width * picture.height;
    let found = hole.len().min(source.len()).min(picture.values.len() / picture.channels.max(1));
    if pixels == 0 || hole.len() != pixels || source.len() != pixels || found != pixels {
        return Err(ImageError::Size { expected: pixels, found });
    }
    if params.patch.is_multiple_of(2) || !(3..=21).contains(&params.patch) {
        return Err(ImageError::PatchSize { size: params.patch });
    }
    let image_channels = picture.channels - picture.guides;
    let finite = picture.values.chunks_exact(picture.channels).zip(hole).all(|(values, hole)| {
        let known = if *hole { &values[image_channels..] } else { values };
        known.iter().all(|value| value.is_finite())
    });
    if finite { Ok(()) } else { Err(ImageError::NotFinite) }
}

/// Every pixel of the hole becomes the mean of what the patches over it say, closer matches counting more.
fn vote(level: &mut Level, matches: &[Match]) {
    let (radius, channels) = (level.radius as isize, level.channels);
    let image_channels = channels - level.guides;
    let spread = typical_distance(matches).max(1e-12);
    let weight: Vec<f32> = matches.iter().map(|found| (-found.distance / (2.0 * spread)).exp().max(1e-6)).collect();
    let view = &*level;
    let voted: Vec<(usize, Vec<f32>)> = view
        .hole_pixels
        .par_iter()
        .map(|&pixel| {
            let (x, y) = view.place(pixel);
            let mut sum = vec![0.0f32; image_channels];
            let mut total = 0.0;
            for (dy, dx) in (-radius..=radius).flat_map(|dy| (-radius..=radius).map(move |dx| (dy, dx))) {
                let Some(target) = view.target_at(x + dx, y + dy) else { continue };
                let (sx, sy) = view.place(matches[target].source);
                let from = view.index(sx - dx, sy - dy) * channels;
                total += weight[target];
                for (sum, value) in sum.iter_mut().zip(&view.values[from..from + image_channels]) {
                    *sum += weight[target] * value;
                }
            }
            sum.iter_mut().for_each(|value| *value /= total);
            (pixel, sum)
        })
        .collect();
    for (pixel, values) in voted {
        level.values[pixel * channels..pixel * channels + image_channels].copy_from_slice(&values);
    }
}

/// The distance that three quarters of the matches are below.
fn typical_distance(matches: &[Match]) -> f32 {
    let mut distances: Vec<f32> = matches.iter().map(|found| found.distance).collect();
    let rank = distances.len() * 3 / 4;
    *distances.select_nth_unstable_by(rank, f32::total_cmp).1
}
