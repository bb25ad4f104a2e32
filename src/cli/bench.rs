//! `rayscope bench`: error against run time.

use std::ffi::{OsStr, OsString};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;

use super::failure::{DONE, INVALID};
use super::progress::{INTERRUPTED, Progress};
use super::screens::{SCREENS, ScreenTimes};
use super::sweep::SweepArgs;
use super::unseen::UnseenTerminal;
use super::{Failure, Outcome, choice, complain, save, whole, write_out};
use crate::door::{Expected, shown};
use crate::lab::bench::{self, BenchPlan, Benchmark, Earlier, Extras, MOST_TIMED, Sample};
use crate::lab::chart::{ChartAxes, ErrorAxis, TimeAxis};
use crate::lab::frames::{self, FrameSchedule};
use crate::lab::timing::{Schedule, SelfCheck, SystemClock};
use crate::lab::{BenchLock, BenchQueue, Family, Machine, plot};
use crate::method::Method;
use crate::render::{CELL_ASPECT, Style, fit};
use crate::report::Format;
use crate::scene::{Rays, Scene};

/// Measure the methods: wrong answers, errors in ulp, nanoseconds
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub(super) struct BenchArgs {
    #[command(flatten)]
    sweep: SweepArgs,

    /// Only these families of rays, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,

    /// Instead of families, the rays of this scene's own picture (a file or a built-in name)
    #[arg(long, value_name = "SCENE", conflicts_with = "family")]
    scene: Option<OsString>,

    /// Instead of single rays, whole frames: with the plan and without, from one sphere to a million
    #[arg(long, conflicts_with_all = ["family", "scene", "rays", "plot", "brief", "strict"])]
    frames: bool,

    /// With --frames: only these numbers of spheres, separated by commas
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', requires = "frames", value_parser = whole(1_u32, 3_000_000))]
    counts: Vec<u32>,

    /// With --frames: instead of scenes of many spheres, camera steps on the explorer's whole screen (a file
    /// or a built-in name)
    #[arg(
        long,
        value_name = "SCENE",
        requires = "frames",
        conflicts_with = "counts"
    )]
    explorer: Option<OsString>,

    /// How many rays of each family
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole(1_u32, 10_000_000))]
    rays: Option<u32>,

    /// Text: leave out the inputs of the largest errors
    #[arg(long)]
    brief: bool,

    /// JSON: with each repeat of each method
    #[arg(long)]
    samples: bool,

    /// List what differs from an earlier report in JSON by more than the noise of both
    #[arg(long, value_name = "OLD.json", conflicts_with = "frames")]
    against: Option<PathBuf>,

    /// The chart: which error lies along it
    #[arg(long, value_name = "ERROR", requires = "plot", value_parser = choice(&ErrorAxis::ALL, ErrorAxis::name), default_value = ErrorAxis::P99.name())]
    x: ErrorAxis,

    /// The chart: which time lies up it
    #[arg(long, value_name = "TIME", requires = "plot", value_parser = choice(&TimeAxis::ALL, TimeAxis::name), default_value = TimeAxis::Single.name())]
    y: TimeAxis,

    /// Exit with status 1 if a self-check of the timing fails
    #[arg(long)]
    strict: bool,
}

fn family() -> impl clap::builder::TypedValueParser<Value = &'static Family> {
    use clap::builder::{PossibleValuesParser, TypedValueParser};
    PossibleValuesParser::new(Family::ALL.iter().map(|family| family.name))
        .try_map(|name| Family::by_name(&name).ok_or("no such family"))
}

/// Runs what was asked for and ends with the exit status.
pub(super) fn run(arguments: &BenchArgs) -> Outcome {
    if let Some(scene) = &arguments.explorer {
        return run_screens(arguments, scene);
    }
    if arguments.frames {
        return run_frames(arguments);
    }
    if arguments.brief && arguments.sweep.format != Format::Text {
        return Err(Failure::misused(
            "--brief: only the text report lists inputs; expected --format text beside it",
        ));
    }
    if arguments.samples && arguments.sweep.format != Format::Json {
        return Err(Failure::misused(
            "--samples: only JSON has them; expected --format json beside it",
        ));
    }
    if arguments.against.is_some() && arguments.sweep.format == Format::Csv {
        return Err(Failure::misused(
            "--against: a table has no place for differences; expected --format text, markdown or json",
        ));
    }
    let earlier = arguments.against.as_deref().map(earlier).transpose()?;
    let samples = samples(arguments)?;
    let methods = arguments.sweep.methods()?;
    let mut progress = Progress::new("bench", samples.len())?;
    let length = length_of(arguments, samples.len());
    let lock = right_to_measure(length, &progress);
    let mut measured = bench::run(
        BenchPlan {
            methods: &methods,
            schedule: Schedule::new(arguments.sweep.quick, arguments.sweep.seed),
        },
        &samples,
        arguments.sweep.seed,
        &SystemClock::new(),
        |number, name| progress.go_on(number, name),
    );
    // Where that can't be found out, the other self-checks have to do.
    let alone = lock.as_ref().ok().map(Option::is_some);
    measured.self_checks.extend(alone.map(SelfCheck::alone));
    drop(lock);
    progress.clear();
    let machine = Machine::detect();
    let axes = ChartAxes {
        x: arguments.x,
        y: arguments.y,
    };
    let drawn = save(arguments.sweep.plot.as_deref(), || {
        plot::work_precision(&measured, &machine, axes)
    });
    let differences = earlier.map(|earlier| bench::differences(&measured, &machine.cpu, &earlier));
    write_out(&in_format(
        &measured,
        &machine,
        arguments,
        differences.as_deref(),
    ))?;
    drawn?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else if arguments.strict && !measured.times_trusted() {
        INVALID
    } else {
        DONE
    })
}

/// About how long a run of this many parts takes, for those who wait for it.
fn length_of(arguments: &BenchArgs, parts: usize) -> Duration {
    let each = if arguments.sweep.quick { 1 } else { 15 };
    Duration::from_secs(each * parts as u64)
}

/// The right to measure, in turn; none if others keep it for much longer than they said, or if
/// somebody waits no longer.
pub(super) fn right_to_measure(
    length: Duration,
    progress: &Progress,
) -> io::Result<Option<BenchLock>> {
    const PATIENCE: u32 = 4;
    let mut deadline = None;
    BenchQueue::of_host().wait(length, |wait| {
        let last = *deadline.get_or_insert_with(|| {
            complain(format_args!("waiting to measure: {wait}"));
            Instant::now() + PATIENCE * wait.about
        });
        Instant::now() < last && !progress.interrupted()
    })
}

/// Measures whole frames instead of single rays.
fn run_frames(arguments: &BenchArgs) -> Outcome {
    let mut schedule = FrameSchedule::new(arguments.sweep.quick, arguments.sweep.seed);
    if let Some(methods) = arguments.sweep.named()? {
        schedule.methods = methods;
    }
    if !arguments.counts.is_empty() {
        schedule.counts = arguments.counts.iter().map(|&n| n as usize).collect();
        schedule.counts.sort_unstable();
    }
    let mut progress = Progress::new("bench", schedule.rows())?;
    // No explorer of this host should time its picture meanwhile.
    let length = length_of(arguments, schedule.rows());
    let _lock = right_to_measure(length, &progress);
    let times = frames::run(
        &schedule,
        &SystemClock::new(),
        &mut UnseenTerminal::default(),
        |number, name| progress.go_on(number, name),
    );
    progress.clear();
    let machine = Machine::detect();
    write_out(&match arguments.sweep.format {
        Format::Text => frames::text(&times, &machine).text(),
        Format::Markdown => frames::markdown(&times, &machine).markdown(),
        Format::Csv => frames::records(&times).csv(),
        Format::Json => frames::json(&times, &machine),
    })?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else {
        DONE
    })
}

/// Measures the explorer's whole screen.
fn run_screens(arguments: &BenchArgs, scene: &OsStr) -> Outcome {
    let (scene, source) = Scene::open(scene).map_err(Failure::invalid)?;
    let methods = arguments.sweep.named()?.unwrap_or(vec![Method::Exact]);
    let mut progress = Progress::new("bench", methods.len() * SCREENS.len())?;
    let _lock = right_to_measure(length_of(arguments, methods.len()), &progress);
    let rounds = if arguments.sweep.quick { 5 } else { 25 };
    let measured = ScreenTimes::measure((&scene, &source), &methods, rounds, |number, name| {
        progress.go_on(number, name)
    });
    progress.clear();
    write_out(&measured.in_format(arguments.sweep.format))?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else {
        DONE
    })
}

fn samples(arguments: &BenchArgs) -> Result<Vec<Sample>, Failure> {
    let usual = if arguments.sweep.quick { 2048 } else { 16_384 };
    let rays = arguments.rays.map_or(usual, |rays| rays as usize);
    if let Some(name) = &arguments.scene {
        let (scene, _) = Scene::open(name).map_err(Failure::invalid)?;
        let (size, shape) = fit(&scene, Style::Half, 80, 24, CELL_ASPECT);
        let own = Rays::new(&scene.camera, size, shape);
        let most = rays.max(MOST_TIMED);
        return Ok(vec![Sample::of_scene(
            &scene,
            &own,
            arguments.sweep.seed,
            most,
        )]);
    }
    let chosen: Vec<&'static Family> = if arguments.family.is_empty() {
        Family::ALL.iter().collect()
    } else {
        arguments.family.clone()
    };
    let sample = |family: &'static Family| Sample::of_family(family, arguments.sweep.seed, rays);
    Ok(chosen.into_iter().map(sample).collect())
}

/// An earlier report, for `--against`.
fn earlier(path: &Path) -> Result<Earlier, Failure> {
    let text = EARLIER
        .text(path)
        .map_err(|e| Failure::invalid(format_args!("cannot read {e}")))?;
    let parsed = Earlier::parse(&text);
    parsed.map_err(|reason| Failure::invalid(format_args!("{}: {reason}", shown(path))))
}

/// All families with their samples are a few megabytes.
const EARLIER: Expected = Expected {
    what: "a report of rayscope bench in JSON",
    most: 64 << 20,
};

fn in_format(
    measured: &Benchmark,
    machine: &Machine,
    arguments: &BenchArgs,
    against: Option<&[String]>,
) -> String {
    match arguments.sweep.format {
        Format::Text => bench::text(measured, machine, !arguments.brief, against).text(),
        Format::Markdown => bench::markdown(measured, machine, against).markdown(),
        Format::Csv => bench::records(measured, machine).csv(),
        Format::Json => bench::json(
            measured,
            machine,
            Extras {
                samples: arguments.samples,
                against,
            },
        ),
    }
}
