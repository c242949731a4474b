//! Things that move rigidly in a frame and that hair stays out of.

use glam::{DMat3, DQuat, DVec3};

use crate::collision::DistanceField;
use crate::constraints::contact::Touch;

/// A turn, then a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Unit quaternion.
    pub rotation: DQuat,
    /// Metres.
    pub translation: DVec3,
}

impl Pose {
    /// Where it stands.
    pub const IDENTITY: Self = Self { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    /// Part `t` of the way to another.
    #[must_use]
    pub fn towards(self, other: Self, t: f64) -> Self {
        Self {
            rotation: self.rotation.slerp(other.rotation, t),
            translation: self.translation.lerp(other.translation, t),
        }
    }
}

/// A shape in its own frame.
#[derive(Clone, Copy, Debug)]
pub enum Shape<'a> {
    /// All within `radius` of the way between two points, which may be one.
    Capsule {
        /// One end.
        from: DVec3,
        /// The other.
        to: DVec3,
        /// Metres.
        radius: f64,
    },
    /// A mesh, as signed distances.
    Field(DistanceField<'a>),
}

impl Shape<'_> {
    /// Distance and way out at a point of the shape's frame; `None` where it is far away.
    fn at(&self, point: DVec3) -> Option<(f64, DVec3)> {
        match self {
            Self::Field(field) => field.at(point),
            Self::Capsule { from, to, radius } => {
                let axis = *to - *from;
                let length_sq = axis.length_squared();
                let t = if length_sq > 0.0 { ((point - *from).dot(axis) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
                let away = point - (*from + t * axis);
                let distance = away.length();
                let out =
                    if distance > 0.0 { away / distance } else { axis.any_orthogonal_vector().normalize_or(DVec3::Y) };
                Some((distance - radius, out))
            }
        }
    }
}

/// A shape and where it goes in a frame.
#[derive(Clone, Copy, Debug)]
pub struct Collider<'a> {
    /// In its own frame.
    pub shape: Shape<'a>,
    /// Where it is when the frame begins.
    pub before: Pose,
    /// Where it is when the frame ends.
    pub after: Pose,
}

impl<'a> Collider<'a> {
    /// In the part `t0..t1` of the frame.
    #[must_use]
    pub fn during(&self, t0: f64, t1: f64) -> Moving<'a> {
        let [earlier, now] = [t0, t1].map(|t| self.before.towards(self.after, t));
        let turn = now.rotation * earlier.rotation.inverse();
        Moving {
            shape: self.shape,
            into_local: DMat3::from_quat(now.rotation.inverse()),
            out: DMat3::from_quat(now.rotation),
            at: now.translation,
            carry: DMat3::from_quat(turn),
            carried_by: now.translation - turn * earlier.translation,
        }
    }
}

/// A collider in a step.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a> {
    shape: Shape<'a>,
    into_local: DMat3,
    out: DMat3,
    at: DVec3,
    carry: DMat3,
    carried_by: DVec3,
}

impl Moving<'_> {
    /// Distance of a point, metres, negative inside; infinite where the shape is far away.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        self.shape.at(self.into_local * (point - self.at)).map_or(f64::INFINITY, |(distance, _)| distance)
    }

    /// Whether a particle that was at `was` before the step and is at `point` after it is nearer than `clearance`.
    #[must_use]
    pub fn touch(&self, was: DVec3, point: DVec3, clearance: f64) -> Option<Touch> {
        let (distance, normal) = self.shape.at(self.into_local * (point - self.at))?;
        (distance < clearance).then(|| Touch {
            depth: clearance - distance,
            normal: self.out * normal,
            carried: self.carry * was + self.carried_by,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning() -> Collider<'static> {
        let shape = Shape::Capsule { from: DVec3::ZERO, to: DVec3::X, radius: 0.5 };
        let after = Pose { rotation: DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2), translation: DVec3::Z };
        Collider { shape, before: Pose::IDENTITY, after }
    }

    #[test]
    fn a_capsule_knows_its_surface() {
        let touch = turning().during(0.0, 0.0).touch(DVec3::Y, DVec3::new(0.5, 0.3, 0.0), 0.1).expect("inside");
        assert!((touch.depth - 0.3).abs() < 1e-12 && (touch.normal - DVec3::Y).length() < 1e-12);
        assert!(turning().during(0.0, 0.0).touch(DVec3::Y, DVec3::new(0.5, 0.7, 0.0), 0.1).is_none());
        let end = turning().during(0.0, 0.0).touch(DVec3::Y, DVec3::new(1.3, 0.0, 0.0), 0.0).expect("inside");
        assert!((end.depth - 0.2).abs() < 1e-12 && (end.normal - DVec3::X).length() < 1e-12);
    }

    #[test]
    fn a_moving_collider_carries_what_lies_on_it() {
        let touch = turning()
            .during(0.0, 1.0)
            .touch(DVec3::new(1.0, 0.4, 0.0), DVec3::new(-0.4, 1.0, 1.0), 0.0)
            .expect("inside");
        assert!((touch.carried - DVec3::new(-0.4, 1.0, 1.0)).length() < 1e-12);
        assert!((touch.depth - 0.1).abs() < 1e-12 && (touch.normal + DVec3::X).length() < 1e-12);
    }
}
