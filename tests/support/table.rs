//! Tables as text or Markdown.

use std::fmt::Display;

/// A table to print.
#[derive(Clone, Debug)]
pub struct Table {
    title: String,
    lines: Vec<Vec<String>>,
}

/// How tables are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    Text,
    Markdown,
}

impl Table {
    /// A table with the names of its columns.
    pub fn new(title: impl Display, columns: &[&str]) -> Self {
        let names = columns.iter().map(|name| name.to_string()).collect();
        Self { title: title.to_string(), lines: vec![names] }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Vec<String>) {
        self.lines.push(row);
    }

    /// The table, its columns as wide as they must be.
    pub fn render(&self, style: Style) -> String {
        let columns = self.lines.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let cells = self.lines.iter().filter_map(|line| line.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut text = format!("{}\n\n", self.title);
        for (number, line) in self.lines.iter().enumerate() {
            let cells = line.iter().zip(&widths);
            let cells: Vec<String> =
                cells.map(|(cell, width)| format!("{cell:>width$}", width = *width)).collect();
            match style {
                Style::Text => text += &format!("  {}\n", cells.join("  ")),
                Style::Markdown => text += &format!("| {} |\n", cells.join(" | ")),
            }
            if number == 0 && style == Style::Markdown {
                text += &format!("|{}\n", "--:|".repeat(columns));
            }
        }
        text + "\n"
    }
}

/// A number to three digits, or nothing.
pub fn short(x: f64) -> String {
    if x.is_nan() { "-".to_owned() } else { format!("{x:.2e}") }
}

/// A ratio, or nothing.
pub fn ratio(x: f64) -> String {
    match x {
        x if x.is_nan() => "-".to_owned(),
        x if x < 100.0 => format!("{x:.1}"),
        x => format!("{x:.0}"),
    }
}
