//! A reading as lines of text, each piece with the role it plays.
//!
//! ```text
//! p0   20, 20, 0
//! d    0, 0, 1
//! sphere 1 of 1, r 10           nearest hit
//! c    20, 20, 20
//!
//! A    d·d            1
//!   = 0² + 0² + 1²
//! B    2 d·(p0−c)    −40
//!   …
//! ```

use std::cmp::Ordering;

use glam::Vec3;

use super::{
    Digits, Equation, FigureInk, Lens, Meeting, Reading, Sign, Subject, Wrong, number, sheet,
    vector,
};
use crate::method::trace::Measured;
use crate::method::{Class, Method, Place, Precision, Solution, Trace};
use crate::text::{Glyphs, wrap};

/// One line of a panel.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Line {
    /// Its pieces, from left to right.
    pub spans: Vec<Span>,
    /// Which lines go first when there is no room: those with the largest value; 0 stays.
    pub spare: u8,
    /// It says nothing without the line before it, and goes when that goes; the reverse, too.
    pub is_joined: bool,
    /// It is blank, and keeps the place of a line that other numbers would have: while they change,
    /// those below it stay where they are.
    pub keeps_place: bool,
}

/// A piece of text that plays one role.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Span {
    /// What it says.
    pub text: String,
    /// What it is.
    pub role: Role,
}

/// What a piece of text is, for the code that colours it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Words.
    Plain,
    /// The name of a quantity.
    Label,
    /// A formula in letters.
    Formula,
    /// A number that came out.
    Value,
    /// What may be skipped at a first reading.
    Faint,
    /// The verdict on a class.
    Verdict(Class),
    /// Something is wrong.
    Warning,
    /// A number that is another one than before.
    Changed,
    /// Where the person is in a list.
    Current,
    /// A part of a figure.
    Ink(FigureInk),
}

impl Line {
    pub(super) fn new(spare: u8) -> Self {
        Self {
            spare,
            ..Self::default()
        }
    }

    /// A line that goes with the one before it.
    pub(super) fn joined(spare: u8) -> Self {
        Self {
            is_joined: true,
            ..Self::new(spare)
        }
    }

    /// Text in lines of at most `width` characters.
    pub(super) fn wrapped(text: &str, width: usize, role: Role, spare: u8) -> Vec<Self> {
        let lines = wrap(text, width).into_iter();
        lines
            .map(|text| Self::new(spare).with(role, text))
            .collect()
    }

    /// A blank line in the place of one that is not there now.
    fn place() -> Self {
        Self {
            keeps_place: true,
            ..Self::default()
        }
    }

    /// Adds a character, to the last piece if that plays the same role.
    pub(super) fn push(&mut self, role: Role, glyph: char) {
        self.append(role, glyph.encode_utf8(&mut [0; 4]));
    }

    /// Adds text, to the last piece if that plays the same role.
    pub(super) fn append(&mut self, role: Role, text: &str) {
        match self.spans.last_mut() {
            _ if text.is_empty() => {}
            Some(last) if last.role == role => last.text.push_str(text),
            _ => self.spans.push(Span {
                text: text.to_owned(),
                role,
            }),
        }
    }

    /// Leaves out what is beyond column `width`.
    pub(super) fn cut(&mut self, width: usize) {
        let mut room = width;
        for span in &mut self.spans {
            let end = span.text.char_indices().nth(room).map(|(at, _)| at);
            span.text.truncate(end.unwrap_or(span.text.len()));
            room -= span.text.chars().count();
        }
        self.spans.retain(|span| !span.text.is_empty());
    }

    /// A line of words that stays.
    pub fn plain(text: impl Into<String>) -> Self {
        Self::new(0).with(Role::Plain, text)
    }

    /// A line that stays, all of it in one role.
    pub fn of(role: Role, text: impl Into<String>) -> Self {
        Self::new(0).with(role, text)
    }

    pub(super) fn with(mut self, role: Role, text: impl Into<String>) -> Self {
        self.spans.push(Span {
            text: text.into(),
            role,
        });
        self
    }

    /// Pads with blanks up to column `column`.
    pub(super) fn to(self, column: usize) -> Self {
        let gap = column.saturating_sub(self.width());
        self.with(Role::Plain, " ".repeat(gap))
    }

    /// Number of characters.
    pub fn width(&self) -> usize {
        self.spans.iter().map(|s| s.text.chars().count()).sum()
    }

    /// The text without roles, and without blanks at its end.
    pub fn text(&self) -> String {
        let text: String = self.spans.iter().map(|s| s.text.as_str()).collect();
        text.trim_end().to_owned()
    }
}

const LABEL_WIDTH: usize = 5;
/// What stands between a centre and its radius.
const RADIUS_LABEL: &str = "   r ";
/// Where the formula with the numbers put in starts.
const SUBSTITUTED: usize = 2;

/// The panel for a reading through a lens, in lines of at most `width` characters where that is possible.
///
/// Through the lens `mathematics` the reading must be that of `exact`.
pub fn lines(
    lens: Lens,
    reading: &Reading,
    width: usize,
    digits: Digits,
    glyphs: Glyphs,
) -> Vec<Line> {
    match (lens, &reading.subject) {
        (Lens::Mathematics, Some(subject)) => {
            mathematics_lines(reading, subject, (width, glyphs), digits)
        }
        _ => machine_lines(reading, width, digits),
    }
}

fn machine_lines(reading: &Reading, width: usize, digits: Digits) -> Vec<Line> {
    let mut out = Vec::new();
    let in_room = |v| columned_vector(v, width.saturating_sub(LABEL_WIDTH), digits);
    out.push(labelled("p0", &in_room(reading.ray.origin), 0));
    out.push(labelled("d", &in_room(reading.ray.direction), 0));
    let Some(subject) = &reading.subject else {
        out.push(Line::new(0));
        out.push(Line::new(0).with(Role::Plain, "The scene has no spheres."));
        return out;
    };
    out.push(subject_title(subject, reading.spheres, width));
    out.push(subject_place(subject, width, digits));
    out.push(Line::new(5));
    out.extend(coefficient_lines(subject, width, digits));
    out.extend(verdict_lines(subject, width, digits));
    out.extend(wrong_lines(reading, width));
    out.extend(sight_lines(subject, width, digits));
    out.extend(meeting_lines(reading, subject.body, digits, None));
    out.extend(word_lines(&subject.trace, width));
    out
}

/// The quadratic worked exactly, its numbers written as on the sheet.
fn mathematics_lines(
    reading: &Reading,
    subject: &Subject,
    (width, glyphs): (usize, Glyphs),
    digits: Digits,
) -> Vec<Line> {
    let q = subject.worked();
    let steps = sheet::mathematics(reading, subject);
    let steps: Vec<_> = steps.iter().map(|step| step.spelt(glyphs)).collect();
    let room = sheet::room_for_signs(width, glyphs);
    let step = |name: &str| steps.iter().find(|step| step.name == glyphs.spell(name));
    let equations = |name: &str| step(name).map_or(&[][..], |step| step.equations.as_slice());
    let written = |equation: &Equation, spare: u8| -> Vec<Line> {
        let lines = sheet::equation_lines(equation, room, false);
        let last = lines.len().saturating_sub(1);
        let spared = lines.into_iter().enumerate().map(|(i, line)| {
            // What stands between two equal signs may go, and what is left is true.
            let text = line.text();
            let is_between = i > 0 && i < last && text.trim_start().starts_with('=');
            let may_go = spare == 0 && is_between && !text.contains('≈');
            Line {
                spare: if may_go { 3 } else { spare },
                is_joined: i > 0 && spare > 0,
                ..line
            }
        });
        spared.collect()
    };
    // What comes out, without the numbers that it comes out of.
    let result = |equation: &Equation, spare: u8| {
        let ways = equation.ways.last().cloned().into_iter().collect();
        let ledger = Vec::new();
        let formula = equation.formula.clone();
        written(
            &Equation {
                formula,
                ways,
                ledger,
            },
            spare,
        )
    };
    let mut out = Vec::new();
    for (i, equation) in equations("ray").iter().enumerate() {
        if i == 2 {
            out.push(subject_title(subject, reading.spheres, width));
        }
        out.extend(written(equation, 0));
    }
    out.push(Line::new(6));
    for name in ["A", "B", "C", "Δ"] {
        // The squares of d tell little, where they are not whole.
        let rounds = |e: &Equation| e.ways[0].iter().any(|link| link.sign == Sign::Near);
        let shown = equations(name).iter().flat_map(|equation| {
            if name == "A" && rounds(equation) {
                result(equation, 0)
            } else {
                written(equation, 0)
            }
        });
        out.extend(shown);
    }
    let class = q.truth.class();
    let verdict = match class {
        Class::Miss => "Δ < 0: the line misses the sphere",
        Class::Tangent => "Δ = 0: it touches in one point",
        Class::Secant | Class::Hit | Class::Nan => "Δ > 0: it meets in two points",
    };
    out.push(Line::new(2).with(Role::Verdict(class), verdict));
    for equation in equations("roots").iter().chain(equations("closest")) {
        out.extend(result(equation, 0));
    }
    let place = match subject.solution.place() {
        Some(Place::Hit) => "hit: in front of the eye",
        Some(Place::Inside) => "inside: the eye is in the sphere",
        Some(Place::Behind) => "behind the eye: not seen",
        None => "",
    };
    if !place.is_empty() {
        out.push(Line::new(1).with(Role::Plain, place));
    }
    if let Some(point) = equations("p").first() {
        out.extend(result(point, 2));
    }
    if let Some(cosine) = equations("light")
        .first()
        .filter(|e| e.formula.starts_with("cos ") && e.formula.contains('='))
    {
        out.extend(result(cosine, 4));
    }
    let roots = q.roots.as_ref();
    let roots = roots.map(|roots| roots.each_ref().map(|root| root.written.text.clone()));
    out.extend(meeting_lines(reading, subject.body, digits, roots.as_ref()));
    out
}

/// What the words mean in which errors are told, for who meets them here first; nothing if all is
/// right.
fn word_lines(trace: &Trace, width: usize) -> Vec<Line> {
    let coefficients = [&trace.a, &trace.b, &trace.c, &trace.discriminant];
    let roots = [&trace.near, &trace.far].into_iter().flatten();
    let wrong: Vec<_> = coefficients
        .into_iter()
        .chain(roots)
        .filter(|m| m.ulps().is_some_and(|ulps| ulps != 0.0))
        .collect();
    if wrong.is_empty() {
        return Vec::new();
    }
    let far_off = wrong.iter().any(|m| m.ulps() > Some(HALF_ULP));
    // They go before what they explain.
    let spare = if far_off { 3 } else { 5 };
    let mut out = vec![Line::new(spare).with(Role::Faint, EXACTLY)];
    out.extend(unit_lines(
        |p| wrong.iter().any(|m| m.precision == p),
        width,
        spare,
    ));
    out
}

/// What stands before the number that would come out with nothing rounded.
pub(super) const EXACTLY: &str = "exactly: had nothing been rounded";

/// The units of errors that are used, each in a few words.
pub(super) fn unit_lines(
    is_used: impl Fn(Precision) -> bool,
    width: usize,
    spare: u8,
) -> Vec<Line> {
    let units = [Precision::Binary32, Precision::Binary64].into_iter();
    let words = units.filter(|&p| is_used(p)).map(Precision::unit_in_words);
    words
        .flat_map(|words| Line::wrapped(words, width, Role::Faint, spare))
        .collect()
}

fn labelled(label: &str, value: &str, spare: u8) -> Line {
    Line::new(spare)
        .with(Role::Label, label)
        .to(LABEL_WIDTH)
        .with(Role::Value, value)
}

/// A vector with as many of the digits as the room holds, but never fewer than three.
fn fitting_vector(v: Vec3, room: usize, digits: Digits) -> String {
    let shortened = (3..=6).rev().map(Digits::Significant);
    let mut choices = std::iter::once(digits).chain(shortened);
    choices
        .find(|&d| vector(v, d).chars().count() <= room)
        .map_or_else(|| vector(v, Digits::Significant(3)), |d| vector(v, d))
}

/// Columns that a number of a vector takes where there is room for three.
const NUMBER: usize = 13;

/// As [`fitting_vector`], its numbers in columns where there is room and they are not in full: what
/// changes then changes in its place, and is easier to compare.
fn columned_vector(v: Vec3, room: usize, digits: Digits) -> String {
    let plain = fitting_vector(v, room, digits);
    let numbers: Vec<_> = plain.split_inclusive(", ").collect();
    let in_columns = |n: &&str| n.chars().count() <= NUMBER;
    if digits == Digits::Full || room < 3 * NUMBER || !numbers.iter().all(in_columns) {
        return plain;
    }
    let padded: Vec<_> = numbers.iter().map(|n| format!("{n:NUMBER$}")).collect();
    padded.concat().trim_end().to_owned()
}

fn subject_title(subject: &Subject, spheres: usize, width: usize) -> Line {
    let mut title = format!("sphere {} of {spheres}", subject.body + 1);
    if let Some(name) = &subject.name {
        title = format!("{title}, {name}");
    }
    // The reason gives way to the name: the lines below say where the sphere is met.
    let has_room = |why: &&str| title.chars().count() + 1 + why.len() <= width;
    let why = Some(subject.why.words()).filter(has_room).unwrap_or("");
    let title = clip(&title, width.saturating_sub(why.len()));
    Line::new(1)
        .with(Role::Plain, title)
        .to(width.saturating_sub(why.len()))
        .with(Role::Faint, why)
}

/// The centre and the radius.
fn subject_place(subject: &Subject, width: usize, digits: Digits) -> Line {
    let radius = number(subject.sphere.radius.into(), Precision::Binary32, digits);
    let room = width.saturating_sub(LABEL_WIDTH + RADIUS_LABEL.len() + radius.chars().count());
    Line::new(0)
        .with(Role::Label, "c")
        .to(LABEL_WIDTH)
        .with(
            Role::Value,
            columned_vector(subject.sphere.center, room, digits),
        )
        .with(Role::Label, RADIUS_LABEL)
        .with(Role::Value, radius)
}

fn coefficient_lines(subject: &Subject, width: usize, digits: Digits) -> Vec<Line> {
    let c = subject.coefficients;
    let trace = &subject.trace;
    let rows = [
        ("A", "d·d", c.a, &trace.a),
        ("B", "2 d·(p0−c)", c.b, &trace.b),
        ("C", "|p0−c|² − r²", c.c, &trace.c),
        ("Δ", "B² − 4AC", c.discriminant, &trace.discriminant),
    ];
    let mut out = routine_lines(trace, width);
    for (label, formula, value, measured) in rows {
        let value = number(value, c.precision, digits);
        out.push(given(label, formula, &value));
        out.push(operands_line(trace, label, width));
        // The class hangs on Δ alone.
        let spare = if label == "Δ" { 4 } else { 6 };
        out.push(exact_line(Some(measured), width, spare));
    }
    out
}

/// What a routine answers, and whose coefficients these are: it names none of its own.
fn routine_lines(trace: &Trace, width: usize) -> Vec<Line> {
    let Method::Routine(id) = trace.method else {
        return Vec::new();
    };
    let line = |spare| move |text| Line::new(spare).with(Role::Plain, text);
    let words = wrap(&format!("It gives {}.", id.words()), width);
    let whose = wrap("A to Δ are those of double:", width);
    let words = words.into_iter().map(line(4));
    words.chain(whose.into_iter().map(line(0))).collect()
}

/// What an operation gave.
fn given(label: &str, formula: &str, value: &str) -> Line {
    Line::new(0)
        .with(Role::Label, label)
        .to(LABEL_WIDTH)
        .with(Role::Formula, formula)
        .to(VALUE_COLUMN - 2)
        .with(Role::Plain, "→ ")
        .with(Role::Value, hang(value))
}

/// The numbers that the method put into the formula of that letter, where it has one and there is room
/// for all their digits.
fn operands_line(trace: &Trace, label: &str, width: usize) -> Line {
    let step = trace.step(label);
    let room = width.saturating_sub(SUBSTITUTED);
    let numbers = step.map(|step| step.numbers.as_str());
    match numbers.filter(|numbers| numbers.chars().count() <= room) {
        Some(numbers) => Line::new(3).to(SUBSTITUTED).with(Role::Plain, numbers),
        None => Line::place(),
    }
}

/// What the number should be, and how far off it is; if it is right, or not there, the place for that.
/// A number that is merely rounded may be spared so far.
fn exact_line(measured: Option<&Measured>, width: usize, spare: u8) -> Line {
    let off = |measured: &Measured| measured.ulps().filter(|&ulps| ulps != 0.0);
    let inexact = measured.and_then(|m| Some((m, off(m)?)));
    let line = inexact.and_then(|(m, ulps)| off_line(m, ulps, width, spare));
    line.unwrap_or_else(Line::place)
}

fn off_line(measured: &Measured, ulps: f64, width: usize, spare: u8) -> Option<Line> {
    let off = format!(
        "  {:>OFF$}",
        measured.error_text(GLYPHS).unwrap_or_default()
    );
    let room = width.saturating_sub(SUBSTITUTED + "exactly ".len() + off.chars().count());
    let exact = (4..=MOST_DIGITS)
        .rev()
        .filter_map(|digits| measured.exact_text(digits, GLYPHS))
        .find(|text| text.chars().count() <= room)
        .or_else(|| measured.exact_text(3, GLYPHS))?;
    // A number that is merely rounded is no news; one that is further off is.
    let (role, spare) = if ulps.abs() <= HALF_ULP {
        (Role::Faint, spare)
    } else if ulps.abs() < MANY_ULPS {
        (Role::Faint, 1)
    } else {
        (Role::Warning, 0)
    };
    let text = format!("exactly {exact}{off}");
    Some(Line::new(spare).to(SUBSTITUTED).with(role, text))
}

/// Room for an error in ulp, so that the number before it ends where it did.
const OFF: usize = 10;
/// As many digits of an exact value as tell any two neighbours of binary64 apart.
const MOST_DIGITS: usize = 17;
/// The error of a number that is the exact value rounded once.
const HALF_ULP: f64 = 0.5;
const GLYPHS: Glyphs = Glyphs::Unicode;
/// From this error on, a third of the bits of a binary32 are gone.
const MANY_ULPS: f64 = 256.0;

/// Where values stand, their signs one to the left.
const VALUE_COLUMN: usize = 22;

/// A value with a blank where a minus sign would be, so that digits stand under digits.
fn hang(value: &str) -> String {
    if value.starts_with('−') {
        value.to_owned()
    } else {
        format!(" {value}")
    }
}

/// Text of at most `room` characters, with a mark where it was cut.
fn clip(text: &str, room: usize) -> String {
    if text.chars().count() <= room {
        return text.to_owned();
    }
    let kept: String = text.chars().take(room.saturating_sub(1)).collect();
    format!("{kept}…")
}

fn verdict_lines(subject: &Subject, width: usize, digits: Digits) -> Vec<Line> {
    let Solution {
        class, near, far, ..
    } = subject.solution;
    let verdict = match class {
        Class::Hit => "hit, as the routine says",
        Class::Miss if subject.trace.method.is_routine() => "miss, as the routine says",
        Class::Tangent if subject.trace.method.is_routine() => "one root, as the routine says",
        Class::Secant if subject.trace.method.is_routine() => "two roots, as the routine says",
        Class::Nan if subject.trace.method.is_routine() => "not a number: no answer",
        Class::Miss => "Δ < 0  miss: no point in common",
        Class::Tangent => "Δ is 0  tangent: it touches",
        Class::Secant => "Δ > 0  secant: two points",
        Class::Nan => "Δ is not a number: no answer",
    };
    let mut out = vec![
        Line::new(4),
        Line::new(0).with(Role::Verdict(class), clip(verdict, width)),
    ];
    if let Some(wrong) = subject.trace.verdict(GLYPHS) {
        out.extend(Line::wrapped(&wrong, width, Role::Warning, 0));
    }
    if class.meets() {
        let is_routine = subject.trace.method.is_routine();
        for (label, formula, t, exact) in [
            ("near", "(−B−√Δ)/2A", near, &subject.trace.near),
            ("far", "(−B+√Δ)/2A", far, &subject.trace.far),
        ] {
            // A routine has formulas of its own, and may give one root, or none.
            let formula = if is_routine { "" } else { formula };
            if class != Class::Hit || !t.is_nan() {
                let value = number(t.into(), Precision::Binary32, digits);
                out.push(given(label, formula, &value));
                out.push(exact_line(exact.as_ref(), width, 4));
            }
        }
    }
    if is_bare_hit(&subject.solution) {
        return out;
    }
    let words = match subject.solution.place() {
        Some(Place::Hit) => "hit: in front of the eye",
        Some(Place::Inside) => "inside: the eye is in the sphere",
        Some(Place::Behind) => "behind the eye: not seen",
        None => return out,
    };
    out.push(Line::new(0).with(Role::Plain, words));
    out
}

/// Whether it is no more than a hit: nothing is said of where.
fn is_bare_hit(solution: &Solution) -> bool {
    solution.class == Class::Hit && solution.near.is_nan()
}

/// Which sphere the method takes for the one in front, and what it says wrongly of spheres that are not
/// shown.
fn wrong_lines(reading: &Reading, width: usize) -> Vec<Line> {
    let sentence = |wrong: &Wrong| {
        let Wrong { body, said, right } = wrong;
        format!("sphere {}: {said}, but exactly {right}", body + 1)
    };
    let other = reading.other_sphere.map(|[seen, right]| {
        let [seen, right] = [seen + 1, right + 1];
        format!("wrong sphere seen: {seen}, but exactly {right} is in front")
    });
    let named = reading.wrong.iter().take(MOST_WRONG).map(sentence);
    let mut sentences: Vec<_> = other.into_iter().chain(named).collect();
    let more = reading.wrong.len().saturating_sub(MOST_WRONG);
    if more > 0 {
        sentences.push(format!("and {more} more spheres are wrong"));
    }
    let lines = |sentence: &String| Line::wrapped(sentence, width, Role::Warning, 0);
    sentences.iter().flat_map(lines).collect()
}

/// How many of the other spheres that a method gets wrong are named.
const MOST_WRONG: usize = 2;

/// What is there to be compared is shown with one digit less.
const fn fewer(digits: Digits) -> Digits {
    match digits {
        Digits::Significant(n) => Digits::Significant(n - 1),
        Digits::Full => Digits::Full,
    }
}

fn sight_lines(subject: &Subject, width: usize, digits: Digits) -> Vec<Line> {
    let Some(sight) = subject.sight.filter(|_| !is_bare_hit(&subject.solution)) else {
        return Vec::new();
    };
    let in_room = |v, digits| columned_vector(v, width.saturating_sub(LABEL_WIDTH), digits);
    let cosine = number(
        sight.cosine.into(),
        Precision::Binary32,
        Digits::Significant(4),
    );
    vec![
        labelled("p", &in_room(sight.point, digits), 1),
        labelled("n", &in_room(sight.normal, fewer(digits)), 1),
        Line::new(2)
            .with(Role::Label, "cos θ ")
            .with(Role::Value, cosine),
    ]
}

/// The other spheres on the line, nearest first, if there is more than the one shown.
fn meeting_lines(
    reading: &Reading,
    shown: usize,
    digits: Digits,
    roots: Option<&[String; 2]>,
) -> Vec<Line> {
    if reading.meetings.len() < 2 {
        return Vec::new();
    }
    let mut out = vec![
        Line::new(4),
        Line::new(1).with(
            Role::Plain,
            format!("{} spheres on this line", reading.meetings.len()),
        ),
    ];
    let place = reading.meetings.iter().position(|m| m.body == shown);
    let last = place.map_or(MOST_MEETINGS, |place| MOST_MEETINGS.max(place + 1));
    for (rank, meeting) in reading.meetings.iter().enumerate().take(last) {
        let spare = match rank.cmp(&3) {
            Ordering::Less => 1,
            _ => 2,
        };
        let roots = roots.cloned().filter(|_| meeting.body == shown);
        out.push(meeting_line(
            meeting,
            meeting.body == shown,
            spare,
            (digits, roots),
        ));
    }
    let more = reading.meetings.len().saturating_sub(last);
    if more > 0 {
        out.push(Line::new(2).with(Role::Faint, format!(" and {more} more")));
    }
    out
}

/// So many of the spheres on a line are listed at least; the list reaches to the one that is shown.
const MOST_MEETINGS: usize = 100;

fn meeting_line(
    meeting: &Meeting,
    shown: bool,
    spare: u8,
    (digits, written): (Digits, Option<[String; 2]>),
) -> Line {
    let Solution {
        class, near, far, ..
    } = meeting.solution;
    let digits = fewer(digits);
    let as_machine = [near, far].map(|t| number(t.into(), Precision::Binary32, digits));
    let [near, far] = written.unwrap_or(as_machine);
    // The words after the numbers stay where they are while those change.
    let roots = if class == Class::Tangent {
        format!("t {near:<20}")
    } else {
        format!("t {:<10} {far:<9}", near + ",")
    };
    let mark = if shown { "▸" } else { " " };
    let place = meeting.solution.place().map_or("", Place::name);
    Line::new(spare)
        .with(Role::Label, format!("{mark}{:<4}", meeting.body + 1))
        .with(Role::Value, roots)
        .with(Role::Faint, format!(" {place}"))
}

/// The lines that fit into `height`, those that keep a place left out first, then the most spare ones.
///
/// What still does not fit is cut at the bottom; the caller marks that it was.
pub fn fit(mut lines: Vec<Line>, height: usize) -> Vec<Line> {
    if lines.len() > height {
        lines.retain(|line| !line.keeps_place);
    }
    let most = lines.iter().map(|l| l.spare).max().unwrap_or(0);
    for spare in (1..=most).rev() {
        let mut excess = lines.len().saturating_sub(height);
        let mut goes = vec![false; lines.len()];
        let mut end = lines.len();
        // Of those that are as spare, the last go first.
        while excess > 0 && end > 0 {
            let start = lines[..end].iter().rposition(|l| !l.is_joined).unwrap_or(0);
            if lines[start].spare == spare {
                goes[start..end].fill(true);
                excess = excess.saturating_sub(end - start);
            }
            end = start;
        }
        let mut goes = goes.into_iter();
        lines.retain(|_| goes.next() != Some(true));
    }
    lines
}

/// The lines as plain text, each ended by a newline.
pub fn plain_text(lines: &[Line]) -> String {
    let lines = lines.iter().filter(|line| !line.keeps_place);
    lines.map(|line| line.text() + "\n").collect()
}
