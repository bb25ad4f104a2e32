//! What one floating-point operation lost, told apart: bits that cancel, bits that fall off the
//! end, numbers that leave the range.

use crate::method::Precision;
use crate::method::dyadic::Dyadic;
use crate::method::surd::Surd;
use crate::method::tape::{Entry, Operation};
use crate::text::Glyphs;

/// A loss of one operation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loss {
    /// Which kind, and how much.
    pub kind: LossKind,
    /// The two operands by name, or their values where they have none; the second is empty for an
    /// operation on one number.
    pub operands: [String; 2],
    /// Bits that a number of this precision holds.
    pub of: u32,
}

/// The ways to lose bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LossKind {
    /// A difference, one of whose operands was not exact: that many leading bits of both agreed
    /// and are gone, and what is left is the part that had been rounded.
    Cancelled {
        /// Leading bits in common.
        bits: u32,
    },
    /// A sum: of the second operand only that many bits have a place beside the first.
    Absorbed {
        /// Bits that were kept, 0 if the operand changed nothing.
        kept: u32,
    },
    /// The result lies below the normal range: rounded to a subnormal number, or to zero.
    Underflowed,
    /// The result lies past the range and became infinite.
    Overflowed,
    /// The operation has no result, as 0/0 or ∞ − ∞, and gave NaN.
    Invalid,
}

impl Loss {
    /// How many bits were lost.
    pub fn bits(&self) -> u32 {
        match self.kind {
            LossKind::Cancelled { bits } => bits,
            LossKind::Absorbed { kept } => self.of - kept,
            LossKind::Underflowed | LossKind::Overflowed | LossKind::Invalid => self.of,
        }
    }

    /// Whether half the bits or more went.
    pub fn is_heavy(&self) -> bool {
        self.bits() >= self.of / 2
    }

    /// The loss in words.
    pub fn sentence(&self, glyphs: Glyphs) -> String {
        let [x, y] = self.operands.each_ref().map(|o| glyphs.spell(o));
        let of = self.of;
        match self.kind {
            LossKind::Cancelled { bits } if bits >= of => {
                format!("{x} and {y}: all {of} leading bits cancel, none is left")
            }
            LossKind::Cancelled { bits } => {
                let left = of - bits;
                let verb = if left == 1 { "is" } else { "are" };
                format!("{x} and {y}: {bits} leading bits cancel, {left} {verb} left")
            }
            LossKind::Absorbed { kept: 0 } => format!("{y} vanishes beside {x}"),
            LossKind::Absorbed { kept } => {
                format!("beside {x} there is room for {kept} of the {of} bits of {y}")
            }
            LossKind::Underflowed => "the result is below the normal range".to_owned(),
            LossKind::Overflowed => "the result is past the range".to_owned(),
            LossKind::Invalid => "the operation has no result".to_owned(),
        }
    }
}

/// An operand with all that a loss may depend on.
pub(super) struct LossOperand {
    /// Its name, or its value as text.
    pub label: String,
    /// Whether it is a quantity with a name.
    pub named: bool,
    /// Its value as the machine has it.
    pub value: f64,
    /// Whether that is free of error.
    pub exact: bool,
}

impl LossOperand {
    /// The product that a fused operation adds without rounding it; of binary32 it is a binary64.
    fn product(x: &Self, y: &Self) -> Self {
        Self {
            label: if x.label == y.label {
                format!("{}²", x.label)
            } else {
                format!("{}·{}", x.label, y.label)
            },
            named: x.named && y.named,
            value: x.value * y.value,
            exact: x.exact && y.exact,
        }
    }
}

/// What the operation of an entry lost, if anything that is worth a word.
pub(super) fn of(entry: &Entry, operands: &[LossOperand], precision: Precision) -> Option<Loss> {
    of_operation(entry.operation?, entry.value, operands, precision)
}

/// What an operation that gave `value` lost, if anything that is worth a word.
pub(super) fn of_operation(
    operation: Operation,
    value: f64,
    operands: &[LossOperand],
    precision: Precision,
) -> Option<Loss> {
    let loss = |kind, operands: [&LossOperand; 2]| Loss {
        kind,
        operands: operands.map(|o| o.label.clone()),
        of: precision.bits(),
    };
    let both = match operands {
        [x, y, ..] => [x, y],
        [x] => [x, x],
        [] => return None,
    };
    if operands.iter().any(|o| o.value.is_nan()) {
        return None;
    }
    if value.is_nan() {
        return Some(loss(LossKind::Invalid, both));
    }
    if value.is_infinite() {
        let made_here = operands.iter().all(|o| o.value.is_finite());
        return made_here.then(|| loss(LossKind::Overflowed, both));
    }
    let local = local_result(operation, operands)?;
    let inexact = local.ulps(value, precision) != 0.0;
    let least_normal = i64::from(precision.least_exponent()) + i64::from(precision.bits()) - 1;
    if inexact && local.floor_log2().is_some_and(|log| log < least_normal) {
        return Some(loss(LossKind::Underflowed, both));
    }
    let product;
    let both = match (operation, operands) {
        (Operation::Add | Operation::Sub, _) => both,
        (Operation::MulAdd, [x, y, z]) => {
            product = LossOperand::product(x, y);
            if rounds_to(product.value, -z.value, precision) {
                // What is asked for is the rounding error of the product: that is all there is.
                return None;
            }
            [&product, z]
        }
        _ => return None,
    };
    let [Some(x), Some(y)] = both.map(|o| Dyadic::from_f64(o.value)) else {
        return None;
    };
    let (lx, ly) = (x.floor_log2()?, y.floor_log2()?);
    let result = Dyadic::from_f64(value)?;
    let cancelled = match result.floor_log2() {
        Some(l) => lx.max(ly) - l,
        None => i64::from(precision.bits()),
    };
    if cancelled > 1 && !both.iter().all(|o| o.exact) {
        let bits = u32::try_from(cancelled).unwrap_or(0).min(precision.bits());
        return Some(loss(LossKind::Cancelled { bits }, both));
    }
    // Room beside the greater operand: places from the smaller's leading bit to the last place.
    let [great, small] = if lx >= ly { both } else { [both[1], both[0]] };
    let last = Surd::from(result).ulp_exponent(precision);
    let kept = (lx.min(ly) - last + 1).max(0);
    let named = both.iter().all(|o| o.named);
    (inexact && named && kept < i64::from(precision.bits()) - 1).then(|| {
        let kept = u32::try_from(kept).unwrap_or(0);
        loss(LossKind::Absorbed { kept }, [great, small])
    })
}

fn rounds_to(value: f64, rounded: f64, precision: Precision) -> bool {
    match precision {
        Precision::Binary32 => f64::from(value as f32) == rounded,
        Precision::Binary64 => value == rounded,
    }
}

/// The result of the operation on the operands as they are, not rounded.
fn local_result(operation: Operation, operands: &[LossOperand]) -> Option<Surd> {
    let exact: Vec<Surd> = operands
        .iter()
        .map(|o| Surd::from_f64(o.value))
        .collect::<Option<_>>()?;
    match (operation, exact.as_slice()) {
        (Operation::Add, [x, y]) => x.checked_add(y),
        (Operation::Sub, [x, y]) => x.checked_sub(y),
        (Operation::Mul, [x, y]) => x.checked_mul(y),
        (Operation::Div, [x, y]) => x.checked_div(y),
        (Operation::Neg, [x]) => Some(-x.clone()),
        (Operation::Sqrt, [x]) => x.checked_sqrt(),
        #[cfg(feature = "routine")]
        (Operation::Narrow, [x]) => Some(x.clone()),
        (Operation::MulAdd, [x, y, z]) => x.checked_mul(y)?.checked_add(z),
        _ => None,
    }
}
