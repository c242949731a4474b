//! Diffusion of values over the marked cells of a box of voxels (or of a picture: one layer).
//!
//! The answer minimises `Σ_cells w (u - v)² + Σ_neighbours (u_i - u_j)²` for every channel on its own: the screened Poisson
//! equation, with natural boundaries at the edge of the mask. A weight of infinity fixes the cell (Dirichlet); weight 0
//! leaves it to its neighbours (Laplace). Started from the answer on a box of half the resolution. Conjugate gradients on the marked cells alone, with the diagonal as preconditioner:
//! on the coarse boxes used here (some 10^5 cells, data nearly everywhere) it needs few steps, costs no set-up and all its
//! loops are parallel, which an incomplete factor's are not.

use rayon::prelude::*;

use crate::diffusion_system::{Solved, System};
use crate::error::check_number;
use crate::{FieldError, GridShape};

/// Up to so many cells the iteration starts from zero.
const COARSEST: usize = 2000;

/// What to stop at.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseOptions {
    /// Largest residual, relative to the right-hand side.
    pub accuracy: f64,
    /// Most steps of the conjugate gradients.
    pub max_iterations: usize,
}

/// The diffused values and how the solver fared.
#[derive(Clone, Debug)]
pub struct Diffused {
    /// `channels` values a cell, 0 outside the mask.
    pub values: Vec<f64>,
    /// Steps taken.
    pub iterations: usize,
    /// Every channel reached the accuracy.
    pub converged: bool,
}

/// Diffuses `values` (`channels` a cell) over the cells where `mask` is true.
///
/// A connected part of the mask without any weight keeps the initial value 0.
///
/// # Errors
/// Lengths that do not fit `shape`, negative or NaN weights.
pub fn diffuse(
    mask: &[bool],
    weights: &[f64],
    values: &[f64],
    channels: usize,
    shape: GridShape,
    options: DiffuseOptions,
) -> Result<Diffused, FieldError> {
    shape.expect("mask", mask.len())?;
    shape.expect("weights", weights.len())?;
    let expected = shape.len() * channels;
    if values.len() != expected || channels == 0 {
        return Err(FieldError::Length { name: "values", found: values.len(), expected });
    }
    check_number("accuracy", options.accuracy)?;
    if let Some(&value) = weights.iter().find(|w| w.is_nan() || **w < 0.0) {
        return Err(FieldError::Number { name: "weights", value });
    }
    let system = System::new(mask, weights, shape);
    let start = if system.cells.len() > COARSEST {
        start(mask, weights, values, channels, shape, options)?
    } else {
        Vec::new()
    };
    let solved = system.solve(weights, values, &start, channels, options);
    Ok(gather(&system, weights, values, mask, channels, &solved))
}

/// The answer on cells of twice the size, spread over their children: where the iteration starts.
///
/// The smooth part of the answer, which conjugate gradients find last, is then already there. Weights of children add up;
/// a link of the coarse box stands for four rows of two links in 3-D (energy 2 Δ²), for two in a picture (Δ²).
fn start(
    mask: &[bool],
    weights: &[f64],
    values: &[f64],
    channels: usize,
    shape: GridShape,
    options: DiffuseOptions,
) -> Result<Vec<f64>, FieldError> {
    let half = |n: usize| n.div_ceil(2);
    let coarse = GridShape { layers: half(shape.layers), rows: half(shape.rows), columns: half(shape.columns) };
    let parent = |cell: usize| {
        let [z, y, x] = shape.place(cell);
        coarse.index(z / 2, y / 2, x / 2)
    };
    let share = if shape.layers > 1 { 0.5 } else { 1.0 };
    let mut below = Coarse::new(coarse.len(), channels);
    for cell in (0..shape.len()).filter(|&cell| mask[cell]) {
        below.add(parent(cell), weights[cell] * share, &values[cell * channels..(cell + 1) * channels]);
    }
    below.finish(channels);
    let found = diffuse(&below.mask, &below.weights, &below.values, channels, coarse, options)?;
    let mut out = vec![0.0; values.len()];
    out.par_chunks_mut(channels).enumerate().filter(|(cell, _)| mask[*cell]).for_each(|(cell, out)| {
        let from = parent(cell) * channels;
        out.copy_from_slice(&found.values[from..from + channels]);
    });
    Ok(out)
}

/// Sums over the children of coarse cells.
struct Coarse {
    mask: Vec<bool>,
    weights: Vec<f64>,
    values: Vec<f64>,
    fixed: Vec<u8>,
}

impl Coarse {
    fn new(cells: usize, channels: usize) -> Self {
        Self {
            mask: vec![false; cells],
            weights: vec![0.0; cells],
            values: vec![0.0; cells * channels],
            fixed: vec![0; cells],
        }
    }

    /// A fixed child outvotes those that are not.
    fn add(&mut self, cell: usize, weight: f64, values: &[f64]) {
        self.mask[cell] = true;
        let mine = &mut self.values[cell * values.len()..(cell + 1) * values.len()];
        if weight.is_infinite() && self.fixed[cell] == 0 {
            mine.fill(0.0);
        }
        if weight.is_infinite() {
            self.fixed[cell] += 1;
        } else if self.fixed[cell] == 0 {
            self.weights[cell] += weight;
        }
        let amount = match (weight.is_infinite(), self.fixed[cell] > 0) {
            (true, _) => 1.0,
            (false, true) => 0.0,
            (false, false) => weight,
        };
        if amount > 0.0 {
            for (mine, value) in mine.iter_mut().zip(values) {
                *mine += amount * value;
            }
        }
    }

    /// Sums become means.
    fn finish(&mut self, channels: usize) {
        for (cell, values) in self.values.chunks_mut(channels).enumerate() {
            let total = if self.fixed[cell] > 0 { f64::from(self.fixed[cell]) } else { self.weights[cell] };
            if total > 0.0 {
                values.iter_mut().for_each(|v| *v /= total);
            }
            if self.fixed[cell] > 0 {
                self.weights[cell] = f64::INFINITY;
            }
        }
    }
}

fn gather(
    system: &System,
    weights: &[f64],
    values: &[f64],
    mask: &[bool],
    channels: usize,
    solved: &Solved,
) -> Diffused {
    let mut out = vec![0.0; values.len()];
    for (cell, chunk) in out.chunks_mut(channels.max(1)).enumerate() {
        if mask[cell] && weights[cell].is_infinite() {
            chunk.copy_from_slice(&values[cell * channels..(cell + 1) * channels]);
        }
    }
    for (row, &cell) in system.cells.iter().enumerate() {
        let place = cell as usize * channels;
        out[place..place + channels].copy_from_slice(&solved.values[row * channels..(row + 1) * channels]);
    }
    Diffused { values: out, iterations: solved.iterations, converged: solved.converged }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPTIONS: DiffuseOptions = DiffuseOptions { accuracy: 1e-12, max_iterations: 10_000 };

    #[test]
    fn linear_data_at_the_border_is_continued_linearly() {
        let shape = GridShape { layers: 4, rows: 6, columns: 7 };
        let linear = |cell: usize| {
            let [z, y, x] = shape.place(cell);
            1.0 + 2.0 * x as f64 - 0.5 * y as f64 + 0.25 * z as f64
        };
        let edge = |cell: usize| shape.neighbours(cell).iter().any(Option::is_none);
        let weights: Vec<f64> = (0..shape.len()).map(|c| if edge(c) { f64::INFINITY } else { 0.0 }).collect();
        let values: Vec<f64> = (0..shape.len()).map(|c| if edge(c) { linear(c) } else { 0.0 }).collect();
        let mask = vec![true; shape.len()];
        let out = diffuse(&mask, &weights, &values, 1, shape, OPTIONS).expect("fits");
        assert!(out.converged);
        assert!((0..shape.len()).all(|c| (out.values[c] - linear(c)).abs() < 1e-8));
    }

    #[test]
    fn a_channel_does_not_see_the_others() {
        let shape = GridShape { layers: 1, rows: 5, columns: 5 };
        let mask = vec![true; 25];
        let weights: Vec<f64> = (0..25).map(|c| f64::from(u8::from(c % 6 == 0))).collect();
        for channels in [2, 9] {
            let many: Vec<f64> = (0..25 * channels).map(|i| (i * 7 % 11) as f64).collect();
            let one: Vec<f64> = many.iter().skip(1).step_by(channels).copied().collect();
            let all = diffuse(&mask, &weights, &many, channels, shape, OPTIONS).expect("fits");
            let alone = diffuse(&mask, &weights, &one, 1, shape, OPTIONS).expect("fits");
            assert!((0..25).all(|c| (all.values[channels * c + 1] - alone.values[c]).abs() < 1e-12));
        }
    }
}
