//! Directions of hair and distances to the head on a box of voxels.

use glam::DVec3;

use crate::GridShape;

/// A box of voxels in space: voxel (layer, row, column) has its centre at `origin + size (column + ½, -(row + ½), layer + ½)`.
pub struct VoxelField<'a> {
    /// Sizes of the box.
    pub shape: GridShape,
    /// Corner of the box with the least x, greatest y, least z; metres.
    pub origin: DVec3,
    /// Edge of a voxel, metres.
    pub size: f64,
    /// Unit direction root to tip a voxel; zero outside the hair.
    pub direction: &'a [[f32; 3]],
    /// Distance to the head, metres, negative inside it.
    pub head_distance: &'a [f32],
}

impl VoxelField<'_> {
    fn place(&self, point: DVec3) -> DVec3 {
        let q = (point - self.origin) / self.size;
        DVec3::new(q.x, -q.y, q.z)
    }

    /// The voxel that a point lies in; `None` outside the box.
    pub(crate) fn voxel(&self, point: DVec3) -> Option<usize> {
        let q = self.place(point);
        let shape = self.shape;
        let inside = q.min_element() >= 0.0
            && q.x < shape.columns as f64
            && q.y < shape.rows as f64
            && q.z < shape.layers as f64;
        inside.then(|| shape.index(q.z as usize, q.y as usize, q.x as usize))
    }

    fn around(&self, point: DVec3, mut visit: impl FnMut(usize, f64)) {
        let q = self.place(point) - 0.5;
        let low = q.floor();
        let f = q - low;
        let shape = self.shape;
        let sizes = [shape.columns, shape.rows, shape.layers];
        let mut at = [[None; 2]; 3];
        for (k, size) in sizes.into_iter().enumerate() {
            for (step, place) in [low[k], low[k] + 1.0].into_iter().enumerate() {
                at[k][step] = (place >= 0.0 && place < size as f64).then_some(place as usize);
            }
        }
        for (z, depth_share) in at[2].into_iter().zip([1.0 - f.z, f.z]) {
            for (y, row_share) in at[1].into_iter().zip([1.0 - f.y, f.y]) {
                let (Some(z), Some(y)) = (z, y) else { continue };
                for (x, share) in at[0].into_iter().zip([1.0 - f.x, f.x]) {
                    if let Some(x) = x {
                        visit(shape.index(z, y, x), share * row_share * depth_share);
                    }
                }
            }
        }
    }

    /// Trilinear, each corner turned to the voxel's own sense; `None` outside the hair.
    pub(crate) fn direction_at(&self, point: DVec3) -> Option<DVec3> {
        let read = |index: usize| DVec3::from_array(self.direction[index].map(f64::from));
        let own = read(self.voxel(point)?);
        if own == DVec3::ZERO {
            return None;
        }
        let mut sum = DVec3::ZERO;
        self.around(point, |index, share| {
            let d = read(index);
            sum += d * share * if d.dot(own) < 0.0 { -1.0 } else { 1.0 };
        });
        sum.try_normalize()
    }

    /// Trilinear, metres; infinite where most of the corners are outside the box.
    pub(crate) fn head_distance(&self, point: DVec3) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        self.around(point, |index, share| {
            // Nothing of an infinite distance is nothing.
            if share > 0.0 {
                sum += share * f64::from(self.head_distance[index]);
                total += share;
            }
        });
        if total > 0.5 { sum / total } else { f64::INFINITY }
    }
}
