//! Pictures of half the size, for the first guess of alpha.

use crate::matting::{TRIMAP_BACKGROUND, TRIMAP_FOREGROUND, TRIMAP_UNKNOWN, is_known};

/// The picture of half the size, every pixel the mean of 2 x 2; an odd last row or column is left out.
pub(crate) fn half_picture(color: &[[f64; 3]], width: usize, height: usize) -> Vec<[f64; 3]> {
    let (w, h) = (width / 2, height / 2);
    (0..w * h)
        .map(|i| {
            let p = 2 * (i / w) * width + 2 * (i % w);
            std::array::from_fn(|c| {
                0.25 * (color[p][c] + color[p + 1][c] + color[p + width][c] + color[p + width + 1][c])
            })
        })
        .collect()
}

/// The trimap of half the size: known where all four pixels are known and agree.
pub(crate) fn half_trimap(trimap: &[u8], width: usize, height: usize) -> Vec<u8> {
    let (w, h) = (width / 2, height / 2);
    (0..w * h)
        .map(|i| {
            let p = 2 * (i / w) * width + 2 * (i % w);
            let first = trimap[p];
            let agree = [p + 1, p + width, p + width + 1].iter().all(|&q| trimap[q] == first);
            if agree && is_known(first) { first } else { TRIMAP_UNKNOWN }
        })
        .collect()
}

/// The trimap, but known where all of the 3 x 3 pixels around in `half`, alpha of half the size, are within `near` of 0 or 1.
pub(crate) fn settled_trimap(trimap: &[u8], width: usize, height: usize, half: &[f64], near: f64) -> Vec<u8> {
    let (w, h) = (width / 2, height / 2);
    let verdicts: Vec<u8> = (0..w * h).map(|i| verdict(half, w, h, i % w, i / w, near)).collect();
    let verdict_at = |p: usize| verdicts[(p / width / 2).min(h - 1) * w + (p % width / 2).min(w - 1)];
    trimap.iter().enumerate().map(|(p, &value)| if is_known(value) { value } else { verdict_at(p) }).collect()
}

fn verdict(half: &[f64], w: usize, h: usize, x: usize, y: usize, near: f64) -> u8 {
    let (mut low, mut high) = (1.0f64, 0.0f64);
    for row in y.saturating_sub(1)..(y + 2).min(h) {
        for &alpha in &half[row * w + x.saturating_sub(1)..row * w + (x + 2).min(w)] {
            low = low.min(alpha);
            high = high.max(alpha);
        }
    }
    match (high < near, low > 1.0 - near) {
        (true, _) => TRIMAP_BACKGROUND,
        (_, true) => TRIMAP_FOREGROUND,
        _ => TRIMAP_UNKNOWN,
    }
}

/// The value at pixel (x, y) of the full picture, linearly between the pixels of the half one (`w` x `h`).
pub(crate) fn upsampled(values: &[f64], w: usize, h: usize, x: usize, y: usize) -> f64 {
    let (x0, x1, tx) = neighbours(x, w);
    let (y0, y1, ty) = neighbours(y, h);
    let top = values[y0 * w + x0] * (1.0 - tx) + values[y0 * w + x1] * tx;
    let bottom = values[y1 * w + x0] * (1.0 - tx) + values[y1 * w + x1] * tx;
    top * (1.0 - ty) + bottom * ty
}

fn neighbours(x: usize, w: usize) -> (usize, usize, f64) {
    let place = ((x as f64 + 0.5) / 2.0 - 0.5).clamp(0.0, (w - 1) as f64);
    let low = place as usize;
    (low, (low + 1).min(w - 1), place - low as f64)
}
