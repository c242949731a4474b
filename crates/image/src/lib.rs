//! Image analysis for hair: Gabor bank, confidence, tracing, matting, completion.

pub mod error;
pub mod gabor;
pub mod raster_view;
pub mod ridges;
pub mod trace;
