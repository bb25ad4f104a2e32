//! `rayscope worksheet`: exercises about pixels of a scene, for pencil and paper.

use std::ffi::OsString;

use clap::{Args, ValueEnum};

use super::print::size;
use super::{Failure, Outcome, seed, whole, write_out};
use crate::explain::worksheet::{self, Part};
use crate::render::{CELL_ASPECT, Style, fit};
use crate::scene::{PixelShape, Rays, Scene, Size};
use crate::terminal::Capability;

/// Print exercises for pencil and paper about pixels of a scene, with answers on a separate page
#[derive(Debug, Args)]
pub(super) struct WorksheetArgs {
    /// A scene file, or the name of a built-in scene
    scene: OsString,

    /// Which pixels are drawn: the same seed gives the same sheet on every machine
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    seed: u64,

    /// How many exercises; fewer if the scene has too few different cases
    #[arg(long, value_name = "N", default_value_t = 8, allow_negative_numbers = true, value_parser = whole(1_u16, 100))]
    count: u16,

    /// Width and height in pixels of the picture that the exercises are about [default: the scene's own, or
    /// 40x40]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,

    /// How the sheet is written
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t)]
    format: SheetFormat,

    /// Only one of the two parts [default: both, the answers on a page of their own]
    #[arg(long, value_name = "PART", value_enum)]
    only: Option<Only>,
}

/// How a worksheet is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum SheetFormat {
    /// To be printed as it is; a form feed begins a new page
    #[default]
    Text,
    /// To be worked on with other programs
    Markdown,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Only {
    /// What the students get
    Exercises,
    /// The answers
    Key,
}

/// The picture of a scene that fixes none.
const SIZE: Size = Size::new(40, 40);

/// Writes the worksheet, or why there is none.
pub(super) fn run(arguments: &WorksheetArgs) -> Outcome {
    let glyphs = Capability::of_output().glyphs;
    let text = text(arguments).map_err(Failure::invalid)?;
    write_out(&glyphs.spell(&text))
}

fn text(arguments: &WorksheetArgs) -> Result<String, String> {
    let WorksheetArgs { seed, count, .. } = *arguments;
    let (scene, _) = Scene::open(&arguments.scene).map_err(|e| e.to_string())?;
    let name = arguments.scene.to_string_lossy();
    if scene.bodies.is_empty() {
        return Err(format!(
            "{name}: the scene has no spheres; expected one to ask about"
        ));
    }
    let rays = rays(&scene, arguments.size);
    let see = command(&name, &scene, rays.size);
    let sheet = worksheet::Worksheet::new(&scene, &rays, seed, count.into(), see);
    if sheet.count() == 0 {
        return Err(format!(
            "{name}: no pixel of it has numbers that can be worked by hand; try another --size"
        ));
    }
    let write = |part| match arguments.format {
        SheetFormat::Text => sheet.text(part),
        SheetFormat::Markdown => sheet.markdown(part),
    };
    Ok(match arguments.only {
        Some(Only::Exercises) => write(Part::Exercises),
        Some(Only::Key) => write(Part::Key),
        None => {
            let new_page = match arguments.format {
                SheetFormat::Text => "\u{c}",
                SheetFormat::Markdown => "\n<div style=\"page-break-after: always\"></div>\n\n",
            };
            write(Part::Exercises) + new_page + &write(Part::Key)
        }
    })
}

/// The command that works out a pixel of that picture.
fn command(name: &str, scene: &Scene, size: Size) -> String {
    let picture = if scene.pixels == Some(size) {
        String::new()
    } else {
        format!(" --style half --size {}x{}", size.width, size.height)
    };
    format!("rayscope print {name}{picture} --pixel X,Y --steps")
}

/// The rays of the picture that is asked for, of the scene's own, or of one with square pixels.
fn rays(scene: &Scene, asked: Option<Size>) -> Rays {
    let (own, shape) = fit(scene, Style::Half, SIZE.width, SIZE.height / 2, CELL_ASPECT);
    match asked {
        Some(asked) if asked != own => Rays::new(&scene.camera, asked, PixelShape::Aspect(1.0)),
        _ => Rays::new(&scene.camera, own, shape),
    }
}
