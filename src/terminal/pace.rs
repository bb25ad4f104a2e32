//! When the next frame may go out: only as fast as the terminal deals with them.
//!
//! What is written goes into buffers on its way, of the kernel and of the network, that hold
//! seconds of frames on a slow link. So each large frame ends in a status query, small ones now and
//! then, and while too much is unanswered the next frame waits: the state goes on, and the screen
//! follows with the newest of it. A terminal that answers nothing is written to without asking.
//!
//! Where frames have to wait for long the next ones are coarse, until nothing has been shown for a while:
//! see [`Detail`].

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Asks the terminal for its status; the answer says that all before it has been dealt with.
pub const QUERY: &[u8] = b"\x1b[5n";

/// This many bytes may go out before the next query.
const UNASKED: usize = 1024;
/// This many bytes may be unanswered when a frame is started: what a slow link takes in a moment.
const WINDOW: usize = 4096;
/// It grows up to this where answers come as fast as ever although frames wait for them.
const LARGEST_WINDOW: usize = 16 * WINDOW;
/// What an answer may take beside the way to and fro and still be fast, and what makes it late.
const FAST: Duration = Duration::from_millis(25);
const LATE: Duration = Duration::from_millis(100);
/// A terminal that has never answered is given this long.
const FIRST_ANSWER: Duration = Duration::from_secs(1);
/// One that has answered before is given this long, and is written to then all the same.
const NEXT_ANSWER: Duration = Duration::from_secs(5);
/// One that answers nothing is taken to show a frame so long after it was written.
const NO_ANSWER: Duration = Duration::from_millis(300);
/// How long an answer may hold up the end, if no round trip was measured, and at most.
const LAST_ANSWER: Duration = Duration::from_millis(200);
const LONGEST_LAST_ANSWER: Duration = Duration::from_secs(3);

/// A frame that had to wait for so long waited for a slow link, or for one that stalls.
const LONG: Duration = Duration::from_millis(100);
/// After this many of them in turn frames are coarse: a link that stalled has no second one.
const ENOUGH: u8 = 2;
/// After so long without a frame the person rests, and the picture gets its detail back: longer than
/// from one key to the next while it is held down.
const REST: Duration = Duration::from_millis(100);

/// How finely pictures are drawn, going by how they get through.
///
/// A coarse picture stays coarse for as long as frames follow each other: to go back and forth between
/// the two would change more cells than either.
#[derive(Debug, Default)]
pub struct Detail {
    /// Since when a frame waits for room.
    held: Option<Instant>,
    /// How many frames in turn waited for long.
    late: u8,
    /// If frames are coarse: when the last one was drawn.
    coarse: Option<Instant>,
}

impl Detail {
    /// A frame is due, and there is no room for it yet.
    pub fn holds(&mut self, now: Instant) {
        self.held.get_or_insert(now);
    }

    /// A frame is drawn now; whether it is to be coarse.
    pub fn draws(&mut self, now: Instant) -> bool {
        let held = self.held.take();
        let waited = held.is_some_and(|since| now.saturating_duration_since(since) >= LONG);
        self.late = if waited {
            self.late.saturating_add(1)
        } else {
            0
        };
        if self.late >= ENOUGH || self.coarse.is_some() {
            self.coarse = Some(now);
        }
        self.coarse.is_some()
    }

    /// When the picture is to be drawn in full, if it is not and nothing else happens before.
    pub fn due(&self) -> Option<Instant> {
        self.coarse.map(|last| last + REST)
    }

    /// Whether it is time for that; the next frame is not coarse then, unless it has to wait again.
    pub fn rests(&mut self, now: Instant) -> bool {
        let rests = self.held.is_none() && self.due().is_some_and(|due| due <= now);
        if rests {
            self.coarse = None;
        }
        rests
    }
}

/// How the terminal keeps up.
#[derive(Debug, Default)]
pub struct Pace {
    /// Frames that are not answered: when they were written, and how long they are.
    unanswered: VecDeque<(Instant, usize)>,
    /// The bytes of small frames since the last query.
    unasked: usize,
    habit: Habit,
    /// From a query to its answer, the last time.
    round_trip: Option<Duration>,
    /// The shortest time that took.
    fastest: Option<Duration>,
    /// By how many times [`WINDOW`] has grown, and whether a frame had to wait since the last answer.
    growth: usize,
    held: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Habit {
    #[default]
    Unknown,
    Answers,
    Silent,
}

impl Pace {
    /// That of a terminal that can be asked, or not.
    pub fn new(can_be_asked: bool) -> Self {
        Self {
            habit: if can_be_asked {
                Habit::Unknown
            } else {
                Habit::Silent
            },
            ..Self::default()
        }
    }

    /// Whether a query at the end of a frame of this many bytes is worth its own.
    pub fn asks(&self, bytes: usize) -> bool {
        self.habit != Habit::Silent && self.unasked + bytes >= UNASKED
    }

    /// Whether a query may be answered.
    pub fn can_ask(&self) -> bool {
        self.habit != Habit::Silent
    }

    /// A frame of `bytes` has been handed over, with a query at its end or none.
    pub fn wrote(&mut self, bytes: usize, asked: bool, now: Instant) {
        if asked {
            self.unanswered.push_back((now, self.unasked + bytes));
            self.unasked = 0;
        } else {
            self.unasked += bytes;
        }
    }

    /// The terminal has answered a query.
    pub fn answered(&mut self, now: Instant) {
        self.habit = Habit::Answers;
        if let Some((asked, _)) = self.unanswered.pop_front() {
            let round_trip = now.saturating_duration_since(asked);
            self.round_trip = Some(round_trip);
            self.fit_window(round_trip);
        }
    }

    /// Lets more go out if only the length of the way held a frame up, and less if bytes queue.
    fn fit_window(&mut self, round_trip: Duration) {
        let fastest = self.fastest.map_or(round_trip, |t| t.min(round_trip));
        self.fastest = Some(fastest);
        if round_trip > 2 * fastest + LATE {
            self.growth /= 2;
        } else if self.held && round_trip <= fastest + fastest / 4 + FAST {
            self.growth = (2 * self.growth + 1).min(LARGEST_WINDOW / WINDOW - 1);
        }
        self.held = false;
    }

    /// How long the answer to a query may take until it is taken not to come.
    pub fn patience(&self) -> Duration {
        match self.habit {
            Habit::Answers => NEXT_ANSWER,
            Habit::Unknown => FIRST_ANSWER,
            Habit::Silent => NO_ANSWER,
        }
    }

    /// How long to wait at the end for the answers that are still to come.
    pub fn last_patience(&self) -> Duration {
        self.round_trip.map_or(LAST_ANSWER, |round_trip| {
            (2 * round_trip + LAST_ANSWER).min(LONGEST_LAST_ANSWER)
        })
    }

    /// When the next frame may go out; none if at once.
    pub fn due(&mut self, now: Instant) -> Option<Instant> {
        let bytes: usize = self.unanswered.iter().map(|(_, n)| n).sum();
        let &(oldest, _) = self.unanswered.front()?;
        if bytes < WINDOW * (self.growth + 1) {
            return None;
        }
        self.held = true;
        let patience = self.patience();
        if now < oldest + patience {
            return Some(oldest + patience);
        }
        // Each answer that does not come lets the next be waited for less, and then not at all.
        self.habit = match self.habit {
            Habit::Answers => Habit::Unknown,
            Habit::Unknown | Habit::Silent => Habit::Silent,
        };
        self.unanswered.clear();
        None
    }

    /// Whether an answer is still to come.
    pub fn is_waiting(&self) -> bool {
        !self.unanswered.is_empty()
    }

    /// Starts again, as on a terminal that has been away.
    pub fn forget(&mut self) {
        self.unanswered.clear();
        self.unasked = 0;
        (self.fastest, self.growth, self.held) = (None, 0, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(start: Instant, ms: u64) -> Instant {
        start + Duration::from_millis(ms)
    }

    fn wrote(pace: &mut Pace, bytes: usize, now: Instant) {
        let asked = pace.asks(bytes);
        pace.wrote(bytes, asked, now);
    }

    /// Whether a frame that waits from one millisecond to another is coarse.
    fn waits(detail: &mut Detail, start: Instant, [from, to]: [u64; 2]) -> bool {
        detail.holds(after(start, from));
        detail.holds(after(start, to - 1));
        detail.draws(after(start, to))
    }

    #[test]
    fn frames_that_wait_are_coarse_until_nothing_is_shown_for_a_while() {
        let start = Instant::now();
        let mut detail = Detail::default();
        assert!(!detail.draws(start));
        assert!(!waits(&mut detail, start, [0, 99]), "it waited shortly");
        assert!(!waits(&mut detail, start, [200, 300]), "it was the first");
        assert!(waits(&mut detail, start, [350, 450]));
        assert!(detail.draws(after(start, 500)), "the person moves on");
        assert_eq!(detail.due(), Some(after(start, 600)));
        assert!(!detail.rests(after(start, 599)));
        assert!(detail.rests(after(start, 600)));
        assert_eq!(detail.due(), None);
        assert!(!detail.draws(after(start, 600)));
    }

    #[test]
    fn a_link_that_stalled_shows_the_last_state_in_full() {
        let start = Instant::now();
        let mut detail = Detail::default();
        assert!(!waits(&mut detail, start, [0, 3000]));
        assert!(!detail.draws(after(start, 3100)));
        assert!(!waits(&mut detail, start, [4000, 7000]));
    }

    #[test]
    fn a_frame_that_waits_is_no_rest() {
        let start = Instant::now();
        let mut detail = Detail::default();
        for at in [0, 200] {
            waits(&mut detail, start, [at, at + 150]);
        }
        detail.holds(after(start, 400));
        assert!(!detail.rests(after(start, 1000)));
        assert!(detail.draws(after(start, 1000)));
        assert!(detail.rests(after(start, 1100)));
    }

    #[test]
    fn a_terminal_that_reads_slowly_is_waited_for() {
        let start = Instant::now();
        let mut pace = Pace::default();
        assert_eq!(pace.due(start), None);
        wrote(&mut pace, 1000, start);
        assert_eq!(pace.due(start), None, "little is on its way");
        pace.answered(start);
        wrote(&mut pace, 3000, start);
        wrote(&mut pace, 3000, start);
        assert_eq!(pace.due(after(start, 900)), Some(start + NEXT_ANSWER));
        pace.answered(start);
        assert_eq!(pace.due(after(start, 1000)), None);
        pace.answered(start);
        assert!(!pace.is_waiting());
    }

    #[test]
    fn small_frames_are_asked_about_together() {
        let start = Instant::now();
        let mut pace = Pace::default();
        for _ in 0..3 {
            assert!(!pace.asks(300));
            wrote(&mut pace, 300, start);
        }
        assert!(!pace.is_waiting());
        for _ in 0..3 {
            assert!(pace.asks(3500));
            wrote(&mut pace, 3500, start);
            pace.answered(start);
        }
        wrote(&mut pace, 300, start);
        wrote(&mut pace, 3900, start);
        assert_eq!(pace.due(start), Some(start + NEXT_ANSWER), "both count");
    }

    #[test]
    fn a_terminal_that_answers_nothing_is_asked_no_more() {
        let start = Instant::now();
        let mut pace = Pace::default();
        assert!(pace.asks(5000));
        wrote(&mut pace, 5000, start);
        assert_eq!(pace.due(start), Some(start + FIRST_ANSWER));
        assert_eq!(pace.due(after(start, 1000)), None);
        assert!(!pace.asks(5000));
        wrote(&mut pace, 5000, after(start, 1001));
        assert_eq!(pace.due(after(start, 1001)), None);
        pace.answered(start);
        assert!(pace.asks(5000), "it was only late");
    }

    #[test]
    fn a_terminal_that_stopped_answering_is_not_waited_for_in_vain() {
        let start = Instant::now();
        let mut pace = Pace::default();
        wrote(&mut pace, 5000, start);
        pace.answered(start);
        wrote(&mut pace, 5000, start);
        assert_eq!(pace.due(start), Some(start + NEXT_ANSWER));
        assert_eq!(pace.due(start + NEXT_ANSWER), None);
        assert!(pace.asks(5000));
    }

    #[test]
    fn a_terminal_that_stopped_answering_delays_two_frames_and_no_more() {
        let mut now = Instant::now();
        let mut pace = Pace::default();
        wrote(&mut pace, 5000, now);
        pace.answered(now);
        let mut delays = Vec::new();
        for _ in 0..10 {
            wrote(&mut pace, 5000, now);
            if let Some(at) = pace.due(now) {
                delays.push(at - now);
                now = at;
                assert_eq!(pace.due(now), None);
            }
        }
        assert_eq!(delays, [NEXT_ANSWER, FIRST_ANSWER]);
    }

    #[test]
    fn the_end_waits_by_the_measured_round_trip() {
        let start = Instant::now();
        let mut pace = Pace::default();
        wrote(&mut pace, 5000, start);
        assert_eq!(pace.last_patience(), LAST_ANSWER, "none was measured");
        pace.answered(after(start, 800));
        assert!(pace.last_patience() > Duration::from_millis(1600));
        wrote(&mut pace, 5000, start);
        pace.answered(start + Duration::from_secs(60));
        assert_eq!(pace.last_patience(), LONGEST_LAST_ANSWER);
    }

    /// A person moves for three seconds, and each frame is of 3000 bytes. How many there are on a link of
    /// this round trip in milliseconds and rate in bytes a millisecond, and how long the last one takes.
    fn frames_of(round_trip: u64, rate: u64) -> (u64, u64) {
        let start = Instant::now();
        let mut pace = Pace::default();
        let mut answers = VecDeque::new();
        let [mut free, mut frames, mut last] = [0; 3];
        for ms in 0..3000 {
            while answers.front().is_some_and(|&at| at <= ms) {
                answers.pop_front();
                pace.answered(after(start, ms));
            }
            let is_next = frames == 0 || ms >= last + 50;
            if is_next && pace.due(after(start, ms)).is_none() {
                wrote(&mut pace, 3000, after(start, ms));
                free = ms.max(free) + 3000 / rate;
                answers.push_back(free + round_trip);
                (frames, last) = (frames + 1, ms);
            }
        }
        (frames, answers.back().map_or(0, |at| at - last))
    }

    #[test]
    fn a_long_way_is_no_slow_link() {
        let (frames, _) = frames_of(300, 10_000);
        assert!(frames > 30, "{frames}");
        // At 10 KB a second three seconds take ten frames, and none waits behind more than a few.
        let (frames, wait) = frames_of(20, 10);
        assert!(frames <= 14 && wait < 1500, "{frames} {wait}");
    }
}
