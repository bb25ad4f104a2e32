//! Flags that say how and where in a scene the explorer opens: what a passed-on view consists of.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};

use super::method_name;
use crate::explorer::{SETTINGS, Setting, SettingRow};
use crate::method::Method;
use crate::text::former_names;

/// The settings that were given as flags, made from the table of settings; `TOUR`: on a page, which
/// has settings of its own.
#[derive(Debug, Default, Clone)]
pub(super) struct PlaceFlags<const TOUR: bool> {
    pub(super) settings: Vec<Setting>,
}

/// Flags that stand before those that say where: how the picture is drawn.
const HOW: [&str; 5] = ["method", "lens", "style", "view", "aspect"];

/// The flag of a setting, for a scene.
fn flag_of_scene(row: &'static SettingRow) -> Option<Arg> {
    let arg = flag(row, |help| match row.name {
        "style" => format!("{help} [default: half where there are colours, else ascii]"),
        "lens" => format!("{help} [default: mathematics]"),
        "aspect" => format!("{help} [default: 2]"),
        _ => help.to_owned(),
    })?;
    Some(match row.name {
        "method" => with_variable(arg, "RAYSCOPE_METHOD").default_value(Method::default().name()),
        "style" => with_variable(arg, "RAYSCOPE_STYLE"),
        _ => arg,
    })
}

/// The flag of a setting, for a page of the tour.
fn flag_of_page(row: &'static SettingRow) -> Option<Arg> {
    flag(row, |help| match row.name {
        "method" | "lens" | "style" | "view" => format!("{help} [default: as the page has it]"),
        "aspect" => format!("{help} [default: 2]"),
        _ => help.to_owned(),
    })
}

fn with_variable(arg: Arg, name: &'static str) -> Arg {
    arg.env(name).hide_env_values(true)
}

fn flag(row: &'static SettingRow, say: impl FnOnce(&str) -> String) -> Option<Arg> {
    let (value, help) = row.flag?;
    let names = (row.choices)();
    let parser = if ["method", "compare"].contains(&row.name) {
        ValueParser::new(method_name().try_map(|name| row.parse(&name.0)))
    } else if names.is_empty() || row.name == "set" {
        ValueParser::new(|text: &str| row.parse(text))
    } else {
        let values = names.into_iter().map(|name| {
            let former: Vec<_> = former_names(&name).collect();
            PossibleValue::new(name).aliases(former)
        });
        let names = PossibleValuesParser::new(values);
        ValueParser::new(names.try_map(|name| row.parse(&name)))
    };
    let arg = Arg::new(row.name)
        .long(row.name)
        .value_name(value)
        .help(say(help))
        .value_parser(parser)
        .allow_hyphen_values(["cursor", "t", "sphere", "shown"].contains(&row.name));
    Some(match row.name {
        "size" => arg.requires("cursor"),
        "set" => arg.action(ArgAction::Append),
        _ => arg,
    })
}

impl<const TOUR: bool> Args for PlaceFlags<TOUR> {
    fn augment_args(command: Command) -> Command {
        let is_how = |row: &&SettingRow| HOW.contains(&row.name);
        let flag = if TOUR { flag_of_page } else { flag_of_scene };
        let how = SETTINGS.iter().filter(is_how).filter_map(flag);
        let place = SETTINGS.iter().filter(|row| !is_how(row)).filter_map(flag);
        command
            .args(how.map(|arg| arg.help_heading(None::<&str>)))
            .args(place.map(|arg| arg.help_heading("Where to open")))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const TOUR: bool> FromArgMatches for PlaceFlags<TOUR> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |row: &SettingRow| matches.get_many::<Setting>(row.name);
        let flags = SETTINGS.iter().filter(|row| row.flag.is_some());
        let settings = flags.filter_map(given).flatten().cloned().collect();
        Ok(Self { settings })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::process;

    use clap::Parser;
    use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};

    use super::super::{Arguments, CliCommand, Failure, explore, tour};
    use crate::explain::{Digits, lines, plain_text};
    use crate::explorer::{Explorer, Viewpoint, command_line};

    /// Opens what a command line asks for, on a screen of 80 by 24.
    fn open(words: &[String]) -> Result<Explorer, Failure> {
        let all = [&["rayscope".to_owned()], words].concat();
        let arguments = Arguments::try_parse_from(all).map_err(Failure::misused)?;
        let mut explorer = match arguments.command {
            None => explore::opened(&arguments.explore, &[], Ok)?.0,
            Some(CliCommand::Tour(arguments)) => tour::opened(&arguments, Ok)?,
            Some(other) => panic!("{other:?} opens no explorer"),
        };
        explorer.prepare(80, 24);
        Ok(explorer)
    }

    fn opened(line: &str) -> Explorer {
        let words: Vec<_> = line.split_whitespace().map(str::to_owned).collect();
        open(&words).unwrap_or_else(|e| panic!("{line}: {}", e.sentence))
    }

    fn press(explorer: &mut Explorer, keys: &str) {
        for key in keys.chars() {
            let code = match key {
                '⏎' => KeyCode::Enter,
                key => KeyCode::Char(key),
            };
            explorer.update(&Event::Key(KeyEvent::new(code, KeyModifiers::NONE)));
            explorer.prepare(80, 24);
        }
    }

    /// What a person sees of an explorer, but for the message.
    fn seen(explorer: &Explorer) -> String {
        let lines = lines(
            explorer.viewpoint().lens,
            explorer.reading().unwrap(),
            80,
            Digits::Full,
            crate::text::Glyphs::Unicode,
        );
        let scene = explorer.scene().to_toml();
        let Viewpoint {
            method,
            lens,
            style,
            view,
            ..
        } = explorer.viewpoint();
        let aspect = explorer.options().aspect;
        let looks = format!("{method} {lens:?} {style:?} {view:?} {aspect}");
        format!("{}{looks}\n{scene}", plain_text(&lines))
    }

    #[test]
    fn the_command_for_a_view_opens_the_same_view() {
        for (line, keys) in [
            ("tutorial", ""),
            ("tutorial --method textbook", "llljj⏎⏎⏎⏎⏎⏎⏎"),
            ("trio", "NaaaWWee"),
            ("trio --style ascii", "Nnnx+"),
            ("trio --aspect 1.7", "jjjjG:set up.x 0.25⏎"),
            (
                "far --method haines",
                "NN6:next-comparison⏎:next-comparison⏎",
            ),
            ("behind", "N:sphere 3⏎vv"),
            ("inside", "3((("),
            ("planet", ":previous-place⏎:step C⏎"),
            ("tour a-b-c --page 2", "lllkkk,,"),
            ("tour 8 --page 1", "Vllx"),
            ("tour 1", "tddd"),
        ] {
            let mut before = opened(line);
            press(&mut before, keys);
            let words = before.link().unwrap();
            let after = open(&words).unwrap_or_else(|e| panic!("{words:?}: {}", e.sentence));
            assert_eq!(seen(&after), seen(&before), "{}", command_line(&words));
            assert_eq!(after.link(), Ok(words));
            assert_eq!(after.cursor(), before.cursor());
        }
    }

    #[test]
    fn a_change_that_no_command_carries_asks_to_be_saved() {
        let mut explorer = opened("trio");
        press(&mut explorer, "x");
        assert!(explorer.link().is_ok());
        press(&mut explorer, "\t");
        for keys in [":duplicate⏎", "ui", "uU:sphere 2⏎x"] {
            press(&mut explorer, keys);
            let said = explorer.link().unwrap_err();
            assert!(said.contains("save it"), "{keys}: {said}");
        }
    }

    #[test]
    fn a_file_of_any_name_is_passed_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("it's a $scene, mine.toml");
        std::fs::write(&path, opened("trio").scene().to_toml()).unwrap();
        let mut before = open(&[path.to_str().unwrap().to_owned()]).unwrap();
        press(&mut before, "lljjd");
        let line = command_line(&before.link().unwrap());
        let shell = process::Command::new("sh")
            .args(["-c", &line.replacen("rayscope", "printf '%s\\n'", 1)])
            .output()
            .unwrap();
        let words = String::from_utf8(shell.stdout).unwrap();
        let words: Vec<_> = words.lines().map(str::to_owned).collect();
        assert_eq!(seen(&open(&words).unwrap()), seen(&before));
    }

    #[test]
    fn a_place_that_is_none_is_refused_in_a_sentence() {
        let said = |line: &str| {
            let words: Vec<_> = line.split_whitespace().map(str::to_owned).collect();
            open(&words).err().unwrap()
        };
        for (line, sentence) in [
            (
                "tutorial --cursor 40,0",
                "--cursor 40,0: expected a pixel of 40×40, counted from 0,0",
            ),
            (
                "trio --cursor 9,9 --size 9x9",
                "--cursor 9,9: expected a pixel of 9×9, counted from 0,0",
            ),
            (
                "trio --sphere 4",
                "--sphere 4: expected a sphere from 1 to 3",
            ),
            (
                "trio --set radius=-1",
                "--set: radius is -1: expected a radius of zero or more",
            ),
            (
                "tutorial --step 99",
                "--step: found “99”, expected a step's name or 1 to 10",
            ),
            (
                "tour 4 --step none",
                "--step: found “none”, expected a step's name or 1 to 10",
            ),
            ("tour 1 --page 9", "--page 9: expected a page from 1 to 4"),
        ] {
            assert_eq!(said(line), Failure::misused(sentence));
        }
        for (line, part) in [
            ("tutorial --size 9x9", "--cursor"),
            ("tutorial --t nan", "--t"),
            (
                "trio --set radius=nan",
                "radius is “nan”: expected a finite number",
            ),
            ("tutorial --t 0x1.8q", "0x1.8q"),
            ("trio --set size=1", "expected one of center.x, center.y"),
        ] {
            let Failure { status, sentence } = said(line);
            assert_eq!(status, 2);
            assert!(sentence.contains(part), "{sentence}");
        }
    }

    #[test]
    fn a_step_that_a_link_from_another_screen_lacks_does_not_keep_it_shut() {
        opened("trio --cursor 0,0 --size 9x9 --panel steps --step 99");
    }
}
