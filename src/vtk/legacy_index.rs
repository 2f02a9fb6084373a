//! What is in a legacy file, and where: found in one pass, nothing decoded.

use super::attributes::AttributeKind;
use super::error::LegacyProblem;
use super::legacy_array::{COLOUR, LegacyArray, LegacyCoding};
use super::legacy_cells::LegacyCells;
use super::legacy_scanner::{LegacyFlaw, Scanner};
use super::legacy_section::LegacySection;

/// More arrays than any sensible file has; a guard against forged ones.
const MAX_ARRAYS: usize = 1 << 16;

/// The data sets that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LegacyKind {
    Grid,
    PolyData,
}

impl LegacyKind {
    /// The keywords of its cells, in VTK's order.
    fn cell_words(self) -> &'static [&'static str] {
        match self {
            Self::Grid => &["cells"],
            Self::PolyData => &["vertices", "lines", "polygons", "triangle_strips"],
        }
    }
}

/// What is in a legacy file, and where.
#[derive(Debug)]
pub(super) struct LegacyIndex {
    pub(super) version: String,
    pub(super) kind: LegacyKind,
    pub(super) points: Option<LegacyArray>,
    /// By kind of cell, in VTK's order: one for a grid, four for polygonal data.
    pub(super) cells: Vec<Option<LegacyCells>>,
    pub(super) types: Option<LegacyArray>,
    pub(super) point_data: LegacySection,
    pub(super) cell_data: LegacySection,
    pub(super) field_data: LegacySection,
    /// What is not read as the file has it, besides arrays.
    pub(super) warnings: Vec<String>,
}

impl LegacyIndex {
    /// Finds everything in the file.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, LegacyFlaw> {
        let mut scanner = Scanner::new(bytes);
        let (version, coding, kind) = read_head(&mut scanner)?;
        let index = Self {
            version,
            kind,
            points: None,
            cells: kind.cell_words().iter().map(|_| None).collect(),
            types: None,
            point_data: LegacySection::new("PointData"),
            cell_data: LegacySection::new("CellData"),
            field_data: LegacySection::new("FieldData"),
            warnings: Vec::new(),
        };
        let mut parser = Parser { scanner, coding, index, place: Place::Field, arrays: 0 };
        while parser.step()? {}
        parser.finish(bytes)
    }

    /// The number of points.
    pub(super) fn point_count(&self) -> usize {
        self.points.as_ref().map_or(0, |points| points.tuples)
    }

    /// The number of cells of all kinds.
    pub(super) fn cell_count(&self) -> usize {
        let counts = self.cells.iter().flatten().map(LegacyCells::len);
        counts.fold(0, usize::saturating_add)
    }
}

/// The first lines, up to the type of data set.
fn read_head(scanner: &mut Scanner<'_>) -> Result<(String, LegacyCoding, LegacyKind), LegacyFlaw> {
    let ends = |expected| LegacyProblem::Ends { expected };
    let line = scanner.line().unwrap_or_default();
    let version = line.strip_prefix(super::legacy_reader::SIGNATURE).unwrap_or_default();
    let version = String::from_utf8_lossy(version.trim_ascii()).into_owned();
    scanner.line().ok_or_else(|| scanner.flaw(ends("the title")))?;
    let before = scanner.clone();
    let coding = match scanner.word("ASCII or BINARY")? {
        word if word.eq_ignore_ascii_case(b"ascii") => LegacyCoding::Ascii,
        word if word.eq_ignore_ascii_case(b"binary") => LegacyCoding::Binary,
        word => return Err(before.unexpected(word, "ASCII or BINARY")),
    };
    scanner.expect("DATASET")?;
    let before = scanner.clone();
    let kind = match scanner.word("the type of data set")? {
        word if word.eq_ignore_ascii_case(b"unstructured_grid") => LegacyKind::Grid,
        word if word.eq_ignore_ascii_case(b"polydata") => LegacyKind::PolyData,
        word => {
            let found = String::from_utf8_lossy(word).into_owned();
            return Err(before.flaw(LegacyProblem::OtherType(found)));
        }
    };
    Ok((version, coding, kind))
}

/// To what the arrays belong that come next.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Field,
    Points,
    Cells,
}

struct Parser<'a> {
    scanner: Scanner<'a>,
    coding: LegacyCoding,
    index: LegacyIndex,
    place: Place,
    arrays: usize,
}

impl Parser<'_> {
    /// Reads one section; returns whether more are to come.
    fn step(&mut self) -> Result<bool, LegacyFlaw> {
        let before = self.scanner.clone();
        let Some(word) = self.scanner.next_word() else {
            return Ok(false);
        };
        let key = word.to_ascii_lowercase();
        let cells = self.index.kind.cell_words().iter().position(|w| w.as_bytes() == key);
        match (&key[..], cells) {
            (_, Some(place)) => {
                let major = self.index.version.split('.').next().map(str::parse::<u32>);
                let is_new_form = matches!(major, Some(Ok(5..)));
                let found = LegacyCells::scan(&mut self.scanner, self.coding, is_new_form)?;
                if let Some(cells) = self.index.cells.get_mut(place) {
                    *cells = Some(found);
                }
            }
            (b"points", _) => {
                let count = self.scanner.count("the number of points")?;
                self.index.points = Some(self.values("Points", (count, 3))?);
            }
            (b"cell_types", _) => {
                let count = self.scanner.count("the number of cells")?;
                self.index.types = Some(self.array("types", b"int", (count, 1))?);
            }
            (b"point_data", _) => self.begin(Place::Points)?,
            (b"cell_data", _) => self.begin(Place::Cells)?,
            (b"field", _) => self.field()?,
            (b"metadata", _) => return Err(before.unexpected(word, "a keyword of VTK")),
            _ if self.place == Place::Field => {
                return Err(before.unexpected(word, "a keyword such as POINTS or POINT_DATA"));
            }
            (key, _) => {
                self.attribute(key).unwrap_or_else(|| {
                    Err(before.unexpected(word, "a keyword such as SCALARS or FIELD"))
                })?;
            }
        }
        Ok(true)
    }

    fn section(&mut self) -> &mut LegacySection {
        match self.place {
            Place::Field => &mut self.index.field_data,
            Place::Points => &mut self.index.point_data,
            Place::Cells => &mut self.index.cell_data,
        }
    }

    fn begin(&mut self, place: Place) -> Result<(), LegacyFlaw> {
        self.place = place;
        let tuples = self.scanner.count("a number of tuples")?;
        self.section().tuples = Some(tuples);
        Ok(())
    }

    /// An array whose type comes next.
    fn values(&mut self, name: &str, shape: (usize, usize)) -> Result<LegacyArray, LegacyFlaw> {
        let kind = self.scanner.word("a type")?;
        self.array(name, kind, shape)
    }

    fn array(
        &mut self,
        name: &str,
        kind: &[u8],
        shape: (usize, usize),
    ) -> Result<LegacyArray, LegacyFlaw> {
        self.arrays += 1;
        if self.arrays > MAX_ARRAYS {
            return Err(self
                .scanner
                .unexpected(name.as_bytes(), "the end (65536 arrays are enough)"));
        }
        LegacyArray::scan(&mut self.scanner, self.coding, name, kind, shape)
    }

    /// `FIELD name number`, then the arrays: name, components, tuples, type, values.
    fn field(&mut self) -> Result<(), LegacyFlaw> {
        self.scanner.word("a name")?;
        let number = self.scanner.count("a number of arrays")?;
        for _ in 0..number {
            if self.scanner.next_is("NULL_ARRAY") {
                continue;
            }
            let name = self.scanner.name()?;
            let components = self.scanner.count("a number of components")?;
            let tuples = self.scanner.count("a number of tuples")?;
            let array = self.values(&name, (tuples, components))?;
            self.section().push(array, None);
        }
        Ok(())
    }

    /// An array with a role; `None` for a keyword VTK does not have.
    fn attribute(&mut self, key: &[u8]) -> Option<Result<(), LegacyFlaw>> {
        let (role, components) = match key {
            b"scalars" => return Some(self.scalars()),
            b"color_scalars" => return Some(self.colours()),
            b"texture_coordinates" => return Some(self.texture_coordinates()),
            b"lookup_table" => return Some(self.lookup_table()),
            b"vectors" => (AttributeKind::Vectors, 3),
            b"normals" => (AttributeKind::Normals, 3),
            b"tensors" => (AttributeKind::Tensors, 9),
            b"tensors6" => (AttributeKind::Tensors, 6),
            b"global_ids" => (AttributeKind::GlobalIds, 1),
            b"pedigree_ids" => (AttributeKind::PedigreeIds, 1),
            b"edge_flags" => (AttributeKind::EdgeFlag, 1),
            _ => return None,
        };
        let read = self.scanner.name().and_then(|name| {
            let kind = self.scanner.word("a type")?;
            self.add(&name, kind, components, role)
        });
        Some(read)
    }

    fn add(
        &mut self,
        name: &str,
        kind: &[u8],
        components: usize,
        role: AttributeKind,
    ) -> Result<(), LegacyFlaw> {
        let tuples = self.section().tuples.unwrap_or(0);
        let array = self.array(name, kind, (tuples, components))?;
        self.section().push(array, Some(role));
        Ok(())
    }

    /// `name type [components] LOOKUP_TABLE name`
    fn scalars(&mut self) -> Result<(), LegacyFlaw> {
        let name = self.scanner.name()?;
        let kind = self.scanner.word("a type")?;
        let mut components = 1;
        if !self.scanner.next_is("LOOKUP_TABLE") {
            components = self.scanner.count("LOOKUP_TABLE, or the number of components")?;
            self.scanner.expect("LOOKUP_TABLE")?;
        }
        self.scanner.word("the name of a lookup table")?;
        self.add(&name, kind, components, AttributeKind::Scalars)
    }

    /// `name components`
    fn colours(&mut self) -> Result<(), LegacyFlaw> {
        let name = self.scanner.name()?;
        let components = self.scanner.count("the number of components")?;
        self.add(&name, COLOUR.as_bytes(), components, AttributeKind::Scalars)
    }

    /// `name components type`
    fn texture_coordinates(&mut self) -> Result<(), LegacyFlaw> {
        let name = self.scanner.name()?;
        let components = self.scanner.count("the number of components")?;
        let kind = self.scanner.word("a type")?;
        self.add(&name, kind, components, AttributeKind::TCoords)
    }

    /// `name size`, then red, green, blue and opacity of each colour.
    fn lookup_table(&mut self) -> Result<(), LegacyFlaw> {
        let name = self.scanner.name()?;
        let size = self.scanner.count("the number of colours")?;
        self.array(&name, COLOUR.as_bytes(), (size, 4))?;
        let name = super::error::line(&name);
        self.index.warnings.push(format!("lookup table '{name}' left out: colours are no data"));
        Ok(())
    }

    /// Compares the numbers of tuples, points and cells.
    fn finish(self, bytes: &[u8]) -> Result<LegacyIndex, LegacyFlaw> {
        let Self { scanner, coding, mut index, .. } = self;
        let (points, cells) = (index.point_count(), index.cell_count());
        let counts = [
            ("points", index.point_data.tuples, points),
            ("cells", index.cell_data.tuples, cells),
            ("types of cells", index.types.as_ref().map(|types| types.tuples), cells),
        ];
        for (what, found, expected) in counts {
            if let Some(found) = found.filter(|found| *found != expected) {
                return Err(scanner.flaw(LegacyProblem::Tuples { what, found, expected }));
            }
        }
        if index.kind == LegacyKind::Grid && index.types.is_none() && cells > 0 {
            return Err(scanner.flaw(LegacyProblem::Ends { expected: "CELL_TYPES" }));
        }
        index.point_data.finish(points);
        index.cell_data.finish(cells);
        if coding == LegacyCoding::Ascii && !bytes.last().is_some_and(u8::is_ascii_whitespace) {
            index.warnings.push(String::from(
                "the file does not end with the end of a line: its last number may be cut",
            ));
        }
        Ok(index)
    }
}
