//! Curves and surfaces of `tress-geom` for Python.

use glam::DVec3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_geom::nurbs::{self, Curve, FlatSurfaces, Jet, Knots, Query, Surface};

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Indices<'py> = PyReadonlyArray1<'py, i64>;
type Triples<'py> = PyReadonlyArray2<'py, f64>;
type Pairs<'py> = PyReadonlyArray2<'py, f64>;
type CurveArrays<'py> = (Triples<'py>, Numbers<'py>, Numbers<'py>, usize);
type SurfaceArrays<'py> =
    (Triples<'py>, Numbers<'py>, PyReadonlyArray2<'py, i64>, PyReadonlyArray2<'py, i64>, Numbers<'py>, Numbers<'py>);
type NewCurve<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);
type NewSurface<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, [Bound<'py, PyArray1<f64>>; 2]);

/// Adds the functions of curves and surfaces to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(nurbs_check_curve, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_points, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_over, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_refined, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_clamped, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_check_surfaces, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_grids, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_points, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_normals, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_surface_refined, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_surface_clamped, module)?)
}

/// Refuses arrays that make no curve.
#[pyfunction]
fn nurbs_check_curve(arrays: CurveArrays<'_>) -> PyResult<()> {
    curve(&arrays).map(|_| ())
}

/// Points at parameters.
#[pyfunction]
fn nurbs_curve_points<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    at: Numbers<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let curve = curve(&arrays)?;
    let at = parameters(&curve, &at)?;
    Ok(rows(at.iter().map(|&t| curve.point(t).to_array())).into_pyarray(py))
}

/// Points, first and second derivatives at parameters, in one row of nine.
#[pyfunction]
fn nurbs_curve_derivatives<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    at: Numbers<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let curve = curve(&arrays)?;
    let at = parameters(&curve, &at)?;
    Ok(rows(at.iter().flat_map(|&t| curve.derivatives(t)).map(|d| d.to_array())).into_pyarray(py))
}

/// The curve over other knots.
#[pyfunction]
fn nurbs_curve_over<'py>(py: Python<'py>, arrays: CurveArrays<'py>, knots: Numbers<'py>) -> PyResult<NewCurve<'py>> {
    let curve = curve(&arrays)?;
    let degree = curve.knots().degree();
    let count = knots.as_slice()?.len().saturating_sub(degree + 1);
    let knots = Knots::new(degree, count, knots.as_slice()?.to_vec()).map_err(refused)?;
    Ok(new_curve(py, &curve.over(knots).map_err(refused)?))
}

/// The curve with more knots.
#[pyfunction]
fn nurbs_curve_refined<'py>(py: Python<'py>, arrays: CurveArrays<'py>, more: Numbers<'py>) -> PyResult<NewCurve<'py>> {
    let refined = curve(&arrays)?.refined(more.as_slice()?).map_err(refused)?;
    Ok(new_curve(py, &refined))
}

/// The curve with clamped knots.
#[pyfunction]
fn nurbs_curve_clamped<'py>(py: Python<'py>, arrays: CurveArrays<'py>) -> PyResult<NewCurve<'py>> {
    Ok(new_curve(py, &curve(&arrays)?.clamped().map_err(refused)?))
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

fn curve((points, weights, knots, degree): &CurveArrays<'_>) -> PyResult<Curve> {
    let points = vectors(points)?;
    let knots = Knots::new(*degree, points.len(), knots.as_slice()?.to_vec()).map_err(refused)?;
    Curve::new(knots, &points, weights.as_slice()?).map_err(refused)
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

fn parameters(curve: &Curve, at: &Numbers<'_>) -> PyResult<Vec<f64>> {
    at.as_slice()?.iter().map(|&t| curve.knots().inside(t).map_err(refused)).collect()
}

fn new_curve<'py>(py: Python<'py>, curve: &Curve) -> NewCurve<'py> {
    let (points, weights) = curve.control();
    let knots = curve.knots().values().to_vec();
    (triples(&points).into_pyarray(py), weights.into_pyarray(py), knots.into_pyarray(py))
}

fn new_surface<'py>(py: Python<'py>, surface: &Surface) -> NewSurface<'py> {
    let (points, weights) = surface.control();
    let knots = [surface.u(), surface.v()].map(|k| k.values().to_vec().into_pyarray(py));
    (triples(&points).into_pyarray(py), weights.into_pyarray(py), knots)
}

fn triples(points: &[DVec3]) -> Array2<f64> {
    rows(points.iter().map(|p| p.to_array()))
}

fn rows(values: impl Iterator<Item = [f64; 3]>) -> Array2<f64> {
    values.collect::<Vec<_>>().into()
}

fn vectors(array: &Triples<'_>) -> PyResult<Vec<DVec3>> {
    Ok(array.as_slice()?.chunks_exact(3).map(DVec3::from_slice).collect())
}

fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
