//! Leaves out what nobody asks about: copies and flags that a text does not need.

use std::collections::HashSet;

use super::super::program::{Answer, Kind, Logic, Note, Op, Slot, Step};

/// Drops steps whose result is used nowhere.
pub(super) fn prune(steps: &mut Vec<Step>, notes: &[Note], answer: &Answer) {
    let mut used: HashSet<Slot> = HashSet::new();
    used.extend(answer.found);
    used.extend(answer.count);
    used.extend(&answer.roots);
    used.extend(answer.constant.map(|at| Slot::new(Kind::Bool, at)));
    used.extend(notes.iter().flat_map(|note| &note.slots));
    // What a loop uses may be written further down: until nothing is added.
    loop {
        let before = used.len();
        mark(steps, &mut used);
        if used.len() == before {
            break;
        }
    }
    drop_unused(steps, &used);
}

fn mark(steps: &[Step], used: &mut HashSet<Slot>) {
    for step in steps.iter().rev() {
        match step {
            Step::Do(op) => {
                let (to, of) = ends(op);
                if used.contains(&to) {
                    used.extend(of);
                }
            }
            Step::Put { to, from } => {
                if used.contains(to) {
                    used.insert(*from);
                }
            }
            Step::If {
                condition,
                accept,
                reject,
            } => {
                used.insert(Slot::new(Kind::Bool, *condition));
                mark(accept, used);
                mark(reject, used);
            }
            Step::Loop {
                body,
                continuing,
                break_if,
                ..
            } => {
                used.extend(break_if.map(|at| Slot::new(Kind::Bool, at)));
                mark(continuing, used);
                mark(body, used);
            }
            Step::Scope(body) => mark(body, used),
            Step::Break | Step::Continue | Step::Leave | Step::Note(_) => {}
        }
    }
}

fn drop_unused(steps: &mut Vec<Step>, used: &HashSet<Slot>) {
    steps.retain_mut(|step| match step {
        Step::Do(op) => used.contains(&ends(op).0),
        Step::Put { to, .. } => used.contains(to),
        Step::If { accept, reject, .. } => {
            drop_unused(accept, used);
            drop_unused(reject, used);
            !(accept.is_empty() && reject.is_empty())
        }
        Step::Loop {
            body, continuing, ..
        } => {
            drop_unused(body, used);
            drop_unused(continuing, used);
            true
        }
        Step::Scope(body) => {
            drop_unused(body, used);
            true
        }
        Step::Break | Step::Continue | Step::Leave | Step::Note(_) => true,
    });
}

/// Whole numbers share a bank, with or without a sign.
fn ends(op: &Op) -> (Slot, Vec<Slot>) {
    let real = |wide: bool| if wide { Kind::Double } else { Kind::Single };
    let slots = |kind: Kind, of: &[u16]| of.iter().map(|&at| Slot::new(kind, at)).collect();
    match *op {
        Op::Arith { wide, to, of, op } => {
            let count = arity(op);
            (Slot::new(real(wide), to), slots(real(wide), &of[..count]))
        }
        Op::Compare { kind, to, of, .. } => (Slot::new(Kind::Bool, to), slots(kind, &of)),
        Op::Logic { op, wide, to, of } => {
            let (kind, count) = match op {
                Logic::IsNan | Logic::IsInf => (real(wide), 1),
                Logic::Not => (Kind::Bool, 1),
                _ => (Kind::Bool, 2),
            };
            (Slot::new(Kind::Bool, to), slots(kind, &of[..count]))
        }
        Op::Whole {
            unsigned, to, of, ..
        } => {
            let kind = if unsigned { Kind::Uint } else { Kind::Int };
            (Slot::new(kind, to), slots(kind, &of))
        }
        Op::Select {
            kind,
            to,
            condition,
            of,
        } => {
            let mut operands: Vec<Slot> = slots(kind, &of);
            operands.push(Slot::new(Kind::Bool, condition));
            (Slot::new(kind, to), operands)
        }
        Op::Convert { from, to } => (to, vec![from]),
    }
}

/// How many operands an operation takes.
pub(in super::super) const fn arity(op: super::super::program::Arith) -> usize {
    use super::super::program::Arith as A;
    match op {
        A::Neg | A::Abs | A::Sqrt | A::Floor | A::Ceil | A::Trunc | A::Round | A::Sign => 1,
        A::Add | A::Sub | A::Mul | A::Div | A::Min | A::Max => 2,
        A::MulAdd => 3,
    }
}
