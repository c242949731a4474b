//! Symmetric sparse matrices and preconditioned conjugate gradients, the same bits for any number of threads.

use rayon::prelude::*;

const CHUNK: usize = 4096;

/// A symmetric matrix with all its entries, row by row; columns of a row ascend.
#[derive(Debug, Clone)]
pub struct SparseSymmetric {
    /// Where every row begins in `columns` and `values`; one more than there are rows.
    pub offsets: Vec<usize>,
    /// Column of every entry.
    pub columns: Vec<u32>,
    /// Value of every entry.
    pub values: Vec<f64>,
}

impl SparseSymmetric {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Columns and values of a row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.offsets[row]..self.offsets[row + 1];
        self.columns[range.clone()].iter().map(|&c| c as usize).zip(self.values[range].iter().copied())
    }

    /// `out` = the matrix times `x`.
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| {
            for (k, value) in out.iter_mut().enumerate() {
                *value = self.row(chunk * CHUNK + k).map(|(column, entry)| entry * x[column]).sum();
            }
        });
    }
}

/// How conjugate gradients ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CgOutcome {
    /// Iterations done.
    pub iterations: usize,
    /// Norm of the residual over that of the right-hand side.
    pub residual: f64,
    /// Whether the residual got below the tolerance.
    pub converged: bool,
}

/// Solves `matrix` x = `right_side` from the guess `x`; `precondition(r, z)` writes an approximate solution for r into z.
///
/// Stops when the residual's norm is at most `tolerance` times that of the right-hand side. Source: Hestenes & Stiefel
/// 1952; sums are taken over fixed chunks, so that threads do not change them.
pub fn conjugate_gradients(
    matrix: &SparseSymmetric,
    right_side: &[f64],
    mut x: Vec<f64>,
    precondition: impl Fn(&[f64], &mut [f64]),
    tolerance: f64,
    max_iterations: usize,
) -> (Vec<f64>, CgOutcome) {
    let count = right_side.len();
    let scale = norm(right_side).max(f64::MIN_POSITIVE);
    let mut product = vec![0.0; count];
    matrix.multiply(&x, &mut product);
    let mut residual: Vec<f64> = right_side.iter().zip(&product).map(|(b, a)| b - a).collect();
    let mut z = vec![0.0; count];
    precondition(&residual, &mut z);
    let mut direction = z.clone();
    let mut energy = dot(&residual, &z);
    let mut iterations = 0;
    while norm(&residual) > tolerance * scale && iterations < max_iterations {
        matrix.multiply(&direction, &mut product);
        let step = energy / dot(&direction, &product);
        add_scaled(&mut x, step, &direction);
        add_scaled(&mut residual, -step, &product);
        precondition(&residual, &mut z);
        let next = dot(&residual, &z);
        let ratio = next / energy;
        direction.par_iter_mut().zip(&z).for_each(|(d, z)| *d = z + ratio * *d);
        energy = next;
        iterations += 1;
    }
    let left = norm(&residual) / scale;
    (x, CgOutcome { iterations, residual: left, converged: left <= tolerance })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let parts: Vec<f64> =
        a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum()).collect();
    parts.iter().sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn add_scaled(x: &mut [f64], factor: f64, y: &[f64]) {
    x.par_iter_mut().zip(y).for_each(|(x, y)| *x += factor * y);
}
