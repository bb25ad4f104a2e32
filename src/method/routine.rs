//! Routines as methods: a small handle into a library of compiled programs.
//!
//! The library has a shelf for each name, and a shelf has the last few versions of its text: older ones are freed
//! as new ones come, and a handle to one that is gone answers as the newest does.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use glam::Vec3;

use super::batch::{Batch, Scalars, Vectors};
use super::{Class, Place, Solution};
use crate::door::{Expected, FileError, TextPosition};
use crate::geometry::{Ray, Sphere};
use crate::routine::{
    self, AnswerKind, Lanes, Language, Nobody, Plain, Program, RoutineError, RunOutcome, Runner,
};

/// The most names that are known at once.
const MOST_NAMES: usize = 256;
/// How many versions of one text are kept.
const VERSIONS: usize = 4;

/// A routine, to be asked as a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct RoutineId {
    shelf: u16,
    version: u32,
}

/// A routine with its text.
#[derive(Debug)]
pub struct LearntRoutine {
    /// As it was read.
    pub text: String,
    /// What it was compiled to.
    pub program: Program,
}

/// A name and the last versions of what it means, the newest last.
struct Shelf {
    key: String,
    name: &'static str,
    versions: VecDeque<(u32, Arc<LearntRoutine>)>,
}

/// Whether texts that are read from now on are contracted.
static CONTRACTS: AtomicBool = AtomicBool::new(false);

/// Routines that are read from now on fuse products into sums, where their text does not say otherwise.
pub(super) fn contract() {
    CONTRACTS.store(true, Ordering::Relaxed);
}

static LIBRARY: RwLock<Vec<Shelf>> = RwLock::new(Vec::new());

/// What a file of a routine should be.
const FILE: Expected = Expected {
    what: "a routine in GLSL or WGSL",
    most: routine::LONGEST as u64,
};

impl RoutineId {
    /// Reads and compiles a file, under that name.
    pub(super) fn load(name: &str, path: &Path) -> Result<Self, FileError> {
        let language = language(name, path)?;
        Self::learn_from(path, name, &Self::text_of(path)?, language)
    }

    /// Compiles a text that came with the program; its key is no path.
    pub(super) fn with_text(name: &str, text: &str) -> Result<Self, FileError> {
        let key = format!("{name} of rayscope");
        let key = Path::new(&key);
        Self::learn_from(key, name, text, language(name, key)?)
    }

    fn learn_from(
        path: &Path,
        name: &str,
        text: &str,
        language: Language,
    ) -> Result<Self, FileError> {
        Self::learn(&path.to_string_lossy(), name, text, language).map_err(|error| FileError {
            position: Some(TextPosition {
                line: error.line,
                column: error.column,
            }),
            ..FileError::whole(path, error.problem)
        })
    }

    /// The text in the file of a routine, right or wrong.
    pub fn text_of(path: &Path) -> Result<String, FileError> {
        FILE.text(path)
    }

    /// Compiles a text under a name; `key` tells apart what has the same name.
    pub fn learn(
        key: &str,
        name: &str,
        text: &str,
        language: Language,
    ) -> Result<Self, RoutineError> {
        if let Some(known) = Self::of_text(key, text) {
            return Ok(known);
        }
        let program = routine::compile(text, language, CONTRACTS.load(Ordering::Relaxed))?;
        let routine = Arc::new(LearntRoutine {
            text: text.to_owned(),
            program,
        });
        let mut library = LIBRARY.write().unwrap_or_else(PoisonError::into_inner);
        let at = match library.iter().position(|shelf| shelf.key == key) {
            Some(at) => at,
            None if library.len() == MOST_NAMES => {
                return Err(RoutineError {
                    line: 1,
                    column: 1,
                    problem: format!(
                        "{MOST_NAMES} routines are known already; restart the program"
                    ),
                });
            }
            None => {
                library.push(Shelf {
                    key: key.to_owned(),
                    // There are few names, and each lasts as long as the program.
                    name: Box::leak(name.to_owned().into_boxed_str()),
                    versions: VecDeque::new(),
                });
                library.len() - 1
            }
        };
        let versions = &mut library[at].versions;
        let version = versions.back().map_or(0, |(version, _)| version + 1);
        versions.push_back((version, routine));
        while versions.len() > VERSIONS {
            versions.pop_front();
        }
        Ok(Self {
            shelf: at as u16,
            version,
        })
    }

    fn of_text(key: &str, text: &str) -> Option<Self> {
        let library = LIBRARY.read().unwrap_or_else(PoisonError::into_inner);
        let shelf = library.iter().position(|shelf| shelf.key == key)?;
        let (version, newest) = library[shelf].versions.back()?;
        (newest.text == text).then_some(Self {
            shelf: shelf as u16,
            version: *version,
        })
    }

    /// The name that it was learnt under.
    pub fn name(self) -> &'static str {
        let library = LIBRARY.read().unwrap_or_else(PoisonError::into_inner);
        library[usize::from(self.shelf)].name
    }

    /// What tells its name apart from the same of another folder.
    pub fn key(self) -> String {
        let library = LIBRARY.read().unwrap_or_else(PoisonError::into_inner);
        library[usize::from(self.shelf)].key.clone()
    }

    /// The routine: that version, or the newest if it is gone.
    pub fn get(self) -> Arc<LearntRoutine> {
        let library = LIBRARY.read().unwrap_or_else(PoisonError::into_inner);
        let versions = &library[usize::from(self.shelf)].versions;
        let kept = versions
            .iter()
            .find(|(version, _)| *version == self.version);
        let (_, routine) = kept.or(versions.back()).expect("a shelf has a version");
        Arc::clone(routine)
    }

    /// What it answers.
    pub fn answers(self) -> AnswerKind {
        with_room::<1, _>(self, |room| room.routine.program.answers())
    }

    /// What it answers, and what is no hit to it, in words. Whether a bool counts spheres behind the eye is found out by asking.
    pub fn words(self) -> String {
        let routine = self.get();
        let answers = routine.program.answers();
        let beside = match answers {
            AnswerKind::Whether if self.counts_behind() => "a sphere behind the eye is a hit, too",
            AnswerKind::Whether => "a sphere behind the eye is no hit",
            AnswerKind::Roots | AnswerKind::Visible => routine.program.no_hit().words(),
        };
        format!("{}; {beside}", answers.words())
    }

    /// Whether it hits a sphere that lies behind the eye, on the line itself.
    fn counts_behind(self) -> bool {
        let ray = Ray {
            origin: Vec3::new(3.0, 0.0, 0.0),
            direction: Vec3::X,
        };
        let sphere = Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        };
        self.solve(&ray, &sphere).class == Class::Hit
    }

    pub(super) fn gives_one_at_most(self) -> bool {
        self.answers() != AnswerKind::Roots
    }

    pub(super) fn solve(self, ray: &Ray, sphere: &Sphere) -> Solution {
        with_room::<1, _>(self, |room| {
            room.give(0, ray, sphere);
            room.run(1);
            room.solution(0)
        })
    }

    /// The answer of each lane of a batch.
    pub(super) fn solve_all<O: Vectors, D: Vectors, C: Vectors, R: Scalars>(
        self,
        batch: &Batch<O, D, C, R>,
        mut put: impl FnMut(usize, Solution),
    ) {
        let count = batch.count();
        with_room::<{ Lanes::COUNT }, _>(self, |room| {
            for first in (0..count).step_by(Lanes::COUNT) {
                let lanes = (count - first).min(Lanes::COUNT);
                for lane in 0..lanes {
                    let (ray, sphere) = batch.get(first + lane);
                    room.give(lane, &ray, &sphere);
                }
                room.run(lanes);
                for lane in 0..lanes {
                    put(first + lane, room.solution(lane));
                }
            }
        });
    }
}

/// What a file of that name is written in.
fn language(name: &str, path: &Path) -> Result<Language, FileError> {
    let problem = "expected a file that ends in .glsl or .wgsl";
    Language::of(name).ok_or_else(|| FileError::whole(path, problem))
}

/// A routine with room to run it.
struct RunRoom<const N: usize> {
    id: RoutineId,
    routine: Arc<LearntRoutine>,
    machine: Runner<Plain, N>,
}

impl<const N: usize> RunRoom<N> {
    fn give(&mut self, lane: usize, ray: &Ray, sphere: &Sphere) {
        let [p0, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array());
        for &(input, slot) in self.routine.program.inputs() {
            let value = input.of(p0, d, c, sphere.radius);
            self.machine.give(slot, lane, value);
        }
    }

    fn run(&mut self, lanes: usize) {
        self.machine.run(&self.routine.program, lanes, &mut Nobody);
    }

    fn solution(&self, lane: usize) -> Solution {
        let program = &self.routine.program;
        match solution(self.machine.outcome(program, lane)) {
            Solution {
                class: Class::Miss, ..
            } if program.answers() != AnswerKind::Roots => Solution::UNSEEN,
            answer => answer,
        }
    }
}

/// What a routine's outcome is as an answer.
pub(super) fn solution(outcome: RunOutcome<f64>) -> Solution {
    match outcome {
        RunOutcome::Miss => Solution::MISS,
        RunOutcome::TooLong => Solution::without_roots(Class::Nan),
        RunOutcome::Hit => Solution {
            class: Class::Hit,
            near: f32::NAN,
            far: f32::NAN,
            place: Some(Place::Hit),
        },
        RunOutcome::One(t) if t.is_nan() => Solution::without_roots(Class::Nan),
        RunOutcome::One(t) => Solution {
            class: Class::Hit,
            near: t as f32 + 0.0,
            far: f32::NAN,
            place: Some(if t > 0.0 { Place::Hit } else { Place::Behind }),
        },
        RunOutcome::Two(near, far, _) if near.is_nan() || far.is_nan() => {
            Solution::without_roots(Class::Nan)
        }
        RunOutcome::Two(near, far, count) => {
            let [near, far] = [near, far].map(|t| t as f32);
            // What gives two roots and does not say how many: the same twice is one.
            let one = count.map_or(near == far, |count| count == 1);
            let class = if one { Class::Tangent } else { Class::Secant };
            Solution::with_roots(class, near, far)
        }
    }
}

type KeptRoom<const N: usize> = RefCell<Option<RunRoom<N>>>;

thread_local! {
    // The last routine that was asked on this thread: a picture asks the same one over and over.
    static ONE: KeptRoom<1> = const { RefCell::new(None) };
    static MANY: KeptRoom<{ Lanes::COUNT }> = const { RefCell::new(None) };
}

/// Where a width keeps its room.
trait Keeps<const N: usize> {
    fn keep<T>(work: impl FnOnce(&KeptRoom<N>) -> T) -> T;
}

struct Shop;

impl Keeps<1> for Shop {
    fn keep<T>(work: impl FnOnce(&KeptRoom<1>) -> T) -> T {
        ONE.with(work)
    }
}

impl Keeps<{ Lanes::COUNT }> for Shop {
    fn keep<T>(work: impl FnOnce(&KeptRoom<{ Lanes::COUNT }>) -> T) -> T {
        MANY.with(work)
    }
}

fn with_room<const N: usize, T>(id: RoutineId, work: impl FnOnce(&mut RunRoom<N>) -> T) -> T
where
    Shop: Keeps<N>,
{
    Shop::keep(|kept| {
        let mut kept = kept.borrow_mut();
        if kept.as_ref().is_none_or(|room| room.id != id) {
            let routine = id.get();
            let machine = Runner::new(&routine.program);
            *kept = Some(RunRoom {
                id,
                routine,
                machine,
            });
        }
        work(kept.as_mut().expect("just put there"))
    })
}
