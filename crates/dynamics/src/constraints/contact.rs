//! Particles that stay outside of things, and rub against them.

use glam::DVec3;

/// Where a surface is, seen from a particle.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// How deep the particle is, metres, > 0.
    pub depth: f64,
    /// Way out, a unit vector.
    pub normal: DVec3,
    /// Where the place at which the particle was went with the surface.
    pub carried: DVec3,
}

/// The particle on the surface, slid less than it would by up to `friction` times its depth.
pub(crate) fn resolved(point: DVec3, touch: Touch, friction: f64) -> DVec3 {
    let out = point + touch.depth * touch.normal;
    let way = out - touch.carried;
    let slide = way - way.dot(touch.normal) * touch.normal;
    let length = slide.length();
    if length > 0.0 { out - slide * (friction * touch.depth / length).min(1.0) } else { out }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_particle_leaves_along_the_normal_and_rubs() {
        let touch = Touch { depth: 0.1, normal: DVec3::Y, carried: DVec3::ZERO };
        let point = DVec3::new(0.5, -0.1, 0.0);
        assert_eq!(resolved(point, touch, 0.0), DVec3::new(0.5, 0.0, 0.0));
        assert!((resolved(point, touch, 1.0) - DVec3::new(0.4, 0.0, 0.0)).length() < 1e-12);
        assert!(resolved(point, touch, 100.0).length() < 1e-12);
    }
}
