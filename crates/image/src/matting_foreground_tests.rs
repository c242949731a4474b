use super::*;

fn ramp(width: usize, height: usize) -> Vec<f64> {
    (0..width * height).map(|p| (((p % width) as f64 - 8.0) / (width as f64 - 16.0)).clamp(0.0, 1.0)).collect()
}

#[test]
fn two_flat_colours_are_unmixed() {
    let (front, back) = ([0.8, 0.3, 0.1], [0.1, 0.4, 0.6]);
    let alpha = ramp(61, 33);
    let color: Vec<[f64; 3]> =
        alpha.iter().map(|a| std::array::from_fn(|c| a * front[c] + (1.0 - a) * back[c])).collect();
    let result = unmixed_colors(&color, &alpha, 61, 33, &UnmixSettings::default());
    for (i, a) in alpha.iter().enumerate() {
        for c in 0..3 {
            assert!(
                *a == 0.0 || (result.foreground[i][c] - front[c]).abs() < 0.02,
                "F {i} {c} at {a}: {:?}",
                result.foreground[i]
            );
            assert!(
                *a == 1.0 || (result.background[i][c] - back[c]).abs() < 0.02,
                "B {i} {c} at {a}: {:?}",
                result.background[i]
            );
        }
    }
}

#[test]
fn the_mixture_is_the_picture() {
    let alpha = ramp(40, 40);
    let color: Vec<[f64; 3]> =
        (0..1600).map(|p| std::array::from_fn(|c| 0.2 + 0.6 * ((p * 31 + c * 17) % 53) as f64 / 53.0)).collect();
    let result = unmixed_colors(&color, &alpha, 40, 40, &UnmixSettings::default());
    let error_sq: f64 = (0..1600)
        .flat_map(|i| (0..3).map(move |c| (i, c)))
        .map(|(i, c)| {
            let mixed = alpha[i] * result.foreground[i][c] + (1.0 - alpha[i]) * result.background[i][c];
            (mixed - color[i][c]).powi(2)
        })
        .sum();
    assert!((error_sq / 4800.0).sqrt() < 0.01, "{}", (error_sq / 4800.0).sqrt());
}

#[test]
fn an_opaque_picture_is_its_own_foreground() {
    let color = vec![[0.25, 0.5, 0.75]; 15];
    let result = unmixed_colors(&color, &[1.0; 15], 5, 3, &UnmixSettings::default());
    assert!(result.foreground.iter().flatten().zip(color.iter().flatten()).all(|(f, c)| (f - c).abs() < 1e-9));
    assert!(unmixed_colors(&[], &[], 0, 0, &UnmixSettings::default()).foreground.is_empty());
}
