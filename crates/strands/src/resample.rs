//! New points at equal lengths along the strand.
//!
//! The result tells where the new points lie between the old ones, so that positions and every attribute are interpolated
//! in the same way by whoever holds them.

use glam::DVec3;

use crate::Strands;
use crate::arc_length::from_root;

/// New points of all strands, each between two old ones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sampling {
    /// First new point of each strand, and the number of new points.
    pub offsets: Vec<i64>,
    /// Index of the old point before each new one; never the last of a strand.
    pub index: Vec<i64>,
    /// Where it lies from that old point (0) to the next (1).
    pub fraction: Vec<f64>,
}

/// `count` points on every strand at equal lengths; the first and the last stay. `count` is at least 2.
pub fn resample_by_count(strands: &Strands, count: usize) -> Sampling {
    sampled(strands, |_| count.max(2))
}

/// Points at equal lengths of at most `spacing`, and as near to it as whole numbers allow; the first and the last stay.
pub fn resample_by_spacing(strands: &Strands, spacing: f64) -> Sampling {
    sampled(strands, |length| ((length / spacing - 1e-9).ceil().max(1.0)) as usize + 1)
}

fn sampled(strands: &Strands, count_of_length: impl Fn(f64) -> usize + Sync + Send) -> Sampling {
    let parts = strands.map(|range, points| strand_sampling(points, range.start as i64, &count_of_length));
    let mut all = Sampling { offsets: vec![0], ..Sampling::default() };
    for (index, fraction) in parts {
        all.index.extend(index);
        all.fraction.extend(fraction);
        all.offsets.push(all.index.len() as i64);
    }
    all
}

fn strand_sampling(points: &[DVec3], first: i64, count_of_length: &impl Fn(f64) -> usize) -> (Vec<i64>, Vec<f64>) {
    let lengths = from_root(points);
    let total = lengths[lengths.len() - 1];
    let count = count_of_length(total);
    let mut segment = 0;
    (0..count)
        .map(|i| {
            let wanted = total * i as f64 / (count - 1) as f64;
            while segment + 2 < points.len() && lengths[segment + 1] < wanted {
                segment += 1;
            }
            let step = lengths[segment + 1] - lengths[segment];
            let inside = if step > 0.0 { ((wanted - lengths[segment]) / step).clamp(0.0, 1.0) } else { 0.0 };
            // The tip exactly, and a strand without length from its first to its last point.
            if i + 1 == count {
                return (first + points.len() as i64 - 2, 1.0);
            }
            (first + segment as i64, inside)
        })
        .unzip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn strand() -> impl Strategy<Value = Vec<DVec3>> {
        prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(DVec3::from_array), 2..20)
    }

    fn positions(points: &[DVec3], sampling: &Sampling) -> Vec<DVec3> {
        let at = |(&i, &f): (&i64, &f64)| points[i as usize].lerp(points[i as usize + 1], f);
        sampling.index.iter().zip(&sampling.fraction).map(at).collect()
    }

    proptest! {
        #[test]
        fn ends_stay_and_arcs_are_equal(points in strand(), count in 2usize..40) {
            let offsets = [0, points.len() as i64];
            let strands = Strands::new(&points, &offsets).expect("valid");
            let sampling = resample_by_count(&strands, count);
            let found = positions(&points, &sampling);
            prop_assert_eq!(found.len(), count);
            prop_assert_eq!(found[0], points[0]);
            prop_assert!(found[count - 1].distance(points[points.len() - 1]) < 1e-12);
            let arcs = from_root(&points);
            let along: Vec<f64> = sampling.index.iter().zip(&sampling.fraction)
                .map(|(&i, f)| arcs[i as usize] + f * (arcs[i as usize + 1] - arcs[i as usize])).collect();
            for (i, length) in along.iter().enumerate() {
                let wanted = arcs[arcs.len() - 1] * i as f64 / (count - 1) as f64;
                prop_assert!((length - wanted).abs() < 1e-9);
            }
        }

        #[test]
        fn spacing_is_at_most_what_was_asked(points in strand(), spacing in 0.05..2.0f64) {
            let offsets = [0, points.len() as i64];
            let strands = Strands::new(&points, &offsets).expect("valid");
            let steps = resample_by_spacing(&strands, spacing).index.len() - 1;
            let length = from_root(&points)[points.len() - 1];
            prop_assert!(length / steps as f64 <= spacing * (1.0 + 1e-6));
            prop_assert!(steps == 1 || length / (steps - 1) as f64 > spacing * (1.0 - 1e-6));
        }
    }

    #[test]
    fn a_strand_without_length_keeps_its_ends() {
        let points = [DVec3::ONE; 3];
        let strands = Strands::new(&points, &[0, 3]).expect("valid");
        let sampling = resample_by_count(&strands, 4);
        assert_eq!(sampling.index, [0, 0, 0, 1]);
        assert_eq!(sampling.fraction, [0.0, 0.0, 0.0, 1.0]);
    }
}
