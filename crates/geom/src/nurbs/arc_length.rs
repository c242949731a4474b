//! Length along a curve, and the parameters at given lengths.
//!
//! The speed is integrated by Gauss's rule of five points, on pieces that are halved until the rule on both halves
//! agrees with that on the whole. The pieces are kept: every later length is one sum on one piece.

use super::{Curve, NurbsError};

/// Pieces are not halved more often than this; a curve that stands still somewhere needs many.
const MAX_HALVINGS: usize = 24;
const MAX_NEWTON_STEPS: usize = 40;

/// Lengths along one curve.
#[derive(Debug)]
pub struct ArcLength<'a> {
    curve: &'a Curve,
    /// Ends of the pieces, from one end of the domain to the other.
    parameters: Vec<f64>,
    /// Length from the start of the curve to each of them.
    lengths: Vec<f64>,
}

impl<'a> ArcLength<'a> {
    /// Lengths with an error of at most about `accuracy`, in the unit of the control points.
    pub fn new(curve: &'a Curve, accuracy: f64) -> Self {
        let breaks = curve.knots().breaks();
        let mut found = Self { curve, parameters: vec![breaks[0]], lengths: vec![0.0] };
        let share = accuracy / (breaks.len() - 1) as f64;
        for ends in breaks.windows(2) {
            found.add_pieces(ends[0], ends[1], integral(curve, ends[0], ends[1]), share, MAX_HALVINGS);
        }
        found
    }

    /// Length of the whole curve.
    pub fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Length from the start of the curve to a parameter of its domain.
    pub fn length_at(&self, t: f64) -> f64 {
        let piece = self.parameters.partition_point(|&p| p <= t).clamp(1, self.parameters.len() - 1) - 1;
        self.lengths[piece] + integral(self.curve, self.parameters[piece], t)
    }

    /// The parameter at a length from the start of the curve.
    ///
    /// # Errors
    /// Lengths below zero or above the whole.
    pub fn parameter_at(&self, length: f64) -> Result<f64, NurbsError> {
        let total = self.total();
        let slack = 1e-12 * total;
        if !(-slack..=total + slack).contains(&length) {
            return Err(NurbsError::OutsideLength { value: length, total });
        }
        let piece = self.lengths.partition_point(|&l| l <= length).clamp(1, self.lengths.len() - 1) - 1;
        Ok(self.parameter_on_piece(piece, length - self.lengths[piece]))
    }

    /// Newton's steps on a piece, replaced by halving where they would leave what still brackets the answer.
    fn parameter_on_piece(&self, piece: usize, wanted: f64) -> f64 {
        let start = self.parameters[piece];
        let (mut low, mut high) = (start, self.parameters[piece + 1]);
        let whole = self.lengths[piece + 1] - self.lengths[piece];
        let mut t = low + (high - low) * if whole > 0.0 { (wanted / whole).clamp(0.0, 1.0) } else { 0.0 };
        for _ in 0..MAX_NEWTON_STEPS {
            let excess = integral(self.curve, start, t) - wanted;
            if excess > 0.0 {
                high = t
            } else {
                low = t
            }
            let newton = t - excess / speed(self.curve, t);
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            if next == t {
                break;
            }
            t = next;
        }
        t
    }

    fn add_pieces(&mut self, low: f64, high: f64, whole: f64, accuracy: f64, halvings: usize) {
        let middle = 0.5 * (low + high);
        let halves = [integral(self.curve, low, middle), integral(self.curve, middle, high)];
        if halvings == 0 || (halves[0] + halves[1] - whole).abs() <= accuracy {
            let before = self.total();
            self.parameters.extend([middle, high]);
            self.lengths.extend([before + halves[0], before + halves[0] + halves[1]]);
            return;
        }
        self.add_pieces(low, middle, halves[0], 0.5 * accuracy, halvings - 1);
        self.add_pieces(middle, high, halves[1], 0.5 * accuracy, halvings - 1);
    }
}

fn speed(curve: &Curve, t: f64) -> f64 {
    curve.derivatives(t)[1].length()
}

/// Gauss's rule of five points for the length between two parameters.
fn integral(curve: &Curve, low: f64, high: f64) -> f64 {
    let root = (10.0f64 / 7.0).sqrt();
    let (near, far) = ((5.0 - 2.0 * root).sqrt() / 3.0, (5.0 + 2.0 * root).sqrt() / 3.0);
    let seventy = 70.0f64.sqrt();
    let (by_near, by_far) = ((322.0 + 13.0 * seventy) / 900.0, (322.0 - 13.0 * seventy) / 900.0);
    let nodes = [(-far, by_far), (-near, by_near), (0.0, 128.0 / 225.0), (near, by_near), (far, by_far)];
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    half * nodes.map(|(x, weight)| weight * speed(curve, middle + half * x)).iter().sum::<f64>()
}
