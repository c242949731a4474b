//! Seeds of strands: pixels where the confidence has a ridge.

use rayon::prelude::*;

use crate::raster_view::Plane;

/// Pixels that are seeds, by falling confidence (ties: by index).
///
/// A pixel is a seed when its confidence exceeds `high` and stands out by more than `epsilon` of itself over both
/// neighbours at `reach_px` across the strand (Chai et al. 2012, eq. 4).
pub fn seeds(confidence: Plane<'_>, angle: &[f32], high: f64, epsilon: f64, reach_px: f64) -> Vec<u32> {
    let mut found: Vec<u32> = (0..confidence.height)
        .into_par_iter()
        .flat_map_iter(|y| {
            let row = y * confidence.width;
            (row..row + confidence.width).filter(move |pixel| {
                let weight = f64::from(confidence.values[*pixel]);
                weight > high && stands_out(confidence, *pixel, f64::from(angle[*pixel]), weight, epsilon, reach_px)
            })
        })
        .map(|pixel| pixel as u32)
        .collect();
    found.sort_by(|a, b| {
        let (a_weight, b_weight) = (confidence.values[*a as usize], confidence.values[*b as usize]);
        b_weight.total_cmp(&a_weight).then(a.cmp(b))
    });
    found
}

fn stands_out(confidence: Plane<'_>, pixel: usize, angle: f64, weight: f64, epsilon: f64, reach_px: f64) -> bool {
    if !angle.is_finite() {
        return false;
    }
    let x = (pixel % confidence.width) as f64 + 0.5;
    let y = (pixel / confidence.width) as f64 + 0.5;
    let (across_x, across_y) = (-angle.sin() * reach_px, angle.cos() * reach_px);
    let left = confidence.bilinear(x - across_x, y - across_y);
    let right = confidence.bilinear(x + across_x, y + across_y);
    (weight - left.max(right)) / weight > epsilon
}
