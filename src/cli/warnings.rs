//! What people should know, told once however many parts it is true of.

use std::collections::HashMap;

/// Warnings, and the parts of the input that each is about.
#[derive(Default)]
pub struct Warnings {
    /// Each text, the first part it is about, and how many there are.
    texts: Vec<(String, Option<String>, usize)>,
    places: HashMap<String, usize>,
}

impl Warnings {
    /// Remembers a warning. `part`: its name; nothing for the input as a whole.
    pub fn add(&mut self, part: Option<&str>, text: &str) {
        match self.places.get(text).and_then(|&place| self.texts.get_mut(place)) {
            Some((_, _, count)) => *count += 1,
            None => {
                self.places.insert(text.to_owned(), self.texts.len());
                self.texts.push((text.to_owned(), part.map(str::to_owned), 1));
            }
        }
    }

    /// A line each, in the order in which they were met. `parts`: how many there are.
    pub fn lines(&self, parts: usize) -> impl Iterator<Item = String> + '_ {
        self.texts.iter().map(move |(text, part, count)| match part {
            None => text.clone(),
            Some(part) if *count == 1 => format!("{part}: {text}"),
            Some(part) => format!("{count} of {parts} files, first {part}: {text}"),
        })
    }
}
