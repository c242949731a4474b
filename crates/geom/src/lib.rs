//! Meshes, bounding volume hierarchies, frames and curves: arrays in, arrays out.
