//! What is joined by `=` is equal as it is printed, and what is joined by `≈` is so once the left side is
//! rounded to the last digit of the right one: over scenes, pixels, lenses and panels.
//!
//! The printed text is read back and evaluated here with whole numbers of any size, without the code that
//! wrote it.

use std::cmp::Ordering;

use dashu_int::IBig;
use rayscope::explain::Digits;
use rayscope::explain::{
    Lens, Reading, SheetLook, lines, plain_text, sheet, sheet_lines, sheet_text,
};
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::Method;
use rayscope::render::{Style, fit};
use rayscope::scene::{Builtin, Rays};
use rayscope::text::Glyphs;

/// n/d, d > 0.
#[derive(Debug, Clone)]
struct Ratio {
    n: IBig,
    d: IBig,
}

impl Ratio {
    fn new(n: IBig, d: IBig) -> Self {
        match d.cmp(&IBig::ZERO) {
            Ordering::Less => Self { n: -n, d: -d },
            Ordering::Greater => Self { n, d },
            Ordering::Equal => panic!("a division by zero"),
        }
    }

    fn whole(n: i64) -> Self {
        Self::new(n.into(), IBig::ONE)
    }

    /// The number that a binary32 stands for.
    fn of(x: f32) -> Self {
        let bits = f64::from(x).to_bits();
        let (exponent, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
        let (m, e) = match exponent {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, exponent as i64 - 1075),
        };
        let m = IBig::from(m) * if x < 0.0 { IBig::NEG_ONE } else { IBig::ONE };
        if e < 0 {
            Self::new(m, IBig::ONE << (-e) as usize)
        } else {
            Self::new(m << e as usize, IBig::ONE)
        }
    }

    fn add(&self, o: &Self) -> Self {
        Self::new(&self.n * &o.d + &o.n * &self.d, &self.d * &o.d)
    }

    fn neg(&self) -> Self {
        Self::new(-&self.n, self.d.clone())
    }

    fn mul(&self, o: &Self) -> Self {
        Self::new(&self.n * &o.n, &self.d * &o.d)
    }

    fn over(&self, o: &Self) -> Self {
        Self::new(&self.n * &o.d, &self.d * &o.n)
    }

    fn sign(&self) -> Ordering {
        self.n.cmp(&IBig::ZERO)
    }
}

/// a + b√n.
#[derive(Debug, Clone)]
struct Number {
    a: Ratio,
    b: Ratio,
    n: Ratio,
}

impl Number {
    fn rational(a: Ratio) -> Self {
        Self {
            a,
            b: Ratio::whole(0),
            n: Ratio::whole(0),
        }
    }

    fn root(&self) -> &Ratio {
        &self.n
    }

    fn with(&self, o: &Self, f: impl Fn(&Ratio, &Ratio) -> Ratio) -> Self {
        let n = if self.b.sign() == Ordering::Equal {
            o.root()
        } else {
            self.root()
        };
        Self {
            a: f(&self.a, &o.a),
            b: f(&self.b, &o.b),
            n: n.clone(),
        }
    }

    fn add(&self, o: &Self) -> Self {
        self.with(o, Ratio::add)
    }

    fn sub(&self, o: &Self) -> Self {
        self.with(o, |x, y| x.add(&y.neg()))
    }

    fn mul(&self, o: &Self) -> Self {
        let n = if self.b.sign() == Ordering::Equal {
            o.root()
        } else {
            self.root()
        }
        .clone();
        Self {
            a: self.a.mul(&o.a).add(&self.b.mul(&o.b).mul(&n)),
            b: self.a.mul(&o.b).add(&self.b.mul(&o.a)),
            n,
        }
    }

    /// Divisors here are rational.
    fn over(&self, o: &Self) -> Self {
        assert_eq!(o.b.sign(), Ordering::Equal);
        Self {
            a: self.a.over(&o.a),
            b: self.b.over(&o.a),
            n: self.n.clone(),
        }
    }

    fn sqrt(&self) -> Self {
        assert_eq!(self.b.sign(), Ordering::Equal);
        Self {
            a: Ratio::whole(0),
            b: Ratio::whole(1),
            n: self.a.clone(),
        }
    }

    /// How the number compares with zero: the greater of a² and b²n decides where the signs differ.
    fn sign(&self) -> Ordering {
        let root = if self.n.sign() == Ordering::Equal {
            Ordering::Equal
        } else {
            self.b.sign()
        };
        match (self.a.sign(), root) {
            (x, y) if x == y || y == Ordering::Equal => x,
            (Ordering::Equal, y) => y,
            (x, y) => {
                let squares = self
                    .a
                    .mul(&self.a)
                    .add(&self.b.mul(&self.b).mul(&self.n).neg());
                match squares.sign() {
                    Ordering::Greater => x,
                    Ordering::Less => y,
                    Ordering::Equal => Ordering::Equal,
                }
            }
        }
    }
}

/// Reads an expression in numbers.
struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn read(text: &str) -> Option<Number> {
        let mut reader = Reader { rest: text.trim() };
        let value = reader.sum()?;
        reader.rest.trim().is_empty().then_some(value)
    }

    fn takes(&mut self, c: char) -> bool {
        let rest = self.rest.trim_start();
        let is_there = rest.starts_with(c);
        self.rest = rest.strip_prefix(c).unwrap_or(rest);
        is_there
    }

    fn sum(&mut self) -> Option<Number> {
        let mut sum = self.product()?;
        loop {
            if self.takes('+') {
                sum = sum.add(&self.product()?);
            } else if self.takes('−') {
                sum = sum.sub(&self.product()?);
            } else {
                return Some(sum);
            }
        }
    }

    fn product(&mut self) -> Option<Number> {
        let mut product = self.factor()?;
        loop {
            if self.takes('·') {
                product = product.mul(&self.factor()?);
            } else if self.takes('/') {
                product = product.over(&self.factor()?);
            } else {
                return Some(product);
            }
        }
    }

    fn factor(&mut self) -> Option<Number> {
        if self.takes('−') {
            let zero = Number::rational(Ratio::whole(0));
            return Some(zero.sub(&self.factor()?));
        }
        if self.takes('√') {
            return Some(self.factor()?.sqrt());
        }
        let base = if self.takes('(') {
            let inside = self.sum()?;
            self.takes(')').then_some(inside)?
        } else {
            Number::rational(self.decimal()?.0)
        };
        Some(if self.takes('²') {
            base.mul(&base)
        } else {
            base
        })
    }

    /// A decimal, and what its last digit counts.
    fn decimal(&mut self) -> Option<(Ratio, Ratio)> {
        let rest = self.rest.trim_start();
        let end = rest
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(rest.len());
        let (digits, mut after) = rest.split_at(end);
        let places = digits.split_once('.').map_or(0, |(_, behind)| behind.len());
        let units: IBig = digits.replace('.', "").parse().ok()?;
        let mut exponent = -(places as i64);
        if let Some(tail) = after.strip_prefix('e') {
            let (sign, tail) = tail.strip_prefix('−').map_or((1, tail), |tail| (-1, tail));
            let end = tail
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(tail.len());
            exponent += sign * tail[..end].parse::<i64>().ok()?;
            after = &tail[end..];
        }
        self.rest = after;
        let ten = |n: i64| IBig::from(10).pow(n.max(0) as usize);
        let unit = Ratio::new(ten(exponent), ten(-exponent));
        Some((Ratio::new(units, IBig::ONE).mul(&unit), unit))
    }
}

/// A single number with what its last digit counts.
fn single(text: &str) -> Option<(Number, Ratio)> {
    let text = text.trim();
    let (sign, digits) = text
        .strip_prefix('−')
        .map_or((1, text), |digits| (-1, digits));
    let mut reader = Reader { rest: digits };
    let (value, unit) = reader.decimal()?;
    let value = Number::rational(value.mul(&Ratio::whole(sign)));
    reader.rest.trim().is_empty().then_some((value, unit))
}

/// Whether `left` is joined rightly to the number that `right` prints.
fn is_joined(left: &Number, sign: char, right: &str) -> bool {
    let (value, unit) =
        single(right).unwrap_or_else(|| (Reader::read(right).unwrap(), Ratio::whole(0)));
    let off = left.sub(&value);
    if sign == '=' {
        return off.sign() == Ordering::Equal;
    }
    let half = Number::rational(unit.over(&Ratio::whole(2)));
    // A tie rounds to either side.
    off.sign() != Ordering::Equal
        && off.sub(&half).sign() != Ordering::Greater
        && off.add(&half).sign() != Ordering::Less
}

/// What the letters stand for, exactly.
struct Exact {
    letters: Vec<(&'static str, Number)>,
}

impl Exact {
    fn of(ray: &Ray, sphere: &Sphere) -> Self {
        let vector = |v: glam::Vec3| v.to_array().map(Ratio::of);
        let (p0, d, c) = (
            vector(ray.origin),
            vector(ray.direction),
            vector(sphere.center),
        );
        let r = Ratio::of(sphere.radius);
        let o = [0, 1, 2].map(|i: usize| p0[i].add(&c[i].neg()));
        let dot = |u: &[Ratio; 3], v: &[Ratio; 3]| {
            (0..3).fold(Ratio::whole(0), |sum, i| sum.add(&u[i].mul(&v[i])))
        };
        let a = dot(&d, &d);
        let b = dot(&d, &o).mul(&Ratio::whole(2));
        let cc = dot(&o, &o).add(&r.mul(&r).neg());
        let delta = b.mul(&b).add(&a.mul(&cc).mul(&Ratio::whole(-4)));
        let below = a.mul(&Ratio::whole(2));
        let root = |side: i64| Number {
            a: b.neg().over(&below),
            b: Ratio::whole(side).over(&below),
            n: delta.clone(),
        };
        let rational = Number::rational;
        let mut letters = vec![
            ("A", rational(a.clone())),
            ("B", rational(b.clone())),
            ("C", rational(cc)),
            ("Δ", rational(delta.clone())),
            ("t", rational(b.neg().over(&below))),
        ];
        if delta.sign() != Ordering::Less {
            letters.extend([("near", root(-1)), ("far", root(1))]);
        }
        Self { letters }
    }

    fn letter(&self, name: &str) -> Option<&Number> {
        self.letters
            .iter()
            .find(|(letter, _)| *letter == name)
            .map(|(_, number)| number)
    }
}

/// Statements of a text, each in one line: what is broken before a sign or in a sum is joined again.
fn statements(text: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    for line in text.lines() {
        let line = line.replace('▸', " ");
        let words = line.trim();
        let goes_on = words.starts_with(['=', '≈']) && !words.starts_with("= ?");
        match out.last_mut() {
            Some(last) if goes_on => *last = format!("{last} {words}"),
            // A long sum goes on in the next line.
            Some(last)
                if line.starts_with("    ")
                    && last.contains(['=', '≈'])
                    && words.starts_with(|c: char| c.is_ascii_digit() || "+−·(".contains(c))
                    && !words.contains(char::is_alphabetic) =>
            {
                *last = format!("{last} {words}");
            }
            _ => out.push(words.to_owned()),
        }
    }
    out
}

/// How many joints were held to what they join.
#[derive(Debug, Default)]
struct Count {
    numeric: usize,
    letters: usize,
    vectors: usize,
    ledgers: usize,
}

/// The i-th component of an expression of vectors.
fn component(text: &str, i: usize) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find('(') {
        let end = rest[start..]
            .find(')')
            .map_or(rest.len(), |end| start + end);
        let inside = &rest[start + 1..end];
        out += &rest[..start];
        match inside.split(", ").nth(i) {
            Some(part) if inside.contains(", ") => out = format!("{out}({part})"),
            _ => out = format!("{out}({inside})"),
        }
        rest = rest.get(end + 1..).unwrap_or_default();
    }
    out + rest
}

/// Holds every joint of a text to what it joins.
fn hold(text: &str, exact: &Exact, count: &mut Count) {
    let mut ledger: Vec<Number> = Vec::new();
    for statement in statements(text) {
        let words: Vec<_> = statement
            .split("  ")
            .map(str::trim)
            .filter(|w| !w.is_empty())
            .collect();
        let term = words.last().and_then(|last| single(last));
        let is_term = ["B²", "4AC", "|p0 − c|²", "r²"].iter().any(|name| {
            words
                .first()
                .is_some_and(|first| first.trim_start_matches("− ") == *name)
        });
        if let (Some((number, _)), true) = (term, is_term && words.len() == 2) {
            ledger.push(number);
            continue;
        }
        let mut signs = statement.chars().filter(|c| matches!(c, '=' | '≈'));
        let parts: Vec<_> = statement.split(['=', '≈']).map(str::trim).collect();
        if let [x, y] = &ledger[..]
            && let Some((result, _)) = parts.last().and_then(|last| single(last))
        {
            assert_eq!(x.sub(y).sub(&result).sign(), Ordering::Equal, "{text}");
            count.ledgers += 1;
        }
        ledger.clear();
        let mut is_equal_so_far = true;
        for pair in parts.windows(2) {
            let sign = signs.next().unwrap();
            is_equal_so_far &= sign == '=';
            let [left, right] = [pair[0], pair[1]];
            if left.contains(", ") && right.contains(", ") && !left.contains(char::is_alphabetic) {
                let all = [0, 1, 2].map(|i| {
                    let [left, right] = [left, right].map(|side| component(side, i));
                    let right = right
                        .trim_start_matches('(')
                        .trim_end_matches(')')
                        .to_owned();
                    let left =
                        Reader::read(&left).unwrap_or_else(|| panic!("{left} of {statement}"));
                    is_joined(&left, '=', &right) || sign == '≈' && is_joined(&left, '≈', &right)
                });
                assert_eq!(all, [true; 3], "{statement}");
                count.vectors += 1;
            } else if let (Some(value), Some(_)) = (Reader::read(left), Reader::read(right)) {
                assert!(is_joined(&value, sign, right), "{statement}\nin\n{text}");
                count.numeric += 1;
            }
        }
        let letter = parts[0].trim_end();
        let last = parts.last().copied().unwrap_or_default();
        if let (Some(number), Some(_), true) = (exact.letter(letter), single(last), parts.len() > 1)
        {
            let sign = if is_equal_so_far { '=' } else { '≈' };
            let rounds = is_joined(number, sign, last);
            // An inexact number between two exact ones is one way to say it, too.
            let is_exact = sign == '≈' && is_joined(number, '=', last);
            assert!(rounds || is_exact, "{statement}\nin\n{text}");
            count.letters += 1;
        }
    }
}

#[test]
fn every_printed_equality_is_true() {
    let mut count = Count::default();
    for builtin in Builtin::ALL {
        let scene = builtin.scene();
        let (size, shape) = fit(&scene, Style::Ascii, 40, 20, 2.0);
        let rays = Rays::new(&scene.camera, size, shape);
        let all = u64::from(size.width) * u64::from(size.height);
        for k in 0..24_u64 {
            let at = (k * 7_919 + 40 * k) % all;
            let (x, y) = (
                (at % u64::from(size.width)) as u32,
                (at / u64::from(size.width)) as u32,
            );
            let ray = rays.ray(x, y);
            for (lens, method) in [
                (Lens::Mathematics, Method::Exact),
                (Lens::Machine, Method::Textbook),
                (Lens::Machine, Method::Exact),
            ] {
                let reading = Reading::take(&scene, (x, y), ray, method, None, None);
                let Some(subject) = &reading.subject else {
                    continue;
                };
                let mut exact = Exact::of(&ray, &subject.sphere);
                if lens == Lens::Machine {
                    exact.letters.clear();
                }
                let steps = sheet(lens, &reading, Some(&scene), Some(&rays), None);
                hold(&sheet_text(&steps, 80), &exact, &mut count);
                for width in [36, 44, 56, 76] {
                    let panel = lines(
                        lens,
                        &reading,
                        width,
                        Digits::Significant(6),
                        Glyphs::Unicode,
                    );
                    hold(&plain_text(&panel), &exact, &mut count);
                    let look = SheetLook {
                        current: steps.len(),
                        ..SheetLook::default()
                    };
                    hold(
                        &plain_text(&sheet_lines(&steps, look, width, 200)),
                        &exact,
                        &mut count,
                    );
                }
            }
        }
    }
    println!("{count:?}");
    let Count {
        numeric,
        letters,
        vectors,
        ledgers,
    } = count;
    assert!(
        numeric > 5_000 && letters > 5_000 && vectors > 200 && ledgers > 300,
        "{count:?}"
    );
}

#[test]
fn the_judge_of_equalities_can_say_no() {
    let yes = |text: &str| {
        let (left, sign, right) = match text.split_once('≈') {
            Some((left, right)) => (left, '≈', right),
            None => text.split_once('=').map(|(l, r)| (l, '=', r)).unwrap(),
        };
        is_joined(&Reader::read(left).unwrap(), sign, right)
    };
    for right in [
        "(−40)² − 4·1·373 = 108",
        "(40 − √108) / (2·1) ≈ 14.8038",
        "√2 ≈ 1.41421",
        "297.8185 − 294.0215 = 3.7970",
        "1.5e−3·2 = 0.003",
        "1234567 ≈ 1.2346e6",
    ] {
        assert!(yes(right), "{right}");
    }
    for wrong in [
        "0.007643² + 0.1795² + 0.9839² = 1.00029",
        "0.007643² + 0.1795² + 0.9839² ≈ 1.00029",
        "1838506.3 − 1838506.1 = 0.125",
        "√2 ≈ 1.41422",
        "√2 = 1.41421",
        "2 ≈ 2",
        "1234567 ≈ 1.2345e6",
    ] {
        assert!(!yes(wrong), "{wrong}");
    }
}
