//! What is written: one file, or a list and the files that it names.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use vtu2contour::filter::{Contoured, picture};
use vtu2contour::vtk::{
    AtomicFile, ClosedFile, Declaration, OutputFolder, PolyData, PvdEntry, VtkError, WriteOptions,
    write_pvd_to, write_pvtp_to, write_vtp_to, write_vtu_to,
};

/// The kinds of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Lines as polygonal data.
    Vtp,
    /// Lines as a grid.
    Vtu,
    /// A picture.
    Svg,
    /// The list of the pieces of polygonal data.
    Pvtp,
    /// The list of the files of a series.
    Pvd,
}

impl Format {
    /// The kind of output that a file's name asks for.
    pub fn of(output: &Path) -> Result<Self> {
        let extension = output.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_lowercase).as_deref() {
            Some("vtp") => Ok(Self::Vtp),
            Some("vtu") => Ok(Self::Vtu),
            Some("svg") => Ok(Self::Svg),
            Some("pvtp") => Ok(Self::Pvtp),
            Some("pvd") => Ok(Self::Pvd),
            _ => bail!(
                "cannot write '{}': the output's name must end in .vtp or .vtu (lines), .svg (a \
                 picture), .pvtp (lines in pieces) or .pvd (a series)",
                output.display()
            ),
        }
    }

    /// Whether output of this kind lists files of its own.
    pub fn is_list(self) -> bool {
        matches!(self, Self::Pvtp | Self::Pvd)
    }

    /// Whether what is written of pieces is one again.
    pub fn joins_pieces(self) -> bool {
        matches!(self, Self::Vtp | Self::Vtu)
    }

    /// Whether the data of the input travel along.
    pub fn has_data(self) -> bool {
        self != Self::Svg
    }
}

/// Output that is being written. All its files appear together, or none of them.
pub struct Output {
    format: Format,
    options: WriteOptions,
    /// Draw the mesh behind the lines of a picture.
    mesh: bool,
    /// The file of the output's name, until something is in it.
    main: AtomicFile,
    /// The contours of the parts so far, where they become one.
    parts: Vec<PolyData>,
    entries: Vec<PvdEntry>,
    files: Vec<ClosedFile>,
    /// What the pieces of a `.pvtp` have.
    declaration: Option<Declaration>,
    /// Dropped after the files in it.
    #[expect(dead_code, reason = "its end removes it if it is empty")]
    folder: Option<OutputFolder>,
}

impl Output {
    /// Begins to write: a folder that is missing is better told before the work than after.
    pub fn begin(path: &Path, options: WriteOptions, mesh: bool) -> Result<Self> {
        let format = Format::of(path)?;
        let folder = || OutputFolder::create(folder_of(path));
        Ok(Self {
            format,
            options,
            mesh,
            main: AtomicFile::create(path)?,
            parts: Vec::new(),
            entries: Vec::new(),
            files: Vec::new(),
            declaration: None,
            folder: format.is_list().then(folder).transpose()?,
        })
    }

    /// Adds the contours of the part `index` of the input.
    pub fn add(&mut self, index: usize, from: &PvdEntry, contoured: Contoured) -> Result<()> {
        match self.format {
            Format::Svg => self.draw(&contoured)?,
            Format::Vtp | Format::Vtu => self.parts.push(contoured.poly_data),
            Format::Pvtp | Format::Pvd => self.add_listed(index, from, &contoured.poly_data)?,
        }
        Ok(())
    }

    /// Writes the parts that become one. Returns the names of arrays that are left out, as they are
    /// not alike in all.
    pub fn write_joined(&mut self) -> Result<Vec<String>, VtkError> {
        if self.parts.is_empty() {
            return Ok(Vec::new());
        }
        let (data, left_out) = PolyData::joined(std::mem::take(&mut self.parts));
        match self.format {
            Format::Vtu => write_vtu_to(&mut self.main, &data.into_grid(), self.options)?,
            _ => write_vtp_to(&mut self.main, &data, self.options)?,
        }
        Ok(left_out)
    }

    /// Writes the lines as a picture.
    fn draw(&mut self, contoured: &Contoured) -> Result<()> {
        let picture = picture(contoured, self.mesh).context(
            "a picture shows contour lines, and the grid has solids only: write surfaces, with \
             -o NAME.vtp",
        )?;
        Ok(picture.write(&mut self.main)?)
    }

    fn add_listed(
        &mut self,
        index: usize,
        from: &PvdEntry,
        data: &PolyData,
    ) -> Result<(), VtkError> {
        let file = listed_file(self.main.path(), index);
        let mut out = AtomicFile::create(&file)?;
        write_vtp_to(&mut out, data, self.options)?;
        self.files.push(out.close()?);
        self.declaration
            .get_or_insert_with(|| Declaration::of_poly_data(data, self.options.floats));
        self.entries.push(PvdEntry { file, ..from.clone() });
        Ok(())
    }

    /// Gives all files their names.
    pub fn finish(mut self) -> Result<(), VtkError> {
        let list = self.main.path().to_owned();
        match (self.format, &self.declaration) {
            (Format::Pvd, _) => write_pvd_to(&mut self.main, list, &self.entries)?,
            (Format::Pvtp, Some(declaration)) => {
                let pieces: Vec<_> = self.entries.iter().map(|entry| &entry.file).collect();
                write_pvtp_to(&mut self.main, list, &pieces, declaration)?;
            }
            _ => {}
        }
        let main = self.main.close()?;
        self.files.into_iter().try_for_each(ClosedFile::commit)?;
        main.commit()
    }
}

/// The file of part `index` in a list: `out/out_0.vtp` for the first of `out.pvd`, as
/// ParaView has it.
pub fn listed_file(list: &Path, index: usize) -> PathBuf {
    let mut name = list.file_stem().unwrap_or_default().to_owned();
    name.push(format!("_{index}.vtp"));
    folder_of(list).join(name)
}

fn folder_of(list: &Path) -> PathBuf {
    list.with_extension("")
}
