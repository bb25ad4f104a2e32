//! One ray and one sphere to take away: as a row for `rayscope grade`, as a test case in C and Rust.

use std::fmt::Write as _;

use super::numbers;
use super::{Problem, Reference};
use crate::method::format::binary32;
use crate::method::{Class, Method};
use crate::text::{Glyphs, hexadecimal};

/// In which form a case is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CaseForm {
    /// CSV for `rayscope grade`: a header and a row with the answer of a method.
    #[default]
    Row,
    /// A test case in C, with the correctly rounded answer, in hexadecimal floats.
    C,
    /// The same in Rust, which has no hexadecimal floats: in bits, with the floats beside them.
    Rust,
}

impl CaseForm {
    /// All forms, the row first.
    pub const ALL: [Self; 3] = [Self::Row, Self::C, Self::Rust];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Row => "row",
            Self::C => "c",
            Self::Rust => "rust",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Row => "a row for rayscope grade",
            Self::C => "a test case in C",
            Self::Rust => "a test case in Rust",
        }
    }

    /// The form after this one, round and round.
    #[must_use]
    pub const fn next(self) -> Self {
        match self {
            Self::Row => Self::C,
            Self::C => Self::Rust,
            Self::Rust => Self::Row,
        }
    }
}

/// A problem to take away, and where it is from.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// The ray and the sphere.
    pub problem: Problem,
    /// Whose answer the row gives.
    pub method: Method,
    /// The scene and the pixel, on one line.
    pub origin: String,
}

/// The header of a CSV file of rows.
pub const HEADER: &str = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far";

impl Case {
    /// The case in one form, with a newline at its end.
    pub fn text(&self, form: CaseForm) -> String {
        match form {
            CaseForm::Row => format!("{HEADER}\n{}\n", self.row()),
            CaseForm::C => self.c(),
            CaseForm::Rust => self.rust(),
        }
    }

    /// The row without its header: numbers in the shortest decimal that reads back as the same
    /// binary32.
    pub fn row(&self) -> String {
        let decimal = |x: f32| binary32(x, Glyphs::Ascii).to_string();
        let inputs = numbers(&self.problem).map(decimal).join(",");
        let (ray, sphere) = &self.problem;
        let answer = self.method.solve(ray, sphere);
        let roots = if answer.class.meets() {
            [answer.near, answer.far].map(decimal).join(",")
        } else {
            ",".into()
        };
        format!("{inputs},{},{roots}", answer.class)
    }

    fn c(&self) -> String {
        let list = |x: &[f32]| {
            x.iter()
                .map(|&x| c_literal(x))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let [p0, d, c, r] = self.inputs();
        // The scene's name is the person's own: it must not end the comment.
        let origin = self.origin.replace("*/", "* /");
        let mut out = format!(
            "/* {origin}: the ray p0 + t d, a sphere, and the exact answer, rounded once. */\n\
             const float p0[3] = {{{}}};\nconst float d[3] = {{{}}};\nconst float c[3] = {{{}}};\n\
             const float r = {};\n",
            list(&p0),
            list(&d),
            list(&c),
            list(&r),
        );
        let (class, roots) = self.truth();
        // Writing to a string does not fail.
        let _ = writeln!(out, "const char expected_class[] = \"{class}\";");
        if let Some(roots) = roots {
            let _ = writeln!(out, "const float expected_roots[2] = {{{}}};", list(&roots));
        }
        out
    }

    fn rust(&self) -> String {
        let vector = |name: &str, x: &[f32]| {
            let bits: Vec<String> = x.iter().map(|x| format!("{:#010x}", x.to_bits())).collect();
            let floats: Vec<String> = x.iter().map(|&x| hexadecimal(x)).collect();
            format!(
                "// {}\nlet {name} = [{}].map(f32::from_bits);\n",
                floats.join(", "),
                bits.join(", ")
            )
        };
        let [p0, d, c, r] = self.inputs();
        let mut out = format!(
            "// {}: the ray p0 + t d, a sphere, and the exact answer, rounded once.\n",
            self.origin
        );
        for (name, x) in [("p0", &p0), ("d", &d), ("c", &c)] {
            out += &vector(name, x);
        }
        out += &vector("[r]", &r);
        let (class, roots) = self.truth();
        let _ = writeln!(out, "let expected_class = \"{class}\";");
        if let Some(roots) = roots {
            out += &vector("expected_roots", &roots);
        }
        out
    }

    /// p0, d, c and r.
    fn inputs(&self) -> [Vec<f32>; 4] {
        let x = numbers(&self.problem);
        [&x[..3], &x[3..6], &x[6..9], &x[9..]].map(<[f32]>::to_vec)
    }

    /// The exact class, and the roots rounded once.
    fn truth(&self) -> (Class, Option<[f32; 2]>) {
        let truth = Reference::new(&self.problem);
        let roots = truth.roots.map(|roots| roots.map(|root| root.rounded));
        (truth.class, roots)
    }
}

/// A float constant of C99: `0x1.8p+1f`.
fn c_literal(x: f32) -> String {
    if x.is_infinite() {
        let sign = if x < 0.0 { "-" } else { "" };
        return format!("{sign}INFINITY");
    }
    format!("{}f", hexadecimal(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Family;

    fn case(problem: Problem) -> Case {
        Case {
            problem,
            method: Method::Textbook,
            origin: "test, pixel (1, 2)".into(),
        }
    }

    /// The value of `0x1.8p+1`, and what follows it; exact, as such numbers are.
    fn read_hexadecimal(text: &str) -> f64 {
        let (sign, text) = match text.strip_prefix('-') {
            Some(rest) => (-1.0, rest),
            None => (1.0, text),
        };
        let (digits, power) = text.strip_prefix("0x").unwrap().split_once('p').unwrap();
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let value = u64::from_str_radix(&format!("{whole}{fraction}"), 16).unwrap() as f64;
        let power = power.parse::<i32>().unwrap() - 4 * fraction.len() as i32;
        sign * value * 2.0_f64.powi(power)
    }

    /// All numbers in braces, or after an equals sign.
    fn numbers_of_c(text: &str) -> Vec<f64> {
        text.split([' ', ',', '{', '}', ';', '='])
            .filter_map(|word| word.strip_suffix('f'))
            .filter(|word| word.contains("0x"))
            .map(read_hexadecimal)
            .collect()
    }

    #[test]
    fn c_and_rust_have_the_very_numbers() {
        for family in Family::ALL {
            for problem in family.sample(5, 20) {
                let case = case(problem);
                let truth = Reference::new(&problem);
                let mut expected: Vec<f32> = numbers(&problem).into();
                let roots = truth.roots.iter().flatten().map(|root| root.rounded);
                expected.extend(roots.filter(|root| root.is_finite()));
                let expected: Vec<f64> = expected.into_iter().map(f64::from).collect();
                assert_eq!(numbers_of_c(&case.text(CaseForm::C)), expected);
                let rust = case.text(CaseForm::Rust);
                let bits = rust.split(['[', ']', ',', ' ']).filter(|w| w.len() == 10);
                let bits = bits.filter_map(|w| u32::from_str_radix(w.strip_prefix("0x")?, 16).ok());
                let floats = bits.map(|bits| f64::from(f32::from_bits(bits)));
                let floats: Vec<f64> = floats.filter(|x| x.is_finite()).collect();
                assert_eq!(floats, expected, "{rust}");
            }
        }
    }

    #[test]
    fn a_name_cannot_end_the_comment() {
        let mut case = case(Family::ALL[0].sample(1, 1)[0]);
        case.origin = "evil */ int x; /*".into();
        assert_eq!(case.text(CaseForm::C).matches("*/").count(), 1);
    }
}
