//! Image analysis for hair: Gabor bank, confidence, tracing, matting, completion.

pub mod error;
pub mod gabor;
pub mod gabor_kernel;
pub mod matting;
mod matting_cholesky;
mod matting_laplacian;
mod matting_pyramid;
pub mod orientation;
pub mod patch_level;
pub mod patch_search;
pub mod patchmatch;
pub mod raster_view;
pub mod ridges;
pub mod seeded;
pub mod sparse_cg;
pub mod trace;
