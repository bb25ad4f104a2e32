//! `rayscope grade`: somebody else's answers held against the truth.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use rayscope::lab::{Family, numbers};
use serde_json::Value;

fn rayscope(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().unwrap();
    // A program that refuses its input early leaves the pipe.
    let _ = writer.join().unwrap();
    output
}

fn problems() -> String {
    let mut csv = String::from("ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n");
    for family in ["typical", "far-4e3", "tangent", "subnormal", "overflow"] {
        for problem in Family::by_name(family).unwrap().sample(1, 60) {
            csv += &numbers(&problem).map(|x| x.to_string()).join(",");
            csv.push('\n');
        }
    }
    csv
}

fn results(output: &Output) -> Vec<Value> {
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    json["results"].as_array().unwrap().clone()
}

#[test]
fn answers_of_a_method_here_are_graded_as_that_method_is() {
    for method in ["textbook", "haines", "double", "exact"] {
        let answered = rayscope(&["solve", "--batch", "-", "--method", method], &problems());
        assert!(answered.status.success(), "{answered:?}");
        let answers = String::from_utf8(answered.stdout).unwrap();
        let graded = rayscope(&["grade", "-", "--format", "json"], &answers);
        assert!(graded.status.success(), "{graded:?}");
        let results = results(&graded);
        let ours = results.iter().find(|r| r["method"] == method).unwrap();
        assert_eq!(results[0]["method"], "given");
        for field in [
            "rays",
            "wrong",
            "judged",
            "ulp",
            "worst_input",
            "first_wrong_input",
        ] {
            assert_eq!(results[0][field], ours[field], "{field} of {method}");
        }
    }
}

const HEADER: &str = "class,near,far,ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n";
/// The tutorial's pixel (20, 20): 10 and 30; a tangent of it: 20; a miss.
const SECANT: &str = "20,20,0,0,0,1,20,20,20,10\n";
const TANGENT: &str = "30,20,0,0,0,1,20,20,20,10\n";
const MISS: &str = "31,20,0,0,0,1,20,20,20,10\n";

fn grade(rows: &[String]) -> (Output, Vec<Value>) {
    let output = rayscope(
        &["grade", "-", "--format", "json"],
        &(HEADER.to_owned() + &rows.concat()),
    );
    let results = results(&output);
    (output, results)
}

#[test]
fn each_fault_is_counted_as_what_it_is() {
    let rows = [
        format!("secant,10,30,{SECANT}"),
        format!("hit,10,30.000002,{SECANT}"),
        format!("hit,20,20,{TANGENT}"),
        format!("miss,,,{MISS}"),
        format!("hit,1,2,{MISS}"),
        format!("miss,,,{SECANT}"),
        format!("secant,20,20,{TANGENT}"),
        format!("secant,10,inf,{SECANT}"),
        format!("nan,,,{SECANT}"),
    ];
    let (output, results) = grade(&rows);
    assert!(output.status.success(), "{output:?}");
    let given = &results[0];
    let wrong = &given["wrong"];
    assert_eq!(given["rays"], 9);
    let counts = ["false_hit", "false_miss", "wrong_count", "not_finite"].map(|kind| &wrong[kind]);
    assert_eq!(counts, [1, 1, 1, 2]);
    assert_eq!(given["judged"], 3);
    // 30.000002 is one spacing of binary32 above 30.
    assert_eq!(given["ulp"]["max"], 1.0);
    assert_eq!(given["first_wrong"], "false hit");
    assert_eq!(given["worst_input"][9], "0x1.4p+3");
}

#[test]
fn of_each_fault_the_row_with_the_fewest_digits_is_shown() {
    // Two false misses, the second in fewer digits; a false hit; a right answer.
    let rows = [
        "miss,,,20.5,20,0,0,0,1,20,20,20,10\n".to_owned(),
        format!("miss,,,{SECANT}"),
        format!("hit,1,2,{MISS}"),
        format!("hit,20,20,{TANGENT}"),
    ];
    let input = HEADER.to_owned() + &rows.concat();
    let json = rayscope(&["grade", "-", "--format", "json"], &input);
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    let simplest = json["simplest"].as_array().unwrap();
    let of = |i: usize, field: &str| simplest[i][field].clone();
    assert_eq!(simplest.len(), 2);
    assert_eq!(
        (of(0, "fault"), of(0, "count")),
        ("false hit".into(), 1.into())
    );
    assert_eq!(
        (of(1, "fault"), of(1, "count")),
        ("false miss".into(), 2.into())
    );
    assert_eq!(of(1, "input")[0], "0x1.4p+4");
    assert_eq!(of(1, "given")["class"], "miss");
    assert_eq!(of(1, "exact")["near"], 10.0);
    let text = rayscope(&["grade", "-"], &input);
    let text = String::from_utf8(text.stdout).unwrap();
    let said = "false miss, the simplest of 2: given miss; exact secant 10, 30";
    assert!(text.contains(said), "{text}");
    assert!(
        text.contains("--ray=20,20,0,0,0,1 --sphere=20,20,20,10"),
        "{text}"
    );
}

#[test]
fn answers_with_times_are_drawn_beside_the_methods_here() {
    let folder = tempfile::tempdir().unwrap();
    let chart = folder.path().join("chart.svg");
    let plot = chart.to_str().unwrap();
    let header = HEADER.replace("r\n", "r,ns\n");
    let timed = |ns: &str| SECANT.replace('\n', &format!(",{ns}\n"));
    let rows = format!(
        "{header}miss,,,{}secant,10,30,{}",
        timed("5.5"),
        timed("6.5")
    );
    let output = rayscope(&["grade", "-", "--plot", plot], &rows);
    assert!(output.status.success(), "{output:?}");
    let svg = std::fs::read_to_string(&chart).unwrap();
    for shown in [
        ">given<",
        ">exact<",
        ">50/0 %<",
        "false miss, the one there is",
        "--ray=20,20",
    ] {
        assert!(svg.contains(shown), "{shown}: {svg}");
    }
    // Without times, or with none, there is nothing to draw, and the file that is there stays.
    let bare = HEADER.to_owned() + "secant,10,30," + SECANT;
    let none = format!("{header}secant,10,30,{}", timed("0"));
    for (input, expected) in [
        (bare, "there is no column ns"),
        (none, "column ns: `0`; expected nanoseconds"),
    ] {
        let output = rayscope(&["grade", "-", "--plot", plot], &input);
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        assert!(String::from_utf8(output.stderr).unwrap().contains(expected));
        assert_eq!(std::fs::read_to_string(&chart).unwrap(), svg);
    }
}

#[test]
fn a_bad_row_is_named_and_the_others_are_graded() {
    let rows = [
        format!("secant,10,30,{SECANT}"),
        format!("secant,ten,30,{SECANT}"),
        format!("maybe,10,30,{SECANT}"),
        "secant,10,30,20,20,0,0,0,0,20,20,20,10\n".to_owned(),
        "secant,10,30,20,20\n".to_owned(),
    ];
    let (output, results) = grade(&rows);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(results[0]["rays"], 1);
    let said = String::from_utf8(output.stderr).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 4, "{said}");
    for (line, words) in lines.iter().zip([
        "line 3, column near: `ten`",
        "line 4, column class: `maybe`",
        "line 5, columns dx, dy, dz: 0,0,0",
        "line 6, column oz",
    ]) {
        assert!(line.contains(words), "{line}");
    }
}

#[test]
fn what_is_no_such_file_is_refused_in_a_sentence() {
    let missing = rayscope(&["grade", "nowhere.csv"], "");
    assert_eq!(missing.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&missing.stderr).contains("nowhere.csv"));
    let headless = rayscope(&["grade", "-"], "ox,oy\n1,2\n");
    assert_eq!(headless.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&headless.stderr).contains("no column oz"));
}

#[test]
fn a_file_without_rows_has_nothing_to_grade() {
    let header = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far\n";
    let output = rayscope(&["grade", "-"], header);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("no row after the header"), "{said}");
    assert!(output.stdout.is_empty());
}

#[test]
fn the_table_shows_the_given_answers_first_and_the_worst_input_as_a_command() {
    let rows = format!("{HEADER}hit,11,30,{SECANT}miss,,,{TANGENT}");
    let output = rayscope(&["grade", "-"], &rows);
    let text = String::from_utf8(output.stdout).unwrap();
    let at = |word: &str| {
        text.find(word)
            .unwrap_or_else(|| panic!("{word} is not in {text}"))
    };
    assert!(at("> given") < at("textbook"));
    assert!(text.contains("false miss, the one there is: given miss; exact tangent 20, 20"));
    assert!(text.contains("rayscope solve --ray=20,20,0,0,0,1 --sphere=20,20,20,10"));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn hexadecimal_answers_are_graded_to_the_last_bit() {
    let csv = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far\n\
               0x0p+0,0,-0x1.8p+1,0,0,0x1p0,0,0,0,0x1p+0,secant,0x1p+1,0x1.000002p+2\n";
    let graded = rayscope(&["grade", "-", "--format", "json"], csv);
    assert!(graded.status.success(), "{graded:?}");
    assert_eq!(results(&graded)[0]["ulp"]["max"], 1.0);
    let bad = csv.replace("0x1p+1", "0x1q+1");
    let refused = rayscope(&["grade", "-"], &bad);
    assert_eq!(refused.status.code(), Some(1));
    assert_eq!(
        String::from_utf8(refused.stderr).unwrap(),
        "rayscope: standard input: line 2, column near: `0x1q+1`; expected a root, such as 12.5, inf or NaN\n"
    );
}
