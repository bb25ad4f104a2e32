//! Where a person looks: what a link carries, a page of the tour sets, and a class shares.

use crate::explain::Lens;
use crate::explorer::panel::Panel;
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::{Scene, Size};

/// All that decides what the screen shows of a scene, but for the terminal's own colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// How the quadratic is evaluated.
    pub method: Method,
    /// Which story of a pixel is told.
    pub lens: Lens,
    /// How samples become characters.
    pub style: Style,
    /// What the picture shows.
    pub view: View,
    /// The panel that the person asked for; others join it where there is room.
    pub panel: Panel,
    /// The step of the derivation, from 0.
    pub step: usize,
    /// t of the moving point; none: where something is seen.
    pub t: Option<f64>,
    /// The method that the chosen one is compared with; none: the next one.
    pub compare: Option<Method>,
    /// The selected sphere, from 0.
    pub sphere: Option<usize>,
    /// The sphere on the line that the person wants to see, from 0.
    pub shown: Option<usize>,
    /// The pixel under the cursor.
    pub cursor: (u32, u32),
    /// The picture in which the cursor counts.
    pub size: Size,
}

impl Default for Viewpoint {
    fn default() -> Self {
        Self {
            method: Method::default(),
            lens: Lens::default(),
            style: Style::Half,
            view: View::default(),
            panel: Panel::default(),
            step: 0,
            t: None,
            compare: None,
            sphere: None,
            shown: None,
            cursor: (0, 0),
            size: Size::new(1, 1),
        }
    }
}

impl Viewpoint {
    /// How a scene is first looked at: from the middle of its picture, at its first sphere.
    pub(crate) fn of(scene: &Scene, size: Size) -> Self {
        Self {
            sphere: (!scene.bodies.is_empty()).then_some(0),
            cursor: (size.width / 2, size.height / 2),
            size,
            ..Self::default()
        }
    }
}
