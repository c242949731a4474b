//! Points of strands made ready for the tiles: on a grid, with width and opacity.

use rayon::prelude::*;

use crate::samples::{OpacityOrders, SAMPLES};
use crate::{ProjectedScene, ProjectedVertex};

/// Positions lie on a grid of 1/1024 px, so that differences between positions are exact and a picture shifted by whole
/// pixels is the same picture.
const GRID: f32 = 1024.0;

/// Row of a point at which no segment begins: the last point of a strand, or a segment that is not drawn.
const NONE: u32 = u32::MAX;

/// Strands that one core takes at a time.
const GROUP: usize = 256;

/// A point of a strand; the segment that begins here has the index of the point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrandPoint {
    pub x: f32,
    pub y: f32,
    pub depth: f32,
    pub half_width: f32,
    /// Opacity in samples: 16 alpha.
    pub opacity: f32,
    pub row: u32,
}

impl StrandPoint {
    /// A place holder.
    pub const NOWHERE: Self = Self { x: 0.0, y: 0.0, depth: 0.0, half_width: 0.0, opacity: 0.0, row: NONE };

    pub fn begins_segment(&self) -> bool {
        self.row != NONE
    }

    /// Unit direction on the screen to another point; None where both are at one place.
    #[inline(always)]
    pub fn direction_to(&self, other: &Self) -> Option<[f32; 2]> {
        let (dx, dy) = (other.x - self.x, other.y - self.y);
        let length = (dx * dx + dy * dy).sqrt();
        (length > 0.0).then(|| [dx / length, dy / length])
    }
}

/// Position on the grid.
pub(crate) fn snapped(value: f32) -> f32 {
    ((value * GRID + 0.5_f32.copysign(value)) as i64) as f32 / GRID
}

/// All points, in parallel: first what each knows of itself, then what its strand tells it.
pub(crate) fn strand_points(scene: &ProjectedScene) -> Vec<StrandPoint> {
    let least = 0.5 * scene.min_width_px;
    let own = (scene.strand_points.par_iter(), scene.half_width_px.par_iter(), scene.alpha.par_iter());
    let mut points: Vec<StrandPoint> =
        own.into_par_iter().map(|(vertex, width, alpha)| point((*vertex).into(), *width, *alpha, least)).collect();
    groups(scene.offsets, &mut points).into_par_iter().for_each(|(first_strand, offsets, points)| {
        for (i, ends) in offsets.windows(2).enumerate() {
            let range = (ends[0] - offsets[0]) as usize..(ends[1] - offsets[0]) as usize;
            begin_segments(&scene.strand_points[ends[0] as usize..], &mut points[range], first_strand + i);
        }
    });
    points
}

fn point(vertex: ProjectedVertex, width: f32, alpha: f32, least: f32) -> StrandPoint {
    let given = width.max(0.0);
    let half_width = given.max(least);
    let share = if half_width > 0.0 { given / half_width } else { 0.0 };
    StrandPoint {
        x: snapped(vertex.x),
        y: snapped(vertex.y),
        depth: vertex.depth,
        half_width,
        opacity: (alpha.clamp(0.0, 1.0) * share) * SAMPLES as f32,
        row: NONE,
    }
}

/// Gives the strand's row to the points at which a segment is drawn: those before the camera, as the next one is.
fn begin_segments(vertices: &[[f32; 4]], points: &mut [StrandPoint], strand: usize) {
    let row = OpacityOrders::row_of_strand(strand);
    for (pair, point) in vertices.windows(2).zip(points.split_last_mut().map_or(&mut [][..], |(_, before)| before)) {
        let drawn = pair.iter().all(|vertex| ProjectedVertex::from(*vertex).scale > 0.0);
        point.row = if drawn { row } else { NONE };
    }
}

/// The points of every `GROUP` strands, with the number of the first of these and their offsets.
fn groups<'a>(offsets: &'a [i64], points: &'a mut [StrandPoint]) -> Vec<(usize, &'a [i64], &'a mut [StrandPoint])> {
    let strands = offsets.len().saturating_sub(1);
    let mut rest = points;
    let mut found = Vec::with_capacity(strands.div_ceil(GROUP));
    for first in (0..strands).step_by(GROUP) {
        let offsets = &offsets[first..=(first + GROUP).min(strands)];
        let (mine, others) = rest.split_at_mut((offsets[offsets.len() - 1] - offsets[0]) as usize);
        found.push((first, offsets, mine));
        rest = others;
    }
    found
}
