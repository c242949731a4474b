//! Many polylines in one array.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use thiserror::Error;

/// Why arrays are no strands.
#[derive(Debug, Error, PartialEq)]
pub enum StrandError {
    /// Offsets do not run from 0 to the number of points.
    #[error("offsets run from {first} to {last}; 0 to {count} was expected")]
    Ends {
        /// The first offset.
        first: i64,
        /// The last offset.
        last: i64,
        /// Number of points.
        count: usize,
    },
    /// A strand has fewer than two points.
    #[error("strand {strand} has {count} points; at least 2 were expected")]
    TooShort {
        /// Index of the strand.
        strand: usize,
        /// Its number of points.
        count: i64,
    },
}

/// Strand i has the points `offsets[i]..offsets[i + 1]`, at least two, root to tip.
#[derive(Debug, Clone, Copy)]
pub struct Strands<'a> {
    points: &'a [DVec3],
    offsets: &'a [i64],
}

impl<'a> Strands<'a> {
    /// Strands of flat arrays.
    ///
    /// # Errors
    /// Offsets that do not run from 0 to the number of points or do not rise by at least two.
    pub fn new(points: &'a [DVec3], offsets: &'a [i64]) -> Result<Self, StrandError> {
        let (first, last) = (offsets.first().copied().unwrap_or(-1), offsets.last().copied().unwrap_or(-1));
        if first != 0 || last != points.len() as i64 {
            return Err(StrandError::Ends { first, last, count: points.len() });
        }
        match offsets.windows(2).position(|w| w[1] - w[0] < 2) {
            Some(strand) => Err(StrandError::TooShort { strand, count: offsets[strand + 1] - offsets[strand] }),
            None => Ok(Self { points, offsets }),
        }
    }

    /// Number of strands.
    pub fn count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// All points.
    pub fn points(&self) -> &'a [DVec3] {
        self.points
    }

    /// Where the points of a strand lie in the array.
    pub fn range(&self, strand: usize) -> Range<usize> {
        self.offsets[strand] as usize..self.offsets[strand + 1] as usize
    }

    /// Applies a function to every strand in parallel; results in the order of the strands.
    pub fn map<T: Send>(&self, function: impl Fn(Range<usize>, &'a [DVec3]) -> T + Sync + Send) -> Vec<T> {
        let points = self.points;
        let of = |strand| {
            let range = self.range(strand);
            function(range.clone(), &points[range])
        };
        (0..self.count()).into_par_iter().with_min_len(64).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_offsets_are_refused() {
        let points = [DVec3::ZERO; 4];
        let refused = |offsets: &[i64]| Strands::new(&points, offsets).err();
        assert_eq!(refused(&[0, 3]), Some(StrandError::Ends { first: 0, last: 3, count: 4 }));
        assert_eq!(refused(&[]), Some(StrandError::Ends { first: -1, last: -1, count: 4 }));
        assert_eq!(refused(&[0, 3, 4]), Some(StrandError::TooShort { strand: 1, count: 1 }));
        assert_eq!(refused(&[0, 3, 2, 4]), Some(StrandError::TooShort { strand: 1, count: -1 }));
        assert_eq!(refused(&[0, 2, 4]), None);
    }
}
