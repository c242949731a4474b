//! The samples of one tile.

use crate::bins::{Rectangle, TILE};
use crate::samples::{Lane, SAMPLES, larger};

/// No primitive.
pub(crate) const EMPTY: u32 = u32::MAX;
/// Set in the index of a triangle, clear in that of a segment.
pub(crate) const TRIANGLE_BIT: u32 = 1 << 31;

/// Side of a block in pixels.
const BLOCK: usize = 8;
const BLOCKS: usize = TILE / BLOCK;

/// Pixel columns and rows of a tile, relative to its origin.
pub(crate) type Pixels = [std::ops::Range<i32>; 2];

/// Depth and primitive of every sample, and the farthest depth of every pixel.
pub(crate) struct Tile {
    /// Pixel of the picture at the tile's upper left.
    pub origin: [i32; 2],
    /// Pixels inside the picture.
    pub size: [i32; 2],
    pub depth: Vec<Lane>,
    pub primitive: Vec<[u32; SAMPLES]>,
    /// Depth behind which a pixel is closed; outside the picture, everything is.
    pub farthest: Vec<f32>,
    /// The farthest of all pixels of every block, as of the last look.
    blocks: [[f32; BLOCKS]; BLOCKS],
}

impl Tile {
    pub fn new() -> Self {
        let pixels = TILE * TILE;
        Self {
            origin: [0; 2],
            size: [0; 2],
            depth: vec![[f32::INFINITY; SAMPLES]; pixels],
            primitive: vec![[EMPTY; SAMPLES]; pixels],
            farthest: vec![f32::INFINITY; pixels],
            blocks: [[f32::INFINITY; BLOCKS]; BLOCKS],
        }
    }

    /// Moves the tile to a place of the picture, of which it may cover less than it could; returns how much.
    pub fn place(&mut self, column: usize, row: usize, width: usize, height: usize) -> [usize; 2] {
        let (x, y) = (column * TILE, row * TILE);
        let size = [TILE.min(width - x), TILE.min(height - y)];
        self.origin = [x as i32, y as i32];
        self.size = size.map(|side| side as i32);
        size
    }

    /// Empties the tile.
    pub fn clear(&mut self) {
        self.depth.fill([f32::INFINITY; SAMPLES]);
        self.primitive.fill([EMPTY; SAMPLES]);
        self.farthest.fill(f32::NEG_INFINITY);
        for row in self.farthest.chunks_exact_mut(TILE).take(self.size[1] as usize) {
            row[..self.size[0] as usize].fill(f32::INFINITY);
        }
    }

    /// Looks again how far one can see; returns the depth behind which the whole tile is closed.
    #[inline(always)]
    pub fn look(&mut self) -> f32 {
        let mut farthest_of_all = f32::NEG_INFINITY;
        for (blocks, rows) in self.blocks.iter_mut().zip(self.farthest.as_chunks::<{ BLOCK * TILE }>().0) {
            let mut most = [f32::NEG_INFINITY; TILE];
            for row in rows.as_chunks::<TILE>().0 {
                (0..TILE).for_each(|i| most[i] = larger(most[i], row[i]));
            }
            for (block, columns) in blocks.iter_mut().zip(most.as_chunks::<BLOCK>().0) {
                *block = columns.iter().copied().reduce(larger).unwrap_or(f32::NEG_INFINITY);
                farthest_of_all = larger(farthest_of_all, *block);
            }
        }
        farthest_of_all
    }

    /// The pixels in a rectangle of the picture; None where it is known that all are closed at the depth `nearest`.
    #[inline(always)]
    pub fn open_pixels(&self, Rectangle { min, max }: Rectangle, nearest: f32) -> Option<Pixels> {
        let [columns, rows] = [self.clip(0, min[0], max[0]), self.clip(1, min[1], max[1])];
        let block = |pixel: i32| pixel as usize / BLOCK;
        let open = !columns.is_empty()
            && !rows.is_empty()
            && self.blocks[block(rows.start)..=block(rows.end - 1)].iter().any(|row| {
                row[block(columns.start)..=block(columns.end - 1)].iter().any(|&farthest| nearest < farthest)
            });
        open.then_some([columns, rows])
    }

    /// Pixel columns (or rows, `axis` 1) of the tile, relative to its origin, that overlap an interval of the picture.
    #[inline(always)]
    pub fn clip(&self, axis: usize, low: f32, high: f32) -> std::ops::Range<i32> {
        let origin = self.origin[axis] as f32;
        // Truncation is the floor of what is not negative, and needs no call.
        let first = larger(low - origin, 0.0) as i32;
        let end = larger(high - origin + 1.0, 0.0) as i32;
        first..end.min(self.size[axis])
    }
}
