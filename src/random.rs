//! A seeded generator of numbers: the same on every machine, so no library function but √.

use crate::number::power_of_two;

/// `SplitMix64` (Steele, Lea, Flood, 2014): 2⁶⁴ steps, any seed.
#[derive(Debug, Clone)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence of this seed.
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 up to, not including, `end`.
    pub const fn below(&mut self, end: u64) -> u64 {
        ((self.bits() as u128 * end as u128) >> 64) as u64
    }

    /// A whole number from `least` to `greatest`, both included.
    pub const fn integer(&mut self, least: i32, greatest: i32) -> i32 {
        let count = (greatest as i64 - least as i64 + 1) as u64;
        (least as i64 + self.below(count) as i64) as i32
    }

    /// A number from `least` up to `end`, uniform in steps of 2⁻⁵³ of the way.
    pub fn uniform(&mut self, least: f64, end: f64) -> f64 {
        let part = (self.bits() >> 11) as f64 * (f64::EPSILON / 2.0);
        least + part * (end - least)
    }

    /// True once in `n` times.
    pub const fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    /// A point of the cube from −1 to 1 that lies in the unit ball, not too near its centre,
    /// drawn out to length 1 up to rounding.
    pub fn unit_vector(&mut self) -> [f64; 3] {
        loop {
            let v = [0; 3].map(|_| self.uniform(-1.0, 1.0));
            let length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
            if (0.01..1.0).contains(&length2) {
                return v.map(|x| x / length2.sqrt());
            }
        }
    }

    /// ± a binary32 of random fraction whose exponent is uniform from `least` to `greatest`.
    pub fn log_uniform(&mut self, least: i32, greatest: i32) -> f64 {
        let fraction = self.uniform(1.0, 2.0);
        let magnitude = f64::from(fraction as f32) * power_of_two(self.integer(least, greatest));
        if self.one_in(2) {
            -magnitude
        } else {
            magnitude
        }
    }

    /// A finite binary32 of any bits.
    pub fn any_single(&mut self) -> f32 {
        loop {
            let x = f32::from_bits(self.bits() as u32);
            if x.is_finite() {
                return x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gives_the_published_sequence() {
        // The reference outputs for seed 1234567.
        let mut random = Random::new(1_234_567);
        let first = [random.bits(), random.bits(), random.bits()];
        assert_eq!(
            first,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }

    #[test]
    fn stays_within_its_bounds() {
        let mut random = Random::new(7);
        for _ in 0..1000 {
            assert!((-3..=4).contains(&random.integer(-3, 4)));
            assert!((0.5..2.0).contains(&random.uniform(0.5, 2.0)));
            let x = random.log_uniform(-149, 127);
            assert!(f64::from(x as f32).abs() < power_of_two(128));
        }
    }
}
