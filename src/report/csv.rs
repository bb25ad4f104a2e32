//! A table as CSV.

use super::Table;

impl Table {
    /// A line of names and a line for each row, with their line ends.
    pub fn csv(&self) -> String {
        let mut writer = ::csv::Writer::from_writer(Vec::new());
        let names = self.columns.iter().map(|column| column.name.as_bytes());
        // Neither writing to memory can fail, nor a row of as many cells as there are columns.
        let _ = writer.write_record(names);
        for row in &self.rows {
            let _ = writer.write_record(row);
        }
        let bytes = writer.into_inner().unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}
