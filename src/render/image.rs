//! The image: cells of a character and two colours, drawn from a frame in a style.

use std::ops::Range;

use super::bounds::Bounds;
use super::ink::{Ink, NO_ANSWER, ink};
use super::look::Look;
use super::ramp::Ramps;
use super::{ColorDepth, Contact, Frame, Style, View};
use crate::scene::{Rgb, Scene, Size};

/// A character and its colours; where there is none, the terminal's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Cell {
    /// The character, one cell wide.
    pub glyph: char,
    /// The colour of the character.
    pub fg: Option<Rgb>,
    /// The colour behind it.
    pub bg: Option<Rgb>,
}

impl Cell {
    /// Nothing to see.
    pub const BLANK: Self = Self::plain(' ');

    /// A character in the terminal's own colours.
    pub const fn plain(glyph: char) -> Self {
        Self {
            glyph,
            fg: None,
            bg: None,
        }
    }

    const fn of(glyph: char, fg: Option<Rgb>) -> Self {
        Self {
            glyph,
            fg,
            bg: None,
        }
    }
}

/// The cells of a picture, row by row.
#[derive(Debug, Clone, Default)]
pub struct Image {
    /// Cells in a row.
    pub cols: u32,
    /// Rows.
    pub rows: u32,
    /// `cols` × `rows` cells.
    pub cells: Vec<Cell>,
    ramps: Ramps,
    /// The edition of the frame that the cells show, and how.
    shown: Option<(u64, Look)>,
    drawn: u64,
    changed: u64,
}

impl Image {
    /// An image of no cells.
    pub fn new() -> Self {
        Self::default()
    }

    /// Draws `frame`, which was rendered from `scene`, in the place of what was here. Of the frame
    /// before, drawn in the same look, the cells are kept in which nothing can have changed.
    pub fn draw(&mut self, frame: &Frame, scene: &Scene, look: Look) {
        let (cols, rows) = look.style.cells_of(frame.size());
        self.ramps.set_depth(look.depth);
        let whole = Canvas {
            frame,
            size: frame.size(),
        };
        let shown = self.shown.filter(|&(_, shown)| shown == look);
        let parts = shown.and_then(|(edition, _)| frame.parts_changed_since(edition));
        self.shown = Some((frame.edition(), look));
        (self.drawn, self.changed) = (0, 0);
        if let Some(parts) = parts {
            for part in parts {
                let (across, down) = cells_within(part.widened(frame.size()), look.style);
                self.draw_part(whole, scene, look, across, down);
            }
            return;
        }
        self.resize(cols, rows);
        self.draw_part(whole, scene, look, 0..cols, 0..rows);
    }

    /// Draws the picture of `size` of which `sketch` is a frame with fewer and larger pixels.
    pub fn draw_sketch(&mut self, sketch: &Frame, size: Size, scene: &Scene, look: Look) {
        let (cols, rows) = look.style.cells_of(size);
        self.ramps.set_depth(look.depth);
        self.shown = None;
        (self.drawn, self.changed) = (0, 0);
        self.resize(cols, rows);
        let canvas = Canvas {
            frame: sketch,
            size,
        };
        self.draw_part(canvas, scene, look, 0..cols, 0..rows);
    }

    /// Takes this many columns and rows, blank ones if these are others than before.
    pub fn make_room(&mut self, (cols, rows): (u32, u32)) {
        if (self.cols, self.rows) != (cols, rows) {
            self.shown = None;
            self.resize(cols, rows);
            self.cells.fill(Cell::BLANK);
        }
    }

    fn resize(&mut self, cols: u32, rows: u32) {
        (self.cols, self.rows) = (cols, rows);
        self.cells
            .resize(cols as usize * rows as usize, Cell::BLANK);
    }

    fn draw_part(
        &mut self,
        canvas: Canvas,
        scene: &Scene,
        look: Look,
        across: Range<u32>,
        down: Range<u32>,
    ) {
        let mut painter = ImagePainter {
            canvas,
            scene,
            look,
            ramps: &mut self.ramps,
        };
        for row in down {
            let start = row as usize * self.cols as usize;
            for col in across.clone() {
                let cell = painter.cell(col, row);
                let place = &mut self.cells[start + col as usize];
                self.changed += u64::from(*place != cell);
                self.drawn += 1;
                *place = cell;
            }
        }
    }

    /// How many cells were drawn for the last frame.
    pub fn cells_drawn(&self) -> u64 {
        self.drawn.min(self.cells.len() as u64)
    }

    /// How many of them came out other than they were.
    pub fn cells_changed(&self) -> u64 {
        self.changed.min(self.cells.len() as u64)
    }

    /// The cell in this column and row, if the image has it.
    pub fn cell(&self, col: u32, row: u32) -> Option<Cell> {
        let inside = col < self.cols && row < self.rows;
        let index = row as usize * self.cols as usize + col as usize;
        inside.then(|| self.cells.get(index).copied()).flatten()
    }

    /// The rows of cells, from the top.
    pub fn lines(&self) -> impl Iterator<Item = &[Cell]> {
        // An image without columns has no cells, so the size of a chunk is never asked in vain.
        self.cells.chunks(self.cols.max(1) as usize)
    }
}

/// The columns and rows of cells that hold the pixels of `part`.
fn cells_within(part: Bounds, style: Style) -> (Range<u32>, Range<u32>) {
    if part.is_empty() {
        return (0..0, 0..0);
    }
    let (left, top) = style.cell_of_pixel(part.left as u32, part.top as u32);
    let up_to_its_end = Size::new(part.right as u32 + 1, part.bottom as u32 + 1);
    let (right, bottom) = style.cells_of(up_to_its_end);
    (left..right, top..bottom)
}

/// The pixels of a picture of this size, as a frame of this or of a smaller one has them.
#[derive(Clone, Copy)]
struct Canvas<'a> {
    frame: &'a Frame,
    size: Size,
}

impl Canvas<'_> {
    /// The pixel of the frame that shows pixel (x, y).
    fn place(&self, x: u32, y: u32) -> (u32, u32) {
        let Size { width, height } = self.frame.size();
        if self.size == self.frame.size() {
            return (x, y);
        }
        let scaled = |at: u32, few: u32, all: u32| at * few / all.max(1);
        (
            scaled(x, width, self.size.width),
            scaled(y, height, self.size.height),
        )
    }
}

struct ImagePainter<'a> {
    canvas: Canvas<'a>,
    scene: &'a Scene,
    look: Look,
    ramps: &'a mut Ramps,
}

impl ImagePainter<'_> {
    fn cell(&mut self, col: u32, row: u32) -> Cell {
        let (x, y) = self.look.style.pixel_of_cell(col, row);
        match self.look.style {
            Style::Half => self.half(x, y),
            Style::Braille => self.braille(x, y),
            Style::Ascii => self.ascii(x, y),
            Style::Tutorial => Cell::plain(self.tutorial(x, y)),
        }
    }

    /// What is to be seen at pixel (x, y); nothing where nothing is.
    fn ink(&mut self, x: u32, y: u32) -> Option<Ink> {
        let place = self.canvas.place(x, y);
        ink(self.canvas.frame, self.scene, self.look, self.ramps, place)
    }

    /// Whether levels are shown by how many dots there are, for want of colours.
    fn dithers(&self) -> bool {
        self.look.depth == ColorDepth::None && self.canvas.frame.view().has_levels()
    }

    /// Whether the pixel (x, y) of this level is bright enough for its place in the pattern, or an
    /// edge: the edges keep dark spheres whole and apart.
    fn has_dot(&self, x: u32, y: u32, ink: &Ink) -> bool {
        let rank = BAYER[y as usize % 4][x as usize % 4];
        let threshold = (f32::from(rank) + 0.5) / 16.0;
        ink.level > threshold || self.is_outline(x, y)
    }

    fn is_outline(&self, x: u32, y: u32) -> bool {
        let (x, y) = self.canvas.place(x, y);
        self.canvas.frame.outline(self.scene, x, y)
    }

    fn ascii(&mut self, x: u32, y: u32) -> Cell {
        match self.ink(x, y) {
            Some(ink) => Cell::of(ink.glyph, ink.color),
            None if self.canvas.frame.view() == View::Class => Cell::plain('.'),
            None => Cell::BLANK,
        }
    }

    /// The tutorial's two characters, of which this is one.
    fn tutorial(&self, x: u32, y: u32) -> char {
        let (x, y) = self.canvas.place(x, y);
        match self.canvas.frame.contact(x, y) {
            Contact::Nan => NO_ANSWER,
            contact if contact.meets() => '+',
            _ => '-',
        }
    }

    fn half(&mut self, x: u32, y: u32) -> Cell {
        let (top, bottom) = (self.ink(x, y), self.ink(x, y + 1));
        if let Some(ink) = [top, bottom].into_iter().flatten().find(Ink::is_alarm) {
            return Cell::of(ink.glyph, ink.color);
        }
        let glyph = quadrants(self.quarters(top), self.quarters(bottom));
        let glyph = if self.look.ascii_only {
            ascii_for_half(glyph)
        } else {
            glyph
        };
        match (top.and_then(|i| i.color), bottom.and_then(|i| i.color)) {
            // One glyph shows two colours only as an upper half on a lower one.
            (Some(fg), Some(bg)) if fg != bg && glyph == '█' => Cell {
                glyph: '▀',
                fg: Some(fg),
                bg: Some(bg),
            },
            (upper, lower) => Cell::of(glyph, upper.or(lower)),
        }
    }

    /// The quarters of a half block that a pixel sets. Where a colour shows its level it sets both.
    fn quarters(&self, ink: Option<Ink>) -> usize {
        let colored = self.look.depth != ColorDepth::None;
        match ink {
            None => 0b00,
            Some(_) if colored && self.canvas.frame.view() != View::Class => 0b11,
            Some(ink) => ink.quarters,
        }
    }

    fn braille(&mut self, x: u32, y: u32) -> Cell {
        let mut dots = 0;
        let mut seen: Option<Ink> = None;
        for (dx, dy, dot) in DOTS {
            let (x, y) = (x + dx, y + dy);
            let Some(ink) = self.ink(x, y) else {
                continue;
            };
            if self.dithers() && !ink.is_alarm() && !self.has_dot(x, y, &ink) {
                continue;
            }
            dots |= dot;
            if seen.is_none_or(|s| ink.rank() > s.rank()) {
                seen = Some(ink);
            }
        }
        let Some(seen) = seen else {
            return Cell::BLANK;
        };
        let glyph = if seen.is_alarm() {
            seen.glyph
        } else if self.look.ascii_only {
            ascii_for_dots(dots)
        } else {
            char::from_u32(0x2800 + dots).unwrap_or(' ')
        };
        Cell::of(glyph, seen.color)
    }
}

/// The block whose upper left and right and lower left and right quarters are set.
const fn quadrants(top: usize, bottom: usize) -> char {
    const BLOCKS: [[char; 4]; 4] = [
        [' ', '▗', '▖', '▄'],
        ['▝', '▐', '▞', '▟'],
        ['▘', '▚', '▌', '▙'],
        ['▀', '▜', '▛', '█'],
    ];
    BLOCKS[top & 3][bottom & 3]
}

const fn ascii_for_half(block: char) -> char {
    match block {
        ' ' => ' ',
        '▀' => '"',
        '▄' => ',',
        '█' => '#',
        '▝' | '▗' | '▐' | '▜' | '▟' => '-',
        _ => 'o',
    }
}

/// Bayer's order in which the dots of a 4 × 4 block light up as it gets brighter.
const BAYER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// Column, row and bit of the dots of a braille cell.
const DOTS: [(u32, u32, u32); 8] = [
    (0, 0, 0x01),
    (0, 1, 0x02),
    (0, 2, 0x04),
    (1, 0, 0x08),
    (1, 1, 0x10),
    (1, 2, 0x20),
    (0, 3, 0x40),
    (1, 3, 0x80),
];

const fn ascii_for_dots(dots: u32) -> char {
    match dots.count_ones() {
        0 => ' ',
        1 | 2 => '.',
        3 | 4 => ':',
        5 | 6 => 'o',
        _ => '#',
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::ink::class_quarters;
    use super::*;
    use crate::geometry::Sphere;
    use crate::method::Method;
    use crate::scene::{Body, Camera, PixelShape, Projection, Rays, Size};

    /// Before the eye one sphere on another, beside them one behind the eye, all of which exact
    /// integers touch; nothing else.
    fn scene() -> Scene {
        let bodies = [[6.0, 6.0, 20.0], [9.0, 7.0, 12.0], [20.0, 9.0, -9.0]];
        let body = |center: [f32; 3]| Body {
            sphere: Sphere::new(center.into(), 5.0).expect("a sphere"),
            name: None,
            color: None,
        };
        Scene {
            name: "test".into(),
            about: None,
            camera: Camera {
                projection: Projection::Orthographic {
                    extent: [26.0, 16.0],
                    step: None,
                },
                position: Vec3::new(12.5, 7.5, 0.0),
                look_at: Vec3::new(12.5, 7.5, 1.0),
                up: Vec3::NEG_Y,
            },
            pixels: Some(Size::new(26, 16)),
            bodies: bodies.map(body).into(),
            light: None,
            probes: Vec::new(),
        }
    }

    fn frame_of(scene: &Scene, view: View) -> Frame {
        let mut frame = Frame::new();
        let rays = Rays::new(&scene.camera, Size::new(26, 16), PixelShape::Own);
        frame.render(scene, &rays, Method::Textbook, view);
        frame
    }

    fn drawn(view: View, style: Style, depth: ColorDepth) -> (Frame, Image) {
        let scene = scene();
        let frame = frame_of(&scene, view);
        let mut image = Image::new();
        let look = Look {
            style,
            depth,
            ascii_only: false,
            coarse: false,
        };
        image.draw(&frame, &scene, look);
        (frame, image)
    }

    fn pixels(frame: &Frame) -> impl Iterator<Item = (u32, u32)> + use<> {
        let Size { width, height } = frame.size();
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    fn cell_at(image: &Image, style: Style, x: u32, y: u32) -> Cell {
        let (col, row) = style.cell_of_pixel(x, y);
        image.cell(col, row).expect("a cell")
    }

    #[test]
    fn a_half_block_says_of_each_of_its_pixels_whether_it_is_hit() {
        for depth in ColorDepth::ALL {
            let (frame, image) = drawn(View::Shade, Style::Half, depth);
            for (x, y) in pixels(&frame) {
                let cell = cell_at(&image, Style::Half, x, y);
                let shows = match cell.glyph {
                    '█' => true,
                    '▀' => y % 2 == 0 || cell.bg.is_some(),
                    '▄' => y % 2 == 1,
                    ' ' => false,
                    other => panic!("{other}"),
                };
                assert_eq!(shows, frame.seen(x, y).is_some(), "{depth:?} ({x}, {y})");
                assert_eq!(
                    cell.fg.is_some(),
                    depth != ColorDepth::None && cell.glyph != ' '
                );
            }
        }
    }

    #[test]
    fn a_half_block_tells_the_classes_of_its_pixels_without_colour() {
        let (frame, image) = drawn(View::Class, Style::Half, ColorDepth::None);
        for (x, y) in pixels(&frame) {
            let glyph = cell_at(&image, Style::Half, x, y).glyph;
            let shown = class_quarters(frame.contact(x, y));
            let fits = |other: usize| match y % 2 {
                0 => quadrants(shown, other) == glyph,
                _ => quadrants(other, shown) == glyph,
            };
            assert!((0..4).any(fits), "{glyph} at ({x}, {y})");
        }
        let mut blocks: Vec<_> = (0..16).map(|i| quadrants(i / 4, i % 4)).collect();
        blocks.sort_unstable();
        blocks.dedup();
        assert_eq!(blocks.len(), 16, "two pairs of classes look the same");
    }

    #[test]
    fn braille_has_a_dot_for_each_hit_and_without_colour_for_each_edge() {
        let scene = scene();
        let dot = |image: &Image, x: u32, y: u32| {
            let glyph = cell_at(image, Style::Braille, x, y).glyph;
            let (_, _, bit) = DOTS[DOTS
                .iter()
                .position(|&(dx, dy, _)| (dx, dy) == (x % 2, y % 4))
                .expect("a dot")];
            glyph != ' ' && (glyph as u32 - 0x2800) & bit != 0
        };
        let (frame, image) = drawn(View::Shade, Style::Braille, ColorDepth::Ansi256);
        for (x, y) in pixels(&frame) {
            assert_eq!(dot(&image, x, y), frame.seen(x, y).is_some());
        }
        let (frame, image) = drawn(View::Shade, Style::Braille, ColorDepth::None);
        for (x, y) in pixels(&frame) {
            assert!(!dot(&image, x, y) || frame.seen(x, y).is_some());
            assert!(dot(&image, x, y) || !frame.outline(&scene, x, y));
        }
        let (frame, image) = drawn(View::Outline, Style::Braille, ColorDepth::True);
        for (x, y) in pixels(&frame) {
            assert_eq!(dot(&image, x, y), frame.outline(&scene, x, y));
        }
    }

    #[test]
    fn an_edge_belongs_to_the_nearer_sphere() {
        let scene = scene();
        let frame = frame_of(&scene, View::Outline);
        for (x, y) in pixels(&frame).filter(|&(x, y)| frame.outline(&scene, x, y)) {
            let here = frame.hit(&scene, x, y).expect("an edge is of a hit");
            let around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
            let beyond = |(x, y)| frame.hit(&scene, x, y).is_none_or(|there| there.t > here.t);
            assert!(around.into_iter().any(beyond), "({x}, {y})");
        }
        // Where the two meet on the row through both, the farther one has no edge of its own.
        assert!(frame.outline(&scene, 4, 7) && !frame.outline(&scene, 3, 7));
    }

    #[test]
    fn ascii_tells_every_contact_apart() {
        let (frame, image) = drawn(View::Class, Style::Ascii, ColorDepth::None);
        let mut seen: Vec<_> = pixels(&frame)
            .map(|(x, y)| {
                (
                    frame.contact(x, y),
                    cell_at(&image, Style::Ascii, x, y).glyph,
                )
            })
            .collect();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(
            seen,
            [
                (Contact::Miss, '.'),
                (Contact::TangentBehind, '~'),
                (Contact::SecantBehind, '-'),
                (Contact::Tangent, 'o'),
                (Contact::Secant, '#')
            ]
        );
    }

    #[test]
    fn where_a_method_has_no_answer_every_style_says_so() {
        let mut scene = scene();
        // B² and 4AC overflow: ∞ − ∞ is not a number.
        scene.bodies = vec![Body {
            sphere: Sphere::new(Vec3::new(0.0, 0.0, 1e30), 1.0).expect("a sphere"),
            name: None,
            color: None,
        }];
        for view in View::ALL.into_iter().filter(|v| *v != View::Stage) {
            let frame = frame_of(&scene, view);
            for style in Style::ALL {
                let mut image = Image::new();
                let look = Look {
                    style,
                    ..Look::default()
                };
                image.draw(&frame, &scene, look);
                assert!(image.cells.iter().all(|cell| cell.glyph == NO_ANSWER));
            }
        }
    }
}
