//! Rays and spheres: plain data in binary32, checked where it comes in.
//!
//! Nothing is computed here but sums and products of vectors. The quadratic lives in [`crate::method`].

pub mod vector;

use std::fmt;

use glam::Vec3;

/// The ray p(t) = origin + t·direction.
///
/// The direction need not be of unit length; t counts in lengths of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// p0, the point at t = 0.
    pub origin: Vec3,
    /// d, the step that one unit of t makes.
    pub direction: Vec3,
}

impl Ray {
    /// A ray of finite numbers whose direction is not zero; anything else is refused by name.
    pub fn new(origin: Vec3, direction: Vec3) -> Result<Self, Invalid> {
        finite_vector("p0", origin)?;
        finite_vector("d", direction)?;
        if direction == Vec3::ZERO {
            return Err(Invalid::new("d", "0,0,0", "a direction other than zero"));
        }
        Ok(Self { origin, direction })
    }

    /// The point at parameter t, in binary32.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.direction
    }
}

/// All points at distance `radius` from `center`; a radius of zero is a single point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// c, the centre.
    pub center: Vec3,
    /// r, at least zero.
    pub radius: f32,
}

impl Sphere {
    /// A sphere of finite numbers whose radius is not negative; anything else is refused by name.
    pub fn new(center: Vec3, radius: f32) -> Result<Self, Invalid> {
        finite_vector("c", center)?;
        finite("r", radius)?;
        if radius < 0.0 {
            return Err(Invalid::new(
                "r",
                Decimal(radius),
                "a radius of zero or more",
            ));
        }
        // −0 is accepted as the zero it equals, and kept out of everything that prints.
        Ok(Self {
            center,
            radius: radius + 0.0,
        })
    }
}

/// The shortest decimal that reads back as the same binary32, as scene files and people spell it: very
/// large and very small numbers have an exponent.
#[derive(Debug, Clone, Copy)]
pub struct Decimal(pub f32);

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Readers of TOML need not accept integers from 2⁶³ on; zeros before that are no help.
        const PLAIN: std::ops::Range<f32> = 1e-5..1e15;
        let value = self.0;
        if value == 0.0 && value.is_sign_negative() {
            // As an integer, −0 would lose its sign.
            write!(f, "-0.0")
        } else if value == 0.0 || PLAIN.contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

/// Such decimals in square brackets.
#[derive(Debug, Clone, Copy)]
pub struct List<const N: usize>(pub [f32; N]);

impl<const N: usize> fmt::Display for List<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, &component) in self.0.iter().enumerate() {
            let before = if n == 0 { "[" } else { ", " };
            write!(f, "{before}{}", Decimal(component))?;
        }
        write!(f, "]")
    }
}

/// Why a number was refused: which one, what it was, what was expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Invalid {
    /// The quantity, in the words of the screen: `d`, `c.x`, `r`.
    pub field: String,
    /// What was found.
    pub found: String,
    /// What would have been right, as a noun phrase.
    pub expected: &'static str,
}

impl Invalid {
    /// A refusal of the value `found` of the quantity `field`.
    pub fn new(field: impl Into<String>, found: impl fmt::Display, expected: &'static str) -> Self {
        Self {
            field: field.into(),
            found: found.to_string(),
            expected,
        }
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            field,
            found,
            expected,
        } = self;
        write!(f, "{field} is {found}: expected {expected}")
    }
}

impl std::error::Error for Invalid {}

fn finite(field: &str, value: f32) -> Result<(), Invalid> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Invalid::new(field, Decimal(value), "a finite number"))
    }
}

fn finite_vector(name: &str, v: Vec3) -> Result<(), Invalid> {
    if v.is_finite() {
        return Ok(());
    }
    for (axis, value) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
        finite(&format!("{name}.{axis}"), value)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_short_and_plain_where_that_is_short() {
        for (value, text) in [
            (10.0, "10"),
            (-0.1, "-0.1"),
            (16_777_216.0, "16777216"),
            (0.0, "0"),
            (-0.0, "-0.0"),
            (1e-5, "0.00001"),
            (1e-7, "1e-7"),
            (1e30, "1e30"),
            (-f32::MAX, "-3.4028235e38"),
            (f32::from_bits(1), "1e-45"),
        ] {
            assert_eq!(Decimal(value).to_string(), text);
        }
    }

    #[test]
    fn refuses_what_is_no_ray_or_sphere_by_name() {
        let nan = Vec3::new(0.0, f32::NAN, 0.0);
        let said = |r: Result<Ray, Invalid>| r.unwrap_err().to_string();
        assert_eq!(
            said(Ray::new(nan, Vec3::X)),
            "p0.y is NaN: expected a finite number"
        );
        assert_eq!(
            said(Ray::new(Vec3::ZERO, Vec3::ZERO)),
            "d is 0,0,0: expected a direction other than zero"
        );
        assert_eq!(
            Sphere::new(Vec3::ZERO, -1.0).unwrap_err().to_string(),
            "r is -1: expected a radius of zero or more"
        );
    }

    #[test]
    fn the_parametric_example_of_the_tutorial() {
        let ray = Ray::new(Vec3::ZERO, Vec3::new(2.0, 5.0, 7.0)).unwrap();
        let points = [1.0, 2.0, 3.0, 4.0].map(|t| ray.at(t).to_array());
        assert_eq!(
            points,
            [
                [2.0, 5.0, 7.0],
                [4.0, 10.0, 14.0],
                [6.0, 15.0, 21.0],
                [8.0, 20.0, 28.0]
            ]
        );
    }
}
