//! From the samples of a pixel to its fragments.

use crate::bins::TILE;
use crate::cutout::Layers;
use crate::gbuffer::{Fragment, Kind, TileFragments};
use crate::samples::{Pattern, SAMPLES};
use crate::segment::Segment;
use crate::strand_points::StrandPoint;
use crate::tile::{EMPTY, TRIANGLE_BIT, Tile};
use crate::triangle::Triangle;
use crate::{ProjectedScene, ProjectedVertex};

/// What fragments are made from.
pub(crate) struct Resolver<'a> {
    pub scene: &'a ProjectedScene<'a>,
    pub points: &'a [StrandPoint],
    pub pattern: &'a Pattern,
}

/// Samples of a pixel that see the same primitive.
#[derive(Clone, Copy)]
struct Group {
    primitive: u32,
    /// Samples, those that are seen in part as parts.
    count: f32,
    x: f32,
    y: f32,
}

/// The groups of a pixel.
#[derive(Default)]
struct Groups(Vec<Group>);

impl Groups {
    fn add(&mut self, primitive: u32, share: f32, x: f32, y: f32) {
        let known = self.0.iter().position(|group| group.primitive == primitive).unwrap_or(self.0.len());
        if known == self.0.len() {
            self.0.push(Group { primitive, count: 0.0, x: 0.0, y: 0.0 });
        }
        let group = &mut self.0[known];
        group.count += share;
        group.x += share * x;
        group.y += share * y;
    }
}

impl Resolver<'_> {
    /// Adds the fragments of every pixel of the tile, row by row, and how many each pixel has.
    pub fn resolve(&self, tile: &Tile, layers: &mut Layers, found: &mut TileFragments) {
        let fragments = &mut found.fragments;
        let mut groups = Groups::default();
        for row in 0..tile.size[1] {
            for column in 0..tile.size[0] {
                let pixel = row as usize * TILE + column as usize;
                if tile.primitive[pixel] == [EMPTY; SAMPLES] && !layers.over(pixel) {
                    continue;
                }
                let corner = [(tile.origin[0] + column) as f32, (tile.origin[1] + row) as f32];
                let first = fragments.len();
                groups.0.clear();
                self.group(&tile.primitive[pixel], pixel, layers, &mut groups);
                fragments.extend(groups.0.iter().filter_map(|group| self.fragment(group, corner)));
                fragments[first..].sort_unstable_by(|a, b| {
                    a.depth.total_cmp(&b.depth).then((a.kind as u8, a.primitive).cmp(&(b.kind as u8, b.primitive)))
                });
                found.counts[row as usize * found.width + column as usize] = (fragments.len() - first) as u32;
            }
        }
    }

    /// Gathers the samples of a pixel by what they see.
    fn group(&self, primitives: &[u32; SAMPLES], pixel: usize, layers: &mut Layers, groups: &mut Groups) {
        let layered = layers.over(pixel);
        for (i, &primitive) in primitives.iter().enumerate() {
            let (x, y) = (self.pattern.x[i], self.pattern.y[i]);
            let mut through = 1.0;
            if layered {
                through = layers.for_each_share(pixel, i, |triangle, share| {
                    groups.add(triangle | TRIANGLE_BIT, share, x, y);
                });
            }
            if primitive != EMPTY && through > 0.0 {
                groups.add(primitive, through, x, y);
            }
        }
    }

    fn fragment(&self, group: &Group, corner: [f32; 2]) -> Option<Fragment> {
        let x = corner[0] + group.x / group.count;
        let y = corner[1] + group.y / group.count;
        let weight = group.count / SAMPLES as f32;
        if group.primitive & TRIANGLE_BIT == 0 {
            return self.segment_fragment(group.primitive, x, y, weight);
        }
        self.triangle_fragment(group.primitive & !TRIANGLE_BIT, x, y, weight)
    }

    fn segment_fragment(&self, primitive: u32, x: f32, y: f32, weight: f32) -> Option<Fragment> {
        let first = primitive as usize;
        let (a, b) = (&self.points[first], &self.points[first + 1]);
        let [t, across] = Segment::new(a, b)?.parameters(x, y);
        let depth = a.depth + t * (b.depth - a.depth);
        let scales = [first, first + 1].map(|i| ProjectedVertex::from(self.scene.strand_points[i]).scale);
        let [_, t] = in_perspective([1.0 - t, t], scales);
        Some(Fragment { kind: Kind::Segment, primitive, parameter: [t, across], weight, depth })
    }

    fn triangle_fragment(&self, primitive: u32, x: f32, y: f32, weight: f32) -> Option<Fragment> {
        let vertices: [&ProjectedVertex; 3] =
            self.scene.triangles[primitive as usize].map(|v| &self.scene.mesh_vertices[v as usize]);
        let on_screen = Triangle::new(vertices)?.barycentric(x, y);
        let depth = (0..3).map(|i| on_screen[i] * vertices[i].depth).sum();
        let [_, b, c] = in_perspective(on_screen, vertices.map(|v| v.scale));
        Some(Fragment { kind: Kind::Triangle, primitive, parameter: [b, c], weight, depth })
    }
}

/// Weights of the vertices in space from those on the screen: w_i s_i / sum, since `scale` goes as 1 / distance.
fn in_perspective<const N: usize>(on_screen: [f32; N], scales: [f32; N]) -> [f32; N] {
    let scaled: [f32; N] = std::array::from_fn(|i| on_screen[i] * scales[i]);
    let sum: f32 = scaled.iter().sum();
    scaled.map(|weight| weight / sum)
}
