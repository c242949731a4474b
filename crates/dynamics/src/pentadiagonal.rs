//! Symmetric positive definite systems with two diagonals on either side.

use glam::DVec3;

/// A matrix in the making, then its factors L D Lᵀ in the same place.
#[derive(Clone, Debug)]
pub(crate) struct Pentadiagonal {
    /// Diagonal; D once factored.
    pub diagonal: Vec<f64>,
    /// Entry (i + 1, i).
    pub first: Vec<f64>,
    /// Entry (i + 2, i).
    pub second: Vec<f64>,
}

impl Pentadiagonal {
    /// A zero matrix.
    pub fn new(size: usize) -> Self {
        Self { diagonal: vec![0.0; size], first: vec![0.0; size], second: vec![0.0; size] }
    }

    /// Factors in place. A row that depends on the ones before is left out of every solution.
    pub fn factor(&mut self) {
        let size = self.diagonal.len();
        let largest = self.diagonal.iter().copied().fold(0.0, f64::max);
        for i in 0..size {
            if self.diagonal[i] <= 1e-14 * largest {
                (self.diagonal[i], self.first[i], self.second[i]) = (f64::INFINITY, 0.0, 0.0);
                continue;
            }
            let d = self.diagonal[i];
            let (first, second) = (self.first[i], self.second[i]);
            (self.first[i], self.second[i]) = (first / d, second / d);
            if i + 1 < size {
                self.diagonal[i + 1] -= first * self.first[i];
                self.first[i + 1] -= second * self.first[i];
            }
            if i + 2 < size {
                self.diagonal[i + 2] -= second * self.second[i];
            }
        }
    }

    /// Solves for three right sides at once, in place.
    pub fn solve(&self, values: &mut [DVec3]) {
        let size = self.diagonal.len();
        for i in 0..size {
            let value = values[i];
            if i + 1 < size {
                values[i + 1] -= self.first[i] * value;
            }
            if i + 2 < size {
                values[i + 2] -= self.second[i] * value;
            }
        }
        for i in (0..size).rev() {
            values[i] /= self.diagonal[i];
            if i + 1 < size {
                let next = values[i + 1];
                values[i] -= self.first[i] * next;
            }
            if i + 2 < size {
                let next = values[i + 2];
                values[i] -= self.second[i] * next;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_fulfils_the_system() {
        let size = 9;
        let mut matrix = Pentadiagonal::new(size);
        for i in 0..size {
            matrix.diagonal[i] = 6.0 + i as f64;
            matrix.first[i] = -2.0 + 0.1 * i as f64;
            matrix.second[i] = 0.7;
        }
        let entry = |matrix: &Pentadiagonal, i: usize, j: usize| match i.abs_diff(j) {
            0 => matrix.diagonal[i],
            1 => matrix.first[i.min(j)],
            2 => matrix.second[i.min(j)],
            _ => 0.0,
        };
        let wanted: Vec<DVec3> = (0..size).map(|i| DVec3::new(i as f64, 1.0, (i * i) as f64)).collect();
        let mut values: Vec<DVec3> =
            (0..size).map(|i| (0..size).map(|j| entry(&matrix, i, j) * wanted[j]).sum()).collect();
        matrix.factor();
        matrix.solve(&mut values);
        assert!(values.iter().zip(&wanted).all(|(a, b)| (*a - *b).length() < 1e-11));
    }

    #[test]
    fn an_empty_row_is_left_out() {
        let mut matrix = Pentadiagonal::new(3);
        (matrix.diagonal[0], matrix.diagonal[2]) = (2.0, 4.0);
        let mut values = vec![DVec3::splat(2.0); 3];
        matrix.factor();
        matrix.solve(&mut values);
        assert_eq!(values, [DVec3::ONE, DVec3::ZERO, DVec3::splat(0.5)]);
    }
}
