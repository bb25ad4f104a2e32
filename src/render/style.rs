//! Styles: how many pixels a cell of the terminal shows, and how a picture fits its room.

use crate::scene::{PixelShape, Scene, Size};
use crate::text::by_name;

/// How many pixels a cell shows, and with what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Style {
    /// Two pixels a cell, one above the other, as half blocks in two colours.
    #[default]
    Half,
    /// Two pixels across and four down a cell, each a dot.
    Braille,
    /// One pixel a cell, on a ramp of characters.
    Ascii,
    /// One pixel in two cells, `++` for a hit and `--` for a miss, as the tutorial prints it.
    Tutorial,
}

impl Style {
    /// All styles, in the order in which lists show them.
    pub const ALL: [Self; 4] = [Self::Half, Self::Braille, Self::Ascii, Self::Tutorial];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Half => "half",
            Self::Braille => "braille",
            Self::Ascii => "ascii",
            Self::Tutorial => "tutorial",
        }
    }

    /// The style of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        by_name(Self::ALL, Self::name, name)
    }

    /// The style after this one, round and round.
    #[must_use]
    pub const fn next(self) -> Self {
        match self {
            Self::Half => Self::Braille,
            Self::Braille => Self::Ascii,
            Self::Ascii => Self::Tutorial,
            Self::Tutorial => Self::Half,
        }
    }

    /// The least block of whole cells that holds whole pixels.
    const fn block(self) -> GlyphBlock {
        let (cells, pixels) = match self {
            Self::Half => (1, [1, 2]),
            Self::Braille => (1, [2, 4]),
            Self::Ascii => (1, [1, 1]),
            Self::Tutorial => (2, [1, 1]),
        };
        GlyphBlock { cells, pixels }
    }

    /// Columns and rows of cells that a picture of `size` pixels takes.
    pub const fn cells_of(self, size: Size) -> (u32, u32) {
        let GlyphBlock { cells, pixels } = self.block();
        let cols = size.width.div_ceil(pixels[0]).saturating_mul(cells);
        (cols, size.height.div_ceil(pixels[1]))
    }

    /// The most pixels that fit into `cols` by `rows` cells.
    pub const fn pixels_in(self, cols: u32, rows: u32) -> Size {
        let GlyphBlock { cells, pixels } = self.block();
        Size::new(
            (cols / cells).saturating_mul(pixels[0]),
            rows.saturating_mul(pixels[1]),
        )
    }

    /// Column and row of the cell (the left one of two) that shows pixel (x, y).
    pub const fn cell_of_pixel(self, x: u32, y: u32) -> (u32, u32) {
        let GlyphBlock { cells, pixels } = self.block();
        ((x / pixels[0]).saturating_mul(cells), y / pixels[1])
    }

    /// The top left pixel of the cell in this column and row.
    pub const fn pixel_of_cell(self, col: u32, row: u32) -> (u32, u32) {
        let GlyphBlock { cells, pixels } = self.block();
        (
            (col / cells).saturating_mul(pixels[0]),
            row.saturating_mul(pixels[1]),
        )
    }

    /// How many times as high as wide a pixel is, where a cell is `cell_aspect` times as high as
    /// wide.
    pub fn pixel_aspect(self, cell_aspect: f64) -> f64 {
        let GlyphBlock { cells, pixels } = self.block();
        cell_aspect * f64::from(pixels[0]) / (f64::from(pixels[1]) * f64::from(cells))
    }
}

/// So many cells in a row hold so many pixels across and down.
struct GlyphBlock {
    cells: u32,
    pixels: [u32; 2],
}

/// How many times as high as wide a cell of most terminals is.
pub const CELL_ASPECT: f64 = 2.0;

/// The picture of `scene` in a room of `cols` by `rows` cells: exactly the scene's own pixels if it
/// fixes them, however large the room; else as many as the room holds.
pub fn fit(
    scene: &Scene,
    style: Style,
    cols: u32,
    rows: u32,
    cell_aspect: f64,
) -> (Size, PixelShape) {
    scene.pixels.map_or_else(
        || {
            let shape = PixelShape::Aspect(style.pixel_aspect(cell_aspect));
            (style.pixels_in(cols, rows), shape)
        },
        |own| (own, PixelShape::Own),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_that_fills_its_room_takes_its_cells() {
        for style in Style::ALL {
            for (cols, rows) in [(0, 0), (2, 1), (20, 6), (80, 24), (500, 200)] {
                assert_eq!(style.cells_of(style.pixels_in(cols, rows)), (cols, rows));
            }
            assert_eq!(Style::by_name(style.name()), Some(style));
        }
    }

    #[test]
    fn the_cell_of_a_pixel_shows_it() {
        for style in Style::ALL {
            for y in 0..9 {
                for x in 0..9 {
                    let (col, row) = style.cell_of_pixel(x, y);
                    let (left, top) = style.pixel_of_cell(col, row);
                    let GlyphBlock { pixels: [w, h], .. } = style.block();
                    assert!((left..left + w).contains(&x) && (top..top + h).contains(&y));
                }
            }
        }
    }

    #[test]
    fn every_style_but_ascii_has_square_pixels_in_cells_twice_as_high_as_wide() {
        let aspect = Style::ALL.map(|s| s.pixel_aspect(2.0));
        assert_eq!(aspect, [1.0, 1.0, 2.0, 1.0]);
    }
}
