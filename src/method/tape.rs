//! A number that keeps record: the rounded value, and beside it what the same operations give
//! without any rounding.
//!
//! Comparisons look at the rounded value alone, so a traced run takes the branches of the plain
//! run and gives its values bit for bit.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Precision;
use super::ball::Unrounded;
use super::number::Scalar;
use super::surd::Surd;
use crate::number::Number;

/// A floating-point type whose operations a tape can record.
pub(super) trait Float: Scalar + From<f32> + Into<f64> {
    const PRECISION: Precision;
}

impl Float for f32 {
    const PRECISION: Precision = Precision::Binary32;
}

impl Float for f64 {
    const PRECISION: Precision = Precision::Binary64;
}

/// The operations of one run, in the order in which they were done.
#[derive(Debug)]
pub(super) struct Tape {
    entries: RefCell<Vec<Entry>>,
    /// How many bits an exact value may take.
    largest: i64,
}

/// One operation with its result.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    /// What was done; nothing for an input.
    pub operation: Option<Operation>,
    /// To what; as many as the operation takes.
    pub operands: Vec<Operand>,
    /// The result as the machine has it.
    pub value: f64,
    /// The result of the same operations on the same inputs, none of them rounded; none where the
    /// operation has no result, as the root of a negative number.
    pub exact: Option<Unrounded>,
}

/// An operation of IEEE 754.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    Sqrt,
    MulAdd,
    #[cfg(feature = "routine")]
    /// To the nearest number of fewer bits.
    Narrow,
    #[cfg(feature = "routine")]
    /// To a whole number.
    Whole,
}

/// What an operation was applied to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Operand {
    /// A number of the formula itself.
    Constant(f64),
    /// The result of an entry of the tape.
    Entry(usize),
}

impl Tape {
    /// A tape whose exact values are exact, however many bits that takes: for a formula, whose length is known.
    pub const fn exact_throughout() -> Self {
        Self::up_to(i64::MAX)
    }

    /// A tape on which larger values are known to within a bound.
    pub const fn up_to(largest: i64) -> Self {
        Self {
            entries: RefCell::new(Vec::new()),
            largest,
        }
    }

    /// An input, which is exact.
    pub fn input<F: Float>(&self, value: F) -> Traced<'_, F> {
        self.push(None, Vec::new(), value, exactly(value))
    }

    #[cfg(feature = "routine")]
    /// A number that is rounded, or chosen, in a way of its own.
    pub fn rounded<F: Float>(&self, operation: Operation, of: Operand, value: F) -> Traced<'_, F> {
        let exact = match operation {
            Operation::Narrow => self.exact(of),
            _ => None,
        };
        self.push(Some(operation), vec![of], value, exact)
    }

    /// The entry of that number; none for one that is not on the tape.
    pub fn get(&self, entry: usize) -> Option<Entry> {
        self.entries.borrow().get(entry).cloned()
    }

    fn exact(&self, operand: Operand) -> Option<Unrounded> {
        match operand {
            Operand::Constant(value) => exactly(value),
            Operand::Entry(i) => self.entries.borrow().get(i)?.exact.clone(),
        }
    }

    fn push<F: Float>(
        &self,
        operation: Option<Operation>,
        operands: Vec<Operand>,
        value: F,
        exact: Option<Unrounded>,
    ) -> Traced<'_, F> {
        let mut entries = self.entries.borrow_mut();
        entries.push(Entry {
            operation,
            operands,
            value: value.into(),
            exact,
        });
        Traced {
            value,
            place: Some((self, entries.len() - 1)),
        }
    }
}

/// A rounded value and its place on a tape; constants of the formula have none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traced<'t, F> {
    value: F,
    place: Option<(&'t Tape, usize)>,
}

impl<F: Float> Traced<'_, F> {
    /// The rounded value.
    pub fn value(self) -> F {
        self.value
    }

    /// The operand that this number is to whatever uses it.
    pub fn operand(self) -> Operand {
        match self.place {
            Some((_, entry)) => Operand::Entry(entry),
            None => Operand::Constant(self.value.into()),
        }
    }

    /// What this number would be without rounding, if it can be told.
    pub fn exact(self) -> Option<Surd> {
        self.unrounded()?.told()
    }

    fn unrounded(self) -> Option<Unrounded> {
        match self.place {
            Some((tape, entry)) => tape.exact(Operand::Entry(entry)),
            None => exactly(self.value),
        }
    }

    #[cfg(feature = "routine")]
    /// The same number with another sign of zero.
    pub fn with(self, value: F) -> Self {
        Self { value, ..self }
    }

    #[cfg(feature = "routine")]
    /// A whole number near this one: what it would be without rounding is another question.
    pub fn whole(self, value: F) -> Self {
        match self.place {
            Some((tape, _)) => tape.rounded(Operation::Whole, self.operand(), value),
            None => Self::constant(value),
        }
    }

    fn record<const N: usize>(operation: Operation, operands: [Self; N], value: F) -> Self {
        let Some((tape, _)) = operands.iter().find_map(|o| o.place) else {
            return Self::constant(value);
        };
        let largest = tape.largest;
        let exact = operands.map(Self::unrounded);
        let exact = match (operation, exact.each_ref().map(Option::as_ref).as_slice()) {
            (Operation::Add, [Some(x), Some(y)]) => x.add(y, largest),
            (Operation::Sub, [Some(x), Some(y)]) => x.sub(y, largest),
            (Operation::Mul, [Some(x), Some(y)]) => x.mul(y, largest),
            (Operation::Div, [Some(x), Some(y)]) => x.div(y, largest),
            (Operation::Neg, [Some(x)]) => Some(x.neg()),
            (Operation::Sqrt, [Some(x)]) => x.sqrt(largest),
            (Operation::MulAdd, [Some(x), Some(y), Some(z)]) => x
                .mul(y, largest)
                .and_then(|product| product.add(z, largest)),
            _ => None,
        };
        let operands = operands.map(Self::operand).to_vec();
        tape.push(Some(operation), operands, value, exact)
    }

    fn constant(value: F) -> Self {
        Self { value, place: None }
    }
}

#[cfg(feature = "routine")]
impl<'t> Traced<'t, f32> {
    /// The same number with more bits.
    pub fn as_wide(self) -> Traced<'t, f64> {
        Traced {
            value: self.value.into(),
            place: self.place,
        }
    }
}

#[cfg(feature = "routine")]
impl<'t> Traced<'t, f64> {
    /// The nearest number of fewer bits.
    pub fn narrowed(self) -> Traced<'t, f32> {
        let value = self.value as f32;
        match self.place {
            Some((tape, _)) => tape.rounded(Operation::Narrow, self.operand(), value),
            None => Traced { value, place: None },
        }
    }
}

fn exactly(value: impl Into<f64>) -> Option<Unrounded> {
    Surd::from_f64(value.into()).map(Unrounded::Surd)
}

macro_rules! traced_operator {
    ($($operator:ident, $method:ident;)*) => {$(
        impl<F: Float> $operator for Traced<'_, F> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let value = self.value.$method(other.value);
                Self::record(Operation::$operator, [self, other], value)
            }
        }
    )*};
}

traced_operator! { Add, add; Sub, sub; Mul, mul; Div, div; }

impl<F: Float> Neg for Traced<'_, F> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::record(Operation::Neg, [self], -self.value)
    }
}

impl<F: Float> PartialEq for Traced<'_, F> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<F: Float> PartialOrd for Traced<'_, F> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<F: Float> Number for Traced<'_, F> {
    fn of(value: f64) -> Self {
        Self::constant(F::of(value))
    }

    fn sqrt(self) -> Self {
        Self::record(Operation::Sqrt, [self], self.value.sqrt())
    }
}

impl<F: Float> Scalar for Traced<'_, F> {
    fn mul_add(self, factor: Self, term: Self) -> Self {
        let value = self.value.mul_add(factor.value, term.value);
        Self::record(Operation::MulAdd, [self, factor, term], value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_exact_value_beside_the_rounded_one() {
        let tape = Tape::exact_throughout();
        let [x, y] = [16_777_216.0_f32, 1.0].map(|v| tape.input(v));
        let difference = (x + y) - x;
        assert_eq!(difference.value(), 0.0);
        assert_eq!(difference.exact().unwrap().to_f64(), 1.0);
        let third = y / Traced::of(3.0);
        let whole = third * Traced::of(3.0);
        assert_eq!(whole.exact().unwrap().to_f64(), 1.0);
        let root = Traced::of(2.0) * y;
        let two = root.sqrt() * root.sqrt();
        assert_ne!(two.value(), 2.0);
        assert_eq!(two.exact().unwrap().to_f64(), 2.0);
        assert!((-root).sqrt().exact().is_none());
        let product = Scalar::mul_add(x, x, -y);
        assert_eq!(product.value(), 281_474_976_710_656.0);
        assert_eq!(product.exact().unwrap().to_f64(), 281_474_976_710_655.0);
    }
}
