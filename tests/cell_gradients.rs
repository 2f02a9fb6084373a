//! Gradients by the shape functions of quadratic cells: exact where they can be.

mod support;

use proptest::prelude::*;
use support::cells::Cells;
use support::meshes::Random;
use vtu2contour::mesh::Vector;
use vtu2contour::simplices::{SplitGrid, nodal_gradients};

/// A quadratic, and its gradient.
#[derive(Clone, Copy, Debug)]
struct Quadratic([f64; 10]);

impl Quadratic {
    fn random(random: &mut Random, degree: usize) -> Self {
        let terms = [1, 4, 10][degree];
        Self([0; 10].map(|_| random.uniform(-2.0, 2.0))).first(terms)
    }

    fn first(mut self, terms: usize) -> Self {
        self.0[terms..].fill(0.0);
        self
    }

    fn value(&self, p: &Vector) -> f64 {
        let [c, x, y, z, xx, yy, zz, xy, yz, zx] = self.0;
        let linear = c + x * p.x + y * p.y + z * p.z;
        let squares = xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z;
        linear + squares + xy * p.x * p.y + yz * p.y * p.z + zx * p.z * p.x
    }

    fn gradient(&self, p: &Vector) -> Vector {
        let [_, x, y, z, xx, yy, zz, xy, yz, zx] = self.0;
        Vector::new(
            x + 2.0 * xx * p.x + xy * p.y + zx * p.z,
            y + 2.0 * yy * p.y + xy * p.x + yz * p.z,
            z + 2.0 * zz * p.z + yz * p.y + zx * p.x,
        )
    }
}

/// The greatest error of the gradients at all points.
fn error(cells: &Cells, field: &Quadratic, dimension: u8) -> f64 {
    let values: Vec<f64> = cells.points.iter().map(|point| field.value(point)).collect();
    let gradients = nodal_gradients(&cells.grid(), &cells.points, &values, dimension).unwrap();
    let error = |(point, gradient): (&Vector, Option<Vector>)| {
        (gradient.expect("every point has a quadratic cell") - field.gradient(point)).norm()
    };
    cells.points.iter().zip(gradients).map(error).fold(0.0, f64::max)
}

/// Types of cells with shape functions, with nodes inside faces or without.
fn kinds(inner: bool) -> &'static [u8] {
    if inner { &[12, 13] } else { &[12, 13, 14] }
}

/// Points through an affine map with positive determinant.
fn skewed(mut cells: Cells) -> Cells {
    for p in &mut cells.points {
        *p = Vector::new(2.0 * p.x + 0.3 * p.y, 0.5 * p.y - 0.2 * p.z, p.x + p.y + 0.7 * p.z);
    }
    cells
}

/// Six tetrahedra a box.
fn tetrahedra(cells: &Cells) -> Cells {
    let split = SplitGrid::new(&cells.grid()).unwrap();
    let cells = split.tetrahedra.simplices.iter().map(|corners| (10, corners.to_vec()));
    Cells { points: split.points, cells: cells.collect(), ..Cells::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Hexahedra, wedges and pyramids that are affine images of the reference cells,
    /// with nodes inside faces or without; and any tetrahedra.
    #[test]
    fn quadratics_are_exact_on_solids(seed: u64, inner: bool, degree in 0..3_usize) {
        let random = &mut Random(seed);
        let field = Quadratic::random(random, degree);
        let cube = Cells::cube(2, 0.0, kinds(inner), random);
        let cells = skewed(cube.quadratic(inner)).renumbered(random);
        prop_assert!(error(&cells, &field, 3) < 1e-11);
        let any = tetrahedra(&Cells::cube(2, 0.3, &[12], random)).quadratic(false);
        prop_assert!(error(&any.renumbered(random), &field, 3) < 1e-10);
    }

    /// Hexahedra and wedges with nodes inside faces need not be affine images.
    #[test]
    fn quadratics_are_exact_on_any_hexahedra_of_27_nodes(seed: u64, degree in 0..3_usize) {
        let random = &mut Random(seed);
        let field = Quadratic::random(random, degree);
        let cells = Cells::cube(2, 0.2, &[12, 13], random).quadratic(true);
        prop_assert!(error(&cells.renumbered(random), &field, 3) < 1e-10);
    }

    /// An affine field is exact on curved cells too: these reproduce their own shape.
    #[test]
    fn affine_fields_are_exact_on_curved_cells(seed: u64, inner: bool) {
        let random = &mut Random(seed);
        let field = Quadratic::random(random, 1);
        let cube = Cells::cube(2, 0.2, kinds(inner), random);
        let mut cells = cube.quadratic(inner);
        for point in &mut cells.points {
            *point += Vector::from([0; 3].map(|_| random.uniform(-0.01, 0.01)));
        }
        prop_assert!(error(&cells.renumbered(random), &field, 3) < 1e-10);
    }
}

/// Triangles and quads in a slanted plane: the tangential part of the gradient.
#[test]
fn gradients_in_a_plane_are_tangential() {
    let random = &mut Random(7);
    let field = Quadratic::random(random, 2);
    let [right, up] = [Vector::new(1.0, 0.0, 0.5), Vector::new(-0.25, 1.0, 0.5)];
    let normal = right.cross(&up).normalize();
    let at = |x: f64, y: f64| right * x + up * y;
    let corners = [[0.0, 0.0], [2.0, 0.2], [2.4, 1.8], [0.1, 1.5]];
    let middle = |a: [f64; 2], b: [f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let mut places = corners.to_vec();
    places.extend((0..4).map(|n| middle(corners[n], corners[(n + 1) % 4])));
    places.push(middle(places[4], places[6]));
    let points: Vec<Vector> = places.iter().map(|&[x, y]| at(x, y)).collect();
    // the diagonal's middle is not that of the quad
    let diagonal = middle(corners[0], corners[2]);
    let mut with_diagonal = points.clone();
    with_diagonal.push(at(diagonal[0], diagonal[1]));
    let quad = Cells { points, cells: vec![(28, (0..9).collect())], ..Cells::default() };
    let mut triangles = Cells { points: with_diagonal, ..Cells::default() };
    triangles.cells = vec![(22, vec![0, 1, 2, 4, 5, 9]), (22, vec![0, 2, 3, 9, 6, 7])];
    for cells in [quad, triangles] {
        let values: Vec<f64> = cells.points.iter().map(|point| field.value(point)).collect();
        let found = nodal_gradients(&cells.grid(), &cells.points, &values, 2).unwrap();
        for (point, gradient) in cells.points.iter().zip(found) {
            let full = field.gradient(point);
            let expected = full - normal * normal.dot(&full);
            let used = cells
                .cells
                .iter()
                .any(|(_, nodes)| nodes.iter().any(|&node| cells.points[node as usize] == *point));
            match gradient {
                Some(gradient) => assert!((gradient - expected).norm() < 1e-11),
                None => assert!(!used),
            }
        }
        assert!(nodal_gradients(&cells.grid(), &cells.points, &values, 3).is_none());
    }
}

/// A large cell counts for more than a sliver beside it.
#[test]
fn the_mean_is_weighted_by_size() {
    let mut cells = Cells { points: vec![Vector::zeros(); 4], ..Cells::default() };
    cells.points[1] = Vector::new(1.0, 0.0, 0.0);
    cells.points[2] = Vector::new(0.0, 1.0, 0.0);
    cells.points[3] = Vector::new(0.0, -0.5, 0.0);
    let middle = |cells: &mut Cells, a: usize, b: usize| {
        let middle = (cells.points[a] + cells.points[b]) / 2.0;
        cells.points.push(middle);
        cells.points.len() as u32 - 1
    };
    let shared = middle(&mut cells, 0, 1);
    let upper = [middle(&mut cells, 1, 2), middle(&mut cells, 2, 0)];
    let lower = [middle(&mut cells, 0, 3), middle(&mut cells, 3, 1)];
    cells.cells.push((22, vec![0, 1, 2, shared, upper[0], upper[1]]));
    cells.cells.push((22, vec![0, 3, 1, lower[0], lower[1], shared]));
    // |y|: slope 1 above, -1 below; the upper triangle is twice the lower
    let values: Vec<f64> = cells.points.iter().map(|point| point.y.abs()).collect();
    let gradients = nodal_gradients(&cells.grid(), &cells.points, &values, 2).unwrap();
    let slope = gradients[0].unwrap();
    assert!((slope - Vector::new(0.0, 1.0 / 3.0, 0.0)).norm() < 1e-14, "{slope}");
}

/// Values that are no numbers, and cells without volume, have no say.
#[test]
fn bad_cells_have_no_say() {
    let cube = Cells::cube(2, 0.0, &[12], &mut Random(1)).quadratic(true);
    let mut values = vec![1.0; cube.points.len()];
    values[3] = f64::NAN;
    let gradients = nodal_gradients(&cube.grid(), &cube.points, &values, 3).unwrap();
    let bad = cube.cells.iter().filter(|(_, nodes)| nodes.contains(&3)).count();
    assert!(bad >= 1 && gradients.iter().any(Option::is_none));
    assert!(gradients.iter().flatten().all(|gradient| gradient.norm() < 1e-12));
    let flat = vec![Vector::zeros(); cube.points.len()];
    values[3] = 1.0;
    let gradients = nodal_gradients(&cube.grid(), &flat, &values, 3).unwrap();
    assert!(gradients.iter().all(Option::is_none));
}
