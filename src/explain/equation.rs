//! The one place that joins what is equal by `=` and what is nearly so by `≈`.
//!
//! `=` joins two sides only if what is printed on both is equal. `≈` joins them where the left one,
//! evaluated as it is printed, rounds to the last digit of the right one. Other sides are not joined.

use dashu_int::IBig;

use crate::method::{Dyadic, Surd};

/// Numbers of at most this many digits are written in full.
const WHOLE: usize = 8;

/// A number as it is printed: a decimal, and what that decimal is.
#[derive(Debug, Clone)]
pub(super) struct Written {
    /// The decimal.
    pub text: String,
    /// What the decimal says, exactly.
    value: Surd,
    /// Its last digit counts 10^−places.
    places: i64,
    /// Whether it says all of the number that it was written for.
    pub is_whole: bool,
}

impl Written {
    /// The number in full if it is short, else rounded to `digits` digits.
    pub fn of(number: &Surd, digits: usize) -> Self {
        Self::in_full(number, WHOLE.max(digits)).unwrap_or_else(|| Self::rounded(number, digits))
    }

    /// All of the number; none if it has more than `most` digits.
    pub fn in_full(number: &Surd, most: usize) -> Option<Self> {
        let all = number.digits(most);
        let places = all.digits.len() as i64 - all.exponent;
        (all.exact && places.abs() < 400).then(|| Self::at(number, places.max(0)))
    }

    /// The number in full if it has no more than `digits` digits, else rounded to these.
    pub fn of_few(number: &Surd, digits: usize) -> Self {
        Self::in_full(number, digits).unwrap_or_else(|| Self::rounded(number, digits))
    }

    /// The number rounded to `digits` digits.
    pub fn rounded(number: &Surd, digits: usize) -> Self {
        let first = number.digits(1).exponent;
        let places = digits as i64 - first;
        let at = Self::at(number, places);
        // 9.996 rounds to 10.00, which has a digit more.
        if number.digits(1).digits == "9" && at.value.digits(1).exponent > first {
            return Self::at(number, places - 1).trimmed();
        }
        at.trimmed()
    }

    /// Without zeros behind its last other decimal: what rounds to it rounds to that, too.
    fn trimmed(self) -> Self {
        if self.places <= 0 || !self.text.ends_with('0') || self.text.contains('e') {
            return self;
        }
        let places = self.places - 1;
        let text = self.text[..self.text.len() - 1]
            .trim_end_matches('.')
            .to_owned();
        Self {
            text,
            places,
            ..self
        }
        .trimmed()
    }

    /// The number rounded to `places` decimals.
    pub fn at(number: &Surd, places: i64) -> Self {
        let units = number.in_decimal_units(places);
        let value = decimal(units.clone(), places);
        Self {
            is_whole: difference(number, &value).is_some_and(|off| off.is_zero()),
            text: text(&units, places),
            value,
            places,
        }
    }

    /// A term of a sum, with `places` decimals; 0 is written without decimals.
    pub fn term(number: &Surd, places: i64) -> Self {
        Self::at(number, if number.is_zero() { 0 } else { places })
    }

    /// The number with `places` decimals, where it was written in full with fewer.
    pub fn padded(&self, places: i64) -> Self {
        Self::at(&self.value, places)
    }

    /// The decimals that are written.
    pub const fn places(&self) -> i64 {
        self.places
    }

    pub fn is_negative(&self) -> bool {
        self.text.starts_with('−')
    }

    /// The same number with the other sign.
    pub fn negated(&self) -> Self {
        let text = match self.text.strip_prefix('−') {
            Some(magnitude) => magnitude.to_owned(),
            None if self.value.is_zero() => self.text.clone(),
            None => format!("−{}", self.text),
        };
        Self {
            text,
            value: -self.value.clone(),
            ..self.clone()
        }
    }

    /// In parentheses if it has a sign.
    pub fn bracketed(&self) -> String {
        if self.is_negative() {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

/// units·10^−places.
fn decimal(units: IBig, places: i64) -> Surd {
    let power = |n: i64| Dyadic::new(IBig::from(10).pow(n.max(0) as usize), 0);
    let units = &Dyadic::new(units, 0) * &power(-places);
    Surd::new(units, Dyadic::ZERO, Dyadic::ZERO, power(places)).unwrap_or_else(zero)
}

fn zero() -> Surd {
    Surd::from(Dyadic::ZERO)
}

fn difference(x: &Surd, y: &Surd) -> Option<Surd> {
    x.checked_sub(y)
}

/// units·10^−places in digits; with an exponent where it is far from 1.
fn text(units: &IBig, places: i64) -> String {
    let digits = units.to_string();
    let (sign, digits) = match digits.strip_prefix('-') {
        Some(digits) => ("−", digits),
        None => ("", digits.as_str()),
    };
    let whole = digits.len() as i64 - places;
    if digits == "0" {
        return if places > 0 && places < 40 {
            format!("0.{}", "0".repeat(places as usize))
        } else {
            "0".into()
        };
    }
    let plain = places >= 0 && (whole > -4 || places <= 10);
    if plain && places == 0 {
        format!("{sign}{digits}")
    } else if plain && whole > 0 {
        let (whole, behind) = digits.split_at(whole as usize);
        format!("{sign}{whole}.{behind}")
    } else if plain {
        format!("{sign}0.{}{digits}", "0".repeat((-whole) as usize))
    } else {
        let (first, rest) = digits.split_at(1);
        let dot = if rest.is_empty() { "" } else { "." };
        let (exponent, minus) = (whole - 1, if whole < 1 { "−" } else { "" });
        format!("{sign}{first}{dot}{rest}e{minus}{}", exponent.abs())
    }
}

/// How two sides are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// What is printed on both sides is equal.
    Equal,
    /// The left side rounds to the right one.
    Near,
    /// What an operation of the machine gave.
    Gives,
    /// A line of its own, joined to nothing.
    Nothing,
}

impl Sign {
    /// The sign.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Equal => "=",
            Self::Near => "≈",
            Self::Gives => "→",
            Self::Nothing => "",
        }
    }

    /// How a formula in letters is joined to a number that is printed for it.
    pub(super) const fn of_letters(is_whole: bool) -> Self {
        if is_whole { Self::Equal } else { Self::Near }
    }
}

/// How a binary64 is joined to the decimal that is shown for it.
pub fn sign_of_shown(value: f64, shown: &str) -> Sign {
    let read = shown.replace('−', "-").parse::<f64>();
    Sign::of_letters(read.is_ok_and(|read| read == value))
}

/// How `left`, evaluated as it is printed, is joined to the number `right`; none if it is not to be.
pub(super) fn relation(left: &Surd, right: &Written) -> Option<Sign> {
    let off = difference(left, &right.value)?;
    if off.is_zero() {
        return Some(Sign::Equal);
    }
    let half = decimal(IBig::from(5), right.places + 1);
    let short = half.checked_sub(&off.abs())?;
    (short.sign().is_gt()).then_some(Sign::Near)
}

/// An expression in numbers as it is printed.
#[derive(Debug, Clone)]
pub(super) struct Expression {
    text: String,
    value: Option<Surd>,
    /// A sum, which needs parentheses in a product.
    is_sum: bool,
}

impl Expression {
    pub fn number(number: &Written) -> Self {
        Self {
            text: number.text.clone(),
            value: Some(number.value.clone()),
            is_sum: false,
        }
    }

    pub fn whole(number: i32) -> Self {
        Self::number(&Written::at(&Surd::from(Dyadic::new(number.into(), 0)), 0))
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    /// What it says, exactly; none where that has no place among the numbers that are kept.
    pub const fn value(&self) -> Option<&Surd> {
        self.value.as_ref()
    }

    /// How the expression is joined to a number; none if it is not to be.
    pub fn relation(&self, right: &Written) -> Option<Sign> {
        relation(self.value.as_ref()?, right)
    }

    fn factor(&self) -> String {
        if self.is_sum || self.text.starts_with('−') {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        let value = |x: &Surd, y: &Surd| x.checked_add(y);
        // A term below zero is taken away.
        let text = match other.text.strip_prefix('−') {
            Some(magnitude) if !other.is_sum => format!("{} − {magnitude}", self.text),
            _ => format!("{} + {}", self.text, other.text),
        };
        self.joined(other, text, true, value)
    }

    pub fn minus(&self, other: &Self) -> Self {
        let text = format!("{} − {}", self.text, other.factor());
        self.joined(other, text, true, Surd::checked_sub)
    }

    pub fn times(&self, other: &Self) -> Self {
        let text = format!("{}·{}", self.factor(), other.factor());
        self.joined(other, text, false, Surd::checked_mul)
    }

    pub fn over(&self, other: &Self) -> Self {
        let below = if other.text.contains('·') {
            format!("({})", other.text)
        } else {
            other.factor()
        };
        let text = format!("{} / {below}", self.factor());
        self.joined(other, text, false, Surd::checked_div)
    }

    pub fn squared(&self) -> Self {
        let value = |x: &Surd, y: &Surd| x.checked_mul(y);
        self.joined(self, format!("{}²", self.factor()), false, value)
    }

    pub fn root(&self) -> Self {
        let inside = if self.text.contains(' ') || self.text.contains('·') {
            format!("({})", self.text)
        } else {
            self.text.clone()
        };
        Self {
            text: format!("√{inside}"),
            value: self.value.as_ref().and_then(Surd::checked_sqrt),
            is_sum: false,
        }
    }

    fn joined(
        &self,
        other: &Self,
        text: String,
        is_sum: bool,
        value: impl Fn(&Surd, &Surd) -> Option<Surd>,
    ) -> Self {
        let values = self.value.as_ref().zip(other.value.as_ref());
        Self {
            text,
            value: values.and_then(|(x, y)| value(x, y)),
            is_sum,
        }
    }

    /// The number with the most digits, `digits` at most and `least` at least, to which the expression
    /// can be joined.
    pub fn result(&self, number: &Surd, digits: usize, least: usize) -> Option<(Sign, Written)> {
        let digits = digits.max(number.digits(1).exponent.clamp(0, 9) as usize);
        let whole = Written::in_full(number, WHOLE).into_iter();
        let rounded = (least..=digits).rev().map(|n| Written::rounded(number, n));
        whole
            .chain(rounded)
            .find_map(|written| Some((self.relation(&written)?, written)))
    }
}

/// The sum of terms with as many decimals, equal in number, as it takes for the printed sum to be the
/// printed number; none if `most` decimals are too few.
pub(super) fn sum_of(terms: &[Surd], result: &Written, most: i64) -> Option<Vec<Written>> {
    let all: Option<Vec<_>> = terms.iter().map(|t| Written::in_full(t, WHOLE)).collect();
    let first = result.places().max(0);
    let equal_places = (first..=most.max(first)).map(|places| {
        terms
            .iter()
            .map(|t| Written::term(t, places))
            .collect::<Vec<_>>()
    });
    all.into_iter().chain(equal_places).find(|written| {
        let sum = written
            .iter()
            .try_fold(zero(), |sum, term| sum.checked_add(&term.value));
        sum.is_some_and(|sum| relation(&sum, result) == Some(Sign::Equal))
    })
}
