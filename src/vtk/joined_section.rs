//! The arrays of points, cells or the field over all pieces of a file.

use super::array_head::ArrayHead;
use super::attributes::{AttributeKind, Attributes};
use super::data_array::DataArray;
use super::error::{ArrayError, VtkError, line};
use super::joined_array::{JoinedArray, OpenArray, PartHead};
use super::section::Section;
use super::selection::Choice;
use super::xml_file::Budget;
use rayon::prelude::*;
use std::collections::HashSet;
use std::path::Path;

/// The arrays of one section that every piece with tuples has, alike in all.
pub(super) struct JoinedSection<'a> {
    /// The section's name in a file, such as `PointData`.
    pub(super) label: &'static str,
    pub(super) arrays: Vec<JoinedArray<'a>>,
    /// Roles of arrays that are there.
    pub(super) active: Vec<(AttributeKind, String)>,
    /// Arrays left out, and why.
    pub(super) unusable: Vec<(String, String)>,
    repeated: Vec<String>,
    /// Whether no piece has tuples.
    pub(super) is_empty: bool,
    /// Whether arrays were asked for by name: then none is left out in silence.
    named: bool,
}

impl<'a> JoinedSection<'a> {
    /// Joins the sections of all pieces. Empty pieces have no say, unless all are empty.
    pub(super) fn join(label: &'static str, sections: &[Section<'a>]) -> Self {
        let filled: Vec<_> = sections.iter().filter(|s| s.tuples != Some(0)).collect();
        let model = filled.first().copied().or(sections.first());
        let mut joined = Self {
            label,
            arrays: Vec::new(),
            active: Vec::new(),
            unusable: Vec::new(),
            repeated: sections.first().map_or(Vec::new(), |s| s.repeated.clone()),
            is_empty: filled.is_empty(),
            named: false,
        };
        let Some(model) = model else {
            return joined;
        };
        for head in &model.heads {
            match join_array(head, &filled) {
                Ok(array) => joined.arrays.push(array),
                Err(reason) => joined.unusable.push((head.name.clone(), reason)),
            }
        }
        joined.report_extra(model, &filled);
        joined.active = joined.known_roles(&model.active);
        joined
    }

    /// Reports the arrays that the first piece does not have.
    fn report_extra(&mut self, model: &Section<'a>, filled: &[&Section<'a>]) {
        let mut seen = HashSet::new();
        let heads = filled.iter().skip(1).flat_map(|section| &section.heads);
        for head in heads.filter(|head| model.get(&head.name).is_none()) {
            if seen.insert(&head.name) {
                self.unusable.push((head.name.clone(), NOT_EVERYWHERE.to_owned()));
            }
        }
    }

    fn known_roles(&self, active: &[(AttributeKind, String)]) -> Vec<(AttributeKind, String)> {
        let is_known = |name: &String| self.arrays.iter().any(|array| array.name == *name);
        let known = active.iter().filter(|(_, name)| is_known(name));
        known.cloned().collect()
    }

    /// One line for each array that is not read as the file has it.
    pub(super) fn warnings(&self) -> Vec<String> {
        let label = self.label;
        let left_out = |(name, why): &(String, String)| {
            format!("{label} array '{}' left out: {why}", line(name))
        };
        let repeated = |name: &String| {
            format!("{label} has several arrays '{}': the first is taken", line(name))
        };
        let left_out = self.unusable.iter().map(left_out);
        left_out.chain(self.repeated.iter().map(repeated)).collect()
    }

    /// Keeps the arrays that are chosen.
    ///
    /// # Errors
    /// A name that must be there is missing or cannot be used.
    pub(super) fn select(mut self, path: &Path, choice: Choice<'_>) -> Result<Self, VtkError> {
        if let Choice::Named(names) = choice {
            let is_there = |name: &&String| self.arrays.iter().any(|array| array.name == **name);
            if let Some(name) = names.iter().find(|name| !is_there(name)) {
                return Err(self.missing(path, name));
            }
            self.named = true;
            // Whoever names arrays need not hear about others.
            self.unusable.clear();
        }
        self.arrays.retain(|array| choice.has(&array.name));
        self.active = self.known_roles(&self.active);
        self.unusable.retain(|(name, _)| choice.has(name));
        self.repeated.retain(|name| choice.has(name));
        Ok(self)
    }

    fn missing(&self, path: &Path, name: &str) -> VtkError {
        let (path, name) = (path.to_owned(), name.to_owned());
        match self.unusable.iter().find(|(known, _)| *known == name) {
            Some((_, reason)) => {
                VtkError::UnusableArray { path, section: self.label, name, reason: reason.clone() }
            }
            None => VtkError::MissingArray {
                path,
                section: self.label,
                name,
                available: self.arrays.iter().map(|array| array.name.clone()).collect(),
            },
        }
    }

    /// Reads and checks the headers of all arrays. One of the wrong length is an error if
    /// it was asked for by name, else it is left out, as VTK's reader does.
    pub(super) fn open(mut self, budget: &mut Budget) -> Result<OpenSection<'a>, VtkError> {
        let mut arrays = Vec::with_capacity(self.arrays.len());
        for array in std::mem::take(&mut self.arrays) {
            let name = array.name.clone();
            match array.open(budget) {
                Ok(open) => arrays.push(open),
                Err(flaw) if !self.named && flaw.is_of_length() => {
                    self.unusable.push((name, flaw.problem.to_string()));
                }
                Err(flaw) => return Err(flaw.into_error(self.label, &name)),
            }
        }
        let is_open = |name: &String| arrays.iter().any(|array| array.head.name == *name);
        self.active.retain(|(_, name)| is_open(name));
        Ok(OpenSection {
            label: self.label,
            warnings: self.warnings(),
            arrays,
            active: self.active,
        })
    }
}

const NOT_EVERYWHERE: &str = "not every piece has it";

/// Finds an array in all pieces, or says why it cannot be used.
fn join_array<'a>(
    head: &ArrayHead<'a>,
    filled: &[&Section<'a>],
) -> Result<JoinedArray<'a>, String> {
    let mut array = JoinedArray::like(head).map_err(|problem| problem.to_string())?;
    for section in filled {
        let part = section.get(&head.name).ok_or(NOT_EVERYWHERE)?;
        let shape = part.shape.as_ref().map_err(ArrayError::to_string)?;
        if *shape != (array.array_type, array.components) {
            return Err(String::from("its type or components differ between pieces"));
        }
        let tuples = match section.tuples {
            Some(tuples) => Some(tuples),
            None => part.tuples().map_err(|problem| problem.to_string())?,
        };
        array.parts.push(PartHead { file: section.file, head: part.clone(), tuples });
    }
    Ok(array)
}

/// The arrays of one section, headers checked.
pub(super) struct OpenSection<'a> {
    label: &'static str,
    /// One line for each array that is not read as the file has it.
    pub(super) warnings: Vec<String>,
    arrays: Vec<OpenArray<'a>>,
    active: Vec<(AttributeKind, String)>,
}

impl OpenSection<'_> {
    /// Decodes all arrays, on all threads.
    pub(super) fn decode(self) -> Result<Attributes, VtkError> {
        let label = self.label;
        let decode = |array: OpenArray<'_>| {
            let name = array.head.name.clone();
            array.decode().map_err(|flaw| flaw.into_error(label, &name))
        };
        // Of several bad arrays, the first is reported, whichever thread is faster.
        let results: Vec<Result<DataArray, _>> = self.arrays.into_par_iter().map(decode).collect();
        let arrays = results.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Attributes::from_distinct(arrays, self.active))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::file_bytes::FileBytes;
    use crate::vtk::xml_file::XmlFile;

    /// Joins the point data of pieces given as (tuples, arrays).
    fn join(pieces: &[(usize, &str)], check: impl Fn(JoinedSection<'_>)) {
        let parts = pieces.iter().map(|(_, arrays)| format!("<P Scalars='a'>{arrays}</P>"));
        let parts = parts.collect::<String>();
        let text = format!("<VTKFile type='x'><x>{parts}</x></VTKFile>");
        let file = XmlFile::parse(Path::new("x"), FileBytes::Owned(text.into()), "x").unwrap();
        let nodes = file.data_set().unwrap().children();
        let sections: Vec<_> = nodes
            .zip(pieces)
            .map(|(node, (tuples, _))| Section::read(&file, Some(node), Some(*tuples)))
            .collect();
        check(JoinedSection::join("PointData", &sections));
    }

    const A: &str = "<DataArray Name='a' type='Int8'/>";
    const B: &str = "<DataArray Name='b' type='Float32' NumberOfComponents='3'/>";

    fn names(section: &JoinedSection<'_>) -> Vec<String> {
        section.arrays.iter().map(|array| array.name.clone()).collect()
    }

    #[test]
    fn arrays_of_every_piece_are_joined() {
        let both = format!("{A}{B}");
        let turned = format!("{B}{A}");
        join(&[(2, &both), (3, &turned)], |section| {
            assert_eq!(names(&section), ["a", "b"]);
            assert_eq!(section.arrays[1].parts.len(), 2);
            assert_eq!(section.active.len(), 1);
            assert!(section.warnings().is_empty());
        });
    }

    #[test]
    fn arrays_of_some_pieces_are_reported() {
        let both = format!("{A}{B}");
        let other = "<DataArray Name='b' type='Float64' NumberOfComponents='3'/>";
        let c = format!("{other}<DataArray Name='c' type='Int8'/>");
        join(&[(2, &both), (3, &c)], |section| {
            assert!(names(&section).is_empty());
            assert!(section.active.is_empty());
            let warnings = section.warnings().join("\n");
            assert_eq!(section.warnings().len(), 3, "{warnings}");
            assert!(warnings.contains("'b' left out: its type"));
            assert!(warnings.contains("'c' left out: not every piece"));
        });
    }

    #[test]
    fn empty_pieces_have_no_say() {
        join(&[(0, ""), (2, A), (0, B)], |section| {
            assert_eq!(names(&section), ["a"]);
            assert!(section.warnings().is_empty());
        });
        join(&[(0, A), (0, B)], |section| {
            assert_eq!(names(&section), ["a"]);
            assert!(section.arrays[0].parts.is_empty());
        });
    }
}
