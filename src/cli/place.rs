//! Flags that say where in a scene the explorer opens: what a passed-on view consists of.

use clap::Args;

use super::print::{pixel, size};
use super::{choice, finite, from_one};
use crate::explorer::{Opening, Panel};
use crate::method::Method;
use crate::scene::Size;

/// Where in the scene to open.
#[derive(Debug, Args)]
#[command(next_help_heading = "Where to open")]
pub(super) struct Place {
    /// The pixel under the cursor
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
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
    #[arg(long = "t", value_name = "T", allow_hyphen_values = true, value_parser = finite)]
    t: Option<f64>,

    /// The method beside the chosen one
    #[arg(long, value_name = "METHOD", value_parser = choice(&Method::ALL, Method::name))]
    compare: Option<Method>,

    /// The sphere that is selected, from 1
    #[arg(long, value_name = "N", value_parser = from_one, allow_negative_numbers = true)]
    sphere: Option<usize>,

    /// The sphere that the panel shows, of those on the line under the cursor
    #[arg(long, value_name = "N", value_parser = from_one, allow_negative_numbers = true)]
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
            t: self.t,
            compare: self.compare,
            ..Opening::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::process;

    use clap::Parser;
    use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};

    use super::super::{Arguments, Command, Failure, explore, tour};
    use crate::explain::{Digits, lines, plain_text};
    use crate::explorer::{Explorer, Options, command_line};
    use crate::text::Glyphs;

    /// Opens what a command line asks for, on a screen of 80 by 24.
    fn open(words: &[String]) -> Result<Explorer, Failure> {
        let all = [&["rayscope".to_owned()], words].concat();
        let arguments = Arguments::try_parse_from(all).map_err(Failure::misused)?;
        let mut explorer = match arguments.command {
            None => explore::opened(&arguments.explore, Ok)?.0,
            Some(Command::Tour(arguments)) => tour::opened(&arguments, Ok)?,
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
            explorer.reading().unwrap(),
            80,
            Digits::Full,
            Glyphs::Unicode,
        );
        let scene = explorer.scene().to_toml();
        let Options {
            method,
            style,
            view,
            aspect,
            ..
        } = explorer.options();
        let looks = format!("{method} {style:?} {view:?} {aspect}");
        format!("{}{looks}\n{scene}", plain_text(&lines))
    }

    #[test]
    fn the_command_for_a_view_opens_the_same_view() {
        for (line, keys) in [
            ("tutorial", ""),
            ("tutorial --method textbook", "llljj⏎⏎⏎⏎⏎⏎⏎"),
            ("trio", "naaaWWee"),
            ("trio --style ascii", "n  x+"),
            ("trio --aspect 1.7", "jjjjG:set up.x 0.25⏎"),
            ("far --method haines", "nn6CC"),
            ("behind", "n:sphere 3⏎vv"),
            ("inside", "3((("),
            ("planet", "N:step C⏎"),
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
        for keys in ["o", "ui", "uU:sphere 2⏎x"] {
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
                "trio --set radius=nan",
                "--set radius=nan: radius is “nan”: expected a finite number",
            ),
            (
                "tutorial --step 99",
                "--step: found “99”, expected a step's name or 1 to 23",
            ),
            (
                "tour 4 --step none",
                "--step: found “none”, expected a step's name or 1 to 23",
            ),
            ("tour 1 --page 9", "--page 9: expected a page from 1 to 4"),
        ] {
            assert_eq!(said(line), Failure::misused(sentence));
        }
        for (line, part) in [
            ("tutorial --size 9x9", "--cursor"),
            ("tutorial --t nan", "--t"),
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
