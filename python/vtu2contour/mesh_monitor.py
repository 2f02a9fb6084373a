"""Monitors of meshes of pyvista and vtk."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .mesh_contour import MeshInterpolant


def monitor(
    mesh: Any,
    kind: str = "defect",
    *,
    scalars: str | None = None,
    component: int | str | None = None,
    gradient: str | None = None,
    pde: str | None = None,
    parameters: Mapping[str, float] | None = None,
    interpolant: str = "pci",
    predictor: str = "quadratic",
    second: str | None = None,
    samples: int | None = None,
    seed: int = 0,
    select: str | None = None,
    name: str | None = None,
) -> Any:
    """Says how much each cell of a mesh needs to be refined, as a cell array.

    The solids are judged, or if there are none the two-dimensional cells. A cell that is no
    triangle or tetrahedron has the sum of its parts' numbers (``"defect"``, ``"area"``), or their
    mean by size.

    Parameters
    ----------
    mesh
        A mesh of pyvista or vtk with point data; of any type of cells, or of blocks.
    kind
        ``"defect"`` (needs ``pde``), ``"area"``, ``"stepwise"`` or ``"interpolation"``: see
        :meth:`vtu2contour.Interpolant.monitor`.
    scalars, component, gradient, pde, parameters, interpolant, predictor
        What is known of the solution: as in :func:`vtu2contour.contour`.
    second, samples, seed
        What is compared, and where: see :meth:`vtu2contour.Interpolant.monitor`.
    select
        Marks cells: ``"average:K"``, those above K times the average; ``"fraction:F"``, this part
        of the cells; ``"bulk:F"``, the fewest with this part of the sum; ``"tolerance:V"``, those
        above V.
    name
        Of the cell array; by default ``"DefectMonitor"``, ``"AreaMonitor"``,
        ``"StepwiseMonitor"`` or ``"InterpolationMonitor"``. That of the marks (1: selected) has
        ``"Marks"`` after it.

    Returns
    -------
    A mesh of the kind that was given, which shares all its data with it; numbers are NaN where a
    cell could not be judged.

    Raises
    ------
    ValueError
        With one line that says what to do, as in :class:`vtu2contour.MeshInterpolant`.

    Examples
    --------
    >>> import pyvista as pv
    >>> import vtu2contour as vc
    >>> mesh = pv.ImageData(dimensions=(3, 3, 1), spacing=(0.5, 0.5, 1)).triangulate()
    >>> mesh["u"] = mesh.points[:, 0] ** 2
    >>> judged = vc.monitor(mesh, "defect", gradient="recover", pde="uxx + uyy = 1")
    >>> float(judged["DefectMonitor"].sum().round(9))  # 1 too much, on the unit square
    1.0
    """
    made = MeshInterpolant(
        mesh,
        scalars=scalars,
        component=component,
        gradient=gradient,
        pde=pde,
        parameters=parameters,
        interpolant=interpolant,
        predictor=predictor,
    )
    return made.monitor(kind, second=second, samples=samples, seed=seed, select=select, name=name)
