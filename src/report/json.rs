//! Data as JSON: the same names and values that the data have.

use serde::Serialize;

/// One JSON object on lines of its own, with a line end.
pub fn json(data: &impl Serialize) -> String {
    // Only keys that are no strings can fail, and the fields of a struct are strings.
    serde_json::to_string_pretty(data).unwrap_or_default() + "\n"
}
