//! One `<PointData>`, `<CellData>` or `<FieldData>` of one piece.

use super::array_head::ArrayHead;
use super::attributes::AttributeKind;
use super::xml::Node;
use super::xml_file::XmlFile;
use std::collections::HashMap;

/// The arrays of one section of one piece.
pub(super) struct Section<'a> {
    pub(super) file: &'a XmlFile,
    /// In the file's order, names all different.
    pub(super) heads: Vec<ArrayHead<'a>>,
    /// The place of each name in `heads`.
    index: HashMap<String, usize>,
    /// The roles given, whether or not there is such an array.
    pub(super) active: Vec<(AttributeKind, String)>,
    /// Names that came more than once; the first array of a name is kept (VTK repeats a
    /// name once for every time step).
    pub(super) repeated: Vec<String>,
    /// How many tuples every array must have; `None` for field data.
    pub(super) tuples: Option<usize>,
}

impl<'a> Section<'a> {
    /// Reads the section's head; a missing section has no arrays.
    pub(super) fn read(file: &'a XmlFile, node: Option<Node<'a>>, tuples: Option<usize>) -> Self {
        let mut section = Self {
            file,
            heads: Vec::new(),
            index: HashMap::new(),
            active: node.map(active).unwrap_or_default(),
            repeated: Vec::new(),
            tuples,
        };
        for head in node.into_iter().flat_map(ArrayHead::all_in) {
            section.add(head);
        }
        section
    }

    fn add(&mut self, head: ArrayHead<'a>) {
        if self.index.contains_key(&head.name) {
            self.repeated.push(head.name);
            return;
        }
        self.index.insert(head.name.clone(), self.heads.len());
        self.heads.push(head);
    }

    /// The array of that name.
    pub(super) fn get(&self, name: &str) -> Option<&ArrayHead<'a>> {
        self.heads.get(*self.index.get(name)?)
    }
}

fn active(node: Node<'_>) -> Vec<(AttributeKind, String)> {
    let role = |kind: &AttributeKind| {
        let name = node.attribute(kind.name())?;
        Some((*kind, name.into_owned()))
    };
    let kinds = AttributeKind::NAMES.iter().map(|(kind, _)| kind);
    kinds.filter_map(role).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::file_bytes::FileBytes;
    use std::path::Path;

    #[test]
    fn arrays_roles_and_repeated_names() {
        let text = "<VTKFile type='PointData'><PointData Vectors='v' Scalars='gone'>\
            <DataArray Name='v' type='Int8'/><Array Name='s' type='String'/><Other/>\
            <DataArray Name='v' type='Int16' TimeStep='1'/></PointData></VTKFile>";
        let bytes = FileBytes::Owned(text.as_bytes().to_vec());
        let file = XmlFile::parse(Path::new("x"), bytes, "PointData").unwrap();
        let section = Section::read(&file, Some(file.data_set().unwrap()), Some(3));
        let names: Vec<_> = section.heads.iter().map(|head| &head.name).collect();
        assert_eq!(names, ["v", "s"]);
        assert_eq!(section.repeated, ["v"]);
        assert_eq!(
            section.active,
            [(AttributeKind::Scalars, "gone".to_owned()), (AttributeKind::Vectors, "v".to_owned())]
        );
        assert!(section.get("s").is_some() && section.get("gone").is_none());
    }
}
