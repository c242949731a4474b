//! NURBS tensor-product surfaces.

use glam::{DVec3, DVec4};

use super::basis::{self, Row, Sample};
use super::curve::{blend, clamped, homogeneous, projected};
use super::{Knots, NurbsError, Refinement};

/// A rational B-spline surface: rows of control points along u, columns along v; weights positive, points finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    u: Knots,
    v: Knots,
    points: Vec<DVec4>,
}

/// A point of a surface and its derivatives to the second order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// The point.
    pub point: DVec3,
    /// First derivative along u.
    pub du: DVec3,
    /// First derivative along v.
    pub dv: DVec3,
    /// Second derivative along u.
    pub duu: DVec3,
    /// Mixed derivative.
    pub duv: DVec3,
    /// Second derivative along v.
    pub dvv: DVec3,
}

impl Surface {
    /// A surface of control points and weights, `points[i * v.count() + j]` at row i along u and column j along v.
    ///
    /// # Errors
    /// Another number of points or weights than the knots are for, points that are not finite, weights not positive.
    pub fn new(u: Knots, v: Knots, points: &[DVec3], weights: &[f64]) -> Result<Self, NurbsError> {
        let points = homogeneous(points, weights, u.count() * v.count())?;
        Ok(Self { u, v, points })
    }

    /// The knots along u.
    pub fn u(&self) -> &Knots {
        &self.u
    }

    /// The knots along v.
    pub fn v(&self) -> &Knots {
        &self.v
    }

    /// Control points and weights, row by row.
    pub fn control(&self) -> (Vec<DVec3>, Vec<f64>) {
        self.points.iter().map(|&p| (projected(p), p.w)).unzip()
    }

    /// The point at parameters of the domain.
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        let (along_u, along_v) = (Sample::new(&self.u, u), Sample::new(&self.v, v));
        projected(self.blend(along_u.first, &along_u.values, along_v.first, &along_v.values))
    }

    /// The points at all pairs of samples, written to `found[i * along_v.len() + j]`.
    pub fn grid(&self, along_u: &[Sample], along_v: &[Sample], found: &mut [[f64; 3]]) {
        let mut row = vec![DVec4::ZERO; self.v.count()];
        for (sample, found) in along_u.iter().zip(found.chunks_exact_mut(along_v.len())) {
            self.blend_rows(sample, &mut row);
            for (point, s) in found.iter_mut().zip(along_v) {
                *point = projected(blend(&row[s.first..], &s.values, self.v.degree())).to_array();
            }
        }
    }

    /// The point and its derivatives at parameters of the domain.
    pub fn jet(&self, u: f64, v: f64) -> Jet {
        self.jet_on([self.u.span(u), self.v.span(v)], u, v)
    }

    /// The same as seen from one span along u and one along v, which tells the sides of a crease apart.
    pub(crate) fn jet_on(&self, [span_u, span_v]: [usize; 2], u: f64, v: f64) -> Jet {
        let [u0, u1, u2] = basis::derivatives(&self.u, span_u, u);
        let [v0, v1, v2] = basis::derivatives(&self.v, span_v, v);
        let (first_u, first_v) = (span_u - self.u.degree(), span_v - self.v.degree());
        let at = |along_u: &Row, along_v: &Row| self.blend(first_u, along_u, first_v, along_v);
        Jet::from_homogeneous(at(&u0, &v0), [at(&u1, &v0), at(&u0, &v1)], [at(&u2, &v0), at(&u1, &v1), at(&u0, &v2)])
    }

    /// The same surface with more knots, all inserted at once.
    ///
    /// # Errors
    /// Knots outside the open domain, or more often than the degree allows.
    pub fn refined(&self, more_u: &[f64], more_v: &[f64]) -> Result<Self, NurbsError> {
        self.over(self.u.with(more_u)?, self.v.with(more_v)?)
    }

    /// The same surface over other knots, which contain the old ones inside their domain.
    ///
    /// # Errors
    /// As [`Refinement::new`].
    pub fn over(&self, u: Knots, v: Knots) -> Result<Self, NurbsError> {
        let along_u = Refinement::new(&self.u, &u)?;
        let along_v = Refinement::new(&self.v, &v)?;
        let points = self.refined_points(&along_u, &along_v);
        Ok(Self { u, v, points })
    }

    /// The homogeneous control points that two refinements make.
    pub(crate) fn refined_points(&self, along_u: &Refinement, along_v: &Refinement) -> Vec<DVec4> {
        let columns = self.v.count();
        let mut points = Vec::with_capacity(along_u.count() * along_v.count());
        for i in 0..along_u.count() {
            let row: Vec<DVec4> = (0..columns).map(|j| along_u.point(i, &self.points, j, columns)).collect();
            points.extend((0..along_v.count()).map(|j| along_v.point(j, &row, 0, 1)));
        }
        points
    }

    /// The same surface with knots that are clamped at all four sides.
    pub fn clamped(&self) -> Result<Self, NurbsError> {
        self.over(clamped(&self.u)?, clamped(&self.v)?)
    }

    /// One homogeneous row of control points: the rows blended at a parameter along u.
    fn blend_rows(&self, sample: &Sample, row: &mut [DVec4]) {
        let columns = row.len();
        let rows = self.points[sample.first * columns..].chunks_exact(columns);
        row.fill(DVec4::ZERO);
        for (points, &share) in rows.zip(&sample.values[..=self.u.degree()]) {
            row.iter_mut().zip(points).for_each(|(sum, &point)| *sum += point * share);
        }
    }

    fn blend(&self, first_u: usize, along_u: &Row, first_v: usize, along_v: &Row) -> DVec4 {
        let rows = self.points.chunks_exact(self.v.count()).skip(first_u).zip(&along_u[..=self.u.degree()]);
        rows.fold(DVec4::ZERO, |sum, (row, &share)| sum + blend(&row[first_v..], along_v, self.v.degree()) * share)
    }
}

impl Jet {
    /// Divides by the weight: `h` is the homogeneous point, then its first (u, v) and second (uu, uv, vv) derivatives.
    fn from_homogeneous(h: DVec4, [hu, hv]: [DVec4; 2], [huu, huv, hvv]: [DVec4; 3]) -> Self {
        let point = projected(h);
        let du = (hu.truncate() - hu.w * point) / h.w;
        let dv = (hv.truncate() - hv.w * point) / h.w;
        Self {
            point,
            du,
            dv,
            duu: (huu.truncate() - 2.0 * hu.w * du - huu.w * point) / h.w,
            duv: (huv.truncate() - hu.w * dv - hv.w * du - huv.w * point) / h.w,
            dvv: (hvv.truncate() - 2.0 * hv.w * dv - hvv.w * point) / h.w,
        }
    }
}
