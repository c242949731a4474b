//! A frame of motion.
//!
//! Chains that nothing joins go through all steps of the frame one after another, each on its own core and in its own
//! cache; springs and contacts between chains make them go step by step together. Both give the same bits on any number
//! of threads.

use glam::DVec3;
use rayon::prelude::*;

use crate::chain::{Chain, Moment, Particles, inverse_masses};
use crate::chains::fits;
use crate::collision::Collider;
use crate::collision::pairs::{Pair, pairs, part};
use crate::constraints::link::{self, Link};
use crate::error::positive;
use crate::{Chains, DynamicsError, Options, State};

/// What happens around the hair in a frame.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Where the animation has the particles when the frame begins, metres.
    pub goal_before: &'a [DVec3],
    /// And when it ends. Segments have its lengths, corners its bends.
    pub goal_after: &'a [DVec3],
    /// When it begins, seconds: gusts depend on it.
    pub start_secs: f64,
    /// Seconds, > 0.
    pub duration_secs: f64,
    /// What is in the way.
    pub colliders: &'a [Collider<'a>],
    /// Springs between chains.
    pub links: &'a [Link],
}

/// Moves `state` on by a frame.
///
/// # Errors
/// Lengths that do not fit, numbers outside their ranges.
pub fn advance(
    state: &mut State,
    chains: Chains<'_>,
    frame: Frame<'_>,
    options: &Options,
) -> Result<(), DynamicsError> {
    check(state, chains, frame, options)?;
    let mut before = state.position.clone();
    let mut list = frame_chains(chains, frame, options);
    let moments: Vec<Moment<'_>> = (0..options.substeps).map(|index| moment(index, frame, options)).collect();
    if frame.links.is_empty() && options.chain_distance == 0.0 {
        let particles = split(state, &mut before, chains.offsets);
        list.par_iter_mut().zip(particles).for_each(|(chain, mut particles)| {
            for moment in &moments {
                chain.move_and_solve(&mut particles, moment);
                chain.finish(&mut particles, moment);
            }
        });
        return Ok(());
    }
    let mut joints = Joints::new(state, chains, frame, options);
    for moment in &moments {
        let particles = split(state, &mut before, chains.offsets);
        list.par_iter_mut().zip(particles).for_each(|(chain, mut own)| chain.move_and_solve(&mut own, moment));
        joints.solve(&mut state.position, moment, options);
        let particles = split(state, &mut before, chains.offsets);
        list.par_iter_mut().zip(particles).for_each(|(chain, mut own)| {
            chain.collide(&mut own, moment);
            chain.finish(&mut own, moment);
        });
    }
    Ok(())
}

fn frame_chains<'a>(chains: Chains<'a>, frame: Frame<'a>, options: &Options) -> Vec<Chain<'a>> {
    let step = frame.duration_secs / options.substeps as f64;
    chains
        .offsets
        .par_windows(2)
        .map(|ends| {
            let own = ends[0]..ends[1];
            let goals = [&frame.goal_before[own.clone()], &frame.goal_after[own.clone()]];
            Chain::new(&chains.mass[own.clone()], &chains.goal_weight[own], goals, frame.colliders, options, step)
        })
        .collect()
}

/// The particles of every chain, apart.
fn split<'a>(state: &'a mut State, before: &'a mut [DVec3], offsets: &[usize]) -> Vec<Particles<'a>> {
    let mut rest = (&mut state.position[..], &mut state.velocity[..], before);
    offsets
        .windows(2)
        .map(|ends| {
            let count = ends[1] - ends[0];
            let (position, after) = std::mem::take(&mut rest.0).split_at_mut(count);
            let (velocity, later) = std::mem::take(&mut rest.1).split_at_mut(count);
            let (before, last) = std::mem::take(&mut rest.2).split_at_mut(count);
            rest = (after, later, last);
            Particles { position, velocity, before }
        })
        .collect()
}

/// What acts between chains, one after another in a fixed order.
struct Joints<'a> {
    inverse: Vec<f64>,
    links: &'a [Link],
    lengths: [Vec<f64>; 2],
    pairs: Vec<Pair>,
}

impl<'a> Joints<'a> {
    fn new(state: &State, chains: Chains<'_>, frame: Frame<'a>, options: &Options) -> Self {
        let drag = options.drag_per_sec * frame.duration_secs / options.substeps as f64;
        let inverse = inverse_masses(chains.mass, chains.goal_weight, drag);
        let lengths = [frame.goal_before, frame.goal_after]
            .map(|goal| frame.links.iter().map(|link| goal[link.from].distance(goal[link.to])).collect());
        let fastest = state.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
        let reach = options.chain_distance + (2.0 * fastest * frame.duration_secs).min(2.0 * options.chain_distance);
        let meeting = options.chain_distance > 0.0;
        let pairs = if meeting {
            pairs(&state.position, frame.goal_after, chains.offsets, options.chain_distance, reach)
        } else {
            Vec::new()
        };
        Self { inverse, links: frame.links, lengths, pairs }
    }

    fn solve(&mut self, position: &mut [DVec3], moment: &Moment<'_>, options: &Options) {
        let soft = 1.0 / (options.link_n_per_m * moment.step * moment.step);
        let mut pulls = vec![0.0; self.links.len()];
        for _ in 0..options.iterations {
            for (index, &joint) in self.links.iter().enumerate() {
                let [before, after] = [self.lengths[0][index], self.lengths[1][index]];
                let length = before + (after - before) * moment.part;
                link::solve(position, joint, length, &self.inverse, soft, &mut pulls[index]);
            }
            for &pair in &self.pairs {
                part(position, pair, &self.inverse);
            }
        }
    }
}

fn check(state: &State, chains: Chains<'_>, frame: Frame<'_>, options: &Options) -> Result<(), DynamicsError> {
    chains.check()?;
    options.check()?;
    positive("duration", frame.duration_secs)?;
    let particles = chains.mass.len();
    fits("position", state.position.len(), particles)?;
    fits("velocity", state.velocity.len(), particles)?;
    fits("goal_before", frame.goal_before.len(), particles)?;
    fits("goal_after", frame.goal_after.len(), particles)?;
    let ends = frame.links.iter().flat_map(|link| [link.from, link.to]);
    match ends.into_iter().find(|end| *end >= particles) {
        Some(particle) => Err(DynamicsError::Link { particle, particles }),
        None => Ok(()),
    }
}

fn moment<'a>(index: usize, frame: Frame<'a>, options: &'a Options) -> Moment<'a> {
    let part = |i: usize| i as f64 / options.substeps as f64;
    let step = frame.duration_secs / options.substeps as f64;
    Moment {
        step,
        part: part(index + 1),
        secs: frame.start_secs + step * index as f64,
        options,
        colliders: frame.colliders.iter().map(|collider| collider.during(part(index), part(index + 1))).collect(),
    }
}
