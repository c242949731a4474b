//! Points of strands made ready for the tiles: on a grid, with mitres, width and opacity.

use rayon::prelude::*;

use crate::samples::{OpacityOrders, SAMPLES};
use crate::{ProjectedScene, ProjectedVertex};

/// Positions lie on a grid of 1/1024 px, so that differences between positions are exact and a picture shifted by whole
/// pixels is the same picture.
const GRID: f32 = 1024.0;

/// Row of a point at which no segment begins: the last point of a strand, or a segment that is not drawn.
const NONE: u32 = u32::MAX;

/// A point of a strand; the segment that begins here has the index of the point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrandPoint {
    pub x: f32,
    pub y: f32,
    pub depth: f32,
    pub half_width: f32,
    /// Opacity in samples: 16 alpha.
    pub opacity: f32,
    /// Unit direction of the line on which two segments meet is at right angles to this; 0 where segments end bluntly.
    pub mitre: [f32; 2],
    pub row: u32,
}

impl StrandPoint {
    pub fn begins_segment(&self) -> bool {
        self.row != NONE
    }
}

/// Position on the grid.
pub(crate) fn snapped(value: f32) -> f32 {
    ((value * GRID + 0.5_f32.copysign(value)) as i64) as f32 / GRID
}

/// All points, in parallel over strands.
pub(crate) fn strand_points(scene: &ProjectedScene) -> Vec<StrandPoint> {
    let strands = scene.offsets.len().saturating_sub(1);
    let of_strand = |strand: usize| {
        let range = scene.offsets[strand] as usize..scene.offsets[strand + 1] as usize;
        let row = OpacityOrders::row_of_strand(strand);
        range.clone().map(move |i| point(scene, i, &range, row))
    };
    (0..strands).into_par_iter().with_min_len(256).flat_map_iter(of_strand).collect()
}

fn point(scene: &ProjectedScene, i: usize, range: &std::ops::Range<usize>, row: u32) -> StrandPoint {
    let vertex = &scene.strand_points[i];
    let least = 0.5 * scene.min_width_px;
    let given = scene.half_width_px[i].max(0.0);
    let half_width = given.max(least);
    let share = if half_width > 0.0 { given / half_width } else { 0.0 };
    let next = (i + 1 < range.end).then(|| &scene.strand_points[i + 1]);
    let drawn = next.is_some_and(|n| vertex.scale > 0.0 && n.scale > 0.0);
    StrandPoint {
        x: snapped(vertex.x),
        y: snapped(vertex.y),
        depth: vertex.depth,
        half_width,
        opacity: (scene.alpha[i].clamp(0.0, 1.0) * share) * SAMPLES as f32,
        mitre: if i == range.start { [0.0; 2] } else { mitre(&scene.strand_points[i - 1], vertex, next) },
        row: if drawn { row } else { NONE },
    }
}

/// Unit vector half-way between the two directions; 0 at ends and at turns of more than a right angle.
fn mitre(previous: &ProjectedVertex, here: &ProjectedVertex, next: Option<&ProjectedVertex>) -> [f32; 2] {
    let Some(next) = next else { return [0.0; 2] };
    let (Some(a), Some(b)) = (direction(previous, here), direction(here, next)) else { return [0.0; 2] };
    if a[0] * b[0] + a[1] * b[1] < 0.0 {
        return [0.0; 2];
    }
    let sum = [a[0] + b[0], a[1] + b[1]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
    [sum[0] / length, sum[1] / length]
}

fn direction(from: &ProjectedVertex, to: &ProjectedVertex) -> Option<[f32; 2]> {
    let (dx, dy) = (snapped(to.x) - snapped(from.x), snapped(to.y) - snapped(from.y));
    let length = (dx * dx + dy * dy).sqrt();
    (length > 0.0).then(|| [dx / length, dy / length])
}
