//! One reading of a file: the steps that all data sets share.

use super::attributes::Attributes;
use super::data_array::DataArray;
use super::description::Sections;
use super::error::VtkError;
use super::joined_array::OpenArray;
use super::joined_section::OpenSection;
use super::pieces::Pieces;
use super::points_reader::{decode_points, open_points};
use super::selection::Selection;
use super::xml_file::Budget;

/// Data read from a file, and what was not read as the file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<T> {
    /// The data.
    pub data: T,
    /// One line for each array that was left out, and why. Empty where arrays were
    /// selected by name: an array that was asked for and cannot be read is an error.
    pub warnings: Vec<String>,
}

impl<T> Loaded<T> {
    /// The data as something else.
    pub(super) fn map<U>(self, change: impl FnOnce(T) -> U) -> Loaded<U> {
        Loaded { data: change(self.data), warnings: self.warnings }
    }
}

/// Points and arrays whose headers have been checked, still encoded.
pub(super) struct Reading<'a> {
    points: OpenArray<'a>,
    point_data: OpenSection<'a>,
    cell_data: OpenSection<'a>,
    field_data: OpenSection<'a>,
    pub(super) warnings: Vec<String>,
}

/// Points and arrays, decoded.
pub(super) struct Decoded {
    pub(super) points: DataArray,
    pub(super) point_data: Attributes,
    pub(super) cell_data: Attributes,
    pub(super) field_data: Attributes,
}

impl<'a> Reading<'a> {
    /// Reads the headers of the points and of the selected arrays. Every promise of a
    /// size is checked here, before anything is decoded.
    pub(super) fn open(
        pieces: &Pieces<'a>,
        selection: &Selection,
        budget: &mut Budget,
    ) -> Result<Self, VtkError> {
        let sections = Sections::join(pieces);
        let points = open_points(&pieces.list, budget)?;
        let point_data = sections.points.select(pieces.path, selection.points())?;
        let cell_data = sections.cells.select(pieces.path, selection.cells())?;
        let point_data = point_data.open(budget)?;
        let cell_data = cell_data.open(budget)?;
        let field_data = sections.field.open(budget)?;
        let warnings = [&point_data, &cell_data, &field_data].map(|s| s.warnings.clone());
        Ok(Self { points, point_data, cell_data, field_data, warnings: warnings.concat() })
    }

    /// Decodes everything that was opened.
    pub(super) fn decode(self) -> Result<Decoded, VtkError> {
        Ok(Decoded {
            points: decode_points(self.points)?,
            point_data: self.point_data.decode()?,
            cell_data: self.cell_data.decode()?,
            field_data: self.field_data.decode()?,
        })
    }
}
