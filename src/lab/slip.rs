//! The slips that people make with the quadratic, by name: what comes out if one is made.

/// A known slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Slip {
    /// B² − AC.
    Missing4,
    /// d·o for B, with the rest as for B = 2 d·o.
    HalfB,
    /// c − p0 for p0 − c.
    SignOfO,
    /// |o|² − r.
    RForR2,
    /// Δ = 0 taken for a miss.
    TangentIsAMiss,
    /// Divided by A, not by 2A.
    MinusBOverA,
    /// A t below 0 given as a hit.
    NegativeT,
    /// The larger root where the smaller is seen.
    FarForNear,
}

impl Slip {
    /// All slips.
    pub const ALL: [Self; 8] = [
        Self::Missing4,
        Self::HalfB,
        Self::SignOfO,
        Self::RForR2,
        Self::TangentIsAMiss,
        Self::MinusBOverA,
        Self::NegativeT,
        Self::FarForNear,
    ];

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Missing4 => "missing-4",
            Self::HalfB => "half-b",
            Self::SignOfO => "sign-of-o",
            Self::RForR2 => "r-for-r2",
            Self::TangentIsAMiss => "tangent-is-a-miss",
            Self::MinusBOverA => "minus-b-over-a",
            Self::NegativeT => "negative-t",
            Self::FarForNear => "far-for-near",
        }
    }

    /// What was done, in a sentence.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Missing4 => "the 4 is missing: the discriminant is B² − 4AC",
            Self::HalfB => "B is taken as d·o, but the formula around it is the one for B = 2 d·o",
            Self::SignOfO => {
                "o points the wrong way: it is p0 − c, from the centre to the start of the ray"
            }
            Self::RForR2 => "r is subtracted instead of r²: C = |o|² − r²",
            Self::TangentIsAMiss => {
                "a discriminant of 0 is a tangent: the ray touches, and only below 0 it misses"
            }
            Self::MinusBOverA => "the roots are divided by A instead of 2A",
            Self::NegativeT => {
                "a t below 0 lies behind the eye and is not seen; from inside, the far root is seen"
            }
            Self::FarForNear => "the far root is given, but the near one is seen",
        }
    }

    /// The discriminant and both roots if this slip is made, from o, d and r; none for a slip that is not in
    /// the formula.
    pub fn formula(self, o: [f64; 3], d: [f64; 3], r: f64) -> Option<(f64, [f64; 2])> {
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let a = dot(d, d);
        let b = match self {
            Self::HalfB => dot(d, o),
            Self::SignOfO => -2.0 * dot(d, o),
            _ => 2.0 * dot(d, o),
        };
        let c = dot(o, o) - if self == Self::RForR2 { r } else { r * r };
        let four = if self == Self::Missing4 { 1.0 } else { 4.0 };
        let discriminant = b * b - four * a * c;
        let under = if self == Self::MinusBOverA {
            a
        } else {
            2.0 * a
        };
        let roots = [-1.0, 1.0].map(|sign| (-b + sign * discriminant.sqrt()) / under);
        let [near, far] = roots;
        match self {
            Self::TangentIsAMiss | Self::NegativeT => None,
            Self::FarForNear => Some((discriminant, [far, near])),
            _ => Some((discriminant, roots)),
        }
    }
}
