//! Directions diffused through marked voxels as structure tensors, which know no forth and back, together with their sense.
//!
//! Diffusing the vectors alone would cancel hair that is parted to both sides; the tensor of each keeps its axis, and the
//! diffused vectors only choose between its two ends.

use glam::DVec3;
use rayon::prelude::*;

use crate::diffuse::{DiffuseOptions, diffuse};
use crate::principal::principal_axes;
use crate::{FieldError, GridShape};

/// Channels of a tensor and its sense.
const CHANNELS: usize = 9;

/// Unit directions of the marked cells, in their order, and how the solver fared.
#[derive(Clone, Debug)]
pub struct DiffusedAxes {
    /// One a marked cell; zero where nothing reaches.
    pub axes: Vec<DVec3>,
    /// Steps taken.
    pub iterations: usize,
    /// The solver reached its accuracy.
    pub converged: bool,
}

/// Diffuses the unit `vectors` of the marked cells (in their order) with their `weights`.
///
/// # Errors
/// Lengths that do not fit the mask, negative or NaN weights.
pub fn diffuse_axes(
    mask: &[bool],
    vectors: &[DVec3],
    weights: &[f64],
    shape: GridShape,
    options: DiffuseOptions,
) -> Result<DiffusedAxes, FieldError> {
    shape.expect("mask", mask.len())?;
    let cells: Vec<usize> = (0..mask.len()).filter(|&cell| mask[cell]).collect();
    for (name, found) in [("vectors", vectors.len()), ("weights", weights.len())] {
        if found != cells.len() {
            return Err(FieldError::Length { name, found, expected: cells.len() });
        }
    }
    let mut values = vec![0.0; mask.len() * CHANNELS];
    let mut amounts = vec![0.0; mask.len()];
    for ((&cell, v), &weight) in cells.iter().zip(vectors).zip(weights) {
        let channels = [v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z, v.x, v.y, v.z];
        values[cell * CHANNELS..(cell + 1) * CHANNELS].copy_from_slice(&channels);
        amounts[cell] = weight;
    }
    let found = diffuse(mask, &amounts, &values, CHANNELS, shape, options)?;
    let (tensors, hints): (Vec<[f64; 6]>, Vec<DVec3>) = cells
        .par_iter()
        .map(|&cell| {
            let c = &found.values[cell * CHANNELS..(cell + 1) * CHANNELS];
            ([c[0], c[1], c[2], c[3], c[4], c[5]], DVec3::new(c[6], c[7], c[8]))
        })
        .unzip();
    Ok(DiffusedAxes {
        axes: principal_axes(&tensors, &hints),
        iterations: found.iterations,
        converged: found.converged,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: GridShape = GridShape { layers: 3, rows: 4, columns: 9 };
    const OPTIONS: DiffuseOptions = DiffuseOptions { accuracy: 1e-9, max_iterations: 1000 };

    fn ends(left: DVec3, right: DVec3) -> DiffusedAxes {
        let column = |cell: usize| SHAPE.place(cell)[2];
        let vectors: Vec<DVec3> = (0..SHAPE.len()).map(|c| if column(c) == 0 { left } else { right }).collect();
        let weights: Vec<f64> =
            (0..SHAPE.len()).map(|c| if column(c) == 0 || column(c) == 8 { 1.0 } else { 0.0 }).collect();
        diffuse_axes(&vec![true; SHAPE.len()], &vectors, &weights, SHAPE, OPTIONS).expect("fits")
    }

    #[test]
    fn one_direction_fills_everything() {
        let d = DVec3::new(1.0, -2.0, 0.5).normalize();
        assert!(ends(d, d).axes.iter().all(|axis| axis.distance(d) < 1e-6));
    }

    #[test]
    fn opposite_senses_keep_their_axis() {
        let out = ends(DVec3::Y, -DVec3::Y);
        assert!(out.converged && out.axes.iter().all(|axis| axis.y.abs() > 1.0 - 1e-6));
    }
}
