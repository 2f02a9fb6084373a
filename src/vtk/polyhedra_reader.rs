//! The faces of polyhedral cells of all pieces, in either form.

use super::array_head::ArrayHead;
use super::cell_array::first_outside;
use super::cell_reader::{Integers, ListNames, ListSource, read_lists};
use super::error::{ArrayError, VtkError};
use super::piece::Piece;
use super::polyhedra::Polyhedra;
use super::xml_file::Budget;

/// VTK 9.4 and later: the points of every face, and the faces of every cell.
const FACES: ListNames = ListNames { connectivity: "face_connectivity", offsets: "face_offsets" };
const CELL_FACES: ListNames =
    ListNames { connectivity: "polyhedron_to_faces", offsets: "polyhedron_offsets" };

/// Reads the faces of all pieces; `None` where no piece has any.
pub(super) fn read_polyhedra(
    pieces: &[Piece<'_>],
    budget: &mut Budget,
) -> Result<Option<Polyhedra>, VtkError> {
    if !pieces.iter().any(|piece| has_faces(piece)) {
        return Ok(None);
    }
    let mut all = Polyhedra::default();
    let mut points = 0;
    for piece in pieces {
        let label = piece.label("Cells");
        let faces = if has(piece, "faceoffsets") {
            read_stream(piece, &label, budget)?
        } else if has(piece, FACES.offsets) {
            read_face_lists(piece, &label, budget)?
        } else {
            without_faces(piece.counts.cells)
        };
        append(&mut all, faces, points);
        points += piece.counts.points;
    }
    Ok(Some(all))
}

fn has(piece: &Piece<'_>, name: &str) -> bool {
    let section = piece.node.child("Cells");
    let mut heads = section.into_iter().flat_map(ArrayHead::all_in);
    heads.any(|head| head.name == name)
}

fn has_faces(piece: &Piece<'_>) -> bool {
    piece.counts.cells > 0 && (has(piece, "faceoffsets") || has(piece, FACES.offsets))
}

fn without_faces(cells: usize) -> Polyhedra {
    let mut polyhedra = Polyhedra::default();
    (0..cells).for_each(|_| polyhedra.cells.push(&[]));
    polyhedra
}

/// Reads the form of VTK before 9.4.
fn read_stream(piece: &Piece<'_>, label: &str, budget: &mut Budget) -> Result<Polyhedra, VtkError> {
    let file = piece.file;
    let mut read = |name: &str, count| {
        let open = Integers::open(file, piece.node.child("Cells"), name, count, budget);
        let values = open.and_then(|integers| {
            let mut values = vec![0i64; integers.count()];
            integers.decode(&mut values).map(|()| values)
        });
        values.map_err(|problem| file.array_error(label, name, problem))
    };
    let ends = read("faceoffsets", Some(piece.counts.cells))?;
    let stream = read("faces", None)?;
    let mut polyhedra = Polyhedra::default();
    polyhedra
        .push_stream(&stream, &ends)
        .and_then(|()| check_points(&polyhedra, piece.counts.points))
        .map_err(|problem| file.array_error(label, "faces", problem))?;
    Ok(polyhedra)
}

fn check_points(polyhedra: &Polyhedra, count: usize) -> Result<(), ArrayError> {
    let points = polyhedra.faces.connectivity();
    match first_outside(points, count) {
        None => Ok(()),
        Some(at) => {
            Err(ArrayError::OutOfRange { at, index: points.get(at).copied().unwrap_or(0), count })
        }
    }
}

/// Reads the form of VTK 9.4 and later.
fn read_face_lists(
    piece: &Piece<'_>,
    label: &str,
    budget: &mut Budget,
) -> Result<Polyhedra, VtkError> {
    let source = |count, bound| ListSource {
        file: piece.file,
        section: piece.node.child("Cells"),
        label: label.to_owned(),
        count,
        bound,
    };
    let faces = read_lists(FACES, &[source(None, piece.counts.points)], budget)?;
    let source = source(Some(piece.counts.cells), faces.len());
    let cells = read_lists(CELL_FACES, &[source], budget)?;
    Ok(Polyhedra { faces, cells })
}

/// Appends the faces of one piece, whose points come after `points` others.
fn append(all: &mut Polyhedra, piece: Polyhedra, points: usize) {
    if points == 0 && all.cells.is_empty() {
        *all = piece;
        return;
    }
    let faces = all.faces.len();
    all.faces.append_moved(&piece.faces, points);
    all.cells.append_moved(&piece.cells, faces);
}
