//! The errors of one picture: pixel by pixel against `exact`, and charted against run time.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::bench::{self, BenchPlan, Benchmark, MOST_TIMED, Sample};
use super::bench_lock::{BenchQueue, BenchWait};
use super::errors::{Fault, FaultCounts, Percentiles};
use super::timing::{Schedule, SystemClock, UNSEEN};
use crate::method::{Method, root_bits_lost};
use crate::render::{Allowance, Contact, Frame, Hit, View};
use crate::scene::{Rays, Scene};

/// What is wrong with the picture at one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PixelError {
    /// Rightly nothing is seen.
    Nothing,
    /// The right sphere is seen; so many bits of the visible root are lost, from 0
    /// to 24.
    Bits(f64),
    /// A sphere where there is none, none where there is one, a tangent taken for a secant or the
    /// reverse, or no number.
    Wrong(Fault),
    /// Another sphere than the one that is nearest.
    OtherSphere,
}

impl PixelError {
    /// Whether what is seen is wrong, and not only inexact: the sphere, the class, or all bits of the
    /// root.
    pub fn is_wrong(&self) -> bool {
        match self {
            Self::Nothing => false,
            Self::Bits(bits) => *bits >= ALL_BITS,
            Self::Wrong(_) | Self::OtherSphere => true,
        }
    }
}

/// The bits of a binary32.
const ALL_BITS: f64 = f32::MANTISSA_DIGITS as f64;

/// The errors of all pixels, counted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PictureErrors {
    /// All pixels.
    pub pixels: usize,
    /// Wrong answers by kind.
    pub wrong: FaultCounts,
    /// Pixels that show another sphere than the nearest.
    pub other_sphere: usize,
    /// Pixels that show the right sphere at a root that has not one right bit.
    pub no_bit: usize,
    /// Bits lost where the right sphere is seen: the median and the worst; none if it is nowhere.
    pub bits: Option<[f64; 2]>,
}

impl PictureErrors {
    /// Counts the errors of pixels.
    pub fn of(errors: &[PixelError]) -> Self {
        let mut all = Self {
            pixels: errors.len(),
            ..Self::default()
        };
        let mut lost = Vec::new();
        for error in errors {
            match *error {
                PixelError::Nothing => {}
                PixelError::Wrong(fault) => all.wrong += fault,
                PixelError::OtherSphere => all.other_sphere += 1,
                PixelError::Bits(bits) => {
                    all.no_bit += usize::from(error.is_wrong());
                    lost.push(bits);
                }
            }
        }
        if !lost.is_empty() {
            let Percentiles { p50, max, .. } = Percentiles::of(&mut lost);
            all.bits = Some([p50, max]);
        }
        all
    }

    /// Pixels that are wrong in any way.
    pub const fn total_wrong(&self) -> usize {
        self.wrong.total() + self.other_sphere + self.no_bit
    }
}

/// The errors of a method at each pixel of a picture, row by row, against `exact`: its roots are the
/// exact ones rounded once, so bits lost are known to half an ulp.
pub fn pixel_errors(scene: &Scene, rays: &Rays, method: Method) -> Vec<PixelError> {
    let mut comparison = PictureComparison::begin(scene, rays, method);
    comparison.go_on(scene, rays, &mut Allowance::endless());
    comparison.errors
}

/// A picture that is being held against that of `exact`.
#[derive(Debug, Default)]
pub struct PictureComparison {
    found: Frame,
    truth: Frame,
    /// The errors of the first pixels.
    errors: Vec<PixelError>,
}

impl PictureComparison {
    /// Begins with the picture that a method makes of a scene.
    pub fn begin(scene: &Scene, rays: &Rays, method: Method) -> Self {
        let begun = |method| {
            let mut frame = Frame::new();
            frame.begin(scene, rays, method, View::Class);
            frame
        };
        Self {
            found: begun(method),
            truth: begun(Method::Exact),
            errors: Vec::new(),
        }
    }

    /// Goes on, with what it was begun for, while the allowance lasts; whether it is done.
    pub fn go_on(&mut self, scene: &Scene, rays: &Rays, allowance: &mut Allowance) -> bool {
        for frame in [&mut self.found, &mut self.truth] {
            if !frame.go_on(scene, rays, allowance) {
                return false;
            }
        }
        let (width, all) = (rays.size.width as usize, rays.size.area());
        while self.errors.len() < all && !allowance.is_used_up() {
            let [x, y] = [self.errors.len() % width, self.errors.len() / width];
            let frames = [&self.found, &self.truth];
            self.errors
                .push(pixel_error(scene, frames, x as u32, y as u32));
            allowance.spend(PIXEL);
        }
        self.errors.len() == all
    }

    /// The errors of all pixels, once it is done.
    pub fn into_errors(self) -> Vec<PixelError> {
        self.errors
    }
}

/// About how much work a pixel is.
const PIXEL: u64 = 20;

fn pixel_error(scene: &Scene, [found, truth]: [&Frame; 2], x: u32, y: u32) -> PixelError {
    match (found.hit(scene, x, y), truth.hit(scene, x, y)) {
        _ if found.contact(x, y) == Contact::Nan => PixelError::Wrong(Fault::NotFinite),
        (None, None) => PixelError::Nothing,
        (Some(_), None) => PixelError::Wrong(Fault::FalseHit),
        (None, Some(_)) => PixelError::Wrong(Fault::FalseMiss),
        (Some(hit), Some(right)) if hit.body != right.body => PixelError::OtherSphere,
        (Some(hit), Some(right)) => {
            let tangent = |frame: &Frame| frame.contact(x, y) == Contact::Tangent;
            if tangent(found) == tangent(truth) {
                root_error(hit, right)
            } else {
                PixelError::Wrong(Fault::WrongCount)
            }
        }
    }
}

fn root_error(hit: Hit, right: Hit) -> PixelError {
    let bits = root_bits_lost(hit.t, right.t);
    bits.map_or(PixelError::Wrong(Fault::NotFinite), PixelError::Bits)
}

/// Why there is no chart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoChart {
    /// It was told to stop.
    Cancelled,
    /// The picture has no sphere to ask about.
    Empty,
    /// The system did not let it begin, for this reason.
    Failed(String),
}

/// What the questions of a picture with very many are drawn from.
const SEED: u64 = 1;

/// How often each method is timed: a tenth of a second on a quiet machine.
const ROUNDS: usize = 101;

/// How long a picture takes about, with what comes before the timing.
const LENGTH: Duration = Duration::from_secs(1);

/// Charts all methods on the questions that a picture asks, to be run on a thread of its own.
/// It waits its turn in `queue`, tells meanwhile how it is, and that it
/// has begun. `cancel` ends it early.
pub fn chart(
    scene: &Scene,
    rays: &Rays,
    queue: &BenchQueue,
    cancel: &AtomicBool,
    mut waits: impl FnMut(Option<BenchWait>),
) -> Result<Benchmark, NoChart> {
    let lock = queue.wait(LENGTH, |wait| {
        waits(Some(wait));
        !cancel.load(Ordering::Relaxed)
    });
    let _lock = match lock {
        Ok(Some(lock)) => lock,
        Ok(None) => return Err(NoChart::Cancelled),
        Err(error) => return Err(NoChart::Failed(error.to_string())),
    };
    waits(None);
    let sample = Sample::of_scene(scene, rays, SEED, MOST_TIMED);
    if sample.problems.is_empty() {
        return Err(NoChart::Empty);
    }
    let plan = BenchPlan {
        methods: &Method::ALL,
        schedule: Schedule {
            rounds: ROUNDS,
            passes: 2,
            unseen: UNSEEN,
            seed: SEED,
        },
    };
    let go_on = |_: usize, _: &str| !cancel.load(Ordering::Relaxed);
    let report = bench::run(plan, &[sample], SEED, &SystemClock::new(), go_on);
    if report.complete {
        Ok(report)
    } else {
        Err(NoChart::Cancelled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Dial;
    use crate::render::{Lost, Style, fit};
    use crate::scene::{Builtin, PixelShape};

    fn picture(name: &str) -> (Scene, Rays) {
        let scene = Builtin::by_name(name).unwrap().scene();
        let (size, shape) = fit(&scene, Style::Ascii, 40, 20, 2.0);
        let rays = Rays::new(&scene.camera, size, shape);
        (scene, rays)
    }

    fn wrong(errors: &[PixelError]) -> usize {
        PictureErrors::of(errors).total_wrong()
    }

    #[test]
    fn exact_loses_nothing_and_textbook_does() {
        let (scene, rays) = picture("trio");
        let exact = pixel_errors(&scene, &rays, Method::Exact);
        assert_eq!(exact.len(), rays.size.area());
        let right = |e: &PixelError| matches!(e, PixelError::Nothing | PixelError::Bits(0.0));
        assert!(exact.iter().all(right));
        let textbook = pixel_errors(&scene, &rays, Method::Textbook);
        let lossy = |e: &&PixelError| matches!(e, PixelError::Bits(bits) if *bits > 1.0);
        assert!(textbook.iter().filter(lossy).count() > 20);
    }

    #[test]
    fn the_view_of_bits_lost_tells_the_same() {
        let far = |name: &str, k| {
            let (scene, rays) = picture(name);
            let dial = Dial::by_name("distance").unwrap();
            let far = dial.turn(&scene, k).unwrap();
            let rays = Rays::new(&far.camera, rays.size, PixelShape::Aspect(2.0));
            (far, rays)
        };
        for (scene, rays) in [
            picture("grazing"),
            picture("tutorial"),
            far("trio", 8),
            far("trio", 11),
        ] {
            for method in Method::ALL {
                let mut frame = Frame::new();
                frame.render(&scene, &rays, method, View::Lost);
                let width = rays.size.width as usize;
                for (i, error) in pixel_errors(&scene, &rays, method).iter().enumerate() {
                    let (x, y) = ((i % width) as u32, (i / width) as u32);
                    let shown = frame.lost(x, y);
                    let same = match *error {
                        PixelError::Nothing => shown.is_none(),
                        PixelError::Bits(bits) => shown == Some(Lost::Bits(bits as f32)),
                        PixelError::Wrong(_) | PixelError::OtherSphere => {
                            shown == Some(Lost::Everything) || frame.contact(x, y) == Contact::Nan
                        }
                    };
                    assert!(same, "{method} ({x}, {y}): {error:?}, {shown:?}");
                }
            }
        }
    }

    #[test]
    fn turning_the_distance_dial_breaks_the_picture_of_textbook() {
        let (scene, rays) = picture("trio");
        let far = Dial::by_name("distance").unwrap().turn(&scene, 12).unwrap();
        let far_rays = Rays::new(&far.camera, rays.size, PixelShape::Aspect(2.0));
        assert_eq!(wrong(&pixel_errors(&scene, &rays, Method::Textbook)), 0);
        let textbook = wrong(&pixel_errors(&far, &far_rays, Method::Textbook));
        assert!(textbook > 10, "{textbook}");
        assert_eq!(wrong(&pixel_errors(&far, &far_rays, Method::Double)), 0);
    }

    #[test]
    fn a_chart_is_of_the_picture_and_can_be_cancelled() {
        let (scene, rays) = picture("tutorial");
        let cancelled = AtomicBool::new(true);
        let queue = BenchQueue::private();
        let draw = |cancel| chart(&scene, &rays, &queue, cancel, |_| ());
        assert_eq!(draw(&cancelled).unwrap_err(), NoChart::Cancelled);
        let report = draw(&AtomicBool::new(false)).unwrap();
        assert_eq!(report.sets[0].census.rays, 1600);
    }
}
