//! Quadratic solids without nodes inside their faces, cut at their mid nodes.
//!
//! Each face is cut into a polygon of its mid nodes and a triangle at each corner.
//! The solid falls into a pyramid at each corner and what is left between the mid
//! nodes; all of these are convex where the edges are straight.

use super::convex_solid::{ConvexSolid, Key};

/// A quadratic solid as loops of corners and mid nodes, and room to cut it up.
#[derive(Debug, Default)]
pub struct CornerCut {
    /// At a corner of a face: the corner, the mid node before, the one after.
    wedges: Vec<[Key; 3]>,
    /// The edges of one face that have not collapsed: corner and mid node.
    edges: Vec<[Key; 2]>,
    /// What is left between the mid nodes.
    middle: ConvexSolid,
    /// The pyramid at a corner.
    pyramid: ConvexSolid,
    /// The mid nodes around a corner.
    around: Vec<Key>,
}

impl CornerCut {
    /// Takes all faces away.
    pub fn clear(&mut self) {
        self.wedges.clear();
        self.middle.clear();
    }

    /// Adds a face: corner, mid node, corner, and so on, counter-clockwise from
    /// outside. An edge whose ends are the same point has collapsed.
    pub fn push_face(&mut self, face: impl IntoIterator<Item = Key>) {
        let mut nodes = face.into_iter();
        self.edges.clear();
        while let (Some(corner), Some(mid)) = (nodes.next(), nodes.next()) {
            self.edges.push([corner, mid]);
        }
        self.drop_collapsed();
        if self.edges.len() < 3 {
            return;
        }
        self.middle.push_face(self.edges.iter().map(|&[_, mid]| mid));
        for (place, &[corner, after]) in self.edges.iter().enumerate() {
            let [_, before] = self.edges[(place + self.edges.len() - 1) % self.edges.len()];
            self.wedges.push([corner, before, after]);
        }
    }

    /// Removes edges whose ends are the same point.
    fn drop_collapsed(&mut self) {
        let Some(&[first, _]) = self.edges.first() else { return };
        let mut kept = 0;
        for place in 0..self.edges.len() {
            let next = self.edges.get(place + 1).map_or(first, |&[corner, _]| corner);
            if self.edges[place][0].point() != next.point() {
                self.edges[kept] = self.edges[place];
                kept += 1;
            }
        }
        self.edges.truncate(kept);
    }

    /// Adds the solid's tetrahedra; false if its faces do not close.
    pub fn cut(&mut self, tetrahedra: &mut Vec<[u32; 4]>) -> bool {
        // the faces around one corner side by side
        self.wedges.sort_unstable_by_key(|[corner, ..]| corner.point());
        let mut closed = true;
        for wedges in self.wedges.chunk_by(|a, b| a[0].point() == b[0].point()) {
            closed &= go_around(wedges, &mut self.around);
            self.pyramid.clear();
            for &[corner, before, after] in wedges {
                self.pyramid.push_face([before, corner, after]);
            }
            self.pyramid.push_face(self.around.iter().copied());
            self.pyramid.cut(tetrahedra);
            self.middle.push_face(self.around.iter().rev().copied());
        }
        self.middle.cut(tetrahedra);
        closed
    }
}

/// The mid nodes around a corner, from each face to the next; false if that does
/// not lead back.
fn go_around(wedges: &[[Key; 3]], around: &mut Vec<Key>) -> bool {
    around.clear();
    let [_, first, mut last] = wedges[0];
    around.push(first);
    while last.point() != first.point() && around.len() < wedges.len() {
        around.push(last);
        let next = wedges.iter().find(|[_, before, _]| before.point() == last.point());
        let Some(&[_, _, after]) = next else { return false };
        last = after;
    }
    last.point() == first.point() && around.len() == wedges.len()
}
