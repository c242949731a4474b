use super::*;
use proptest::prelude::*;

/// A black and white step: the colours alone settle alpha.
fn step(width: usize, height: usize) -> (Vec<[f64; 3]>, Vec<u8>) {
    let color = (0..width * height).map(|p| if p % width < width / 2 { [0.1, 0.2, 0.1] } else { [0.9, 0.8, 0.7] });
    let trimap = (0..width * height).map(|p| match p % width {
        x if x < 3 => TRIMAP_BACKGROUND,
        x if x >= width - 3 => TRIMAP_FOREGROUND,
        _ => TRIMAP_UNKNOWN,
    });
    (color.collect(), trimap.collect())
}

#[test]
fn a_step_of_colour_is_a_step_of_alpha() {
    let (color, trimap) = step(24, 16);
    let result = closed_form_alpha(&color, &trimap, 24, 16, &MattingSettings::default()).expect("valid");
    assert!(result.outcome.converged);
    for (p, alpha) in result.alpha.iter().enumerate() {
        let truth = f64::from(p % 24 >= 12);
        assert!((alpha - truth).abs() < 0.01, "pixel {p}: {alpha} against {truth}");
    }
}

#[test]
fn alpha_that_is_linear_in_colour_comes_back() {
    let (width, height) = (70, 60);
    let truth: Vec<f64> = (0..width * height)
        .map(|p| (((p % width) as f64 - 10.0) / 50.0 + 0.02 * ((p / width) as f64).sin()).clamp(0.0, 1.0))
        .collect();
    let color: Vec<[f64; 3]> = truth.iter().map(|a| [0.2 + 0.5 * a, 0.7 - 0.6 * a, 0.3 + 0.1 * a]).collect();
    let trimap: Vec<u8> = truth
        .iter()
        .map(|&a| {
            if a == 0.0 {
                TRIMAP_BACKGROUND
            } else if a == 1.0 {
                TRIMAP_FOREGROUND
            } else {
                TRIMAP_UNKNOWN
            }
        })
        .collect();
    let settings = MattingSettings { epsilon: 1e-8, tolerance: 1e-9, ..MattingSettings::default() };
    let result = closed_form_alpha(&color, &trimap, width, height, &settings).expect("valid");
    let worst = result.alpha.iter().zip(&truth).map(|(a, t)| (a - t).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn a_constant_picture_gives_a_smooth_ramp() {
    let (_, trimap) = step(30, 12);
    let result = closed_form_alpha(&vec![[0.5; 3]; 360], &trimap, 30, 12, &MattingSettings::default()).expect("valid");
    let row = &result.alpha[6 * 30..7 * 30];
    assert!(row.windows(2).all(|pair| pair[1] >= pair[0] - 1e-6), "{row:?}");
    assert!((row[14] + row[15] - 1.0).abs() < 1e-3, "the ramp is symmetric");
}

#[test]
fn wrong_input_is_refused() {
    let settings = MattingSettings::default();
    let unknown = vec![TRIMAP_UNKNOWN; 16];
    let gray = vec![[0.5; 3]; 16];
    assert!(matches!(closed_form_alpha(&gray, &unknown, 4, 4, &settings), Err(MattingError::NothingKnown)));
    assert!(matches!(closed_form_alpha(&gray, &unknown, 5, 4, &settings), Err(MattingError::WrongSize { .. })));
    assert!(matches!(closed_form_alpha(&gray, &unknown, 2, 8, &settings), Err(MattingError::TooSmall(2, 8))));
}

proptest! {
    #[test]
    fn swapping_foreground_and_background_mirrors_alpha(seed in 0u64..1000) {
        let (_, trimap) = step(20, 10);
        let noise = |p: usize, c: usize| ((p * 37 + c * 101 + seed as usize * 13) % 97) as f64 / 97.0;
        let color: Vec<[f64; 3]> = (0..200).map(|p| std::array::from_fn(|c| noise(p, c))).collect();
        let swapped: Vec<u8> = trimap.iter().map(|&t| match t {
            TRIMAP_BACKGROUND => TRIMAP_FOREGROUND,
            TRIMAP_FOREGROUND => TRIMAP_BACKGROUND,
            other => other,
        }).collect();
        let settings = MattingSettings { tolerance: 1e-8, ..MattingSettings::default() };
        let one = closed_form_alpha(&color, &trimap, 20, 10, &settings).expect("valid").alpha;
        let other = closed_form_alpha(&color, &swapped, 20, 10, &settings).expect("valid").alpha;
        for (a, b) in one.iter().zip(&other) {
            prop_assert!((a + b - 1.0).abs() < 1e-3, "{} and {}", a, b);
        }
    }
}
