//! What holds particles together and to their places. A constraint C(p) = 0 of compliance α has the energy C² / 2α.
//!
//! `soft` stands for α / h² everywhere: that is how a step of h seconds sees a compliance. Multipliers are kept over the
//! rounds of a step (Macklin et al. 2016, eq. 18), so that more rounds come nearer to the same solution.

pub mod bend;
pub mod contact;
pub mod goal;
pub mod link;
pub mod stretch;
