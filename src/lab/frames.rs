//! The time of whole frames, with the plan and without it, for growing numbers of spheres.
//!
//! Every sphere moves from frame to frame, so each frame is planned and asked again; the plan's own time
//! is part of its frame's.

mod report;

pub use report::{brief, json, markdown, records, text};

use std::hint::black_box;

use glam::{DVec3, Vec3};

use super::errors::nearest_rank;
use super::timing::Clock;
use crate::geometry::Sphere;
use crate::method::Method;
use crate::random::Random;
use crate::render::{ColorDepth, Frame, Image, Look, Style, View};
use crate::scene::{Body, Camera, PixelShape, Projection, Rays, Scene, Size};

/// Half the side of the cube that holds the spheres.
const HALF_SIDE: f64 = 10.0;

/// `count` spheres at random places of a cube, all before the eye: their radii shrink as their
/// number grows, so that they fill about the same share of the cube.
pub fn scene(count: usize, seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let spacing = 2.0 * HALF_SIDE / (count as f64).cbrt();
    let bodies = (0..count)
        .map(|_| {
            let radius = spacing * random.uniform(0.2, 0.45);
            let reach = HALF_SIDE - radius;
            let center = DVec3::from([0; 3].map(|_| random.uniform(-reach, reach)));
            Body {
                sphere: Sphere {
                    center: center.as_vec3(),
                    radius: radius as f32,
                },
                name: None,
                color: None,
            }
        })
        .collect();
    Scene {
        name: format!("{count} spheres"),
        about: None,
        camera: Camera {
            projection: Projection::Perspective {
                field_of_view: 45.0,
            },
            position: Vec3::new(0.0, 0.0, 30.0),
            look_at: Vec3::ZERO,
            up: Vec3::Y,
        },
        pixels: None,
        bodies,
        light: None,
        probes: Vec::new(),
    }
}

/// Where the cells of a picture go.
pub trait CellOutput {
    /// Compares a picture with what is shown and writes the difference; how many bytes that took.
    fn show(&mut self, image: &Image) -> usize;
    /// The same by ratatui's own backend, on a screen of its own.
    fn show_by_ratatui(&mut self, image: &Image) -> usize;
}

/// What a run is to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameSchedule {
    /// Numbers of spheres, ascending.
    pub counts: Vec<usize>,
    /// Sizes of the picture, in pixels.
    pub sizes: Vec<Size>,
    /// The methods.
    pub methods: Vec<Method>,
    /// How often a frame is drawn at most.
    pub rounds: usize,
    /// From this many milliseconds on no further frames are drawn, once there are three with the plan
    /// and one without.
    pub budget: f64,
    /// What the scenes are drawn from.
    pub seed: u64,
}

impl FrameSchedule {
    /// The usual run, or a quick one.
    pub fn new(quick: bool, seed: u64) -> Self {
        let powers = if quick { 0..=4 } else { 0..=6 };
        Self {
            counts: powers.map(|power| 10_usize.pow(power)).collect(),
            sizes: vec![Size::new(80, 48), Size::new(200, 120)],
            methods: vec![Method::Exact],
            rounds: if quick { 15 } else { 101 },
            budget: if quick { 100.0 } else { 1000.0 },
            seed,
        }
    }

    /// How many rows the report will have.
    pub fn rows(&self) -> usize {
        self.counts.len() * self.sizes.len() * self.methods.len()
    }
}

/// A frame without the plan that would take longer than this many milliseconds is not drawn.
const TOO_LONG: f64 = 60_000.0;

/// The times of one number of spheres, size and method: medians, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRow {
    /// Spheres in the scene.
    pub spheres: usize,
    /// The picture.
    pub size: Size,
    /// The method.
    pub method: Method,
    /// A frame with the plan, shaded: planning and rays.
    pub plan_ms: f64,
    /// The quickest of them.
    pub best_ms: f64,
    /// A frame that asks every pixel about every sphere; none where it would take over a minute.
    pub no_plan_ms: Option<f64>,
    /// A frame in which one sphere has moved.
    pub one_moved_ms: f64,
    /// Where the time of a frame with the plan goes, to the last byte.
    pub parts: Parts,
    /// Pixels within the columns of the spheres that were asked about, counted for each sphere.
    pub covered: u64,
    /// Bytes of a frame, for 256 colours and half blocks.
    pub bytes: usize,
    /// Those that ratatui's own backend writes for it.
    pub ratatui_bytes: usize,
}

/// Where the time of a frame goes, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parts {
    /// To find where each sphere can be seen.
    pub plan: f64,
    /// To ask what the rays hit, and to shade it.
    pub rays: f64,
    /// To turn pixels into characters and colours.
    pub cells: f64,
    /// To compare the cells with those that are shown.
    pub diff: f64,
    /// To write the bytes of those that differ.
    pub encode: f64,
    /// The same by ratatui's own backend.
    pub ratatui: f64,
}

impl FrameRow {
    /// Whether the plan is quicker, planning included; unknown frames without it are slower.
    pub fn pays(&self) -> bool {
        self.no_plan_ms.is_none_or(|without| self.plan_ms < without)
    }

    /// What the cost should be in proportion to.
    fn work(&self) -> f64 {
        self.spheres as f64 + self.covered as f64
    }
}

/// The rows of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTimes {
    /// What the scenes were drawn from.
    pub seed: u64,
    /// Whether all rows are there.
    pub complete: bool,
    /// The rows, in the order in which they were measured.
    pub rows: Vec<FrameRow>,
}

impl FrameTimes {
    /// The slope of log time over log work, where the work is spheres and the pixels that they cover
    /// together: 1 if time grows in proportion to their sum. None of fewer than two rows.
    pub fn slope(&self, method: Method) -> Option<f64> {
        let of_method = || self.rows.iter().filter(|row| row.method == method);
        let points = || of_method().map(|row| (row.work().log2(), row.plan_ms.log2()));
        let n = points().count() as f64;
        let mean = |pick: fn((f64, f64)) -> f64| points().map(pick).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let xx: f64 = points().map(|p| (p.0 - x) * (p.0 - x)).sum();
        let xy: f64 = points().map(|p| (p.0 - x) * (p.1 - y)).sum();
        (n > 1.0 && xx > 0.0).then(|| xy / xx)
    }
}

/// Measures all rows of a schedule. `go_on` is told which row comes, and asked before each frame.
pub fn run(
    schedule: &FrameSchedule,
    clock: &dyn Clock,
    output: &mut dyn CellOutput,
    mut go_on: impl FnMut(usize, &str) -> bool,
) -> FrameTimes {
    let mut report = FrameTimes {
        seed: schedule.seed,
        complete: true,
        rows: Vec::new(),
    };
    // The scenes of a number of spheres serve all its rows.
    for &count in &schedule.counts {
        let scenes = [0, 1].map(|i| scene(count, schedule.seed.wrapping_add(i)));
        for &size in &schedule.sizes {
            for &method in &schedule.methods {
                let number = report.rows.len();
                let name = format!("{count} spheres, {size}, {method}");
                let mut harness = Harness {
                    schedule,
                    clock,
                    scenes: &scenes,
                    rays: Rays::new(&scenes[0].camera, size, PixelShape::Aspect(1.0)),
                    method,
                    go_on: &mut || go_on(number, &name),
                };
                let smaller = report.rows.iter().rev();
                let smaller = smaller
                    .copied()
                    .find(|r| (r.size, r.method) == (size, method));
                let Some(row) = harness.measure(output, smaller) else {
                    report.complete = false;
                    return report;
                };
                report.rows.push(row);
            }
        }
    }
    report
}

/// Two scenes that take turns, and what is asked about them.
struct Harness<'a> {
    schedule: &'a FrameSchedule,
    clock: &'a dyn Clock,
    scenes: &'a [Scene; 2],
    rays: Rays,
    method: Method,
    go_on: &'a mut dyn FnMut() -> bool,
}

impl Harness<'_> {
    /// All times of a row; none if `go_on` said no. `smaller` is the row of fewer spheres.
    fn measure(
        &mut self,
        output: &mut dyn CellOutput,
        smaller: Option<FrameRow>,
    ) -> Option<FrameRow> {
        let mut frame = Frame::new();
        let (scenes, rays, method) = (self.scenes, self.rays, self.method);
        let with_plan = self.time(3, |i| {
            frame.render(&scenes[i % 2], &rays, method, View::Shade);
            black_box(frame.seen(0, 0));
        })?;
        let covered = frame.plan().counts().spanned;
        let planning = self.time(3, |i| {
            black_box(frame.bound_only(&scenes[i % 2], &rays, method, View::Shade));
        })?;
        let one_moved = self.time_one_moved(&mut frame)?;
        let (plan_ms, plan) = (median(&with_plan), median(&planning));
        let ([cells, diff, encode, ratatui], [bytes, ratatui_bytes]) =
            self.time_output(&mut frame, output)?;
        Some(FrameRow {
            spheres: scenes[0].bodies.len(),
            size: rays.size,
            method,
            plan_ms,
            best_ms: with_plan[0],
            no_plan_ms: if self.would_be_too_long(smaller) {
                None
            } else {
                Some(self.time_without()?)
            },
            one_moved_ms: median(&one_moved),
            parts: Parts {
                plan,
                rays: (plan_ms - plan).max(0.0),
                cells,
                diff,
                encode,
                ratatui,
            },
            covered,
            bytes,
            ratatui_bytes,
        })
    }

    /// Sorted milliseconds of `run`, which is told which turn it is: at least `least`, then as many as the
    /// schedule allows.
    fn time(&mut self, least: usize, mut run: impl FnMut(usize)) -> Option<Vec<f64>> {
        let mut times = Vec::new();
        let mut spent = 0.0;
        // One turn warms up, if turns are short.
        let mut is_warm = least == 1;
        let mut turn = 0;
        while times.len() < least
            || (times.len() < self.schedule.rounds && spent < self.schedule.budget)
        {
            if !(self.go_on)() {
                return None;
            }
            let start = self.clock.now();
            run(turn);
            let taken = milliseconds(self.clock.now().saturating_sub(start));
            turn += 1;
            if is_warm {
                times.push(taken);
                spent += taken;
            }
            is_warm = true;
        }
        times.sort_by(f64::total_cmp);
        Some(times)
    }

    /// Whether a frame without the plan would take over a minute, going by that of fewer spheres: of the
    /// row before, or of the first few.
    fn would_be_too_long(&self, smaller: Option<FrameRow>) -> bool {
        let (spheres, ms) = smaller.map_or_else(
            || self.time_without_plan(&self.few()),
            |row| (row.spheres, row.no_plan_ms),
        );
        let factor = self.scenes[0].bodies.len() as f64 / spheres.max(1) as f64;
        ms.is_none_or(|ms| ms * factor > TOO_LONG)
    }

    /// The spheres of a scene, and the milliseconds that one frame of it takes without the plan.
    fn time_without_plan(&self, scene: &Scene) -> (usize, Option<f64>) {
        let start = self.clock.now();
        Frame::new().render_all(scene, &self.rays, self.method, View::Shade);
        let taken = milliseconds(self.clock.now().saturating_sub(start));
        (scene.bodies.len(), Some(taken))
    }

    /// The scene with its first spheres only.
    fn few(&self) -> Scene {
        let scene = &self.scenes[0];
        let few = scene.bodies.iter().take(10).cloned();
        Scene {
            name: scene.name.clone(),
            about: None,
            camera: scene.camera,
            pixels: None,
            bodies: few.collect(),
            light: None,
            probes: Vec::new(),
        }
    }

    /// The time without the plan.
    fn time_without(&mut self) -> Option<f64> {
        let mut frame = Frame::new();
        let (scenes, rays, method) = (self.scenes, self.rays, self.method);
        let times = self.time(1, |i| {
            frame.render_all(&scenes[i % 2], &rays, method, View::Shade);
            black_box(frame.seen(0, 0));
        })?;
        Some(median(&times))
    }

    /// The time of frames in each of which one sphere, that in the middle of the list, has moved.
    fn time_one_moved(&mut self, frame: &mut Frame) -> Option<Vec<f64>> {
        let mut scene = self.scenes[0].clone();
        let middle = scene.bodies.len() / 2;
        let radius = scene.bodies[middle].sphere.radius;
        let (rays, method) = (self.rays, self.method);
        frame.render(&scene, &rays, method, View::Shade);
        self.time(3, |i| {
            let to_and_fro = if i % 2 == 0 { 0.25 } else { -0.25 };
            scene.bodies[middle].sphere.center.x += radius * to_and_fro;
            frame.render(&scene, &rays, method, View::Shade);
            black_box(frame.seen(0, 0));
        })
    }

    /// Medians of cells, of comparing them and of writing them, also by ratatui's own backend; and the
    /// bytes of a frame of either.
    fn time_output(
        &mut self,
        frame: &mut Frame,
        output: &mut dyn CellOutput,
    ) -> Option<([f64; 4], [usize; 2])> {
        let look = Look {
            style: Style::Half,
            depth: ColorDepth::Ansi256,
            ascii_only: false,
            coarse: false,
        };
        let mut image = Image::new();
        let mut taken = [const { Vec::new() }; 4];
        let mut bytes = [0; 2];
        for turn in 0..self.schedule.rounds.min(25) {
            if !(self.go_on)() {
                return None;
            }
            frame.render(&self.scenes[turn % 2], &self.rays, self.method, View::Shade);
            let time = |run: &mut dyn FnMut()| {
                let start = self.clock.now();
                run();
                milliseconds(self.clock.now().saturating_sub(start))
            };
            let cells = time(&mut || image.draw(frame, &self.scenes[turn % 2], look));
            let both = time(&mut || bytes[0] = output.show(&image));
            // Shown once more the cells are compared, and nothing is written.
            let diff = time(&mut || {
                output.show(&image);
            });
            let ratatui_both = time(&mut || bytes[1] = output.show_by_ratatui(&image));
            let ratatui_diff = time(&mut || {
                output.show_by_ratatui(&image);
            });
            let [encode, ratatui] =
                [both - diff, ratatui_both - ratatui_diff].map(|ms| ms.max(0.0));
            for (taken, ms) in taken.iter_mut().zip([cells, diff, encode, ratatui]) {
                taken.push(ms);
            }
        }
        for taken in &mut taken {
            taken.sort_by(f64::total_cmp);
        }
        Some((taken.map(|taken| median(&taken)), bytes))
    }
}

fn milliseconds(nanoseconds: u64) -> f64 {
    nanoseconds as f64 * 1e-6
}

/// The middle of sorted times.
fn median(sorted: &[f64]) -> f64 {
    nearest_rank(sorted, 1, 2)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// A clock that goes on by a millisecond at each look.
    #[derive(Default)]
    struct Ticks(Cell<u64>);

    impl Clock for Ticks {
        fn now(&self) -> u64 {
            self.0.set(self.0.get() + 1_000_000);
            self.0.get()
        }
    }

    struct Nowhere;

    impl CellOutput for Nowhere {
        fn show(&mut self, image: &Image) -> usize {
            image.cells.len()
        }

        fn show_by_ratatui(&mut self, image: &Image) -> usize {
            2 * image.cells.len()
        }
    }

    fn schedule() -> FrameSchedule {
        FrameSchedule {
            counts: vec![1, 10],
            sizes: vec![Size::new(8, 6), Size::new(20, 10)],
            methods: vec![Method::Exact, Method::Textbook],
            rounds: 3,
            budget: 10.0,
            seed: 1,
        }
    }

    #[test]
    fn a_median_is_the_middle_one() {
        assert_eq!(median(&[1.0, 2.0, 9.0]), 2.0);
    }

    #[test]
    fn a_run_has_a_row_for_each_count_size_and_method() {
        let report = run(&schedule(), &Ticks::default(), &mut Nowhere, |_, _| true);
        assert!(report.complete);
        assert_eq!(report.rows.len(), schedule().rows());
        for row in &report.rows {
            assert_eq!((row.plan_ms, row.no_plan_ms), (1.0, Some(1.0)));
            assert!(!row.pays());
        }
        let text = text(&report, &crate::lab::Machine::detect()).text();
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        assert!(text.contains("does not pay"));
    }

    #[test]
    fn an_interrupted_run_keeps_the_rows_it_has() {
        let report = run(&schedule(), &Ticks::default(), &mut Nowhere, |row, _| {
            row < 3
        });
        assert!(!report.complete);
        assert_eq!(report.rows.len(), 3);
    }

    #[test]
    fn what_would_take_over_a_minute_is_not_drawn() {
        struct Slow(Cell<u64>);
        impl Clock for Slow {
            fn now(&self) -> u64 {
                self.0.set(self.0.get() + 7_000_000_000);
                self.0.get()
            }
        }
        let clock = Slow(Cell::new(0));
        let report = run(&schedule(), &clock, &mut Nowhere, |_, _| true);
        let without = |i: usize| report.rows[i].no_plan_ms;
        assert_eq!(without(0), Some(7000.0));
        assert_eq!(without(4), None);
    }

    #[test]
    fn the_slope_of_a_proportion_is_one() {
        let mut report = run(&schedule(), &Ticks::default(), &mut Nowhere, |_, _| true);
        for row in &mut report.rows {
            row.plan_ms = 3.0 * row.work();
        }
        let slope = report.slope(Method::Exact).expect("rows");
        assert!((slope - 1.0).abs() < 1e-9, "{slope}");
        assert_eq!(report.slope(Method::Kahan), None);
    }
}
