//! Which tiles a primitive may touch: counting sort, chunk by chunk.
//!
//! Each chunk of primitives is sorted by tile on its own core; a tile later reads its share of every chunk. Nothing is
//! shared while writing, and the order within a tile does not matter, since tiles order what they read.

use rayon::prelude::*;

/// Side of a tile in pixels.
pub(crate) const TILE: usize = 32;

const CHUNK: usize = 1 << 16;

/// Part of the picture, in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rectangle {
    pub min: [f32; 2],
    pub max: [f32; 2],
}

/// The tiles of a picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TileGrid {
    pub columns: usize,
    pub rows: usize,
}

impl TileGrid {
    pub fn new(width: usize, height: usize) -> Self {
        Self { columns: width.div_ceil(TILE), rows: height.div_ceil(TILE) }
    }

    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Tiles that overlap a rectangle in pixels: columns, rows; empty when it lies outside or is not a number.
    pub fn overlapping(&self, Rectangle { min, max }: Rectangle) -> [std::ops::Range<usize>; 2] {
        let range = |low: f32, high: f32, count: usize| {
            let side = TILE as f32;
            let first = (low / side).max(0.0) as usize;
            let end = (high / side + 1.0).max(0.0) as usize;
            first.min(count)..end.min(count)
        };
        [range(min[0], max[0], self.columns), range(min[1], max[1], self.rows)]
    }
}

/// Primitives of every tile, each with a key to sort by: `key << 32 | primitive`.
pub(crate) struct Bins {
    chunks: Vec<Chunk>,
}

struct Chunk {
    first_of_tile: Vec<u32>,
    entries: Vec<u64>,
}

impl Bins {
    /// Sorts primitives `0..count` by the tiles that they may touch; `place` gives the rectangle of a primitive in pixels
    /// and its key, or None where it is not drawn.
    pub fn new(grid: TileGrid, count: usize, place: impl Fn(usize) -> Option<(Rectangle, u32)> + Sync) -> Self {
        let chunks = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| Chunk::new(grid, chunk * CHUNK..((chunk + 1) * CHUNK).min(count), &place))
            .collect();
        Self { chunks }
    }

    /// Primitives of one tile with their keys, in no order that matters.
    pub fn of_tile(&self, tile: usize) -> impl Iterator<Item = u64> + '_ {
        self.chunks.iter().flat_map(move |chunk| chunk.of_tile(tile).iter().copied())
    }
}

impl Chunk {
    fn new(grid: TileGrid, range: std::ops::Range<usize>, place: &impl Fn(usize) -> Option<(Rectangle, u32)>) -> Self {
        let mut pairs: Vec<(u32, u64)> = Vec::with_capacity(range.len() * 2);
        let mut first_of_tile = vec![0u32; grid.count() + 1];
        for primitive in range {
            let Some((rectangle, key)) = place(primitive) else { continue };
            let [columns, rows] = grid.overlapping(rectangle);
            for row in rows {
                for tile in row * grid.columns + columns.start..row * grid.columns + columns.end {
                    pairs.push((tile as u32, u64::from(key) << 32 | primitive as u64));
                    first_of_tile[tile + 1] += 1;
                }
            }
        }
        for tile in 0..grid.count() {
            first_of_tile[tile + 1] += first_of_tile[tile];
        }
        let mut next = first_of_tile.clone();
        let mut entries = vec![0u64; pairs.len()];
        for &(tile, entry) in &pairs {
            let place = &mut next[tile as usize];
            entries[*place as usize] = entry;
            *place += 1;
        }
        Self { first_of_tile, entries }
    }

    fn of_tile(&self, tile: usize) -> &[u64] {
        &self.entries[self.first_of_tile[tile] as usize..self.first_of_tile[tile + 1] as usize]
    }
}
