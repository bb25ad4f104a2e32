//! A line of a method's source as a whole statement in C, in the words of the tutorial.

use super::Precision;

/// The line as a statement in C; nothing for a line that is no statement of the formula.
pub fn in_c(line: &str, precision: Precision) -> String {
    let Some((name, value)) = line
        .strip_prefix("let ")
        .and_then(|rest| rest.strip_suffix(';'))
        .and_then(|rest| rest.split_once(" = "))
    else {
        return String::new();
    };
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.chars().all(is_plain)
        || value.contains(['|', '[', '{', '?']) && !value.contains("p0[0]")
    {
        return String::new();
    }
    let (number, vector, sqrt, fma) = match precision {
        Precision::Binary32 => ("float", "vector", "sqrtf", "fmaf"),
        Precision::Binary64 => ("double", "dvector", "sqrt", "fma"),
    };
    if value.contains("p0[0]") {
        return format!("{vector} o = vectorSub(&p0, &center);");
    }
    let mut value = value.replace("input.", "").replace("k.", "");
    for (word, digit) in [("two", "2"), ("four", "4")] {
        value = value.replace(&format!("{word} *"), &format!("{digit} *"));
    }
    if let Some(inside) = value.strip_suffix(".sqrt()") {
        value = format!("{sqrt}({inside})");
    }
    if let Some((x, rest)) = value.split_once(".mul_add(") {
        value = format!("{fma}({x}, {rest}");
    }
    let is_vector = ["sub(", "cross(", "scale("]
        .iter()
        .any(|f| value.starts_with(f));
    for (ours, theirs) in [
        ("dot(", "vectorDot("),
        ("sub(", "vectorSub("),
        ("cross(", "vectorCross("),
        ("scale(", "vectorScale("),
    ] {
        value = value.replace(ours, theirs);
    }
    // Vectors are passed by where they are, as in the tutorial.
    for name in ["d", "o", "p0", "center", "cross", "l"] {
        for (before, after) in [("(", ","), (", ", ")"), (" ", ",")] {
            let bare = format!("{before}{name}{after}");
            if value.contains("vector") {
                value = value.replace(&bare, &format!("{before}&{name}{after}"));
            }
        }
    }
    if value.contains('.') || value.contains(".solve") {
        return String::new();
    }
    let kind = if is_vector { vector } else { number };
    format!("{kind} {name} = {value};")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_a_whole_statement_in_c() {
        let single = |line| in_c(line, Precision::Binary32);
        for (line, statement) in [
            ("let a = dot(d, d);", "float a = vectorDot(&d, &d);"),
            (
                "let o = sub(p0, center);",
                "vector o = vectorSub(&p0, &center);",
            ),
            (
                "let b = two * dot(d, o);",
                "float b = 2 * vectorDot(&d, &o);",
            ),
            ("let root = reduced.sqrt();", "float root = sqrtf(reduced);"),
            (
                "let near = (-b - root) / (two * a);",
                "float near = (-b - root) / (2 * a);",
            ),
            ("let e = k.a.mul_add(k.c, -w);", "float e = fmaf(a, c, -w);"),
            (
                "let cross = cross(k.o, input.d);",
                "vector cross = vectorCross(&o, &d);",
            ),
            (
                "let l = sub(k.o, scale(foot, input.d));",
                "vector l = vectorSub(&o, vectorScale(foot, &d));",
            ),
            ("Stage::Whole => whole(input, open),", ""),
            ("let [t, too] = bounds.map(rounding::round);", ""),
            ("let threshold = self.threshold();", ""),
        ] {
            assert_eq!(single(line), statement);
        }
        assert_eq!(
            in_c("let s = d.sqrt();", Precision::Binary64),
            "double s = sqrt(d);"
        );
    }
}
