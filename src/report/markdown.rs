//! A report as Markdown.

use std::fmt::Write as _;

use super::{Align, Part, Table};
use crate::text::paragraph;

/// A part with its line end; parts are an empty line apart.
pub(super) fn part(part: &Part) -> Option<String> {
    Some(match part {
        Part::Heading(text) => format!("### {text}\n"),
        // Two blanks at the end of a line keep the next one from joining it.
        Part::Lines(lines) if lines.is_empty() => return None,
        Part::Lines(lines) => lines.join("  \n") + "\n",
        Part::Fixed(lines) => {
            let lines: String = lines.iter().map(|line| paragraph(line)).collect();
            format!("```text\n{lines}```\n")
        }
        Part::Items(items) if items.is_empty() => return None,
        Part::Items(items) => format!("* {}\n", items.join("\n* ")),
        Part::Table(table) => table.markdown(),
        Part::Gap => return None,
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
