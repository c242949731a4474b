//! Closed-form matting (Levin, Lischinski & Weiss 2008): the alpha of the unknown pixels of a trimap.
//!
//! Alpha is, in every 3 x 3 window, nearly a linear function of colour; what that leaves over is a quadratic form, the
//! matting Laplacian. Only unknown pixels are unknowns: the known ones move to the right-hand side. The system is solved
//! by conjugate gradients, preconditioned by an incomplete Cholesky factor and begun at the answer for the picture of half
//! the size, which finds the slow smooth part of alpha cheaply. A `settle` above 0 also takes from there what is surely
//! all or nothing, as Levin et al. do, and leaves a narrower band to solve for: most of the time, hardly any of the alpha.
//!
//! Not multigrid: the system's strong couplings follow hairs, not the grid. Not a direct solve: the band is thin, but its
//! fill is ten times the incomplete factor's.

use thiserror::Error;

use crate::matting_cholesky::{BlockCholesky, BreakdownError};
use crate::matting_laplacian::{Domain, MattingSystem};
use crate::matting_pyramid::{half_picture, half_trimap, settled_trimap, upsampled};
use crate::sparse_cg::{CgOutcome, conjugate_gradients};

/// Value of a trimap where the pixel is surely background.
pub const TRIMAP_BACKGROUND: u8 = 0;
/// Value of a trimap where alpha is wanted.
pub const TRIMAP_UNKNOWN: u8 = 128;
/// Value of a trimap where the pixel is surely foreground.
pub const TRIMAP_FOREGROUND: u8 = 255;

const LEAST_SIDE: usize = 24;
const LEAST_UNKNOWN: usize = 500;
/// Unknown pixels from which on the answer for half the size may settle some.
const MANY_UNKNOWN: usize = 10_000;

/// What is wrong with the input, or why no alpha came out.
#[derive(Debug, Error, PartialEq)]
pub enum MattingError {
    /// The slices do not hold one picture of the given size.
    #[error("a picture of {width} x {height} has {expected} colour values and trimap pixels; got {got}")]
    WrongSize {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// Length that was expected.
        expected: usize,
        /// Length that came.
        got: usize,
    },
    /// The picture has no 3 x 3 window.
    #[error("a picture of {0} x {1} is too small for matting; 3 x 3 pixels are needed")]
    TooSmall(usize, usize),
    /// The trimap says nothing anywhere.
    #[error("the trimap has no known pixel")]
    NothingKnown,
    /// No diagonal shift made the factor positive.
    #[error(transparent)]
    Breakdown(#[from] BreakdownError),
}

/// Settings of `closed_form_alpha`.
#[derive(Debug, Clone, Copy)]
pub struct MattingSettings {
    /// Variance of colour (white = 1) that is added in every window; 1e-7 to 1e-5.
    pub epsilon: f64,
    /// Norm of the residual, over that of the right-hand side, at which the solver stops.
    pub tolerance: f64,
    /// Most iterations, at every size.
    pub max_iterations: usize,
    /// Entries of the incomplete factor below this part of the diagonal are dropped.
    pub drop: f64,
    /// Where the answer for half the size is this near 0 or 1 all around, alpha counts as known; 0 settles none.
    pub settle: f64,
}

impl Default for MattingSettings {
    fn default() -> Self {
        Self { epsilon: 1e-6, tolerance: 1e-5, max_iterations: 500, drop: 1e-2, settle: 0.0 }
    }
}

/// Alpha of every pixel, row by row, in [0, 1]; and how the solver fared at full size.
#[derive(Debug, Clone)]
pub struct Alpha {
    /// Alpha in [0, 1], one value a pixel.
    pub alpha: Vec<f64>,
    /// Iterations, residual and whether it got below the tolerance.
    pub outcome: CgOutcome,
}

/// Alpha of the picture `color` (RGB in [0, 1], row by row) under `trimap` (0, 128 or 255 a pixel; others count as 128).
///
/// Colours should be coded (sRGB): equal steps then look equal, in light and shade. The same bits for any number of
/// threads. About 6 µs an unknown pixel on one core.
pub fn closed_form_alpha(
    color: &[[f64; 3]],
    trimap: &[u8],
    width: usize,
    height: usize,
    settings: &MattingSettings,
) -> Result<Alpha, MattingError> {
    for got in [color.len(), trimap.len()] {
        if got != width * height {
            return Err(MattingError::WrongSize { width, height, expected: width * height, got });
        }
    }
    if width < 3 || height < 3 {
        return Err(MattingError::TooSmall(width, height));
    }
    if !trimap.iter().any(|&t| is_known(t)) {
        return Err(MattingError::NothingKnown);
    }
    solve_level(color, trimap, width, height, settings)
}

/// Whether a trimap value settles its pixel.
pub(crate) fn is_known(value: u8) -> bool {
    value == TRIMAP_BACKGROUND || value == TRIMAP_FOREGROUND
}

fn solve_level(
    color: &[[f64; 3]],
    trimap: &[u8],
    width: usize,
    height: usize,
    settings: &MattingSettings,
) -> Result<Alpha, MattingError> {
    let mut domain = Domain::new(trimap, width, height);
    let mut alpha: Vec<f64> = trimap.iter().map(|&t| known_alpha(t)).collect();
    if domain.pixels.is_empty() {
        return Ok(Alpha { alpha, outcome: CgOutcome { iterations: 0, residual: 0.0, converged: true } });
    }
    let mut start = vec![0.5; domain.pixels.len()];
    if let Some(small) = half_answer(color, trimap, &domain, settings)? {
        if settings.settle > 0.0 && domain.pixels.len() >= MANY_UNKNOWN {
            let settled = settled_trimap(trimap, width, height, &small, settings.settle);
            domain = Domain::new(&settled, width, height);
            alpha = settled.iter().map(|&t| known_alpha(t)).collect();
        }
        let value = |p: usize| upsampled(&small, width / 2, height / 2, p % width, p / width);
        start = domain.pixels.iter().map(|&p| value(p)).collect();
    }
    let system = MattingSystem::assemble(color, &alpha, &domain, settings.epsilon);
    let factor = BlockCholesky::of(&system.matrix, settings.drop)?;
    let (solution, outcome) = conjugate_gradients(
        &system.matrix,
        &system.right_side,
        start,
        |r, z| factor.solve(r, z),
        settings.tolerance,
        settings.max_iterations,
    );
    for (&pixel, value) in domain.pixels.iter().zip(solution) {
        alpha[pixel] = value.clamp(0.0, 1.0);
    }
    Ok(Alpha { alpha, outcome })
}

fn known_alpha(value: u8) -> f64 {
    if value == TRIMAP_FOREGROUND { 1.0 } else { 0.0 }
}

/// Alpha of the picture of half the size; nothing where that would be too small.
fn half_answer(
    color: &[[f64; 3]],
    trimap: &[u8],
    domain: &Domain,
    settings: &MattingSettings,
) -> Result<Option<Vec<f64>>, MattingError> {
    let (width, height) = (domain.width, domain.height);
    if width.min(height) < 2 * LEAST_SIDE || domain.pixels.len() < LEAST_UNKNOWN {
        return Ok(None);
    }
    let coarse = MattingSettings { tolerance: settings.tolerance.max(1e-4), ..*settings };
    let (color, trimap) = (half_picture(color, width, height), half_trimap(trimap, width, height));
    Ok(Some(solve_level(&color, &trimap, width / 2, height / 2, &coarse)?.alpha))
}

#[cfg(test)]
#[path = "matting_tests.rs"]
mod tests;
