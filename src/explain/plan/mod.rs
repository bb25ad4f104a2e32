//! The plan of a frame as lines of text: what was done, what was left out, and why.

mod reasons;
mod report;

use super::panel::{Line, Role};
use crate::text::wrap;

pub use reasons::{PlanLine, plan_lines, plan_sentence};
pub use report::{FramePlan, Plans, plans_report, plans_table};

/// Columns of a thing's name, and of each of its two numbers.
const NAME: usize = 16;
const NUMBER: usize = 9;

/// The plan for a panel: what this `frame` did, the numbers of all things, then the reasons.
pub fn plan_panel(frame: &str, plan: &[PlanLine], width: usize) -> Vec<Line> {
    let spread = width.saturating_sub(NAME + 2 * NUMBER) / 2;
    let [first, second] = [NAME + NUMBER + spread, NAME + 2 * (NUMBER + spread)];
    let mut out: Vec<Line> = wrap(frame, width).into_iter().map(Line::plain).collect();
    out.push(
        Line::new(0)
            .with(Role::Label, right("kept", first))
            .with(Role::Label, right("left out", second - first)),
    );
    for line in plan {
        let role = if line.left_out > 0 {
            Role::Value
        } else {
            Role::Faint
        };
        out.push(
            Line::new(0)
                .with(Role::Plain, format!("{:NAME$}", line.what))
                .with(Role::Plain, right(&compact(line.kept), first - NAME))
                .with(role, right(&compact(line.left_out), second - first)),
        );
    }
    for line in plan {
        out.push(Line::new(0));
        out.push(Line::new(0).with(Role::Label, line.what.trim_start()));
        let words = wrap(&line.because, width.saturating_sub(2));
        out.extend(
            words
                .into_iter()
                .map(|text| Line::plain(format!("  {text}"))),
        );
    }
    out
}

fn right(text: &str, width: usize) -> String {
    format!("{text:>width$}")
}

/// A number in at most seven columns.
fn compact(n: u64) -> String {
    match n {
        0..10_000_000 => n.to_string(),
        10_000_000..1_000_000_000 => format!("{}·10⁶", n / 1_000_000),
        _ => format!("{}·10⁹", n / 1_000_000_000),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_of_34_columns_holds_every_line() {
        let plan = [
            PlanLine::new("stage 3", 1, 23_999_999_999_999, "it was sure"),
            PlanLine::new("  before the eye", 9_999_999, 0, "a ".repeat(60)),
        ];
        for line in plan_panel("It rests.", &plan, 34) {
            let width: usize = line.spans.iter().map(|s| s.text.chars().count()).sum();
            assert!(width <= 34, "{line:?}");
        }
    }
}
