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
///
/// Cells whose bound is not above `enough` are not asked along which direction they err: these parts are 0.
pub(crate) fn cell_errors(
    net: &Net,
    u: &Lines,
    v: &Lines,
    enough: f64,
    place: impl Fn(DVec4) -> DVec4,
) -> Vec<CellError> {
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
            errors.push(cell.error(enough));
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

    fn error(&self, enough: f64) -> CellError {
        let ([r0, r1], [c0, c1]) = (self.rows, self.columns);
        let corners = [self.at(r0, c0), self.at(r1, c0), self.at(r1, c1), self.at(r0, c1)];
        let gap = diagonal_gap(corners);
        let total = self.distance_to(&Facets::new(corners), enough - gap) + gap;
        if total <= enough {
            return CellError { total, along_u: 0.0, along_v: 0.0 };
        }
        let mut error = CellError { total, along_u: gap, along_v: gap };
        for row in r0..=r1 {
            let ends = [self.at(row, c0), self.at(row, c1)];
            for column in c0..=c1 {
                let point = self.at(row, column);
                let across = [self.at(r0, column), self.at(r1, column)];
                error.along_v = error.along_v.max(distance_to_segment(point, ends));
                error.along_u = error.along_u.max(distance_to_segment(point, across));
            }
        }
        error
    }

    /// A bound of the distance of all control points from the triangles, exact where it is above `enough`.
    fn distance_to(&self, facets: &Facets, enough: f64) -> f64 {
        let ([r0, r1], [c0, c1]) = (self.rows, self.columns);
        let mut worst = enough.max(0.0).powi(2);
        let mut found: f64 = 0.0;
        for row in r0..=r1 {
            for (column, &point) in (c0..).zip(&self.points[row * self.stride + c0..=row * self.stride + c1]) {
                let first = (row - r0) * (c1 - c0) >= (column - c0) * (r1 - r0);
                let mut distance_sq = facets.distance_sq(point, first, worst);
                if distance_sq > worst {
                    distance_sq = distance_to_triangles(point, facets.corners).powi(2);
                    worst = worst.max(distance_sq);
                }
                found = found.max(distance_sq);
            }
        }
        found.sqrt()
    }
}

/// The two triangles over the corners of a cell, ready for many points.
struct Facets {
    corners: [DVec3; 4],
    facets: Option<[Facet; 2]>,
}

impl Facets {
    fn new(corners: [DVec3; 4]) -> Self {
        let [a, b, c, d] = corners;
        let facets = Facet::new(b, [c, a]).zip(Facet::new(d, [a, c])).map(|(first, second)| [first, second]);
        Self { corners, facets }
    }

    /// The squared distance of a point from a point of the nearer triangle: the nearest one, or one close to it. Where
    /// the triangle that is asked `first` is within `enough`, the other one is not asked.
    fn distance_sq(&self, point: DVec3, first: bool, enough: f64) -> f64 {
        let Some([one, two]) = &self.facets else {
            return distance_to_triangles(point, self.corners).powi(2);
        };
        let (near, far) = if first { (one, two) } else { (two, one) };
        let found = near.distance_sq(point);
        if found <= enough { found } else { found.min(far.distance_sq(point)) }
    }
}

/// A triangle with its right angle, or what is nearest to one, at the origin. Barycentric coordinates below 0 are raised
/// to 0: along edges that are nearly square to each other this finds nearly the closest point.
struct Facet {
    origin: DVec3,
    edges: [DVec3; 2],
    /// A point minus the origin times these gives its coordinates along the edges.
    duals: [DVec3; 2],
}

impl Facet {
    /// None where the triangle has no area.
    fn new(origin: DVec3, others: [DVec3; 2]) -> Option<Self> {
        let edges = others.map(|other| other - origin);
        let normal = edges[0].cross(edges[1]);
        let area_sq = normal.length_squared();
        let square = edges[0].length_squared() * edges[1].length_squared();
        (area_sq > 1e-12 * square && area_sq.is_normal()).then(|| Self {
            origin,
            edges,
            duals: [edges[1].cross(normal) / area_sq, normal.cross(edges[0]) / area_sq],
        })
    }

    fn distance_sq(&self, point: DVec3) -> f64 {
        let offset = point - self.origin;
        let [along, across] = self.duals.map(|dual| offset.dot(dual).max(0.0));
        let shrink = 1.0 / (along + across).max(1.0);
        (offset - (self.edges[0] * along + self.edges[1] * across) * shrink).length_squared()
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn anywhere() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn quick_distances_are_never_below_the_exact_ones(corners in prop::array::uniform4(anywhere()), p in anywhere()) {
            let quick = Facets::new(corners).distance_sq(p, true, 0.0).sqrt();
            prop_assert!(quick >= distance_to_triangles(p, corners) - 1e-9);
        }

        #[test]
        fn over_a_rectangle_they_are_exact(size in prop::array::uniform2(0.1..2.0f64), p in anywhere()) {
            let [x, y] = size;
            let corners = [DVec3::ZERO, DVec3::X * x, DVec3::new(x, y, 0.0), DVec3::Y * y];
            let quick = Facets::new(corners).distance_sq(p, true, 0.0).sqrt();
            let exact = p.distance(p.clamp(DVec3::ZERO, corners[2]));
            let outside = p.x < 0.0 || p.y < 0.0 || p.x > x || p.y > y;
            prop_assert!(quick >= exact - 1e-12);
            prop_assert!(outside || quick <= exact + 1e-12);
        }

        #[test]
        fn triangles_without_area_fall_back_on_exact_distances(a in anywhere(), b in anywhere(), p in anywhere()) {
            let corners = [a, b, b, b];
            let quick = Facets::new(corners).distance_sq(p, true, 0.0).sqrt();
            prop_assert!((quick - distance_to_segment(p, [a, b])).abs() < 1e-9);
        }
    }
}
