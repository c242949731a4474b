//! Random numbers that are a function of a seed and a place, for loops on any number of threads.

/// A sequence of random numbers (splitmix64; Steele, Lea and Flood 2014).
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence of a seed at a place.
    pub fn new(seed: u64, place: u64) -> Self {
        let mut random = Self { state: seed ^ place.wrapping_mul(0xD1B5_4A32_D192_ED03) };
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.state ^ (self.state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A whole number in [0, count); 0 where `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.next()) * count as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_even_and_in_range() {
        let mut counts = [0; 7];
        for place in 0..7000 {
            counts[Random::new(3, place).below(7)] += 1;
        }
        // 1000 each with a standard deviation of 29: five of them.
        assert!(counts.iter().all(|&count| (855..=1145).contains(&count)), "{counts:?}");
    }

    #[test]
    fn places_and_seeds_differ() {
        let first = |seed, place| Random::new(seed, place).below(1 << 60);
        assert_ne!(first(0, 0), first(0, 1));
        assert_ne!(first(0, 0), first(1, 0));
        assert_eq!(first(5, 9), first(5, 9));
    }
}
