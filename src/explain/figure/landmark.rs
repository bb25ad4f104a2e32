//! The places of a line that have names, in their order: where the moving point can go at once.

use super::section::{Anchor, Section};
use crate::geometry::{Ray, Sphere};
use crate::method::Class;

/// A place on the line that slice and curve name.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// Where it is: p0 + t·d. Slice and curve know the place again by this very number.
    pub t: f64,
    /// What is there, in a few words.
    pub what: String,
}

/// p0, the roots and the point closest to the centre, by t; those at the same t are one.
pub fn landmarks(ray: &Ray, sphere: &Sphere) -> Vec<Landmark> {
    let section = Section::new(ray, sphere);
    let named = match section.class {
        Class::Secant | Class::Hit => vec![
            (Anchor::Start, "p0, the start of the ray"),
            (Anchor::Near, "into the sphere"),
            (Anchor::Foot, "closest to the centre"),
            (Anchor::Far, "out of the sphere"),
        ],
        Class::Tangent => vec![
            (Anchor::Start, "p0, the start of the ray"),
            (Anchor::Near, "touching the sphere"),
        ],
        Class::Miss | Class::Nan => vec![
            (Anchor::Start, "p0, the start of the ray"),
            (Anchor::Foot, "closest to the centre"),
        ],
    };
    let mut places: Vec<_> = named
        .into_iter()
        .map(|(anchor, what)| Landmark {
            t: section.t(anchor),
            what: what.to_owned(),
        })
        .filter(|place| place.t.is_finite())
        .collect();
    places.sort_by(|x, y| x.t.total_cmp(&y.t));
    places.dedup_by(|next, kept| {
        let same = next.t.to_bits() == kept.t.to_bits();
        if same {
            kept.what += ", ";
            kept.what += &next.what;
        }
        same
    });
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::figure::cases;
    use crate::explain::figure::section::LinePoint;
    use proptest::prelude::*;

    fn of(name: &str) -> Vec<(f64, String)> {
        let (subject, ray) = cases::named(name);
        let places = landmarks(&ray, &subject.sphere);
        places.into_iter().map(|p| (p.t, p.what)).collect()
    }

    #[test]
    fn landmarks_stand_in_the_order_of_t() {
        let words = |name| of(name).into_iter().map(|(t, what)| format!("{t} {what}"));
        assert_eq!(
            words("tutorial centre").collect::<Vec<_>>(),
            [
                "0 p0, the start of the ray",
                "10 into the sphere",
                "20 closest to the centre",
                "30 out of the sphere"
            ]
        );
        assert_eq!(
            words("tutorial tangent").collect::<Vec<_>>(),
            ["0 p0, the start of the ray", "20 touching the sphere"]
        );
        assert_eq!(
            words("tutorial wide miss").collect::<Vec<_>>(),
            ["0 p0, the start of the ray", "20 closest to the centre"]
        );
        assert_eq!(
            words("surface").collect::<Vec<_>>(),
            [
                "0 p0, the start of the ray, into the sphere",
                "1 closest to the centre",
                "2 out of the sphere"
            ]
        );
    }

    proptest! {
        #[test]
        fn a_landmark_is_known_again(case in prop_oneof![cases::whole(), cases::aimed()]) {
            let (subject, ray) = case;
            let section = Section::new(&ray, &subject.sphere);
            let places = landmarks(&ray, &subject.sphere);
            prop_assert!(places.windows(2).all(|p| p[0].t < p[1].t));
            for place in places {
                let LinePoint::At(anchor) = section.spot(place.t) else {
                    return Err(TestCaseError::fail(format!("{place:?}")));
                };
                prop_assert_eq!(section.t(anchor), place.t);
            }
        }
    }
}
