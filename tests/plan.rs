//! The plan of a frame: what it leaves out, counted, and that this changes no bit from frame to frame.

use std::process::Command;

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::Sphere;
use rayscope::lab::{BenchQueue, frames};
use rayscope::method::Method;
use rayscope::random::Random;
use rayscope::render::{Allowance, Counts, Frame, Image, Look, Style, View};
use rayscope::scene::{Body, Builtin, Camera, PixelShape, Projection, Rays, Scene, Size};

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

fn scene(projection: Projection, bodies: Vec<Body>) -> Scene {
    Scene {
        name: "test".into(),
        about: None,
        camera: Camera {
            projection,
            position: Vec3::ZERO,
            look_at: Vec3::NEG_Z,
            up: Vec3::Y,
        },
        pixels: None,
        bodies,
        light: None,
        probes: Vec::new(),
    }
}

const WIDE: Projection = Projection::Perspective {
    field_of_view: 60.0,
};

fn rays_of(scene: &Scene, size: Size) -> Rays {
    let shape = scene
        .pixels
        .map_or(PixelShape::Aspect(1.0), |_| PixelShape::Own);
    Rays::new(&scene.camera, size, shape)
}

fn pixels(size: Size) -> impl Iterator<Item = (u32, u32)> {
    (0..size.height).flat_map(move |y| (0..size.width).map(move |x| (x, y)))
}

/// Everything that a frame says of each pixel, and the cells that show it.
fn said(scene: &Scene, frame: &Frame) -> Vec<impl PartialEq + std::fmt::Debug + use<>> {
    pixels(frame.size())
        .map(|(x, y)| {
            let hit = frame.hit(scene, x, y);
            (
                (x, y),
                hit.map(|hit| (hit.body, hit.t.to_bits())),
                frame.contact(x, y),
                frame.outline(scene, x, y),
                (
                    frame.brightness(x, y).to_bits(),
                    frame.delta(x, y).map(f32::to_bits),
                    frame.lost(x, y),
                    frame.stage(x, y),
                ),
                frame
                    .normal(scene, x, y)
                    .map(|n| n.to_array().map(f32::to_bits)),
            )
        })
        .collect()
}

/// A frame with the plan, one that is put down again and again, and one without the plan, which must come
/// to the same.
struct Pair {
    planned: Frame,
    sliced: Frame,
    random: Random,
    whole: Frame,
    drawn: Image,
}

impl Pair {
    fn new() -> Self {
        Self {
            planned: Frame::new(),
            sliced: Frame::new(),
            random: Random::new(1),
            whole: Frame::new(),
            drawn: Image::new(),
        }
    }

    /// The next frame, by both; the counts of the plan.
    fn check(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) -> Counts {
        self.planned.render(scene, rays, method, view);
        self.whole.render_all(scene, rays, method, view);
        self.render_in_slices(scene, rays, method, view);
        let whole = said(scene, &self.whole);
        for frame in [&self.planned, &self.sliced] {
            assert_eq!(frame.range(), self.whole.range());
            for (planned, whole) in said(scene, frame).iter().zip(&whole) {
                assert_eq!(planned, whole, "{method}, {}", view.name());
            }
        }
        // The picture that is mended cell by cell is the one that is drawn from scratch.
        let look = Look {
            style: Style::Braille,
            ..Look::default()
        };
        self.drawn.draw(&self.planned, scene, look);
        let mut anew = Image::new();
        anew.draw(&self.whole, scene, look);
        assert_eq!(self.drawn.cells, anew.cells, "{method}, {}", view.name());
        for frame in [&self.planned, &self.whole] {
            assert_that_counts_meet(scene, frame);
        }
        *self.planned.plan().counts()
    }
}

impl Pair {
    /// The next frame in slices of random lengths; now and then another one was begun before and is put
    /// away.
    fn render_in_slices(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        let Self { sliced, random, .. } = self;
        let mut slice = |most| Allowance::of(1 + random.below(most));
        let longest = 1 << slice(14).units();
        if slice(4).units() == 1 {
            let other = View::ALL[slice(View::ALL.len() as u64).units() as usize - 1];
            sliced.begin(scene, rays, Method::Exact, other);
            sliced.go_on(scene, rays, &mut slice(longest));
        }
        sliced.begin(scene, rays, method, view);
        let mut share = 0.0;
        while !sliced.go_on(scene, rays, &mut slice(longest)) {
            assert!((share..1.0).contains(&sliced.share_done()));
            share = sliced.share_done();
        }
        assert_eq!(sliced.share_done(), 1.0);
        let [planned, sliced] = [&self.planned, &self.sliced].map(|frame| *frame.plan().counts());
        if planned.kept == sliced.kept {
            let rays = planned.rays;
            assert_eq!(planned, Counts { rays, ..sliced }, "{method}, {view:?}");
        }
    }
}

/// Whatever is counted of something is no more than there is of it, and what was done and what was not are
/// all of it.
fn assert_that_counts_meet(scene: &Scene, frame: &Frame) {
    let plan = frame.plan();
    let (spheres, size) = (scene.bodies.len() as u64, frame.size());
    let [pixels, height] = [size.area() as u64, size.height.into()];
    for counts in [Some(plan.counts()), plan.truth()].into_iter().flatten() {
        let c = *counts;
        let met = c.behind + c.outside + c.hidden + c.asked;
        let what = (plan.method(), plan.view(), c);
        assert!(met <= spheres, "{what:?}");
        if plan.counts().kept == 0 {
            assert_eq!(met, spheres, "{what:?}");
        }
        assert!(
            c.rows <= spheres * height && c.spanned <= spheres * pixels,
            "{what:?}"
        );
        assert!(c.around <= c.asked && c.ties <= c.solved, "{what:?}");
        assert!(c.shaded + c.kept <= pixels && c.kept <= pixels, "{what:?}");
        let stages: u64 = c.stages.iter().sum();
        let of_exact = stages == c.solved + c.rounded;
        assert!(
            of_exact || stages == 0 || plan.view() == View::Lost,
            "{what:?}"
        );
    }
}

fn check_everything(scene: &Scene, size: Size) {
    let rays = rays_of(scene, size);
    let mut pair = Pair::new();
    for method in Method::ALL {
        for view in View::ALL {
            pair.check(scene, &rays, method, view);
        }
    }
}

fn counts_of(scene: &Scene, size: Size, view: View) -> Counts {
    let mut frame = Frame::new();
    frame.render(scene, &rays_of(scene, size), Method::Exact, view);
    *frame.plan().counts()
}

#[test]
fn the_tutorials_screen_needs_21_rows_and_317_pixels() {
    let tutorial = Builtin::Tutorial.scene();
    let counts = counts_of(&tutorial, Size::new(40, 40), View::Shade);
    assert_eq!((counts.rows, counts.spanned), (21, 317));
    // The margin: tests go in runs of eight, so up to seven more pixels a row.
    assert!(
        (317..317 + 7 * 21).contains(&counts.tested),
        "{}",
        counts.tested
    );
    // The twelve tangents and four pixels beside them are beyond the test.
    assert_eq!(counts.solved, 16);
    // The other methods look at no more rows; their columns are widened by their error.
    for method in Method::ALL {
        let mut frame = Frame::new();
        let rays = rays_of(&tutorial, Size::new(40, 40));
        frame.render(&tutorial, &rays, method, View::Shade);
        let counts = frame.plan().counts();
        assert_eq!((counts.rows, counts.spanned), (21, 317), "{method}");
    }
}

/// Counts that depend on no machine: a line for each built-in scene and view.
#[test]
fn the_counts_of_the_built_in_scenes() {
    let mut lines = vec![format!(
        "{:12} {:8} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}",
        "scene",
        "view",
        "asked",
        "behind",
        "outsid",
        "hidden",
        "rows",
        "pixels",
        "tests",
        "exact",
        "roots",
        "shaded"
    )];
    for builtin in Builtin::ALL {
        let scene = builtin.scene();
        let size = scene.pixels.unwrap_or(Size::new(80, 48));
        for view in [View::Shade, View::Class, View::Outline, View::Depth] {
            let c = counts_of(&scene, size, view);
            lines.push(format!(
                "{:12} {:8} {:6} {:6} {:6} {:6} {:6} {:6} {:6} {:6} {:6} {:6}",
                builtin.name(),
                view.name(),
                c.asked,
                c.behind,
                c.outside,
                c.hidden,
                c.rows,
                c.spanned,
                c.tested,
                c.solved,
                c.roots,
                c.shaded
            ));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn contours_of_spheres_that_do_not_meet_need_no_root() {
    let apart = scene(
        WIDE,
        vec![
            body([0.0, 0.0, -8.0], 2.0),
            body([0.5, 0.0, -5.0], 0.5),
            body([0.0, 0.0, 0.0], 0.5),
            body([2.0, 1.0, -12.0], 1.0),
        ],
    );
    let meeting = scene(
        WIDE,
        vec![body([0.0, 0.0, -8.0], 2.0), body([1.0, 0.0, -7.0], 2.0)],
    );
    let size = Size::new(60, 40);
    for view in [View::Class, View::Outline] {
        assert_eq!(counts_of(&apart, size, view).roots, 0);
        assert!(counts_of(&meeting, size, view).roots > 0);
    }
    assert!(counts_of(&meeting, size, View::Shade).roots > 0);
    for scene in [apart, meeting] {
        check_everything(&scene, size);
    }
}

#[test]
fn hidden_spheres_are_really_hidden() {
    let mut crowd = frames::scene(3000, 7);
    let size = Size::new(120, 80);
    let rays = rays_of(&crowd, size);
    let mut frame = Frame::new();
    frame.render(&crowd, &rays, Method::Exact, View::Shade);
    let before = said(&crowd, &frame);
    let counts = *frame.plan().counts();
    assert!(counts.hidden > 20, "{counts:?}");
    // Not one of those that are left out is seen, and without them the picture is the same.
    let mut seen = vec![false; crowd.bodies.len()];
    for (x, y) in pixels(size) {
        if let Some(body) = frame.seen(x, y) {
            seen[body as usize] = true;
        }
    }
    // Who is not seen is put away, behind the eye, so that the numbers stay.
    let mut removed = 0;
    for (body, seen) in crowd.bodies.iter_mut().zip(seen) {
        if !seen {
            body.sphere.center = Vec3::new(0.0, 0.0, 1e4);
            removed += 1;
        }
    }
    assert!(removed >= counts.hidden + counts.outside + counts.behind);
    let mut without = Frame::new();
    without.render(&crowd, &rays, Method::Exact, View::Shade);
    assert!(before == said(&crowd, &without));
}

#[test]
fn nothing_is_asked_while_nothing_changes_and_little_when_one_sphere_moves() {
    let mut crowd = Builtin::Crowd.scene();
    let size = Size::new(48, 32);
    let rays = rays_of(&crowd, size);
    let mut pair = Pair::new();
    let whole = pair.check(&crowd, &rays, Method::Exact, View::Shade);
    let all = size.area() as u64;
    assert_eq!((whole.rays, whole.kept), (all, 0));

    // The cursor moves: the picture does not depend on it.
    let still = pair.check(&crowd, &rays, Method::Exact, View::Shade);
    assert_eq!((still.kept, still.tested, still.solved), (all, 0, 0));
    assert_eq!((still.rays, still.asked, still.shaded), (0, 0, 0));

    let seen = pixels(size).find_map(|(x, y)| pair.planned.seen(x, y));
    let seen = seen.expect("a sphere");
    crowd.bodies[seen as usize].sphere.center.x += 0.05;
    let moved = pair.check(&crowd, &rays, Method::Exact, View::Shade);
    assert!(moved.kept > all - all / 10, "{moved:?}");
    assert!(10 * moved.tested < whole.tested, "{moved:?} {whole:?}");
    assert!(10 * moved.asked < whole.asked);
    let [drawn, changed] = [pair.drawn.cells_drawn(), pair.drawn.cells_changed()];
    assert!(11 * drawn < pair.drawn.cells.len() as u64);
    assert!(changed <= drawn);
}

/// While everything moves nothing is kept, nor remembered; once it rests, everything is again.
#[test]
fn a_scene_that_moved_as_a_whole_is_kept_when_it_rests() {
    let mut crowd = frames::scene(5000, 3);
    let size = Size::new(48, 32);
    let all = size.area() as u64;
    let rays = rays_of(&crowd, size);
    let mut pair = Pair::new();
    let check =
        |pair: &mut Pair, scene: &Scene, view| pair.check(scene, &rays, Method::Exact, view).kept;
    for _ in 0..4 {
        assert_eq!(check(&mut pair, &crowd, View::Shade), 0);
        for body in &mut crowd.bodies {
            body.sphere.center.x += 0.01;
        }
    }
    // The first frame at rest finds out, the second keeps.
    assert_eq!(check(&mut pair, &crowd, View::Shade), 0);
    assert_eq!(check(&mut pair, &crowd, View::Shade), 0);
    assert_eq!(check(&mut pair, &crowd, View::Shade), all);
    crowd.bodies[2500].sphere.center.x += 0.05;
    let kept = check(&mut pair, &crowd, View::Shade);
    assert!(0 < kept && kept <= all, "{kept}");
    // Nothing is known of another scene, even one as long as the sample.
    for body in &mut crowd.bodies {
        body.sphere.center.x += 0.01;
    }
    for view in [View::Shade, View::Class] {
        check(&mut pair, &crowd, view);
    }
    crowd.bodies.truncate(64);
    check(&mut pair, &crowd, View::Shade);
    crowd.bodies.truncate(63);
    check(&mut pair, &crowd, View::Shade);
}

/// The cost grows with spheres and with what they cover, not with their product.
#[test]
fn tests_grow_with_what_is_covered() {
    for count in [1, 10, 100, 1000, 10_000, 100_000] {
        let counts = counts_of(&frames::scene(count, 1), Size::new(200, 120), View::Shade);
        let covered = counts.spanned;
        assert!(counts.tested <= 8 * covered, "{count}: {counts:?}");
        assert!(counts.rows <= covered);
        assert!(covered < 50_000 + 10 * count as u64, "{count}: {counts:?}");
    }
}

#[test]
fn the_eye_inside_on_and_just_outside_a_sphere() {
    let r = 3.0_f32;
    for distance in [
        0.0,
        1.0,
        r.next_down(),
        r,
        r.next_up(),
        r * (1.0 + 1e-6),
        r * (1.0 + 1e-4),
        r * 1.01,
        r * 1.2,
    ] {
        for direction in [Vec3::NEG_Z, Vec3::Z, Vec3::X, Vec3::new(0.6, 0.0, -0.8)] {
            let center = direction * distance;
            let bodies = vec![
                body(center.to_array(), r),
                body([0.0, 0.5, -2.0], 0.25),
                body([0.0, -1.0, -9.0], 2.0),
            ];
            let size = Size::new(23, 17);
            let mut pair = Pair::new();
            let orthographic = Projection::Orthographic {
                extent: [7.0, 7.0],
                step: None,
            };
            for projection in [WIDE, orthographic] {
                let scene = scene(projection, bodies.clone());
                let rays = rays_of(&scene, size);
                for view in View::ALL {
                    pair.check(&scene, &rays, Method::Exact, view);
                }
                pair.check(&scene, &rays, Method::Textbook, View::Class);
            }
        }
    }
    let inside = scene(WIDE, vec![body([0.0, 0.0, -1.0], 3.0)]);
    let counts = counts_of(&inside, Size::new(40, 30), View::Shade);
    assert_eq!((counts.around, counts.asked), (1, 1));
}

#[test]
fn spheres_that_straddle_the_plane_of_the_eye() {
    let bodies = (0..24)
        .map(|i| {
            let angle = i as f32;
            let away = 1.5 + 0.25 * angle;
            let z = [0.0, 0.4, -0.4, 1.0, -1.0, 0.999][i % 6];
            body([away * angle.cos(), away * angle.sin(), z], 1.0)
        })
        .collect::<Vec<_>>();
    for field_of_view in [60.0, 120.0, 175.0] {
        let scene = scene(Projection::Perspective { field_of_view }, bodies.clone());
        check_everything(&scene, Size::new(37, 21));
    }
}

#[test]
fn radii_from_1e_minus_30_to_1e_30_in_one_scene() {
    let bodies: Vec<Body> = (-30..=30)
        .step_by(4)
        .flat_map(|power| {
            let scale = 10.0_f32.powi(power);
            let aside = 0.6 * scale * (power as f32).sin();
            [
                body([aside, 0.0, -4.0 * scale], scale),
                body([0.0, aside, -4.0], scale),
            ]
        })
        .collect();
    for bodies in [bodies.clone(), bodies.into_iter().rev().collect()] {
        check_everything(&scene(WIDE, bodies.clone()), Size::new(15, 11));
        let flat = Projection::Orthographic {
            extent: [4.0, 4.0],
            step: None,
        };
        check_everything(&scene(flat, bodies), Size::new(15, 11));
    }
}

#[test]
fn a_hundred_thousand_spheres_at_one_point() {
    let bodies = vec![body([0.1, 0.0, -6.0], 1.0); 100_000];
    let scene = scene(WIDE, bodies);
    let size = Size::new(5, 3);
    let rays = rays_of(&scene, size);
    let mut pair = Pair::new();
    pair.check(&scene, &rays, Method::Exact, View::Shade);
    // Of spheres at equal t the first listed is seen.
    assert!(pixels(size).all(|(x, y)| pair.planned.seen(x, y).is_none_or(|body| body == 0)));
}

/// Around the eye the innermost sphere hides the others, be they listed in any order.
#[test]
fn of_spheres_around_the_eye_hardly_any_is_asked_about() {
    let size = Size::new(160, 120);
    let radius = |i: u32| 3.0 + ((i * 7919) % 4999) as f32 / 1000.0;
    let bodies: Vec<Body> = (0..4999)
        .map(|i| body([0.0, 0.1, 0.0], radius(i)))
        .collect();
    let scene = scene(WIDE, bodies);
    let counts = counts_of(&scene, size, View::Shade);
    assert!(counts.asked < 400, "{counts:?}");
    let mut pair = Pair::new();
    let small = Size::new(5, 4);
    for view in [View::Shade, View::Class, View::Depth, View::Lost] {
        for method in [Method::Exact, Method::Haines] {
            pair.check(&scene, &rays_of(&scene, small), method, view);
        }
    }
}

/// What happens to a scene between two frames.
#[derive(Debug, Clone, Copy)]
enum Step {
    Move(usize, [f32; 3]),
    Grow(usize, f32),
    Swap(usize, usize),
    Remove(usize),
    Turn(f32),
    Ask(Method, View),
    Rest,
}

fn any_step() -> impl Strategy<Value = Step> {
    let offset = prop::array::uniform3(-2.0_f32..2.0);
    prop_oneof![
        6 => (any::<usize>(), offset).prop_map(|(i, by)| Step::Move(i, by)),
        3 => (any::<usize>(), 0.2_f32..2.5).prop_map(|(i, by)| Step::Grow(i, by)),
        1 => (any::<usize>(), any::<usize>()).prop_map(|(i, j)| Step::Swap(i, j)),
        1 => any::<usize>().prop_map(Step::Remove),
        1 => (-0.3_f32..0.3).prop_map(Step::Turn),
        1 => (
            prop::sample::select(&Method::ALL[..]),
            prop::sample::select(&View::ALL[..])
        )
            .prop_map(|(method, view)| Step::Ask(method, view)),
        1 => Just(Step::Rest),
    ]
}

fn any_body() -> impl Strategy<Value = Body> {
    let place = (-6.0_f32..6.0, -5.0_f32..5.0, -14.0_f32..3.0);
    (place, 0.05_f32..2.5).prop_map(|((x, y, z), radius)| body([x, y, z], radius))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(120),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// The frame keeps what it can from the one before; that changes no bit either.
    #[test]
    fn what_is_kept_from_frame_to_frame_changes_no_bit(
        bodies in prop::collection::vec(any_body(), 1..40),
        steps in prop::collection::vec(any_step(), 1..8),
        perspective in any::<bool>(),
        (width, height) in (1_u32..45, 1_u32..30),
        method in prop::sample::select(&Method::ALL[..]),
        view in prop::sample::select(&View::ALL[..]),
    ) {
        let flat = Projection::Orthographic { extent: [9.0, 9.0], step: None };
        let mut scene = scene(if perspective { WIDE } else { flat }, bodies);
        let mut pair = Pair::new();
        let (mut method, mut view) = (method, view);
        pair.check(&scene, &rays_of(&scene, Size::new(width, height)), method, view);
        for step in steps {
            let count = scene.bodies.len();
            match step {
                _ if count == 0 => {}
                Step::Move(i, by) => scene.bodies[i % count].sphere.center += Vec3::from(by),
                Step::Grow(i, by) => scene.bodies[i % count].sphere.radius *= by,
                Step::Swap(i, j) => scene.bodies.swap(i % count, j % count),
                Step::Remove(i) => {
                    scene.bodies.remove(i % count);
                }
                Step::Turn(by) => scene.camera.look_at += Vec3::X * by,
                Step::Ask(m, v) => (method, view) = (m, v),
                Step::Rest => {}
            }
            let rays = rays_of(&scene, Size::new(width, height));
            pair.check(&scene, &rays, method, view);
        }
    }
}

fn rayscope(arguments: &[&str]) -> (String, String, Option<i32>) {
    let queue = BenchQueue::private();
    let (variable, queue) = queue.variable();
    let out = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .env(variable, queue)
        .output()
        .expect("the program runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (text(out.stdout), text(out.stderr), out.status.code())
}

#[test]
fn the_command_prints_the_plan_of_three_frames() {
    let (text, _, status) = rayscope(&["plan", "tutorial"]);
    assert_eq!(status, Some(0));
    assert!(text.lines().all(|line| line.chars().count() <= 80));
    let (json, _, _) = rayscope(&["plan", "tutorial", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let line = |frame: usize, what: &str| {
        let plan = json["frames"][frame]["plan"].as_array().expect("a list");
        let found = plan.iter().find(|line| line["what"] == what);
        let found = found.unwrap_or_else(|| panic!("no {what}"));
        assert!(!found["because"].as_str().expect("words").is_empty());
        [found["kept"].as_u64(), found["left_out"].as_u64()].map(Option::unwrap)
    };
    assert_eq!(line(0, "rows"), [21, 19]);
    assert_eq!(line(0, "columns of rows"), [317, 1283]);
    assert_eq!(line(0, "shades"), [317, 1283]);
    assert_eq!(line(0, "B")[0], 1);
    assert_eq!(line(1, "pixels redrawn"), [0, 1600]);
    assert_eq!(line(1, "bytes sent")[0], 0);
    assert!(line(2, "pixels redrawn")[0] < 500);
    assert!(line(2, "bytes sent")[1] > 0);
    let (csv, _, _) = rayscope(&["plan", "trio", "--method", "kahan", "--format", "csv"]);
    assert!(csv.starts_with("frame,what,kept,left_out,because\nwhole,"));
    assert!(csv.contains("\nsphere,bytes sent,"));
}

#[test]
fn a_plan_of_nothing_is_refused_with_a_sentence() {
    let (_, error, status) = rayscope(&["plan", "trio", "--sphere", "4"]);
    assert_eq!(status, Some(2));
    assert!(error.contains("--sphere 4: expected a sphere of the scene, from 1 to 3"));
    let (_, error, status) = rayscope(&["plan", "./nowhere.toml"]);
    assert_eq!(status, Some(1));
    assert!(error.contains("nowhere.toml"));
}

#[test]
fn bench_frames_lists_spheres_sizes_and_times() {
    let arguments = [
        "bench", "--frames", "--quick", "--counts", "1,10", "--format",
    ];
    let run = |format: &str| rayscope(&[&arguments[..], &[format]].concat());
    let (json, _, status) = run("json");
    assert_eq!(status, Some(0));
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let frames = json["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 4);
    for frame in frames {
        assert!(frame["plan_ms"].as_f64().is_some_and(|ms| ms > 0.0));
        assert!(frame["no_plan_ms"].as_f64().is_some());
        assert_eq!(frame["method"], "exact");
        for key in ["spheres", "width", "height"] {
            assert!(frame[key].as_u64().is_some(), "{key}");
        }
        assert!(frame["encode_ms"].as_f64().is_some() && frame["ratatui_ms"].as_f64().is_some());
    }
    let (csv, _, _) = run("csv");
    assert!(csv.starts_with("spheres,width,height,method,plan_ms,no_plan_ms,"));
    assert!(csv.contains(",encode_ms,bytes,ratatui_ms,ratatui_bytes,"));
    assert_eq!(csv.lines().count(), 5);
    let (markdown, _, _) = run("markdown");
    assert!(markdown.contains("| spheres | pixels |"));
}

#[test]
fn bench_frames_of_the_explorer_has_a_row_for_each_screen() {
    let arguments = [
        "bench",
        "--frames",
        "--quick",
        "--explorer",
        "trio",
        "--format",
    ];
    let run = |format: &str| rayscope(&[&arguments[..], &[format]].concat());
    let (json, _, status) = run("json");
    assert_eq!(status, Some(0));
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let frames = json["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 2);
    for (frame, size) in frames.iter().zip([[80, 24], [200, 60]]) {
        assert_eq!([&frame["width"], &frame["height"]], size);
        assert_eq!(
            (&frame["scene"], &frame["spheres"]),
            (&"trio".into(), &3.into())
        );
        for key in ["plan_ms", "cells_ms", "encode_ms", "ratatui_ms"] {
            assert!(frame[key].as_f64().is_some_and(|ms| ms > 0.0), "{key}");
        }
        let bytes = |key: &str| frame[key].as_u64().expect("bytes");
        assert!(2 * bytes("bytes") <= bytes("ratatui_bytes"), "{frame}");
    }
    let (csv, _, _) = run("csv");
    assert!(csv.starts_with("scene,spheres,width,height,method,steps,plan_ms,"));
    let (text, _, _) = run("text");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}
