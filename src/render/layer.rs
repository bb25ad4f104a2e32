//! The answers of one method for the pixels of a picture: which sphere is seen, and at which root.

use std::ops::Range;

use crate::method::{Class, Place, Solution};

/// What the line of a pixel does, of all spheres together: that of the nearest visible hit, else
/// the greatest in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Contact {
    /// It misses every sphere.
    #[default]
    Miss,
    /// It touches a sphere behind the eye.
    TangentBehind,
    /// It crosses a sphere behind the eye.
    SecantBehind,
    /// It meets nothing, as far as the method can tell, but for one sphere at least the method's
    /// discriminant is not a number.
    Nan,
    /// It touches the nearest visible sphere.
    Tangent,
    /// It crosses the nearest visible sphere, which lies before the eye.
    Secant,
    /// The eye is inside the nearest visible sphere.
    Inside,
}

impl Contact {
    pub(super) fn of(answer: &Solution) -> Self {
        match (answer.class, answer.place()) {
            (Class::Nan, _) => Self::Nan,
            (Class::Miss, _) | (_, None) => Self::Miss,
            (Class::Tangent, Some(Place::Behind)) => Self::TangentBehind,
            (Class::Secant | Class::Hit, Some(Place::Behind)) => Self::SecantBehind,
            (_, Some(Place::Inside)) => Self::Inside,
            (Class::Tangent, Some(Place::Hit)) => Self::Tangent,
            (Class::Secant | Class::Hit, Some(Place::Hit)) => Self::Secant,
        }
    }

    /// Where the sphere lies that is seen so.
    pub(super) const fn place(self) -> Place {
        match self {
            Self::Inside => Place::Inside,
            _ => Place::Hit,
        }
    }

    const fn is_behind(self) -> bool {
        matches!(self, Self::TangentBehind | Self::SecantBehind)
    }

    /// Whether the line meets a sphere, also behind the eye: the tutorial's boolean.
    pub const fn meets(self) -> bool {
        !matches!(self, Self::Miss | Self::Nan)
    }
}

/// No sphere: greater than the number of any.
pub(super) const NOBODY: u32 = u32::MAX;

/// Marks the number of a sphere that the method itself found at this pixel: how its line meets it is
/// noted, and t is the method's own. Else the certified test found it: a secant before the eye, t about
/// right.
pub(super) const ASKED: u32 = 1 << 31;

/// The number of the sphere that an entry names.
pub(super) const fn number(entry: u32) -> Option<u32> {
    if entry == NOBODY {
        None
    } else {
        Some(entry & !ASKED)
    }
}

/// The spheres seen at the pixels, and at which roots.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Layer {
    /// The visible root; ∞ where there is none.
    pub(super) t: Vec<f32>,
    /// The number of the sphere, with [`ASKED`] where that is so, or [`NOBODY`].
    pub(super) body: Vec<u32>,
    /// How the line meets it, where that does not follow from the entry: see [`Layer::contact`].
    pub(super) contact: Vec<Contact>,
}

impl Layer {
    /// Nothing is known of this number of pixels.
    pub(super) fn clear_all(&mut self, pixels: usize) {
        refill(&mut self.t, pixels, f32::INFINITY);
        refill(&mut self.body, pixels, NOBODY);
        refill(&mut self.contact, pixels, Contact::Miss);
    }

    /// Nothing is known of these pixels.
    pub(super) fn clear_run(&mut self, run: Range<usize>) {
        self.t[run.clone()].fill(f32::INFINITY);
        self.body[run.clone()].fill(NOBODY);
        self.contact[run].fill(Contact::Miss);
    }

    /// Which sphere is seen at a pixel.
    pub(super) fn seen(&self, i: usize) -> Option<u32> {
        number(self.body[i])
    }

    /// What the line of a pixel does.
    pub(super) fn contact(&self, i: usize) -> Contact {
        let entry = self.body[i];
        if entry == NOBODY || self.is_asked(i) {
            self.contact[i]
        } else {
            Contact::Secant
        }
    }

    /// Whether the method itself found what is seen at a pixel.
    pub(super) fn is_asked(&self, i: usize) -> bool {
        self.body[i] != NOBODY && self.body[i] & ASKED != 0
    }

    /// Notes what the method answered about a sphere; whether that is now the one that is seen. Another one
    /// that is seen goes before it unless it `is_first`. What is behind the eye is noted only if
    /// `also_behind`.
    pub(super) fn note(
        &mut self,
        i: usize,
        sphere: u32,
        answer: &Solution,
        also_behind: bool,
        is_first: impl FnOnce(u32) -> bool,
    ) -> bool {
        let contact = Contact::of(answer);
        match (answer.visible(), self.seen(i)) {
            (Some(t), seen) if seen.is_none_or(is_first) => {
                self.t[i] = t;
                self.body[i] = sphere | ASKED;
                self.contact[i] = contact;
                true
            }
            (None, None) if also_behind || !contact.is_behind() => {
                self.contact[i] = self.contact[i].max(contact);
                false
            }
            _ => false,
        }
    }
}

/// Fills a buffer again, in the memory that it has.
pub(super) fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}
