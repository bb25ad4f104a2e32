//! The derivation of a routine: its own lines, in the order in which they ran, with this ray's numbers.
//!
//! The program runs over numbers that keep record; exact values follow the branches that the rounded ones took.

use std::collections::HashMap;
use std::marker::PhantomData;

use super::build::Steps;
use super::{Measured, Quantity, TraceStep};
use crate::geometry::{Ray, Sphere};
use crate::method::ball::LARGEST_SURD;
use crate::method::format::Shortest;
use crate::method::number::Input;
use crate::method::tape::{Float, Tape, Traced};
use crate::method::{Precision, RoutineId, Truth};
use crate::number::Number as _;
use crate::routine::{Arithmetic, Listener, Noted, Program, Real, Returned, Runner, Told};
use crate::text::Glyphs;

/// How many steps are shown of a routine that loops.
const MOST_STEPS: usize = 200;

/// Numbers that keep record.
struct Recorded<'t>(PhantomData<&'t Tape>);

impl<'t> Arithmetic for Recorded<'t> {
    type Single = Traced<'t, f32>;
    type Double = Traced<'t, f64>;

    fn widen(x: Self::Single) -> Self::Double {
        x.as_wide()
    }

    fn narrow(x: Self::Double) -> Self::Single {
        x.narrowed()
    }
}

impl<F: Float + Real> Real for Traced<'_, F> {
    fn mul_add(self, factor: Self, term: Self) -> Self {
        crate::method::number::Scalar::mul_add(self, factor, term)
    }
    fn abs(self) -> Self {
        if self.value() < F::of(0.0) {
            -self
        } else {
            self.with(Real::abs(self.value()))
        }
    }
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }
    fn floor(self) -> Self {
        self.whole(Real::floor(self.value()))
    }
    fn ceil(self) -> Self {
        self.whole(Real::ceil(self.value()))
    }
    fn trunc(self) -> Self {
        self.whole(Real::trunc(self.value()))
    }
    fn round(self) -> Self {
        self.whole(Real::round(self.value()))
    }
    fn sign(self) -> Self {
        Self::of(Real::sign(self.value()).into())
    }
    fn to_f64(self) -> f64 {
        self.value().into()
    }
}

/// The steps of a routine.
pub(in crate::method) fn steps(
    id: RoutineId,
    ray: &Ray,
    sphere: &Sphere,
    _: &Truth,
) -> Vec<TraceStep> {
    let routine = id.get();
    let program = &routine.program;
    let tape = Tape::up_to(LARGEST_SURD);
    let input = Input::new(ray, sphere, |x| tape.input(x));
    let mut scribe = Scribe {
        program,
        steps: Steps::new(&tape, &input),
        list: Vec::new(),
        texts: HashMap::new(),
    };
    scribe.name_parameters(&input);
    let mut machine = Runner::<Recorded<'_>, 1>::new(program);
    for &(what, slot) in program.inputs() {
        let value = what.of(input.p0, input.d, input.center, input.r);
        machine.give(slot, 0, value);
    }
    machine.run(program, 1, &mut scribe);
    scribe.list
}

/// Writes down what it hears.
struct Scribe<'a, 't> {
    program: &'a Program,
    steps: Steps<'t>,
    list: Vec<TraceStep>,
    /// What each name of a function means just now.
    texts: HashMap<(Option<String>, String), String>,
}

impl<'t> Scribe<'_, 't> {
    fn name_parameters(&mut self, input: &Input<Traced<'t, f32>>) {
        let mut by_name: HashMap<&str, Vec<Traced<'t, f32>>> = HashMap::new();
        let vector = |v: [Traced<'t, f32>; 3]| v.to_vec();
        for (name, role) in self.program.roles() {
            let value = match role {
                "origin" => vector(input.p0),
                "direction" => vector(input.d),
                "center" => vector(input.center),
                "radius" => vec![input.r],
                "sphere" => [vector(input.center), vec![input.r]].concat(),
                _ => continue,
            };
            by_name.insert(name, value);
        }
        for (name, value) in by_name {
            let texts: Vec<String> = value.iter().map(|x| text(*x)).collect();
            self.keep(None, name, &texts);
            for (axis, component) in ["x", "y", "z", "w"].into_iter().zip(&value) {
                let named = if value.len() == 1 {
                    name.to_owned()
                } else {
                    format!("{name}.{axis}")
                };
                self.steps.rename(&named, *component);
            }
        }
    }

    fn keep(&mut self, function: Option<&str>, name: &str, texts: &[String]) {
        let mut insert = |name: String, text: String| {
            self.texts.insert((function.map(str::to_owned), name), text);
        };
        match texts {
            [one] => insert(name.to_owned(), one.clone()),
            many => {
                insert(name.to_owned(), format!("({})", many.join(", ")));
                if let [x, y, z, _] = many {
                    insert(format!("{name}.xyz"), format!("({x}, {y}, {z})"));
                }
                let axes = ["x", "y", "z", "w"].into_iter().chain(["r", "g", "b", "a"]);
                for (axis, text) in axes.zip(many.iter().chain(many)) {
                    insert(format!("{name}.{axis}"), text.clone());
                }
            }
        }
    }

    /// The expression with numbers in place of names.
    fn filled(&self, function: Option<&str>, formula: &str) -> String {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut out = String::new();
        let mut rest = formula;
        while let Some(first) = rest.chars().next() {
            if !is_part(first) {
                out.push(first);
                rest = &rest[first.len_utf8()..];
                continue;
            }
            // A number may have a dot and an exponent; a name may have members.
            let end = rest
                .find(|c: char| !is_part(c) && c != '.')
                .unwrap_or(rest.len());
            let (word, after) = rest.split_at(end);
            let called = after.trim_start().starts_with('(');
            let known = (!first.is_ascii_digit() && !called)
                .then(|| self.lookup(function, word))
                .flatten();
            match known {
                Some(number) if number.starts_with('−') => out = out + "(" + number + ")",
                Some(number) => out += number,
                None => out += word,
            }
            rest = after;
        }
        out
    }

    fn lookup(&self, function: Option<&str>, word: &str) -> Option<&str> {
        let get = |name: &str| {
            self.texts
                .get(&(function.map(str::to_owned), name.to_owned()))
        };
        // A parameter in a structure is known by its own name.
        let member = || word.split_once('.').and_then(|(_, member)| get(member));
        get(word).or_else(member).map(String::as_str)
    }
}

impl<'t> Listener<Recorded<'t>> for Scribe<'_, 't> {
    const LISTENS: bool = true;

    fn hear(&mut self, noted: Noted<'_, Recorded<'t>>) {
        if self.list.len() >= MOST_STEPS {
            return;
        }
        let note = noted.note;
        let function = note.function.as_deref();
        let numbers = self.filled(function, &note.formula);
        let mut losses = Vec::new();
        let mut parts = Vec::new();
        let mut other = None;
        for value in &noted.values {
            match *value {
                Told::Single(x) => {
                    losses.extend(self.steps.losses(&[x]));
                    parts.push(measured(x));
                }
                Told::Double(x) => {
                    losses.extend(self.steps.losses(&[x]));
                    parts.push(measured(x));
                }
                Told::Bool(x) => other = Some(Quantity::Whether(x)),
                Told::Whole(x) => other = Some(Quantity::Count(x)),
            }
        }
        let texts: Vec<String> = parts
            .iter()
            .map(|part| part.shortest(Glyphs::Unicode).to_string())
            .collect();
        if let Some(name) = &note.name {
            if !texts.is_empty() {
                self.keep(function, name, &texts);
            }
            for (i, value) in noted.values.iter().enumerate() {
                let axis = ["x", "y", "z", "w"].get(i).copied().unwrap_or("");
                let named = if noted.values.len() == 1 {
                    name.clone()
                } else {
                    format!("{name}.{axis}")
                };
                match *value {
                    Told::Single(x) => self.steps.rename(&named, x),
                    Told::Double(x) => self.steps.rename(&named, x),
                    _ => {}
                }
            }
        }
        let result = match (other, parts.len()) {
            (Some(other), 0) => other,
            (_, 1) => Quantity::Scalar(parts.remove(0)),
            _ => Quantity::Vector(parts.into()),
        };
        losses.sort_by_key(|loss| std::cmp::Reverse((loss.is_heavy(), loss.bits())));
        let (code, comment) = self.program.line(note.line);
        let symbol = match (&note.name, note.returned) {
            (Some(name), _) => name.clone(),
            (None, Returned::Asked) => "if".to_owned(),
            (None, _) => "return".to_owned(),
        };
        let place = match function {
            Some(function) => format!("line {}, in {function}", note.line),
            None => format!("line {}", note.line),
        };
        let why = if comment.is_empty() {
            place
        } else {
            format!("{place}: {comment}")
        };
        self.list.push(TraceStep {
            symbol: symbol.into(),
            formula: note.formula.clone().into(),
            numbers,
            result,
            why: why.into(),
            code: code.to_owned().into(),
            losses,
        });
    }
}

fn measured<F: Float>(value: Traced<'_, F>) -> Measured {
    Measured {
        value: value.value().into(),
        precision: F::PRECISION,
        exact: value.exact(),
    }
}

fn text(value: Traced<'_, f32>) -> String {
    Shortest {
        value: value.value().into(),
        precision: Precision::Binary32,
        glyphs: Glyphs::Unicode,
    }
    .to_string()
}
