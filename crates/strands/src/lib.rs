//! Strands as flat arrays; one operation a file.

mod arc_length;
mod resample;
mod smooth;
mod strands;
mod transform;

pub use arc_length::{arc_lengths, lengths};
pub use resample::{Sampling, resample_by_count, resample_by_spacing};
pub use smooth::smooth;
pub use strands::{StrandError, Strands};
pub use transform::transformed;
