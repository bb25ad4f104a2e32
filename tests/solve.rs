//! `rayscope solve` as another program meets it: the built binary, its streams, its exit status.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};

const HEADER: &str = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r";

/// What a run of the program left behind.
struct Run {
    status: i32,
    out: String,
    err: String,
}

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn solve(arguments: &[&str], input: &str) -> Run {
    let mut child = start(&[&["solve"], arguments].concat());
    child
        .stdin
        .take()
        .unwrap()
        .write_all(input.as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    Run {
        status: output.status.code().unwrap(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn batch(input: &str) -> Run {
    solve(&["--batch", "-", "--method", "double"], input)
}

#[test]
fn batch_answers_row_by_row_beside_what_it_was_given() {
    let run = batch(&format!(
        "{HEADER}\n20,20,0,0,0,1,20,20,20,10\n30,20,0,0,0,1,20,20,20,10\n31,20,0,0,0,1,20,20,20,10\n"
    ));
    assert_eq!(run.status, 0);
    assert_eq!(run.err, "");
    assert_eq!(
        run.out,
        format!(
            "{HEADER},class,near,far,a,b,c,discriminant\n\
             20,20,0,0,0,1,20,20,20,10,secant,10,30,1,-40,300,400\n\
             30,20,0,0,0,1,20,20,20,10,tangent,20,20,1,-40,400,0\n\
             31,20,0,0,0,1,20,20,20,10,miss,,,1,-40,421,-84\n"
        )
    );
}

/// From (20, 20, 0) along z the tutorial's sphere is met at 10 and at 30.
#[test]
fn batch_looks_between_tmin_and_tmax() {
    let ray = "20,20,0,0,0,1,20,20,20,10";
    let visible = |columns: &str, values: &str| {
        let run = batch(&format!("{HEADER},{columns}\n{ray},{values}\n"));
        let (header, row) = run.out.trim_end().split_once('\n').unwrap();
        assert!(header.ends_with(",discriminant,visible"), "{header}");
        let answers = row.rsplit(',').next().unwrap().to_owned();
        (run.status, answers, run.err)
    };
    for (columns, values, expected) in [
        ("tmin,tmax", "0,inf", "10"),
        ("tmax,tmin", "29,0", "10"),
        ("tmin", "9.5", "10"),
        ("tmin", "10", "30"),
        ("tmin", "30", ""),
        ("tmin", "-5", "10"),
        ("tmax", "10", ""),
        ("tmax", "0x1.4001p3", "10"),
        ("tmin,tmax", "11,29", ""),
        ("tmin,tmax", "11,31", "30"),
        ("tmin,tmax", "10,10", ""),
    ] {
        let found = visible(columns, values);
        assert_eq!(
            found,
            (0, expected.into(), String::new()),
            "{columns} {values}"
        );
    }
    for (values, said) in [
        ("2,1", "columns tmin, tmax: 2 is above 1"),
        (",1", "column tmin: nothing there"),
        ("0,nan", "column tmax: nan"),
        ("0,1e39", "column tmax: 1e39 is past the range"),
        ("x,1", "column tmin: `x` is not a number"),
    ] {
        let (status, answer, err) = visible("tmin,tmax", values);
        assert_eq!((status, answer), (1, String::new()), "{values}");
        assert!(err.contains("line 2") && err.contains(said), "{err}");
    }
    let invalid = batch(&format!("{HEADER},tmin\n{ray},x\n"));
    assert!(
        invalid.out.ends_with(",x,invalid,,,,,,,\n"),
        "{}",
        invalid.out
    );
    // Without the two there is no such column, and one of that name is somebody else's.
    let own = batch(&format!("{HEADER},visible\n{ray},mine\n"));
    assert!(
        own.out.ends_with(",mine,secant,10,30,1,-40,300,400\n"),
        "{}",
        own.out
    );
    let clash = batch(&format!("{HEADER},visible,tmin\n{ray},mine,0\n"));
    assert!(
        clash.status == 1 && clash.err.contains("column visible"),
        "{}",
        clash.err
    );
    let twice = batch(&format!("{HEADER},tmin,tmin\n{ray},0,0\n"));
    assert!(
        twice.status == 1 && twice.err.contains("two columns tmin"),
        "{}",
        twice.err
    );
}

/// A root that rounds to 0 and lies above it is seen from 0 on.
#[test]
fn batch_sees_what_lies_ahead_by_less_than_binary32_can_say() {
    // p0 is 2^-149 before the surface of the unit sphere at the origin, along x, and d is 8 long.
    let rows = format!("{HEADER},tmin\n-1e-45,0,0,8,0,0,8,0,0,8,0\n");
    let run = solve(&["--batch", "-"], &rows);
    let fields: Vec<&str> = run.out.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(fields[12], "0", "{}", run.out);
    assert_eq!(fields[18], "0", "{}", run.out);
}

#[test]
fn batch_takes_columns_in_any_order_and_leaves_the_others_alone() {
    let run = batch(
        "\u{feff}note,r,cx,cy,cz,dx,dy,dz,ox,oy,oz,\"a tag\"\r\n\
         \"says \"\"hit\"\", or not\",1.50,0,0,0, +1e0,0,0,-3,0,0,007\r\n\
         \r\n\
         \"two\nlines\",\"0.0\",0,0,0,1,0,0,-3,.5,0,\r\n\
         5\" nail,1,0,0,0,1,0,0,-3,5.,0,x",
    );
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(
        run.out,
        "note,r,cx,cy,cz,dx,dy,dz,ox,oy,oz,\"a tag\",class,near,far,a,b,c,discriminant\r\n\
         \"says \"\"hit\"\", or not\",1.50,0,0,0, +1e0,0,0,-3,0,0,007,secant,1.5,4.5,1,-6,6.75,9\r\n\
         \"two\nlines\",\"0.0\",0,0,0,1,0,0,-3,.5,0,,miss,,,1,-6,9.25,-1\r\n\
         5\" nail,1,0,0,0,1,0,0,-3,5.,0,x,miss,,,1,-6,33,-96\n"
    );
}

/// Each bad row with the place and the value that its reason must name.
#[test]
fn batch_names_what_is_wrong_with_a_row_and_answers_the_others() {
    let bad = [
        ("x,0,0,1,0,0,0,0,0,1", "line 3, column ox: `x`"),
        ("0,,0,1,0,0,0,0,0,1", "line 5, column oy: nothing there"),
        ("0,0,1e39,1,0,0,0,0,0,1", "line 7, column oz: 1e39"),
        ("0,0,0,inf,0,0,0,0,0,1", "line 9, column dx: inf"),
        ("0,0,0,1,NaN,0,0,0,0,1", "line 11, column dy: NaN"),
        (
            "0,0,0,0,-0,1e-60,0,0,0,1",
            "line 13, columns dx, dy, dz: 0,0,0",
        ),
        ("0,0,0,1,0,0,0,0,0,-1", "line 15, column r: -1"),
        ("0,0,0,1,0,0,0,0,0", "line 17, column r: nothing there"),
        ("0,0,0,1,0,0,0,0,0,1,7", "line 19, column 11: 11 fields"),
        ("0,0,0,1,0,0,\"0,0,0,1", "line 21, column cx: a quote"),
        ("0,0,0,1,0,0,0x10,0,0,1", "line 23, column cx: `0x10`"),
        (
            &format!("0,0,0,1,0,0,{},0,0,1", "0".repeat(100_000)),
            "line 25, column cx: the line is longer",
        ),
        ("0,0,0,1,0,0,0,0,0\r,1\r0", "line 27, column r: `1\\r0`"),
    ];
    let good = "-3,0,0,1,0,0,0,0,0,1";
    let mut input = HEADER.to_owned();
    for (row, _) in bad {
        input = input + "\n" + good + "\n" + row;
    }
    let run = batch(&input);
    assert_eq!(run.status, 1);
    let mut out = csv::Reader::from_reader(run.out.as_bytes());
    let rows: Vec<_> = out.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2 * bad.len());
    for pair in rows.chunks(2) {
        assert_eq!(
            pair[0].iter().skip(10).collect::<Vec<_>>(),
            ["secant", "2", "4", "1", "-6", "8", "4"]
        );
        assert_eq!(
            pair[1].iter().skip(10).collect::<Vec<_>>(),
            ["invalid", "", "", "", "", "", ""]
        );
    }
    for ((_, reason), said) in bad.iter().zip(run.err.lines()) {
        assert!(said.contains(reason), "{said} does not say {reason}");
        assert!(
            said.contains("expected")
                || said.contains("header")
                || said.contains("never closed")
                || said.contains("left out")
        );
    }
    assert_eq!(run.err.lines().count(), bad.len());
}

#[test]
fn batch_refuses_a_header_that_will_not_do() {
    for (input, reason) in [
        ("", "is empty"),
        ("\n\r\n", "is empty"),
        ("ox,oy,oz,dx,dy,dz,cx,cy,cz\n", "no column r"),
        ("ox,oy,oz,dx,dy,dz,cx,cy,cz,r,r\n", "two columns r"),
        ("ox,oy,oz,dx,dy,dz,cx,cy,cz,r,near\n", "column near"),
        ("0,0,0,1,0,0,0,0,0,1\n", "no column ox"),
        (
            "ox,oy,oz,dx,dy,dz,cx,cy,cz,r\r0,0,0,1,0,0,0,0,0,1\r",
            "a carriage return",
        ),
    ] {
        let run = batch(input);
        assert_eq!(run.status, 1);
        assert_eq!(run.out, "");
        assert!(
            run.err.contains(reason),
            "{} does not say {reason}",
            run.err
        );
        assert_eq!(run.err.lines().count(), 1);
    }
    let run = solve(&["--batch", "no/such/file.csv"], "");
    assert_eq!(run.status, 1);
    assert!(
        run.err.contains("cannot read no/such/file.csv"),
        "{}",
        run.err
    );
}

#[test]
fn batch_tells_apart_what_binary32_cannot_hold() {
    let rows = format!(
        "{HEADER}\n-3e20,0,0,1,0,0,0,0,0,1e20\n-3.4028235e38,0,0,1,0,0,3.4028235e38,0,0,1e38\n"
    );
    let run = solve(&["--batch", "-", "--method=textbook"], &rows);
    let answers: Vec<_> = run.out.lines().skip(1).collect();
    assert!(
        answers[0].ends_with(",nan,NaN,NaN,1,-6e20,NaN,NaN"),
        "{}",
        answers[0]
    );
    let run = batch(&rows);
    let answers: Vec<_> = run.out.lines().skip(1).collect();
    assert!(answers[1].contains(",secant,inf,inf,1,"), "{}", answers[1]);
    assert_eq!(run.status, 0);
}

#[test]
fn an_answer_comes_before_the_next_row_is_asked_for() {
    let mut child = start(&["solve", "--batch", "-"]);
    let mut input = child.stdin.take().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    let mut line = String::new();
    for row in [HEADER, "-3,0,0,1,0,0,0,0,0,1", "0,0,0,1,0,0,0,0,0,1"] {
        writeln!(input, "{row}").unwrap();
        line.clear();
        output.read_line(&mut line).unwrap();
        assert!(line.starts_with(row), "{line}");
    }
    drop(input);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_reader_that_has_enough_ends_the_batch_quietly() {
    let mut child = start(&["solve", "--batch", "-"]);
    drop(child.stdout.take());
    let mut input = child.stdin.take().unwrap();
    // The program may be gone before it has read everything: then writing fails, as it should.
    let rows = format!("{HEADER}\n{}", "-3,0,0,1,0,0,0,0,0,1\n".repeat(100_000));
    let _ = input.write_all(rows.as_bytes());
    drop(input);
    let mut said = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut said)
        .unwrap();
    assert_eq!(said, "");
    assert!(child.wait().unwrap().success());
}

const TUTORIAL: [&str; 4] = ["--ray", "20,20,0,0,0,1", "--sphere", "20,20,20,10"];

#[test]
fn one_intersection_is_worked_out_as_in_the_tutorial() {
    let run = solve(&[&TUTORIAL[..], &["--method", "textbook"]].concat(), "");
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    for line in [
        "A = d·d\n    0² + 0² + 1² → 1\n",
        "    2·(0·0 + 0·0 + 1·(−20)) → −40\n",
        "C = |o|² − r²\n    400 − 100 → 300\n",
        "    float c = oo - rr;\n",
        "Δ = B² − 4AC\n    1600 − 1200 → 400\n",
        "secant  Δ > 0: the line crosses the sphere in two points\n",
        "near → 10, exactly\nfar → 30, exactly\n",
        "hit: the ray sees it at t 10\n",
    ] {
        assert!(run.out.contains(line), "{line} is not in {}", run.out);
    }
}

#[test]
fn a_wrong_class_is_said_in_words() {
    let far = [
        "--ray=-4100,0.5,0,1,0,0",
        "--sphere=0,0,0,1",
        "--method=textbook",
    ];
    let run = solve(&far, "");
    assert_eq!(run.status, 0);
    assert!(run.out.contains(
        "WRONG: textbook says tangent, but the line crosses the sphere: exactly, Δ is 3 and not 0."
    ));
}

#[test]
fn json_has_the_answer_the_coefficients_and_the_steps() {
    let run = solve(
        &[&TUTORIAL[..], &["--format=json", "--method=textbook"]].concat(),
        "",
    );
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let found: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    for (pointer, value) in [
        ("/class", "\"secant\""),
        ("/near", "10.0"),
        ("/far", "30.0"),
        ("/place", "\"hit\""),
        ("/visible", "10.0"),
        ("/precision", "\"binary32\""),
        ("/discriminant", "400.0"),
        ("/errors/discriminant/exact", "\"400\""),
        ("/errors/near/ulps", "0.0"),
        ("/truth/class", "\"secant\""),
        ("/verdict", "null"),
        ("/steps/8/symbol", "\"Δ\""),
        ("/steps/8/numbers", "\"1600 − 1200\""),
        ("/ray/direction", "[0.0,0.0,1.0]"),
    ] {
        let at = found.pointer(pointer).map(ToString::to_string);
        assert_eq!(at.as_deref(), Some(value), "{pointer}");
    }
    let nan = [
        "--ray=-3e20,0,0,1,0,0",
        "--sphere=0,0,0,1e20",
        "--format=json",
    ];
    let run = solve(&[&nan[..], &["--method=textbook"]].concat(), "");
    let found: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!(found["class"], "nan");
    assert_eq!(found["near"], "NaN");
    assert_eq!(found["c"], "NaN");
    assert_eq!(found["truth"]["far"].as_f64(), Some(4e20));
}

#[test]
fn negative_numbers_need_no_equals_sign() {
    let run = solve(&["--ray", "-3,0,0,1,0,0", "--sphere", "-0,0,0,1"], "");
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(
        run.out
            .contains("near = (−B − √Δ) / 2A = (6 − √4) / (2·1) = 2")
    );
}

#[test]
fn a_bad_number_is_named_and_a_bad_command_line_is_told_apart() {
    for (ray, sphere, reason) in [
        ("x,0,0,1,0,0", "0,0,0,1", "--ray, ox: `x` is not a number"),
        ("0,0,0,0,0,0", "0,0,0,1", "--ray: d is 0,0,0"),
        ("0,0,0,1,0,0", "0,0,0,-1", "--sphere: r is -1"),
        ("0,0,0,1,0,0", "0,nan,0,1", "--sphere, cy: nan"),
        ("0,0,0,1e39,0,0", "0,0,0,1", "--ray, dx: 1e39"),
        ("0,0,0,1,0", "0,0,0,1", "5 numbers; expected 6"),
    ] {
        let run = solve(&["--ray", ray, "--sphere", sphere], "");
        assert_eq!(run.status, 1);
        assert_eq!(run.out, "");
        assert!(
            run.err.contains(reason),
            "{} does not say {reason}",
            run.err
        );
    }
    let wrong: [&[&str]; 6] = [
        &[],
        &["--ray", "0,0,0,1,0,0"],
        &["--sphere", "0,0,0,1"],
        &[
            "--ray",
            "0,0,0,1,0,0",
            "--sphere",
            "0,0,0,1",
            "--method",
            "best",
        ],
        &["--batch", "-", "--format", "json"],
        &["--batch", "-", "--ray", "0,0,0,1,0,0"],
    ];
    for arguments in wrong {
        assert_eq!(solve(arguments, "").status, 2, "{arguments:?}");
    }
}

/// Every named case by the default method, to the bit, with the file's own columns in their places.
#[test]
fn batch_gives_every_named_case_its_exact_answer() {
    let run = solve(&["--batch", "tests/cases/named.csv"], "");
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let given = std::fs::read_to_string("tests/cases/named.csv").unwrap();
    let mut out = csv::Reader::from_reader(run.out.as_bytes());
    let column =
        |name: &str, names: &csv::StringRecord| names.iter().position(|n| n == name).unwrap();
    let names = out.headers().unwrap().clone();
    let pairs = [
        ("class", "expected_class"),
        ("near", "expected_near"),
        ("far", "expected_far"),
    ]
    .map(|(found, expected)| (column(found, &names), column(expected, &names)));
    let mut rows = 0;
    for row in out.records() {
        let row = row.unwrap();
        assert_eq!(row[pairs[0].0], row[pairs[0].1], "{}", &row[0]);
        for (found, expected) in &pairs[1..] {
            let bits = |text: &str| text.parse::<f32>().map(f32::to_bits).ok();
            assert_eq!(bits(&row[*found]), bits(&row[*expected]), "{}", &row[0]);
        }
        rows += 1;
    }
    assert_eq!(rows, 51);
    for (given, out) in given.lines().zip(run.out.lines()) {
        assert!(out.starts_with(&format!("{given},")), "{out}");
    }
}
