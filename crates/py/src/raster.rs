//! `tress-raster` for Python.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tress_raster::{AlphaPicture, Cutout, GBuffer, ProjectedScene, ProjectedVertex, RasterError, SegmentFragments};

type Floats<'py> = PyReadonlyArray1<'py, f32>;
type Rows<'py> = PyReadonlyArray2<'py, f32>;

/// Adds the functions of `tress-raster` to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(raster_project, module)?)?;
    module.add_function(wrap_pyfunction!(raster_gbuffer, module)?)?;
    module.add_function(wrap_pyfunction!(raster_composite, module)?)?;
    module.add_function(wrap_pyfunction!(raster_interpolated, module)?)?;
    module.add_function(wrap_pyfunction!(raster_strand_picture, module)?)?;
    module.add_function(wrap_pyfunction!(raster_visible_weight, module)?)?;
    module.add_function(wrap_pyfunction!(raster_fit_colors, module)?)?;
    module.add_function(wrap_pyfunction!(raster_alpha_coverage, module)?)?;
    module.add_function(wrap_pyfunction!(raster_alpha_scale, module)?)
}

/// Projected vertices (N, 4) of points (N, 3).
#[pyfunction]
fn raster_project<'py>(
    py: Python<'py>,
    points: Rows<'py>,
    matrix: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (points, numbers) = (points.as_slice()?.as_chunks().0, matrix.as_slice()?);
    let matrix: [[f64; 4]; 3] = std::array::from_fn(|row| std::array::from_fn(|column| numbers[row * 4 + column]));
    let projected = py.detach(|| tress_raster::project(points, &matrix)).map_err(refused)?;
    let rows: Vec<[f32; 4]> = projected.into_iter().map(Into::into).collect();
    Ok(Array2::from(rows).into_pyarray(py))
}

/// The GBuffer of projected strands and triangles, as a dictionary of arrays.
#[pyfunction]
fn raster_gbuffer<'py>(
    py: Python<'py>,
    strand_points: Rows<'py>,
    offsets: PyReadonlyArray1<'py, i64>,
    half_width_px: Floats<'py>,
    alpha: Floats<'py>,
    mesh_vertices: Rows<'py>,
    triangles: PyReadonlyArray2<'py, u32>,
    cutouts: Vec<PyReadonlyArray2<'py, u8>>,
    cutout_of_triangle: PyReadonlyArray1<'py, i32>,
    corner_uv: Rows<'py>,
    min_width_px: f32,
    width: usize,
    height: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let mesh_vertices = vertices(&mesh_vertices)?;
    let cutouts: Vec<Cutout<'_>> = cutouts
        .iter()
        .map(|picture| Ok(Cutout { alpha: picture.as_slice()?, width: picture.shape()[1] }))
        .collect::<PyResult<_>>()?;
    let scene = ProjectedScene {
        strand_points: strand_points.as_slice()?.as_chunks().0,
        offsets: offsets.as_slice()?,
        half_width_px: half_width_px.as_slice()?,
        alpha: alpha.as_slice()?,
        mesh_vertices: &mesh_vertices,
        triangles: triangles.as_slice()?.as_chunks().0,
        cutouts: &cutouts,
        cutout_of_triangle: cutout_of_triangle.as_slice()?,
        corner_uv: corner_uv.as_slice()?.as_chunks().0,
        min_width_px,
        width,
        height,
    };
    let buffer = py.detach(|| tress_raster::rasterise(&scene)).map_err(refused)?;
    as_dict(py, buffer)
}

/// Premultiplied RGBA (pixels, 4) of shaded fragments (F, 4).
#[pyfunction]
fn raster_composite<'py>(
    py: Python<'py>,
    pixel_offsets: PyReadonlyArray1<'py, i64>,
    weight: Floats<'py>,
    rgba: Rows<'py>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (offsets, weight, rgba) = (pixel_offsets.as_slice()?, weight.as_slice()?, rgba.as_slice()?.as_chunks().0);
    let picture = py.detach(|| tress_raster::composite(offsets, weight, rgba));
    Ok(Array2::from(picture).into_pyarray(py))
}

/// Premultiplied RGBA (pixels, 4) of the strands alone, in the colours (N, 3) of their points.
#[pyfunction]
fn raster_strand_picture<'py>(
    py: Python<'py>,
    pixel_offsets: PyReadonlyArray1<'py, i64>,
    kind: PyReadonlyArray1<'py, u8>,
    primitive: PyReadonlyArray1<'py, i32>,
    parameter: Rows<'py>,
    weight: Floats<'py>,
    colors: Rows<'py>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let fragments = segment_fragments(&pixel_offsets, &kind, &primitive, &parameter, &weight)?;
    let colors = colors.as_slice()?.as_chunks().0;
    Ok(Array2::from(py.detach(|| tress_raster::strand_picture(&fragments, colors))).into_pyarray(py))
}

/// Values (N, C) of the points at the places `t` (K,) from the points `first` (K,) on: (K, C).
#[pyfunction]
fn raster_interpolated<'py>(
    py: Python<'py>,
    first: PyReadonlyArray1<'py, i32>,
    t: Floats<'py>,
    values: Rows<'py>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (rows, channels) = (first.as_slice()?.len(), values.as_array().ncols());
    let (first, t, values) = (first.as_slice()?, t.as_slice()?, values.as_slice()?);
    let found = py.detach(|| tress_raster::interpolated(first, t, values, channels));
    let found = Array2::from_shape_vec((rows, channels), found).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(found.into_pyarray(py))
}

/// How much every point shows, in pixels.
#[pyfunction]
fn raster_visible_weight<'py>(
    py: Python<'py>,
    pixel_offsets: PyReadonlyArray1<'py, i64>,
    kind: PyReadonlyArray1<'py, u8>,
    primitive: PyReadonlyArray1<'py, i32>,
    parameter: Rows<'py>,
    weight: Floats<'py>,
    points: usize,
) -> PyResult<Bound<'py, PyArray1<f32>>> {
    let fragments = segment_fragments(&pixel_offsets, &kind, &primitive, &parameter, &weight)?;
    Ok(py.detach(|| tress_raster::visible_weight(&fragments, points)).into_pyarray(py))
}

/// Colours (N, 3) with which the hair in the picture has the colours of `target`.
#[pyfunction]
fn raster_fit_colors<'py>(
    py: Python<'py>,
    pixel_offsets: PyReadonlyArray1<'py, i64>,
    kind: PyReadonlyArray1<'py, u8>,
    primitive: PyReadonlyArray1<'py, i32>,
    parameter: Rows<'py>,
    weight: Floats<'py>,
    colors: Rows<'py>,
    freedom: Floats<'py>,
    target: Rows<'py>,
    pixel_weight: Floats<'py>,
    iterations: usize,
    most: f32,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let fragments = segment_fragments(&pixel_offsets, &kind, &primitive, &parameter, &weight)?;
    let (colors, target) = (colors.as_slice()?.as_chunks().0, target.as_slice()?.as_chunks().0);
    let (freedom, pixel_weight) = (freedom.as_slice()?, pixel_weight.as_slice()?);
    let found =
        py.detach(|| tress_raster::fit_colors(&fragments, colors, freedom, target, pixel_weight, iterations, most));
    Ok(Array2::from(found).into_pyarray(py))
}

/// Share of a picture (H, W) that passes an alpha test.
#[pyfunction]
fn raster_alpha_coverage(py: Python<'_>, alpha: Rows<'_>, threshold: f32) -> PyResult<f64> {
    let (texels, width) = (alpha.as_slice()?, alpha.shape()[1]);
    py.detach(|| Ok(AlphaPicture::new(texels, width)?.coverage(threshold, 1.0))).map_err(refused)
}

/// Scale of alpha (H, W) with which a wanted share passes the test.
#[pyfunction]
fn raster_alpha_scale(py: Python<'_>, alpha: Rows<'_>, threshold: f32, wanted: f64) -> PyResult<f32> {
    let (texels, width) = (alpha.as_slice()?, alpha.shape()[1]);
    py.detach(|| Ok(AlphaPicture::new(texels, width)?.scale_for_coverage(threshold, wanted))).map_err(refused)
}

fn segment_fragments<'a>(
    pixel_offsets: &'a PyReadonlyArray1<'_, i64>,
    kind: &'a PyReadonlyArray1<'_, u8>,
    primitive: &'a PyReadonlyArray1<'_, i32>,
    parameter: &'a Rows<'_>,
    weight: &'a Floats<'_>,
) -> PyResult<SegmentFragments<'a>> {
    Ok(SegmentFragments {
        pixel_offsets: pixel_offsets.as_slice()?,
        kind: kind.as_slice()?,
        primitive: primitive.as_slice()?,
        parameter: parameter.as_slice()?.as_chunks().0,
        weight: weight.as_slice()?,
    })
}

fn vertices(array: &Rows<'_>) -> PyResult<Vec<ProjectedVertex>> {
    Ok(array.as_slice()?.as_chunks().0.iter().map(|row| ProjectedVertex::from(*row)).collect())
}

fn as_dict(py: Python<'_>, buffer: GBuffer) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("pixel_offsets", buffer.pixel_offsets.into_pyarray(py))?;
    dict.set_item("kind", buffer.kind.into_pyarray(py))?;
    dict.set_item("primitive", buffer.primitive.into_pyarray(py))?;
    dict.set_item("parameter", Array2::from(buffer.parameter).into_pyarray(py))?;
    dict.set_item("weight", buffer.weight.into_pyarray(py))?;
    dict.set_item("depth", buffer.depth.into_pyarray(py))?;
    Ok(dict)
}

fn refused(error: RasterError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
