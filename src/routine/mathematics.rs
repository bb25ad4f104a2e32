//! The functions of the languages that a routine may call, by name, and those that it may not.

use naga::MathFunction as F;

/// Why a function is not among those of a routine.
pub(super) fn refusal(function: F) -> String {
    let name = format!("{function:?}").to_lowercase();
    let why = match function {
        F::Sin
        | F::Cos
        | F::Tan
        | F::Asin
        | F::Acos
        | F::Atan
        | F::Atan2
        | F::Exp
        | F::Exp2
        | F::Log
        | F::Log2
        | F::Sinh
        | F::Cosh
        | F::Tanh
        | F::Asinh
        | F::Acosh
        | F::Atanh => "no two machines round it alike, and a sphere needs only + - * / and sqrt",
        _ => "a ray and a sphere need + - * / and sqrt",
    };
    format!("{name} is not run here: {why}")
}
