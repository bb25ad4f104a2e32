//! What a person may be asked to predict, and how an answer is judged.

use super::sheet::WorkedQuadratic;
use crate::lab::slip::Slip;
use crate::method::{Class, Place, Surd};
use crate::text::read;

/// A question that a line of the sheet answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StepQuestion {
    /// The number A.
    A,
    /// The number B.
    B,
    /// The number C.
    C,
    /// The number Δ.
    Delta,
    /// How many points have line and sphere in common?
    Count,
    /// The smaller root.
    Near,
    /// The larger root.
    Far,
    /// Which root is seen?
    Seen,
}

/// An answer to choose: the key, and what it says.
pub type Choice = (char, &'static str);

/// What is said to an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judgement {
    /// It is right.
    Right,
    /// It is wrong, by a known slip.
    Slip(Slip),
    /// It is wrong.
    Wrong,
}

/// So far a number may be off, of itself.
const TOLERANCE: f64 = 0.01;

impl StepQuestion {
    /// All questions.
    pub const ALL: [Self; 8] = [
        Self::A,
        Self::B,
        Self::C,
        Self::Delta,
        Self::Count,
        Self::Near,
        Self::Far,
        Self::Seen,
    ];

    /// The question of a method's step of that symbol.
    pub(super) fn of_symbol(symbol: &str) -> Option<Self> {
        Some(match symbol {
            "A" => Self::A,
            "B" => Self::B,
            "C" => Self::C,
            "Δ" => Self::Delta,
            "near" => Self::Near,
            "far" => Self::Far,
            _ => return None,
        })
    }

    /// The question as it is asked.
    pub const fn text(self) -> &'static str {
        match self {
            Self::A => "What is A?",
            Self::B => "What is B?",
            Self::C => "What is C?",
            Self::Delta => "What is Δ?",
            Self::Count => "How many points do line and sphere share?",
            Self::Near => "What is near, the smaller t?",
            Self::Far => "What is far, the larger t?",
            Self::Seen => "Which root is seen?",
        }
    }

    /// A word for it in a list.
    pub const fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::Delta => "Δ",
            Self::Count => "points",
            Self::Near => "near",
            Self::Far => "far",
            Self::Seen => "seen",
        }
    }

    /// The answers to choose from; none where a number is to be typed.
    pub const fn choices(self) -> Option<[Choice; 3]> {
        match self {
            Self::Count => Some([('0', "none"), ('1', "one"), ('2', "two")]),
            Self::Seen => Some([('0', "neither"), ('n', "near"), ('f', "far")]),
            _ => None,
        }
    }

    /// How to answer.
    pub fn hint(self) -> String {
        match self.choices() {
            Some(choices) => choices
                .map(|(key, word)| format!("{key} {word}"))
                .join("   "),
            None => "type a number; within 1 % is right".into(),
        }
    }

    /// Judges an answer: a number, or the key or the word of a choice. Says what was expected if it is
    /// neither.
    pub(super) fn judge(self, answer: &str, q: &Given<'_>) -> Result<Judgement, String> {
        let answer = answer.trim();
        let Some(choices) = self.choices() else {
            let typed = answer.replace('−', "-");
            let number = read::binary64(&typed).filter(|x| x.is_finite());
            let number = number
                .ok_or_else(|| format!("found “{answer}”, expected a number, such as −40"))?;
            return Ok(self.judge_number(number, q.quadratic));
        };
        let meant = |(key, word): &Choice| answer == *word || answer.chars().eq([*key]);
        let chosen = choices.iter().position(meant).ok_or_else(|| {
            let words = choices.map(|(key, word)| format!("{key} for {word}"));
            format!("found “{answer}”, expected {}", words.join(", "))
        })?;
        Ok(self.judge_choice(chosen, q))
    }

    fn judge_choice(self, chosen: usize, q: &Given<'_>) -> Judgement {
        let right = self.right_choice(q);
        match (self, right, chosen) {
            _ if right == chosen => Judgement::Right,
            (Self::Count, 1, 0) => Judgement::Slip(Slip::TangentIsAMiss),
            (Self::Seen, 2, 1) | (Self::Seen, 0, 1 | 2)
                if q.quadratic.truth.class() != Class::Miss =>
            {
                Judgement::Slip(Slip::NegativeT)
            }
            (Self::Seen, 1, 2) => Judgement::Slip(Slip::FarForNear),
            _ => Judgement::Wrong,
        }
    }

    fn right_choice(self, q: &Given<'_>) -> usize {
        match self {
            Self::Seen => match q.place {
                Some(Place::Hit) => 1,
                Some(Place::Inside) => 2,
                Some(Place::Behind) | None => 0,
            },
            _ => match q.quadratic.truth.class() {
                Class::Miss | Class::Nan => 0,
                Class::Tangent => 1,
                Class::Secant | Class::Hit => 2,
            },
        }
    }

    /// The right answer as it is written on the sheet.
    pub(super) fn right(self, q: &Given<'_>) -> String {
        let root = |i: usize| {
            let roots = q.quadratic.roots.as_ref();
            roots
                .map_or("nowhere", |roots| roots[i].written.text.as_str())
                .to_owned()
        };
        match self {
            Self::A => q.quadratic.a.text.clone(),
            Self::B => q.quadratic.b.text.clone(),
            Self::C => q.quadratic.c.text.clone(),
            Self::Delta => q.quadratic.delta.text.clone(),
            Self::Near => root(0),
            Self::Far => root(1),
            Self::Count | Self::Seen => self
                .choices()
                .map_or("", |choices| choices[self.right_choice(q)].1)
                .to_owned(),
        }
    }

    fn judge_number(self, number: f64, q: &WorkedQuadratic) -> Judgement {
        let exact = |x: &crate::method::Dyadic| Surd::from(x.clone()).to_f64();
        let [a, b, c] = [exact(&q.truth.a), exact(&q.truth.b()), exact(&q.truth.c)];
        let r = q.radius().to_f64();
        let delta = exact(&q.truth.discriminant());
        let is = |wanted: f64| (number - wanted).abs() <= TOLERANCE * wanted.abs();
        let root = |b: f64, delta: f64, side: f64| (-b + side * delta.sqrt()) / (2.0 * a);
        let wrong: Vec<(Slip, f64)> = match self {
            Self::B => vec![(Slip::HalfB, b / 2.0), (Slip::SignOfO, -b)],
            Self::C => vec![(Slip::RForR2, c + r * r - r)],
            Self::Delta => vec![
                (Slip::Missing4, b * b - a * c),
                (Slip::HalfB, b * b / 4.0 - 4.0 * a * c),
                (Slip::RForR2, b * b - 4.0 * a * (c + r * r - r)),
            ],
            Self::Near | Self::Far => {
                let side = if self == Self::Near { -1.0 } else { 1.0 };
                let mut slips = vec![
                    (Slip::MinusBOverA, 2.0 * root(b, delta, side)),
                    (Slip::SignOfO, root(-b, delta, side)),
                    (Slip::HalfB, root(b / 2.0, delta, side)),
                    (Slip::Missing4, root(b, b * b - a * c, side)),
                ];
                if self == Self::Near {
                    slips.insert(0, (Slip::FarForNear, root(b, delta, 1.0)));
                }
                slips
            }
            Self::A | Self::Count | Self::Seen => Vec::new(),
        };
        let right = match self {
            Self::A => a,
            Self::B => b,
            Self::C => c,
            Self::Delta => delta,
            _ => {
                let at = usize::from(self == Self::Far);
                let roots = q.roots.as_ref();
                roots.map_or(f64::NAN, |roots| roots[at].exact.to_f64())
            }
        };
        if is(right) {
            return Judgement::Right;
        }
        // A slip that gives the right number is none.
        let named = wrong.into_iter().find(|&(_, value)| is(value));
        named.map_or(Judgement::Wrong, |(slip, _)| Judgement::Slip(slip))
    }
}

/// What an answer is held to.
pub(super) struct Given<'a> {
    pub quadratic: &'a WorkedQuadratic,
    pub place: Option<Place>,
}
