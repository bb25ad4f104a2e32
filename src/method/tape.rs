//! A number that keeps record: the rounded value, and beside it what the same operations give
//! without any rounding.
//!
//! Comparisons look at the rounded value alone, so a traced run takes the branches of the plain
//! run and gives its values bit for bit.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Precision;
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
#[derive(Debug, Default)]
pub(super) struct Tape(RefCell<Vec<Entry>>);

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
    pub exact: Option<Surd>,
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
    /// An input, which is exact.
    pub fn input<F: Float>(&self, value: F) -> Traced<'_, F> {
        self.push(None, Vec::new(), value, Surd::from_f64(value.into()))
    }

    /// The entry of that number; none for one that is not on the tape.
    pub fn get(&self, entry: usize) -> Option<Entry> {
        self.0.borrow().get(entry).cloned()
    }

    fn exact(&self, operand: Operand) -> Option<Surd> {
        match operand {
            Operand::Constant(value) => Surd::from_f64(value),
            Operand::Entry(i) => self.0.borrow().get(i)?.exact.clone(),
        }
    }

    fn push<F: Float>(
        &self,
        operation: Option<Operation>,
        operands: Vec<Operand>,
        value: F,
        exact: Option<Surd>,
    ) -> Traced<'_, F> {
        let mut entries = self.0.borrow_mut();
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

    /// What this number would be without rounding.
    pub fn exact(self) -> Option<Surd> {
        match self.place {
            Some((tape, entry)) => tape.exact(Operand::Entry(entry)),
            None => Surd::from_f64(self.value.into()),
        }
    }

    fn record<const N: usize>(operation: Operation, operands: [Self; N], value: F) -> Self {
        let Some((tape, _)) = operands.iter().find_map(|o| o.place) else {
            return Self::constant(value);
        };
        let exact = operands.map(Self::exact);
        let exact = match (operation, exact.each_ref().map(Option::as_ref).as_slice()) {
            (Operation::Add, [Some(x), Some(y)]) => x.checked_add(y),
            (Operation::Sub, [Some(x), Some(y)]) => x.checked_sub(y),
            (Operation::Mul, [Some(x), Some(y)]) => x.checked_mul(y),
            (Operation::Div, [Some(x), Some(y)]) => x.checked_div(y),
            (Operation::Neg, [Some(x)]) => Some(-(*x).clone()),
            (Operation::Sqrt, [Some(x)]) => x.checked_sqrt(),
            (Operation::MulAdd, [Some(x), Some(y), Some(z)]) => {
                x.checked_mul(y).and_then(|product| product.checked_add(z))
            }
            _ => None,
        };
        let operands = operands.map(Self::operand).to_vec();
        tape.push(Some(operation), operands, value, exact)
    }

    fn constant(value: F) -> Self {
        Self { value, place: None }
    }
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
        let tape = Tape::default();
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
