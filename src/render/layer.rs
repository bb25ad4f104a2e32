//! The answers of one method for the pixels of a picture: which sphere is seen, and at which root.

use super::nearest::NOBODY;
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
            (Class::Secant, Some(Place::Behind)) => Self::SecantBehind,
            (_, Some(Place::Inside)) => Self::Inside,
            (Class::Tangent, Some(Place::Hit)) => Self::Tangent,
            (Class::Secant, Some(Place::Hit)) => Self::Secant,
        }
    }

    /// The root of the sphere that is seen so.
    pub(super) const fn visible_root(self) -> Place {
        match self {
            Self::Inside => Place::Inside,
            _ => Place::Hit,
        }
    }

    const fn is_behind(self) -> bool {
        matches!(self, Self::TangentBehind | Self::SecantBehind)
    }

    /// Whether the line meets a sphere, be it behind the eye: the tutorial's boolean.
    pub const fn meets(self) -> bool {
        !matches!(self, Self::Miss | Self::Nan)
    }
}

/// The spheres seen at the pixels, and at which roots.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Layer {
    pub(super) t: Vec<f32>,
    pub(super) body: Vec<u32>,
    pub(super) contact: Vec<Contact>,
}

impl Layer {
    /// Nothing is known of a pixel.
    pub(super) fn clear(&mut self, i: usize) {
        self.t[i] = f32::INFINITY;
        self.body[i] = NOBODY;
        self.contact[i] = Contact::Miss;
    }

    /// Makes room for so many pixels; what they held is of no use.
    pub(super) fn resize(&mut self, pixels: usize) {
        self.t.resize(pixels, f32::INFINITY);
        self.body.resize(pixels, NOBODY);
        self.contact.resize(pixels, Contact::Miss);
    }

    /// Takes note of one answer; whether it is of the sphere that is seen so far. What is behind the
    /// eye is noted only if `also_behind`.
    pub(super) fn note(
        &mut self,
        i: usize,
        number: u32,
        answer: &Solution,
        also_behind: bool,
    ) -> bool {
        let contact = Contact::of(answer);
        match answer.visible() {
            Some(t) if (t, number) < (self.t[i], self.body[i]) => {
                self.t[i] = t;
                self.body[i] = number;
                self.contact[i] = contact;
                true
            }
            None if self.body[i] == NOBODY && (also_behind || !contact.is_behind()) => {
                self.contact[i] = self.contact[i].max(contact);
                false
            }
            _ => false,
        }
    }
}

/// Fills a buffer anew, in the memory that it has.
pub(super) fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}
