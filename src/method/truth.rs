//! What the answer is, exactly: integers without end (`dashu-int`), no rounding but the last.
//!
//! Slow, plain, and independent of every method: tests and reports hold the methods to it.

use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::surd::Surd;
use super::{Class, Place, Precision, Solution, Which};
use crate::geometry::{Ray, Sphere};

/// The quadratic of one ray and one sphere over the exact numbers that their binary32 stand for.
#[derive(Debug, Clone)]
pub struct Truth {
    /// A = d·d, above zero.
    pub a: Dyadic,
    /// b = B/2 = d·(p0 − c).
    pub half_b: Dyadic,
    /// C = (p0 − c)·(p0 − c) − r².
    pub c: Dyadic,
    /// D = Δ/4 = b² − AC.
    pub quarter_discriminant: Dyadic,
}

impl Truth {
    /// The exact coefficients. The inputs must be finite and d other than zero.
    pub fn new(ray: &Ray, sphere: &Sphere) -> Self {
        let d = ray.direction.to_array().map(Dyadic::from);
        let p0 = ray.origin.to_array().map(Dyadic::from);
        let center = sphere.center.to_array().map(Dyadic::from);
        let r = Dyadic::from(sphere.radius);
        let o = [0, 1, 2].map(|i| &p0[i] - &center[i]);

        let a = dot(&d, &d);
        let half_b = dot(&d, &o);
        let c = &dot(&o, &o) - &r.squared();
        let quarter_discriminant = &half_b.squared() - &(&a * &c);
        Self {
            a,
            half_b,
            c,
            quarter_discriminant,
        }
    }

    /// B = 2 d·(p0 − c).
    pub fn b(&self) -> Dyadic {
        self.half_b.clone().shifted(1)
    }

    /// Δ = B² − 4AC.
    pub fn discriminant(&self) -> Dyadic {
        self.quarter_discriminant.clone().shifted(2)
    }

    /// Miss, tangent or secant, by the sign of Δ.
    pub fn class(&self) -> Class {
        match self.quarter_discriminant.sign() {
            Ordering::Less => Class::Miss,
            Ordering::Equal => Class::Tangent,
            Ordering::Greater => Class::Secant,
        }
    }

    /// The smaller root, (−b − √D)/A; none for a miss.
    pub fn near(&self) -> Option<Surd> {
        self.root(Which::Near)
    }

    /// The larger root, (−b + √D)/A; none for a miss.
    pub fn far(&self) -> Option<Surd> {
        self.root(Which::Far)
    }

    fn root(&self, which: Which) -> Option<Surd> {
        let d = self.quarter_discriminant.clone();
        Surd::new(-self.half_b.clone(), which.sign().into(), d, self.a.clone())
    }

    /// The class, where the sphere lies, and both roots rounded once to binary32.
    pub fn solution(&self) -> Solution {
        match (self.near(), self.far()) {
            (Some(near), Some(far)) => {
                let sign = |root: &Surd| f32::from(root.sign() as i8);
                let place = Place::by_roots(sign(&near), sign(&far));
                Solution::placed(self.class(), near.to_f32(), far.to_f32(), place)
            }
            _ => Solution::MISS,
        }
    }

    /// How a root of this quadratic compares with one of another sphere along the same ray.
    ///
    /// A is the same, so where this root t is, the other quadratic has the value 2(b′ − b)t + C′ − C and
    /// the slope (b′ − b ± √D)/A: numbers with one square root, whose signs are known.
    pub(super) fn compare(&self, root: Which, other: &Self, other_root: Which) -> Option<Ordering> {
        let side = Dyadic::from(root.sign());
        let (db, dc) = (&other.half_b - &self.half_b, &other.c - &self.c);
        let x = &(&self.a * &dc) - &(&db * &self.half_b).shifted(1);
        let y = (&db * &side).shifted(1);
        let sign = |x, y| {
            let n = self.quarter_discriminant.clone();
            Some(Surd::new(x, y, n, Dyadic::from(1.0))?.sign())
        };
        let order = other_root.compare(sign(db, side)?, || sign(x, y))?;
        Some(order.reverse())
    }

    /// κ = (|A|t² + |Bt| + |C|)/(|t|√Δ) at a root t: what rounding the coefficients may cost at
    /// best. ∞ for a tangent, none for t = 0, where it has no meaning.
    pub fn condition(&self, root: &Surd) -> Option<f64> {
        if root.is_zero() {
            return None;
        }
        let f64_of = |x: &Dyadic| Surd::from(x.clone()).to_f64().abs();
        let t = root.to_f64().abs();
        let sum = f64_of(&self.a) * t * t + f64_of(&self.b()) * t + f64_of(&self.c);
        Some(sum / (t * f64_of(&self.discriminant()).sqrt()))
    }

    /// The blame of a binary32 answer for a root: its relative error over κu, u = 2⁻²⁴.
    ///
    /// Far above 1 the formula is at fault; about 1 or below, the question is. A correctly
    /// rounded answer is never at fault: 0. None for t = 0.
    pub fn blame(&self, root: &Surd, answer: f32) -> Option<f64> {
        let condition = self.condition(root)?;
        if answer == root.to_f32() {
            return Some(0.0);
        }
        let error = Surd::from_f64(answer.into())
            .and_then(|answer| {
                answer
                    .checked_sub(root)?
                    .abs()
                    .checked_div(&root.clone().abs())
            })
            .map_or(f64::INFINITY, |relative| relative.to_f64());
        Some(error / (condition * HALF_ULP))
    }
}

/// u = 2⁻²⁴, the unit roundoff of binary32.
const HALF_ULP: f64 = 1.0 / 16_777_216.0;

/// The error of a binary32 answer for a root, in ulps: |answer − root| / ulp(root).
///
/// ∞ for an infinite answer to a root within the range, 0 where the infinity is right, NaN for
/// NaN.
pub fn ulp_error(answer: f32, root: &Surd) -> f64 {
    root.ulps(answer.into(), Precision::Binary32)
}

fn dot(u: &[Dyadic; 3], v: &[Dyadic; 3]) -> Dyadic {
    let [x, y, z] = [0, 1, 2].map(|i| &u[i] * &v[i]);
    &(&x + &y) + &z
}

/// How many of the 24 bits of an answer an error makes worthless: log₂ of the error in half ulps; 0
/// for an error of half an ulp, 24 where nothing is left.
pub fn bits_lost(ulps: f64) -> f64 {
    (2.0 * ulps)
        .max(1.0)
        .log2()
        .min(f64::from(f32::MANTISSA_DIGITS))
}

/// The bits that a root above 0 lost, held against the exact one rounded once: 0 for the same
/// number, none if one of two different ones is infinite.
pub fn root_bits_lost(answer: f32, exact: f32) -> Option<f64> {
    if answer == exact {
        return Some(0.0);
    }
    let ulp = f64::from(exact.next_up()) - f64::from(exact);
    let error = (f64::from(answer) - f64::from(exact)).abs();
    (answer.is_finite() && exact.is_finite()).then(|| bits_lost(error / ulp))
}
