//! Values of a box of voxels between the cells' centres.

use glam::DVec3;
use rayon::prelude::*;

use crate::{FieldError, GridShape};

/// Trilinear values at `places` (column, row, layer; a cell's centre at + 0.5); those outside take the border's.
///
/// # Errors
/// `values` does not have `shape.len()` entries, or the box is empty.
pub fn sample(values: &[f32], places: &[DVec3], shape: GridShape) -> Result<Vec<f32>, FieldError> {
    shape.expect("values", values.len())?;
    if shape.is_empty() {
        return Err(FieldError::Length { name: "values", found: 0, expected: 1 });
    }
    let most = DVec3::new(shape.columns as f64, shape.rows as f64, shape.layers as f64) - 1.0;
    let at = |place: &DVec3| {
        let q = (*place - 0.5).clamp(DVec3::ZERO, most);
        let low = q.floor();
        let f = q - low;
        let high = (low + 1.0).min(most);
        let mut sum = 0.0;
        for corner in 0..8u8 {
            let up = [corner & 1 == 1, corner & 2 == 2, corner & 4 == 4];
            let share: f64 = (0..3).map(|k| if up[k] { f[k] } else { 1.0 - f[k] }).product();
            let cell = |k: usize| (if up[k] { high[k] } else { low[k] }) as usize;
            if share > 0.0 {
                sum += share * f64::from(values[shape.index(cell(2), cell(1), cell(0))]);
            }
        }
        sum as f32
    };
    Ok(places.par_iter().map(at).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_field_is_read_exactly() {
        let shape = GridShape { layers: 4, rows: 5, columns: 6 };
        let linear = |p: DVec3| 1.0 + 0.5 * p.x - 0.25 * p.y + 2.0 * p.z;
        let values: Vec<f32> = (0..shape.len())
            .map(|cell| {
                let [z, y, x] = shape.place(cell).map(|v| v as f64 + 0.5);
                linear(DVec3::new(x, y, z)) as f32
            })
            .collect();
        let places = [DVec3::new(0.5, 0.5, 0.5), DVec3::new(2.2, 3.7, 1.9), DVec3::new(5.5, 4.5, 3.5)];
        let found = sample(&values, &places, shape).expect("fits");
        assert!(places.iter().zip(found).all(|(p, v)| (f64::from(v) - linear(*p)).abs() < 1e-5));
    }
}
