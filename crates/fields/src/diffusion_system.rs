//! The screened Poisson equation over marked cells, and its solution by conjugate gradients.

use rayon::prelude::*;

use crate::GridShape;
use crate::diffuse::DiffuseOptions;
use crate::sums::{SUMMED, sums};

const NONE: u32 = u32::MAX;

/// The matrix: weights and links of the cells that are free, and which of their neighbours are fixed.
pub(crate) struct System {
    /// Number in the box of every free cell.
    pub(crate) cells: Vec<u32>,
    links: Vec<[u32; 6]>,
    fixed: Vec<[u32; 6]>,
    diagonal: Vec<f64>,
}

/// What `System::solve` found.
pub(crate) struct Solved {
    /// `channels` values a free cell.
    pub(crate) values: Vec<f64>,
    pub(crate) iterations: usize,
    pub(crate) converged: bool,
}

impl System {
    pub(crate) fn new(mask: &[bool], weights: &[f64], shape: GridShape) -> Self {
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

    /// Solves for `channels` values a cell, from `start` where it is not empty; both, and `values`, over the whole box.
    ///
    /// Numbers of channels that do not occur often are solved one by one.
    pub(crate) fn solve(
        &self,
        weights: &[f64],
        values: &[f64],
        start: &[f64],
        channels: usize,
        options: DiffuseOptions,
    ) -> Solved {
        match channels {
            1 => self.solve_in_step::<1>(weights, values, start, options),
            9 => self.solve_in_step::<9>(weights, values, start, options),
            _ => self.solve_one_by_one(weights, values, start, channels, options),
        }
    }

    fn solve_one_by_one(
        &self,
        weights: &[f64],
        values: &[f64],
        start: &[f64],
        channels: usize,
        options: DiffuseOptions,
    ) -> Solved {
        let channel = |all: &[f64], k: usize| -> Vec<f64> { all.iter().skip(k).step_by(channels).copied().collect() };
        let mut all = Solved { values: vec![0.0; self.cells.len() * channels], iterations: 0, converged: true };
        for k in 0..channels {
            let one = self.solve_in_step::<1>(weights, &channel(values, k), &channel(start, k), options);
            all.values.iter_mut().skip(k).step_by(channels).zip(one.values).for_each(|(all, one)| *all = one);
            all.iterations = all.iterations.max(one.iterations);
            all.converged &= one.converged;
        }
        all
    }

    /// `K` channels, each with its own step lengths: a neighbour's values are fetched once for all of them. A step passes
    /// over the cells three times, and adds up on the way.
    fn solve_in_step<const K: usize>(
        &self,
        weights: &[f64],
        values: &[f64],
        start: &[f64],
        options: DiffuseOptions,
    ) -> Solved {
        let mut cells = self.begun::<K>(weights, values.as_chunks().0, start.as_chunks().0);
        let mut p: Vec<[f64; K]> = cells.iter().enumerate().map(|(row, cell)| self.scaled(row, &cell.r)).collect();
        let [bb, mut rr, mut rz] = sums(&mut cells, |row, cell| {
            [product(&cell.b, &cell.b), product(&cell.r, &cell.r), product(&cell.r, &p[row])]
        });
        let reached = |rr: &[f64; K]| rr.iter().zip(&bb).all(|(rr, bb)| rr.sqrt() <= options.accuracy * bb.sqrt());
        let mut iterations = 0;
        while iterations < options.max_iterations && !reached(&rr) {
            let [curvature] = sums(&mut cells, |row, cell| {
                cell.image = self.row_times(row, |n| &p[n]);
                [product(&p[row], &cell.image)]
            });
            let step = ratios(&rz, &curvature);
            let [squared, next] = sums(&mut cells, |row, cell| {
                for k in 0..K {
                    cell.x[k] += step[k] * p[row][k];
                    cell.r[k] -= step[k] * cell.image[k];
                }
                [product(&cell.r, &cell.r), product(&cell.r, &self.scaled(row, &cell.r))]
            });
            let turn = ratios(&next, &rz);
            (rr, rz) = (squared, next);
            p.par_iter_mut().zip(&cells).with_min_len(SUMMED).enumerate().for_each(|(row, (p, cell))| {
                let z = self.scaled(row, &cell.r);
                (0..K).for_each(|k| p[k] = z[k] + turn[k] * p[k]);
            });
            iterations += 1;
        }
        Solved { converged: reached(&rr), values: cells.iter().flat_map(|cell| cell.x).collect(), iterations }
    }

    /// Every cell with its right-hand side, and the residual of where it starts.
    fn begun<const K: usize>(&self, weights: &[f64], values: &[[f64; K]], start: &[[f64; K]]) -> Vec<Cell<K>> {
        let rows = (0..self.cells.len()).into_par_iter().with_min_len(SUMMED);
        let first = |n: usize| &start[self.cells[n] as usize];
        rows.map(|row| {
            let b = self.right_side(row, weights, values);
            if start.is_empty() {
                return Cell { b, r: b, x: [0.0; K], image: [0.0; K] };
            }
            let image = self.row_times(row, first);
            Cell { b, r: std::array::from_fn(|k| b[k] - image[k]), x: *first(row), image }
        })
        .collect()
    }

    fn right_side<const K: usize>(&self, row: usize, weights: &[f64], values: &[[f64; K]]) -> [f64; K] {
        let mut b = [0.0; K];
        let mut add = |cell: usize, weight: f64| (0..K).for_each(|k| b[k] += weight * values[cell][k]);
        let cell = self.cells[row] as usize;
        if weights[cell] > 0.0 {
            add(cell, weights[cell]);
        }
        self.fixed[row].iter().filter(|&&n| n != NONE).for_each(|&n| add(n as usize, 1.0));
        b
    }

    /// A row of the matrix times the vector whose rows `x` gives.
    #[inline]
    fn row_times<'a, const K: usize>(&self, row: usize, x: impl Fn(usize) -> &'a [f64; K]) -> [f64; K] {
        let mut out = x(row).map(|own| self.diagonal[row] * own);
        for &n in self.links[row].iter().filter(|&&n| n != NONE) {
            let near = x(n as usize);
            (0..K).for_each(|k| out[k] -= near[k]);
        }
        out
    }

    /// `r` over the diagonal; zero where a cell has neither weight nor neighbours.
    #[inline]
    fn scaled<const K: usize>(&self, row: usize, r: &[f64; K]) -> [f64; K] {
        let factor = if self.diagonal[row] > 0.0 { 1.0 / self.diagonal[row] } else { 0.0 };
        r.map(|r| factor * r)
    }
}

/// A free cell's right-hand side, residual, value, and the matrix times the search direction.
struct Cell<const K: usize> {
    b: [f64; K],
    r: [f64; K],
    x: [f64; K],
    image: [f64; K],
}

#[inline]
fn product<const K: usize>(a: &[f64; K], b: &[f64; K]) -> [f64; K] {
    std::array::from_fn(|k| a[k] * b[k])
}

fn ratios<const K: usize>(a: &[f64; K], b: &[f64; K]) -> [f64; K] {
    std::array::from_fn(|k| if b[k] > 0.0 { a[k] / b[k] } else { 0.0 })
}
