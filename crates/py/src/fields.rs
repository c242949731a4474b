//! `tress-fields` for Python.

use glam::{DVec2, DVec3};
use numpy::PyUntypedArrayMethods;
use numpy::ndarray::{Array2, ArrayView2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3, PyReadonlyArray4};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress_fields::axes::diffuse_axes;
use tress_fields::depth::{DepthOptions, strand_depths};
use tress_fields::diffuse::{DiffuseOptions, diffuse};
use tress_fields::distance::distance;
use tress_fields::mesh_depth::mesh_depth;
use tress_fields::nearest::nearest;
use tress_fields::neighbours::{Lists, NeighbourOptions, neighbours};
use tress_fields::principal::principal_axes;
use tress_fields::sample::sample;
use tress_fields::trace::{Seed, TraceOptions, trace};
use tress_fields::{FieldError, FrontSheet, GridShape, VoxelField};

type Flat<'py, T> = Bound<'py, PyArray1<T>>;

/// Adds the functions of `tress-fields` to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(fields_distance, module)?)?;
    module.add_function(wrap_pyfunction!(fields_nearest, module)?)?;
    module.add_function(wrap_pyfunction!(fields_sample, module)?)?;
    module.add_function(wrap_pyfunction!(fields_diffuse, module)?)?;
    module.add_function(wrap_pyfunction!(fields_diffuse_axes, module)?)?;
    module.add_function(wrap_pyfunction!(fields_mesh_depth, module)?)?;
    module.add_function(wrap_pyfunction!(fields_principal_axes, module)?)?;
    module.add_function(wrap_pyfunction!(fields_neighbours, module)?)?;
    module.add_function(wrap_pyfunction!(fields_strand_depths, module)?)?;
    module.add_function(wrap_pyfunction!(fields_trace, module)?)
}

fn refused(error: FieldError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn shape_of(sizes: &[usize]) -> GridShape {
    GridShape { layers: sizes[0], rows: sizes[1], columns: sizes[2] }
}

fn points3(view: ArrayView2<'_, f64>) -> Vec<DVec3> {
    view.rows().into_iter().map(|r| DVec3::new(r[0], r[1], r[2])).collect()
}

fn triples(points: &[DVec3]) -> PyResult<Array2<f64>> {
    let flat = points.iter().flat_map(|p| p.to_array()).collect();
    Array2::from_shape_vec((points.len(), 3), flat).map_err(|e| PyValueError::new_err(e.to_string()))
}

/// Distance in voxels to the nearest marked voxel, flat.
#[pyfunction]
fn fields_distance<'py>(py: Python<'py>, inside: PyReadonlyArray3<'py, bool>) -> PyResult<Flat<'py, f32>> {
    let shape = shape_of(inside.shape());
    let marks = inside.as_slice()?;
    Ok(py.detach(|| distance(marks, shape)).map_err(refused)?.into_pyarray(py))
}

/// Distance in voxels to the nearest marked voxel, and its number; both flat.
#[pyfunction]
fn fields_nearest<'py>(
    py: Python<'py>,
    inside: PyReadonlyArray3<'py, bool>,
) -> PyResult<(Flat<'py, f32>, Flat<'py, u32>)> {
    let shape = shape_of(inside.shape());
    let marks = inside.as_slice()?;
    let out = py.detach(|| nearest(marks, shape)).map_err(refused)?;
    Ok((out.distance.into_pyarray(py), out.cell.into_pyarray(py)))
}

/// Values between the voxels' centres; `places` has rows of column, row, layer.
#[pyfunction]
fn fields_sample<'py>(
    py: Python<'py>,
    values: PyReadonlyArray3<'py, f32>,
    places: PyReadonlyArray2<'py, f64>,
) -> PyResult<Flat<'py, f32>> {
    let (shape, places) = (shape_of(values.shape()), points3(places.as_array()));
    let values = values.as_slice()?;
    Ok(py.detach(|| sample(values, &places, shape)).map_err(refused)?.into_pyarray(py))
}

/// Directions of the marked voxels, in their order, from their vectors and weights; steps, converged.
#[pyfunction]
fn fields_diffuse_axes<'py>(
    py: Python<'py>,
    mask: PyReadonlyArray3<'py, bool>,
    vectors: PyReadonlyArray2<'py, f64>,
    weights: PyReadonlyArray1<'py, f64>,
    accuracy: f64,
    max_iterations: usize,
) -> PyResult<(Bound<'py, PyArray2<f64>>, usize, bool)> {
    let (shape, vectors) = (shape_of(mask.shape()), points3(vectors.as_array()));
    let (mask, weights) = (mask.as_slice()?, weights.as_slice()?);
    let options = DiffuseOptions { accuracy, max_iterations };
    let out = py.detach(|| diffuse_axes(mask, &vectors, weights, shape, options)).map_err(refused)?;
    Ok((triples(&out.axes)?.into_pyarray(py), out.iterations, out.converged))
}

/// Diffused values (flat), steps, converged. Weights of infinity fix a cell.
#[pyfunction]
fn fields_diffuse<'py>(
    py: Python<'py>,
    mask: PyReadonlyArray3<'py, bool>,
    weights: PyReadonlyArray3<'py, f64>,
    values: PyReadonlyArray4<'py, f64>,
    accuracy: f64,
    max_iterations: usize,
) -> PyResult<(Flat<'py, f64>, usize, bool)> {
    let sizes = values.shape();
    let (shape, channels) = (shape_of(sizes), sizes[3]);
    let (mask, weights, values) = (mask.as_slice()?, weights.as_slice()?, values.as_slice()?);
    let options = DiffuseOptions { accuracy, max_iterations };
    let out = py.detach(|| diffuse(mask, weights, values, channels, shape, options)).map_err(refused)?;
    Ok((out.values.into_pyarray(py), out.iterations, out.converged))
}

/// Front and back depth of a mesh, flat; NaN where it is not.
#[pyfunction]
fn fields_mesh_depth<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, i32>,
    rows: usize,
    columns: usize,
) -> PyResult<(Flat<'py, f64>, Flat<'py, f64>)> {
    let vertices = points3(vertices.as_array());
    let corners: Vec<[i32; 3]> = triangles.as_array().rows().into_iter().map(|r| [r[0], r[1], r[2]]).collect();
    let out = py.detach(|| mesh_depth(&vertices, &corners, rows, columns)).map_err(refused)?;
    Ok((out.front.into_pyarray(py), out.back.into_pyarray(py)))
}

/// Principal axes of tensors (xx, yy, zz, xy, xz, yz), on the side of the hints.
#[pyfunction]
fn fields_principal_axes<'py>(
    py: Python<'py>,
    tensors: PyReadonlyArray2<'py, f64>,
    hints: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let hints = points3(hints.as_array());
    let tensors: Vec<[f64; 6]> = tensors.as_slice()?.as_chunks().0.to_vec();
    if tensors.len() != hints.len() {
        let error = FieldError::Length { name: "hints", found: hints.len(), expected: tensors.len() };
        return Err(refused(error));
    }
    let axes = py.detach(|| principal_axes(&tensors, &hints));
    Ok(triples(&axes)?.into_pyarray(py))
}

/// Neighbour lists: starts and members.
#[pyfunction]
fn fields_neighbours<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    offsets: PyReadonlyArray1<'py, i64>,
    occluded: PyReadonlyArray1<'py, bool>,
    radius: f64,
    min_cosine: f64,
    most: usize,
) -> PyResult<(Flat<'py, i64>, Flat<'py, u32>)> {
    let points: Vec<DVec2> = points.as_array().rows().into_iter().map(|r| DVec2::new(r[0], r[1])).collect();
    let (offsets, occluded) = (offsets.as_slice()?, occluded.as_slice()?);
    let options = NeighbourOptions { radius, min_cosine, most };
    let lists = py.detach(|| neighbours(&points, offsets, occluded, options)).map_err(refused)?;
    let starts: Vec<i64> = lists.starts.iter().map(|&s| s as i64).collect();
    Ok((starts.into_pyarray(py), lists.members.into_pyarray(py)))
}

/// Depths, steps, converged, relative residual.
#[pyfunction]
fn fields_strand_depths<'py>(
    py: Python<'py>,
    offsets: PyReadonlyArray1<'py, i64>,
    starts: PyReadonlyArray1<'py, i64>,
    members: PyReadonlyArray1<'py, u32>,
    target: PyReadonlyArray1<'py, f64>,
    weight: PyReadonlyArray1<'py, f64>,
    start: PyReadonlyArray1<'py, f64>,
    options: (f64, f64, f64, usize),
) -> PyResult<(Flat<'py, f64>, usize, bool, f64)> {
    let lists = Lists {
        starts: starts.as_slice()?.iter().map(|&s| s as usize).collect(),
        members: members.as_slice()?.to_vec(),
    };
    let options = DepthOptions {
        strand_weight: options.0,
        neighbour_weight: options.1,
        accuracy: options.2,
        max_iterations: options.3,
    };
    let (offsets, target) = (offsets.as_slice()?, target.as_slice()?);
    let (weight, start) = (weight.as_slice()?, start.as_slice()?);
    let out = py.detach(|| strand_depths(offsets, &lists, target, weight, start, options)).map_err(refused)?;
    Ok((out.z.into_pyarray(py), out.iterations, out.converged, out.residual))
}

/// The box and the picture of a trace.
#[derive(FromPyObject)]
struct Scene<'py> {
    direction: PyReadonlyArray4<'py, f32>,
    head_distance: PyReadonlyArray3<'py, f32>,
    origin: [f64; 3],
    size: f64,
    sheet_depth: PyReadonlyArray2<'py, f32>,
    sheet_direction: PyReadonlyArray3<'py, f32>,
    scale: f64,
    centre: [f64; 2],
}

/// Settings of a trace, by name.
#[derive(FromPyObject)]
struct Settings {
    step: f64,
    min_length: f64,
    sheet_depth: f64,
    min_cosine: f64,
    inertia: f64,
    voxel_cap: u16,
    pixel_cap: u16,
    clearance: f64,
    most: usize,
}

/// Points, offsets, seed of each strand, rooted, density.
type TraceArrays<'py> = (Bound<'py, PyArray2<f64>>, Flat<'py, i64>, Flat<'py, u32>, Flat<'py, bool>, Flat<'py, u16>);

/// Strands through a field; `seeds` has rows of x, y, z, forward, backward.
#[pyfunction]
fn fields_trace<'py>(
    py: Python<'py>,
    scene: Scene<'py>,
    seeds: PyReadonlyArray2<'py, f64>,
    density: PyReadonlyArray1<'py, u16>,
    settings: Settings,
) -> PyResult<TraceArrays<'py>> {
    let shape = shape_of(scene.head_distance.shape());
    let picture = scene.sheet_depth.shape().to_vec();
    let field = VoxelField {
        shape,
        origin: DVec3::from_array(scene.origin),
        size: scene.size,
        direction: scene.direction.as_slice()?.as_chunks().0,
        head_distance: scene.head_distance.as_slice()?,
    };
    let sheet = FrontSheet {
        rows: picture[0],
        columns: picture[1],
        scale: scene.scale,
        centre: DVec2::from_array(scene.centre),
        depth: scene.sheet_depth.as_slice()?,
        direction: scene.sheet_direction.as_slice()?.as_chunks().0,
    };
    let seeds: Vec<Seed> = seeds
        .as_array()
        .rows()
        .into_iter()
        .map(|r| Seed { point: DVec3::new(r[0], r[1], r[2]), forward: r[3], backward: r[4] })
        .collect();
    let options = TraceOptions {
        step: settings.step,
        min_length: settings.min_length,
        sheet_depth: settings.sheet_depth,
        min_cosine: settings.min_cosine,
        inertia: settings.inertia,
        voxel_cap: settings.voxel_cap,
        pixel_cap: settings.pixel_cap,
        clearance: settings.clearance,
        most: settings.most,
    };
    let mut density = density.as_slice()?.to_vec();
    let out = py.detach(|| trace(&field, &sheet, &seeds, &mut density, options)).map_err(refused)?;
    Ok((
        triples(&out.points)?.into_pyarray(py),
        out.offsets.into_pyarray(py),
        out.seed.into_pyarray(py),
        out.rooted.into_pyarray(py),
        density.into_pyarray(py),
    ))
}
