//! The roots of At² + 2bt + C = 0 without cancellation, given the reduced discriminant
//! D = b² − AC = Δ/4 ≥ 0: the quadratic formula solved for the sum whose terms have one sign.

use super::number::Number;

/// The roots and what they are made of.
#[derive(Debug, Clone, Copy)]
#[expect(dead_code, reason = "the traced run is to show them")]
pub(super) struct Roots<T> {
    /// √D.
    pub root: T,
    /// q = −(b + sign(b)√D), with sign(0) = +1.
    pub q: T,
    /// The smaller root.
    pub near: T,
    /// The larger root.
    pub far: T,
    /// Which quotient each root is.
    pub form: Form,
}

/// Which quotients the near and the far root are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// b ≥ 0: near = q/A, far = C/q.
    NearOverA,
    /// b < 0: near = C/q, far = q/A.
    FarOverA,
    /// D = 0: both are q/A.
    Double,
    /// q = 0, so b = 0 and D = 0: both are 0, where C/q would be 0/0.
    Zero,
}

/// Both roots; near ≤ far unless one of them is NaN.
#[inline]
pub(super) fn roots<T: Number>(a: T, b: T, c: T, reduced: T) -> Roots<T> {
    let zero = T::constant(0.0);
    let root = reduced.sqrt();
    let signed_root = if b < zero { -root } else { root };
    let q = -(b + signed_root);
    let (near, far, form) = if q == zero {
        (zero, zero, Form::Zero)
    } else if reduced == zero {
        let both = q / a;
        (both, both, Form::Double)
    } else if b < zero {
        (c / q, q / a, Form::FarOverA)
    } else {
        (q / a, c / q, Form::NearOverA)
    };
    // C was rounded apart from D: where the two roots all but agree they can change places.
    let (near, far) = if near > far { (far, near) } else { (near, far) };
    Roots {
        root,
        q,
        near,
        far,
        form,
    }
}
