//! Boxes of pixels.

use crate::scene::Size;

/// Pixels from `left` to `right` and from `top` to `bottom`, all inclusive; none if a first one is
/// beyond its last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bounds {
    pub left: i16,
    pub right: i16,
    pub top: i16,
    pub bottom: i16,
}

impl Bounds {
    /// No pixel.
    pub(super) const NONE: Self = Self {
        left: i16::MAX,
        right: -1,
        top: i16::MAX,
        bottom: -1,
    };

    /// All pixels of a picture.
    pub(super) const fn whole(size: Size) -> Self {
        Self {
            left: 0,
            right: size.width as i16 - 1,
            top: 0,
            bottom: size.height as i16 - 1,
        }
    }

    /// Whether there is no pixel.
    pub(super) const fn is_empty(self) -> bool {
        self.left > self.right || self.top > self.bottom
    }

    /// How many rows there are.
    pub(super) const fn rows(self) -> u64 {
        if self.is_empty() {
            0
        } else {
            (self.bottom - self.top) as u64 + 1
        }
    }

    /// How many pixels there are.
    pub(super) const fn area(self) -> u64 {
        if self.is_empty() {
            0
        } else {
            self.rows() * ((self.right - self.left) as u64 + 1)
        }
    }

    /// Whether the two have no pixel in common, if `other` has any.
    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "one branch for all")]
    pub(super) const fn is_apart_from(self, other: Self) -> bool {
        (self.left > other.right)
            | (self.right < other.left)
            | (self.top > other.bottom)
            | (self.bottom < other.top)
    }

    /// The pixels that the two have in common.
    #[inline(always)]
    pub(super) const fn within(self, other: Self) -> Self {
        const fn most(a: i16, b: i16) -> i16 {
            if a > b { a } else { b }
        }
        const fn least(a: i16, b: i16) -> i16 {
            if a < b { a } else { b }
        }
        Self {
            left: most(self.left, other.left),
            right: least(self.right, other.right),
            top: most(self.top, other.top),
            bottom: least(self.bottom, other.bottom),
        }
    }

    /// With the pixels beside it, as far as the picture goes.
    pub(super) fn widened(self, size: Size) -> Self {
        if self.is_empty() {
            return self;
        }
        Self {
            left: self.left - 1,
            right: self.right + 1,
            top: self.top - 1,
            bottom: self.bottom + 1,
        }
        .within(Self::whole(size))
    }

    /// The least rectangle that holds both.
    pub(super) fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}
