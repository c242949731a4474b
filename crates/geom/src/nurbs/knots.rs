//! Knot vectors that are known to be valid.

use super::{MAX_DEGREE, NurbsError};

/// How far outside the domain a parameter may lie, as a share of the domain's length, before it is refused.
const DOMAIN_SLACK: f64 = 1e-12;

/// A degree and a knot vector: finite, not decreasing, with a domain, and nowhere so often that the curve breaks apart.
///
/// n control points of degree p have n + p + 1 knots, and the domain runs from knot p to knot n. The vector is clamped
/// where the first and the last knot occur p + 1 times; it need not be.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    degree: usize,
    values: Vec<f64>,
}

impl Knots {
    /// A knot vector for `count` control points.
    ///
    /// # Errors
    /// Degrees outside 1 to 7, too few control points, another number of knots than `count + degree + 1`, knots that
    /// are not finite or decrease, an empty domain, an inner knot more than `degree` times, any more than `degree + 1`.
    pub fn new(degree: usize, count: usize, values: Vec<f64>) -> Result<Self, NurbsError> {
        refuse_sizes(degree, count)?;
        if values.len() != count + degree + 1 {
            return Err(NurbsError::KnotCount { length: values.len(), count, degree });
        }
        refuse_values(&values)?;
        let knots = Self { degree, values };
        let (low, high) = knots.domain();
        if low == high {
            return Err(NurbsError::NoDomain(low));
        }
        knots.refuse_multiplicities()?;
        Ok(knots)
    }

    /// The clamped knots from 0 to 1 whose inner knots are equally spaced.
    ///
    /// # Errors
    /// Degrees outside 1 to 7, too few control points.
    pub fn uniform(degree: usize, count: usize) -> Result<Self, NurbsError> {
        refuse_sizes(degree, count)?;
        let spans = count - degree;
        Self::clamped(degree, &(0..=spans).map(|i| i as f64 / spans as f64).collect::<Vec<_>>())
    }

    /// The clamped knots over `breaks`: the first and the last `degree + 1` times, the others as often as they are given.
    ///
    /// # Errors
    /// As [`Knots::new`].
    pub fn clamped(degree: usize, breaks: &[f64]) -> Result<Self, NurbsError> {
        let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else {
            return Err(NurbsError::NoDomain(0.0));
        };
        let mut values = vec![first; degree];
        values.extend_from_slice(breaks);
        values.extend(std::iter::repeat_n(last, degree));
        Self::new(degree, (breaks.len() + degree).saturating_sub(1), values)
    }

    /// The degree, 1 to 7.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of control points.
    pub fn count(&self) -> usize {
        self.values.len() - self.degree - 1
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.values[self.degree], self.values[self.count()])
    }

    /// The parameter that a fraction of the domain, 0 to 1, stands for; its ends exactly.
    pub fn at_fraction(&self, fraction: f64) -> f64 {
        let (low, high) = self.domain();
        (low * (1.0 - fraction) + high * fraction).clamp(low, high)
    }

    /// Index i of the span `[knot i, knot i + 1)`, never empty, in which a parameter lies; the last span holds its end.
    pub fn span(&self, t: f64) -> usize {
        let inner = &self.values[self.degree..=self.count()];
        let end = inner[inner.len() - 1];
        let after = if t < end { inner.partition_point(|&k| k <= t) } else { inner.partition_point(|&k| k < end) };
        self.degree + after.max(1) - 1
    }

    /// The different knots of the domain, both ends included.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.values[self.degree..=self.count()].to_vec();
        breaks.dedup();
        breaks
    }

    /// How often a value occurs.
    pub fn multiplicity(&self, value: f64) -> usize {
        self.values.partition_point(|&k| k <= value) - self.values.partition_point(|&k| k < value)
    }

    /// The parameter that control point `index` stands for: the mean of the `degree` knots inside its support.
    pub fn greville(&self, index: usize) -> f64 {
        self.values[index + 1..=index + self.degree].iter().sum::<f64>() / self.degree as f64
    }

    /// The parameter, moved into the domain where rounding has put it outside.
    ///
    /// # Errors
    /// Parameters outside the domain, NaN too.
    pub fn inside(&self, t: f64) -> Result<f64, NurbsError> {
        let (low, high) = self.domain();
        let slack = DOMAIN_SLACK * (high - low);
        if (low - slack..=high + slack).contains(&t) {
            return Ok(t.clamp(low, high));
        }
        Err(NurbsError::OutsideDomain { value: t, low, high })
    }

    /// The same domain run through backwards.
    pub fn reversed(&self) -> Self {
        let (low, high) = self.domain();
        let mut values: Vec<f64> = self.values.iter().rev().map(|k| low + (high - k)).collect();
        // Both ends exactly, whatever the sum was rounded to.
        let last = values.len() - 1 - self.degree;
        let end = values[last];
        values.iter_mut().filter(|k| **k == end).for_each(|k| *k = high);
        Self { degree: self.degree, values }
    }

    /// These knots and `more`, in order.
    ///
    /// # Errors
    /// New knots outside the open domain; multiplicities as in [`Knots::new`].
    pub fn with(&self, more: &[f64]) -> Result<Self, NurbsError> {
        let (low, high) = self.domain();
        if let Some(&value) = more.iter().find(|&&k| !(low < k && k < high)) {
            return Err(NurbsError::OutsideDomain { value, low, high });
        }
        let mut values = [self.values.as_slice(), more].concat();
        values.sort_by(f64::total_cmp);
        Self::new(self.degree, self.count() + more.len(), values)
    }

    fn refuse_multiplicities(&self) -> Result<(), NurbsError> {
        let (low, high) = self.domain();
        for run in self.values.chunk_by(|a, b| a == b) {
            let inner = low < run[0] && run[0] < high;
            let limit = if inner { self.degree } else { self.degree + 1 };
            if run.len() > limit {
                return Err(NurbsError::Multiplicity { value: run[0], multiplicity: run.len(), limit });
            }
        }
        Ok(())
    }
}

/// Refuses degrees outside 1 to 7 and too few control points.
pub(crate) fn refuse_sizes(degree: usize, count: usize) -> Result<(), NurbsError> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(NurbsError::Degree(degree));
    }
    if count <= degree {
        return Err(NurbsError::TooFewPoints { degree, count });
    }
    Ok(())
}

fn refuse_values(values: &[f64]) -> Result<(), NurbsError> {
    if let Some(index) = values.iter().position(|k| !k.is_finite()) {
        return Err(NurbsError::KnotNotFinite(index));
    }
    match values.windows(2).position(|w| w[1] < w[0]) {
        Some(i) => Err(NurbsError::Decreasing { index: i + 1, value: values[i + 1], before: values[i] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_knots_are_refused() {
        let refused = |degree, count, values: &[f64]| Knots::new(degree, count, values.to_vec()).err();
        assert_eq!(refused(8, 9, &[0.0; 18]), Some(NurbsError::Degree(8)));
        assert_eq!(refused(3, 3, &[0.0; 7]), Some(NurbsError::TooFewPoints { degree: 3, count: 3 }));
        let short = NurbsError::KnotCount { length: 3, count: 2, degree: 1 };
        assert_eq!(refused(1, 2, &[0.0, 0.0, 1.0]), Some(short));
        let decreasing = NurbsError::Decreasing { index: 2, value: 0.5, before: 1.0 };
        assert_eq!(refused(1, 2, &[0.0, 1.0, 0.5, 1.0]), Some(decreasing));
        assert_eq!(refused(1, 2, &[0.0, 1.0, 1.0, 1.0]), Some(NurbsError::NoDomain(1.0)));
        let often = NurbsError::Multiplicity { value: 0.5, multiplicity: 2, limit: 1 };
        assert_eq!(refused(1, 4, &[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]), Some(often));
        assert_eq!(refused(1, 2, &[0.0, 0.0, 1.0, f64::NAN]), Some(NurbsError::KnotNotFinite(3)));
    }

    #[test]
    fn spans_are_never_empty() {
        let knots = Knots::new(2, 6, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0]).expect("valid");
        assert_eq!([0.0, 0.5, 1.0, 2.0, 2.9, 3.0].map(|t| knots.span(t)), [2, 2, 4, 5, 5, 5]);
        assert_eq!(knots.breaks(), [0.0, 1.0, 2.0, 3.0]);
    }
}
