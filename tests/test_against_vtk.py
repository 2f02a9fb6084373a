"""Our contours beside VTK's, and our files in the hands of VTK, pyvista and meshio."""

from __future__ import annotations

import meshio
import numpy as np
import pytest
import pyvista
from conftest import ROOT
from scipy.spatial import cKDTree

DATA = ROOT / "tests" / "data"
SAMPLES = ROOT / "samples"
PDE = (
    "uxx + uyy = -100*exp(-(5-10*x)^2/2) + (50-100*x)*ux"
    " - 150*exp(-(5-10*x)^2/2)*exp(-(5-10*y)^2/2) - 75*exp(-(5-10*y)^2/2) + (50-100*y)*uy"
)


def bell(x):
    return np.exp(-((5 - 10 * x) ** 2) / 2)


def exact(points):
    """The solution of problem 4 (thesis, eq. 5.1) at points, shape (n, 2 or 3)."""
    x, y = points[:, 0], points[:, 1]
    return bell(x) + 0.75 * bell(y) + 0.75 * bell(x) * bell(y)


def slope(points):
    """The length of its gradient."""
    x, y = points[:, 0], points[:, 1]
    ux = 10 * (5 - 10 * x) * bell(x) * (1 + 0.75 * bell(y))
    uy = 10 * (5 - 10 * y) * bell(y) * (0.75 + 0.75 * bell(x))
    return np.hypot(ux, uy)


def segments(lines: pyvista.PolyData):
    """The two ends of every segment, each of shape (n, 3), and the levels (n,)."""
    starts, ends = [], []
    for line in np.split(lines.lines, np.cumsum(1 + line_sizes(lines))[:-1]):
        starts.append(line[1:-1])
        ends.append(line[2:])
    starts, ends = np.concatenate(starts), np.concatenate(ends)
    return lines.points[starts], lines.points[ends], lines.point_data["u"][starts]


def line_sizes(lines: pyvista.PolyData):
    """The number of points of each line, shape (n,)."""
    sizes, place = [], 0
    while place < len(lines.lines):
        sizes.append(lines.lines[place])
        place += 1 + lines.lines[place]
    return np.array(sizes)


def distance_to_exact(lines: pyvista.PolyData):
    """Mean distance of points along the segments from the exact contour, weighted by length.

    The distance of a point is its value's difference from the level over the slope there.
    """
    start, end, level = segments(lines)
    length = np.linalg.norm(end - start, axis=1)
    total = 0.0
    parts = (np.arange(8) + 0.5) / 8
    for t in parts:
        points = start + t * (end - start)
        distance = np.abs(exact(points) - level) / slope(points)
        total += np.sum(distance * length) / np.sum(length)
    return total / len(parts)


LEVELS = [0.25, 0.5, 0.95, 1.25, 1.5, 1.75, 2.0, 2.25]


def test_distance_is_fifty_times_smaller_than_vtks(contour):
    """Problem 4, 1600 points."""
    source = DATA / "problem4_1600.vtu"
    theirs = distance_to_exact(pyvista.read(source).contour(LEVELS, scalars="u"))
    levels = ",".join(map(str, LEVELS))
    ours = distance_to_exact(pyvista.read(contour(source, "-v", levels, "--pde", PDE)))
    without = distance_to_exact(pyvista.read(contour(source, "-v", levels)))
    print(f"\nmean distance: VTK {theirs:.2e}, ours {ours:.2e}, without the PDE {without:.2e}")
    assert theirs > 50 * ours
    assert theirs > 20 * without


def test_the_linear_interpolant_gives_vtks_contour(contour):
    """On the linear interpolant, our lines are VTK's: same points, same length."""
    for name in ["problem4", "plate_with_holes", "surface"]:
        source = SAMPLES / f"{name}.vtu"
        grid = pyvista.read(source)
        low, high = grid.get_data_range("u")
        levels = list(np.linspace(low, high, 9)[1:-1])
        theirs = grid.contour(levels, scalars="u")
        listed = ",".join(map(repr, map(float, levels)))
        ours = pyvista.read(contour(source, f"--value={listed}", "--interpolant", "linear"))
        size = np.linalg.norm(np.ptp(grid.points, axis=0))
        tree = cKDTree(ours.points)
        apart, _ = tree.query(theirs.points)
        assert apart.max() < 1e-6 * size, name
        start, end, _ = segments(ours)
        ours_length = np.sum(np.linalg.norm(end - start, axis=1))
        theirs_length = theirs.compute_cell_sizes()["Length"].sum()
        assert ours_length == pytest.approx(theirs_length, rel=1e-6), name


def test_islands_that_vtk_misses(contour):
    """The mode of a drum at 0.56 has 14 islands; on this mesh the linear one has 6."""
    source = SAMPLES / "islands.vtu"
    ours = pyvista.read(contour(source, "-v", "0.56"))
    theirs = pyvista.read(source).contour([0.56], scalars="u").strip()
    assert (ours.n_lines, theirs.n_lines) == (14, 6)


@pytest.mark.parametrize("encoding", ["raw", "zlib", "lz4", "base64", "ascii"])
def test_every_reader_gives_the_same(contour, encoding):
    """VTK's reader (by pyvista) and meshio agree on our files, value by value."""
    source = SAMPLES / "problem4.vtu"
    options = ["--encoding", encoding, "--normals", "--gradients"]
    path = contour(source, *options)
    lines = pyvista.read(path)
    assert lines.n_points > 1000 and lines.n_lines == 20
    # values are those of the raw file
    raw = pyvista.read(contour(source, "--normals", "--gradients", name="raw.vtp"))
    assert np.array_equal(lines.points, raw.points)
    assert np.array_equal(lines.lines, raw.lines)
    for name in raw.point_data:
        assert np.array_equal(lines.point_data[name], raw.point_data[name]), name
    for name in raw.cell_data:
        assert np.array_equal(lines.cell_data[name], raw.cell_data[name]), name


@pytest.mark.parametrize("encoding", ["raw", "zlib", "base64", "ascii"])
def test_meshio_reads_our_lines(contour, encoding):
    """meshio has no reader of .vtp, none of LZ4 and no polylines: segments as .vtu."""
    options = ["--segments", "--encoding", encoding]
    lines = pyvista.read(contour(SAMPLES / "problem4.vtu", *options))
    mesh = meshio.read(contour(SAMPLES / "problem4.vtu", *options, name="lines.vtu"))
    assert np.array_equal(mesh.points, lines.points)
    assert np.array_equal(mesh.cells_dict["line"], lines.lines.reshape(-1, 3)[:, 1:])
    for name in lines.point_data:
        assert np.array_equal(mesh.point_data[name], lines.point_data[name]), name
    for name in lines.cell_data:
        assert np.array_equal(mesh.cell_data[name][0], lines.cell_data[name]), name


def test_data_travel_as_in_vtk(contour):
    """Names, values and kinds of data are those of VTK's own filter."""
    source = SAMPLES / "problem4.vtu"
    theirs = pyvista.read(source).contour([0.9], scalars="u")
    ours = pyvista.read(contour(source, "-v", "0.9", "--segments"))
    assert set(theirs.point_data) <= set(ours.point_data)
    assert set(theirs.cell_data) <= set(ours.cell_data)
    assert ours.active_scalars_name == "u"
    assert np.all(ours.point_data["u"] == 0.9)
    for name, array in theirs.point_data.items():
        assert ours.point_data[name].dtype == array.dtype, name
        assert ours.point_data[name].shape[1:] == array.shape[1:], name
    assert ours.field_data["TimeValue"] == pyvista.read(source).field_data["TimeValue"]
    # a cell's data are those of the cell that its segment lies in
    grid = pyvista.read(source)
    parents = ours.cell_data["OriginalCellIds"]
    middles = ours.cell_centers().points
    found = grid.find_containing_cell(middles)
    same = found == parents
    assert np.mean(same) > 0.99  # a segment may leave its cell by less than the tolerance
    assert np.array_equal(ours.cell_data["region"], grid.cell_data["region"][parents])


def test_a_level_through_nodes_makes_no_empty_segment(contour, tmp_path):
    """u = x on a grid: VTK's fast path makes degenerate pieces here, ours none."""
    grid = pyvista.ImageData(dimensions=(5, 5, 1)).cast_to_unstructured_grid()
    grid = grid.triangulate()
    grid.point_data["u"] = grid.points[:, 0].astype(float)
    grid.point_data["gradient"] = np.tile([1.0, 0.0, 0.0], (grid.n_points, 1))
    grid.set_active_scalars("u")
    grid.save(tmp_path / "grid.vtu")
    lines = pyvista.read(contour(tmp_path / "grid.vtu", "-v", "0,1,2,3,4"))
    assert lines.n_lines == 5
    start, end, _ = segments(lines)
    lengths = np.linalg.norm(end - start, axis=1)
    assert lengths.min() > 0 and lengths.sum() == pytest.approx(20)
