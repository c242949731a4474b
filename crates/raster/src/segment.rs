//! One segment of a strand in one tile.
//!
//! A segment is the band between its two points, as wide as the strand. Neighbours meet on the line through their common
//! point that halves the angle between them: together they cover every sample of the strand once, so that opacity is not
//! counted twice where segments meet. At turns of more than a right angle the band ends bluntly.

use crate::bins::{Rectangle, TILE};
use crate::samples::{Lane, OpacityOrders, Pattern, SAMPLES, larger, largest, smaller, take, word};
use crate::strand_points::StrandPoint;
use crate::tile::{Pixels, Tile};

/// How far the corners of a band may lie from its points, in half widths: a right-angled mitre reaches sqrt 2.
const REACH: f32 = 1.5;
/// Widens intervals of pixels against rounding; more pixels than needed are harmless.
const MARGIN: f32 = 1.0 / 64.0;

/// Rectangle around a segment, in pixels.
#[inline(always)]
pub(crate) fn bounds(a: &StrandPoint, b: &StrandPoint) -> Rectangle {
    let pad = REACH * larger(a.half_width, b.half_width) + MARGIN;
    Rectangle {
        min: [smaller(a.x, b.x) - pad, smaller(a.y, b.y) - pad],
        max: [larger(a.x, b.x) + pad, larger(a.y, b.y) + pad],
    }
}

/// The depth of the nearer end.
#[inline(always)]
pub(crate) fn nearest(a: &StrandPoint, b: &StrandPoint) -> f32 {
    smaller(a.depth, b.depth)
}

/// A segment with its linear forms: across and along from the first point, and the clips at both ends.
pub(crate) struct Segment<'a> {
    a: &'a StrandPoint,
    b: &'a StrandPoint,
    along: [f32; 2],
    length: f32,
}

impl<'a> Segment<'a> {
    /// None where the segment has no length on the screen.
    #[inline(always)]
    pub fn new(a: &'a StrandPoint, b: &'a StrandPoint) -> Option<Self> {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let length = (dx * dx + dy * dy).sqrt();
        (length > 0.0).then(|| Self { a, b, along: [dx / length, dy / length], length })
    }

    /// Position along the segment, 0 to 1, and across, -1 to 1, of a point in pixels.
    pub fn parameters(&self, x: f32, y: f32) -> [f32; 2] {
        let (rx, ry) = (x - self.a.x, y - self.a.y);
        let t = ((self.along[0] * rx + self.along[1] * ry) / self.length).clamp(0.0, 1.0);
        let half_width = self.a.half_width + t * (self.b.half_width - self.a.half_width);
        let across = (self.along[0] * ry - self.along[1] * rx) / half_width.max(f32::MIN_POSITIVE);
        [t, across.clamp(-1.0, 1.0)]
    }

    /// Draws the segment that begins at point `index` of `points` into the `pixels` of a tile.
    #[inline(always)]
    pub fn draw(
        &self,
        index: usize,
        points: &[StrandPoint],
        [columns, rows]: Pixels,
        tile: &mut Tile,
        pattern: &Pattern,
        orders: &OpacityOrders,
    ) {
        let [dx, dy] = self.along;
        let nearest = nearest(self.a, self.b);
        let reach = larger(self.a.half_width, self.b.half_width) + 0.5 * (dx.abs() + dy.abs()) + MARGIN;
        let mut forms: Option<SampleForms> = None;
        for row in rows {
            let ry = (tile.origin[1] + row) as f32 + 0.5 - self.a.y;
            // Across is dx ry - dy rx: the columns where it stays within reach.
            let columns = if dy.abs() > 1e-3 {
                let (middle, spread) = (self.a.x + dx * ry / dy, reach / dy.abs());
                let near = tile.clip(0, middle - spread - 0.5, middle + spread - 0.5);
                near.start.max(columns.start)..near.end.min(columns.end)
            } else {
                columns.clone()
            };
            for column in columns {
                let pixel = row as usize * TILE + column as usize;
                if nearest >= tile.farthest[pixel] {
                    continue;
                }
                if forms.is_none() {
                    forms = Some(SampleForms::new(self, mitres(points, index), pattern));
                }
                let Some(forms) = &forms else { unreachable!("made above") };
                let corner = [(tile.origin[0] + column) as f32 - self.a.x, (tile.origin[1] + row) as f32 - self.a.y];
                let thresholds = orders.of(self.a.row);
                let (depth, primitive) = (&mut tile.depth[pixel], &mut tile.primitive[pixel]);
                forms.cover(self, corner, thresholds, index as u32, depth, primitive);
                tile.farthest[pixel] = largest(&tile.depth[pixel]);
            }
        }
    }
}

/// Unit directions at right angles to the lines on which the segment that begins at point `index` meets the segments
/// before and after it; its own direction where there is none, and at turns of more than a right angle.
#[inline(always)]
fn mitres(points: &[StrandPoint], index: usize) -> [[f32; 2]; 2] {
    let (a, b) = (&points[index], &points[index + 1]);
    let Some(along) = a.direction_to(b) else { return [[0.0; 2]; 2] };
    let before = index.checked_sub(1).map(|i| &points[i]).filter(|p| p.begins_segment());
    let after = points.get(index + 2).filter(|_| b.begins_segment());
    let half_way = |other: Option<[f32; 2]>| other.and_then(|other| mean_direction(along, other)).unwrap_or(along);
    [half_way(before.and_then(|p| p.direction_to(a))), half_way(after.and_then(|p| b.direction_to(p)))]
}

/// Unit vector half-way between two; None where they are more than a right angle apart.
#[inline(always)]
fn mean_direction(a: [f32; 2], b: [f32; 2]) -> Option<[f32; 2]> {
    if a[0] * b[0] + a[1] * b[1] < 0.0 {
        return None;
    }
    let sum = [a[0] + b[0], a[1] + b[1]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
    Some([sum[0] / length, sum[1] / length])
}

/// Values of the linear forms at the samples, relative to the pixel's corner.
struct SampleForms {
    across: Lane,
    along: Lane,
    after_start: Lane,
    after_end: Lane,
    start: [f32; 2],
    end: [f32; 2],
}

impl SampleForms {
    #[inline(always)]
    fn new(segment: &Segment, [start, end]: [[f32; 2]; 2], pattern: &Pattern) -> Self {
        let [dx, dy] = segment.along;
        Self {
            across: pattern.linear(-dy, dx),
            along: pattern.linear(dx, dy),
            after_start: pattern.linear(start[0], start[1]),
            after_end: pattern.linear(end[0], end[1]),
            start,
            end,
        }
    }

    /// Depth test and coverage of the samples of a pixel whose corner lies at `corner` from the segment's first point.
    #[inline(always)]
    fn cover(
        &self,
        segment: &Segment,
        corner: [f32; 2],
        thresholds: &Lane,
        index: u32,
        depth: &mut Lane,
        primitive: &mut [u32; SAMPLES],
    ) {
        let (a, b) = (segment.a, segment.b);
        let [rx, ry] = corner;
        let [dx, dy] = segment.along;
        let (ex, ey) = (rx - (b.x - a.x), ry - (b.y - a.y));
        let across = dx * ry - dy * rx;
        let along = dx * rx + dy * ry;
        let after_start = self.start[0] * rx + self.start[1] * ry;
        let after_end = self.end[0] * ex + self.end[1] * ey;
        let per_px = 1.0 / segment.length;
        let width_slope = b.half_width - a.half_width;
        let depth_slope = b.depth - a.depth;
        let opacity_slope = b.opacity - a.opacity;
        // Masks of whole words instead of booleans: without branches, the loops become vector instructions.
        let mut nearer: Lane = [0.0; SAMPLES];
        let mut hits = [0u32; SAMPLES];
        for i in 0..SAMPLES {
            let t = smaller(larger((along + self.along[i]) * per_px, 0.0), 1.0);
            let z = a.depth + t * depth_slope;
            nearer[i] = z;
            hits[i] = word((across + self.across[i]).abs() <= a.half_width + t * width_slope)
                & word(after_start + self.after_start[i] >= 0.0)
                & word(after_end + self.after_end[i] < 0.0)
                & word(a.opacity + t * opacity_slope > thresholds[i])
                & word(z < depth[i]);
        }
        take(&hits, &nearer, index, depth, primitive);
    }
}
