//! The view: what is seen does not depend on what was left out, and is shown as it is.

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::Sphere;
use rayscope::method::Method;
use rayscope::method::exact::Stage;
use rayscope::render::{
    CELL_ASPECT, ColorDepth, Contact, Frame, Image, Look, Lost, Style, View, fit,
};
use rayscope::scene::{Body, Camera, Light, PixelShape, Projection, Rays, Scene, Size};

/// So many cases, or as many as `RAYSCOPE_FRAMES` asks for.
fn cases(usual: u32) -> u32 {
    std::env::var("RAYSCOPE_FRAMES").map_or(usual, |n| n.parse().expect("a number of cases"))
}

fn body(center: [f32; 3], radius: f32) -> Body {
    Body {
        sphere: Sphere::new(center.into(), radius).expect("a sphere"),
        name: None,
        color: None,
    }
}

fn scene(camera: Camera, bodies: Vec<Body>) -> Scene {
    Scene {
        name: "test".into(),
        about: None,
        camera,
        pixels: None,
        bodies,
        light: None,
        probes: Vec::new(),
    }
}

/// The tutorial's screen.
fn tutorial() -> Scene {
    let camera = Camera {
        projection: Projection::Orthographic {
            extent: [40.0, 40.0],
            step: None,
        },
        position: Vec3::new(19.5, 19.5, 0.0),
        look_at: Vec3::new(19.5, 19.5, 20.0),
        up: Vec3::NEG_Y,
    };
    Scene {
        pixels: Some(Size::new(40, 40)),
        ..scene(camera, vec![body([20.0; 3], 10.0)])
    }
}

fn looking_down_z(position: [f32; 3]) -> Camera {
    let position = Vec3::from(position);
    Camera {
        projection: Projection::Perspective {
            field_of_view: 45.0,
        },
        position,
        look_at: position - Vec3::Z,
        up: Vec3::Y,
    }
}

fn rendered(scene: &Scene, size: Size, method: Method, view: View) -> Frame {
    let shape = scene
        .pixels
        .map_or(PixelShape::Aspect(1.0), |_| PixelShape::Own);
    let mut frame = Frame::new();
    frame.render(scene, &Rays::new(&scene.camera, size, shape), method, view);
    frame
}

fn drawn(scene: &Scene, cells: (u32, u32), view: View, look: Look) -> Image {
    let (size, shape) = fit(scene, look.style, cells.0, cells.1, CELL_ASPECT);
    let mut frame = Frame::new();
    let rays = Rays::new(&scene.camera, size, shape);
    frame.render(scene, &rays, Method::default(), view.shown_in(look.style));
    let mut image = Image::new();
    image.draw(&frame, scene, look);
    image
}

fn text(image: &Image) -> String {
    image
        .lines()
        .flat_map(|line| line.iter().map(|c| c.glyph).chain(['\n']))
        .collect()
}

/// The tutorial's rule, in integers: Δ = 4·(100 − (x−20)² − (y−20)²) is not below 0.
fn tutorials_text() -> String {
    let mut text = String::new();
    for y in -20_i32..20 {
        for x in -20_i32..20 {
            text += if x * x + y * y <= 100 { "++" } else { "--" };
        }
        text.push('\n');
    }
    text
}

#[test]
fn the_seed_is_the_tutorials_text() {
    let look = Look {
        style: Style::Tutorial,
        ..Look::default()
    };
    let text = text(&drawn(&tutorial(), (80, 24), View::Shade, look));
    assert_eq!(text, tutorials_text());
    assert_eq!(text.lines().count(), 40);
    assert!(text.lines().all(|line| line.len() == 80));
    assert_eq!(text.matches('+').count(), 2 * 317);
}

fn count(frame: &Frame, what: impl Fn(Contact) -> bool) -> usize {
    let Size { width, height } = frame.size();
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .filter(|&(x, y)| what(frame.contact(x, y)))
        .count()
}

#[test]
fn the_seed_has_317_hits_of_which_12_are_tangents() {
    for method in Method::ALL {
        let frame = rendered(&tutorial(), Size::new(40, 40), method, View::Class);
        assert_eq!(count(&frame, Contact::meets), 317, "{method}");
        assert_eq!(count(&frame, |c| c == Contact::Tangent), 12, "{method}");
    }
    let hit = rendered(
        &tutorial(),
        Size::new(40, 40),
        Method::Textbook,
        View::Shade,
    )
    .hit(&tutorial(), 20, 20)
    .expect("a hit");
    assert_eq!((hit.body, hit.t), (0, 10.0));
}

#[test]
fn a_sphere_behind_the_eye_is_told_apart_and_not_seen() {
    let mut behind = tutorial();
    behind.bodies[0].sphere.center.z = -20.0;
    let size = Size::new(40, 40);
    let frame = rendered(&behind, size, Method::Textbook, View::Class);
    assert_eq!(count(&frame, |c| c == Contact::SecantBehind), 305);
    assert_eq!(count(&frame, |c| c == Contact::TangentBehind), 12);
    assert_eq!(frame.seen(20, 20), None);
    // The tutorial's boolean cannot tell.
    let look = Look {
        style: Style::Tutorial,
        ..Look::default()
    };
    assert_eq!(
        text(&drawn(&behind, (80, 40), View::Shade, look)),
        tutorials_text()
    );
    let frame = rendered(&behind, size, Method::Textbook, View::Shade);
    assert_eq!(count(&frame, |c| c != Contact::Miss), 0);
}

#[test]
fn of_two_spheres_at_equal_t_the_first_listed_wins() {
    let twin = || body([0.0, 0.0, -5.0], 1.0);
    let scene = scene(looking_down_z([0.0; 3]), vec![twin(), twin()]);
    let frame = rendered(&scene, Size::new(21, 21), Method::default(), View::Shade);
    assert_eq!(frame.seen(10, 10), Some(0));
}

#[test]
fn a_sphere_is_round_in_every_style() {
    for projection in [
        Projection::Perspective {
            field_of_view: 45.0,
        },
        Projection::Orthographic {
            extent: [8.0, 8.0],
            step: None,
        },
    ] {
        for style in Style::ALL {
            for cell_aspect in [1.0, 1.7, 2.0, 2.6] {
                let camera = Camera {
                    projection,
                    ..looking_down_z([0.0; 3])
                };
                let scene = scene(camera, vec![body([0.0, 0.0, -10.0], 3.0)]);
                let (size, shape) = fit(&scene, style, 240, 100, cell_aspect);
                let mut frame = Frame::new();
                let rays = Rays::new(&scene.camera, size, shape);
                frame.render(&scene, &rays, Method::default(), View::Shade);
                let seen = |x: u32, y: u32| frame.seen(x, y).is_some();
                let width = (0..size.width)
                    .filter(|&x| seen(x, size.height / 2))
                    .count();
                let height = (0..size.height)
                    .filter(|&y| seen(size.width / 2, y))
                    .count();
                let aspect = style.pixel_aspect(cell_aspect);
                let off = width as f64 - height as f64 * aspect;
                // A pixel each way may or may not be hit.
                assert!(
                    off.abs() <= 1.0 + aspect && width > 20,
                    "{style:?} {cell_aspect}: {width} by {height}"
                );
            }
        }
    }
}

#[test]
fn any_size_is_drawn_in_any_style() {
    let mut frame = Frame::new();
    let mut image = Image::new();
    let scenes = [
        tutorial(),
        scene(looking_down_z([0.0; 3]), vec![]),
        scene(
            looking_down_z([0.0; 3]),
            vec![body([0.0, 0.0, -3.0], 1.0), body([0.5, 0.0, -2.0], 0.0)],
        ),
    ];
    for scene in &scenes {
        for style in Style::ALL {
            for cells in [
                (0, 0),
                (0, 9),
                (9, 0),
                (1, 1),
                (20, 6),
                (80, 24),
                (500, 200),
            ] {
                for view in View::ALL {
                    for depth in ColorDepth::ALL {
                        let (size, shape) = fit(scene, style, cells.0, cells.1, CELL_ASPECT);
                        if size.area() > 20_000 && depth != ColorDepth::Ansi256 {
                            continue;
                        }
                        let rays = Rays::new(&scene.camera, size, shape);
                        frame.render(scene, &rays, Method::default(), view);
                        let look = Look {
                            style,
                            depth,
                            ascii_only: depth == ColorDepth::None,
                            coarse: false,
                        };
                        image.draw(&frame, scene, look);
                        assert_eq!(image.cells.len(), (image.cols * image.rows) as usize);
                        assert_eq!((image.cols, image.rows), style.cells_of(size));
                        if look.ascii_only {
                            assert!(image.cells.iter().all(|c| c.glyph.is_ascii()));
                        }
                    }
                }
            }
        }
    }
}

fn pixels(frame: &Frame) -> impl Iterator<Item = (u32, u32)> + use<> {
    let Size { width, height } = frame.size();
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

#[test]
fn the_sign_of_delta_is_the_class() {
    for method in Method::ALL {
        let [class, delta] =
            [View::Class, View::Delta].map(|v| rendered(&tutorial(), Size::new(40, 40), method, v));
        for (x, y) in pixels(&class) {
            // Δ/(4Ar²) = 1 − (p/r)²; from twice the radius on it is not shown.
            let expected = 1.0 - ((x as f32 - 20.0).powi(2) + (y as f32 - 20.0).powi(2)) / 100.0;
            let shown = delta.delta(x, y);
            assert_eq!(shown.is_some(), expected > -3.0, "{method} ({x}, {y})");
            assert!(shown.is_none_or(|d| (d - expected).abs() < 1e-5));
            let sign = shown.map_or(-1.0, |d| if d == 0.0 { 0.0 } else { d.signum() });
            let of_class = match class.contact(x, y) {
                Contact::Secant => 1.0,
                Contact::Tangent => 0.0,
                _ => -1.0,
            };
            assert_eq!(sign, of_class, "{method} ({x}, {y})");
        }
    }
}

#[test]
fn what_a_method_lost_is_told_from_what_it_got_wrong() {
    let camera = looking_down_z([0.0, 0.0, 0.0]);
    let far = scene(
        Camera {
            projection: Projection::Perspective {
                field_of_view: 0.05,
            },
            ..camera
        },
        vec![body([0.0, 0.0, -3000.0], 1.0)],
    );
    let size = Size::new(32, 32);
    let exact = rendered(&far, size, Method::Exact, View::Lost);
    let textbook = rendered(&far, size, Method::Textbook, View::Lost);
    let class = rendered(&far, size, Method::Textbook, View::Class);
    let [mut wrong, mut lost] = [0, 0];
    for (x, y) in pixels(&exact) {
        let seen = exact.seen(x, y);
        assert_eq!(exact.lost(x, y), seen.map(|_| Lost::Bits(0.0)));
        match textbook.lost(x, y) {
            None => assert_eq!(seen, None),
            Some(Lost::Everything) => {
                // Of one sphere it can touch where it crosses.
                let touches = class.contact(x, y) == Contact::Tangent;
                assert!(textbook.seen(x, y) != seen || touches, "({x}, {y})");
                wrong += 1;
            }
            Some(Lost::Bits(bits)) => {
                assert_eq!(textbook.seen(x, y), seen);
                assert!((0.0..=24.0).contains(&bits));
                lost += u32::from(bits > 4.0);
            }
        }
    }
    assert!(wrong > 20 && lost > 100, "{wrong} wrong, {lost} lost");
}

#[test]
fn the_stages_of_the_seed_are_the_first_and_for_its_tangents_the_plain_one() {
    let size = Size::new(40, 40);
    let [class, stage] =
        [View::Class, View::Stage].map(|v| rendered(&tutorial(), size, Method::Textbook, v));
    for (x, y) in pixels(&class) {
        let expected = match class.contact(x, y) {
            Contact::Tangent => Stage::Unrounded,
            _ => Stage::Binary64,
        };
        assert_eq!(stage.stage(x, y), Some(expected), "({x}, {y})");
    }
}

#[test]
fn depth_runs_from_the_nearest_to_the_farthest_and_normals_point_outwards() {
    let size = Size::new(40, 40);
    let depth = rendered(&tutorial(), size, Method::Exact, View::Depth);
    assert_eq!(depth.range(), Some([10.0, 20.0]));
    for (t, nearness) in [(10.0, 1.0), (200.0_f32.sqrt(), 0.5), (20.0, 0.0)] {
        assert!((depth.nearness(t) - nearness).abs() < 1e-6);
    }
    let normal = rendered(&tutorial(), size, Method::Exact, View::Normal);
    // The tutorial's screen has y downwards, and its sphere's centre at (20, 20).
    for ((x, y), n) in [
        ((20, 20), [0.0, 0.0, 1.0]),
        ((26, 20), [0.6, 0.0, 0.8]),
        ((20, 14), [0.0, 0.6, 0.8]),
        ((12, 26), [-0.8, -0.6, 0.0]),
    ] {
        let found = normal.normal(&tutorial(), x, y).expect("a hit");
        assert!(found.distance(n.into()) < 1e-6, "{found}");
    }
}

#[test]
fn every_view_can_be_read_in_every_style_without_colour() {
    let mut scene = tutorial();
    scene.bodies.push(body([28.0, 26.0, 12.0], 5.0));
    for style in [Style::Half, Style::Braille, Style::Ascii] {
        for view in [View::Depth, View::Normal, View::Delta] {
            let look = Look {
                style,
                depth: ColorDepth::None,
                ascii_only: false,
                coarse: false,
            };
            let image = drawn(&scene, (40, 40), view, look);
            let mut glyphs: Vec<_> = image.cells.iter().map(|c| c.glyph).collect();
            glyphs.sort_unstable();
            glyphs.dedup();
            assert!(glyphs.len() > 4, "{style:?} {view:?}: {glyphs:?}");
        }
    }
}

/// A vector that has a length.
fn any_direction() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0_f32..1.0)
        .prop_map(Vec3::from)
        .prop_filter("zero", |v| v.length() > 0.01)
}

/// Spheres about the point `eye`, from around it to far away; some just touch it, some hold it.
fn any_body(eye: Vec3) -> impl Strategy<Value = Body> {
    (any_direction(), -3_i32..14, 0_u8..6).prop_map(move |(offset, power, kind)| {
        let offset = offset * 2_f32.powi(power);
        let radius = match kind {
            0 => offset.length(),
            1 => offset.length() * (1.0 - 1e-6),
            2 => offset.length() * 1.5,
            3 => offset.length() * 0.1,
            4 => 0.0,
            _ => 1.0,
        };
        body((eye + offset).to_array(), radius)
    })
}

/// An eye that has the first sphere in the picture, before it or behind it, or anything else.
fn any_camera(eye: Vec3, bodies: &[Body]) -> impl Strategy<Value = Camera> + use<> {
    let target = bodies[0].sphere;
    let offset = target.center - eye;
    let size = (target.radius / offset.length()).clamp(1e-4, 1.0);
    let towards = prop_oneof![
        Just(offset),
        any_direction().prop_map(move |v| target.radius * v - offset),
        any_direction().prop_map(move |v| offset + target.radius * v),
        any_direction(),
    ];
    let zoom = 0.5_f32..8.0;
    (any::<bool>(), towards, zoom).prop_filter_map(
        "looks nowhere",
        move |(perspective, v, zoom)| {
            let projection = if perspective {
                let field_of_view = (zoom * size).to_degrees().min(170.0);
                Projection::Perspective { field_of_view }
            } else {
                let extent = (zoom * target.radius).max(0.1);
                Projection::Orthographic {
                    extent: [extent, extent],
                    step: None,
                }
            };
            let camera = Camera {
                projection,
                position: eye,
                look_at: eye + v,
                up: Vec3::Y,
            };
            camera.check().is_ok().then_some(camera)
        },
    )
}

fn any_scene() -> impl Strategy<Value = Scene> {
    let eye = prop_oneof![Just(Vec3::ZERO), Just(Vec3::new(1000.0, -20.0, 3.0))];
    let light = prop_oneof![
        Just(None),
        Just(Some(Light {
            position: Vec3::new(3.0, 5.0, 1.0)
        }))
    ];
    eye.prop_flat_map(|eye| (Just(eye), prop::collection::vec(any_body(eye), 1..6)))
        .prop_flat_map(|(eye, mut bodies)| {
            bodies.push(bodies[0].clone());
            (any_camera(eye, &bodies), Just(bodies))
        })
        .prop_flat_map(move |(camera, bodies)| {
            let light = light.clone();
            light.prop_map(move |light| Scene {
                light,
                ..scene(camera, bodies.clone())
            })
        })
}

/// Everything that a frame says of each pixel.
fn said(scene: &Scene, frame: &Frame) -> Vec<impl PartialEq + std::fmt::Debug + use<>> {
    pixels(frame)
        .map(|(x, y)| {
            let hit = frame
                .hit(scene, x, y)
                .map(|hit| (hit.body, hit.t.to_bits()));
            let numbers = (
                frame.brightness(x, y).to_bits(),
                frame.delta(x, y).map(f32::to_bits),
                frame.lost(x, y),
                frame.stage(x, y),
            );
            let normal = frame.normal(scene, x, y);
            (
                (x, y),
                hit,
                frame.contact(x, y),
                frame.outline(scene, x, y),
                numbers,
                normal.map(|n| n.to_array().map(f32::to_bits)),
            )
        })
        .collect()
}

fn assert_same_in(frames: &mut [Frame; 2], scene: &Scene, rays: &Rays, method: Method, view: View) {
    let [some, all] = frames;
    some.render(scene, rays, method, view);
    all.render_all(scene, rays, method, view);
    assert_eq!(some.range(), all.range());
    for (some, all) in said(scene, some).iter().zip(&said(scene, all)) {
        assert_eq!(some, all, "{method}, {}", view.name());
    }
}

fn assert_same(scene: &Scene, size: Size, shape: PixelShape) {
    let rays = Rays::new(&scene.camera, size, shape);
    let mut frames = [Frame::new(), Frame::new()];
    for method in Method::ALL {
        for view in View::ALL {
            assert_same_in(&mut frames, scene, &rays, method, view);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(500)))]

    #[test]
    fn what_is_left_out_changes_no_bit(
        scene in any_scene(),
        (width, height) in (1_u32..40, 1_u32..30),
        method in prop::sample::select(&Method::ALL[..]),
        view in prop::sample::select(&View::ALL[..]),
    ) {
        let rays = Rays::new(&scene.camera, Size::new(width, height), PixelShape::Aspect(1.5));
        let mut frames = [Frame::new(), Frame::new()];
        assert_same_in(&mut frames, &scene, &rays, method, view);
        assert_same_in(&mut frames, &scene, &rays, Method::Exact, View::Shade);
    }
}

#[test]
fn what_is_left_out_changes_no_bit_at_the_ends_of_the_range() {
    let bodies = vec![
        body([0.0, 0.0, -1e30], 1e29),
        body([0.0, 1.0, -3e38], 1e38),
        body([1e-30, 0.0, -1e-30], 1e-31),
        body([0.0, 0.0, -1e20], 1e-30),
        body([0.0, 0.0, -5.0], 0.0),
        body([0.0, 0.0, 0.0], 0.0),
    ];
    for field_of_view in [1e-30, 1e-3, 179.999_98] {
        let camera = Camera {
            projection: Projection::Perspective { field_of_view },
            ..looking_down_z([0.0; 3])
        };
        let scene = scene(camera, bodies.clone());
        assert_same(&scene, Size::new(17, 17), PixelShape::Aspect(1.0));
    }
    for extent in [1e-38, 1e-30, 1e30] {
        let camera = Camera {
            projection: Projection::Orthographic {
                extent: [extent, extent],
                step: None,
            },
            ..looking_down_z([0.0; 3])
        };
        let scene = scene(camera, bodies.clone());
        assert_same(&scene, Size::new(17, 17), PixelShape::Aspect(1.0));
    }
}

/// From z = 1e7 both near roots round alike; the outer sphere is in front, wherever it is listed.
#[test]
fn of_spheres_about_one_point_exact_sees_the_outer_one_from_far_away() {
    let camera = Camera {
        projection: Projection::Orthographic {
            extent: [4.0, 4.0],
            step: None,
        },
        position: Vec3::new(0.0, 0.0, 1e7),
        look_at: Vec3::ZERO,
        up: Vec3::Y,
    };
    let scene = scene(camera, vec![body([0.0; 3], 1.0), body([0.0; 3], 1.2)]);
    let size = Size::new(40, 40);
    for view in View::ALL {
        let frame = rendered(&scene, size, Method::Exact, view);
        let seen: Vec<_> = pixels(&frame)
            .filter_map(|(x, y)| frame.seen(x, y))
            .collect();
        assert!(seen.len() > 300, "{view:?}");
        assert!(seen.iter().all(|&body| body == 1), "{view:?}");
    }
    let frame = rendered(&scene, size, Method::Exact, View::Shade);
    assert!(frame.plan().counts().ties > 200);
    // The others go by their own numbers, which are equal, and are shown to be wrong.
    let frame = rendered(&scene, size, Method::Double, View::Lost);
    assert_eq!(frame.seen(20, 20), Some(0));
    assert_eq!(frame.lost(20, 20), Some(Lost::Everything));
    assert_same(&scene, Size::new(15, 15), PixelShape::Aspect(1.0));
}
