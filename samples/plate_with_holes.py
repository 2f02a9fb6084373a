"""Heat in a plate with three holes: a hot pipe, an insulated hole and a cold pipe.

    uxx + uyy = -6   on [0, 2] x [0, 1.2] without three discs,

a Poisson problem: the plate is heated evenly, and its rim is held at u = 0. The rims of the
holes, from left to right:

    hot pipe        centre (0.50, 0.66)  radius 0.20   u = 1
    insulated hole  centre (1.08, 0.45)  radius 0.17   du/dn = 0
    cold pipe       centre (1.56, 0.72)  radius 0.16   u = 0

Solved with cubic elements on a coarse mesh, those on a hole's rim curved (six-node geometry), and
written as linear triangles with the values and the area-weighted mean gradients at the vertices.

Point arrays: u, grad_u (3 components).
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import NamedTuple

import common
import gmsh
import numpy as np
from common import Array, Indices, TriangleMesh
from skfem import Basis, condense, solve
from skfem.models.poisson import laplace, unit_load

OUTPUT = Path(__file__).with_suffix(".vtu")
SIZE = 0.085
WIDTH, HEIGHT = 2.0, 1.2
HEATING = 6.0


class Hole(NamedTuple):
    """A disc cut out of the plate; `value` is u on its rim, None where it is insulated."""

    x: float
    y: float
    radius: float
    value: float | None

    def distance(self, points: Array) -> Array:
        """Distances (K,) of points (2, K) from the centre."""
        return np.hypot(points[0] - self.x, points[1] - self.y)


HOLES = (
    Hole(0.50, 0.66, 0.20, 1.0),
    Hole(1.08, 0.45, 0.17, None),
    Hole(1.56, 0.72, 0.16, 0.0),
)


def plate_mesh() -> TriangleMesh:
    """The mesh of the plate, with straight edges."""
    return common.generate(_add_plate, SIZE)


def _add_plate() -> None:
    occ = gmsh.model.occ
    plate = occ.addRectangle(0.0, 0.0, 0.0, WIDTH, HEIGHT)
    discs = [(2, occ.addDisk(hole.x, hole.y, 0.0, hole.radius, hole.radius)) for hole in HOLES]
    occ.cut([(2, plate)], discs)
    occ.synchronize()


def near_hole(hole: Hole, points: Array) -> Array:
    """Which of some points (2, K) of the boundary belong to a hole: within half a radius of it."""
    return hole.distance(points) < 1.5 * hole.radius


def snap(points: Array) -> Array:
    """Points (2, K) of the boundary, those near a hole moved radially onto its circle."""
    points = points.copy()
    for hole in HOLES:
        near = near_hole(hole, points)
        centre = np.array([[hole.x], [hole.y]])
        scale = hole.radius / hole.distance(points[:, near])
        points[:, near] = centre + (points[:, near] - centre) * scale
    return points


def temperature(mesh: TriangleMesh, refinements: int = 0) -> tuple[Array, Array]:
    """Temperature (N,) and its gradient (N, 3) at the vertices of the mesh.

    The elements are halved `refinements` times before the problem is solved.
    """
    basis = common.cubic_basis(common.planar_elements(mesh, snap, refinements))
    values, fixed = boundary_values(basis)
    load = HEATING * unit_load.assemble(basis)
    u = solve(*condense(laplace.assemble(basis), load, x=values, D=fixed))
    return common.vertex_data(basis, u, len(mesh.points))


def boundary_values(basis: Basis) -> tuple[Array, Indices]:
    """A vector of the prescribed values, and the degrees of freedom for which they hold."""
    values = basis.zeros()
    rim = rim_dofs(basis)
    fixed = [rim[None]]
    for hole in HOLES:
        if hole.value is not None:
            values[rim[hole]] = hole.value
            fixed.append(rim[hole])
    return values, np.unique(np.concatenate(fixed))


def rim_dofs(basis: Basis) -> dict[Hole | None, Indices]:
    """The degrees of freedom on each hole's rim and, under None, on the plate's."""
    facets = {
        hole: basis.mesh.facets_satisfying(partial(near_hole, hole), boundaries_only=True)
        for hole in HOLES
    }
    inner = np.concatenate(list(facets.values()))
    facets[None] = np.setdiff1d(basis.mesh.boundary_facets(), inner)
    return {where: basis.get_dofs(found).all() for where, found in facets.items()}


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    mesh = plate_mesh()
    u, gradient = temperature(mesh)
    common.write_meshio(output, mesh, {"u": u, "grad_u": gradient}, compression="zlib")


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
