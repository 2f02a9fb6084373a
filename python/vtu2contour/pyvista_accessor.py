"""``mesh.dei`` on every mesh of pyvista (0.48 and later)::

    lines = mesh.dei.contour([0.1, 0.2], scalars="u", pde="uxx + uyy = -6")
    f = mesh.dei.interpolant(scalars="u")

pyvista finds it by itself where vtu2contour is installed.
"""

from __future__ import annotations

from typing import Any

import pyvista

from .mesh_contour import MeshInterpolant, contour, info
from .mesh_monitor import monitor
from .refinement import refine


@pyvista.register_dataset_accessor("dei", pyvista.DataObject)
class Dei:
    """The Differential Equation Interpolant of a mesh."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def contour(self, levels: Any = 10, **options: Any) -> Any:
        """Contours: see :func:`vtu2contour.contour`."""
        return contour(self._mesh, levels, **options)

    def interpolant(self, **options: Any) -> MeshInterpolant:
        """The interpolant, for many levels: see :class:`vtu2contour.MeshInterpolant`."""
        return MeshInterpolant(self._mesh, **options)

    def monitor(self, kind: str = "defect", **options: Any) -> Any:
        """Where the mesh should be finer: see :func:`vtu2contour.monitor`."""
        return monitor(self._mesh, kind, **options)

    def refine(self, **options: Any) -> Any:
        """A finer mesh: see :func:`vtu2contour.refine`."""
        return refine(self._mesh, **options)

    def info(self, **options: Any) -> dict[str, Any]:
        """What would be contoured: see :func:`vtu2contour.info`."""
        return info(self._mesh, **options)
