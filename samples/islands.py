"""A vibrating drum in the shape of a stadium: islands, saddles and nearly closed rings.

    uxx + uyy = -k2 u   inside,   u = 0 on the rim,   k2 = 84.39...

The stadium is the square [-1, 1]^2 with half discs of radius 1 at its left and right ends; the mode
is the only one with an eigenvalue within 2 of 84.4. It is even in x and in y, scaled to a unit
integral of u^2 and to a positive integral of u. With four edges to a wavelength the mesh is so
coarse that some of the islands near the extrema lie inside a few cells or a single one, where
linear contours lose them: see the levels in README.md.

Solved with quartic elements, those on the rim curved (six-node geometry), and written as linear
triangles with the values and the area-weighted mean gradients at the vertices.

Point arrays: u (active), Gradients (3 components). Field data: k2, TimeValue.
"""

from __future__ import annotations

from pathlib import Path

import common
import gmsh
import numpy as np
from common import Array, TriangleMesh
from scipy.sparse.linalg import eigsh
from skfem import Basis, Element, ElementTriP4
from skfem.models.poisson import laplace, mass, unit_load

OUTPUT = Path(__file__).with_suffix(".vtu")
SIZE = 0.165
HALF_LENGTH = 1.0
RADIUS = 1.0
QUARTIC = ElementTriP4()
NEAR = 84.4
"""The eigenvalue is the one nearest this."""


def drum_mesh() -> TriangleMesh:
    """The mesh of the stadium, with straight edges."""
    return common.generate(_add_stadium, SIZE)


def _add_stadium() -> None:
    occ = gmsh.model.occ
    a, r = HALF_LENGTH, RADIUS
    rim = [(-a, -r), (a, -r), (a + r, 0.0), (a, r), (-a, r), (-a - r, 0.0)]
    p = [occ.addPoint(x, y, 0.0) for x, y in rim]
    right, left = occ.addPoint(a, 0.0, 0.0), occ.addPoint(-a, 0.0, 0.0)
    loop = [
        occ.addLine(p[0], p[1]),
        occ.addCircleArc(p[1], right, p[2]),
        occ.addCircleArc(p[2], right, p[3]),
        occ.addLine(p[3], p[4]),
        occ.addCircleArc(p[4], left, p[5]),
        occ.addCircleArc(p[5], left, p[0]),
    ]
    occ.addPlaneSurface([occ.addCurveLoop(loop)])
    occ.synchronize()


def snap(points: Array) -> Array:
    """Points (2, K) of the boundary, those of the ends moved radially onto their circles."""
    centre = np.zeros_like(points)
    centre[0] = np.clip(points[0], -HALF_LENGTH, HALF_LENGTH)
    arm = points - centre
    return centre + RADIUS * arm / np.hypot(*arm)


def drum_basis(mesh: TriangleMesh, refinements: int = 0, element: Element = QUARTIC) -> Basis:
    """Elements, quartic unless told otherwise, on the mesh halved `refinements` times."""
    elements = common.planar_elements(mesh, snap, refinements)
    return Basis(elements, element, intorder=2 * element.maxdeg + 2)


def mode(basis: Basis) -> tuple[float, Array]:
    """The eigenvalue nearest NEAR and its mode at the degrees of freedom."""
    stiffness, masses = laplace.assemble(basis), mass.assemble(basis)
    inside = basis.complement_dofs(basis.get_dofs())
    values, vectors = eigsh(
        stiffness[inside][:, inside].tocsc(),
        k=1,
        M=masses[inside][:, inside].tocsc(),
        sigma=NEAR,
        v0=np.ones(len(inside)),
    )
    u = basis.zeros()
    u[inside] = vectors[:, 0]
    return float(values[0]), u * np.sign(unit_load.assemble(basis) @ u) / np.sqrt(u @ masses @ u)


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    mesh = drum_mesh()
    basis = drum_basis(mesh)
    k2, u = mode(basis)
    values, gradients = common.vertex_data(basis, u, len(mesh.points))
    common.write_vtk(
        output,
        mesh,
        {"u": values, "Gradients": gradients},
        active="u",
        field_data={"k2": np.array([k2]), "TimeValue": np.array([0.0])},
        mode="ascii",
    )


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
