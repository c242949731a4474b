//! One level of the picture pyramid of a completion: its pixels, and which patches are sought and offered.

use crate::patch_search::Match;
use crate::patchmatch::Picture;
use crate::seeded::Random;

/// Marks pixels that are not the middle of a sought patch.
const NO_TARGET: u32 = u32::MAX;
/// Rounds in which the first, smooth filling settles.
const SMOOTHING_ROUNDS: usize = 60;

/// One level. The picture is padded by a patch's radius of repeated border, so that all patches are whole.
pub struct Level {
    /// Interleaved values of the padded picture.
    pub values: Vec<f32>,
    /// Pixels a row, padding included.
    pub width: usize,
    /// Rows, padding included.
    pub height: usize,
    /// Numbers a pixel.
    pub channels: usize,
    /// Of these, the last that belong to the guide.
    pub guides: usize,
    /// Half the side of a patch.
    pub radius: usize,
    /// Pixels to be filled, padding included.
    pub hole_pixels: Vec<usize>,
    /// Middles of the patches that touch the hole.
    pub targets: Vec<usize>,
    /// Number of the target at each pixel, or `NO_TARGET`.
    target_of: Vec<u32>,
    /// Middles of the patches that may be copied.
    pub sources: Vec<usize>,
    hole: Vec<bool>,
    source: Vec<bool>,
    offered: Vec<bool>,
}

impl Level {
    /// The level of the picture itself.
    pub fn finest(picture: &Picture, hole: &[bool], source: &[bool], radius: usize) -> Self {
        let (width, height) = (picture.width + 2 * radius, picture.height + 2 * radius);
        let inner = |index: usize, inner: usize| index.saturating_sub(radius).min(inner - 1);
        let from: Vec<usize> = (0..width * height)
            .map(|pixel| inner(pixel / width, picture.height) * picture.width + inner(pixel % width, picture.width))
            .collect();
        let padding = |pixel: usize| {
            let (x, y) = (pixel % width, pixel / width);
            x < radius || y < radius || x >= width - radius || y >= height - radius
        };
        let values = from
            .iter()
            .flat_map(|&p| &picture.values[p * picture.channels..(p + 1) * picture.channels])
            .map(|value| if value.is_finite() { *value } else { 0.0 })
            .collect();
        let hole_here = from.iter().map(|&p| hole[p]).collect();
        let source_here = from.iter().enumerate().map(|(pixel, &p)| source[p] && !hole[p] && !padding(pixel)).collect();
        Self::new(values, [width, height, picture.channels, picture.guides, radius], hole_here, source_here)
    }

    fn new(
        values: Vec<f32>,
        [width, height, channels, guides, radius]: [usize; 5],
        hole: Vec<bool>,
        source: Vec<bool>,
    ) -> Self {
        let grid = Windows { width, height, radius };
        let (touching, spoiled) = (grid.any(&hole), grid.any(&source.iter().map(|s| !s).collect::<Vec<_>>()));
        let targets: Vec<usize> = (0..hole.len()).filter(|&pixel| touching[pixel] && grid.is_middle(pixel)).collect();
        let offered: Vec<bool> = (0..hole.len()).map(|pixel| !spoiled[pixel] && grid.is_middle(pixel)).collect();
        let mut target_of = vec![NO_TARGET; hole.len()];
        targets.iter().enumerate().for_each(|(number, &pixel)| target_of[pixel] = number as u32);
        let listed = |flags: &[bool]| (0..flags.len()).filter(|&pixel| flags[pixel]).collect();
        Self {
            hole_pixels: listed(&hole),
            sources: listed(&offered),
            values,
            width,
            height,
            channels,
            guides,
            radius,
            targets,
            target_of,
            hole,
            source,
            offered,
        }
    }

    /// The level of half the size, or none where the hole or the source would vanish.
    pub fn halved(&self) -> Option<Self> {
        let radius = self.radius;
        let (inner_width, inner_height) = (self.width - 2 * radius, self.height - 2 * radius);
        if inner_width < 4 * radius + 2 || inner_height < 4 * radius + 2 {
            return None;
        }
        let (half_width, half_height) = (inner_width.div_ceil(2), inner_height.div_ceil(2));
        let mut values = Vec::with_capacity(half_width * half_height * self.channels);
        let (mut hole, mut source) = (Vec::new(), Vec::new());
        for (y, x) in (0..half_height).flat_map(|y| (0..half_width).map(move |x| (y, x))) {
            let covered = self.covered(x, y, inner_width, inner_height);
            let known: Vec<usize> = covered.iter().copied().filter(|&pixel| !self.hole[pixel]).collect();
            hole.push(2 * known.len() < covered.len());
            source.push(covered.iter().all(|&pixel| self.source[pixel]));
            for channel in 0..self.channels {
                let guide = channel >= self.channels - self.guides;
                let from = if guide || known.is_empty() { &covered } else { &known };
                let sum: f32 = from.iter().map(|pixel| self.values[pixel * self.channels + channel]).sum();
                values.push(sum / from.len() as f32);
            }
        }
        let (channels, guides) = (self.channels, self.guides);
        let picture = Picture { values, width: half_width, height: half_height, channels, guides };
        let level = Self::finest(&picture, &hole, &source, radius);
        (!level.hole_pixels.is_empty() && !level.sources.is_empty()).then_some(level)
    }

    /// The up to four pixels that the pixel (x, y) of the halved picture covers.
    fn covered(&self, x: usize, y: usize, inner_width: usize, inner_height: usize) -> Vec<usize> {
        let (columns, rows) = (2 * x..(2 * x + 2).min(inner_width), 2 * y..(2 * y + 2).min(inner_height));
        rows.flat_map(|row| columns.clone().map(move |column| (row, column)))
            .map(|(row, column)| (row + self.radius) * self.width + column + self.radius)
            .collect()
    }

    /// Column and row of a pixel.
    pub fn place(&self, pixel: usize) -> (isize, isize) {
        ((pixel % self.width) as isize, (pixel / self.width) as isize)
    }

    /// The pixel in a column and row that exist.
    pub fn index(&self, x: isize, y: isize) -> usize {
        y as usize * self.width + x as usize
    }

    /// Number of the target patch around (x, y), if there is one.
    pub fn target_at(&self, x: isize, y: isize) -> Option<usize> {
        let pixel = self.inside(x, y)?;
        (self.target_of[pixel] != NO_TARGET).then(|| self.target_of[pixel] as usize)
    }

    /// Middle of the source patch around (x, y), if there is one.
    pub fn source_at(&self, x: isize, y: isize) -> Option<usize> {
        self.inside(x, y).filter(|&pixel| self.offered[pixel])
    }

    fn inside(&self, x: isize, y: isize) -> Option<usize> {
        let inside = x >= 0 && y >= 0 && x < self.width as isize && y < self.height as isize;
        inside.then(|| self.index(x, y))
    }

    /// A random source for every target.
    pub fn random_matches(&self, seed: u64) -> Vec<Match> {
        let random = |target: &usize| self.sources[Random::new(seed, *target as u64).below(self.sources.len())];
        self.targets.iter().map(|target| Match { source: random(target), distance: f32::INFINITY }).collect()
    }

    /// The coarser level's matches, at twice their place; random ones where that is no source here.
    pub fn upsampled_matches(&self, coarser: &Self, matches: &[Match], seed: u64) -> Vec<Match> {
        let radius = self.radius as isize;
        let random = self.random_matches(seed);
        let pairs = self.targets.iter().zip(random);
        pairs
            .map(|(&target, random)| {
                let (x, y) = self.place(target);
                let (below_x, below_y) = ((x - radius) / 2, (y - radius) / 2);
                let found = coarser.target_at(below_x + radius, below_y + radius).and_then(|number| {
                    let (source_x, source_y) = coarser.place(matches[number].source);
                    let (odd_x, odd_y) = (x - radius - 2 * below_x, y - radius - 2 * below_y);
                    let x = 2 * (source_x - radius) + odd_x + radius;
                    self.source_at(x, 2 * (source_y - radius) + odd_y + radius)
                });
                found.map_or(random, |source| Match { source, distance: random.distance })
            })
            .map(|found| Match { distance: 1.0, ..found })
            .collect()
    }

    /// A smooth first filling: the mean of the known pixels, then of the neighbours, over and over.
    pub fn fill_smoothly(&mut self) {
        let image_channels = self.channels - self.guides;
        for channel in 0..image_channels {
            let known = (0..self.hole.len()).filter(|&pixel| !self.hole[pixel]);
            let (sum, count) = known.fold((0.0f64, 0usize), |(sum, count), pixel| {
                (sum + f64::from(self.values[pixel * self.channels + channel]), count + 1)
            });
            let mean = (sum / count.max(1) as f64) as f32;
            self.hole_pixels.iter().for_each(|pixel| self.values[pixel * self.channels + channel] = mean);
        }
        for _ in 0..SMOOTHING_ROUNDS {
            for &pixel in &self.hole_pixels {
                let (x, y) = (pixel % self.width, pixel / self.width);
                let around = [
                    pixel - usize::from(x > 0),
                    pixel + usize::from(x + 1 < self.width),
                    pixel - if y > 0 { self.width } else { 0 },
                    pixel + if y + 1 < self.height { self.width } else { 0 },
                ];
                for channel in 0..image_channels {
                    let sum: f32 = around.iter().map(|near| self.values[near * self.channels + channel]).sum();
                    self.values[pixel * self.channels + channel] = 0.25 * sum;
                }
            }
        }
    }

    /// Writes the filled pixels into the picture of this level's size.
    pub fn copy_hole_into(&self, picture: &mut Picture, hole: &[bool]) {
        let image_channels = self.channels - self.guides;
        for pixel in (0..hole.len()).filter(|&pixel| hole[pixel]) {
            let (x, y) = (pixel % picture.width + self.radius, pixel / picture.width + self.radius);
            let from = (y * self.width + x) * self.channels;
            let to = pixel * self.channels;
            picture.values[to..to + image_channels].copy_from_slice(&self.values[from..from + image_channels]);
        }
    }
}

/// Square windows of a grid.
struct Windows {
    width: usize,
    height: usize,
    radius: usize,
}

impl Windows {
    /// Whether a whole patch fits around the pixel.
    fn is_middle(&self, pixel: usize) -> bool {
        let (x, y, radius) = (pixel % self.width, pixel / self.width, self.radius);
        x >= radius && y >= radius && x + radius < self.width && y + radius < self.height
    }

    /// Whether any pixel of the window around each pixel is marked; rows first, then columns.
    fn any(&self, marked: &[bool]) -> Vec<bool> {
        let along = |marked: &[bool], step: usize, length: usize, place: fn(usize, usize) -> usize| -> Vec<bool> {
            (0..marked.len())
                .map(|pixel| {
                    let at = place(pixel, self.width);
                    let low = at.saturating_sub(self.radius);
                    (low..=(at + self.radius).min(length - 1)).any(|near| marked[pixel + near * step - at * step])
                })
                .collect()
        };
        let rows = along(marked, 1, self.width, |pixel, width| pixel % width);
        along(&rows, self.width, self.height, |pixel, width| pixel / width)
    }
}
