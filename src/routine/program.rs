//! A compiled routine: steps over single numbers, each in a place of its own.

use super::signature::{AnswerKind, NoHit, Signature};

/// What kind of number a place holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum SlotKind {
    /// binary32.
    Single,
    /// binary64, GLSL's `double`.
    Double,
    /// true or false.
    Bool,
    /// A whole number of 32 bits, with a sign.
    Int,
    /// A whole number of 32 bits, without.
    Uint,
}

impl SlotKind {
    pub const fn is_real(self) -> bool {
        matches!(self, Self::Single | Self::Double)
    }
}

/// A place in the bank of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Slot {
    pub kind: SlotKind,
    pub at: u16,
}

/// An operation that gives a real number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Arith {
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    Abs,
    Sqrt,
    /// x·y + z, rounded once.
    MulAdd,
    Min,
    Max,
    Floor,
    Ceil,
    Trunc,
    Round,
    Sign,
}

/// An operation that gives a whole number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Whole {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Neg,
    Abs,
    Min,
    Max,
    And,
    Or,
    Xor,
    Not,
    ShiftLeft,
    ShiftRight,
}

/// A comparison; false for a NaN, but for `!=`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// An operation on what is true and false.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Logic {
    And,
    Or,
    Equal,
    NotEqual,
    Not,
    IsNan,
    IsInf,
}

/// One operation on single numbers; operands that it does not take are 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Op {
    Arith {
        op: Arith,
        wide: bool,
        to: u16,
        of: [u16; 3],
    },
    Compare {
        op: Comparison,
        kind: SlotKind,
        to: u16,
        of: [u16; 2],
    },
    Logic {
        op: Logic,
        wide: bool,
        to: u16,
        of: [u16; 2],
    },
    Whole {
        op: Whole,
        unsigned: bool,
        to: u16,
        of: [u16; 2],
    },
    /// The first where the condition is true, else the second.
    Select {
        kind: SlotKind,
        to: u16,
        condition: u16,
        of: [u16; 2],
    },
    Convert {
        from: Slot,
        to: Slot,
    },
}

/// A part of a program.
#[derive(Debug, Clone)]
pub(crate) enum ProgramStep {
    Do(Op),
    /// Writes a variable, in the lanes that run.
    Put {
        to: Slot,
        from: Slot,
    },
    If {
        condition: u16,
        accept: Vec<ProgramStep>,
        reject: Vec<ProgramStep>,
    },
    Loop {
        body: Vec<ProgramStep>,
        continuing: Vec<ProgramStep>,
        break_if: Option<u16>,
        /// Operations of one turn, inner loops apart.
        cost: u32,
    },
    Break,
    Continue,
    /// The body of a function; what leaves it goes on after it.
    Scope(Vec<ProgramStep>),
    Leave,
    /// A place where somebody who listens is told values.
    Note(usize),
}

/// What the text does at a place where values are told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// The line of the text, from 1.
    pub line: usize,
    /// What gets the value; none for a condition or what is returned.
    pub name: Option<String>,
    /// The expression as it is written.
    pub formula: String,
    /// What kind of statement it is.
    pub returned: Returned,
    /// The function that it is in; none for the routine itself.
    pub function: Option<String>,
    /// The numbers, in order.
    pub(crate) slots: Vec<Slot>,
}

/// What a statement does with its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Returned {
    /// It goes into a variable.
    Kept,
    /// It decides a branch.
    Asked,
    /// It is what the function gives.
    Given,
}

/// A real number that a program starts with.
pub(crate) type ProgramConstants<T> = Vec<(u16, T)>;

/// A routine, ready to run.
#[derive(Debug, Clone)]
pub struct Program {
    pub(crate) steps: Vec<ProgramStep>,
    pub(crate) notes: Vec<Note>,
    /// Places in each bank: single, double, bool, whole.
    pub(crate) sizes: [usize; 4],
    pub(crate) singles: ProgramConstants<f32>,
    pub(crate) doubles: ProgramConstants<f64>,
    pub(crate) bools: ProgramConstants<bool>,
    pub(crate) wholes: ProgramConstants<i32>,
    /// Operations of a run, loops apart.
    pub(crate) cost: u32,
    /// Where the numbers of ray and sphere go: which of the eleven inputs, and the place.
    pub(crate) inputs: Vec<(ProgramInput, Slot)>,
    pub(crate) answer: ProgramAnswer,
    pub(crate) signature: Signature,
    /// The text, line by line, without what follows `//`, and that.
    pub(crate) lines: Vec<super::lines::SourceLine>,
}

impl Program {
    /// Which numbers of the question go where.
    pub(crate) fn inputs(&self) -> &[(ProgramInput, Slot)] {
        &self.inputs
    }

    /// What it answers.
    pub fn answers(&self) -> AnswerKind {
        self.signature.answers
    }

    /// How no hit is told.
    pub fn no_hit(&self) -> NoHit {
        self.answer.no_hit
    }

    /// The name of the function.
    pub fn name(&self) -> &str {
        &self.signature.name
    }

    /// Whether it computes in binary64.
    pub fn is_double(&self) -> bool {
        self.sizes[1] > 0
    }

    /// What each parameter was taken for, in order.
    pub fn roles(&self) -> impl Iterator<Item = (&str, &'static str)> {
        let roles = self.signature.parameters.iter();
        roles.map(|(name, role)| (name.as_str(), role.name()))
    }

    /// What values are told of, in the order of the text.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The code of a line, from 1, and the comment behind it.
    pub fn line(&self, line: usize) -> (&str, &str) {
        let found = self.lines.get(line.wrapping_sub(1));
        found.map_or(("", ""), |line| (&line.code, &line.comment))
    }
}

/// A number of the question.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ProgramInput {
    /// p0, by axis.
    Origin(u8),
    /// p0 − c, for a routine that has no centre.
    FromCenter(u8),
    /// d.
    Direction(u8),
    /// c.
    Center(u8),
    /// r.
    Radius,
    /// r².
    RadiusSquared,
    /// The least t that counts: 0.
    Least,
    /// The greatest t that counts: the greatest finite number.
    Most,
}

/// Where the answer is found once a run is over.
#[derive(Debug, Clone)]
pub(crate) struct ProgramAnswer {
    /// Whether there is a hit, where the routine says so itself.
    pub found: Option<Slot>,
    /// The number of roots, where the routine says so.
    pub count: Option<Slot>,
    /// One root or two.
    pub roots: Vec<Slot>,
    /// Whether what was returned is a constant: no hit.
    pub constant: Option<u16>,
    /// What tells no hit.
    pub no_hit: NoHit,
}
