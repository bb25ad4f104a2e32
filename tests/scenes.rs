//! Scene files: what is written reads back, what is wrong is said in one sentence, and the built-in
//! scenes teach what they promise.

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::{Class, Method, Place};
use rayscope::scene::{
    Aim, Body, Builtin, Camera, Light, PixelShape, Probe, Projection, Rays, Rgb, Scene, Size,
};

/// Any finite binary32, subnormal and −0 among them.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>()
            .prop_map(f32::from_bits)
            .prop_filter("finite", |v| v.is_finite()),
        (-1000_i16..1000).prop_map(f32::from),
        Just(-0.0),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from)
}

fn above_zero() -> impl Strategy<Value = f32> {
    coordinate()
        .prop_map(f32::abs)
        .prop_filter("above zero", |v| *v > 0.0)
}

fn text() -> impl Strategy<Value = String> {
    r#"[\PC"\\#'=]{0,12}"#
}

fn projection() -> impl Strategy<Value = Projection> {
    prop_oneof![
        [above_zero(), above_zero()].prop_map(|extent| Projection::Orthographic { extent }),
        above_zero()
            .prop_filter("an angle", |v| *v < 180.0)
            .prop_map(|field_of_view| Projection::Perspective { field_of_view }),
    ]
}

fn camera() -> impl Strategy<Value = Camera> {
    (projection(), vector(), vector(), vector())
        .prop_map(|(projection, position, look_at, up)| Camera {
            projection,
            position,
            look_at,
            up,
        })
        .prop_filter("looks somewhere", |camera| camera.check().is_ok())
}

fn body() -> impl Strategy<Value = Body> {
    let color = any::<(u8, u8, u8)>().prop_map(|(r, g, b)| Rgb(r, g, b));
    (
        vector(),
        coordinate().prop_map(f32::abs),
        proptest::option::of(text()),
        proptest::option::of(color),
    )
        .prop_map(|(center, radius, name, color)| Body {
            sphere: Sphere::new(center, radius).unwrap(),
            name: name.map(String::into_boxed_str),
            color,
        })
}

fn probe(pixels: Option<Size>) -> impl Strategy<Value = Probe> {
    let aim = match pixels {
        Some(Size { width, height }) => prop_oneof![
            (0..width, 0..height).prop_map(|(x, y)| Aim::Pixel(x, y)),
            vector().prop_map(Aim::Point),
        ]
        .boxed(),
        None => vector().prop_map(Aim::Point).boxed(),
    };
    (aim, text(), text()).prop_map(|(aim, title, text)| Probe { aim, title, text })
}

fn scene() -> impl Strategy<Value = Scene> {
    let side = 1..=Size::LARGEST;
    let size = (side.clone(), side).prop_map(|(w, h)| Size::new(w, h));
    proptest::option::of(size).prop_flat_map(|pixels| {
        (
            (text(), proptest::option::of(text())),
            camera(),
            proptest::collection::vec(body(), 0..5),
            proptest::option::of(vector().prop_map(|position| Light { position })),
            proptest::collection::vec(probe(pixels), 0..4),
        )
            .prop_map(
                move |((name, about), camera, bodies, light, probes)| Scene {
                    name,
                    about,
                    camera,
                    pixels,
                    bodies,
                    light,
                    probes,
                },
            )
    })
}

proptest! {
    #[test]
    fn what_is_written_reads_back(scene in scene()) {
        let text = scene.to_toml();
        let back = Scene::parse(&text, "scene.toml");
        // Debug tells −0 from 0, which == does not.
        prop_assert_eq!(format!("{:?}", back), format!("{:?}", Ok::<_, ()>(scene)), "{}", text);
    }

    #[test]
    fn no_text_makes_the_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = Scene::parse(&String::from_utf8_lossy(&bytes), "scene.toml");
    }

    #[test]
    fn no_change_of_a_good_file_makes_the_reader_panic(
        which in 0..Builtin::ALL.len(),
        cut in 0.0..1.0,
        put in r#"[\PC\n\[\]{}="'.,0-9e-]{0,6}"#,
        drop in 0_usize..12,
    ) {
        let mut text: Vec<char> = Builtin::ALL[which].scene().to_toml().chars().take(2000).collect();
        let at = (cut * text.len() as f64) as usize;
        let end = (at + drop).min(text.len());
        text.splice(at..end, put.chars());
        let text: String = text.into_iter().collect();
        if let Err(error) = Scene::parse(&text, "scene.toml") {
            prop_assert!(!error.to_string().contains('\n'), "{}", error);
        }
    }
}

#[test]
fn the_built_in_scenes_read_and_read_back() {
    for builtin in Builtin::ALL {
        let scene = builtin.scene();
        assert_eq!(scene.name, builtin.name());
        assert_eq!(Builtin::by_name(builtin.name()), Some(builtin));
        assert_eq!(Scene::parse(&scene.to_toml(), "other.toml"), Ok(scene));
    }
}

/// The rays of a scene in a picture of its own size, or else of 80 × 48 pixels.
fn rays(scene: &Scene) -> Rays {
    match scene.pixels {
        Some(pixels) => Rays::new(&scene.camera, pixels, PixelShape::Own),
        None => Rays::new(&scene.camera, Size::new(80, 48), PixelShape::Aspect(1.0)),
    }
}

/// The ray that a probe points at.
fn probed(scene: &Scene, title: &str) -> Ray {
    let rays = rays(scene);
    let probe = scene.probes.iter().find(|p| p.title == title).unwrap();
    match probe.aim {
        Aim::Pixel(x, y) => rays.ray(x, y),
        Aim::Point(point) => {
            let [x, y] = rays.project(point.as_dvec3()).unwrap();
            rays.ray(x.round() as u32, y.round() as u32)
        }
    }
}

#[test]
fn every_built_in_scene_has_a_sentence_and_probes_inside_its_picture() {
    for builtin in Builtin::ALL {
        let scene = builtin.scene();
        let about = builtin.about();
        assert!(about.ends_with('.'), "{about}");
        assert!(scene.probes.len() >= 2, "{}", scene.name);
        for (w, h) in [(38, 40), (80, 48), (200, 120)] {
            let rays = match scene.pixels {
                Some(_) => rays(&scene),
                None => Rays::new(&scene.camera, Size::new(w, h), PixelShape::Aspect(1.0)),
            };
            for probe in &scene.probes {
                assert!(probe.text.ends_with('.'), "{}", probe.text);
                let Aim::Point(point) = probe.aim else {
                    continue;
                };
                let [x, y] = rays.project(point.as_dvec3()).unwrap();
                let Size { width, height } = rays.size;
                let inside = (-0.5..f64::from(width) - 0.5).contains(&x)
                    && (-0.5..f64::from(height) - 0.5).contains(&y);
                assert!(inside, "{}: {} at {x} {y}", scene.name, probe.title);
            }
        }
    }
}

#[test]
fn the_three_lines_miss_touch_and_cross_exactly() {
    let scene = Builtin::ThreeLines.scene();
    let sphere = scene.bodies[0].sphere;
    let solved = |title| Method::Textbook.solve(&probed(&scene, title), &sphere);
    let discriminant = |title| {
        Method::Textbook
            .coefficients(&probed(&scene, title), &sphere)
            .discriminant
    };
    assert_eq!(solved("a line that misses").class, Class::Miss);
    assert_eq!(discriminant("a line that misses"), -44.0);
    for touching in ["a line that touches", "another that touches"] {
        assert_eq!(solved(touching).class, Class::Tangent);
        assert_eq!((solved(touching).near, solved(touching).far), (20.0, 20.0));
    }
    assert_eq!(discriminant("a line that crosses"), 64.0);
    let crossing = solved("a line that crosses");
    assert_eq!((crossing.near, crossing.far), (16.0, 24.0));
}

#[test]
fn the_seeds_probes_tell_the_truth() {
    let scene = Builtin::Seed.scene();
    let discriminant = |title| {
        Method::Textbook
            .coefficients(&probed(&scene, title), &scene.bodies[0].sphere)
            .discriminant
    };
    assert_eq!(discriminant("through the centre"), 400.0);
    assert_eq!(discriminant("a tangent"), 0.0);
    assert_eq!(discriminant("a tangent off the axes"), 0.0);
    assert_eq!(discriminant("a miss"), -84.0);
    assert_eq!(discriminant("almost a tangent"), 60.0);
}

#[test]
fn in_inside_and_behind_the_roots_lie_as_the_probes_say() {
    let places = |scene: &Scene, title| -> Vec<(String, Place)> {
        let ray = probed(scene, title);
        scene
            .bodies
            .iter()
            .filter_map(|body| {
                let place = Method::Textbook.solve(&ray, &body.sphere).place()?;
                Some((body.name.as_deref().unwrap_or_default().to_owned(), place))
            })
            .collect()
    };
    let named = |name: &str, place| (name.to_owned(), place);

    let inside = Builtin::Inside.scene();
    assert_eq!(
        places(&inside, "the wall ahead"),
        [named("the room", Place::Inside)]
    );
    assert_eq!(
        places(&inside, "a ball in the room"),
        [named("the room", Place::Inside), named("ball", Place::Hit)]
    );
    assert_eq!(
        places(&inside, "half in the wall"),
        [
            named("the room", Place::Inside),
            named("in the wall", Place::Hit)
        ]
    );

    let behind = Builtin::Behind.scene();
    assert_eq!(
        places(&behind, "ahead"),
        [named("ahead, large", Place::Hit)]
    );
    assert_eq!(
        places(&behind, "behind"),
        [named("behind, low on the left", Place::Behind)]
    );
    assert_eq!(
        places(&behind, "one ahead, one behind"),
        [
            named("ahead, large", Place::Hit),
            named("behind, high on the right", Place::Behind)
        ]
    );
}

/// Whether the line meets the sphere, in binary64 by Lagrange's identity: for these rays its error
/// is a thousand times smaller than the least |Δ| of a picture.
fn meets(ray: &Ray, sphere: &Sphere) -> bool {
    let o = (ray.origin.as_dvec3()) - sphere.center.as_dvec3();
    let d = ray.direction.as_dvec3();
    let r = f64::from(sphere.radius);
    d.length_squared() * r * r - o.cross(d).length_squared() >= 0.0
}

#[test]
fn the_textbook_garbles_far() {
    let scene = Builtin::Far.scene();
    let sphere = scene.bodies[0].sphere;
    let rays = rays(&scene);
    let mut false_hits = 0;
    let mut false_misses = 0;
    let mut hits = 0;
    for y in 0..rays.size.height {
        for x in 0..rays.size.width {
            let ray = rays.ray(x, y);
            let said = Method::Textbook.solve(&ray, &sphere).class.meets();
            let truth = meets(&ray, &sphere);
            hits += usize::from(truth);
            false_hits += usize::from(said && !truth);
            false_misses += usize::from(truth && !said);
        }
    }
    // A disc of 82 % of the height, and about half of it gone.
    assert!((1100..1300).contains(&hits), "{hits}");
    assert!(false_misses > hits / 3, "{false_misses} of {hits}");
    assert!(false_hits > 50, "{false_hits}");
}

#[test]
fn the_textbook_raises_the_ground_of_planet_by_a_fifth() {
    let scene = Builtin::Planet.scene();
    let ray = probed(&scene, "the ground five metres ahead");
    let ground = scene.bodies[0].sphere;
    let textbook = Method::Textbook.coefficients(&ray, &ground);
    assert_eq!(textbook.c, 16_777_216.0);
    let o = ray.origin.as_dvec3() - ground.center.as_dvec3();
    let exact = o.length_squared() - f64::from(ground.radius).powi(2);
    assert_eq!(exact, 21_661_403.5);
}

#[test]
fn the_textbook_takes_the_gap_of_grazing_for_a_tangent() {
    let scene = Builtin::Grazing.scene();
    let rays = Rays::new(&scene.camera, Size::new(81, 49), PixelShape::Aspect(1.0));
    let middle = rays.ray(40, 24);
    for body in &scene.bodies {
        assert_eq!(
            Method::Textbook
                .coefficients(&middle, &body.sphere)
                .discriminant,
            0.0
        );
        let o = middle.origin - body.sphere.center;
        assert_eq!(o.cross(middle.direction).length(), body.sphere.radius);
    }
    let rays = Rays::new(&scene.camera, Size::new(80, 48), PixelShape::Aspect(1.0));
    let tangents = (0..48)
        .flat_map(|y| (0..80).map(move |x| rays.ray(x, y)))
        .filter(|ray| Method::Textbook.solve(ray, &scene.bodies[0].sphere).class == Class::Tangent)
        .count();
    assert!(tangents > 300, "{tangents}");
}

/// FNV-1a over the bits of every sphere.
fn checksum(bodies: &[Body]) -> u64 {
    bodies
        .iter()
        .flat_map(|body| {
            let Rgb(r, g, b) = body.color.unwrap();
            let [x, y, z] = body.sphere.center.to_array();
            [x, y, z, body.sphere.radius]
                .into_iter()
                .flat_map(|v| v.to_bits().to_le_bytes())
                .chain([r, g, b])
        })
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        })
}

#[test]
fn the_crowd_is_the_same_on_every_machine() {
    let crowd = Builtin::Crowd.scene();
    assert_eq!(crowd.bodies.len(), 10_000);
    assert_eq!(checksum(&crowd.bodies), 0x362c_30ff_23bd_4f22);
    assert!(
        crowd
            .bodies
            .iter()
            .all(|b| Sphere::new(b.sphere.center, b.sphere.radius).is_ok())
    );
}
