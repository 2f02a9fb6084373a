//! What a file holds, known without decoding anything.

use super::array_type::ArrayType;
use super::attributes::AttributeKind;
use super::joined_array::JoinedArray;
use super::joined_section::JoinedSection;
use super::piece::PieceCounts;
use super::pieces::Pieces;
use super::section::Section;
use super::unstructured_grid::UnstructuredGrid;

/// What a file holds, known from its head alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The version of the format, such as `1.0`; empty where the file does not say.
    pub version: String,
    /// How much is in each piece.
    pub pieces: Vec<PieceCounts>,
    /// Point arrays that can be read.
    pub point_arrays: Vec<ArrayInfo>,
    /// Cell arrays that can be read.
    pub cell_arrays: Vec<ArrayInfo>,
    /// Field arrays that can be read.
    pub field_arrays: Vec<ArrayInfo>,
    /// One line for each array that is left out, and why.
    pub warnings: Vec<String>,
}

impl Description {
    /// The number of points of all pieces.
    pub fn points(&self) -> usize {
        self.pieces.iter().map(|piece| piece.points).sum()
    }

    /// Gives the arrays of a piece the roles that they have in the whole.
    pub fn give_roles(&self, piece: &mut UnstructuredGrid) {
        let sections = [
            (&self.point_arrays, &mut piece.point_data),
            (&self.cell_arrays, &mut piece.cell_data),
        ];
        for (arrays, data) in sections {
            data.clear_roles();
            for array in arrays {
                array.active.iter().for_each(|&role| {
                    data.set_active(role, &array.name);
                });
            }
        }
    }

    /// The number of cells of all pieces.
    pub fn cells(&self) -> usize {
        self.pieces.iter().map(|piece| piece.cells).sum()
    }
}

/// What the head says about an array.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrayInfo {
    /// The name.
    pub name: String,
    /// The type of its values in the file.
    pub array_type: ArrayType,
    /// Values per tuple.
    pub components: usize,
    /// Names of the components, as in [`DataArray`](super::DataArray).
    pub component_names: Vec<String>,
    /// The roles the array is active in.
    pub active: Vec<AttributeKind>,
}

/// The three sections of arrays, joined over all pieces.
pub(super) struct Sections<'a> {
    pub(super) points: JoinedSection<'a>,
    pub(super) cells: JoinedSection<'a>,
    pub(super) field: JoinedSection<'a>,
}

impl<'a> Sections<'a> {
    /// Joins the heads of all arrays of a data set.
    pub(super) fn join(pieces: &Pieces<'a>) -> Self {
        let read = |label, count: fn(&PieceCounts) -> usize| {
            let sections = pieces.list.iter().map(|piece| {
                let tuples = Some(count(&piece.counts));
                Section::read(piece.file, piece.node.child(label), tuples)
            });
            JoinedSection::join(label, &sections.collect::<Vec<_>>())
        };
        let field = pieces.field.map(|(file, node)| Section::read(file, Some(node), None));
        Self {
            points: read("PointData", |counts| counts.points),
            cells: read("CellData", |counts| counts.cells),
            field: JoinedSection::join("FieldData", &Vec::from_iter(field)),
        }
    }

    /// One line for each array that is not read as the file has it.
    pub(super) fn warnings(&self) -> Vec<String> {
        let sections = [&self.points, &self.cells, &self.field];
        sections.iter().flat_map(|section| section.warnings()).collect()
    }

    /// Describes the arrays of a file with these pieces.
    pub(super) fn describe(&self, version: &str, pieces: &Pieces<'_>) -> Description {
        Description {
            version: version.to_owned(),
            pieces: pieces.list.iter().map(|piece| piece.counts).collect(),
            point_arrays: describe(&self.points),
            cell_arrays: describe(&self.cells),
            field_arrays: describe(&self.field),
            warnings: self.warnings(),
        }
    }
}

fn describe(section: &JoinedSection<'_>) -> Vec<ArrayInfo> {
    let info = |array: &JoinedArray<'_>| {
        let active = section.active.iter().filter(|(_, name)| *name == array.name);
        ArrayInfo {
            name: array.name.clone(),
            array_type: array.array_type,
            components: array.components,
            component_names: array.component_names.clone(),
            active: active.map(|(kind, _)| *kind).collect(),
        }
    };
    section.arrays.iter().map(info).collect()
}
