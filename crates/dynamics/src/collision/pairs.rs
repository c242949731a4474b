//! Particles of different chains that may meet within a frame.

use std::collections::HashMap;

use glam::{DVec3, I64Vec3};

/// Two particles and the distance that they keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The lower particle.
    pub first: usize,
    /// The higher particle.
    pub second: usize,
    /// Metres.
    pub distance: f64,
}

/// All pairs of different chains within `reach`, that keep `distance` or what their goals have, whichever is less; in
/// order of their particles.
#[must_use]
pub fn pairs(points: &[DVec3], goals: &[DVec3], offsets: &[usize], distance: f64, reach: f64) -> Vec<Pair> {
    let cell = |p: DVec3| (p / reach).floor().as_i64vec3();
    let mut cells: HashMap<I64Vec3, Vec<usize>> = HashMap::new();
    let mut chain = vec![0; points.len()];
    for (index, ends) in offsets.windows(2).enumerate() {
        chain[ends[0]..ends[1]].fill(index);
    }
    let mut found = Vec::new();
    for (second, &point) in points.iter().enumerate() {
        let home = cell(point);
        for step in 0..27 {
            let beside = home + I64Vec3::new(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1);
            for &first in cells.get(&beside).map_or(&[][..], Vec::as_slice) {
                if chain[first] != chain[second] && points[first].distance_squared(point) < reach * reach {
                    let distance = distance.min(goals[first].distance(goals[second]));
                    found.push(Pair { first, second, distance });
                }
            }
        }
        cells.entry(home).or_default().push(second);
    }
    found.sort_unstable_by_key(|pair| (pair.first, pair.second));
    found
}

/// Moves a pair apart that is too near.
pub(crate) fn part(points: &mut [DVec3], pair: Pair, inverse: &[f64]) {
    let (a, b) = (inverse[pair.first], inverse[pair.second]);
    let between = points[pair.second] - points[pair.first];
    let found = between.length();
    if found >= pair.distance || found <= 0.0 || a + b <= 0.0 {
        return;
    }
    let step = (pair.distance - found) / (found * (a + b)) * between;
    points[pair.first] -= a * step;
    points[pair.second] += b * step;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_those_of_a_plain_search() {
        let points: Vec<DVec3> = (0..300)
            .map(|i| DVec3::new(f64::from(i * 37 % 101), f64::from(i * 53 % 89), f64::from(i * 71 % 97)) * 0.01)
            .collect();
        let offsets: Vec<usize> = (0..=30).map(|c| c * 10).collect();
        let goals: Vec<DVec3> = points.iter().map(|p| *p * 0.1).collect();
        let found = pairs(&points, &goals, &offsets, 0.05, 0.1);
        let mut plain = Vec::new();
        for first in 0..300 {
            for second in first + 1..300 {
                if first / 10 != second / 10 && points[first].distance(points[second]) < 0.1 {
                    let distance = goals[first].distance(goals[second]).min(0.05);
                    plain.push(Pair { first, second, distance });
                }
            }
        }
        assert!(!found.is_empty());
        assert_eq!(found, plain);
    }
}
