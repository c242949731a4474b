//! The surface of the hair that a photograph shows, with a direction a pixel.

use glam::{DVec2, DVec3};

/// The visible surface of the hair on the pixels of the photograph.
pub struct FrontSheet<'a> {
    /// Rows and columns of the picture.
    pub rows: usize,
    /// Columns of the picture.
    pub columns: usize,
    /// Pixels a metre, and the pixel of the origin: `u = s x + c.x`, `v = -s y + c.y`.
    pub scale: f64,
    /// Pixel of the origin.
    pub centre: DVec2,
    /// z of the surface; NaN where there is no hair.
    pub depth: &'a [f32],
    /// Direction root to tip in pixel axes (y down); zero where unknown.
    pub direction: &'a [[f32; 2]],
}

impl FrontSheet<'_> {
    /// Where a point falls in the picture.
    pub(crate) fn pixel(&self, point: DVec3) -> DVec2 {
        DVec2::new(point.x * self.scale, -point.y * self.scale) + self.centre
    }

    /// The pixel's place in the flat arrays; `None` outside the picture.
    pub(crate) fn pixel_index(&self, pixel: DVec2) -> Option<usize> {
        let inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < self.columns as f64 && pixel.y < self.rows as f64;
        inside.then(|| pixel.y as usize * self.columns + pixel.x as usize)
    }

    /// Bilinear over the pixels that have a depth; `None` where the pixel itself has none.
    pub(crate) fn surface(&self, pixel: DVec2) -> Option<f64> {
        let centre = f64::from(self.depth[self.pixel_index(pixel)?]);
        if centre.is_nan() {
            return None;
        }
        let (mut sum, mut total) = (0.0, 0.0);
        self.corners(pixel, |index, share| {
            let z = f64::from(self.depth[index]);
            if !z.is_nan() {
                sum += share * z;
                total += share;
            }
        });
        Some(if total > 1e-9 { sum / total } else { centre })
    }

    /// Bilinear, each corner turned to the pixel's own sense; `None` where unknown.
    pub(crate) fn direction_at(&self, pixel: DVec2) -> Option<DVec2> {
        let read = |index: usize| {
            let [x, y] = self.direction[index];
            DVec2::new(f64::from(x), f64::from(y))
        };
        let own = read(self.pixel_index(pixel)?);
        let mut sum = DVec2::ZERO;
        self.corners(pixel, |index, share| {
            let d = read(index);
            sum += d * share * if d.dot(own) < 0.0 { -1.0 } else { 1.0 };
        });
        sum.try_normalize()
    }

    fn corners(&self, pixel: DVec2, mut visit: impl FnMut(usize, f64)) {
        let q = pixel - 0.5;
        let low = q.floor();
        let f = q - low;
        for (dy, dx) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)] {
            let corner = low + DVec2::new(dx, dy);
            let share = (if dx > 0.0 { f.x } else { 1.0 - f.x }) * (if dy > 0.0 { f.y } else { 1.0 - f.y });
            if let Some(index) = self.pixel_index(corner + 0.5) {
                visit(index, share);
            }
        }
    }
}
