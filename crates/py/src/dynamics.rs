//! `tress-dynamics` for Python.

use crate::nurbs::{refused, vectors};
use glam::{DQuat, DVec3};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use tress_dynamics::collision::{Collider, DistanceField, Pose, Shape};
use tress_dynamics::constraints::link::Link;
use tress_dynamics::{Chains, Frame, Options, State, Wind, advance};

type Points<'py> = PyReadonlyArray2<'py, f64>;
type Rows<'py> = Bound<'py, PyArray2<f64>>;

/// Adds the functions of `tress-dynamics` to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyOptions>()?;
    module.add_class::<PyField>()?;
    module.add_function(wrap_pyfunction!(dynamics_advance, module)?)
}

/// `Options` as Python makes them.
#[pyclass(name = "DynamicsOptions", frozen)]
struct PyOptions(Options);

#[pymethods]
impl PyOptions {
    #[new]
    #[pyo3(signature = (*, gravity, stretch_n, bend_nm2, goal_n_per_m, link_n_per_m, drag_per_sec, damping_per_sec, wind,
        gusts, gust_secs, seed, friction, clearance, chain_distance, clamp_roots, substeps, iterations))]
    fn new(
        gravity: [f64; 3],
        stretch_n: f64,
        bend_nm2: f64,
        goal_n_per_m: f64,
        link_n_per_m: f64,
        drag_per_sec: f64,
        damping_per_sec: f64,
        wind: [f64; 3],
        gusts: f64,
        gust_secs: f64,
        seed: u64,
        friction: f64,
        clearance: f64,
        chain_distance: f64,
        clamp_roots: bool,
        substeps: usize,
        iterations: usize,
    ) -> Self {
        let wind = Wind { velocity: wind.into(), gusts, gust_secs, seed };
        Self(Options {
            gravity: gravity.into(),
            stretch_n,
            bend_nm2,
            goal_n_per_m,
            link_n_per_m,
            drag_per_sec,
            damping_per_sec,
            wind,
            friction,
            clearance,
            chain_distance,
            clamp_roots,
            substeps,
            iterations,
        })
    }
}

/// A distance field, kept for all frames.
#[pyclass(name = "DynamicsField", frozen)]
struct PyField {
    origin: DVec3,
    spacing: f64,
    counts: [usize; 3],
    values: Vec<f32>,
}

#[pymethods]
impl PyField {
    /// `values` (Z, Y, X).
    #[new]
    fn new(origin: [f64; 3], spacing: f64, values: PyReadonlyArray3<'_, f32>) -> PyResult<Self> {
        let shape = values.shape();
        let counts = [shape[2], shape[1], shape[0]];
        Ok(Self { origin: origin.into(), spacing, counts, values: values.as_slice()?.to_vec() })
    }
}

/// State after a frame: positions and velocities.
#[pyfunction]
fn dynamics_advance<'py>(
    py: Python<'py>,
    position: Points<'py>,
    velocity: Points<'py>,
    offsets: PyReadonlyArray1<'py, i64>,
    mass: PyReadonlyArray1<'py, f64>,
    goal_weight: PyReadonlyArray1<'py, f64>,
    goals: (Points<'py>, Points<'py>),
    secs: (f64, f64),
    links: PyReadonlyArray2<'py, i64>,
    capsules: Points<'py>,
    fields: Vec<Py<PyField>>,
    poses: (Points<'py>, Points<'py>),
    options: &PyOptions,
) -> PyResult<(Rows<'py>, Rows<'py>)> {
    let mut state = State { position: vectors(&position)?, velocity: vectors(&velocity)? };
    let offsets: Vec<usize> = offsets.as_slice()?.iter().map(|&offset| offset as usize).collect();
    let chains = Chains { offsets: &offsets, mass: mass.as_slice()?, goal_weight: goal_weight.as_slice()? };
    let (before, after) = (vectors(&goals.0)?, vectors(&goals.1)?);
    let links: Vec<Link> =
        links.as_slice()?.chunks_exact(2).map(|pair| Link { from: pair[0] as usize, to: pair[1] as usize }).collect();
    let fields: Vec<&PyField> = fields.iter().map(|field| field.get()).collect();
    let colliders = colliders(capsules.as_slice()?, &fields, poses.0.as_slice()?, poses.1.as_slice()?);
    let frame = Frame {
        goal_before: &before,
        goal_after: &after,
        start_secs: secs.0,
        duration_secs: secs.1,
        colliders: &colliders,
        links: &links,
    };
    py.detach(|| advance(&mut state, chains, frame, &options.0)).map_err(refused)?;
    Ok((rows(py, &state.position), rows(py, &state.velocity)))
}

/// Capsules first, then fields; a pose is a quaternion x y z w and a translation.
fn colliders<'a>(capsules: &[f64], fields: &[&'a PyField], before: &[f64], after: &[f64]) -> Vec<Collider<'a>> {
    let round = capsules.chunks_exact(7).map(|c| Shape::Capsule {
        from: DVec3::new(c[0], c[1], c[2]),
        to: DVec3::new(c[3], c[4], c[5]),
        radius: c[6],
    });
    let meshes = fields.iter().map(|field| {
        let PyField { origin, spacing, counts, values } = field;
        Shape::Field(DistanceField { origin: *origin, spacing: *spacing, counts: *counts, values })
    });
    let poses = before.chunks_exact(7).map(pose).zip(after.chunks_exact(7).map(pose));
    round.chain(meshes).zip(poses).map(|(shape, (before, after))| Collider { shape, before, after }).collect()
}

fn pose(v: &[f64]) -> Pose {
    Pose { rotation: DQuat::from_xyzw(v[0], v[1], v[2], v[3]).normalize(), translation: DVec3::new(v[4], v[5], v[6]) }
}

fn rows<'py>(py: Python<'py>, points: &[DVec3]) -> Rows<'py> {
    let flat: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect();
    Array2::from_shape_vec((points.len(), 3), flat).expect("three numbers a point").into_pyarray(py)
}
