//! Strands in the picture: curves along the ridges of the confidence map (Chai et al. 2012, section 3.2.2).
//!
//! From each seed a curve is followed both ways. While the map is trusted the thread is *certain* and takes the map's
//! direction; where confidence fails, or the direction jumps because another strand lies on top, it is *uncertain*, keeps
//! its curvature and loses health, until it finds itself again or dies. Vertices passed under a jump are flagged occluded.
//!
//! Seeds are taken one after the other, strongest first, since each curve removes the seeds along it; that order makes
//! the result the same on any number of threads.

use glam::DVec2;

use crate::error::ImageError;
use crate::raster_view::Plane;
use crate::ridges::seeds;

/// Steps over which the curvature is measured that an uncertain thread keeps.
const CURVATURE_STEPS: usize = 8;
/// A curve that comes back to a pixel after this many of its own vertices runs in a circle.
const RETURN_STEPS: u32 = 24;

/// Constants of tracing; the defaults of Python's `TraceParams` are the paper's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceParams {
    /// Seeds need more confidence than this.
    pub high: f64,
    /// Certain vertices need at least this.
    pub low: f64,
    /// Share by which a seed must stand out over its neighbours.
    pub epsilon: f64,
    /// Steps that an uncertain thread survives.
    pub health: u32,
    /// Length of a step, pixels.
    pub step_px: f64,
    /// Largest bend between steps of a certain thread, radians.
    pub max_bend: f64,
    /// Distance across the strand at which its flanks are sampled, pixels.
    pub reach_px: f64,
    /// Shorter curves are dropped, pixels.
    pub min_length_px: f64,
    /// Standard deviation of the smoothing along the finished curve, pixels; 0 for none.
    pub smoothing_px: f64,
}

/// Traced curves as flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traced {
    /// Vertices, pixels.
    pub points: Vec<DVec2>,
    /// Curve i is `points[offsets[i]..offsets[i + 1]]`.
    pub offsets: Vec<usize>,
    /// Vertices that lie under another strand.
    pub occluded: Vec<bool>,
    /// Confidence at every vertex; 0 at occluded ones.
    pub confidence: Vec<f32>,
}

#[derive(Clone, Copy)]
struct Vertex {
    point: DVec2,
    direction: DVec2,
    certain: bool,
    occluded: bool,
    confidence: f64,
}

/// Traces every seed of the confidence map inside the mask.
pub fn trace(angle: &[f32], confidence: Plane<'_>, mask: &[bool], params: TraceParams) -> Result<Traced, ImageError> {
    confidence.check(mask.len())?;
    confidence.check(angle.len())?;
    for (name, value) in [("step_px", params.step_px), ("max_bend", params.max_bend), ("reach_px", params.reach_px)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(ImageError::Trace { name, value });
        }
    }
    let field = Field::new(angle, confidence, mask, params);
    let mut taken = Taken::new(confidence);
    let mut visits = Visits { stamp: vec![0; mask.len()], at: vec![0; mask.len()], current: 0 };
    let mut traced = Traced { offsets: vec![0], ..Traced::default() };
    for seed in seeds(confidence, angle, params.high, params.epsilon, params.reach_px) {
        if taken.pixels[seed as usize] || !mask[seed as usize] {
            continue;
        }
        let curve = field.curve(seed as usize, &mut visits);
        curve.iter().for_each(|vertex| taken.take(vertex, params.reach_px));
        let length: f64 = curve.windows(2).map(|pair| pair[0].point.distance(pair[1].point)).sum();
        if curve.len() >= 2 && length >= params.min_length_px {
            traced.push(&curve, params.smoothing_px / params.step_px);
        }
    }
    Ok(traced)
}

/// Pixels that traced curves cover: no seeds any more.
struct Taken {
    pixels: Vec<bool>,
    width: usize,
    height: usize,
}

impl Taken {
    fn new(like: Plane<'_>) -> Self {
        Self { pixels: vec![false; like.values.len()], width: like.width, height: like.height }
    }

    /// Takes the pixels within three quarters of the flanks' distance of a certain vertex. Those at an uncertain one are
    /// not the curve's own: another strand lies over it there, and keeps its seeds.
    fn take(&mut self, vertex: &Vertex, reach_px: f64) {
        if !vertex.certain {
            return;
        }
        let radius = (0.75 * reach_px).max(std::f64::consts::FRAC_1_SQRT_2);
        let span = |middle: f64, size: usize| {
            let clamped = |place: f64| place.clamp(0.0, size as f64) as usize;
            clamped((middle - radius).floor())..clamped((middle + radius).ceil())
        };
        for y in span(vertex.point.y, self.height) {
            for x in span(vertex.point.x, self.width) {
                if vertex.point.distance(DVec2::new(x as f64 + 0.5, y as f64 + 0.5)) <= radius {
                    self.pixels[y * self.width + x] = true;
                }
            }
        }
    }
}

impl Traced {
    fn push(&mut self, curve: &[Vertex], smoothing_steps: f64) {
        let points: Vec<DVec2> = curve.iter().map(|vertex| vertex.point).collect();
        self.points.extend(smoothed(&points, smoothing_steps));
        for vertex in curve {
            self.occluded.push(vertex.occluded);
            self.confidence.push(if vertex.occluded { 0.0 } else { vertex.confidence as f32 });
        }
        self.offsets.push(self.points.len());
    }
}

/// Which pixels the present curve has passed, and at which of its vertices, counted from the seed.
struct Visits {
    stamp: Vec<u32>,
    at: Vec<i32>,
    current: u32,
}

impl Visits {
    /// Has the curve been here long before vertex `index`? Marks the pixel.
    fn returns(&mut self, pixel: usize, index: i32) -> bool {
        let returns = self.stamp[pixel] == self.current && index.abs_diff(self.at[pixel]) > RETURN_STEPS;
        if self.stamp[pixel] != self.current {
            self.stamp[pixel] = self.current;
            self.at[pixel] = index;
        }
        returns
    }
}

struct Field<'a> {
    confidence: Plane<'a>,
    mask: &'a [bool],
    /// Confidence times cosine and sine of the double angle, to interpolate undirected angles.
    double_cos: Vec<f32>,
    double_sin: Vec<f32>,
    params: TraceParams,
}

impl<'a> Field<'a> {
    fn new(angle: &[f32], confidence: Plane<'a>, mask: &'a [bool], params: TraceParams) -> Self {
        let double = |part: fn(f32) -> f32| {
            angle
                .iter()
                .zip(confidence.values)
                .map(|(a, w)| if a.is_finite() { (w + 1e-4) * part(2.0 * a) } else { 0.0 })
                .collect()
        };
        Self { confidence, mask, double_cos: double(f32::cos), double_sin: double(f32::sin), params }
    }

    fn pixel(&self, point: DVec2) -> Option<usize> {
        let (x, y) = (point.x.floor(), point.y.floor());
        let inside = x >= 0.0 && y >= 0.0 && x < self.confidence.width as f64 && y < self.confidence.height as f64;
        inside.then(|| y as usize * self.confidence.width + x as usize).filter(|pixel| self.mask[*pixel])
    }

    /// Direction of the strand at a point, turned to bend least from `along`.
    fn direction(&self, point: DVec2, along: DVec2) -> Option<DVec2> {
        let (width, height) = (self.confidence.width, self.confidence.height);
        let sample = |values: &[f32]| Plane { values, width, height }.bilinear(point.x, point.y);
        let (cos, sin) = (sample(&self.double_cos), sample(&self.double_sin));
        if cos == 0.0 && sin == 0.0 {
            return None;
        }
        let direction = DVec2::from_angle(0.5 * sin.atan2(cos));
        Some(if direction.dot(along) < 0.0 { -direction } else { direction })
    }

    /// The curve through a seed: both ways, with uncertain ends trimmed.
    fn curve(&self, seed: usize, visits: &mut Visits) -> Vec<Vertex> {
        let width = self.confidence.width;
        let start = DVec2::new((seed % width) as f64 + 0.5, (seed / width) as f64 + 0.5);
        let Some(direction) = self.direction(start, DVec2::X) else { return Vec::new() };
        let point = self.recentred(start, direction);
        let confidence = self.confidence.bilinear(point.x, point.y);
        let first = Vertex { point, direction, certain: true, occluded: false, confidence };
        visits.current += 1;
        let forth = self.half(first, 1, visits);
        let mut curve = self.half(Vertex { direction: -direction, ..first }, -1, visits);
        curve.reverse();
        curve.push(first);
        curve.extend(forth);
        curve
    }

    /// Vertices after `first`, one way (1 or -1), up to the last certain one.
    fn half(&self, first: Vertex, way: i32, visits: &mut Visits) -> Vec<Vertex> {
        let mut steps: Vec<Vertex> = Vec::new();
        let mut last = first;
        let mut turn = 0.0;
        let mut health = self.params.health;
        let longest = 4 * (self.confidence.width + self.confidence.height);
        while steps.len() < longest {
            let point = last.point + self.params.step_px * last.direction;
            let Some(pixel) = self.pixel(point) else { break };
            last = self.step(last, point, turn);
            health = if last.certain { self.params.health } else { health.saturating_sub(1) };
            if health == 0 || (last.certain && visits.returns(pixel, way * (steps.len() as i32 + 1))) {
                break;
            }
            steps.push(last);
            if last.certain {
                turn = mean_turn(first.direction, &steps);
            }
        }
        let certain = steps.iter().rposition(|vertex| vertex.certain).map_or(0, |index| index + 1);
        steps.truncate(certain);
        steps
    }

    /// Rules 1 to 5 of the paper at one vertex.
    fn step(&self, last: Vertex, point: DVec2, turn: f64) -> Vertex {
        let confidence = self.confidence.bilinear(point.x, point.y);
        let found = self.direction(point, last.direction).filter(|_| confidence >= self.params.low);
        match found {
            Some(direction) if direction.angle_to(last.direction).abs() <= self.params.max_bend => {
                let point = self.recentred(point, direction);
                Vertex { point, direction, certain: true, occluded: false, confidence }
            }
            bent => {
                let direction = DVec2::from_angle(turn).rotate(last.direction);
                let occluded = bent.is_some() || last.occluded;
                Vertex { point, direction, certain: false, occluded, confidence }
            }
        }
    }

    /// The point moved across the strand to the top of a tent through the confidence at it and its two flanks.
    fn recentred(&self, point: DVec2, direction: DVec2) -> DVec2 {
        let across = direction.perp() * self.params.reach_px;
        let sample = |p: DVec2| self.confidence.bilinear(p.x, p.y);
        let (middle, left, right) = (sample(point), sample(point - across), sample(point + across));
        let slope = middle - left.min(right);
        if slope <= 1e-9 {
            return point;
        }
        point + across * (0.5 * (right - left) / slope).clamp(-0.5, 0.5)
    }
}

/// Mean signed turn a step over the last certain steps, radians.
fn mean_turn(first: DVec2, steps: &[Vertex]) -> f64 {
    let count = steps.len().min(CURVATURE_STEPS);
    let before = if steps.len() > count { steps[steps.len() - count - 1].direction } else { first };
    before.angle_to(steps[steps.len() - 1].direction) / count as f64
}

/// Gaussian means along a curve; the window narrows towards the ends, which stay.
fn smoothed(points: &[DVec2], sigma: f64) -> Vec<DVec2> {
    let widest = (3.0 * sigma).ceil() as usize;
    let mean = |index: usize| {
        let reach = widest.min(index).min(points.len() - 1 - index);
        let weight = |step: usize| (-0.5 * (step as f64 / sigma).powi(2)).exp();
        let (sum, total) = (1..=reach).fold((points[index], 1.0), |(sum, total), step| {
            (sum + weight(step) * (points[index - step] + points[index + step]), total + 2.0 * weight(step))
        });
        sum / total
    };
    (0..points.len()).map(mean).collect()
}
