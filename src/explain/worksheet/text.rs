//! A worksheet on paper: as plain text, or as Markdown.

use super::Worksheet;
use super::exercise::Exercise;
use crate::text::wrap;

/// Which part of a worksheet is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// For the students.
    Exercises,
    /// For the teacher.
    Key,
}

/// Columns of a page.
const WIDTH: usize = 76;
/// What the students may look up.
const FORMULAS: [&str; 6] = [
    "p(t) = p0 + t·d            the ray; o = p0 − c",
    "A = d·d    B = 2 d·o    C = o·o − r²",
    "Δ = B² − 4AC               Δ < 0 no point, Δ = 0 one, Δ > 0 two",
    "t = (−B ± √Δ) / 2A         near has the minus, far the plus",
    "seen is the least t > 0    none if both are 0 or below",
    "(a, b, c)·(x, y, z) = ax + by + cz",
];

impl Worksheet {
    /// One part as plain text.
    pub fn text(&self, part: Part) -> String {
        let mut out = Vec::new();
        out.extend(paragraph(&self.title(part), "", ""));
        if part == Part::Key {
            out.push(String::new());
            out.extend(paragraph(&self.how_to_see(), "", ""));
        }
        if part == Part::Exercises {
            out.push(String::new());
            out.push(format!("Name {}  Date {}", "_".repeat(44), "_".repeat(16)));
            out.extend(
                self.about.iter().flat_map(|about| {
                    std::iter::once(String::new()).chain(paragraph(about, "", ""))
                }),
            );
            out.push(String::new());
            out.extend(FORMULAS.map(|formula| format!("    {formula}")));
        }
        for (n, exercise) in (1..).zip(&self.exercises) {
            out.push(String::new());
            let number = format!("{n:<4}", n = format!("{n}."));
            out.extend(paragraph(exercise.title, &number, "    "));
            if part == Part::Exercises {
                for sentence in &exercise.given {
                    out.extend(paragraph(sentence, "    ", "    "));
                }
            } else {
                out.extend(paragraph(&place(exercise), "    ", "    "));
            }
            for (letter, task) in ('a'..).zip(&exercise.tasks) {
                let text = match part {
                    Part::Exercises => &task.asked,
                    Part::Key => &task.answer,
                };
                out.extend(paragraph(text, &format!("    {letter}) "), "       "));
                if part == Part::Exercises {
                    out.extend(std::iter::repeat_n(String::new(), task.room));
                }
            }
        }
        lines(&out)
    }

    /// One part as Markdown.
    pub fn markdown(&self, part: Part) -> String {
        let mut out = vec![format!("# {}", self.title(part))];
        if part == Part::Key {
            out.push(self.how_to_see());
        }
        if part == Part::Exercises {
            out.push("Name: \\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_\\_ Date: \\_\\_\\_\\_\\_\\_\\_\\_".into());
            out.extend(self.about.clone());
            let formulas = FORMULAS.map(|f| format!("    {f}"));
            out.push(formulas.join("\n"));
        }
        for (n, exercise) in (1..).zip(&self.exercises) {
            out.push(format!("## {n}. {}", exercise.title));
            if part == Part::Exercises {
                out.push(exercise.given.join("  \n"));
            } else {
                out.push(place(exercise));
            }
            for (letter, task) in ('a'..).zip(&exercise.tasks) {
                match part {
                    Part::Exercises => {
                        out.push(format!("{letter}) {}", task.asked));
                        out.push("<br>".repeat(task.room));
                    }
                    Part::Key => out.push(format!("{letter}) {}", task.answer)),
                }
            }
        }
        out.join("\n\n") + "\n"
    }

    fn title(&self, part: Part) -> String {
        let what = match part {
            Part::Exercises => "Worksheet",
            Part::Key => "Answers to worksheet",
        };
        format!("{what} {}: {}", self.seed, self.scene)
    }

    fn how_to_see(&self) -> String {
        format!(
            "The pixels are those of {}. To see one: {}",
            self.size, self.see
        )
    }
}

/// Which pixel an exercise is of.
fn place(exercise: &Exercise) -> String {
    let (x, y) = exercise.pixel;
    format!("pixel ({x}, {y})")
}

/// Text in lines; `first` stands before the first, `next` before each other.
fn paragraph(text: &str, first: &str, next: &str) -> Vec<String> {
    let room = WIDTH - first.chars().count().max(next.chars().count());
    if text.chars().count() <= room {
        return vec![first.to_owned() + text];
    }
    let lines = wrap(text, room).into_iter().enumerate();
    lines
        .map(|(i, line)| if i == 0 { first } else { next }.to_owned() + &line)
        .collect()
}

fn lines(lines: &[String]) -> String {
    lines.iter().map(|line| line.clone() + "\n").collect()
}
