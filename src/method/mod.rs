//! The quadratic At² + Bt + C = 0, and the ways to evaluate it in floating point.
//!
//! The rest of the program asks a [`Method`] and gets a [`Solution`]. The renderer alone also has a
//! test of its own, which decides only what `exact` is proven to say. Each method has a file of its own.

mod ball;
pub mod batch;
mod citardauq;
mod contracted;
mod double;
mod dyadic;
pub mod exact;
pub mod format;
mod formula;
mod haines;
mod kahan;
mod number;
mod order;
mod q_form;
#[cfg(not(feature = "routine"))]
#[path = "no_routine.rs"]
mod routine;
#[cfg(feature = "routine")]
mod routine;
pub(crate) mod simd;
pub mod source;
pub mod statement;
mod surd;
mod tape;
mod textbook;
pub mod trace;
mod truth;
mod unit;

pub use dyadic::Dyadic;
#[cfg(feature = "routine")]
pub use routine::LearntRoutine;
pub use routine::RoutineId;
pub use surd::{DecimalDigits, Surd};
pub use trace::Trace;
pub use truth::{Truth, bits_lost, root_bits_lost, ulp_error};

use std::cmp::Ordering;
use std::fmt;
use std::path::Path;

use crate::door::FileError;
use crate::geometry::{Ray, Sphere};
use citardauq::Citardauq;
use contracted::Contracted;
use double::Double;
use haines::Haines;
use kahan::Kahan;
use textbook::Textbook;
use unit::Unit;

/// One way to evaluate the quadratic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Method {
    /// B² − 4AC and (−B ± √Δ)/2A in binary32, operation for operation as in the tutorial.
    Textbook,
    /// The same with the products fused that compilers fuse by default where they can.
    Contracted,
    /// b² − C and −b ± √D in binary32, which takes d to be of length 1.
    Unit,
    /// b² − AC with b = B/2, and the q-form's roots q/A and C/q, in binary32.
    Citardauq,
    /// r² − ‖o − (b/A)d‖², the perpendicular form, and the q-form's roots, in binary32.
    Haines,
    /// b² − AC by fused multiply-adds, and the q-form's roots, in binary32.
    Kahan,
    /// A r² − ‖o × d‖², Lagrange's identity, and the q-form's roots, in binary64 inside.
    Double,
    /// The exact class, and both roots rounded once, by as many stages as the ray needs.
    #[default]
    Exact,
    /// One's own, from a file.
    Routine(RoutineId),
}

impl Method {
    /// All methods that are built in, in the order in which lists show them.
    pub const ALL: [Self; 8] = [
        Self::Textbook,
        Self::Contracted,
        Self::Unit,
        Self::Citardauq,
        Self::Haines,
        Self::Kahan,
        Self::Double,
        Self::Exact,
    ];

    /// The name on the command line, in files and on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Routine(id) => id.name(),
            Self::Textbook => "textbook",
            Self::Contracted => "contracted",
            Self::Unit => "unit",
            Self::Citardauq => "citardauq",
            Self::Haines => "haines",
            Self::Kahan => "kahan",
            Self::Double => "double",
            Self::Exact => "exact",
        }
    }

    /// The built-in method of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.name() == name)
    }

    /// Whether a name is that of a file, not of a built-in method: it has a dot or a slash in it.
    pub fn is_file(name: &str) -> bool {
        name.contains(['.', '/'])
    }

    /// From now on the routines that [`Self::load`] reads have their products fused into sums, as compilers do unasked
    /// for processors with fused multiply-adds; unless a text says otherwise.
    #[cfg(feature = "routine")]
    pub fn contract_routines() {
        routine::contract();
    }

    /// The routine in a file, under that name.
    pub fn load(name: &str, path: &Path) -> Result<Self, FileError> {
        RoutineId::load(name, path).map(Self::Routine)
    }

    /// Where the line of `ray` meets `sphere`.
    #[expect(
        clippy::inline_always,
        reason = "a method that is known where it is called is then its formula alone; left to the compiler it is a call of \
                  all of them, and `textbook` takes three times as long"
    )]
    #[inline(always)]
    pub fn solve(self, ray: &Ray, sphere: &Sphere) -> Solution {
        match self {
            Self::Textbook => formula::solve::<Textbook>(ray, sphere),
            Self::Contracted => formula::solve_fused::<Contracted>(ray, sphere),
            Self::Unit => formula::solve::<Unit>(ray, sphere),
            Self::Citardauq => formula::solve::<Citardauq>(ray, sphere),
            Self::Haines => formula::solve::<Haines>(ray, sphere),
            Self::Kahan => formula::solve::<Kahan>(ray, sphere),
            Self::Double => formula::solve::<Double>(ray, sphere),
            Self::Exact => exact::solve(ray, sphere),
            Self::Routine(id) => id.solve(ray, sphere),
        }
    }

    /// A, B, C and Δ as this method's own arithmetic has them; a routine names none, and those of `double` stand
    /// for them.
    pub fn coefficients(self, ray: &Ray, sphere: &Sphere) -> Coefficients {
        match self {
            Self::Textbook => formula::coefficients::<Textbook>(ray, sphere),
            Self::Contracted => formula::coefficients::<Contracted>(ray, sphere),
            Self::Unit => formula::coefficients::<Unit>(ray, sphere),
            Self::Citardauq => formula::coefficients::<Citardauq>(ray, sphere),
            Self::Haines => formula::coefficients::<Haines>(ray, sphere),
            Self::Kahan => formula::coefficients::<Kahan>(ray, sphere),
            Self::Double | Self::Routine(_) => formula::coefficients::<Double>(ray, sphere),
            Self::Exact => exact::coefficients(ray, sphere),
        }
    }

    /// The routine in a text that came with the program, under that name.
    pub fn with_text(name: &str, text: &str) -> Result<Self, FileError> {
        RoutineId::with_text(name, text).map(Self::Routine)
    }

    /// How this method comes to its answer, step by step, beside what is exact.
    pub fn trace(self, ray: &Ray, sphere: &Sphere) -> Trace {
        Trace::new(self, ray, sphere)
    }

    /// Whether it is somebody's own.
    pub const fn is_routine(self) -> bool {
        matches!(self, Self::Routine(_))
    }

    /// Whether it is a routine that gives one t, or no more than hit or miss: what lies behind the eye may then be
    /// none of either.
    pub fn gives_one_at_most(self) -> bool {
        match self {
            Self::Routine(id) => id.gives_one_at_most(),
            _ => false,
        }
    }

    fn steps(self, ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<trace::TraceStep> {
        match self {
            Self::Textbook => formula::steps::<Textbook>(ray, sphere, truth),
            Self::Contracted => formula::steps::<Contracted>(ray, sphere, truth),
            Self::Unit => formula::steps::<Unit>(ray, sphere, truth),
            Self::Citardauq => formula::steps::<Citardauq>(ray, sphere, truth),
            Self::Haines => formula::steps::<Haines>(ray, sphere, truth),
            Self::Kahan => formula::steps::<Kahan>(ray, sphere, truth),
            Self::Double => formula::steps::<Double>(ray, sphere, truth),
            Self::Exact => trace::exact::steps(ray, sphere, truth),
            Self::Routine(id) => trace::routine::steps(id, ray, sphere, truth),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What the sign of Δ says of the whole line, not only of the part before the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// Δ < 0: no point in common.
    Miss,
    /// Δ = 0: the line touches the sphere in one point.
    Tangent,
    /// Δ > 0: the line crosses the sphere in two points.
    Secant,
    /// The line meets the sphere; in how many points, a routine need not say.
    Hit,
    /// The method's discriminant is not a number, so it has no answer.
    Nan,
}

impl Class {
    /// The class that the sign of a discriminant gives.
    pub fn of_discriminant(discriminant: f64) -> Self {
        if discriminant < 0.0 {
            Self::Miss
        } else if discriminant == 0.0 {
            Self::Tangent
        } else if discriminant > 0.0 {
            Self::Secant
        } else {
            Self::Nan
        }
    }

    /// The word on the screen and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Miss => "miss",
            Self::Tangent => "tangent",
            Self::Secant => "secant",
            Self::Hit => "hit",
            Self::Nan => "nan",
        }
    }

    /// Whether the line has a point in common with the sphere; a tangent has.
    pub const fn meets(self) -> bool {
        matches!(self, Self::Tangent | Self::Secant | Self::Hit)
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// One of the two roots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Which {
    /// The smaller.
    Near,
    /// The larger.
    Far,
}

impl Which {
    /// The sign that √D has in this root.
    const fn sign(self) -> f32 {
        match self {
            Self::Near => -1.0,
            Self::Far => 1.0,
        }
    }

    /// How this root compares with m, by the signs of the slope Am + b and the value Am² + 2bm + C
    /// there; none where the value is not known. The slope comes first: a value of 0 makes m this root
    /// only on this root's side of the vertex.
    fn compare(
        self,
        slope: Ordering,
        value: impl FnOnce() -> Option<Ordering>,
    ) -> Option<Ordering> {
        match self {
            Self::Near if slope.is_gt() => Some(Ordering::Less),
            Self::Near => value(),
            Self::Far if slope.is_lt() => Some(Ordering::Greater),
            Self::Far => Some(value()?.reverse()),
        }
    }
}

/// Where a sphere lies that the line meets, seen from the ray's start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Place {
    /// 0 < near: in front of the eye.
    Hit,
    /// near ≤ 0 < far: the eye is inside the sphere, or on it and looking in.
    Inside,
    /// far ≤ 0: the sphere is behind the eye; the line meets it, the ray does not.
    Behind,
}

impl Place {
    /// Where a sphere lies whose roots compare so with 0.
    #[inline]
    fn by_roots(near: f32, far: f32) -> Self {
        if near > 0.0 {
            Self::Hit
        } else if far > 0.0 {
            Self::Inside
        } else {
            Self::Behind
        }
    }

    /// The visible root of a sphere that lies so: the least t > 0.
    pub(crate) const fn visible_root(self) -> Option<Which> {
        match self {
            Self::Hit => Some(Which::Near),
            Self::Inside => Some(Which::Far),
            Self::Behind => None,
        }
    }

    /// The word on the screen and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hit => "hit",
            Self::Inside => "inside",
            Self::Behind => "behind",
        }
    }
}

/// What a method answers: the class and both roots in binary32.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Miss, tangent or secant of the line.
    pub class: Class,
    /// The smaller root t; NaN where there is none, ±∞ past the range of binary32.
    pub near: f32,
    /// The larger root t; equal to `near` for a tangent.
    pub far: f32,
    /// Where the sphere lies; a root that rounds to 0 need not be 0, so `exact` knows better than both.
    place: Option<Place>,
}

impl Solution {
    /// The answer that the line does not meet the sphere.
    pub const MISS: Self = Self::without_roots(Class::Miss);

    /// An answer of a class that has no roots.
    pub const fn without_roots(class: Class) -> Self {
        Self {
            class,
            near: f32::NAN,
            far: f32::NAN,
            place: None,
        }
    }

    /// No hit, of a routine that says nothing of what lies behind the eye.
    #[cfg(feature = "routine")]
    const UNSEEN: Self = Self {
        place: Some(Place::Behind),
        ..Self::MISS
    };

    /// An answer with both roots, which also say where the sphere lies; a root of −0 is given as the 0
    /// it equals.
    #[inline]
    pub fn with_roots(class: Class, near: f32, far: f32) -> Self {
        Self::placed(class, near, far, Place::by_roots(near, far))
    }

    /// An answer with both roots of a sphere that lies there.
    #[inline]
    fn placed(class: Class, near: f32, far: f32, place: Place) -> Self {
        Self {
            class,
            near: near + 0.0,
            far: far + 0.0,
            place: class.meets().then_some(place),
        }
    }

    /// Where the sphere lies, or nothing if the line misses it.
    pub const fn place(&self) -> Option<Place> {
        if self.class.meets() { self.place } else { None }
    }

    /// Whether it is no hit of a routine that gives one t at most: nothing is said of what lies behind the eye.
    pub fn tells_of_ray_alone(&self) -> bool {
        self.class == Class::Miss && self.place.is_some()
    }

    /// The visible root: the least t > 0.
    pub fn visible(&self) -> Option<f32> {
        if !self.class.meets() {
            return None;
        }
        match self.place? {
            // What says no more than that it hits is as far off as can be.
            Place::Hit if self.near.is_nan() => Some(f32::INFINITY),
            Place::Hit => Some(self.near),
            Place::Inside => Some(self.far),
            Place::Behind => None,
        }
    }
}

impl Solution {
    /// The least root between `from` and `to`, neither of them counted, as the roots are given; from 0 to ∞
    /// that is the visible root.
    pub fn visible_between(&self, from: f32, to: f32) -> Option<f32> {
        let place = self.place?;
        // A root that rounds to 0 may lie above it, which the place knows.
        let [near_ahead, far_ahead] = [place == Place::Hit, place != Place::Behind];
        let is_between = |t: f32, ahead: bool| {
            (if from == 0.0 { ahead } else { t > from }) && (t < to || to == f32::INFINITY)
        };
        if is_between(self.near, near_ahead) {
            Some(self.near)
        } else {
            is_between(self.far, far_ahead).then_some(self.far)
        }
    }
}

/// The precision in which a method holds its coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 24 bits.
    Binary32,
    /// 53 bits.
    Binary64,
}

impl Precision {
    /// Bits of the significand, the leading one counted.
    pub const fn bits(self) -> u32 {
        match self {
            Self::Binary32 => f32::MANTISSA_DIGITS,
            Self::Binary64 => f64::MANTISSA_DIGITS,
        }
    }

    /// What an error in units of the spacing is counted in: the field's word for binary32, and one
    /// that can't be taken for it for binary64.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Binary32 => "ulp",
            Self::Binary64 => "ulp64",
        }
    }

    /// What that unit is, in a few words.
    pub const fn unit_in_words(self) -> &'static str {
        match self {
            Self::Binary32 => "ulp: gap to the next binary32",
            Self::Binary64 => "ulp64: gap to the next binary64",
        }
    }

    /// log2 of the least subnormal number, which is the least spacing.
    pub const fn least_exponent(self) -> i32 {
        match self {
            Self::Binary32 => f32::MIN_EXP - f32::MANTISSA_DIGITS as i32,
            Self::Binary64 => f64::MIN_EXP - f64::MANTISSA_DIGITS as i32,
        }
    }

    /// log2 of the greatest spacing, that of the numbers just below the range's end.
    pub const fn greatest_exponent(self) -> i32 {
        match self {
            Self::Binary32 => f32::MAX_EXP - f32::MANTISSA_DIGITS as i32,
            Self::Binary64 => f64::MAX_EXP - f64::MANTISSA_DIGITS as i32,
        }
    }
}

/// A, B, C and Δ = B² − 4AC, each a number of the given precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// In which precision the four are held; binary32 values stand here exactly.
    pub precision: Precision,
    /// A = d·d.
    pub a: f64,
    /// B = 2 d·(p0 − c).
    pub b: f64,
    /// C = (p0 − c)·(p0 − c) − r².
    pub c: f64,
    /// Δ = B² − 4AC.
    pub discriminant: f64,
}
