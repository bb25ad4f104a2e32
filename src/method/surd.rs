//! Numbers (x + y√n)/z with dyadic x, y, z, n: the field in which the quadratic has its roots.
//!
//! All that a method computes lies in it, so that an exact value can stand beside every rounded
//! one. The only rounding here is the last: to binary32, to binary64, to decimal digits.

use std::cmp::Ordering;
use std::ops::Neg;

use dashu_int::ops::{BitTest, DivRem, SquareRootRem};
use dashu_int::{IBig, UBig};

use super::Precision;
use super::dyadic::Dyadic;
use crate::number::power_of_two;

/// The number (x + y√n)/z: z > 0, n ≥ 0, and y = 0 unless n is needed.
#[derive(Debug, Clone)]
pub struct Surd {
    x: Dyadic,
    y: Dyadic,
    n: Dyadic,
    z: Dyadic,
}

/// Decimal digits of a number: ±0.d₁d₂d₃…·10^exponent, cut off and not rounded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DecimalDigits {
    /// Whether the number is below zero.
    pub negative: bool,
    /// The digits from the first that is not zero, without zeros at the end; empty for zero.
    pub digits: String,
    /// The power of ten: 1 for numbers from 1 to below 10.
    pub exponent: i64,
    /// Whether the digits are the whole number and nothing was cut off.
    pub exact: bool,
}

impl Surd {
    /// The root (x ± √n)/z that quadratics have, with the sign that `y` gives; none for z = 0 or
    /// n < 0.
    pub fn new(x: Dyadic, y: Dyadic, n: Dyadic, z: Dyadic) -> Option<Self> {
        match z.sign() {
            _ if n.sign() == Ordering::Less => None,
            Ordering::Equal => None,
            Ordering::Less => Some(Self {
                x: -x,
                y: -y,
                n,
                z: -z,
            }),
            Ordering::Greater => Some(Self { x, y, n, z }),
        }
    }

    /// The number that a binary32 or binary64 stands for; none for NaN and ±∞.
    pub fn from_f64(value: f64) -> Option<Self> {
        Dyadic::from_f64(value).map(Self::from)
    }

    /// How the number compares with zero.
    pub fn sign(&self) -> Ordering {
        let (x, y) = (self.x.sign(), self.root_sign());
        if x == y || y == Ordering::Equal {
            x
        } else if x == Ordering::Equal {
            y
        } else {
            // Opposite signs: the greater of x² and y²n decides.
            match self.x.squared().cmp(&self.radicand()) {
                Ordering::Greater => x,
                Ordering::Less => y,
                Ordering::Equal => Ordering::Equal,
            }
        }
    }

    /// Whether this is zero.
    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// The number as a dyadic, where it plainly is one: no root, and a power of two below.
    pub fn as_dyadic(&self) -> Option<Dyadic> {
        let unit = self.z.mantissa() == &IBig::ONE;
        (unit && self.root_sign() == Ordering::Equal)
            .then(|| self.x.clone().shifted(-self.z.exponent()))
    }

    /// The sign of y√n.
    fn root_sign(&self) -> Ordering {
        if self.n.is_zero() {
            Ordering::Equal
        } else {
            self.y.sign()
        }
    }

    /// y²n, so that x ± √(y²n) is the numerator.
    fn radicand(&self) -> Dyadic {
        &self.y.squared() * &self.n
    }

    /// 1/self; none for zero.
    pub fn reciprocal(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        // z/(x + y√n) = z(x − y√n)/(x² − y²n), unless the conjugate is zero: then y√n = x.
        let norm = &self.x.squared() - &self.radicand();
        if norm.is_zero() {
            let twice_x = self.x.clone().shifted(1);
            return Self::new(self.z.clone(), Dyadic::ZERO, Dyadic::ZERO, twice_x);
        }
        let y = -(&self.z * &self.y);
        Self::new(&self.z * &self.x, y, self.n.clone(), norm)
    }

    /// self/other; none if other is zero or has another root than this number.
    pub fn checked_div(&self, other: &Self) -> Option<Self> {
        self.checked_mul(&other.reciprocal()?)
    }

    /// The product; none if the two have different roots.
    pub fn checked_mul(&self, other: &Self) -> Option<Self> {
        let n = self.common_root(other)?;
        let x = &(&self.x * &other.x) + &(&(&self.y * &other.y) * &n);
        let y = &(&self.x * &other.y) + &(&self.y * &other.x);
        Self::new(x, y, n, &self.z * &other.z)
    }

    /// The sum; none if the two have different roots.
    pub fn checked_add(&self, other: &Self) -> Option<Self> {
        let n = self.common_root(other)?;
        let x = &(&self.x * &other.z) + &(&other.x * &self.z);
        let y = &(&self.y * &other.z) + &(&other.y * &self.z);
        Self::new(x, y, n, &self.z * &other.z)
    }

    /// The difference; none if the two have different roots.
    pub fn checked_sub(&self, other: &Self) -> Option<Self> {
        self.checked_add(&-other.clone())
    }

    /// √self of a rational number; none below zero, and none for a number that has a root already.
    pub fn checked_sqrt(&self) -> Option<Self> {
        if self.root_sign() != Ordering::Equal {
            return None;
        }
        // √(x/z) = √(xz)/z.
        let n = &self.x * &self.z;
        Self::new(Dyadic::ZERO, Dyadic::from(1.0), n, self.z.clone())
    }

    fn common_root(&self, other: &Self) -> Option<Dyadic> {
        if self.root_sign() == Ordering::Equal {
            Some(other.n.clone())
        } else if other.root_sign() == Ordering::Equal || self.n == other.n {
            Some(self.n.clone())
        } else {
            None
        }
    }

    /// |self|.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.sign() == Ordering::Less {
            -self
        } else {
            self
        }
    }

    /// self·2^k.
    #[must_use]
    pub fn shifted(mut self, k: i64) -> Self {
        self.z = self.z.shifted(-k);
        self
    }

    /// ⌊|self|·2^k⌋, and whether that is |self|·2^k itself.
    fn magnitude_in_units(&self, k: i64) -> (UBig, bool) {
        let positive = self.clone().abs();
        let w = positive.radicand();
        let (z, z_exponent) = (positive.z.mantissa(), positive.z.exponent());
        // N = (x ± √w)·2^g with g so great that x·2^g, w·4^g and the quotient's divisor are whole.
        let g = (-positive.x.exponent())
            .max(-w.exponent().div_euclid(2))
            .max(k - z_exponent);
        let x = positive.x.in_units_of(-g);
        let (root, rest) = magnitude(&w.in_units_of(-2 * g)).sqrt_rem();
        let rational = rest.is_zero();
        let root = IBig::from(root);
        let floor_n = if positive.root_sign() == Ordering::Less {
            x - root - IBig::from(u8::from(!rational))
        } else {
            x + root
        };
        // ⌊N/m⌋ = ⌊⌊N⌋/m⌋ for a whole m.
        let divisor = magnitude(z) << (g + z_exponent - k) as usize;
        let (quotient, rest) = magnitude(&floor_n).div_rem(&divisor);
        (quotient, rational && rest.is_zero())
    }

    /// ⌊log2|self|⌋ give or take 3; none for zero.
    fn estimate_log2(&self) -> Option<i64> {
        if self.is_zero() {
            return None;
        }
        let w = self.radicand();
        let half_log = w.floor_log2().map(|l| l.div_euclid(2));
        let sum = match (self.x.floor_log2(), half_log) {
            (Some(x), Some(y)) => x.max(y),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => return None,
        };
        let numerator = if half_log.is_some() && self.x.sign() == self.root_sign().reverse() {
            // |x| − √w = (x² − w)/(|x| + √w)
            (&self.x.squared() - &w).floor_log2()? - sum
        } else {
            sum
        };
        Some(numerator - self.z.floor_log2()?)
    }

    /// At least `bits` leading bits of |self|: m and k with m = ⌊|self|·2^k⌋, and whether that is
    /// all of it; none for zero.
    fn leading_bits(&self, bits: i64) -> Option<(UBig, i64, bool)> {
        let k = bits + 4 - self.estimate_log2()?;
        let (m, exact) = self.magnitude_in_units(k);
        Some((m, k, exact))
    }

    /// The number to that many bits, and log2 of how far off that may be; none if it is the number itself.
    pub(super) fn approximation(&self, bits: i64) -> (Dyadic, Option<i64>) {
        let Some((m, k, exact)) = self.leading_bits(bits) else {
            return (Dyadic::ZERO, None);
        };
        let m = IBig::from(m);
        let negative = self.sign() == Ordering::Less;
        let near = Dyadic::new(if negative { -m } else { m }, -k);
        (near, (!exact).then_some(-k))
    }

    /// About how many bits it takes to work with.
    pub(super) fn size(&self) -> i64 {
        let size = |d: &Dyadic| {
            d.floor_log2()
                .map_or(0, |log| (log - d.exponent()) + d.exponent().abs())
        };
        size(&self.x) + size(&self.y) + size(&self.n) + size(&self.z)
    }

    /// ⌊log2|self|⌋; none for zero.
    pub fn floor_log2(&self) -> Option<i64> {
        let (m, k, _) = self.leading_bits(8)?;
        Some(m.bit_len() as i64 - 1 - k)
    }

    /// The number rounded once, to nearest and ties to even; ±∞ past the range, +0 for zero.
    pub fn round(&self, precision: Precision) -> f64 {
        let Some((m, k, exact)) = self.leading_bits(i64::from(precision.bits()) + 2) else {
            return 0.0;
        };
        let rounded = round_magnitude(&m, -k, exact, precision);
        if self.sign() == Ordering::Less {
            -rounded
        } else {
            rounded
        }
    }

    /// The number rounded once to binary32.
    pub fn to_f32(&self) -> f32 {
        self.round(Precision::Binary32) as f32
    }

    /// The number rounded once to binary64.
    pub fn to_f64(&self) -> f64 {
        self.round(Precision::Binary64)
    }

    /// log2 of the spacing at this number: max(⌊log2|t|⌋, least) − (bits − 1), and that of the
    /// least subnormal at zero.
    pub fn ulp_exponent(&self, precision: Precision) -> i64 {
        let least = i64::from(precision.least_exponent());
        match self.floor_log2() {
            Some(log) => (log - i64::from(precision.bits()) + 1).max(least),
            None => least,
        }
    }

    /// |value − self| in units of the spacing of `precision` at this number.
    ///
    /// NaN is NaN away; an infinity is ∞ away, unless this number rounds to it: then it is 0 away.
    pub fn ulps(&self, value: f64, precision: Precision) -> f64 {
        match Self::from_f64(value).and_then(|v| v.checked_sub(self)) {
            Some(error) => error.abs().shifted(-self.ulp_exponent(precision)).to_f64(),
            None if value.is_nan() => f64::NAN,
            None if value == self.round(precision) => 0.0,
            None => f64::INFINITY,
        }
    }

    /// The first `count` decimal digits.
    pub fn digits(&self, count: usize) -> DecimalDigits {
        let mut found = DecimalDigits {
            negative: self.sign() == Ordering::Less,
            digits: String::new(),
            exponent: 0,
            exact: true,
        };
        let Some(log2) = self.floor_log2() else {
            return found;
        };
        // log10 = log2·0.30103; a place too many is cut off below.
        let log10 = log2 * 30103 / 100_000 - 1;
        let places = count as i64 - log10;
        let scaled = self.times_power_of_ten(places);
        let (m, exact) = scaled.magnitude_in_units(0);
        let all = m.to_string();
        found.exponent = all.len() as i64 - places;
        let cut = all.len().min(count);
        found.exact = exact && all[cut..].bytes().all(|b| b == b'0');
        found.digits = if found.exact {
            all.trim_end_matches('0').to_owned()
        } else {
            all[..cut].to_owned()
        };
        found
    }

    /// The nearest whole multiple of 10^−places, in units of that; of two, the one farther from zero.
    pub fn in_decimal_units(&self, places: i64) -> IBig {
        let (twice, _) = self
            .times_power_of_ten(places)
            .shifted(1)
            .magnitude_in_units(0);
        let units = IBig::from((twice + UBig::ONE) >> 1);
        if self.sign() == Ordering::Less {
            -units
        } else {
            units
        }
    }

    fn times_power_of_ten(&self, power: i64) -> Self {
        let factor = Dyadic::new(IBig::from(10).pow(power.unsigned_abs() as usize), 0);
        let mut scaled = self.clone();
        if power >= 0 {
            scaled.x = &scaled.x * &factor;
            scaled.y = &scaled.y * &factor;
        } else {
            scaled.z = &scaled.z * &factor;
        }
        scaled
    }
}

fn magnitude(n: &IBig) -> UBig {
    n.clone().into_parts().1
}

/// m·2^exponent, or a little more if not `exact`, to the nearest number of `precision`; m must
/// have two bits more than that, or reach two places below the least subnormal.
fn round_magnitude(m: &UBig, exponent: i64, exact: bool, precision: Precision) -> f64 {
    let top = m.bit_len() as i64 - 1 + exponent;
    let unit = (top - i64::from(precision.bits()) + 1).max(i64::from(precision.least_exponent()));
    if unit > i64::from(precision.greatest_exponent()) {
        return f64::INFINITY;
    }
    let drop = (unit - exponent).max(0) as usize;
    let kept = (m >> drop) << (exponent - unit).max(0) as usize;
    let half = drop > 0 && m.bit(drop - 1);
    let below = !exact || (drop > 1 && m.trailing_zeros().is_some_and(|zeros| zeros < drop - 1));
    // `kept` has at most 53 bits: the conversion is exact.
    let kept = u64::try_from(kept).unwrap_or(u64::MAX);
    let rounded = kept + u64::from(half && (below || kept % 2 == 1));
    let value = rounded as f64 * power_of_two(unit as i32);
    match precision {
        Precision::Binary32 => f64::from(value as f32),
        Precision::Binary64 => value,
    }
}

impl From<Dyadic> for Surd {
    fn from(x: Dyadic) -> Self {
        Self {
            x,
            y: Dyadic::ZERO,
            n: Dyadic::ZERO,
            z: Dyadic::from(1.0),
        }
    }
}

impl Neg for Surd {
    type Output = Self;
    fn neg(mut self) -> Self {
        self.x = -self.x;
        self.y = -self.y;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surd([x, y, n, z]: [f64; 4]) -> Surd {
        let [x, y, n, z] = [x, y, n, z].map(|v| Dyadic::from_f64(v).unwrap());
        Surd::new(x, y, n, z).unwrap()
    }

    fn shown(s: &Surd, count: usize) -> String {
        let d = s.digits(count);
        let sign = if d.negative { "-" } else { "" };
        let more = if d.exact { "" } else { "…" };
        format!("{sign}0.{}{more}e{}", d.digits, d.exponent)
    }

    #[test]
    fn decides_signs_exactly() {
        // 3 − √8.999… > 0 > 3 − √9.000…; 3 − √9 = 0.
        assert_eq!(
            surd([3.0, -1.0, 9.0_f64.next_down(), 1.0]).sign(),
            Ordering::Greater
        );
        assert_eq!(
            surd([3.0, -1.0, 9.0_f64.next_up(), 1.0]).sign(),
            Ordering::Less
        );
        assert!(surd([3.0, -1.0, 9.0, 7.0]).is_zero());
    }

    #[test]
    fn rounds_once_to_nearest_even() {
        let tie = surd([16_777_217.0, 0.0, 0.0, 1.0]);
        assert_eq!(tie.to_f32(), 16_777_216.0);
        let above = surd([16_777_217.0, 1.0, 1e-200, 1.0]);
        assert_eq!(above.to_f32(), 16_777_218.0);
        let below = surd([-16_777_217.0, 1.0, 1e-200, 1.0]);
        assert_eq!(below.to_f32(), -16_777_216.0);
        assert_eq!(surd([1.0, 0.0, 0.0, 3.0]).to_f32(), 1.0 / 3.0);
        assert_eq!(surd([0.0, 1.0, 2.0, 1.0]).to_f64(), 2.0_f64.sqrt());
        assert_eq!(surd([1e39, 0.0, 0.0, 1.0]).to_f32(), f32::INFINITY);
        assert_eq!(surd([3.0, 0.0, 0.0, 4e45]).to_f32(), f32::from_bits(1));
        assert_eq!(surd([-1.0, 0.0, 0.0, 1e300]).to_f32(), -0.0);
        assert_eq!(surd([f64::MAX, 0.0, 0.0, 0.5]).to_f64(), f64::INFINITY);
    }

    #[test]
    fn computes_in_the_field() {
        let golden = surd([1.0, 1.0, 5.0, 2.0]);
        let one = surd([1.0, 0.0, 0.0, 1.0]);
        // φ − 1 = 1/φ, φ² = φ + 1.
        let less = golden.checked_sub(&one).unwrap();
        assert!(
            less.checked_sub(&golden.reciprocal().unwrap())
                .unwrap()
                .is_zero()
        );
        let square = golden.checked_mul(&golden).unwrap();
        let more = golden.checked_add(&one).unwrap();
        assert!(square.checked_sub(&more).unwrap().is_zero());
        // A vanishing conjugate: 1/(3 + √9) = 1/6.
        let sixth = surd([3.0, 1.0, 9.0, 1.0]).reciprocal().unwrap();
        assert_eq!(sixth.to_f64(), 1.0 / 6.0);
        assert!(surd([3.0, -1.0, 9.0, 1.0]).reciprocal().is_none());
        assert!(surd([-2.0, 0.0, 0.0, 1.0]).checked_sqrt().is_none());
        let half = surd([3.0, 0.0, 0.0, 4.0]).checked_sqrt().unwrap();
        assert_eq!(half.to_f64(), 3.0_f64.sqrt() / 2.0);
        assert!(golden.checked_add(&surd([0.0, 1.0, 2.0, 1.0])).is_none());
    }

    #[test]
    fn measures_errors_in_ulps() {
        let third = surd([1.0, 0.0, 0.0, 3.0]);
        let nearest = 1.0_f32 / 3.0;
        let off = third.ulps(nearest.into(), Precision::Binary32);
        // 1/3 = 0.0101…₂: the 24 bits are off by a third of the last.
        assert!((off - 1.0 / 3.0).abs() < 1e-9, "{off}");
        let next = third.ulps(nearest.next_up().into(), Precision::Binary32);
        assert!((next - 4.0 / 3.0).abs() < 1e-9, "{next}");
        let zero = surd([0.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            zero.ulps(f32::from_bits(3).into(), Precision::Binary32),
            3.0
        );
        let huge = surd([1e300, 0.0, 0.0, 1.0]);
        assert_eq!(huge.ulps(f64::INFINITY, Precision::Binary32), 0.0);
        assert_eq!(
            huge.ulps(f64::NEG_INFINITY, Precision::Binary32),
            f64::INFINITY
        );
        assert!(huge.ulps(f64::NAN, Precision::Binary32).is_nan());
    }

    #[test]
    fn writes_decimal_digits() {
        let tenth = Surd::from_f64(0.1_f32.into()).unwrap();
        assert_eq!(shown(&tenth, 13), "0.1000000014901…e0");
        assert_eq!(shown(&tenth, 40), "0.100000001490116119384765625e0");
        assert_eq!(shown(&surd([-300.0, 0.0, 0.0, 1.0]), 5), "-0.3e3");
        assert_eq!(shown(&surd([0.0, 1.0, 2.0, 1.0]), 8), "0.14142135…e1");
        assert_eq!(shown(&surd([9.99, 0.0, 0.0, 1.0]), 3), "0.999…e1");
        assert_eq!(shown(&surd([0.0, 0.0, 0.0, 1.0]), 3), "0.e0");
        let tiny = Surd::from_f64(f64::from_bits(1)).unwrap();
        assert_eq!(shown(&tiny, 4), "0.4940…e-323");
    }
}
