//! The languages, and their reader: from text to `naga`'s representation, validated.

use naga::front::{glsl, wgsl};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage, Span, WithSpan};

use super::RoutineError;
use super::guard::RoutineSource;

/// What a routine is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Language {
    /// The language of OpenGL, WebGL and Shadertoy.
    Glsl,
    /// The language of WebGPU.
    Wgsl,
}

impl Language {
    /// By the ending of a file's name.
    pub fn of(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "glsl" | "frag" | "vert" | "comp" => Some(Self::Glsl),
            "wgsl" => Some(Self::Wgsl),
            _ => None,
        }
    }
}

/// A module with what the validator found out about it.
pub(super) struct ParsedModule {
    pub module: Module,
    pub info: ModuleInfo,
}

/// Reads and validates.
pub(super) fn parse(source: &RoutineSource) -> Result<ParsedModule, RoutineError> {
    let module = match source.language {
        Language::Glsl => read_glsl(source)?,
        Language::Wgsl => read_wgsl(source)?,
    };
    // No uniformity: a routine has no neighbours to agree with.
    let flags = ValidationFlags::EXPRESSIONS
        | ValidationFlags::BLOCKS
        | ValidationFlags::STRUCT_LAYOUTS
        | ValidationFlags::CONSTANTS;
    let info = Validator::new(flags, Capabilities::FLOAT64)
        .validate(&module)
        .map_err(|error| invalid(source, &error))?;
    Ok(ParsedModule { module, info })
}

fn read_glsl(source: &RoutineSource) -> Result<Module, RoutineError> {
    let options = glsl::Options::from(ShaderStage::Fragment);
    glsl::Frontend::default()
        .parse(&options, &source.code)
        .map_err(|errors| {
            // The first in the text: what follows is often its consequence.
            let first = errors.errors.iter().min_by_key(|error| {
                let at = error.meta.to_range().unwrap_or(0..0);
                (at == (0..0), at.start)
            });
            match first {
                Some(error) => {
                    let problem = match &error.kind {
                        glsl::ErrorKind::PreprocessorError(kind)
                            if format!("{kind:?}").contains("64BitLiteral") =>
                        {
                            "a number such as 2.0lf is not read here; write double(2.0)".to_owned()
                        }
                        glsl::ErrorKind::InvalidToken(..) => {
                            let found = error.meta.to_range().and_then(|at| source.code.get(at));
                            unexpected(&error.kind.to_string(), found.unwrap_or_default())
                        }
                        kind => sentence(&kind.to_string()),
                    };
                    at(source, error.meta, problem)
                }
                None => source.error(0, "the text can't be read"),
            }
        })
}

fn read_wgsl(source: &RoutineSource) -> Result<Module, RoutineError> {
    wgsl::parse_str(&source.code).map_err(|error| {
        let span = error.labels().next().map(|(span, _)| span);
        at(source, span.unwrap_or_default(), sentence(error.message()))
    })
}

fn invalid(source: &RoutineSource, error: &WithSpan<naga::valid::ValidationError>) -> RoutineError {
    let span = error.spans().map(|(span, _)| *span).find(Span::is_defined);
    let mut problem = error.as_inner().to_string();
    let mut cause: Option<&dyn std::error::Error> = std::error::Error::source(error.as_inner());
    while let Some(inner) = cause {
        problem = inner.to_string();
        cause = inner.source();
    }
    at(source, span.unwrap_or_default(), sentence(&problem))
}

fn at(source: &RoutineSource, span: Span, problem: String) -> RoutineError {
    source.error(span.to_range().map_or(0, |range| range.start), problem)
}

/// What the reader calls the signs that it expects, and the signs.
const SIGNS: [(&str, &str); 13] = [
    ("LeftParen", "("),
    ("RightParen", ")"),
    ("LeftBracket", "["),
    ("RightBracket", "]"),
    ("LeftBrace", "{"),
    ("RightBrace", "}"),
    ("Semicolon", "a semicolon"),
    ("Comma", "a comma"),
    ("Colon", ":"),
    ("Dot", "a dot"),
    ("Assign", "="),
    ("Identifier", "a name"),
    ("identifier", "a name"),
];

/// What was expected, in signs and not in the reader's names for them, and what is there.
fn unexpected(message: &str, found: &str) -> String {
    let expected = message.rsplit_once(", found ").map_or(message, |(e, _)| e);
    let expected = SIGNS
        .iter()
        .fold(expected.to_owned(), |text, (name, sign)| {
            text.replace(name, sign)
        });
    match found.trim() {
        "" => sentence(&format!("{expected}, found the end of the text")),
        found => sentence(&format!("{expected}, found {found}")),
    }
}

/// What the reader says, as our sentences are: in one line, without capital or full stop.
fn sentence(message: &str) -> String {
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut characters = line.trim_end_matches('.').chars();
    let first = characters.next().map(|c| c.to_ascii_lowercase());
    let text: String = first.into_iter().chain(characters).collect();
    if text.is_empty() {
        "the text can't be read".to_owned()
    } else {
        text
    }
}
