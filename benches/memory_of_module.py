"""Peak memory of contouring a million tetrahedra from NumPy arrays, beside that of its arrays.

Run with the module built for release: ``python benches/memory_of_module.py [int32|int64]``.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import vtu2contour as vc


def megabytes(name: str) -> float:
    """A figure of this process's memory: VmRSS now, or VmHWM, the peak."""
    status = Path("/proc/self/status").read_text()
    return int(re.search(rf"{name}:\s+(\d+)", status)[1]) / 1024


def cube(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of the unit cube and 6 n^3 tetrahedra, as int32."""
    line = np.linspace(0, 1, n + 1)
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    i, j, k = np.meshgrid(*3 * [np.arange(n, dtype=np.int32)], indexing="ij")
    corner = ((i * (n + 1) + j) * (n + 1) + k).ravel().astype(np.int32)
    steps = np.array([(n + 1) ** 2, n + 1, 1], np.int32)
    tetrahedra = []
    for a, b, c in [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]:
        path = np.cumsum([0, steps[a], steps[b], steps[c]]).astype(np.int32)
        tetrahedra.append(corner[:, None] + path)
    return points, np.concatenate(tetrahedra)


def main() -> None:
    small_points, small_cells = cube(2)
    slope = np.zeros_like(small_points) + [1, 0, 0]
    vc.contour_arrays(small_points, small_cells, small_points[:, 0], slope, [0.3])
    # threads and their stacks are there now
    points, cells = cube(55)
    cells = cells.astype(sys.argv[1] if len(sys.argv) > 1 else np.int32)
    u = np.linalg.norm(points - 0.5, axis=1)
    grad = (points - 0.5) / np.maximum(u, 1e-9)[:, None]
    size = sum(a.nbytes for a in (points, cells, u, grad)) / 2**20
    print(f"{len(cells)} tetrahedra ({cells.dtype}), input {size:.1f} MiB")

    surface, peak, _ = measured(lambda: vc.contour_arrays(points, cells, u, grad, [0.3]))
    arrays = (surface.points, surface.values, surface.triangles, surface.cells)
    output = sum(a.nbytes for a in arrays) / 2**20
    print(f"output {output:.1f} MiB: {len(surface.triangles)} triangles")

    def tell(what: str, peak: float, output: float) -> None:
        whole = (size + peak - output) / size
        print(
            f"{what}: {peak:.1f} MiB above the input; with it, less the output, {whole:.2f} of it"
        )

    tell("contoured once, peak", peak, output)
    f, peak, kept = measured(lambda: vc.Interpolant(points, cells, u, grad))
    tell("interpolant, peak", peak, 0)
    tell("interpolant, kept", kept, 0)
    _, peak, _ = measured(lambda: f.contour([0.3]))
    tell("contoured again, peak", kept + peak, output)


def measured(job: Callable[[], Any]) -> tuple[Any, float, float]:
    """What a job makes, and by how many megabytes memory grows: at most, and in the end. What of
    programs is read in meanwhile does not count.
    """
    before, programs = megabytes("VmRSS"), megabytes("RssFile")
    Path("/proc/self/clear_refs").write_text("5")  # the peak is counted from here
    made = job()
    before += megabytes("RssFile") - programs
    return made, megabytes("VmHWM") - before, megabytes("VmRSS") - before


if __name__ == "__main__":
    main()
