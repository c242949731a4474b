//! Symmetric positive definite systems whose entries lie near the diagonal.

/// A symmetric matrix, of which the diagonal and `band` entries to its left are kept in every row.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    band: usize,
    /// Row i from column `i - band` to column i.
    entries: Vec<f64>,
}

/// The factor L of L Lᵀ.
pub(crate) struct Factor(Banded);

/// A diagonal entry that has shrunk to this share of what it was tells of an unknown that nothing determines.
const SINGULAR: f64 = 1e-12;

impl Banded {
    /// A matrix of zeros.
    pub fn new(size: usize, band: usize) -> Self {
        Self { band, entries: vec![0.0; size * (band + 1)] }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.entries.len() / (self.band + 1)
    }

    /// Adds to the entry of a row and a column that is not beyond it, and to the mirrored one.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.index(row, column);
        self.entries[at] += value;
    }

    /// The entry of a row and a column, which lie at most a band apart.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.entries[self.index(row.max(column), row.min(column))]
    }

    /// Takes an unknown out: its row and column become those of the unit matrix.
    pub fn take_out(&mut self, unknown: usize) {
        for other in self.near(unknown) {
            let at = self.index(other.max(unknown), other.min(unknown));
            self.entries[at] = if other == unknown { 1.0 } else { 0.0 };
        }
    }

    /// The rows that share an entry with a row.
    pub fn near(&self, row: usize) -> std::ops::Range<usize> {
        row.saturating_sub(self.band)..(row + self.band + 1).min(self.size())
    }

    /// Cholesky's factor; otherwise the first unknown that is not determined.
    pub fn factor(mut self) -> Result<Factor, usize> {
        for i in 0..self.size() {
            let first = i.saturating_sub(self.band);
            let before = self.get(i, i);
            for j in first..=i {
                let shared = first.max(j.saturating_sub(self.band));
                let product: f64 = (shared..j).map(|k| self.get(i, k) * self.get(j, k)).sum();
                let rest = self.get(i, j) - product;
                let at = self.index(i, j);
                if j < i {
                    self.entries[at] = rest / self.get(j, j);
                } else if rest <= SINGULAR * before || rest.is_nan() {
                    return Err(i);
                } else {
                    self.entries[at] = rest.sqrt();
                }
            }
        }
        Ok(Factor(self))
    }

    fn index(&self, row: usize, column: usize) -> usize {
        row * (self.band + 1) + self.band + column - row
    }
}

impl Factor {
    /// Solves for one right-hand side, in place.
    pub fn solve(&self, values: &mut [f64]) {
        let (l, size) = (&self.0, self.0.size());
        for i in 0..size {
            let known: f64 = (i.saturating_sub(l.band)..i).map(|k| l.get(i, k) * values[k]).sum();
            values[i] = (values[i] - known) / l.get(i, i);
        }
        for i in (0..size).rev() {
            let known: f64 = (i + 1..(i + l.band + 1).min(size)).map(|k| l.get(k, i) * values[k]).sum();
            values[i] = (values[i] - known) / l.get(i, i);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_differences_are_solved_and_free_unknowns_are_named() {
        let mut matrix = Banded::new(6, 2);
        for i in 0..6 {
            matrix.add(i, i, 2.0);
            if i > 0 {
                matrix.add(i, i - 1, -1.0);
            }
        }
        let solution = [1.0, -2.0, 3.0, 0.5, 0.0, 4.0];
        let at = |i: usize| if (1..=6).contains(&i) { solution[i - 1] } else { 0.0 };
        let mut values: Vec<f64> = (1..=6).map(|i| 2.0 * at(i) - at(i - 1) - at(i + 1)).collect();
        matrix.clone().factor().expect("positive definite").solve(&mut values);
        assert!(values.iter().zip(solution).all(|(a, b)| (a - b).abs() < 1e-13));
        let mut free = Banded::new(3, 1);
        free.add(0, 0, 1.0);
        assert_eq!(free.factor().err(), Some(1));
    }
}
