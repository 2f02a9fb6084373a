"""The compiled part: arrays in, dictionaries of arrays out."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

VERSION: str

class MissingArrayError(ValueError):
    """The mesh has no point array of that name, or none at all."""

class NothingToContourError(ValueError):
    """The mesh has no cells that can be contoured, or no finite values in them."""

class _Interpolant:
    def contour(self, options: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]: ...
    def evaluate(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def warnings(self) -> list[str]: ...
    def info(self) -> dict[str, Any]: ...

class ArrayInterpolant(_Interpolant):
    """The interpolant of NumPy arrays, which stay where they are."""

    def __new__(
        cls,
        points: NDArray[np.float64],
        cells: NDArray[np.uint32],
        values: NDArray[np.float64],
        gradients: NDArray[np.float64] | None,
        options: dict[str, Any],
        arrays: list[tuple[str, NDArray[np.float64]]],
    ) -> ArrayInterpolant: ...
    def monitor(
        self,
        choice: dict[str, Any],
        pde: tuple[str, list[tuple[str, float]], list[tuple[str, NDArray[np.float64]]]] | None,
    ) -> dict[str, Any]: ...

class GridInterpolant(_Interpolant):
    """The interpolant of a grid, with the data that travel along."""

    def __new__(cls, grid: dict[str, Any], options: dict[str, Any]) -> GridInterpolant: ...
    def monitor(self, choice: dict[str, Any]) -> dict[str, Any]: ...

def contour_arrays(
    points: NDArray[np.float64],
    cells: NDArray[np.uint32],
    values: NDArray[np.float64],
    gradients: NDArray[np.float64] | None,
    solution: dict[str, Any],
    arrays: list[tuple[str, NDArray[np.float64]]],
    drawing: dict[str, Any],
) -> tuple[dict[str, Any], dict[str, Any]]: ...
def contour_grid(
    grid: dict[str, Any], solution: dict[str, Any], drawing: dict[str, Any]
) -> tuple[dict[str, Any], dict[str, Any]]: ...
def refine_grid(
    grid: dict[str, Any],
    asked: dict[str, Any],
    regions: str | None,
    solution: dict[str, Any],
    options: dict[str, Any],
    is_first: bool,
) -> tuple[dict[str, Any], dict[str, Any]]: ...
def refine_arrays(
    points: NDArray[np.float64],
    cells: NDArray[np.uint32],
    marks: NDArray[np.uint32],
    regions: NDArray[np.uint32],
    state: NDArray[np.uint16],
    options: dict[str, Any],
) -> dict[str, Any]: ...
def curves(grid: dict[str, Any]) -> list[NDArray[np.float64]]: ...
