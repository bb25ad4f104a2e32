//! A report as Markdown.

use std::fmt::Write as _;

use super::{Align, ReportPart, Table};
use crate::text::paragraph;

/// A part with its line end; parts are an empty line apart.
pub(super) fn part(part: &ReportPart) -> Option<String> {
    Some(match part {
        ReportPart::Heading(text) => format!("### {text}\n"),
        // Two blanks at the end of a line keep the next one from joining it.
        ReportPart::Lines(lines) if lines.is_empty() => return None,
        ReportPart::Lines(lines) => lines.join("  \n") + "\n",
        ReportPart::Fixed(lines) => {
            let lines: String = lines.iter().map(|line| paragraph(line)).collect();
            format!("```text\n{lines}```\n")
        }
        ReportPart::Items(items) if items.is_empty() => return None,
        ReportPart::Items(items) => format!("* {}\n", items.join("\n* ")),
        ReportPart::Table(table) => table.markdown(),
        ReportPart::Gap => return None,
    })
}

impl Table {
    /// The table alone, as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = String::from("|");
        // Writing to a string does not fail.
        for column in &self.columns {
            let _ = write!(out, " {} |", escaped(&column.name));
        }
        out += "\n|";
        for column in &self.columns {
            out += match column.align {
                Align::Left | Align::Words => "---|",
                Align::Right => "--:|",
            };
        }
        out.push('\n');
        for row in &self.rows {
            out.push('|');
            for cell in row {
                let _ = write!(out, " {} |", escaped(cell));
            }
            out.push('\n');
        }
        out
    }
}

/// A bar within a cell would end it.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|")
}
