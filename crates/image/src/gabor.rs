//! A bank of even Gabor kernels, evaluated at masked pixels.
//!
//! The kernel of angle θ oscillates along `ũ = u cos θ + v sin θ`, so the strand that it answers to runs along θ + π/2
//! (Chai et al. 2012, eq. 2; Jain and Farrokhnia 1991). Each kernel has zero mean and unit L2 norm: flat regions do not
//! answer, however bright.
//!
//! How it is fast. Turning a picture by quarter turns and mirroring it only permutes the kernels, and each kernel is
//! even. The eight pixels that these symmetries map onto each other are summed and differenced once (`fold`), which
//! splits the bank into four independent families; in each, the responses of four related kernels are one product. So a
//! pixel costs an eighth of the multiplications of plain correlation, with the same result up to rounding. The products run over
//! blocks of neighbouring pixels, whose sums stay in registers; where the processor has wide registers (AVX2) they are
//! used, with the same operations and so the same bits. FFTs, the usual alternative, cost the same for all kernel sizes
//! but cannot profit from the mask: over a full rectangle they draw level at a radius of some 18 pixels.

use rayon::prelude::*;
use std::f64::consts::PI;

use crate::error::ImageError;
use crate::gabor_kernel::{GaborParams, Kernel};
use crate::raster_view::Plane;

/// Neighbouring pixels of a row that are filtered together.
pub const BLOCK: usize = 16;
/// Kernels of one family whose sums are kept in registers together.
const GROUP: usize = 3;
/// Taps that are folded together: their sums fit the first-level cache.
const TAPS: usize = 32;
/// Families of the symmetry group: kernels even or odd under mirroring, and under transposition.
const FAMILIES: usize = 4;

/// An offset (u, v), 0 <= v <= u, that stands for the up to eight pixels (±u, ±v), (±v, ±u).
struct Tap {
    u: isize,
    v: isize,
}

/// Kernels folded by their symmetries.
pub struct GaborBank {
    orientations: usize,
    radius: usize,
    taps: Vec<Tap>,
    /// First members of the sets of related kernels {k, -k, n/2 - k, n/2 + k}, padded by zeros to a multiple of `GROUP`.
    leaders: Vec<usize>,
    /// By family, group of leaders, tap.
    coefficients: Vec<Vec<[f32; GROUP]>>,
    processor: pulp::Arch,
}

/// Responses of a block of pixels: `[orientation][pixel]`.
pub type BlockResponses = Vec<[f32; BLOCK]>;

/// Working memory for `GaborBank::responses`.
pub struct Scratch {
    window: Vec<f32>,
    folded: [[[f32; BLOCK]; TAPS]; FAMILIES],
    /// By family and group of leaders.
    sums: Vec<[[f32; BLOCK]; GROUP]>,
}

impl GaborBank {
    /// The bank for the given sizes. Refuses sizes that are not positive and finite, or an odd number of orientations.
    pub fn new(params: GaborParams) -> Result<Self, ImageError> {
        params.check()?;
        let orientations = params.orientations;
        let radius = params.radius();
        let reach = (radius * radius) as isize;
        let taps: Vec<Tap> = (0..=radius as isize)
            .flat_map(|u| (0..=u).map(move |v| Tap { u, v }))
            .filter(|tap| tap.u * tap.u + tap.v * tap.v <= reach)
            .collect();
        let leaders: Vec<usize> = (0..=orientations / 4).collect();
        let kernels: Vec<Kernel> =
            leaders.iter().map(|&k| Kernel::new(params, PI * k as f64 / orientations as f64)).collect();
        let coefficients = (0..FAMILIES)
            .flat_map(|family| kernels.chunks(GROUP).map(move |group| (family, group)))
            .map(|(family, group)| taps.iter().map(|tap| coefficient_group(family, group, tap)).collect())
            .collect();
        Ok(Self { orientations, radius, taps, leaders, coefficients, processor: pulp::Arch::new() })
    }

    /// Number of orientations over [0, π).
    pub fn orientations(&self) -> usize {
        self.orientations
    }

    /// Multiplications per pixel.
    pub fn products_per_pixel(&self) -> usize {
        self.taps.len() * FAMILIES * self.leaders.len().div_ceil(GROUP) * GROUP
    }

    /// Working memory for `responses`.
    pub fn scratch(&self) -> Scratch {
        let side = 2 * self.radius + 1;
        Scratch {
            window: vec![0.0; side * (side + BLOCK - 1)],
            folded: [[[0.0; BLOCK]; TAPS]; FAMILIES],
            sums: vec![[[0.0; BLOCK]; GROUP]; self.coefficients.len()],
        }
    }

    /// Responses F(θ_k) of the pixels (x, y) to (x + BLOCK - 1, y). Pixels outside the image repeat its border.
    pub fn responses(&self, image: Plane<'_>, x: usize, y: usize, scratch: &mut Scratch, out: &mut BlockResponses) {
        self.copy_window(image, x, y, &mut scratch.window);
        self.processor.dispatch(|| self.window_responses(scratch, out));
    }

    #[inline(always)]
    fn window_responses(&self, scratch: &mut Scratch, out: &mut BlockResponses) {
        let Scratch { window, folded, sums } = scratch;
        let groups = self.leaders.len().div_ceil(GROUP);
        sums.fill([[0.0; BLOCK]; GROUP]);
        for (chunk, taps) in self.taps.chunks(TAPS).enumerate() {
            self.fold(window, taps, folded);
            for (slot, sum) in sums.iter_mut().enumerate() {
                let coefficients = &self.coefficients[slot][chunk * TAPS..chunk * TAPS + taps.len()];
                *sum = product(coefficients, &folded[slot / groups], *sum);
            }
        }
        out.resize(self.orientations, [0.0; BLOCK]);
        for (rank, &leader) in self.leaders.iter().enumerate() {
            let (group, place) = (rank / GROUP, rank % GROUP);
            self.unfold(leader, std::array::from_fn(|family| sums[family * groups + group][place]), out);
        }
    }

    /// The responses of the up to four kernels related to `leader`.
    #[inline(always)]
    fn unfold(&self, leader: usize, sums: [[f32; BLOCK]; FAMILIES], out: &mut BlockResponses) {
        let (n, half) = (self.orientations, self.orientations / 2);
        let members = [leader, (n - leader) % n, (n + half - leader) % n, (half + leader) % n];
        for (mirrored_transposed, member) in members.into_iter().enumerate() {
            let [mirror, transpose] = match mirrored_transposed {
                0 => [1.0, 1.0],
                1 => [-1.0, 1.0],
                2 => [1.0, -1.0],
                _ => [-1.0, -1.0],
            };
            out[member] = std::array::from_fn(|i| {
                (sums[0][i] + mirror * sums[1][i]) + transpose * (sums[2][i] + mirror * sums[3][i])
            });
        }
    }

    /// Sums and differences of the eight pixels that share a tap, for every family and pixel of the block.
    #[inline(always)]
    fn fold(&self, window: &[f32], taps: &[Tap], folded: &mut [[[f32; BLOCK]; TAPS]; FAMILIES]) {
        let stride = 2 * self.radius + BLOCK;
        let middle = (self.radius * stride + self.radius) as isize;
        let row = |u: isize, v: isize| -> &[f32; BLOCK] {
            let start = (middle + v * stride as isize + u) as usize;
            window[start..start + BLOCK].first_chunk().expect("a block is inside the window")
        };
        let [even, mirrored, transposed, both] = folded;
        for (tap, &Tap { u, v }) in taps.iter().enumerate() {
            let pair = |u: isize, v: isize| -> [f32; BLOCK] {
                let (a, b) = (row(u, v), row(-u, -v));
                std::array::from_fn(|i| a[i] + b[i])
            };
            let (same, flipped, swapped, turned) = (pair(u, v), pair(-u, v), pair(v, u), pair(-v, u));
            for i in 0..BLOCK {
                let (p, q) = (same[i] + flipped[i], same[i] - flipped[i]);
                // Transposing a flipped pixel is turning it: (-u, v) becomes (v, -u), which is (-v, u) by evenness.
                let (r, s) = (swapped[i] + turned[i], swapped[i] - turned[i]);
                even[tap][i] = p + r;
                transposed[tap][i] = p - r;
                mirrored[tap][i] = q + s;
                both[tap][i] = q - s;
            }
        }
    }

    /// The pixels under the kernels of a block, with the border of the image repeated.
    fn copy_window(&self, image: Plane<'_>, x: usize, y: usize, window: &mut [f32]) {
        let (radius, width) = (self.radius as isize, 2 * self.radius + BLOCK);
        let left = x as isize - radius;
        let inside = left >= 0 && left as usize + width <= image.width;
        for (row, target) in window.chunks_exact_mut(width).enumerate() {
            let source_row = (y as isize + row as isize - radius).clamp(0, image.height as isize - 1);
            if inside {
                let start = source_row as usize * image.width + left as usize;
                target.copy_from_slice(&image.values[start..start + width]);
            } else {
                for (column, value) in target.iter_mut().enumerate() {
                    *value = image.clamped(left + column as isize, source_row);
                }
            }
        }
    }

    /// Responses of every pixel: `orientations` planes, one after the other. For tests and comparisons.
    pub fn all_responses(&self, image: Plane<'_>) -> Result<Vec<f32>, ImageError> {
        image.check(image.values.len())?;
        let (width, pixels) = (image.width, image.values.len());
        let rows: Vec<Vec<f32>> = (0..image.height)
            .into_par_iter()
            .map(|y| {
                let (mut scratch, mut block) = (self.scratch(), BlockResponses::new());
                let mut row = vec![0.0; width * self.orientations];
                for x in (0..width).step_by(BLOCK) {
                    self.responses(image, x, y, &mut scratch, &mut block);
                    for (k, values) in block.iter().enumerate() {
                        let count = BLOCK.min(width - x);
                        row[k * width + x..k * width + x + count].copy_from_slice(&values[..count]);
                    }
                }
                row
            })
            .collect();
        let mut planes = Vec::with_capacity(pixels * self.orientations);
        for k in 0..self.orientations {
            rows.iter().for_each(|row| planes.extend_from_slice(&row[k * width..(k + 1) * width]));
        }
        Ok(planes)
    }
}

/// Coefficients of one family at one tap: characters of the symmetry group summed over the four images of the tap.
fn coefficient_group(family: usize, kernels: &[Kernel], &Tap { u, v }: &Tap) -> [f32; GROUP] {
    let (mirror, transpose) = (if family & 1 == 0 { 1.0 } else { -1.0 }, if family & 2 == 0 { 1.0 } else { -1.0 });
    // `fold` counts every pixel 8 / (number of distinct images) times; a quarter undoes the four families.
    let share = distinct_images(u, v) as f64 / 8.0 / 4.0;
    std::array::from_fn(|slot| {
        kernels.get(slot).map_or(0.0, |kernel| {
            let plain = kernel.at(u, v) + mirror * kernel.at(-u, v);
            let swapped = kernel.at(v, u) + mirror * kernel.at(-v, u);
            (share * (plain + transpose * swapped)) as f32
        })
    })
}

fn distinct_images(u: isize, v: isize) -> usize {
    match (u == 0, v == 0 || u == v) {
        (true, _) => 1,
        (false, true) => 4,
        (false, false) => 8,
    }
}

/// `sums` of `GROUP` kernels for a block of pixels, with those over a few more taps added.
#[inline(always)]
fn product(
    coefficients: &[[f32; GROUP]],
    folded: &[[f32; BLOCK]; TAPS],
    mut sums: [[f32; BLOCK]; GROUP],
) -> [[f32; BLOCK]; GROUP] {
    for (coefficient, values) in coefficients.iter().zip(folded) {
        for slot in 0..GROUP {
            for i in 0..BLOCK {
                sums[slot][i] += coefficient[slot] * values[i];
            }
        }
    }
    sums
}
