//! Keys are answered soon whatever the scene: work is done in slices of bounded work, between which a key
//! has its turn, and what is drawn in the end does not depend on how often one had.
//!
//! The longest key is printed (`cargo test --test keys -- --nocapture`), by the clock, which no test asserts.

use std::time::{Duration, Instant};

use glam::Vec3;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use rayscope::explorer::{Explorer, Options, Setting};
use rayscope::geometry::Sphere;
use rayscope::method::Method;
use rayscope::random::Random;
use rayscope::render::{Allowance, Counts, Frame, View};
use rayscope::scene::{Body, Builtin, PixelShape, Rays, Scene, Size, Source};
use rayscope::terminal::{Limits, Painter};

const SCREEN: (u16, u16) = (200, 60);

/// As long as the loop between terminal and explorer works at a time.
const SLICE: Duration = Duration::from_millis(20);

/// Spheres that a random number makes, seen from 9 before the origin.
fn scene(name: &str, count: usize, mut sphere: impl FnMut(&mut Random) -> Sphere) -> Scene {
    let mut random = Random::new(1);
    let bodies = (0..count).map(|_| Body {
        sphere: sphere(&mut random),
        name: None,
        color: None,
    });
    let bodies = bodies.collect();
    let mut scene = Builtin::Trio.scene();
    (scene.name, scene.bodies) = (name.into(), bodies);
    scene.probes.clear();
    scene.camera.position = Vec3::new(0.0, 0.0, 9.0);
    scene.camera.look_at = Vec3::ZERO;
    scene
}

fn near(random: &mut Random, reach: f64) -> Vec3 {
    Vec3::from([0; 3].map(|_| random.uniform(-reach, reach) as f32))
}

/// Spheres that no rounded number tells apart, so that exact signs have to.
fn nearly_coincident(count: usize) -> Scene {
    scene("nearly coincident", count, |random| Sphere {
        center: near(random, 1e-6),
        radius: 1.0 + random.uniform(0.0, 1e-6) as f32,
    })
}

fn around_the_eye(count: usize) -> Scene {
    scene("around the eye", count, |random| Sphere {
        center: Vec3::new(0.0, 0.0, 9.0) + near(random, 2.0),
        radius: 5.0 + random.uniform(0.0, 1.0) as f32,
    })
}

/// An explorer on a terminal, whose loop is ours.
struct Desk {
    explorer: Explorer,
    painter: Painter,
    longest: (Duration, String),
}

impl Desk {
    fn opens(scene: Scene, settings: &[Setting]) -> Self {
        let source = Source::Builtin(Builtin::Trio);
        let mut explorer = Explorer::new(scene, &source, Options::default());
        explorer.set_out(settings).expect("a place");
        let mut desk = Self {
            explorer,
            painter: Painter::default(),
            longest: (Duration::ZERO, String::new()),
        };
        desk.turn("opening", |_| ());
        desk
    }

    /// Something happens and the screen is drawn; whether all is done.
    fn turn(&mut self, what: &str, act: impl FnOnce(&mut Explorer)) -> bool {
        let start = Instant::now();
        act(&mut self.explorer);
        let (cols, rows) = SCREEN;
        let is_done = self.explorer.prepare_within(cols, rows, SLICE);
        let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
        let cursor = self.explorer.draw(&mut buffer);
        self.painter.paint(&mut buffer, cursor, Limits::default());
        let name = || format!("{what}, {}", self.explorer.scene().name);
        let taken = start.elapsed();
        if taken > self.longest.0 {
            self.longest = (taken, name());
        }
        is_done
    }

    fn press(&mut self, key: KeyCode) -> bool {
        self.turn(&format!("{key:?}"), |explorer| {
            explorer.update(&pressed(key));
        })
    }

    fn types(&mut self, line: &str) {
        let keys = format!(":{line}");
        for key in keys.chars().map(KeyCode::Char) {
            self.explorer.update(&pressed(key));
        }
        self.turn(line, |explorer| {
            explorer.update(&pressed(KeyCode::Enter));
        });
    }
}

#[test]
fn the_longest_key_of_a_hostile_walk() {
    let textbook = [Setting::Method(Method::Textbook)];
    let crowd = || Builtin::Crowd.scene();
    let desks = vec![
        Desk::opens(nearly_coincident(100_000), &[]),
        Desk::opens(nearly_coincident(20_000), &textbook),
        Desk::opens(around_the_eye(20_000), &[]),
        Desk::opens(around_the_eye(20_000), &textbook),
        Desk::opens(crowd(), &textbook),
        Desk::opens(crowd(), &[Setting::View(View::Lost)]),
    ];
    let mut longest = (Duration::ZERO, String::new());
    for mut desk in desks {
        for key in "da12345678".chars() {
            desk.press(KeyCode::Char(key));
        }
        for line in [
            "set position.z 1e20",
            "dial distance 12",
            "view lost",
            "view stage",
        ] {
            desk.types(line);
            for key in [KeyCode::Left, KeyCode::Char('d'), KeyCode::Null] {
                desk.press(key);
            }
        }
        longest = longest.max(desk.longest);
    }
    println!("the longest: {:.1?}, {}", longest.0, longest.1);
}

/// In tests of eight pixels and questions to a method, of which one may be long.
fn work(counts: &Counts) -> u64 {
    counts.tested / 8 + counts.hidden_runs + counts.solved + counts.rounded
}

#[test]
fn a_slice_is_bounded_work() {
    const SLICE_OF_WORK: u64 = 10_000;
    let size = Size::new(80, 48);
    for scene in [nearly_coincident(2000), around_the_eye(500)] {
        let rays = Rays::new(&scene.camera, size, PixelShape::Aspect(1.0));
        for (method, view) in [
            (Method::Exact, View::Shade),
            (Method::Exact, View::Depth),
            (Method::Textbook, View::Lost),
        ] {
            let mut frame = Frame::new();
            frame.begin(&scene, &rays, method, view);
            let mut before = 0;
            let mut slices = 0;
            while !frame.go_on(&scene, &rays, &mut Allowance::of(SLICE_OF_WORK)) {
                let plan = frame.plan();
                let after = work(plan.counts()) + plan.truth().map_or(0, work);
                let done = after - before;
                // A sphere is put down once it was asked about some hundred times, at the end of a row.
                assert!(done <= SLICE_OF_WORK + 1000, "{done}, {}", scene.name);
                (before, slices) = (after, slices + 1);
            }
            assert!(slices > 2, "{slices}, {}", scene.name);
        }
    }
}

/// Keys that come while the picture is unfinished, and those that wait for it, lead to the same screen.
#[test]
fn a_screen_that_came_in_slices_is_the_same() {
    let mut random = Random::new(3);
    for scene in [
        around_the_eye(60),
        nearly_coincident(60),
        Builtin::Crowd.scene(),
    ] {
        let [mut patient, mut hasty] = [(); 2].map(|()| {
            let source = Source::Builtin(Builtin::Trio);
            Explorer::new(scene.clone(), &source, Options::default())
        });
        let screen = |explorer: &Explorer| {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 24));
            explorer.draw(&mut buffer);
            buffer
        };
        for _ in 0..12 {
            for _ in 0..=random.below(4) {
                let key = b"adwsvvmmhjl9\\"[random.below(13) as usize] as char;
                for explorer in [&mut patient, &mut hasty] {
                    explorer.update(&pressed(KeyCode::Char(key)));
                }
                patient.prepare(80, 24);
                for _ in 0..random.below(4) {
                    hasty.prepare_within(80, 24, Duration::ZERO);
                }
            }
            while !hasty.prepare_within(80, 24, Duration::ZERO) {}
            // What changed since the key before depends on what was seen of it.
            for explorer in [&mut patient, &mut hasty] {
                explorer.update(&pressed(KeyCode::Esc));
                explorer.prepare(80, 24);
            }
            assert_eq!(screen(&hasty), screen(&patient), "{}", scene.name);
        }
    }
}

fn pressed(key: KeyCode) -> Event {
    Event::Key(KeyEvent::new(key, KeyModifiers::NONE))
}
