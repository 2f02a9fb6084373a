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

impl PieceCounts {
    /// Points and cells of a piece of an unstructured grid.
    pub(super) fn of_grid(file: &XmlFile, node: Node<'_>) -> Result<Self, VtkError> {
        Ok(Self {
            points: required(file, node, "NumberOfPoints")?,
            cells: required(file, node, "NumberOfCells")?,
            ..Self::default()
        })
    }

    /// Points and the four kinds of cells of a piece of polygonal data.
    pub(super) fn of_poly_data(file: &XmlFile, node: Node<'_>) -> Result<Self, VtkError> {
        let optional = |name| count(file, node, name).map(Option::unwrap_or_default);
        let counts = Self {
            points: required(file, node, "NumberOfPoints")?,
            verts: optional("NumberOfVerts")?,
            lines: optional("NumberOfLines")?,
            polys: optional("NumberOfPolys")?,
            strips: optional("NumberOfStrips")?,
            cells: 0,
        };
        let cells =
            sum(counts.kinds().into_iter()).ok_or_else(|| bad(file, node, "NumberOfPolys"))?;
        Ok(Self { cells, ..counts })
    }

    /// Cells of [`PolyData`](super::PolyData) in the order of cell data: verts, lines, polygons,
    /// strips; zeros in other data sets.
    pub fn kinds(&self) -> [usize; 4] {
        [self.verts, self.lines, self.polys, self.strips]
    }
}

/// How to read what a `<Piece>` says it holds.
pub(super) type ReadCounts = fn(&XmlFile, Node<'_>) -> Result<PieceCounts, VtkError>;

/// One `<Piece>`.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    pub(super) file: &'a XmlFile,
    pub(super) node: Node<'a>,
    pub(super) counts: PieceCounts,
    /// Its place in its file.
    index: usize,
}

impl<'a> Piece<'a> {
    /// All pieces of a data set, one file after the other.
    pub(super) fn all(files: &[&'a XmlFile], read: ReadCounts) -> Result<Vec<Self>, VtkError> {
        let mut pieces = Vec::new();
        for file in files {
            let nodes = file.data_set()?.children().filter(|node| node.name() == "Piece");
            for (index, node) in nodes.enumerate() {
                pieces.push(Self { file, node, counts: read(file, node)?, index });
            }
        }
        // Indices are i64, so no more points or cells than that can be told apart.
        for (part, name) in [
            (pieces.iter().map(|p| p.counts.points).collect(), "NumberOfPoints"),
            (pieces.iter().map(|p| p.counts.cells).collect::<Vec<_>>(), "NumberOfCells"),
        ] {
            let total = sum(part.into_iter()).and_then(|total| i64::try_from(total).ok());
            if let (None, Some(first)) = (total, pieces.first()) {
                return Err(bad(first.file, first.node, name));
            }
        }
        Ok(pieces)
    }

    /// How a message calls a section of the piece.
    pub(super) fn label(&self, section: &str) -> String {
        match self.index {
            0 => section.to_owned(),
            index => format!("{section} in piece {index}"),
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
