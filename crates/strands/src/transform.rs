//! Points elsewhere.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// Points under the affine map `[linear | shift]`, row by row; computed in double precision and rounded once.
pub fn transformed(points: &[[f32; 3]], matrix: &[[f64; 4]; 3]) -> Vec<[f32; 3]> {
    let linear = DMat3::from_cols_array_2d(&matrix.map(|row| [row[0], row[1], row[2]])).transpose();
    let shift = DVec3::from_array(matrix.map(|row| row[3]));
    points
        .par_iter()
        .map(|p| {
            let moved = linear * DVec3::new(p[0].into(), p[1].into(), p[2].into()) + shift;
            moved.to_array().map(|value| value as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_and_shifts() {
        let quarter = [[0.0, -1.0, 0.0, 10.0], [1.0, 0.0, 0.0, 20.0], [0.0, 0.0, 1.0, 30.0]];
        assert_eq!(transformed(&[[1.0, 2.0, 3.0]], &quarter), [[8.0, 21.0, 33.0]]);
    }
}
