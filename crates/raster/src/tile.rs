//! The samples of one tile.

use crate::bins::TILE;
use crate::samples::{Lane, SAMPLES, larger, largest};

/// No primitive.
pub(crate) const EMPTY: u32 = u32::MAX;
/// Set in the index of a triangle, clear in that of a segment.
pub(crate) const TRIANGLE_BIT: u32 = 1 << 31;

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
        }
    }

    /// Empties the tile for another place of the picture.
    pub fn begin(&mut self, column: usize, row: usize, width: usize, height: usize) {
        let (x, y) = (column * TILE, row * TILE);
        self.origin = [x as i32, y as i32];
        self.size = [TILE.min(width - x) as i32, TILE.min(height - y) as i32];
        self.depth.fill([f32::INFINITY; SAMPLES]);
        self.primitive.fill([EMPTY; SAMPLES]);
        self.farthest.fill(f32::NEG_INFINITY);
        for row in self.farthest.chunks_exact_mut(TILE).take(self.size[1] as usize) {
            row[..self.size[0] as usize].fill(f32::INFINITY);
        }
    }

    /// Depth behind which the whole tile is closed.
    pub fn farthest_of_all(&self) -> f32 {
        self.farthest.as_chunks().0.iter().map(largest).fold(f32::NEG_INFINITY, larger)
    }

    /// Pixel columns (or rows, `axis` 1) of the tile, relative to its origin, that overlap an interval of the picture.
    pub fn clip(&self, axis: usize, low: f32, high: f32) -> std::ops::Range<i32> {
        let origin = self.origin[axis] as f32;
        // Truncation is the floor of what is not negative, and needs no call.
        let first = larger(low - origin, 0.0) as i32;
        let end = larger(high - origin + 1.0, 0.0) as i32;
        first..end.min(self.size[axis])
    }
}
