//! `tress-strands` for Python.

use glam::DVec3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_strands::{Sampling, StrandError, Strands};

type Points<'py> = PyReadonlyArray2<'py, f64>;
type Offsets<'py> = PyReadonlyArray1<'py, i64>;
type SamplingArrays<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>);

/// Adds the functions of `tress-strands` to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(strands_arc_lengths, module)?)?;
    module.add_function(wrap_pyfunction!(strands_lengths, module)?)?;
    module.add_function(wrap_pyfunction!(strands_resample_by_count, module)?)?;
    module.add_function(wrap_pyfunction!(strands_resample_by_spacing, module)?)?;
    module.add_function(wrap_pyfunction!(strands_smooth, module)?)?;
    module.add_function(wrap_pyfunction!(strands_transformed, module)?)
}

/// Length of every strand.
#[pyfunction]
fn strands_lengths<'py>(
    py: Python<'py>,
    points: Points<'py>,
    offsets: Offsets<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (points, offsets) = (vectors(&points)?, offsets.as_slice()?);
    let strands = Strands::new(&points, offsets).map_err(refused)?;
    Ok(py.detach(|| tress_strands::lengths(&strands)).into_pyarray(py))
}

/// Length from the root to every point.
#[pyfunction]
fn strands_arc_lengths<'py>(
    py: Python<'py>,
    points: Points<'py>,
    offsets: Offsets<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (points, offsets) = (vectors(&points)?, offsets.as_slice()?);
    let strands = Strands::new(&points, offsets).map_err(refused)?;
    Ok(py.detach(|| tress_strands::arc_lengths(&strands)).into_pyarray(py))
}

/// Offsets, index and fraction of `count` points on every strand.
#[pyfunction]
fn strands_resample_by_count<'py>(
    py: Python<'py>,
    points: Points<'py>,
    offsets: Offsets<'py>,
    count: usize,
) -> PyResult<SamplingArrays<'py>> {
    let (points, offsets) = (vectors(&points)?, offsets.as_slice()?);
    let strands = Strands::new(&points, offsets).map_err(refused)?;
    Ok(sampling(py, py.detach(|| tress_strands::resample_by_count(&strands, count))))
}

/// Offsets, index and fraction of points at most `spacing` apart.
#[pyfunction]
fn strands_resample_by_spacing<'py>(
    py: Python<'py>,
    points: Points<'py>,
    offsets: Offsets<'py>,
    spacing: f64,
) -> PyResult<SamplingArrays<'py>> {
    let (points, offsets) = (vectors(&points)?, offsets.as_slice()?);
    let strands = Strands::new(&points, offsets).map_err(refused)?;
    Ok(sampling(py, py.detach(|| tress_strands::resample_by_spacing(&strands, spacing))))
}

/// Smoothed points.
#[pyfunction]
fn strands_smooth<'py>(
    py: Python<'py>,
    points: Points<'py>,
    offsets: Offsets<'py>,
    amount: f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (points, offsets) = (vectors(&points)?, offsets.as_slice()?);
    let strands = Strands::new(&points, offsets).map_err(refused)?;
    let found = py.detach(|| tress_strands::smooth(&strands, amount));
    Ok(Array2::from(found.iter().map(DVec3::to_array).collect::<Vec<_>>()).into_pyarray(py))
}

/// Points (N, 3) under the upper three rows of a matrix (4, 4).
#[pyfunction]
fn strands_transformed<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f32>,
    transform: Points<'py>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (points, numbers) = (points.as_slice()?.as_chunks().0, transform.as_slice()?);
    let matrix = std::array::from_fn(|row| std::array::from_fn(|column| numbers[row * 4 + column]));
    Ok(Array2::from(py.detach(|| tress_strands::transformed(points, &matrix))).into_pyarray(py))
}

fn sampling(py: Python<'_>, found: Sampling) -> SamplingArrays<'_> {
    (found.offsets.into_pyarray(py), found.index.into_pyarray(py), found.fraction.into_pyarray(py))
}

fn vectors(array: &Points<'_>) -> PyResult<Vec<DVec3>> {
    Ok(array.as_slice()?.chunks_exact(3).map(DVec3::from_slice).collect())
}

fn refused(error: StrandError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
