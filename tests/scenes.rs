//! Scene files: what is written reads back, what is wrong is said in one sentence, and the built-in
//! scenes teach what they promise.

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::Sphere;
use rayscope::scene::{Aim, Body, Builtin, Camera, Light, Probe, Projection, Rgb, Scene, Size};

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
