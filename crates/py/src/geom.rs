//! `tress-geom` for Python.

use glam::DVec3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_geom::{Bvh, Closest, Ray, TriangleMesh};

type Triples<'py> = PyReadonlyArray2<'py, f64>;
type Corners<'py> = PyReadonlyArray2<'py, u32>;
type ClosestArrays<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

/// Adds the functions of `tress-geom` to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(geom_closest_points, module)?)?;
    module.add_function(wrap_pyfunction!(geom_signed_distances, module)?)?;
    module.add_function(wrap_pyfunction!(geom_winding_numbers, module)?)?;
    module.add_function(wrap_pyfunction!(geom_first_hits, module)?)?;
    module.add_function(wrap_pyfunction!(geom_any_hits, module)?)
}

/// Triangle, barycentric coordinates and distance of the closest points.
#[pyfunction]
fn geom_closest_points<'py>(
    py: Python<'py>,
    positions: Triples<'py>,
    triangles: Corners<'py>,
    queries: Triples<'py>,
) -> PyResult<ClosestArrays<'py>> {
    let bvh = bvh(&positions, &triangles)?;
    let queries = points(&queries)?;
    let found = py.detach(|| tress_geom::closest_points(&bvh, &queries));
    let distances = found.iter().map(|c| c.distance).collect();
    Ok(closest_arrays(py, &found, distances))
}

/// As `geom_closest_points`, with distances negative inside.
#[pyfunction]
fn geom_signed_distances<'py>(
    py: Python<'py>,
    positions: Triples<'py>,
    triangles: Corners<'py>,
    queries: Triples<'py>,
) -> PyResult<ClosestArrays<'py>> {
    let bvh = bvh(&positions, &triangles)?;
    let queries = points(&queries)?;
    let found = py.detach(|| tress_geom::signed_distances(&bvh, &queries));
    let closest: Vec<Closest> = found.iter().map(|s| s.closest).collect();
    let distances = found.iter().map(|s| s.distance).collect();
    Ok(closest_arrays(py, &closest, distances))
}

/// Generalised winding numbers.
#[pyfunction]
fn geom_winding_numbers<'py>(
    py: Python<'py>,
    positions: Triples<'py>,
    triangles: Corners<'py>,
    queries: Triples<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let bvh = bvh(&positions, &triangles)?;
    let queries = points(&queries)?;
    Ok(py.detach(|| tress_geom::winding_numbers(&bvh, &queries)).into_pyarray(py))
}

/// Triangle (-1: none), barycentric coordinates and multiple of the direction (infinite: none) of the first hits.
#[pyfunction]
fn geom_first_hits<'py>(
    py: Python<'py>,
    positions: Triples<'py>,
    triangles: Corners<'py>,
    origins: Triples<'py>,
    directions: Triples<'py>,
    limit: f64,
) -> PyResult<ClosestArrays<'py>> {
    let bvh = bvh(&positions, &triangles)?;
    let rays = rays(&origins, &directions, limit)?;
    let hits = py.detach(|| tress_geom::first_hits(&bvh, &rays));
    let triangle: Vec<i32> = hits.iter().map(|h| h.map_or(-1, |h| h.triangle as i32)).collect();
    let barycentric = rows(hits.iter().map(|h| h.map_or([0.0; 3], |h| h.barycentric)));
    let t: Vec<f64> = hits.iter().map(|h| h.map_or(f64::INFINITY, |h| h.t)).collect();
    Ok((triangle.into_pyarray(py), barycentric.into_pyarray(py), t.into_pyarray(py)))
}

/// Whether each ray hits anything.
#[pyfunction]
fn geom_any_hits<'py>(
    py: Python<'py>,
    positions: Triples<'py>,
    triangles: Corners<'py>,
    origins: Triples<'py>,
    directions: Triples<'py>,
    limit: f64,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let bvh = bvh(&positions, &triangles)?;
    let rays = rays(&origins, &directions, limit)?;
    Ok(py.detach(|| tress_geom::any_hits(&bvh, &rays)).into_pyarray(py))
}

fn bvh(positions: &Triples<'_>, triangles: &Corners<'_>) -> PyResult<Bvh> {
    let mesh = TriangleMesh::from_flat(positions.as_slice()?, triangles.as_slice()?).map_err(refused)?;
    Bvh::new(&mesh).map_err(refused)
}

fn rays(origins: &Triples<'_>, directions: &Triples<'_>, limit: f64) -> PyResult<Vec<Ray>> {
    let pairs = points(origins)?.into_iter().zip(points(directions)?);
    Ok(pairs.map(|(origin, direction)| Ray { origin, direction, limit }).collect())
}

fn closest_arrays<'py>(py: Python<'py>, found: &[Closest], distances: Vec<f64>) -> ClosestArrays<'py> {
    let triangle: Vec<i32> = found.iter().map(|c| c.triangle as i32).collect();
    let barycentric = rows(found.iter().map(|c| c.barycentric));
    (triangle.into_pyarray(py), barycentric.into_pyarray(py), distances.into_pyarray(py))
}

fn rows(values: impl Iterator<Item = [f64; 3]>) -> Array2<f64> {
    values.collect::<Vec<_>>().into()
}

fn points(array: &Triples<'_>) -> PyResult<Vec<DVec3>> {
    Ok(array.as_slice()?.chunks_exact(3).map(DVec3::from_slice).collect())
}

fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
