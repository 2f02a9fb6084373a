"""Refined meshes: of pyvista and vtk, and of NumPy arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _vtk
from .interpolant import _cells, _vectors
from .options import selection, solution_options, tell

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

#: How far points of a solver's mesh may be from where they were, relative to the greatest
#: coordinate: it may keep them in single precision.
SAME = 1e-6


class SolverError(RuntimeError):
    """A solver failed, or returned another mesh.

    ``mesh`` is the last mesh that it solved on, with all data, or None; ``step`` the number of
    the step that failed, 0 before the first. What the solver raised is the ``__cause__``.
    """

    def __init__(self, text: str, step: int, mesh: Any) -> None:
        super().__init__(text)
        self.step = step
        self.mesh = mesh


def refine(
    mesh: Any,
    *,
    by: str | None = None,
    marks: str | None = None,
    select: str = "average:2",
    method: str = "bisect",
    smooth: str | None = None,
    regions: str | None = None,
    boundary: Any = None,
    max_points: int | None = None,
    steps: int = 1,
    solver: Callable[[Any], Any] | None = None,
    scalars: str | None = None,
    component: int | str | None = None,
    gradient: str | None = None,
    pde: str | None = None,
    parameters: Mapping[str, float] | None = None,
    interpolant: str = "pci",
    predictor: str = "quadratic",
) -> Any:
    """Refines a mesh where that is asked for, with all its data.

    Its solids are refined, or if it has none its two-dimensional cells; all become tetrahedra or
    triangles first. New points have the value and the gradient of the solution's cubics, other
    point arrays are interpolated linearly, and cells have the data of those they are part of.

    Parameters
    ----------
    mesh
        A mesh of pyvista or vtk, not one of blocks.
    by
        Cell array by whose numbers cells are selected, such as an error indicator.
    marks
        Instead of ``by``: cell array with another number than 0 in the cells to be refined. In
        several steps their parts are refined again.
    select
        Which cells ``by`` selects: ``"average:K"``, above K times the average; ``"fraction:F"``,
        this part of the cells; ``"bulk:F"``, the fewest with this part of the sum;
        ``"tolerance:V"``, those above V.
    method
        How triangles are divided: ``"bisect"`` (across the longest edge), ``"newest-vertex"``,
        ``"red-green"``, ``"centroid"`` or ``"delaunay"`` (the thesis' hybrid, in the plane).
        Tetrahedra are always bisected.
    smooth
        Moves points of triangles afterwards: ``"laplacian"`` or ``"optimised"``.
    regions
        Cell array whose numbers tell regions: ``"delaunay"`` and ``smooth`` keep the edges
        between them. Division keeps all sides of cells anyway.
    boundary
        For ``"delaunay"``: a curved boundary or several, each a mesh of lines or an array of
        points of shape (n, 3) or (n, 2), in order. New boundary points are put on it.
    max_points
        The most points that the refined mesh may have; with triangles it is met exactly.
    steps
        So many steps, each of the mesh of the one before.
    solver
        A callable that gets a mesh of the kind that was given and returns it solved: the same
        points and cells, in their order, with its own arrays (None: it changed the one it got).
        Called after each step, and before the first if the array ``by`` is not there. It must
        give each mesh the array ``by``.
    scalars, component, gradient, pde, parameters, interpolant, predictor
        What is known of the solution: as in :func:`vtu2contour.contour`.

    Returns
    -------
    An unstructured grid of the kind that was given (pyvista or vtk), with ``OriginalCellIds`` (the
    cell of ``mesh`` that each is part of) and ``ParentEdge`` (the two points of the result between
    which a point was put; -1 where it is not new, or inside a cell).

    Raises
    ------
    SolverError
        If the solver fails or returns another mesh; its ``mesh`` is the last good one.
    ValueError
        If an array is missing or the cells cannot be refined: one line that says what to do.

    Examples
    --------
    >>> import numpy as np
    >>> import pyvista as pv
    >>> import vtu2contour as vc
    >>> mesh = pv.ImageData(dimensions=(5, 5, 1)).triangulate()
    >>> mesh["u"] = mesh.points[:, 0] ** 2
    >>> mesh.cell_data["eta"] = np.arange(32.0)
    >>> fine = vc.refine(mesh, by="eta", select="fraction:0.25", max_points=28)
    >>> fine.n_points, sorted(fine.cell_data)
    (28, ['OriginalCellIds', 'eta'])
    """
    asked = _asked(by, marks, select)
    if not hasattr(mesh, "IsA"):
        raise TypeError(
            f"a mesh of pyvista or vtk is needed, not a {type(mesh).__name__}; "
            "vtu2contour.refine_arrays takes NumPy arrays"
        )
    if steps > 1 and by is not None and solver is None:
        raise ValueError(
            "'by' tells nothing of refined cells: leave steps out, or give a solver, which "
            "writes the array anew"
        )
    options = {
        "asked": asked,
        "regions": regions,
        "solution": solution_options(
            scalars=scalars,
            component=component,
            gradient=gradient,
            pde=pde,
            parameters=parameters,
            interpolant=interpolant,
            predictor=predictor,
        ),
        "options": _refinement_options(method, smooth, boundary, max_points),
    }
    solve = None if solver is None else _Solver(solver, by, _vtk.is_of_pyvista(mesh))
    if solve is not None and by is not None and not mesh.GetCellData().HasArray(by):
        mesh = solve(mesh, 0, None)
    last = mesh if solve is not None else None
    for step in range(1, steps + 1):
        parts, report = _core.refine_grid(_vtk.parts_of(mesh), **options, is_first=step == 1)
        tell(report["warnings"])
        if step > 1 and report["added"] == 0:
            break
        finer = _vtk.unstructured_grid(parts)
        if _vtk.is_of_pyvista(mesh):
            import pyvista

            finer = pyvista.wrap(finer)
        mesh = finer if solve is None else solve(finer, step, last)
        last = mesh
    return mesh


class _Solver:
    """A user's solver, whose work is looked at."""

    def __init__(self, call: Callable[[Any], Any], by: str | None, is_of_pyvista: bool) -> None:
        self._call = call
        self._by = by
        self._is_of_pyvista = is_of_pyvista

    def __call__(self, mesh: Any, step: int, last: Any) -> Any:
        """The mesh solved. ``last`` is the one before, which is kept if this fails."""
        given = mesh.copy() if self._is_of_pyvista else _shallow_copy(mesh)
        if self._by is not None:
            # numbers of the cells before say nothing of these
            given.GetCellData().RemoveArray(self._by)
        try:
            solved = self._call(given)
        except Exception as error:
            text = f"the solver failed in step {step}: {type(error).__name__}: {error}"
            raise SolverError(text, step, last) from error
        solved = given if solved is None else solved
        problem = self._problem(mesh, solved)
        if problem is not None:
            raise SolverError(f"the solver {problem}", step, last)
        return solved

    def _problem(self, given: Any, solved: Any) -> str | None:
        """What is wrong with what the solver returned."""
        if not hasattr(solved, "IsA") or not solved.IsA("vtkDataSet"):
            return f"returned a {type(solved).__name__}, and no mesh"
        cure = "it must keep all points and cells, in their order"
        counts = [(m.GetNumberOfPoints(), m.GetNumberOfCells()) for m in (given, solved)]
        if counts[0] != counts[1]:
            (points, cells), (its_points, its_cells) = counts
            return (
                f"was given {points} points and {cells} cells, and returned {its_points} and "
                f"{its_cells}: {cure}"
            )
        mine, its = (_vtk.parts_of(mesh) for mesh in (given, solved))
        if any(not np.array_equal(mine[name], its[name]) for name in ("connectivity", "types")):
            return f"returned another mesh, its cells are others: {cure}"
        here, there = mine["points"][1], its["points"][1]
        if np.abs(here - there).max(initial=0) > SAME * np.abs(here).max(initial=0):
            return f"returned another mesh, its points lie elsewhere: {cure}"
        if self._by is not None and not solved.GetCellData().HasArray(self._by):
            return f"did not give the mesh the cell array '{self._by}', which by needs"
        return None


def _shallow_copy(mesh: Any) -> Any:
    copy = mesh.NewInstance()
    copy.ShallowCopy(mesh)
    return copy


@dataclass(frozen=True)
class Refined:
    """Triangles or tetrahedra refined, and where everything comes from.

    All arrays are NumPy's. With c corners a cell, n points and m cells before:
    """

    #: Positions, float64, shape (n + k, 3): those that were there, in their order, then new ones.
    points: NDArray[np.float64]
    #: Rows of ``points``, int64, shape (M, c).
    cells: NDArray[np.int64]
    #: For each cell the one before that it is part of, int64, shape (M,).
    parents: NDArray[np.int64]
    #: For each new point the two ends of the edge it lies on, int64, shape (k, 2); -1 where it
    #: is inside a cell.
    new_edges: NDArray[np.int64]
    #: How far from the first end to the second, shape (k,); NaN where it is inside a cell.
    new_at: NDArray[np.float64]
    #: The cell before that a new point is inside of, int64, shape (k,); -1 on edges.
    new_cells: NDArray[np.int64]
    #: The weights of that cell's corners, shape (k, c); NaN on edges.
    new_weights: NDArray[np.float64]
    #: Old points that smoothing moved, int64; the cells before they are in, and their weights.
    moved: NDArray[np.int64]
    moved_cells: NDArray[np.int64]
    moved_weights: NDArray[np.float64]
    #: What the method has to know in the next step, uint16: one number a cell, or none.
    state: NDArray[np.uint16]
    #: The cells before, int64, shape (m, c).
    old_cells: NDArray[np.int64] = field(repr=False)

    def carry(self, values: ArrayLike) -> NDArray[np.float64]:
        """Values at the points before, shape (n,) or (n, ...), interpolated linearly at all."""
        values = np.asarray(values, np.float64)
        count = len(self.points) - len(self.new_at)
        if len(values) != count:
            raise ValueError(f"there must be one value for each of {count} points")
        new = np.empty((len(self.new_at), *values.shape[1:]))
        is_inside = self.new_cells >= 0
        first, second = self.new_edges[~is_inside].T
        at = self.new_at[~is_inside].reshape(-1, *[1] * (values.ndim - 1))
        new[~is_inside] = (1 - at) * values[first] + at * values[second]
        new[is_inside] = self._means(values, self.new_cells[is_inside], self.new_weights[is_inside])
        carried = np.concatenate([values, new])
        carried[self.moved] = self._means(values, self.moved_cells, self.moved_weights)
        return carried

    def _means(
        self, values: NDArray[np.float64], cells: NDArray[np.int64], weights: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        return np.einsum("kc,kc...->k...", weights, values[self.old_cells[cells]])


def refine_arrays(
    points: ArrayLike,
    cells: ArrayLike,
    marks: ArrayLike,
    *,
    method: str = "bisect",
    smooth: str | None = None,
    regions: ArrayLike | None = None,
    boundary: Any = None,
    max_points: int | None = None,
    state: ArrayLike | None = None,
) -> Refined:
    """Refines triangles or tetrahedra given as NumPy arrays.

    Parameters
    ----------
    points
        Positions, shape (n, 3), or (n, 2) for a mesh in the plane.
    cells
        Rows of ``points``: shape (m, 3) for triangles, (m, 4) for tetrahedra.
    marks
        The cells to be refined: their numbers, those first that need it most; or one bool for
        each, shape (m,).
    method, smooth, boundary, max_points
        As in :func:`refine`; ``boundary`` as arrays of points.
    regions
        A number for each cell, shape (m,): edges between regions are kept.
    state
        :attr:`Refined.state` of the step that made this mesh; begins anew without it.

    Raises
    ------
    ValueError
        If shapes do not fit, or the cells cannot be refined: one line that says what to do.

    Examples
    --------
    >>> import numpy as np
    >>> import vtu2contour as vc
    >>> points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> fine = vc.refine_arrays(points, [[0, 1, 2], [0, 2, 3]], [0])
    >>> fine.points[4].tolist(), fine.new_edges.tolist(), fine.parents.tolist()
    ([0.5, 0.5, 0.0], [[0, 2]], [0, 0, 1, 1])
    >>> fine.carry(points[:, 0]).tolist()
    [0.0, 1.0, 1.0, 0.0, 0.5]
    """
    corners = _cells(cells)
    chosen = np.asarray(marks)
    if chosen.dtype == bool:
        if chosen.shape != (len(corners),):
            raise ValueError(f"marks must have shape ({len(corners)},), not {chosen.shape}")
        chosen = np.flatnonzero(chosen)
    elif chosen.size and not np.issubdtype(chosen.dtype, np.integer):
        raise ValueError(f"marks must be numbers of cells or bools, not {chosen.dtype}")
    elif chosen.size and (chosen.min() < 0 or chosen.max() >= len(corners)):
        raise ValueError(f"marks must be numbers of cells, from 0 to {len(corners) - 1}")
    numbers = np.zeros(0) if regions is None else np.asarray(regions)
    if regions is not None and numbers.shape != (len(corners),):
        raise ValueError(f"regions must have shape ({len(corners)},), not {numbers.shape}")
    found = _core.refine_arrays(
        _vectors(points, "points"),
        corners,
        np.ascontiguousarray(chosen, np.uint32).ravel(),
        np.unique(numbers, return_inverse=True)[1].astype(np.uint32).ravel(),
        np.ascontiguousarray(() if state is None else state, np.uint16),
        _refinement_options(method, smooth, boundary, max_points),
    )
    return Refined(**found, old_cells=corners.astype(np.int64))


def _asked(by: str | None, marks: str | None, select: str) -> tuple[str, tuple[str, float] | None]:
    """Which cells, as the compiled part takes it."""
    if (by is None) == (marks is None):
        raise ValueError("give one of by and marks, the name of a cell array")
    if by is None:
        return str(marks), None
    return by, selection(select)


def _refinement_options(
    method: str, smooth: str | None, boundary: Any, max_points: int | None
) -> dict[str, Any]:
    return {
        "method": method,
        "smooth": smooth,
        "max_points": max_points,
        "boundaries": _boundaries(boundary),
    }


def _boundaries(boundary: Any) -> list[NDArray[np.float64]]:
    """Curved boundaries as arrays of points, shape (n, 3)."""
    if boundary is None:
        return []
    if hasattr(boundary, "IsA"):
        return [_vectors(curve, "boundary") for curve in _core.curves(_vtk.parts_of(boundary))]
    if isinstance(boundary, Sequence) and any(
        hasattr(curve, "IsA") or np.ndim(curve) == 2 for curve in boundary
    ):
        return [array for curve in boundary for array in _boundaries(curve)]
    return [_vectors(boundary, "boundary")]
