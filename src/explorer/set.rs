//! Gives the settings of a view their values: by a command, or where the explorer opens.

use crate::explorer::arrival::Target;
use crate::explorer::edit::document::Document;
use crate::explorer::edit::field;
use crate::explorer::edit::spheres;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::show;
use crate::explorer::setting::Setting;
use crate::explorer::state::State;
use crate::explorer::{cursor, look, routines, walk};
use crate::method::Method;
use crate::scene::{Scene, Size};

/// Gives one setting its value, as a command does; says why not if it can't have it.
pub(crate) fn set(state: &mut State, setting: Setting) {
    match setting {
        Setting::Routine { name, beside } => match routines::open(state, &name) {
            Ok(method) if beside => set(state, Setting::Compare(method)),
            Ok(method) => set(state, Setting::Method(method)),
            Err(sentence) => state.warn(sentence),
        },
        Setting::Method(method) => look::set_method(state, method),
        Setting::Lens(lens) => look::set_lens(state, lens),
        Setting::Style(style) => look::set_style(state, style),
        Setting::View(view) => look::set_view(state, view),
        Setting::Theme(palette) => look::set_palette(state, palette),
        Setting::Color(depth) => look::set_depth(state, depth),
        Setting::Aspect(ratio) => look::set_aspect(state, ratio),
        Setting::Cursor(x, y) => cursor::go_to(state, x, y),
        Setting::Panel(panel) => show(state, panel),
        Setting::Step(name) => walk::go_to_step_named(state, &name),
        Setting::Compare(method) => match check_other(method, state.at.method) {
            Ok(()) => {
                state.at.compare = Some(method);
                state.at.panel = Panel::Compare;
            }
            Err(expected) => state.warn(format!("compare: found {method}, {expected}")),
        },
        Setting::Sphere(n) => match in_scene(state.scene(), n) {
            Ok(at) => spheres::select(state, at),
            Err(expected) => state.warn(format!("sphere: found {n}, {expected}")),
        },
        Setting::Set(field, value) => match field.set(state.scene(), state.at.sphere, value) {
            Ok(change) => {
                state.apply(change);
            }
            Err(refused) => state.warn(refused.to_string()),
        },
        Setting::Stride(length) => spheres::set_stride(state, length),
        Setting::T(_) | Setting::Shown(_) | Setting::Size(_) => state.at.put(&setting),
    }
}

/// Goes to a place in the scene that has been opened, or says in a sentence what is wrong.
pub(crate) fn set_out(state: &mut State, settings: &[Setting]) -> Result<(), String> {
    let refuse =
        |flag: &str, value: String, expected: String| format!("--{flag} {value}: {expected}");
    let mut at = state.at;
    let mut numbers = Vec::new();
    let mut picture = state.scene().pixels;
    let mut wanted = None;
    for setting in settings {
        match *setting {
            Setting::Routine { ref name, beside } => {
                let method = routines::open(state, name)?;
                *(if beside {
                    at.compare.get_or_insert(method)
                } else {
                    &mut at.method
                }) = method;
            }
            Setting::Sphere(n) => {
                let found = in_scene(state.scene(), n);
                at.sphere = Some(found.map_err(|e| refuse("sphere", n.to_string(), e))?);
            }
            Setting::Shown(n) => {
                let found = in_scene(state.scene(), n);
                at.shown = Some(found.map_err(|e| refuse("shown", n.to_string(), e))?);
            }
            Setting::Set(field, value) => numbers.push((field, value)),
            Setting::Cursor(x, y) => wanted = Some((x, y)),
            Setting::Size(size) => picture = picture.or(Some(size)),
            Setting::Step(ref step) => state.arrival.step = Some(step.clone()),
            Setting::Aspect(ratio) => state.options.aspect = ratio,
            _ => at.put(setting),
        }
    }
    if let Some(method) = at.compare {
        check_other(method, at.method).map_err(|e| refuse("compare", method.to_string(), e))?;
    }
    let scene = field::set_all(state.scene(), at.sphere, &numbers);
    let scene = scene.map_err(|refused| format!("--set: {refused}"))?;
    if let Some((x, y)) = wanted {
        let target = target((x, y), scene.pixels.or(picture));
        let target = target.map_err(|e| refuse("cursor", format!("{x},{y}"), e))?;
        state.arrival.target = Some(target);
    }
    if scene != *state.scene() {
        state.work.document = Document::new(scene);
        state.picture.forget();
    }
    state.at = at;
    Ok(())
}

/// A method may be compared with another one only.
fn check_other(method: Method, chosen: Method) -> Result<(), String> {
    if method == chosen {
        return Err(format!(
            "expected another method than {chosen}, which is chosen"
        ));
    }
    Ok(())
}

/// The place of the sphere of that number, counted from 1.
fn in_scene(scene: &Scene, n: usize) -> Result<usize, String> {
    let count = scene.bodies.len();
    let at = n.checked_sub(1).filter(|&at| at < count);
    at.ok_or_else(|| format!("expected a sphere from 1 to {count}"))
}

/// The cursor's place, held to the picture in which it counts.
fn target((x, y): (u32, u32), picture: Option<Size>) -> Result<Target, String> {
    match picture {
        Some(size) if x >= size.width || y >= size.height => {
            Err(format!("expected a pixel of {size}, counted from 0,0"))
        }
        Some(size) => Ok(Target::PixelOf((x, y), size)),
        None => Ok(Target::Pixel(x, y)),
    }
}
