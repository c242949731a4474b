//! Knot insertion by the Oslo algorithm: all new knots at once, through discrete B-splines.
//!
//! A new control point is the blossom of the old curve at the `degree` new knots inside its support. Its shares of the
//! old control points, the discrete B-splines, obey the recurrence of the B-splines with one new knot at every degree,
//! so one pass costs O(degree²) a control point, however many knots are inserted; Böhm's algorithm would pay that for
//! every knot. Where a support starts before the domain of an unclamped vector, the first span of the domain stands in:
//! the blossom is the same on every span of the support.
//!
//! Source: Cohen, Lyche, Riesenfeld 1980 (`strips` [17]).

use std::ops::{Add, Mul};

use super::basis::{Row, blended};
use super::{Knots, NurbsError};

/// The control points over new knots, as shares of those over the old ones: `degree + 1` successive shares each.
#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    degree: usize,
    first: Vec<usize>,
    shares: Vec<Row>,
}

impl Refinement {
    /// The way from `old` knots to `new` ones, which are of the same degree and may trim the domain.
    ///
    /// # Errors
    /// A domain that exceeds the old one; an old knot inside the new domain that the new knots hold less often.
    pub fn new(old: &Knots, new: &Knots) -> Result<Self, NurbsError> {
        Self::of(old, new, &(0..new.count()).collect::<Vec<_>>())
    }

    /// The same for some of the new control points alone.
    ///
    /// # Errors
    /// As [`Refinement::new`].
    pub(crate) fn of(old: &Knots, new: &Knots, indices: &[usize]) -> Result<Self, NurbsError> {
        refuse_lost_knots(old, new)?;
        let (first, shares) = indices.iter().map(|&j| discrete_b_splines(old, new, j)).unzip();
        Ok(Self { degree: old.degree(), first, shares })
    }

    /// Number of new control points.
    pub fn count(&self) -> usize {
        self.first.len()
    }

    /// New control point `index` of old ones that lie `stride` apart, the first at `start`.
    pub fn point<T>(&self, index: usize, old: &[T], start: usize, stride: usize) -> T
    where
        T: Copy + Add<Output = T> + Mul<f64, Output = T>,
    {
        let at = start + self.first[index] * stride;
        let shares = &self.shares[index];
        (1..=self.degree).fold(old[at] * shares[0], |sum, k| sum + old[at + k * stride] * shares[k])
    }

    /// All new control points.
    pub fn apply<T>(&self, old: &[T]) -> Vec<T>
    where
        T: Copy + Add<Output = T> + Mul<f64, Output = T>,
    {
        (0..self.count()).map(|j| self.point(j, old, 0, 1)).collect()
    }
}

/// Index of the first old control point that new control point `index` is made of, and the shares from there on.
fn discrete_b_splines(old: &Knots, new: &Knots, index: usize) -> (usize, Row) {
    let values = new.values();
    let start = values[index.max(new.degree())];
    let span = old.span(start);
    (span - old.degree(), blended(old, span, |q| values[index + q]))
}

fn refuse_lost_knots(old: &Knots, new: &Knots) -> Result<(), NurbsError> {
    let ((low, high), (new_low, new_high)) = (old.domain(), new.domain());
    for value in [new_low, new_high] {
        if value < low || value > high {
            return Err(NurbsError::OutsideDomain { value, low, high });
        }
    }
    let inner = |value: &f64| new_low < *value && *value < new_high;
    match old.breaks().into_iter().filter(inner).find(|&b| new.multiplicity(b) < old.multiplicity(b)) {
        Some(value) => Err(NurbsError::KnotLost(value)),
        None => Ok(()),
    }
}
