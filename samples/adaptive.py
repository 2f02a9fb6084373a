"""Adaptive finite elements: scikit-fem solves, vtu2contour refines, five times.

    python samples/adaptive.py [--output FILE]

On an L-shaped domain the solution of Laplace's equation is r^(2/3) sin(2 θ / 3): at the inner
corner its gradient is infinite. Linear elements on a uniform mesh then converge slowly; on meshes
that are finer where the error indicator is large, they converge as fast as if there were no corner.
The picture has the meshes of the steps, and both errors. Needs scikit-fem, pyvista, matplotlib and
the Python module.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv
from numpy.typing import NDArray
from skfem import (
    Basis,
    BilinearForm,
    ElementTriP1,
    Functional,
    InteriorFacetBasis,
    MeshTri1,
    condense,
    solve,
)
from skfem.helpers import dot, grad

import vtu2contour as vc

HERE = Path(__file__).resolve().parent
STEPS = 5
#: Squares along each side of the square from which the L is cut.
COARSE = 8


@dataclass
class Solved:
    """What was found on a mesh."""

    mesh: pv.UnstructuredGrid
    #: The error in the energy norm: the L2 norm of the gradient's error.
    error: float

    @property
    def unknowns(self) -> int:
        return self.mesh.n_points


def l_shape(n: int = COARSE) -> pv.UnstructuredGrid:
    """[-1, 1]² without the quadrant of positive x and negative y, n squares along its side."""
    line = np.linspace(-1, 1, n + 1)
    mesh = MeshTri1.init_tensor(line, line)
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    mesh = mesh.remove_elements(np.flatnonzero((x > 0) & (y < 0)))
    points = np.column_stack([mesh.p.T, np.zeros(mesh.p.shape[1])])
    return pv.UnstructuredGrid({pv.CellType.TRIANGLE: mesh.t.T}, points)


def exact(x: NDArray, y: NDArray) -> tuple[NDArray, NDArray]:
    """The solution, and its gradient (2, ...); the angle θ is counted from the positive x axis."""
    r, angle = np.hypot(x, y), np.arctan2(y, x) % (2 * np.pi)
    slope = 2 / 3 * np.maximum(r, 1e-300) ** (-1 / 3)
    gradient = np.stack([-slope * np.sin(angle / 3), slope * np.cos(angle / 3)])
    return r ** (2 / 3) * np.sin(2 / 3 * angle), gradient


@BilinearForm
def laplace(u, v, _):
    return dot(grad(u), grad(v))


@Functional
def squared_error(w):
    difference = grad(w["u"]) - exact(*w.x)[1]
    return dot(difference, difference)


@Functional
def squared_jump(w):
    """Of the normal derivative over an edge, times its length."""
    return w.h * dot(grad(w["here"]) - grad(w["there"]), w.n) ** 2


def solved(grid: pv.UnstructuredGrid) -> tuple[NDArray, NDArray, float]:
    """The solution at the points, the squared error indicator of each cell, and the error."""
    triangles = grid.cells_dict[pv.CellType.TRIANGLE]
    points = np.ascontiguousarray(grid.points[:, :2].T, float)
    mesh = MeshTri1(points, np.ascontiguousarray(triangles.T, np.int64))
    basis = Basis(mesh, ElementTriP1(), intorder=8)
    fixed = exact(*mesh.p)[0]
    u = solve(*condense(laplace.assemble(basis), x=fixed, D=basis.get_dofs()))
    sides = [InteriorFacetBasis(mesh, ElementTriP1(), side=side) for side in (0, 1)]
    here, there = (side.interpolate(u) for side in sides)
    jumps = np.zeros(mesh.nfacets)
    jumps[sides[0].find] = squared_jump.elemental(sides[0], here=here, there=there)
    indicator = jumps[mesh.t2f].sum(axis=0) / 2
    error = np.sqrt(squared_error.assemble(basis, u=basis.interpolate(u)))
    return u, indicator, float(error)


def adaptive(steps: int = STEPS) -> list[Solved]:
    """What is found on the first mesh and after each step."""
    history: list[Solved] = []

    def solver(grid: pv.UnstructuredGrid) -> pv.UnstructuredGrid:
        grid.point_data["u"], grid.cell_data["eta"], error = solved(grid)
        history.append(Solved(grid.copy(), error))
        return grid

    vc.refine(
        l_shape(),
        by="eta",
        select="bulk:0.9",
        scalars="u",
        pde="uxx + uyy = 0",
        steps=steps,
        solver=solver,
    )
    return history


def uniform(most: int) -> list[Solved]:
    """The same on uniform meshes of ever half the width, up to so many points or more."""
    history, n = [], COARSE
    while not history or history[-1].unknowns < most:
        grid = l_shape(n)
        history.append(Solved(grid, solved(grid)[2]))
        n *= 2
    return history


def draw(steps: list[Solved], plain: list[Solved], path: Path) -> None:
    """The meshes of the steps, and the errors over the numbers of points."""
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.6), layout="constrained")
    places = [axes[0, 0], axes[0, 1], axes[0, 2], axes[1, 0], axes[1, 1], axes[1, 2]]
    for number, (place, step) in enumerate(zip(places, steps)):
        triangles = step.mesh.cells_dict[pv.CellType.TRIANGLE]
        place.triplot(*step.mesh.points[:, :2].T, triangles, color="0.35", linewidth=0.4)
        place.set_title(f"step {number}: {step.unknowns} points", fontsize=10, loc="left")
        place.set_aspect("equal")
        place.axis("off")
    grid = axes[0, 3].get_gridspec()
    for place in axes[:, 3]:
        place.remove()
    plot = figure.add_subplot(grid[:, 3])
    for history, name, marker in ((plain, "uniform", "s"), (steps, "refined", "o")):
        plot.loglog(
            [solved.unknowns for solved in history],
            [solved.error for solved in history],
            marker=marker,
            label=name,
        )
    counts = np.array([steps[0].unknowns, steps[-1].unknowns])
    for slope, place in ((-1 / 2, 0.88), (-1 / 3, 1.1)):
        line = place * steps[0].error * (counts / counts[0]) ** slope
        name = f"slope -1/{round(-1 / slope)}"
        plot.loglog(counts, line, color="0.6", linestyle=":" if slope < -0.4 else "--", label=name)
    plot.set_xticks([100, 200, 400, 800], ["100", "200", "400", "800"])
    plot.set_yticks([0.06, 0.08, 0.1, 0.15, 0.2], ["0.06", "0.08", "0.1", "0.15", "0.2"])
    plot.minorticks_off()
    plot.set_xlabel("points")
    plot.set_title("error in the energy norm", fontsize=10, loc="left")
    plot.legend(frameon=False)
    plot.grid(True, color="0.92")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--output", type=Path, default=HERE / "adaptive.png")
    arguments = parser.parse_args()
    steps = adaptive()
    plain = uniform(steps[-1].unknowns)
    for name, history in (("refined", steps), ("uniform", plain)):
        for solved in history:
            print(f"{name}: {solved.unknowns:5} points, error {solved.error:.4f}")
    draw(steps, plain, arguments.output)


if __name__ == "__main__":
    main()
