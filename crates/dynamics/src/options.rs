//! What the hair is made of and what acts on it.

use glam::DVec3;

use crate::DynamicsError;
use crate::error::{not_negative, positive};

/// Moving air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// Mean velocity, metres a second.
    pub velocity: DVec3,
    /// Strength of the gusts as part of the mean, >= 0.
    pub gusts: f64,
    /// Seconds from gust to gust.
    pub gust_secs: f64,
    /// Gusts of another seed come at other times.
    pub seed: u64,
}

/// How to move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Metres a second squared.
    pub gravity: DVec3,
    /// Resistance to stretching, newtons at twice the length; may be infinite.
    pub stretch_n: f64,
    /// Resistance to bending away from the goal's shape, newton square metres; may be infinite.
    pub bend_nm2: f64,
    /// Stiffness of the spring to the goal at goal weight ½, newtons a metre.
    pub goal_n_per_m: f64,
    /// Stiffness of the springs between chains, newtons a metre; may be infinite.
    pub link_n_per_m: f64,
    /// Share of the velocity against the air that is lost in a second, as a rate.
    pub drag_per_sec: f64,
    /// Rate at which a chain's inner motion dies down; it leaves falling and turning as a whole alone.
    pub damping_per_sec: f64,
    /// Air.
    pub wind: Wind,
    /// Coulomb's coefficient at colliders.
    pub friction: f64,
    /// Distance that particles keep from colliders, metres, unless their goals are nearer.
    pub clearance: f64,
    /// Distance that particles of different chains keep, metres, unless their goals are nearer; 0: chains do not meet.
    pub chain_distance: f64,
    /// The roots' directions follow the goal's.
    pub clamp_roots: bool,
    /// Steps a frame.
    pub substeps: usize,
    /// Rounds over the constraints a step.
    pub iterations: usize,
}

impl Options {
    /// # Errors
    /// A number outside its range.
    pub fn check(&self) -> Result<(), DynamicsError> {
        for (name, value) in [
            ("stretch", self.stretch_n),
            ("bend", self.bend_nm2),
            ("goal stiffness", self.goal_n_per_m),
            ("link stiffness", self.link_n_per_m),
            ("drag", self.drag_per_sec),
            ("damping", self.damping_per_sec),
            ("gusts", self.wind.gusts),
            ("friction", self.friction),
            ("clearance", self.clearance),
            ("chain distance", self.chain_distance),
        ] {
            not_negative(name, value)?;
        }
        positive("gust time", self.wind.gust_secs)?;
        positive("substeps", self.substeps as f64)?;
        positive("iterations", self.iterations as f64)
    }
}
