"""Refined meshes in Python: as by the command line, with arrays, and with a solver."""

from __future__ import annotations

import importlib
import subprocess
import threading

import numpy as np
import pytest
import pyvista as pv
from conftest import ROOT
from test_module import solid, square, wave

import vtu2contour as vc


def flat(n: int = 4) -> pv.UnstructuredGrid:
    """The unit square with a wave and numbers of its triangles."""
    points, cells = square(n)
    points = np.column_stack([points, np.zeros(len(points))])
    grid = pv.UnstructuredGrid({5: cells}, points)
    grid["u"], grid["grad_u"] = wave(points)
    grid.cell_data["eta"] = np.arange(grid.n_cells, dtype=float)
    return grid


def same(one: pv.UnstructuredGrid, other: pv.UnstructuredGrid) -> None:
    assert one.n_cells > 0 and np.array_equal(one.points, other.points)
    assert np.array_equal(one.cells, other.cells)
    for here, there in ((one.point_data, other.point_data), (one.cell_data, other.cell_data)):
        assert sorted(here) == sorted(there)
        for name in here:
            assert np.array_equal(here[name], there[name], equal_nan=True), name


@pytest.mark.parametrize(
    ("solids", "options", "arguments"),
    [
        (False, {"by": "eta"}, ["--by", "eta"]),
        (
            False,
            {"marks": "eta", "steps": 2, "max_points": 60, "smooth": "optimised"},
            ["--marks", "eta", "--steps", "2", "--max-points", "60", "--smooth", "optimised"],
        ),
        (
            False,
            {"by": "eta", "select": "bulk:0.3", "method": "delaunay", "regions": "eta"},
            ["--by", "eta", "--select", "bulk:0.3", "--method", "delaunay", "--regions", "eta"],
        ),
        (
            True,
            {"by": "eta", "select": "fraction:0.2", "pde": "uxx + uyy + uzz = -14*u"},
            ["--by", "eta", "--select", "fraction:0.2", "--pde", "uxx + uyy + uzz = -14*u"],
        ),
    ],
)
def test_meshes_are_refined_as_by_the_command_line(program, tmp_path, solids, options, arguments):
    grid = solid(n=2) if solids else flat()
    grid.cell_data["eta"] = np.arange(grid.n_cells, dtype=float)
    grid.save(tmp_path / "in.vtu")
    command = [program, "refine", tmp_path / "in.vtu", "-o", tmp_path / "out.vtu", "-a", "u"]
    done = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = vc.refine(grid, scalars="u", **options)
    assert type(found) is pv.UnstructuredGrid
    same(found, pv.read(tmp_path / "out.vtu"))


def test_vtk_in_vtk_out():
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

    plain = vtkUnstructuredGrid()
    plain.ShallowCopy(flat())
    found = vc.refine(plain, by="eta", scalars="u")
    assert type(found) is vtkUnstructuredGrid
    same(pv.wrap(found), vc.refine(flat(), by="eta", scalars="u"))


def test_arrays_are_refined_as_the_mesh_of_them():
    for grid, kind in ((flat(), 5), (solid(n=2), 10)):
        marks = np.arange(grid.n_cells) % 3 == 0
        grid.cell_data["marks"] = marks.astype(np.uint8)
        mesh = vc.refine(grid, marks="marks", scalars="u")
        found = vc.refine_arrays(grid.points, grid.cells_dict[kind], marks)
        assert np.array_equal(found.points, mesh.points)
        # the mesh's tetrahedra have their corners in an order of positive volume
        cells = (found.cells, mesh.cells_dict[kind])
        named = [np.sort(corners, axis=1) for corners in cells]
        assert np.array_equal(*(np.unique(corners, axis=0) for corners in named))
        assert np.array_equal(found.parents, mesh.cell_data["OriginalCellIds"])
        edges = mesh.point_data["ParentEdge"][grid.n_points :]
        assert np.array_equal(found.new_edges, edges)
        assert np.allclose(found.carry(grid.points), found.points, atol=1e-14)
        linear = grid.points @ [1.0, 2.0, 3.0]
        assert np.allclose(found.carry(linear), found.points @ [1.0, 2.0, 3.0], atol=1e-14)


def test_arrays_step_by_step():
    points, cells = square(3)
    for method in ("bisect", "newest-vertex", "red-green", "centroid", "delaunay"):
        step = vc.refine_arrays(points, cells, [0, 5], method=method, smooth="laplacian")
        assert np.allclose(step.carry(points), step.points[:, :2], atol=1e-13)
        state = step.state if len(step.state) else None
        again = vc.refine_arrays(step.points, step.cells, [0], method=method, state=state)
        assert len(again.points) > len(step.points) > len(points)
    bounded = vc.refine_arrays(points, cells, range(len(cells)), max_points=20)
    assert len(bounded.points) == 20


def test_a_curved_boundary():
    angles = np.linspace(0, 2 * np.pi, 361)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    circle[-1] = circle[0]
    points = np.vstack([circle[:-1:45], [[0, 0]]])
    cells = [[8, n, (n + 1) % 8] for n in range(8)]
    lines = pv.lines_from_points(np.column_stack([circle, 0 * angles]))
    for boundary in (circle, [circle[:181], circle[180:]], lines, [lines]):
        fine = vc.refine_arrays(points, cells, range(8), method="delaunay", boundary=boundary)
        for _ in range(2):
            options = {"method": "delaunay", "boundary": boundary}
            fine = vc.refine_arrays(fine.points, fine.cells, range(len(fine.cells)), **options)
        on_edges = fine.points[len(fine.points) - len(fine.new_at) :][fine.new_edges[:, 0] >= 0]
        assert len(on_edges) >= 8
        assert np.allclose(np.linalg.norm(on_edges, axis=1), 1, atol=1e-4)
    with pytest.raises(ValueError, match="boundary is for triangles by method='delaunay'"):
        vc.refine_arrays(points, cells, [0], boundary=circle)


def test_a_solver_between_the_steps():
    seen = []

    def solve(mesh):
        seen.append((type(mesh), mesh.n_cells, "eta" in mesh.cell_data))
        mesh["u"], mesh["grad_u"] = wave(mesh.points)
        mesh.cell_data["eta"] = mesh.cell_centers().points[:, 0]
        return mesh

    start = flat()
    start.cell_data.remove("eta")
    fine = vc.refine(start, by="eta", select="fraction:0.3", steps=3, solver=solve, scalars="u")
    assert len(seen) == 4 and seen[0][1] == start.n_cells < seen[1][1] < seen[2][1] < seen[3][1]
    # numbers of the cells before are not there to be taken for new ones
    assert {(kind, known) for kind, _, known in seen} == {(pv.UnstructuredGrid, False)}
    assert np.array_equal(fine["u"], wave(fine.points)[0])
    assert fine.cell_data["OriginalCellIds"].max() == start.n_cells - 1
    assert "eta" not in start.cell_data
    # a solver that returns nothing has changed the mesh it got
    same(
        fine,
        vc.refine(
            start,
            by="eta",
            select="fraction:0.3",
            steps=3,
            scalars="u",
            solver=lambda mesh: solve(mesh) and None,
        ),
    )


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        (lambda mesh: 1 / 0, "failed in step 2: ZeroDivisionError"),
        (lambda mesh: 3, "returned a int, and no mesh"),
        (lambda mesh: flat(7), "was given .* points"),
        (lambda mesh: mesh.translate([1, 0, 0]), "its points lie elsewhere"),
        (lambda mesh: mesh, "did not give the mesh the cell array 'eta'"),
    ],
)
def test_a_solver_that_fails_leaves_the_last_good_mesh(wrong, text):
    calls = []

    def solve(mesh):
        calls.append(mesh.n_points)
        if len(calls) == 2:
            return wrong(mesh)
        mesh.cell_data["eta"] = mesh.cell_centers().points[:, 0]
        return mesh

    with pytest.raises(vc.SolverError, match=text) as caught:
        vc.refine(flat(), by="eta", select="fraction:0.3", steps=4, solver=solve, scalars="u")
    assert caught.value.step == 2 and caught.value.mesh.n_points == calls[0]
    assert "eta" in caught.value.mesh.cell_data
    assert len(str(caught.value).splitlines()) == 1


def test_what_is_wrong_is_told():
    points, cells = square(2)
    for options, text in (
        ({}, "one of by and marks"),
        ({"by": "eta", "marks": "eta"}, "one of by and marks"),
        ({"by": "none"}, "no cell array 'none'"),
        ({"by": "eta", "select": "most"}, "select must be average:K"),
        ({"by": "eta", "select": "bulk:2"}, "1 at most"),
        ({"by": "eta", "select": "best:2"}, "select must be 'average' or"),
        ({"by": "eta", "method": "halves"}, "method must be 'bisect' or"),
        ({"by": "eta", "steps": 2}, "tells nothing of refined cells"),
    ):
        with pytest.raises(ValueError, match=text):
            vc.refine(flat(), scalars="u", **options)
    with pytest.raises(TypeError, match="refine_arrays"):
        vc.refine(points, by="eta")
    for marks, options, text in (
        ([9], {}, "from 0 to 7"),
        ([-1], {}, "from 0 to 7"),
        ([0.5], {}, "numbers of cells or bools"),
        ([True], {}, r"shape \(8,\)"),
        ([0], {"regions": [1]}, r"regions must have shape"),
        ([0], {"method": "newest-vertex", "state": [7] * 8}, "state is not that of this mesh"),
    ):
        with pytest.raises(ValueError, match=text):
            vc.refine_arrays(points, cells, marks, **options)
    points[3] = np.nan
    with pytest.raises(ValueError, match="point 3 is not finite"):
        vc.refine_arrays(points, cells, [0])


def test_other_threads_go_on():
    points, cells = square(300)
    count = 0
    thread = threading.Thread(target=vc.refine_arrays, args=(points, cells, range(len(cells))))
    thread.start()
    while thread.is_alive():
        count += 1
    assert count > 10


def test_the_example_with_scikit_fem(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(ROOT / "samples")
    adaptive = importlib.import_module("adaptive")
    steps = adaptive.adaptive()
    plain = adaptive.uniform(steps[-1].unknowns)
    assert len(steps) == 6 and steps[0].error == plain[0].error

    def slope(history):
        counts = np.log([solved.unknowns for solved in history])
        return np.polyfit(counts, np.log([solved.error for solved in history]), 1)[0]

    # the optimal rate, and that of the corner's singularity
    assert slope(steps) < -0.45 and -0.37 < slope(plain) < -0.3
    adaptive.draw(steps, plain, tmp_path / "meshes.png")
    assert (tmp_path / "meshes.png").stat().st_size > 50_000
