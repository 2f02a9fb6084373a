"""Our iso-surfaces beside VTK's, on the sample of a solid; and the sample itself."""

from __future__ import annotations

import sys
from importlib import import_module

import numpy as np
import pytest
import pyvista
from conftest import ROOT

sys.path.insert(0, str(ROOT / "samples"))
problem6 = import_module("problem6")

SAMPLE = ROOT / "samples" / "problem6.vtu"
LEVEL = 0.07


def distance_to_exact(surface: pyvista.PolyData) -> float:
    """The mean distance of the middles of the triangles from the exact surface."""
    middles = surface.cell_centers().points.astype(float)
    slopes = np.linalg.norm(problem6.gradient(middles), axis=1)
    return float(np.mean(np.abs(problem6.solution(middles) - LEVEL) / slopes))


@pytest.fixture(scope="module")
def theirs() -> pyvista.PolyData:
    return pyvista.read(SAMPLE).contour([LEVEL], scalars="u", compute_normals=True)


def test_distance_to_the_exact_surface(contour, theirs):
    """With two points a side three times nearer than VTK's, with four ten times."""
    for points, times in ((2, 3), (4, 10)):
        ours = pyvista.read(contour(SAMPLE, f"--value={LEVEL}", f"--nside={points}"))
        ratio = distance_to_exact(theirs) / distance_to_exact(ours)
        print(f"{points} points a side: {ratio:.1f} times nearer than VTK's")
        assert ratio > times


def test_what_vtk_users_expect(contour, theirs):
    """One mesh of triangles, closed up to the boundary of the cube, with VTK's arrays."""
    options = (f"--value={LEVEL}", "--normals", "--gradients")
    ours = pyvista.read(contour(SAMPLE, *options, name="surface.vtp"))
    assert ours.is_all_triangles
    rim = ours.extract_feature_edges(
        boundary_edges=True, non_manifold_edges=False, feature_edges=False, manifold_edges=False
    )
    assert np.allclose(rim.points[:, 2], 1.0)  # the surface leaves the cube through its top only
    assert (
        ours.extract_feature_edges(
            boundary_edges=False, non_manifold_edges=True, feature_edges=False, manifold_edges=False
        ).n_cells
        == 0
    )
    assert ours.active_scalars_name == "u"
    assert (ours["u"] == LEVEL).all()
    assert set(ours.array_names) == {"u", "gradient", "Normals", "Gradients", "OriginalCellIds"}
    # VTK's normals are means of those of facets; ours are exact, and to the same side
    nearest = [theirs.find_closest_point(point) for point in ours.points]
    agreement = np.sum(ours["Normals"] * theirs["Normals"][nearest], axis=1)
    assert np.mean(agreement) > 0.95
    exact = problem6.gradient(ours.points.astype(float))
    exact /= -np.linalg.norm(exact, axis=1)[:, None]
    assert np.mean(np.sum(ours["Normals"] * exact, axis=1)) > 0.999
    assert (
        np.mean(
            np.sum(
                ours.compute_normals(
                    cell_normals=True,
                    point_normals=False,
                    auto_orient_normals=False,
                    consistent_normals=False,
                )["Normals"]
                * -problem6.gradient(ours.cell_centers().points.astype(float)),
                axis=1,
            )
            > 0
        )
        == 1.0
    )


# The sample


def test_the_formulas_are_those_of_the_pde():
    points, h = np.random.default_rng(6).random((500, 3)), 1e-4
    shifted = [[problem6.solution(points + s * h * e) for s in (1, -1)] for e in np.eye(3)]
    slopes = np.column_stack([(up - down) / (2 * h) for up, down in shifted])
    np.testing.assert_allclose(problem6.gradient(points), slopes, atol=1e-7)
    second = sum((up + down) / h**2 for up, down in shifted) - 6 * problem6.solution(points) / h**2
    np.testing.assert_allclose(problem6.right_hand_side(points), second, atol=1e-6)


def test_the_script_writes_the_sample(tmp_path):
    problem6.main(tmp_path / "again.vtu")
    again, committed = pyvista.read(tmp_path / "again.vtu"), pyvista.read(SAMPLE)
    np.testing.assert_array_equal(again.points, committed.points)
    np.testing.assert_array_equal(again.cells, committed.cells)
    for name in ("u", "gradient"):
        np.testing.assert_allclose(again[name], committed[name], atol=1e-11)
    assert committed.volume == pytest.approx(1.0)
