//! Orientation, tracing and completion of `tress-image` for Python.

use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_image::gabor::GaborBank;
use tress_image::gabor_kernel::GaborParams;
use tress_image::orientation::{OrientSettings, orient};
use tress_image::patchmatch::{CompletionParams, Picture, complete};
use tress_image::raster_view::Plane;
use tress_image::ridges::seeds;
use tress_image::trace::{TraceParams, trace};

type Plane32<'py> = PyReadonlyArray2<'py, f32>;
type Mask<'py> = PyReadonlyArray2<'py, bool>;
type Orientation<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<f32>>);
type Curves<'py> =
    (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<f32>>);

/// Adds the functions of `tress-image` to the module, those of the matting aside.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(image_gabor_responses, module)?)?;
    module.add_function(wrap_pyfunction!(image_orient, module)?)?;
    module.add_function(wrap_pyfunction!(image_seeds, module)?)?;
    module.add_function(wrap_pyfunction!(image_trace, module)?)?;
    module.add_function(wrap_pyfunction!(image_complete, module)?)
}

/// Responses (orientations, H, W) of the whole bank at every pixel.
#[pyfunction]
fn image_gabor_responses<'py>(
    py: Python<'py>,
    image: Plane32<'py>,
    sizes: (f64, f64, f64),
    orientations: usize,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let bank = bank(sizes, orientations)?;
    let view = plane(&image)?;
    let responses = py.detach(|| bank.all_responses(view)).map_err(refused)?;
    responses.into_pyarray(py).reshape([orientations, view.height, view.width])
}

/// Strand direction (NaN outside the mask) and unscaled confidence (0 outside).
#[pyfunction]
fn image_orient<'py>(
    py: Python<'py>,
    image: Plane32<'py>,
    mask: Mask<'py>,
    sizes: Vec<(f64, f64, f64)>,
    orientations: usize,
    between_bins: bool,
    ridges_only: bool,
) -> PyResult<Orientation<'py>> {
    let banks: Vec<GaborBank> = sizes.into_iter().map(|sizes| bank(sizes, orientations)).collect::<PyResult<_>>()?;
    let settings = OrientSettings { between_bins, ridges_only };
    let (view, mask) = (plane(&image)?, mask.as_slice()?);
    let found = py.detach(|| orient(view, mask, &banks, settings)).map_err(refused)?;
    let shape = [view.height, view.width];
    Ok((found.angle.into_pyarray(py).reshape(shape)?, found.weight.into_pyarray(py).reshape(shape)?))
}

/// Indices of the seed pixels, by falling confidence.
#[pyfunction]
fn image_seeds<'py>(
    py: Python<'py>,
    angle: Plane32<'py>,
    confidence: Plane32<'py>,
    high: f64,
    epsilon: f64,
    reach_px: f64,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let (angle, view) = (angle.as_slice()?, plane(&confidence)?);
    view.check(angle.len()).map_err(refused)?;
    let found = py.detach(|| seeds(view, angle, high, epsilon, reach_px));
    Ok(found.into_iter().map(i64::from).collect::<Vec<_>>().into_pyarray(py))
}

/// Points (N, 2), offsets (S + 1,), occluded (N,), confidence (N,).
#[pyfunction]
#[pyo3(signature = (angle, confidence, mask, *, high, low, epsilon, health, step_px, max_bend, reach_px, min_length_px, smoothing_px))]
fn image_trace<'py>(
    py: Python<'py>,
    angle: Plane32<'py>,
    confidence: Plane32<'py>,
    mask: Mask<'py>,
    high: f64,
    low: f64,
    epsilon: f64,
    health: u32,
    step_px: f64,
    max_bend: f64,
    reach_px: f64,
    min_length_px: f64,
    smoothing_px: f64,
) -> PyResult<Curves<'py>> {
    let (angle, view, mask) = (angle.as_slice()?, plane(&confidence)?, mask.as_slice()?);
    let params = TraceParams { high, low, epsilon, health, step_px, max_bend, reach_px, min_length_px, smoothing_px };
    let traced = py.detach(|| trace(angle, view, mask, params)).map_err(refused)?;
    let points: Vec<f32> = traced.points.iter().flat_map(|p| [p.x as f32, p.y as f32]).collect();
    let offsets: Vec<i64> = traced.offsets.iter().map(|&o| o as i64).collect();
    Ok((
        points.into_pyarray(py).reshape([traced.occluded.len(), 2])?,
        offsets.into_pyarray(py),
        traced.occluded.into_pyarray(py),
        traced.confidence.into_pyarray(py),
    ))
}

/// The picture (H, W, C) with its hole filled; the last `guides` channels are known everywhere.
#[pyfunction]
#[pyo3(signature = (picture, hole, source, *, guides, patch, levels, rounds, seed))]
fn image_complete<'py>(
    py: Python<'py>,
    picture: PyReadonlyArray3<'py, f32>,
    hole: Mask<'py>,
    source: Mask<'py>,
    guides: usize,
    patch: usize,
    levels: usize,
    rounds: usize,
    seed: u64,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let [height, width, channels] = [picture.shape()[0], picture.shape()[1], picture.shape()[2]];
    let given = Picture { values: picture.as_slice()?.to_vec(), width, height, channels, guides };
    let (hole, source) = (hole.as_slice()?, source.as_slice()?);
    let params = CompletionParams { patch, levels, rounds, seed };
    let filled = py.detach(|| complete(&given, hole, source, params)).map_err(refused)?;
    filled.values.into_pyarray(py).reshape([height, width, channels])
}

fn bank((sigma_u, sigma_v, wavelength): (f64, f64, f64), orientations: usize) -> PyResult<GaborBank> {
    GaborBank::new(GaborParams { sigma_u, sigma_v, wavelength, orientations }).map_err(refused)
}

fn plane<'a>(array: &'a Plane32<'_>) -> PyResult<Plane<'a>> {
    let [height, width] = [array.shape()[0], array.shape()[1]];
    Ok(Plane { values: array.as_slice()?, width, height })
}

fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
