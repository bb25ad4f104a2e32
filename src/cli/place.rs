//! Flags that say where in a scene the explorer opens: what a passed-on view consists of.

use clap::Args;

use super::choice;
use super::print::{pixel, size};
use crate::explorer::{Opening, Panel};
use crate::method::Method;
use crate::scene::Size;

/// Where in the scene to open.
#[derive(Debug, Args)]
#[command(next_help_heading = "Where to open")]
pub(super) struct Place {
    /// The pixel under the cursor
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    cursor: Option<(u32, u32)>,

    /// The picture in which the cursor counts, where the scene fixes none: on a screen of another
    /// size the cursor is put in the same place
    #[arg(long, value_name = "WxH", value_parser = size, requires = "cursor")]
    size: Option<Size>,

    /// The panel beside the picture
    #[arg(long, value_parser = choice(&Panel::ALL, Panel::name))]
    panel: Option<Panel>,

    /// The step of the derivation, by name or number
    #[arg(long, value_name = "STEP")]
    step: Option<String>,

    /// Where the moving point of slice and curve is
    #[arg(long = "t", value_name = "T", allow_negative_numbers = true)]
    t: Option<f64>,

    /// The method beside the chosen one
    #[arg(long, value_name = "METHOD", value_parser = choice(&Method::ALL, Method::name))]
    compare: Option<Method>,

    /// The sphere that is selected, from 1
    #[arg(long, value_name = "N")]
    sphere: Option<usize>,

    /// The sphere that the panel shows, of those on the line under the cursor
    #[arg(long, value_name = "N")]
    shown: Option<usize>,

    /// A number of the selected sphere or the camera, as after `:set`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl Place {
    pub(super) fn opening(&self) -> Opening {
        Opening {
            set: self.set.clone(),
            sphere: self.sphere,
            shown: self.shown,
            cursor: self.cursor,
            size: self.size,
            panel: self.panel,
            step: self.step.clone(),
            t: self.t.filter(|t| t.is_finite()),
            compare: self.compare,
            ..Opening::default()
        }
    }
}
