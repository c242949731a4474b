//! What is moved, and how it moves now.

use glam::DVec3;

use crate::DynamicsError;
use crate::error::positive;

/// Chains of particles, root first.
#[derive(Clone, Copy, Debug)]
pub struct Chains<'a> {
    /// Chain c is the particles `offsets[c]..offsets[c + 1]`.
    pub offsets: &'a [usize],
    /// Kilograms, > 0.
    pub mass: &'a [f64],
    /// How much a particle follows its goal: 0 hangs free, 1 follows exactly.
    pub goal_weight: &'a [f64],
}

impl Chains<'_> {
    /// # Errors
    /// Lengths that do not fit, masses that are not positive, goal weights outside [0, 1].
    pub fn check(&self) -> Result<(), DynamicsError> {
        let particles = self.mass.len();
        let rising = self.offsets.windows(2).all(|pair| pair[0] <= pair[1]);
        if !rising || self.offsets.first() != Some(&0) || self.offsets.last() != Some(&particles) {
            return Err(DynamicsError::Offsets { particles });
        }
        fits("goal_weight", self.goal_weight.len(), particles)?;
        self.mass.iter().try_for_each(|&mass| positive("mass", mass))?;
        match self.goal_weight.iter().find(|weight| !(0.0..=1.0).contains(*weight)) {
            Some(&value) => Err(DynamicsError::Number { name: "goal_weight", value, expected: "a number in [0, 1]" }),
            None => Ok(()),
        }
    }
}

/// Where the particles are and how fast they go.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Metres.
    pub position: Vec<DVec3>,
    /// Metres a second.
    pub velocity: Vec<DVec3>,
}

pub(crate) fn fits(name: &'static str, found: usize, expected: usize) -> Result<(), DynamicsError> {
    (found == expected).then_some(()).ok_or(DynamicsError::Length { name, found, expected })
}
