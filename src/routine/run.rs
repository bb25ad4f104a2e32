//! Runs a program over N rays at once, or over one with somebody who listens.
//!
//! Branches take the lanes that they are for; an operation is done for all lanes, what a variable holds is changed
//! in those that run. So a lane's answer depends on its own ray alone.

use super::compile::MOST_OPERATIONS;
use super::program::{
    Arith, Comparison, Logic, Note, Op, Program, ProgramInput, ProgramStep, Slot, SlotKind, Whole,
};
use super::signature::{AnswerKind, NoHit};
use super::value::{Arithmetic, Real};
use crate::number::Number;

/// How many rays are asked about at once where there are many.
pub(crate) struct Lanes;

impl Lanes {
    pub const COUNT: usize = 64;
}

/// A value that is told.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Told<A: Arithmetic> {
    Single(A::Single),
    Double(A::Double),
    Bool(bool),
    Whole(i64),
}

/// Values that are told, with what the text says there.
pub(crate) struct Noted<'a, A: Arithmetic> {
    pub note: &'a Note,
    pub values: Vec<Told<A>>,
}

/// Who is told values, of the first lane.
pub(crate) trait Listener<A: Arithmetic> {
    const LISTENS: bool;
    fn hear(&mut self, noted: Noted<'_, A>);
}

/// Nobody listens.
pub(crate) struct Nobody;

impl<A: Arithmetic> Listener<A> for Nobody {
    const LISTENS: bool = false;
    fn hear(&mut self, _: Noted<'_, A>) {}
}

/// What came out for one ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RunOutcome<T> {
    /// The routine says that there is no hit.
    Miss,
    /// It took more operations than a ray may.
    TooLong,
    /// There is a hit, and nothing more is said.
    Hit,
    /// The visible root, as the routine has it.
    One(T),
    /// Both roots, and how many it says there are.
    Two(T, T, Option<i32>),
}

/// Room for the numbers of a run.
pub(crate) struct Runner<A: Arithmetic, const N: usize> {
    singles: Vec<[A::Single; N]>,
    doubles: Vec<[A::Double; N]>,
    bools: Vec<[bool; N]>,
    wholes: Vec<[i32; N]>,
    spent: [u32; N],
    too_long: u64,
    /// Lanes that left a scope, broke a loop, or went on to its next turn; the innermost last.
    left: Vec<u64>,
    broken: Vec<u64>,
    continued: Vec<u64>,
}

impl<A: Arithmetic, const N: usize> Runner<A, N> {
    /// Room for that program, its constants in their places.
    pub fn new(program: &Program) -> Self {
        assert!(N <= 64, "a lane is a bit of a mask");
        let [singles, doubles, bools, wholes] = program.sizes;
        let mut machine = Self {
            singles: vec![[A::Single::of(0.0); N]; singles],
            doubles: vec![[A::Double::of(0.0); N]; doubles],
            bools: vec![[false; N]; bools],
            wholes: vec![[0; N]; wholes],
            spent: [0; N],
            too_long: 0,
            left: Vec::new(),
            broken: Vec::new(),
            continued: Vec::new(),
        };
        for &(at, value) in &program.singles {
            machine.singles[usize::from(at)] = [A::Single::of(value.into()); N];
        }
        for &(at, value) in &program.doubles {
            machine.doubles[usize::from(at)] = [A::Double::of(value); N];
        }
        for &(at, value) in &program.bools {
            machine.bools[usize::from(at)] = [value; N];
        }
        for &(at, value) in &program.wholes {
            machine.wholes[usize::from(at)] = [value; N];
        }
        machine
    }

    /// Gives a lane a number of its question.
    pub(crate) fn give(&mut self, slot: Slot, lane: usize, value: A::Single) {
        let at = usize::from(slot.at);
        match slot.kind {
            SlotKind::Double => self.doubles[at][lane] = A::widen(value),
            _ => self.singles[at][lane] = value,
        }
    }

    /// Runs the first `count` lanes.
    pub(crate) fn run(&mut self, program: &Program, count: usize, listener: &mut impl Listener<A>) {
        let all = if count >= 64 {
            u64::MAX
        } else {
            (1 << count) - 1
        };
        self.spent = [program.cost; N];
        self.too_long = 0;
        self.left.clear();
        self.broken.clear();
        self.continued.clear();
        self.block(program, &program.steps, all, listener);
    }

    /// What came out for a lane.
    pub(crate) fn outcome(&self, program: &Program, lane: usize) -> RunOutcome<A::Double> {
        if self.too_long >> lane & 1 == 1 {
            return RunOutcome::TooLong;
        }
        let answer = &program.answer;
        let root = |i: usize| answer.roots.get(i).map(|slot| self.real(*slot, lane));
        let said = answer
            .found
            .map(|slot| self.bools[usize::from(slot.at)][lane]);
        let count = answer
            .count
            .map(|slot| self.wholes[usize::from(slot.at)][lane]);
        let constant = answer.constant.map(|at| self.bools[usize::from(at)][lane]);
        let negative = || {
            let below = |t: Option<A::Double>| t.is_some_and(|t| t < A::Double::of(0.0));
            match program.answers() {
                AnswerKind::Roots => below(root(0)) && below(root(1)),
                _ => below(root(0)),
            }
        };
        let misses = match answer.no_hit {
            NoHit::Said => said == Some(false) || (said.is_none() && count.is_some_and(|n| n <= 0)),
            NoHit::Constant => constant == Some(true),
            NoHit::Negative => negative(),
            NoHit::Nothing => false,
        };
        if misses {
            return RunOutcome::Miss;
        }
        match (root(0), root(1)) {
            (Some(near), Some(far)) if count == Some(1) => {
                RunOutcome::Two(near, if count == Some(1) { near } else { far }, count)
            }
            (Some(near), Some(far)) => RunOutcome::Two(near, far, count),
            (Some(t), None) => RunOutcome::One(t),
            _ => RunOutcome::Hit,
        }
    }

    fn real(&self, slot: Slot, lane: usize) -> A::Double {
        let at = usize::from(slot.at);
        match slot.kind {
            SlotKind::Double => self.doubles[at][lane],
            _ => A::widen(self.singles[at][lane]),
        }
    }

    /// Runs steps in these lanes; those that go on behind them are given back.
    fn block(
        &mut self,
        program: &Program,
        steps: &[ProgramStep],
        mut lanes: u64,
        listener: &mut impl Listener<A>,
    ) -> u64 {
        for step in steps {
            if lanes == 0 {
                break;
            }
            match step {
                ProgramStep::Do(op) => self.operate(*op),
                ProgramStep::Put { to, from } => self.put(*to, *from, lanes),
                ProgramStep::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let yes = mask(&self.bools[usize::from(*condition)]);
                    let accepted = self.block(program, accept, lanes & yes, listener);
                    let rejected = self.block(program, reject, lanes & !yes, listener);
                    lanes = accepted | rejected;
                }
                ProgramStep::Loop {
                    body,
                    continuing,
                    break_if,
                    cost,
                } => {
                    lanes = self.turns(
                        program,
                        (body, continuing, *break_if, *cost),
                        lanes,
                        listener,
                    );
                }
                ProgramStep::Break => {
                    *self.broken.last_mut().expect("inside a loop") |= lanes;
                    lanes = 0;
                }
                ProgramStep::Continue => {
                    *self.continued.last_mut().expect("inside a loop") |= lanes;
                    lanes = 0;
                }
                ProgramStep::Scope(body) => {
                    self.left.push(0);
                    let through = self.block(program, body, lanes, listener);
                    lanes = through | self.left.pop().unwrap_or(0);
                }
                ProgramStep::Leave => {
                    if let Some(left) = self.left.last_mut() {
                        *left |= lanes;
                    }
                    lanes = 0;
                }
                ProgramStep::Note(index) => self.tell(program, *index, lanes, listener),
            }
        }
        lanes
    }

    fn turns(
        &mut self,
        program: &Program,
        (body, continuing, break_if, cost): (&[ProgramStep], &[ProgramStep], Option<u16>, u32),
        mut lanes: u64,
        listener: &mut impl Listener<A>,
    ) -> u64 {
        self.broken.push(0);
        while lanes != 0 {
            lanes = self.spend(lanes, cost);
            self.continued.push(0);
            let through = self.block(program, body, lanes, listener);
            let next = through | self.continued.pop().unwrap_or(0);
            lanes = self.block(program, continuing, next, listener);
            if let Some(condition) = break_if {
                let done = lanes & mask(&self.bools[usize::from(condition)]);
                *self.broken.last_mut().expect("this loop") |= done;
                lanes &= !done;
            }
        }
        self.broken.pop().unwrap_or(0)
    }

    /// Counts the operations of a turn; lanes that may pay for them go on.
    fn spend(&mut self, lanes: u64, cost: u32) -> u64 {
        let mut going = lanes;
        for lane in 0..N {
            if lanes >> lane & 1 == 1 {
                self.spent[lane] = self.spent[lane].saturating_add(cost.max(1));
                if self.spent[lane] > MOST_OPERATIONS {
                    going &= !(1 << lane);
                    self.too_long |= 1 << lane;
                }
            }
        }
        going
    }

    fn tell(&self, program: &Program, index: usize, lanes: u64, listener: &mut impl Listener<A>) {
        fn of<A: Arithmetic, L: Listener<A>>(_: &L) -> bool {
            L::LISTENS
        }
        if !of(listener) || lanes & 1 == 0 {
            return;
        }
        let note = &program.notes[index];
        let value = |slot: &Slot| {
            let at = usize::from(slot.at);
            match slot.kind {
                SlotKind::Single => Told::Single(self.singles[at][0]),
                SlotKind::Double => Told::Double(self.doubles[at][0]),
                SlotKind::Bool => Told::Bool(self.bools[at][0]),
                SlotKind::Int => Told::Whole(self.wholes[at][0].into()),
                SlotKind::Uint => Told::Whole((self.wholes[at][0] as u32).into()),
            }
        };
        let values = note.slots.iter().map(value).collect();
        listener.hear(Noted { note, values });
    }

    fn put(&mut self, to: Slot, from: Slot, lanes: u64) {
        let [to_at, from_at] = [to.at, from.at].map(usize::from);
        match to.kind {
            SlotKind::Single => put(&mut self.singles, to_at, from_at, lanes),
            SlotKind::Double => put(&mut self.doubles, to_at, from_at, lanes),
            SlotKind::Bool => put(&mut self.bools, to_at, from_at, lanes),
            SlotKind::Int | SlotKind::Uint => put(&mut self.wholes, to_at, from_at, lanes),
        }
    }

    fn operate(&mut self, op: Op) {
        match op {
            Op::Arith {
                op,
                wide: false,
                to,
                of,
            } => arith(&mut self.singles, op, to, of),
            Op::Arith { op, to, of, .. } => arith(&mut self.doubles, op, to, of),
            Op::Compare { op, kind, to, of } => {
                self.bools[usize::from(to)] = match kind {
                    SlotKind::Double => compare(&self.doubles, op, of),
                    SlotKind::Single | SlotKind::Bool => compare(&self.singles, op, of),
                    SlotKind::Int => compare(&self.wholes, op, of),
                    SlotKind::Uint => {
                        let [x, y] = of.map(|at| self.wholes[usize::from(at)].map(|x| x as u32));
                        compare(&[x, y], op, [0, 1])
                    }
                };
            }
            Op::Logic { op, wide, to, of } => self.logic(op, wide, to, of),
            Op::Whole {
                op,
                unsigned,
                to,
                of,
            } => {
                let [x, y] = of.map(|at| self.wholes[usize::from(at)]);
                self.wholes[usize::from(to)] =
                    std::array::from_fn(|i| whole(op, unsigned, x[i], y[i]));
            }
            Op::Select {
                kind,
                to,
                condition,
                of,
            } => {
                let condition = self.bools[usize::from(condition)];
                match kind {
                    SlotKind::Single => select(&mut self.singles, condition, to, of),
                    SlotKind::Double => select(&mut self.doubles, condition, to, of),
                    SlotKind::Bool => select(&mut self.bools, condition, to, of),
                    SlotKind::Int | SlotKind::Uint => select(&mut self.wholes, condition, to, of),
                }
            }
            Op::Convert { from, to } => self.convert(from, to),
        }
    }

    fn logic(&mut self, op: Logic, wide: bool, to: u16, of: [u16; 2]) {
        let [a, b] = of.map(usize::from);
        self.bools[usize::from(to)] = match op {
            Logic::IsNan if wide => self.doubles[a].map(|x| x.to_f64().is_nan()),
            Logic::IsNan => self.singles[a].map(|x| x.to_f64().is_nan()),
            Logic::IsInf if wide => self.doubles[a].map(|x| x.to_f64().is_infinite()),
            Logic::IsInf => self.singles[a].map(|x| x.to_f64().is_infinite()),
            Logic::Not => self.bools[a].map(|x| !x),
            Logic::And => both(&self.bools, a, b, |x, y| x & y),
            Logic::Or => both(&self.bools, a, b, |x, y| x | y),
            Logic::Equal => both(&self.bools, a, b, |x, y| x == y),
            Logic::NotEqual => both(&self.bools, a, b, |x, y| x != y),
        };
    }

    fn convert(&mut self, from: Slot, to: Slot) {
        let [f, t] = [from.at, to.at].map(usize::from);
        match (from.kind, to.kind) {
            (SlotKind::Single, SlotKind::Double) => self.doubles[t] = self.singles[f].map(A::widen),
            (SlotKind::Double, SlotKind::Single) => {
                self.singles[t] = self.doubles[f].map(A::narrow);
            }
            (_, SlotKind::Single) => self.singles[t] = self.as_f64(from).map(A::Single::of),
            (_, SlotKind::Double) => self.doubles[t] = self.as_f64(from).map(A::Double::of),
            (_, SlotKind::Bool) => self.bools[t] = self.as_f64(from).map(|x| x != 0.0),
            (SlotKind::Int | SlotKind::Uint, SlotKind::Int | SlotKind::Uint) => {
                self.wholes[t] = self.wholes[f];
            }
            (_, SlotKind::Int) => self.wholes[t] = self.as_f64(from).map(|x| x as i32),
            (_, SlotKind::Uint) => self.wholes[t] = self.as_f64(from).map(|x| x as u32 as i32),
        }
    }

    fn as_f64(&self, from: Slot) -> [f64; N] {
        let at = usize::from(from.at);
        match from.kind {
            SlotKind::Single => self.singles[at].map(Real::to_f64),
            SlotKind::Double => self.doubles[at].map(Real::to_f64),
            SlotKind::Bool => self.bools[at].map(|x| f64::from(u8::from(x))),
            SlotKind::Int => self.wholes[at].map(f64::from),
            SlotKind::Uint => self.wholes[at].map(|x| f64::from(x as u32)),
        }
    }
}

impl ProgramInput {
    /// The number of that ray and sphere, p0, d, c and r.
    pub(crate) fn of<T: crate::number::Number>(self, p0: [T; 3], d: [T; 3], c: [T; 3], r: T) -> T {
        match self {
            Self::Origin(axis) => p0[usize::from(axis)],
            Self::FromCenter(axis) => p0[usize::from(axis)] - c[usize::from(axis)],
            Self::Direction(axis) => d[usize::from(axis)],
            Self::Center(axis) => c[usize::from(axis)],
            Self::Radius => r,
            Self::RadiusSquared => r * r,
            Self::Least => T::of(0.0),
            Self::Most => T::of(f64::from(f32::MAX)),
        }
    }
}

fn mask<const N: usize>(bools: &[bool; N]) -> u64 {
    let bits = bools.iter().enumerate();
    bits.fold(0, |mask, (lane, &bit)| mask | u64::from(bit) << lane)
}

fn put<T: Copy, const N: usize>(bank: &mut [[T; N]], to: usize, from: usize, lanes: u64) {
    let all = if N == 64 { u64::MAX } else { (1 << N) - 1 };
    let value = bank[from];
    if lanes == all {
        bank[to] = value;
        return;
    }
    for (lane, place) in bank[to].iter_mut().enumerate() {
        if lanes >> lane & 1 == 1 {
            *place = value[lane];
        }
    }
}

fn both<T: Copy, U, const N: usize>(
    bank: &[[T; N]],
    a: usize,
    b: usize,
    f: impl Fn(T, T) -> U,
) -> [U; N] {
    let (x, y) = (&bank[a], &bank[b]);
    std::array::from_fn(|i| f(x[i], y[i]))
}

fn arith<T: Real, const N: usize>(bank: &mut [[T; N]], op: Arith, to: u16, of: [u16; 3]) {
    let [a, b, c] = of.map(usize::from);
    let result = match op {
        Arith::Add => both(bank, a, b, |x, y| x + y),
        Arith::Sub => both(bank, a, b, |x, y| x - y),
        Arith::Mul => both(bank, a, b, |x, y| x * y),
        Arith::Div => both(bank, a, b, |x, y| x / y),
        Arith::Min => both(bank, a, b, Real::min),
        Arith::Max => both(bank, a, b, Real::max),
        Arith::Neg => bank[a].map(|x| -x),
        Arith::Abs => bank[a].map(Real::abs),
        Arith::Sqrt => bank[a].map(Number::sqrt),
        Arith::Floor => bank[a].map(Real::floor),
        Arith::Ceil => bank[a].map(Real::ceil),
        Arith::Trunc => bank[a].map(Real::trunc),
        Arith::Round => bank[a].map(Real::round),
        Arith::Sign => bank[a].map(Real::sign),
        Arith::MulAdd => {
            let (x, y, z) = (&bank[a], &bank[b], &bank[c]);
            std::array::from_fn(|i| x[i].mul_add(y[i], z[i]))
        }
    };
    bank[usize::from(to)] = result;
}

fn compare<T: Copy + PartialOrd, const N: usize>(
    bank: &[[T; N]],
    op: Comparison,
    of: [u16; 2],
) -> [bool; N] {
    let [a, b] = of.map(usize::from);
    match op {
        Comparison::Equal => both(bank, a, b, |x, y| x == y),
        Comparison::NotEqual => both(bank, a, b, |x, y| x != y),
        Comparison::Less => both(bank, a, b, |x, y| x < y),
        Comparison::LessEqual => both(bank, a, b, |x, y| x <= y),
        Comparison::Greater => both(bank, a, b, |x, y| x > y),
        Comparison::GreaterEqual => both(bank, a, b, |x, y| x >= y),
    }
}

fn select<T: Copy, const N: usize>(
    bank: &mut [[T; N]],
    condition: [bool; N],
    to: u16,
    of: [u16; 2],
) {
    let [a, b] = of.map(usize::from);
    let (x, y) = (&bank[a], &bank[b]);
    let chosen = std::array::from_fn(|i| if condition[i] { x[i] } else { y[i] });
    bank[usize::from(to)] = chosen;
}

/// Whole numbers wrap around; what divides by 0 gives 0.
fn whole(op: Whole, unsigned: bool, x: i32, y: i32) -> i32 {
    let (ux, uy) = (x as u32, y as u32);
    match op {
        Whole::Add => x.wrapping_add(y),
        Whole::Sub => x.wrapping_sub(y),
        Whole::Mul => x.wrapping_mul(y),
        Whole::Div if unsigned => ux.checked_div(uy).unwrap_or(0) as i32,
        Whole::Div => x.checked_div(y).unwrap_or(0),
        Whole::Rem if unsigned => ux.checked_rem(uy).unwrap_or(0) as i32,
        Whole::Rem => x.checked_rem(y).unwrap_or(0),
        Whole::Neg => x.wrapping_neg(),
        Whole::Abs => x.wrapping_abs(),
        Whole::Min if unsigned => ux.min(uy) as i32,
        Whole::Min => x.min(y),
        Whole::Max if unsigned => ux.max(uy) as i32,
        Whole::Max => x.max(y),
        Whole::And => x & y,
        Whole::Or => x | y,
        Whole::Xor => x ^ y,
        Whole::Not => !x,
        Whole::ShiftLeft => x.wrapping_shl(uy),
        Whole::ShiftRight if unsigned => ux.wrapping_shr(uy) as i32,
        Whole::ShiftRight => x.wrapping_shr(uy),
    }
}

/// What a routine makes of one ray and sphere, in plain numbers.
pub fn ask(program: &Program, p0: [f32; 3], d: [f32; 3], c: [f32; 3], r: f32) -> RunOutcome<f64> {
    let mut machine = Runner::<super::value::Plain, 1>::new(program);
    for (input, slot) in &program.inputs {
        machine.give(*slot, 0, input.of(p0, d, c, r));
    }
    machine.run(program, 1, &mut Nobody);
    machine.outcome(program, 0)
}

/// Values that a routine had at a line.
#[derive(Debug, Clone, PartialEq)]
pub struct RealNote {
    /// The line, from 1.
    pub line: usize,
    /// The real numbers, in order.
    pub values: Vec<f64>,
}

/// What the lines of a routine give for one ray and sphere, in plain numbers.
pub fn listen(program: &Program, [p0, d, c]: [[f32; 3]; 3], r: f32) -> Vec<RealNote> {
    let mut notes = Notebook(Vec::new());
    let mut machine = Runner::<super::value::Plain, 1>::new(program);
    for (input, slot) in &program.inputs {
        machine.give(*slot, 0, input.of(p0, d, c, r));
    }
    machine.run(program, 1, &mut notes);
    notes.0
}

/// Writes values down, as many as anybody reads.
struct Notebook(Vec<RealNote>);

impl Listener<super::value::Plain> for Notebook {
    const LISTENS: bool = true;

    fn hear(&mut self, noted: Noted<'_, super::value::Plain>) {
        if self.0.len() == 200 {
            return;
        }
        let real = |value: &Told<super::value::Plain>| match value {
            Told::Single(x) => Some(f64::from(*x)),
            Told::Double(x) => Some(*x),
            Told::Bool(_) | Told::Whole(_) => None,
        };
        self.0.push(RealNote {
            line: noted.note.line,
            values: noted.values.iter().filter_map(real).collect(),
        });
    }
}
