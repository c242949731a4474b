//! Principal axes of symmetric 3x3 tensors.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// The unit eigenvector of the largest eigenvalue of each tensor `(xx, yy, zz, xy, xz, yz)`, on the side of `hints`; the hint
/// itself where the tensor has no single largest axis (zero tensor), zero where that is zero too.
///
/// `hints` has one vector a tensor and settles the sign, since a tensor does not know forth from back.
#[must_use]
pub fn principal_axes(tensors: &[[f64; 6]], hints: &[DVec3]) -> Vec<DVec3> {
    tensors.par_iter().zip(hints).map(|(t, &hint)| principal_axis(t, hint)).collect()
}

fn principal_axis(t: &[f64; 6], hint: DVec3) -> DVec3 {
    let m = DMat3::from_cols(DVec3::new(t[0], t[3], t[4]), DVec3::new(t[3], t[1], t[5]), DVec3::new(t[4], t[5], t[2]));
    let largest = largest_eigenvalue(t);
    let axis = null_vector(m - DMat3::from_diagonal(DVec3::splat(largest)), largest.abs());
    match axis {
        Some(axis) if axis.dot(hint) < 0.0 => -axis,
        Some(axis) => axis,
        None => hint.normalize_or_zero(),
    }
}

/// Closed form for symmetric matrices (Smith 1961).
fn largest_eigenvalue(t: &[f64; 6]) -> f64 {
    let off = t[3] * t[3] + t[4] * t[4] + t[5] * t[5];
    let mean = (t[0] + t[1] + t[2]) / 3.0;
    let d = [t[0] - mean, t[1] - mean, t[2] - mean];
    let p = ((d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 2.0 * off) / 6.0).sqrt();
    if p < 1e-300 {
        return mean;
    }
    let determinant =
        d[0] * (d[1] * d[2] - t[5] * t[5]) - t[3] * (t[3] * d[2] - t[5] * t[4]) + t[4] * (t[3] * t[5] - d[1] * t[4]);
    let r = (determinant / (2.0 * p * p * p)).clamp(-1.0, 1.0);
    mean + 2.0 * p * (r.acos() / 3.0).cos()
}

/// The direction that `m` (of rank 2) sends to zero: the longest cross product of its rows.
fn null_vector(m: DMat3, scale: f64) -> Option<DVec3> {
    let crosses = [m.x_axis.cross(m.y_axis), m.x_axis.cross(m.z_axis), m.y_axis.cross(m.z_axis)];
    let mut best = crosses[0];
    for c in &crosses[1..] {
        if c.length_squared() > best.length_squared() {
            best = *c;
        }
    }
    (best.length() > 1e-12 * scale * scale).then(|| best.normalize_or_zero()).filter(|b| *b != DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_axis_of_a_line_is_found(x in -1.0..1.0f64, y in -1.0..1.0f64, z in 0.1..1.0f64, rest in 0.0..0.5f64) {
            let d = DVec3::new(x, y, z).normalize();
            let t = [
                d.x * d.x + rest, d.y * d.y + rest, d.z * d.z + rest, d.x * d.y, d.x * d.z, d.y * d.z,
            ];
            let found = principal_axes(&[t], &[d])[0];
            prop_assert!(found.dot(d) > 1.0 - 1e-9);
        }
    }

    #[test]
    fn without_an_axis_the_hint_stays() {
        let hint = DVec3::new(0.0, -1.0, 0.0);
        assert_eq!(principal_axes(&[[0.0; 6], [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]], &[hint, hint]), vec![hint, hint]);
    }
}
