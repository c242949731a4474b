//! Diffusion of values over the marked cells of a box of voxels (or of a picture: one layer).
//!
//! The answer minimises `Σ_cells w (u - v)² + Σ_neighbours (u_i - u_j)²` for every channel on its own: the screened Poisson
//! equation, with natural boundaries at the edge of the mask. A weight of infinity fixes the cell (Dirichlet); weight 0
//! leaves it to its neighbours (Laplace). Conjugate gradients on the marked cells alone, with the diagonal as preconditioner:
//! on the coarse boxes used here (some 10^5 cells, data nearly everywhere) it needs few steps, costs no set-up and all its
//! loops are parallel, which an incomplete factor's are not.

use rayon::prelude::*;

use crate::error::check_number;
use crate::sums::dot;
use crate::{FieldError, GridShape};

const NONE: u32 = u32::MAX;

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
    /// Most steps that a channel took.
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
    if values.len() != expected {
        return Err(FieldError::Length { name: "values", found: values.len(), expected });
    }
    check_number("accuracy", options.accuracy)?;
    if let Some(&value) = weights.iter().find(|w| w.is_nan() || **w < 0.0) {
        return Err(FieldError::Number { name: "weights", value });
    }
    let system = System::new(mask, weights, shape);
    let solved: Vec<Solved> =
        (0..channels).into_par_iter().map(|c| system.solve(weights, values, channels, c, options)).collect();
    Ok(gather(&system, weights, values, mask, channels, &solved))
}

struct System {
    cells: Vec<u32>,
    links: Vec<[u32; 6]>,
    fixed: Vec<[u32; 6]>,
    diagonal: Vec<f64>,
}

struct Solved {
    values: Vec<f64>,
    iterations: usize,
    converged: bool,
}

impl System {
    fn new(mask: &[bool], weights: &[f64], shape: GridShape) -> Self {
        let free = |cell: usize| mask[cell] && weights[cell].is_finite();
        let cells: Vec<u32> = (0..shape.len()).filter(|&cell| free(cell)).map(|cell| cell as u32).collect();
        let mut number = vec![NONE; shape.len()];
        for (row, &cell) in cells.iter().enumerate() {
            number[cell as usize] = row as u32;
        }
        let pairs: Vec<([u32; 6], [u32; 6])> = cells
            .par_iter()
            .map(|&cell| {
                let near = shape.neighbours(cell as usize);
                let link = near.map(|n| n.map_or(NONE, |n| number[n]));
                let fixed = near.map(|n| n.filter(|&n| mask[n] && weights[n].is_infinite()).map_or(NONE, |n| n as u32));
                (link, fixed)
            })
            .collect();
        let diagonal = cells
            .iter()
            .zip(&pairs)
            .map(|(&cell, (link, fixed))| {
                let degree = link.iter().chain(fixed).filter(|&&n| n != NONE).count();
                weights[cell as usize] + degree as f64
            })
            .collect();
        let (links, fixed) = pairs.into_iter().unzip();
        Self { cells, links, fixed, diagonal }
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        out.par_iter_mut().with_min_len(2048).enumerate().for_each(|(row, out)| {
            let near: f64 = self.links[row].iter().filter(|&&n| n != NONE).map(|&n| x[n as usize]).sum();
            *out = self.diagonal[row] * x[row] - near;
        });
    }

    fn right_side(&self, weights: &[f64], values: &[f64], channels: usize, channel: usize) -> Vec<f64> {
        let value = |cell: u32| values[cell as usize * channels + channel];
        let term = |row: usize| {
            let cell = self.cells[row];
            let weight = weights[cell as usize];
            let data = if weight > 0.0 { weight * value(cell) } else { 0.0 };
            data + self.fixed[row].iter().filter(|&&n| n != NONE).map(|&n| value(n)).sum::<f64>()
        };
        (0..self.cells.len()).into_par_iter().map(term).collect()
    }

    fn solve(
        &self,
        weights: &[f64],
        values: &[f64],
        channels: usize,
        channel: usize,
        options: DiffuseOptions,
    ) -> Solved {
        let b = self.right_side(weights, values, channels, channel);
        let n = b.len();
        let mut x = vec![0.0; n];
        let mut r = b.clone();
        let scaled = |r: &[f64]| -> Vec<f64> {
            r.par_iter().zip(&self.diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect()
        };
        let mut z = scaled(&r);
        let mut p = z.clone();
        let mut image = vec![0.0; n];
        let mut rz = dot(&r, &z);
        let goal = options.accuracy * dot(&b, &b).sqrt();
        let mut iterations = 0;
        while iterations < options.max_iterations && dot(&r, &r).sqrt() > goal {
            self.apply(&p, &mut image);
            let curvature = dot(&p, &image);
            if curvature <= 0.0 {
                break;
            }
            let step = rz / curvature;
            x.par_iter_mut().zip(&p).for_each(|(x, p)| *x += step * p);
            r.par_iter_mut().zip(&image).for_each(|(r, q)| *r -= step * q);
            z = scaled(&r);
            let next = dot(&r, &z);
            let turn = next / rz;
            rz = next;
            p.par_iter_mut().zip(&z).for_each(|(p, z)| *p = z + turn * *p);
            iterations += 1;
        }
        let converged = dot(&r, &r).sqrt() <= goal;
        Solved { values: x, iterations, converged }
    }
}

fn gather(
    system: &System,
    weights: &[f64],
    values: &[f64],
    mask: &[bool],
    channels: usize,
    solved: &[Solved],
) -> Diffused {
    let mut out = vec![0.0; values.len()];
    for (cell, chunk) in out.chunks_mut(channels.max(1)).enumerate() {
        if mask[cell] && weights[cell].is_infinite() {
            chunk.copy_from_slice(&values[cell * channels..(cell + 1) * channels]);
        }
    }
    for (row, &cell) in system.cells.iter().enumerate() {
        for (channel, solution) in solved.iter().enumerate() {
            out[cell as usize * channels + channel] = solution.values[row];
        }
    }
    Diffused {
        values: out,
        iterations: solved.iter().map(|s| s.iterations).max().unwrap_or(0),
        converged: solved.iter().all(|s| s.converged),
    }
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
        let two: Vec<f64> = (0..50).map(|i| (i * 7 % 11) as f64).collect();
        let one: Vec<f64> = two.iter().skip(1).step_by(2).copied().collect();
        let both = diffuse(&mask, &weights, &two, 2, shape, OPTIONS).expect("fits");
        let alone = diffuse(&mask, &weights, &one, 1, shape, OPTIONS).expect("fits");
        assert!((0..25).all(|c| (both.values[2 * c + 1] - alone.values[c]).abs() < 1e-12));
    }
}
