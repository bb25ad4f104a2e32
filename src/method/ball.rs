//! Numbers known to within a bound: 320 bits about a middle. For what a [`Surd`] can't hold, as a root of a root,
//! or what would grow without end.

use dashu_int::ops::{BitTest as _, SquareRootRem as _};
use dashu_int::{IBig, UBig};

use super::dyadic::Dyadic;
use super::surd::Surd;

/// Bits of a middle.
const BITS: i64 = 320;
/// A bound may be this many bits smaller than the number, or the number can't be told.
const TELLING: i64 = 200;
/// What is larger or smaller than 2^±that is not followed.
const FARTHEST: i64 = 1 << 24;
/// How much the surds of a routine may hold before a ball takes their place: a loop may square without end.
#[cfg(feature = "routine")]
pub(super) const LARGEST_SURD: i64 = 6000;

/// A number without rounding: itself, or within a ball.
#[derive(Debug, Clone)]
pub(super) enum Unrounded {
    Surd(Surd),
    Ball(Ball),
}

/// A middle and a bound on how far the number is from it.
#[derive(Debug, Clone)]
pub(super) struct Ball {
    middle: Dyadic,
    /// m·2^e with 1 ≤ m < 2; none for 0.
    bound: Option<(f64, i64)>,
}

impl Unrounded {
    /// The number, if enough of it is known to be shown.
    pub fn told(&self) -> Option<Surd> {
        match self {
            Self::Surd(surd) => Some(surd.clone()),
            Self::Ball(ball) => ball.told(),
        }
    }

    fn surd(&self) -> Option<&Surd> {
        match self {
            Self::Surd(surd) => Some(surd),
            Self::Ball(_) => None,
        }
    }

    fn ball(&self) -> Option<Ball> {
        match self {
            Self::Surd(surd) => Ball::of(surd),
            Self::Ball(ball) => Some(ball.clone()),
        }
    }

    pub fn add(&self, other: &Self, largest: i64) -> Option<Self> {
        self.both(other, largest, Surd::checked_add, Ball::add)
    }

    pub fn sub(&self, other: &Self, largest: i64) -> Option<Self> {
        self.both(other, largest, Surd::checked_sub, |x, y| x.add(&y.neg()))
    }

    pub fn mul(&self, other: &Self, largest: i64) -> Option<Self> {
        self.both(other, largest, Surd::checked_mul, Ball::mul)
    }

    pub fn div(&self, other: &Self, largest: i64) -> Option<Self> {
        if self.surd().is_some() && other.surd().is_some_and(Surd::is_zero) {
            return None;
        }
        self.both(other, largest, Surd::checked_div, Ball::div)
    }

    pub fn neg(&self) -> Self {
        match self {
            Self::Surd(surd) => Self::Surd(-surd.clone()),
            Self::Ball(ball) => Self::Ball(ball.neg()),
        }
    }

    pub fn sqrt(&self, largest: i64) -> Option<Self> {
        if let Some(surd) = self.surd() {
            if surd.sign().is_lt() {
                return None;
            }
            if let Some(root) = surd.checked_sqrt().filter(|root| root.size() <= largest) {
                return Some(Self::Surd(root));
            }
        }
        self.ball()?.sqrt().map(Self::Ball)
    }

    /// By surds while these hold it and are no larger than that, else by balls.
    fn both(
        &self,
        other: &Self,
        largest: i64,
        by_surds: impl Fn(&Surd, &Surd) -> Option<Surd>,
        by_balls: impl Fn(&Ball, &Ball) -> Option<Ball>,
    ) -> Option<Self> {
        if let (Some(x), Some(y)) = (self.surd(), other.surd())
            && let Some(result) = by_surds(x, y).filter(|result| result.size() <= largest)
        {
            return Some(Self::Surd(result));
        }
        by_balls(&self.ball()?, &other.ball()?).map(Self::Ball)
    }
}

impl Ball {
    fn of(surd: &Surd) -> Option<Self> {
        let (middle, error) = surd.approximation(BITS);
        Self {
            middle,
            bound: error.map(|e| (1.0, e)),
        }
        .followed()
    }

    fn told(&self) -> Option<Surd> {
        let telling = match (self.bound, self.middle.floor_log2()) {
            (None, _) => true,
            (Some((_, e)), Some(log)) => e + TELLING < log,
            (Some(_), None) => false,
        };
        telling.then(|| Surd::from(self.middle.clone()))
    }

    /// Nothing, for what is out of all range.
    fn followed(self) -> Option<Self> {
        let log = self.middle.floor_log2().unwrap_or(0);
        let bound = self.bound.map_or(0, |(_, e)| e);
        (log.abs() < FARTHEST && bound.abs() < FARTHEST + BITS).then_some(self)
    }

    /// The middle rounded to its bits, and the bound with what that may be off.
    fn rounded(middle: Dyadic, bound: Option<(f64, i64)>) -> Option<Self> {
        let Some(log) = middle.floor_log2() else {
            return Self { middle, bound }.followed();
        };
        let cut = log - BITS + 1 - middle.exponent();
        if cut <= 0 {
            return Self { middle, bound }.followed();
        }
        let unit = middle.exponent() + cut;
        // Towards −∞: off by less than a unit.
        let short = Dyadic::new(middle.mantissa() >> cut as usize, unit);
        Self {
            middle: short,
            bound: sum(bound, Some((1.0, unit))),
        }
        .followed()
    }

    fn neg(&self) -> Self {
        Self {
            middle: -self.middle.clone(),
            bound: self.bound,
        }
    }

    fn add(&self, other: &Self) -> Option<Self> {
        let bound = sum(self.bound, other.bound);
        let logs = [self, other].map(|ball| ball.middle.floor_log2());
        // Of two numbers far apart the smaller is no more than a bound.
        if let [Some(x), Some(y)] = logs
            && (x - y).abs() > 2 * BITS
        {
            let (great, small) = if x > y { (self, y) } else { (other, x) };
            return Self::rounded(great.middle.clone(), sum(bound, Some((1.0, small + 1))));
        }
        Self::rounded(&self.middle + &other.middle, bound)
    }

    fn mul(&self, other: &Self) -> Option<Self> {
        let sizes = [self, other].map(Self::size);
        let bound = sum(
            sum(
                product(sizes[0], other.bound),
                product(sizes[1], self.bound),
            ),
            product(self.bound, other.bound),
        );
        Self::rounded(&self.middle * &other.middle, bound)
    }

    fn div(&self, other: &Self) -> Option<Self> {
        let log = other.middle.floor_log2()?;
        // A divisor that may be 0 leaves no quotient.
        if other.bound.is_some_and(|(_, e)| e + 3 > log) {
            return None;
        }
        let (x, y) = (&self.middle, &other.middle);
        let shift = (BITS + 8 + bits(y.mantissa()) - bits(x.mantissa())).max(0);
        let quotient = (x.mantissa() << shift as usize) / y.mantissa();
        let exponent = x.exponent() - y.exponent() - shift;
        let middle = Dyadic::new(quotient, exponent);
        let cut_off = Some((1.0, exponent));
        let size = middle.floor_log2().map(|log| (1.0, log + 1));
        // |a/b − q| ≤ (bound of a + |q|·bound of b) / (|b| − bound of b), which is at least |b|/2.
        let over = sum(self.bound, product(sum(size, cut_off), other.bound));
        let bound = sum(cut_off, over.map(|(m, e)| (m, e - log + 1)));
        Self::rounded(middle, bound)
    }

    fn sqrt(&self) -> Option<Self> {
        let log = self.middle.floor_log2()?;
        let is_certain = self.bound.is_none_or(|(_, e)| e + 3 < log);
        if self.middle.sign().is_lt() || !is_certain {
            return None;
        }
        let mut shift = (2 * BITS + 16 - bits(self.middle.mantissa())).max(0);
        shift += (self.middle.exponent() - shift).rem_euclid(2);
        let whole = UBig::try_from(self.middle.mantissa() << shift as usize).ok()?;
        let (root, _) = whole.sqrt_rem();
        let exponent = (self.middle.exponent() - shift) / 2;
        let middle = Dyadic::new(IBig::from(root), exponent);
        // |√a − √m| ≤ bound/√m.
        let of_bound = self.bound.map(|(m, e)| (m, e - log.div_euclid(2)));
        Self::rounded(middle, sum(Some((1.0, exponent)), of_bound))
    }

    /// At least |middle|.
    fn size(&self) -> Option<(f64, i64)> {
        self.middle.floor_log2().map(|log| (1.0, log + 1))
    }
}

fn bits(x: &IBig) -> i64 {
    x.clone().into_parts().1.bit_len() as i64
}

type Bound = Option<(f64, i64)>;

/// A little more than the sum.
fn sum(x: Bound, y: Bound) -> Bound {
    let (Some(x), Some(y)) = (x, y) else {
        return x.or(y);
    };
    let (great, small) = if x.1 >= y.1 { (x, y) } else { (y, x) };
    let apart = (great.1 - small.1).min(60);
    Some(normal(
        great.0 + small.0 * 0.5_f64.powi(apart as i32),
        great.1,
    ))
}

/// A little more than the product.
fn product(x: Bound, y: Bound) -> Bound {
    let (x, y) = (x?, y?);
    Some(normal(x.0 * y.0, x.1 + y.1))
}

fn normal(m: f64, e: i64) -> (f64, i64) {
    let m = m * (1.0 + 1e-12);
    if m >= 4.0 {
        (m / 4.0, e + 2)
    } else if m >= 2.0 {
        (m / 2.0, e + 1)
    } else {
        (m, e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LARGEST: i64 = 6000;

    fn exact(x: f64) -> Unrounded {
        Unrounded::Surd(Surd::from_f64(x).unwrap())
    }

    #[test]
    fn a_root_of_a_root_is_known_to_two_hundred_bits() {
        let two = exact(2.0);
        let fourth = two.sqrt(LARGEST).unwrap().sqrt(LARGEST).unwrap();
        assert!(matches!(fourth, Unrounded::Ball(_)));
        let square = fourth.mul(&fourth, LARGEST).unwrap();
        let back = square.mul(&square, LARGEST).unwrap();
        let off = back.sub(&two, LARGEST).unwrap();
        // It is 0 or all but, so how far off can't be told.
        assert!(off.told().is_none());
        assert_eq!(back.told().unwrap().to_f64(), 2.0);
        let sum = fourth
            .add(&exact(3.0).sqrt(LARGEST).unwrap(), LARGEST)
            .unwrap();
        assert!(
            (sum.told().unwrap().to_f64() - (2.0_f64.powf(0.25) + 3.0_f64.sqrt())).abs() < 1e-14
        );
        let third = exact(1.0)
            .div(
                &exact(3.0).sqrt(LARGEST).unwrap().sqrt(LARGEST).unwrap(),
                LARGEST,
            )
            .unwrap();
        assert!((third.told().unwrap().to_f64() - 3.0_f64.powf(-0.25)).abs() < 1e-15);
    }

    #[test]
    fn what_may_be_zero_divides_nothing_and_what_grows_stays_small() {
        let root = exact(2.0).sqrt(LARGEST).unwrap().sqrt(LARGEST).unwrap();
        let nothing = root.sub(&root, LARGEST).unwrap();
        assert!(exact(1.0).div(&nothing, LARGEST).is_none());
        assert!(nothing.sqrt(LARGEST).is_none());
        let mut x = exact(1.000_000_1);
        let mut steps = 0;
        while let Some(next) = x.mul(&x, LARGEST) {
            x = next;
            steps += 1;
            assert!(steps < 200);
        }
        assert!(steps > 30);
    }
}
