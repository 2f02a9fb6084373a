//! The faces of polyhedral cells.

use super::cell_array::CellArray;
use super::error::ArrayError;

/// The faces of the polyhedral cells of a grid, as VTK 9.4 and later keep them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polyhedra {
    /// The points of each face.
    pub faces: CellArray,
    /// The faces of each cell of the grid; none for cells that are no polyhedra.
    pub cells: CellArray,
}

impl Polyhedra {
    /// Reads the form of VTK before 9.4: for each polyhedron, in `stream`, the number of
    /// its faces, and for each face the number of its points and these; `ends` says where
    /// in the stream each cell ends, -1 for cells that are no polyhedra.
    ///
    /// # Errors
    /// The stream and the ends contradict each other.
    pub fn push_stream(&mut self, stream: &[i64], ends: &[i64]) -> Result<(), ArrayError> {
        // Counted first: each number of the stream could be a face of its own.
        let cells = ends.iter().filter(|end| **end >= 0).count();
        let (faces, points) = count(stream, cells);
        self.faces.reserve(points);
        self.cells.reserve(faces);
        let mut start = 0;
        for (cell, end) in ends.iter().enumerate() {
            let bad = ArrayError::BadFaces { cell };
            let Ok(end) = usize::try_from(*end) else {
                self.cells.push(&[]);
                continue;
            };
            let faces = stream.get(start..end).ok_or(bad.clone())?;
            self.push_cell(faces).ok_or(bad)?;
            start = end;
        }
        Ok(())
    }

    /// Adds the faces of one polyhedron.
    pub(super) fn push_cell(&mut self, stream: &[i64]) -> Option<()> {
        let (count, mut rest) = stream.split_first()?;
        let count = usize::try_from(*count).ok().filter(|n| *n <= rest.len())?;
        let first = self.faces.len();
        for _ in 0..count {
            let (size, points) = rest.split_first()?;
            let size = usize::try_from(*size).ok()?;
            self.faces.push(points.get(..size)?);
            rest = points.get(size..)?;
        }
        self.cells.push_range(first..self.faces.len());
        rest.is_empty().then_some(())
    }

    /// The form of VTK before 9.4, which every VTK reads: stream and ends as for
    /// [`push_stream`](Self::push_stream).
    pub(super) fn to_stream(&self) -> (Vec<i64>, Vec<i64>) {
        let mut stream = Vec::new();
        let mut ends = Vec::with_capacity(self.cells.len());
        for cell in self.cells.iter() {
            if cell.is_empty() {
                ends.push(-1);
                continue;
            }
            stream.push(cell.len() as i64);
            for face in cell {
                let face = usize::try_from(*face).ok();
                let points = face.and_then(|face| self.faces.get(face)).unwrap_or_default();
                stream.push(points.len() as i64);
                stream.extend_from_slice(points);
            }
            ends.push(stream.len() as i64);
        }
        (stream, ends)
    }
}

/// The faces and their points in a stream of polyhedra, as far as it makes sense.
fn count(stream: &[i64], cells: usize) -> (usize, usize) {
    let mut values = stream.iter();
    let (mut faces, mut points) = (0usize, 0usize);
    for _ in 0..cells {
        let count = values.next().map_or(0, |count| *count);
        for _ in 0..count {
            let Some(size) = values.next().and_then(|size| usize::try_from(*size).ok()) else {
                return (faces, points);
            };
            if size > values.len() {
                return (faces, points);
            }
            faces += 1;
            points += size;
            values = values.as_slice().get(size..).unwrap_or_default().iter();
        }
    }
    (faces, points)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [i64; 17] = [4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2];

    #[test]
    fn streams_come_back() {
        let mut polyhedra = Polyhedra::default();
        let ends = [-1, 17, -1];
        polyhedra.push_stream(&TETRAHEDRON, &ends).unwrap();
        assert_eq!(polyhedra.faces.len(), 4);
        assert_eq!(polyhedra.faces.get(1), Some(&[0i64, 1, 3][..]));
        assert!(polyhedra.cells.offsets().eq([0, 0, 4, 4]));
        assert_eq!(polyhedra.to_stream(), (TETRAHEDRON.to_vec(), ends.to_vec()));
    }

    #[test]
    fn contradictions_are_refused() {
        let refuse = |stream: &[i64], ends: &[i64]| {
            let mut polyhedra = Polyhedra::default();
            polyhedra.push_stream(stream, ends).unwrap_err()
        };
        let bad = |cell| ArrayError::BadFaces { cell };
        assert_eq!(refuse(&TETRAHEDRON, &[18]), bad(0));
        assert_eq!(refuse(&TETRAHEDRON, &[-1, 16]), bad(1));
        assert_eq!(refuse(&TETRAHEDRON, &[0]), bad(0));
        assert_eq!(refuse(&[1, -3], &[2]), bad(0));
        assert_eq!(refuse(&[i64::MAX, 0], &[2]), bad(0));
        assert_eq!(refuse(&[1, 1, 0, 9], &[4]), bad(0));
    }
}
