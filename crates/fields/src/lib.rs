//! Orientation and scalar fields on pixels and voxels: diffusion and streamlines.
