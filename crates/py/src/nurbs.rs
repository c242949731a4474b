//! Surfaces of `tress-geom` for Python.

use glam::{DMat4, DVec3};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_geom::nurbs::{self, FitSettings, FlatSurfaces, Grid, Jet, Knots, PatchMesh, Query, Surface};

pub(crate) type Numbers<'py> = PyReadonlyArray1<'py, f64>;
pub(crate) type Triples<'py> = PyReadonlyArray2<'py, f64>;
/// Knots and their degree.
pub(crate) type KnotArrays<'py> = (Numbers<'py>, usize);
type Indices<'py> = PyReadonlyArray1<'py, i64>;
type Pairs<'py> = PyReadonlyArray2<'py, f64>;
type Counts<'py> = PyReadonlyArray2<'py, i64>;
type SurfaceArrays<'py> = (Triples<'py>, Numbers<'py>, Counts<'py>, Counts<'py>, Numbers<'py>, Numbers<'py>);
/// Parameters, points and distances.
type ClosestArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);
type NewSurface<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, [Bound<'py, PyArray1<f64>>; 2]);
/// Positions, normals, parameters, triangles, offsets of corners and of triangles, segments, errors.
type MeshArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    [Bound<'py, PyArray1<i64>>; 2],
    Bound<'py, PyArray2<i64>>,
    Bound<'py, PyArray1<f64>>,
);

/// Adds the functions of surfaces to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(nurbs_fit_surface, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_surface_closest, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_meshes_within, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_meshes_uniform, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_meshes_by_span, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_segments_within, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_check_surfaces, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_grids, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_points, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_normals, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_surface_refined, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_surface_clamped, module)?)
}

/// The surface nearest to points.
#[pyfunction]
fn nurbs_fit_surface<'py>(
    py: Python<'py>,
    knots_u: KnotArrays<'py>,
    knots_v: KnotArrays<'py>,
    parameters: Pairs<'py>,
    points: Triples<'py>,
    smoothness: f64,
    fix_ends: bool,
) -> PyResult<NewSurface<'py>> {
    let (u, v) = (knots_of(&knots_u.0, knots_u.1)?, knots_of(&knots_v.0, knots_v.1)?);
    let points = vectors(&points)?;
    let parameters: Vec<[f64; 2]> = parameters.as_slice()?.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
    let settings = FitSettings { smoothness, fix_ends };
    let fitted = py.detach(|| nurbs::fit_surface(u, v, &parameters, &points, settings)).map_err(refused)?;
    Ok(new_surface(py, &fitted))
}

/// Parameters, point and distance of the closest points of the one surface.
#[pyfunction]
fn nurbs_surface_closest<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    queries: Triples<'py>,
) -> PyResult<ClosestArrays<'py>> {
    let (surface, queries) = (one_surface(&arrays)?, vectors(&queries)?);
    let found = py.detach(|| surface.closest(&queries)).map_err(refused)?;
    let uv: Vec<[f64; 2]> = found.iter().map(|c| c.uv).collect();
    let distances: Vec<f64> = found.iter().map(|c| c.distance).collect();
    let points = rows(found.iter().map(|c| c.point.to_array()));
    Ok((Array2::from(uv).into_pyarray(py), points.into_pyarray(py), distances.into_pyarray(py)))
}

/// Triangles within an accuracy of every surface, in space or in a picture.
#[pyfunction]
#[pyo3(signature = (arrays, accuracy, projection=None))]
fn nurbs_meshes_within<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    accuracy: f64,
    projection: Option<[[f64; 4]; 3]>,
) -> PyResult<MeshArrays<'py>> {
    let surfaces = surfaces(&arrays)?;
    let projection = projection.map(|[x, y, w]| DMat4::from_cols_array_2d(&[x, y, [0.0; 4], w]).transpose());
    let meshes = py.detach(|| nurbs::meshes(&surfaces, |_, surface| Grid::within(surface, accuracy, projection)));
    Ok(mesh_arrays(py, &meshes.map_err(refused)?))
}

/// Triangles over equal intervals, as many along u and v as each surface is given.
#[pyfunction]
fn nurbs_meshes_uniform<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    segments: Counts<'py>,
) -> PyResult<MeshArrays<'py>> {
    let (surfaces, segments) = (surfaces(&arrays)?, pairs_of_counts(&segments)?);
    let meshes = py.detach(|| nurbs::meshes(&surfaces, |i, surface| Ok(Grid::uniform(surface, segments[i]))));
    Ok(mesh_arrays(py, &meshes.map_err(refused)?))
}

/// Triangles over equal intervals of every span, as many along u and v as each surface is given.
#[pyfunction]
fn nurbs_meshes_by_span<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    per_span: Counts<'py>,
) -> PyResult<MeshArrays<'py>> {
    let (surfaces, per_span) = (surfaces(&arrays)?, pairs_of_counts(&per_span)?);
    let meshes = py.detach(|| nurbs::meshes(&surfaces, |i, surface| Ok(Grid::by_span(surface, per_span[i]))));
    Ok(mesh_arrays(py, &meshes.map_err(refused)?))
}

/// The intervals along u and v that numbers of cells are best spent on.
#[pyfunction]
fn nurbs_segments_within<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    cells: Indices<'py>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let (surfaces, cells) = (surfaces(&arrays)?, cells.as_slice()?);
    Ok(Array2::from(py.detach(|| nurbs::segments_within(&surfaces, cells))).into_pyarray(py))
}

/// Refuses arrays that make no surfaces.
#[pyfunction]
fn nurbs_check_surfaces(arrays: SurfaceArrays<'_>) -> PyResult<()> {
    surfaces(&arrays).map(|_| ())
}

/// Points at all pairs of fractions of the domains.
#[pyfunction]
fn nurbs_grids<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    fractions_u: Numbers<'py>,
    fractions_v: Numbers<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let surfaces = surfaces(&arrays)?;
    let (fractions_u, fractions_v) = (fractions_u.as_slice()?, fractions_v.as_slice()?);
    Ok(Array2::from(py.detach(|| nurbs::grids(&surfaces, fractions_u, fractions_v))).into_pyarray(py))
}

/// Points at parameters of surfaces.
#[pyfunction]
fn nurbs_points<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    indices: Indices<'py>,
    uv: Pairs<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (surfaces, queries) = asked(&arrays, &indices, &uv)?;
    Ok(Array2::from(py.detach(|| nurbs::points_at(&surfaces, &queries))).into_pyarray(py))
}

/// Points and derivatives (point, u, v, uu, uv, vv) at parameters of surfaces, six rows a query.
#[pyfunction]
fn nurbs_derivatives<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    indices: Indices<'py>,
    uv: Pairs<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (surfaces, queries) = asked(&arrays, &indices, &uv)?;
    let jets = py.detach(|| nurbs::jets_at(&surfaces, &queries));
    let parts = |jet: Jet| [jet.point, jet.du, jet.dv, jet.duu, jet.duv, jet.dvv].map(|d| d.to_array());
    Ok(rows(jets.into_iter().flat_map(parts)).into_pyarray(py))
}

/// Unit normals at parameters of surfaces.
#[pyfunction]
fn nurbs_normals<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    indices: Indices<'py>,
    uv: Pairs<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (surfaces, queries) = asked(&arrays, &indices, &uv)?;
    Ok(Array2::from(py.detach(|| nurbs::normals_at(&surfaces, &queries))).into_pyarray(py))
}

/// The one surface with more knots.
#[pyfunction]
fn nurbs_surface_refined<'py>(
    py: Python<'py>,
    arrays: SurfaceArrays<'py>,
    more_u: Numbers<'py>,
    more_v: Numbers<'py>,
) -> PyResult<NewSurface<'py>> {
    let refined = one_surface(&arrays)?.refined(more_u.as_slice()?, more_v.as_slice()?).map_err(refused)?;
    Ok(new_surface(py, &refined))
}

/// The one surface with clamped knots.
#[pyfunction]
fn nurbs_surface_clamped<'py>(py: Python<'py>, arrays: SurfaceArrays<'py>) -> PyResult<NewSurface<'py>> {
    Ok(new_surface(py, &one_surface(&arrays)?.clamped().map_err(refused)?))
}

fn surfaces((points, weights, counts, degrees, knots_u, knots_v): &SurfaceArrays<'_>) -> PyResult<Vec<Surface>> {
    let flat = FlatSurfaces {
        points: points.as_slice()?,
        weights: weights.as_slice()?,
        counts: counts.as_slice()?,
        degrees: degrees.as_slice()?,
        knots_u: knots_u.as_slice()?,
        knots_v: knots_v.as_slice()?,
    };
    flat.surfaces().map_err(refused)
}

fn one_surface(arrays: &SurfaceArrays<'_>) -> PyResult<Surface> {
    surfaces(arrays)?.into_iter().next().ok_or_else(|| PyValueError::new_err("no surface was given"))
}

fn asked(arrays: &SurfaceArrays<'_>, indices: &Indices<'_>, uv: &Pairs<'_>) -> PyResult<(Vec<Surface>, Vec<Query>)> {
    let surfaces = surfaces(arrays)?;
    let queries = nurbs::queries(&surfaces, indices.as_slice()?, uv.as_slice()?).map_err(refused)?;
    Ok((surfaces, queries))
}

fn new_surface<'py>(py: Python<'py>, surface: &Surface) -> NewSurface<'py> {
    let (points, weights) = surface.control();
    let knots = [surface.u(), surface.v()].map(|k| k.values().to_vec().into_pyarray(py));
    (triples(&points).into_pyarray(py), weights.into_pyarray(py), knots)
}

fn mesh_arrays<'py>(py: Python<'py>, meshes: &[PatchMesh]) -> MeshArrays<'py> {
    let (mut corners, mut triangles) = (vec![0i64], vec![0i64]);
    for mesh in meshes {
        corners.push(corners[corners.len() - 1] + mesh.positions.len() as i64);
        triangles.push(triangles[triangles.len() - 1] + mesh.triangles.len() as i64);
    }
    let shifted = |(mesh, &first): (&PatchMesh, &i64)| {
        mesh.triangles.iter().map(|t| t.map(|corner| corner + first as u32)).collect::<Vec<_>>()
    };
    let indices: Vec<[u32; 3]> = meshes.iter().zip(&corners).flat_map(shifted).collect();
    let positions = rows(meshes.iter().flat_map(|m| m.positions.iter().copied())).into_pyarray(py);
    let normals = rows(meshes.iter().flat_map(|m| m.normals.iter().copied())).into_pyarray(py);
    let uv: Vec<[f64; 2]> = meshes.iter().flat_map(|m| m.uv.iter().copied()).collect();
    let segments: Vec<[i64; 2]> = meshes.iter().map(|m| m.segments.map(|n| n as i64)).collect();
    let errors: Vec<f64> = meshes.iter().map(|m| m.error.unwrap_or(f64::NAN)).collect();
    (
        positions,
        normals,
        Array2::from(uv).into_pyarray(py),
        Array2::from(indices).into_pyarray(py),
        [corners.into_pyarray(py), triangles.into_pyarray(py)],
        Array2::from(segments).into_pyarray(py),
        errors.into_pyarray(py),
    )
}

fn pairs_of_counts(array: &Counts<'_>) -> PyResult<Vec<[usize; 2]>> {
    Ok(array.as_slice()?.chunks_exact(2).map(|p| [p[0].max(1) as usize, p[1].max(1) as usize]).collect())
}

pub(crate) fn knots_of(knots: &Numbers<'_>, degree: usize) -> PyResult<Knots> {
    let values = knots.as_slice()?.to_vec();
    Knots::new(degree, values.len().saturating_sub(degree + 1), values).map_err(refused)
}

pub(crate) fn triples(points: &[DVec3]) -> Array2<f64> {
    rows(points.iter().map(|p| p.to_array()))
}

pub(crate) fn rows(values: impl Iterator<Item = [f64; 3]>) -> Array2<f64> {
    values.collect::<Vec<_>>().into()
}

pub(crate) fn vectors(array: &Triples<'_>) -> PyResult<Vec<DVec3>> {
    Ok(array.as_slice()?.chunks_exact(3).map(DVec3::from_slice).collect())
}

pub(crate) fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
