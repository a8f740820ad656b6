//! Names from files, made fit to be printed.

/// The text with `?` for control characters, which could move a terminal's cursor or break a chart.
pub fn plain(text: &str) -> String {
    text.replace(char::is_control, "?")
}
