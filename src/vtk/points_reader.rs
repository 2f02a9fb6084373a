//! The points of all pieces.

use super::array_head::ArrayHead;
use super::array_type::ArrayType;
use super::data_array::DataArray;
use super::error::{ArrayError, VtkError};
use super::joined_array::{Flaw, JoinedArray, OpenArray, PartHead};
use super::piece::Piece;
use super::values::Values;
use super::xml_file::Budget;

const SECTION: &str = "Points";

/// Reads the headers of the points of all pieces.
pub(super) fn open_points<'a>(
    pieces: &[Piece<'a>],
    budget: &mut Budget,
) -> Result<OpenArray<'a>, VtkError> {
    join(pieces)
        .and_then(|points| points.open(budget))
        .map_err(|flaw| flaw.into_error(SECTION, SECTION))
}

/// Decodes the points: `Float32` and `Float64` are kept, integers become `Float64`.
pub(super) fn decode_points(points: OpenArray<'_>) -> Result<DataArray, VtkError> {
    let mut array = points.decode().map_err(|flaw| flaw.into_error(SECTION, SECTION))?;
    if !array.array_type().is_float() {
        array.values = Values::F64(array.to_f64().unwrap_or_default());
    }
    Ok(array)
}

fn join<'a>(pieces: &[Piece<'a>]) -> Result<JoinedArray<'a>, Flaw<'a>> {
    let mut joined = None;
    for piece in pieces.iter().filter(|piece| piece.counts.points > 0) {
        let added = add(&mut joined, piece);
        added.map_err(|problem| Flaw { file: piece.file, problem })?;
    }
    Ok(joined.unwrap_or_else(|| no_points(pieces)))
}

fn add<'a>(joined: &mut Option<JoinedArray<'a>>, piece: &Piece<'a>) -> Result<(), ArrayError> {
    let head = head_of(piece).ok_or(ArrayError::Missing)?;
    let points = match joined {
        None => joined.insert(like(&head)?),
        Some(points) => points,
    };
    check_type(&head, points.array_type)?;
    let tuples = Some(piece.counts.points);
    points.parts.push(PartHead { file: piece.file, head, tuples });
    Ok(())
}

fn head_of<'a>(piece: &Piece<'a>) -> Option<ArrayHead<'a>> {
    ArrayHead::all_in(piece.node.child(SECTION)?).next()
}

fn like<'a>(head: &ArrayHead<'a>) -> Result<JoinedArray<'a>, ArrayError> {
    let points = JoinedArray::like(head)?;
    if matches!(points.array_type, ArrayType::Bit | ArrayType::String) {
        return Err(ArrayError::WrongType { found: points.array_type, expected: "a number" });
    }
    match points.components {
        3 => Ok(points),
        found => Err(ArrayError::Components { found, expected: 3 }),
    }
}

fn check_type(head: &ArrayHead<'_>, expected: ArrayType) -> Result<(), ArrayError> {
    match head.shape.clone()? {
        (found, 3) if found == expected => Ok(()),
        (_, 3) => {
            Err(ArrayError::WrongType { found: head.shape.clone()?.0, expected: expected.name() })
        }
        (_, found) => Err(ArrayError::Components { found, expected: 3 }),
    }
}

/// Without points, the type is that of any piece's head, `Float32` if none has one.
fn no_points<'a>(pieces: &[Piece<'a>]) -> JoinedArray<'a> {
    let heads = pieces.iter().filter_map(head_of);
    let found = heads.filter_map(|head| like(&head).ok()).next();
    found.unwrap_or_else(|| JoinedArray {
        name: SECTION.to_owned(),
        array_type: ArrayType::F32,
        components: 3,
        component_names: Vec::new(),
        parts: Vec::new(),
    })
}
