//! `tress-raster` for Python.

use pyo3::prelude::*;

/// Adds the functions of `tress-raster` to the module.
pub fn register(_module: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}
