//! The un-mixed colours of foreground and background, given alpha.
//!
//! Every pixel wants alpha F + (1 - alpha) B to be its colour, and F and B to be like those of its four neighbours, the
//! more so where alpha changes. From a picture of one pixel to the full one, each level begins at the answer of the one
//! half its size and is relaxed a few times; so colours travel as far as they must in time linear in the pixels. Source of
//! the idea: Germer, Uelwer, Conrad & Harmeling 2020, Fast Multi-Level Foreground Estimation.
//!
//! Rows are relaxed in two sets, even then odd: a row reads only rows of the other set, so all rows of a set run at once
//! and threads do not change a bit. At the end F and B move the least that makes the mixture exact, as far as [0, 1] lets.

use rayon::prelude::*;

/// Settings of `unmixed_colors`.
#[derive(Debug, Clone, Copy)]
pub struct UnmixSettings {
    /// Pull of neighbours on each other where alpha is constant.
    pub smoothness: f64,
    /// Additional pull for each unit that alpha differs by.
    pub gradient_weight: f64,
    /// Relaxations at levels of at most 32 pixels a side.
    pub small_sweeps: usize,
    /// Relaxations at larger levels.
    pub large_sweeps: usize,
}

impl Default for UnmixSettings {
    fn default() -> Self {
        Self { smoothness: 1e-5, gradient_weight: 1.0, small_sweeps: 10, large_sweeps: 3 }
    }
}

/// Foreground and background colour of every pixel, each in [0, 1].
#[derive(Debug, Clone)]
pub struct Unmixed {
    /// Foreground colour, one a pixel.
    pub foreground: Vec<[f64; 3]>,
    /// Background colour, one a pixel.
    pub background: Vec<[f64; 3]>,
}

const SMALL_SIDE: usize = 32;
const EVEN: usize = 0;
/// Times that a pair is moved onto its mixture; clipping one colour leaves a lack for the other.
const PROJECTIONS: usize = 4;

/// F and B of the picture `color` (`width` x `height`, row by row, in [0, 1]) with `alpha` in [0, 1].
///
/// Colours should be linear: light adds up linearly. Panics where lengths do not fit the size. About 0.2 µs a pixel.
pub fn unmixed_colors(
    color: &[[f64; 3]],
    alpha: &[f64],
    width: usize,
    height: usize,
    settings: &UnmixSettings,
) -> Unmixed {
    assert!(color.len() == width * height && alpha.len() == width * height, "lengths fit the size");
    if color.is_empty() {
        return Unmixed { foreground: Vec::new(), background: Vec::new() };
    }
    let top = Level { color: color.to_vec(), alpha: alpha.to_vec(), width, height };
    let levels = pyramid(top);
    let mut pair: Option<Pairs> = None;
    for level in levels.iter().rev() {
        let mut pairs = pair.map_or_else(|| Pairs::first(&levels[0], level), |coarse| coarse.upsampled(level));
        let small = level.width.max(level.height) <= SMALL_SIDE;
        for _ in 0..if small { settings.small_sweeps } else { settings.large_sweeps } {
            pairs.relax(EVEN, level, settings);
            pairs.relax(EVEN + 1, level, settings);
        }
        pair = Some(pairs);
    }
    exactly_mixed(&pair.expect("at least one level"), &levels[0])
}

struct Level {
    color: Vec<[f64; 3]>,
    alpha: Vec<f64>,
    width: usize,
    height: usize,
}

fn pyramid(top: Level) -> Vec<Level> {
    let mut levels = vec![top];
    while let Some(last) = levels.last().filter(|l| l.width.max(l.height) > 1) {
        let half = last.half();
        levels.push(half);
    }
    levels
}

impl Level {
    fn half(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let four = |i: usize| {
            let (x, y) = (2 * (i % width), 2 * (i / width));
            let (x1, y1) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
            [y * self.width + x, y * self.width + x1, y1 * self.width + x, y1 * self.width + x1]
        };
        let color = (0..width * height)
            .into_par_iter()
            .map(|i| std::array::from_fn(|c| four(i).iter().map(|&p| 0.25 * self.color[p][c]).sum()))
            .collect();
        let alpha =
            (0..width * height).into_par_iter().map(|i| four(i).iter().map(|&p| 0.25 * self.alpha[p]).sum()).collect();
        Self { color, alpha, width, height }
    }
}

/// Foreground and background colours: red, green, blue of each.
type Pair = [f64; 6];

/// The pairs of a level: its even rows and its odd rows, so that one set can be written while the other is read.
struct Pairs {
    width: usize,
    rows: [Vec<Pair>; 2],
}

impl Pairs {
    /// Mean colours of what is surely foreground and surely background in the full picture, everywhere.
    fn first(full: &Level, level: &Level) -> Self {
        let foreground = weighted_mean(full, |alpha| alpha.powi(4));
        let background = weighted_mean(full, |alpha| (1.0 - alpha).powi(4));
        let pair: Pair = std::array::from_fn(|k| if k < 3 { foreground[k] } else { background[k - 3] });
        let odd = level.height / 2;
        let set = |rows: usize| vec![pair; rows * level.width];
        Self { width: level.width, rows: [set(level.height - odd), set(odd)] }
    }

    fn at(&self, x: usize, y: usize) -> &Pair {
        &self.rows[y % 2][y / 2 * self.width + x]
    }

    fn upsampled(&self, level: &Level) -> Self {
        let set = |parity: usize| {
            (parity..level.height)
                .step_by(2)
                .flat_map(|y| (0..level.width).map(move |x| *self.at(x / 2, y / 2)))
                .collect()
        };
        Self { width: level.width, rows: [set(0), set(1)] }
    }

    /// Solves every pixel of the rows of one parity for its own pair, its neighbours held.
    fn relax(&mut self, parity: usize, level: &Level, settings: &UnmixSettings) {
        let [even, odd] = &mut self.rows;
        let (written, read) = if parity == EVEN { (even, &*odd) } else { (odd, &*even) };
        let width = level.width;
        written.par_chunks_mut(width).enumerate().for_each(|(k, row)| {
            let y = 2 * k + parity;
            let line = |y: usize| &read[y / 2 * width..(y / 2 + 1) * width];
            let above = (y > 0).then(|| line(y.wrapping_sub(1)));
            let below = (y + 1 < level.height).then(|| line(y + 1));
            for x in 0..width {
                row[x] = relaxed(row, x, y, above, below, level, settings);
            }
        });
    }
}

fn relaxed(
    row: &[Pair],
    x: usize,
    y: usize,
    above: Option<&[Pair]>,
    below: Option<&[Pair]>,
    level: &Level,
    settings: &UnmixSettings,
) -> Pair {
    let here = y * level.width + x;
    let alpha = level.alpha[here];
    let mut total = 0.0;
    let mut pulled = [0.0; 6];
    let mut pull = |neighbour: usize, pair: &Pair| {
        let weight = settings.smoothness + settings.gradient_weight * (alpha - level.alpha[neighbour]).abs();
        total += weight;
        for (sum, value) in pulled.iter_mut().zip(pair) {
            *sum += weight * value;
        }
    };
    if x > 0 {
        pull(here - 1, &row[x - 1]);
    }
    if x + 1 < level.width {
        pull(here + 1, &row[x + 1]);
    }
    if let Some(line) = above {
        pull(here - level.width, &line[x]);
    }
    if let Some(line) = below {
        pull(here + level.width, &line[x]);
    }
    solved(alpha, total.max(1e-12), &pulled, &level.color[here])
}

/// The pair that minimises (alpha F + (1 - alpha) B - color)² + total (F² + B²) - 2 pulled (F, B), clipped to [0, 1].
fn solved(alpha: f64, total: f64, pulled: &Pair, color: &[f64; 3]) -> Pair {
    let beta = 1.0 - alpha;
    let (a, b, d) = (alpha * alpha + total, alpha * beta, beta * beta + total);
    let inverse = 1.0 / (a * d - b * b);
    let mut pair = [0.0; 6];
    for c in 0..3 {
        let front = pulled[c] + alpha * color[c];
        let back = pulled[c + 3] + beta * color[c];
        pair[c] = ((d * front - b * back) * inverse).clamp(0.0, 1.0);
        pair[c + 3] = ((a * back - b * front) * inverse).clamp(0.0, 1.0);
    }
    pair
}

fn weighted_mean(level: &Level, weight: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut total = 1e-12;
    let mut sum = [0.0; 3];
    for (color, &alpha) in level.color.iter().zip(&level.alpha) {
        let w = weight(alpha);
        total += w;
        for c in 0..3 {
            sum[c] += w * color[c];
        }
    }
    sum.map(|s| s / total)
}

/// Moves every pair the least that makes its mixture the picture's colour, then clips it.
fn exactly_mixed(pairs: &Pairs, level: &Level) -> Unmixed {
    let (foreground, background) = (0..level.alpha.len())
        .into_par_iter()
        .map(|i| {
            let pair = pairs.at(i % level.width, i / level.width);
            let (alpha, beta) = (level.alpha[i], 1.0 - level.alpha[i]);
            let scale = 1.0 / (alpha * alpha + beta * beta);
            let mut colors = ([pair[0], pair[1], pair[2]], [pair[3], pair[4], pair[5]]);
            for c in 0..3 {
                for _ in 0..PROJECTIONS {
                    let lack = (level.color[i][c] - alpha * colors.0[c] - beta * colors.1[c]) * scale;
                    colors.0[c] = (colors.0[c] + alpha * lack).clamp(0.0, 1.0);
                    colors.1[c] = (colors.1[c] + beta * lack).clamp(0.0, 1.0);
                }
            }
            colors
        })
        .unzip();
    Unmixed { foreground, background }
}

#[cfg(test)]
#[path = "matting_foreground_tests.rs"]
mod tests;
