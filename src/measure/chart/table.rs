//! The data beside a chart, as CSV (RFC 4180).

use std::fmt::{Display, Write};

use crate::measure::lab::Machine;

/// Rows under a head.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    pub fn new(head: &[&str]) -> Self {
        Self { head: head.iter().map(|&h| h.to_owned()).collect(), rows: Vec::new() }
    }

    /// Adds a row; it has as many cells as the head.
    pub fn push(&mut self, row: &[&dyn Display]) {
        self.push_cells(row.iter().map(|cell| cell.to_string()).collect());
    }

    /// Adds a row of finished cells, as many as the head has.
    pub fn push_cells(&mut self, row: Vec<String>) {
        debug_assert_eq!(row.len(), self.head.len());
        self.rows.push(row);
    }

    /// As text, with what it was measured on in every row, so that tables of several machines can be put together.
    pub fn to_csv(&self, machine: &Machine) -> String {
        let last = [&*machine.cpu, machine.isa, &machine.threads.to_string(), machine.commit].map(str::to_owned);
        let head = self.head.iter().cloned().chain(["cpu", "isa", "threads", "commit"].map(str::to_owned)).collect();
        let rows = self.rows.iter().map(|row| row.iter().chain(&last).cloned().collect::<Vec<_>>());
        let mut text = String::new();
        for row in std::iter::once(head).chain(rows) {
            let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
            // A string takes whatever is written to it.
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.to_owned() }
}

/// A cell: a number, or nothing.
pub fn optional(n: Option<usize>) -> String {
    n.map(|n| n.to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_needed() {
        let mut table = Table::new(&["a", "b"]);
        table.push(&[&1.5, &"x, \"y\""]);
        let machine = Machine { cpu: "C".into(), isa: "i", threads: 2, commit: "c", optimised: true };
        assert_eq!(table.to_csv(&machine), "a,b,cpu,isa,threads,commit\n1.5,\"x, \"\"y\"\"\",C,i,2,c\n");
    }
}
