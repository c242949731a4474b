//! Corners that keep their bend: all those of a chain at once.
//!
//! C_i = (p_{i+1} - p_i) / l_i - (p_i - p_{i-1}) / l_{i-1} - b_i, a vector: the change of direction at particle i, less the
//! one it has in the goal's shape, turned with the segment before. While b_i stands still C is linear in the particles, its
//! three components do not mix, and J M⁻¹ Jᵀ + α̃ is one pentadiagonal matrix for all rounds of a frame. The compliance
//! (l_{i-1} + l_i) / 2B is that of a rod of bending stiffness B (Bergou et al. 2008), so that the number of particles does
//! not matter.
//!
//! A clamped root is held in its goal's direction by a corner before its first segment.
//!
//! Limits: turning b_i with the segment before leaves out twist, and the torque that this would take back from it:
//! momentum is kept, angular momentum only where the goal's shape is straight.

use glam::DVec3;

use crate::pentadiagonal::Pentadiagonal;

/// Factors for a frame, and the multipliers of one step.
#[derive(Clone, Debug)]
pub struct Bend {
    matrix: Pentadiagonal,
    soft: Vec<f64>,
    pull: Vec<DVec3>,
    step: Vec<DVec3>,
    clamped: bool,
}

impl Bend {
    /// The factored system of a chain. `soft_per_m`: 1 / (B h²). `clamped`: the root's direction is held.
    #[must_use]
    pub fn new(inverse: &[f64], lengths: &[f64], soft_per_m: f64, clamped: bool) -> Self {
        let corners = lengths.len();
        let before = |i: usize| if i > 0 { lengths[i - 1] } else { 0.0 };
        let soft: Vec<f64> = (0..corners).map(|i| soft_per_m * 0.5 * (before(i) + lengths[i])).collect();
        let mut matrix = Pentadiagonal::new(corners);
        for i in usize::from(!clamped)..corners {
            let [a, b, c] = gradient(lengths, i);
            let first = if i > 0 { inverse[i - 1] * a * a } else { 0.0 };
            matrix.diagonal[i] = first + inverse[i] * b * b + inverse[i + 1] * c * c + soft[i];
            if i + 1 < corners {
                let [a1, b1, _] = gradient(lengths, i + 1);
                matrix.first[i] = inverse[i] * b * a1 + inverse[i + 1] * c * b1;
            }
            if i + 2 < corners {
                matrix.second[i] = inverse[i + 1] * c * gradient(lengths, i + 2)[0];
            }
        }
        matrix.factor();
        Self { matrix, soft, pull: vec![DVec3::ZERO; corners], step: vec![DVec3::ZERO; corners], clamped }
    }

    /// Forgets the multipliers.
    pub fn forget(&mut self) {
        self.pull.fill(DVec3::ZERO);
    }

    /// One round towards the shape of `goal`.
    pub fn solve(&mut self, points: &mut [DVec3], goal: &[DVec3], inverse: &[f64], lengths: &[f64]) {
        let corners = lengths.len();
        for i in 0..corners {
            self.step[i] = -violation(points, goal, lengths, i) - self.soft[i] * self.pull[i];
        }
        if !self.clamped {
            self.step[0] = DVec3::ZERO;
        }
        self.matrix.solve(&mut self.step);
        for i in 0..corners {
            let (step, [a, b, c]) = (self.step[i], gradient(lengths, i));
            if i > 0 {
                points[i - 1] += inverse[i - 1] * a * step;
            }
            points[i] += inverse[i] * b * step;
            points[i + 1] += inverse[i + 1] * c * step;
            self.pull[i] += step;
        }
    }
}

/// Derivatives of C_i by p_{i-1}, p_i, p_{i+1}; the first corner has nothing before it.
fn gradient(lengths: &[f64], i: usize) -> [f64; 3] {
    let after = 1.0 / lengths[i];
    if i == 0 {
        return [0.0, -after, after];
    }
    let before = 1.0 / lengths[i - 1];
    [before, -before - after, after]
}

/// C_i of `points` against the shape of `goal`.
pub(crate) fn violation(points: &[DVec3], goal: &[DVec3], lengths: &[f64], i: usize) -> DVec3 {
    let after = (points[i + 1] - points[i]) / lengths[i];
    let wanted = (goal[i + 1] - goal[i]).normalize_or_zero();
    if i == 0 {
        return after - wanted;
    }
    let before = (points[i] - points[i - 1]) / lengths[i - 1];
    let rested = (goal[i] - goal[i - 1]).normalize_or_zero();
    after - before - turned(wanted - rested, rested, before.normalize_or_zero())
}

/// `vector` turned by the least rotation that takes unit `from` to unit `to`.
fn turned(vector: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let cosine = from.dot(to);
    if cosine < -0.999_999 {
        let axis = from.any_orthonormal_vector();
        return 2.0 * axis.dot(vector) * axis - vector;
    }
    let axis = from.cross(to);
    cosine * vector + axis.cross(vector) + axis * (axis.dot(vector) / (1.0 + cosine))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_rotation_takes_one_direction_to_the_other() {
        let (from, to) = (DVec3::new(1.0, 2.0, -0.5).normalize(), DVec3::new(-0.3, 0.4, 2.0).normalize());
        assert!((turned(from, from, to) - to).length() < 1e-12);
        let v = DVec3::new(0.2, -1.0, 3.0);
        assert!((turned(v, from, to).length() - v.length()).abs() < 1e-12);
        assert!((turned(v, from, to).dot(to) - v.dot(from)).abs() < 1e-12);
        assert!((turned(from, from, -from) + from).length() < 1e-9);
        assert_eq!(turned(v, from, from), v);
    }

    #[test]
    fn the_gradient_is_the_finite_difference() {
        let lengths = [0.3, 0.5, 0.2];
        let straight: Vec<DVec3> = (0..4).map(|i| DVec3::X * f64::from(i)).collect();
        let points = [DVec3::ZERO, DVec3::new(0.3, 0.1, 0.0), DVec3::new(0.7, 0.3, 0.1), DVec3::new(0.8, 0.2, 0.3)];
        for i in 1..3 {
            for (k, wanted) in gradient(&lengths, i).into_iter().enumerate() {
                let mut moved = points;
                moved[i - 1 + k] += DVec3::Y * 1e-6;
                let slope =
                    (violation(&moved, &straight, &lengths, i) - violation(&points, &straight, &lengths, i)) / 1e-6;
                assert!((slope - DVec3::Y * wanted).length() < 1e-6);
            }
        }
    }
}
