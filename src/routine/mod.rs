//! One's own routine: a function in GLSL or WGSL that meets a ray with a sphere, checked, compiled
//! to operations on single numbers, and run over any number: in arrays for speed, or over one that keeps record.
//!
//! `naga` reads and validates the text; what it is asked to read is bounded before (`guard`), and what a run
//! may cost is bounded after (`run`).

mod compile;
mod front;
mod guard;
mod lines;
mod mathematics;
mod program;
mod role;
mod run;
mod signature;
mod value;

#[cfg(test)]
mod fuzz;

pub use front::Language;
pub use program::{Note, Program, Returned};
pub(crate) use run::{Lanes, Listener, Nobody, Noted, Runner, Told};
pub use run::{RealNote, RunOutcome, ask, listen};
pub use signature::{AnswerKind, NoHit};
pub(crate) use value::{Arithmetic, Plain, Real};

use std::fmt;

/// The longest text of a routine, in bytes.
pub const LONGEST: usize = 64 * 1024;

/// What a routine of one's own may begin with: the tutorial's function.
pub const fn template(language: Language) -> &'static str {
    match language {
        Language::Glsl => include_str!("template.glsl"),
        Language::Wgsl => include_str!("template.wgsl"),
    }
}

/// Why a text is no routine: where, and what is wrong, in a sentence without its full stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RoutineError {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// What is wrong, and what was expected.
    pub problem: String,
}

impl fmt::Display for RoutineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.problem)
    }
}

impl std::error::Error for RoutineError {}

/// Reads, checks and compiles the text of a routine.
///
/// With contraction a product is fused with the sum or difference that uses it, as compilers for processors with
/// fused multiply-adds do unasked. `contract` asks for it; a comment line `// contraction: on`, or `off`, has the last word.
pub fn compile(text: &str, language: Language, contract: bool) -> Result<Program, RoutineError> {
    let source = guard::check(text, language)?;
    // The front end and the compiler recurse as deep as the text nests, which the guard bounds:
    // a stack of a size that suffices for that, whoever calls.
    let contract = source
        .said("contraction")
        .map_or(contract, |(_, said)| said == "on");
    let work = move || {
        let module = front::parse(&source)?;
        compile::compile(&source, &module, contract)
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .name("routine".to_owned())
            .stack_size(STACK)
            .spawn_scoped(scope, work);
        match thread.map(std::thread::ScopedJoinHandle::join) {
            Ok(Ok(result)) => result,
            // A panic of the front end is a fault of its own; the person needs another text all the same.
            Ok(Err(_)) => Err(RoutineError {
                line: 1,
                column: 1,
                problem: "the text can't be read: it is beyond the reader of shaders".to_owned(),
            }),
            Err(error) => Err(RoutineError {
                line: 1,
                column: 1,
                problem: format!("no thread can be had to read it: {error}"),
            }),
        }
    })
}

/// Measured: the deepest text that the guard lets through needs less than a tenth of it.
const STACK: usize = 64 << 20;
