//! Sums whose bits do not depend on the number of threads.

use rayon::prelude::*;

const CHUNK: usize = 4096;
/// Cells whose sums are added up first.
const CELLS: usize = 1024;
/// Fewest cells that are worth a thread of their own: a pass over a few is over before others could begin.
pub(crate) const SUMMED: usize = 8192;

/// Inner product by fixed chunks, added in their order.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let parts: Vec<f64> =
        a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum()).collect();
    parts.iter().sum()
}

/// Visits all `cells`, which may be changed, and adds up what `visit` gives for each: by fixed chunks, added in their order.
pub(crate) fn sums<T: Send, const K: usize, const N: usize>(
    cells: &mut [T],
    visit: impl Fn(usize, &mut T) -> [[f64; K]; N] + Sync,
) -> [[f64; K]; N] {
    let add = |mut total: [[f64; K]; N], part: [[f64; K]; N]| {
        total.iter_mut().flatten().zip(part.as_flattened()).for_each(|(total, part)| *total += part);
        total
    };
    let parts: Vec<[[f64; K]; N]> = cells
        .par_chunks_mut(CELLS)
        .with_min_len(SUMMED / CELLS)
        .enumerate()
        .map(|(chunk, cells)| {
            let cells = cells.iter_mut().enumerate();
            cells.fold([[0.0; K]; N], |total, (k, cell)| add(total, visit(chunk * CELLS + k, cell)))
        })
        .collect();
    parts.into_iter().fold([[0.0; K]; N], add)
}
