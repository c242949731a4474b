//! Strands traced through a direction field in a box of voxels with a picture in front of it.
//!
//! Two fields are joined. Behind, a direction a voxel. In front, the *front sheet*: the surface `z_front(x, y)` seen in the
//! photograph with a direction a pixel, which is far finer than the voxels; strands within `sheet_depth` of that
//! surface slide along it at the depth at which they entered, so that their projection follows the picture
//! exactly. Where the sheet ends (at the silhouette) the strand goes on in the voxels.
//!
//! Seeds are taken in batches of fixed size. Strands of one batch are traced in parallel against the density that earlier
//! batches left, and their own is added afterwards in their order: the result does not depend on the number of threads.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::error::check_number;
use crate::{FieldError, FrontSheet, VoxelField};

/// How to trace.
#[derive(Clone, Copy, Debug)]
pub struct TraceOptions {
    /// Length of a step, metres.
    pub step: f64,
    /// Strands shorter than this are dropped, metres.
    pub min_length: f64,
    /// How far behind the surface the picture still steers, metres.
    pub sheet_depth: f64,
    /// A turn sharper than this between steps ends the strand (cosine).
    pub min_cosine: f64,
    /// Share of the previous direction in the next one, in [0, 1).
    pub inertia: f64,
    /// Strands allowed in a voxel.
    pub voxel_cap: u16,
    /// Visible strands allowed in a pixel; a seed whose pixel has one already is skipped. 0: pixels are not counted.
    pub pixel_cap: u16,
    /// Distance kept from the head, metres.
    pub clearance: f64,
    /// Most strands.
    pub most: usize,
}

/// One place to start from.
#[derive(Clone, Copy, Debug)]
pub struct Seed {
    /// Where, metres.
    pub point: DVec3,
    /// Longest way towards the tip, metres.
    pub forward: f64,
    /// Longest way towards the root, metres.
    pub backward: f64,
}

/// Strands, root to tip.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traced {
    /// Vertices.
    pub points: Vec<DVec3>,
    /// Strand i is `points[offsets[i]..offsets[i + 1]]`.
    pub offsets: Vec<i64>,
    /// The seed that each strand came from.
    pub seed: Vec<u32>,
    /// The root end met the head.
    pub rooted: Vec<bool>,
}

const BATCH: usize = 512;

/// Traces both ways from every seed until `options.most` strands are found. `density` (strands a voxel) goes in and comes out
/// changed, so that several calls share it.
///
/// # Errors
/// Lengths that do not fit the box or the picture.
pub fn trace(
    field: &VoxelField<'_>,
    sheet: &FrontSheet<'_>,
    seeds: &[Seed],
    density: &mut [u16],
    options: TraceOptions,
) -> Result<Traced, FieldError> {
    field.shape.expect("direction", field.direction.len())?;
    field.shape.expect("head_distance", field.head_distance.len())?;
    field.shape.expect("density", density.len())?;
    let pixels = sheet.rows * sheet.columns;
    for (name, found) in [("depth", sheet.depth.len()), ("sheet direction", sheet.direction.len())] {
        if found != pixels {
            return Err(FieldError::Length { name, found, expected: pixels });
        }
    }
    for (name, value) in [("step", options.step), ("voxel size", field.size), ("scale", sheet.scale)] {
        check_number(name, value)?;
    }
    let tracer = Tracer { field, sheet, options };
    let mut cover = vec![0u16; if options.pixel_cap > 0 { pixels } else { 0 }];
    let mut out = Traced { offsets: vec![0], ..Traced::default() };
    for (batch, seeds) in seeds.chunks(BATCH).enumerate() {
        let found: Vec<Option<Path>> = seeds.par_iter().map(|seed| tracer.strand(seed, density, &cover)).collect();
        for (i, path) in found.into_iter().enumerate() {
            let Some(path) = path else { continue };
            if out.seed.len() == options.most {
                return Ok(out);
            }
            if tracer.taken(seeds[i].point, &cover) {
                continue;
            }
            tracer.mark(&path.points, density, &mut cover);
            out.points.extend(&path.points);
            out.offsets.push(out.points.len() as i64);
            out.seed.push((batch * BATCH + i) as u32);
            out.rooted.push(path.rooted);
        }
    }
    Ok(out)
}

/// A point as the picture sees it.
#[derive(Clone, Copy)]
struct Sight {
    pixel: DVec2,
    surface: Option<f64>,
}

struct Path {
    points: Vec<DVec3>,
    rooted: bool,
}

struct Tracer<'a> {
    field: &'a VoxelField<'a>,
    sheet: &'a FrontSheet<'a>,
    options: TraceOptions,
}

impl Tracer<'_> {
    fn strand(&self, seed: &Seed, density: &[u16], cover: &[u16]) -> Option<Path> {
        if self.taken(seed.point, cover) || self.full(seed.point, density, cover) {
            return None;
        }
        let start = self.out_of_head(seed.point)?;
        let (mut back, rooted) = self.walk(start, -1.0, seed.backward, density, cover);
        let (ahead, _) = self.walk(start, 1.0, seed.forward, density, cover);
        back.reverse();
        back.push(start);
        back.extend(ahead);
        let length: f64 = back.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        (back.len() >= 2 && length >= self.options.min_length).then_some(Path { points: back, rooted })
    }

    fn walk(&self, from: DVec3, sense: f64, longest: f64, density: &[u16], cover: &[u16]) -> (Vec<DVec3>, bool) {
        let mut points = Vec::new();
        let mut point = from;
        let mut previous = DVec3::ZERO;
        let steps = (longest / self.options.step) as usize;
        let mut sight = self.sight(point);
        for _ in 0..steps {
            let Some(found) = self.direction(point, sight) else { break };
            let direct = found * sense;
            if previous != DVec3::ZERO && direct.dot(previous) < self.options.min_cosine {
                break;
            }
            let heading = (direct * (1.0 - self.options.inertia) + previous * self.options.inertia).normalize_or_zero();
            let (next, seen) = self.advance(point, sight, heading);
            if self.full(next, density, cover) {
                break;
            }
            let gap = if self.far_from_head(next) { f64::INFINITY } else { self.field.head_distance(next) };
            if gap < self.options.clearance {
                let pushed = self.pushed_out(next, gap);
                if self.field.head_distance(pushed) < 0.0 {
                    return (points, sense < 0.0);
                }
                if sense < 0.0 && gap < 0.5 * self.options.clearance {
                    points.push(pushed);
                    return (points, true);
                }
                points.push(pushed);
                previous = (pushed - point).normalize_or_zero();
                point = pushed;
                sight = self.sight(point);
                continue;
            }
            points.push(next);
            previous = heading;
            point = next;
            sight = seen;
        }
        let rooted = sense < 0.0 && self.field.head_distance(point) < 2.0 * self.options.clearance;
        (points, rooted)
    }

    /// What the picture knows of a point: its pixel and, where there is hair, the z of the surface there.
    fn sight(&self, point: DVec3) -> Sight {
        let pixel = self.sheet.pixel(point);
        Sight { pixel, surface: self.sheet.surface(pixel) }
    }

    /// Where the strand goes at a point, root to tip; `None` outside the hair.
    fn direction(&self, point: DVec3, sight: Sight) -> Option<DVec3> {
        self.sheet_direction(point, sight).or_else(|| self.field.direction_at(point))
    }

    fn sheet_direction(&self, point: DVec3, sight: Sight) -> Option<DVec3> {
        let pixel = sight.pixel;
        let surface = sight.surface?;
        if (point.z - surface).abs() > self.options.sheet_depth {
            return None;
        }
        let flat = self.sheet.direction_at(pixel)?;
        let ahead = self.sheet.surface(pixel + flat);
        let behind = self.sheet.surface(pixel - flat);
        let rise = match (ahead, behind) {
            (Some(a), Some(b)) => (a - b) / 2.0,
            (Some(a), None) => a - surface,
            (None, Some(b)) => surface - b,
            (None, None) => 0.0,
        };
        Some(DVec3::new(flat.x, -flat.y, rise * self.sheet.scale).normalize_or_zero())
    }

    /// One step; on the sheet the distance behind the surface is kept.
    fn advance(&self, point: DVec3, sight: Sight, heading: DVec3) -> (DVec3, Sight) {
        let next = point + heading * self.options.step;
        let seen = self.sight(next);
        match (sight.surface.map(|z| point.z - z), seen.surface.map(|z| next.z - z)) {
            (Some(before), Some(after)) if before.abs() <= self.options.sheet_depth => {
                let slip = (after - before).clamp(-self.options.step, self.options.step);
                (DVec3::new(next.x, next.y, next.z - slip), seen)
            }
            _ => (next, seen),
        }
    }

    /// Whether the voxel says by itself that the skin is beyond its neighbours: a distance changes by no more than one's way.
    fn far_from_head(&self, point: DVec3) -> bool {
        self.field.voxel(point).is_some_and(|voxel| {
            f64::from(self.field.head_distance[voxel]) > self.options.clearance + 2.0 * self.field.size
        })
    }

    fn pushed_out(&self, point: DVec3, gap: f64) -> DVec3 {
        let h = 0.5 * self.field.size;
        let slope = DVec3::new(
            self.field.head_distance(point + DVec3::X * h) - self.field.head_distance(point - DVec3::X * h),
            self.field.head_distance(point + DVec3::Y * h) - self.field.head_distance(point - DVec3::Y * h),
            self.field.head_distance(point + DVec3::Z * h) - self.field.head_distance(point - DVec3::Z * h),
        );
        if slope.is_finite() { point + slope.normalize_or_zero() * (self.options.clearance - gap) } else { point }
    }

    /// The point itself, or where it is nearer than `clearance` to the skin, the one that far before it; `None` where a
    /// push along the slope does not lead out of the head.
    fn out_of_head(&self, point: DVec3) -> Option<DVec3> {
        let gap = self.field.head_distance(point);
        if gap >= self.options.clearance {
            return Some(point);
        }
        Some(self.pushed_out(point, gap)).filter(|&pushed| self.field.head_distance(pushed) >= 0.0)
    }

    fn on_sheet(&self, point: DVec3) -> Option<usize> {
        let pixel = self.sheet.pixel(point);
        let surface = self.sheet.surface(pixel)?;
        ((point.z - surface).abs() <= self.options.sheet_depth).then(|| self.sheet.pixel_index(pixel)).flatten()
    }

    fn taken(&self, point: DVec3, cover: &[u16]) -> bool {
        !cover.is_empty() && self.sheet.pixel_index(self.sheet.pixel(point)).is_some_and(|pixel| cover[pixel] > 0)
    }

    fn full(&self, point: DVec3, density: &[u16], cover: &[u16]) -> bool {
        if !cover.is_empty() && self.on_sheet(point).is_some_and(|pixel| cover[pixel] >= self.options.pixel_cap) {
            return true;
        }
        self.field.voxel(point).is_none_or(|voxel| density[voxel] >= self.options.voxel_cap)
    }

    fn mark(&self, points: &[DVec3], density: &mut [u16], cover: &mut [u16]) {
        let (mut last, mut last_pixel) = (usize::MAX, usize::MAX);
        for &point in points {
            if let Some(voxel) = self.field.voxel(point).filter(|v| *v != last) {
                density[voxel] = density[voxel].saturating_add(1);
                last = voxel;
            }
            if cover.is_empty() {
                continue;
            }
            if let Some(pixel) = self.on_sheet(point).filter(|p| *p != last_pixel) {
                cover[pixel] = cover[pixel].saturating_add(1);
                last_pixel = pixel;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GridShape;

    const SHAPE: GridShape = GridShape { layers: 20, rows: 20, columns: 20 };
    const OPTIONS: TraceOptions = TraceOptions {
        step: 0.25,
        min_length: 0.0,
        sheet_depth: 0.0,
        min_cosine: 0.0,
        inertia: 0.0,
        voxel_cap: 60000,
        pixel_cap: 0,
        clearance: 0.0,
        most: 1000,
    };

    fn run(direction: impl Fn(DVec3) -> DVec3, seeds: &[Seed], options: TraceOptions) -> Traced {
        let origin = DVec3::new(-10.0, 10.0, -10.0);
        let cells: Vec<[f32; 3]> = (0..SHAPE.len())
            .map(|cell| {
                let [z, y, x] = SHAPE.place(cell).map(|v| v as f64 + 0.5);
                direction(origin + DVec3::new(x, -y, z)).as_vec3().to_array()
            })
            .collect();
        let head = vec![f32::INFINITY; SHAPE.len()];
        let field = VoxelField { shape: SHAPE, origin, size: 1.0, direction: &cells, head_distance: &head };
        let sheet = FrontSheet { rows: 0, columns: 0, scale: 1.0, centre: DVec2::ZERO, depth: &[], direction: &[] };
        trace(&field, &sheet, seeds, &mut vec![0; SHAPE.len()], options).expect("fits")
    }

    #[test]
    fn a_constant_field_gives_straight_lines_to_the_walls() {
        let d = DVec3::new(1.0, 2.0, -1.0).normalize();
        let seed = Seed { point: DVec3::new(0.1, 0.2, 0.3), forward: 100.0, backward: 100.0 };
        let out = run(|_| d, &[seed], OPTIONS);
        assert_eq!(out.offsets.len(), 2);
        assert!(out.points.iter().all(|p| (*p - seed.point).cross(d).length() < 1e-6));
        assert!(out.points.first().is_some_and(|p| p.abs().max_element() > 9.0));
        assert!(out.points.last().is_some_and(|p| p.abs().max_element() > 9.0));
    }

    #[test]
    fn a_turning_field_gives_circles() {
        let seed = Seed { point: DVec3::new(6.0, 0.0, 0.0), forward: 12.0, backward: 0.0 };
        let turn = |p: DVec3| DVec3::new(-p.y, p.x, 0.0).normalize_or_zero();
        let out = run(turn, &[seed], TraceOptions { step: 0.05, ..OPTIONS });
        assert!(out.points.iter().all(|p| (p.length() - 6.0).abs() < 0.4));
    }

    #[test]
    fn full_voxels_end_strands() {
        let seed = Seed { point: DVec3::new(0.5, 0.5, 0.5), forward: 5.0, backward: 5.0 };
        let out = run(|_| DVec3::X, &vec![seed; 2000], TraceOptions { voxel_cap: 3, ..OPTIONS });
        assert!(out.seed.len() <= BATCH && !out.seed.is_empty());
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let seeds: Vec<Seed> = (0..3000)
            .map(|i| {
                let f = |k: usize| ((i * k) % 997) as f64 / 997.0 * 18.0 - 9.0;
                Seed { point: DVec3::new(f(31), f(57), f(91)), forward: 20.0, backward: 20.0 }
            })
            .collect();
        let turn = |p: DVec3| DVec3::new(-p.y, p.x, 1.0).normalize_or_zero();
        let options = TraceOptions { voxel_cap: 8, ..OPTIONS };
        let with = |threads: usize| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("pool")
                .install(|| run(turn, &seeds, options))
        };
        assert_eq!(with(1), with(4));
    }
}
