//! One even Gabor kernel, as numbers on a grid.

use std::f64::consts::PI;

use crate::error::ImageError;

/// Largest size of a kernel in pixels.
const LARGEST_PX: f64 = 64.0;
/// Standard deviations after which a kernel is cut off.
const CUT: f64 = 2.5;

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

impl GaborParams {
    /// Refuses sizes that are not positive and finite, or an odd number of orientations.
    pub fn check(&self) -> Result<(), ImageError> {
        let Self { sigma_u, sigma_v, wavelength, orientations } = *self;
        if ![sigma_u, sigma_v, wavelength].iter().all(|size| size.is_finite() && *size > 0.0 && *size <= LARGEST_PX) {
            return Err(ImageError::KernelSize { sigma_u, sigma_v, wavelength });
        }
        if orientations % 2 != 0 || !(4..=128).contains(&orientations) {
            return Err(ImageError::Orientations { orientations });
        }
        Ok(())
    }

    /// Pixels from the middle of a kernel to its border.
    pub fn radius(&self) -> usize {
        (CUT * self.sigma_u.max(self.sigma_v)).ceil() as usize
    }
}

/// An even Gabor kernel of zero mean and unit L2 norm on a disc of pixels.
pub struct Kernel {
    radius: isize,
    values: Vec<f64>,
}

impl Kernel {
    /// The kernel of angle `theta` (the direction of its oscillation); the strand it finds runs across that.
    pub fn new(params: GaborParams, theta: f64) -> Self {
        let radius = params.radius() as isize;
        let (sin, cos) = theta.sin_cos();
        let offsets = (-radius..=radius).flat_map(|v| (-radius..=radius).map(move |u| (u, v)));
        let (window, mut values): (Vec<f64>, Vec<f64>) = offsets
            .map(|(u, v)| {
                let along = u as f64 * cos + v as f64 * sin;
                let across = v as f64 * cos - u as f64 * sin;
                let bell = (-0.5 * ((along / params.sigma_u).powi(2) + (across / params.sigma_v).powi(2))).exp();
                let bell = if u * u + v * v <= radius * radius { bell } else { 0.0 };
                (bell, bell * (2.0 * PI * along / params.wavelength).cos())
            })
            .unzip();
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
