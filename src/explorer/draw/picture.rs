//! The picture and the reading under the cursor: made anew only when what they depend on changed.

use ratatui::layout::Rect;

use crate::explain::{Drawn, Reading, Step, derivation};
use crate::explorer::arrival;
use crate::explorer::draw::layout;
use crate::explorer::{Explorer, Options};
use crate::method::Method;
use crate::render::{Frame, Image, Look, View, fit};
use crate::scene::{PixelShape, Rays, Scene, Size};
use crate::text::Glyphs;

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

impl Explorer {
    /// Brings picture and panel up to date for a screen of this many columns and rows.
    pub fn prepare(&mut self, cols: u16, rows: u16) {
        self.screen = (cols, rows);
        let area = Rect::new(0, 0, cols, rows);
        let room = layout::inner(self.layout(area).unwrap_or_default().view);
        let room = (room.width, room.height);
        let Options {
            style,
            view,
            aspect,
            glyphs,
            method,
            ..
        } = self.options;
        let (size, shape) = fit(self.scene(), style, room.0.into(), room.1.into(), aspect);
        let key = PictureKey {
            version: self.document.version(),
            size,
            shape,
            method,
            view: view.shown_in(style),
            look: Look {
                style,
                depth: self.options.colors(),
                ascii_only: glyphs == Glyphs::Ascii,
                coarse: self.coarse,
            },
        };
        self.picture.rests = self.picture.key == Some(key);
        if !self.picture.rests {
            self.scale_cursor(size);
            let scene = self.document.scene();
            let picture = &mut self.picture;
            picture.rays = Rays::new(&scene.camera, size, shape);
            picture.frame.render(scene, &picture.rays, method, key.view);
            picture.image.draw(&picture.frame, scene, key.look);
            picture.key = Some(key);
        }
        self.arrive();
        self.picture
            .scroll_to(style.cell_of_pixel(self.cursor.0, self.cursor.1), room);
        self.read(key);
        self.arrive_at_step();
        self.date_chart();
        self.find_errors();
    }

    /// Brings picture and reading up to date between two drawings, for what acts on them: several
    /// events may come before the next drawing, and the outcome must not depend on how many.
    pub(crate) fn refresh(&mut self) {
        let (cols, rows) = self.screen;
        if (cols, rows) != (0, 0) {
            self.prepare(cols, rows);
        }
    }

    /// Keeps the cursor on the same place of the picture when the number of pixels changes.
    pub(crate) fn scale_cursor(&mut self, size: Size) {
        let Some(old) = self.picture.key.map(|k| k.size) else {
            if self.scene().pixels.is_none() {
                self.cursor = (size.width / 2, size.height / 2);
            }
            return;
        };
        self.cursor = arrival::scaled(self.cursor, old, size);
    }

    pub(crate) fn read(&mut self, picture: PictureKey) {
        let key = ReadingKey {
            // How finely the picture is drawn makes no other reading.
            picture: PictureKey {
                look: Look {
                    coarse: false,
                    ..picture.look
                },
                ..picture
            },
            cursor: self.cursor,
            selected: self.selected,
            chosen: self.chosen,
        };
        if self.picture.reading_key == Some(key) {
            return;
        }
        let ray = self.picture.rays.ray(self.cursor.0, self.cursor.1);
        self.picture.reading = Some(Reading::take(
            self.scene(),
            self.cursor,
            ray,
            self.options.method,
            self.selected,
            self.chosen,
        ));
        self.picture.reading_key = Some(key);
        self.derive();
    }

    /// Derives the reading anew and notes which results are other ones than before.
    fn derive(&mut self) {
        let Some(reading) = &self.picture.reading else {
            return;
        };
        let Picture { frame, image, .. } = &self.picture;
        let drawn = Drawn::at(self.cursor, frame, image, self.options.style);
        let steps = derivation(reading, self.scene(), &self.picture.rays, &drawn);
        let before = std::mem::take(&mut self.picture.steps);
        let is_new = |step: &Step| {
            let old = before.iter().find(|old| old.name == step.name);
            !before.is_empty() && old.is_none_or(|old| old.result != step.result)
        };
        self.picture.changed = steps.iter().map(is_new).collect();
        self.picture.steps = steps;
        self.keep_step(&before);
        self.prediction.revealed = false;
    }
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
    fn scroll_to(&mut self, cell: (u32, u32), room: (u16, u16)) {
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
