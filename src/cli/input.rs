//! What is contoured: one grid, the pieces of one, or the steps of a series.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use vtu2contour::filter::{ContourOptions, FilterError, arrays_of_cells, needed_arrays};
use vtu2contour::vtk::{
    AnyFile, Attributes, Description, Loaded, PvdEntry, PvdFile, Selection, UnstructuredGrid,
    VtkError,
};

use super::arguments::Time;

/// An open file, and which parts of it are contoured.
pub struct Input {
    path: PathBuf,
    /// The series that lists the file, where that is taken in pieces.
    series: Option<PathBuf>,
    file: AnyFile,
    /// The parts, at least one.
    pub parts: Vec<Part>,
    /// What all pieces have, where they are read one at a time.
    whole: Option<Whole>,
    /// What people should know about the file as a whole.
    pub warnings: Vec<String>,
}

/// What the pieces of a list are part of.
struct Whole {
    /// The arrays that all of them have.
    description: Description,
    /// The field data: of the list, or of the first piece that has any.
    field_data: Attributes,
}

/// One grid of an input.
pub struct Part {
    /// Its place among all parts of the file.
    index: usize,
    /// Its file and, in a series, its time.
    pub entry: PvdEntry,
}

/// Which arrays a part is read with.
#[derive(Clone, Copy)]
pub enum Arrays<'a> {
    /// All, for they travel along.
    All,
    /// Those that contouring needs.
    Needed(&'a ContourOptions),
    /// Those that decide where cells are.
    OfCells,
}

impl Input {
    /// Opens a file. A series has its steps as parts, or those at a time; any other file has
    /// one part. A list of pieces that is to be taken `in_pieces` has these as parts, also if it is
    /// the only step of a series.
    pub fn open(path: &Path, time: Option<Time>, in_pieces: bool) -> Result<Self> {
        let file = AnyFile::open(path)?;
        let mut input = Self {
            path: path.to_owned(),
            series: None,
            parts: steps_of(path, &file),
            file,
            whole: None,
            warnings: Vec::new(),
        };
        if let Some(time) = time {
            if !input.is_series() {
                bail!("'{}' is no series (.pvd): leave --time out", path.display());
            }
            input.choose(time)?;
        }
        if in_pieces {
            input.take_pieces()?;
        }
        if input.parts.is_empty() {
            bail!("'{}' lists no file: there is nothing to contour", path.display());
        }
        Ok(input)
    }

    /// Makes the pieces of a list the parts.
    fn take_pieces(&mut self) -> Result<()> {
        if let (AnyFile::Pvd(series), [step]) = (&self.file, &self.parts[..]) {
            let (path, file) = (step.entry.file.clone(), series.open_entry(&step.entry)?);
            self.series = Some(std::mem::replace(&mut self.path, path));
            self.file = file;
        }
        if !matches!(self.file, AnyFile::Pvtu(_) | AnyFile::Pvtp(_)) {
            return Ok(());
        }
        let time = self.parts.first().and_then(|step| step.entry.time);
        let piece = |path: &PathBuf| PvdEntry { time, ..lone(path) };
        self.parts = parts_of(self.file.piece_paths().iter().map(piece));
        let description = self.file.description()?;
        self.warnings.clone_from(&description.warnings);
        let field_data = self.field_data(&description)?;
        self.whole = Some(Whole { description, field_data });
        Ok(())
    }

    /// The field data of pieces.
    fn field_data(&self, whole: &Description) -> Result<Attributes, VtkError> {
        if !whole.field_arrays.is_empty() {
            for index in 0..self.parts.len() {
                let piece = self.file.read_piece(index, &Selection::none())?.data;
                if !piece.field_data.is_empty() {
                    return Ok(piece.field_data);
                }
            }
        }
        Ok(Attributes::new())
    }

    /// What all pieces have, where they are read one at a time.
    pub fn whole(&self) -> Option<&Description> {
        self.whole.as_ref().map(|whole| &whole.description)
    }

    /// The only part.
    ///
    /// # Errors
    /// If there are several: the job is one of a single grid.
    pub fn only_part(&self) -> Result<&Part> {
        match &self.parts[..] {
            [part] => Ok(part),
            parts => bail!(
                "'{}' is a series of {} files: choose a step, with --time T, first or last",
                self.path.display(),
                parts.len()
            ),
        }
    }

    /// Whether the input is a series, or one step of it.
    pub fn is_series(&self) -> bool {
        matches!(self.file, AnyFile::Pvd(_))
    }

    /// Whether the parts are pieces of a whole.
    pub fn is_in_pieces(&self) -> bool {
        self.is_several() && !self.is_series()
    }

    /// Whether there are several parts, which share their levels.
    pub fn is_several(&self) -> bool {
        self.parts.len() > 1
    }

    /// Keeps the steps at one time, and those without a time, which belong to all.
    fn choose(&mut self, time: Time) -> Result<()> {
        let mut times: Vec<f64> = self.parts.iter().filter_map(|part| part.entry.time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let found = match time {
            Time::First => times.first(),
            Time::Last => times.last(),
            Time::At(time) => times.iter().find(|&&other| other == time),
        };
        let Some(&found) = found else {
            bail!("'{}' has no step at that time; {}", self.path.display(), listed(&times, time));
        };
        self.parts.retain(|part| part.entry.time.is_none_or(|time| time == found));
        Ok(())
    }

    /// Every file that is read, as far as lists name it.
    ///
    /// # Errors
    /// If a file of a series is missing: better told before the work than after.
    pub fn files(&self) -> Result<Vec<PathBuf>> {
        let mut files = vec![self.path.clone()];
        files.extend(self.series.clone());
        files.extend_from_slice(self.file.piece_paths());
        if let AnyFile::Pvd(series) = &self.file {
            for Part { entry, .. } in &self.parts {
                files.push(entry.file.clone());
                files.extend(pieces_of(series, entry)?);
            }
        }
        Ok(files)
    }

    /// Decodes a part.
    pub fn read(&self, part: &Part, arrays: Arrays) -> Result<Loaded<UnstructuredGrid>, VtkError> {
        match (&self.file, &self.whole) {
            (AnyFile::Pvd(series), _) => read_file(&series.open_entry(&part.entry)?, arrays),
            (file, None) => read_file(file, arrays),
            (file, Some(Whole { description, field_data })) => {
                let selection = match arrays {
                    Arrays::All => Selection::all_of(description),
                    Arrays::Needed(options) => needed_arrays(options, description),
                    Arrays::OfCells => arrays_of_cells(description),
                };
                let mut piece = file.read_piece(part.index, &selection)?;
                description.give_roles(&mut piece.data);
                piece.data.field_data.clone_from(field_data);
                Ok(piece)
            }
        }
    }

    /// What is in a part; nothing is decoded.
    pub fn describe(&self, part: &Part) -> Result<Description, VtkError> {
        match &self.file {
            AnyFile::Pvd(series) => series.open_entry(&part.entry)?.description(),
            file => file.description(),
        }
    }

    /// What messages call a part; nothing where there is only one.
    pub fn name(&self, part: &Part) -> Option<String> {
        let file = part.entry.file.display();
        let time = part.entry.time.map_or(String::new(), |time| format!(" (time {time})"));
        self.is_several().then(|| format!("'{file}'{time}"))
    }

    /// The error with the part's file; a PDE's with the place marked below.
    pub fn explained(&self, part: &Part, error: &FilterError) -> anyhow::Error {
        match error {
            FilterError::Pde(problem) => anyhow!("{error}\n{}", problem.caret()),
            _ => anyhow!("'{}': {error}", part.entry.file.display()),
        }
    }
}

fn read_file(file: &AnyFile, arrays: Arrays) -> Result<Loaded<UnstructuredGrid>, VtkError> {
    match arrays {
        Arrays::All => file.read(&Selection::All),
        Arrays::Needed(options) => file.read(&needed_arrays(options, &file.description()?)),
        Arrays::OfCells => file.read(&arrays_of_cells(&file.description()?)),
    }
}

/// The steps of a series; of another file only itself.
fn steps_of(path: &Path, file: &AnyFile) -> Vec<Part> {
    match file {
        AnyFile::Pvd(series) => parts_of(series.entries().iter().cloned()),
        _ => parts_of([lone(path)]),
    }
}

fn parts_of(entries: impl IntoIterator<Item = PvdEntry>) -> Vec<Part> {
    entries.into_iter().enumerate().map(|(index, entry)| Part { index, entry }).collect()
}

/// A file that no series lists.
fn lone(path: &Path) -> PvdEntry {
    PvdEntry { file: path.to_owned(), ..PvdEntry::default() }
}

/// The pieces of an entry that is a list itself.
fn pieces_of(series: &PvdFile, entry: &PvdEntry) -> Result<Vec<PathBuf>, VtkError> {
    let extension = entry.file.extension().and_then(|extension| extension.to_str());
    let is_list = extension.is_some_and(|extension| extension.starts_with(['p', 'P']));
    if entry.file.is_file() && !is_list {
        return Ok(Vec::new());
    }
    Ok(series.open_entry(entry)?.piece_paths().to_vec())
}

/// What times there are, in a list that stays short.
fn listed(times: &[f64], wanted: Time) -> String {
    const SHOWN: usize = 10;
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return "its files have no times: leave --time out".to_owned();
    };
    if times.len() <= SHOWN {
        let times: Vec<String> = times.iter().map(f64::to_string).collect();
        return format!("its times are {}", times.join(", "));
    }
    let distance = |time: &&f64| match wanted {
        Time::At(wanted) => (**time - wanted).abs(),
        _ => 0.0,
    };
    let nearest = times.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = nearest.unwrap_or(first);
    format!("it has {} times from {first} to {last}; the nearest is {nearest}", times.len())
}
