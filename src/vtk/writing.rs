//! The parts of a file that all data sets share.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::column::{column, numbers};
use super::data_array::DataArray;
use super::error::{ArrayError, VtkError};
use super::write_options::WriteOptions;
use super::xml_writer::{ArrayTag, XmlWriter};
use std::io::{self, Write};

/// Refuses arrays that have another length than their points or cells.
pub(super) fn check_data(
    points: &DataArray,
    point_data: &Attributes,
    cell_data: &Attributes,
    cells: usize,
) -> Result<(), VtkError> {
    let contradiction =
        |problem| VtkError::Inconsistent { section: "Points", name: points.name.clone(), problem };
    if points.components != 3 {
        return Err(contradiction(ArrayError::Components {
            found: points.components,
            expected: 3,
        }));
    }
    if !points.array_type().is_float() {
        return Err(contradiction(ArrayError::WrongType {
            found: points.array_type(),
            expected: "Float32 or Float64",
        }));
    }
    check_array("Points", points, points.tuples())?;
    let mut point_arrays = point_data.iter();
    point_arrays.try_for_each(|array| check_array("PointData", array, points.tuples()))?;
    let mut cell_arrays = cell_data.iter();
    cell_arrays.try_for_each(|array| check_array("CellData", array, cells))
}

fn check_array(section: &'static str, array: &DataArray, tuples: usize) -> Result<(), VtkError> {
    let found = array.values.len();
    let expected = tuples.saturating_mul(array.components);
    if found == expected && array.components > 0 {
        return Ok(());
    }
    Err(VtkError::Inconsistent {
        section,
        name: array.name.clone(),
        problem: ArrayError::Count { found, expected },
    })
}

/// Writes the field data, if there are any.
pub(super) fn write_field<'a, W: Write>(
    xml: &mut XmlWriter<'a, W>,
    field: &'a Attributes,
    options: WriteOptions,
) -> io::Result<()> {
    if field.is_empty() {
        return Ok(());
    }
    xml.open("FieldData", &[])?;
    for array in field {
        write_array(xml, array, Some(array.tuples()), options)?;
    }
    xml.close("FieldData")
}

/// Writes point or cell data.
pub(super) fn write_attributes<'a, W: Write>(
    xml: &mut XmlWriter<'a, W>,
    section: &str,
    attributes: &'a Attributes,
    options: WriteOptions,
) -> io::Result<()> {
    let active = attributes.active_names().iter();
    let active: Vec<_> = active.map(|(kind, name)| (kind.name(), &name[..])).collect();
    xml.open(section, &active)?;
    for array in attributes {
        write_array(xml, array, None, options)?;
    }
    xml.close(section)
}

fn write_array<'a, W: Write>(
    xml: &mut XmlWriter<'a, W>,
    array: &'a DataArray,
    tuples: Option<usize>,
    options: WriteOptions,
) -> io::Result<()> {
    let tag = ArrayTag {
        name: &array.name,
        components: array.components,
        component_names: &array.component_names,
        tuples,
    };
    xml.array(&tag, column(&array.values, options.floats))
}

/// Writes the points.
pub(super) fn write_points<'a, W: Write>(
    xml: &mut XmlWriter<'a, W>,
    points: &'a DataArray,
    options: WriteOptions,
) -> io::Result<()> {
    xml.open("Points", &[])?;
    write_array(xml, points, None, options)?;
    xml.close("Points")
}

/// Writes lists of indices; VTK's offsets leave out the leading 0.
pub(super) fn write_lists<'a, W: Write>(
    xml: &mut XmlWriter<'a, W>,
    lists: &'a CellArray,
) -> io::Result<()> {
    let ends: Vec<i64> = lists.offsets().skip(1).collect();
    xml.array(&ArrayTag::plain("connectivity"), Box::new(numbers(lists.connectivity())))?;
    xml.array(&ArrayTag::plain("offsets"), Box::new(numbers(ends)))
}
