//! The nearest marked voxel, of every voxel.
//!
//! Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions" (2012): the lower envelope of parabolas along
//! x, then y, then z. Linear in the number of voxels; the lines of one axis are independent and run in parallel. Where
//! the distance alone is asked for, `distance` gives the same several times faster.

use rayon::prelude::*;

use crate::{FieldError, GridShape};

const FAR: f64 = 1e15;

/// Where the nearest marked cell is, a cell.
#[derive(Clone, Debug)]
pub struct Nearest {
    /// Distance in voxels from the cell's centre to that of the nearest marked cell; infinite where none is marked.
    pub distance: Vec<f32>,
    /// Number of that cell; its own where none is marked. Of several equally near, one that depends on nothing but the marks.
    pub cell: Vec<u32>,
}

/// The nearest cell where `inside` is true, of every cell.
///
/// # Errors
/// `inside` does not have `shape.len()` entries.
pub fn nearest(inside: &[bool], shape: GridShape) -> Result<Nearest, FieldError> {
    shape.expect("inside", inside.len())?;
    let mut found: Vec<Place> = inside
        .par_iter()
        .enumerate()
        .map(|(cell, &marked)| Place { squared: if marked { 0.0 } else { FAR }, cell: cell as u32 })
        .collect();
    along_rows(&mut found, shape.columns);
    found = along_strided(found, shape.layers, shape.rows, shape.columns);
    found = along_strided(found, 1, shape.layers, shape.rows * shape.columns);
    let root = |d: f64| if d >= FAR / 2.0 { f32::INFINITY } else { d.sqrt() as f32 };
    Ok(Nearest {
        distance: found.par_iter().map(|place| root(place.squared)).collect(),
        cell: found.par_iter().map(|place| place.cell).collect(),
    })
}

/// Squared distance to a cell, and its number.
#[derive(Clone, Copy)]
struct Place {
    squared: f64,
    cell: u32,
}

fn along_rows(values: &mut [Place], width: usize) {
    values.par_chunks_mut(width.max(1)).for_each_init(Envelope::default, |envelope, line| envelope.apply(line));
}

/// `values` is (outer, length, inner); every line along `length` is transformed.
fn along_strided(values: Vec<Place>, outer: usize, length: usize, inner: usize) -> Vec<Place> {
    if length < 2 {
        return values;
    }
    let lines: Vec<Vec<Place>> = (0..outer * inner)
        .into_par_iter()
        .map_init(Envelope::default, |envelope, line| {
            let start = (line / inner) * length * inner + line % inner;
            let mut buffer: Vec<Place> = (0..length).map(|i| values[start + i * inner]).collect();
            envelope.apply(&mut buffer);
            buffer
        })
        .collect();
    let mut out = values;
    out.par_chunks_mut(inner).enumerate().for_each(|(sheet, row)| {
        let (block, place) = (sheet / length, sheet % length);
        for (i, value) in row.iter_mut().enumerate() {
            *value = lines[block * inner + i][place];
        }
    });
    out
}

/// The lower envelope of parabolas: their apexes and where each takes over.
#[derive(Default)]
struct Envelope {
    apex: Vec<usize>,
    start: Vec<f64>,
    height: Vec<Place>,
}

impl Envelope {
    fn apply(&mut self, line: &mut [Place]) {
        self.build(line);
        let mut k = 0;
        for (i, value) in line.iter_mut().enumerate() {
            while k + 1 < self.apex.len() && self.start[k + 1] <= i as f64 {
                k += 1;
            }
            let step = i as f64 - self.apex[k] as f64;
            let low = self.height[k];
            *value = Place { squared: (low.squared + step * step).min(FAR), cell: low.cell };
        }
    }

    fn build(&mut self, line: &[Place]) {
        self.apex.clear();
        self.start.clear();
        self.height.clear();
        for (i, &height) in line.iter().enumerate() {
            let mut from = f64::NEG_INFINITY;
            while let (Some(&apex), Some(&low), Some(&start)) =
                (self.apex.last(), self.height.last(), self.start.last())
            {
                let (i, a) = (i as f64, apex as f64);
                from = ((height.squared + i * i) - (low.squared + a * a)) / (2.0 * (i - a));
                if from > start {
                    break;
                }
                self.apex.pop();
                self.start.pop();
                self.height.pop();
                from = f64::NEG_INFINITY;
            }
            self.apex.push(i);
            self.start.push(from);
            self.height.push(height);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_cell_is_marked_and_as_far_as_said() {
        let shape = GridShape { layers: 6, rows: 8, columns: 7 };
        let inside: Vec<bool> = (0..shape.len()).map(|cell| cell * 37 % 23 == 0).collect();
        let found = nearest(&inside, shape).expect("fits");
        for cell in 0..shape.len() {
            let near = found.cell[cell] as usize;
            let (from, to) = (shape.place(cell), shape.place(near));
            let squared: f64 = (0..3).map(|k| (from[k] as f64 - to[k] as f64).powi(2)).sum();
            assert!(inside[near] && (squared.sqrt() - f64::from(found.distance[cell])).abs() < 1e-5);
        }
    }

    #[test]
    fn where_nothing_is_marked_a_cell_is_its_own_nearest() {
        let found = nearest(&[false; 8], GridShape { layers: 2, rows: 2, columns: 2 }).expect("fits");
        assert!(found.distance.iter().all(|d| d.is_infinite()) && found.cell == [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
