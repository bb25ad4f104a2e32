//! Where the methods should break down, from their formulas alone. docs/stability.md explains each
//! line; here they stand as arithmetic.

use crate::method::Method;

/// Theory and measurement agree if the dial's values differ by at most this factor, beyond the
/// step of the sweep: the constants of the estimates are not better known.
pub const AGREEMENT: f64 = 4.0;

/// log₂ of the unit roundoff of binary32.
const SINGLE: f64 = -24.0;
/// log₂ of the unit roundoff of binary64.
const DOUBLE: f64 = -53.0;

/// log₂ of the largest scale of the typical rays: ‖o‖ is up to 24.
const FARTHEST: f64 = 4.585;

/// log₂ of the distance ‖o‖/r at which the spacing of binary32 at t alone is a tenth of r.
const ROUNDING_OF_T: f64 = -SINGLE - 4.322;

/// log₂ of how much less is rounded in binary64: of the operations that count, o alone, since the
/// products of binary32 numbers are exact.
const ONLY_O: f64 = 2.0;

/// How a method gets D, which is what decides how it breaks down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DiscriminantForm {
    /// b² − AC in binary32; b is B/2, or B in the textbook.
    Coefficients { textbook: bool },
    /// r² − ‖o − (b/A)d‖² in binary32.
    Perpendicular,
    /// b² − C in binary32, which takes A to be 1.
    UnitLength,
    /// A r² − ‖o × d‖² in binary64.
    Lagrange,
    /// Certified: it does not break down.
    Certified,
    /// Somebody's own: nothing is known of it.
    Unknown,
}

impl DiscriminantForm {
    const fn of(method: Method) -> Self {
        match method {
            Method::Textbook | Method::Contracted => Self::Coefficients { textbook: true },
            Method::Citardauq | Method::Kahan => Self::Coefficients { textbook: false },
            Method::Unit => Self::UnitLength,
            Method::Haines => Self::Perpendicular,
            Method::Double => Self::Lagrange,
            Method::Exact => Self::Certified,
            Method::Routine(_) => Self::Unknown,
        }
    }
}

/// log₂ of the dial's value at the first wrong answer, and at the first hit moved by more than half
/// a pixel, among `rays` rays a setting; none for never.
pub(super) fn of(dial: &str, method: Method, rays: usize) -> [Option<f64>; 2] {
    use DiscriminantForm::{Certified, Coefficients, Lagrange, Perpendicular, UnitLength};
    let rays = rays as f64;
    // The relative error ε of cos²θ at which one of n rays, spread evenly from the centre to half a
    // radius outside, comes out on the wrong side: 2/n. And at which one of them moves by r/20:
    // ε/(2 cosθ) > 1/20 and cos²θ < 100ε², as 100ε²n/3 of them have.
    let side = (2.0 / rays).log2();
    let half_pixel = (0.02 / rays).sqrt().log2();
    match (dial, DiscriminantForm::of(method)) {
        // ε = u(‖o‖/r)² where r² is taken from ‖o‖², u‖o‖/r where the line's distance is computed.
        // Rounding t to binary32 moves the hit by u‖o‖ in any case, against r/20.
        ("distance", Coefficients { .. }) => {
            [side, half_pixel].map(|epsilon| Some((epsilon - SINGLE) / 2.0))
        }
        ("distance", Perpendicular) => [side, half_pixel].map(|epsilon| Some(epsilon - SINGLE)),
        ("distance", Lagrange) => [Some(side - DOUBLE + ONLY_O), Some(ROUNDING_OF_T)],
        ("distance", Certified) => [None, Some(ROUNDING_OF_T)],
        // C = ‖o‖² − r² is off by u·r², so t by u·r up to 1/cosθ = 5 times, against height/20.
        ("altitude", Coefficients { .. } | Perpendicular | UnitLength) => {
            [None, Some(SINGLE + 5.9)]
        }
        ("altitude", Lagrange) => [None, Some(DOUBLE + 5.9)],
        // Without A the error of D is (A − 1)C: as soon as A is not 1, or where C is at its least.
        ("distance", UnitLength) => [Some(1.0), None],
        ("tangency", UnitLength) => [Some(-1.0), None],
        ("long", UnitLength) => [Some(0.0), Some(0.0)],
        ("short", UnitLength) => [Some(0.0), None],
        // cos²θ against the same ε at four radii, at most twice the usual: 34u or 8u. Its root is
        // far below a twentieth.
        ("tangency", Coefficients { .. }) => [Some(0.5 * (SINGLE + 5.1)), None],
        ("tangency", Perpendicular) => [Some(0.5 * (SINGLE + 3.0)), None],
        ("tangency", Lagrange) => [Some(0.5 * (DOUBLE - ONLY_O + 3.0)), None],
        // B² or b², or C, passes 2¹²⁸; A r² later.
        ("large" | "long", Coefficients { textbook: true }) => [Some(64.0 - FARTHEST - 1.0), None],
        ("long", Coefficients { textbook: false }) => [Some(64.0 - FARTHEST), None],
        ("long", Perpendicular) => [Some(63.0), None],
        ("large", Coefficients { textbook: false } | Perpendicular | UnitLength) => {
            [Some(64.0 - FARTHEST), None]
        }
        // D = r²cos²θ s², or Δ, four times as much, is a multiple of 2⁻¹⁴⁹: ε = 2⁻¹⁴⁹/(r² s²), r from
        // 1/2.
        ("small", Coefficients { textbook: true }) => {
            [side, half_pixel].map(|epsilon| Some((-149.0 - epsilon) / 2.0))
        }
        ("small", Coefficients { textbook: false } | Perpendicular | UnitLength) => {
            [side, half_pixel].map(|epsilon| Some((-149.0 + 2.0 - epsilon) / 2.0))
        }
        // A is a multiple of 2⁻¹⁴⁹ and so off by α = 2⁻¹⁵⁰/‖d‖². b² − AC makes (‖o‖/r)² ≈ 50 of it;
        // the perpendicular form only its square, but its roots are divided by A.
        ("short", Coefficients { .. }) => {
            [side, half_pixel].map(|epsilon| Some((-150.0 - (epsilon - 50.0_f64.log2())) / 2.0))
        }
        ("short", Perpendicular) => {
            let side = side / 2.0 - 7.0_f64.log2();
            let half_pixel = -(12.0_f64 * 20.0).log2();
            [side, half_pixel].map(|alpha| Some((-150.0 - alpha) / 2.0))
        }
        _ => [None; 2],
    }
}

/// Whether a measured place, found in steps of `step`, is where theory puts it.
pub(super) fn agree(measured: Option<i32>, theory: Option<f64>, step: i32) -> bool {
    match (measured, theory) {
        (None, None) => true,
        (Some(k), Some(theory)) => {
            (f64::from(k) - theory).abs() <= AGREEMENT.log2() + f64::from(step)
        }
        _ => false,
    }
}
