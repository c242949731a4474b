//! Read-only views of one-channel pictures.

use crate::error::ImageError;

/// A picture of one channel: `values[y * width + x]`.
#[derive(Clone, Copy)]
pub struct Plane<'a> {
    /// Row-major values.
    pub values: &'a [f32],
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Plane<'_> {
    /// Refuses a plane whose size does not fit its values, or another array of `other` pixels, or values not finite.
    pub fn check(&self, other: usize) -> Result<(), ImageError> {
        let expected = self.width * self.height;
        if self.values.len() != expected || other != expected || expected == 0 {
            return Err(ImageError::Size { expected, found: self.values.len().min(other) });
        }
        if self.values.iter().any(|value| !value.is_finite()) {
            return Err(ImageError::NotFinite);
        }
        Ok(())
    }

    /// Value of the pixel (x, y), the border repeated outside.
    pub fn clamped(&self, x: isize, y: isize) -> f32 {
        let x = x.clamp(0, self.width as isize - 1) as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        self.values[y * self.width + x]
    }

    /// Bilinear value at (x, y), pixel centres at +0.5, the border repeated outside.
    pub fn bilinear(&self, x: f64, y: f64) -> f64 {
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - top);
        let at = |dx: isize, dy: isize| f64::from(self.clamped(left as isize + dx, top as isize + dy));
        (at(0, 0) * (1.0 - fx) + at(1, 0) * fx) * (1.0 - fy) + (at(0, 1) * (1.0 - fx) + at(1, 1) * fx) * fy
    }
}
