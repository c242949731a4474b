//! Closest points of a curve.
//!
//! Pieces of the curve lie in the boxes of their control points; they are searched from the nearest box on, each by
//! Newton's method held to the piece, until no box is nearer than the best point.

use glam::DVec3;
use rayon::prelude::*;

use super::curve::projected;
use super::net::Lines;
use super::{Curve, NurbsError, Refinement};
use crate::Aabb;

const MAX_STEPS: usize = 40;
/// Where on a piece Newton's method may start: at the nearest of these.
pub(crate) const STARTS: [f64; 5] = [0.5, 0.0, 0.25, 0.75, 1.0];
/// Pieces of a span, by degree: so short that the distance has hardly two valleys on one.
const PIECES_PER_DEGREE: usize = 4;

/// The point of a curve that is closest to a query.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestOnCurve {
    /// Its parameter.
    pub parameter: f64,
    /// The point.
    pub point: DVec3,
    /// Distance from the query.
    pub distance: f64,
}

impl Curve {
    /// The closest points to queries, in parallel.
    ///
    /// # Errors
    /// None for a valid curve.
    pub fn closest(&self, queries: &[DVec3]) -> Result<Vec<ClosestOnCurve>, NurbsError> {
        let pieces = self.pieces()?;
        Ok(queries.par_iter().map(|&query| self.closest_of(&pieces, query)).collect())
    }

    /// The pieces of all spans, each with the box of its control points.
    fn pieces(&self) -> Result<Vec<([f64; 2], Aabb)>, NurbsError> {
        let lines = Lines::new(
            self.knots(),
            pieces_of_spans(&self.knots().breaks(), PIECES_PER_DEGREE * self.knots().degree()),
        )?;
        let points = Refinement::new(self.knots(), lines.knots())?.apply(self.homogeneous());
        let ends = lines.parameters.windows(2).zip(lines.on_line.windows(2));
        Ok(ends.map(|(t, i)| ([t[0], t[1]], bounds(points[i[0]..=i[1]].iter().map(|&p| projected(p))))).collect())
    }

    fn closest_of(&self, pieces: &[([f64; 2], Aabb)], query: DVec3) -> ClosestOnCurve {
        let mut nearest: Vec<(f64, usize)> =
            pieces.iter().enumerate().map(|(i, (_, bounds))| (bounds.distance_sq(query), i)).collect();
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut best = ClosestOnCurve { parameter: 0.0, point: query, distance: f64::INFINITY };
        for (bound_sq, piece) in nearest {
            if bound_sq >= best.distance * best.distance {
                break;
            }
            let found = self.closest_on_piece(pieces[piece].0, query);
            if found.distance < best.distance {
                best = found;
            }
        }
        best
    }

    /// Newton's steps on the square of the distance, along the piece; Gauss's where it is not convex.
    fn closest_on_piece(&self, [low, high]: [f64; 2], query: DVec3) -> ClosestOnCurve {
        // The piece's own span, also at its ends: beyond a crease the slope is another.
        let span = self.knots().span(0.5 * (low + high));
        let at = |t: f64| self.derivatives_on(span, t);
        let starts = STARTS.map(|part| low + part * (high - low)).map(|t| (t, at(t)));
        let nearer = |a: &&(f64, [DVec3; 3]), b: &&(f64, [DVec3; 3])| {
            a.1[0].distance_squared(query).total_cmp(&b.1[0].distance_squared(query))
        };
        let (mut t, mut best) = *starts.iter().min_by(nearer).unwrap_or(&starts[0]);
        for _ in 0..MAX_STEPS {
            let (away, [_, first, second]) = (best[0] - query, best);
            let (slope, speed_sq) = (away.dot(first), first.length_squared());
            let convex = speed_sq + away.dot(second);
            let step = -slope / if convex > 0.0 { convex } else { speed_sq.max(f64::MIN_POSITIVE) };
            let Some((next, found)) = shorter(at, query, t, step, [low, high], away.length_squared()) else { break };
            let moved = (next - t).abs();
            (t, best) = (next, found);
            if moved <= 1e-15 * (high - low) {
                break;
            }
        }
        ClosestOnCurve { parameter: t, point: best[0], distance: best[0].distance(query) }
    }
}

/// The longest of the halved steps, held to the piece, that does not lead away from the query.
fn shorter(
    at: impl Fn(f64) -> [DVec3; 3],
    query: DVec3,
    t: f64,
    step: f64,
    [low, high]: [f64; 2],
    distance_sq: f64,
) -> Option<(f64, [DVec3; 3])> {
    (0..30).map(|halvings| (t + step * 0.5f64.powi(halvings)).clamp(low, high)).find_map(|next| {
        let found = at(next);
        let not_away = found[0].distance_squared(query) <= distance_sq * (1.0 + 4.0 * f64::EPSILON);
        (next != t && not_away).then_some((next, found))
    })
}

/// Every span in so many equal parts.
pub(crate) fn pieces_of_spans(breaks: &[f64], parts: usize) -> Vec<f64> {
    let mut found = vec![breaks[0]];
    for ends in breaks.windows(2) {
        found.extend((1..parts).map(|k| ends[0] + (ends[1] - ends[0]) * k as f64 / parts as f64));
        found.push(ends[1]);
    }
    found
}

/// The box around points.
pub(crate) fn bounds(points: impl Iterator<Item = DVec3>) -> Aabb {
    points.fold(Aabb::EMPTY, |bounds, point| bounds.with(point))
}
