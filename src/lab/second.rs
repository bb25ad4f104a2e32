//! The second ray: how far the computed hit point and its normal are off, and what a ray that starts there
//! meets: the sphere itself, which is called acne, and what it costs to pass over that.

use glam::{DVec3, Vec3};
use serde::Serialize;

use super::Problem;
use super::errors::Percentiles;
use super::reference::Reference;
use crate::geometry::{Ray, Sphere};
use crate::method::{Method, Solution};
use crate::random::Random;
use crate::render::height;

/// What the rays of a set become at their hits, for one method.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct SecondRays {
    /// Hits that the method sees as the truth does, at a point within the range.
    pub hits: usize,
    /// How far p = p0 + t·d, in binary32, is from the exact point, in units of the world.
    pub point: Percentiles,
    /// The same in parts of the radius.
    pub point_of_radius: Percentiles,
    /// How far p − c, which points along the normal, is off once it is as long as r, in units of the world.
    pub normal: Percentiles,
    /// The same in parts of the radius: how far the unit normal is off.
    pub normal_of_radius: Percentiles,
    /// Points that lie inside the sphere.
    pub inside: usize,
    /// Points that lie outside.
    pub outside: usize,
    /// Second rays away from the sphere that meet it all the same.
    pub self_hits: usize,
    /// What clears them all by a least t, for d of length 1.
    pub t_min: Clearance,
    /// What clears them all by a start that far along the normal.
    pub along_normal: Clearance,
}

/// The least ε that clears every self-hit, and what it costs.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Clearance {
    /// In units of the world; none if not even a radius clears all.
    pub epsilon: Option<f64>,
    /// In parts of the radius: the greatest that one ray needs.
    pub of_radius: Option<f64>,
    /// Of as many rays that go on into the sphere: whose other side is then passed over.
    pub missed: usize,
}

/// A hit with what a second ray needs.
struct Start {
    sphere: Sphere,
    point: Vec3,
    /// The computed normal, of length about 1, on the side that the first ray came from.
    normal: Vec3,
    /// Away from the sphere on that side, and through to the other.
    away: Vec3,
    onward: Vec3,
}

impl SecondRays {
    /// The second rays of the first `most` problems.
    pub fn of(
        solve: impl Fn(&Ray, &Sphere) -> Solution,
        problems: &[Problem],
        references: &[Reference],
        most: usize,
    ) -> Self {
        let exactly = |ray: &Ray, sphere: &Sphere| Method::Exact.solve(ray, sphere);
        let mut found = Self::default();
        let mut errors = [const { Vec::new() }; 4];
        let mut random = Random::new(most as u64);
        let mut starts = Vec::new();
        for (problem, truth) in problems.iter().zip(references).take(most) {
            // The same directions whatever was seen.
            let direction = random.unit_vector();
            let Some((start, off)) = hit(&solve, problem, truth, direction) else {
                continue;
            };
            for (errors, off) in errors.iter_mut().zip(off) {
                errors.push(off);
            }
            match height(start.point, &start.sphere) {
                side if side < 0.0 => found.inside += 1,
                side if side > 0.0 => found.outside += 1,
                _ => {}
            }
            starts.push(start);
        }
        found.hits = starts.len();
        let [point, point_of_radius, normal, normal_of_radius] =
            errors.map(|mut errors| Percentiles::of(&mut errors));
        (found.point, found.point_of_radius) = (point, point_of_radius);
        (found.normal, found.normal_of_radius) = (normal, normal_of_radius);
        let is_self_hit = |start: &&Start| is_seen(&solve, &start.ray(start.away, 0.0), start, 0.0);
        let selves: Vec<&Start> = starts.iter().filter(is_self_hit).collect();
        found.self_hits = selves.len();
        found.t_min = Clearance::of(
            &selves,
            &starts,
            |start, epsilon| is_seen(&solve, &start.ray(start.away, 0.0), start, epsilon),
            |start, epsilon| is_seen(exactly, &start.ray(start.onward, 0.0), start, epsilon),
        );
        found.along_normal = Clearance::of(
            &selves,
            &starts,
            |start, epsilon| is_seen(&solve, &start.ray(start.away, epsilon), start, 0.0),
            |start, epsilon| is_seen(exactly, &start.ray(start.onward, -epsilon), start, 0.0),
        );
        found
    }
}

impl Start {
    /// A second ray that starts so far along the normal.
    fn ray(&self, direction: Vec3, offset: f32) -> Ray {
        Ray {
            origin: self.point + offset * self.normal,
            direction,
        }
    }
}

/// Whether the sphere is met beyond `least`.
fn is_seen(
    solve: impl Fn(&Ray, &Sphere) -> Solution,
    ray: &Ray,
    start: &Start,
    least: f32,
) -> bool {
    let found = solve(ray, &start.sphere);
    found.visible_between(least, f32::INFINITY).is_some()
}

/// The hit that a method sees, with the errors of point and normal; none where the method sees another root
/// than there is, or no number.
fn hit(
    solve: impl Fn(&Ray, &Sphere) -> Solution,
    (ray, sphere): &Problem,
    truth: &Reference,
    direction: [f64; 3],
) -> Option<(Start, [f64; 4])> {
    let found = solve(ray, sphere);
    let (t, root) = (found.visible()?, truth.visible()?);
    if found.place() != truth.solution.place() || sphere.radius == 0.0 {
        return None;
    }
    let point = ray.at(t);
    let exact = ray.origin.as_dvec3() + root.value() * ray.direction.as_dvec3();
    let (center, r) = (sphere.center.as_dvec3(), f64::from(sphere.radius));
    let outward = (point - sphere.center) / sphere.radius;
    if !(outward.is_finite() && exact.is_finite()) {
        return None;
    }
    let off = (point.as_dvec3() - exact).length();
    let normal_off = (outward.as_dvec3() - (exact - center) / r).length();
    // The side that the first ray came from.
    let facing = if ray.direction.as_dvec3().dot(exact - center) > 0.0 {
        -1.0
    } else {
        1.0
    };
    let normal = outward * facing as f32;
    let direction = DVec3::from(direction);
    let away = if direction.dot(exact - center) * facing < 0.0 {
        -direction
    } else {
        direction
    };
    let start = Start {
        sphere: *sphere,
        point,
        normal,
        away: away.as_vec3(),
        onward: -away.as_vec3(),
    };
    Some((start, [off, off / r, normal_off * r, normal_off]))
}

impl Clearance {
    /// What clears every self-hit: `hits` says whether one is left at some ε, `contact` whether the other side is
    /// still met.
    fn of(
        selves: &[&Start],
        all: &[Start],
        hits: impl Fn(&Start, f32) -> bool,
        contact: impl Fn(&Start, f32) -> bool,
    ) -> Self {
        let needed =
            |start: &&Start| least_clear(start.sphere.radius, |epsilon| hits(start, epsilon));
        let needs: Option<Vec<f32>> = selves.iter().map(needed).collect();
        let Some(needs) = needs else {
            return Self::default();
        };
        let radii = selves.iter().map(|start| start.sphere.radius);
        let parts = needs
            .iter()
            .zip(radii)
            .map(|(need, r)| f64::from(*need) / f64::from(r));
        let epsilon = needs.iter().copied().fold(0.0, f32::max);
        let missed = all
            .iter()
            .filter(|start| contact(start, 0.0) && !contact(start, epsilon));
        Self {
            epsilon: Some(epsilon.into()),
            of_radius: Some(parts.fold(0.0, f64::max)),
            missed: missed.count(),
        }
    }
}

/// The least ε up to r from which on nothing is hit, by halving the numbers between; none if r is not enough.
fn least_clear(r: f32, hits: impl Fn(f32) -> bool) -> Option<f32> {
    // Numbers above 0 lie in the order of their bits.
    let (mut hit, mut clear) = (0, r.to_bits());
    if hits(r) {
        return None;
    }
    while clear - hit > 1 {
        let middle = hit + (clear - hit) / 2;
        if hits(f32::from_bits(middle)) {
            hit = middle;
        } else {
            clear = middle;
        }
    }
    Some(f32::from_bits(clear))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Family;

    fn second(method: Method, family: &str) -> SecondRays {
        let problems = Family::by_name(family).unwrap().sample(3, 300);
        SecondRays::of(
            |r, s| method.solve(r, s),
            &problems,
            &Reference::all(&problems),
            300,
        )
    }

    #[test]
    fn the_point_is_as_good_as_binary32_and_the_root_allow() {
        let exact = second(Method::Exact, "typical");
        assert!(exact.hits > 150, "{exact:?}");
        // Coordinates of up to 16 with half an ulp each, and the product's.
        assert!(
            exact.point.max > 1e-8 && exact.point.max < 4e-6,
            "{exact:?}"
        );
        let textbook = second(Method::Textbook, "typical");
        assert!(textbook.point.max > exact.point.max, "{textbook:?}");
        // Rounding puts about as many points inside as outside.
        assert!(exact.inside * 4 > exact.hits && exact.outside * 4 > exact.hits);
        let ground = second(Method::Exact, "ground");
        assert!(ground.point.max < 1e-3, "{ground:?}");
        let parts = ground.point_of_radius.max * 1e6 / ground.point.max;
        assert!((0.999..1.001).contains(&parts), "{ground:?}");
    }

    #[test]
    fn the_least_clearance_clears_and_the_next_below_does_not() {
        let problems = Family::by_name("typical").unwrap().sample(3, 300);
        let references = Reference::all(&problems);
        let found = SecondRays::of(
            |r, s| Method::Exact.solve(r, s),
            &problems,
            &references,
            300,
        );
        // A point inside sees the sphere in front of it.
        assert!(
            found.self_hits >= found.inside / 2 && found.self_hits > 20,
            "{found:?}"
        );
        for clearance in [found.t_min, found.along_normal] {
            let epsilon = clearance.epsilon.unwrap();
            assert!(epsilon > 0.0 && epsilon < 0.1, "{clearance:?}");
            assert!(clearance.missed < found.hits / 4, "{clearance:?}");
        }
        // Along the normal far less is needed than along a ray that all but touches.
        assert!(found.along_normal.epsilon < found.t_min.epsilon);
        let threshold = |t: f32| least_clear(10.0, |epsilon| epsilon < t);
        assert_eq!(threshold(0.3), Some(0.3));
        assert_eq!(threshold(1e-40), Some(1e-40));
        assert_eq!(threshold(11.0), None);
    }
}
