//! How the picture is asked for and drawn: method, view, style, colours.

use crate::explain::Lens;
use crate::explorer::action::Action;
use crate::explorer::draw::theme::Palette;
use crate::explorer::options::Request;
use crate::explorer::setting::Setting;
use crate::explorer::state::{State, turn};
use crate::method::Method;
use crate::render::{ColorDepth, Style, View};

/// Why something on the screen is as it is, where the person has said so.
const CHOSEN_HERE: &str = "chosen here";

/// Does an action that changes how the picture is asked for or drawn; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    match action {
        Action::NextMethod => turn_method(state, 1),
        Action::PreviousMethod => turn_method(state, state.methods().len() - 1),
        Action::OtherLens => set_lens(state, state.at.lens.other()),
        Action::NextView => turn_view(state, 1),
        Action::PreviousView => turn_view(state, View::ALL.len() - 1),
        Action::NextStyle => turn_style(state, 1),
        Action::PreviousStyle => turn_style(state, Style::ALL.len() - 1),
        Action::Precision => state.full_digits = !state.full_digits,
        Action::AspectTaller => set_aspect(state, state.options.aspect + 0.05),
        Action::AspectWider => set_aspect(state, state.options.aspect - 0.05),
        Action::NextTheme => set_palette(state, turn(&Palette::ALL, state.options.palette, 1)),
        Action::NextColor => set_depth(state, turn(&ColorDepth::ALL, state.options.depth, 1)),
        Action::ScrollDown => state.scroll += 5,
        Action::ScrollUp => state.scroll = state.scroll.saturating_sub(5),
        Action::Mouse => toggle_mouse(state),
        Action::Redraw => state.request = Some(Request::Redraw),
        _ => return false,
    }
    true
}

/// Takes the mouse, or leaves it to the terminal, which selects text with it.
fn toggle_mouse(state: &mut State) {
    state.mouse = !state.mouse;
    state.say(if state.mouse {
        "Mouse on: a click moves the cursor, the wheel zooms. {mouse} turns it off."
    } else {
        "Mouse off: it selects text again."
    });
}

fn turn_method(state: &mut State, by: usize) {
    set_method(state, turn(&state.methods(), state.at.method, by));
}

/// Chooses a method, and looks at what its arithmetic does.
pub(crate) const fn set_method(state: &mut State, method: Method) {
    (state.at.method, state.at.lens) = (method, Lens::Machine);
}

fn turn_view(state: &mut State, by: usize) {
    set_view(state, turn(&View::ALL, state.at.view, by));
}

fn turn_style(state: &mut State, by: usize) {
    set_style(state, turn(&Style::ALL, state.at.style, by));
}

pub(crate) fn set_style(state: &mut State, style: Style) {
    state.at.style = style;
    state.chosen.push(Setting::Style(style));
    say_legend(state);
}

pub(crate) fn set_lens(state: &mut State, lens: Lens) {
    state.at.lens = lens;
    state.chosen.push(Setting::Lens(lens));
}

pub(crate) fn set_view(state: &mut State, view: View) {
    state.at.view = view;
    say_legend(state);
}

/// Takes the colours for the ground that the terminal says it has; false if others were chosen.
pub(crate) fn set_ground(state: &mut State, is_light: bool) -> bool {
    let options = &mut state.options;
    if options.follows_ground {
        options.palette = if is_light {
            Palette::Light
        } else {
            Palette::Dark
        };
        options.reasons.palette = "the terminal says so";
    }
    options.follows_ground
}

pub(crate) fn set_palette(state: &mut State, palette: Palette) {
    state.options.palette = palette;
    state.chosen.push(Setting::Theme(palette));
    state.options.reasons.palette = CHOSEN_HERE;
    state.options.follows_ground = false;
    state.say(format!("Theme: {}, {}.", palette.name(), palette.words()));
}

pub(crate) fn set_depth(state: &mut State, depth: ColorDepth) {
    state.options.depth = depth;
    state.options.reasons.depth = CHOSEN_HERE;
    let unused = match state.options.palette {
        Palette::Monochrome => "; the theme monochrome uses none, {next-theme} changes it",
        _ => "",
    };
    state.say(format!("Colours: {}{unused}.", depth.words()));
}

fn say_legend(state: &mut State) {
    let (view, style) = (state.at.view, state.at.style);
    let shown = view.shown_in(style).name();
    state.say(format!("{shown}, {}: {}", style.name(), view.legend(style)));
}

pub(crate) fn set_aspect(state: &mut State, aspect: f64) {
    state.options.aspect = aspect.clamp(0.5, 4.0);
    state.say(format!(
        "Cells are taken to be {:.2} times as high as wide.",
        state.options.aspect
    ));
}
