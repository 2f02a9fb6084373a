//! The arrays of points, cells or the field, and which of them are active.

use super::data_array::DataArray;
use std::collections::HashMap;
use std::ops::Range;

/// The roles an array of points or cells can be given in VTK.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // each is VTK's own word for the role
pub enum AttributeKind {
    Scalars,
    Vectors,
    Normals,
    TCoords,
    Tensors,
    GlobalIds,
    PedigreeIds,
    EdgeFlag,
    Tangents,
    RationalWeights,
    HigherOrderDegrees,
    ProcessIds,
}

impl AttributeKind {
    /// Every role with its name in a file, in VTK's order.
    pub(super) const NAMES: [(Self, &'static str); 12] = [
        (Self::Scalars, "Scalars"),
        (Self::Vectors, "Vectors"),
        (Self::Normals, "Normals"),
        (Self::TCoords, "TCoords"),
        (Self::Tensors, "Tensors"),
        (Self::GlobalIds, "GlobalIds"),
        (Self::PedigreeIds, "PedigreeIds"),
        (Self::EdgeFlag, "EdgeFlag"),
        (Self::Tangents, "Tangents"),
        (Self::RationalWeights, "RationalWeights"),
        (Self::HigherOrderDegrees, "HigherOrderDegrees"),
        (Self::ProcessIds, "ProcessIds"),
    ];

    /// The role of that name in a file, such as `Scalars`.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(kind, _)| *kind)
    }

    /// The name in a file, such as `Scalars`.
    pub fn name(self) -> &'static str {
        let found = Self::NAMES.iter().find(|(kind, _)| *kind == self);
        found.map_or("", |(_, name)| name)
    }
}

/// An ordered set of arrays, and the names of the active ones.
///
/// Used for point data, cell data and (without active ones) field data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    arrays: Vec<DataArray>,
    active: Vec<(AttributeKind, String)>,
}

impl Attributes {
    /// A set without arrays.
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends an array; one of the same name is replaced where it stands.
    pub fn push(&mut self, array: DataArray) {
        match self.arrays.iter_mut().find(|old| old.name == array.name) {
            Some(old) => *old = array,
            None => self.arrays.push(array),
        }
    }

    /// The same without the arrays of these names.
    pub fn without(&self, names: &[&str]) -> Self {
        let kept = self.arrays.iter().filter(|array| !names.contains(&array.name.as_str()));
        let mut kept: Self = kept.cloned().collect();
        for (kind, name) in self.active_names() {
            kept.set_active(*kind, name);
        }
        kept
    }

    /// The array of that name.
    pub fn get(&self, name: &str) -> Option<&DataArray> {
        self.arrays.iter().find(|array| array.name == name)
    }

    /// The arrays in order.
    pub fn iter(&self) -> std::slice::Iter<'_, DataArray> {
        self.arrays.iter()
    }

    /// The number of arrays.
    pub fn len(&self) -> usize {
        self.arrays.len()
    }

    /// Whether there are no arrays.
    pub fn is_empty(&self) -> bool {
        self.arrays.is_empty()
    }

    /// Gives the array of that name a role (an array may have several, a role one array).
    /// Returns whether there is such an array; nothing changes where there is not.
    pub fn set_active(&mut self, kind: AttributeKind, name: &str) -> bool {
        if self.get(name).is_none() {
            return false;
        }
        self.active.retain(|(old, _)| *old != kind);
        self.active.push((kind, name.to_owned()));
        true
    }

    /// The array with that role.
    pub fn active(&self, kind: AttributeKind) -> Option<&DataArray> {
        let (_, name) = self.active.iter().find(|(active, _)| *active == kind)?;
        self.get(name)
    }

    /// The roles given, with the array's name, in the order they were given.
    pub fn active_names(&self) -> &[(AttributeKind, String)] {
        &self.active
    }

    /// A set of arrays whose names are known to differ.
    pub(super) fn from_distinct(
        arrays: Vec<DataArray>,
        active: Vec<(AttributeKind, String)>,
    ) -> Self {
        Self { arrays, active }
    }

    /// The arrays of several sets joined, one set after the other: those that all sets have, of the
    /// same type and components, in the order and with the roles of the first. Besides the names
    /// of the others.
    pub(super) fn joined(sets: Vec<Self>) -> (Self, Vec<String>) {
        let mut left_out: Vec<String> = Vec::new();
        let mut sets = sets.into_iter();
        let first = sets.next().unwrap_or_default();
        let by_name = |set: Self| set.arrays.into_iter().map(|array| (array.name.clone(), array));
        let mut others: Vec<HashMap<String, DataArray>> =
            sets.map(|set| by_name(set).collect()).collect();
        let mut arrays = Vec::with_capacity(first.arrays.len());
        for mut array in first.arrays {
            // an array at a time, so that little is in memory twice
            let more = others.iter_mut().map(|set| set.remove(&array.name));
            let mut more = more.collect::<Vec<_>>().into_iter();
            if more.all(|more| append_to(&mut array, more)) {
                arrays.push(array);
            } else {
                left_out.push(array.name);
            }
        }
        left_out.extend(others.into_iter().flat_map(HashMap::into_keys));
        left_out.sort_unstable();
        left_out.dedup();
        let mut active = first.active;
        active.retain(|(_, name)| !left_out.contains(name));
        (Self { arrays, active }, left_out)
    }

    /// Brings the tuples of all arrays into another order: that of the ranges, one after the other.
    pub(super) fn reorder(&mut self, order: &[Range<usize>]) {
        if order.windows(2).all(|pair| pair[0].end == pair[1].start) {
            return;
        }
        for array in &mut self.arrays {
            let components = array.components;
            let values = |tuples: &Range<usize>| tuples.start * components..tuples.end * components;
            let ranges: Vec<_> = order.iter().map(values).collect();
            array.values = array.values.gather(&ranges);
        }
    }

    /// Takes all roles from the arrays.
    pub(super) fn clear_roles(&mut self) {
        self.active.clear();
    }
}

/// Appends an array, if it is there and of the same shape; says whether.
fn append_to(array: &mut DataArray, more: Option<DataArray>) -> bool {
    let more = more.filter(|more| more.components == array.components);
    more.is_some_and(|more| array.values.append(more.values))
}

impl<'a> IntoIterator for &'a Attributes {
    type Item = &'a DataArray;
    type IntoIter = std::slice::Iter<'a, DataArray>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl FromIterator<DataArray> for Attributes {
    fn from_iter<I: IntoIterator<Item = DataArray>>(arrays: I) -> Self {
        let mut set = Self::new();
        arrays.into_iter().for_each(|array| set.push(array));
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set() -> Attributes {
        let arrays = ["a", "b"].map(|name| DataArray::new(name, 1, vec![1.0f64]));
        arrays.into_iter().collect()
    }

    #[test]
    fn order_is_kept_and_names_are_unique() {
        let mut set = set();
        set.push(DataArray::new("a", 1, vec![7i8]));
        let names: Vec<_> = set.iter().map(|array| array.name.as_str()).collect();
        assert_eq!(names, ["a", "b"]);
        assert_eq!(set.get("a").unwrap().values, vec![7i8].into());
    }

    #[test]
    fn arrays_that_are_alike_are_joined() {
        let array =
            |name, components, values: &[f64]| DataArray::new(name, components, values.to_vec());
        let mut set: Attributes = [
            array("a", 1, &[1.0, 2.0]),
            array("shape", 2, &[0.0; 4]),
            array("only here", 1, &[0.0; 2]),
            DataArray::new("type", 1, vec![1i8, 2]),
        ]
        .into_iter()
        .collect();
        set.set_active(AttributeKind::Vectors, "shape");
        set.set_active(AttributeKind::Scalars, "a");
        let more = ["type", "only there", "shape", "a"].map(|name| array(name, 1, &[3.0]));
        let more: Attributes = more.into_iter().collect();
        let (joined, left_out) = Attributes::joined(vec![set, more.clone(), more]);
        assert_eq!(left_out, ["only here", "only there", "shape", "type"]);
        let mut expected: Attributes = [array("a", 1, &[1.0, 2.0, 3.0, 3.0])].into_iter().collect();
        expected.set_active(AttributeKind::Scalars, "a");
        assert_eq!(joined, expected);
    }

    #[test]
    fn a_role_belongs_to_one_existing_array() {
        let mut set = set();
        assert!(set.set_active(AttributeKind::Scalars, "a"));
        assert!(set.set_active(AttributeKind::Scalars, "b"));
        assert!(!set.set_active(AttributeKind::Vectors, "c"));
        assert_eq!(set.active(AttributeKind::Scalars).unwrap().name, "b");
        assert_eq!(set.active_names().len(), 1);
    }
}
