//! What part of the slice is seen: as much as shows what matters, and no more.
//!
//! In this order, the first that keeps apart what is apart: the whole circle with p0, beyond a
//! break if it is far; the roots, or the gap of a miss, with heights stretched; p0 and the surface
//! under it.

use super::axis::{Axis, AxisPosition, DrawingArea, Stretch};
use super::canvas::Canvas;
use super::section::{Anchor, LinePoint, Section};
use crate::method::Class;

/// What part of the plane is seen, and how large.
#[derive(Debug, Clone)]
pub(super) struct SliceView {
    pub axis: Axis,
    /// The line's height, in dots from the top.
    pub base: f64,
    /// Dots a length of height.
    pub up: f64,
}

/// The least distance of two points, in dots, at which both are seen.
const APART: f64 = 5.0;

/// The least gap between line and circle, in dots, that is seen as one.
const GAP: f64 = 1.5;

impl SliceView {
    /// The widest view that shows what matters: that two points are two, and a gap a gap.
    pub(super) fn of(section: &Section, canvas: &Canvas) -> Self {
        let frame = frame(canvas);
        let whole = Self::whole(section, frame);
        if whole.tells_apart(section, frame) {
            return whole;
        }
        let around_foot = Self::around_foot(section, frame);
        if around_foot.tells_apart(section, frame) {
            return around_foot;
        }
        Self::around_start(section, frame).unwrap_or(whole)
    }

    /// The whole circle, and p0: beyond a break if the circle would be small otherwise.
    fn whole(section: &Section, frame: DrawingArea) -> Self {
        let Section { radius, foot, .. } = *section;
        let (top, height) = (section.depth().max(0.0), section.distance + radius);
        let tall = top + height;
        let fit = |width: f64, room: f64| (room / width).min(frame.height() / tall);
        let circle = Stretch {
            anchor: Anchor::Foot,
            from: -radius,
            to: radius,
        };
        let all = Stretch {
            from: (-radius).min(-foot),
            to: radius.max(-foot),
            ..circle
        };
        let all_scale = fit(all.to - all.from, frame.width());
        let circle_scale = fit(2.0 * radius, frame.width_beside(1));
        let axis = if all_scale >= SMALLEST * circle_scale || tall == 0.0 {
            Axis::lay(frame, None, all, None, all_scale)
        } else {
            let [before, after] = sides_of(foot);
            Axis::lay(frame, before, circle, after, circle_scale)
        };
        let up = axis.scale;
        Self {
            axis,
            base: frame.top + (frame.height() - tall * up) / 2.0 + top * up,
            up,
        }
    }

    /// Both roots, or the tangent of a miss, and p0 if it is not far; heights stretched.
    fn around_foot(section: &Section, frame: DrawingArea) -> Self {
        let touch = match section.class {
            Class::Miss => section.touching_point(),
            _ => (section.half, 0.0),
        };
        let reach = touch.0 * 1.5;
        let start = -section.foot;
        let mut stretch = Stretch {
            anchor: Anchor::Foot,
            from: -reach,
            to: reach,
        };
        let mut breaks = [None, None];
        if start.abs() <= 2.0 * reach {
            stretch.from = stretch.from.min(start - 0.2 * reach);
            stretch.to = stretch.to.max(start + 0.2 * reach);
        } else {
            breaks = sides_of(section.foot);
        }
        Self::stretched(section, frame, breaks, stretch, touch.1)
    }

    /// p0 and the root nearest to it, the other root beyond a break; heights stretched if flat.
    fn around_start(section: &Section, frame: DrawingArea) -> Option<Self> {
        let root = section.nearest_root()?;
        let start = section.offset(LinePoint::At(Anchor::Start), root);
        let around = 0.8 * start.abs();
        let mut stretch = Stretch {
            anchor: root,
            from: start.min(0.0) - around,
            to: start.max(0.0) + around,
        };
        let other = match root {
            Anchor::Near => Anchor::Far,
            _ => Anchor::Near,
        };
        let away = section.offset(LinePoint::At(other), root);
        let mut breaks = [None, None];
        if away > stretch.to + 2.0 * around {
            breaks[1] = Some(other);
        } else if away < stretch.from - 2.0 * around {
            breaks[0] = Some(other);
        } else {
            stretch.from = stretch.from.min(away - 0.2 * around);
            stretch.to = stretch.to.max(away + 0.2 * around);
        }
        Some(Self::stretched(section, frame, breaks, stretch, 0.0))
    }

    /// A view of part of the line; heights are stretched if the circle is all but flat in it.
    fn stretched(
        section: &Section,
        frame: DrawingArea,
        [before, after]: [Option<Anchor>; 2],
        stretch: Stretch,
        lowest: f64,
    ) -> Self {
        let axis = Axis::lay(frame, before, stretch, after, f64::INFINITY);
        let range = heights(section, stretch)
            .map(|(bottom, top)| (bottom.min(lowest).min(0.0), top.max(0.0)));
        let room = frame.height();
        match range {
            Some((bottom, top)) if (top - bottom) * axis.scale < room * FLAT && top > bottom => {
                let up = room / (top - bottom);
                Self {
                    axis,
                    base: frame.top + top * up,
                    up,
                }
            }
            Some((bottom, top)) if (top - bottom) * axis.scale <= room => Self {
                base: frame.middle() + f64::midpoint(bottom, top) * axis.scale,
                up: axis.scale,
                axis,
            },
            _ => Self {
                base: frame.middle(),
                up: axis.scale,
                axis,
            },
        }
    }

    /// How many times heights are drawn too tall.
    pub(super) fn stretch(&self) -> f64 {
        self.up / self.axis.scale
    }

    /// Whether p0 and the roots are seen apart where they are, and a gap is seen as one.
    fn tells_apart(&self, section: &Section, frame: DrawingArea) -> bool {
        let apart = APART.min(frame.width() / 8.0);
        if section.class == Class::Miss {
            return -section.depth() * self.up >= GAP.min(frame.height() / 8.0);
        }
        let dot = |anchor| match self.axis.place(section, LinePoint::At(anchor)) {
            AxisPosition::On(dot) => Some(dot),
            _ => None,
        };
        let [start, near, far] = [Anchor::Start, Anchor::Near, Anchor::Far].map(dot);
        let seen = |same: bool, one: Option<f64>, other: Option<f64>| {
            same || one
                .zip(other)
                .is_none_or(|(one, other)| (one - other).abs() >= apart)
        };
        seen(section.class == Class::Tangent, near, far)
            && seen(section.near == 0.0, start, near)
            && seen(section.far == 0.0, start, far)
    }
}

/// The least and the greatest height of the upper half circle over a stretch of the line; none if
/// the stretch reaches beyond the circle.
fn heights(section: &Section, stretch: Stretch) -> Option<(f64, f64)> {
    const STEPS: u32 = 32;
    let length = stretch.to - stretch.from;
    let height = |i| {
        let part = f64::from(i) / f64::from(STEPS);
        section.upper(stretch.anchor, stretch.from + part * length)
    };
    let all: Option<Vec<f64>> = (0..=STEPS).map(height).collect();
    let all = all?.into_iter();
    Some((
        all.clone().fold(f64::INFINITY, f64::min),
        all.fold(f64::NEG_INFINITY, f64::max),
    ))
}

/// How small the circle may become, against the size it could have alone, to show p0 without a break.
const SMALLEST: f64 = 0.45;

/// What part of the room heights may fill before they count as flat and are stretched.
const FLAT: f64 = 0.3;

/// Breaks at the side where p0 is.
fn sides_of(foot: f64) -> [Option<Anchor>; 2] {
    if foot >= 0.0 {
        [Some(Anchor::Start), None]
    } else {
        [None, Some(Anchor::Start)]
    }
}

/// The room for shapes: margins are for labels.
fn frame(canvas: &Canvas) -> DrawingArea {
    let (width, height) = canvas.size();
    let side = (width / 10.0).min(8.0);
    let edge = (height / 8.0).min(5.0);
    DrawingArea {
        left: side,
        right: width - side,
        top: edge,
        bottom: height - edge,
    }
}
