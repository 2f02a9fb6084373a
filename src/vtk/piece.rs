//! The pieces of a file and how much is in each.

use super::error::VtkError;
use super::xml::Node;
use super::xml_file::XmlFile;

/// How much is in one piece of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PieceCounts {
    /// Points.
    pub points: usize,
    /// Cells of all kinds.
    pub cells: usize,
    /// Cells of [`PolyData`](super::PolyData) that are points; 0 in other data sets.
    pub verts: usize,
    /// Cells of [`PolyData`](super::PolyData) that are lines; 0 in other data sets.
    pub lines: usize,
    /// Cells of [`PolyData`](super::PolyData) that are polygons; 0 in other data sets.
    pub polys: usize,
    /// Cells of [`PolyData`](super::PolyData) that are strips; 0 in other data sets.
    pub strips: usize,
}

/// One `<Piece>`.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    pub(super) node: Node<'a>,
    pub(super) counts: PieceCounts,
}

impl<'a> Piece<'a> {
    /// Points and cells of a piece of an unstructured grid.
    pub(super) fn of_grid(file: &XmlFile, node: Node<'a>) -> Result<Self, VtkError> {
        let counts = PieceCounts {
            points: required(file, node, "NumberOfPoints")?,
            cells: required(file, node, "NumberOfCells")?,
            ..PieceCounts::default()
        };
        Ok(Self { node, counts })
    }

    /// Points and the four kinds of cells of a piece of polygonal data.
    pub(super) fn of_poly_data(file: &XmlFile, node: Node<'a>) -> Result<Self, VtkError> {
        let optional = |name| count(file, node, name).map(Option::unwrap_or_default);
        let counts = PieceCounts {
            points: required(file, node, "NumberOfPoints")?,
            verts: optional("NumberOfVerts")?,
            lines: optional("NumberOfLines")?,
            polys: optional("NumberOfPolys")?,
            strips: optional("NumberOfStrips")?,
            cells: 0,
        };
        let kinds = [counts.verts, counts.lines, counts.polys, counts.strips];
        let cells = sum(kinds.into_iter()).ok_or_else(|| bad(file, node, "NumberOfPolys"))?;
        let counts = PieceCounts { cells, ..counts };
        Ok(Self { node, counts })
    }

    /// All pieces of a data set.
    pub(super) fn all(
        file: &'a XmlFile,
        read: fn(&XmlFile, Node<'a>) -> Result<Self, VtkError>,
    ) -> Result<Vec<Self>, VtkError> {
        let pieces = file.data_set()?.children();
        let pieces = pieces.filter(|node| node.name() == "Piece");
        let pieces: Vec<Self> = pieces.map(|node| read(file, node)).collect::<Result<_, _>>()?;
        // Indices are i64, so no more points or cells than that can be told apart.
        for (part, name) in [
            (pieces.iter().map(|p| p.counts.points).collect(), "NumberOfPoints"),
            (pieces.iter().map(|p| p.counts.cells).collect::<Vec<_>>(), "NumberOfCells"),
        ] {
            let total = sum(part.into_iter()).and_then(|total| i64::try_from(total).ok());
            if let (None, Some(first)) = (total, pieces.first()) {
                return Err(bad(file, first.node, name));
            }
        }
        Ok(pieces)
    }

    /// How a message calls piece `index`.
    pub(super) fn label(section: &str, index: usize) -> String {
        match index {
            0 => section.to_owned(),
            _ => format!("{section} in piece {index}"),
        }
    }
}

fn sum(mut counts: impl Iterator<Item = usize>) -> Option<usize> {
    counts.try_fold(0usize, usize::checked_add)
}

fn required(file: &XmlFile, node: Node<'_>, name: &'static str) -> Result<usize, VtkError> {
    count(file, node, name)?.ok_or_else(|| bad(file, node, name))
}

fn count(file: &XmlFile, node: Node<'_>, name: &'static str) -> Result<Option<usize>, VtkError> {
    match node.attribute(name) {
        None => Ok(None),
        Some(value) => match value.trim().parse() {
            Ok(count) => Ok(Some(count)),
            Err(_) => Err(bad(file, node, name)),
        },
    }
}

fn bad(file: &XmlFile, node: Node<'_>, attribute: &'static str) -> VtkError {
    VtkError::Attribute {
        path: file.path().to_owned(),
        element: node.name().to_owned(),
        attribute,
        value: node.attribute(attribute).unwrap_or_default().into_owned(),
        expected: "a count",
    }
}
