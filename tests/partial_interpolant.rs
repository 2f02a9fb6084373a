//! An interpolant that is computed in some cells only, for some levels only, is the same there as
//! one that is computed everywhere.

mod support;

use proptest::prelude::*;
use support::meshes::{Random, random_square};
use support::mixed_grid::mixed_grid;
use support::tetrahedra::{kuhn_grid, random_cube};
use vtu2contour::contour::Levels;
use vtu2contour::field::Field;
use vtu2contour::filter::{
    ContourOptions, GradientSource, Interpolant, Solution, contour, preview,
};
use vtu2contour::interpolant::{
    JointReach, Pci, TetrahedronCubics, TriangleCubics, Tricubic, reach_in_tetrahedron,
    reach_on_triangle,
};
use vtu2contour::mesh::{SimplexMesh, Subset, Vector};
use vtu2contour::vtk::UnstructuredGrid;

/// A random number below a count.
fn below(random: &mut Random, count: usize) -> usize {
    random.uniform(0.0, count as f64) as usize
}

/// Values and gradients that contradict each other, so that many corrections are cut.
fn noise(random: &mut Random, points: usize) -> (Vec<f64>, Vec<Vector>) {
    let values = (0..points).map(|_| random.uniform(-1.0, 1.0)).collect();
    let size = |random: &mut Random| 10_f64.powf(random.uniform(-2.0, 2.0));
    let gradients = (0..points)
        .map(|_| Vector::from([(); 3].map(|()| random.uniform(-1.0, 1.0) * size(random))));
    (values, gradients.collect())
}

/// The same mesh with some simplices more, which share their sides with two others.
fn with_branches<const CORNERS: usize>(
    random: &mut Random,
    mesh: &SimplexMesh<CORNERS>,
) -> SimplexMesh<'static, CORNERS> {
    let mut simplices = mesh.simplices().to_vec();
    for _ in 0..5 {
        let mut branch = simplices[below(random, simplices.len())];
        branch[below(random, CORNERS)] = below(random, mesh.points().len()) as u32;
        let is_simplex = (1..CORNERS).all(|n| !branch[..n].contains(&branch[n]));
        simplices.extend(is_simplex.then_some(branch));
    }
    SimplexMesh::new(mesh.points().to_vec(), simplices).unwrap()
}

/// A few simplices, the most of them near each other.
fn few<const CORNERS: usize>(random: &mut Random, mesh: &SimplexMesh<CORNERS>) -> Subset {
    let count = mesh.simplices().len();
    let chosen = [(); 3].map(|()| below(random, count));
    let few = Subset::new(count, |simplex| chosen.contains(&simplex));
    if below(random, 2) == 0 { few.with_neighbours(mesh) } else { few }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn some_tetrahedra_have_the_same_bits(seed in 0..10_000_u64) {
        let mut random = Random(seed);
        let cube = random_cube(&mut random, 250);
        let mesh = with_branches(&mut random, &cube);
        let (values, gradients) = noise(&mut random, mesh.points().len());
        let field = Field { values: &values, gradients: &gradients };
        let some = few(&mut random, &mesh);
        let (part, whole) = (Tricubic::in_some(&mesh, field, &some), Tricubic::new(&mesh, field));
        let plain = Tricubic::with_quadratic_precision(&mesh, field);
        let mut differing = 0;
        for tetrahedron in 0..mesh.tetrahedra().len() {
            let expected: &dyn TetrahedronCubics =
                if some.contains(tetrahedron) { &whole } else { &plain };
            prop_assert_eq!(part.cubic(tetrahedron), expected.cubic(tetrahedron));
            differing += usize::from(part.cubic(tetrahedron) != whole.cubic(tetrahedron));
        }
        // it was not computed everywhere
        prop_assert!(differing > mesh.tetrahedra().len() / 2);
    }

    #[test]
    fn some_triangles_have_the_same_bits(seed in 0..10_000_u64) {
        let mut random = Random(seed);
        let square = random_square(&mut random, 100);
        let mesh = with_branches(&mut random, &square);
        let (values, gradients) = noise(&mut random, mesh.points().len());
        let field = Field { values: &values, gradients: &gradients };
        let some = few(&mut random, &mesh);
        let (part, whole) = (Pci::on_some(&mesh, field, &some), Pci::new(&mesh, field));
        let plain = Pci::with_quadratic_precision(&mesh, field);
        let mut differing = 0;
        for triangle in 0..mesh.triangles().len() {
            let expected: &dyn TriangleCubics =
                if some.contains(triangle) { &whole } else { &plain };
            prop_assert_eq!(part.cubic(triangle), expected.cubic(triangle));
            differing += usize::from(part.cubic(triangle) != whole.cubic(triangle));
        }
        prop_assert!(differing > mesh.triangles().len() / 2);
    }

    /// Without a bit of slack. Half of the data are wild, some are missing.
    #[test]
    fn no_cubic_is_out_of_reach(seed in 0..10_000_u64) {
        let mut random = Random(seed);
        let (plane, solid) = (random_square(&mut random, 60), random_cube(&mut random, 60));
        let (mut values, gradients) = noise(&mut random, 100);
        values[below(&mut random, 60)] = f64::NAN;
        let field = Field { values: &values, gradients: &gradients };
        let within = |outer: [f64; 2], [low, high]: [f64; 2]| outer[0] <= low && high <= outer[1];
        let pci = Pci::new(&plane, field);
        for triangle in 0..plane.triangles().len() {
            let cubic = pci.cubic(triangle);
            let is_finite = cubic.coefficients.iter().all(|b| b.is_finite());
            let reach = reach_on_triangle(&plane, &field, triangle);
            prop_assert_eq!(reach.is_some(), is_finite);
            prop_assert!(reach.is_none_or(|reach| within(reach, cubic.value_bounds())));
        }
        let tricubic = Tricubic::new(&solid, field);
        for tetrahedron in 0..solid.tetrahedra().len() {
            let cubic = tricubic.cubic(tetrahedron);
            let is_finite = cubic.coefficients.iter().all(|b| b.is_finite());
            let reach = reach_in_tetrahedron(&solid, &field, tetrahedron);
            prop_assert_eq!(reach.is_some(), is_finite);
            prop_assert!(reach.is_none_or(|reach| within(reach, cubic.value_bounds())));
        }
        let on_triangle = |cell| reach_on_triangle(&plane, &field, cell);
        joint_reaches_hold_all(&mut random, &plane, field, &on_triangle)?;
        let in_tetrahedron = |cell| reach_in_tetrahedron(&solid, &field, cell);
        joint_reaches_hold_all(&mut random, &solid, field, &in_tetrahedron)?;
    }
}

/// The reach of cells that follow each other holds that of each, and the values at its vertices, as
/// they are; there is one if all are finite.
fn joint_reaches_hold_all<const CORNERS: usize>(
    random: &mut Random,
    mesh: &SimplexMesh<CORNERS>,
    field: Field,
    reach: &dyn Fn(usize) -> Option<[f64; 2]>,
) -> Result<(), TestCaseError> {
    for _ in 0..50 {
        let first = below(random, mesh.simplices().len());
        let cells = first..mesh.simplices().len().min(first + 1 + below(random, 4));
        let reaches: Option<Vec<_>> = cells.clone().map(reach).collect();
        let joint = JointReach::new(mesh, &field, cells.clone());
        prop_assert_eq!(joint.is_some(), reaches.is_some());
        let (Some(joint), Some(reaches)) = (joint, reaches) else { continue };
        let [low, high] = joint.range;
        prop_assert!(reaches.iter().all(|reach| low <= reach[0] && reach[1] <= high));
        let corners = mesh.simplices()[cells].iter().flatten();
        let values: Vec<f64> = corners.map(|&point| field.values[point as usize]).collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        prop_assert_eq!(joint.at_vertices, [least, greatest]);
    }
    Ok(())
}

/// What is drawn and what is reported are those of the interpolant that is computed everywhere.
fn check(grid: &UnstructuredGrid, levels: Levels) -> usize {
    check_with(grid, GradientSource::Array("g".to_owned()), levels).0
}

/// The same, with what people are told.
fn check_with(
    grid: &UnstructuredGrid,
    gradient: GradientSource,
    levels: Levels,
) -> (usize, Vec<String>) {
    let array = Some("u".to_owned());
    let options = ContourOptions { levels, array, gradient, ..ContourOptions::default() };
    let whole = Interpolant::new(Solution::of_grid(grid, &options).unwrap(), &options).unwrap();
    let contours = whole.contours(&options).unwrap();
    let expected = whole.output(&contours, options.output(grid)).poly_data(grid);
    let found = contour(grid, &options, &mut |_| {}).unwrap();
    assert_eq!(found.poly_data, expected);
    assert_eq!(format!("{:?}", found.report), format!("{:?}", whole.report(&contours)));
    let foretold = preview(grid, &options).unwrap();
    assert_eq!(foretold.range, whole.interpolation.range);
    assert_eq!(foretold.unusable, whole.interpolation.unusable());
    assert_eq!(foretold.ghosts, whole.interpolation.ghosts());
    (expected.lines.len() + expected.polys.len(), found.report.warnings)
}

/// Though the range of the cubics is not looked for where levels are given.
#[test]
fn cubics_of_recovered_gradients_that_go_far_beyond_are_told_at_given_levels() {
    let (even, uneven) = (kuhn_grid(6), random_cube(&mut Random(3), 150));
    let wave = |p: &Vector| ((3.0 * p.x + 2.0 * p.y).sin() + p.z * p.z, Vector::zeros());
    let noise = |p: &Vector| ((1e4 * (p.x + 2.0 * p.y + 3.0 * p.z)).sin(), Vector::zeros());
    for (grid, is_told) in
        [(mixed_grid(&even, wave, |_| false), false), (mixed_grid(&uneven, noise, |_| false), true)]
    {
        for levels in [Levels::Explicit(vec![0.4]), Levels::Equal { count: 2, range: None }] {
            let (drawn, told) = check_with(&grid, GradientSource::Recovered, levels);
            let reach = told.iter().any(|text| text.starts_with("the cubics of 'u' reach from"));
            assert!(drawn > 0 && reach == is_told, "{told:?}");
        }
    }
}

#[test]
fn levels_that_are_attained_between_points_only_are_drawn() {
    let hill = |p: &Vector| ((p.x - 0.2) * (0.8 - p.x), Vector::new(1.0 - 2.0 * p.x, 0.0, 0.0));
    let grid = mixed_grid(&kuhn_grid(3), hill, |_| false);
    // at most 0.062 at points, 0.09 between them
    assert!(check(&grid, Levels::Explicit(vec![0.085])) > 0);
}

/// Levels of which each is in few cells, as [`Tricubic::in_some`] computes all if most are asked.
#[test]
fn contours_and_reports_are_those_of_the_whole() {
    let wave = |p: &Vector| {
        let (s, c) = (3.0 * p.x + 2.0 * p.y + p.z).sin_cos();
        (s + p.z * p.z, Vector::new(3.0 * c, 2.0 * c, c + 2.0 * p.z))
    };
    // on a plateau, then up a hill, whose foot and top are not at points
    let hill = |p: &Vector| {
        let rise = (p.x - 0.73).max(0.0);
        (0.1 + rise * rise * (1.0 + p.y * (1.0 - p.y)), {
            let along_y = rise * rise * (1.0 - 2.0 * p.y);
            Vector::new(2.0 * rise * (1.0 + p.y * (1.0 - p.y)), along_y, 0.0)
        })
    };
    let missing = |p: &Vector| {
        let (u, g) = wave(p);
        (if p.x > 0.8 && p.y > 0.8 { f64::NAN } else { u }, g)
    };
    let mesh = kuhn_grid(12);
    let nowhere = |_: &Vector| false;
    let right = |p: &Vector| p.x > 0.7;
    let grids = [
        (mixed_grid(&mesh, wave, nowhere), [-0.9, 0.3, 1.4]),
        (mixed_grid(&mesh, wave, right), [-0.9, 0.3, 1.4]),
        (mixed_grid(&mesh, missing, right), [-0.9, 0.3, 1.4]),
        (mixed_grid(&mesh, hill, nowhere), [0.1, 0.101, 0.15]),
    ];
    for (grid, levels) in grids {
        for level in levels {
            assert!(check(&grid, Levels::Explicit(vec![level])) > 0, "{level}");
        }
        check(&grid, Levels::Explicit(vec![levels[0], levels[2]]));
        check(&grid, Levels::Explicit(Vec::new()));
        check(&grid, Levels::Explicit(vec![9.0]));
        for range in [None, Some([levels[0], levels[1]])] {
            for count in [1, 10] {
                assert!(check(&grid, Levels::Equal { count, range }) > 0);
            }
        }
        let options = ContourOptions { array: Some("u".to_owned()), ..ContourOptions::default() };
        let [low, high] = preview(&grid, &options).unwrap().range;
        check(&grid, Levels::Explicit(vec![low, high]));
    }
}
