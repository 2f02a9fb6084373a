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


def monitor_options(
    kind: str,
    *,
    second: str | None = None,
    samples: int | None = None,
    seed: int = 0,
    select: str | None = None,
    name: str | None = None,
) -> dict[str, Any]:
    """Which monitor, and what is made of it."""
    if samples is not None and not 1 <= samples < 2**16:
        raise ValueError(f"samples must be from 1 to {2**16 - 1}, not {samples}")
    return {
        "kind": kind,
        "second": second,
        "samples": None if samples is None else (int(samples), int(seed)),
        "select": None if select is None else selection(select),
        "name": name,
    }


def selection(text: str) -> tuple[str, float]:
    """How cells are selected, and by which number: of a text such as ``"bulk:0.5"``."""
    how, _, number = text.partition(":")
    try:
        return how.strip(), float(number)
    except ValueError:
        known = "'average:K', 'fraction:F', 'bulk:F' or 'tolerance:V'"
        raise ValueError(f"select must be {known}, not '{text}'") from None


def tell(texts: Sequence[str]) -> None:
    """What people should know about their data, as warnings of the line that called us."""
    depth, frame = 1, sys._getframe()
    while frame is not None and frame.f_globals.get("__name__", "").startswith(__package__ + "."):
        depth, frame = depth + 1, frame.f_back
    for text in texts:
        warnings.warn(text, UserWarning, stacklevel=depth)
