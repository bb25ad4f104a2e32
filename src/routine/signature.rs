//! Which function of a text is the routine, what its parameters are for, and what it answers.

use naga::{
    AddressSpace, Function, Handle, Module, Scalar, ScalarKind, Span, Type, TypeInner, VectorSize,
};

use super::RoutineError;
use super::guard::RoutineSource;
use super::role::ParameterRole;

/// What a routine answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AnswerKind {
    /// Both roots.
    Roots,
    /// One t, the visible root.
    Visible,
    /// Whether there is a hit.
    Whether,
}

impl AnswerKind {
    /// In words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Roots => "both roots",
            Self::Visible => "one t",
            Self::Whether => "hit or miss",
        }
    }
}

/// What tells that there is no hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NoHit {
    /// The routine says so by true and false, or by the number of roots.
    Said,
    /// A `return` that gives a constant.
    Constant,
    /// A t below 0, as a comment line says.
    Negative,
    /// Nothing: every run gives roots.
    Nothing,
}

impl NoHit {
    /// In words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Said => "it says itself whether it hits",
            Self::Constant => "a constant is no hit",
            Self::Negative => "a t below 0 is no hit",
            Self::Nothing => "it never says that it misses",
        }
    }
}

/// The routine's face.
#[derive(Debug, Clone)]
pub(crate) struct Signature {
    pub name: String,
    pub answers: AnswerKind,
    /// Each number or vector that goes in or out, by name.
    pub parameters: Vec<(String, ParameterRole)>,
}

/// A part of a parameter or a result that is a number or a vector.
#[derive(Debug, Clone)]
pub(super) struct Leaf {
    /// Its own name, without that of the structure it lies in.
    pub name: String,
    pub shape: LeafShape,
}

/// Of which shape it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LeafShape {
    Real(u8),
    Bool,
    Int,
}

/// A function that could be the routine.
#[derive(Debug, Clone)]
pub(super) struct RoutineCandidate {
    pub function: Handle<Function>,
    pub name: String,
    /// Roles of what goes in, part by part and parameter by parameter.
    pub given: Vec<Vec<(Leaf, Option<ParameterRole>)>>,
    /// Which of the parameters are written to.
    pub out: Vec<bool>,
    pub result: Vec<Leaf>,
    pub answers: AnswerKind,
    span: Span,
}

/// Chooses the routine.
pub(super) fn choose(
    source: &RoutineSource,
    module: &Module,
) -> Result<RoutineCandidate, RoutineError> {
    let named = source.said("routine");
    let mut found: Vec<Result<RoutineCandidate, RoutineError>> = Vec::new();
    for (function, body) in module.functions.iter() {
        let name = body.name.as_deref().unwrap_or("");
        let asked = named.map(|(_, name)| name);
        if name == "main" && body.arguments.is_empty() || asked.is_some_and(|asked| asked != name) {
            continue;
        }
        let span = module.functions.get_span(function);
        found.push(candidate(source, module, function, span));
    }
    if let (Some((line, name)), true) = (named, found.is_empty()) {
        return Err(RoutineError {
            line,
            column: 1,
            problem: format!("there is no function {name}"),
        });
    }
    let fitting: Vec<&RoutineCandidate> = found.iter().flatten().collect();
    // A helper may look like a routine; the routine is not called by another.
    let calls = |caller: &RoutineCandidate, called: Handle<Function>| {
        calls(&module.functions[caller.function].body, called)
    };
    let tops: Vec<&&RoutineCandidate> = fitting
        .iter()
        .filter(|one| !fitting.iter().any(|other| calls(other, one.function)))
        .collect();
    match tops[..] {
        [one] => Ok((**one).clone()),
        [] => match found.into_iter().rev().find_map(Result::err) {
            Some(error) => Err(error),
            None => Err(source.error(
                0,
                "there is no function; a routine is one such as vec2 f(vec3 origin, vec3 direction, vec3 center, float radius)",
            )),
        },
        [one, other, ..] => {
            let at = other.span.to_range().map_or(0, |range| range.start);
            Err(source.error(
                at,
                format!(
                    "{} and {} could both be the routine; a comment line says which: // routine: {}",
                    one.name, other.name, other.name
                ),
            ))
        }
    }
}

fn calls(block: &naga::Block, called: Handle<Function>) -> bool {
    use naga::Statement as S;
    block.iter().any(|statement| match statement {
        S::Call { function, .. } => *function == called,
        S::Block(inner) => calls(inner, called),
        S::If { accept, reject, .. } => calls(accept, called) || calls(reject, called),
        S::Loop {
            body, continuing, ..
        } => calls(body, called) || calls(continuing, called),
        S::Switch { cases, .. } => cases.iter().any(|case| calls(&case.body, called)),
        _ => false,
    })
}

fn candidate(
    source: &RoutineSource,
    module: &Module,
    handle: Handle<Function>,
    span: Span,
) -> Result<RoutineCandidate, RoutineError> {
    let function = &module.functions[handle];
    let name = function.name.clone().unwrap_or_default();
    let at = function_place(source, &name, span);
    let refuse = |problem: String| source.error(at, problem);
    let mut leaves = Vec::new();
    let mut out = Vec::new();
    for argument in &function.arguments {
        let (ty, pointer) = match module.types[argument.ty].inner {
            TypeInner::Pointer {
                base,
                space: AddressSpace::Function,
            } => (base, true),
            _ => (argument.ty, false),
        };
        let mut parts = Vec::new();
        let own = argument.name.as_deref().unwrap_or("");
        flatten(module, ty, own, &mut parts, 0)
            .map_err(|kind| refuse(format!("{name} takes {kind}, which no ray or sphere has")))?;
        leaves.push(parts);
        out.push(pointer);
    }
    let mut result = Vec::new();
    if let Some(given) = &function.result {
        flatten(module, given.ty, "", &mut result, 0).map_err(|kind| {
            refuse(format!(
                "{name} gives {kind}; a routine gives float, vec2, bool, or a struct of them"
            ))
        })?;
    }
    let given = roles(source, &name, at, &leaves, &out)?;
    let outs: Vec<&Leaf> = given
        .iter()
        .zip(&out)
        .filter(|(_, out)| **out)
        .flat_map(|(parts, _)| parts.iter().map(|(leaf, _)| leaf))
        .collect();
    let answers = answers(&result, &outs).ok_or_else(|| {
        refuse(format!(
            "{name} gives no t and no bool; a routine gives float, vec2, bool, or a struct of them, or writes out parameters"
        ))
    })?;
    Ok(RoutineCandidate {
        function: handle,
        name,
        given,
        out,
        result,
        answers,
        span,
    })
}

/// Where the function is written: the reader gives whole functions no place.
fn function_place(source: &RoutineSource, name: &str, span: Span) -> usize {
    if let Some(range) = span.to_range().filter(|_| span.is_defined()) {
        return range.start;
    }
    source.code.find(&format!("{name}(")).unwrap_or(0)
}

fn answers(result: &[Leaf], outs: &[&Leaf]) -> Option<AnswerKind> {
    let reals = |leaf: &Leaf| match leaf.shape {
        LeafShape::Real(1) => 1,
        LeafShape::Real(2) => 2,
        _ => 0,
    };
    let count: u32 =
        result.iter().map(reals).sum::<u32>() + outs.iter().map(|leaf| reals(leaf)).sum::<u32>();
    let says = result
        .iter()
        .any(|leaf| matches!(leaf.shape, LeafShape::Bool | LeafShape::Int));
    match count {
        0 if result.iter().any(|leaf| leaf.shape == LeafShape::Bool) => Some(AnswerKind::Whether),
        0 => None,
        1 if !result.is_empty() => Some(AnswerKind::Visible),
        _ if !result.is_empty() || says => Some(AnswerKind::Roots),
        _ => None,
    }
}

/// The parts of a type that are numbers or vectors; of which kind it is if it has others.
fn flatten(
    module: &Module,
    ty: Handle<Type>,
    name: &str,
    out: &mut Vec<Leaf>,
    depth: usize,
) -> Result<(), String> {
    let real = |scalar: Scalar| scalar.kind == ScalarKind::Float && matches!(scalar.width, 4 | 8);
    let shape = match &module.types[ty].inner {
        TypeInner::Scalar(scalar) if real(*scalar) => LeafShape::Real(1),
        TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Bool => LeafShape::Bool,
        TypeInner::Scalar(_) => LeafShape::Int,
        TypeInner::Vector { size, scalar } if real(*scalar) => LeafShape::Real(match size {
            VectorSize::Bi => 2,
            VectorSize::Tri => 3,
            VectorSize::Quad => 4,
        }),
        TypeInner::Struct { members, .. } if depth < 4 => {
            for member in members {
                flatten(
                    module,
                    member.ty,
                    member.name.as_deref().unwrap_or(""),
                    out,
                    depth + 1,
                )?;
            }
            return Ok(());
        }
        TypeInner::Matrix { .. } => return Err("a matrix".to_owned()),
        _ => return Err("something".to_owned()),
    };
    if out.len() > 16 {
        return Err("too much".to_owned());
    }
    out.push(Leaf {
        name: name.to_owned(),
        shape,
    });
    Ok(())
}

type Roles = Vec<Vec<(Leaf, Option<ParameterRole>)>>;

/// What each part is for.
fn roles(
    source: &RoutineSource,
    function: &str,
    at: usize,
    leaves: &[Vec<Leaf>],
    out: &[bool],
) -> Result<Roles, RoutineError> {
    let ins: Vec<&Leaf> = leaves
        .iter()
        .zip(out)
        .filter(|(_, out)| !**out)
        .flat_map(|(parts, _)| parts)
        .collect();
    let chosen = match source.said("roles") {
        Some((line, said)) => said_roles(line, said, &ins)?,
        None => usual_roles(&ins)
            .map_err(|problem| source.error(at, format!("{function}: {problem}")))?,
    };
    let mut chosen = chosen.into_iter();
    Ok(leaves
        .iter()
        .zip(out)
        .map(|(parts, out)| {
            let role = |leaf: &Leaf| (leaf.clone(), if *out { None } else { chosen.next() });
            parts.iter().map(role).collect()
        })
        .collect())
}

fn said_roles(line: usize, said: &str, ins: &[&Leaf]) -> Result<Vec<ParameterRole>, RoutineError> {
    let refuse = |problem: String| RoutineError {
        line,
        column: 1,
        problem,
    };
    let mut roles = Vec::new();
    for word in said.split(',') {
        let role = ParameterRole::said(word).ok_or_else(|| {
            refuse(format!(
                "{} is not a role; the roles are origin, direction, center, radius, radius squared, sphere, least t, greatest t",
                word.trim()
            ))
        })?;
        roles.push(role);
    }
    if roles.len() != ins.len() {
        return Err(refuse(format!(
            "{} roles for {} parameters",
            roles.len(),
            ins.len()
        )));
    }
    for (role, leaf) in roles.iter().zip(ins) {
        let wanted = match role {
            ParameterRole::Origin
            | ParameterRole::FromCenter
            | ParameterRole::Direction
            | ParameterRole::Center => 3,
            ParameterRole::Sphere => 4,
            _ => 1,
        };
        if leaf.shape != LeafShape::Real(wanted) {
            return Err(refuse(format!(
                "{} can't be the {}",
                leaf.name,
                role.name()
            )));
        }
    }
    complete(roles).map_err(refuse)
}

/// By the order in which people write them, which the names must not contradict.
fn usual_roles(ins: &[&Leaf]) -> Result<Vec<ParameterRole>, String> {
    let vectors: Vec<&&Leaf> = ins
        .iter()
        .filter(|leaf| leaf.shape == LeafShape::Real(3))
        .collect();
    let has_sphere = ins.iter().any(|leaf| leaf.shape == LeafShape::Real(4));
    let orders: &[&[ParameterRole]] = match (vectors.len(), has_sphere) {
        (3, false) => &[
            &[
                ParameterRole::Origin,
                ParameterRole::Direction,
                ParameterRole::Center,
            ],
            &[
                ParameterRole::Center,
                ParameterRole::Origin,
                ParameterRole::Direction,
            ],
        ],
        (2, true) => &[&[ParameterRole::Origin, ParameterRole::Direction]],
        (2, false) => &[&[ParameterRole::FromCenter, ParameterRole::Direction]],
        _ => {
            return Err(
                "a ray and a sphere are vec3 origin, vec3 direction, vec3 center, float radius, or vec4 sphere"
                    .to_owned(),
            );
        }
    };
    let agrees = |usual: ParameterRole, role: ParameterRole| {
        usual == role
            || (role == ParameterRole::FromCenter && usual == ParameterRole::Origin)
            || (role == ParameterRole::FromCenter && usual == ParameterRole::Center)
    };
    let fits = |order: &&&[ParameterRole]| {
        order.iter().zip(&vectors).all(|(&role, leaf)| {
            ParameterRole::usual(&leaf.name)
                .is_none_or(|usual| !is_vector(usual) || agrees(usual, role))
        })
    };
    let Some(order) = orders.iter().find(fits) else {
        let (leaf, role) = orders[0]
            .iter()
            .zip(&vectors)
            .find_map(|(role, leaf)| {
                let usual = ParameterRole::usual(&leaf.name)?;
                (is_vector(usual) && !agrees(usual, *role)).then_some((leaf, usual))
            })
            .expect("some name disagrees");
        return Err(format!(
            "{} reads like the {}, but is where another is expected; a comment line says what is what: // roles: origin, direction, center, radius",
            leaf.name,
            role.name()
        ));
    };
    let mut next = order.iter();
    let mut radius = !has_sphere;
    let mut least = true;
    let mut roles = Vec::new();
    for leaf in ins {
        let usual = ParameterRole::usual(&leaf.name);
        roles.push(match leaf.shape {
            LeafShape::Real(3) => *next.next().expect("as many as there are vectors"),
            LeafShape::Real(4) => ParameterRole::Sphere,
            LeafShape::Real(1) => match usual {
                Some(role @ (ParameterRole::Least | ParameterRole::Most)) => role,
                _ if radius => {
                    radius = false;
                    if usual == Some(ParameterRole::RadiusSquared) {
                        ParameterRole::RadiusSquared
                    } else {
                        ParameterRole::Radius
                    }
                }
                _ if least => {
                    least = false;
                    ParameterRole::Least
                }
                _ => ParameterRole::Most,
            },
            _ => return Err(format!("{} is neither a float nor a vector", leaf.name)),
        });
    }
    complete(roles)
}

const fn is_vector(role: ParameterRole) -> bool {
    matches!(
        role,
        ParameterRole::Origin | ParameterRole::Direction | ParameterRole::Center
    )
}

/// The roles, if they make a ray and a sphere.
fn complete(roles: Vec<ParameterRole>) -> Result<Vec<ParameterRole>, String> {
    let has = |role: ParameterRole| roles.iter().filter(|r| **r == role).count();
    let sphere = has(ParameterRole::Sphere);
    let radius = has(ParameterRole::Radius) + has(ParameterRole::RadiusSquared);
    let center = has(ParameterRole::Center) + has(ParameterRole::FromCenter) + sphere;
    let origin = has(ParameterRole::Origin) + has(ParameterRole::FromCenter);
    if (origin, has(ParameterRole::Direction), center) == (1, 1, 1) && radius + sphere == 1 {
        Ok(roles)
    } else {
        Err(
            "a ray and a sphere are one origin, one direction, one center and one radius, or a vec4 sphere"
                .to_owned(),
        )
    }
}
