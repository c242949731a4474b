//! Incomplete Cholesky factor with a threshold, by columns, as a preconditioner.
//!
//! Left-looking: column j is the matrix's column less what the columns before it that reach row j take away; small entries
//! are dropped as soon as the column is done. Fill is kept where it is large, which is what couples pixels along a hair; a
//! factor without fill needs three times the iterations. A pivot that is not positive begins the factor again with a
//! larger shift of the diagonal.
//!
//! Long systems are cut into blocks of consecutive rows that are factored and solved at once; what couples the blocks is
//! left to the iteration. The number of blocks depends on the rows alone, not on the threads.

use std::ops::Range;

use rayon::prelude::*;
use thiserror::Error;

use crate::sparse_cg::SparseSymmetric;

const SHIFTS: [f64; 6] = [0.0, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
const NONE: u32 = u32::MAX;
const ROWS_PER_BLOCK: usize = 20_000;

/// No shift of the diagonal made all pivots positive.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("the matrix has no incomplete Cholesky factor; is it positive definite?")]
pub struct BreakdownError;

/// Incomplete factors of the blocks on a matrix's diagonal.
#[derive(Debug)]
pub struct BlockCholesky {
    blocks: Vec<IncompleteCholesky>,
    starts: Vec<usize>,
}

impl BlockCholesky {
    /// The factors of `matrix`, entries below `drop` times the root of their two diagonals left out.
    pub fn of(matrix: &SparseSymmetric, drop: f64) -> Result<Self, BreakdownError> {
        let count = (matrix.len() / ROWS_PER_BLOCK).max(1);
        let starts: Vec<usize> = (0..=count).map(|k| k * matrix.len() / count).collect();
        let blocks: Result<_, _> = (0..count)
            .into_par_iter()
            .map(|k| IncompleteCholesky::of(matrix, starts[k]..starts[k + 1], drop))
            .collect();
        Ok(Self { blocks: blocks?, starts })
    }

    /// Writes the solution z of (blocks of L Lᵀ) z = `r` into `z`.
    pub fn solve(&self, r: &[f64], z: &mut [f64]) {
        z.copy_from_slice(r);
        let mut rest = z;
        let mut parts = Vec::with_capacity(self.blocks.len());
        for pair in self.starts.windows(2) {
            let (part, after) = rest.split_at_mut(pair[1] - pair[0]);
            parts.push(part);
            rest = after;
        }
        self.blocks.par_iter().zip(parts).for_each(|(block, part)| block.solve(part));
    }
}

/// A lower triangular L with L Lᵀ near the matrix: the diagonal, and below it columns with ascending rows.
#[derive(Debug)]
struct IncompleteCholesky {
    inverse_diagonal: Vec<f64>,
    offsets: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl IncompleteCholesky {
    /// The factor of the block of `matrix` in `range` of rows and columns.
    fn of(matrix: &SparseSymmetric, range: Range<usize>, drop: f64) -> Result<Self, BreakdownError> {
        SHIFTS.iter().find_map(|&shift| Self::shifted(matrix, range.clone(), drop, shift)).ok_or(BreakdownError)
    }

    fn shifted(matrix: &SparseSymmetric, range: Range<usize>, drop: f64, shift: f64) -> Option<Self> {
        let count = range.len();
        let diagonal: Vec<f64> =
            range.clone().map(|i| matrix.row(i).find(|&(j, _)| j == i).map_or(0.0, |(_, v)| v)).collect();
        let mut factor = Self {
            inverse_diagonal: vec![0.0; count],
            offsets: vec![0],
            rows: Vec::with_capacity(16 * count),
            values: Vec::with_capacity(16 * count),
        };
        let mut reaching = ColumnLists::new(count);
        let mut column = SparseColumn::new(count);
        for j in 0..count {
            let mut pivot = diagonal[j] * (1.0 + shift);
            let row = matrix.row(range.start + j);
            for (i, value) in row.filter(|&(i, _)| i > range.start + j && i < range.end) {
                column.add(i - range.start, value);
            }
            reaching.visit(j, &factor.offsets, &factor.rows, |entry, end| {
                let at_j = factor.values[entry];
                pivot -= at_j * at_j;
                for k in entry + 1..end {
                    column.add(factor.rows[k] as usize, -at_j * factor.values[k]);
                }
            });
            if pivot.is_nan() || pivot <= 1e-12 * diagonal[j] {
                return None;
            }
            let inverse = 1.0 / pivot.sqrt();
            factor.inverse_diagonal[j] = inverse;
            let least = drop * drop * diagonal[j];
            column.drain_sorted(|i, value| {
                if value * value > least * diagonal[i] {
                    factor.rows.push(i as u32);
                    factor.values.push(value * inverse);
                }
            });
            factor.offsets.push(factor.rows.len());
            reaching.enter(j, factor.offsets[j], &factor.offsets, &factor.rows);
        }
        Some(factor)
    }

    /// Puts the solution z of L Lᵀ z = r in the place of r.
    fn solve(&self, z: &mut [f64]) {
        for j in 0..z.len() {
            let value = z[j] * self.inverse_diagonal[j];
            z[j] = value;
            for k in self.offsets[j]..self.offsets[j + 1] {
                z[self.rows[k] as usize] -= self.values[k] * value;
            }
        }
        for j in (0..z.len()).rev() {
            let below: f64 =
                (self.offsets[j]..self.offsets[j + 1]).map(|k| self.values[k] * z[self.rows[k] as usize]).sum();
            z[j] = (z[j] - below) * self.inverse_diagonal[j];
        }
    }
}

/// For every row, the finished columns whose next unused entry lies in it, as linked lists.
struct ColumnLists {
    head: Vec<u32>,
    next: Vec<u32>,
    cursor: Vec<usize>,
}

impl ColumnLists {
    fn new(count: usize) -> Self {
        Self { head: vec![NONE; count], next: vec![NONE; count], cursor: vec![0; count] }
    }

    /// Calls `take(entry, end)` for every column that reaches `row`, then moves each on to its next row.
    fn visit(&mut self, row: usize, offsets: &[usize], rows: &[u32], mut take: impl FnMut(usize, usize)) {
        let mut column = self.head[row];
        while column != NONE {
            let k = column as usize;
            let following = self.next[k];
            take(self.cursor[k], offsets[k + 1]);
            self.enter(k, self.cursor[k] + 1, offsets, rows);
            column = following;
        }
    }

    fn enter(&mut self, column: usize, entry: usize, offsets: &[usize], rows: &[u32]) {
        self.cursor[column] = entry;
        if entry < offsets[column + 1] {
            let row = rows[entry] as usize;
            self.next[column] = self.head[row];
            self.head[row] = column as u32;
        }
    }
}

/// One column under construction: values by row, and which rows are in use.
struct SparseColumn {
    value: Vec<f64>,
    used: Vec<bool>,
    rows: Vec<u32>,
}

impl SparseColumn {
    fn new(count: usize) -> Self {
        Self { value: vec![0.0; count], used: vec![false; count], rows: Vec::new() }
    }

    fn add(&mut self, row: usize, value: f64) {
        if !self.used[row] {
            self.used[row] = true;
            self.rows.push(row as u32);
        }
        self.value[row] += value;
    }

    fn drain_sorted(&mut self, mut take: impl FnMut(usize, f64)) {
        self.rows.sort_unstable();
        for row in self.rows.drain(..) {
            let row = row as usize;
            take(row, self.value[row]);
            self.value[row] = 0.0;
            self.used[row] = false;
        }
    }
}
