//! How many intervals along u and v a number of cells is best spent on.

use glam::DVec3;

use super::Surface;
use super::batch::samples;
use super::flatness::distance_to_segment;

/// Samples along and across that stand for the surface while budgets are compared.
const SAMPLES: [usize; 2] = [48, 9];
/// A gain below this share of the error of a single cell is none.
const NEGLIGIBLE: f64 = 1e-6;
/// Nor is one of this many metres, which is rounding.
const ROUNDING_M: f64 = 1e-12;

impl Surface {
    /// The numbers of equal intervals along u and v, with at most `cells` cells, that follow the surface most closely;
    /// of equally good ones the fewest.
    pub fn segments_within(&self, cells: usize) -> [usize; 2] {
        let (error_u, error_v) = (self.chord_errors(cells, true), self.chord_errors(cells, false));
        let slack = NEGLIGIBLE * (error_u[0] + error_v[0]) + ROUNDING_M;
        let mut best = ([1, 1], f64::INFINITY);
        for rows in 1..=cells {
            let columns = fewest(&error_v[..cells / rows], slack);
            let error = error_u[rows - 1] + error_v[columns - 1];
            if error < best.1 - slack {
                best = ([rows, columns], error);
            }
        }
        best.0
    }

    /// How far the surface's lines along u (or v) lie from 1, 2, … `most` chords each.
    fn chord_errors(&self, most: usize, along_u: bool) -> Vec<f64> {
        let [fine, coarse] = SAMPLES;
        let errors = |count: usize| {
            let inner = fine.div_ceil(count);
            let (along, across) = (fractions(count * inner), fractions(coarse - 1));
            let lines = self.lines(&along, &across, along_u);
            lines.chunks_exact(along.len()).map(|line| chord_error(line, inner)).fold(0.0, f64::max)
        };
        (1..=most).map(errors).collect()
    }

    /// Points on lines along u (or v), line by line.
    fn lines(&self, along: &[f64], across: &[f64], along_u: bool) -> Vec<DVec3> {
        let (u, v) = if along_u { (along, across) } else { (across, along) };
        let mut grid = vec![[0.0; 3]; u.len() * v.len()];
        self.grid(&samples(self.u(), u), &samples(self.v(), v), &mut grid);
        let at = |i: usize, j: usize| DVec3::from_array(grid[i * v.len() + j]);
        let line = |k: usize| (0..along.len()).map(move |i| if along_u { (i, k) } else { (k, i) });
        (0..across.len()).flat_map(line).map(|(i, j)| at(i, j)).collect()
    }
}

/// The first place of a number within `slack` of the least, counted from 1.
fn fewest(errors: &[f64], slack: f64) -> usize {
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    errors.iter().position(|&e| e <= least + slack).map_or(1, |i| i + 1)
}

fn chord_error(line: &[DVec3], inner: usize) -> f64 {
    let chord = |first: usize| {
        let ends = [line[first], line[first + inner]];
        line[first..first + inner].iter().map(|&p| distance_to_segment(p, ends)).fold(0.0, f64::max)
    };
    (0..line.len() - 1).step_by(inner).map(chord).fold(0.0, f64::max)
}

fn fractions(count: usize) -> Vec<f64> {
    (0..=count).map(|i| i as f64 / count as f64).collect()
}
