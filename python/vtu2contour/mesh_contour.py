"""Contours of meshes of pyvista and vtk."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _vtk
from .interpolant import _vectors
from .options import drawing_options, monitor_options, solution_options, tell

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class MeshInterpolant:
    """The interpolant of a mesh of pyvista or vtk: made once, contoured at any levels.

    Parameters are those of :func:`contour` that say what is contoured. A mesh of blocks has an
    interpolant in each block that has cells and the array.

    Raises
    ------
    MissingArrayError
        If the mesh (every block of it) lacks the array.
    NothingToContourError
        If it has no cells of two or three dimensions, or no finite values in them.
    ValueError
        If the PDE cannot be read, or what is given does not fit together.
    """

    def __init__(
        self,
        mesh: Any,
        *,
        scalars: str | None = None,
        component: int | str | None = None,
        gradient: str | None = None,
        pde: str | None = None,
        parameters: Mapping[str, float] | None = None,
        interpolant: str = "pci",
        predictor: str = "quadratic",
        merge_points: float | None = None,
    ) -> None:
        _check(mesh)
        self._options = solution_options(
            scalars=scalars,
            component=component,
            gradient=gradient,
            pde=pde,
            parameters=parameters,
            interpolant=interpolant,
            predictor=predictor,
            merge_points=merge_points,
        )
        #: for the data that travel along with a monitor
        self._mesh = mesh
        #: an empty mesh of the same blocks; nothing for a mesh that is no blocks
        self._structure = None
        #: the interpolant of each block, by its number in the whole
        self._blocks: dict[int, Any] = {}
        self._size: float | None = None
        if _vtk.is_composite(mesh):
            self._of_blocks(mesh)
        else:
            self._blocks[0] = self._of_block(mesh)

    def _of_blocks(self, mesh: Any) -> None:
        self._structure = mesh.NewInstance()
        self._structure.CopyStructure(mesh)
        refused: ValueError | None = None
        blocks = [(n, block) for n, block, _ in _blocks(mesh) if block is not None]
        for number, block in blocks:
            if not block.IsA("vtkDataSet") or block.GetNumberOfCells() == 0:
                continue
            try:
                self._blocks[number] = self._of_block(block)
            except (_core.MissingArrayError, _core.NothingToContourError) as error:
                refused = refused or error
        if refused is not None and not self._blocks:
            raise refused
        # blocks are to be equally fine where they meet
        self._size = _diagonal([block for _, block in blocks if block.IsA("vtkDataSet")])

    def _of_block(self, block: Any) -> Any:
        core = _core.GridInterpolant(_vtk.parts_of(block), self._options)
        tell(core.warnings())
        return core

    def __call__(self, points: ArrayLike) -> NDArray[np.float64]:
        """Values at points of shape (k, 3): shape (k,); NaN outside the mesh."""
        return self._evaluate(points, 0)

    def gradient(self, points: ArrayLike) -> NDArray[np.float64]:
        """Gradients at points of shape (k, 3): shape (k, 3); NaN outside the mesh."""
        return self._evaluate(points, 1)

    def _evaluate(self, points: ArrayLike, which: int) -> NDArray[np.float64]:
        points = _vectors(points, "points")
        found = np.full((len(points), 3) if which else len(points), np.nan)
        for core in self._blocks.values():
            here = core.evaluate(points)[which]
            found = np.where(np.isnan(found), here, found)
        return found

    def contour(
        self,
        levels: float | int | Sequence[float] = 10,
        *,
        rng: tuple[float, float] | None = None,
        method: str | None = None,
        tolerance: float | None = None,
        spacing: float | None = None,
        nside: int | None = None,
        triangles: int | None = None,
        normals: bool = False,
        gradients: bool = False,
        segments: bool = False,
        double: bool | None = None,
        size: float | None = None,
    ) -> Any:
        """Its contours, as a mesh of the kind that was given. Parameters are those of
        :func:`contour` that say how contours are drawn.
        """
        if rng is None and self._structure is not None and self._blocks:
            # a constant has no levels inside its range
            rng = self.range if self.range[0] < self.range[1] else None
        options = drawing_options(
            levels,
            rng=rng,
            method=method,
            tolerance=tolerance,
            spacing=spacing,
            nside=nside,
            triangles=triangles,
            normals=normals,
            gradients=gradients,
            segments=segments,
            double=double,
            size=size or self._size,
        )
        return _as_given(self._mesh, self._contoured(options))

    def monitor(
        self,
        kind: str = "defect",
        *,
        second: str | None = None,
        samples: int | None = None,
        seed: int = 0,
        select: str | None = None,
        name: str | None = None,
    ) -> Any:
        """The mesh with a monitor of its cells. Parameters are those of
        :func:`vtu2contour.monitor`; blocks without the array stay as they are.
        """
        choice = monitor_options(
            kind, second=second, samples=samples, seed=seed, select=select, name=name
        )
        if self._structure is None:
            return _as_given(self._mesh, _monitored(self._mesh, self._blocks[0], choice))
        output = self._structure.NewInstance()
        output.ShallowCopy(self._mesh)
        for number, block, put in _blocks(output):
            if number in self._blocks:
                put(_monitored(block, self._blocks[number], choice))
        return _as_given(self._mesh, output)

    def _contoured(self, options: dict[str, Any]) -> Any:
        if self._structure is None:
            return _poly_data(*self._blocks[0].contour(options))
        output = self._structure.NewInstance()
        output.CopyStructure(self._structure)
        for number, _, put in _blocks(output):
            if number in self._blocks:
                put(_poly_data(*self._blocks[number].contour(options)))
        return output

    @property
    def range(self) -> tuple[float, float]:
        """The least and the greatest value of the cubics."""
        return self.info["range"]

    @property
    def info(self) -> dict[str, Any]:
        """What is contoured: see :func:`info`. Numbers are sums over the blocks."""
        infos = [core.info() for core in self._blocks.values()]
        if not infos:
            return {}
        ranges = [found["range"] for found in infos]
        counts = {
            name: sum(found[name] for found in infos)
            for name, value in infos[0].items()
            if isinstance(value, int)
        }
        whole = (min(low for low, _ in ranges), max(high for _, high in ranges))
        diagonal = self._size or infos[0]["diagonal"]
        return {**infos[0], **counts, "range": whole, "diagonal": diagonal}


def contour(
    mesh: Any,
    levels: float | int | Sequence[float] = 10,
    *,
    scalars: str | None = None,
    component: int | str | None = None,
    gradient: str | None = None,
    pde: str | None = None,
    parameters: Mapping[str, float] | None = None,
    interpolant: str = "pci",
    predictor: str = "quadratic",
    merge_points: float | None = None,
    rng: tuple[float, float] | None = None,
    method: str | None = None,
    tolerance: float | None = None,
    spacing: float | None = None,
    nside: int | None = None,
    triangles: int | None = None,
    normals: bool = False,
    gradients: bool = False,
    segments: bool = False,
    double: bool | None = None,
) -> Any:
    """Contours a mesh: lines in its two-dimensional cells, surfaces in its solids.

    Parameters
    ----------
    mesh
        A mesh of pyvista or vtk with point data; of any type of cells, or of blocks.
    levels
        A float or a sequence: these levels. An int: so many, equally spaced strictly inside
        the range.
    scalars
        The point array; by default the active scalars, or the only array of one component.
    component
        Of an array of several components: its number from 0, or ``"mag"`` for the length.
    gradient
        The point array that holds its gradient, per unit of length; by default one with a
        usual name that fits the values, else it is recovered. ``"recover"`` forces that.
    pde
        The equation that the array solves, such as ``"uxx + uyy = -k2*u"``; there, the array is
        always ``u``. The cubics solve it too.
    parameters
        Values of names in the PDE, such as ``{"k2": 84.4}``. Point arrays may be named too.
    interpolant
        ``"pci"``; or, for comparison, ``"quadratic-precision"`` (each cell by itself, of third
        order) or ``"linear"``.
    predictor
        Where a PDE's right-hand side takes the solution from: ``"quadratic"`` or ``"linear"``.
    merge_points
        Points no further apart than this length are made one.
    rng
        The range to divide by a number of levels.
    method
        How lines are drawn: ``"aodea"`` (default), ``"odea"``, ``"sode"``, ``"intercept"``.
    tolerance
        No segment or triangle is further than this length from the contour. By default 1e-5
        of the mesh's diagonal for lines, 1e-3 for surfaces.
    spacing
        No two neighbouring points of a line are further apart than this length.
    nside, triangles
        Instead of a tolerance, for surfaces: points on each side of a patch, or the greatest
        number of triangles.
    normals, gradients
        Adds ``Normals`` (unit vectors along -grad u) or ``Gradients`` to the points.
    segments
        Lines of two points each, as vtk's own filter has them, instead of whole lines.
    double
        Points of double precision, or of single; by default as the mesh has them.

    Returns
    -------
    A mesh of the kind that was given (pyvista or vtk): polygonal data, in blocks for a mesh of
    blocks. The array is exactly the level, other point data are interpolated, cell and field
    data travel along, with ``OriginalCellIds``.

    Raises
    ------
    ValueError
        With one line that says what to do, as in :class:`MeshInterpolant`.

    Examples
    --------
    >>> import pyvista as pv
    >>> import vtu2contour as vc
    >>> mesh = pv.ImageData(dimensions=(5, 5, 5), spacing=(0.25, 0.25, 0.25))
    >>> mesh = mesh.cast_to_unstructured_grid()
    >>> mesh["u"] = (mesh.points**2).sum(axis=1)
    >>> mesh["grad_u"] = 2 * mesh.points
    >>> sphere = vc.contour(mesh, [0.2, 0.5], normals=True)
    >>> sphere.array_names
    ['u', 'grad_u', 'OriginalCellIds', 'Normals', 'OriginalCellIds']
    """
    _check(mesh)
    solution: dict[str, Any] = {
        "scalars": scalars,
        "component": component,
        "gradient": gradient,
        "pde": pde,
        "parameters": parameters,
        "interpolant": interpolant,
        "predictor": predictor,
        "merge_points": merge_points,
    }
    drawing: dict[str, Any] = {
        "rng": rng,
        "method": method,
        "tolerance": tolerance,
        "spacing": spacing,
        "nside": nside,
        "triangles": triangles,
        "normals": normals,
        "gradients": gradients,
        "segments": segments,
        "double": double,
    }
    if _vtk.is_composite(mesh):
        # levels may lie inside a range that only all blocks tell
        return MeshInterpolant(mesh, **solution).contour(levels, **drawing)
    options = solution_options(**solution), drawing_options(levels, **drawing)
    return _as_given(mesh, _poly_data(*_core.contour_grid(_vtk.parts_of(mesh), *options)))


def info(mesh: Any, **options: Any) -> dict[str, Any]:
    """What of a mesh would be contoured.

    ``options`` are those of :class:`MeshInterpolant`. The result names the ``scalars``, where
    their ``gradient`` comes from, the ``range`` of the cubics, the ``diagonal`` of the mesh (a
    length), and counts ``points``, ``triangles``, ``tetrahedra``, ``ghosts`` (cells of another
    process), and cells that are ``unusable`` (values that are not finite), ``left_out`` (they
    cannot be split) or ``singular`` (the PDE says nothing there).
    """
    return MeshInterpolant(mesh, **options).info


def _monitored(mesh: Any, core: Any, choice: dict[str, Any]) -> Any:
    found = core.monitor(choice)
    tell(found["warnings"])
    return _vtk.with_cell_arrays(mesh, found["arrays"])


def _check(mesh: Any) -> None:
    if not hasattr(mesh, "IsA"):
        raise TypeError(
            f"a mesh of pyvista or vtk is needed, not a {type(mesh).__name__}; "
            "vtu2contour.Interpolant takes NumPy arrays"
        )


def _as_given(given: Any, output: Any) -> Any:
    """A mesh of vtk as one of pyvista, if that was given."""
    if not _vtk.is_of_pyvista(given):
        return output
    import pyvista

    return pyvista.wrap(output)


def _poly_data(parts: dict[str, Any], report: dict[str, Any]) -> Any:
    tell(report["warnings"])
    return _vtk.poly_data(parts)


def _blocks(mesh: Any) -> Iterator[tuple[int, Any, Callable[[Any], None]]]:
    """The leaves of a mesh of blocks: their numbers, what they hold, and what puts another
    mesh there."""
    iterator = mesh.NewIterator()
    if hasattr(iterator, "SkipEmptyNodesOff"):
        iterator.SkipEmptyNodesOff()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        number, block = iterator.GetCurrentFlatIndex(), iterator.GetCurrentDataObject()
        yield number, block, lambda other: mesh.SetDataSet(iterator, other)
        iterator.GoToNextItem()


def _diagonal(blocks: list[Any]) -> float | None:
    """The length of the diagonal of the box around all blocks."""
    boxes = [np.reshape(b.GetBounds(), (3, 2)) for b in blocks if b.GetNumberOfPoints()]
    if not boxes:
        return None
    low, high = np.min(boxes, axis=0)[:, 0], np.max(boxes, axis=0)[:, 1]
    return float(np.linalg.norm(high - low))
