//! Sums whose bits do not depend on the number of threads.

use rayon::prelude::*;

const CHUNK: usize = 4096;
/// Fewest chunks that are worth a thread of their own.
const CHUNKS: usize = 8;

/// Inner product by fixed chunks, added in their order.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let parts: Vec<f64> =
        a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum()).collect();
    parts.iter().sum()
}

/// Inner products of every channel, `channels` values a row.
pub(crate) fn dots(a: &[f64], b: &[f64], channels: usize) -> Vec<f64> {
    let size = CHUNK / 4 * channels;
    let parts: Vec<Vec<f64>> = a
        .par_chunks(size)
        .zip(b.par_chunks(size))
        .with_min_len(CHUNKS)
        .map(|(a, b)| {
            let mut sums = vec![0.0; channels];
            for (a, b) in a.chunks_exact(channels).zip(b.chunks_exact(channels)) {
                for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
                    *sum += a * b;
                }
            }
            sums
        })
        .collect();
    let mut total = vec![0.0; channels];
    for part in &parts {
        for (total, part) in total.iter_mut().zip(part) {
            *total += part;
        }
    }
    total
}
