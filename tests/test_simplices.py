"""Cells of all types as simplices, and gradients by their shape functions, beside VTK's."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import pyvista
from conftest import ROOT

import vtk

REAL = Path(os.environ.get("VTU2CONTOUR_DATA", ROOT.parent / "shared" / "data"))

FLAT = [5, 8, 9, 22, 23, 28, 30, 34]
SOLID = [10, 11, 12, 13, 14, 15, 16, 24, 25, 26, 27, 29, 31, 32, 33, 37]
QUADRATIC = [22, 23, 24, 25, 26, 28, 29, 30, 31, 32, 33, 34]
# order two: Lagrange types, the plain types of the same nodes, and Bézier types
HIGHER = {69: (22, 76), 70: (28, 77), 71: (24, 78), 72: (29, 79), 73: (32, 80)}


@pytest.fixture(scope="session")
def split_cells() -> Path:
    subprocess.run(["cargo", "build", "--quiet", "--example", "split-cells"], cwd=ROOT, check=True)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return target / "debug" / "examples" / "split-cells"


@pytest.fixture
def split(split_cells, tmp_path):
    """Splits a grid: ``split(grid)`` gives the simplices and what the program told."""

    def run(grid: pyvista.UnstructuredGrid):
        source, output = tmp_path / "grid.vtu", tmp_path / "simplices.vtu"
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetFileName(str(source))
        writer.Write()
        command = [split_cells, source, output]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return pyvista.read(output), done.stdout

    return run


def new_cell(kind: int) -> vtk.vtkCell:
    """A cell of VTK's; of order two if it is of a kind of any order."""
    cell = vtk.vtkGenericCell.InstantiateCell(kind)
    if kind in HIGHER or kind in (bezier for _, bezier in HIGHER.values()):
        count = {69: 6, 70: 9, 71: 10, 72: 27, 73: 18}[kind if kind in HIGHER else kind - 7]
        cell.GetPointIds().SetNumberOfIds(count)
        cell.GetPoints().SetNumberOfPoints(count)
        if hasattr(cell, "SetUniformOrderFromNumPoints"):
            cell.SetUniformOrderFromNumPoints(count)
        cell.Initialize()
    return cell


def reference_nodes(kind: int) -> np.ndarray:
    """The parametric coordinates of the nodes of a type, shape (n, 3)."""
    cell = new_cell(kind)
    return np.array(cell.GetParametricCoords()).reshape(-1, 3)[: cell.GetNumberOfPoints()]


def one_cell(kind: int, points: np.ndarray) -> pyvista.UnstructuredGrid:
    cells = np.concatenate([[len(points)], np.arange(len(points))])
    return pyvista.UnstructuredGrid(cells, np.array([kind], np.uint8), points)


def sheared(nodes: np.ndarray) -> np.ndarray:
    """Nodes moved by an affine map that keeps flat cells in a slanted plane."""
    return nodes @ np.array([[2.0, 0.3, 0.1], [0.2, 1.5, 0.4], [-0.3, 0.2, 1.2]]) + [1.0, 2.0, 3.0]


def bent(nodes: np.ndarray, seed: int) -> np.ndarray:
    """Nodes moved a little at random, each on its own."""
    return sheared(nodes + np.random.default_rng(seed).uniform(-0.04, 0.04, nodes.shape))


@pytest.mark.parametrize("kind", FLAT + SOLID)
def test_area_and_volume_are_those_of_vtk(kind, split):
    # pixels and voxels are along the axes
    move = sheared if kind not in (8, 11) else lambda nodes: nodes * [2, 3, 4]
    grid = one_cell(kind, move(reference_nodes(kind)))
    ours, told = split(grid)
    assert "left out: no cells; folded: no cells" in told
    sizes = grid.compute_cell_sizes()
    size = "Area" if kind in FLAT else "Volume"
    expected = abs(sizes[size][0])
    found = ours.compute_cell_sizes()[size]
    assert (found > 0).all()
    assert found.sum() == pytest.approx(expected, rel=1e-6 if kind > 20 else 1e-12)


def vtk_gradients(kind: int, points: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The gradient at each node by VTK's shape functions, shape (n, 3)."""
    cell = new_cell(kind)
    for n, point in enumerate(points):
        cell.GetPoints().SetPoint(n, *point)
        cell.GetPointIds().SetId(n, n)
    gradients = []
    for place in reference_nodes(kind):
        gradient = [0.0] * 3
        if kind == 30:
            # VTK's own Derivatives of this type are the same at all places
            slopes = [0.0] * (2 * len(points))
            cell.InterpolateDerivs(list(place), slopes)
            slopes = np.array(slopes).reshape(2, -1)
            gradient = np.linalg.pinv(slopes @ points) @ (slopes @ values)
        else:
            cell.Derivatives(0, list(place), list(values), 1, gradient)
        gradients.append(gradient)
    return np.array(gradients)


@pytest.mark.parametrize("kind", QUADRATIC + list(HIGHER))
def test_gradients_are_those_of_vtk(kind, split):
    points = bent(reference_nodes(kind), kind)
    if new_cell(kind).GetCellDimension() == 2:
        # VTK's flat cells are in a plane
        points = sheared(points * [1, 1, 0])
    values = np.random.default_rng(kind).uniform(size=len(points))
    grid = one_cell(kind, points)
    grid["u"] = values
    ours, _ = split(grid)
    expected = vtk_gradients(kind, points, values)
    assert np.abs(ours["gradient of u"] - expected).max() < 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("rational", [False, True])
@pytest.mark.parametrize("kind", list(HIGHER))
def test_bezier_cells_are_cut_where_they_are(kind, rational, split):
    """The nodes of the simplices and their data are those that VTK finds on the cell."""
    bezier = HIGHER[kind][1]
    nodes = reference_nodes(kind)
    points = bent(nodes, kind)
    random = np.random.default_rng(kind)
    weights = random.uniform(0.5, 2.0, len(nodes)) if rational else np.ones(len(nodes))
    grid = one_cell(bezier, points)
    grid["u"] = random.uniform(size=len(nodes))
    if rational:
        grid["w"] = weights
        grid.GetPointData().SetActiveAttribute("w", vtk.vtkDataSetAttributes.RATIONALWEIGHTS)
    cell = grid.GetCell(0)
    expected = []
    for place in nodes:
        position, shares = [0.0] * 3, [0.0] * len(nodes)
        cell.EvaluateLocation(vtk.mutable(0), list(place), position, shares)
        expected.append([*position, np.dot(shares, grid["u"])])
    ours, told = split(grid)
    assert "left out: no cells" in told
    assert np.abs(np.c_[ours.points, ours["u"]] - expected).max() < 1e-12
    assert np.abs(ours.points - points).max() > 1e-3


def test_bad_weights_are_told(split):
    grid = one_cell(77, reference_nodes(70))
    grid["u"] = np.arange(9.0)
    grid["w"] = np.append(np.ones(8), -1.0)
    grid.GetPointData().SetActiveAttribute("w", vtk.vtkDataSetAttributes.RATIONALWEIGHTS)
    _, told = split(grid)
    assert "1 Bézier quads (with weights that are not positive)" in told


FILES = [
    ("vtkdata/QuadraticTetra.vtu", "Volume", 1e-5),
    ("vtkdata/CylinderQuadratic.vtk", "Volume", 1e-5),
    ("vtkdata/polyhedron2pieces.vtu", "Volume", 1e-5),
    ("vtkdata/uGridEx.vtk", "Volume", 1e-5),
    ("vtkdata/uGridEx.vtk", "Area", 1e-5),
    ("vtkdata/blow.vtk", "Area", 1e-5),
    ("vtkdata/Disc_BiQuadraticQuads.vtu", "Area", 1e-3),
    ("mfem/star-mixed-p2.vtk", "Area", 1e-3),
    ("mfem/square-disc-p2.vtk", "Area", 1e-3),
    ("mfem/escher-p2.vtk", "Volume", 1e-5),
    ("vtkio/box_para.vtu", "Area", 1e-5),
]


@pytest.mark.skipif(not REAL.is_dir(), reason="the real files are not here")
@pytest.mark.parametrize(("name", "size", "tolerance"), FILES)
def test_real_files_keep_their_size(name, size, tolerance, split):
    grid = pyvista.read(REAL / name).cast_to_unstructured_grid()
    ours, told = split(grid)
    assert "left out: no cells" in told
    expected = np.abs(grid.compute_cell_sizes()[size]).sum()
    assert ours.compute_cell_sizes()[size].sum() == pytest.approx(expected, rel=tolerance)


@pytest.mark.skipif(not REAL.is_dir(), reason="the real files are not here")
@pytest.mark.parametrize("name", ["lagrange/data2d.vtu", "lagrange/data3d.vtu"])
def test_higher_orders_are_told(name, split):
    ours, told = split(pyvista.read(REAL / name))
    assert ours.n_cells == 0
    assert "(of order above 2)" in told
