//! One triangle in one tile, seen from either side.
//!
//! An edge that two triangles share is evaluated from the same end by both, so that both get the same number and exactly
//! one of them takes each sample: no gaps and no doubles, without exact arithmetic.

use crate::ProjectedVertex;
use crate::bins::{Rectangle, TILE};
use crate::samples::{Lane, Pattern, SAMPLES, larger, largest, take, word};
use crate::strand_points::snapped;
use crate::tile::{EMPTY, TRIANGLE_BIT, Tile};

/// A triangle with its three edges and its plane of depth.
pub(crate) struct Triangle {
    corners: [[f32; 2]; 3],
    edges: [Edge; 3],
    depth_at_first: f32,
    gradient: [f32; 2],
    nearest: f32,
}

#[derive(Clone, Copy)]
struct Edge {
    from: [f32; 2],
    along: [f32; 2],
    /// Whether the inside is where the form is not negative.
    positive: bool,
}

impl Triangle {
    /// None where the triangle has no area on the screen or lies partly behind the camera.
    pub fn new(vertices: [&ProjectedVertex; 3]) -> Option<Self> {
        let corners = vertices.map(|v| [snapped(v.x), snapped(v.y)]);
        let [a, b, c] = corners.map(|p| p.map(f64::from));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || vertices.iter().any(|v| v.scale <= 0.0) {
            return None;
        }
        let depths = vertices.map(|v| v.depth);
        let edge = |i: usize| Edge::new(corners[i], corners[(i + 1) % 3], area > 0.0);
        Some(Self {
            corners,
            edges: [edge(0), edge(1), edge(2)],
            depth_at_first: vertices[0].depth,
            gradient: gradient(corners, depths),
            nearest: depths[0].min(depths[1]).min(depths[2]),
        })
    }

    /// Where the first corner lies, in pixels.
    pub fn first_corner(&self) -> [f32; 2] {
        self.corners[0]
    }

    /// How a value that is linear on the screen, and given at the corners, grows a pixel to the right and down.
    pub fn gradient_of(&self, values: [f32; 3]) -> [f32; 2] {
        gradient(self.corners, values)
    }

    /// Rectangle around the triangle, in pixels.
    pub fn bounds(&self) -> Rectangle {
        let [a, b, c] = self.corners;
        let least = |i: usize| a[i].min(b[i]).min(c[i]);
        let most = |i: usize| a[i].max(b[i]).max(c[i]);
        Rectangle { min: [least(0), least(1)], max: [most(0), most(1)] }
    }

    /// Barycentric coordinates on the screen of a point inside, clamped to the triangle.
    pub fn barycentric(&self, x: f32, y: f32) -> [f32; 3] {
        let [a, b, c] = self.corners.map(|p| [f64::from(p[0] - x), f64::from(p[1] - y)]);
        let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let areas = [cross(b, c), cross(c, a), cross(a, b)];
        let total: f64 = areas.iter().sum();
        let shares = areas.map(|area| (area / total).max(0.0));
        let sum: f64 = shares.iter().sum();
        shares.map(|share| (share / sum) as f32)
    }

    /// Draws into a tile.
    pub fn draw(&self, index: u32, tile: &mut Tile, pattern: &Pattern) {
        let Rectangle { min, max } = self.bounds();
        let (columns, rows) = (tile.clip(0, min[0], max[0]), tile.clip(1, min[1], max[1]));
        let forms = self.edges.map(|e| pattern.linear(-e.along[1], e.along[0]));
        let depths = pattern.linear(self.gradient[0], self.gradient[1]);
        for row in rows {
            for column in columns.clone() {
                let pixel = row as usize * TILE + column as usize;
                let corner = [(tile.origin[0] + column) as f32, (tile.origin[1] + row) as f32];
                if self.nearest >= tile.farthest[pixel] || self.misses(corner) {
                    continue;
                }
                let (depth, primitive) = (&mut tile.depth[pixel], &mut tile.primitive[pixel]);
                self.cover(corner, &forms, &depths, index | TRIANGLE_BIT, depth, primitive);
                tile.farthest[pixel] = largest(&tile.depth[pixel]);
            }
        }
    }

    /// Visits every sample of the tile that the triangle covers before what is there already, without drawing, as
    /// (pixel of the tile, sample, place in the picture, depth).
    pub fn for_each_sample(&self, tile: &Tile, pattern: &Pattern, mut visit: impl FnMut(usize, usize, [f32; 2], f32)) {
        let Rectangle { min, max } = self.bounds();
        let (columns, rows) = (tile.clip(0, min[0], max[0]), tile.clip(1, min[1], max[1]));
        let forms = self.edges.map(|e| pattern.linear(-e.along[1], e.along[0]));
        let depths = pattern.linear(self.gradient[0], self.gradient[1]);
        for row in rows {
            for column in columns.clone() {
                let pixel = row as usize * TILE + column as usize;
                let corner = [(tile.origin[0] + column) as f32, (tile.origin[1] + row) as f32];
                if self.nearest >= tile.farthest[pixel] || self.misses(corner) {
                    continue;
                }
                let (mut depth, mut primitive) = (tile.depth[pixel], [EMPTY; SAMPLES]);
                self.cover(corner, &forms, &depths, 0, &mut depth, &mut primitive);
                for i in (0..SAMPLES).filter(|&i| primitive[i] != EMPTY) {
                    visit(pixel, i, [corner[0] + pattern.x[i], corner[1] + pattern.y[i]], depth[i]);
                }
            }
        }
    }

    /// Whether the pixel lies wholly outside of an edge.
    fn misses(&self, corner: [f32; 2]) -> bool {
        self.edges.iter().any(|e| {
            let middle = e.value([corner[0] + 0.5, corner[1] + 0.5]);
            let reach = 0.51 * (e.along[0].abs() + e.along[1].abs());
            if e.positive { middle < -reach } else { middle > reach }
        })
    }

    #[inline]
    fn cover(
        &self,
        corner: [f32; 2],
        forms: &[Lane; 3],
        depths: &Lane,
        index: u32,
        depth: &mut Lane,
        primitive: &mut [u32; SAMPLES],
    ) {
        let [e0, e1, e2] = self.edges.map(|e| e.value(corner));
        let [p0, p1, p2] = self.edges.map(|e| word(!e.positive));
        let (rx, ry) = (corner[0] - self.corners[0][0], corner[1] - self.corners[0][1]);
        let z0 = self.depth_at_first + self.gradient[0] * rx + self.gradient[1] * ry;
        let mut nearer: Lane = [0.0; SAMPLES];
        let mut hits = [0u32; SAMPLES];
        for i in 0..SAMPLES {
            let z = larger(z0 + depths[i], self.nearest);
            nearer[i] = z;
            hits[i] = (word(e0 + forms[0][i] >= 0.0) ^ p0)
                & (word(e1 + forms[1][i] >= 0.0) ^ p1)
                & (word(e2 + forms[2][i] >= 0.0) ^ p2)
                & word(z < depth[i]);
        }
        take(&hits, &nearer, index, depth, primitive);
    }
}

fn gradient(corners: [[f32; 2]; 3], values: [f32; 3]) -> [f32; 2] {
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let [za, zb, zc] = values.map(f64::from);
    let gx = ((zb - za) * (c[1] - a[1]) - (zc - za) * (b[1] - a[1])) / area;
    let gy = ((zc - za) * (b[0] - a[0]) - (zb - za) * (c[0] - a[0])) / area;
    [gx as f32, gy as f32]
}

impl Edge {
    /// The edge from the lower end (in the order of x, then y); `inside_left` of the given direction.
    fn new(a: [f32; 2], b: [f32; 2], inside_left: bool) -> Self {
        let forward = a < b;
        let (from, to) = if forward { (a, b) } else { (b, a) };
        Self { from, along: [to[0] - from[0], to[1] - from[1]], positive: forward == inside_left }
    }

    fn value(&self, point: [f32; 2]) -> f32 {
        self.along[0] * (point[1] - self.from[1]) - self.along[1] * (point[0] - self.from[0])
    }
}
