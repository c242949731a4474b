//! What every pixel sees.

use rayon::prelude::*;

use crate::bins::TileGrid;

/// What kind of primitive a fragment shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// A segment of a strand; its index is that of its first point.
    Segment = 0,
    /// A triangle.
    Triangle = 1,
}

/// One primitive in one pixel; the fields are those of `GBuffer`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fragment {
    pub kind: Kind,
    pub primitive: u32,
    pub parameter: [f32; 2],
    pub weight: f32,
    pub depth: f32,
}

/// Fragments of all pixels, row by row, from front to back within a pixel; flat, one array a field.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GBuffer {
    /// First fragment of every pixel, and the number of fragments.
    pub pixel_offsets: Vec<i64>,
    /// `Kind` of the primitive.
    pub kind: Vec<u8>,
    /// First point of the segment, or index of the triangle.
    pub primitive: Vec<i32>,
    /// Middle of the samples that see it. Segment: position from 0 to 1 along, and -1 to 1 across, of the strand.
    /// Triangle: barycentric coordinates of the second and third corner. Right in perspective.
    pub parameter: Vec<[f32; 2]>,
    /// Share of the pixel: a multiple of 1/16 where nothing is seen through.
    pub weight: Vec<f32>,
    /// Depth as given with the vertices (linear on the screen).
    pub depth: Vec<f32>,
}

/// Fragments of one tile, pixel by pixel.
pub(crate) struct TileFragments {
    pub fragments: Vec<Fragment>,
    pub counts: Vec<u32>,
    pub width: usize,
}

impl GBuffer {
    /// The picture's fragments from those of its tiles, row by row of tiles.
    pub(crate) fn assembled(tiles: &[TileFragments], grid: TileGrid) -> Self {
        let rows: Vec<&[TileFragments]> = tiles.chunks(grid.columns).collect();
        let pixel_offsets = pixel_offsets(&rows);
        let total = pixel_offsets[pixel_offsets.len() - 1] as usize;
        let mut buffer = Self {
            pixel_offsets,
            kind: vec![0; total],
            primitive: vec![0; total],
            parameter: vec![[0.0; 2]; total],
            weight: vec![0.0; total],
            depth: vec![0.0; total],
        };
        let mut parts = Vec::with_capacity(rows.len());
        let mut rest = Part {
            kind: &mut buffer.kind,
            primitive: &mut buffer.primitive,
            parameter: &mut buffer.parameter,
            weight: &mut buffer.weight,
            depth: &mut buffer.depth,
        };
        for row in &rows {
            let (part, behind) = rest.split(row.iter().map(|tile| tile.fragments.len()).sum());
            parts.push(part);
            rest = behind;
        }
        parts.into_par_iter().zip(rows).for_each(|(mut part, row)| {
            let mut place = 0;
            for_each_row(row, |tile, _, range| {
                for fragment in &tile.fragments[range] {
                    part.put(place, fragment);
                    place += 1;
                }
            });
        });
        buffer
    }
}

fn pixel_offsets(rows: &[&[TileFragments]]) -> Vec<i64> {
    let pixels = rows.iter().flat_map(|row| row.iter()).map(|tile| tile.counts.len()).sum::<usize>();
    let mut offsets = Vec::with_capacity(pixels + 1);
    let mut end = 0;
    offsets.push(end);
    for row in rows {
        for_each_row(row, |_, counts, _| {
            offsets.extend(counts.iter().map(|count| {
                end += i64::from(*count);
                end
            }));
        });
    }
    offsets
}

/// Visits each tile's share of every row of pixels: its counts and the range of its fragments.
fn for_each_row<'a>(
    tiles: &'a [TileFragments],
    mut visit: impl FnMut(&'a TileFragments, &'a [u32], std::ops::Range<usize>),
) {
    let height = tiles.first().map_or(0, |tile| tile.counts.len() / tile.width);
    let mut read = vec![0usize; tiles.len()];
    for y in 0..height {
        for (tile, read) in tiles.iter().zip(&mut read) {
            let counts = &tile.counts[y * tile.width..(y + 1) * tile.width];
            let end = *read + counts.iter().sum::<u32>() as usize;
            visit(tile, counts, *read..end);
            *read = end;
        }
    }
}

/// A stretch of the arrays of a `GBuffer`.
struct Part<'a> {
    kind: &'a mut [u8],
    primitive: &'a mut [i32],
    parameter: &'a mut [[f32; 2]],
    weight: &'a mut [f32],
    depth: &'a mut [f32],
}

impl<'a> Part<'a> {
    fn split(self, at: usize) -> (Self, Self) {
        let (kind, primitive) = (self.kind.split_at_mut(at), self.primitive.split_at_mut(at));
        let (parameter, weight) = (self.parameter.split_at_mut(at), self.weight.split_at_mut(at));
        let depth = self.depth.split_at_mut(at);
        (
            Self { kind: kind.0, primitive: primitive.0, parameter: parameter.0, weight: weight.0, depth: depth.0 },
            Self { kind: kind.1, primitive: primitive.1, parameter: parameter.1, weight: weight.1, depth: depth.1 },
        )
    }

    fn put(&mut self, place: usize, fragment: &Fragment) {
        self.kind[place] = fragment.kind as u8;
        self.primitive[place] = fragment.primitive as i32;
        self.parameter[place] = fragment.parameter;
        self.weight[place] = fragment.weight;
        self.depth[place] = fragment.depth;
    }
}
