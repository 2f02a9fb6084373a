//! The arrays of points, cells or the field in a legacy file.

use super::attributes::{AttributeKind, Attributes};
use super::description::ArrayInfo;
use super::error::{VtkError, line};
use super::legacy_array::LegacyArray;
use super::selection::Choice;
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::Path;

/// The arrays of points, cells or the field.
#[derive(Clone, Debug)]
pub(super) struct LegacySection {
    /// What messages call it, such as `PointData`.
    label: &'static str,
    /// How many tuples the file says the arrays have.
    pub(super) tuples: Option<usize>,
    arrays: Vec<LegacyArray>,
    /// The place of each name in `arrays`.
    places: HashMap<String, usize>,
    active: Vec<(AttributeKind, String)>,
    /// Arrays left out, and why.
    unusable: Vec<(String, String)>,
    repeated: Vec<String>,
}

impl LegacySection {
    /// A section without arrays.
    pub(super) fn new(label: &'static str) -> Self {
        Self {
            label,
            tuples: None,
            arrays: Vec::new(),
            places: HashMap::new(),
            active: Vec::new(),
            unusable: Vec::new(),
            repeated: Vec::new(),
        }
    }

    /// Adds an array; as in VTK, one of the same name takes the place of an earlier one,
    /// and the first array of a role keeps it.
    pub(super) fn push(&mut self, array: LegacyArray, role: Option<AttributeKind>) {
        if let Some(role) = role.filter(|role| !self.active.iter().any(|(old, _)| old == role)) {
            self.active.push((role, array.name.clone()));
        }
        match self.places.get(&array.name).and_then(|place| self.arrays.get_mut(*place)) {
            Some(old) => {
                self.repeated.push(array.name.clone());
                *old = array;
            }
            None => {
                self.places.insert(array.name.clone(), self.arrays.len());
                self.arrays.push(array);
            }
        }
    }

    /// Leaves out the arrays that have another number of tuples.
    pub(super) fn finish(&mut self, tuples: usize) {
        for array in self.arrays.extract_if(.., |array| array.tuples != tuples) {
            let reason = format!("{} tuples where {tuples} are expected", array.tuples);
            self.unusable.push((array.name, reason));
        }
        let is_there = |name: &String| self.arrays.iter().any(|array| array.name == *name);
        self.active.retain(|(_, name)| is_there(name));
    }

    /// One line for each array that is not read as the file has it.
    pub(super) fn warnings(&self) -> Vec<String> {
        let label = self.label;
        let left_out = |(name, why): &(String, String)| {
            format!("{label} array '{}' left out: {why}", line(name))
        };
        let repeated = |name: &String| {
            format!("{label} has several arrays '{}': the last is taken", line(name))
        };
        let left_out = self.unusable.iter().map(left_out);
        left_out.chain(self.repeated.iter().map(repeated)).collect()
    }

    /// Describes the arrays.
    pub(super) fn describe(&self) -> Vec<ArrayInfo> {
        let info = |array: &LegacyArray| {
            let active = self.active.iter().filter(|(_, name)| *name == array.name);
            ArrayInfo {
                name: array.name.clone(),
                array_type: array.array_type(),
                components: array.components,
                component_names: array.component_names.clone(),
                active: active.map(|(kind, _)| *kind).collect(),
            }
        };
        self.arrays.iter().map(info).collect()
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
            // Whoever names arrays need not hear about others.
            self.unusable.clear();
        }
        self.arrays.retain(|array| choice.has(&array.name));
        self.active.retain(|(_, name)| choice.has(name));
        self.unusable.retain(|(name, _)| choice.has(name));
        self.repeated.retain(|name| choice.has(name));
        Ok(self)
    }

    fn missing(&self, path: &Path, name: &str) -> VtkError {
        let (path, section, name) = (path.to_owned(), self.label, name.to_owned());
        match self.unusable.iter().find(|(known, _)| *known == name) {
            Some((_, reason)) => {
                VtkError::UnusableArray { path, section, name, reason: reason.clone() }
            }
            None => {
                let available = self.arrays.iter().map(|array| array.name.clone()).collect();
                VtkError::MissingArray { path, section, name, available }
            }
        }
    }

    /// Decodes all arrays, on all threads.
    pub(super) fn decode(&self, path: &Path, bytes: &[u8]) -> Result<Attributes, VtkError> {
        let decode = |array: &LegacyArray| {
            array.decode(bytes).map_err(|problem| VtkError::Array {
                path: path.to_owned(),
                section: self.label.to_owned(),
                name: array.name.clone(),
                problem,
            })
        };
        // Of several bad arrays, the first is reported, whichever thread is faster.
        let results: Vec<Result<_, _>> = self.arrays.par_iter().map(decode).collect();
        let arrays = results.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Attributes::from_distinct(arrays, self.active.clone()))
    }
}
