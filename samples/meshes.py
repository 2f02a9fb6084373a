"""Gmsh meshes of the unit square for table 5.7 of the DEI thesis: 900, 1600 and 2500 points.

The mesh size is searched for the count of points closest to each target. Every file carries the
exact values and gradients of the fourth test problem (see problem4.py) at its points.

Point arrays: u, gradient (3 components).
"""

from __future__ import annotations

from pathlib import Path

import common
import numpy as np
import problem4
from common import TriangleMesh

OUTPUT = Path(__file__).parent.parent / "tests" / "data"
TARGETS = (900, 1600, 2500)
EQUILATERAL = np.sqrt(2.0 / np.sqrt(3.0))
"""Edge length times the root of the count of points in a large mesh of equilateral triangles."""
STEPS = 3
"""How often the first guess is corrected by the count that it gives."""
NEARBY = np.linspace(0.985, 1.015, 21)
"""Multiples of the corrected guess that are tried."""


def closest_mesh(target: int) -> TriangleMesh:
    """The mesh of the unit square whose count of points is closest to the target."""
    size = EQUILATERAL / np.sqrt(target)
    for _ in range(STEPS):
        size *= np.sqrt(count_points(size) / target)
    best = min(size * NEARBY, key=lambda tried: abs(count_points(tried) - target))
    return problem4.square_mesh(best)


def count_points(size: float) -> int:
    """The count of points of a mesh of the unit square."""
    return len(problem4.square_mesh(size).points)


def file_name(target: int) -> str:
    """The name of the file with about `target` points."""
    return f"problem4_{target}.vtu"


def main(output: Path = OUTPUT) -> None:
    """Write the meshes into the folder `output`."""
    for target in TARGETS:
        mesh = closest_mesh(target)
        point_data = {
            "u": problem4.solution(mesh.points),
            "gradient": problem4.gradient(mesh.points),
        }
        common.write_meshio(output / file_name(target), mesh, point_data, compression="zlib")


if __name__ == "__main__":
    common.command_line(main, OUTPUT, __doc__)
