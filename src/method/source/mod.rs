//! The methods as text in other languages, to copy out and change.
//!
//! Each is written once, in lines that all the languages share but for how they name a variable and return.
//! Helper functions keep the operations and their order, so that each text rounds as the method here does.

mod exact;

use super::Method;

/// A language that a method is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SourceLanguage {
    /// For OpenGL, WebGL and Shadertoy; what `--method FILE.glsl` reads.
    Glsl,
    /// For WebGPU; what `--method FILE.wgsl` reads.
    Wgsl,
    /// C11.
    C,
    /// Rust.
    Rust,
}

impl SourceLanguage {
    /// All languages.
    pub const ALL: [Self; 4] = [Self::Glsl, Self::Wgsl, Self::C, Self::Rust];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Glsl => "glsl",
            Self::Wgsl => "wgsl",
            Self::C => "c",
            Self::Rust => "rust",
        }
    }
}

/// A part of a method: a variable, with what is said of it, or where it returns.
enum MethodPart {
    /// A number: name, expression, comment.
    Number(&'static str, &'static str, &'static str),
    /// A vector, likewise.
    Vector(&'static str, &'static str, &'static str),
    /// No hit if this holds.
    Miss(&'static str),
    /// The two roots.
    Roots(&'static str, &'static str),
}

use MethodPart::{Miss, Number, Roots, Vector};

const O: MethodPart = Vector(
    "o",
    "sub(origin, center)",
    "from the centre to where the ray starts",
);
const A: MethodPart = Number(
    "a",
    "dot(direction, direction)",
    "what multiplies t²: the length of d, squared",
);
const HALF_B: MethodPart = Number("b", "dot(direction, o)", "half of what multiplies t");
const C: MethodPart = Number(
    "c",
    "dot(o, o) - radius * radius",
    "below 0 if the ray starts inside",
);
const Q_FORM: [MethodPart; 7] = [
    Miss("reduced < 0.0"),
    Number("s", "root(reduced)", ""),
    Number(
        "q",
        "-(b + choose(b < 0.0, -s, s))",
        "of the two sums the one that does not cancel",
    ),
    Number("one", "q / a", ""),
    Number(
        "other",
        "choose(reduced == 0.0, one, c / q)",
        "the product of the roots is C/A",
    ),
    Number("near", "choose(b < 0.0, other, one)", ""),
    Number("far", "choose(b < 0.0, one, other)", ""),
];
const IN_ORDER: MethodPart = Roots(
    "choose(near > far, far, near)",
    "choose(near > far, near, far)",
);

#[expect(clippy::too_many_lines, reason = "a list of formulas")]
fn parts(method: Method) -> Vec<MethodPart> {
    let textbook_roots = || {
        [
            Miss("discriminant < 0.0"),
            Number("s", "root(discriminant)", ""),
            Roots("(-b - s) / (2.0 * a)", "(-b + s) / (2.0 * a)"),
        ]
    };
    let reduced = |own: Vec<MethodPart>| {
        let mut parts = vec![O, A, HALF_B, C];
        parts.extend(own);
        parts.extend(Q_FORM);
        parts.push(IN_ORDER);
        parts
    };
    match method {
        Method::Textbook => {
            let mut parts = vec![
                O,
                A,
                Number("b", "2.0 * dot(direction, o)", "what multiplies t"),
                C,
                Number("discriminant", "b * b - 4.0 * a * c", ""),
            ];
            parts.extend(textbook_roots());
            parts
        }
        Method::Contracted => {
            let mut parts = vec![
                O,
                Number(
                    "a",
                    "fused_dot(direction, direction)",
                    "what multiplies t², two of its products unrounded",
                ),
                Number("b", "2.0 * fused_dot(direction, o)", "what multiplies t"),
                Number(
                    "c",
                    "fused(-radius, radius, fused_dot(o, o))",
                    "below 0 if the ray starts inside",
                ),
                Number(
                    "discriminant",
                    "fused(b, b, -(4.0 * a * c))",
                    "b² is not rounded, the other product is",
                ),
            ];
            parts.extend(textbook_roots());
            parts
        }
        Method::Unit => vec![
            O,
            HALF_B,
            C,
            Number(
                "reduced",
                "b * b - c",
                "right only as far as the length of d is 1",
            ),
            Miss("reduced < 0.0"),
            Number("s", "root(reduced)", ""),
            Roots("-b - s", "-b + s"),
        ],
        Method::Citardauq => reduced(vec![Number(
            "reduced",
            "b * b - a * c",
            "a quarter of the discriminant",
        )]),
        Method::Haines => reduced(vec![
            Number(
                "foot",
                "b / a",
                "its negative is the t at which the line comes closest to the centre",
            ),
            Vector(
                "l",
                "sub(o, scale(foot, direction))",
                "from the centre to that point",
            ),
            Number(
                "h",
                "radius * radius - dot(l, l)",
                "half the chord, squared",
            ),
            Number("reduced", "a * h", "a quarter of the discriminant"),
        ]),
        Method::Kahan => reduced(vec![
            Number("w", "a * c", ""),
            Number(
                "e",
                "fused(a, c, -w)",
                "what the rounding of w cost, exactly",
            ),
            Number("f", "fused(b, b, -w)", ""),
            Number("reduced", "f - e", "a quarter of the discriminant"),
        ]),
        Method::Double => reduced(vec![
            Vector(
                "k",
                "across(o, direction)",
                "its length is that of d times the distance of the line",
            ),
            Number(
                "reduced",
                "a * (radius * radius) - dot(k, k)",
                "a quarter of the discriminant, by Lagrange's identity",
            ),
        ]),
        Method::Exact | Method::Routine(_) => Vec::new(),
    }
}

/// The text of a built-in method; a sentence where there is none in that language.
pub fn source(method: Method, language: SourceLanguage) -> Result<String, String> {
    if method == Method::Exact {
        return exact::source(language);
    }
    if method == Method::Double && language == SourceLanguage::Wgsl {
        return Err(
            "double: WGSL has no 64-bit numbers; expected --lang glsl, c or rust".to_owned(),
        );
    }
    let wide = method == Method::Double;
    let writer = Writer { language, wide };
    let mut text = format!("// {}\n", about(method));
    text += &writer.opening();
    for part in parts(method) {
        text += &writer.part(&part);
    }
    text += "}\n";
    Ok(text)
}

/// One sentence on a method.
pub fn about(method: Method) -> &'static str {
    match method {
        Method::Textbook => "textbook: B² - 4AC and (-B ± √Δ) / 2A in binary32, as in the tutorial",
        Method::Contracted => {
            "contracted: textbook as compilers run it that fuse products into sums"
        }
        Method::Unit => "unit: half-b for a direction of length 1, as many engines have it",
        Method::Citardauq => {
            "citardauq: half-b, and the roots q/A and C/q, of which neither cancels"
        }
        Method::Haines => {
            "haines: the distance of the line against the radius; far spheres keep their bits"
        }
        Method::Kahan => {
            "kahan: citardauq with a discriminant to 2 ulp, by two fused multiply-adds"
        }
        Method::Double => "double: Lagrange's identity in binary64, roots rounded at the end",
        Method::Exact => "exact: the first of its stages, in binary64, with the bound on its error",
        Method::Routine(_) => "one's own",
    }
}

struct Writer {
    language: SourceLanguage,
    /// Whether it computes in binary64.
    wide: bool,
}

impl Writer {
    fn number(&self) -> &'static str {
        match (self.language, self.wide) {
            (SourceLanguage::Wgsl, _) | (SourceLanguage::Rust, false) => "f32",
            (SourceLanguage::Rust, true) => "f64",
            (_, false) => "float",
            (_, true) => "double",
        }
    }

    /// The helper functions, and the head of the function itself.
    fn opening(&self) -> String {
        let template = match self.language {
            SourceLanguage::Glsl if self.wide => include_str!("double.glsl"),
            SourceLanguage::Glsl => include_str!("single.glsl"),
            SourceLanguage::Wgsl => include_str!("single.wgsl"),
            SourceLanguage::C => include_str!("any.c"),
            SourceLanguage::Rust => include_str!("any.txt"),
        };
        template
            .replace("NUM", self.number())
            .replace("SUFFIX", if self.wide { "" } else { "f" })
    }

    fn part(&self, part: &MethodPart) -> String {
        use SourceLanguage::{C, Glsl, Rust, Wgsl};
        let number = self.number();
        match part {
            Number(name, value, comment) => {
                let value = self.expression(value);
                let line = match self.language {
                    Glsl => format!("{number} {name} = {value};"),
                    C => format!("const {number} {name} = {value};"),
                    Wgsl | Rust => format!("let {name} = {value};"),
                };
                commented(&line, comment)
            }
            Vector(name, value, comment) => {
                let value = self.expression(value);
                let line = match self.language {
                    Glsl if self.wide => format!("dvec3 {name} = {value};"),
                    Glsl => format!("vec3 {name} = {value};"),
                    C => format!("const vector {name} = {value};"),
                    Wgsl | Rust => format!("let {name} = {value};"),
                };
                commented(&line, comment)
            }
            Miss(condition) => {
                let condition = self.expression(condition);
                match self.language {
                    Glsl => format!("    if ({condition}) return vec2(-1.0); // no hit\n"),
                    Wgsl => format!(
                        "    if ({condition}) {{ return vec2<f32>(-1.0, -1.0); }} // no hit\n"
                    ),
                    C => format!("    if ({condition}) return 0;\n"),
                    Rust => format!("    if {condition} {{\n        return None;\n    }}\n"),
                }
            }
            Roots(near, far) => {
                let [near, far] = [near, far].map(|root| self.expression(root));
                match self.language {
                    Glsl if self.wide => format!("    return vec2(float({near}), float({far}));\n"),
                    Glsl => format!("    return vec2({near}, {far});\n"),
                    Wgsl => format!("    return vec2<f32>({near}, {far});\n"),
                    C => format!(
                        "    *t0 = (float)({near});\n    *t1 = (float)({far});\n    return 1;\n"
                    ),
                    Rust if self.wide => format!("    Some([({near}) as f32, ({far}) as f32])\n"),
                    Rust => format!("    Some([{near}, {far}])\n"),
                }
            }
        }
    }

    /// An expression with numbers as the language writes them.
    fn expression(&self, text: &str) -> String {
        let text = match (self.language, self.wide) {
            (SourceLanguage::C, false) => text.replace(".0", ".0f"),
            (SourceLanguage::Glsl, true) => text
                .replace("4.0", "double(4.0)")
                .replace("2.0", "double(2.0)")
                .replace("0.0", "double(0.0)"),
            _ => text.to_owned(),
        };
        let names: &[(&str, &str)] = if self.wide && self.language == SourceLanguage::Glsl {
            &[
                ("origin", "p0"),
                ("direction", "d"),
                ("center", "cc"),
                ("radius", "r"),
            ]
        } else {
            &[]
        };
        names
            .iter()
            .fold(text, |text, (from, to)| text.replace(from, to))
    }
}

fn commented(line: &str, comment: &str) -> String {
    if comment.is_empty() {
        format!("    {line}\n")
    } else {
        format!("    {line:<44} // {comment}\n")
    }
}
