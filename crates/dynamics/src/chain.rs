//! One chain's way through one step.

use glam::{DMat3, DVec3};

use crate::Options;
use crate::collision::{Collider, Moving};
use crate::constraints::bend::Bend;
use crate::constraints::contact::resolved;
use crate::constraints::goal;
use crate::constraints::stretch::Stretch;

/// One step of a frame.
pub(crate) struct Moment<'a> {
    /// Seconds.
    pub step: f64,
    /// The frame's part at which the step ends.
    pub part: f64,
    /// Time at which the step begins, seconds.
    pub secs: f64,
    /// What acts.
    pub options: &'a Options,
    /// What is in the way.
    pub colliders: Vec<Moving<'a>>,
}

/// The particles of a chain.
pub(crate) struct Particles<'a> {
    pub position: &'a mut [DVec3],
    pub velocity: &'a mut [DVec3],
    /// Where they were when the step began.
    pub before: &'a mut [DVec3],
}

/// What a chain's solvers keep for a frame.
pub(crate) struct Chain<'a> {
    mass: &'a [f64],
    goals: [&'a [DVec3]; 2],
    inverse: Vec<f64>,
    lengths: [Vec<f64>; 2],
    goal_soft: Vec<f64>,
    /// Now: between those of the frame's beginning and end.
    goal: Vec<DVec3>,
    length: Vec<f64>,
    goal_pull: Vec<DVec3>,
    stretch: Stretch,
    bend: Option<Bend>,
    /// For each collider, distances that particles, then middles of segments, keep.
    kept: Vec<[Vec<f64>; 2]>,
}

/// Part of a chain's inertia that keeps a straight one solvable.
const LEAST_INERTIA: f64 = 1e-9;

impl<'a> Chain<'a> {
    /// A chain for a frame of steps of `step` seconds.
    pub fn new(
        mass: &'a [f64],
        goal_weight: &[f64],
        goals: [&'a [DVec3]; 2],
        colliders: &[Collider<'_>],
        options: &Options,
        step: f64,
    ) -> Self {
        let inverse = inverse_masses(mass, goal_weight, step * options.drag_per_sec);
        let lengths = goals.map(lengths_of);
        let soft = |weight: &f64| goal::compliance(*weight, options.goal_n_per_m) / (step * step);
        let bend = (options.bend_nm2 > 0.0 && mass.len() > 1).then(|| {
            let clamped = options.clamp_roots && inverse[0] == 0.0;
            Bend::new(&inverse, &lengths[1], 1.0 / (options.bend_nm2 * step * step), clamped)
        });
        Self {
            mass,
            goals,
            goal_soft: goal_weight.iter().map(soft).collect(),
            goal: goals[0].to_vec(),
            length: lengths[0].clone(),
            goal_pull: vec![DVec3::ZERO; mass.len()],
            stretch: Stretch::new(lengths[0].len()),
            inverse,
            lengths,
            bend,
            kept: colliders.iter().map(|collider| kept_distances(collider, goals[1], options.clearance)).collect(),
        }
    }

    /// Forces and velocities, then the constraints within the chain and the colliders.
    pub fn move_and_solve(&mut self, particles: &mut Particles<'_>, moment: &Moment<'_>) {
        self.follow_goals(moment.part);
        self.predict(particles, moment);
        let options = moment.options;
        let soft_per_m = 1.0 / (options.stretch_n * moment.step * moment.step);
        for _ in 0..options.iterations {
            for i in 0..particles.position.len() {
                let (inverse, soft) = (self.inverse[i], self.goal_soft[i]);
                goal::solve(&mut particles.position[i], self.goal[i], inverse, soft, &mut self.goal_pull[i]);
            }
            if let Some(bend) = &mut self.bend {
                bend.solve(particles.position, &self.goal, &self.inverse, &self.lengths[1]);
            }
            if options.stretch_n > 0.0 {
                self.stretch.solve(particles.position, &self.inverse, &self.length, soft_per_m);
            }
            self.collide(particles, moment);
        }
    }

    /// Velocities of the step, and their damping.
    pub fn finish(&self, particles: &mut Particles<'_>, moment: &Moment<'_>) {
        for i in 0..particles.position.len() {
            particles.velocity[i] = (particles.position[i] - particles.before[i]) / moment.step;
        }
        let kept = (-moment.options.damping_per_sec * moment.step).exp();
        if kept < 1.0 {
            self.damp(particles, kept);
        }
    }

    fn follow_goals(&mut self, part: f64) {
        for i in 0..self.goal.len() {
            self.goal[i] = self.goals[0][i].lerp(self.goals[1][i], part);
        }
        for j in 0..self.length.len() {
            self.length[j] = self.lengths[0][j] + (self.lengths[1][j] - self.lengths[0][j]) * part;
        }
        self.goal_pull.fill(DVec3::ZERO);
        self.stretch.forget();
        if let Some(bend) = &mut self.bend {
            bend.forget();
        }
    }

    fn predict(&self, particles: &mut Particles<'_>, moment: &Moment<'_>) {
        let Moment { step, secs, options, .. } = *moment;
        let Some(&root) = particles.position.first() else { return };
        let drag = step * options.drag_per_sec;
        let push = step * options.gravity + drag * options.wind.at(root, secs);
        for i in 0..particles.position.len() {
            particles.before[i] = particles.position[i];
            if self.inverse[i] > 0.0 {
                particles.velocity[i] = (particles.velocity[i] + push) / (1.0 + drag);
                particles.position[i] += step * particles.velocity[i];
            } else {
                particles.position[i] = self.goal[i];
            }
        }
    }

    /// Particles, then the middles of segments, out of the colliders.
    pub fn collide(&self, particles: &mut Particles<'_>, moment: &Moment<'_>) {
        let friction = moment.options.friction;
        for (collider, [points, middles]) in moment.colliders.iter().zip(&self.kept) {
            for (i, &kept) in points.iter().enumerate() {
                if self.inverse[i] == 0.0 {
                    continue;
                }
                if let Some(touch) = collider.touch(particles.before[i], particles.position[i], kept) {
                    particles.position[i] = resolved(particles.position[i], touch, friction);
                }
            }
            for (j, &kept) in middles.iter().enumerate() {
                let free = [self.inverse[j], self.inverse[j + 1]].map(|w| f64::from(w > 0.0));
                let middle = 0.5 * (particles.position[j] + particles.position[j + 1]);
                let was = 0.5 * (particles.before[j] + particles.before[j + 1]);
                if let Some(touch) = collider.touch(was, middle, kept).filter(|_| free[0] + free[1] > 0.0) {
                    let way = 2.0 * touch.depth / (free[0] + free[1]) * touch.normal;
                    particles.position[j] += free[0] * way;
                    particles.position[j + 1] += free[1] * way;
                }
            }
        }
    }

    /// Keeps the velocity that the chain has as a rigid whole, and the part `kept` of the rest (Müller et al. 2007).
    fn damp(&self, particles: &mut Particles<'_>, kept: f64) {
        let free = || (0..self.inverse.len()).filter(|&i| self.inverse[i] > 0.0);
        let mass: f64 = free().map(|i| self.mass[i]).sum();
        if mass <= 0.0 {
            return;
        }
        let centre = free().map(|i| self.mass[i] * particles.position[i]).sum::<DVec3>() / mass;
        let velocity = free().map(|i| self.mass[i] * particles.velocity[i]).sum::<DVec3>() / mass;
        let mut spin = DVec3::ZERO;
        let mut inertia = DMat3::ZERO;
        for i in free() {
            let arm = particles.position[i] - centre;
            spin += self.mass[i] * arm.cross(particles.velocity[i] - velocity);
            inertia += self.mass[i] * (DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer(arm));
        }
        let trace = inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z;
        let turn = if trace > 0.0 {
            (inertia + DMat3::from_diagonal(DVec3::splat(LEAST_INERTIA * trace))).inverse() * spin
        } else {
            DVec3::ZERO
        };
        for i in 0..self.inverse.len() {
            if self.inverse[i] > 0.0 {
                let rigid = velocity + turn.cross(particles.position[i] - centre);
                particles.velocity[i] = rigid + kept * (particles.velocity[i] - rigid);
            }
        }
    }
}

/// What a push moves: nothing where the goal holds, and less where drag, taken implicitly, holds back. So drag slows
/// motion and leaves the state of rest as it is.
pub(crate) fn inverse_masses(mass: &[f64], goal_weight: &[f64], drag: f64) -> Vec<f64> {
    mass.iter().zip(goal_weight).map(|(m, w)| if *w < 1.0 { 1.0 / (m * (1.0 + drag)) } else { 0.0 }).collect()
}

/// What particles and middles keep from a collider: the clearance, or what their goals have where that is less. So hair
/// that is modelled close to a head, or rooted in it, is not pushed off.
fn kept_distances(collider: &Collider<'_>, goal: &[DVec3], clearance: f64) -> [Vec<f64>; 2] {
    let there = collider.during(1.0, 1.0);
    let kept = |point: DVec3| there.distance(point).min(clearance);
    [
        goal.iter().map(|point| kept(*point)).collect(),
        goal.windows(2).map(|pair| kept(0.5 * (pair[0] + pair[1]))).collect(),
    ]
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// Lengths of the segments between points; never 0, which has no direction.
pub(crate) fn lengths_of(points: &[DVec3]) -> Vec<f64> {
    points.windows(2).map(|pair| pair[0].distance(pair[1]).max(1e-9)).collect()
}
