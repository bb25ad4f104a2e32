//! A batch against the single call, bit for bit.

use glam::Vec3;
use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::Family;
use rayscope::method::batch::{Batch, Scalars, Solutions, Vectors};
use rayscope::method::{Class, Method, Solution};

/// Rays and spheres in arrays.
struct Columns([Vec<f32>; 10]);

impl Columns {
    fn of(cases: &[(Ray, Sphere)]) -> Self {
        Self(std::array::from_fn(|i| {
            let number = |(ray, sphere): &(Ray, Sphere)| match i {
                0..3 => ray.origin[i],
                3..6 => ray.direction[i - 3],
                6..9 => sphere.center[i - 6],
                _ => sphere.radius,
            };
            cases.iter().map(number).collect()
        }))
    }

    fn vectors(&self, i: usize) -> [&[f32]; 3] {
        [&self.0[i], &self.0[i + 1], &self.0[i + 2]]
    }

    fn batch(&self) -> Batch<impl Vectors, impl Vectors, impl Vectors, impl Scalars> {
        Batch {
            origin: self.vectors(0),
            direction: self.vectors(3),
            center: self.vectors(6),
            radius: self.0[9].as_slice(),
        }
    }
}

/// The bits of an answer; a NaN is a NaN.
fn bits(solution: Solution) -> (Class, [Option<u32>; 2]) {
    let number = |t: f32| (!t.is_nan()).then_some(t.to_bits());
    (solution.class, [solution.near, solution.far].map(number))
}

fn assert_like_one_by_one(
    batch: &Batch<impl Vectors, impl Vectors, impl Vectors, impl Scalars>,
    method: Method,
    name: &str,
) {
    let n = batch.count();
    let mut out = Solutions::default();
    batch.solve(method, &mut out);
    let mut visible = vec![0.0; n];
    batch.visible(method, &mut visible);
    let mut classes = vec![Class::Nan; n];
    batch.classes(method, &mut classes);
    let mut portable = Solutions::default();
    batch.solve_portably(&mut portable);
    for i in 0..n {
        let (ray, sphere) = batch.get(i);
        let single = method.solve(&ray, &sphere);
        let what = format!("{method}, {name}, {n} lanes, lane {i}: {ray:?} {sphere:?}");
        assert_eq!(bits(out.get(i)), bits(single), "{what}");
        assert_eq!(classes[i], single.class, "{what}");
        let seen = (!visible[i].is_nan()).then_some(visible[i]);
        assert_eq!(seen, single.visible(), "{what}");
        if method == Method::Exact {
            assert_eq!(bits(portable.get(i)), bits(single), "{what}");
        }
    }
}

#[test]
fn gives_the_bits_of_the_single_call_on_every_family() {
    for family in Family::ALL {
        let columns = Columns::of(&family.sample(11, 200));
        for method in Method::ALL {
            assert_like_one_by_one(&columns.batch(), method, family.name);
        }
    }
}

#[test]
fn any_number_of_lanes_will_do() {
    let cases = Family::by_name("surface").unwrap().sample(5, 40);
    for n in 0..cases.len() {
        let columns = Columns::of(&cases[..n]);
        assert_like_one_by_one(&columns.batch(), Method::Exact, "surface");
    }
}

#[test]
fn any_part_may_be_shared() {
    let cases = Family::by_name("typical").unwrap().sample(6, 100);
    let columns = Columns::of(&cases);
    let (ray, sphere) = cases[0];
    let rays_at_a_sphere = Batch {
        origin: columns.vectors(0),
        direction: columns.vectors(3),
        center: sphere.center,
        radius: sphere.radius,
    };
    assert_like_one_by_one(&rays_at_a_sphere, Method::Exact, "one sphere");
    let spheres_on_a_ray = Batch {
        origin: ray.origin,
        direction: ray.direction,
        center: columns.vectors(6),
        radius: columns.0[9].as_slice(),
    };
    assert_like_one_by_one(&spheres_on_a_ray, Method::Exact, "one ray");
    let one = Batch {
        origin: ray.origin,
        direction: ray.direction,
        center: sphere.center,
        radius: sphere.radius,
    };
    assert_like_one_by_one(&one, Method::Exact, "one of each");
}

#[test]
#[should_panic(expected = "different numbers of lanes")]
fn parts_must_agree_on_the_number_of_lanes() {
    let numbers = [1.0; 3];
    let batch = Batch {
        origin: [&numbers[..]; 3],
        direction: Vec3::X,
        center: Vec3::ZERO,
        radius: &numbers[..2],
    };
    batch.count();
}
