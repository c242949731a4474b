//! `tress-geom` for Python.

use pyo3::prelude::*;

/// Adds the functions of `tress-geom` to the module.
pub fn register(_module: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}
