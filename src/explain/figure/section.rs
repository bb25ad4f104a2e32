//! The plane through ray and centre, in numbers: lengths along the line, and heights away from it.
//!
//! The line lies flat and d points to the right; c is below it, or on it. Along the line, a place
//! is measured from an [`Anchor`], so that nothing cancels close to it: 1 m above a planet and 1e9
//! radii from a marble are then as exact as the middle of the tutorial's sphere.
//!
//! ```text
//!        p0 ───── near ──── foot ──── far ──▸       height 0
//!                    ╲  half │
//!                  radius    │ distance
//!                        ╲   │
//!                            c                      height −distance
//! ```

use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Dyadic, Surd, Truth};

/// A place on the line that others are measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// p0, t = 0.
    Start,
    /// The smaller root; the foot, if the line misses the sphere.
    Near,
    /// Where the line is closest to c: t = −B/2A.
    Foot,
    /// The larger root; the foot, if the line misses the sphere.
    Far,
}

/// A place on the line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LinePoint {
    /// One that has a name.
    At(Anchor),
    /// So many lengths from p0, in the direction of d.
    Along(f64),
}

/// The line and the circle that the sphere leaves in the plane through line and centre.
///
/// Computed exactly and rounded once to binary64; all are lengths in the scene's own unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// |d|: how far one unit of t reaches.
    pub speed: f64,
    /// r.
    pub radius: f64,
    /// From the line to c.
    pub distance: f64,
    /// From p0 to the foot.
    pub foot: f64,
    /// From p0 to the smaller root.
    pub near: f64,
    /// From p0 to the larger root.
    pub far: f64,
    /// √|r² − distance²|: half the chord; for a miss, the length of the tangent from the foot.
    pub half: f64,
    /// By the exact sign of Δ.
    pub class: Class,
}

impl Section {
    pub(super) fn new(ray: &Ray, sphere: &Sphere) -> Self {
        let truth = Truth::new(ray, sphere);
        let a = &truth.a;
        let d = &truth.quarter_discriminant;
        let r = Dyadic::from(sphere.radius);
        // Lagrange: A·r² − D = |(p0−c) × d|², and D/A = r² − distance².
        let cross_squared = &(a * &r.squared()) - d;
        let speed = root_of_quotient(a, &Dyadic::from(1.0));
        let t = |t: Option<Surd>| t.map_or(0.0, |t| t.to_f64());
        let middle = Surd::new(-truth.half_b.clone(), Dyadic::ZERO, Dyadic::ZERO, a.clone());
        let foot = t(middle) * speed;
        let meets = truth.class().meets();
        Self {
            speed,
            radius: sphere.radius.into(),
            distance: root_of_quotient(&cross_squared, a),
            foot,
            near: if meets { t(truth.near()) * speed } else { foot },
            far: if meets { t(truth.far()) * speed } else { foot },
            half: root_of_quotient(&d.clone().abs(), a),
            class: truth.class(),
        }
    }

    /// The root that is seen: the least beyond p0.
    pub(super) fn visible(&self) -> Option<Anchor> {
        if !self.class.meets() {
            None
        } else if self.near > 0.0 {
            Some(Anchor::Near)
        } else if self.far > 0.0 {
            Some(Anchor::Far)
        } else {
            None
        }
    }

    /// The root nearest to p0 but not at it.
    pub(super) fn nearest_root(&self) -> Option<Anchor> {
        let away = |&root: &Anchor| self.position(LinePoint::At(root)).abs();
        [Anchor::Near, Anchor::Far]
            .into_iter()
            .filter(|root| self.class.meets() && away(root) > 0.0)
            .min_by(|m, n| away(m).total_cmp(&away(n)))
    }

    /// r² − distance², which is D/A.
    fn half_squared(&self) -> f64 {
        match self.class {
            Class::Miss => -self.half * self.half,
            _ => self.half * self.half,
        }
    }

    /// r − distance: how deep the line dips into the circle, below zero for a miss.
    pub(super) fn depth(&self) -> f64 {
        divide(self.half_squared(), self.radius + self.distance)
    }

    /// From p0 to the surface, below zero inside.
    pub(super) fn altitude(&self) -> f64 {
        let power = self.power(Anchor::Start, 0.0);
        let from_center = self.foot.hypot(self.distance);
        divide(power, from_center + self.radius)
    }

    /// t of a place that has a name.
    pub(super) fn t(&self, anchor: Anchor) -> f64 {
        self.position(LinePoint::At(anchor)) / self.speed + 0.0
    }

    /// The place at t: one that has a name where it is at that very t, so that nothing is rounded
    /// there.
    pub(super) fn spot(&self, t: f64) -> LinePoint {
        [Anchor::Near, Anchor::Far, Anchor::Foot, Anchor::Start]
            .into_iter()
            .find(|&anchor| self.t(anchor).to_bits() == t.to_bits())
            .map_or(LinePoint::Along(t * self.speed), LinePoint::At)
    }

    /// From p0 to a place, in lengths.
    pub(super) fn position(&self, spot: LinePoint) -> f64 {
        match spot {
            LinePoint::At(Anchor::Start) => 0.0,
            LinePoint::At(Anchor::Near) => self.near,
            LinePoint::At(Anchor::Foot) => self.foot,
            LinePoint::At(Anchor::Far) => self.far,
            LinePoint::Along(length) => length,
        }
    }

    /// From the foot to an anchor other than p0, in lengths.
    fn side(&self, anchor: Anchor) -> f64 {
        match anchor {
            _ if !self.class.meets() => 0.0,
            Anchor::Near => -self.half,
            Anchor::Far => self.half,
            Anchor::Foot | Anchor::Start => 0.0,
        }
    }

    /// From an anchor to a place, in lengths.
    pub(super) fn offset(&self, spot: LinePoint, anchor: Anchor) -> f64 {
        let origin = self.position(LinePoint::At(anchor));
        match spot {
            LinePoint::At(to) if to == anchor => 0.0,
            LinePoint::At(to) if to != Anchor::Start && anchor != Anchor::Start => {
                self.side(to) - self.side(anchor)
            }
            _ => self.position(spot) - origin,
        }
    }

    /// The place `offset` lengths from an anchor, measured from the foot.
    pub(super) fn beyond_foot(&self, anchor: Anchor, offset: f64) -> f64 {
        match anchor {
            Anchor::Start => offset - self.foot,
            _ => offset + self.side(anchor),
        }
    }

    /// f = |p − c|² − r² at the place `offset` lengths from an anchor.
    pub(super) fn power(&self, anchor: Anchor, offset: f64) -> f64 {
        let meets = self.class.meets();
        match anchor {
            Anchor::Near if meets => offset * (offset - 2.0 * self.half),
            Anchor::Far if meets => offset * (offset + 2.0 * self.half),
            Anchor::Start if meets => (offset - self.near) * (offset - self.far),
            _ => {
                let x = self.beyond_foot(anchor, offset);
                x * x - self.half_squared()
            }
        }
    }

    /// f at a place, measured from the anchor nearest to it.
    pub(super) fn value(&self, spot: LinePoint) -> f64 {
        let away = |&anchor: &Anchor| self.offset(spot, anchor).abs();
        [Anchor::Near, Anchor::Foot, Anchor::Far]
            .into_iter()
            .min_by(|m, n| away(m).total_cmp(&away(n)))
            .map_or(f64::NAN, |anchor| {
                self.power(anchor, self.offset(spot, anchor))
            })
    }

    /// Height of the upper half circle over the place `offset` lengths from an anchor.
    pub(super) fn upper(&self, anchor: Anchor, offset: f64) -> Option<f64> {
        let rise = self.rise(anchor, offset)?;
        // −distance + rise, without the cancellation: rise² − distance² = −f.
        Some(divide(-self.power(anchor, offset), self.distance + rise))
    }

    /// Height of the lower half circle.
    pub(super) fn lower(&self, anchor: Anchor, offset: f64) -> Option<f64> {
        Some(-self.distance - self.rise(anchor, offset)?)
    }

    /// Of the circle over the horizontal line through c.
    fn rise(&self, anchor: Anchor, offset: f64) -> Option<f64> {
        let x = self.beyond_foot(anchor, offset).abs();
        (x <= self.radius).then(|| ((self.radius - x) * (self.radius + x)).sqrt())
    }

    /// Offsets from an anchor of the two points of the circle at a height, left and right.
    pub(super) fn sides(&self, anchor: Anchor, height: f64) -> Option<[f64; 2]> {
        let squared = (self.depth() - height) * (self.radius + self.distance + height);
        if squared.is_nan() || squared < 0.0 {
            return None;
        }
        let half_width = squared.sqrt();
        // half² − half_width² = height·(height + 2·distance)
        let bend = height * (height + 2.0 * self.distance);
        let shift = divide(bend, self.half + half_width);
        Some(match anchor {
            Anchor::Near if self.class.meets() => [shift, half_width + self.half],
            Anchor::Far if self.class.meets() => [-half_width - self.half, -shift],
            Anchor::Start => [self.foot - half_width, self.foot + half_width],
            _ => [-half_width, half_width],
        })
    }

    /// For a miss, the point where the tangent from the foot touches: (along, height) from the foot.
    pub(super) fn touching_point(&self) -> (f64, f64) {
        let sine = divide(self.radius, self.distance);
        (
            self.half * sine,
            -self.half * divide(self.half, self.distance),
        )
    }
}

/// √(x/y) for x ≥ 0, y > 0, rounded once.
fn root_of_quotient(x: &Dyadic, y: &Dyadic) -> f64 {
    let one = Dyadic::from(1.0);
    Surd::new(Dyadic::ZERO, one, x * y, y.clone()).map_or(0.0, |root| root.to_f64())
}

/// x/y, and 0 for 0/0: the limit in every use here.
fn divide(x: f64, y: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x / y }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::figure::cases;
    use proptest::prelude::*;

    fn section(name: &str) -> Section {
        let (subject, ray) = cases::named(name);
        Section::new(&ray, &subject.sphere)
    }

    #[test]
    fn the_numbers_of_the_tutorial() {
        let s = section("tutorial off centre");
        assert_eq!((s.near, s.foot, s.far), (12.0, 20.0, 28.0));
        assert_eq!((s.distance, s.half, s.depth()), (6.0, 8.0, 4.0));
        assert_eq!(s.power(Anchor::Start, 0.0), 336.0);
        let s = section("tutorial miss");
        assert_eq!((s.distance, s.half), (11.0, 21.0_f64.sqrt()));
        assert_eq!(s.depth(), -1.0);
    }

    #[test]
    fn lengths_are_along_a_direction_of_any_length() {
        let (subject, ray) = cases::case([7.0, 1.0, 0.0], [4.0, -3.0, 0.0], [0.0; 3], 5.0);
        let s = Section::new(&ray, &subject.sphere);
        assert_eq!(s.class, Class::Tangent);
        assert_eq!((s.speed, s.near, s.far), (5.0, -5.0, -5.0));
    }

    #[test]
    fn nothing_cancels_close_to_an_anchor() {
        // On a planet the surface under a slanting ray is a line: 45 degrees, from far away.
        let s = section("planet");
        let height = s.upper(Anchor::Near, 1e-6).unwrap();
        assert!((height / 1e-6 - 1.0).abs() < 1e-6, "{height}");
        assert!((s.altitude() - 1.7).abs() < 1e-6);
        // A gap of 1.2e−7, of a sphere of radius 1.
        let s = section("grazing miss");
        let exact = 1.0 - f64::from(1.000_000_1_f32);
        assert!((s.depth() / exact - 1.0).abs() < 1e-12);
        assert_eq!(s.upper(Anchor::Foot, 0.0), Some(s.depth()));
    }

    proptest! {
        #[test]
        fn the_circle_is_a_circle((subject, ray) in cases::whole(), part in -0.99..0.99_f64) {
            let s = Section::new(&ray, &subject.sphere);
            let on_circle = |x: f64, y: f64| {
                let r = x.hypot(y + s.distance);
                prop_assert!((r - s.radius).abs() <= 1e-9 * (s.radius + s.distance));
                Ok(())
            };
            for anchor in [Anchor::Start, Anchor::Near, Anchor::Foot, Anchor::Far] {
                let x = part * s.radius;
                let offset = x - s.beyond_foot(anchor, 0.0);
                let halves = [s.upper(anchor, offset), s.lower(anchor, offset)];
                for y in halves.into_iter().flatten() {
                    on_circle(x, y)?;
                }
                prop_assert_eq!(halves.iter().flatten().count(), 2);
                let y = part * s.radius - s.distance;
                for offset in s.sides(anchor, y).into_iter().flatten() {
                    on_circle(s.beyond_foot(anchor, offset), y)?;
                }
                let root = s.offset(LinePoint::At(Anchor::Near), anchor);
                if s.class.meets() {
                    prop_assert!(s.power(anchor, root).abs() < 1e-9 * (1.0 + s.foot * s.foot));
                }
            }
        }
    }
}
