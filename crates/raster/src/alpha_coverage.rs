//! How much of a picture passes an alpha test, and the scale of alpha that makes it pass as much as another.
//!
//! A graphics processor tests the *interpolated* alpha, so the area is measured there: 4 x 4 points a texel, alpha
//! bilinear between texel centres and repeated beyond the edge. Counts are whole numbers: no sum depends on the order of
//! the threads. Averaging pulls alpha towards its mean, so that thin hair falls below the threshold in a smaller picture;
//! scaling alpha brings the area back (Castaño, *Computing Alpha Mipmaps*, 2010).

use rayon::prelude::*;

use crate::RasterError;

/// Points a texel along either axis.
const POINTS: usize = 4;
/// Scales between which the right one is looked for.
const SCALES: [f64; 2] = [1.0 / 16.0, 256.0];
/// Halvings of the (logarithmic) interval: to one part in 10^6.
const HALVINGS: usize = 24;

/// Alpha of a picture, row by row, [0, 1].
#[derive(Debug, Clone, Copy)]
pub struct AlphaPicture<'a> {
    /// `width * height` numbers.
    alpha: &'a [f32],
    width: usize,
}

impl<'a> AlphaPicture<'a> {
    /// A picture of rows of `width` texels.
    ///
    /// # Errors
    /// No texels, or rows of unequal length.
    pub fn new(alpha: &'a [f32], width: usize) -> Result<Self, RasterError> {
        if width == 0 || alpha.is_empty() || !alpha.len().is_multiple_of(width) {
            return Err(RasterError::Size(width, alpha.len().checked_div(width).unwrap_or(0)));
        }
        Ok(Self { alpha, width })
    }

    /// Share of the area in which `min(scale * alpha, 1)`, interpolated, exceeds `threshold`.
    pub fn coverage(&self, threshold: f32, scale: f32) -> f64 {
        let height = self.alpha.len() / self.width;
        let passed: usize = (0..height).into_par_iter().map(|row| self.passed_in_row(row, threshold, scale)).sum();
        passed as f64 / (self.alpha.len() * POINTS * POINTS) as f64
    }

    /// The scale with which the coverage comes nearest to `wanted`.
    ///
    /// Coverage never falls as the scale grows, so that halving finds where it passes the wanted one; of the two ends of
    /// the last interval the nearer is taken.
    pub fn scale_for_coverage(&self, threshold: f32, wanted: f64) -> f32 {
        let [mut low, mut high] = SCALES;
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            if self.coverage(threshold, middle as f32) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        let miss = |scale: f64| (self.coverage(threshold, scale as f32) - wanted).abs();
        if miss(low) < miss(high) { low as f32 } else { high as f32 }
    }

    fn passed_in_row(&self, row: usize, threshold: f32, scale: f32) -> usize {
        let last_row = self.alpha.len() / self.width - 1;
        let rows = [row.saturating_sub(1), row, (row + 1).min(last_row)];
        let at = |row: usize, column: usize| (self.alpha[row * self.width + column] * scale).min(1.0);
        let mut passed = 0;
        for column in 0..self.width {
            let columns = [column.saturating_sub(1), column, (column + 1).min(self.width - 1)];
            let near = rows.map(|row| columns.map(|column| at(row, column)));
            let (least, most) = near.iter().flatten().fold((1.0f32, 0.0f32), |(l, m), &a| (l.min(a), m.max(a)));
            passed += if least > threshold {
                POINTS * POINTS
            } else if most > threshold {
                passed_in_texel(&near, threshold)
            } else {
                0
            };
        }
        passed
    }
}

/// How many of a texel's points exceed the threshold, from the texel and its eight neighbours.
fn passed_in_texel(near: &[[f32; 3]; 3], threshold: f32) -> usize {
    let mut passed = 0;
    for y in 0..POINTS {
        let (row, down) = between(y);
        for x in 0..POINTS {
            let (column, right) = between(x);
            let mixed = |row: usize| near[row][column] + right * (near[row][column + 1] - near[row][column]);
            let upper = mixed(row);
            passed += usize::from(upper + down * (mixed(row + 1) - upper) > threshold);
        }
    }
    passed
}

/// Between which two of three texel centres a point lies, and how far along.
fn between(point: usize) -> (usize, f32) {
    let from_first = (point as f32 + 0.5) / POINTS as f32 + 0.5;
    (from_first as usize, from_first.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(width: usize) -> Vec<f32> {
        (0..width * 8).map(|i| ((i % width) as f32 + 0.5) / width as f32).collect()
    }

    #[test]
    fn a_ramp_passes_beyond_the_threshold() -> Result<(), RasterError> {
        let alpha = ramp(64);
        let picture = AlphaPicture::new(&alpha, 64)?;
        for (threshold, scale, expected) in [(0.5, 1.0, 0.5), (0.25, 1.0, 0.75), (0.5, 2.0, 0.75), (0.5, 0.5, 0.0)] {
            let found = picture.coverage(threshold, scale);
            assert!((found - expected).abs() < 1e-9, "{threshold} {scale}: {found}");
        }
        Ok(())
    }

    #[test]
    fn the_scale_gives_the_coverage() -> Result<(), RasterError> {
        let alpha = ramp(64);
        let picture = AlphaPicture::new(&alpha, 64)?;
        for wanted in [0.1, 0.5, 0.9] {
            let scale = picture.scale_for_coverage(0.5, wanted);
            assert!((picture.coverage(0.5, scale) - wanted).abs() < 1.0 / 256.0, "{wanted}: {scale}");
            assert!((f64::from(scale) - 0.5 / (1.0 - wanted)).abs() < 0.05 / (1.0 - wanted), "{wanted}: {scale}");
        }
        Ok(())
    }

    #[test]
    fn nothing_and_all_are_kept() -> Result<(), RasterError> {
        for alpha in [0.0, 1.0] {
            let texels = [alpha; 12];
            let picture = AlphaPicture::new(&texels, 4)?;
            assert_eq!(picture.coverage(0.5, 1.0), f64::from(alpha));
        }
        Ok(())
    }

    #[test]
    fn pictures_without_texels_are_refused() {
        assert!(AlphaPicture::new(&[], 0).is_err());
        assert!(AlphaPicture::new(&[0.0; 5], 2).is_err());
    }
}
