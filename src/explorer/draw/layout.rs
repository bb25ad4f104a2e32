//! Where things stand on the screen.
//!
//! ```text
//!  title ─────────────────────────────────────────────
//! ┌ view ──────────────────┐┌ panel ─────────────────┐
//! │                        ││                        │   wide: side by side
//! └────────────────────────┘└────────────────────────┘   narrow: one above the other
//!  tour ──────────────────────────────────────────────   small: a strip for the panel
//!  footer ────────────────────────────────────────────
//! ```

use ratatui::layout::Rect;

use crate::render::Image;

/// The smallest screen that is drawn on, in columns and rows.
pub const LEAST: (u16, u16) = (20, 6);
/// From this width on the panel stands beside the view.
const WIDE: u16 = 66;
/// From this height on a narrow screen has room for view and panel.
const TALL: u16 = 18;
/// The panel's width: at least, and at most.
const PANEL: (u16, u16) = (38, 58);
/// What the border takes.
const BORDER: u16 = 2;

/// The parts of a screen; a part that has no room is empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Layout {
    /// One line at the top.
    pub title: Rect,
    /// The picture with its border.
    pub view: Rect,
    /// The panel with its border.
    pub panel: Rect,
    /// One line that stands for the panel where there is no room for it.
    pub strip: Rect,
    /// The tour's page, over the footer, while the tour is open.
    pub tour: Rect,
    /// One line at the bottom: keys, messages, questions.
    pub footer: Rect,
}

impl Layout {
    /// All that picture, panel and strip have between them; what is not shown has no place, and does
    /// not count.
    pub fn body(&self) -> Rect {
        let parts = [self.panel, self.strip].into_iter();
        parts
            .filter(|part| !part.is_empty())
            .fold(self.view, Rect::union)
    }

    /// The parts of a screen of `area` that shows a picture of `picture` columns and rows, or one
    /// that takes what room there is. None if the screen is too small.
    pub fn of(area: Rect, picture: Option<(u32, u32)>) -> Option<Self> {
        if area.width < LEAST.0 || area.height < LEAST.1 {
            return None;
        }
        let row = |y, height| Rect::new(area.x, y, area.width, height);
        let body = row(area.y + 1, area.height - 2);
        let mut layout = Self {
            title: row(area.y, 1),
            footer: row(area.bottom() - 1, 1),
            ..Self::default()
        };
        let wanted = picture.map(|(cols, rows)| {
            let outer = |n: u32| u16::try_from(n).unwrap_or(u16::MAX).saturating_add(BORDER);
            (outer(cols), outer(rows))
        });
        if area.width >= WIDE {
            let most = body.width - PANEL.0;
            let usual = body.width - (body.width * 2 / 5).clamp(PANEL.0, PANEL.1);
            // A picture of its own size leaves all the rest to the panels.
            let view = wanted.map_or(usual, |(cols, _)| cols.clamp(LEAST.0, most));
            (layout.view, layout.panel) = split_columns(body, view);
        } else if area.height >= TALL {
            let usual = body.height - body.height / 2;
            let view = wanted.map_or(usual, |(_, rows)| rows.min(usual));
            (layout.view, layout.panel) = split_rows(body, view);
        } else {
            (layout.view, layout.strip) = split_rows(body, body.height - 1);
        }
        Some(layout)
    }

    /// As [`Layout::of`], with a box of that many rows over the footer.
    pub fn with_box(area: Rect, picture: Option<(u32, u32)>, rows: u16) -> Option<Self> {
        let rest = Rect {
            height: area.height.saturating_sub(rows),
            ..area
        };
        let mut layout = Self::of(rest, picture)?;
        layout.tour = Rect {
            height: rows,
            ..layout.footer
        };
        layout.footer.y += rows;
        Some(layout)
    }
}

/// The smallest screen, no less than the usual one, that shows a picture of that many columns and rows
/// whole beside the panel.
pub fn screen_for(picture: Option<(u32, u32)>) -> (u16, u16) {
    let Some((cols, rows)) = picture else {
        return USUAL;
    };
    let most = |n: u32| u16::try_from(n).unwrap_or(u16::MAX).min(MOST);
    let (cols, rows) = (most(cols), most(rows));
    let height = USUAL.1.max(rows + BORDER + 2);
    let shows = |width: &u16| {
        let layout = Layout::of(Rect::new(0, 0, *width, height), None);
        layout.is_some_and(|layout| inner(layout.view).width >= cols)
    };
    let width = (USUAL.0..=MOST + PANEL.1 + BORDER).find(shows);
    (width.unwrap_or(MOST), height)
}

/// The usual screen, in columns and rows, which is drawn for where there is none.
pub const USUAL: (u16, u16) = (80, 24);
/// The most columns or rows of a picture that a screen is made for.
const MOST: u16 = 400;

fn split_columns(area: Rect, left: u16) -> (Rect, Rect) {
    let right = Rect::new(area.x + left, area.y, area.width - left, area.height);
    (
        Rect {
            width: left,
            ..area
        },
        right,
    )
}

fn split_rows(area: Rect, top: u16) -> (Rect, Rect) {
    let bottom = Rect::new(area.x, area.y + top, area.width, area.height - top);
    (
        Rect {
            height: top,
            ..area
        },
        bottom,
    )
}

/// What is inside a border.
pub fn inner(area: Rect) -> Rect {
    if area.width < BORDER || area.height < BORDER {
        return Rect::default();
    }
    Rect::new(
        area.x + 1,
        area.y + 1,
        area.width - BORDER,
        area.height - BORDER,
    )
}

/// What is inside a panel's border, a blank away from it.
pub fn text_room(area: Rect) -> Rect {
    let room = inner(area);
    Rect {
        x: room.x + 1,
        width: room.width.saturating_sub(2),
        ..room
    }
}

/// The cells inside the border of `view` that show `image` from its column and row `offset` on: a
/// picture that is smaller than its room stands in the middle.
pub fn centered(view: Rect, image: &Image, (left, top): (u32, u32)) -> Rect {
    let room = inner(view);
    let width = (image.cols - left.min(image.cols)).min(room.width.into()) as u16;
    let height = (image.rows - top.min(image.rows)).min(room.height.into()) as u16;
    Rect::new(
        room.x + (room.width - width) / 2,
        room.y + (room.height - height) / 2,
        width,
        height,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_fill_every_screen_and_never_overlap() {
        for width in (0..300).step_by(7) {
            for height in (0..120).step_by(3) {
                let pictures = [None, Some((40, 20)), Some((400, 300)), Some((u32::MAX, 1))];
                for (picture, rows) in pictures.into_iter().flat_map(|p| [(p, 0), (p, 6)]) {
                    let area = Rect::new(0, 0, width, height);
                    let Some(l) = Layout::with_box(area, picture, rows) else {
                        assert!(width < LEAST.0 || height < LEAST.1 + rows);
                        continue;
                    };
                    let parts = [l.title, l.view, l.panel, l.strip, l.tour, l.footer];
                    let sum: u32 = parts.iter().map(|p| p.area()).sum();
                    assert_eq!(sum, area.area(), "{area} {picture:?} {l:?}");
                    assert!(
                        parts
                            .iter()
                            .all(|p| p.intersection(area) == *p || p.is_empty())
                    );
                }
            }
        }
    }

    #[test]
    fn the_tutorials_picture_fits_a_screen_of_80_by_24() {
        let layout = Layout::of(Rect::new(0, 0, 80, 24), Some((40, 20))).unwrap();
        assert_eq!(inner(layout.view), Rect::new(1, 2, 40, 20));
        assert_eq!(layout.panel.width, 38);
    }
}
