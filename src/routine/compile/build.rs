//! What is being built: places for numbers, constants, variables, and the steps so far.

use std::collections::HashMap;

use naga::{Handle, Module, Scalar, ScalarKind, Type, TypeInner};

use super::super::RoutineError;
use super::super::front::ParsedModule;
use super::super::guard::RoutineSource;
use super::super::program::{
    Arith, Comparison, Logic, Note, Op, Program, ProgramAnswer, ProgramInput, ProgramStep, Slot,
    SlotKind,
};
use super::super::signature::Signature;
use super::{MOST_OPERATIONS, prune};

/// The most places of one kind.
const MOST_SLOTS: u16 = 8_000;
/// The most steps that a program may have once helper functions are put in.
const MOST_STEPS: usize = 20_000;
/// The most places where values are told.
const MOST_NOTES: usize = 2_000;

/// Whether a value is one that the text says outright.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Constancy {
    Always,
    Never,
    /// As that place among the true and false says.
    Flag(u16),
}

/// Numbers in order, as the type of an expression has them.
#[derive(Debug, Clone)]
pub(super) struct CompiledValue {
    pub slots: Vec<Slot>,
    pub constancy: Constancy,
    /// The variable whose places these are, if it may be written again.
    pub of: Option<usize>,
}

/// A variable that may be written more than once.
#[derive(Debug, Clone)]
pub(super) struct Storage {
    pub slots: Vec<Slot>,
    /// Whether it holds a constant.
    pub flag: u16,
}

/// The program so far.
pub(super) struct Builder<'a> {
    pub source: &'a RoutineSource,
    pub parsed: &'a ParsedModule,
    pub contract: bool,
    /// The blocks that are open, the innermost last.
    blocks: Vec<Vec<ProgramStep>>,
    pub notes: Vec<Note>,
    counts: [u16; 4],
    constants: HashMap<(SlotKind, u64), u16>,
    /// Variables, of all functions.
    pub storage: Vec<Storage>,
    pub globals: HashMap<Handle<naga::GlobalVariable>, usize>,
    steps: usize,
    /// Operations so far in the innermost loop, or outside any.
    pub costs: Vec<u32>,
    /// Where in the text one is.
    pub at: usize,
}

impl<'a> Builder<'a> {
    pub fn new(source: &'a RoutineSource, parsed: &'a ParsedModule, contract: bool) -> Self {
        Self {
            source,
            parsed,
            contract,
            blocks: vec![Vec::new()],
            notes: Vec::new(),
            counts: [0; 4],
            constants: HashMap::new(),
            storage: Vec::new(),
            globals: HashMap::new(),
            steps: 0,
            costs: vec![0],
            at: 0,
        }
    }

    pub fn module(&self) -> &'a Module {
        &self.parsed.module
    }

    /// An error where one is.
    pub fn refuse<T>(&self, problem: impl Into<String>) -> Result<T, RoutineError> {
        Err(self.source.error(self.at, problem))
    }

    pub fn fresh(&mut self, kind: SlotKind) -> Result<u16, RoutineError> {
        let count = &mut self.counts[bank(kind)];
        if *count >= MOST_SLOTS {
            return self.refuse("the routine is too long once its helper functions are put in");
        }
        *count += 1;
        Ok(*count - 1)
    }

    pub fn fresh_slot(&mut self, kind: SlotKind) -> Result<Slot, RoutineError> {
        Ok(Slot::new(kind, self.fresh(kind)?))
    }

    /// Places for a value of that type.
    pub fn fresh_of(&mut self, ty: Handle<Type>) -> Result<Vec<Slot>, RoutineError> {
        let kinds = self.kinds(&self.module().types[ty].inner)?;
        kinds
            .into_iter()
            .map(|kind| self.fresh_slot(kind))
            .collect()
    }

    /// The numbers that a type is made of, in order.
    pub fn kinds(&self, inner: &TypeInner) -> Result<Vec<SlotKind>, RoutineError> {
        let types = &self.module().types;
        Ok(match inner {
            TypeInner::Scalar(scalar) => vec![self.kind(*scalar)?],
            TypeInner::Vector { size, scalar } => vec![self.kind(*scalar)?; *size as usize],
            TypeInner::Struct { members, .. } => {
                let mut kinds = Vec::new();
                for member in members {
                    kinds.extend(self.kinds(&types[member.ty].inner)?);
                    if kinds.len() > 64 {
                        return self.refuse("the structure is too large");
                    }
                }
                kinds
            }
            TypeInner::Array { base, size, .. } => {
                let count = match size {
                    naga::ArraySize::Constant(count) if count.get() <= 16 => count.get() as usize,
                    _ => return self.refuse("an array has 16 elements at most"),
                };
                let one = self.kinds(&types[*base].inner)?;
                if one.len() * count > 64 {
                    return self.refuse("the array is too large");
                }
                one.repeat(count)
            }
            TypeInner::Matrix { .. } => return self.refuse("matrices are not run here"),
            _ => return self.refuse("only numbers, vectors and structures of them are run here"),
        })
    }

    pub fn kind(&self, scalar: Scalar) -> Result<SlotKind, RoutineError> {
        Ok(match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) | (ScalarKind::AbstractFloat, _) => SlotKind::Single,
            (ScalarKind::Float, 8) => SlotKind::Double,
            (ScalarKind::Bool, _) => SlotKind::Bool,
            (ScalarKind::Sint, 4) | (ScalarKind::AbstractInt, _) => SlotKind::Int,
            (ScalarKind::Uint, 4) => SlotKind::Uint,
            _ => return self.refuse("numbers are float, double, int, uint and bool"),
        })
    }

    /// The place of a constant.
    pub fn constant(&mut self, kind: SlotKind, value: f64) -> Result<u16, RoutineError> {
        let key = (kind, value.to_bits());
        if let Some(at) = self.constants.get(&key) {
            return Ok(*at);
        }
        let at = self.fresh(kind)?;
        self.constants.insert(key, at);
        Ok(at)
    }

    pub fn truth(&mut self, value: bool) -> Result<u16, RoutineError> {
        self.constant(SlotKind::Bool, f64::from(u8::from(value)))
    }

    /// A variable in these places, which holds a constant or not.
    pub fn variable(&mut self, slots: Vec<Slot>, _: bool) -> usize {
        // A bank that is full is told of by the next place that is asked for.
        let flag = self.fresh(SlotKind::Bool).unwrap_or(0);
        self.storage.push(Storage { slots, flag });
        self.storage.len() - 1
    }

    pub fn push(&mut self, step: ProgramStep) {
        self.steps += 1;
        if let Some(block) = self.blocks.last_mut() {
            block.push(step);
        }
    }

    /// One more operation.
    pub fn operate(&mut self, op: Op) -> Result<(), RoutineError> {
        if let Some(cost) = self.costs.last_mut() {
            *cost += 1;
        }
        self.push(ProgramStep::Do(op));
        if self.steps > MOST_STEPS
            || self
                .costs
                .last()
                .is_some_and(|cost| *cost > MOST_OPERATIONS)
        {
            return self.refuse(format!(
                "the routine is too long: at most {MOST_OPERATIONS} operations a ray"
            ));
        }
        Ok(())
    }

    /// Steps that are built apart.
    pub fn block(
        &mut self,
        build: impl FnOnce(&mut Self) -> Result<(), RoutineError>,
    ) -> Result<Vec<ProgramStep>, RoutineError> {
        self.blocks.push(Vec::new());
        let built = build(self);
        let block = self.blocks.pop().unwrap_or_default();
        built.map(|()| block)
    }

    pub fn arith(&mut self, op: Arith, kind: SlotKind, of: &[Slot]) -> Result<Slot, RoutineError> {
        let to = self.fresh(kind)?;
        let mut operands = [0; 3];
        for (operand, slot) in operands.iter_mut().zip(of) {
            *operand = slot.at;
        }
        let wide = kind == SlotKind::Double;
        self.operate(Op::Arith {
            op,
            wide,
            to,
            of: operands,
        })?;
        Ok(Slot::new(kind, to))
    }

    pub fn compare(&mut self, op: Comparison, of: [Slot; 2]) -> Result<Slot, RoutineError> {
        let to = self.fresh(SlotKind::Bool)?;
        let kind = of[0].kind;
        let of = of.map(|slot| slot.at);
        self.operate(Op::Compare { op, kind, to, of })?;
        Ok(Slot::new(SlotKind::Bool, to))
    }

    pub fn logic(&mut self, op: Logic, wide: bool, of: [u16; 2]) -> Result<u16, RoutineError> {
        let to = self.fresh(SlotKind::Bool)?;
        self.operate(Op::Logic { op, wide, to, of })?;
        Ok(to)
    }

    pub fn select(&mut self, condition: u16, of: [Slot; 2]) -> Result<Slot, RoutineError> {
        let kind = of[0].kind;
        let to = self.fresh(kind)?;
        let of = of.map(|slot| slot.at);
        self.operate(Op::Select {
            kind,
            to,
            condition,
            of,
        })?;
        Ok(Slot::new(kind, to))
    }

    /// Writes a value into a variable, from its n-th place on.
    pub fn put(&mut self, variable: usize, from: usize, value: &CompiledValue) {
        let Storage { slots, flag } = self.storage[variable].clone();
        let whole = value.slots.len() == slots.len();
        for (to, from) in slots[from..].iter().zip(&value.slots) {
            self.push(ProgramStep::Put {
                to: *to,
                from: *from,
            });
        }
        let said = match value.constancy {
            Constancy::Always if !whole => return,
            Constancy::Always => self.truth(true),
            Constancy::Never => self.truth(false),
            Constancy::Flag(said) => Ok(said),
        };
        if let Ok(said) = said {
            self.push(ProgramStep::Put {
                to: Slot::new(SlotKind::Bool, flag),
                from: Slot::new(SlotKind::Bool, said),
            });
        }
    }

    /// Tells values of a statement.
    pub fn note(&mut self, note: Note) {
        if self.notes.len() < MOST_NOTES {
            self.notes.push(note);
            self.push(ProgramStep::Note(self.notes.len() - 1));
        }
    }

    pub fn finish(
        mut self,
        inputs: Vec<(ProgramInput, Slot)>,
        answer: ProgramAnswer,
        signature: Signature,
    ) -> Program {
        let mut steps = self.blocks.pop().unwrap_or_default();
        prune::prune(&mut steps, &self.notes, &answer);
        let mut program = Program {
            steps,
            notes: self.notes,
            sizes: self.counts.map(usize::from),
            singles: Vec::new(),
            doubles: Vec::new(),
            bools: Vec::new(),
            wholes: Vec::new(),
            cost: self.costs.first().copied().unwrap_or(0),
            inputs,
            answer,
            signature,
            lines: self.source.lines.clone(),
        };
        for ((kind, bits), at) in self.constants {
            let value = f64::from_bits(bits);
            match kind {
                SlotKind::Single => program.singles.push((at, value as f32)),
                SlotKind::Double => program.doubles.push((at, value)),
                SlotKind::Bool => program.bools.push((at, value != 0.0)),
                SlotKind::Int => program.wholes.push((at, value as i32)),
                SlotKind::Uint => program.wholes.push((at, value as u32 as i32)),
            }
        }
        program
    }
}

pub(super) const fn bank(kind: SlotKind) -> usize {
    match kind {
        SlotKind::Single => 0,
        SlotKind::Double => 1,
        SlotKind::Bool => 2,
        SlotKind::Int | SlotKind::Uint => 3,
    }
}
