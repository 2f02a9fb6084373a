//! Contour lines as a picture.

use super::contour_filter::Contoured;
use crate::mesh::{TriangleMesh, Vector, boundary_edges, plane_axes};
use crate::svg::{Coloured, Picture, Point};

/// The picture of contour lines; nothing without two-dimensional cells: the mesh's boundary (and its edges, if wanted)
/// behind the lines, coloured by level. Curves stay Bézier curves.
///
/// A mesh in a plane z = const is seen from above, one in another plane at right
/// angles, and a curved surface along its mean normal; what lies behind is drawn too.
pub fn picture(contoured: &Contoured, with_mesh: bool) -> Option<Picture> {
    let Contoured { lines, report, .. } = contoured;
    let mesh = contoured.triangles.as_ref()?;
    let view = view_axes(mesh);
    let flat = |point: &Vector| view.map(|axis| axis.dot(point));
    let segment = |edge: &[u32; 2]| edge.map(|point| flat(&mesh.points()[point as usize]));
    let outline = boundary_edges(mesh).iter().map(segment).collect();
    let edges =
        if with_mesh { inner_edges(mesh).iter().map(segment).collect() } else { Vec::new() };
    let coloured = |line: &crate::contour::lines::Polyline| Coloured {
        value: lines.levels[line.level],
        curves: lines.curves[line.curves.clone()]
            .iter()
            .map(|curve| -> [Point; 4] { curve.control.each_ref().map(flat) })
            .collect(),
        closed: line.closed,
    };
    Some(Picture {
        title: report.label.clone(),
        values: lines.levels.clone(),
        mesh: edges,
        outline,
        lines: lines.lines.iter().map(coloured).collect(),
    })
}

/// The directions to the right and up, in the plane at right angles to the mesh's
/// mean normal, which is taken to point at the viewer.
fn view_axes(mesh: &TriangleMesh) -> [Vector; 2] {
    let normal: Vector = (0..mesh.triangles().len())
        .map(|triangle| {
            let [a, b, c] = mesh.corners(triangle);
            (b - a).cross(&(c - a))
        })
        .filter(|normal| normal.iter().all(|x| x.is_finite()))
        .sum();
    // closed surfaces have no mean normal, and mirrored meshes a negative one:
    // both are seen from above
    let size = mesh.diagonal().powi(2);
    if normal.norm() <= 1e-6 * size || normal.xy().norm() <= 1e-6 * normal.z.abs() {
        return [Vector::x(), Vector::y()];
    }
    plane_axes(&normal)
}

/// Every edge once.
fn inner_edges(mesh: &TriangleMesh) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = mesh
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
