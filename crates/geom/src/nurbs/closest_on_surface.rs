//! Closest points of a surface.
//!
//! Cells of the surface lie in the boxes of their control points; they are searched from the nearest box on, each by
//! Newton's method held to the cell, until no box is nearer than the best point.

use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;

use super::closest_on_curve::{STARTS, bounds, pieces_of_spans};
use super::curve::projected;
use super::net::{Lines, Net};
use super::{Jet, NurbsError, Surface};
use crate::Aabb;

const MAX_STEPS: usize = 40;
/// Cells of a span and direction, by degree: so small that the distance has hardly two valleys in one.
const CELLS_PER_DEGREE: usize = 2;

/// The point of a surface that is closest to a query.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestOnSurface {
    /// Its parameters along u and v.
    pub uv: [f64; 2],
    /// The point.
    pub point: DVec3,
    /// Distance from the query.
    pub distance: f64,
}

/// A part of the domain and the box of its control points.
struct Cell {
    low: DVec2,
    high: DVec2,
    /// Its spans, also at its rim: beyond a crease the slopes are others.
    spans: [usize; 2],
    bounds: Aabb,
}

impl Surface {
    /// The closest points to queries, in parallel.
    ///
    /// # Errors
    /// None for a valid surface.
    pub fn closest(&self, queries: &[DVec3]) -> Result<Vec<ClosestOnSurface>, NurbsError> {
        let cells = self.cells()?;
        Ok(queries.par_iter().map(|&query| self.closest_of(&cells, query)).collect())
    }

    /// The cells of all spans, each with the box of its control points.
    fn cells(&self) -> Result<Vec<Cell>, NurbsError> {
        let u = Lines::new(self.u(), pieces_of_spans(&self.u().breaks(), CELLS_PER_DEGREE * self.u().degree()))?;
        let v = Lines::new(self.v(), pieces_of_spans(&self.v().breaks(), CELLS_PER_DEGREE * self.v().degree()))?;
        let net = Net::new(self, &u, &v)?;
        let mut cells = Vec::with_capacity(u.intervals() * v.intervals());
        for i in 0..u.intervals() {
            for j in 0..v.intervals() {
                let block = net.block([u.on_line[i], u.on_line[i + 1]], [v.on_line[j], v.on_line[j + 1]]);
                let low = DVec2::new(u.parameters[i], v.parameters[j]);
                cells.push(Cell {
                    low,
                    spans: [self.u().span(low.x), self.v().span(low.y)],
                    high: DVec2::new(u.parameters[i + 1], v.parameters[j + 1]),
                    bounds: bounds(block.map(projected)),
                });
            }
        }
        Ok(cells)
    }

    fn closest_of(&self, cells: &[Cell], query: DVec3) -> ClosestOnSurface {
        let mut nearest: Vec<(f64, usize)> =
            cells.iter().enumerate().map(|(i, cell)| (cell.bounds.distance_sq(query), i)).collect();
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut best = ClosestOnSurface { uv: [0.0; 2], point: query, distance: f64::INFINITY };
        for (bound_sq, cell) in nearest {
            if bound_sq >= best.distance * best.distance {
                break;
            }
            let found = self.closest_on_cell(&cells[cell], query);
            if found.distance < best.distance {
                best = found;
            }
        }
        best
    }

    /// Newton's steps on the square of the distance, held to the cell.
    fn closest_on_cell(&self, cell: &Cell, query: DVec3) -> ClosestOnSurface {
        let pairs = STARTS.into_iter().flat_map(|u| STARTS.map(|v| DVec2::new(u, v)));
        let starts = pairs.map(|part| cell.low + part * (cell.high - cell.low));
        let far = |at: &DVec2| self.point(at.x, at.y).distance_squared(query);
        let mut at = starts.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(cell.low);
        let mut jet = self.jet_on(cell.spans, at.x, at.y);
        for _ in 0..MAX_STEPS {
            let steps = descents(&jet, query, at, cell);
            let shorter = steps.into_iter().find_map(|step| self.shorter(&jet, query, at, step, cell));
            let Some((next, found)) = shorter else { break };
            let moved = ((next - at) / (cell.high - cell.low)).abs().max_element();
            (at, jet) = (next, found);
            if moved <= 1e-15 {
                break;
            }
        }
        ClosestOnSurface { uv: at.to_array(), point: jet.point, distance: jet.point.distance(query) }
    }

    /// The longest of the halved steps, held to the cell, that does not lead away from the query.
    fn shorter(&self, jet: &Jet, query: DVec3, at: DVec2, step: DVec2, cell: &Cell) -> Option<(DVec2, Jet)> {
        let limit = jet.point.distance_squared(query) * (1.0 + 4.0 * f64::EPSILON);
        (0..30).map(|halvings| (at + step * 0.5f64.powi(halvings)).clamp(cell.low, cell.high)).find_map(|next| {
            let found = self.jet_on(cell.spans, next.x, next.y);
            (next != at && found.point.distance_squared(query) <= limit).then_some((next, found))
        })
    }
}

/// The steps to try, best first: Newton's, or Gauss's where the square of the distance is not convex, unless it would
/// leave the cell from its rim; then the slope itself, scaled along each direction, which never leads away. None goes
/// along a direction that is pressed against the rim.
fn descents(jet: &Jet, query: DVec3, at: DVec2, cell: &Cell) -> [DVec2; 2] {
    let away = jet.point - query;
    let slope = DVec2::new(away.dot(jet.du), away.dot(jet.dv));
    let (uu, uv, vv) = (jet.du.length_squared(), jet.du.dot(jet.dv), jet.dv.length_squared());
    let bent = [uu + away.dot(jet.duu), uv + away.dot(jet.duv), vv + away.dot(jet.dvv)];
    let leaves =
        |step: DVec2, k: usize| (at[k] <= cell.low[k] && step[k] < 0.0) || (at[k] >= cell.high[k] && step[k] > 0.0);
    let pressed = [leaves(-slope, 0), leaves(-slope, 1)];
    // The slight excess on the diagonal lets a vanishing derivative at a collapsed row stay in place.
    let excess = 1e-12 * (uu + vv) + f64::MIN_POSITIVE;
    let gauss = [uu + excess, uv, vv + excess];
    let newton = held_step(bent, slope, pressed).or_else(|| held_step(gauss, slope, pressed)).unwrap_or(DVec2::ZERO);
    let scale = DVec2::new(bent[0].max(gauss[0]), bent[2].max(gauss[2]));
    let free = DVec2::new(f64::from(!pressed[0]), f64::from(!pressed[1]));
    let scaled = -slope / scale * free;
    if leaves(newton, 0) || leaves(newton, 1) { [scaled, scaled] } else { [newton, scaled] }
}

/// Solves for the step along the directions that are free; none where the matrix is not positive definite there.
fn held_step([uu, uv, vv]: [f64; 3], slope: DVec2, pressed: [bool; 2]) -> Option<DVec2> {
    match pressed {
        [true, true] => Some(DVec2::ZERO),
        [true, false] => (vv > 0.0).then(|| DVec2::new(0.0, -slope.y / vv)),
        [false, true] => (uu > 0.0).then(|| DVec2::new(-slope.x / uu, 0.0)),
        [false, false] => {
            let determinant = uu * vv - uv * uv;
            let convex = uu > 0.0 && vv > 0.0 && determinant > 1e-14 * uu * vv;
            convex.then(|| -(DMat2::from_cols_array(&[uu, uv, uv, vv]).inverse() * slope))
        }
    }
}
