//! Visibility of strands and meshes: a GBuffer on the CPU.
//!
//! Everything is already projected when it comes in (`project` does it for cameras; baking passes uv coordinates), is
//! sorted into tiles, and every tile is rasterised by one core on its own: 16 samples a pixel, each with its own depth
//! test. What every pixel sees is then merged into fragments. No result depends on the number of cores.

mod alpha_coverage;
mod bins;
mod composite;
mod cutout;
mod error;
mod fit;
mod gbuffer;
mod project;
mod rasterise;
mod resolve;
mod samples;
mod scene;
mod segment;
mod splat;
mod strand_points;
mod tile;
mod triangle;

pub use alpha_coverage::AlphaPicture;
pub use composite::{composite, interpolated, strand_picture};
pub use cutout::Cutout;
pub use error::RasterError;
pub use fit::fit_colors;
pub use gbuffer::{GBuffer, Kind};
pub use project::{ProjectedVertex, project};
pub use rasterise::rasterise;
pub use samples::SAMPLES;
pub use scene::ProjectedScene;
pub use splat::{SegmentFragments, visible_weight};
