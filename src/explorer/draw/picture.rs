//! The picture, the reading under the cursor and its derivation, and what each was made from.

use crate::explain::{Lens, Reading, Step};
use crate::method::Method;
use crate::render::{Allowance, Frame, Image, Look, View};
use crate::scene::{PixelShape, Rays, Scene, Size};

/// How many times as wide and as high as a pixel those of the sketches are that come first.
const SKETCHES: [u32; 2] = [16, 4];

/// The picture on the screen, and what it was made from.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) key: Option<PictureKey>,
    pub(crate) rays: Rays,
    pub(crate) frame: Frame,
    pub(crate) image: Image,
    /// The picture in larger pixels, if it takes long, and which of the sketches it is.
    sketch: Frame,
    sketching: Sketching,
    /// First column and row of the picture that are on the screen.
    pub(crate) offset: (u32, u32),
    /// Columns and rows of the picture, and the room, that the offset is for.
    scrolled_in: Option<(u32, u32, (u16, u16))>,
    /// What the chosen method finds.
    pub(crate) reading: Option<Reading>,
    /// What there is to find, if another method is chosen than `exact`.
    pub(crate) exact_reading: Option<Reading>,
    pub(crate) reading_key: Option<ReadingKey>,
    /// The derivation of the reading.
    pub(crate) steps: Vec<Step>,
    /// The derivation of the reading before, and which results differ from its own.
    pub(crate) steps_before: Vec<Step>,
    pub(crate) changed: Vec<bool>,
    /// Whether the derivation waits for the picture.
    pub(crate) is_derivation_pending: bool,
    /// Whether the last frame needed nothing of the picture.
    pub(crate) rests: bool,
    /// Whether the picture is done.
    is_drawn: bool,
}

/// How far a picture that takes long is sketched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sketching {
    /// It may not take long.
    NotYet,
    /// The sketch of this number is begun.
    Sketch(usize),
    /// The picture itself is next.
    Done,
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
    pub(crate) lens: Lens,
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
            sketch: Frame::new(),
            sketching: Sketching::Done,
            offset: (0, 0),
            scrolled_in: None,
            reading: None,
            exact_reading: None,
            reading_key: None,
            steps: Vec::new(),
            steps_before: Vec::new(),
            is_derivation_pending: false,
            changed: Vec::new(),
            rests: false,
            is_drawn: false,
        }
    }

    /// Begins the picture of a scene.
    pub(crate) fn begin(&mut self, scene: &Scene, key: PictureKey) {
        self.rays = Rays::new(&scene.camera, key.size, key.shape);
        self.frame.begin(scene, &self.rays, key.method, key.view);
        self.image.make_room(key.look.style.cells_of(key.size));
        self.sketching = Sketching::NotYet;
        self.key = Some(key);
        self.is_drawn = false;
    }

    /// Goes on with it while the allowance lasts; whether it is done.
    ///
    /// What takes long comes in coarse: the first allowance goes to the picture itself, the next ones to
    /// sketches, each of which is drawn, and the rest to the picture again.
    pub(crate) fn go_on(&mut self, scene: &Scene, allowance: &mut Allowance) -> bool {
        let Some(key) = self.key.filter(|_| !self.is_drawn) else {
            return true;
        };
        if let Sketching::Sketch(number) = self.sketching {
            return self.go_on_sketching(scene, key, number, allowance);
        }
        if self.frame.go_on(scene, &self.rays, allowance) {
            self.image.draw(&self.frame, scene, key.look);
            self.sketching = Sketching::Done;
            self.is_drawn = true;
        } else if self.sketching == Sketching::NotYet {
            self.begin_sketch(scene, key, 0);
        }
        self.is_drawn
    }

    fn begin_sketch(&mut self, scene: &Scene, key: PictureKey, number: usize) {
        self.sketching = SKETCHES.get(number).map_or(Sketching::Done, |&times| {
            let rays = self.rays.coarser(times);
            self.sketch.begin(scene, &rays, key.method, key.view);
            Sketching::Sketch(number)
        });
    }

    fn go_on_sketching(
        &mut self,
        scene: &Scene,
        key: PictureKey,
        number: usize,
        allowance: &mut Allowance,
    ) -> bool {
        let rays = self.rays.coarser(SKETCHES[number]);
        if self.sketch.go_on(scene, &rays, allowance) {
            self.image
                .draw_sketch(&self.sketch, key.size, scene, key.look);
            self.begin_sketch(scene, key, number + 1);
        }
        false
    }

    /// Whether nothing was drawn of it yet.
    pub(crate) fn is_begun_anew(&self) -> bool {
        !self.is_drawn && self.sketching == Sketching::NotYet
    }

    /// How much of the picture is done, in percent, if not all of it is.
    pub(crate) fn percent_done(&self) -> Option<u32> {
        (!self.is_drawn && self.key.is_some())
            .then(|| (100.0 * self.frame.share_done()).floor() as u32)
    }

    /// Takes nothing of what is there for the picture of the scene that comes now.
    pub(crate) fn forget(&mut self) {
        self.image.make_room((0, 0));
        (self.key, self.reading_key) = (None, None);
        // It speaks of spheres that the next scene may not have.
        (self.reading, self.exact_reading) = (None, None);
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
