//! A pixel's question in numbers that a person can work with: rounded to few decimals, and then
//! answered without any rounding.

use super::decimal::{DecimalFraction, MOST_PLACES, WrittenNumber, power_of_ten, ratio};
use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Place};

/// A ray and a sphere in decimals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PaperQuestion {
    pub origin: [DecimalFraction; 3],
    pub direction: [DecimalFraction; 3],
    pub center: [DecimalFraction; 3],
    pub radius: DecimalFraction,
    /// Whether these are the pixel's own numbers, none of them rounded.
    pub own: bool,
}

/// The quadratic of a question, and what it says.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaperAnswers {
    pub o: [DecimalFraction; 3],
    pub a: DecimalFraction,
    pub b: DecimalFraction,
    pub c: DecimalFraction,
    pub discriminant: DecimalFraction,
    pub class: Class,
    pub place: Option<Place>,
    /// The near and the far root, if there are any.
    pub roots: Option<[WrittenNumber; 2]>,
    /// −B/2A, where the line comes closest to the centre.
    pub closest: WrittenNumber,
}

/// How far a component of d may be moved by rounding, as a part of the greatest.
const MOVED: f64 = 0.01;
/// The most digits behind the point of a number of the scene that is left as it is.
const OWN_PLACES: u32 = 3;

impl PaperQuestion {
    /// The question of a ray and a sphere in the fewest decimals that keep its answer: class, place,
    /// and the direction to one part in a hundred. None if that takes more than six.
    pub fn new(ray: &Ray, sphere: &Sphere, class: Class, place: Option<Place>) -> Option<Self> {
        (0..=MOST_PLACES)
            .filter_map(|places| Self::rounded(ray, sphere, places))
            .find(|question| {
                let greatest = ray.direction.abs().max_element();
                let moved = question
                    .direction
                    .iter()
                    .zip(ray.direction.to_array())
                    .map(|(rounded, own)| (rounded.value() - f64::from(own)).abs())
                    .fold(0.0, f64::max);
                moved <= MOVED * f64::from(greatest)
                    && question
                        .answers()
                        .is_some_and(|found| found.class == class && found.place == place)
            })
    }

    fn rounded(ray: &Ray, sphere: &Sphere, places: u32) -> Option<Self> {
        let [origin, direction, center] =
            [ray.origin, ray.direction, sphere.center].map(|v| v.to_array());
        let most = |numbers: &[f32]| {
            let each = numbers.iter().map(|&x| DecimalFraction::places_of(x));
            each.max().unwrap_or(0)
        };
        let at = most(&[&origin[..], &center, &[sphere.radius]].concat());
        let position = if at <= OWN_PLACES { at } else { places };
        let ahead = most(&direction).min(places);
        let three = |v: [f32; 3], places| {
            let [x, y, z] = v.map(|x| DecimalFraction::of(x, places));
            Some([x?, y?, z?])
        };
        let question = Self {
            origin: three(origin, position)?,
            direction: three(direction, ahead)?,
            center: three(center, position)?,
            radius: DecimalFraction::of(sphere.radius, position)?,
            own: at <= position && most(&direction) <= places,
        };
        let moves = question.direction.iter().any(|x| x.units != 0);
        (moves && (question.radius.units > 0 || sphere.radius == 0.0)).then_some(question)
    }

    /// The answer in whole numbers; none where they grow too long.
    pub fn answers(&self) -> Option<PaperAnswers> {
        let d = self.direction.map(|x| x.units);
        let o = [0, 1, 2].map(|i| self.origin[i].units - self.center[i].units);
        let [ahead, position] = [self.direction[0].places, self.radius.places];
        let r = self.radius.units;
        let a = dot(d, d)?;
        let b = dot(d, o)?.checked_mul(2)?;
        let c = dot(o, o)?.checked_sub(r.checked_mul(r)?)?;
        let discriminant = b
            .checked_mul(b)?
            .checked_sub(a.checked_mul(c)?.checked_mul(4)?)?;

        let class = match discriminant.signum() {
            -1 => Class::Miss,
            0 => Class::Tangent,
            _ => Class::Secant,
        };
        // The signs of the roots are those of their sum and product.
        let place = class.meets().then(|| match (c.signum(), b.signum()) {
            (1, -1) => Place::Hit,
            (-1, _) | (0, -1) => Place::Inside,
            _ => Place::Behind,
        });
        let decimal = |units, places| DecimalFraction { units, places };
        Some(PaperAnswers {
            o: o.map(|x| decimal(x, position)),
            a: decimal(a, 2 * ahead),
            b: decimal(b, ahead + position),
            c: decimal(c, 2 * position),
            discriminant: decimal(discriminant, 2 * (ahead + position)),
            class,
            place,
            roots: class
                .meets()
                .then(|| roots(a, b, c, discriminant, ahead, position)),
            closest: scaled(-b, a.checked_mul(2)?, ahead, position),
        })
    }
}

fn dot(u: [i128; 3], v: [i128; 3]) -> Option<i128> {
    (0..3).try_fold(0_i128, |sum, i| sum.checked_add(u[i].checked_mul(v[i])?))
}

/// (numerator/denominator)·10^(ahead − position): a t, whose units are those of positions over those
/// of directions.
fn scaled(numerator: i128, denominator: i128, ahead: u32, position: u32) -> WrittenNumber {
    let [up, down] = [ahead, position].map(power_of_ten);
    let both = (numerator.checked_mul(up), denominator.checked_mul(down));
    match both {
        (Some(numerator), Some(denominator)) => WrittenNumber::quotient(numerator, denominator),
        _ => WrittenNumber::Near(ratio(numerator, denominator) * ratio(up, down)),
    }
}

fn roots(
    a: i128,
    b: i128,
    c: i128,
    discriminant: i128,
    ahead: u32,
    position: u32,
) -> [WrittenNumber; 2] {
    let root = discriminant.unsigned_abs().isqrt() as i128;
    if root * root == discriminant {
        return [-root, root].map(|root| scaled(root - b, 2 * a, ahead, position));
    }
    // Of the two sums −B ± √Δ, the one that does not cancel gives one root, C over it the other.
    let b = b as f64;
    let q = -0.5 * (b + (discriminant as f64).sqrt().copysign(b));
    let [one, other] = [q / a as f64, c as f64 / q]
        .map(|t| WrittenNumber::Near(t * ratio(power_of_ten(ahead), power_of_ten(position))));
    if one.value() < other.value() {
        [one, other]
    } else {
        [other, one]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use proptest::prelude::*;

    use crate::method::Method;

    fn question_in(x: [i16; 10], places: [u32; 2]) -> PaperQuestion {
        let at = |i: usize, places| DecimalFraction {
            units: x[i].into(),
            places,
        };
        let three = |i: usize, places| [0, 1, 2].map(|j| at(i + j, places));
        let radius = at(9, places[1]);
        PaperQuestion {
            origin: three(0, places[1]),
            direction: three(3, places[0]),
            center: three(6, places[1]),
            radius: DecimalFraction {
                units: radius.units.abs(),
                ..radius
            },
            own: true,
        }
    }

    proptest! {
        /// In whole numbers, which binary32 holds, the program gives the answer of the sheet.
        #[test]
        fn the_answers_are_those_of_exact(
            x in prop_oneof![
                prop::array::uniform10(-12_i16..=12),
                prop::array::uniform10(-2000_i16..=2000),
            ],
            places in [0..=3_u32, 0..=3_u32],
        ) {
            let whole = |v: [DecimalFraction; 3]| Vec3::from(v.map(|x| x.units as f32));
            let question = question_in(x, places);
            let ray = Ray::new(whole(question.origin), whole(question.direction));
            prop_assume!(ray.is_ok());
            let sphere = Sphere::new(whole(question.center), question.radius.units as f32);
            let found = Method::Exact.solve(&ray.unwrap(), &sphere.unwrap());
            let answers = question.answers().unwrap();
            prop_assert_eq!(answers.class, found.class);
            prop_assert_eq!(answers.place, found.place());
            if let Some([near, far]) = answers.roots {
                let unit = ratio(power_of_ten(places[0]), power_of_ten(places[1]));
                for (answer, root) in [(near, found.near), (far, found.far)] {
                    let (answer, root) = (answer.value(), f64::from(root) * unit);
                    prop_assert!((answer - root).abs() <= 1e-7 * root.abs(), "{answer} {root}");
                }
            }
        }
    }

    fn question(p0: [f32; 3], d: [f32; 3], c: [f32; 3], r: f32) -> PaperQuestion {
        let ray = Ray::new(p0.into(), d.into()).unwrap();
        let sphere = Sphere::new(Vec3::from(c), r).unwrap();
        let found = Method::Exact.solve(&ray, &sphere);
        PaperQuestion::new(&ray, &sphere, found.class, found.place()).unwrap()
    }

    #[test]
    fn the_tutorials_pixel_is_taken_as_it_is() {
        let question = question([20.0, 20.0, 0.0], [0.0, 0.0, 1.0], [20.0; 3], 10.0);
        assert!(question.own);
        let answers = question.answers().unwrap();
        let text =
            [answers.a, answers.b, answers.c, answers.discriminant].map(DecimalFraction::text);
        assert_eq!(text, ["1", "−40", "300", "400"]);
        let roots = answers.roots.unwrap().map(WrittenNumber::equation);
        assert_eq!(roots, ["= 10", "= 30"]);
        assert_eq!(answers.place, Some(Place::Hit));
    }

    #[test]
    fn a_slanted_ray_is_rounded_and_then_answered_without_rounding() {
        let question = question(
            [0.0, 1.5, 9.0],
            [0.007_643_267, -0.179_477_5, -0.983_880_8],
            [-0.75, 0.0, 0.5],
            1.25,
        );
        assert!(!question.own);
        assert_eq!(
            question.direction.map(DecimalFraction::text),
            ["0.01", "−0.18", "−0.98"]
        );
        let answers = question.answers().unwrap();
        assert_eq!(answers.a.equation(), "= 0.9929");
        assert_eq!(answers.b.equation(), "= −17.185");
        assert_eq!(answers.c.equation(), "= 73.5");
        assert_eq!(answers.discriminant.equation(), "= 3.411625");
        let near = answers.roots.unwrap()[0].value();
        assert!((near - 7.72).abs() < 0.01, "{near}");
    }
}
