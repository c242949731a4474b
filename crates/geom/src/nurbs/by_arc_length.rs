//! The same path with length as its parameter.

use super::arc_length::ArcLength;
use super::fit::{FitSettings, fit_curve};
use super::{Curve, Knots, NurbsError};

/// Points on each span while it is fitted and measured.
const SAMPLES_PER_SPAN: usize = 8;
const MAX_SPANS_PER_PIECE: usize = 1024;

/// A curve by length, and how far it lies from the path it follows.
#[derive(Debug, Clone)]
pub struct ByArcLength {
    /// A cubic of weights 1, whose parameter runs from 0 to the length of the path.
    pub curve: Curve,
    /// Greatest distance, over samples, from the point of the path at the same length.
    pub deviation: f64,
}

/// The path of a curve as a cubic whose parameter is the length from its start, to within `accuracy`.
///
/// Creases stay creases. Spans are doubled until the cubic is within `accuracy`; where it is still not at 1,024 spans
/// between two creases, `deviation` tells what was reached.
///
/// # Errors
/// A curve without length.
pub fn by_arc_length(curve: &Curve, accuracy: f64) -> Result<ByArcLength, NurbsError> {
    let lengths = ArcLength::new(curve, 0.01 * accuracy);
    if lengths.total() <= 0.0 {
        return Err(NurbsError::NoLength);
    }
    let creases = crease_lengths(curve, &lengths);
    let mut spans = 2;
    loop {
        let found = fitted(curve, &lengths, &creases, spans)?;
        if found.deviation <= accuracy || spans >= MAX_SPANS_PER_PIECE {
            return Ok(found);
        }
        spans *= 2;
    }
}

/// Lengths of both ends and of all knots where the path may turn sharply.
fn crease_lengths(curve: &Curve, lengths: &ArcLength<'_>) -> Vec<f64> {
    let knots = curve.knots();
    let (low, high) = knots.domain();
    let sharp = |t: &f64| low < *t && *t < high && knots.multiplicity(*t) >= knots.degree();
    let mut found = vec![0.0];
    found.extend(knots.breaks().into_iter().filter(sharp).map(|t| lengths.length_at(t)));
    found.push(lengths.total());
    // Pieces without length would be knots in the same place.
    found.dedup_by(|a, b| *a - *b <= 1e-12 * lengths.total());
    found
}

fn fitted(curve: &Curve, lengths: &ArcLength<'_>, creases: &[f64], spans: usize) -> Result<ByArcLength, NurbsError> {
    let last = creases.len() - 2;
    let (mut breaks, mut at) = (vec![0.0], vec![0.0]);
    for (i, ends) in creases.windows(2).enumerate() {
        let between = |k: usize, of: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / of as f64;
        breaks.extend((1..spans).map(|k| between(k, spans)));
        breaks.extend(std::iter::repeat_n(ends[1], if i == last { 1 } else { 3 }));
        let samples = spans * SAMPLES_PER_SPAN;
        at.extend((1..=samples).map(|k| if k == samples { ends[1] } else { between(k, samples) }));
    }
    let parameters = at.iter().map(|&length| lengths.parameter_at(length)).collect::<Result<Vec<_>, _>>()?;
    let points: Vec<_> = parameters.iter().map(|&t| curve.point(t)).collect();
    let settings = FitSettings { smoothness: 0.0, fix_ends: true };
    let found = fit_curve(Knots::clamped(3, &breaks)?, &at, &points, settings)?;
    let deviation = at.iter().zip(&points).map(|(&s, p)| found.point(s).distance(*p)).fold(0.0, f64::max);
    Ok(ByArcLength { curve: found, deviation })
}
