//! The whole picture: tiles in parallel, then one list of fragments.

use rayon::prelude::*;

use crate::bins::{Bins, TileGrid};
use crate::cutout::Layers;
use crate::gbuffer::{GBuffer, TileFragments};
use crate::resolve::Resolver;
use crate::samples::{OpacityOrders, Pattern};
use crate::segment::{self, Segment};
use crate::strand_points::{StrandPoint, strand_points};
use crate::tile::Tile;
use crate::triangle::Triangle;
use crate::{ProjectedScene, RasterError};

/// Segments between two looks at how far one can see in the tile.
const STRIDE: usize = 64;
/// Segments that are ordered at once, at the least; those behind wait, since most of them may be hidden.
const LEAST_ORDERED: usize = 512;

/// What every pixel of the picture sees of the scene.
///
/// Opaque triangles come first, since they hide much; then the segments of the tile from front to back, until every
/// sample of the tile is nearer than the next segment; last the triangles that one can see through, as layers. Cost:
/// about linear in the segments plus what is visible of them, and in the samples of all layers.
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
        processor: pulp::Arch::new(),
    };
    let tiles: Vec<TileFragments> = (0..grid.count())
        .into_par_iter()
        .map_init(Scratch::new, |scratch, i| work.tile_fragments(i, scratch))
        .collect();
    Ok(GBuffer::assembled(&tiles, grid))
}

/// What one core works with.
struct Scratch {
    tile: Tile,
    keys: Vec<u64>,
    layers: Layers,
}

impl Scratch {
    fn new() -> Self {
        Self { tile: Tile::new(), keys: Vec::new(), layers: Layers::new() }
    }
}

struct Work<'a> {
    scene: &'a ProjectedScene<'a>,
    points: &'a [StrandPoint],
    grid: TileGrid,
    segments: Bins,
    triangles: Bins,
    pattern: Pattern,
    orders: OpacityOrders,
    processor: pulp::Arch,
}

impl Work<'_> {
    fn tile_fragments(&self, index: usize, Scratch { tile, keys, layers }: &mut Scratch) -> TileFragments {
        let (column, row) = (index % self.grid.columns, index / self.grid.columns);
        let size = tile.place(column, row, self.scene.width, self.scene.height);
        let mut found = TileFragments { fragments: Vec::new(), counts: vec![0; size[0] * size[1]], width: size[0] };
        keys.clear();
        keys.extend(self.segments.of_tile(index));
        if keys.is_empty() && self.triangles.of_tile(index).next().is_none() {
            return found;
        }
        tile.clear();
        for entry in self.triangles.of_tile(index) {
            let triangle = entry as u32;
            if self.scene.cutout(triangle as usize).is_some() {
                continue;
            }
            if let Some(drawn) = triangle_of(self.scene, triangle as usize) {
                drawn.draw(triangle, tile, &self.pattern);
            }
        }
        self.draw_segments(keys, tile);
        layers.clear();
        for triangle in self.triangles.of_tile(index).map(|entry| entry as u32) {
            if self.scene.cutout(triangle as usize).is_some()
                && let Some(seen) = triangle_of(self.scene, triangle as usize)
            {
                layers.add(self.scene, &seen, triangle, tile, &self.pattern);
            }
        }
        Resolver { scene: self.scene, points: self.points, pattern: &self.pattern }.resolve(tile, layers, &mut found);
        found
    }

    /// Draws from front to back until everything that is left is hidden.
    fn draw_segments(&self, keys: &mut [u64], tile: &mut Tile) {
        let at_once = LEAST_ORDERED.max(keys.len() / 4);
        let mut rest = keys;
        while !rest.is_empty() {
            if at_once < rest.len() {
                rest.select_nth_unstable(at_once);
            }
            let (front, behind) = rest.split_at_mut(at_once.min(rest.len()));
            front.sort_unstable();
            if !self.processor.dispatch(Drawing { work: self, keys: front, tile }) {
                return;
            }
            rest = behind;
        }
    }
}

/// Segments that come ordered from front to back, and the tile to draw them into.
struct Drawing<'a> {
    work: &'a Work<'a>,
    keys: &'a [u64],
    tile: &'a mut Tile,
}

/// A type, not a closure, since closures are not inlined and then have the vectors of the oldest processor.
impl pulp::NullaryFnOnce for Drawing<'_> {
    type Output = bool;

    /// Draws; returns whether anything can be seen behind.
    #[inline(always)]
    fn call(self) -> bool {
        let Self { work, keys, tile } = self;
        for keys in keys.chunks(STRIDE) {
            if sortable(tile.look()) <= (keys[0] >> 32) as u32 {
                return false;
            }
            // All ends at once: they lie far apart in memory, and waiting for each in turn would take longer.
            let mut ends = [[StrandPoint::NOWHERE; 2]; STRIDE];
            for (ends, key) in ends.iter_mut().zip(keys) {
                let i = *key as u32 as usize;
                *ends = [work.points[i], work.points[i + 1]];
            }
            for (key, [a, b]) in keys.iter().zip(&ends) {
                let Some(pixels) = tile.open_pixels(segment::bounds(a, b), segment::nearest(a, b)) else { continue };
                if let Some(segment) = Segment::new(a, b) {
                    segment.draw(*key as u32 as usize, work.points, pixels, tile, &work.pattern, &work.orders);
                }
            }
        }
        true
    }
}

/// A number that orders as the depth does.
#[inline(always)]
fn sortable(depth: f32) -> u32 {
    let bits = depth.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

fn segment_bins(points: &[StrandPoint], grid: TileGrid) -> Bins {
    Bins::new(grid, points.len().saturating_sub(1), |i| {
        let (a, b) = (&points[i], &points[i + 1]);
        let drawn = a.begins_segment() && a.opacity.max(b.opacity) > 0.0;
        drawn.then(|| (segment::bounds(a, b), sortable(segment::nearest(a, b))))
    })
}

fn triangle_bins(scene: &ProjectedScene, grid: TileGrid) -> Bins {
    Bins::new(grid, scene.triangles.len(), |i| triangle_of(scene, i).map(|triangle| (triangle.bounds(), 0)))
}

fn triangle_of(scene: &ProjectedScene, index: usize) -> Option<Triangle> {
    Triangle::new(scene.triangles[index].map(|v| &scene.mesh_vertices[v as usize]))
}
