//! Which tiles a primitive may touch: counting sort, chunk by chunk.
//!
//! Each chunk of primitives is sorted by tile on its own core; a tile later reads its share of every chunk. Nothing is
//! shared while writing, and the order within a tile does not matter, since tiles order what they read.

use rayon::prelude::*;

/// Side of a tile in pixels.
pub(crate) const TILE: usize = 32;

const CHUNK: usize = 1 << 16;

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
    pub fn overlapping(&self, min: [f32; 2], max: [f32; 2]) -> [std::ops::Range<usize>; 2] {
        let range = |low: f32, high: f32, count: usize| {
            let side = TILE as f32;
            let first = (low / side).max(0.0) as usize;
            let end = (high / side + 1.0).max(0.0) as usize;
            first.min(count)..end.min(count)
        };
        [range(min[0], max[0], self.columns), range(min[1], max[1], self.rows)]
    }
}

/// Primitives of every tile.
pub(crate) struct Bins {
    chunks: Vec<Chunk>,
}

struct Chunk {
    first_of_tile: Vec<u32>,
    primitives: Vec<u32>,
}

impl Bins {
    /// Sorts primitives `0..count`; `touch` calls its second argument with every tile that the primitive may touch.
    pub fn new(grid: TileGrid, count: usize, touch: impl Fn(usize, &mut dyn FnMut(usize)) + Sync) -> Self {
        let chunks = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| Chunk::new(grid, chunk * CHUNK..((chunk + 1) * CHUNK).min(count), &touch))
            .collect();
        Self { chunks }
    }

    /// Primitives of one tile.
    pub fn of_tile(&self, tile: usize) -> impl Iterator<Item = u32> + '_ {
        self.chunks.iter().flat_map(move |chunk| {
            chunk.primitives[chunk.first_of_tile[tile] as usize..chunk.first_of_tile[tile + 1] as usize].iter().copied()
        })
    }
}

impl Chunk {
    fn new(grid: TileGrid, range: std::ops::Range<usize>, touch: &impl Fn(usize, &mut dyn FnMut(usize))) -> Self {
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(range.len() * 2);
        for primitive in range {
            touch(primitive, &mut |tile| pairs.push((tile as u32, primitive as u32)));
        }
        let mut first_of_tile = vec![0u32; grid.count() + 1];
        for &(tile, _) in &pairs {
            first_of_tile[tile as usize + 1] += 1;
        }
        for tile in 0..grid.count() {
            first_of_tile[tile + 1] += first_of_tile[tile];
        }
        let mut next = first_of_tile.clone();
        let mut primitives = vec![0u32; pairs.len()];
        for &(tile, primitive) in &pairs {
            primitives[next[tile as usize] as usize] = primitive;
            next[tile as usize] += 1;
        }
        Self { first_of_tile, primitives }
    }
}
