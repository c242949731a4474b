//! The matting Laplacian over the unknown pixels of a trimap (Levin et al. 2008, eq. 12), 3 x 3 windows.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::matting::is_known;
use crate::sparse_cg::SparseSymmetric;

const NOT_UNKNOWN: u32 = u32::MAX;
const WINDOW: f64 = 9.0;
/// Pixels that share a window with a pixel: 5 x 5 around it.
const REACH: usize = 5;

/// The unknown pixels of a trimap, numbered in scan order.
pub(crate) struct Domain {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Pixel of every unknown.
    pub(crate) pixels: Vec<usize>,
    number: Vec<u32>,
}

impl Domain {
    pub(crate) fn new(trimap: &[u8], width: usize, height: usize) -> Self {
        let pixels: Vec<usize> = (0..trimap.len()).filter(|&p| !is_known(trimap[p])).collect();
        let mut number = vec![NOT_UNKNOWN; trimap.len()];
        for (k, &pixel) in pixels.iter().enumerate() {
            number[pixel] = k as u32;
        }
        Self { width, height, pixels, number }
    }

    /// Centres of the windows that hold the pixel: one row and column away at most, and not on the picture's rim.
    fn windows(&self, pixel: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (x, y) = (pixel % self.width, pixel / self.width);
        let columns = x.saturating_sub(1).max(1)..(x + 2).min(self.width - 1);
        let rows = y.saturating_sub(1).max(1)..(y + 2).min(self.height - 1);
        rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
    }
}

/// The equations of alpha at the unknown pixels: `matrix` alpha = `right_side`.
pub(crate) struct MattingSystem {
    pub(crate) matrix: SparseSymmetric,
    pub(crate) right_side: Vec<f64>,
}

/// Mean colour and inverse covariance of a window.
#[derive(Clone, Copy)]
struct Window {
    mean: DVec3,
    inverse: DMat3,
}

impl MattingSystem {
    /// `alpha` holds the known values (its unknown ones are not read); `epsilon` is added to every window's variance.
    pub(crate) fn assemble(color: &[[f64; 3]], alpha: &[f64], domain: &Domain, epsilon: f64) -> Self {
        let windows = WindowTable::of(color, domain, epsilon);
        let rows: Vec<[f64; REACH * REACH]> =
            domain.pixels.par_iter().map(|&pixel| windows.row(color, domain, pixel)).collect();
        let mut offsets = vec![0];
        let (mut columns, mut values, mut right_side) = (Vec::new(), Vec::new(), Vec::with_capacity(rows.len()));
        for (&pixel, row) in domain.pixels.iter().zip(&rows) {
            let mut known = 0.0;
            for (neighbour, value) in neighbours(domain, pixel, row) {
                if domain.number[neighbour] == NOT_UNKNOWN {
                    known -= value * alpha[neighbour];
                } else {
                    columns.push(domain.number[neighbour]);
                    values.push(value);
                }
            }
            offsets.push(columns.len());
            right_side.push(known);
        }
        Self { matrix: SparseSymmetric { offsets, columns, values }, right_side }
    }
}

/// Pixels around `pixel` and their entries, in scan order; entries that are exactly zero are left out.
fn neighbours<'a>(
    domain: &'a Domain,
    pixel: usize,
    row: &'a [f64; REACH * REACH],
) -> impl Iterator<Item = (usize, f64)> + 'a {
    let (x, y) = (pixel % domain.width, pixel / domain.width);
    row.iter().enumerate().filter(|(_, value)| **value != 0.0).map(move |(k, &value)| {
        let (column, line) = (x + k % REACH - 2, y + k / REACH - 2);
        (line * domain.width + column, value)
    })
}

/// The windows that hold an unknown pixel.
struct WindowTable {
    number: Vec<u32>,
    windows: Vec<Window>,
}

impl WindowTable {
    fn of(color: &[[f64; 3]], domain: &Domain, epsilon: f64) -> Self {
        let mut number = vec![NOT_UNKNOWN; domain.width * domain.height];
        let mut centers = Vec::new();
        for &pixel in &domain.pixels {
            for (column, row) in domain.windows(pixel) {
                let center = row * domain.width + column;
                if number[center] == NOT_UNKNOWN {
                    number[center] = centers.len() as u32;
                    centers.push(center);
                }
            }
        }
        let windows = centers.par_iter().map(|&center| window(color, domain.width, center, epsilon)).collect();
        Self { number, windows }
    }

    /// Entries of the Laplacian between `pixel` and the 5 x 5 pixels around it.
    fn row(&self, color: &[[f64; 3]], domain: &Domain, pixel: usize) -> [f64; REACH * REACH] {
        let (x, y) = (pixel % domain.width, pixel / domain.width);
        let here = DVec3::from_array(color[pixel]);
        let mut row = [0.0; REACH * REACH];
        for (column, line) in domain.windows(pixel) {
            let window = &self.windows[self.number[line * domain.width + column] as usize];
            let lever = window.inverse * (here - window.mean);
            for k in 0..9 {
                let (i, j) = (column + k % 3 - 1, line + k / 3 - 1);
                let there = DVec3::from_array(color[j * domain.width + i]);
                row[(j + 2 - y) * REACH + (i + 2 - x)] -= (1.0 + lever.dot(there - window.mean)) / WINDOW;
            }
            row[REACH * REACH / 2] += 1.0;
        }
        row
    }
}

fn window(color: &[[f64; 3]], width: usize, center: usize, epsilon: f64) -> Window {
    let pixels: [DVec3; 9] =
        std::array::from_fn(|k| DVec3::from_array(color[center + (k / 3) * width + k % 3 - width - 1]));
    let mean = pixels.iter().sum::<DVec3>() / WINDOW;
    let mut covariance = DMat3::from_diagonal(DVec3::splat(epsilon / WINDOW));
    for pixel in pixels {
        let away = pixel - mean;
        covariance += DMat3::from_cols(away * away.x, away * away.y, away * away.z) * (1.0 / WINDOW);
    }
    Window { mean, inverse: covariance.inverse() }
}
