//! From the reader's representation to a program over single numbers: vectors and structures taken apart,
//! helper functions put in where they are called, operations in the order of the statements.

mod build;
mod expression;
mod function;
mod prune;

use naga::{AddressSpace, Handle, Type};

use super::RoutineError;
use super::front::ParsedModule;
use super::guard::RoutineSource;
use super::program::{Program, ProgramAnswer, ProgramInput, Slot, SlotKind};
use super::role::ParameterRole;
use super::signature::{self, AnswerKind, LeafShape, NoHit, RoutineCandidate, Signature};
use build::{Builder, CompiledValue, Constancy};
use function::{Argument, Variable};

/// The most operations that a run may cost, over all loops.
pub(super) const MOST_OPERATIONS: u32 = 10_000;

/// Compiles the routine of a module.
pub(super) fn compile(
    source: &RoutineSource,
    parsed: &ParsedModule,
    contract: bool,
) -> Result<Program, RoutineError> {
    let candidate = signature::choose(source, &parsed.module)?;
    let mut builder = Builder::new(source, parsed, contract);
    globals(&mut builder)?;
    let mut inputs = Vec::new();
    let arguments = arguments(&mut builder, &candidate, &mut inputs)?;
    let result = builder.call(candidate.function, &arguments, true)?;
    let answer = answer(&mut builder, &candidate, &arguments, result.as_ref());
    let signature = Signature {
        name: candidate.name.clone(),
        answers: candidate.answers,
        parameters: parameters(&candidate),
    };
    Ok(builder.finish(inputs, answer, signature))
}

/// Global variables get their first values again for each ray.
fn globals(builder: &mut Builder<'_>) -> Result<(), RoutineError> {
    let module = &builder.parsed.module;
    for (handle, global) in module.global_variables.iter() {
        let name = global.name.as_deref().unwrap_or("");
        // The reader declares what shaders have built in, used or not.
        if name.starts_with("gl_") {
            continue;
        }
        if global.space != AddressSpace::Private {
            let at = module.global_variables.get_span(handle).to_range();
            let problem =
                format!("{name} comes from outside, and a routine gets only a ray and a sphere");
            return Err(builder
                .source
                .error(at.map_or(0, |range| range.start), problem));
        }
        let slots = builder.fresh_of(global.ty)?;
        let variable = builder.variable(slots, true);
        if let Some(init) = global.init {
            let value = builder.global_value(init)?;
            builder.put(variable, 0, &value);
        }
        builder.globals.insert(handle, variable);
    }
    Ok(())
}

/// The parameters as values and variables, and which number of the question goes where.
fn arguments(
    builder: &mut Builder<'_>,
    candidate: &RoutineCandidate,
    inputs: &mut Vec<(ProgramInput, Slot)>,
) -> Result<Vec<Argument>, RoutineError> {
    let module = &builder.parsed.module;
    let function = &module.functions[candidate.function];
    let mut arguments = Vec::new();
    for ((argument, parts), out) in function
        .arguments
        .iter()
        .zip(&candidate.given)
        .zip(&candidate.out)
    {
        let ty = base(module, argument.ty);
        let slots = builder.fresh_of(ty)?;
        if *out {
            let variable = builder.variable(slots, true);
            arguments.push(Argument::Variable(Variable::whole(builder, variable)));
            continue;
        }
        let mut at = 0;
        for (leaf, role) in parts {
            let count = match leaf.shape {
                LeafShape::Real(n) => usize::from(n),
                LeafShape::Bool | LeafShape::Int => 1,
            };
            if let Some(role) = role {
                for (axis, slot) in slots[at..at + count].iter().enumerate() {
                    inputs.extend(input(*role, axis as u8).map(|input| (input, *slot)));
                }
            }
            at += count;
        }
        arguments.push(Argument::CompiledValue(CompiledValue {
            slots,
            constancy: Constancy::Never,
            of: None,
        }));
    }
    Ok(arguments)
}

pub(super) fn base(module: &naga::Module, ty: Handle<Type>) -> Handle<Type> {
    match module.types[ty].inner {
        naga::TypeInner::Pointer { base, .. } => base,
        _ => ty,
    }
}

fn input(role: ParameterRole, axis: u8) -> Option<ProgramInput> {
    Some(match role {
        ParameterRole::Origin => ProgramInput::Origin(axis),
        ParameterRole::FromCenter => ProgramInput::FromCenter(axis),
        ParameterRole::Direction => ProgramInput::Direction(axis),
        ParameterRole::Radius => ProgramInput::Radius,
        ParameterRole::RadiusSquared => ProgramInput::RadiusSquared,
        ParameterRole::Sphere if axis == 3 => ProgramInput::Radius,
        ParameterRole::Center | ParameterRole::Sphere => ProgramInput::Center(axis),
        ParameterRole::Least => ProgramInput::Least,
        ParameterRole::Most => ProgramInput::Most,
        ParameterRole::Near | ParameterRole::Far | ParameterRole::Other => return None,
    })
}

fn parameters(candidate: &RoutineCandidate) -> Vec<(String, ParameterRole)> {
    let mut roots = [ParameterRole::Near, ParameterRole::Far].into_iter();
    let parts = candidate.given.iter().flatten();
    parts
        .map(|(leaf, role)| {
            let role = role.unwrap_or_else(|| match leaf.shape {
                LeafShape::Real(1) => roots.next().unwrap_or(ParameterRole::Other),
                _ => ParameterRole::Other,
            });
            (leaf.name.clone(), role)
        })
        .collect()
}

/// Where the answer lies.
fn answer(
    builder: &mut Builder<'_>,
    candidate: &RoutineCandidate,
    arguments: &[Argument],
    result: Option<&CompiledValue>,
) -> ProgramAnswer {
    let mut answer = ProgramAnswer {
        found: None,
        count: None,
        roots: Vec::new(),
        constant: None,
        no_hit: NoHit::Nothing,
    };
    let mut take = |shape: LeafShape, slots: &[Slot]| match shape {
        LeafShape::Bool => answer.found = answer.found.or(Some(slots[0])),
        LeafShape::Int => answer.count = answer.count.or(Some(slots[0])),
        LeafShape::Real(1 | 2) => answer.roots.extend(slots),
        LeafShape::Real(_) => {}
    };
    if let Some(result) = result {
        let mut at = 0;
        for leaf in &candidate.result {
            let count = width(leaf.shape);
            take(leaf.shape, &result.slots[at..at + count]);
            at += count;
        }
    }
    for (argument, parts) in arguments.iter().zip(&candidate.given) {
        let Argument::Variable(variable) = argument else {
            continue;
        };
        let mut at = 0;
        for (leaf, _) in parts {
            let count = width(leaf.shape);
            if leaf.shape != LeafShape::Bool || answer_has_no_bool(candidate) {
                take(leaf.shape, &variable.slots(builder)[at..at + count]);
            }
            at += count;
        }
    }
    answer.roots.truncate(2);
    let negative = builder.source.said("no hit").is_some_and(|(_, said)| {
        said.contains("< 0") || said.contains("negative") || said.contains("below 0")
    });
    answer.no_hit = match (&answer, result.map(|value| value.constancy)) {
        (ProgramAnswer { found: Some(_), .. } | ProgramAnswer { count: Some(_), .. }, _) => {
            NoHit::Said
        }
        _ if negative => NoHit::Negative,
        (_, Some(Constancy::Flag(flag))) => {
            answer.constant = Some(flag);
            NoHit::Constant
        }
        _ => NoHit::Nothing,
    };
    if candidate.answers == AnswerKind::Visible {
        answer.roots.truncate(1);
    }
    answer
}

fn answer_has_no_bool(candidate: &RoutineCandidate) -> bool {
    !candidate
        .result
        .iter()
        .any(|leaf| leaf.shape == LeafShape::Bool)
}

const fn width(shape: LeafShape) -> usize {
    match shape {
        LeafShape::Real(n) => n as usize,
        LeafShape::Bool | LeafShape::Int => 1,
    }
}

impl Slot {
    pub(super) const fn new(kind: SlotKind, at: u16) -> Self {
        Self { kind, at }
    }
}
