"""The README's picture of surfaces, and the thesis' figure 5.15: VTK's contour and ours.

    python samples/surfaces_against_vtk.py PROGRAM [--output FILE]

The sixth test problem on 8 points a side, at the level 0.07: VTK's contour filter, and ours with 2,
3 and 4 points on each side of a patch. PROGRAM is the command line `vtu2contour`. Needs pyvista.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

import pyvista
from PIL import Image

HERE = Path(__file__).resolve().parent
SOURCE = HERE / "problem6.vtu"
LEVEL = 0.07
TOWARDS_US = (1.4, -1.4, 0.75)


def ours(program: Path, points: int) -> pyvista.PolyData:
    """Our surface with so many points on each side of a patch."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "surface.vtp"
        options = [f"--value={LEVEL}", f"--nside={points}", "--normals"]
        subprocess.run([program, SOURCE, "-o", output, *options], check=True)
        return pyvista.read(output)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="the command line vtu2contour")
    parser.add_argument("--output", type=Path, default=HERE / "surfaces_against_vtk.png")
    arguments = parser.parse_args()
    theirs = pyvista.read(SOURCE).contour([LEVEL], scalars="u", compute_normals=True)
    surfaces = {"VTK's contour filter": theirs}
    for points in (2, 3, 4):
        surfaces[f"vtu2contour --nside {points}"] = ours(arguments.program, points)
    plotter = pyvista.Plotter(
        off_screen=True,
        lighting="three lights",
        shape=(1, 4),
        border=False,
        window_size=(1480, 400),
    )
    plotter.enable_anti_aliasing("ssaa")
    for column, (title, surface) in enumerate(surfaces.items()):
        plotter.subplot(0, column)
        plotter.background_color = "white"
        text = f"{title}: {surface.n_cells} triangles"
        plotter.add_text(text, position=(8, 8), font_size=9, color="black")
        plotter.add_mesh(
            surface,
            color="#f6b53c",
            smooth_shading=True,
            ambient=0.25,
            diffuse=0.8,
            specular=0.4,
            specular_power=20,
        )
        plotter.view_vector(TOWARDS_US, viewup=(0.0, 0.0, 1.0))
        plotter.camera.zoom(1.35)
    plotter.screenshot(arguments.output)
    with Image.open(arguments.output) as picture:
        picture.convert("RGB").quantize(128).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
