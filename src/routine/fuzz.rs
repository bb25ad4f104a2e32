//! Texts that are almost routines: whatever is asked to be read, the answer is a program or one sentence.

use proptest::prelude::*;

use super::{Language, RoutineError, RunOutcome, ask, compile};

const SEEDS: [&str; 4] = [
    include_str!("../../tests/routines/half_b.glsl"),
    include_str!("../../tests/routines/iterated.glsl"),
    include_str!("../../tests/routines/hit_record.glsl"),
    include_str!("../../tests/routines/out_parameters.glsl"),
];

const WGSL: &str = include_str!("../../tests/routines/textbook.wgsl");

const PIECES: [&str; 40] = [
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ";",
    ",",
    "+",
    "-",
    "*",
    "/",
    "=",
    "==",
    "<",
    "if (x < 1.0)",
    "else",
    "for (;;)",
    "while (true)",
    "return",
    "return -1.0;",
    "float",
    "vec3",
    "double",
    "bool",
    "struct",
    "out",
    "const",
    "1e999",
    "0.0",
    "4294967296",
    "sqrt(",
    "normalize(",
    "pow(",
    "sin(",
    "#define X 1\n",
    "// roles: ",
    "/*",
    "*/",
    "?1.0:",
];

fn words(text: &str) -> Vec<&str> {
    text.split_inclusive(|c: char| !c.is_ascii_alphanumeric())
        .collect()
}

/// A routine in which words were dropped, doubled, exchanged and put in.
fn altered() -> impl Strategy<Value = String> {
    let change = (
        any::<prop::sample::Index>(),
        any::<prop::sample::Index>(),
        0..5_u8,
        0..PIECES.len(),
    );
    (0..SEEDS.len(), prop::collection::vec(change, 0..6)).prop_map(|(seed, changes)| {
        let mut words = words(SEEDS[seed]);
        for (at, other, kind, piece) in changes {
            let (at, other) = (at.index(words.len()), other.index(words.len()));
            match kind {
                0 => drop(words.remove(at)),
                1 => words.swap(at, other),
                2 => words.insert(at, words[other]),
                3 => words.insert(at, PIECES[piece]),
                _ => words[at] = words[other],
            }
        }
        words.concat()
    })
}

/// Nothing but pieces.
fn heap() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(PIECES.to_vec());
    prop::collection::vec(piece, 0..200).prop_map(|pieces| pieces.join(" "))
}

fn holds(text: &str, language: Language) -> Result<(), TestCaseError> {
    match compile(text, language, false) {
        Ok(program) => {
            let numbers = ([0.5, 0.25, -3.0], [0.0, 0.0, 1.0], [0.0; 3], 1.0);
            let (p0, d, c, r) = numbers;
            let outcome = ask(&program, p0, d, c, r);
            // The same again, from what the run before has left.
            prop_assert_eq!(
                format!("{outcome:?}"),
                format!("{:?}", ask(&program, p0, d, c, r))
            );
        }
        Err(RoutineError { line, problem, .. }) => {
            prop_assert!(line >= 1 && line <= text.split('\n').count().max(1));
            prop_assert!(!problem.is_empty() && !problem.contains('\n'), "{problem}");
            prop_assert!(
                !problem.contains("beyond the reader"),
                "the reader panicked: {text}"
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn a_text_is_a_program_or_a_sentence(altered in altered(), heap in heap(), noise in "\\PC{0,200}") {
        for text in [altered, heap, noise] {
            holds(&text, Language::Glsl)?;
            holds(&text, Language::Wgsl)?;
        }
    }

    #[test]
    fn a_text_that_ends_early_is_refused(at in any::<prop::sample::Index>()) {
        holds(&WGSL[..at.index(WGSL.len())], Language::Wgsl)?;
        let text = SEEDS[0];
        holds(&text[..at.index(text.len())], Language::Glsl)?;
    }
}

/// What made a reader run out of its stack, or of memory, is refused before it reads.
#[test]
fn what_is_deep_or_long_is_refused() {
    let with = |body: String| {
        format!(
            "float f(vec3 ro, vec3 rd, vec3 ce, float ra) {{ float x = 1.0; {body} return x; }}"
        )
    };
    let hostile = [
        with(format!(
            "x = {}x{};",
            "(".repeat(10_000),
            ")".repeat(10_000)
        )),
        with(format!("x = x{};", " + x".repeat(20_000))),
        with(format!("x = {}x;", "- ".repeat(20_000))),
        with("{".repeat(5_000) + &"}".repeat(5_000)),
        with("if (x > 0.0) ".repeat(5_000) + ";"),
        with("if (x > 0.0) {} else ".repeat(5_000) + "{}"),
        with("float a[100000000];".to_owned()),
        with(format!("float y{};", ", z".repeat(20_000))),
        format!(
            "#define A {}\n#define B A A A A\n#define C B B B B\n{}",
            "x ".repeat(10),
            with("x = C;".into())
        ),
        "x".repeat(100_000),
    ];
    for text in hostile {
        let error = compile(&text, Language::Glsl, false).unwrap_err();
        assert!(!error.problem.is_empty());
    }
    // What calls itself over and over is put in over and over.
    let mut text = "float f0(float x) { return x * x; }\n".to_owned();
    for i in 1..40 {
        let sum = format!("f{j}(x) + f{j}(x)", j = i - 1);
        text = format!("{text}float f{i}(float x) {{ return {sum}; }}\n");
    }
    text += "float f(vec3 ro, vec3 rd, vec3 ce, float ra) { return f39(ra); }";
    let error = compile(&text, Language::Glsl, false).unwrap_err();
    assert!(error.problem.contains("too"), "{error}");
}

#[test]
fn a_loop_ends_after_ten_thousand_operations() {
    for body in [
        "while (true) { x += 1.0; }",
        "for (;;) {}",
        "for (int i = 0; i < 100000; i++) x += 1.0;",
    ] {
        let text = format!(
            "float f(vec3 ro, vec3 rd, vec3 ce, float ra) {{ float x = 1.0; {body} return x; }}"
        );
        let program = compile(&text, Language::Glsl, false).unwrap();
        let outcome = ask(&program, [0.0; 3], [1.0; 3], [0.0; 3], 1.0);
        assert_eq!(outcome, RunOutcome::TooLong, "{body}");
    }
}

#[test]
fn what_can_not_be_told_is_refused_in_a_sentence_with_its_line() {
    let cases = [
        (
            "float f(vec3 rd, vec3 ro, vec3 ce, float ra) { return 1.0; }",
            "line 1: f: rd reads like the direction",
        ),
        (
            "\n\nfloat f(vec2 a) { return 1.0; }",
            "line 3: f: a ray and a sphere are",
        ),
        (
            "float f(vec3 ro, vec3 rd, vec3 ce, float ra) {\n  return sin(ra);\n}",
            "line 2: sin is not run here",
        ),
        (
            "float f(vec3 ro, vec3 rd, vec3 ce, float ra) {\n  return rad;\n}",
            "line 2: unknown variable: rad",
        ),
        (
            "float x =\nfloat f(vec3 ro, vec3 rd, vec3 ce, float ra) { return ra; }",
            "line 2: expected (, found f",
        ),
        (
            "float f(vec3 ro, vec3 rd, vec3 ce, float ra) {\n  float x = ra return x;\n}",
            "line 2: expected ",
        ),
        (
            "uniform float x; float f(vec3 ro, vec3 rd, vec3 ce, float ra) { return x; }",
            "line 1: ",
        ),
        ("", "line 1: there is no function"),
    ];
    for (text, sentence) in cases {
        let error = compile(text, Language::Glsl, false)
            .unwrap_err()
            .to_string();
        assert!(error.to_lowercase().starts_with(sentence), "{error}");
    }
    let said = "// roles: direction, origin, center, radius\nfloat f(vec3 rd, vec3 ro, vec3 ce, float ra) { return ro.x; }";
    let program = compile(said, Language::Glsl, false).unwrap();
    assert_eq!(
        ask(&program, [7.0; 3], [1.0; 3], [0.0; 3], 1.0),
        RunOutcome::One(7.0)
    );
}
