//! Depth of 2-D strands by the portrait paper's energy (eq. 5).
//!
//! `E = Σ w_Z (z - z̄)² + w_S Σ (z_i - (z_{i-1} + z_{i+1}) / 2)² + w_N Σ (z_i - mean of N(i))²`
//!
//! The normal equations are solved by conjugate gradients without forming the matrix: squaring E_N would fill some fifty entries
//! a row. The preconditioner is the exact inverse of what couples vertices of one strand (a band of five, factored per
//! strand), so that stiffness along strands, which makes the plain iteration slow, costs nothing; strands are
//! factored and solved in parallel. The paper's biconjugate gradients need no symmetry, which this system has.

use rayon::prelude::*;

use crate::FieldError;
use crate::error::{check_number, check_offsets};
use crate::neighbours::Lists;
use crate::sums::dot;

/// Weights of the energy and what to stop at.
#[derive(Clone, Copy, Debug)]
pub struct DepthOptions {
    /// w_S: straightness along a strand.
    pub strand_weight: f64,
    /// w_N: likeness to neighbouring strands.
    pub neighbour_weight: f64,
    /// Largest residual, relative to the right-hand side.
    pub accuracy: f64,
    /// Most steps.
    pub max_iterations: usize,
}

/// Depths and how the solver fared.
#[derive(Clone, Debug)]
pub struct Depths {
    /// One depth a vertex.
    pub z: Vec<f64>,
    /// Steps taken.
    pub iterations: usize,
    /// The accuracy was reached.
    pub converged: bool,
    /// Residual, relative to the right-hand side.
    pub residual: f64,
}

/// Minimises the energy from `start`. `target` and `weight` (w_Z, 0: no constraint) have one entry a vertex.
///
/// A part of the strands that no constraint reaches keeps the mean of its start.
///
/// # Errors
/// Lengths that do not fit, weights that are negative or not finite.
pub fn strand_depths(
    offsets: &[i64],
    near: &Lists,
    target: &[f64],
    weight: &[f64],
    start: &[f64],
    options: DepthOptions,
) -> Result<Depths, FieldError> {
    let count = target.len();
    check_offsets(offsets, count)?;
    for (name, found) in [("weight", weight.len()), ("start", start.len()), ("neighbours", near.starts.len() - 1)] {
        if found != count {
            return Err(FieldError::Length { name, found, expected: count });
        }
    }
    weight.iter().try_for_each(|&w| check_number("weight", w))?;
    for (name, value) in [
        ("strand_weight", options.strand_weight),
        ("neighbour_weight", options.neighbour_weight),
        ("accuracy", options.accuracy),
    ] {
        check_number(name, value)?;
    }
    let energy = Energy::new(offsets, near, weight, options);
    Ok(solve(&energy, target, start, options))
}

struct Energy<'a> {
    ranges: Vec<(usize, usize)>,
    strand: Vec<(bool, bool)>,
    near: &'a Lists,
    namers: Lists,
    weight: &'a [f64],
    options: DepthOptions,
}

impl<'a> Energy<'a> {
    fn new(offsets: &[i64], near: &'a Lists, weight: &'a [f64], options: DepthOptions) -> Self {
        let ranges: Vec<(usize, usize)> = offsets.windows(2).map(|p| (p[0] as usize, p[1] as usize)).collect();
        let mut strand = vec![(false, false); weight.len()];
        for &(first, end) in &ranges {
            for (i, has) in strand[first..end].iter_mut().enumerate() {
                *has = (i > 0, first + i + 1 < end);
            }
        }
        Self { ranges, strand, near, namers: near.reversed(), weight, options }
    }

    /// z minus the mean of its two neighbours on the strand; 0 at the ends.
    fn bend(&self, x: &[f64], i: usize) -> f64 {
        if self.strand[i] == (true, true) { x[i] - (x[i - 1] + x[i + 1]) / 2.0 } else { 0.0 }
    }

    /// z minus the mean of N; 0 without neighbours.
    fn stray(&self, x: &[f64], i: usize) -> f64 {
        let near = self.near.of(i);
        if near.is_empty() {
            return 0.0;
        }
        x[i] - near.iter().map(|&j| x[j as usize]).sum::<f64>() / near.len() as f64
    }

    /// Half the gradient of the energy without its constant part.
    fn apply(&self, x: &[f64], out: &mut [f64]) {
        let (bend, stray): (Vec<f64>, Vec<f64>) =
            (0..x.len()).into_par_iter().with_min_len(1024).map(|i| (self.bend(x, i), self.stray(x, i))).unzip();
        out.par_iter_mut().with_min_len(1024).enumerate().for_each(|(i, out)| {
            let (before, after) = self.strand[i];
            let mut along = bend[i];
            along -= if before { bend[i - 1] / 2.0 } else { 0.0 };
            along -= if after { bend[i + 1] / 2.0 } else { 0.0 };
            let named: f64 =
                self.namers.of(i).iter().map(|&j| stray[j as usize] / self.near.of(j as usize).len() as f64).sum();
            *out = self.weight[i] * x[i]
                + self.options.strand_weight * along
                + self.options.neighbour_weight * (stray[i] - named);
        });
    }

    fn neighbour_diagonal(&self, i: usize) -> f64 {
        let own = f64::from(u8::from(!self.near.of(i).is_empty()));
        let named: f64 = self.namers.of(i).iter().map(|&j| (self.near.of(j as usize).len() as f64).powi(-2)).sum();
        self.options.neighbour_weight * (own + named)
    }

    /// The band of five of one strand, as rows (diagonal, next, next but one), factored to L D Lᵀ.
    fn factor(&self, (first, end): (usize, usize)) -> Vec<[f64; 3]> {
        let mut band: Vec<[f64; 3]> =
            (first..end).map(|i| [self.weight[i] + self.neighbour_diagonal(i) + 1e-9, 0.0, 0.0]).collect();
        let w = self.options.strand_weight;
        for k in 1..band.len().saturating_sub(1) {
            let add = |slot: &mut f64, value: f64| *slot += w * value;
            add(&mut band[k - 1][0], 0.25);
            add(&mut band[k - 1][1], -0.5);
            add(&mut band[k - 1][2], 0.25);
            add(&mut band[k][0], 1.0);
            add(&mut band[k][1], -0.5);
            add(&mut band[k + 1][0], 0.25);
        }
        for k in 0..band.len() {
            let [d, a, b] = band[k];
            let (la, lb) = (a / d, b / d);
            if k + 1 < band.len() {
                band[k + 1][0] -= la * a;
                band[k + 1][1] -= la * b;
            }
            if k + 2 < band.len() {
                band[k + 2][0] -= lb * b;
            }
            band[k] = [d, la, lb];
        }
        band
    }
}

/// Solves L D Lᵀ x = r in place.
fn solve_band(band: &[[f64; 3]], r: &mut [f64]) {
    for k in 0..r.len() {
        if k >= 1 {
            r[k] -= band[k - 1][1] * r[k - 1];
        }
        if k >= 2 {
            r[k] -= band[k - 2][2] * r[k - 2];
        }
    }
    for k in (0..r.len()).rev() {
        r[k] /= band[k][0];
        if k + 1 < r.len() {
            r[k] -= band[k][1] * r[k + 1];
        }
        if k + 2 < r.len() {
            r[k] -= band[k][2] * r[k + 2];
        }
    }
}

fn precondition(energy: &Energy<'_>, bands: &[Vec<[f64; 3]>], r: &[f64]) -> Vec<f64> {
    let mut out = r.to_vec();
    let mut rest: &mut [f64] = &mut out;
    let mut parts = Vec::with_capacity(bands.len());
    for &(first, end) in &energy.ranges {
        let (part, tail) = rest.split_at_mut(end - first);
        parts.push(part);
        rest = tail;
    }
    parts.into_par_iter().zip(bands).with_min_len(16).for_each(|(part, band)| solve_band(band, part));
    out
}

fn solve(energy: &Energy<'_>, target: &[f64], start: &[f64], options: DepthOptions) -> Depths {
    let bands: Vec<Vec<[f64; 3]>> = energy.ranges.par_iter().map(|&range| energy.factor(range)).collect();
    let b: Vec<f64> = target.iter().zip(energy.weight).map(|(t, w)| if *w > 0.0 { t * w } else { 0.0 }).collect();
    let mut x = start.to_vec();
    let mut image = vec![0.0; x.len()];
    energy.apply(&x, &mut image);
    let mut r: Vec<f64> = b.iter().zip(&image).map(|(b, q)| b - q).collect();
    let scale = dot(&b, &b).sqrt().max(f64::MIN_POSITIVE);
    let mut z = precondition(energy, &bands, &r);
    let mut p = z.clone();
    let mut rz = dot(&r, &z);
    let mut iterations = 0;
    let mut residual = dot(&r, &r).sqrt() / scale;
    while residual > options.accuracy && iterations < options.max_iterations {
        energy.apply(&p, &mut image);
        let curvature = dot(&p, &image);
        if curvature <= 0.0 {
            break;
        }
        let step = rz / curvature;
        x.par_iter_mut().zip(&p).for_each(|(x, p)| *x += step * p);
        r.par_iter_mut().zip(&image).for_each(|(r, q)| *r -= step * q);
        z = precondition(energy, &bands, &r);
        let next = dot(&r, &z);
        let turn = next / rz;
        rz = next;
        p.par_iter_mut().zip(&z).for_each(|(p, z)| *p = z + turn * *p);
        residual = dot(&r, &r).sqrt() / scale;
        iterations += 1;
    }
    Depths { z: x, iterations, converged: residual <= options.accuracy, residual }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alone(count: usize) -> Lists {
        Lists { starts: vec![0; count + 1], members: Vec::new() }
    }

    const OPTIONS: DepthOptions =
        DepthOptions { strand_weight: 2.0, neighbour_weight: 1.0, accuracy: 1e-13, max_iterations: 5000 };

    #[test]
    fn a_strand_held_at_both_ends_is_straight() {
        let mut target = vec![0.0; 21];
        let mut weight = vec![0.0; 21];
        target[20] = 0.1;
        weight[0] = 5.0;
        weight[20] = 5.0;
        let out = strand_depths(&[0, 21], &alone(21), &target, &weight, &[0.0; 21], OPTIONS).expect("fits");
        assert!(out.converged);
        assert!(out.z.iter().enumerate().all(|(i, z)| (z - 0.005 * i as f64).abs() < 1e-6));
    }

    #[test]
    fn a_free_strand_follows_its_neighbour() {
        let near = Lists { starts: vec![0, 0, 0, 1, 2], members: vec![0, 1] };
        let out = strand_depths(&[0, 2, 4], &near, &[0.2, 0.4, 0.0, 0.0], &[5.0, 5.0, 0.0, 0.0], &[0.0; 4], OPTIONS)
            .expect("fits");
        assert!((out.z[2] - 0.2).abs() < 1e-8 && (out.z[3] - 0.4).abs() < 1e-8);
    }
}
