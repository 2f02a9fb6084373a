"""Current through an L-shaped conductor: a solution without gradients, singular at a corner.

    uxx + uyy = 0   on [0, 2]^2 without [1, 2]^2,
    u = 1 on the upper electrode (0 < x < 1, y = 2),
    u = 0 on the right electrode (x = 2, 0 < y < 1),
    du/dn = 0 on the rest of the boundary.

u is the electric potential (volts); its contours fan out around the re-entrant corner (1, 1),
where the gradient is infinite like r^(-1/3). The conductor's resistance is that of 2.5585 squares
in series. The mesh is finer at the corner. The file has no gradients: they are to be recovered.

Solved with cubic elements on a mesh halved twice, so that the singularity does not spoil the
values at the vertices, and written in single precision.

Point arrays: u.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import common
import gmsh
import numpy as np
from common import Array, TriangleMesh
from skfem import Basis, condense, solve
from skfem.models.poisson import laplace

OUTPUT = Path(__file__).with_suffix(".vtu")
SIZE = 0.15
SIZE_AT_CORNER = 0.03
REFINEMENTS = 2
TOLERANCE = 1e-9

Side = Callable[[Array], Array]
"""Which of some points (2, K) of the boundary belong to a part of it."""


def conductor_mesh() -> TriangleMesh:
    """The mesh of the L, finer at the re-entrant corner."""
    return common.generate(_add_conductor)


def _add_conductor() -> None:
    geo = gmsh.model.geo
    corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
    p = [geo.addPoint(x, y, 0.0, SIZE_AT_CORNER if x == y == 1.0 else SIZE) for x, y in corners]
    lines = [geo.addLine(p[i - 1], p[i]) for i in range(len(p))]
    geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()


def upper_electrode(x: Array) -> Array:
    """The end of the vertical arm."""
    return x[1] > 2.0 - TOLERANCE


def right_electrode(x: Array) -> Array:
    """The end of the horizontal arm."""
    return x[0] > 2.0 - TOLERANCE


def inner_sides(x: Array) -> Array:
    """The two sides that meet in the re-entrant corner."""
    right = (np.abs(x[0] - 1.0) < TOLERANCE) & (x[1] > 1.0 - TOLERANCE)
    upper = (np.abs(x[1] - 1.0) < TOLERANCE) & (x[0] > 1.0 - TOLERANCE)
    return right | upper


def outer_sides(x: Array) -> Array:
    """The two sides that meet in the origin."""
    return (x[0] < TOLERANCE) | (x[1] < TOLERANCE)


def conductor_basis(mesh: TriangleMesh, refinements: int = REFINEMENTS) -> Basis:
    """Cubic elements on the mesh, halved `refinements` times."""
    return common.cubic_basis(common.planar_elements(mesh, refinements=refinements))


def potential(basis: Basis, one: Side, zero: Side) -> tuple[float, Array]:
    """Energy and degrees of freedom of the potential with u = 1 on one side, 0 on the other.

    The energy, the integral of |grad u|^2, is the conductance between the two sides.
    """
    stiffness = laplace.assemble(basis)
    live, ground = (
        basis.get_dofs(basis.mesh.facets_satisfying(side, boundaries_only=True)).all()
        for side in (one, zero)
    )
    values = basis.zeros()
    values[live] = 1.0
    u = solve(*condense(stiffness, x=values, D=np.concatenate([live, ground])))
    return float(u @ stiffness @ u), u


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    mesh = conductor_mesh()
    basis = conductor_basis(mesh)
    _, u = potential(basis, upper_electrode, right_electrode)
    values, _ = common.vertex_data(basis, u, len(mesh.points))
    common.write_meshio(
        output,
        mesh,
        {"u": values.astype(np.float32)},
        compression=None,
        precision=np.float32,
    )


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
