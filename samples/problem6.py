"""The sixth test problem of the DEI thesis: a solid, in closed form.

    uxx + uyy + uzz = 6 x (y^3 - y^2) (z^2 + 1) + (x^3 - x) (6 y - 2) (z^2 + 1)
                      + 2 (x^3 - x) (y^3 - y^2)                            on [0, 1]^3,

whose solution is u = (x^3 - x) (y^3 - y^2) (z^2 + 1). The file carries exact values and gradients
at the points of the grid of the thesis' figure 5.12, 8 a side, each cube cut into six tetrahedra.

Point arrays: u, gradient (3 components).
"""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

import meshio
import numpy as np
from common import Array, Indices, command_line, rounded

OUTPUT = Path(__file__).with_suffix(".vtu")
POINTS_PER_SIDE = 8


def solution(points: Array) -> Array:
    """u (N,) at points (N, 3)."""
    x, y, z = points.T
    return (x**3 - x) * (y**3 - y**2) * (z**2 + 1.0)


def gradient(points: Array) -> Array:
    """The gradient (N, 3) of u at points (N, 3)."""
    x, y, z = points.T
    ux = (3.0 * x**2 - 1.0) * (y**3 - y**2) * (z**2 + 1.0)
    uy = (x**3 - x) * (3.0 * y**2 - 2.0 * y) * (z**2 + 1.0)
    uz = (x**3 - x) * (y**3 - y**2) * 2.0 * z
    return np.column_stack([ux, uy, uz])


def right_hand_side(points: Array) -> Array:
    """The PDE's right-hand side (N,), as the thesis states it."""
    x, y, z = points.T
    return (
        6.0 * x * (y**3 - y**2) * (z**2 + 1.0)
        + (x**3 - x) * (6.0 * y - 2.0) * (z**2 + 1.0)
        + 2.0 * (x**3 - x) * (y**3 - y**2)
    )


def grid(side: int) -> tuple[Array, Indices]:
    """Points (N, 3) of a regular grid of the unit cube, `side` along each edge, and tetrahedra.

    Each cube is cut into six along its diagonal: from corner to corner along the axes, in every
    order, so that neighbours agree.
    """
    axis = np.arange(side) / (side - 1.0)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(side**3).reshape(side, side, side)
    first = number[:-1, :-1, :-1].ravel()
    steps = [side**2, side, 1]
    cells = []
    for order in permutations(range(3)):
        corners = np.cumsum([0] + [steps[axis] for axis in order])
        is_even = np.linalg.det(np.eye(3)[list(order)]) > 0.0
        cells.append(first[:, None] + corners[[0, 1, 2, 3] if is_even else [0, 2, 1, 3]])
    return points, np.concatenate(cells)


def main(output: Path = OUTPUT) -> None:
    """Write the sample."""
    points, tetrahedra = grid(POINTS_PER_SIDE)
    data = {"u": solution(points), "gradient": gradient(points)}
    mesh = meshio.Mesh(points, [("tetra", tetrahedra)], point_data=rounded(data))
    meshio.vtu.write(output, mesh, binary=True, compression="zlib")


if __name__ == "__main__":
    command_line(main, OUTPUT, __doc__)
