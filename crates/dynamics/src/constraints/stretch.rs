//! Segments that keep their lengths: all those of a chain at once.
//!
//! C_j = |p_{j+1} - p_j| - l_j. Only neighbouring segments share a particle, so J M⁻¹ Jᵀ + α̃ is tridiagonal and one
//! elimination down the chain solves it: a pull at the tip is felt at the root in the same round.

use glam::DVec3;

/// Keeps a system solvable where both ends of a straight chain are held; as part of the diagonal.
const LEAST_SOFTNESS: f64 = 1e-9;

/// The multipliers of one step, and scratch.
#[derive(Clone, Debug)]
pub struct Stretch {
    pull: Vec<f64>,
    along: Vec<DVec3>,
    diagonal: Vec<f64>,
    step: Vec<f64>,
}

impl Stretch {
    /// For a chain of so many segments.
    #[must_use]
    pub fn new(segments: usize) -> Self {
        Self {
            pull: vec![0.0; segments],
            along: vec![DVec3::ZERO; segments],
            diagonal: vec![0.0; segments],
            step: vec![0.0; segments],
        }
    }

    /// Forgets the multipliers.
    pub fn forget(&mut self) {
        self.pull.fill(0.0);
    }

    /// One round. `inverse` are inverse masses, `soft_per_m` is the compliance of a metre over the step squared.
    pub fn solve(&mut self, points: &mut [DVec3], inverse: &[f64], lengths: &[f64], soft_per_m: f64) {
        let count = lengths.len();
        for j in 0..count {
            let between = points[j + 1] - points[j];
            let length = between.length();
            let soft = soft_per_m * lengths[j];
            self.along[j] = if length > 0.0 { between / length } else { DVec3::ZERO };
            self.diagonal[j] = (inverse[j] + inverse[j + 1]) * (1.0 + LEAST_SOFTNESS) + soft;
            self.step[j] = lengths[j] - length - soft * self.pull[j];
        }
        self.eliminate(inverse);
        for j in 0..count {
            let push = self.along[j] * self.step[j];
            points[j] -= inverse[j] * push;
            points[j + 1] += inverse[j + 1] * push;
            self.pull[j] += self.step[j];
        }
    }

    /// Thomas's algorithm; a segment between held particles has nothing to move.
    fn eliminate(&mut self, inverse: &[f64]) {
        let count = self.step.len();
        let off = |along: &[DVec3], j: usize| -inverse[j + 1] * along[j].dot(along[j + 1]);
        for j in 0..count {
            if self.diagonal[j] <= 0.0 {
                (self.diagonal[j], self.step[j]) = (f64::INFINITY, 0.0);
            }
            if j + 1 < count {
                let share = off(&self.along, j) / self.diagonal[j];
                self.diagonal[j + 1] -= share * off(&self.along, j);
                self.step[j + 1] -= share * self.step[j];
            }
        }
        for j in (0..count).rev() {
            let next = if j + 1 < count { off(&self.along, j) * self.step[j + 1] } else { 0.0 };
            self.step[j] = (self.step[j] - next) / self.diagonal[j];
        }
    }
}
