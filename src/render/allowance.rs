//! How much of a frame is worked out before somebody else has a turn.

use std::time::Instant;

/// How much work is done between two looks at the clock: about a tenth of a millisecond.
const UNTIL_A_LOOK: u64 = 20_000;

/// How often a method is asked about one sphere at most before the clock is looked at.
const QUESTIONS: u64 = 500;

/// How much work may be done now: up to a count, up to a time, or all there is.
///
/// A unit of work is about a certified test of eight pixels.
#[derive(Debug, Clone, Copy)]
pub struct Allowance {
    left: u64,
    until: Option<Instant>,
    /// Since the last look at the clock.
    spent: u64,
}

impl Allowance {
    /// For all there is to do.
    pub const fn endless() -> Self {
        Self::of(u64::MAX)
    }

    /// For this much work.
    pub const fn of(work: u64) -> Self {
        Self {
            left: work,
            until: None,
            spent: 0,
        }
    }

    /// For as much work as can be done until then.
    pub const fn until(time: Instant) -> Self {
        Self {
            until: Some(time),
            ..Self::endless()
        }
    }

    /// How much work that is, if the clock does not end it.
    pub const fn units(&self) -> u64 {
        self.left
    }

    /// Notes that so much work was done.
    #[inline(always)]
    pub fn spend(&mut self, work: u64) {
        self.left = self.left.saturating_sub(work);
        self.spent += work;
        if self.spent >= UNTIL_A_LOOK {
            self.look();
        }
    }

    #[inline(never)]
    fn look(&mut self) {
        self.spent = 0;
        if self.until.is_some_and(|until| until <= Instant::now()) {
            self.left = 0;
        }
    }

    /// Whether nothing more is to be done now.
    #[inline(always)]
    pub const fn is_used_up(&self) -> bool {
        self.left == 0
    }

    /// How often a method may be asked about one sphere before the next check.
    pub(super) fn questions(&self) -> u64 {
        self.left.clamp(1, QUESTIONS)
    }
}
