//! The right to measure, which one thread of the whole host has at a time: two measurements at
//! once would time each other. A process that asks while it is taken queues and gets it in turn.
//!
//! The queue is a row of places, each the name of a [`HostLock`]. A newcomer takes the place behind
//! the last that is taken; who waits moves up as the place before becomes free; who has place 0
//! measures. A process that dies leaves its place to the next, since the system frees its names.

use std::fmt;
use std::io;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use crate::system::HostLock;

/// The right to measure, until it is dropped.
#[derive(Debug)]
pub struct BenchLock(#[expect(dead_code, reason = "held, not used")] QueuePlace);

/// Which of all queues: one for the host, and others for tests.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BenchQueue(String);

/// What somebody who waits is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BenchWait {
    /// How many are before them, of whom the first measures.
    pub ahead: usize,
    /// How long these said that they need, rounded up to powers of two of a second.
    pub about: Duration,
}

/// A place of the queue, and how long its holder needs: the latter is a name, too, so that others can
/// find it out.
#[derive(Debug)]
struct QueuePlace {
    number: usize,
    _name: HostLock,
    _length: Option<HostLock>,
}

/// More don't queue.
const PLACES: usize = 64;
/// Lengths are told as powers of two seconds, up to this one: over an hour.
const MOST_EXPONENT: u32 = 12;
/// How often somebody who waits looks: so seldom that it disturbs no measurement.
const TICK: Duration = Duration::from_millis(50);
/// The variable that names another queue than the host's, for programs that test this one.
const VARIABLE: &str = "RAYSCOPE_BENCH_QUEUE";

impl BenchQueue {
    /// The one that all programs of this host share, unless the environment names another.
    pub fn of_host() -> Self {
        let named = std::env::var(VARIABLE).ok().filter(|n| !n.is_empty());
        Self(named.unwrap_or_else(|| "rayscope-measures".into()))
    }

    /// One that nobody else knows of.
    pub fn private() -> Self {
        static MADE: AtomicU32 = AtomicU32::new(0);
        let number = MADE.fetch_add(1, Ordering::Relaxed);
        Self(format!("rayscope-{}-{number}", std::process::id()))
    }

    /// The queue's name, as the environment has it.
    pub fn variable(&self) -> (&'static str, &str) {
        (VARIABLE, &self.0)
    }

    /// Waits for the right to measure for about `length`. Whoever waits is told how it is, again and
    /// again, and waits no more once they say false: then there is no lock.
    pub fn wait(
        &self,
        length: Duration,
        mut go_on: impl FnMut(BenchWait) -> bool,
    ) -> io::Result<Option<BenchLock>> {
        let exponent = exponent(length);
        let mut place = self.enter(exponent)?;
        loop {
            self.move_up(&mut place, exponent)?;
            if place.number == 0 {
                return Ok(Some(BenchLock(place)));
            }
            let wait = BenchWait {
                ahead: place.number,
                about: (0..place.number).map(|n| self.length_at(n)).sum(),
            };
            if !go_on(wait) {
                return Ok(None);
            }
            thread::sleep(TICK);
        }
    }

    /// Takes the place behind the last that is taken.
    fn enter(&self, exponent: u32) -> io::Result<QueuePlace> {
        loop {
            let mut number = 0;
            for last in (0..PLACES).rev() {
                if HostLock::is_taken(&self.place(last))? {
                    number = last + 1;
                    break;
                }
            }
            if number == PLACES {
                return Err(io::Error::other("too many wait to measure"));
            }
            // Where another newcomer was quicker, the next look finds them.
            if let Some(place) = self.take(number, exponent)? {
                return Ok(place);
            }
        }
    }

    /// Moves up as far as places are free.
    fn move_up(&self, place: &mut QueuePlace, exponent: u32) -> io::Result<()> {
        while place.number > 0 {
            match self.take(place.number - 1, exponent)? {
                Some(better) => *place = better,
                None => break,
            }
        }
        Ok(())
    }

    fn take(&self, number: usize, exponent: u32) -> io::Result<Option<QueuePlace>> {
        let Some(name) = HostLock::take(&self.place(number))? else {
            return Ok(None);
        };
        Ok(Some(QueuePlace {
            number,
            _name: name,
            _length: HostLock::take(&self.length(number, exponent))?,
        }))
    }

    /// How long the holder of that place said to need.
    fn length_at(&self, number: usize) -> Duration {
        let told = |&exponent: &u32| {
            let taken = HostLock::is_taken(&self.length(number, exponent));
            taken.unwrap_or(false)
        };
        let exponent = (0..=MOST_EXPONENT).find(told).unwrap_or(0);
        Duration::from_secs(1 << exponent)
    }

    fn place(&self, number: usize) -> String {
        format!("{}-{number}", self.0)
    }

    fn length(&self, number: usize, exponent: u32) -> String {
        format!("{}-{number}-for-{}s", self.0, 1_u32 << exponent)
    }
}

/// The least power of two seconds that is not less than that.
fn exponent(length: Duration) -> u32 {
    let seconds = length.as_secs_f64().ceil() as u64;
    seconds
        .max(1)
        .next_power_of_two()
        .ilog2()
        .min(MOST_EXPONENT)
}

impl fmt::Display for BenchWait {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let before = match self.ahead {
            1 => "one measurement is".to_owned(),
            n => format!("{n} measurements are"),
        };
        write!(
            f,
            "{before} before this one, about {} s",
            self.about.as_secs()
        )
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Receiver, channel};
    use std::thread::JoinHandle;

    use super::*;

    const SHORT: Duration = Duration::from_secs(1);

    /// Somebody who asks on a thread: what they are told, and the lock they get.
    fn asks(queue: &BenchQueue, length: Duration) -> (Receiver<BenchWait>, JoinHandle<BenchLock>) {
        let (told, hears) = channel();
        let queue = queue.clone();
        let asker = thread::spawn(move || {
            let lock = queue.wait(length, |wait| told.send(wait).is_ok());
            lock.unwrap().expect("the lock")
        });
        (hears, asker)
    }

    #[test]
    fn everybody_gets_their_turn_in_the_order_in_which_they_asked() {
        let queue = BenchQueue::private();
        let first = queue.wait(Duration::from_secs(6), |_| false).unwrap();
        let first = first.expect("nobody is before");
        let (second_hears, second) = asks(&queue, SHORT);
        let ahead = |ahead, seconds| BenchWait {
            ahead,
            about: Duration::from_secs(seconds),
        };
        assert_eq!(second_hears.recv(), Ok(ahead(1, 8)));
        let (third_hears, third) = asks(&queue, SHORT);
        assert_eq!(third_hears.recv(), Ok(ahead(2, 9)));
        drop(first);
        let lock = second.join().unwrap();
        // The third moves up behind the second, which measures now.
        while third_hears.recv().expect("the third still waits") != ahead(1, 1) {}
        drop(lock);
        drop(third.join().unwrap());
        assert!(queue.wait(SHORT, |_| false).unwrap().is_some());
    }

    #[test]
    fn one_who_gives_up_leaves_the_queue() {
        let queue = BenchQueue::private();
        let _first = queue.wait(SHORT, |_| false).unwrap();
        assert!(queue.wait(SHORT, |_| false).unwrap().is_none());
        let mut ahead = 0;
        let none = queue.wait(SHORT, |wait| {
            ahead = wait.ahead;
            false
        });
        assert!(none.unwrap().is_none());
        assert_eq!(ahead, 1);
    }

    #[test]
    fn lengths_are_told_in_powers_of_two() {
        for (seconds, expected) in [(0.0, 0), (1.0, 0), (1.2, 1), (5.0, 3), (1e6, MOST_EXPONENT)] {
            assert_eq!(exponent(Duration::from_secs_f64(seconds)), expected);
        }
    }
}
