//! Gusts: a sum of three waves that travel with the wind.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::Wind;

/// Frequencies that share no period within hours, and their parts of the whole.
const WAVES: [(f64, f64); 3] = [(1.0, 0.5), (1.618_034, 0.3), (2.645_751, 0.2)];

impl Wind {
    /// Velocity of the air at a place and time. Gusts pass along the wind at its own speed.
    pub(crate) fn at(&self, place: DVec3, secs: f64) -> DVec3 {
        let speed = self.velocity.length();
        if self.gusts == 0.0 || speed == 0.0 {
            return self.velocity;
        }
        let since = (secs - place.dot(self.velocity) / (speed * speed)) / self.gust_secs;
        let gust: f64 = WAVES
            .iter()
            .zip(0..)
            .map(|((rate, part), wave)| part * (TAU * (rate * since + self.phase(wave))).sin())
            .sum();
        self.velocity * (1.0 + self.gusts * gust)
    }

    /// In [0, 1), by the splitmix64 of seed and wave.
    fn phase(&self, wave: u64) -> f64 {
        let mut x = self.seed.wrapping_add((wave + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIND: Wind = Wind { velocity: DVec3::new(3.0, 0.0, 4.0), gusts: 0.5, gust_secs: 2.0, seed: 7 };

    #[test]
    fn gusts_stay_within_their_strength_and_average_out() {
        let speeds: Vec<f64> = (0..20_000).map(|i| WIND.at(DVec3::ZERO, f64::from(i) * 0.01).length()).collect();
        assert!(speeds.iter().all(|v| (2.5..=7.5).contains(v)));
        assert!((speeds.iter().sum::<f64>() / 20_000.0 - 5.0).abs() < 0.02);
    }

    #[test]
    fn a_gust_arrives_downwind_later() {
        let downwind = WIND.velocity.normalize() * 10.0;
        assert!((WIND.at(downwind, 3.0) - WIND.at(DVec3::ZERO, 1.0)).length() < 1e-12);
    }

    #[test]
    fn without_gusts_the_wind_is_steady() {
        let steady = Wind { gusts: 0.0, ..WIND };
        assert_eq!(steady.at(DVec3::ONE, 3.3), WIND.velocity);
    }
}
