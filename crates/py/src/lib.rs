//! The Python extension module `tress._core`: conversions and GIL release, no algorithm.
//!
//! One file a crate: `geom.rs` (with `curves.rs` and `nurbs.rs`), `strands.rs`, `fields.rs`, `image.rs`, `matting.rs`,
//! `raster.rs`, `dynamics.rs`. Each has a `register` that adds its functions to the module. Arrays come in as contiguous
//! `PyReadonlyArray`s and go out as fresh NumPy arrays.

use pyo3::prelude::*;

mod curves;
mod dynamics;
mod fields;
mod geom;
mod image;
mod matting;
mod nurbs;
mod raster;
mod strands;

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    geom::register(module)?;
    curves::register(module)?;
    nurbs::register(module)?;
    strands::register(module)?;
    fields::register(module)?;
    image::register(module)?;
    matting::register(module)?;
    raster::register(module)?;
    dynamics::register(module)
}
