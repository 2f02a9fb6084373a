//! `vtu2contour interpolate`: the cubics at other points, on a finer mesh, on a grid.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};
use vtu2contour::filter::{Sampled, Subdivision, sample, sample_image, subdivide};
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{
    AtomicFile, Selection, UnstructuredGrid, VtkError, read_grid, write_vti_to, write_vtp_to,
    write_vtu_to,
};

use super::arguments::InterpolateArguments;
use super::csv;
use super::input::{Arrays, Input};
use super::messages::Messages;
use super::running;

/// The kinds of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Csv,
    Vti,
    Vtp,
    Vtu,
}

/// Runs the job.
pub fn run(arguments: &InterpolateArguments) -> Result<()> {
    let format = format(arguments)?;
    running::run(&arguments.running, |messages| interpolate(arguments, format, messages))
}

/// The kind of output that a file's name asks for, if it can hold what is wanted.
fn format(arguments: &InterpolateArguments) -> Result<Format> {
    let extension = arguments.output.extension().and_then(|extension| extension.to_str());
    let found = match extension.map(str::to_lowercase).as_deref() {
        Some("csv") => Some(Format::Csv),
        Some("vti") => Some(Format::Vti),
        Some("vtp") => Some(Format::Vtp),
        Some("vtu") => Some(Format::Vtu),
        _ => None,
    };
    let (wanted, can): (&str, &[Format]) = if arguments.at.is_some() {
        (
            "with --at its name must end in .csv, .vtp or .vtu",
            &[Format::Csv, Format::Vtp, Format::Vtu],
        )
    } else if arguments.grid.is_some() {
        ("with --grid its name must end in .vti", &[Format::Vti])
    } else {
        ("a refined mesh is a .vtu", &[Format::Vtu])
    };
    match found {
        Some(format) if can.contains(&format) => Ok(format),
        _ => bail!("cannot write '{}': {wanted}", arguments.output.display()),
    }
}

fn interpolate(
    arguments: &InterpolateArguments,
    format: Format,
    messages: &Messages,
) -> Result<()> {
    messages.stage("reading");
    let input = Input::open(&arguments.input, arguments.scalars.time, false)?;
    let part = input.only_part()?;
    let mut out = AtomicFile::create(&arguments.output)?;
    let grid = input.read(part, Arrays::All)?.data;
    messages.stage("interpolating");
    let (options, write_options) = (arguments.sample_options(), arguments.write_options());
    let explained = |error| input.explained(part, &error);
    let sampled = if let Some(file) = &arguments.at {
        let there = Points::read(file)?;
        let sampled = sample(&grid, &options, &there.points).map_err(explained)?;
        there.write(&mut out, format, &sampled, write_options)?;
        sampled
    } else if let Some(counts) = arguments.grid {
        let (image, sampled) = sample_image(&grid, &options, counts).map_err(explained)?;
        write_vti_to(&mut out, &image, write_options)?;
        sampled
    } else {
        let subdivision = match (arguments.subdivide, arguments.tolerance) {
            (Some(parts), _) => Subdivision::Parts(parts),
            (None, tolerance) => Subdivision::Tolerance(tolerance.unwrap_or(f64::INFINITY)),
        };
        let refined = subdivide(&grid, &options, subdivision).map_err(explained)?;
        if !refined.is_fine {
            messages.warning("--tolerance is not kept everywhere: it would take too many cells");
        }
        messages.detail(&format!(
            "{} cells of {}, {} points",
            refined.grid.cells.len(),
            grid.cells.len(),
            refined.grid.points.tuples()
        ));
        write_vtu_to(&mut out, &refined.grid, write_options)?;
        refined.sampled
    };
    tell(&sampled, messages);
    Ok(out.commit()?)
}

/// Tells what was left out and counted.
fn tell(sampled: &Sampled, messages: &Messages) {
    if sampled.left_out.total() > 0 {
        messages.warning(&format!("left out: {}", sampled.left_out));
    }
    let counts = [
        (sampled.outside, "points are outside the mesh: their values are NaN"),
        (sampled.singular, "triangles or tetrahedra could not use the PDE"),
    ];
    for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
        messages.warning(&format!("{count} {what}"));
    }
    sampled.warnings.iter().for_each(|warning| messages.warning(warning));
    messages.detail(&format!("interpolated '{}'", sampled.label));
}

/// Points of a file.
struct Points {
    points: Vec<Vector>,
    /// What they are points of, if that is a grid.
    grid: Option<UnstructuredGrid>,
}

impl Points {
    fn read(file: &Path) -> Result<Self> {
        let extension = file.extension().and_then(|extension| extension.to_str());
        if extension.is_some_and(|extension| extension.eq_ignore_ascii_case("csv")) {
            return Ok(Self { points: csv::read_points(file)?, grid: None });
        }
        let grid = read_grid(file, &Selection::none())?.data;
        let coordinates = grid.points.to_f64().unwrap_or_default();
        let points = coordinates.as_chunks::<3>().0.iter().map(|point| Vector::from(*point));
        Ok(Self { points: points.collect(), grid: Some(grid) })
    }

    fn write(
        self,
        out: &mut impl Write,
        format: Format,
        sampled: &Sampled,
        options: vtu2contour::vtk::WriteOptions,
    ) -> Result<(), VtkError> {
        match (format, self.grid) {
            (Format::Csv, _) => {
                csv::write_points(out, &self.points, &sampled.data).map_err(VtkError::Write)
            }
            (Format::Vtu, Some(grid)) => {
                let grid = UnstructuredGrid { point_data: sampled.data.clone(), ..grid };
                write_vtu_to(out, &grid, options)
            }
            (Format::Vtu, None) => {
                let grid = sampled.clone().poly_data(&self.points).into_grid();
                write_vtu_to(out, &grid, options)
            }
            _ => write_vtp_to(out, &sampled.clone().poly_data(&self.points), options),
        }
    }
}
