//! Curves of `tress-geom` for Python.

use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use tress_geom::nurbs::{self, ArcLength, Curve, FitSettings, Knots};

use crate::nurbs::{KnotArrays, Numbers, Triples, knots_of, refused, rows, triples, vectors};

type CurveArrays<'py> = (Triples<'py>, Numbers<'py>, Numbers<'py>, usize);
/// Parameters, points and distances.
type ClosestArrays<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);
type NewCurve<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Adds the functions of curves to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(nurbs_check_curve, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_points, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_over, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_refined, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_clamped, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_closest, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_lengths, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_parameters, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_curve_by_arc_length, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_chord_parameters, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_knots_for, module)?)?;
    module.add_function(wrap_pyfunction!(nurbs_fit_curve, module)?)
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
    let knots = knots_of(&knots, curve.knots().degree())?;
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

/// Parameter, point and distance of the closest points.
#[pyfunction]
fn nurbs_curve_closest<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    queries: Triples<'py>,
) -> PyResult<ClosestArrays<'py>> {
    let (curve, queries) = (curve(&arrays)?, vectors(&queries)?);
    let found = py.detach(|| curve.closest(&queries)).map_err(refused)?;
    let parameters: Vec<f64> = found.iter().map(|c| c.parameter).collect();
    let distances: Vec<f64> = found.iter().map(|c| c.distance).collect();
    let points = rows(found.iter().map(|c| c.point.to_array()));
    Ok((parameters.into_pyarray(py), points.into_pyarray(py), distances.into_pyarray(py)))
}

/// Lengths from the start of the curve to parameters.
#[pyfunction]
fn nurbs_curve_lengths<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    at: Numbers<'py>,
    accuracy: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let curve = curve(&arrays)?;
    let at = parameters(&curve, &at)?;
    let lengths = ArcLength::new(&curve, accuracy);
    Ok(at.iter().map(|&t| lengths.length_at(t)).collect::<Vec<_>>().into_pyarray(py))
}

/// Parameters at lengths from the start of the curve.
#[pyfunction]
fn nurbs_curve_parameters<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    lengths: Numbers<'py>,
    accuracy: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let curve = curve(&arrays)?;
    let along = ArcLength::new(&curve, accuracy);
    let found: Result<Vec<f64>, _> = lengths.as_slice()?.iter().map(|&length| along.parameter_at(length)).collect();
    Ok(found.map_err(refused)?.into_pyarray(py))
}

/// The cubic by arc length, and how far it lies from the curve.
#[pyfunction]
fn nurbs_curve_by_arc_length<'py>(
    py: Python<'py>,
    arrays: CurveArrays<'py>,
    accuracy: f64,
) -> PyResult<(NewCurve<'py>, f64)> {
    let curve = curve(&arrays)?;
    let found = py.detach(|| nurbs::by_arc_length(&curve, accuracy)).map_err(refused)?;
    Ok((new_curve(py, &found.curve), found.deviation))
}

/// Parameters in proportion to the chords.
#[pyfunction]
fn nurbs_chord_parameters<'py>(py: Python<'py>, points: Triples<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
    Ok(nurbs::chord_parameters(&vectors(&points)?).into_pyarray(py))
}

/// Knots over sorted parameters.
#[pyfunction]
fn nurbs_knots_for<'py>(
    py: Python<'py>,
    parameters: Numbers<'py>,
    degree: usize,
    count: usize,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let knots = nurbs::knots_for(parameters.as_slice()?, degree, count).map_err(refused)?;
    Ok(knots.values().to_vec().into_pyarray(py))
}

/// The curve nearest to points.
#[pyfunction]
fn nurbs_fit_curve<'py>(
    py: Python<'py>,
    knots: KnotArrays<'py>,
    parameters: Numbers<'py>,
    points: Triples<'py>,
    smoothness: f64,
    fix_ends: bool,
) -> PyResult<NewCurve<'py>> {
    let (knots, points) = (knots_of(&knots.0, knots.1)?, vectors(&points)?);
    let settings = FitSettings { smoothness, fix_ends };
    let fitted = nurbs::fit_curve(knots, parameters.as_slice()?, &points, settings).map_err(refused)?;
    Ok(new_curve(py, &fitted))
}

fn curve((points, weights, knots, degree): &CurveArrays<'_>) -> PyResult<Curve> {
    let points = vectors(points)?;
    let knots = Knots::new(*degree, points.len(), knots.as_slice()?.to_vec()).map_err(refused)?;
    Curve::new(knots, &points, weights.as_slice()?).map_err(refused)
}

fn parameters(curve: &Curve, at: &Numbers<'_>) -> PyResult<Vec<f64>> {
    at.as_slice()?.iter().map(|&t| curve.knots().inside(t).map_err(refused)).collect()
}

fn new_curve<'py>(py: Python<'py>, curve: &Curve) -> NewCurve<'py> {
    let (points, weights) = curve.control();
    let knots = curve.knots().values().to_vec();
    (triples(&points).into_pyarray(py), weights.into_pyarray(py), knots.into_pyarray(py))
}
