//! What a text must keep to before `naga` reads it: that reader recurses, and expands macros, as far as a text
//! asks it to.

use super::front::Language;
use super::lines::{self, SourceLine};
use super::{LONGEST, RoutineError};

/// How deep brackets may nest.
const DEEPEST: usize = 48;
/// How many operators, calls and commas one statement may have.
const LONGEST_STATEMENT: usize = 300;
/// How many branches and loops one text may have.
const MOST_BRANCHES: usize = 200;
/// How many branches may follow one another with nothing between them.
const LONGEST_CHAIN: usize = 16;
/// The greatest index.
const GREATEST_INDEX: u32 = 15;
/// How many names one text may define by `#define`, and how long what they mean may be.
const MOST_MACROS: usize = 64;
const LONGEST_MACRO: usize = 80;

/// A text that may be read.
#[derive(Debug, Clone)]
pub(super) struct RoutineSource {
    pub language: Language,
    /// As the reader gets it: as long as the person's, comments and what it refuses left blank, and for GLSL a
    /// `main` behind it.
    pub code: String,
    pub lines: Vec<SourceLine>,
    /// Where each line starts.
    starts: Vec<usize>,
}

impl RoutineSource {
    /// The line and the column, from 1, of a byte.
    pub fn place(&self, byte: usize) -> (usize, usize) {
        let line = self.starts.partition_point(|&start| start <= byte);
        let line = line.clamp(1, self.lines.len());
        let from = self.starts[line - 1];
        let before = self.code.get(from..byte).unwrap_or("");
        (line, before.chars().count() + 1)
    }

    /// An error at a byte.
    pub fn error(&self, byte: usize, problem: impl Into<String>) -> RoutineError {
        let (line, column) = self.place(byte);
        RoutineError {
            line,
            column,
            problem: problem.into(),
        }
    }

    /// What a comment line of the form `// word: …` says; the last one counts.
    pub fn said(&self, word: &str) -> Option<(usize, &str)> {
        let said = |line: &'_ SourceLine| {
            let (head, rest) = line.comment.split_once(':')?;
            head.trim()
                .eq_ignore_ascii_case(word)
                .then(|| rest.trim().len())
        };
        self.lines.iter().enumerate().rev().find_map(|(i, line)| {
            let length = said(line)?;
            let text = line.comment.trim_end();
            Some((i + 1, &text[text.len() - length..]))
        })
    }
}

/// Checks the text, and takes out of it what the reader does not read.
pub(super) fn check(text: &str, language: Language) -> Result<RoutineSource, RoutineError> {
    if text.len() > LONGEST {
        return Err(RoutineError {
            line: 1,
            column: 1,
            problem: format!(
                "the text has {} bytes, and a routine at most {LONGEST}",
                text.len()
            ),
        });
    }
    let (code, lines) = lines::split(text, language == Language::Wgsl);
    let starts = std::iter::once(0)
        .chain(code.match_indices('\n').map(|(i, _)| i + 1))
        .collect();
    let mut source = RoutineSource {
        language,
        code,
        lines,
        starts,
    };
    characters(&source)?;
    if language == Language::Glsl {
        source.code = without_directives(&source)?;
    }
    shape(&source)?;
    if language == Language::Glsl {
        source.code.push_str("\nvoid main() {}\n");
    }
    Ok(source)
}

/// Code is plain ASCII without backslashes.
fn characters(source: &RoutineSource) -> Result<(), RoutineError> {
    let strange = |c: char| !c.is_ascii() || c == '\\' || c == '\0';
    match source.code.char_indices().find(|&(_, c)| strange(c)) {
        Some((at, c)) => Err(source.error(
            at,
            format!(
                "{} is no character of the language outside comments",
                c.escape_default()
            ),
        )),
        None => Ok(()),
    }
}

/// The code with blanks in place of `#version`, `#extension` and `precision`; a macro is a name for few words.
fn without_directives(source: &RoutineSource) -> Result<String, RoutineError> {
    let mut code = String::with_capacity(source.code.len());
    let mut macros: Vec<&str> = Vec::new();
    let mut bodies: Vec<(usize, &str)> = Vec::new();
    let mut offset = 0;
    for line in source.code.split_inclusive('\n') {
        let trimmed = line.trim();
        let blank = match trimmed.strip_prefix('#').map(str::trim_start) {
            Some(directive) => {
                let word = directive.split(|c: char| !c.is_ascii_alphabetic()).next();
                match word.unwrap_or("") {
                    "version" | "extension" | "pragma" | "line" | "" => true,
                    "define" => {
                        let (name, body) = definition(source, offset, directive)?;
                        macros.push(name);
                        bodies.push((offset, body));
                        false
                    }
                    "ifdef" | "ifndef" | "else" | "endif" | "undef" => false,
                    word => {
                        return Err(source.error(
                            offset,
                            format!("#{word} is not read here; #define, #ifdef, #ifndef, #else and #endif are"),
                        ));
                    }
                }
            }
            None => trimmed.starts_with("precision ") && trimmed.ends_with(';'),
        };
        if blank {
            code.extend(line.chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        } else {
            code.push_str(line);
        }
        offset += line.len();
    }
    if macros.len() > MOST_MACROS {
        let at = bodies.last().map_or(0, |&(at, _)| at);
        return Err(source.error(
            at,
            format!("more than {MOST_MACROS} names are defined by #define"),
        ));
    }
    for (at, body) in bodies {
        if let Some(word) = words(body).find(|word| macros.contains(word)) {
            return Err(source.error(
                at,
                format!(
                    "#define builds on {word}, which is defined by #define; write a const instead"
                ),
            ));
        }
    }
    Ok(code)
}

/// The name that is defined, and what it means.
fn definition<'a>(
    source: &RoutineSource,
    at: usize,
    directive: &'a str,
) -> Result<(&'a str, &'a str), RoutineError> {
    let rest = directive["define".len()..].trim_start();
    let end = rest
        .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .unwrap_or(rest.len());
    let (name, body) = rest.split_at(end);
    if body.starts_with('(') {
        return Err(source.error(
            at,
            format!("#define {name}(…) is not read here; write a function"),
        ));
    }
    let brackets = body.contains(['{', '}', ';', '[', ']', '#']);
    if brackets || body.len() > LONGEST_MACRO {
        return Err(source.error(
            at,
            format!("#define {name} may mean an expression of {LONGEST_MACRO} characters at most"),
        ));
    }
    Ok((name, body))
}

fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}

/// Brackets match and are not deep, statements are not long, branches not many.
fn shape(source: &RoutineSource) -> Result<(), RoutineError> {
    let mut shape = TextShape::default();
    let code = &source.code;
    let bytes = code.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let byte = bytes[at];
        if byte.is_ascii_alphanumeric() || byte == b'_' {
            let rest = &code[at..];
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            let word = &rest[..end.unwrap_or(rest.len())];
            shape.word(source, at, word)?;
            at += word.len();
        } else {
            shape.sign(source, at, byte)?;
            at += 1;
        }
    }
    if let Some((at, _)) = shape.open.last() {
        return Err(source.error(*at, "this bracket is never closed"));
    }
    Ok(())
}

#[derive(Default)]
struct TextShape {
    open: Vec<(usize, u8)>,
    signs: usize,
    branches: usize,
    chain: usize,
}

impl TextShape {
    fn word(&mut self, source: &RoutineSource, at: usize, word: &str) -> Result<(), RoutineError> {
        if matches!(
            word,
            "if" | "else" | "for" | "while" | "do" | "loop" | "switch" | "case"
        ) {
            self.branches += 1;
            self.chain += 1;
        }
        if self.branches > MOST_BRANCHES || self.chain > LONGEST_CHAIN {
            return Err(source.error(
                at,
                format!(
                    "too many branches: {MOST_BRANCHES} in a text, {LONGEST_CHAIN} one straight after another"
                ),
            ));
        }
        if source.language == Language::Wgsl && word == "array" {
            return Err(source.error(at, "arrays are not read here"));
        }
        let within = self
            .open
            .last()
            .is_some_and(|&(_, bracket)| bracket == b'[');
        let index = word.trim_end_matches('u').parse::<u32>();
        if within && !index.is_ok_and(|index| index <= GREATEST_INDEX) {
            return Err(source.error(
                at,
                format!("an index is a whole number from 0 to {GREATEST_INDEX}, written out"),
            ));
        }
        self.signs += 1;
        self.long(source, at)
    }

    fn sign(&mut self, source: &RoutineSource, at: usize, byte: u8) -> Result<(), RoutineError> {
        match byte {
            b'(' | b'[' | b'{' => {
                self.open.push((at, byte));
                if self.open.len() > DEEPEST {
                    return Err(source.error(at, format!("brackets nest more than {DEEPEST} deep")));
                }
            }
            b')' | b']' | b'}' => {
                let wanted = match byte {
                    b')' => b'(',
                    b']' => b'[',
                    _ => b'{',
                };
                if self.open.pop().is_none_or(|(_, open)| open != wanted) {
                    let sign = char::from(byte);
                    return Err(source.error(at, format!("{sign} closes no bracket")));
                }
            }
            _ => {}
        }
        match byte {
            b';' => (self.signs, self.chain) = (0, 0),
            b'{' | b'}' => self.signs = 0,
            byte if byte.is_ascii_whitespace() => {}
            _ => self.signs += 1,
        }
        self.long(source, at)
    }

    fn long(&self, source: &RoutineSource, at: usize) -> Result<(), RoutineError> {
        if self.signs > 2 * LONGEST_STATEMENT {
            return Err(source.error(
                at,
                format!("this statement is too long: at most {LONGEST_STATEMENT} operations"),
            ));
        }
        Ok(())
    }
}
