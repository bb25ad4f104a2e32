//! From the bytes that a terminal sends to the events that the explorer knows.
//!
//! Why it is written by hand: crossterm keeps its parser to itself and to its own reading of the
//! terminal, which spins once that is closed. The parser of `termina` 0.4 can be had, but drops the
//! status answer `CSI 0 n` that paces our frames, holds what has begun without an end (`ESC [` and
//! nothing more swallows the keys after it), has no bound for a paste, and takes APC, PM and SOS for
//! a key with Alt and more keys. A parser of what *programs* write (`vte`) would not do either: to it
//! `ESC ]` starts a string in any case, where here it may be the escape key and a bracket.

use std::collections::VecDeque;
use std::str;
use std::time::Duration;

use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};

const ESC: u8 = 0x1b;
const BEL: u8 = 0x07;
const CAN: u8 = 0x18;
const SUB: u8 = 0x1a;

/// What is kept of a sequence or of a string; the rest is passed over.
const LONGEST_SEQUENCE: usize = 256;
/// A string without an end that is no longer was typed: the escape key and some others.
const LONGEST_TYPED: usize = 8;
/// What is kept of a paste; the prompts that it can go to hold less.
const LONGEST_PASTE: usize = 1 << 14;
/// A paste of more bytes has lost its end.
const ENDLESS_PASTE: usize = 1 << 24;
const PASTE_END: &[u8] = b"\x1b[201~";

/// How long the rest of an escape may take: no longer than a person minds who presses that key.
const ESCAPE_PATIENCE: Duration = Duration::from_millis(50);
/// How long the rest of a sequence or a string may take, on a bad network too.
const SEQUENCE_PATIENCE: Duration = Duration::from_millis(500);
/// How long a paste may pause.
const PASTE_PATIENCE: Duration = Duration::from_secs(5);

/// What a terminal had to say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TerminalMessage {
    /// A key, the mouse, a paste.
    Event(Event),
    /// The answer to a status query: all that was written before it has been dealt with.
    Ready,
    /// What the ground is.
    Ground {
        /// Rather than dark.
        is_light: bool,
    },
}

/// Turns bytes into events, however they are cut into reads.
#[derive(Debug, Default)]
pub struct Keyboard {
    /// The beginning of a sequence whose end has not come.
    pending: Vec<u8>,
    /// What is under way that has its own end.
    open: Option<Open>,
    /// An escape was taken for the key: an answer to a query may have lost its beginning.
    took_escape: bool,
    /// A string was given up: its end may still come.
    lost_string: bool,
}

/// What goes on until its end, over any number of bytes.
#[derive(Debug)]
enum Open {
    /// A paste: what is kept of it, and how long it is.
    Paste(Vec<u8>, usize),
    /// An OSC, DCS, APC, PM or SOS string: its beginning, and how long it is.
    String(Vec<u8>, usize),
    /// A control sequence that is too long to mean anything.
    Overlong,
}

/// What the first bytes of the input are.
enum Parsed {
    /// So many bytes, and what they say, if it is anything of use.
    Took(usize, Option<TerminalMessage>),
    /// So many bytes, with which something begins.
    Opens(usize, Open),
    /// Not to be told before more has come.
    More,
}

impl Keyboard {
    /// Takes bytes in and appends what they say.
    pub fn feed(&mut self, bytes: &[u8], messages: &mut VecDeque<TerminalMessage>) {
        let mut at = 0;
        if std::mem::take(&mut self.took_escape) && bytes.starts_with(b"[0n") {
            messages.push_back(TerminalMessage::Ready);
            at = 3;
        }
        self.pending.extend_from_slice(&bytes[at..]);
        let rest = std::mem::take(&mut self.pending);
        at = 0;
        while at < rest.len() {
            let was_open = self.open.is_some();
            let taken = match self.open.take() {
                // The end of a string that was given up.
                None if self.lost_string && rest[at..].starts_with(b"\x1b\\") => 2,
                Some(open) => self.go_on(open, &rest[at..], messages),
                None => match step(&rest[at..]) {
                    Parsed::Took(n, what) => {
                        messages.extend(what);
                        n
                    }
                    Parsed::Opens(n, open) => {
                        self.open = Some(open);
                        n
                    }
                    Parsed::More => 0,
                },
            };
            at += taken;
            if taken == 0 && self.open.is_some() == was_open {
                break;
            }
            self.lost_string = false;
        }
        self.pending = rest[at..].to_vec();
    }

    /// How long to wait for the rest of what has begun; nothing if nothing has.
    pub fn patience(&self) -> Option<Duration> {
        match (&self.open, self.pending.as_slice()) {
            (Some(Open::Paste(..)), _) => Some(PASTE_PATIENCE),
            (None, []) => None,
            (None, [ESC] | [ESC, b'O']) => Some(ESCAPE_PATIENCE),
            _ => Some(SEQUENCE_PATIENCE),
        }
    }

    /// Gives up waiting for the rest of what has begun: a lone escape is that key.
    pub fn give_up(&mut self, messages: &mut VecDeque<TerminalMessage>) {
        let pending = std::mem::take(&mut self.pending);
        let rest = match self.open.take() {
            Some(Open::Paste(text, _)) => return messages.push_back(pasted(&text)),
            Some(Open::String(text, length)) if length <= LONGEST_TYPED => text,
            Some(Open::String(..) | Open::Overlong) => {
                self.lost_string = true;
                return;
            }
            None => pending,
        };
        self.took_escape = rest == [ESC];
        let Some(typed) = rest.strip_prefix(&[ESC]) else {
            return;
        };
        // A sequence that was cut off says nothing; `[`, `O` and the like were keys of their own.
        if typed.len() <= 1 || begins_string(typed[0]) {
            messages.push_back(key(KeyCode::Esc, KeyModifiers::NONE));
            let typed = String::from_utf8_lossy(typed);
            let typed = typed.chars().filter(|c| !c.is_control());
            messages.extend(typed.map(|c| key(KeyCode::Char(c), KeyModifiers::NONE)));
        }
    }

    /// Takes the next part of what is under way; how many bytes.
    fn go_on(
        &mut self,
        open: Open,
        bytes: &[u8],
        messages: &mut VecDeque<TerminalMessage>,
    ) -> usize {
        match open {
            Open::Paste(text, length) => self.go_on_with_paste(text, length, bytes, messages),
            Open::String(text, length) => self.go_on_with_string(text, length, bytes, messages),
            Open::Overlong => match bytes.iter().position(|b| !is_inside_sequence(*b)) {
                Some(end) if is_final(bytes[end]) => end + 1,
                Some(end) => end,
                None => {
                    self.open = Some(Open::Overlong);
                    bytes.len()
                }
            },
        }
    }

    fn go_on_with_paste(
        &mut self,
        mut text: Vec<u8>,
        length: usize,
        bytes: &[u8],
        messages: &mut VecDeque<TerminalMessage>,
    ) -> usize {
        let end = bytes.windows(PASTE_END.len()).position(|w| w == PASTE_END);
        // The last bytes may be the first of the end.
        let cut = (0..PASTE_END.len())
            .rev()
            .find(|&n| bytes.ends_with(&PASTE_END[..n]))
            .unwrap_or(0);
        let taken = end.unwrap_or(bytes.len() - cut);
        let room = LONGEST_PASTE.saturating_sub(text.len());
        text.extend_from_slice(&bytes[..taken.min(room)]);
        let length = length + taken;
        if end.is_none() && length < ENDLESS_PASTE {
            self.open = Some(Open::Paste(text, length));
            return taken;
        }
        messages.push_back(pasted(&text));
        taken + end.map_or(0, |_| PASTE_END.len())
    }

    fn go_on_with_string(
        &mut self,
        mut text: Vec<u8>,
        length: usize,
        bytes: &[u8],
        messages: &mut VecDeque<TerminalMessage>,
    ) -> usize {
        let end = bytes
            .iter()
            .position(|b| matches!(*b, ESC | BEL | CAN | SUB));
        let taken = end.unwrap_or(bytes.len());
        let room = LONGEST_SEQUENCE.saturating_sub(text.len());
        text.extend_from_slice(&bytes[..taken.min(room)]);
        let length = length + taken;
        match bytes.get(taken..) {
            Some([ESC, b'\\', ..]) => {
                messages.extend(string(&text));
                taken + 2
            }
            Some([BEL, ..]) => {
                messages.extend(string(&text));
                taken + 1
            }
            Some([CAN | SUB, ..]) => taken + 1,
            // Another sequence breaks it off.
            Some([ESC, _, ..]) => {
                self.open = Some(Open::String(text, length));
                self.give_up(messages);
                taken
            }
            // Nothing more, or an escape whose second byte has not come.
            _ => {
                self.open = Some(Open::String(text, length));
                taken
            }
        }
    }
}

fn pasted(text: &[u8]) -> TerminalMessage {
    TerminalMessage::Event(Event::Paste(String::from_utf8_lossy(text).into_owned()))
}

fn key(code: KeyCode, modifiers: KeyModifiers) -> TerminalMessage {
    TerminalMessage::Event(Event::Key(KeyEvent::new(code, modifiers)))
}

/// Whether an escape and this byte begin a string: DCS, SOS, OSC, PM, APC.
const fn begins_string(byte: u8) -> bool {
    matches!(byte, b'P' | b'X' | b']' | b'^' | b'_')
}

/// Whether a byte belongs to a control sequence that goes on.
const fn is_inside_sequence(byte: u8) -> bool {
    matches!(byte, 0x20..=0x3f)
}

/// Whether a byte ends a control sequence.
const fn is_final(byte: u8) -> bool {
    matches!(byte, 0x40..=0x7e)
}

fn step(bytes: &[u8]) -> Parsed {
    match bytes {
        [ESC] | [ESC, b'O'] => Parsed::More,
        [ESC, b'[', ..] => control_sequence(bytes),
        [ESC, b'O', last, ..] => match keypad_key(*last).or_else(|| application_key(*last)) {
            Some(code) => Parsed::Took(3, Some(key(code, KeyModifiers::NONE))),
            None => Parsed::Took(1, Some(key(KeyCode::Esc, KeyModifiers::NONE))),
        },
        // A string, or the escape key and another: its end tells, or that none comes.
        [ESC, first, ..] if begins_string(*first) => {
            Parsed::Opens(2, Open::String(bytes[..2].to_vec(), 2))
        }
        // Escape and a key at once: two keys that a network has brought together, or one with Alt,
        // which nothing here needs.
        [ESC, ..] => Parsed::Took(1, Some(key(KeyCode::Esc, KeyModifiers::NONE))),
        _ => match character(bytes) {
            Some((n, found)) => {
                Parsed::Took(n, found.map(|(code, modifiers)| key(code, modifiers)))
            }
            None => Parsed::More,
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
fn control_sequence(bytes: &[u8]) -> Parsed {
    let body = &bytes[2..];
    // The Linux console's F1 to F5.
    if let [b'[', rest @ ..] = body {
        let Some(last) = rest.first() else {
            return Parsed::More;
        };
        let number = last.wrapping_sub(b'A');
        let code = (number < 5).then(|| key(KeyCode::F(number + 1), KeyModifiers::NONE));
        return Parsed::Took(4, code);
    }
    if let Some(step) = raw_report(body) {
        return step;
    }
    let Some(end) = body.iter().position(|b| !is_inside_sequence(*b)) else {
        return if body.len() < LONGEST_SEQUENCE {
            Parsed::More
        } else {
            Parsed::Opens(bytes.len(), Open::Overlong)
        };
    };
    let (parameters, last) = (&body[..end], body[end]);
    if !is_final(last) {
        // Broken off by a byte that has no place in it, which is looked at by itself.
        return Parsed::Took(2 + end, None);
    }
    let length = 2 + end + 1;
    if last == b'~' && parameters == b"200" {
        return Parsed::Opens(length, Open::Paste(Vec::new(), 0));
    }
    Parsed::Took(length, meaning(parameters, last))
}

/// The mouse as xterm reports it in bytes of their own (X10, highlighting), which is never asked for.
fn raw_report(body: &[u8]) -> Option<Parsed> {
    let length = match body.first()? {
        b'M' => 3,
        b't' => 2,
        b'T' => 6,
        _ => return None,
    };
    let rest = &body[1..];
    Some(match rest.iter().take(length).position(|b| *b < 0x20) {
        Some(early) => Parsed::Took(3 + early, None),
        None if rest.len() < length => Parsed::More,
        None => Parsed::Took(3 + length, None),
    })
}

/// What a whole control sequence says, if it is anything of use.
fn meaning(parameters: &[u8], last: u8) -> Option<TerminalMessage> {
    match (parameters, last) {
        (b"?997;1", b'n') => return Some(TerminalMessage::Ground { is_light: false }),
        (b"?997;2", b'n') => return Some(TerminalMessage::Ground { is_light: true }),
        ([b'<', report @ ..], b'M' | b'm') => return mouse(report, last),
        // Answers to what was never asked have a mark before their numbers, or bytes after them.
        ([b'<'..=b'?', ..], _) => return None,
        _ if parameters.iter().any(|b| *b < b'0') => return None,
        (b"0" | b"3", b'n') => return Some(TerminalMessage::Ready),
        _ => {}
    }
    let fields = fields(parameters);
    let field = |i: usize| fields.get(i).copied().unwrap_or_default();
    let ([first, shifted, ..], [held, kind, ..]) = (field(0), field(1));
    let modifiers = modifiers(held);
    let code = match last {
        b'~' if first == Some(27) => code_of(field(2)[0]?),
        b'~' => first.and_then(numbered_key),
        b'u' if modifiers.contains(KeyModifiers::SHIFT) => code_of(shifted.or(first)?),
        b'u' => code_of(first?),
        // Other numbers are answers: a place, a size.
        _ if first.unwrap_or(1) != 1 || held.is_some_and(|held| held > 256) => None,
        b'M' => None,
        b'Z' => Some(KeyCode::BackTab),
        _ => keypad_key(last),
    }?;
    let kind = match kind {
        Some(2) => KeyEventKind::Repeat,
        Some(3) => KeyEventKind::Release,
        _ => KeyEventKind::Press,
    };
    let event = KeyEvent::new_with_kind(code, modifiers, kind);
    Some(TerminalMessage::Event(Event::Key(event)))
}

/// The numbers of a sequence, each with its own second and third after colons.
fn fields(parameters: &[u8]) -> Vec<[Option<u32>; 3]> {
    let number = |text: &[u8]| str::from_utf8(text).ok()?.parse().ok();
    let field = |text: &[u8]| {
        let mut parts = text.split(|&b| b == b':').map(number);
        std::array::from_fn(|_| parts.next().flatten())
    };
    parameters.split(|&b| b == b';').map(field).collect()
}

/// What a string says, if it is anything of use: the colour of the ground.
fn string(text: &[u8]) -> Option<TerminalMessage> {
    let color = str::from_utf8(text).ok()?.strip_prefix("\x1b]11;")?;
    let (_, channels) = color.split_once(':')?;
    let mut channels = channels.split('/').map(|hex| {
        let most = 16_u32.checked_pow(hex.len() as u32)?.checked_sub(1)?;
        let value = u32::from_str_radix(hex, 16).ok()?;
        (most > 0).then(|| value as f32 / most as f32)
    });
    let mut next = || channels.next().flatten();
    let [red, green, blue] = [next()?, next()?, next()?];
    let luma = 0.299 * red + 0.587 * green + 0.114 * blue;
    Some(TerminalMessage::Ground {
        is_light: luma > 0.5,
    })
}

/// xterm's way to say what was held down: 1, and a bit for each.
fn modifiers(parameter: Option<u32>) -> KeyModifiers {
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
        b'P'..=b'S' => KeyCode::F(last - b'P' + 1),
        _ => return None,
    })
}

/// The keypad where somebody has left it in its application mode.
const fn application_key(last: u8) -> Option<KeyCode> {
    Some(match last {
        b'M' => KeyCode::Enter,
        b'I' => KeyCode::Tab,
        b' ' => KeyCode::Char(' '),
        b'X' => KeyCode::Char('='),
        b'j'..=b'y' => KeyCode::Char((last - b'j' + b'*') as char),
        _ => return None,
    })
}

const fn numbered_key(number: u32) -> Option<KeyCode> {
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

/// The key of a character that was sent as its number; kitty numbers other keys from 57344.
fn code_of(number: u32) -> Option<KeyCode> {
    Some(match number {
        57399..=57408 => KeyCode::Char(char::from_digit(number - 57399, 10)?),
        57409..=57413 => KeyCode::Char(*b"./*-+".get(number as usize - 57409)? as char),
        57414 => KeyCode::Enter,
        57415 => KeyCode::Char('='),
        57417 => KeyCode::Left,
        57418 => KeyCode::Right,
        57419 => KeyCode::Up,
        57420 => KeyCode::Down,
        57421 => KeyCode::PageUp,
        57422 => KeyCode::PageDown,
        57423 => KeyCode::Home,
        57424 => KeyCode::End,
        57425 => KeyCode::Insert,
        57426 => KeyCode::Delete,
        57344..=63743 => return None,
        _ => {
            let mut bytes = [0; 4];
            let c = char::from_u32(number)?;
            let (_, found) = character(c.encode_utf8(&mut bytes).as_bytes())?;
            return found.map(|(code, _)| code);
        }
    })
}

/// A press, a release or a turn of the wheel: `button ; column ; row`, and M or m.
fn mouse(report: &[u8], last: u8) -> Option<TerminalMessage> {
    let fields = fields(report);
    let [[Some(button), ..], [Some(column), ..], [Some(row), ..]] = fields[..] else {
        return None;
    };
    let [column, row] = [column, row].map(|n| u16::try_from(n).ok()?.checked_sub(1));
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
    Some(TerminalMessage::Event(Event::Mouse(MouseEvent {
        kind,
        column: column?,
        row: row?,
        modifiers: KeyModifiers::NONE,
    })))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn messages(chunks: &[&[u8]]) -> Vec<TerminalMessage> {
        let mut keyboard = Keyboard::default();
        let mut all = VecDeque::new();
        for chunk in chunks {
            keyboard.feed(chunk, &mut all);
        }
        keyboard.give_up(&mut all);
        all.into()
    }

    fn plain(code: KeyCode) -> TerminalMessage {
        key(code, KeyModifiers::NONE)
    }

    fn typed(text: &str) -> Vec<TerminalMessage> {
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
            assert_eq!(messages(&[bytes]), [key(*code, *modifiers)], "{bytes:?}");
        }
    }

    #[test]
    fn a_string_that_a_program_would_start_swallows_no_keys() {
        assert_eq!(messages(&[b"\x1b]", b"abc"])[1..], typed("]abc"));
        assert_eq!(messages(&[b"\x1b\x1b", b"Oz"])[2..], typed("Oz"));
    }

    #[test]
    fn what_terminals_say_of_themselves_is_no_key() {
        for talk in [
            "\x1b]10;rgb:0000/0000/0000\x1b\\",
            "\x1b]4;1;rgb:ff/00/00\x07",
            "\x1bP1$r0m\x1b\\",
            "\x1bP>|xterm(390)\x1b\\",
            "\x1b_Gi=1;OK\x1b\\",
            "\x1b^private\x1b\\",
            "\x1bXany\x1b\\",
            "\x1b[?62;1;2;4;6;9;15;16;17;18;21;22;28;29;42;52c",
            "\x1b[>41;390;0c",
            "\x1b[12;40R",
            "\x1b[8;24;80t",
            "\x1b[?2026;2$y",
            "\x1b[?1u",
            "\x1b[I\x1b[O",
            "\x1b[M\x20\x21\x22",
            "\x1b[M#q\x7f",
            "\x1b[35;12;9M",
            "\x1b[57441;1u",
        ] {
            for cut in 1..talk.len() {
                let (first, second) = talk.as_bytes().split_at(cut);
                let second = [second, b"q"].concat();
                assert_eq!(messages(&[first, &second]), typed("q"), "{talk:?} at {cut}");
            }
        }
    }

    #[test]
    fn a_string_of_any_length_is_swallowed_and_held_in_little() {
        let mut keyboard = Keyboard::default();
        let mut all = VecDeque::new();
        keyboard.feed(b"\x1bP1;2|", &mut all);
        for _ in 0..1000 {
            keyboard.feed(&[b'D'; 1000], &mut all);
        }
        assert!(
            matches!(&keyboard.open, Some(Open::String(kept, _)) if kept.len() <= LONGEST_SEQUENCE)
        );
        keyboard.feed(b"\x1b\\", &mut all);
        keyboard.feed(b"\x1b[", &mut all);
        for _ in 0..1000 {
            keyboard.feed(&[b'1'; 1000], &mut all);
        }
        assert!(keyboard.pending.len() <= LONGEST_SEQUENCE);
        keyboard.feed(b"nq", &mut all);
        assert_eq!(all, typed("q"));
    }

    #[test]
    fn a_string_that_is_given_up_presses_nothing() {
        let mut keyboard = Keyboard::default();
        let mut all = VecDeque::new();
        keyboard.feed(b"\x1b]52;c;RGVsZXRl", &mut all);
        keyboard.give_up(&mut all);
        keyboard.feed(b"\x1b\\q", &mut all);
        assert_eq!(all, typed("q"));
    }

    #[test]
    fn what_has_begun_is_waited_for_as_long_as_it_may_take() {
        let patience = |bytes: &[u8]| {
            let mut keyboard = Keyboard::default();
            keyboard.feed(bytes, &mut VecDeque::new());
            keyboard.patience()
        };
        assert_eq!(patience(b"q"), None);
        assert_eq!(patience(b"\x1b"), Some(ESCAPE_PATIENCE));
        assert_eq!(patience(b"\x1b["), Some(SEQUENCE_PATIENCE));
        assert_eq!(patience(b"\x1b]11;rgb:"), Some(SEQUENCE_PATIENCE));
        assert_eq!(
            patience(b"\x1b[200~text with a pause"),
            Some(PASTE_PATIENCE)
        );
        assert_eq!(patience(b"\x1b[200~text\x1b[201~"), None);
    }

    #[test]
    fn the_ground_is_told() {
        let ground = |text: &str| messages(&[text.as_bytes()]);
        let told = |is_light| [TerminalMessage::Ground { is_light }];
        assert_eq!(ground("\x1b]11;rgb:ffff/ffff/ffff\x1b\\"), told(true));
        assert_eq!(ground("\x1b]11;rgba:ff/ff/ff/ff\x07"), told(true));
        assert_eq!(ground("\x1b]11;rgb:0/3/2\x07"), told(false));
        assert_eq!(ground("\x1b]11;rgb:/ffff\x07"), []);
        assert_eq!(ground("\x1b[?997;2n"), told(true));
        assert_eq!(ground("\x1b[?997;1n"), told(false));
    }

    #[test]
    fn a_release_is_no_press() {
        for (bytes, code, modifiers, kind) in [
            (
                "\x1b[113;1:3u",
                KeyCode::Char('q'),
                KeyModifiers::NONE,
                KeyEventKind::Release,
            ),
            (
                "\x1b[97;1:2u",
                KeyCode::Char('a'),
                KeyModifiers::NONE,
                KeyEventKind::Repeat,
            ),
            (
                "\x1b[1;1:3A",
                KeyCode::Up,
                KeyModifiers::NONE,
                KeyEventKind::Release,
            ),
            (
                "\x1b[3;1:3~",
                KeyCode::Delete,
                KeyModifiers::NONE,
                KeyEventKind::Release,
            ),
            (
                "\x1b[97:65;2u",
                KeyCode::Char('A'),
                KeyModifiers::SHIFT,
                KeyEventKind::Press,
            ),
            (
                "\x1b[27;5;99~",
                KeyCode::Char('c'),
                KeyModifiers::CONTROL,
                KeyEventKind::Press,
            ),
        ] {
            let event = KeyEvent::new_with_kind(code, modifiers, kind);
            let expected = TerminalMessage::Event(Event::Key(event));
            assert_eq!(messages(&[bytes.as_bytes()]), [expected], "{bytes:?}");
        }
    }

    #[test]
    fn an_answer_whose_beginning_came_late_is_still_one() {
        let mut keyboard = Keyboard::default();
        let mut all = VecDeque::new();
        keyboard.feed(b"\x1b", &mut all);
        keyboard.give_up(&mut all);
        keyboard.feed(b"[0nq", &mut all);
        assert_eq!(
            all.make_contiguous()[1..],
            [vec![TerminalMessage::Ready], typed("q")].concat()
        );
    }

    #[test]
    fn an_answer_is_no_key() {
        let answer = messages(&[b"\x1b[0nq"]);
        assert_eq!(answer, [TerminalMessage::Ready, plain(KeyCode::Char('q'))]);
    }

    #[test]
    fn what_is_pasted_is_text_whatever_it_holds() {
        let paste = messages(&[b"\x1b[200~q\x1b[Ax\r\x03\x1b[201~q"]);
        let text = Event::Paste("q\x1b[Ax\r\x03".into());
        assert_eq!(
            paste,
            [TerminalMessage::Event(text), plain(KeyCode::Char('q'))]
        );
    }

    #[test]
    fn a_paste_that_never_ends_gives_the_keys_back_once_nothing_comes() {
        let mut keyboard = Keyboard::default();
        let mut all = VecDeque::new();
        for _ in 0..100 {
            keyboard.feed(&[b'x'; 1000], &mut all);
            keyboard.feed(b"\x1b[200~", &mut all);
            all.clear();
        }
        assert!(keyboard.patience().is_some());
        keyboard.give_up(&mut all);
        let Some(TerminalMessage::Event(Event::Paste(text))) = all.pop_front() else {
            panic!("no paste");
        };
        assert_eq!(text.len(), LONGEST_PASTE);
        keyboard.feed(b"q", &mut all);
        assert_eq!(all, [plain(KeyCode::Char('q'))]);
    }

    #[test]
    fn the_mouse_is_heard() {
        let report = |kind, column, row| {
            TerminalMessage::Event(Event::Mouse(MouseEvent {
                kind,
                column,
                row,
                modifiers: KeyModifiers::NONE,
            }))
        };
        assert_eq!(
            messages(&[
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
            let mut all = VecDeque::new();
            keyboard.feed(noise, &mut all);
            keyboard.give_up(&mut all);
            keyboard.feed(b"q", &mut all);
            assert_eq!(all.pop_back(), Some(plain(KeyCode::Char('q'))), "{noise:?}");
        }
    }

    /// A control sequence or a string as xterm's grammar has them, but none that is a key.
    fn talk() -> impl Strategy<Value = Vec<u8>> {
        let text = prop::collection::vec(0x20_u8..0x7f, 0..40);
        let string = (
            "[P\\]^_X]",
            text,
            prop::sample::select(vec!["\x1b\\", "\x07"]),
        );
        prop_oneof![
            string.prop_map(|(kind, text, end)| {
                [b"\x1b", kind.as_bytes(), &text, end.as_bytes()].concat()
            }),
            "\x1b\\[[<=>?][0-9;:]{0,40}[ -/]{0,2}[@-LN-Zac-ln-z~]".prop_map(String::into_bytes),
            "\x1b\\[[0-9;:]{0,40}[ -/]{1,2}[@-~]".prop_map(String::into_bytes),
            "\x1b\\[[0-9;]{1,40}[a-mo-tv-y]".prop_map(String::into_bytes),
            "\x1b\\[M[ -~]{3}".prop_map(String::into_bytes),
        ]
    }

    proptest! {
        #[test]
        fn the_grammar_of_terminals_presses_no_key(
            all in prop::collection::vec(talk(), 0..10),
            cut in 1usize..9,
        ) {
            let bytes = [all.concat(), b"q".to_vec()].concat();
            let chunks: Vec<&[u8]> = bytes.chunks(cut).collect();
            let mut found = messages(&chunks);
            found.retain(|m| matches!(m, TerminalMessage::Event(_)));
            prop_assert_eq!(found, typed("q"));
        }

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
                    talk(),
                    prop::collection::vec(any::<u8>(), 0..4),
                ],
                0..20,
            ),
            cut in 1usize..7,
        ) {
            let bytes = parts.concat();
            let whole = messages(&[&bytes]);
            let chunks: Vec<&[u8]> = bytes.chunks(cut).collect();
            prop_assert_eq!(messages(&chunks), whole);
        }
    }
}
