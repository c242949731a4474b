//! Closed forms and conservation: falling, swinging, hanging, bending, resting.

use std::f64::consts::TAU;

use glam::DVec3;
use tress_dynamics::collision::{Collider, Pose, Shape};
use tress_dynamics::constraints::link::Link;
use tress_dynamics::energy::{energy, momentum};
use tress_dynamics::{Chains, Frame, Options, State, Wind, advance};

const GRAVITY: DVec3 = DVec3::new(0.0, -9.81, 0.0);
const FRAME: f64 = 1.0 / 60.0;

fn options() -> Options {
    Options {
        gravity: GRAVITY,
        stretch_n: f64::INFINITY,
        bend_nm2: 0.0,
        goal_n_per_m: 0.0,
        link_n_per_m: f64::INFINITY,
        drag_per_sec: 0.0,
        damping_per_sec: 0.0,
        wind: Wind { velocity: DVec3::ZERO, gusts: 0.0, gust_secs: 1.0, seed: 0 },
        friction: 0.0,
        clearance: 0.0,
        chain_distance: 0.0,
        clamp_roots: false,
        substeps: 8,
        iterations: 1,
    }
}

/// One straight chain of `count` particles over `length` metres, root held, `mass` kilograms in all.
struct Rod {
    offsets: Vec<usize>,
    mass: Vec<f64>,
    weight: Vec<f64>,
    goal: Vec<DVec3>,
    state: State,
}

impl Rod {
    fn new(count: usize, length: f64, along: DVec3, mass: f64) -> Self {
        let goal: Vec<DVec3> = (0..count).map(|i| along * length * i as f64 / (count - 1) as f64).collect();
        let each = mass / (count - 1) as f64;
        let mut masses = vec![each; count];
        (masses[0], masses[count - 1]) = (0.5 * each, 0.5 * each);
        let mut weight = vec![0.0; count];
        weight[0] = 1.0;
        let state = State { position: goal.clone(), velocity: vec![DVec3::ZERO; count] };
        Self { offsets: vec![0, count], mass: masses, weight, goal, state }
    }

    fn chains(&self) -> Chains<'_> {
        Chains { offsets: &self.offsets, mass: &self.mass, goal_weight: &self.weight }
    }

    fn energy(&self, options: &Options) -> f64 {
        energy(&self.state, self.chains(), &self.goal, options)
    }

    fn advance(&mut self, options: &Options, colliders: &[Collider<'_>]) {
        let chains = Chains { offsets: &self.offsets, mass: &self.mass, goal_weight: &self.weight };
        let frame = Frame {
            goal_before: &self.goal,
            goal_after: &self.goal,
            start_secs: 0.0,
            duration_secs: FRAME,
            colliders,
            links: &[],
        };
        advance(&mut self.state, chains, frame, options).expect("fits");
    }

    fn tip(&self) -> DVec3 {
        self.state.position[self.goal.len() - 1]
    }
}

#[test]
fn what_hangs_free_falls_freely() {
    let mut rod = Rod::new(6, 0.3, DVec3::X, 0.01);
    rod.weight[0] = 0.0;
    for _ in 0..30 {
        rod.advance(&Options { bend_nm2: 1e-4, ..options() }, &[]);
    }
    let steps = 30.0 * 8.0;
    let step = FRAME / 8.0;
    let fallen = 0.5 * GRAVITY * step * step * steps * (steps + 1.0);
    for (point, start) in rod.state.position.iter().zip(&rod.goal) {
        assert!((*point - *start - fallen).length() < 1e-10);
    }
}

#[test]
fn a_pendulum_swings_in_its_period() {
    let mut rod = Rod::new(2, 0.25, DVec3::new(0.05, -1.0, 0.0).normalize(), 0.02);
    let settings = Options { substeps: 32, ..options() };
    let mut crossings = Vec::new();
    let mut last = rod.tip().x;
    for frame in 0..600 {
        rod.advance(&settings, &[]);
        let x = rod.tip().x;
        if last > 0.0 && x <= 0.0 {
            crossings.push((f64::from(frame) + last / (last - x)) * FRAME);
        }
        last = x;
    }
    let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    let amplitude = 0.05_f64.atan();
    let wanted = TAU * (0.25 / 9.81_f64).sqrt() * (1.0 + amplitude * amplitude / 16.0);
    assert!((period / wanted - 1.0).abs() < 2e-3, "{period} against {wanted}");
}

/// Settles, whatever it takes.
fn settled(rod: &mut Rod, settings: &Options) {
    let damped = Options { drag_per_sec: 6.0, ..*settings };
    for _ in 0..600 {
        rod.advance(&damped, &[]);
    }
}

#[test]
fn a_hanging_rod_stretches_under_its_weight() {
    for (substeps, iterations) in [(1, 1), (4, 1), (16, 1), (4, 8)] {
        let mut rod = Rod::new(17, 0.3, DVec3::NEG_Y, 0.01);
        settled(&mut rod, &Options { stretch_n: 2.0, substeps, iterations, ..options() });
        let stretched = -rod.tip().y - 0.3;
        let wanted = 0.01 * 9.81 * 0.3 / (2.0 * 2.0);
        assert!((stretched / wanted - 1.0).abs() < 1e-4, "{substeps} x {iterations}: {stretched} against {wanted}");
    }
}

#[test]
fn a_clamped_rod_sags_as_a_beam_does_whatever_the_step_and_the_particles() {
    let (length, mass, bend): (f64, f64, f64) = (0.1, 0.001, 2e-4);
    let wanted = mass / length * 9.81 * length.powi(4) / (8.0 * bend);
    for (count, substeps, iterations) in [(9, 8, 1), (33, 8, 1), (17, 4, 1), (17, 32, 1), (17, 8, 6)] {
        let mut rod = Rod::new(count, length, DVec3::X, mass);
        settled(&mut rod, &Options { bend_nm2: bend, clamp_roots: true, substeps, iterations, ..options() });
        let sag = -rod.tip().y;
        assert!(
            (sag / wanted - 1.0).abs() < 0.02,
            "{count} particles, {substeps} x {iterations}: {sag} against {wanted}"
        );
    }
}

#[test]
fn energy_does_not_grow() {
    for settings in [
        Options { stretch_n: 50.0, ..options() },
        Options { stretch_n: 50.0, bend_nm2: 1e-4, clamp_roots: true, ..options() },
        Options { stretch_n: 50.0, bend_nm2: 1e-4, goal_n_per_m: 1.0, damping_per_sec: 3.0, ..options() },
    ] {
        let mut rod = Rod::new(12, 0.3, DVec3::X, 0.01);
        rod.weight[1..].fill(0.3);
        let start = rod.energy(&settings);
        let scale = 0.01 * 9.81 * 0.3;
        for frame in 0..300 {
            rod.advance(&settings, &[]);
            let now = rod.energy(&settings);
            assert!(now < start + 0.02 * scale, "frame {frame}: {now} after {start}");
        }
    }
}

#[test]
fn free_hair_keeps_its_momentum() {
    let mut rod = Rod::new(12, 0.3, DVec3::X, 0.01);
    rod.weight[0] = 0.0;
    for (i, velocity) in rod.state.velocity.iter_mut().enumerate() {
        *velocity = DVec3::new((i as f64).sin(), (2.0 * i as f64).cos(), 0.3 * i as f64);
    }
    let settings =
        Options { gravity: DVec3::ZERO, bend_nm2: 1e-4, damping_per_sec: 5.0, stretch_n: 100.0, ..options() };
    let before = momentum(&rod.state, rod.chains());
    for _ in 0..60 {
        rod.advance(&settings, &[]);
    }
    assert!((momentum(&rod.state, rod.chains()) - before).length() < 1e-12);
}

#[test]
fn what_rests_stays_at_rest() {
    let mut rod = Rod::new(10, 0.3, DVec3::X, 0.01);
    for (i, point) in rod.goal.iter_mut().enumerate() {
        point.y = 0.02 * (i as f64).sin();
    }
    rod.state.position.clone_from(&rod.goal);
    rod.weight[1..].fill(0.5);
    let settings = Options { gravity: DVec3::ZERO, bend_nm2: 1e-3, goal_n_per_m: 1.0, clamp_roots: true, ..options() };
    for _ in 0..60 {
        rod.advance(&settings, &[]);
    }
    let away = rod.state.position.iter().zip(&rod.goal).map(|(p, g)| p.distance(*g)).fold(0.0, f64::max);
    assert!(away < 1e-12, "{away}");
}

#[test]
fn a_goal_weight_of_one_follows_exactly() {
    let mut rod = Rod::new(10, 0.3, DVec3::X, 0.01);
    rod.weight.fill(1.0);
    let after: Vec<DVec3> = rod.goal.iter().map(|p| *p + DVec3::new(0.3 * p.x, 0.1, -0.2)).collect();
    let frame = Frame {
        goal_before: &rod.goal.clone(),
        goal_after: &after,
        start_secs: 0.0,
        duration_secs: FRAME,
        colliders: &[],
        links: &[],
    };
    let mut state = rod.state.clone();
    let settings = Options { bend_nm2: 1.0, goal_n_per_m: 3.0, damping_per_sec: 4.0, ..options() };
    advance(&mut state, rod.chains(), frame, &settings).expect("fits");
    assert_eq!(state.position, after);
}

#[test]
fn no_setting_explodes() {
    let ball = Shape::Capsule { from: DVec3::new(0.0, -0.1, 0.0), to: DVec3::new(0.1, -0.1, 0.0), radius: 0.05 };
    let ball = [Collider { shape: ball, before: Pose::IDENTITY, after: Pose::IDENTITY }];
    for stretch_n in [0.0, 1e-6, 1e6, f64::INFINITY] {
        for bend_nm2 in [0.0, 1e-9, 10.0, f64::INFINITY] {
            for goal_n_per_m in [0.0, 1e6, f64::INFINITY] {
                for substeps in [1, 10] {
                    let mut rod = Rod::new(16, 0.3, DVec3::X, 1e-4);
                    rod.weight[1..].fill(0.01);
                    rod.weight[15] = 1.0;
                    rod.goal[15] = DVec3::new(0.2, 0.4, 0.1);
                    let settings = Options {
                        stretch_n,
                        bend_nm2,
                        goal_n_per_m,
                        substeps,
                        clamp_roots: true,
                        friction: 0.5,
                        ..options()
                    };
                    for _ in 0..60 {
                        rod.advance(&settings, &ball);
                    }
                    let farthest = rod.state.position.iter().map(|p| p.length()).fold(0.0, f64::max);
                    assert!(farthest < 6.0, "{stretch_n} {bend_nm2} {goal_n_per_m} {substeps}: {farthest}");
                }
            }
        }
    }
}

#[test]
fn hair_stays_outside_a_ball() {
    let ball = Shape::Capsule { from: DVec3::ZERO, to: DVec3::ZERO, radius: 0.1 };
    let ball = [Collider { shape: ball, before: Pose::IDENTITY, after: Pose::IDENTITY }];
    let mut rod = Rod::new(24, 0.3, DVec3::X, 0.001);
    for point in rod.goal.iter_mut().chain(&mut rod.state.position) {
        *point += DVec3::new(-0.02, 0.102, 0.01);
    }
    let settings = Options { clearance: 0.001, friction: 0.3, drag_per_sec: 1.0, ..options() };
    for _ in 0..240 {
        rod.advance(&settings, &ball);
        for pair in rod.state.position.windows(2) {
            assert!(pair[0].length() > 0.1005 && (0.5 * (pair[0] + pair[1])).length() > 0.1);
        }
    }
}

fn curtain(chains: usize, count: usize) -> (Vec<usize>, Vec<DVec3>) {
    let offsets = (0..=chains).map(|c| c * count).collect();
    let goal = (0..chains)
        .flat_map(|c| (0..count).map(move |i| DVec3::new(0.01 * c as f64, -0.02 * i as f64, 0.001 * (c * i) as f64)))
        .collect();
    (offsets, goal)
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let (offsets, goal) = curtain(40, 10);
    let mass = vec![1e-4; goal.len()];
    let weight: Vec<f64> = (0..goal.len()).map(|i| if i % 10 == 0 { 1.0 } else { 0.1 }).collect();
    let links: Vec<Link> = (0..39).map(|c| Link { from: c * 10 + 5, to: c * 10 + 15 }).collect();
    let run = |threads: usize, joined: bool| {
        let mut state = State { position: goal.clone(), velocity: vec![DVec3::X; goal.len()] };
        let chains = Chains { offsets: &offsets, mass: &mass, goal_weight: &weight };
        let links = if joined { &links[..] } else { &[] };
        let frame = Frame {
            goal_before: &goal,
            goal_after: &goal,
            start_secs: 0.0,
            duration_secs: FRAME,
            colliders: &[],
            links,
        };
        let distance = if joined { 0.008 } else { 0.0 };
        let settings = Options { bend_nm2: 1e-6, goal_n_per_m: 0.1, chain_distance: distance, ..options() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| (0..20).for_each(|_| advance(&mut state, chains, frame, &settings).expect("fits")));
        state
    };
    for joined in [false, true] {
        assert_eq!(run(1, joined), run(4, joined));
    }
}

#[test]
fn linked_chains_keep_their_distance() {
    let (offsets, goal) = curtain(2, 10);
    let mass = vec![1e-4; 20];
    let mut weight = vec![0.0; 20];
    (weight[0], weight[10]) = (1.0, 1.0);
    let mut state = State { position: goal.clone(), velocity: vec![DVec3::ZERO; 20] };
    for velocity in &mut state.velocity[1..10] {
        *velocity = DVec3::NEG_X;
    }
    let links: Vec<Link> = (1..10).map(|i| Link { from: i, to: 10 + i }).collect();
    let chains = Chains { offsets: &offsets, mass: &mass, goal_weight: &weight };
    let frame = Frame {
        goal_before: &goal,
        goal_after: &goal,
        start_secs: 0.0,
        duration_secs: FRAME,
        colliders: &[],
        links: &links,
    };
    for _ in 0..60 {
        advance(&mut state, chains, frame, &Options { iterations: 4, ..options() }).expect("fits");
        for link in &links {
            let found = state.position[link.from].distance(state.position[link.to]);
            assert!((found - goal[link.from].distance(goal[link.to])).abs() < 0.002);
        }
    }
}

#[test]
fn chains_that_meet_stay_apart() {
    let goal: Vec<DVec3> =
        (0..2).flat_map(|c| (0..10).map(move |i| DVec3::new(0.03 * f64::from(c), -0.02 * f64::from(i), 0.0))).collect();
    let offsets = [0, 10, 20];
    let mass = vec![1e-4; 20];
    let mut weight = vec![0.0; 20];
    (weight[0], weight[10]) = (1.0, 1.0);
    let mut state = State { position: goal.clone(), velocity: vec![DVec3::ZERO; 20] };
    for i in 1..10 {
        state.velocity[i] = DVec3::X * 0.5;
    }
    let chains = Chains { offsets: &offsets, mass: &mass, goal_weight: &weight };
    let frame = Frame {
        goal_before: &goal,
        goal_after: &goal,
        start_secs: 0.0,
        duration_secs: FRAME,
        colliders: &[],
        links: &[],
    };
    for _ in 0..60 {
        advance(&mut state, chains, frame, &Options { chain_distance: 0.02, ..options() }).expect("fits");
        for i in 1..10 {
            assert!(state.position[i].distance(state.position[10 + i]) > 0.018);
        }
    }
}

#[test]
fn bad_numbers_are_refused() {
    let rod = Rod::new(4, 0.3, DVec3::X, 0.01);
    let frame = Frame {
        goal_before: &rod.goal,
        goal_after: &rod.goal,
        start_secs: 0.0,
        duration_secs: FRAME,
        colliders: &[],
        links: &[],
    };
    let refused = |chains: Chains<'_>, frame: Frame<'_>, options: Options| {
        advance(&mut rod.state.clone(), chains, frame, &options).expect_err("refused").to_string()
    };
    let chains = rod.chains();
    assert_eq!(refused(Chains { mass: &[0.0; 4], ..chains }, frame, options()), "mass is 0; a number > 0 was expected");
    assert!(refused(Chains { goal_weight: &[1.5; 4], ..chains }, frame, options()).contains("[0, 1]"));
    assert!(refused(Chains { offsets: &[0, 3], ..chains }, frame, options()).contains("offsets"));
    assert!(refused(chains, Frame { duration_secs: 0.0, ..frame }, options()).contains("duration is 0"));
    assert!(refused(chains, frame, Options { bend_nm2: f64::NAN, ..options() }).contains("bend is NaN"));
    assert!(
        refused(chains, Frame { links: &[Link { from: 0, to: 9 }], ..frame }, options()).contains("particle 9 of 4")
    );
}
