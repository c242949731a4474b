//! The most similar source patch of every patch that touches the hole, by random search and neighbours' advice.

use rayon::prelude::*;

use crate::patch_level::Level;
use crate::seeded::Random;

/// Distances at which neighbours are asked, in pixels, farthest first.
const NEIGHBOURS: [isize; 4] = [8, 4, 2, 1];
/// Share by which the window of the random search shrinks.
const SHRINK: f64 = 0.5;

/// A source patch and how far it is: the mean squared difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// Pixel in the middle of the source patch.
    pub source: usize,
    /// Mean squared difference; infinite when not yet measured.
    pub distance: f32,
}

/// Better matches than those given, never worse ones.
pub fn nearest(level: &Level, matches: Vec<Match>, seed: u64) -> Vec<Match> {
    let mut matches: Vec<Match> = matches
        .par_iter()
        .zip(&level.targets)
        .map(|(old, &target)| Match { distance: distance(level, target, old.source, f32::INFINITY), ..*old })
        .collect();
    for (pass, reach) in NEIGHBOURS.into_iter().enumerate() {
        let before = matches;
        matches = before
            .par_iter()
            .zip(&level.targets)
            .map(|(&old, &target)| {
                let advised = advised(level, target, &before, old, reach);
                if pass + 1 == NEIGHBOURS.len() { searched(level, target, advised, seed) } else { advised }
            })
            .collect();
    }
    matches
}

/// The best of a match and those of the neighbours at `reach`, shifted to this target.
fn advised(level: &Level, target: usize, matches: &[Match], best: Match, reach: isize) -> Match {
    let (x, y) = level.place(target);
    let mut best = best;
    for (dx, dy) in [(-reach, 0), (reach, 0), (0, -reach), (0, reach)] {
        if let Some(neighbour) = level.target_at(x + dx, y + dy) {
            let (sx, sy) = level.place(matches[neighbour].source);
            best = better(level, target, best, sx - dx, sy - dy);
        }
    }
    best
}

/// The best of a match and random ones in windows around it that shrink to a pixel.
fn searched(level: &Level, target: usize, best: Match, seed: u64) -> Match {
    let mut random = Random::new(seed, target as u64);
    let mut best = best;
    let mut reach = level.width.max(level.height) as f64;
    let anywhere = level.sources[random.below(level.sources.len())];
    let (x, y) = level.place(anywhere);
    best = better(level, target, best, x, y);
    while reach >= 1.0 {
        let (x, y) = level.place(best.source);
        let side = 2 * reach as usize + 1;
        let dx = random.below(side) as isize - reach as isize;
        let dy = random.below(side) as isize - reach as isize;
        best = better(level, target, best, x + dx, y + dy);
        reach *= SHRINK;
    }
    best
}

fn better(level: &Level, target: usize, best: Match, x: isize, y: isize) -> Match {
    match level.source_at(x, y) {
        Some(source) if source != best.source => {
            let distance = distance(level, target, source, best.distance);
            if distance < best.distance { Match { source, distance } } else { best }
        }
        _ => best,
    }
}

/// Mean squared difference of two patches; stops early, with a larger number, once it exceeds `limit`.
fn distance(level: &Level, target: usize, source: usize, limit: f32) -> f32 {
    let length = (2 * level.radius + 1) * level.channels;
    let count = ((2 * level.radius + 1) * length) as f32;
    let corner = level.radius * (level.width + 1);
    let (target, source) = ((target - corner) * level.channels, (source - corner) * level.channels);
    let limit = limit * count;
    let mut sum = 0.0;
    for row in 0..=2 * level.radius {
        let start = row * level.width * level.channels;
        let a = &level.values[target + start..target + start + length];
        let b = &level.values[source + start..source + start + length];
        sum += squared_difference(a, b);
        if sum > limit {
            break;
        }
    }
    sum / count
}

/// Eight sums side by side, so that wide registers can be used.
fn squared_difference(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0f32; 8];
    let (a_blocks, a_rest) = a.as_chunks::<8>();
    let (b_blocks, b_rest) = b.as_chunks::<8>();
    for (a, b) in a_blocks.iter().zip(b_blocks) {
        for lane in 0..8 {
            sums[lane] += (a[lane] - b[lane]) * (a[lane] - b[lane]);
        }
    }
    let rest: f32 = a_rest.iter().zip(b_rest).map(|(a, b)| (a - b) * (a - b)).sum();
    sums.iter().sum::<f32>() + rest
}
