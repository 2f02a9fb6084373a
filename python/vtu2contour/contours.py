"""Contours of NumPy arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Contours:
    """Contour lines of triangles, or iso-surfaces of tetrahedra, at all levels.

    All arrays are NumPy's; lengths are in the unit of the mesh's points.
    """

    #: Positions, shape (n, 3), float64.
    points: NDArray[np.float64]
    #: The level of each point, shape (n,), float64.
    values: NDArray[np.float64]
    #: Triangles of a surface as rows of ``points``, shape (m, 3), int64. Their normals point
    #: to the lower values.
    triangles: NDArray[np.int64]
    #: Rows of ``points``, line after line, int64; a closed line ends with its first point.
    line_points: NDArray[np.int64]
    #: Where each line begins in ``line_points``, and the end of the last, int64.
    line_offsets: NDArray[np.int64]
    #: The cell of the mesh that each line begins in, or each triangle lies in, int64.
    cells: NDArray[np.int64]
    #: The levels, ascending.
    levels: list[float]
    #: Unit vectors along -grad u, shape (n, 3), if asked for.
    normals: NDArray[np.float64] | None = None
    #: Gradients of the interpolant, shape (n, 3), if asked for.
    gradients: NDArray[np.float64] | None = None
    #: What was done: numbers of cells ``active``, ``divided`` and ``unresolved``.
    counts: dict[str, int] = field(default_factory=dict)

    @property
    def lines(self) -> list[NDArray[np.int64]]:
        """The rows of ``points`` of each line, in order."""
        return np.split(self.line_points, self.line_offsets[1:-1]) if self._line_count() else []

    def _line_count(self) -> int:
        return len(self.line_offsets) - 1

    def to_pyvista(self) -> Any:
        """The same as a ``pyvista.PolyData`` with ``values`` (and ``Normals``,
        ``Gradients``) at the points and ``OriginalCellIds`` at the cells."""
        import pyvista

        data = pyvista.PolyData()
        data.points = self.points
        if self._line_count():
            data.lines = _with_sizes(self.line_offsets, self.line_points)
        if len(self.triangles):
            data.faces = np.insert(self.triangles, 0, 3, axis=1).ravel()
        data.point_data["values"] = self.values
        for name, array in (("Normals", self.normals), ("Gradients", self.gradients)):
            if array is not None:
                data.point_data[name] = array
        data.cell_data["OriginalCellIds"] = self.cells
        data.set_active_scalars("values", preference="point")
        return data


def _with_sizes(offsets: NDArray[np.int64], points: NDArray[np.int64]) -> NDArray[np.int64]:
    """Lines as VTK lists them: each with the number of its points first."""
    return np.insert(points, offsets[:-1], np.diff(offsets))
