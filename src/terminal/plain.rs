//! The explorer without a screen: lines in, lines out, on a terminal or through pipes.

use std::io::{self, ErrorKind, Write};
use std::sync::mpsc;

use crate::door::without_mark;
use crate::explorer::{Explorer, Reply};
use crate::system::{HUNG_UP, LineInput, LinePart, Waker, is_terminal_gone};

/// No line of a person or of a sane script is longer, in bytes.
const LONGEST_LINE: usize = 1 << 16;
const PROMPT: &str = "> ";
/// The exit status of a script of which a line could not be done.
const REFUSED: u8 = 1;

/// Converses until the person leaves, the input ends or a signal says so; the exit status.
///
/// Somebody who is `present` is prompted and asked; in a script a line that can't be done makes the
/// exit status 1, and nothing is asked.
pub fn converse(explorer: &mut Explorer, present: bool) -> io::Result<u8> {
    let (sender, woken) = mpsc::channel();
    explorer.wake_by(Waker::new(move || {
        // Nobody waits any more: then nobody misses it.
        let _ = sender.send(());
    }));
    let mut lines = Lines::new()?;
    if !present {
        explorer.put_off();
    }
    let mut any_refused = false;
    let mut reply = explorer.greeting();
    loop {
        any_refused |= reply.refused;
        // Who leaves a script leaves unsaved work to the recovery file.
        let left = explorer.is_asking_to_quit() && !present;
        let status = explorer.ended().or(left.then_some(0));
        if left {
            reply.question = None;
        }
        match say(&reply, present && status.is_none()) {
            Ok(true) => {}
            Ok(false) => return Ok(0),
            // The terminal is closed.
            Err(e) if is_terminal_gone(&e) => return Ok(HUNG_UP),
            Err(e) => return Err(e),
        }
        let status = match status {
            Some(status) => Some(status),
            None => match lines.next()? {
                NextLine::Line(line) => {
                    reply = explorer.run_line(&line);
                    while explorer.is_measuring() && woken.recv().is_ok() {
                        explorer.catch_up();
                    }
                    None
                }
                NextLine::TooLong => {
                    reply = Reply {
                        text: format!("A line is longer than {LONGEST_LINE} bytes.\n"),
                        question: None,
                        refused: true,
                    };
                    None
                }
                NextLine::End(status) => Some(status),
            },
        };
        match status {
            Some(0) if any_refused && !present => return Ok(REFUSED),
            Some(status) => return Ok(status),
            None => {}
        }
    }
}

/// Writes a reply and, to somebody who is there, the prompt; false if nobody reads any more.
fn say(reply: &Reply, prompt: bool) -> io::Result<bool> {
    let mut out = io::stdout().lock();
    let question = reply.question.as_deref().unwrap_or_default();
    let prompt = if prompt { PROMPT } else { "" };
    let written = out
        .write_all([reply.text.as_str(), question, prompt].concat().as_bytes())
        .and_then(|()| out.flush());
    match written {
        Ok(()) => Ok(true),
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(e) => Err(e),
    }
}

/// What comes in.
enum NextLine {
    Line(String),
    TooLong,
    /// No more is to come; the exit status.
    End(u8),
}

/// Standard input, line by line, and the signals beside it.
struct Lines {
    input: LineInput,
    pending: Vec<u8>,
    /// The line at hand is too long: the rest of it is passed over.
    is_skipping: bool,
    is_over: bool,
    /// Lines taken so far: the first may have a byte order mark before it.
    taken: usize,
}

impl Lines {
    fn new() -> io::Result<Self> {
        Ok(Self {
            input: LineInput::open()?,
            pending: Vec::new(),
            is_skipping: false,
            is_over: false,
            taken: 0,
        })
    }

    fn next(&mut self) -> io::Result<NextLine> {
        loop {
            if let Some(line) = self.take_line() {
                return Ok(line);
            }
            if self.is_over {
                return Ok(NextLine::End(0));
            }
            match self.input.wait()? {
                LinePart::Bytes(bytes) => self.pending.extend(bytes),
                LinePart::End => self.is_over = true,
                LinePart::Leave(status) => return Ok(NextLine::End(status)),
            }
        }
    }

    /// The first whole line of what has come in; at the end, what there is.
    fn take_line(&mut self) -> Option<NextLine> {
        let end = self.pending.iter().position(|&b| b == b'\n');
        let length = match end {
            Some(at) => at + 1,
            None if self.is_over && !self.pending.is_empty() => self.pending.len(),
            None => {
                if self.pending.len() > LONGEST_LINE {
                    self.pending.clear();
                    self.is_skipping = true;
                }
                return None;
            }
        };
        let line: Vec<u8> = self.pending.drain(..length).collect();
        if std::mem::take(&mut self.is_skipping) || line.len() > LONGEST_LINE {
            return Some(NextLine::TooLong);
        }
        let text = String::from_utf8_lossy(&line);
        self.taken += 1;
        let text = if self.taken == 1 {
            without_mark(&text)
        } else {
            &text
        };
        Some(NextLine::Line(text.to_owned()))
    }
}
