//! Unit normals of surfaces, also where a row of control points has collapsed to a point.
//!
//! Where all points of a row coincide one first derivative vanishes, and the normal is the limit from inside, which the
//! mixed derivative gives. Where that vanishes too (two rows in one point), the normal a little further inside is taken.

use glam::DVec3;

use super::{Jet, Knots, Surface};

/// Below this share of the longer derivative's length, or of the sine between the two, there is no normal yet.
const VANISHING: f64 = 1e-9;
/// How far inside, as a share of the domain, the last attempt looks.
const FURTHER_INSIDE: f64 = 1e-4;

impl Surface {
    /// The unit normal, du x dv, at parameters of the domain; zero where the surface has none (a patch without area).
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        let (inward_u, inward_v) = (inward(self.u(), u), inward(self.v(), v));
        self.jet(u, v).normal(inward_u, inward_v).unwrap_or_else(|| {
            let (u, v) = (further_inside(self.u(), u), further_inside(self.v(), v));
            self.jet(u, v).normal(inward_u, inward_v).unwrap_or(DVec3::ZERO)
        })
    }
}

impl Jet {
    /// The unit normal, where a missing derivative is replaced by its limit from the side that `inward_*` (+1, -1) tell.
    fn normal(&self, inward_u: f64, inward_v: f64) -> Option<DVec3> {
        let size = self.du.length().max(self.dv.length());
        let no_u = self.du.length() <= VANISHING * size;
        let no_v = self.dv.length() <= VANISHING * size;
        let du = if no_u { self.duv * inward_v } else { self.du };
        let dv = if no_v { self.duv * inward_u } else { self.dv };
        let across = du.cross(dv);
        let flat = across.length() <= VANISHING * du.length() * dv.length();
        (!flat).then(|| across.normalize())
    }
}

/// Direction towards the middle of the domain.
fn inward(knots: &Knots, t: f64) -> f64 {
    let (low, high) = knots.domain();
    if t - low <= high - t { 1.0 } else { -1.0 }
}

fn further_inside(knots: &Knots, t: f64) -> f64 {
    let (low, high) = knots.domain();
    t + inward(knots, t) * FURTHER_INSIDE * (high - low)
}
