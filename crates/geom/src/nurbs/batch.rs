//! Many surfaces in flat arrays, as a hairdo of strips keeps them. Parallel over surfaces, the same bits on any number
//! of threads.

use glam::DVec3;
use rayon::prelude::*;
use thiserror::Error;

use super::basis::Sample;
use super::{Grid, Jet, Knots, NurbsError, PatchMesh, Surface};

/// Surfaces one after the other: all control points, weights and knots, with the sizes that tell them apart.
#[derive(Debug, Clone, Copy)]
pub struct FlatSurfaces<'a> {
    /// x, y, z of all control points; those of a surface row by row along u.
    pub points: &'a [f64],
    /// Weights of all control points.
    pub weights: &'a [f64],
    /// Number of control points along u and v, two numbers a surface.
    pub counts: &'a [i64],
    /// Degrees along u and v, two numbers a surface.
    pub degrees: &'a [i64],
    /// Knots along u of all surfaces.
    pub knots_u: &'a [f64],
    /// Knots along v of all surfaces.
    pub knots_v: &'a [f64],
}

/// Why one of many surfaces is none.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum BatchError {
    /// A surface is refused.
    #[error("surface {surface}: {source}")]
    Surface {
        /// Index of the surface.
        surface: usize,
        /// What is wrong with it.
        source: NurbsError,
    },
    /// An array does not hold what the counts and degrees say.
    #[error(transparent)]
    Length(#[from] NurbsError),
    /// A query names no surface.
    #[error("query {query} names surface {surface} of {count}")]
    NoSuchSurface {
        /// Index of the query.
        query: usize,
        /// The surface that it names.
        surface: i64,
        /// Number of surfaces.
        count: usize,
    },
}

impl FlatSurfaces<'_> {
    /// The surfaces themselves.
    ///
    /// # Errors
    /// The first surface that is refused, or arrays that are longer or shorter than the counts and degrees say.
    pub fn surfaces(&self) -> Result<Vec<Surface>, BatchError> {
        let places = self.places()?;
        let surface = |(surface, place): (usize, &Place)| {
            self.surface(place).map_err(|source| BatchError::Surface { surface, source })
        };
        places.iter().enumerate().map(surface).collect()
    }

    fn surface(&self, place: &Place) -> Result<Surface, NurbsError> {
        let [rows, columns] = place.counts;
        let knots = |all: &[f64], at: usize, side: usize| {
            let (degree, count) = (place.degrees[side], place.counts[side]);
            Knots::new(degree, count, all[at..at + count + degree + 1].to_vec())
        };
        let u = knots(self.knots_u, place.knots_u, 0)?;
        let v = knots(self.knots_v, place.knots_v, 1)?;
        let range = place.point..place.point + rows * columns;
        let points: Vec<DVec3> =
            self.points[range.start * 3..range.end * 3].chunks_exact(3).map(DVec3::from_slice).collect();
        Surface::new(u, v, &points, &self.weights[range])
    }

    /// Where each surface starts; afterwards every range is known to lie inside the arrays.
    fn places(&self) -> Result<Vec<Place>, BatchError> {
        let mut next = Place::default();
        let mut places = Vec::with_capacity(self.counts.len() / 2);
        for (surface, (counts, degrees)) in self.counts.chunks(2).zip(self.degrees.chunks(2)).enumerate() {
            next.counts = [counts[0], counts[1]].map(|n| usize::try_from(n).unwrap_or(0));
            next.degrees = [degrees[0], degrees[1]].map(|n| usize::try_from(n).unwrap_or(0));
            for (degree, count) in next.degrees.into_iter().zip(next.counts) {
                super::knots::refuse_sizes(degree, count).map_err(|source| BatchError::Surface { surface, source })?;
            }
            places.push(next);
            next.point += next.counts[0] * next.counts[1];
            next.knots_u += next.counts[0] + next.degrees[0] + 1;
            next.knots_v += next.counts[1] + next.degrees[1] + 1;
        }
        let lengths = [
            ("coordinates of control points", self.points.len(), next.point * 3),
            ("weights", self.weights.len(), next.point),
            ("knots along u", self.knots_u.len(), next.knots_u),
            ("knots along v", self.knots_v.len(), next.knots_v),
        ];
        match lengths.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(NurbsError::Length { what, found, expected }.into()),
            None => Ok(places),
        }
    }
}

/// Sizes of one surface and where its numbers start in the flat arrays.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    counts: [usize; 2],
    degrees: [usize; 2],
    point: usize,
    knots_u: usize,
    knots_v: usize,
}

/// The points of every surface at all pairs of fractions (0 to 1) of its domain, surface by surface, row by row along u.
pub fn grids(surfaces: &[Surface], fractions_u: &[f64], fractions_v: &[f64]) -> Vec<[f64; 3]> {
    let size = fractions_u.len() * fractions_v.len();
    let mut found = vec![[0.0; 3]; surfaces.len() * size];
    if size > 0 {
        found.par_chunks_mut(size).zip(surfaces).for_each(|(found, surface)| {
            let along_u = samples(surface.u(), fractions_u);
            let along_v = samples(surface.v(), fractions_v);
            surface.grid(&along_u, &along_v, found);
        });
    }
    found
}

/// The B-splines at fractions of a domain.
pub(crate) fn samples(knots: &Knots, fractions: &[f64]) -> Vec<Sample> {
    fractions.iter().map(|&fraction| Sample::new(knots, knots.at_fraction(fraction))).collect()
}

/// A parameter pair on one of many surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Query {
    /// Index of the surface.
    pub surface: usize,
    /// Parameter along u, inside the domain.
    pub u: f64,
    /// Parameter along v, inside the domain.
    pub v: f64,
}

/// Checks that queries name surfaces and lie in their domains.
///
/// # Errors
/// The first query that does not.
pub fn queries(surfaces: &[Surface], indices: &[i64], uv: &[f64]) -> Result<Vec<Query>, BatchError> {
    let query = |(query, (&index, uv)): (usize, (&i64, &[f64]))| {
        let surface = usize::try_from(index).ok().filter(|&s| s < surfaces.len());
        let count = surfaces.len();
        let surface = surface.ok_or(BatchError::NoSuchSurface { query, surface: index, count })?;
        let (u, v) = (surfaces[surface].u().inside(uv[0])?, surfaces[surface].v().inside(uv[1])?);
        Ok(Query { surface, u, v })
    };
    indices.iter().zip(uv.chunks_exact(2)).enumerate().map(query).collect()
}

/// The points at queries.
pub fn points_at(surfaces: &[Surface], queries: &[Query]) -> Vec<[f64; 3]> {
    queries.par_iter().with_min_len(256).map(|q| surfaces[q.surface].point(q.u, q.v).to_array()).collect()
}

/// The points and derivatives at queries.
pub fn jets_at(surfaces: &[Surface], queries: &[Query]) -> Vec<Jet> {
    queries.par_iter().with_min_len(256).map(|q| surfaces[q.surface].jet(q.u, q.v)).collect()
}

/// The unit normals at queries.
pub fn normals_at(surfaces: &[Surface], queries: &[Query]) -> Vec<[f64; 3]> {
    queries.par_iter().with_min_len(256).map(|q| surfaces[q.surface].normal(q.u, q.v).to_array()).collect()
}

/// The triangles of many surfaces, each with grid lines of its own; errors name the first surface that has none.
pub fn meshes(
    surfaces: &[Surface],
    grid: impl Fn(usize, &Surface) -> Result<Grid, NurbsError> + Sync,
) -> Result<Vec<PatchMesh>, BatchError> {
    let mesh = |(index, surface): (usize, &Surface)| {
        let mesh = grid(index, surface).and_then(|grid| PatchMesh::new(surface, &grid));
        mesh.map_err(|source| BatchError::Surface { surface: index, source })
    };
    // Collected in full before the first error is taken, so that it is the same one on any number of threads.
    let meshes: Vec<_> = surfaces.par_iter().enumerate().map(mesh).collect();
    meshes.into_iter().collect()
}

/// For every surface the intervals along u and v that a number of cells is best spent on.
pub fn segments_within(surfaces: &[Surface], cells: &[i64]) -> Vec<[i64; 2]> {
    let best = |(surface, &cells): (&Surface, &i64)| {
        surface.segments_within(usize::try_from(cells).unwrap_or(1).max(1)).map(|n| n as i64)
    };
    surfaces.par_iter().zip(cells).map(best).collect()
}
