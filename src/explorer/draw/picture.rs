//! The picture, the reading under the cursor and its derivation, and what each was made from.

use crate::explain::{Reading, Step};
use crate::method::Method;
use crate::render::{Frame, Image, Look, View};
use crate::scene::{PixelShape, Rays, Scene, Size};

/// The picture on the screen, and what it was made from.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) key: Option<PictureKey>,
    pub(crate) rays: Rays,
    pub(crate) frame: Frame,
    pub(crate) image: Image,
    /// First column and row of the picture that are on the screen.
    pub(crate) offset: (u32, u32),
    /// Columns and rows of the picture, and the room, that the offset is for.
    scrolled_in: Option<(u32, u32, (u16, u16))>,
    pub(crate) reading: Option<Reading>,
    pub(crate) reading_key: Option<ReadingKey>,
    /// The derivation of the reading.
    pub(crate) steps: Vec<Step>,
    /// Which of its results differ from those of the reading before.
    pub(crate) changed: Vec<bool>,
    /// Whether the last frame needed nothing of the picture.
    pub(crate) rests: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PictureKey {
    pub(crate) version: u64,
    pub(crate) size: Size,
    pub(crate) shape: PixelShape,
    pub(crate) method: Method,
    pub(crate) view: View,
    pub(crate) look: Look,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ReadingKey {
    pub(crate) picture: PictureKey,
    pub(crate) cursor: (u32, u32),
    pub(crate) selected: Option<usize>,
    pub(crate) chosen: Option<usize>,
}

impl Picture {
    /// No picture yet, of a scene whose rays are known if it fixes its pixels.
    pub(crate) fn of(scene: &Scene) -> Self {
        let size = scene.pixels.unwrap_or(Size::new(1, 1));
        Self {
            key: None,
            rays: Rays::new(&scene.camera, size, PixelShape::Own),
            frame: Frame::new(),
            image: Image::new(),
            offset: (0, 0),
            scrolled_in: None,
            reading: None,
            reading_key: None,
            steps: Vec::new(),
            changed: Vec::new(),
            rests: false,
        }
    }

    /// Takes nothing of what is there for the picture of the scene that comes now.
    pub(crate) fn forget(&mut self) {
        (self.key, self.reading_key) = (None, None);
        // It speaks of spheres that the next scene may not have.
        self.reading = None;
        self.steps.clear();
    }

    /// Scrolls a picture that is larger than its room by as little as shows the cursor's cell; in
    /// another room, or for another size, from its middle.
    pub(crate) fn scroll_to(&mut self, cell: (u32, u32), room: (u16, u16)) {
        let sizes = (self.image.cols, self.image.rows, room);
        if self.scrolled_in != Some(sizes) {
            self.scrolled_in = Some(sizes);
            let middle = |all: u32, room: u16| all.saturating_sub(room.into()) / 2;
            self.offset = (
                middle(self.image.cols, room.0),
                middle(self.image.rows, room.1),
            );
        }
        let scrolled = |offset: u32, cell: u32, room: u32, all: u32| {
            let least = (cell + 1).saturating_sub(room);
            offset
                .clamp(least, cell.max(least))
                .min(all.saturating_sub(room))
        };
        self.offset = (
            scrolled(self.offset.0, cell.0, room.0.into(), self.image.cols),
            scrolled(self.offset.1, cell.1, room.1.into(), self.image.rows),
        );
    }
}
