//! Length along strands.

use glam::DVec3;

use crate::Strands;

/// Length of every strand.
pub fn lengths(strands: &Strands) -> Vec<f64> {
    strands.map(|_, points| points.windows(2).map(|w| w[0].distance(w[1])).sum())
}

/// Length from the root to every point, 0 at the roots.
pub fn arc_lengths(strands: &Strands) -> Vec<f64> {
    strands.map(|_, points| from_root(points)).concat()
}

/// Length from the root to every point of one strand.
pub(crate) fn from_root(points: &[DVec3]) -> Vec<f64> {
    let mut length = 0.0;
    let mut previous = points.first().copied().unwrap_or_default();
    points
        .iter()
        .map(|&point| {
            length += previous.distance(point);
            previous = point;
            length
        })
        .collect()
}
