//! Springs from particles to the places where the animation wants them.

use glam::DVec3;

/// Compliance of a goal spring: none at weight 1, infinite at 0, `1 / stiffness` at ½.
#[must_use]
pub fn compliance(weight: f64, stiffness: f64) -> f64 {
    if weight <= 0.0 || stiffness <= 0.0 { f64::INFINITY } else { (1.0 - weight) / (weight * stiffness) }
}

/// Moves a particle of inverse mass `inverse` towards `goal`; `pull` is the spring's multiplier.
pub(crate) fn solve(point: &mut DVec3, goal: DVec3, inverse: f64, soft: f64, pull: &mut DVec3) {
    if soft.is_finite() && inverse > 0.0 {
        let step = (goal - *point - soft * *pull) / (inverse + soft);
        *pull += step;
        *point += inverse * step;
    }
}
