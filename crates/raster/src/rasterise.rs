//! The whole picture: tiles in parallel, then one list of fragments.

use rayon::prelude::*;

use crate::bins::{Bins, TileGrid};
use crate::gbuffer::{Fragment, GBuffer};
use crate::resolve::Resolver;
use crate::samples::{OpacityOrders, Pattern};
use crate::segment::{self, Segment};
use crate::strand_points::{StrandPoint, strand_points};
use crate::tile::Tile;
use crate::triangle::Triangle;
use crate::{ProjectedScene, RasterError};

/// Segments between two looks at whether the tile is closed.
const STRIDE: usize = 64;

/// What every pixel of the picture sees of the scene.
///
/// Triangles come first, since they hide much; then the segments of the tile from front to back, until every sample of
/// the tile is nearer than the next segment. Cost: about linear in the segments plus what is visible of them.
///
/// # Errors
/// Arrays that do not fit together, a picture without pixels.
pub fn rasterise(scene: &ProjectedScene) -> Result<GBuffer, RasterError> {
    scene.check()?;
    let points = strand_points(scene);
    let grid = TileGrid::new(scene.width, scene.height);
    let work = Work {
        scene,
        points: &points,
        grid,
        segments: segment_bins(&points, grid),
        triangles: triangle_bins(scene, grid),
        pattern: Pattern::new(),
        orders: OpacityOrders::new(),
    };
    let rows: Vec<TileRow> = (0..grid.count())
        .into_par_iter()
        .map_init(Tile::new, |tile, index| work.tile_fragments(index, tile))
        .collect::<Vec<_>>()
        .chunks(grid.columns)
        .map(|tiles| TileRow::joined(tiles, scene.width))
        .collect();
    Ok(assembled(rows))
}

struct Work<'a> {
    scene: &'a ProjectedScene<'a>,
    points: &'a [StrandPoint],
    grid: TileGrid,
    segments: Bins,
    triangles: Bins,
    pattern: Pattern,
    orders: OpacityOrders,
}

struct TileFragments {
    fragments: Vec<Fragment>,
    counts: Vec<u32>,
    width: usize,
}

impl Work<'_> {
    fn tile_fragments(&self, index: usize, tile: &mut Tile) -> TileFragments {
        let (column, row) = (index % self.grid.columns, index / self.grid.columns);
        tile.begin(column, row, self.scene.width, self.scene.height);
        for triangle in self.triangles.of_tile(index) {
            if let Some(drawn) = triangle_of(self.scene, triangle as usize) {
                drawn.draw(triangle, tile, &self.pattern);
            }
        }
        self.draw_segments(index, tile);
        let (mut fragments, mut counts) = (Vec::new(), Vec::new());
        Resolver { scene: self.scene, points: self.points, pattern: &self.pattern }.resolve(
            tile,
            &mut fragments,
            &mut counts,
        );
        TileFragments { fragments, counts, width: tile.size[0] as usize }
    }

    fn draw_segments(&self, index: usize, tile: &mut Tile) {
        let nearest = |i: u32| self.points[i as usize].depth.min(self.points[i as usize + 1].depth);
        let mut order: Vec<u64> =
            self.segments.of_tile(index).map(|i| u64::from(sortable(nearest(i))) << 32 | u64::from(i)).collect();
        order.sort_unstable();
        for keys in order.chunks(STRIDE) {
            if nearest(keys[0] as u32) >= tile.farthest_of_all() {
                return;
            }
            for &key in keys {
                let i = key as u32;
                let (a, b) = (&self.points[i as usize], &self.points[i as usize + 1]);
                if let Some(segment) = Segment::new(a, b) {
                    segment.draw(i, tile, &self.pattern, &self.orders);
                }
            }
        }
    }
}

/// A number that orders as the depth does.
fn sortable(depth: f32) -> u32 {
    let bits = depth.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

fn segment_bins(points: &[StrandPoint], grid: TileGrid) -> Bins {
    Bins::new(grid, points.len().saturating_sub(1), |i, touch| {
        let (a, b) = (&points[i], &points[i + 1]);
        if a.begins_segment() && a.opacity.max(b.opacity) > 0.0 {
            let (min, max) = segment::bounds(a, b);
            touch_all(grid, min, max, touch);
        }
    })
}

fn triangle_bins(scene: &ProjectedScene, grid: TileGrid) -> Bins {
    Bins::new(grid, scene.triangles.len(), |i, touch| {
        if let Some(triangle) = triangle_of(scene, i) {
            let (min, max) = triangle.bounds();
            touch_all(grid, min, max, touch);
        }
    })
}

fn touch_all(grid: TileGrid, min: [f32; 2], max: [f32; 2], touch: &mut dyn FnMut(usize)) {
    let [columns, rows] = grid.overlapping(min, max);
    for row in rows {
        for column in columns.clone() {
            touch(row * grid.columns + column);
        }
    }
}

fn triangle_of(scene: &ProjectedScene, index: usize) -> Option<Triangle> {
    Triangle::new(scene.triangles[index].map(|v| &scene.mesh_vertices[v as usize]))
}

/// Fragments of the pixel rows that one row of tiles covers, and the number in every pixel.
struct TileRow {
    fragments: Vec<Fragment>,
    counts: Vec<u32>,
}

impl TileRow {
    fn joined(tiles: &[TileFragments], width: usize) -> Self {
        let height = tiles.first().map_or(0, |tile| tile.counts.len() / tile.width);
        let mut row = Self {
            fragments: Vec::with_capacity(tiles.iter().map(|tile| tile.fragments.len()).sum()),
            counts: Vec::with_capacity(width * height),
        };
        let mut read = vec![0usize; tiles.len()];
        for y in 0..height {
            for (tile, read) in tiles.iter().zip(&mut read) {
                let counts = &tile.counts[y * tile.width..(y + 1) * tile.width];
                let number = counts.iter().sum::<u32>() as usize;
                row.counts.extend_from_slice(counts);
                row.fragments.extend_from_slice(&tile.fragments[*read..*read + number]);
                *read += number;
            }
        }
        row
    }
}

fn assembled(rows: Vec<TileRow>) -> GBuffer {
    let pixels = rows.iter().map(|row| row.counts.len()).sum::<usize>();
    let mut buffer = GBuffer {
        pixel_offsets: Vec::with_capacity(pixels + 1),
        fragments: Vec::with_capacity(rows.iter().map(|row| row.fragments.len()).sum()),
    };
    let mut end = 0;
    buffer.pixel_offsets.push(end);
    for row in rows {
        for count in row.counts {
            end += i64::from(count);
            buffer.pixel_offsets.push(end);
        }
        buffer.fragments.extend(row.fragments);
    }
    buffer
}
