//! The bounds of stage 1, held against every input of formats so small that all can be tried.
//!
//! Of binary64 the derivation uses the unit roundoff, that an input has less than half its bits, and
//! that nothing over- or underflows. So the same code must keep the same bounds where inputs have p
//! bits and operations P = 2p + 5, a relation that binary32 and binary64 have too (53 = 2·24 + 5).
//! There an input of every kind comes up: what a search by chance in binary32 would have to be
//! lucky to meet.
//!
//! With `RAYSCOPE_SMALL_FORMAT` set, the formats have more exponents: some minutes of a release build.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::binary64::{self, Bounded, Discriminant, Estimate, Input, Roots};
use super::real::WorkingFloat;
use crate::method::Class;
use crate::number::Number;

/// A number of P bits, rounded to nearest with ties to even, of any exponent.
///
/// Kept in binary64: for P ≤ 25 rounding an operation's binary64 result again gives what rounding
/// once would give (Figueroa, "When is double rounding innocuous?", 1995).
#[derive(Debug, Clone, Copy)]
struct Small<const P: u32>(f64);

impl<const P: u32> Small<P> {
    fn rounded(exact: f64) -> Self {
        let dropped = 53 - P;
        let bits = exact.to_bits();
        let half_and_ties = (1 << (dropped - 1)) - 1 + ((bits >> dropped) & 1);
        Self(f64::from_bits((bits + half_and_ties) >> dropped << dropped))
    }
}

impl<const P: u32> Add for Small<P> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded(self.0 + other.0)
    }
}

impl<const P: u32> Sub for Small<P> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.0 - other.0)
    }
}

impl<const P: u32> Mul for Small<P> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::rounded(self.0 * other.0)
    }
}

impl<const P: u32> Div for Small<P> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::rounded(self.0 / other.0)
    }
}

impl<const P: u32> Neg for Small<P> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const P: u32> Number for Small<P> {
    fn of(value: f64) -> Self {
        Self::rounded(value)
    }
    fn sqrt(self) -> Self {
        Self::rounded(self.0.sqrt())
    }
}

impl<const P: u32> WorkingFloat for Small<P> {
    const U: f64 = 1.0 / (1_u64 << P) as f64;
    /// As far above u as leaves the roundings that the derivation counts as a part of ε small.
    const DIRECT_ERROR: f64 = 64.0 * Self::U;
    const SPLITTER: f64 = (1_u64 << P.div_ceil(2)) as f64 + 1.0;

    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn copysign(self, other: Self) -> Self {
        Self(self.0.copysign(other.0))
    }
}

/// The numbers of p bits with these exponents, from 0 up; whole, so that the exact quantities are
/// whole numbers too.
fn numbers(p: u32, exponents: &[u32]) -> Vec<f64> {
    let significands = 1_u64 << (p - 1)..1 << p;
    let scaled = |&e: &u32| significands.clone().map(move |s| (s << e) as f64);
    let positive = exponents.iter().flat_map(scaled);
    std::iter::once(0.0).chain(positive).collect()
}

/// For each difference of two such numbers one pair that has it: nothing depends on p0 and c but by
/// their difference, exact and rounded.
fn pairs(numbers: &[f64]) -> Vec<(f64, f64)> {
    let all: Vec<f64> = numbers.iter().flat_map(|&x| [x, -x]).collect();
    let mut pairs: Vec<(f64, f64)> = all
        .iter()
        .flat_map(|&x| all.iter().map(move |&y| (x, y)))
        .collect();
    pairs.sort_by(|(x, y), (v, w)| (x - y).total_cmp(&(v - w)));
    pairs.dedup_by(|(x, y), (v, w)| *x - *y == *v - *w);
    pairs
}

/// What the formulas give without rounding: A, b, C, D as whole numbers, and the roots to fifty bits.
struct Exact {
    half_b: i64,
    c: i64,
    d: i64,
    /// The smaller and the larger root.
    roots: [f64; 2],
}

impl Exact {
    fn new(input: &Input<f64>) -> Self {
        let whole = |x: f64| x as i64;
        let o = [0, 1, 2].map(|i| whole(input.p0[i]) - whole(input.center[i]));
        let direction = input.d.map(whole);
        let dot = |u: [i64; 3], v: [i64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let a = dot(direction, direction);
        let half_b = dot(o, direction);
        let c = dot(o, o) - whole(input.r).pow(2);
        let d = half_b * half_b - a * c;
        let q = half_b as f64 + (d.max(0) as f64).sqrt().copysign(half_b as f64);
        Self {
            half_b,
            c,
            d,
            roots: match [-q / a as f64, -c as f64 / q] {
                [t, u] if t > u => [u, t],
                ordered => ordered,
            },
        }
    }

    fn class(&self) -> Class {
        Class::of_discriminant(self.d as f64)
    }
}

/// The largest share of each bound that an error came to.
#[derive(Debug, Clone, Copy, Default)]
struct Shares {
    inputs: u64,
    certain: u64,
    /// How far D is on the wrong side of zero.
    sign: f64,
    d: f64,
    c: f64,
    half_b: f64,
    direct: f64,
    great: f64,
    small: f64,
}

fn learn(most: &mut f64, error: f64, bound: f64) {
    if error > 0.0 {
        *most = most.max(error / bound);
    }
}

/// Runs stage 1 for one input in P bits and holds all that it claims against what is exact.
fn hold<const P: u32>(input: &Input<f64>, shares: &mut Shares) {
    let exact = Exact::new(input);
    let small = Input {
        p0: input.p0.map(Small::<P>),
        d: input.d.map(Small),
        center: input.center.map(Small),
        r: Small(input.r),
    };
    let found = binary64::discriminant(&small);
    let plain = Discriminant {
        o: found.o.map(|x| x.0),
        a: found.a.0,
        ar2: found.ar2.0,
        k2: found.k2.0,
        d: found.d.0,
        d_error: found.d_error.0,
    };
    shares.inputs += 1;
    let beyond_zero = if exact.d < 0 { plain.d } else { -plain.d };
    learn(&mut shares.sign, beyond_zero, plain.d_error);
    let Some(class) = plain.class() else {
        return;
    };
    assert_eq!(class, exact.class(), "{P} bits: {input:?}");
    shares.certain += 1;
    let estimate = binary64::compensated(&small, &found);
    hold_coefficients(&estimate, &exact, shares);
    if class == Class::Secant {
        learn(
            &mut shares.d,
            (plain.d - exact.d as f64).abs(),
            plain.d_error,
        );
        hold_compensated(&binary64::roots(&estimate), &exact, shares);
        hold_direct(&small, &found, &exact, shares);
    }
}

fn hold_coefficients<const P: u32>(
    estimate: &Estimate<Small<P>>,
    exact: &Exact,
    shares: &mut Shares,
) {
    let error = |found: Small<P>, exact: i64| (found.0 - exact as f64).abs();
    let half_b = error(estimate.half_b, exact.half_b);
    learn(&mut shares.half_b, half_b, estimate.half_b_error.0);
    learn(
        &mut shares.c,
        error(estimate.c, exact.c),
        estimate.c_error.0,
    );
}

fn hold_compensated<const P: u32>(roots: &Roots<Small<P>>, exact: &Exact, shares: &mut Shares) {
    let error = |root: Bounded<Small<P>>, exact: f64| (-root.value.0 - exact).abs();
    let [near, far] = exact.roots;
    let [great, small] = if roots.q.0 < 0.0 {
        [far, near]
    } else {
        [near, far]
    };
    let Roots {
        great: q_over_a,
        small: c_over_q,
        ..
    } = *roots;
    learn(&mut shares.great, error(q_over_a, great), q_over_a.error.0);
    learn(&mut shares.small, error(c_over_q, small), c_over_q.error.0);
}

/// The share of ε that is used up on either side.
fn hold_direct<const P: u32>(
    input: &Input<Small<P>>,
    discriminant: &Discriminant<Small<P>>,
    exact: &Exact,
    shares: &mut Shares,
) {
    let direct = binary64::direct(input, discriminant);
    if discriminant.d_error.0 < direct.d_error_limit.0 {
        for ([less, more], exact) in [direct.near, direct.far].into_iter().zip(exact.roots) {
            let half = (more.0 - less.0).abs() / 2.0;
            let middle = f64::midpoint(less.0, more.0);
            learn(&mut shares.direct, (exact - middle).abs(), half);
        }
    }
}

/// Holds every input of p bits with these exponents in so many dimensions, in P bits.
///
/// Axes can be turned around without any rounding coming out otherwise, so directions are in the
/// first octant.
fn search<const P: u32>(p: u32, exponents: &[u32], dimensions: usize) -> Shares {
    assert_eq!(P, 2 * p + 5);
    let numbers = numbers(p, exponents);
    let pairs = pairs(&numbers);
    let mut shares = Shares::default();
    for d in points(&numbers, 0.0, dimensions).skip(1) {
        for o in points(&pairs, (0.0, 0.0), dimensions) {
            for &r in &numbers {
                let input = Input {
                    p0: o.map(|(x, _)| x),
                    center: o.map(|(_, y)| y),
                    d,
                    r,
                };
                hold::<P>(&input, &mut shares);
            }
        }
    }
    shares
}

/// All points whose coordinates are of this list, the first in the list first; beyond so many
/// dimensions they are zero.
fn points<T: Copy>(coordinates: &[T], zero: T, dimensions: usize) -> impl Iterator<Item = [T; 3]> {
    let all = coordinates.len().pow(dimensions as u32);
    (0..all).map(move |number| {
        let mut rest = number;
        let mut point = [zero; 3];
        for x in &mut point[..dimensions] {
            *x = coordinates[rest % coordinates.len()];
            rest /= coordinates.len();
        }
        point
    })
}

/// Every bound is kept, and the search is no empty one: it comes near enough to them to see a
/// constant that is a few times too small.
fn assert_kept(name: &str, shares: &Shares) {
    println!("{name}: {shares:?}");
    let Shares {
        sign,
        d,
        c,
        half_b,
        direct,
        great,
        small,
        ..
    } = *shares;
    for (what, share) in [
        ("the sign of D", sign),
        ("D", d),
        ("C", c),
        ("b", half_b),
        ("(−b ± s)/A", direct),
        ("q/A", great),
        ("C/q", small),
    ] {
        assert!(
            share <= 1.0,
            "{name}: {what} is off by {share} of its bound"
        );
        assert!(share > 0.0, "{name}: no error of {what} was met");
    }
}

/// The exponents of the wide format if it was asked for.
fn exponents(usual: &'static [u32], wide: &'static [u32]) -> &'static [u32] {
    if std::env::var_os("RAYSCOPE_SMALL_FORMAT").is_some() {
        wide
    } else {
        usual
    }
}

#[test]
fn in_nine_bits_every_bound_is_kept_in_the_plane() {
    let exponents = exponents(&[0, 3, 8], &[0, 1, 3, 5, 8, 9]);
    assert_kept("2 bits in 9", &search::<9>(2, exponents, 2));
}

#[test]
fn in_eleven_bits_every_bound_is_kept_in_the_plane() {
    let exponents = exponents(&[0, 9], &[0, 4, 9]);
    assert_kept("3 bits in 11", &search::<11>(3, exponents, 2));
}

#[test]
fn in_seven_bits_every_bound_is_kept_in_space() {
    let exponents = exponents(&[0, 7], &[0, 2, 4, 7]);
    assert_kept("1 bit in 7", &search::<7>(1, exponents, 3));
}

#[test]
fn rounds_to_nearest_with_ties_to_even() {
    let rounded = |x| Small::<3>::rounded(x).0;
    let pairs = [
        (8.0, 8.0),
        (9.0, 8.0),
        (11.0, 12.0),
        (-9.1, -10.0),
        (15.0, 16.0),
        (0.0, 0.0),
    ];
    for (exact, expected) in pairs {
        assert_eq!(rounded(exact), expected, "{exact}");
    }
}
