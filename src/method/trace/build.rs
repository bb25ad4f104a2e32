//! Collects the steps of a traced run: names quantities, puts numbers into formulas, and assigns
//! each recorded operation to the step that it belongs to.

use std::collections::HashMap;

use super::loss::{self, Loss};
use super::{Measured, Quantity, TraceStep};
use crate::method::Precision;
use crate::method::format::Shortest;
use crate::method::number::Input;
use crate::method::surd::Surd;
use crate::method::tape::{Float, Operand, Operation, Tape, Traced};
use crate::text::Glyphs;

/// What a step says of itself, the numbers apart.
#[derive(Debug, Clone, Copy)]
pub(in crate::method) struct StepText {
    /// What the result is called.
    pub symbol: &'static str,
    /// How it is computed.
    pub formula: &'static str,
    /// The formula with `{symbol}` where a number goes; `{o.x}` is a component.
    pub template: &'static str,
    /// The line of the method's source that does it.
    pub code: &'static str,
    /// One sentence on what it is for.
    pub why: &'static str,
}

/// The steps so far.
pub(in crate::method) struct Steps<'t> {
    tape: &'t Tape,
    list: Vec<TraceStep>,
    /// What each named quantity puts into a template.
    texts: HashMap<String, String>,
    /// The named quantities on the tape.
    names: HashMap<usize, String>,
}

/// From the centre to where the ray starts.
pub(in crate::method) const O: StepText = StepText {
    symbol: "o",
    formula: "p0 − c",
    template: "{p0} − {c}",
    code: "let o = sub(p0, center);",
    why: "Where the ray starts, seen from the centre.",
};

/// A.
pub(in crate::method) const A: StepText = StepText {
    symbol: "A",
    formula: "d·d",
    template: "{d.x}² + {d.y}² + {d.z}²",
    code: "let a = dot(d, d);",
    why: "What multiplies t²: the length of d, squared.",
};

/// b = B/2.
pub(in crate::method) const HALF_B: StepText = StepText {
    symbol: "b",
    formula: "d·o",
    template: "{d.x}·{o.x} + {d.y}·{o.y} + {d.z}·{o.z}",
    code: "let b = dot(d, o);",
    why: "Half of B: below 0 if the ray comes nearer to the centre as it starts.",
};

/// |o|².
pub(in crate::method) const OO: StepText = StepText {
    symbol: "|o|²",
    formula: "o·o",
    template: "{o.x}² + {o.y}² + {o.z}²",
    code: "let oo = dot(o, o);",
    why: "How far the ray starts from the centre, squared.",
};

/// r².
pub(in crate::method) const RR: StepText = StepText {
    symbol: "r²",
    formula: "r·r",
    template: "{r}²",
    code: "let rr = r * r;",
    why: "The radius, squared.",
};

/// C.
pub(in crate::method) const C: StepText = StepText {
    symbol: "C",
    formula: "|o|² − r²",
    template: "{|o|²} − {r²}",
    code: "let c = oo - rr;",
    why: "What is left without t: below 0 if the ray starts inside, 0 if on the surface.",
};

/// b².
pub(in crate::method) const BB: StepText = StepText {
    symbol: "b²",
    formula: "b·b",
    template: "{b}²",
    code: "let bb = k.b * k.b;",
    why: "The first half of the discriminant.",
};

const AXES: [&str; 3] = ["x", "y", "z"];

impl<'t> Steps<'t> {
    /// No step yet; the inputs have their names.
    pub fn new<F: Float>(tape: &'t Tape, input: &Input<Traced<'t, F>>) -> Self {
        let mut steps = Self {
            tape,
            list: Vec::new(),
            texts: HashMap::new(),
            names: HashMap::new(),
        };
        steps.name_vector("p0", input.p0, input_text);
        steps.name_vector("d", input.d, input_text);
        steps.name_vector("c", input.center, input_text);
        steps.name("r", input.r, input_text);
        steps
    }

    /// The steps in order.
    pub fn finish(self) -> Vec<TraceStep> {
        self.list
    }

    /// A step that gives a number.
    pub fn scalar<F: Float>(&mut self, line: StepText, value: Traced<'t, F>) {
        let losses = self.losses(&[value]);
        self.name(line.symbol, value, text);
        self.push(line, Quantity::Scalar(measured(value)), losses);
    }

    /// A step that gives a vector.
    pub fn vector<F: Float>(&mut self, line: StepText, value: [Traced<'t, F>; 3]) {
        let losses = self.losses(&value);
        self.name_vector(line.symbol, value, text);
        self.push(
            line,
            Quantity::Vector(Box::new(value.map(measured))),
            losses,
        );
    }

    /// A step that gives a root. The exact value is that of the root itself, whatever branch the
    /// rounded numbers took.
    pub fn root<F: Float>(&mut self, line: StepText, value: Traced<'t, F>, exact: Option<Surd>) {
        let losses = self.losses(&[value]);
        self.name(line.symbol, value, text);
        let root = Measured {
            exact,
            ..measured(value)
        };
        self.push(line, Quantity::Scalar(root), losses);
    }

    /// A step that gives a binary32 which no operation of the record made: a root that was rounded, or
    /// what was assumed.
    pub fn stated(&mut self, line: StepText, value: f32, exact: Option<Surd>) {
        let number = Measured {
            value: value.into(),
            precision: Precision::Binary32,
            exact,
        };
        self.push(line, Quantity::Scalar(number), Vec::new());
    }

    fn push(&mut self, line: StepText, result: Quantity, losses: Vec<Loss>) {
        self.list.push(TraceStep {
            symbol: line.symbol.into(),
            formula: line.formula.into(),
            numbers: self.fill(line.template),
            result,
            why: line.why.into(),
            code: line.code.into(),
            losses,
        });
    }

    fn name<F: Float>(
        &mut self,
        symbol: &str,
        value: Traced<'t, F>,
        text: impl Fn(Traced<'t, F>) -> String,
    ) {
        self.texts.insert(symbol.to_owned(), text(value));
        if let Operand::Entry(entry) = value.operand() {
            self.names.insert(entry, symbol.to_owned());
        }
    }

    fn name_vector<F: Float>(
        &mut self,
        symbol: &str,
        value: [Traced<'t, F>; 3],
        text: impl Fn(Traced<'t, F>) -> String,
    ) {
        let [x, y, z] = value.map(&text);
        self.texts
            .insert(symbol.to_owned(), format!("({x}, {y}, {z})"));
        for (axis, component) in AXES.into_iter().zip(value) {
            self.name(&format!("{symbol}.{axis}"), component, &text);
        }
    }

    /// The template with numbers in their places, negative ones in parentheses.
    fn fill(&self, template: &str) -> String {
        let mut filled = String::new();
        let mut rest = template;
        while let Some((before, slot)) = rest.split_once('{') {
            let (symbol, after) = slot.split_once('}').unwrap_or((slot, ""));
            let number = self.texts.get(symbol).map_or("?", String::as_str);
            filled += before;
            if number.starts_with('−') {
                filled = filled + "(" + number + ")";
            } else {
                filled += number;
            }
            rest = after;
        }
        filled + rest
    }

    #[cfg(feature = "routine")]
    /// Gives a number a name by which losses speak of it.
    pub fn rename<F: Float>(&mut self, name: &str, value: Traced<'t, F>) {
        if let Operand::Entry(entry) = value.operand() {
            self.names.insert(entry, name.to_owned());
        }
    }

    /// What was lost on the way from quantities that have a name to these, the worst first.
    pub fn losses<F: Float>(&self, values: &[Traced<'t, F>]) -> Vec<Loss> {
        let mut found = Vec::new();
        let mut open: Vec<Operand> = values.iter().map(|v| v.operand()).collect();
        let mut seen = Vec::new();
        while let Some(operand) = open.pop() {
            let Operand::Entry(place) = operand else {
                continue;
            };
            if self.names.contains_key(&place) || seen.contains(&place) {
                continue;
            }
            seen.push(place);
            let Some(entry) = self.tape.get(place) else {
                continue;
            };
            let operands: Vec<_> = entry
                .operands
                .iter()
                .map(|o| match entry.operation {
                    Some(Operation::MulAdd) => self.signless_operand::<F>(*o),
                    _ => self.operand::<F>(*o),
                })
                .collect();
            found.extend(loss::of(&entry, &operands, F::PRECISION));
            open.extend(entry.operands);
        }
        found.sort_by_key(|loss| std::cmp::Reverse((loss.is_heavy(), loss.bits())));
        found
    }

    /// An operand of a fused operation, which has no difference and negates what it takes away: that
    /// goes by the name that it has without the sign.
    fn signless_operand<F: Float>(&self, operand: Operand) -> loss::LossOperand {
        let plain = self.operand::<F>(operand);
        let negated = match operand {
            Operand::Entry(place) => self.tape.get(place),
            Operand::Constant(_) => None,
        };
        match negated {
            Some(entry) if entry.operation == Some(Operation::Neg) => loss::LossOperand {
                value: plain.value,
                ..self.operand::<F>(entry.operands[0])
            },
            _ => plain,
        }
    }

    fn operand<F: Float>(&self, operand: Operand) -> loss::LossOperand {
        let (value, exact, name) = match operand {
            Operand::Constant(value) => (value, true, None),
            Operand::Entry(place) => {
                let entry = self.tape.get(place);
                let value = entry.as_ref().map_or(f64::NAN, |e| e.value);
                let exact = entry.and_then(|e| e.exact?.told());
                let exact = exact.is_some_and(|exact| exact.ulps(value, F::PRECISION) == 0.0);
                (value, exact, self.names.get(&place))
            }
        };
        loss::LossOperand {
            label: name.cloned().unwrap_or_else(|| number::<F>(value)),
            named: name.is_some(),
            value,
            exact,
        }
    }
}

fn measured<F: Float>(value: Traced<'_, F>) -> Measured {
    Measured {
        value: value.value().into(),
        precision: F::PRECISION,
        exact: value.exact(),
    }
}

/// An input is a binary32, whatever the method computes with.
fn input_text<F: Float>(value: Traced<'_, F>) -> String {
    number::<f32>(value.value().into())
}

fn text<F: Float>(value: Traced<'_, F>) -> String {
    number::<F>(value.value().into())
}

fn number<F: Float>(value: f64) -> String {
    let (precision, glyphs) = (F::PRECISION, Glyphs::Unicode);
    Shortest {
        value,
        precision,
        glyphs,
    }
    .to_string()
}
