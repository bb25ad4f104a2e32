//! Reports: what a run found, as sentences and tables, and a writer for each format.
//!
//! A [`Report`] is for people, and is written as text of 80 columns or as Markdown. Programs get a
//! [`Table`] as CSV, or the data themselves as JSON.

mod csv;
mod json;
mod markdown;
mod text;

pub use json::json;

/// How a run is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// For people, on 80 columns.
    Text,
    /// For programs, a row for each measurement.
    Csv,
    /// For programs, everything.
    Json,
    /// For documents.
    Markdown,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Text, Self::Csv, Self::Json, Self::Markdown];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Csv => "csv",
            Self::Json => "json",
            Self::Markdown => "markdown",
        }
    }
}

/// What people read, from top to bottom.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Report {
    parts: Vec<ReportPart>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum ReportPart {
    Heading(String),
    Lines(Vec<String>),
    Fixed(Vec<String>),
    Items(Vec<String>),
    Table(Table),
    Gap,
}

impl Report {
    /// A report that says nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a heading.
    #[must_use]
    pub fn heading(self, text: impl Into<String>) -> Self {
        self.with(ReportPart::Heading(text.into()))
    }

    /// Adds a sentence.
    #[must_use]
    pub fn words(self, text: impl Into<String>) -> Self {
        self.lines([text])
    }

    /// Adds sentences, each on a line of its own. Their blanks at the left indent the text.
    #[must_use]
    pub fn lines<T: Into<String>>(self, lines: impl IntoIterator<Item = T>) -> Self {
        self.with(ReportPart::Lines(
            lines.into_iter().map(Into::into).collect(),
        ))
    }

    /// Adds lines that Markdown shows as they are, letter by letter.
    #[must_use]
    pub fn fixed(self, lines: Vec<String>) -> Self {
        self.with(ReportPart::Fixed(lines))
    }

    /// Adds a list.
    #[must_use]
    pub fn items(self, items: Vec<String>) -> Self {
        self.with(ReportPart::Items(items))
    }

    /// Adds a table.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.with(ReportPart::Table(table))
    }

    /// Adds an empty line; Markdown has one after each part as it is.
    #[must_use]
    pub fn gap(self) -> Self {
        self.with(ReportPart::Gap)
    }

    /// Adds what another report says.
    #[must_use]
    pub fn then(mut self, other: Self) -> Self {
        self.parts.extend(other.parts);
        self
    }

    fn with(mut self, part: ReportPart) -> Self {
        self.parts.push(part);
        self
    }

    /// The report as text of 80 columns.
    pub fn text(&self) -> String {
        self.parts.iter().map(text::part).collect()
    }

    /// The report as Markdown.
    pub fn markdown(&self) -> String {
        let parts: Vec<String> = self.parts.iter().filter_map(markdown::part).collect();
        parts.join("\n")
    }
}

/// Columns with names, and rows of as many cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<String>>,
    groups: Vec<(&'static str, usize)>,
    indent: usize,
}

/// What programs read of a row: the name of a column, and what it says.
pub type DataColumn<T> = (&'static str, fn(&T) -> String);

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    name: String,
    align: Align,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Align {
    Left,
    Right,
    /// The last column, wrapped where the line ends.
    Words,
}

impl Column {
    /// A column of names.
    pub fn left(name: impl Into<String>) -> Self {
        Self::new(name, Align::Left)
    }

    /// A column of numbers.
    pub fn right(name: impl Into<String>) -> Self {
        Self::new(name, Align::Right)
    }

    /// The last column, if it holds sentences.
    pub fn words(name: impl Into<String>) -> Self {
        Self::new(name, Align::Words)
    }

    fn new(name: impl Into<String>, align: Align) -> Self {
        let name = name.into();
        Self { name, align }
    }
}

impl Table {
    /// A table of these columns.
    pub fn new(
        columns: impl IntoIterator<Item = Column>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        Self {
            columns: columns.into_iter().collect(),
            rows: rows.into_iter().collect(),
            ..Self::default()
        }
    }

    /// A table that programs read: each column is a name and what it says of a row.
    pub fn of<T>(columns: &[DataColumn<T>], rows: impl IntoIterator<Item = T>) -> Self {
        let cells = |row: T| columns.iter().map(|(_, cell)| cell(&row)).collect();
        Self::new(
            columns.iter().map(|&(name, _)| Column::left(name)),
            rows.into_iter().map(cells),
        )
    }

    /// The same table with all its columns at the right.
    #[must_use]
    pub fn numbers(mut self) -> Self {
        for column in &mut self.columns {
            column.align = Align::Right;
        }
        self
    }

    /// In text, names above those of the columns, each over so many of them.
    #[must_use]
    pub fn grouped(mut self, groups: &[(&'static str, usize)]) -> Self {
        self.groups = groups.to_vec();
        self
    }

    /// In text, blanks at the left.
    #[must_use]
    pub fn indented(mut self, indent: usize) -> Self {
        self.indent = indent;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Table {
        let rows = [["textbook", "1.5", "a | b"], ["exact", "12.25", "x,\"y\""]];
        Table::new(
            [
                Column::left("method"),
                Column::right("ns"),
                Column::words("why"),
            ],
            rows.map(|row| row.map(str::to_owned).to_vec()),
        )
    }

    #[test]
    fn a_table_in_each_format() {
        let report = Report::new().heading("times").table(sample());
        assert_eq!(
            report.text(),
            "times\n\
             method       ns  why\n\
             textbook    1.5  a | b\n\
             exact     12.25  x,\"y\"\n"
        );
        assert_eq!(
            report.markdown(),
            "### times\n\n\
             | method | ns | why |\n\
             |---|--:|---|\n\
             | textbook | 1.5 | a \\| b |\n\
             | exact | 12.25 | x,\"y\" |\n"
        );
        assert_eq!(
            sample().csv(),
            "method,ns,why\ntextbook,1.5,a | b\nexact,12.25,\"x,\"\"y\"\"\"\n"
        );
    }

    #[test]
    fn groups_lie_over_their_columns_and_words_are_wrapped() {
        let rows = [vec!["1".into(), "2".into(), "word ".repeat(30)]];
        let columns = [Column::right("a"), Column::right("b"), Column::words("c")];
        let table = Table::new(columns, rows)
            .grouped(&[("both of them", 2)])
            .indented(2);
        let text = Report::new().table(table).text();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("  both of them"));
        assert_eq!(lines.next(), Some("      a      b  c"));
        assert!(text.lines().count() > 4);
        assert!(text.lines().all(|line| line.chars().count() <= 80));
        assert!(
            text.lines()
                .skip(3)
                .all(|line| line.starts_with("                word"))
        );
    }

    #[test]
    fn a_table_that_is_too_wide_for_two_blanks_has_one_between_its_columns() {
        let columns = (0..12).map(|_| Column::right("number"));
        let table = Table::new(columns, [vec!["12345".to_owned(); 12]]);
        let text = Report::new().table(table).text();
        assert!(text.lines().all(|line| line.chars().count() == 12 * 6 + 11));
    }
}
