//! Sums whose bits do not depend on the number of threads.

use rayon::prelude::*;

const CHUNK: usize = 4096;

/// Inner product by fixed chunks, added in their order.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let parts: Vec<f64> =
        a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum()).collect();
    parts.iter().sum()
}
