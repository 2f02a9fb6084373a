//! What every refined flat mesh must be.

use std::collections::{HashMap, HashSet};

use vtu2contour::mesh::{TriangleMesh, Vector, boundary_edges};
use vtu2contour::refine::{NewPoint, Refinement};

/// Twice the signed area in the plane of x and y.
pub fn doubled(mesh: &TriangleMesh, cell: usize) -> f64 {
    let [a, b, c] = mesh.corners(cell);
    (b - a).cross(&(c - a)).z
}

/// The mesh of a refinement.
pub fn mesh_of(refined: &Refinement<3>) -> TriangleMesh<'static> {
    TriangleMesh::new(refined.points.clone(), refined.cells.clone()).unwrap()
}

/// Checks that the refined mesh is conforming, covers what the input covers without turning a
/// cell over, knows where everything comes from, and keeps boundary and interfaces edge by edge.
/// On curved boundaries (`is_straight` is false) the area may change.
pub fn check(input: &TriangleMesh, regions: &[u32], refined: &Refinement<3>, is_straight: bool) {
    let mesh = mesh_of(refined);
    let old = input.points().len();
    assert_eq!(refined.points[..old], *input.points());
    assert_eq!(refined.points.len(), old + refined.new_points.len());
    assert_eq!(refined.cells.len(), refined.parents.len());
    // each cell turned as its parent, no edge twice on the same side
    let mut sides: HashMap<[u32; 2], usize> = HashMap::new();
    for (cell, &[a, b, c]) in refined.cells.iter().enumerate() {
        let parent = refined.parents[cell] as usize;
        let (area, of_parent) = (doubled(&mesh, cell), doubled(input, parent));
        assert!(area * of_parent > 0.0, "cell {cell} is turned over or has no area");
        let turned = if area > 0.0 { [a, b, c] } else { [a, c, b] };
        for k in 0..3 {
            *sides.entry([turned[k], turned[(k + 1) % 3]]).or_default() += 1;
        }
        if is_straight {
            let middle = mesh.position(cell, &[1.0 / 3.0; 3]);
            let at = input.frame(parent).barycentric(&middle);
            assert!(at.iter().all(|&x| x > -1e-9), "cell {cell} is not in its parent");
        }
    }
    assert!(sides.values().all(|&count| count == 1));
    let area = |mesh: &TriangleMesh| {
        (0..mesh.triangles().len()).map(|cell| doubled(mesh, cell).abs()).sum::<f64>()
    };
    if is_straight {
        let (before, after) = (area(input), area(&mesh));
        assert!((before - after).abs() <= 1e-12 * before, "area {before} became {after}");
    }
    for (point, origin) in refined.points[old..].iter().zip(&refined.new_points) {
        let there = match *origin {
            NewPoint::Edge { ends, at } => {
                assert!(ends[0] < ends[1] && (0.0..=1.0).contains(&at));
                let [from, to] = ends.map(|end| input.points()[end as usize]);
                from + (to - from) * at
            }
            NewPoint::Inside { cell, at } => input.position(cell as usize, &at),
        };
        assert!(!is_straight || (there - point).norm() < 1e-9, "{origin:?} is not {point}");
    }
    check_edges(input, regions, refined);
}

/// The edges of the boundary and between regions, as sorted pairs.
fn kept_edges(mesh: &TriangleMesh, region: impl Fn(usize) -> u32) -> Vec<[u32; 2]> {
    let mut beside: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for (cell, &[a, b, c]) in mesh.triangles().iter().enumerate() {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            beside.entry([p.min(q), p.max(q)]).or_default().push(region(cell));
        }
    }
    let is_kept = |cells: &Vec<u32>| cells.len() == 1 || cells[0] != cells[1];
    beside.into_iter().filter(|(_, cells)| is_kept(cells)).map(|(edge, _)| edge).collect()
}

/// Each kept edge of the output is a part of one of the input, and the parts make the whole.
fn check_edges(input: &TriangleMesh, regions: &[u32], refined: &Refinement<3>) {
    let region = |cell: usize| regions.get(cell).copied().unwrap_or(0);
    let before = kept_edges(input, region);
    let after = kept_edges(&mesh_of(refined), |cell| region(refined.parents[cell] as usize));
    let old = input.points().len();
    let mut found: HashMap<[u32; 2], f64> = HashMap::new();
    for edge in after {
        // where the ends are along an edge of the input
        let places = |point: u32, edge: [u32; 2]| match point as usize {
            p if p < old => edge.iter().position(|&end| end == point).map(|n| n as f64),
            p => match refined.new_points[p - old] {
                NewPoint::Edge { ends, at } if ends == edge => Some(at),
                _ => None,
            },
        };
        let of = edge.iter().find_map(|&point| match point as usize {
            p if p >= old => match refined.new_points[p - old] {
                NewPoint::Edge { ends, .. } => Some(ends),
                NewPoint::Inside { .. } => panic!("a point inside is on a kept edge"),
            },
            _ => None,
        });
        let whole = of.unwrap_or([edge[0].min(edge[1]), edge[0].max(edge[1])]);
        let [from, to] = edge.map(|point| places(point, whole).expect("a part of one edge"));
        *found.entry(whole).or_default() += (to - from).abs();
    }
    assert_eq!(found.len(), before.len());
    for edge in before {
        assert!((found[&edge] - 1.0).abs() < 1e-12, "{edge:?} is not there as a whole");
    }
}

/// The least angle of the cells that `counts`, in degrees.
pub fn least_angle(mesh: &TriangleMesh, counts: impl Fn(usize) -> bool) -> f64 {
    let angles = (0..mesh.triangles().len()).filter(|&cell| counts(cell)).flat_map(|cell| {
        let corners = mesh.corners(cell);
        [0, 1, 2].map(|k| {
            let [a, b, c] = [0, 1, 2].map(|step| corners[(k + step) % 3]);
            (b - a).angle(&(c - a)).to_degrees()
        })
    });
    angles.fold(180.0, f64::min)
}

/// Whether no point beyond an edge that is not kept lies in a cell's circumcircle.
pub fn is_delaunay(mesh: &TriangleMesh, is_kept: impl Fn([u32; 2]) -> bool) -> bool {
    let mut apexes: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for &[a, b, c] in mesh.triangles() {
        for [p, q, r] in [[a, b, c], [b, c, a], [c, a, b]] {
            apexes.entry([p.min(q), p.max(q)]).or_default().push(r);
        }
    }
    let at = |point: u32| mesh.points()[point as usize];
    apexes.into_iter().filter(|(edge, beside)| beside.len() == 2 && !is_kept(*edge)).all(
        |([p, q], beside)| {
            let angle = |apex: u32| (at(p) - at(apex)).angle(&(at(q) - at(apex)));
            angle(beside[0]) + angle(beside[1]) <= std::f64::consts::PI + 1e-9
        },
    )
}

/// The boundary's edges, sorted pairs.
pub fn boundary(mesh: &TriangleMesh) -> Vec<[u32; 2]> {
    boundary_edges(mesh).into_iter().map(|[a, b]| [a.min(b), a.max(b)]).collect()
}

/// The point at an angle of a circle around the origin.
pub fn on_circle(radius: f64, angle: f64) -> Vector {
    Vector::new(radius * angle.cos(), radius * angle.sin(), 0.0)
}

/// Whether a mesh is its own image, mirrored at x = 1/2, but for
/// rounding.
pub fn is_symmetric(mesh: &TriangleMesh) -> bool {
    let name = |p: &Vector, mirrored: bool| {
        let x = if mirrored { 1.0 - p.x } else { p.x };
        [x, p.y].map(|x| (x * 1e7).round() as i64)
    };
    let cells = |mirrored: bool| -> HashSet<[[i64; 2]; 3]> {
        let named = (0..mesh.triangles().len()).map(|cell| {
            let mut corners = mesh.corners(cell).map(|corner| name(&corner, mirrored));
            corners.sort_unstable();
            corners
        });
        named.collect()
    };
    cells(false) == cells(true)
}
