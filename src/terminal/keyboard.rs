//! From the bytes that a terminal sends to the events that the explorer knows.
//!
//! crossterm keeps its own parser to itself and to its own reading of the terminal, which spins
//! once that is closed. A parser of what *programs* write would not do either: to it `ESC ]` starts
//! a string and swallows the keys that follow, where here it is the escape key and a bracket.

use std::collections::VecDeque;
use std::str;

use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};

const ESC: u8 = 0x1b;
/// The longest escape sequence that a key or a mouse has, with room to spare.
const LONGEST_SEQUENCE: usize = 32;
/// What is kept of a paste; the prompts that it can go to hold less.
const LONGEST_PASTE: usize = 1 << 14;
const PASTE_END: &[u8] = b"\x1b[201~";

/// What a terminal had to say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Heard {
    /// A key, the mouse, a paste.
    Event(Event),
    /// The answer to a status query: all that was written before it has been dealt with.
    Ready,
}

/// Turns bytes into events, however they are cut into reads.
#[derive(Debug, Default)]
pub struct Keyboard {
    /// The beginning of a sequence whose end has not come.
    pending: Vec<u8>,
    /// A paste whose end has not come.
    paste: Option<Vec<u8>>,
}

/// What the first bytes of the input are.
enum Step {
    /// So many bytes, and what they say, if it is anything of use.
    Took(usize, Option<Heard>),
    /// The beginning of a paste, so many bytes long.
    Paste(usize),
    /// Not to be told before more has come.
    More,
}

impl Keyboard {
    /// Takes bytes in and appends what they say.
    pub fn feed(&mut self, bytes: &[u8], heard: &mut VecDeque<Heard>) {
        self.pending.extend_from_slice(bytes);
        let mut rest = std::mem::take(&mut self.pending);
        let mut at = 0;
        while at < rest.len() {
            let taken = match &mut self.paste {
                Some(_) => self.feed_paste(&rest[at..], heard),
                None => match step(&rest[at..]) {
                    Step::Took(n, what) => {
                        heard.extend(what);
                        n
                    }
                    Step::Paste(n) => {
                        self.paste = Some(Vec::new());
                        n
                    }
                    Step::More => break,
                },
            };
            if taken == 0 {
                break;
            }
            at += taken;
        }
        rest.drain(..at);
        self.pending = rest;
    }

    /// Whether something has begun that more input may complete.
    pub fn is_waiting(&self) -> bool {
        self.paste.is_some() || !self.pending.is_empty()
    }

    /// Takes what has begun as it stands, since nothing more has come: a lone escape is that key.
    pub fn settle(&mut self, heard: &mut VecDeque<Heard>) {
        if let Some(text) = self.paste.take() {
            heard.push_back(pasted(&text));
        }
        let pending = std::mem::take(&mut self.pending);
        let mut rest = pending.as_slice();
        if rest.first() == Some(&ESC) {
            heard.push_back(key(KeyCode::Esc, KeyModifiers::NONE));
            rest = &rest[1..];
        }
        // A sequence that was cut off says nothing; `[` and `O` were keys of their own.
        if let [only @ (b'[' | b'O')] = rest {
            heard.push_back(key(KeyCode::Char(char::from(*only)), KeyModifiers::NONE));
        }
    }

    /// Takes the next part of a paste; how many bytes.
    fn feed_paste(&mut self, bytes: &[u8], heard: &mut VecDeque<Heard>) -> usize {
        let Some(text) = &mut self.paste else {
            return 0;
        };
        let end = bytes.windows(PASTE_END.len()).position(|w| w == PASTE_END);
        // The last bytes may be the first of the end.
        let open = (0..PASTE_END.len())
            .rev()
            .find(|&n| bytes.ends_with(&PASTE_END[..n]))
            .unwrap_or(0);
        let length = end.unwrap_or(bytes.len() - open);
        let room = LONGEST_PASTE.saturating_sub(text.len());
        text.extend_from_slice(&bytes[..length.min(room)]);
        if end.is_none() {
            return length;
        }
        heard.push_back(pasted(text));
        self.paste = None;
        length + PASTE_END.len()
    }
}

fn pasted(text: &[u8]) -> Heard {
    Heard::Event(Event::Paste(String::from_utf8_lossy(text).into_owned()))
}

fn key(code: KeyCode, modifiers: KeyModifiers) -> Heard {
    Heard::Event(Event::Key(KeyEvent::new(code, modifiers)))
}

fn step(bytes: &[u8]) -> Step {
    match bytes {
        [ESC] | [ESC, b'O'] => Step::More,
        [ESC, b'[', ..] => control_sequence(bytes),
        [ESC, b'O', last, ..] => match keypad_key(*last) {
            Some(code) => Step::Took(3, Some(key(code, KeyModifiers::NONE))),
            None => Step::Took(1, Some(key(KeyCode::Esc, KeyModifiers::NONE))),
        },
        // Escape and a key at once: two keys that a network has brought together, or one with Alt,
        // which nothing here needs.
        [ESC, ..] => Step::Took(1, Some(key(KeyCode::Esc, KeyModifiers::NONE))),
        _ => match character(bytes) {
            Some((n, found)) => Step::Took(n, found.map(|(code, modifiers)| key(code, modifiers))),
            None => Step::More,
        },
    }
}

/// A key without an escape sequence: how many bytes, and which; none if more bytes belong to it.
fn character(bytes: &[u8]) -> Option<(usize, Option<(KeyCode, KeyModifiers)>)> {
    let first = *bytes.first()?;
    let plain = |code| Some((1, Some((code, KeyModifiers::NONE))));
    let control = |c: u8| Some((1, Some((KeyCode::Char(c.into()), KeyModifiers::CONTROL))));
    match first {
        b'\r' => plain(KeyCode::Enter),
        b'\t' => plain(KeyCode::Tab),
        // Which of the two the backspace key sends is a matter of the terminal.
        0x08 | 0x7f => plain(KeyCode::Backspace),
        0 => control(b' '),
        0x01..=0x1a => control(first - 1 + b'a'),
        0x1b => plain(KeyCode::Esc),
        0x1c..=0x1f => control(first - 0x1c + b'4'),
        _ => {
            let length = match first {
                ..0x80 => 1,
                0xc2..=0xdf => 2,
                0xe0..=0xef => 3,
                0xf0..=0xf4 => 4,
                _ => return Some((1, None)),
            };
            let Some(whole) = bytes.get(..length) else {
                // Incomplete, unless what is there can't become a character any more.
                let broken = str::from_utf8(bytes).is_err_and(|e| e.error_len().is_some());
                return broken.then_some((1, None));
            };
            match str::from_utf8(whole).ok().and_then(|s| s.chars().next()) {
                Some(c) => Some((length, Some((KeyCode::Char(c), KeyModifiers::NONE)))),
                None => Some((1, None)),
            }
        }
    }
}

/// `ESC [`, parameters, a final byte.
fn control_sequence(bytes: &[u8]) -> Step {
    // The Linux console's F1 to F5.
    if let [_, _, b'[', last, ..] = bytes {
        let number = last.wrapping_sub(b'A');
        let code = (number < 5).then(|| key(KeyCode::F(number + 1), KeyModifiers::NONE));
        return Step::Took(4, code);
    }
    if matches!(bytes, [_, _, b'[']) {
        return Step::More;
    }
    let body = &bytes[2..];
    let mut start = body.iter().take(LONGEST_SEQUENCE);
    let Some(end) = start.position(|b| !(0x20..0x40).contains(b)) else {
        return if body.len() < LONGEST_SEQUENCE {
            Step::More
        } else {
            Step::Took(2 + LONGEST_SEQUENCE, None)
        };
    };
    let (parameters, last) = (&body[..end], body[end]);
    if !(0x40..0x7f).contains(&last) {
        // Broken off by a byte that has no place in it, which is looked at anew.
        return Step::Took(2 + end, None);
    }
    let length = 2 + end + 1;
    if let Some(report) = parameters.strip_prefix(b"<") {
        return Step::Took(length, mouse(report, last));
    }
    let numbers = numbers(parameters);
    let first = numbers.first().copied().flatten();
    match (last, first) {
        (b'~', Some(200)) => Step::Paste(length),
        (b'n', Some(0 | 3)) => Step::Took(length, Some(Heard::Ready)),
        _ => {
            let modifiers = modifiers(numbers.get(1).copied().flatten());
            let code = match last {
                b'~' => first.and_then(numbered_key),
                b'u' => first
                    .and_then(|n| char::from_u32(n.into()))
                    .and_then(code_of),
                b'Z' => Some(KeyCode::BackTab),
                _ => keypad_key(last),
            };
            Step::Took(length, code.map(|code| key(code, modifiers)))
        }
    }
}

fn numbers(parameters: &[u8]) -> Vec<Option<u16>> {
    parameters
        .split(|&b| b == b';')
        .map(|n| str::from_utf8(n).ok()?.parse().ok())
        .collect()
}

/// xterm's way to say what was held down: 1, and a bit for each.
fn modifiers(parameter: Option<u16>) -> KeyModifiers {
    let bits = parameter.unwrap_or(1).saturating_sub(1);
    let mut modifiers = KeyModifiers::NONE;
    modifiers.set(KeyModifiers::SHIFT, bits & 1 != 0);
    modifiers.set(KeyModifiers::ALT, bits & 2 != 0);
    modifiers.set(KeyModifiers::CONTROL, bits & 4 != 0);
    modifiers
}

/// The keys that `ESC [` and `ESC O` share.
const fn keypad_key(last: u8) -> Option<KeyCode> {
    Some(match last {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        b'H' => KeyCode::Home,
        b'F' => KeyCode::End,
        b'M' => KeyCode::Enter,
        b'P'..=b'S' => KeyCode::F(last - b'P' + 1),
        _ => return None,
    })
}

const fn numbered_key(number: u16) -> Option<KeyCode> {
    Some(match number {
        1 | 7 => KeyCode::Home,
        2 => KeyCode::Insert,
        3 => KeyCode::Delete,
        4 | 8 => KeyCode::End,
        5 => KeyCode::PageUp,
        6 => KeyCode::PageDown,
        11..=15 => KeyCode::F(number as u8 - 10),
        17..=21 => KeyCode::F(number as u8 - 11),
        23 | 24 => KeyCode::F(number as u8 - 12),
        _ => return None,
    })
}

/// The key of a character that was sent as its number.
fn code_of(c: char) -> Option<KeyCode> {
    let mut bytes = [0; 4];
    let (_, found) = character(c.encode_utf8(&mut bytes).as_bytes())?;
    found.map(|(code, _)| code)
}

/// A press, a release or a turn of the wheel: `button ; column ; row`, and M or m.
fn mouse(report: &[u8], last: u8) -> Option<Heard> {
    let numbers = numbers(report);
    let [Some(button), Some(column @ 1..), Some(row @ 1..)] = numbers[..] else {
        return None;
    };
    let which = match button & 3 {
        0 => MouseButton::Left,
        1 => MouseButton::Middle,
        _ => MouseButton::Right,
    };
    let kind = match (button & !0b1_1100, last) {
        (64, b'M') => MouseEventKind::ScrollUp,
        (65, b'M') => MouseEventKind::ScrollDown,
        (0..=2, b'M') => MouseEventKind::Down(which),
        (0..=2, b'm') => MouseEventKind::Up(which),
        _ => return None,
    };
    Some(Heard::Event(Event::Mouse(MouseEvent {
        kind,
        column: column - 1,
        row: row - 1,
        modifiers: KeyModifiers::NONE,
    })))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn heard(chunks: &[&[u8]]) -> Vec<Heard> {
        let mut keyboard = Keyboard::default();
        let mut heard = VecDeque::new();
        for chunk in chunks {
            keyboard.feed(chunk, &mut heard);
        }
        keyboard.settle(&mut heard);
        heard.into()
    }

    fn plain(code: KeyCode) -> Heard {
        key(code, KeyModifiers::NONE)
    }

    fn typed(text: &str) -> Vec<Heard> {
        text.chars().map(|c| plain(KeyCode::Char(c))).collect()
    }

    #[test]
    fn keys_are_told_apart() {
        use KeyCode::{
            BackTab, Backspace, Char, Delete, End, Enter, Esc, F, Home, Left, PageUp, Tab, Up,
        };
        let none = KeyModifiers::NONE;
        let cases: &[(&[u8], KeyCode, KeyModifiers)] = &[
            (b"a", Char('a'), none),
            ("Δ".as_bytes(), Char('Δ'), none),
            (b"\r", Enter, none),
            (b"\t", Tab, none),
            (b"\x7f", Backspace, none),
            (b"\x08", Backspace, none),
            (b"\x03", Char('c'), KeyModifiers::CONTROL),
            (b"\x1a", Char('z'), KeyModifiers::CONTROL),
            (b"\x1b", Esc, none),
            (b"\x1b[A", Up, none),
            (b"\x1bOA", Up, none),
            (b"\x1b[1;2D", Left, KeyModifiers::SHIFT),
            (
                b"\x1b[1;6D",
                Left,
                KeyModifiers::SHIFT | KeyModifiers::CONTROL,
            ),
            (b"\x1b[Z", BackTab, none),
            (b"\x1b[3~", Delete, none),
            (b"\x1b[5~", PageUp, none),
            (b"\x1b[1~", Home, none),
            (b"\x1b[7~", Home, none),
            (b"\x1bOF", End, none),
            (b"\x1bOP", F(1), none),
            (b"\x1b[[A", F(1), none),
            (b"\x1b[11~", F(1), none),
            (b"\x1b[24~", F(12), none),
            (b"\x1b[97;5u", Char('a'), KeyModifiers::CONTROL),
        ];
        for (bytes, code, modifiers) in cases {
            assert_eq!(heard(&[bytes]), [key(*code, *modifiers)], "{bytes:?}");
        }
    }

    #[test]
    fn a_string_that_a_program_would_start_swallows_no_keys() {
        assert_eq!(heard(&[b"\x1b]", b"abc"])[1..], typed("]abc"));
        assert_eq!(heard(&[b"\x1b\x1b", b"Oq"])[2..], typed("Oq"));
    }

    #[test]
    fn an_answer_is_no_key() {
        let answer = heard(&[b"\x1b[0nq"]);
        assert_eq!(answer, [Heard::Ready, plain(KeyCode::Char('q'))]);
    }

    #[test]
    fn what_is_pasted_is_text_whatever_it_holds() {
        let paste = heard(&[b"\x1b[200~q\x1b[Ax\r\x03\x1b[201~q"]);
        let text = Event::Paste("q\x1b[Ax\r\x03".into());
        assert_eq!(paste, [Heard::Event(text), plain(KeyCode::Char('q'))]);
    }

    #[test]
    fn a_paste_that_never_ends_gives_the_keys_back_once_nothing_comes() {
        let mut keyboard = Keyboard::default();
        let mut heard = VecDeque::new();
        for _ in 0..100 {
            keyboard.feed(&[b'x'; 1000], &mut heard);
            keyboard.feed(b"\x1b[200~", &mut heard);
            heard.clear();
        }
        assert!(keyboard.is_waiting());
        keyboard.settle(&mut heard);
        let Some(Heard::Event(Event::Paste(text))) = heard.pop_front() else {
            panic!("no paste");
        };
        assert_eq!(text.len(), LONGEST_PASTE);
        keyboard.feed(b"q", &mut heard);
        assert_eq!(heard, [plain(KeyCode::Char('q'))]);
    }

    #[test]
    fn the_mouse_is_heard() {
        let report = |kind, column, row| {
            Heard::Event(Event::Mouse(MouseEvent {
                kind,
                column,
                row,
                modifiers: KeyModifiers::NONE,
            }))
        };
        assert_eq!(
            heard(&[
                b"\x1b[<0;10;5M\x1b[<0;10;5m\x1b[<64;1;1M\x1b[<65;300;2M\x1b[<35;1;1M\x1b[<0;0;1M"
            ]),
            [
                report(MouseEventKind::Down(MouseButton::Left), 9, 4),
                report(MouseEventKind::Up(MouseButton::Left), 9, 4),
                report(MouseEventKind::ScrollUp, 0, 0),
                report(MouseEventKind::ScrollDown, 299, 1),
            ]
        );
    }

    #[test]
    fn bytes_that_mean_nothing_leave_the_keys_after_them() {
        for noise in [
            b"\x1b[".as_slice(),
            b"\x1b[12",
            b"\x1b[\xff",
            b"\x1b[<1;2",
            b"\xff\xfe",
            b"\xe2\x82",
            b"\x1b[I",
            b"\x1b[99~",
            b"\x1bOz",
        ] {
            let mut keyboard = Keyboard::default();
            let mut heard = VecDeque::new();
            keyboard.feed(noise, &mut heard);
            keyboard.settle(&mut heard);
            keyboard.feed(b"q", &mut heard);
            assert_eq!(
                heard.pop_back(),
                Some(plain(KeyCode::Char('q'))),
                "{noise:?}"
            );
        }
    }

    proptest! {
        #[test]
        fn it_does_not_matter_how_the_bytes_are_cut(
            parts in prop::collection::vec(
                prop_oneof![
                    Just(b"\x1b[A".to_vec()),
                    Just(b"\x1b[1;2D".to_vec()),
                    Just(b"\x1bOP".to_vec()),
                    Just(b"\x1b[0n".to_vec()),
                    Just(b"\x1b[<0;3;4M".to_vec()),
                    Just(b"\x1b[200~x\x1b[2y\x1b[201~".to_vec()),
                    Just("Δ√".as_bytes().to_vec()),
                    prop::collection::vec(any::<u8>(), 0..4),
                ],
                0..20,
            ),
            cut in 1usize..7,
        ) {
            let bytes = parts.concat();
            let whole = heard(&[&bytes]);
            let chunks: Vec<&[u8]> = bytes.chunks(cut).collect();
            prop_assert_eq!(heard(&chunks), whole);
        }
    }
}
