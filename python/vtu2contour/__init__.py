"""Smooth contours of coarse finite-element solutions.

A solution knows values *and gradients* at its nodes, and often the differential equation
that it solves. This module makes one cubic polynomial per triangle or tetrahedron of them,
the Differential Equation Interpolant, and draws the contour lines or iso-surfaces of that
cubic: smooth, every point on its level, islands inside a cell included.

``contour(mesh, levels)`` contours a mesh of pyvista or vtk, and ``contour_arrays(points, cells,
u, grad, levels)`` NumPy arrays; ``MeshInterpolant(mesh)`` and ``Interpolant(points, cells, u,
grad)`` are kept for any number of levels; ``info(mesh)`` tells what would be done.
``monitor(mesh, kind)`` says where the mesh should be finer; ``refine(mesh, by=...)`` and
``refine_arrays(points, cells, marks)`` make it so, ``refine`` with a solver between the steps.

>>> import numpy as np
>>> import vtu2contour as vc
>>> points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
>>> cells = np.array([[0, 1, 2], [0, 2, 3]])
>>> u = (points**2).sum(axis=1)  # a paraboloid, which a cubic can be
>>> f = vc.Interpolant(points, cells, u, 2 * points)
>>> quarter = f.contour([0.25])  # a quarter of the circle of radius 1/2
>>> bool(np.allclose(np.linalg.norm(quarter.points, axis=1), 0.5, rtol=1e-14))
True
"""

from ._core import VERSION as __version__
from ._core import MissingArrayError, NothingToContourError
from .contours import Contours
from .interpolant import Interpolant, contour_arrays
from .mesh_contour import MeshInterpolant, contour, info
from .mesh_monitor import monitor
from .refinement import Refined, SolverError, refine, refine_arrays

__all__ = [
    "Contours",
    "Interpolant",
    "MeshInterpolant",
    "MissingArrayError",
    "NothingToContourError",
    "Refined",
    "SolverError",
    "__version__",
    "contour",
    "contour_arrays",
    "info",
    "monitor",
    "refine",
    "refine_arrays",
]
