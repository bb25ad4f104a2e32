//! Binary64 for a block of rays at once; lanes that it leaves open are marked, for the single call.
//!
//! A loop holds the formula of a single ray without a branch, and the compiler makes vectors of it;
//! what needs comparing is left in arrays, for loops of its own.

use super::binary64::{self, Input};
use super::rounding::round;
use crate::method::Class;

/// How many rays a block has.
pub const LANES: usize = 16;

/// So many open lanes are worth another pass over the whole block.
const WORTH_A_PASS: usize = 4;

/// The rays and spheres of a block.
pub trait Inputs {
    /// The numbers of a lane, below [`LANES`]; `#[inline(always)]`.
    fn input(&self, lane: usize) -> Input<f64>;
}

/// What binary64 found of each lane. Where `open`, the rest has no meaning.
#[derive(Debug, Clone, Copy)]
pub struct LaneAnswers {
    /// Miss or secant.
    pub class: [Class; LANES],
    /// The smaller root, NaN for a miss.
    pub near: [f32; LANES],
    /// The larger root, NaN for a miss.
    pub far: [f32; LANES],
    /// Whether the lane needs the stages beyond.
    pub open: [bool; LANES],
    /// Whether it took the compensated C.
    pub compensated: [bool; LANES],
}

/// Class and roots of the lanes of a block.
#[inline(always)]
pub fn solve(inputs: &impl Inputs) -> LaneAnswers {
    let mut block = direct(inputs);
    if block.open.iter().filter(|&&open| open).count() >= WORTH_A_PASS {
        compensate(inputs, &mut block);
    }
    block
}

/// Classes alone, and which lanes are open: no roots.
#[inline(always)]
pub fn classes(inputs: &impl Inputs) -> ([Class; LANES], [bool; LANES]) {
    let [mut d, mut threshold] = [[0.0; LANES]; 2];
    for i in 0..LANES {
        let discriminant = binary64::discriminant(&inputs.input(i));
        d[i] = discriminant.d;
        threshold[i] = discriminant.threshold();
    }
    let (mut class, mut open) = ([Class::Miss; LANES], [false; LANES]);
    for i in 0..LANES {
        class[i] = if d[i] > 0.0 {
            Class::Secant
        } else {
            Class::Miss
        };
        let certain = d[i].abs() > threshold[i];
        open[i] = !certain;
    }
    (class, open)
}

/// Stage 1, as the single call runs it.
#[inline(always)]
fn direct(inputs: &impl Inputs) -> LaneAnswers {
    let [mut d, mut threshold, mut d_error, mut limit] = [[0.0; LANES]; 4];
    let [mut near, mut near_too, mut far, mut far_too] = [[0.0; LANES]; 4];
    for i in 0..LANES {
        let input = inputs.input(i);
        let discriminant = binary64::discriminant(&input);
        let direct = binary64::direct(&input, &discriminant);
        d[i] = discriminant.d;
        threshold[i] = discriminant.threshold();
        d_error[i] = discriminant.d_error;
        limit[i] = direct.d_error_limit;
        [near[i], near_too[i]] = direct.near.map(round);
        [far[i], far_too[i]] = direct.far.map(round);
    }

    let mut block = LaneAnswers {
        class: [Class::Secant; LANES],
        near,
        far,
        open: [false; LANES],
        compensated: [false; LANES],
    };
    for i in 0..LANES {
        let miss = d[i] < -threshold[i];
        let secant = d[i] > threshold[i]
            && d_error[i] < limit[i]
            && near[i] == near_too[i]
            && far[i] == far_too[i]
            && places(near[i], far[i]);
        block.open[i] = !(miss || secant);
        block.class[i] = if miss { Class::Miss } else { Class::Secant };
        block.near[i] = if miss { f32::NAN } else { near[i] };
        block.far[i] = if miss { f32::NAN } else { far[i] };
    }
    block
}

/// Whether two roots say where the sphere lies: of one that rounds to 0 the sign is not known.
#[inline(always)]
fn places(near: f32, far: f32) -> bool {
    near != 0.0 && far != 0.0
}

/// Settles those of the open lanes that the compensated C can settle.
#[inline(always)]
fn compensate(inputs: &impl Inputs, block: &mut LaneAnswers) {
    let [mut d, mut threshold] = [[0.0; LANES]; 2];
    let [mut near, mut near_too, mut far, mut far_too] = [[0.0; LANES]; 4];
    for i in 0..LANES {
        let input = inputs.input(i);
        let discriminant = binary64::discriminant(&input);
        let roots = binary64::roots(&binary64::compensated(&input, &discriminant));
        d[i] = discriminant.d;
        threshold[i] = discriminant.threshold();
        [near[i], near_too[i]] = roots.near().ends().map(round);
        [far[i], far_too[i]] = roots.far().ends().map(round);
    }
    for i in 0..LANES {
        let secant = d[i] > threshold[i]
            && near[i] == near_too[i]
            && far[i] == far_too[i]
            && places(near[i], far[i]);
        if block.open[i] && secant {
            block.open[i] = false;
            block.compensated[i] = true;
            block.near[i] = near[i];
            block.far[i] = far[i];
        }
    }
}
