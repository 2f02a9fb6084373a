//! How long a step of refinement takes: a quarter of a million and a million cells, a tenth of
//! them marked; by the floor alone, and by the filter, which makes the cubics and carries the
//! data. `cargo run --release --example refinement_speed`

use std::time::{Duration, Instant};

use vtu2contour::filter::{ContourOptions, MarkedBy, RefineMethod, RefineOptions, refine};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};
use vtu2contour::refine::delaunay::{DelaunayOptions, delaunay};
use vtu2contour::refine::{Marks, TriangleMethod, refine_tetrahedra};
use vtu2contour::vtk::{DataArray, UnstructuredGrid};

const METHODS: [TriangleMethod; 4] = [
    TriangleMethod::LongestEdge,
    TriangleMethod::NewestVertex,
    TriangleMethod::RedGreen,
    TriangleMethod::Centroid,
];

fn main() {
    for n in [354, 708] {
        let mesh = square(n);
        let marked = tenth(mesh.triangles().len());
        for method in METHODS {
            let start = Clock::start();
            let refined = method.refine(&mesh, &Marks::all(&marked)).map(|refined| refined.cells);
            tell(
                mesh.triangles().len(),
                refined.map_or(0, |cells| cells.len()),
                start,
                &format!("{method:?}"),
            );
        }
        let start = Clock::start();
        let refined = delaunay(&mesh, &Marks::all(&marked), &DelaunayOptions::default());
        let cells = refined.map_or(0, |refined| refined.cells.len());
        tell(mesh.triangles().len(), cells, start, "Delaunay");
        let grid = grid(&mesh, 5, &marked);
        for method in [RefineMethod::default(), RefineMethod::Delaunay] {
            with_data(&grid, method);
        }
    }
    for n in [35, 55] {
        let mesh = cube(n);
        let marked = tenth(mesh.tetrahedra().len());
        let start = Clock::start();
        let refined = refine_tetrahedra(&mesh, &Marks::all(&marked));
        let cells = refined.as_ref().map_or(0, |refined| refined.cells.len());
        tell(mesh.tetrahedra().len(), cells, start, "tetrahedra");
        // half of the points that this takes
        let added = refined.map_or(0, |refined| refined.new_points.len());
        let marks = Marks { max_points: mesh.points().len() + added / 2, ..Marks::all(&marked) };
        let start = Clock::start();
        let cells = refine_tetrahedra(&mesh, &marks).map_or(0, |refined| refined.cells.len());
        tell(mesh.tetrahedra().len(), cells, start, "tetrahedra, bounded");
        with_data(&grid(&mesh, 10, &marked), RefineMethod::default());
    }
}

/// The mesh with values and gradients of a function, another array, and marks.
fn grid<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    kind: u8,
    marked: &[u32],
) -> UnstructuredGrid {
    let points = mesh.points();
    let numbers = |vectors: &mut dyn Iterator<Item = Vector>| -> Vec<f64> {
        vectors.flat_map(<[f64; 3]>::from).collect()
    };
    let coordinates = numbers(&mut points.iter().copied());
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
    mesh.simplices().iter().for_each(|corners| grid.push_cell(kind, &corners.map(i64::from)));
    let slope = Vector::new(3.0, 2.0, 1.0);
    let phase = |point: &Vector| slope.dot(point);
    let values: Vec<f64> = points.iter().map(|point| phase(point).sin()).collect();
    let gradients = numbers(&mut points.iter().map(|point| slope * phase(point).cos()));
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("grad_u", 3, gradients.clone()));
    grid.point_data.push(DataArray::new("other", 3, gradients));
    let mut marks = vec![0_u8; mesh.simplices().len()];
    marked.iter().for_each(|&cell| marks[cell as usize] = 1);
    grid.cell_data.push(DataArray::new("marks", 1, marks));
    grid
}

/// The filter, data and all.
fn with_data(grid: &UnstructuredGrid, method: RefineMethod) {
    let solution = ContourOptions { array: Some("u".to_owned()), ..ContourOptions::default() };
    let options = RefineOptions {
        method,
        marked: MarkedBy::Marks("marks".to_owned()),
        smoothing: None,
        max_points: None,
        regions: None,
        boundaries: Vec::new(),
        solution,
    };
    let start = Clock::start();
    let cells = refine(grid, &options).map_or(0, |refined| refined.grid.types.len());
    tell(grid.types.len(), cells, start, &format!("filter, {method:?}"));
}

fn tell(before: usize, after: usize, start: Clock, what: &str) {
    let wall = start.wall.elapsed().as_secs_f64();
    let used = processor_time().zip(start.used).map(|(now, then)| now - then);
    // on a machine with other work this says more
    let used = used.map_or(String::new(), |t| format!(", {:.2} s of processors", t.as_secs_f64()));
    println!("{what:30} {before:8} -> {after:8} cells: {wall:.2} s{used}");
}

/// When something began, by the wall's clock and by the time that processors worked for it.
struct Clock {
    wall: Instant,
    used: Option<Duration>,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), used: processor_time() }
    }
}

/// The time that processors worked for this program, where Linux tells it (in hundredths).
fn processor_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let numbers = text.rsplit(')').next()?.split_whitespace().skip(11).take(2);
    let ticks: u64 = numbers.filter_map(|number| number.parse::<u64>().ok()).sum();
    Some(Duration::from_millis(10 * ticks))
}

/// Every tenth, in an order without pattern.
fn tenth(cells: usize) -> Vec<u32> {
    let mixed = |cell: u32| cell.wrapping_mul(2_654_435_761).rotate_left(7).wrapping_mul(40_503);
    (0..cells as u32).filter(|&cell| mixed(cell) % 10 == 0).collect()
}

fn square(n: usize) -> TriangleMesh<'static> {
    let at = |k: usize| k as f64 / n as f64;
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| Vector::new(at(i), at(j), 0.0)));
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| (j * (n + 1) + i) as u32));
    let row = n as u32 + 1;
    let triangles = squares.flat_map(|a| [[a, a + 1, a + 1 + row], [a, a + 1 + row, a + row]]);
    TriangleMesh::new(points.collect(), triangles.collect()).unwrap()
}

/// Each small cube in six.
fn cube(n: usize) -> TetrahedronMesh<'static> {
    let row = n + 1;
    let at = |k: usize| k as f64 / n as f64;
    let points = (0..row * row * row)
        .map(|k| Vector::new(at(k % row), at(k / row % row), at(k / row / row)));
    let cubes = (0..n * n * n).map(|k| k % n + k / n % n * row + k / n / n * row * row);
    let steps = [1, row, row * row];
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let tetrahedra = cubes.flat_map(|a| {
        orders.iter().enumerate().map(move |(k, order)| {
            let [x, y, z] = order.map(|axis| steps[axis]);
            let corners = [a, a + x, a + x + y, a + x + y + z].map(|point| point as u32);
            // the last three are turned the other way
            if k < 3 { corners } else { [corners[1], corners[0], corners[2], corners[3]] }
        })
    });
    TetrahedronMesh::new(points.collect(), tetrahedra.collect()).unwrap()
}
