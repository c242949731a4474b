//! Visibility of strands and meshes: a GBuffer on the CPU.
