"""The interpolant of NumPy arrays, and their contours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .contours import Contours
from .options import drawing_options, monitor_options, solution_options, tell

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Interpolant:
    """One cubic per triangle or tetrahedron, made of values, gradients and the PDE.

    Made once; evaluated and contoured as often as wanted: ``f(points)``,
    ``f.gradient(points)``, ``f.contour(levels)``.

    Arrays of float64 with three columns and cells of int32 or uint32 are used where they are,
    in C's order, and others are copied: float32, int64, lists, two columns. Do not change
    arrays while the interpolant is in use.

    Parameters
    ----------
    points
        Positions, shape (n, 3), or (n, 2) for a mesh in the plane.
    cells
        Rows of ``points``: shape (m, 3) for triangles (in any plane or on a curved surface),
        (m, 4) for tetrahedra. They are numbered from 0.
    u
        Values at the points, shape (n,).
    grad
        Gradients at the points, per unit of length, shape (n, 3) or (n, 2); recovered from the
        values if not given.
    pde
        The equation that ``u`` solves, such as ``"uxx + uyy = -6"``: the cubics solve it too.
    parameters
        Values of names in the PDE.
    arrays
        Arrays of one value a point, shape (n,), that the PDE names.
    interpolant
        ``"pci"``; or, for comparison, ``"quadratic-precision"`` (each cell by itself, of third
        order) or ``"linear"``.
    predictor
        Where a PDE's right-hand side takes the solution from: ``"quadratic"`` or ``"linear"``.

    Raises
    ------
    ValueError
        If shapes do not fit, a cell names a point that is not there, no cell has finite
        values, or the PDE cannot be read.

    Examples
    --------
    >>> import numpy as np
    >>> import vtu2contour as vc
    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> u, grad = (points**2).sum(axis=1), 2 * points
    >>> f = vc.Interpolant(points, [[0, 1, 2, 3]], u, grad)
    >>> f([[0.25, 0.25, 0.25]]).round(12).tolist()  # a quadratic is reproduced
    [0.1875]
    >>> f.gradient([[0.25, 0.25, 0.25]]).round(12).tolist()
    [[0.5, 0.5, 0.5]]
    >>> sphere = f.contour([0.25], nside=8, normals=True)
    >>> bool(np.allclose(np.linalg.norm(sphere.points, axis=1), 0.5, rtol=1e-12))
    True
    """

    def __init__(
        self,
        points: ArrayLike,
        cells: ArrayLike,
        u: ArrayLike,
        grad: ArrayLike | None = None,
        *,
        pde: str | None = None,
        parameters: Mapping[str, float] | None = None,
        arrays: Mapping[str, ArrayLike] | None = None,
        interpolant: str = "pci",
        predictor: str = "quadratic",
    ) -> None:
        options = solution_options(
            pde=pde, parameters=parameters, interpolant=interpolant, predictor=predictor
        )
        self._core = _core.ArrayInterpolant(
            *_solution(points, cells, u, grad), options, _named(arrays)
        )
        tell(self._core.warnings())

    def __call__(self, points: ArrayLike) -> NDArray[np.float64]:
        """Values at points of shape (k, 3) or (k, 2): shape (k,); NaN outside the mesh."""
        return self._core.evaluate(_vectors(points, "points"))[0]

    def gradient(self, points: ArrayLike) -> NDArray[np.float64]:
        """Gradients at points of shape (k, 3) or (k, 2): shape (k, 3), per unit of length; NaN
        outside the mesh.

        On a surface in space they are tangential. Between two cells the gradient is that of
        one of them.
        """
        return self._core.evaluate(_vectors(points, "points"))[1]

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
    ) -> Contours:
        """Contours at ``levels``: these (a float or a sequence), or so many (an int), equally
        spaced inside the range. What they are drawn by is the same as in
        :func:`vtu2contour.contour`.
        """
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
        )
        return _contours(*self._core.contour(options))

    def monitor(
        self,
        kind: str = "defect",
        *,
        pde: str | None = None,
        parameters: Mapping[str, float] | None = None,
        arrays: Mapping[str, ArrayLike] | None = None,
        second: str | None = None,
        samples: int | None = None,
        seed: int = 0,
    ) -> NDArray[np.float64]:
        """How much each cell needs to be refined.

        Parameters
        ----------
        kind
            ``"defect"``: how far the cubic is from satisfying the PDE ``L u = g``, about the
            integral of ``|L p - g|`` over the cell, in the unit of g times an area or volume.
            ``"area"``: that of the cubic's graph. ``"stepwise"``: the mean difference to the
            cubics on the mesh with every edge halved, whose new points have the cubics' own
            values and gradients. ``"interpolation"``: the mean difference to a second
            interpolant. The last two are in the unit of ``u``.
        pde, parameters, arrays
            The PDE; by default the one that the interpolant was made of.
        second
            What ``"interpolation"`` compares with: ``"pqi"``, ``"fqi"`` (quartics on triangles),
            ``"p3"`` (in tetrahedra), which need a PDE, ``"quadratic-precision"`` or ``"linear"``.
            By default ``"fqi"`` or ``"p3"``, and without a PDE ``"quadratic-precision"``.
        samples, seed
            So many random points of each cell, the same for the same seed; by default fixed
            points, which are mirrored with the cell.

        Returns
        -------
        Shape (m,): a number for each cell; NaN where it cannot be computed.

        Raises
        ------
        ValueError
            If there is no such monitor, or it needs a PDE and there is none.

        Examples
        --------
        >>> import numpy as np
        >>> import vtu2contour as vc
        >>> points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        >>> f = vc.Interpolant(points, [[0, 1, 2], [0, 2, 3]], (points**2).sum(axis=1), 2 * points)
        >>> f.monitor("defect", pde="uxx + uyy = 3").round(12).tolist()  # it is 4: 1 too much
        [0.5, 0.5]
        """
        choice = monitor_options(kind, second=second, samples=samples, seed=seed)
        known = None
        if pde is not None:
            given = solution_options(parameters=parameters)["parameters"]
            known = (pde, given, _named(arrays))
        found = self._core.monitor(choice, known)
        tell(found["warnings"])
        (numbers,) = found["arrays"].values()
        return numbers

    @property
    def range(self) -> tuple[float, float]:
        """The least and the greatest value of the cubics."""
        return self.info["range"]

    @property
    def info(self) -> dict[str, Any]:
        """What it was made of: ``range``, where the ``gradient`` came from, numbers of
        ``points``, ``triangles``, ``tetrahedra``, of cells that are ``unusable`` (values that
        are not finite) and in which the PDE is ``singular``.
        """
        return self._core.info()


def contour_arrays(
    points: ArrayLike,
    cells: ArrayLike,
    u: ArrayLike,
    grad: ArrayLike | None = None,
    levels: float | int | Sequence[float] = 10,
    *,
    pde: str | None = None,
    parameters: Mapping[str, float] | None = None,
    arrays: Mapping[str, ArrayLike] | None = None,
    interpolant: str = "pci",
    predictor: str = "quadratic",
    rng: tuple[float, float] | None = None,
    method: str | None = None,
    tolerance: float | None = None,
    spacing: float | None = None,
    nside: int | None = None,
    triangles: int | None = None,
    normals: bool = False,
    gradients: bool = False,
) -> Contours:
    """Contours NumPy arrays once: quicker than an :class:`Interpolant`, and in less memory, as
    cubics are made only where the levels are.

    ``points``, ``cells``, ``u``, ``grad`` and the PDE are as in :class:`Interpolant`; how
    contours are drawn is as in :func:`vtu2contour.contour`. What comes out is the same as that
    of ``Interpolant(...).contour(levels)``.

    Raises
    ------
    ValueError
        As in :class:`Interpolant`.

    Examples
    --------
    >>> import numpy as np
    >>> import vtu2contour as vc
    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> u, grad = (points**2).sum(axis=1), 2 * points
    >>> sphere = vc.contour_arrays(points, [[0, 1, 2, 3]], u, grad, [0.25], nside=8)
    >>> bool(np.allclose(np.linalg.norm(sphere.points, axis=1), 0.5, rtol=1e-12))
    True
    """
    solution = solution_options(
        pde=pde, parameters=parameters, interpolant=interpolant, predictor=predictor
    )
    drawing = drawing_options(
        levels,
        rng=rng,
        method=method,
        tolerance=tolerance,
        spacing=spacing,
        nside=nside,
        triangles=triangles,
        normals=normals,
        gradients=gradients,
    )
    given = _solution(points, cells, u, grad)
    return _contours(*_core.contour_arrays(*given, solution, _named(arrays), drawing))


def _solution(
    points: ArrayLike, cells: ArrayLike, u: ArrayLike, grad: ArrayLike | None
) -> tuple[Any, Any, Any, Any]:
    """Arrays as the compiled part takes them: the same ones, where their types allow."""
    values = np.ascontiguousarray(u, np.float64)
    if values.ndim != 1:
        raise ValueError(f"u must have shape (n,), not {values.shape}")
    gradients = None if grad is None else _vectors(grad, "grad")
    return _vectors(points, "points"), _cells(cells), values, gradients


def _named(arrays: Mapping[str, ArrayLike] | None) -> list[tuple[str, NDArray[np.float64]]]:
    return [(name, np.asarray(a, np.float64)) for name, a in (arrays or {}).items()]


def _contours(arrays: dict[str, Any], report: dict[str, Any]) -> Contours:
    tell(report.pop("warnings"))
    return Contours(**arrays, levels=report.pop("levels"), counts=report)


def _vectors(array: ArrayLike, name: str) -> NDArray[np.float64]:
    """Vectors of three components; those of two get a third, zero."""
    vectors = np.ascontiguousarray(array, np.float64)
    if vectors.ndim == 2 and vectors.shape[1] == 2:
        vectors = np.column_stack([vectors, np.zeros(len(vectors))])
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise ValueError(f"{name} must have shape (n, 3) or (n, 2), not {vectors.shape}")
    return vectors


def _cells(array: ArrayLike) -> NDArray[np.uint32]:
    """Corners as 32-bit numbers: the same array, where it has 32 bits."""
    cells = np.ascontiguousarray(array)
    if cells.ndim != 2 or cells.shape[1] not in (3, 4):
        raise ValueError(f"cells must have shape (m, 3) or (m, 4), not {cells.shape}")
    if not np.issubdtype(cells.dtype, np.integer):
        raise ValueError(f"cells must be whole numbers, not {cells.dtype}")
    if cells.dtype.itemsize == 4:
        return cells.view(np.uint32)
    if len(cells) and (cells.min() < 0 or cells.max() >= 2**32):
        raise ValueError("cells must name points by their numbers, counted from 0")
    return cells.astype(np.uint32)
