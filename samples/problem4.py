"""The fourth test problem of the DEI thesis: two crossing ridges with a peak, in closed form.

    uxx + uyy = -100 A + (50 - 100 x) ux - 150 A B - 75 B + (50 - 100 y) uy   on [0, 1]^2,
    A = exp(-(5 - 10 x)^2 / 2),  B = exp(-(5 - 10 y)^2 / 2),

whose solution is u = A + 0.75 B + 0.75 A B (equation 5.1); its values on the boundary are its
Dirichlet conditions. The file carries exact values and gradients at the vertices of a mesh so
coarse that linear contours are kinked.

Point arrays: u (active), gradient (3 components), laplacian (the PDE's right-hand side).
Cell arrays: area, region (quadrant of the centroid: 0 lower left, 1 lower right, 2 upper left,
3 upper right), error_of_linear (greatest |u - linear interpolant| over sample points of the cell).
"""

from __future__ import annotations

from pathlib import Path

import common
import gmsh
import numpy as np
from common import Array, Indices, TriangleMesh

OUTPUT = Path(__file__).with_suffix(".vtu")
SIZE = 0.057
SAMPLES_PER_SIDE = 8


def bell(t: Array) -> Array:
    """exp(-(5 - 10 t)^2 / 2): both A and B."""
    return np.exp(-((5.0 - 10.0 * t) ** 2) / 2.0)


def bell_slope(t: Array) -> Array:
    """The derivative of `bell`."""
    return 10.0 * (5.0 - 10.0 * t) * bell(t)


def bell_curvature(t: Array) -> Array:
    """The second derivative of `bell`."""
    return 100.0 * ((5.0 - 10.0 * t) ** 2 - 1.0) * bell(t)


def solution(points: Array) -> Array:
    """u (N,) at points (N, 2 or more)."""
    a, b = bell(points[:, 0]), bell(points[:, 1])
    return a + 0.75 * b + 0.75 * a * b


def gradient(points: Array) -> Array:
    """The gradient (N, 3) of u at points (N, 2 or more); its z component is zero."""
    x, y = points[:, 0], points[:, 1]
    ux = bell_slope(x) * (1.0 + 0.75 * bell(y))
    uy = 0.75 * bell_slope(y) * (1.0 + bell(x))
    return np.column_stack([ux, uy, np.zeros_like(ux)])


def laplacian(points: Array) -> Array:
    """uxx + uyy (N,) at points (N, 2 or more)."""
    x, y = points[:, 0], points[:, 1]
    return bell_curvature(x) * (1.0 + 0.75 * bell(y)) + 0.75 * bell_curvature(y) * (1.0 + bell(x))


def right_hand_side(points: Array) -> Array:
    """The PDE's right-hand side (N,) with the solution put in, as the thesis states it."""
    a, b = bell(points[:, 0]), bell(points[:, 1])
    slope = ((50.0 - 100.0 * points[:, :2]) * gradient(points)[:, :2]).sum(axis=1)
    return -100.0 * a - 150.0 * a * b - 75.0 * b + slope


def square_mesh(size: float) -> TriangleMesh:
    """A mesh of the unit square with edges about as long as `size`."""
    return common.generate(_add_square, size)


def _add_square() -> None:
    gmsh.model.occ.addRectangle(0.0, 0.0, 0.0, 1.0, 1.0)
    gmsh.model.occ.synchronize()


def error_of_linear(points: Array, triangles: Indices) -> Array:
    """Greatest error (M,) of the linear interpolant over a lattice of points in each triangle."""
    n = SAMPLES_PER_SIDE
    lattice = [(i / n, j / n, (n - i - j) / n) for i in range(n + 1) for j in range(n + 1 - i)]
    worst = np.zeros(len(triangles))
    for weights in lattice:
        there = np.einsum("k,mkd->md", weights, points[triangles])
        linear = solution(points)[triangles] @ weights
        worst = np.maximum(worst, np.abs(solution(there) - linear))
    return worst


def quadrants(mesh: TriangleMesh) -> Indices:
    """The quadrant (M,) of each triangle's centroid, 0 to 3."""
    right, upper = (common.centroids(mesh)[:, axis] > 0.5 for axis in (0, 1))
    return right.astype(np.int64) + 2 * upper.astype(np.int64)


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    mesh = square_mesh(SIZE)
    points = mesh.points
    common.write_vtk(
        output,
        mesh,
        {"u": solution(points), "gradient": gradient(points), "laplacian": laplacian(points)},
        {
            "area": common.areas(mesh),
            "region": quadrants(mesh),
            "error_of_linear": error_of_linear(points, mesh.triangles),
        },
        active="u",
        field_data={"TimeValue": np.array([0.0])},
        mode="appended",
        compressor="none",
    )


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
