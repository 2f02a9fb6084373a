"""What users give, as the compiled part takes it."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def solution_options(
    *,
    scalars: str | None = None,
    component: int | str | None = None,
    gradient: str | None = None,
    merge_points: float | None = None,
    interpolant: str = "pci",
    pde: str | None = None,
    parameters: Mapping[str, float] | None = None,
    predictor: str = "quadratic",
) -> dict[str, Any]:
    """What an interpolant is made of."""
    return {
        "scalars": scalars,
        "component": component,
        "gradient": gradient,
        "merge_points": merge_points,
        "interpolant": interpolant,
        "pde": pde,
        "parameters": [(name, float(value)) for name, value in (parameters or {}).items()],
        "predictor": predictor,
    }


def drawing_options(
    levels: float | int | Sequence[float],
    *,
    rng: tuple[float, float] | None = None,
    method: str | None = None,
    spacing: float | None = None,
    tolerance: float | None = None,
    nside: int | None = None,
    triangles: int | None = None,
    size: float | None = None,
    double: bool | None = None,
    segments: bool = False,
    gradients: bool = False,
    normals: bool = False,
) -> dict[str, Any]:
    """How contours are drawn. A whole number of levels is so many; all else are levels."""
    is_count = isinstance(levels, (int, np.integer)) and not isinstance(levels, bool)
    if is_count and levels < 0:
        raise ValueError(f"there cannot be {levels} levels; write {float(levels)} for the level")
    return {
        "levels": None if is_count else np.atleast_1d(np.asarray(levels, float)).ravel().tolist(),
        "count": int(levels) if is_count else 0,
        "range": None if rng is None else (float(rng[0]), float(rng[1])),
        "method": method,
        "spacing": spacing,
        "tolerance": tolerance,
        "nside": nside,
        "triangles": triangles,
        "size": size,
        "double": double,
        "segments": segments,
        "gradients": gradients,
        "normals": normals,
    }


def tell(texts: Sequence[str]) -> None:
    """What people should know about their data, as warnings of the line that called us."""
    depth, frame = 1, sys._getframe()
    while frame is not None and frame.f_globals.get("__name__", "").startswith(__package__ + "."):
        depth, frame = depth + 1, frame.f_back
    for text in texts:
        warnings.warn(text, UserWarning, stacklevel=depth)
