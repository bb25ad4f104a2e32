//! The bounds of stage 1 and of `double` that are no chains of roundings, by exact arithmetic on polynomials.
//!
//! docs/gappa proves what single roundings come to; here these are put together, with the constants that
//! run. A polynomial in variables that are none below zero is none below zero if no coefficient is: a
//! bound less its error is written as one, and each coefficient is looked at.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

use super::binary64::{
    C_ERROR, E_ADDED, E_LENGTH, E_RADIUS, HALF_B_ERROR, ROOT_ERROR, SMALL_FACTOR, U,
};
use super::real::WorkingFloat;
use crate::method::dyadic::Dyadic;
use crate::number::power_of_two;

/// The exponents of up to six variables.
type Term = [u32; 6];

/// A polynomial with exact coefficients.
#[derive(Debug, Clone, PartialEq)]
struct Polynomial(BTreeMap<Term, Dyadic>);

impl Polynomial {
    fn of(terms: impl IntoIterator<Item = (Term, Dyadic)>) -> Self {
        let mut sum = BTreeMap::<Term, Dyadic>::new();
        for (term, coefficient) in terms {
            let zero = Dyadic::from(0.0);
            let entry = sum.entry(term).or_insert(zero);
            *entry = &*entry + &coefficient;
        }
        sum.retain(|_, coefficient| !coefficient.is_zero());
        Self(sum)
    }

    /// A number, which must be a binary64.
    fn number(x: f64) -> Self {
        Self::of([([0; 6], Dyadic::from_f64(x).unwrap())])
    }

    fn variable(i: usize) -> Self {
        let mut term = [0; 6];
        term[i] = 1;
        Self::of([(term, Dyadic::from(1.0))])
    }

    fn squared(&self) -> Self {
        self.clone() * self.clone()
    }

    /// Whether it is none below zero wherever no variable is.
    fn is_never_negative(&self) -> bool {
        self.0.values().all(|c| c.sign() != Ordering::Less)
    }

    /// The terms with coefficients above zero: at least as much wherever no variable is below zero.
    fn positive_part(&self) -> Self {
        let terms = self.0.iter().filter(|(_, c)| c.sign() == Ordering::Greater);
        Self::of(terms.map(|(t, c)| (*t, c.clone())))
    }
}

impl Add for Polynomial {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::of(self.0.into_iter().chain(other.0))
    }
}

impl Sub for Polynomial {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::of(
            self.0
                .into_iter()
                .chain(other.0.into_iter().map(|(t, c)| (t, -c))),
        )
    }
}

impl Mul for Polynomial {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::of(self.0.iter().flat_map(|(s, x)| {
            other.0.iter().map(move |(t, y)| {
                let term = std::array::from_fn(|i| s[i] + t[i]);
                (term, x * y)
            })
        }))
    }
}

fn n(x: f64) -> Polynomial {
    Polynomial::number(x)
}

/// What docs/gappa proves: 2u and 3u, with what the second order adds.
const TWO_U: f64 = 131_073.0 / (65_536.0 * 9_007_199_254_740_992.0);
const THREE_U: f64 = 196_609.0 / (65_536.0 * 9_007_199_254_740_992.0);
/// How much the computed bound may be below the exact one, relatively.
const OF_BOUND: f64 = 12.0 * U;

/// The constants of E: 13, 6 and 11.
type Constants = [f64; 3];

const OURS: Constants = [E_RADIUS, E_LENGTH, E_ADDED];

/// The least that E, divided by A, comes to when it is computed.
fn bound([radius, length, added]: Constants, r: &Polynomial, l: &Polynomial) -> Polynomial {
    let spread = (n(radius * U) * r.clone() + n(length * U) * l.clone())
        * (r.clone() + n(added * U) * l.clone());
    n(1.0 - OF_BOUND) * spread
}

/// The error of the cross product beyond u of itself: this times L, lengths divided by √A.
fn beta() -> Polynomial {
    n(1.0 + U) * n(TWO_U)
}

/// What K² is computed as at most, and at least where the second is not below zero.
fn k_squared(k: &Polynomial, l: &Polynomial) -> [Polynomial; 2] {
    let upper = n(1.0 + U) * k.clone() + beta() * l.clone();
    let lower = n(1.0 - U) * k.clone() - beta() * l.clone();
    [
        upper.squared() * (n(1.0) + n(THREE_U)),
        lower.squared() * (n(1.0) - n(THREE_U)),
    ]
}

/// Whether E with these constants is at least what D̂ is off by.
fn holds(constants: Constants) -> bool {
    let [x, y, l] = [0, 1, 2].map(Polynomial::variable);
    let last = n(1.0 + U);
    let r_squared = |r: &Polynomial, sign: f64| r.squared() * (n(1.0) + n(sign * THREE_U));

    // D ≥ 0: r = k + x. What is computed is not below −E.
    let (k, r) = (x.clone(), x.clone() + y.clone());
    let below = k_squared(&k, &l)[0].clone() - r_squared(&r, -1.0);
    let a_miss_is_one = bound(constants, &r, &l) - last.clone() * below;

    // D ≤ 0 and (1 − u)r = βL + x, (1 − u)k − βL = x + y: not above E, all times (1 − u)².
    let scaled = beta() * l.clone() + x.clone();
    let above = r_squared(&scaled, 1.0)
        - n(1.0 - U).squared() * (x.clone() + y.clone()).squared() * (n(1.0) - n(THREE_U));
    let e = bound(constants, &scaled, &(n(1.0 - U) * l.clone()));
    let two_roots_are_two = e - last.clone() * above;

    // D ≤ 0 and (1 − u)r + y = βL: all times β².
    let wide = n(1.0 - U) * x.clone() + y.clone();
    let r = beta() * x.clone();
    let few = bound(constants, &r, &wide) - last.clone() * r_squared(&r, 1.0);

    // D ≥ 0, both ways: D̂ is within E of D. What K² is off by grows with k, which is at most r.
    let r = x.clone();
    let [upper, lower] = k_squared(&r, &l);
    let [over, under] = [upper - r.squared(), r.squared() - lower];
    let rounding = n(U) * r_squared(&r, 1.0);
    let of_r = n(THREE_U) * r.squared();
    let close = [over.clone(), under.positive_part()]
        .map(|off| bound(constants, &r, &l) - (of_r.clone() + off + rounding.clone()));

    over.is_never_negative()
        && [a_miss_is_one, two_roots_are_two, few]
            .iter()
            .all(Polynomial::is_never_negative)
        && close.iter().all(Polynomial::is_never_negative)
}

/// `Σ(|o_j d_k| + |o_k d_j|)²` ≤ L²A, and ≤ 2‖o‖²A: what is left is a sum of squares and of products of
/// numbers not below zero, which is seen to be the same polynomial.
#[test]
fn the_error_of_the_cross_product_is_as_long_as_is_stated() {
    let [a, b] = [[0, 1, 2], [3, 4, 5]].map(|v| v.map(Polynomial::variable));
    let pairs = [(0, 1, 2), (1, 2, 0), (2, 0, 1)];
    let sum = |terms: [Polynomial; 3]| {
        let [x, y, z] = terms;
        x + y + z
    };
    let squares = |v: &[Polynomial; 3]| sum(v.each_ref().map(Polynomial::squared));
    let both = |i: usize, j: usize| a[i].clone() * b[j].clone();
    let error = sum(pairs.map(|(i, j, _)| (both(i, j) + both(j, i)).squared()));

    let length = sum(a.clone());
    let left = sum([0, 1, 2].map(|i| both(i, i).squared()));
    let left = left
        + n(2.0)
            * sum(pairs.map(|(i, j, k)| {
                let apart = (b[i].clone() - b[j].clone()).squared();
                a[i].clone() * a[j].clone() * (apart + b[i].clone() * b[j].clone() + b[k].squared())
            }));
    assert_eq!(length.squared() * squares(&b) - error.clone(), left);

    let left = n(2.0) * sum([0, 1, 2].map(|i| both(i, i).squared()))
        + sum(pairs.map(|(i, j, _)| (both(i, j) - both(j, i)).squared()));
    assert_eq!(n(2.0) * squares(&a) * squares(&b) - error, left);
}

#[test]
fn the_sign_of_d_is_certain_beyond_its_bound() {
    assert!(holds(OURS));
    // The constants have room, which is for the roots, and not without end.
    assert!(holds([12.0, E_LENGTH, E_ADDED]));
    assert!(!holds([8.0, E_LENGTH, E_ADDED]));
    assert!(!holds([E_RADIUS, 3.5, E_ADDED]));
    assert!(!holds([E_RADIUS, E_LENGTH, 0.125]));
}

/// Whether the direct roots are within ε, by the parts of ε that the error of s, that of b, the rounding of s
/// and all others take up.
fn direct_roots_hold([radius, length, _]: Constants, half_b: f64, root: f64) -> bool {
    // ROOT/2 + HALF_B/(2·6) + 1/(2·13) + 8u/ε < 1, less what second orders come to.
    let [r, l] = [radius, length].map(n);
    let parts = n(root) * r.clone() * l.clone()
        + n(half_b) * r.clone()
        + l.clone()
        + n(2.0 * 8.0 * U / f64::DIRECT_ERROR) * r.clone() * l.clone();
    let whole = n(2.0 * (1.0 - power_of_two(-10))) * r * l;
    (whole - parts).is_never_negative()
}

#[test]
fn the_direct_roots_are_within_epsilon() {
    assert!(direct_roots_hold(OURS, HALF_B_ERROR, ROOT_ERROR));
    assert!(direct_roots_hold(
        [12.0, E_LENGTH, E_ADDED],
        HALF_B_ERROR,
        ROOT_ERROR
    ));
    assert!(!direct_roots_hold(
        [E_RADIUS, 3.0, E_ADDED],
        HALF_B_ERROR,
        ROOT_ERROR
    ));
    // b: a product with its o, and two sums; the bound is computed with as many roundings and one more.
    let of_b = (n(1.0) + n(TWO_U)) * n(1.0 + U) * n(1.0 + U) - n(1.0);
    let stated = n(HALF_B_ERROR * U) * (n(1.0) - n(OF_BOUND));
    assert!((stated - of_b).is_never_negative());
    // s: |D̂ − D|/(ŝ + s) with D ≥ 3/4 D̂, so 1/(1 + √(3/4)) of E/ŝ: (1/ROOT − 1)² ≤ 3/4.
    let left = n(1.0 - ROOT_ERROR);
    let most = n(0.75) * n(ROOT_ERROR).squared();
    assert!((most - left.squared()).is_never_negative());
    // ε holds between 1 − ε and 1 + ε as they are in binary64.
    assert_eq!(f64::DIRECT_ERROR, power_of_two(-36));
}

#[test]
fn the_compensated_stage_keeps_its_bounds() {
    // ŝ² > 4E ≥ 4·6·11 u²AL², so that E_b is at most h ŝ with h² = HALF_B²/(4·6·11).
    let h = n(0.263);
    let room = h.squared() * n(4.0 * E_LENGTH * E_ADDED) - n(HALF_B_ERROR).squared();
    assert!(room.is_never_negative());
    // E_q/|q̂| ≤ h + ROOT/4 + 8u, and 1/(1 − that) is at most the factor 1.75, all times the factor.
    let share = h + n(ROOT_ERROR / 4.0) + n(9.0 * U);
    let room = n(SMALL_FACTOR) * (n(1.0) - share) - n(1.0);
    assert!(room.is_never_negative());
    // C: differences, squares, two sums and the last one, of u(o·o + r²) each; nine roundings; o's own squared.
    let terms = 2.0 + 1.0 + 1.0 + 1.0 + 1.0;
    assert!(terms * 9.0 + 1.0 <= C_ERROR);
}

/// What docs/stability.md promises of `double`, in A r², K², K‖o‖√A and A‖o‖², divided by A.
#[test]
fn double_keeps_its_promises() {
    let [r, k, o] = [0, 1, 2].map(Polynomial::variable);
    // √2 from above.
    let root_of_two = n(92_682.0 / 65_536.0);
    assert!((root_of_two.squared() - n(2.0)).is_never_negative());
    let upper = n(1.0 + U) * k.clone() + beta() * root_of_two * o.clone();
    let off = upper.squared() * (n(1.0) + n(THREE_U)) - k.squared() + n(THREE_U) * r.squared();
    let promised =
        n(8.0 * U) * (r.squared() + k.squared() + k.clone() * o.clone() + n(2.0 * U) * o.squared());
    assert!((promised.clone() - off).is_never_negative());

    // A root: 9u‖o‖ + 6ur + E/s, times s ≤ r, with K ≤ r in E.
    let e = n(8.0 * U) * (n(2.0) * r.squared() + r.clone() * o.clone() + n(2.0 * U) * o.squared());
    let error = (n(9.0 * U) * o.clone() + n(6.0 * U) * r.clone()) * r.clone() + e;
    let promised = n(32.0 * U) * (o.clone() * r.clone() + r.squared() + n(U) * o.squared());
    assert!((promised - error).is_never_negative());
}
