//! Random places in simplices.

/// Random numbers, the same every time and on every thread: SplitMix64 (Steele, Lea,
/// Flood 2014).
pub(crate) struct Random(u64);

impl Random {
    /// The numbers that belong to some others.
    pub fn new(of: [u64; 3]) -> Self {
        let mut random = Self(0);
        for number in of {
            random.0 ^= number;
            random.0 = random.bits();
        }
        random
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// A number above 0 and up to 1.
    pub fn unit(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1_u64 << 53) as f64
    }

    /// A point of a simplex, all places alike, as barycentric coordinates.
    pub fn in_simplex<const CORNERS: usize>(&mut self) -> [f64; CORNERS] {
        // waiting times, as parts of their sum, are uniform in a simplex
        let weights = [(); CORNERS].map(|()| -self.unit().ln());
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_points_fill_their_simplex() {
        let mut random = Random::new([1, 2, 3]);
        let mut mean = [0.0; 4];
        let mut second = 0.0;
        for _ in 0..4000 {
            let point: [f64; 4] = random.in_simplex();
            assert!((point.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(point.iter().all(|&weight| weight >= 0.0));
            mean.iter_mut().zip(point).for_each(|(mean, weight)| *mean += weight / 4000.0);
            second += point[0] * point[0] / 4000.0;
        }
        assert!(mean.iter().all(|&mean| (mean - 0.25).abs() < 0.02));
        // of a uniform distribution: 2! 3! / 5!
        assert!((second - 0.1).abs() < 0.01);
    }
}
