//! Springs between particles of different chains.

use glam::DVec3;

/// A spring of the length that its ends' goals have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// One end, a particle.
    pub from: usize,
    /// The other.
    pub to: usize,
}

/// Draws the ends together or apart; `pull` is the spring's multiplier.
pub(crate) fn solve(points: &mut [DVec3], link: Link, length: f64, inverse: &[f64], soft: f64, pull: &mut f64) {
    let between = points[link.to] - points[link.from];
    let found = between.length();
    let weight = inverse[link.from] + inverse[link.to] + soft;
    if found <= 0.0 || weight <= 0.0 || !soft.is_finite() {
        return;
    }
    let step = (length - found - soft * *pull) / weight;
    *pull += step;
    points[link.from] -= inverse[link.from] * step / found * between;
    points[link.to] += inverse[link.to] * step / found * between;
}
