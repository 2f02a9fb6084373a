"""The README's picture: VTK's contour and ours, on the same coarse mesh.

    python samples/against_vtk.py PROGRAM [--output FILE]

PROGRAM is the command line `vtu2contour`. Needs pyvista and matplotlib.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.collections import LineCollection
from PIL import Image

HERE = Path(__file__).resolve().parent
SOURCE = HERE / "islands.vtu"
LEVELS = np.linspace(-1.16, 0.88, 18)
WINDOW = (-2.03, 0.02, -1.03, 1.03)  # the left half of the drum: x and y from, to


def ours(program: Path) -> pyvista.PolyData:
    """Our contour lines at the levels."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "lines.vtp"
        levels = ",".join(f"{level:.6f}" for level in LEVELS)
        subprocess.run([program, SOURCE, "-o", output, f"--value={levels}"], check=True)
        return pyvista.read(output)


def segments(lines: pyvista.PolyData):
    """Ends of all segments, shape (n, 2, 2), and their levels, shape (n,)."""
    pairs, place = [], 0
    while place < len(lines.lines):
        size = lines.lines[place]
        points = lines.lines[place + 1 : place + 1 + size]
        pairs.append(np.stack([points[:-1], points[1:]], axis=1))
        place += 1 + size
    pairs = np.concatenate(pairs)
    return lines.points[pairs][:, :, :2], lines.point_data["u"][pairs[:, 0]]


def draw(axes, grid: pyvista.UnstructuredGrid, lines: pyvista.PolyData, title: str) -> None:
    """Draws lines over their mesh."""
    triangles = grid.cells_dict[pyvista.CellType.TRIANGLE]
    axes.triplot(*grid.points[:, :2].T, triangles, color="0.85", linewidth=0.6, zorder=1)
    ends, levels = segments(lines)
    axes.add_collection(
        LineCollection(ends, array=levels, cmap="viridis", linewidth=1.4, capstyle="round")
    )
    axes.set_title(title, fontsize=12, loc="left")
    axes.set_xlim(WINDOW[:2])
    axes.set_ylim(WINDOW[2:])
    axes.set_aspect("equal")
    axes.axis("off")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="the command line vtu2contour")
    parser.add_argument("--output", type=Path, default=HERE / "against_vtk.png")
    arguments = parser.parse_args()
    grid = pyvista.read(SOURCE)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5.9), layout="constrained")
    draw(left, grid, grid.contour(list(LEVELS), scalars="u"), "VTK's contour filter")
    draw(right, grid, ours(arguments.program), "vtu2contour, same mesh and data")
    figure.savefig(arguments.output, dpi=90)
    with Image.open(arguments.output) as picture:
        picture.convert("RGB").quantize(64).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
