//! Laws of orientation, tracing and completion: any input is answered or refused, on any number of threads alike.

use proptest::prelude::*;
use rayon::ThreadPoolBuilder;
use tress_image::error::ImageError;
use tress_image::gabor::GaborBank;
use tress_image::gabor_kernel::{GaborParams, Kernel};
use tress_image::orientation::{OrientSettings, orient};
use tress_image::patchmatch::{CompletionParams, Picture, complete};
use tress_image::raster_view::Plane;
use tress_image::trace::{TraceParams, Traced, trace};

const PAPER: GaborParams = GaborParams { sigma_u: 1.8, sigma_v: 2.4, wavelength: 4.0, orientations: 32 };
const SETTINGS: OrientSettings = OrientSettings { between_bins: true, ridges_only: true };
const TRACING: TraceParams = TraceParams {
    high: 0.3,
    low: 0.05,
    epsilon: 0.2,
    health: 5,
    step_px: 0.75,
    max_bend: 0.5,
    reach_px: 1.5,
    min_length_px: 2.0,
    smoothing_px: 1.0,
};

/// Waves in two directions, so that there is something to trace.
fn waves(width: usize, height: usize) -> Vec<f32> {
    let at = |x: f32, y: f32| (1.5 * x + 0.2 * y).cos() + 0.7 * (0.3 * x - 1.4 * y).cos();
    (0..width * height).map(|pixel| at((pixel % width) as f32, (pixel / width) as f32)).collect()
}

fn traced(values: &[f32], width: usize, height: usize) -> Result<Traced, ImageError> {
    let bank = GaborBank::new(PAPER)?;
    let mask = vec![true; values.len()];
    let found = orient(Plane { values, width, height }, &mask, &[bank], SETTINGS)?;
    trace(&found.angle, Plane { values: &found.weight, width, height }, &mask, TRACING)
}

fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    ThreadPoolBuilder::new().num_threads(count).build().expect("threads can be started").install(work)
}

fn filled(seed: u64) -> Picture {
    let picture = Picture { values: waves(50, 40), width: 50, height: 40, channels: 1, guides: 0 };
    let hole: Vec<bool> = (0..2000).map(|p| (15..35).contains(&(p % 50)) && (12..30).contains(&(p / 50))).collect();
    let params = CompletionParams { patch: 5, levels: 4, rounds: 2, seed };
    complete(&picture, &hole, &vec![true; 2000], params).expect("the picture can be filled")
}

#[test]
fn kernels_are_even_and_those_of_mirrored_angles_mirror_each_other() {
    for k in 0..32 {
        let theta = std::f64::consts::PI * f64::from(k) / 32.0;
        let (kernel, mirrored) = (Kernel::new(PAPER, theta), Kernel::new(PAPER, -theta));
        for (u, v) in [(0, 0), (1, 0), (2, 3), (-4, 1), (5, -2)] {
            assert!((kernel.at(u, v) - kernel.at(-u, -v)).abs() < 1e-12);
            assert!((kernel.at(u, v) - mirrored.at(u, -v)).abs() < 1e-12);
        }
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let run = || traced(&waves(61, 47), 61, 47).expect("waves can be traced");
    let one = on_threads(1, run);
    assert!(one.offsets.len() > 3);
    assert_eq!(one, on_threads(5, run));
    assert_eq!(on_threads(1, || filled(7)), on_threads(5, || filled(7)));
}

#[test]
fn another_seed_fills_otherwise() {
    assert_ne!(filled(1), filled(2));
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut values = waves(9, 9);
        values[40] = bad;
        assert_eq!(traced(&values, 9, 9), Err(ImageError::NotFinite));
    }
}

proptest! {
    #[test]
    fn any_picture_is_traced_within_its_bounds(
        (width, height) in (1usize..24, 1usize..24),
        seed in proptest::collection::vec(-1e6f32..1e6, 24 * 24),
    ) {
        let traced = traced(&seed[..width * height], width, height).expect("finite pictures are not refused");
        prop_assert_eq!(traced.points.len(), *traced.offsets.last().expect("offsets begin with 0"));
        prop_assert!(traced.offsets.windows(2).all(|pair| pair[1] >= pair[0] + 2));
        let margin = TRACING.reach_px;
        for point in &traced.points {
            prop_assert!((-margin..=width as f64 + margin).contains(&point.x));
            prop_assert!((-margin..=height as f64 + margin).contains(&point.y));
        }
    }

    #[test]
    fn pictures_of_another_size_are_refused(width in 0usize..9, height in 0usize..9, values in 0usize..90) {
        prop_assume!(width * height != values || values == 0);
        prop_assert!(
            matches!(traced(&vec![0.5; values], width, height), Err(ImageError::Size { .. })),
            "{} values for {} x {}", values, width, height
        );
    }
}
