//! The 16 samples of a pixel, and which of them a strand of some opacity covers.
//!
//! The pattern is the first 16 points of the base-2 (0, 2)-sequence (van der Corput and Sobol): every row, column and
//! 4 x 4 cell of the pixel holds its share, so that area is measured well by edges of any slope. It is the same in every
//! pixel: a picture shifted by whole pixels is the same picture.
//!
//! Opacity is a subset of the samples. Each strand takes one of 256 random orders of the samples and covers the first
//! `16 alpha` of them, rounded up or down by the order's own dither: right in the mean, the same along the whole strand,
//! and independent between strands, so that layers cover each other as independent layers do.

/// Samples in a pixel.
pub const SAMPLES: usize = 16;

/// One value a sample.
pub type Lane = [f32; SAMPLES];

const ORDERS: usize = 256;

/// The larger of two numbers that are not NaN: one instruction, which `f32::max` is not.
#[inline(always)]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers that are not NaN.
#[inline(always)]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// All bits set, or none.
#[inline(always)]
pub(crate) fn word(condition: bool) -> u32 {
    u32::from(condition).wrapping_neg()
}

/// Puts depth and primitive into the samples that are hit, where the word is all ones.
#[inline(always)]
pub(crate) fn take(hits: &[u32; SAMPLES], nearer: &Lane, index: u32, depth: &mut Lane, primitive: &mut [u32; SAMPLES]) {
    for i in 0..SAMPLES {
        depth[i] = f32::from_bits((nearer[i].to_bits() & hits[i]) | (depth[i].to_bits() & !hits[i]));
        primitive[i] = (index & hits[i]) | (primitive[i] & !hits[i]);
    }
}

/// The largest value of the samples.
#[inline(always)]
pub(crate) fn largest(lane: &Lane) -> f32 {
    let mut most = *lane;
    for half in [8, 4, 2, 1] {
        for i in 0..half {
            most[i] = larger(most[i], most[i + half]);
        }
    }
    most[0]
}

/// Positions within the pixel, multiples of 1/32: exact in floating point.
pub struct Pattern {
    /// To the right.
    pub x: Lane,
    /// Downwards.
    pub y: Lane,
}

impl Pattern {
    /// The pattern.
    pub fn new() -> Self {
        let mut pattern = Self { x: [0.0; SAMPLES], y: [0.0; SAMPLES] };
        for i in 0..SAMPLES {
            pattern.x[i] = (van_der_corput(i as u8) as f32 + 0.5) / SAMPLES as f32;
            pattern.y[i] = (sobol_second(i as u8) as f32 + 0.5) / SAMPLES as f32;
        }
        pattern
    }

    /// Value of the linear form `gx x + gy y` at every sample.
    #[inline(always)]
    pub fn linear(&self, gx: f32, gy: f32) -> Lane {
        std::array::from_fn(|i| gx * self.x[i] + gy * self.y[i])
    }
}

/// Bits of `i` in reverse, in sixteenths.
fn van_der_corput(i: u8) -> u8 {
    i.reverse_bits() >> 4
}

/// Second coordinate of Sobol's sequence, in sixteenths: direction numbers 8, 12, 10, 15.
fn sobol_second(i: u8) -> u8 {
    [8u8, 12, 10, 15].iter().enumerate().filter(|(bit, _)| i >> bit & 1 == 1).fold(0, |sum, (_, d)| sum ^ d)
}

/// Thresholds of opacity: a sample is covered where `16 alpha` exceeds its threshold.
pub struct OpacityOrders {
    thresholds: Vec<Lane>,
}

impl OpacityOrders {
    /// The 256 orders.
    pub fn new() -> Self {
        Self { thresholds: (0..ORDERS).map(order).collect() }
    }

    /// Thresholds of one strand.
    #[inline(always)]
    pub fn of(&self, row: u32) -> &Lane {
        &self.thresholds[row as usize % ORDERS]
    }

    /// The row that a strand takes.
    pub fn row_of_strand(strand: usize) -> u32 {
        (split_mix(strand as u64) % ORDERS as u64) as u32
    }
}

/// A shuffled order of the samples plus a dither that differs from row to row.
fn order(row: usize) -> Lane {
    let mut ranks: [usize; SAMPLES] = std::array::from_fn(|i| i);
    for last in (1..SAMPLES).rev() {
        ranks.swap(last, (split_mix((row * SAMPLES + last) as u64 ^ 0x7e55) % (last as u64 + 1)) as usize);
    }
    let dither = (row as f32 + 0.5) / ORDERS as f32;
    std::array::from_fn(|i| ranks[i] as f32 + dither)
}

/// SplitMix64 (Steele et al. 2014): a good mix of the bits of a counter.
fn split_mix(counter: u64) -> u64 {
    let mut z = counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_column_and_cell_has_its_share() {
        let pattern = Pattern::new();
        for (nx, ny) in [(16, 1), (8, 2), (4, 4), (2, 8), (1, 16)] {
            let mut count = vec![0; nx * ny];
            for i in 0..SAMPLES {
                count[(pattern.y[i] * ny as f32) as usize * nx + (pattern.x[i] * nx as f32) as usize] += 1;
            }
            assert!(count.iter().all(|&c| c == 1), "{nx} x {ny}");
        }
    }

    #[test]
    fn opacity_is_right_in_the_mean() {
        let orders = OpacityOrders::new();
        for alpha in [0.0f32, 0.03, 0.5, 0.77, 1.0] {
            let covered = |row| orders.of(row).iter().filter(|&&t| 16.0 * alpha > t).count();
            let mean = (0..256).map(|row| covered(row) as f32).sum::<f32>() / 256.0;
            assert!((mean - 16.0 * alpha).abs() <= 1.0 / 256.0 + 1e-4, "{alpha}: {mean}");
        }
    }

    #[test]
    fn two_half_opaque_strands_leave_a_quarter() {
        let orders = OpacityOrders::new();
        let open = |row: u32| orders.of(row).map(|t| 8.0 <= t);
        let mut sum = 0.0;
        for a in 0..256 {
            for b in 0..256 {
                let both = open(a).iter().zip(open(b)).filter(|(a, b)| **a && *b).count();
                sum += both as f64 / 16.0;
            }
        }
        assert!((sum / 65536.0 - 0.25).abs() < 0.005, "{}", sum / 65536.0);
    }
}
