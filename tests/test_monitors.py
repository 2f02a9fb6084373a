"""Monitors in Python: as the command line, with arrays and meshes in memory."""

from __future__ import annotations

import subprocess
import warnings

import numpy as np
import pytest
import pyvista as pv
from test_module import SAMPLES, solid, square, wave
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

import vtu2contour as vc

KINDS = ("defect", "area", "stepwise", "interpolation")
PDE = "uxx + uyy + uzz = -14*u"


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("cell", ["tetrahedra", "hexahedra"])
def test_meshes_are_judged_as_by_the_command_line(program, tmp_path, kind, cell):
    grid, file, output = solid(cell, 3), tmp_path / "in.vtu", tmp_path / "out.vtu"
    grid.save(file)
    options = ["-a", "u", "-m", kind, "--pde", PDE, "--select", "bulk:0.5", "--name", "eta"]
    subprocess.run([program, "monitor", file, "-o", output, *options], check=True)
    expected = pv.read(output)
    found = vc.monitor(grid, kind, scalars="u", pde=PDE, select="bulk:0.5", name="eta")
    assert isinstance(found, pv.UnstructuredGrid) and found.n_cells == grid.n_cells
    for name in ("eta", "etaMarks", "number"):
        assert np.array_equal(found.cell_data[name], expected.cell_data[name]), name
    assert 0 < found["etaMarks"].sum() < grid.n_cells
    # the mesh that was given has nothing new
    assert "eta" not in grid.cell_data


@pytest.mark.parametrize("kind", KINDS)
def test_arrays_are_judged_as_meshes(kind):
    grid = solid(n=3)
    cells = grid.cells_dict[10]
    f = vc.Interpolant(grid.points, cells, grid["u"], grid["grad_u"], pde=PDE)
    found = f.monitor(kind)
    assert found.shape == (len(cells),) and found.dtype == np.float64
    expected = vc.monitor(grid, kind, scalars="u", pde=PDE)
    (name,) = set(expected.cell_data) - set(grid.cell_data)
    assert np.allclose(found, expected[name], rtol=1e-12, atol=0)
    # random points are those of their seed
    random = [f.monitor(kind, samples=5, seed=seed) for seed in (1, 1, 2)]
    assert np.array_equal(random[0], random[1]) and not np.array_equal(random[0], random[2])


def test_a_defect_is_of_the_pde_that_is_given():
    points, cells = square(4)
    u, grad = points[:, 0] ** 2, np.column_stack([2 * points[:, 0], 0 * points[:, 0]])
    f = vc.Interpolant(points, cells, u, grad)
    # |2 - k| times the area, which is 1/32
    found = f.monitor(
        "defect",
        pde="uxx + uyy = k*rho",
        parameters={"k": 3.0},
        arrays={"rho": np.ones(len(points))},
    )
    assert np.allclose(found, 1 / 32, rtol=1e-12)
    g = vc.Interpolant(points, cells, u, grad, pde="uxx + uyy = 2")
    assert np.allclose(g.monitor("defect"), 0, atol=1e-14)
    assert np.allclose(g.monitor("defect", pde="uxx + uyy = 3"), 1 / 32, rtol=1e-12)
    grid = solid(n=2)
    u, grad = grid.points[:, 0] ** 2, np.zeros((grid.n_points, 3))
    grad[:, 0] = 2 * grid.points[:, 0]
    h = vc.Interpolant(grid.points, grid.cells_dict[10], u, grad)
    volumes = np.abs(grid.compute_cell_sizes()["Volume"])
    assert np.allclose(h.monitor("defect", pde="uxx + uyy + uzz = 3"), volumes, rtol=1e-9)
    with pytest.raises(ValueError, match="needs the PDE: give pde=EQUATION"):
        f.monitor("defect")
    with pytest.raises(ValueError, match="kind must be 'defect' or 'area'"):
        f.monitor("residual")
    with pytest.raises(ValueError, match="second must be 'pqi'"):
        f.monitor("interpolation", second="best")
    with pytest.raises(ValueError, match="from 1 to 65535"):
        f.monitor("area", samples=0)


def test_vtk_in_vtk_out_and_blocks():
    grid = solid(n=3)
    raw = vtkUnstructuredGrid()
    raw.ShallowCopy(grid)
    found = vc.monitor(raw, "area", scalars="u")
    assert type(found) is vtkUnstructuredGrid
    assert found.GetCellData().GetArray("AreaMonitor").GetNumberOfTuples() == grid.n_cells
    bare = grid.copy()
    bare.point_data.remove("u")
    blocks = pv.MultiBlock([grid, None, bare, pv.MultiBlock([grid])])
    judged = vc.monitor(blocks, "area", scalars="u")
    assert isinstance(judged, pv.MultiBlock) and judged.n_blocks == 4
    expected = vc.monitor(grid, "area", scalars="u")["AreaMonitor"]
    assert np.array_equal(judged[0]["AreaMonitor"], expected)
    assert np.array_equal(judged[3][0]["AreaMonitor"], expected)
    assert judged[1] is None and "AreaMonitor" not in judged[2].cell_data
    assert "AreaMonitor" not in grid.cell_data


def test_surfaces_and_images_keep_their_kind():
    image = pv.ImageData(dimensions=(4, 4, 1), spacing=(1 / 3, 1 / 3, 1))
    image["u"], image["grad_u"] = wave(np.asarray(image.points, float))
    judged = vc.monitor(image, "interpolation", scalars="u")
    assert isinstance(judged, pv.ImageData) and (judged["InterpolationMonitor"] > 0).all()
    surface = image.extract_surface(algorithm=None)
    judged = vc.monitor(surface, "stepwise", scalars="u", select="fraction:0.5")
    assert isinstance(judged, pv.PolyData) and judged["StepwiseMonitorMarks"].sum() >= 4


def test_what_cannot_be_judged_is_told():
    grid = solid(n=2)
    grid["u"][0] = np.nan
    with pytest.warns(UserWarning, match="cells could not be judged, and are NaN"):
        judged = vc.monitor(grid, "area", scalars="u", gradient="grad_u")
    assert 0 < np.isnan(judged["AreaMonitor"]).sum() < grid.n_cells
    with pytest.raises(vc.MissingArrayError):
        vc.monitor(grid, "area", scalars="none")
    with pytest.raises(ValueError, match="select must be"):
        vc.monitor(grid, "area", scalars="u", select="most")
    with pytest.raises(ValueError, match="a part of the cells is above 0"):
        vc.monitor(grid, "area", scalars="u", gradient="grad_u", select="bulk:2")


def test_the_accessor_of_pyvista():
    mesh = pv.read(SAMPLES / "problem4.vtu")
    options = {"pde": "uxx + uyy = laplacian"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        expected = vc.monitor(mesh, "defect", **options)["DefectMonitor"]
        if hasattr(mesh, "dei"):
            assert np.array_equal(mesh.dei.monitor("defect", **options)["DefectMonitor"], expected)
