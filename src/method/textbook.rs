//! The textbook formula in binary32, operation for operation as in the tutorial's
//! `intersectRaySphere`, and the roots that the tutorial leaves to its reader.

use super::number::{Input, Number, dot, sub};
use super::tape::Tape;
use super::trace::{self, Line, Step, Steps};
use super::truth::Truth;
use super::{Class, Coefficients, Precision, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic<T> {
    o: [T; 3],
    a: T,
    b: T,
    oo: T,
    rr: T,
    c: T,
    bb: T,
    four_ac: T,
    discriminant: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let Input { p0, d, center, r } = *input;
    let [two, four] = [2.0, 4.0].map(T::constant);

    let o = sub(p0, center);
    let a = dot(d, d);
    let b = two * dot(d, o);
    let oo = dot(o, o);
    let rr = r * r;
    let c = oo - rr;
    let bb = b * b;
    let four_ac = four * a * c;
    let discriminant = bb - four_ac;
    Quadratic {
        o,
        a,
        b,
        oo,
        rr,
        c,
        bb,
        four_ac,
        discriminant,
    }
}

/// √Δ and the two roots.
struct Roots<T> {
    root: T,
    near: T,
    far: T,
}

#[inline]
fn roots<T: Number>(a: T, b: T, discriminant: T) -> Roots<T> {
    let two = T::constant(2.0);
    let root = discriminant.sqrt();
    let near = (-b - root) / (two * a);
    let far = (-b + root) / (two * a);
    Roots { root, near, far }
}

/// Class and roots by (−B ± √Δ) / 2A.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic {
        a, b, discriminant, ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    let class = Class::of_discriminant(discriminant.into());
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let Roots { near, far, .. } = roots(a, b, discriminant);
    Solution::with_roots(class, near, far)
}

/// A, B, C and Δ in binary32.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic {
        a,
        b,
        c,
        discriminant,
        ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    Coefficients {
        precision: Precision::Binary32,
        a: a.into(),
        b: b.into(),
        c: c.into(),
        discriminant: discriminant.into(),
    }
}

/// The derivation, by the same code over a number that keeps record.
pub(super) fn steps(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<Step> {
    let tape = Tape::default();
    let input = Input::new(ray, sphere, |x| tape.input(x));
    let mut steps = Steps::new(&tape, &input);
    let quadratic = quadratic(&input);
    steps.vector(trace::O, quadratic.o);
    steps.scalar(trace::A, quadratic.a);
    steps.scalar(
        Line {
            symbol: "B",
            formula: "2 d·o",
            template: "2·({d.x}·{o.x} + {d.y}·{o.y} + {d.z}·{o.z})",
            code: "let b = two * dot(d, o);",
            why: "What multiplies t: below 0 if the ray comes nearer to the centre as it starts.",
        },
        quadratic.b,
    );
    steps.scalar(trace::OO, quadratic.oo);
    steps.scalar(trace::RR, quadratic.rr);
    steps.scalar(trace::C, quadratic.c);
    steps.scalar(
        Line {
            symbol: "B²",
            formula: "B·B",
            template: "{B}²",
            code: "let bb = b * b;",
            why: "The first half of the discriminant.",
        },
        quadratic.bb,
    );
    steps.scalar(
        Line {
            symbol: "4AC",
            formula: "4·A·C",
            template: "4·{A}·{C}",
            code: "let four_ac = four * a * c;",
            why: "The second half: below 0 if the ray starts inside.",
        },
        quadratic.four_ac,
    );
    steps.scalar(
        Line {
            symbol: "Δ",
            formula: "B² − 4AC",
            template: "{B²} − {4AC}",
            code: "let discriminant = bb - four_ac;",
            why: "The discriminant: below 0 a miss, 0 a single point, above 0 two points.",
        },
        quadratic.discriminant,
    );
    if Class::of_discriminant(quadratic.discriminant.value().into()).meets() {
        let roots = roots(quadratic.a, quadratic.b, quadratic.discriminant);
        steps.scalar(
            Line {
                symbol: "√Δ",
                formula: "√Δ",
                template: "√{Δ}",
                code: "let root = discriminant.sqrt();",
                why: "Real only because Δ is not below 0.",
            },
            roots.root,
        );
        steps.root(
            Line {
                symbol: "near",
                formula: "(−B − √Δ) / 2A",
                template: "(−{B} − {√Δ}) / (2·{A})",
                code: "let near = (-b - root) / (two * a);",
                why: "The smaller root: where the line enters the sphere.",
            },
            roots.near,
            truth.near(),
        );
        steps.root(
            Line {
                symbol: "far",
                formula: "(−B + √Δ) / 2A",
                template: "(−{B} + {√Δ}) / (2·{A})",
                code: "let far = (-b + root) / (two * a);",
                why: "The larger root: where the line leaves the sphere.",
            },
            roots.far,
            truth.far(),
        );
    }
    steps.finish()
}
