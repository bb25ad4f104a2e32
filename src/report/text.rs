//! A report as text of 80 columns.

use super::{Align, Column, ReportPart, Table};
use crate::text::{paragraph, wrap};

/// Columns of a line.
const WIDTH: usize = 80;

pub(super) fn part(part: &ReportPart) -> String {
    match part {
        ReportPart::Heading(text) => paragraph(text),
        ReportPart::Lines(lines) | ReportPart::Fixed(lines) | ReportPart::Items(lines) => {
            lines.iter().map(|line| paragraph(line)).collect()
        }
        ReportPart::Table(table) => TextLayout::of(table).text(table),
        ReportPart::Gap => "\n".into(),
    }
}

fn columns(text: &str) -> usize {
    text.chars().count()
}

/// How wide the columns of a table are, and how many blanks lie before and between them.
struct TextLayout {
    widths: Vec<usize>,
    gap: usize,
    indent: usize,
}

impl TextLayout {
    fn of(table: &Table) -> Self {
        let widths = |gap| Self {
            widths: widths(table, gap),
            gap,
            indent: table.indent,
        };
        let roomy = widths(2);
        let ends = roomy.end();
        if ends <= WIDTH { roomy } else { widths(1) }
    }

    /// Where the lines end; words take what is left of them.
    fn end(&self) -> usize {
        let gaps = self.gap * self.widths.len().saturating_sub(1);
        self.indent + self.widths.iter().sum::<usize>() + gaps
    }

    fn text(&self, table: &Table) -> String {
        let groups = self.groups(table);
        let names: Vec<String> = table.columns.iter().map(|c| c.name.clone()).collect();
        let is_named = names.iter().any(|name| !name.is_empty());
        let heads = is_named.then(|| self.row(table, &names));
        let rows = table.rows.iter().map(|row| self.row(table, row));
        groups.into_iter().chain(heads).chain(rows).collect()
    }

    fn groups(&self, table: &Table) -> Option<String> {
        let mut columns = self.widths.iter();
        let cells: Vec<String> = table
            .groups
            .iter()
            .map(|&(name, count)| {
                let width = columns
                    .by_ref()
                    .take(count)
                    .map(|w| w + self.gap)
                    .sum::<usize>();
                format!("{name:width$}")
            })
            .collect();
        (!cells.is_empty()).then(|| self.line(&cells.concat()))
    }

    fn row(&self, table: &Table, row: &[String]) -> String {
        let cells = row.iter().zip(&table.columns).zip(&self.widths);
        let mut line = String::new();
        for ((cell, Column { align, .. }), &width) in cells {
            match align {
                Align::Left => line += cell,
                Align::Right => {}
                Align::Words => return self.words(&line, cell),
            }
            line += &" ".repeat(width.saturating_sub(columns(cell)));
            if *align == Align::Right {
                line += cell;
            }
            line += &" ".repeat(self.gap);
        }
        self.line(&line)
    }

    /// A row whose last cell goes on in the lines below it.
    fn words(&self, before: &str, text: &str) -> String {
        let margin = columns(before);
        let room = WIDTH.saturating_sub(self.indent + margin);
        let mut lines = wrap(text, room).into_iter();
        let first = before.to_owned() + &lines.next().unwrap_or_default();
        let rest = lines.map(|words| " ".repeat(margin) + &words);
        let all = std::iter::once(first).chain(rest);
        all.map(|line| self.line(&line)).collect()
    }

    fn line(&self, line: &str) -> String {
        let line = line.trim_end();
        format!("{:1$}{line}\n", "", self.indent)
    }
}

/// The width of each column: that of its widest cell, and a share of what the name of its group needs.
fn widths(table: &Table, gap: usize) -> Vec<usize> {
    let width = |(i, column): (usize, &Column)| {
        if column.align == Align::Words {
            return 0;
        }
        let cells = table.rows.iter().filter_map(|row| row.get(i));
        let cells = cells.map(|cell| columns(cell)).max().unwrap_or(0);
        cells.max(columns(&column.name))
    };
    let mut widths: Vec<usize> = table.columns.iter().enumerate().map(width).collect();
    let mut first = 0;
    for &(name, count) in &table.groups {
        let Some(group) = widths.get_mut(first..first + count) else {
            break;
        };
        let all = group.iter().sum::<usize>() + gap * count.saturating_sub(1);
        for i in 0..columns(name).saturating_sub(all) {
            group[i % count] += 1;
        }
        first += count;
    }
    widths
}
