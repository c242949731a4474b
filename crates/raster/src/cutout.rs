//! Triangles that one can see through: pictures of opacity, and the layers of a tile.
//!
//! Every sample keeps the list of all layers before its opaque surface and adds them up by their own depths. So any order
//! of the triangles, also of such that pass through each other, gives the exact picture. Alpha to coverage, the way of
//! the strands, would need no lists, but with 16 samples it shows steps and noise where a dozen of soft layers meet.
//!
//! Source of the list of layers: Carpenter, The A-buffer, an Antialiased Hidden Surface Method (1984).

use crate::bins::TILE;
use crate::samples::{Pattern, SAMPLES};
use crate::tile::Tile;
use crate::triangle::Triangle;
use crate::{ProjectedScene, ProjectedVertex};

/// End of a list, and the index of no layer.
const END: u32 = u32::MAX;
/// A sample is closed where less light than this comes through; the layer that closes it takes the rest.
const CLOSED: f32 = 1.0 / 512.0;
/// Layers fainter than half a byte are not there.
const LEAST: f32 = 0.5 / 255.0;

/// Opacity over a triangle, a picture of bytes: the top row first, texture coordinates as in `Texture` (v up).
#[derive(Debug, Clone, Copy)]
pub struct Cutout<'a> {
    /// `width` times `height` bytes, 255 is opaque.
    pub alpha: &'a [u8],
    /// Texels in a row.
    pub width: usize,
}

impl Cutout<'_> {
    /// Whether the texels fill a rectangle.
    pub fn fits(&self) -> bool {
        self.width > 0 && !self.alpha.is_empty() && self.alpha.len().is_multiple_of(self.width)
    }

    /// Opacity at a place, 0 to 1, bilinear, clamped at the rim.
    fn at(&self, u: f32, v: f32) -> f32 {
        let height = self.alpha.len() / self.width;
        let place = |share: f32, count: usize| {
            let x = (share * count as f32 - 0.5).clamp(0.0, (count - 1) as f32);
            let low = x as usize;
            (low, (low + 1).min(count - 1), x - low as f32)
        };
        let (left, right, fx) = place(u, self.width);
        let (upper, lower, fy) = place(1.0 - v, height);
        let texel = |column: usize, row: usize| f32::from(self.alpha[row * self.width + column]) / 255.0;
        let top = texel(left, upper) * (1.0 - fx) + texel(right, upper) * fx;
        let bottom = texel(left, lower) * (1.0 - fx) + texel(right, lower) * fx;
        top * (1.0 - fy) + bottom * fy
    }
}

/// One layer over one sample; `next` is the one that came before it.
#[derive(Clone, Copy)]
struct Layer {
    primitive: u32,
    depth: f32,
    alpha: f32,
    next: u32,
}

/// The layers of all samples of a tile.
pub(crate) struct Layers {
    first: Vec<[u32; SAMPLES]>,
    layers: Vec<Layer>,
    sorted: Vec<Layer>,
}

impl Layers {
    pub fn new() -> Self {
        Self { first: vec![[END; SAMPLES]; TILE * TILE], layers: Vec::new(), sorted: Vec::new() }
    }

    /// Forgets all layers.
    pub fn clear(&mut self) {
        if !self.layers.is_empty() {
            self.first.fill([END; SAMPLES]);
            self.layers.clear();
        }
    }

    /// Whether there is a layer before a pixel of the tile.
    pub fn over(&self, pixel: usize) -> bool {
        !self.layers.is_empty() && self.first[pixel] != [END; SAMPLES]
    }

    /// Adds a triangle of the scene wherever it lies before what is opaque.
    pub fn add(&mut self, scene: &ProjectedScene, triangle: &Triangle, index: u32, tile: &Tile, pattern: &Pattern) {
        let Some(cutout) = scene.cutout(index as usize) else { return };
        let vertices = scene.triangles[index as usize].map(|v| &scene.mesh_vertices[v as usize]);
        let place = TexturePlace::new(triangle, vertices, &scene.corner_uv[index as usize]);
        triangle.for_each_sample(tile, pattern, |pixel, sample, [x, y], depth| {
            let [u, v] = place.at(x, y);
            let alpha = cutout.at(u, v);
            if alpha >= LEAST {
                let next = self.first[pixel][sample];
                self.first[pixel][sample] = self.layers.len() as u32;
                self.layers.push(Layer { primitive: index, depth, alpha, next });
            }
        });
    }

    /// Visits what a sample sees, from front to back, as (triangle, share); returns the share that comes through.
    pub fn for_each_share(&mut self, pixel: usize, sample: usize, mut visit: impl FnMut(u32, f32)) -> f32 {
        self.sorted.clear();
        let mut at = self.first[pixel][sample];
        while at != END {
            let layer = self.layers[at as usize];
            self.sorted.push(layer);
            at = layer.next;
        }
        self.sorted.sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth).then(a.primitive.cmp(&b.primitive)));
        let mut through = 1.0f32;
        for layer in &self.sorted {
            let rest = through * (1.0 - layer.alpha);
            if rest < CLOSED {
                visit(layer.primitive, through);
                return 0.0;
            }
            visit(layer.primitive, through - rest);
            through = rest;
        }
        through
    }
}

/// Texture coordinates over a triangle, right in perspective: scale, and scale times u and v, are linear on the screen.
struct TexturePlace {
    corner: [f32; 2],
    at_corner: [f32; 3],
    gradients: [[f32; 2]; 3],
}

impl TexturePlace {
    fn new(triangle: &Triangle, vertices: [&ProjectedVertex; 3], corners: &[f32; 6]) -> Self {
        let values: [[f32; 3]; 3] = std::array::from_fn(|i| {
            let scale = vertices[i].scale;
            [scale, scale * corners[2 * i], scale * corners[2 * i + 1]]
        });
        let gradients = std::array::from_fn(|k| triangle.gradient_of(values.map(|value| value[k])));
        Self { corner: triangle.first_corner(), at_corner: values[0], gradients }
    }

    fn at(&self, x: f32, y: f32) -> [f32; 2] {
        let (dx, dy) = (x - self.corner[0], y - self.corner[1]);
        let value = |k: usize| self.at_corner[k] + self.gradients[k][0] * dx + self.gradients[k][1] * dy;
        let scale = value(0);
        [value(1) / scale, value(2) / scale]
    }
}
