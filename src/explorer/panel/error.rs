//! Error against run time for the picture on the screen: timed when asked, on a thread of its own.
//!
//! The thread gets copies, sends its report through a channel and rings the waker: the loop that
//! waits for input then has the panel take the report. Nothing waits for the thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread;
use std::time::{Duration, Instant};

use ratatui::layout::Rect;

use crate::explain::{self, Line, Role};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{AS_FIGURE, Component, show};
use crate::explorer::state::State;
use crate::lab::bench::Benchmark;
use crate::lab::picture::{NoChart, chart};
use crate::lab::{BenchQueue, BenchWait};
use crate::render::Allowance;
use crate::scene::{Rays, Scene};
use crate::system::Waker;
use crate::text;

/// What was measured, what is being measured, and why there is nothing.
#[derive(Debug, Default)]
pub(crate) struct ErrorPanel {
    pub(crate) waker: Waker,
    pub(crate) chart: Option<Chart>,
    run: Option<Run>,
    /// Why the last measurement came to nothing.
    pub(crate) refusal: Option<NoChart>,
}

/// The picture that is asked about.
#[derive(Debug, Clone)]
struct MeasuredPicture {
    scene: Scene,
    rays: Rays,
}

impl MeasuredPicture {
    /// Whether another picture asks the same questions.
    fn is(&self, scene: &Scene, rays: &Rays) -> bool {
        let (mine, others) = (self.scene.bodies.iter(), scene.bodies.iter());
        self.rays == *rays && mine.map(|b| b.sphere).eq(others.map(|b| b.sphere))
    }
}

/// A measurement that has come to its end.
#[derive(Debug)]
pub(crate) struct Chart {
    pub(crate) report: Benchmark,
    of: MeasuredPicture,
    /// The document's version and the rays for which `is_stale` was found out.
    seen: Option<(u64, Rays)>,
    /// Whether the screen shows another picture by now.
    pub(crate) is_stale: bool,
}

/// A measurement on its way; it is called off when this is dropped.
#[derive(Debug)]
struct Run {
    of: MeasuredPicture,
    cancel: Arc<AtomicBool>,
    news: Receiver<News>,
    /// Who is before it.
    wait: Option<BenchWait>,
}

/// What the thread has to say.
#[derive(Debug)]
enum News {
    /// Others come first; nobody any more.
    Waits(Option<BenchWait>),
    Ends(Result<Benchmark, NoChart>),
}

impl Drop for Run {
    fn drop(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

/// Sends news and wakes the loop that waits for them; wakes too if a panic leaves nothing to send.
struct NewsSender {
    to: Option<Sender<News>>,
    waker: Waker,
}

impl NewsSender {
    fn send(&self, news: News) {
        if let Some(to) = &self.to {
            // Nobody listens any more: then nobody misses it.
            let _ = to.send(news);
        }
    }
}

impl Drop for NewsSender {
    fn drop(&mut self) {
        self.to = None;
        self.waker.wake();
    }
}

impl Run {
    fn start(of: MeasuredPicture, queue: BenchQueue, waker: Waker) -> Result<Self, NoChart> {
        let cancel = Arc::new(AtomicBool::new(false));
        let (sender, news) = mpsc::channel();
        let sender = NewsSender {
            to: Some(sender),
            waker,
        };
        let (subject, cancelled) = (of.clone(), Arc::clone(&cancel));
        let work = move || {
            let MeasuredPicture { scene, rays } = &subject;
            let mut told = None;
            let end = chart(scene, rays, &queue, &cancelled, |wait| {
                if told != wait {
                    told = wait;
                    sender.send(News::Waits(wait));
                    sender.waker.wake();
                }
            });
            sender.send(News::Ends(end));
        };
        match thread::Builder::new().name("measure".into()).spawn(work) {
            Ok(_) => Ok(Self {
                of,
                cancel,
                news,
                wait: None,
            }),
            Err(error) => Err(NoChart::Failed(error.to_string())),
        }
    }
}

impl Run {
    fn in_words(&self) -> String {
        match &self.wait {
            Some(wait) => format!(
                "Waiting to measure, since two at once would disturb each other: {wait}. % stops waiting."
            ),
            None => "Measuring … all keys work as usual.".into(),
        }
    }
}

impl ErrorPanel {
    /// Whether a measurement is on its way.
    pub(crate) const fn is_running(&self) -> bool {
        self.run.is_some()
    }

    /// What there is to say before the chart, or in its place, in lines of that width.
    pub(crate) fn remarks(&self, width: usize) -> Vec<Line> {
        let mut remarks = Vec::new();
        if let Some(run) = &self.run {
            remarks.push((Role::Plain, run.in_words()));
        } else if let Some(refusal) = &self.refusal {
            remarks.push((Role::Warning, in_words(refusal)));
        }
        match &self.chart {
            Some(chart) => remarks.extend(chart.remarks()),
            None if remarks.is_empty() => remarks.push((Role::Plain, NOTHING_YET.into())),
            None => {}
        }
        let lines = |(role, text): &(Role, String)| {
            let lines = text::wrap(text, width).into_iter();
            lines.map(|line| Line::of(*role, line)).collect::<Vec<_>>()
        };
        remarks.iter().flat_map(lines).collect()
    }
}

/// How long to wait at most for a measurement that was called off to end.
const RELEASE: Duration = Duration::from_secs(2);

/// What the panel says before anything was measured.
const NOTHING_YET: &str = "Press % to time all methods on the questions that this picture asks: the ray \
    of each pixel with each sphere. Each answer is compared with the exact one, too. It takes about \
    a second; on a shared host measurements run one after another.";

/// A refusal as a sentence.
fn in_words(refusal: &NoChart) -> String {
    match refusal {
        NoChart::Cancelled => "The measurement was stopped. % starts it again.".into(),
        NoChart::Empty => "The scene has no spheres: there is nothing to ask.".into(),
        NoChart::Failed(reason) => format!("Nothing could be measured: {reason}. % tries again."),
    }
}

impl Chart {
    /// How far the chart can be believed, and what it is of.
    fn remarks(&self) -> Vec<(Role, String)> {
        let mut remarks = Vec::new();
        if self.is_stale {
            let stale = "STALE: the picture has changed since this was measured. % measures again.";
            remarks.push((Role::Warning, stale.into()));
        }
        let complaints = self.report.complaints();
        if let [first, more @ ..] = complaints.as_slice() {
            let more = if more.is_empty() { "" } else { " …" };
            let text = format!("TIMES NOT TRUSTED: {first}{more}");
            remarks.push((Role::Warning, text));
        }
        if cfg!(debug_assertions) {
            remarks.push((Role::Warning, "Not an optimised build.".into()));
        }
        let abouts = self.report.sets.iter().map(|set| &set.about);
        remarks.extend(abouts.map(|about| (Role::Faint, about.clone())));
        remarks
    }
}

impl Component for ErrorPanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let width = room.width.into();
        let mut lines = self.remarks(width);
        if let Some(chart) = &self.chart {
            let rows = usize::from(room.height).saturating_sub(lines.len());
            let sets = chart.report.sets.iter();
            let glyphs = state.options.glyphs;
            lines.extend(sets.flat_map(|c| explain::work(c, width, rows, glyphs)));
        }
        ("error against run time".to_owned(), lines)
    }

    fn foot(&self, _: &State) -> String {
        if self.is_running() {
            "% stop".into()
        } else {
            "% measure".into()
        }
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        match action {
            Action::PanelError => show(state, Panel::Error),
            Action::Measure => self.measure(state),
            _ => return false,
        }
        true
    }

    /// Finds out whether the chart is of the picture on the screen.
    fn go_on(&mut self, state: &State, _: &mut Allowance) -> bool {
        let key = (state.work.document.version(), state.picture.rays);
        if let Some(chart) = self.chart.as_mut().filter(|chart| chart.seen != Some(key)) {
            chart.is_stale = !chart.of.is(state.scene(), &key.1);
            chart.seen = Some(key);
        }
        true
    }

    fn size_as_text(&self) -> (u16, u16) {
        AS_FIGURE
    }
}

impl ErrorPanel {
    /// Takes what the thread has to say; false if nothing on the screen can have changed.
    pub(crate) fn catch_up(&mut self, state: &mut State) -> bool {
        let Some(run) = &mut self.run else {
            return false;
        };
        let mut any = false;
        loop {
            let end = match run.news.try_recv() {
                Ok(News::Ends(end)) => end,
                Ok(News::Waits(wait)) => {
                    (run.wait, any) = (wait, true);
                    continue;
                }
                Err(TryRecvError::Empty) => return any,
                Err(TryRecvError::Disconnected) => Err(NoChart::Failed("it broke off".into())),
            };
            let of = run.of.clone();
            self.run = None;
            self.end(of, end);
            if state.at.panel != Panel::Error {
                state.say("Measured. 7 shows error against run time.");
            }
            return true;
        }
    }

    fn end(&mut self, of: MeasuredPicture, end: Result<Benchmark, NoChart>) {
        match end {
            Ok(report) => {
                self.chart = Some(Chart {
                    report,
                    of,
                    seen: None,
                    is_stale: false,
                });
                self.refusal = None;
            }
            Err(refusal) => self.refusal = Some(refusal),
        }
    }

    /// Times all methods on the questions of this picture, or stops doing so.
    fn measure(&mut self, state: &mut State) {
        state.at.panel = Panel::Error;
        if self.run.take().is_some() {
            self.refusal = Some(NoChart::Cancelled);
            return;
        }
        let of = MeasuredPicture {
            scene: state.scene().clone(),
            rays: state.picture.rays,
        };
        let queue = state.workplace.queue.clone();
        match Run::start(of, queue, self.waker.clone()) {
            Ok(run) => {
                self.run = Some(run);
                self.refusal = None;
            }
            Err(refusal) => self.refusal = Some(refusal),
        }
    }

    /// Calls a measurement off before this process stops, and waits until its thread has let go of
    /// the right to measure: a process that is stopped with it would hold up all others.
    pub(crate) fn pause(&mut self) {
        if let Some(run) = self.run.take() {
            run.cancel.store(true, Ordering::Relaxed);
            // Between two rounds it looks; one that takes longer is not worth a terminal that hangs.
            let deadline = Instant::now() + RELEASE;
            let left = || deadline.saturating_duration_since(Instant::now());
            while let Ok(News::Waits(_)) = run.news.recv_timeout(left()) {}
            self.refusal = Some(NoChart::Cancelled);
        }
    }
}
