//! Figures 5.8 to 5.10: contour lines of each interpolant.
//!
//! As in the thesis, interpolants are evaluated on a grid of 40 by 40 and the contours
//! are those of the grid; the PCI is also drawn as it is, by its own contour lines.

use std::error::Error;
use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::path::Path;

use vtu2contour::contour::lines::{Method, Resolution, contour_lines};
use vtu2contour::contour::{CellRanges, Levels};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{Linear, Pci, Pieces, TriangleCubics};
use vtu2contour::mesh::{PointLocator, TetrahedronMesh, TriangleMesh, Vector, boundary_edges};
use vtu2contour::pde::Pde;
use vtu2contour::svg::{Coloured, Picture, Point};

use crate::support::meshes::{Random, grid};
use crate::support::problems_3d::SIXTH;
use crate::support::table_5_1::{MEMBERS, Points, Way};
use crate::support::tetrahedra::random_cube;
use crate::support::{problem4, table_5_3};

/// Squares along each side of the grid.
const SQUARES: usize = 40;

/// Draws all figures into a folder.
pub fn draw(folder: &Path) -> Result<(), Box<dyn Error>> {
    create_dir_all(folder)?;
    for (number, points) in [("5.8", 500), ("5.9", 2000)] {
        draw_plane(folder, number, points)?;
    }
    draw_solid(folder)
}

fn draw_plane(folder: &Path, number: &str, points: usize) -> Result<(), Box<dyn Error>> {
    let mesh = Points::RandomWithSides.mesh(points, 1);
    let (values, gradients) = problem4::at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(problem4::PDE, &[], &[])?;
    for way in [Way::Thesis, Way::Ours] {
        for member in MEMBERS {
            let (pieces, _) = member.build(&mesh, field, &pde, way);
            let name =
                format!("{}_{}", member.name(), if way == Way::Ours { "ours" } else { "thesis" });
            draw_on_grid(folder, number, &name, [0.0, 2.5], |p| at(&mesh, &*pieces, p))?;
        }
    }
    let pci = Pci::with_pde(&mesh, field, &Way::Ours.equation(&pde));
    write(folder, number, "PCI_itself", &pci, [0.0, 2.5])
}

/// The interpolant at points.
fn at<const CORNERS: usize>(
    mesh: &vtu2contour::mesh::SimplexMesh<CORNERS>,
    pieces: &dyn Pieces<CORNERS>,
    points: &[Vector],
) -> Vec<f64> {
    let locator = PointLocator::new(mesh);
    let value = |point: &Vector| {
        let place = locator.locate(mesh, point, f64::INFINITY)?;
        Some(pieces.taylor(place.simplex, &place.at).value)
    };
    points.iter().map(|point| value(point).unwrap_or(f64::NAN)).collect()
}

fn draw_solid(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mesh: TetrahedronMesh = random_cube(&mut Random(1), 512);
    let (values, gradients) = SIXTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(SIXTH.pde, &[], &[])?;
    let range = [0.0, 0.08];
    let lifted = |p: &Vector| Vector::new(p.x, p.y, 0.5);
    let exact = |p: &[Vector]| p.iter().map(|p| (SIXTH.value)(&lifted(p))).collect();
    draw_on_grid(folder, "5.10", "exact", range, exact)?;
    for member in table_5_3::MEMBERS {
        let pieces =
            member.build(&mesh, field, &Way::Thesis.equation(&pde), &Way::Thesis.options());
        let sliced = |p: &[Vector]| at(&mesh, &*pieces, &p.iter().map(lifted).collect::<Vec<_>>());
        draw_on_grid(folder, "5.10", member.name(), range, sliced)?;
    }
    Ok(())
}

/// Draws the contours of values on the grid.
fn draw_on_grid(
    folder: &Path,
    number: &str,
    name: &str,
    range: [f64; 2],
    values: impl Fn(&[Vector]) -> Vec<f64>,
) -> Result<(), Box<dyn Error>> {
    let mesh: TriangleMesh = grid(SQUARES);
    let values = values(mesh.points());
    write(folder, number, name, &Linear::new(&mesh, &values), range)
}

fn write(
    folder: &Path,
    number: &str,
    name: &str,
    cubics: &dyn TriangleCubics,
    range: [f64; 2],
) -> Result<(), Box<dyn Error>> {
    let ranges = CellRanges::new(cubics);
    let levels = Levels::Equal { count: 20, range: Some(range) }.resolve(range)?;
    let fine = Resolution { spacing: f64::INFINITY, tolerance: 1e-4 };
    let lines = contour_lines(cubics, &ranges, &levels, Method::Aodea, fine);
    let flat = |p: &Vector| -> Point { [p.x, p.y] };
    let mesh = cubics.mesh();
    let edges = boundary_edges(mesh);
    let outline = edges.iter().map(|edge| edge.map(|p| flat(&mesh.points()[p as usize])));
    let coloured = lines.lines.iter().map(|line| Coloured {
        value: lines.levels[line.level],
        curves: lines.curves[line.curves.clone()]
            .iter()
            .map(|curve| curve.control.each_ref().map(flat))
            .collect(),
        closed: line.closed,
    });
    let picture = Picture {
        title: name.replace('_', " "),
        values: lines.levels.clone(),
        outline: outline.collect(),
        lines: coloured.collect(),
        ..Picture::default()
    };
    let file = File::create(folder.join(format!("figure_{number}_{name}.svg")))?;
    Ok(picture.write(BufWriter::new(file))?)
}
