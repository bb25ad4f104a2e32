//! The quadratic of a ray and a sphere, worked exactly, and each of its numbers written once: with as
//! many digits as it takes for the next to come out of them.

use super::super::equation::{Expression, Sign, Written, sum_of};
use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Dyadic, Surd, Truth};

/// The numbers of one ray and one sphere, exactly and as they are written.
#[derive(Debug, Clone)]
pub(in crate::explain) struct WorkedQuadratic {
    pub truth: Truth,
    /// p0, d, c.
    pub given: [[Written; 3]; 3],
    pub r: Written,
    /// The same, exactly.
    inputs: [[Surd; 3]; 3],
    radius: Surd,
    /// p0 − c, exactly and as it is written.
    pub o: [Surd; 3],
    pub written_o: [Written; 3],
    pub a: Written,
    pub b: Written,
    pub c: Written,
    pub delta: Written,
    /// B² and 4AC, whose difference, as they are written, is Δ as it is written.
    pub ledger: Option<Vec<Written>>,
    /// What is printed for the roots, near and far, and how it is joined to them.
    pub roots: Option<[WorkedRoot; 2]>,
}

/// A root: the expression that it comes out of, and the number.
#[derive(Debug, Clone)]
pub(in crate::explain) struct WorkedRoot {
    pub exact: Surd,
    /// The formula with the numbers; none where no reasonable number of digits would do.
    pub expression: Option<(Expression, Sign)>,
    pub written: Written,
}

/// Digits that are tried, from few to many.
const DIGITS: [usize; 14] = [6, 7, 8, 9, 10, 12, 14, 17, 20, 24, 30, 40, 52, 64];
/// The digits that a result has at least, where it is rounded.
const LEAST: usize = 4;
/// Inputs are not written with more digits than these, unless all are asked for.
const INPUT: usize = 9;
/// A result is not written with more digits than these where fewer will do.
const USUAL: usize = 6;

impl WorkedQuadratic {
    /// Works the quadratic; with numbers in full if `in_full`, else with as few digits as will do.
    pub fn new(ray: &Ray, sphere: &Sphere, in_full: bool) -> Self {
        let truth = Truth::new(ray, sphere);
        let tried = DIGITS.iter().copied().filter(|&n| !in_full || n >= 40);
        let worked = tried.map(|digits| Self::written(ray, sphere, &truth, digits));
        let mut last = None;
        for worked in worked {
            if worked.is_balanced() {
                return worked;
            }
            last = Some(worked);
        }
        last.unwrap_or_else(|| Self::written(ray, sphere, &truth, USUAL))
    }

    /// Whether each number comes out of those before it as they are written.
    fn is_balanced(&self) -> bool {
        let joined = |roots: &[WorkedRoot; 2]| roots.iter().all(|r| r.expression.is_some());
        self.ledger.is_some()
            && self.delta_of_letters().relation(&self.delta).is_some()
            && self.roots.as_ref().is_none_or(joined)
    }

    fn written(ray: &Ray, sphere: &Sphere, truth: &Truth, digits: usize) -> Self {
        let exact = |v: glam::Vec3| v.to_array().map(|x| Surd::from(Dyadic::from(x)));
        let of_input = digits.min(if digits < 40 { INPUT } else { digits });
        let written = |v: &[Surd; 3]| v.each_ref().map(|x| Written::of(x, of_input));
        let [p0, d, center] = [ray.origin, ray.direction, sphere.center].map(exact);
        let o = [0, 1, 2].map(|i| {
            p0[i]
                .checked_sub(&center[i])
                .unwrap_or_else(|| p0[i].clone())
        });
        let given = [&p0, &d, &center].map(written);
        let radius = Surd::from(Dyadic::from(sphere.radius));
        let r = Written::of(&radius, digits);
        let number = |x: &Dyadic| Written::of(&x.clone().into(), digits);
        let mut worked = Self {
            written_o: [0, 1, 2].map(|i| component(&given[0][i], &given[2][i], &o[i], digits)),
            inputs: [p0, d, center],
            radius,
            given,
            r,
            o,
            a: number(&truth.a),
            b: number(&truth.b()),
            c: number(&truth.c),
            delta: number(&truth.discriminant()),
            ledger: None,
            roots: None,
            truth: truth.clone(),
        };
        // With fewer digits of Δ than of A, B and C it comes out of them more surely.
        let most = digits.min(USUAL).max(digits.saturating_sub(2));
        let whole = Written::in_full(&truth.discriminant().into(), digits.max(8));
        let rounded = (LEAST..=most).rev();
        let rounded = rounded.map(|n| Written::rounded(&truth.discriminant().into(), n));
        for delta in whole.into_iter().chain(rounded) {
            worked.delta = delta;
            worked.ledger = worked.ledger_of_delta();
            worked.roots = worked.worked_roots();
            if worked.is_balanced() {
                break;
            }
        }
        worked
    }

    /// p0, exactly.
    pub fn origin(&self) -> [Surd; 3] {
        self.inputs[0].clone()
    }

    /// d, exactly.
    pub fn direction(&self) -> [Surd; 3] {
        self.inputs[1].clone()
    }

    /// c, exactly.
    pub fn center(&self) -> [Surd; 3] {
        self.inputs[2].clone()
    }

    /// r, exactly.
    pub fn radius(&self) -> Surd {
        self.radius.clone()
    }

    /// B² − 4·A·C in numbers.
    pub fn delta_of_letters(&self) -> Expression {
        let [a, b, c] = [&self.a, &self.b, &self.c].map(Expression::number);
        b.squared().minus(&Expression::whole(4).times(&a).times(&c))
    }

    /// B² and 4AC.
    pub fn squares(&self) -> [Surd; 2] {
        let four_ac = (&self.truth.a * &self.truth.c).shifted(2);
        [self.truth.b().squared(), four_ac].map(Surd::from)
    }

    fn ledger_of_delta(&self) -> Option<Vec<Written>> {
        let [bb, four_ac] = self.squares();
        let mut terms = sum_of(&[bb, -four_ac], &self.delta, self.delta.places())?;
        terms[1] = Written::negated(&terms[1]);
        Some(terms)
    }

    fn worked_roots(&self) -> Option<[WorkedRoot; 2]> {
        let roots = [self.truth.near()?, self.truth.far()?];
        let [a, delta] = [&self.a, &self.delta].map(Expression::number);
        let below = Expression::whole(2).times(&a);
        let minus_b = Expression::number(&Written::negated(&self.b));
        let above = match self.truth.class() {
            Class::Tangent => [minus_b.clone(), minus_b],
            _ => [minus_b.minus(&delta.root()), minus_b.plus(&delta.root())],
        };
        let mut above = above.into_iter();
        Some(roots.map(|exact| {
            let expression = above.next().map(|above| above.over(&below));
            let joined = expression.and_then(|expression| {
                let (sign, written) = expression.result(&exact, USUAL, LEAST)?;
                Some((expression, sign, written))
            });
            match joined {
                Some((expression, sign, written)) => WorkedRoot {
                    exact,
                    expression: Some((expression, sign)),
                    written,
                },
                None => WorkedRoot {
                    written: Written::of(&exact, USUAL),
                    exact,
                    expression: None,
                },
            }
        }))
    }
}

/// A component of p0 − c, which comes out of those of p0 and c as they are written.
fn component(p0: &Written, c: &Written, exact: &Surd, digits: usize) -> Written {
    let difference = Expression::number(p0).minus(&Expression::number(c));
    let joined = difference.result(exact, digits, 1);
    joined.map_or_else(|| Written::of(exact, digits), |(_, written)| written)
}
