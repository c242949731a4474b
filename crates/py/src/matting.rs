//! The matting of `tress-image` for Python.

use numpy::{IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_image::matting::{MattingSettings, closed_form_alpha};

/// Adds the function of the matting to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(matting_alpha, module)?)
}

/// Alpha (H, W), iterations, relative residual, whether it converged.
#[pyfunction]
fn matting_alpha<'py>(
    py: Python<'py>,
    image: PyReadonlyArray3<'py, f32>,
    trimap: PyReadonlyArray2<'py, u8>,
    epsilon: f64,
    tolerance: f64,
    max_iterations: usize,
    settle: f64,
) -> PyResult<(Bound<'py, PyArray2<f32>>, usize, f64, bool)> {
    let [height, width] = [trimap.shape()[0], trimap.shape()[1]];
    let color = pixels(image.as_slice()?);
    let trimap = trimap.as_slice()?.to_vec();
    let settings = MattingSettings { epsilon, tolerance, max_iterations, settle, ..MattingSettings::default() };
    let result = py
        .detach(|| closed_form_alpha(&color, &trimap, width, height, &settings))
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let alpha: Vec<f32> = result.alpha.iter().map(|&a| a as f32).collect();
    let alpha = alpha.into_pyarray(py).reshape([height, width])?;
    Ok((alpha, result.outcome.iterations, result.outcome.residual, result.outcome.converged))
}

fn pixels(flat: &[f32]) -> Vec<[f64; 3]> {
    flat.chunks_exact(3).map(|rgb| [f64::from(rgb[0]), f64::from(rgb[1]), f64::from(rgb[2])]).collect()
}
