//! Leaves out what nobody asks about: copies and flags that a text does not need.

use std::collections::HashSet;

use super::super::program::{Logic, Note, Op, ProgramAnswer, ProgramStep, Slot, SlotKind};

/// Drops steps whose result is used nowhere.
pub(super) fn prune(steps: &mut Vec<ProgramStep>, notes: &[Note], answer: &ProgramAnswer) {
    let mut used: HashSet<Slot> = HashSet::new();
    used.extend(answer.found);
    used.extend(answer.count);
    used.extend(&answer.roots);
    used.extend(answer.constant.map(|at| Slot::new(SlotKind::Bool, at)));
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

fn mark(steps: &[ProgramStep], used: &mut HashSet<Slot>) {
    for step in steps.iter().rev() {
        match step {
            ProgramStep::Do(op) => {
                let (to, of) = ends(op);
                if used.contains(&to) {
                    used.extend(of);
                }
            }
            ProgramStep::Put { to, from } => {
                if used.contains(to) {
                    used.insert(*from);
                }
            }
            ProgramStep::If {
                condition,
                accept,
                reject,
            } => {
                used.insert(Slot::new(SlotKind::Bool, *condition));
                mark(accept, used);
                mark(reject, used);
            }
            ProgramStep::Loop {
                body,
                continuing,
                break_if,
                ..
            } => {
                used.extend(break_if.map(|at| Slot::new(SlotKind::Bool, at)));
                mark(continuing, used);
                mark(body, used);
            }
            ProgramStep::Scope(body) => mark(body, used),
            ProgramStep::Break
            | ProgramStep::Continue
            | ProgramStep::Leave
            | ProgramStep::Note(_) => {}
        }
    }
}

fn drop_unused(steps: &mut Vec<ProgramStep>, used: &HashSet<Slot>) {
    steps.retain_mut(|step| match step {
        ProgramStep::Do(op) => used.contains(&ends(op).0),
        ProgramStep::Put { to, .. } => used.contains(to),
        ProgramStep::If { accept, reject, .. } => {
            drop_unused(accept, used);
            drop_unused(reject, used);
            !(accept.is_empty() && reject.is_empty())
        }
        ProgramStep::Loop {
            body, continuing, ..
        } => {
            drop_unused(body, used);
            drop_unused(continuing, used);
            true
        }
        ProgramStep::Scope(body) => {
            drop_unused(body, used);
            true
        }
        ProgramStep::Break | ProgramStep::Continue | ProgramStep::Leave | ProgramStep::Note(_) => {
            true
        }
    });
}

/// Whole numbers share a bank, with or without a sign.
fn ends(op: &Op) -> (Slot, Vec<Slot>) {
    let real = |wide: bool| {
        if wide {
            SlotKind::Double
        } else {
            SlotKind::Single
        }
    };
    let slots = |kind: SlotKind, of: &[u16]| of.iter().map(|&at| Slot::new(kind, at)).collect();
    match *op {
        Op::Arith { wide, to, of, op } => {
            let count = arity(op);
            (Slot::new(real(wide), to), slots(real(wide), &of[..count]))
        }
        Op::Compare { kind, to, of, .. } => (Slot::new(SlotKind::Bool, to), slots(kind, &of)),
        Op::Logic { op, wide, to, of } => {
            let (kind, count) = match op {
                Logic::IsNan | Logic::IsInf => (real(wide), 1),
                Logic::Not => (SlotKind::Bool, 1),
                _ => (SlotKind::Bool, 2),
            };
            (Slot::new(SlotKind::Bool, to), slots(kind, &of[..count]))
        }
        Op::Whole {
            unsigned, to, of, ..
        } => {
            let kind = if unsigned {
                SlotKind::Uint
            } else {
                SlotKind::Int
            };
            (Slot::new(kind, to), slots(kind, &of))
        }
        Op::Select {
            kind,
            to,
            condition,
            of,
        } => {
            let mut operands: Vec<Slot> = slots(kind, &of);
            operands.push(Slot::new(SlotKind::Bool, condition));
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
