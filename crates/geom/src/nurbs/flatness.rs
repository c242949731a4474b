//! How far a surface may lie from the two triangles that stand for it between grid lines.
//!
//! Between lines the surface lies in the hull of its control points. If each of them is within d of the triangles, the
//! surface is within d of the hull of the triangles, and that hull, the tetrahedron over the four corners, rises over
//! the triangles by the gap between their two diagonals. So d plus the gap bounds the chord error; it is not an estimate.

use glam::{DVec3, DVec4};

use super::curve::projected;
use super::net::{Lines, Net};
use crate::{barycentric_point, closest_on_triangle};

/// The bounds between two neighbouring lines along u and two along v.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CellError {
    /// Bound of the distance from the surface to the triangles.
    pub total: f64,
    /// The part that more lines along u would take away.
    pub along_u: f64,
    /// The part that more lines along v would take away.
    pub along_v: f64,
}

/// The bounds of all cells, row by row along u. `place` maps homogeneous control points to where the error is measured.
pub(crate) fn cell_errors(net: &Net, u: &Lines, v: &Lines, place: impl Fn(DVec4) -> DVec4) -> Vec<CellError> {
    let points: Vec<DVec3> = net.points.iter().map(|&p| projected(place(p))).collect();
    let mut errors = Vec::with_capacity(u.intervals() * v.intervals());
    for rows in u.on_line.windows(2) {
        for columns in v.on_line.windows(2) {
            let cell = Cell {
                points: &points,
                stride: net.columns,
                rows: [rows[0], rows[1]],
                columns: [columns[0], columns[1]],
            };
            errors.push(cell.error());
        }
    }
    errors
}

/// The control points of one cell.
struct Cell<'a> {
    points: &'a [DVec3],
    stride: usize,
    rows: [usize; 2],
    columns: [usize; 2],
}

impl Cell<'_> {
    fn at(&self, row: usize, column: usize) -> DVec3 {
        self.points[row * self.stride + column]
    }

    fn error(&self) -> CellError {
        let ([r0, r1], [c0, c1]) = (self.rows, self.columns);
        let corners = [self.at(r0, c0), self.at(r1, c0), self.at(r1, c1), self.at(r0, c1)];
        let gap = diagonal_gap(corners);
        let mut error = CellError { total: 0.0, along_u: gap, along_v: gap };
        for row in r0..=r1 {
            let ends = [self.at(row, c0), self.at(row, c1)];
            for column in c0..=c1 {
                let point = self.at(row, column);
                let across = [self.at(r0, column), self.at(r1, column)];
                error.total = error.total.max(distance_to_triangles(point, corners));
                error.along_v = error.along_v.max(distance_to_segment(point, ends));
                error.along_u = error.along_u.max(distance_to_segment(point, across));
            }
        }
        error.total += gap;
        error
    }
}

/// Distance of the point from the nearer of the triangles 0 1 2 and 0 2 3.
fn distance_to_triangles(point: DVec3, [a, b, c, d]: [DVec3; 4]) -> f64 {
    let distance =
        |triangle: [DVec3; 3]| barycentric_point(&triangle, closest_on_triangle(&triangle, point)).distance(point);
    distance([a, b, c]).min(distance([a, c, d]))
}

pub(crate) fn distance_to_segment(point: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let length_sq = along.length_squared();
    let t = if length_sq > 0.0 { ((point - a).dot(along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + along * t)
}

/// Distance between the lines of the two diagonals of a quadrangle: how high the tetrahedron over its corners is.
fn diagonal_gap([a, b, c, d]: [DVec3; 4]) -> f64 {
    let across = (c - a).cross(d - b);
    match across.try_normalize() {
        Some(normal) => normal.dot(b - a).abs(),
        // Parallel diagonals: the quadrangle is folded to a line, and its twist bounds the gap.
        None => (a - b + c - d).length() / 2.0,
    }
}
