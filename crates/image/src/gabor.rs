//! A bank of even Gabor kernels, evaluated at masked pixels.
//!
//! The kernel of angle θ oscillates along `ũ = u cos θ + v sin θ`, so the strand that it answers to runs along θ + π/2
//! (Chai et al. 2012, eq. 2; Jain and Farrokhnia 1991). Each kernel has zero mean and unit L2 norm: flat regions do not
//! answer, however bright.
//!
//! How it is fast. A kernel is even in (u, v), and the kernels of θ and π − θ are mirror images. So the four pixels
//! (±u, ±v) are first folded into one even and one odd sum, shared by all orientations; the responses are then two small
//! matrix products a pixel. That is a quarter of the multiplications of plain correlation.

use rayon::prelude::*;
use std::f64::consts::PI;

use crate::error::ImageError;
use crate::raster_view::Plane;

/// Accumulators kept in registers while the taps run by.
const LANES: usize = 16;

/// Sizes of the kernels in pixels and the number of orientations over [0, π).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaborParams {
    /// Standard deviation along the oscillation, pixels.
    pub sigma_u: f64,
    /// Standard deviation along the strand, pixels.
    pub sigma_v: f64,
    /// Wavelength of the oscillation, pixels.
    pub wavelength: f64,
    /// Number of orientations; even, from 4 to 128.
    pub orientations: usize,
}

/// One folded tap: the offset (u, v) with u, v >= 0 stands for up to four pixels.
struct Tap {
    u: usize,
    v: usize,
}

/// Kernels folded by symmetry: coefficients in rows of `LANES`-padded orientations.
pub struct GaborBank {
    orientations: usize,
    radius: usize,
    taps: Vec<Tap>,
    even: Vec<f32>,
    odd: Vec<f32>,
    stride: usize,
}

impl GaborBank {
    /// The bank for the given sizes. Refuses sizes that are not positive and finite, or an odd number of orientations.
    pub fn new(params: GaborParams) -> Result<Self, ImageError> {
        let GaborParams { sigma_u, sigma_v, wavelength, orientations } = params;
        if ![sigma_u, sigma_v, wavelength].iter().all(|size| size.is_finite() && *size > 0.0 && *size <= 64.0) {
            return Err(ImageError::KernelSize { sigma_u, sigma_v, wavelength });
        }
        if orientations % 2 != 0 || !(4..=128).contains(&orientations) {
            return Err(ImageError::Orientations { orientations });
        }
        let radius = (3.0 * sigma_u.max(sigma_v)).ceil() as usize;
        let half = orientations / 2;
        let stride = (half + 1).div_ceil(LANES) * LANES;
        let taps: Vec<Tap> = (0..=radius).flat_map(|v| (0..=radius).map(move |u| Tap { u, v })).collect();
        let mut even = vec![0.0; taps.len() * stride];
        let mut odd = vec![0.0; taps.len() * stride];
        for k in 0..=half {
            let kernel = Kernel::new(params, PI * k as f64 / orientations as f64, radius);
            for (tap, Tap { u, v }) in taps.iter().enumerate() {
                let (same, mirrored) = (kernel.at(*u as isize, *v as isize), kernel.at(*u as isize, -(*v as isize)));
                even[tap * stride + k] = (0.5 * (same + mirrored)) as f32;
                odd[tap * stride + k] = (0.5 * (same - mirrored)) as f32;
            }
        }
        Ok(Self { orientations, radius, taps, even, odd, stride })
    }

    /// Number of orientations over [0, π).
    pub fn orientations(&self) -> usize {
        self.orientations
    }

    /// Responses of every pixel: `orientations` planes, one after the other.
    pub fn all_responses(&self, image: Plane<'_>) -> Result<Vec<f32>, ImageError> {
        image.check(image.values.len())?;
        let (width, pixels) = (image.width, image.values.len());
        let mut by_pixel = vec![0.0; pixels * self.orientations];
        by_pixel.par_chunks_mut(width * self.orientations).enumerate().for_each(|(y, row)| {
            let mut scratch = self.scratch();
            for (x, out) in row.chunks_mut(self.orientations).enumerate() {
                self.responses(image, x, y, &mut scratch, out);
            }
        });
        Ok((0..self.orientations).flat_map(|k| by_pixel.iter().skip(k).step_by(self.orientations).copied()).collect())
    }

    /// Responses F(θ_k) of the pixel (x, y), one an orientation. Pixels outside the image repeat its border.
    pub fn responses(&self, image: Plane<'_>, x: usize, y: usize, scratch: &mut Scratch, out: &mut [f32]) {
        self.fold(image, x, y, scratch);
        let half = self.orientations / 2;
        for chunk in (0..self.stride).step_by(LANES) {
            let even = self.product(&self.even, &scratch.even, chunk);
            let odd = self.product(&self.odd, &scratch.odd, chunk);
            for lane in 0..LANES.min((half + 1).saturating_sub(chunk)) {
                let k = chunk + lane;
                out[k] = even[lane] + odd[lane];
                if k > 0 && k < half {
                    out[self.orientations - k] = even[lane] - odd[lane];
                }
            }
        }
    }

    fn product(&self, coefficients: &[f32], sums: &[f32], chunk: usize) -> [f32; LANES] {
        let mut total = [0.0f32; LANES];
        for (sum, row) in sums.iter().zip(coefficients.chunks_exact(self.stride)) {
            let row = &row[chunk..chunk + LANES];
            for lane in 0..LANES {
                total[lane] += sum * row[lane];
            }
        }
        total
    }

    /// Sums of the up to four pixels that share a tap: even under mirroring, and odd.
    fn fold(&self, image: Plane<'_>, x: usize, y: usize, scratch: &mut Scratch) {
        let inner =
            x >= self.radius && y >= self.radius && x + self.radius < image.width && y + self.radius < image.height;
        for (tap, Tap { u, v }) in self.taps.iter().enumerate() {
            let (u, v) = (*u, *v);
            let sample = |right: bool, down: bool| {
                if inner {
                    let column = if right { x + u } else { x - u };
                    let row = if down { y + v } else { y - v };
                    image.values[row * image.width + column]
                } else {
                    image.clamped(offset(x, u, right), offset(y, v, down))
                }
            };
            let diagonal = sample(true, true) + if u + v > 0 { sample(false, false) } else { 0.0 };
            let crossing = if u > 0 && v > 0 { sample(true, false) + sample(false, true) } else { 0.0 };
            scratch.even[tap] = diagonal + crossing;
            scratch.odd[tap] = diagonal - crossing;
        }
        // A tap on an axis is its own mirror image: its odd coefficient is zero and its even one complete.
    }

    /// Working memory for `responses`.
    pub fn scratch(&self) -> Scratch {
        Scratch { even: vec![0.0; self.taps.len()], odd: vec![0.0; self.taps.len()] }
    }
}

fn offset(origin: usize, distance: usize, forward: bool) -> isize {
    if forward { (origin + distance) as isize } else { origin as isize - distance as isize }
}

/// Folded sums of one pixel's neighbourhood.
pub struct Scratch {
    even: Vec<f32>,
    odd: Vec<f32>,
}

/// One even Gabor kernel of zero mean and unit norm on a square grid.
pub struct Kernel {
    radius: isize,
    values: Vec<f64>,
}

impl Kernel {
    /// The kernel of angle `theta` (the direction of its oscillation).
    pub fn new(params: GaborParams, theta: f64, radius: usize) -> Self {
        let radius = radius as isize;
        let (sin, cos) = theta.sin_cos();
        let mut values = Vec::with_capacity((2 * radius as usize + 1).pow(2));
        let mut window = Vec::with_capacity(values.capacity());
        for v in -radius..=radius {
            for u in -radius..=radius {
                let along = u as f64 * cos + v as f64 * sin;
                let across = v as f64 * cos - u as f64 * sin;
                let bell = (-0.5 * ((along / params.sigma_u).powi(2) + (across / params.sigma_v).powi(2))).exp();
                window.push(bell);
                values.push(bell * (2.0 * PI * along / params.wavelength).cos());
            }
        }
        // The mean is removed under the bell, so that the kernel still fades out at its border.
        let mean = values.iter().sum::<f64>() / window.iter().sum::<f64>();
        values.iter_mut().zip(&window).for_each(|(value, bell)| *value -= mean * bell);
        let norm = values.iter().map(|value| value * value).sum::<f64>().sqrt();
        values.iter_mut().for_each(|value| *value /= norm);
        Self { radius, values }
    }

    /// Value at the offset (u, v).
    pub fn at(&self, u: isize, v: isize) -> f64 {
        self.values[((v + self.radius) * (2 * self.radius + 1) + u + self.radius) as usize]
    }
}

/// Orientation and raw confidence of every masked pixel.
pub struct Oriented {
    /// Direction of the strand in [0, π), NaN outside the mask.
    pub angle: Vec<f32>,
    /// Eq. 3 before scaling; 0 outside the mask.
    pub weight: Vec<f32>,
}

/// The strand direction with the largest response and its confidence (Chai et al. 2012, eq. 3), at masked pixels.
///
/// With `between_bins`, the best of the bank's angles is refined by the parabola through its two neighbours.
pub fn orient(image: Plane<'_>, mask: &[bool], bank: &GaborBank, between_bins: bool) -> Result<Oriented, ImageError> {
    image.check(mask.len())?;
    let mut angle = vec![f32::NAN; mask.len()];
    let mut weight = vec![0.0; mask.len()];
    angle.par_chunks_mut(image.width).zip(weight.par_chunks_mut(image.width)).enumerate().for_each(
        |(y, (angle, weight))| {
            let mut scratch = bank.scratch();
            let mut responses = vec![0.0; bank.orientations];
            for x in (0..image.width).filter(|x| mask[y * image.width + x]) {
                bank.responses(image, x, y, &mut scratch, &mut responses);
                (angle[x], weight[x]) = best(&responses, between_bins);
            }
        },
    );
    Ok(Oriented { angle, weight })
}

/// Strand direction and confidence from the responses of one pixel.
fn best(responses: &[f32], between_bins: bool) -> (f32, f32) {
    let count = responses.len();
    let peak = (0..count).fold(0, |peak, k| if responses[k] > responses[peak] { k } else { peak });
    let sum: f32 = (0..count)
        .map(|k| {
            let apart = k.abs_diff(peak);
            let angle = std::f32::consts::PI * apart.min(count - apart) as f32 / count as f32;
            angle * (responses[k] - responses[peak]).powi(2)
        })
        .sum();
    let (before, after) = (responses[(peak + count - 1) % count], responses[(peak + 1) % count]);
    let bend = before - 2.0 * responses[peak] + after;
    let shift = if between_bins && bend < -1e-12 { 0.5 * (before - after) / bend } else { 0.0 };
    let normal = std::f32::consts::PI * (peak as f32 + shift) / count as f32;
    (((normal + std::f32::consts::FRAC_PI_2).rem_euclid(std::f32::consts::PI)), sum.sqrt())
}
