//! Axis-aligned boxes.

use glam::DVec3;

/// The smallest axis-aligned box around what was added; empty at first (`min` > `max`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub min: DVec3,
    /// Upper corner.
    pub max: DVec3,
}

impl Aabb {
    /// Holds nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box around points.
    pub fn of(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, &p| b.with(p))
    }

    /// The box that holds `point` too.
    pub fn with(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// The box around both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Middle of the box.
    pub fn centre(self) -> DVec3 {
        (self.min + self.max) * 0.5
    }

    /// Half of the surface; 0 when empty.
    pub fn half_area(self) -> f64 {
        let e = (self.max - self.min).max(DVec3::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }

    /// Squared distance of a point from the box; 0 inside.
    pub fn distance_sq(self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length_squared()
    }

    /// Where a ray enters the box, as a multiple of its direction and not below 0; infinite where it misses.
    pub fn entry(self, origin: DVec3, inverse_direction: DVec3, limit: f64) -> f64 {
        let a = (self.min - origin) * inverse_direction;
        let b = (self.max - origin) * inverse_direction;
        let near = nan_ignoring_max(a.min(b));
        let far = nan_ignoring_min(a.max(b));
        let near = near.max(0.0);
        if near <= far * (1.0 + 4.0 * f64::EPSILON) && near <= limit { near } else { f64::INFINITY }
    }
}

// A ray that runs inside a face of the box gives 0 * inf = NaN there; `f64::max` and `min` skip NaN.
fn nan_ignoring_max(v: DVec3) -> f64 {
    v.x.max(v.y).max(v.z)
}

fn nan_ignoring_min(v: DVec3) -> f64 {
    v.x.min(v.y).min(v.z)
}
