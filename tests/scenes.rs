//! Scene files: what is written reads back, what is wrong is said in one sentence, and the built-in
//! scenes teach what they promise.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output};

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::{Class, Method, Place};
use rayscope::scene::{
    Aim, Body, Builtin, Camera, LARGEST_FILE, Light, PixelShape, Probe, Projection, Rays, Rgb,
    Scene, Size, Source,
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

/// The pixels' grid of an orthographic camera: none, or a power of two.
fn step() -> impl Strategy<Value = Option<f32>> {
    prop_oneof![
        Just(None),
        (-149_i32..=127).prop_map(|k| Some(2.0_f64.powi(k) as f32)),
    ]
}

fn projection() -> impl Strategy<Value = Projection> {
    prop_oneof![
        ([above_zero(), above_zero()], step())
            .prop_map(|(extent, step)| Projection::Orthographic { extent, step }),
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
fn the_tutorials_probes_tell_the_truth() {
    let scene = Builtin::Tutorial.scene();
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

const CAMERA: &str = "[camera]\nposition = [0, 0, 10]\nlook_at = [0, 0, 0]\n";
const SPHERE: &str = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
const WINDOW: &str = "projection = \"orthographic\"\nextent = [4, 3]\n";

/// Every kind of file that is refused, with a name for each.
#[expect(
    clippy::too_many_lines,
    reason = "a table, a line or two for each kind"
)]
fn bad_files() -> Vec<(&'static str, String)> {
    let camera = |lines: &str| format!("[camera]\n{lines}\n");
    let look = "position = [0, 0, 10]\nlook_at = [0, 0, 0]\n";
    let with_camera = |lines: &str| camera(&format!("{look}{lines}"));
    let after = |lines: &str| format!("{CAMERA}{lines}\n");
    let sphere = |lines: &str| format!("{CAMERA}{SPHERE}[[sphere]]\n{lines}\n");
    let probe = |lines: &str| {
        format!("{CAMERA}pixels = [40, 30]\n[[probe]]\ntitle = \"t\"\ntext = \"s\"\n{lines}\n")
    };
    vec![
        ("an empty file", String::new()),
        ("no TOML", after("[[sphere]\ncenter = 3")),
        ("text without quotes", after("[light]\nposition = here")),
        ("a quote left open", format!("name = \"two\n{CAMERA}")),
        ("a key twice", sphere("radius = 1\nradius = 2")),
        ("a table twice", after("[camera]\nposition = [0, 0, 0]")),
        ("a misspelt key", sphere("center = [0, 0, 0]\nraduis = 1")),
        ("a misspelt table", after("[[spheres]]\nradius = 1")),
        (
            "a key from elsewhere",
            sphere("center = [0, 0, 0]\nradius = 1\nxyz = 1"),
        ),
        ("a name that is no text", format!("name = 7\n{CAMERA}")),
        (
            "a name that runs on",
            format!("name = \"two\\nlines\"\n{CAMERA}"),
        ),
        (
            "a name with an escape",
            format!("name = \"\\u001b[2J\"\n{CAMERA}"),
        ),
        ("a camera that is no table", "camera = 3".to_owned()),
        ("a sphere not in a list", after("[sphere]\nradius = 1")),
        ("no table where one should be", "sphere = [1]".to_owned()),
        ("no position", camera("look_at = [0, 0, 0]")),
        ("nothing to look at", camera("position = [0, 0, 0]")),
        (
            "a camera that looks at itself",
            camera("position = [1, 2, 3]\nlook_at = [1, 2, 3]"),
        ),
        ("up along the view", with_camera("up = [0, 0, 2]")),
        ("no up at all", with_camera("up = [0, 0, 0]")),
        (
            "another projection",
            with_camera("projection = \"fisheye\""),
        ),
        ("an angle too wide", with_camera("field_of_view = 180")),
        ("no extent", with_camera("projection = \"orthographic\"")),
        (
            "an extent of zero",
            with_camera("projection = \"orthographic\"\nextent = [4, 0]"),
        ),
        (
            "an extent out of range",
            with_camera("projection = \"orthographic\"\nextent = [1, 1e36]"),
        ),
        (
            "an angle without perspective",
            with_camera(&format!("{WINDOW}field_of_view = 45")),
        ),
        ("an extent in perspective", with_camera("extent = [4, 3]")),
        (
            "a step that is no power of two",
            with_camera("projection = \"orthographic\"\nextent = [4, 3]\nstep = 3"),
        ),
        (
            "a step below zero",
            with_camera("projection = \"orthographic\"\nstep = -1"),
        ),
        ("a step in perspective", with_camera("step = 1")),
        ("no pixels", with_camera("pixels = [0, 40]")),
        ("too many pixels", with_camera("pixels = [40, 5000]")),
        ("half a pixel", with_camera("pixels = [40, 30.5]")),
        ("pixels in one number", with_camera("pixels = 40")),
        ("no radius", sphere("center = [0, 0, 0]")),
        ("no centre", sphere("radius = 1")),
        (
            "a negative radius",
            sphere("center = [0, 0, 0]\nradius = -3"),
        ),
        (
            "a radius that is text",
            sphere("center = [0, 0, 0]\nradius = \"3\""),
        ),
        (
            "a radius that is true",
            sphere("center = [0, 0, 0]\nradius = true"),
        ),
        (
            "a radius that is a day",
            sphere("center = [0, 0, 0]\nradius = 2011-01-02"),
        ),
        ("NaN", sphere("center = [0, nan, 0]\nradius = 1")),
        ("an infinity", sphere("center = [0, 0, -inf]\nradius = 1")),
        ("past binary32", sphere("center = [1e39, 0, 0]\nradius = 1")),
        (
            "past binary32 in hexadecimal",
            sphere(&format!(
                "center = [0, 0, 0x1{}]\nradius = 1",
                "0".repeat(32)
            )),
        ),
        ("two coordinates", sphere("center = [0, 0]\nradius = 1")),
        (
            "a coordinate that is a list",
            sphere("center = [0, [1], 0]\nradius = 1"),
        ),
        (
            "a colour by name",
            sphere("center = [0, 0, 0]\nradius = 1\ncolor = \"red\""),
        ),
        ("a light without position", after("[light]")),
        ("a probe that points nowhere", probe("")),
        (
            "a probe that points twice",
            probe("pixel = [1, 1]\npoint = [0, 0, 0]"),
        ),
        ("a probe past the pixels", probe("pixel = [40, 0]")),
        ("a probe before the pixels", probe("pixel = [-1, 0]")),
        (
            "a pixel without pixels",
            after("[[probe]]\ntitle = \"t\"\ntext = \"s\"\npixel = [1, 1]"),
        ),
        (
            "a probe without title",
            after("[[probe]]\ntext = \"s\"\npoint = [1, 1, 1]"),
        ),
        (
            "a long text for a number",
            sphere(&format!(
                "center = [0, 0, 0]\nradius = \"{}\"",
                "long ".repeat(30)
            )),
        ),
    ]
}

#[test]
fn each_kind_of_bad_file_has_its_sentence() {
    let mut said = String::new();
    for (kind, text) in bad_files() {
        let error = Scene::parse(&text, "bad.toml").expect_err(kind);
        writeln!(said, "{kind}\n    {error}").unwrap();
    }
    insta::assert_snapshot!(said);
}

/// What loading a file of these bytes says, without the name of the file.
fn said_of(bytes: &[u8]) -> String {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    let error = Scene::load(file.path()).unwrap_err();
    error.to_string().split_off(error.file.len())
}

#[test]
fn files_that_are_no_text_are_refused() {
    assert_eq!(
        said_of(b"name = \"a\"\nabout = \"caf\xe9\"\n"),
        ":2:13: found the byte 0xe9, expected text in UTF-8"
    );
    let folder = tempfile::tempdir().unwrap();
    let refused = |path: &Path| Scene::load(path).unwrap_err().problem;
    assert_eq!(
        refused(folder.path()),
        "found a directory, expected a scene file"
    );
    assert_eq!(
        refused(&folder.path().join("none.toml")),
        "found no such file, expected a scene file"
    );
    let large = tempfile::NamedTempFile::new().unwrap();
    large.as_file().set_len(LARGEST_FILE + 1).unwrap();
    assert_eq!(
        refused(large.path()),
        "found more than 256 MiB, expected a scene file of at most 256 MiB"
    );
}

#[test]
fn a_fault_far_down_a_long_file_is_found_at_its_line() {
    let mut text = format!("{CAMERA}{}", SPHERE.repeat(2000));
    text += "[[sphere]]\ncenter = [0, 0, 0]\nradius = -1\n";
    assert_eq!(
        Scene::parse(&text, "long.toml").unwrap_err().to_string(),
        "long.toml:6006:10: sphere 2001, radius: found -1, expected a finite number of zero or more"
    );
    let text = format!("{CAMERA}{}colour = 3", SPHERE.repeat(2000));
    assert_eq!(
        Scene::parse(&text, "long.toml").unwrap_err().to_string(),
        "long.toml:6004:1: sphere 2000: found the unknown key \"colour\", expected perhaps color"
    );
    let text = format!("{CAMERA}{}{CAMERA}", SPHERE.repeat(2000));
    assert_eq!(
        Scene::parse(&text, "long.toml").unwrap_err().to_string(),
        "long.toml:6004:1: camera: found a second table, expected only one"
    );
}

#[test]
fn a_name_is_a_built_in_scene_or_a_file() {
    let (scene, source) = Scene::open("trio").unwrap();
    assert_eq!(
        (scene, source),
        (Builtin::Trio.scene(), Source::Builtin(Builtin::Trio))
    );

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, format!("{CAMERA}{SPHERE}")).unwrap();
    let (scene, source) = Scene::open(path.to_str().unwrap()).unwrap();
    assert_eq!(scene.name, "mine");
    assert_eq!(source, Source::File(path));

    assert_eq!(
        Scene::open("grasing").unwrap_err().to_string(),
        "grasing: found no such file and no such built-in scene, expected perhaps grazing"
    );
}

#[test]
fn every_spelling_of_toml_says_the_same() {
    let tables =
        format!("name = \"same\"\n{CAMERA}{WINDOW}[light]\nposition = [1, 2, 3]\n{SPHERE}");
    let inline = "\u{feff}name = 'same'\r\n\
        sphere = [{ center = [0.0, +0, 0e7], radius = 0x1 }]\r\n\
        light.position = [\r\n1,\r\n2_000e-3, 3.0, # light\r\n]\r\n\
        camera = { projection = \"orthographic\", extent = [4, 3], position = [0, 0, 1_0], \
        look_at = [0, 0, 0] }\r\n";
    assert_eq!(Scene::parse(inline, "same"), Scene::parse(&tables, "same"));
}

fn rayscope(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_program_prints_each_built_in_scene_as_a_file_of_it() {
    for builtin in Builtin::ALL {
        let output = rayscope(&["scenes", builtin.name()]);
        assert!(output.status.success());
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(Scene::parse(&text, "printed.toml"), Ok(builtin.scene()));
    }
}

#[test]
fn the_program_refuses_a_scene_that_it_does_not_have_by_offering_its_own() {
    let output = rayscope(&["scenes", "tutorail"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    for builtin in Builtin::ALL {
        assert!(said.contains(builtin.name()), "{said}");
    }
    assert!(said.contains("similar value exists: 'tutorial'"), "{said}");

    let output = rayscope(&["no-such.toml"]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.starts_with("rayscope: no-such.toml: found no such file"),
        "{said}"
    );
}
