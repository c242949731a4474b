//! Motion of hair as chains of particles: stretch and bend springs, goals, wind, collisions.
//!
//! The particle-spring layer of Koh and Huang's and of the cartoon paper's hair, integrated by compliant constraints in
//! small steps (Macklin et al. 2016, 2019). Along a chain the constraints of a kind are solved all at once and exactly:
//! stretch is a tridiagonal, bending a pentadiagonal system, so that stiff hair is stiff whatever the step and the number
//! of iterations, and infinite stiffness is a number like any other. Only springs and contacts between chains go one by
//! one.

pub mod advance;
mod chain;
mod chains;
pub mod collision;
pub mod constraints;
pub mod energy;
mod error;
mod options;
mod pentadiagonal;
mod wind;

pub use advance::{Frame, advance};
pub use chains::{Chains, State};
pub use error::DynamicsError;
pub use options::{Options, Wind};
