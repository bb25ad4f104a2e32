//! What a person chose for all scenes and finds again at the next start: theme, style and lens.

use std::fs;

use crate::door::Expected;
use crate::explorer::files::disk::{self, Over};
use crate::explorer::files::workplace::Workplace;
use crate::explorer::setting::{self, Setting, SettingRow};

/// The settings that are remembered.
const NAMES: [&str; 3] = ["theme", "style", "lens"];

const SETTINGS_FILE: Expected = Expected {
    what: "a file of settings",
    most: 4096,
};

/// What was chosen at an earlier start; a file that can't be read is as good as none.
pub fn remembered(workplace: &Workplace) -> Vec<Setting> {
    let path = workplace.settings_file();
    let text = path.and_then(|path| SETTINGS_FILE.text(&path).ok());
    let text = text.unwrap_or_default();
    let lines = text.lines().filter_map(|line| line.split_once(' '));
    lines
        .filter(|(name, _)| NAMES.contains(name))
        .filter_map(|(name, value)| setting::parse(SettingRow::by_name(name)?, value).ok())
        .collect()
}

/// Writes down what was chosen, beside what is there.
pub(crate) fn remember(workplace: &Workplace, chosen: &[Setting]) {
    let Some(path) = workplace.settings_file().filter(|_| !chosen.is_empty()) else {
        return;
    };
    let mut all = remembered(workplace);
    all.extend_from_slice(chosen);
    let last = |name| {
        all.iter()
            .filter_map(line)
            .rfind(|(other, _)| *other == name)
    };
    let lines = NAMES.into_iter().filter_map(last);
    let lines: Vec<String> = lines
        .map(|(name, value)| format!("{name} {value}\n"))
        .collect();
    let text = lines.concat();
    // If it cannot be remembered, the person chooses again: nothing is lost.
    if let Some(folder) = path.parent() {
        let _ = fs::create_dir_all(folder);
    }
    let _ = disk::save(&path, &text, Over::Anything);
}

/// The name and the value of a setting that is remembered.
fn line(setting: &Setting) -> Option<(&'static str, &'static str)> {
    match setting {
        Setting::Theme(palette) => Some(("theme", palette.name())),
        Setting::Style(style) => Some(("style", style.name())),
        Setting::Lens(lens) => Some(("lens", lens.name())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explorer::draw::theme::Palette;
    use crate::render::Style;

    #[test]
    fn what_was_chosen_last_is_remembered_and_nonsense_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let place = Workplace::keeping_in(&folder.path().join("state"));
        assert_eq!(remembered(&place), []);
        let [dark, light] = [Palette::Dark, Palette::Light].map(Setting::Theme);
        let [ascii, half] = [Style::Ascii, Style::Half].map(Setting::Style);
        remember(&place, &[ascii.clone(), dark, half.clone()]);
        remember(&place, std::slice::from_ref(&light));
        assert_eq!(remembered(&place), [light, half]);
        fs::write(
            place.settings_file().unwrap(),
            "style none\nmethod double\n\u{7}",
        )
        .unwrap();
        assert_eq!(remembered(&place), []);
        remember(&Workplace::default(), &[ascii]);
    }
}
