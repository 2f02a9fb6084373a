//! Scratch.
mod support;
use support::checked::is_symmetric;
use support::meshes::symmetric_grid;
use support::tables_of_refinement::*;
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::monitor::Selection;
use vtu2contour::refine::Marks;
use vtu2contour::refine::delaunay::*;
#[test]
fn scratch() {
    let problem = problem(2);
    for method in [Method::SurfaceArea, Method::Defect, Method::Stepwise, Method::Interpolation] {
        let mut mesh = symmetric_grid(6);
        while mesh.points().len() < 1000 {
            let m = method.monitor(&mesh, &problem);
            let mut f = 2.0;
            let mut sel = Selection::AboveAverage(2.0).select(&m).unwrap();
            if sel.is_empty() {
                f = 1.0;
                sel = Selection::AboveAverage(1.0).select(&m).unwrap();
            }
            let part = TriangleMesh::new(
                mesh.points().to_vec(),
                sel.iter().map(|&c| mesh.triangles()[c as usize]).collect(),
            )
            .unwrap();
            println!(
                "{method:?} {} points, factor {f}, {} marks, marks symmetric {}",
                mesh.points().len(),
                sel.len(),
                is_symmetric(&part)
            );
            for least in [0.0, 20.0] {
                let o = DelaunayOptions { least_angle: least, ..Default::default() };
                let r = delaunay(&mesh, &Marks::all(&sel), &o).unwrap();
                let next = TriangleMesh::new(r.points, r.cells).unwrap();
                println!("   {least}: {} points {}", next.points().len(), is_symmetric(&next));
                if least == 20.0 {
                    let ok = is_symmetric(&next);
                    if !ok {
                        for p in next.points() {
                            if !next
                                .points()
                                .iter()
                                .any(|q| (q - Vector::new(1.0 - p.x, p.y, 0.0)).norm() < 1e-7)
                            {
                                println!("      lone {:?}", (p.x, p.y));
                            }
                        }
                        let key = |c: usize, m: bool| {
                            let mut k = next.corners(c).map(|p| {
                                [if m { 1.0 - p.x } else { p.x }, p.y]
                                    .map(|x| (x * 1e7).round() as i64)
                            });
                            k.sort();
                            k
                        };
                        let all: std::collections::HashSet<_> =
                            (0..next.triangles().len()).map(|c| key(c, true)).collect();
                        for c in 0..next.triangles().len() {
                            if !all.contains(&key(c, false)) {
                                println!("      cell {:?}", next.corners(c).map(|p| (p.x, p.y)));
                            }
                        }
                    }
                    mesh = next;
                    if !ok {
                        mesh = symmetric_grid(40);
                    }
                }
            }
        }
    }
    // where the points of problem 1 go
    let problem = support::tables_of_refinement::problem(1);
    for method in METHODS {
        let mesh = method.mesh(&problem, 900);
        let near =
            mesh.points().iter().filter(|p| (1.0 - p.x).hypot(p.y.min(1.0 - p.y)) < 0.05).count();
        println!("{method:?}: {near} of 900 within 0.05 of the right corners");
    }
}
