//! Energy and momentum of hair, to watch and to test.

use glam::DVec3;

use crate::chain::lengths_of;
use crate::constraints::{bend::violation, goal};
use crate::{Chains, Options, State};

/// Joules: of motion, of height against gravity, and in the springs to lengths, bends and places of `goals`.
#[must_use]
pub fn energy(state: &State, chains: Chains<'_>, goals: &[DVec3], options: &Options) -> f64 {
    let particles = (0..chains.mass.len()).map(|i| {
        let motion = 0.5 * chains.mass[i] * state.velocity[i].length_squared();
        let height = -chains.mass[i] * options.gravity.dot(state.position[i]);
        let away = state.position[i].distance_squared(goals[i]);
        let soft = goal::compliance(chains.goal_weight[i], options.goal_n_per_m);
        motion + height + if soft > 0.0 { 0.5 * away / soft } else { 0.0 }
    });
    let springs = chains.offsets.windows(2).map(|ends| {
        let own = ends[0]..ends[1];
        let (points, goal) = (&state.position[own.clone()], &goals[own]);
        let lengths = lengths_of(goal);
        let stretch: f64 = (0..lengths.len())
            .map(|j| 0.5 * options.stretch_n / lengths[j] * (points[j].distance(points[j + 1]) - lengths[j]).powi(2))
            .sum();
        let bend: f64 = (1..lengths.len())
            .map(|i| {
                let away = violation(points, goal, &lengths, i).length_squared();
                0.5 * options.bend_nm2 * away / (0.5 * (lengths[i - 1] + lengths[i]))
            })
            .sum();
        let held = options.stretch_n.is_infinite();
        if held { bend } else { stretch + bend }
    });
    particles.sum::<f64>() + springs.sum::<f64>()
}

/// Kilogram metres a second.
#[must_use]
pub fn momentum(state: &State, chains: Chains<'_>) -> DVec3 {
    state.velocity.iter().zip(chains.mass).map(|(velocity, mass)| *mass * *velocity).sum()
}
