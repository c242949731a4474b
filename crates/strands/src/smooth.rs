//! Smoothing along the strand.
//!
//! Implicit diffusion: every point is drawn towards the middle of its neighbours, `(1 + amount L) x = x_old`, L the second
//! difference, with roots and tips held. One tridiagonal solve a strand (Thomas), stable for every amount; explicit steps
//! would need as many rounds as the amount is large.

use glam::DVec3;

use crate::Strands;

/// Smoothed points. `amount` is in squared points: features shorter than about `2 pi sqrt(amount)` points fade. Roots and
/// tips stay; straight, evenly spaced strands stay as they are.
pub fn smooth(strands: &Strands, amount: f64) -> Vec<DVec3> {
    strands.map(|_, points| smoothed(points, amount.max(0.0))).concat()
}

fn smoothed(points: &[DVec3], amount: f64) -> Vec<DVec3> {
    let last = points.len() - 1;
    let mut found = points.to_vec();
    if last < 2 || amount == 0.0 {
        return found;
    }
    let diagonal = 1.0 + 2.0 * amount;
    let mut upper = vec![0.0; points.len()];
    // Forward: row i reads -amount x[i-1] + diagonal x[i] - amount x[i+1] = points[i]; x[0] is known.
    for i in 1..last {
        let pivot = diagonal - amount * upper[i - 1];
        upper[i] = amount / pivot;
        found[i] = (points[i] + found[i - 1] * amount) / pivot;
    }
    for i in (1..last).rev() {
        found[i] = found[i] + found[i + 1] * upper[i];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(points: &[DVec3], amount: f64) -> Vec<DVec3> {
        smooth(&Strands::new(points, &[0, points.len() as i64]).expect("valid"), amount)
    }

    #[test]
    fn the_equation_holds() {
        let points: Vec<DVec3> = (0..9).map(|i| DVec3::new(f64::from(i), f64::from(i * i % 5), 1.0)).collect();
        let found = run(&points, 2.5);
        assert_eq!((found[0], found[8]), (points[0], points[8]));
        for i in 1..8 {
            let left = found[i] * 6.0 - (found[i - 1] + found[i + 1]) * 2.5;
            assert!(left.distance(points[i]) < 1e-12);
        }
    }

    #[test]
    fn straight_strands_stay_and_zigzag_fades() {
        let straight: Vec<DVec3> = (0..7).map(|i| DVec3::new(f64::from(i), 2.0, 0.0)).collect();
        for (a, b) in run(&straight, 100.0).iter().zip(&straight) {
            assert!(a.distance(*b) < 1e-9);
        }
        let zigzag: Vec<DVec3> =
            (0..9).map(|i| DVec3::new(f64::from(i), if i % 2 == 1 { 1.0 } else { 0.0 }, 0.0)).collect();
        let height = |p: &[DVec3]| p[2..7].windows(2).map(|w| (w[1].y - w[0].y).abs()).fold(0.0, f64::max);
        assert!(height(&run(&zigzag, 4.0)) < 0.15);
    }
}
