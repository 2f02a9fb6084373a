"""Heat in a thin closed shell, a torus, between two flames and two jets of cold air.

    lap_S u = 4 u - f   on the torus with radii 1 and 0.45 (no boundary),

where lap_S is the Laplace-Beltrami operator of the surface and
f = sum of s exp(-|x - c|^2 / 0.1) over the four spots

    flame  c = ( 1.35,  0.00,  0.28)  s =  60
    flame  c = (-0.60,  1.00,  0.40)  s =  45
    jet    c = (-0.10, -1.10,  0.44)  s = -50
    jet    c = (-1.00,  0.10, -0.40)  s = -30

heats and cools it; 4 u is the heat lost to the air. Solved with cubic elements on the exact torus
(each triangle is projected onto it) and written as flat triangles, with the values and the
tangential gradients (area-weighted means) at the vertices.

Point arrays: u (active), gradient (3 components, tangent to the torus), normal (unit, outward).
Cell arrays: area (of the flat triangle).
"""

from __future__ import annotations

from pathlib import Path

import common
import gmsh
import numpy as np
from common import Array, TriangleMesh
from skfem import Basis, BilinearForm, LinearForm, MeshTri1, solve
from skfem.mapping import Mapping

OUTPUT = Path(__file__).with_suffix(".vtu")
SIZE = 0.19
MAJOR, MINOR = 1.0, 0.45
LOSS = 4.0
SPOT_AREA = 0.1
SPOTS = (
    ((1.35, 0.0, 0.28), 60.0),
    ((-0.6, 1.0, 0.4), 45.0),
    ((-0.1, -1.1, 0.44), -50.0),
    ((-1.0, 0.1, -0.4), -30.0),
)


def torus_mesh() -> TriangleMesh:
    """Flat triangles with vertices on the torus."""
    mesh = common.generate(_add_torus, SIZE)
    return TriangleMesh(project(mesh.points.T).T, mesh.triangles)


def _add_torus() -> None:
    gmsh.model.occ.addTorus(0.0, 0.0, 0.0, MAJOR, MINOR)
    gmsh.model.occ.synchronize()


def project(x: Array) -> Array:
    """The points of the torus closest to points (3, ...)."""
    core = core_circle(x)
    arm = x - core
    return core + MINOR * arm / np.linalg.norm(arm, axis=0)


def core_circle(x: Array) -> Array:
    """The points of the torus' core circle closest to points (3, ...)."""
    core = np.zeros_like(x)
    core[:2] = MAJOR * x[:2] / np.hypot(x[0], x[1])
    return core


def projection_slope(x: Array) -> Array:
    """The derivative (3, 3, ...) of `project` at points (3, ...)."""
    identity = np.eye(3).reshape(3, 3, *[1] * (x.ndim - 1))
    flat = identity * np.array([1.0, 1.0, 0.0]).reshape(3, *[1] * x.ndim)
    radius = np.hypot(x[0], x[1])
    radial = np.stack([x[0], x[1], np.zeros_like(x[0])]) / radius
    core_slope = MAJOR / radius * (flat - radial[:, None] * radial[None, :])
    arm = x - core_circle(x)
    length = np.linalg.norm(arm, axis=0)
    normal = arm / length
    across = identity - normal[:, None] * normal[None, :]
    turned = np.einsum("ij...,jk...->ik...", across, identity - core_slope)
    return core_slope + MINOR / length * turned


def normals(points: Array) -> Array:
    """Outward unit normals (N, 3) at points (N, 3) of the torus."""
    return ((points.T - core_circle(points.T)) / MINOR).T


class TorusMapping(Mapping):
    """From the reference triangle to the torus: to the flat triangle, then to the closest point.

    scikit-fem's own mappings are between spaces of one dimension. This one has a 3 x 2 slope, for
    whose inverse its pseudo-inverse stands: it gives tangential gradients.
    """

    def __init__(self, elements: MeshTri1):
        """`elements` have their vertices (3, N) on the torus."""
        self.corners = elements.p[:, elements.t]  # (3, corners, cells)

    def _flat(self, X: Array, tind: Array | None) -> tuple[Array, Array]:
        """Points (3, cells, points) of the flat triangles and the slope (3, 2, cells)."""
        corners = self.corners if tind is None else self.corners[:, :, tind]
        slope = corners[:, 1:] - corners[:, :1]
        return corners[:, 0, :, None] + np.einsum("dkc,kq->dcq", slope, X), slope

    def F(self, X: Array, tind: Array | None = None) -> Array:
        """Points (3, cells, points) of the torus for reference points X (2, points)."""
        return project(self._flat(X, tind)[0])

    def DF(self, X: Array, tind: Array | None = None) -> Array:
        """The slope (3, 2, cells, points) of `F`."""
        flat, slope = self._flat(X, tind)
        return np.einsum("ijcq,jkc->ikcq", projection_slope(flat), slope)

    def _metric(self, slope: Array) -> Array:
        """The first fundamental form (cells, points, 2, 2)."""
        return np.einsum("dicq,djcq->cqij", slope, slope)

    def detDF(self, X: Array, tind: Array | None = None) -> Array:
        """Surface per area of the reference triangle (cells, points)."""
        return np.sqrt(np.linalg.det(self._metric(self.DF(X, tind))))

    def invDF(self, X: Array, tind: Array | None = None) -> Array:
        """The pseudo-inverse (2, 3, cells, points) of the slope."""
        slope = self.DF(X, tind)
        return np.einsum("cqij,djcq->idcq", np.linalg.inv(self._metric(slope)), slope)


@BilinearForm
def operator(u, v, _):
    """grad u . grad v + LOSS u v."""
    return (u.grad * v.grad).sum(axis=0) + LOSS * u * v


@LinearForm
def heating(v, w):
    """f v, with f the sum over the spots."""
    return source(w.x) * v


def source(x: Array) -> Array:
    """f at points (3, ...)."""
    total = np.zeros(x.shape[1:])
    for centre, strength in SPOTS:
        away = x - np.reshape(centre, (3, *[1] * (x.ndim - 1)))
        total += strength * np.exp(-(away**2).sum(axis=0) / SPOT_AREA)
    return total


def torus_basis(mesh: TriangleMesh, refinements: int = 0) -> Basis:
    """Cubic elements on the torus, halved `refinements` times."""
    elements = MeshTri1(mesh.points.T.copy(), mesh.triangles.T.copy())
    for _ in range(refinements):
        elements = elements.refined()
        elements = MeshTri1(project(elements.p), elements.t)
    return common.cubic_basis(elements, mapping=TorusMapping(elements))


def temperature(mesh: TriangleMesh, refinements: int = 0) -> tuple[Array, Array]:
    """Temperature (N,) and its tangential gradient (N, 3) at the vertices of the mesh."""
    basis = torus_basis(mesh, refinements)
    u = solve(operator.assemble(basis), heating.assemble(basis))
    values, gradients = common.vertex_data(basis, u, len(mesh.points))
    normal = normals(mesh.points)
    return values, gradients - (gradients * normal).sum(axis=1, keepdims=True) * normal


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    mesh = torus_mesh()
    u, gradient = temperature(mesh)
    common.write_vtk(
        output,
        mesh,
        {"u": u, "gradient": gradient, "normal": normals(mesh.points)},
        {"area": common.areas(mesh)},
        active="u",
        field_data={"TimeValue": np.array([0.0])},
        mode="appended",
        compressor="lz4",
        header_bits=32,
    )


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
