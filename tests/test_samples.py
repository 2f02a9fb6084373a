"""The samples: each script writes what is committed, and what it writes is what it claims.

Every check runs on the committed file and, where its bytes differ, on the one that its script
writes now. With another version of gmsh the two may have different meshes: both must be right.
They need the packages of samples/requirements.txt, and about a minute.
"""

from __future__ import annotations

import subprocess
import sys
from collections import defaultdict
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skfem import ElementTriP2
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "samples"
DATA = ROOT / "tests" / "data"
sys.path.insert(0, str(SAMPLES))

common = import_module("common")
islands = import_module("islands")
meshes = import_module("meshes")
no_gradient = import_module("no_gradient")
plate_with_holes = import_module("plate_with_holes")
problem4 = import_module("problem4")
surface = import_module("surface")

MESHES = [meshes.file_name(target) for target in meshes.TARGETS]
FILES = {
    "problem4.vtu": SAMPLES,
    "plate_with_holes.vtu": SAMPLES,
    "islands.vtu": SAMPLES,
    "surface.vtu": SAMPLES,
    "no_gradient.vtu": SAMPLES,
    **dict.fromkeys(MESHES, DATA),
}
GRADIENTS = {
    "problem4.vtu": "gradient",
    "plate_with_holes.vtu": "grad_u",
    "islands.vtu": "Gradients",
    "surface.vtu": "gradient",
    **dict.fromkeys(MESHES, "gradient"),
}


class Sample:
    """A file of triangles: its mesh and arrays, read by VTK."""

    def __init__(self, path: Path):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        self.grid = grid = reader.GetOutput()
        types = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
        assert types == {VTK_TRIANGLE}
        corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        self.precision = points.dtype
        self.mesh = common.TriangleMesh(points.astype(float), corners.astype(np.int64))
        self.point = _arrays(grid.GetPointData())
        self.cell = _arrays(grid.GetCellData())
        self.field = _arrays(grid.GetFieldData())

    def arrays(self) -> dict:
        """Everything in the file under a distinct name."""
        result = {"points": self.mesh.points, "triangles": self.mesh.triangles}
        for kind in ("point", "cell", "field"):
            result |= {f"{kind} {name}": array for name, array in getattr(self, kind).items()}
        return result


def _arrays(data) -> dict:
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    return {name: vtk_to_numpy(data.GetArray(name)) for name in names}


def run_scripts(folder: Path) -> Path:
    """Run every script in processes of their own; the folder now holds all files."""
    for script in sorted({SAMPLES / name for name in FILES if FILES[name] == SAMPLES}):
        _run(script.with_suffix(".py"), folder / script.name)
    _run(SAMPLES / "meshes.py", folder)
    return folder


def _run(script: Path, output: Path) -> None:
    subprocess.run([sys.executable, str(script), "--output", str(output)], check=True)


@pytest.fixture(scope="session")
def fresh(tmp_path_factory) -> Path:
    """A folder of files that the scripts have just written."""
    return run_scripts(tmp_path_factory.mktemp("samples"))


@pytest.fixture
def versions(fresh):
    """Reads a file by its name: the committed one and, where its bytes differ, the fresh one."""

    def read(name: str) -> list[Sample]:
        committed, written = FILES[name] / name, fresh / name
        same = committed.read_bytes() == written.read_bytes()
        return [Sample(path) for path in ([committed] if same else [committed, written])]

    return read


# The files


@pytest.mark.parametrize("name", FILES)
def test_script_writes_the_committed_file(name, fresh):
    committed, written = FILES[name] / name, fresh / name
    if committed.read_bytes() == written.read_bytes():
        return
    old, new = Sample(committed).arrays(), Sample(written).arrays()
    assert list(old) == list(new)
    assert len(new["points"]) == pytest.approx(len(old["points"]), rel=0.05)
    if same_mesh(old, new):
        for key in old:
            np.testing.assert_allclose(new[key], old[key], rtol=1e-9, atol=1e-9, err_msg=key)


def same_mesh(old: dict, new: dict) -> bool:
    """Whether two files' arrays have the same triangles, their points equal up to rounding."""
    return (
        np.array_equal(old["triangles"], new["triangles"])
        and old["points"].shape == new["points"].shape
        and np.allclose(old["points"], new["points"], rtol=0.0, atol=1e-9)
    )


def test_scripts_write_the_same_bytes_again(fresh, tmp_path):
    again = run_scripts(tmp_path)
    for name in FILES:
        assert (again / name).read_bytes() == (fresh / name).read_bytes(), name


@pytest.mark.parametrize("name", FILES)
def test_files_are_small(name):
    limit = 150 if FILES[name] == SAMPLES else 200
    assert (FILES[name] / name).stat().st_size < limit * 1024


def test_samples_show_a_reader_several_encodings():
    encodings = {
        "problem4.vtu": (b'encoding="raw"', b'header_type="UInt64"'),
        "plate_with_holes.vtu": (b'format="binary"', b"vtkZLibDataCompressor"),
        "islands.vtu": (b'format="ascii"',),
        "surface.vtu": (b'encoding="raw"', b"vtkLZ4DataCompressor", b'header_type="UInt32"'),
        "no_gradient.vtu": (b'format="binary"', b'type="Float32"'),
    }
    for name, marks in encodings.items():
        text = (SAMPLES / name).read_bytes()
        assert all(mark in text for mark in marks), name
    assert b"compressor" not in (SAMPLES / "no_gradient.vtu").read_bytes()


@pytest.mark.parametrize("name", FILES)
def test_meshes_are_good(versions, name):
    for sample in versions(name):
        mesh = sample.mesh
        assert len(np.unique(mesh.points, axis=0)) == len(mesh.points)
        assert np.array_equal(np.unique(mesh.triangles), np.arange(len(mesh.points)))
        assert smallest_angle(mesh) > 25.0
        if name != "surface.vtu":
            assert common.doubled_normals(mesh.points, mesh.triangles)[:, 2].min() > 0.0


def smallest_angle(mesh) -> float:
    """The smallest angle of all triangles, in degrees."""
    p = mesh.points[mesh.triangles]
    to_next, to_last = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    sine = np.linalg.norm(np.cross(to_next, to_last), axis=2)
    return float(np.degrees(np.arctan2(sine, (to_next * to_last).sum(axis=2))).min())


@pytest.mark.parametrize("name", GRADIENTS)
def test_gradients_match_finite_differences(versions, name):
    """Along each edge the trapezium rule turns gradients into differences of u, up to h^3.

    The edges of `islands` are a quarter of a wavelength: there the rule itself is 15 % off.
    """
    for sample in versions(name):
        u, g = sample.point["u"], sample.point[GRADIENTS[name]]
        ends = edges(sample.mesh.triangles)
        along = np.diff(sample.mesh.points[ends], axis=1)[:, 0]
        predicted = (g[ends].mean(axis=1) * along).sum(axis=1)
        difference = np.diff(u[ends], axis=1)[:, 0]
        limit = 0.2 if name == "islands.vtu" else 0.06
        assert np.linalg.norm(predicted - difference) < limit * np.linalg.norm(difference)


def edges(triangles) -> np.ndarray:
    """All sides (3 M, 2) of the triangles, vertices in increasing order, shared ones twice."""
    return np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]))


# Problem 4


def test_problem4_solution_satisfies_its_pde():
    points = np.random.default_rng(4).random((500, 2))
    np.testing.assert_allclose(
        problem4.laplacian(points), problem4.right_hand_side(points), atol=1e-10
    )


def test_problem4_formulas_match_finite_differences():
    points, h = np.random.default_rng(4).random((500, 2)), 1e-4
    shifted = [[problem4.solution(points + s * h * e) for s in (1, -1)] for e in np.eye(2)]
    slopes = np.column_stack([(up - down) / (2 * h) for up, down in shifted])
    np.testing.assert_allclose(problem4.gradient(points)[:, :2], slopes, atol=2e-5)
    second = sum((up + down) / h**2 for up, down in shifted) - 4 * problem4.solution(points) / h**2
    np.testing.assert_allclose(problem4.laplacian(points), second, atol=2e-3)


def test_problem4_sample(versions):
    for sample in versions("problem4.vtu"):
        points = sample.mesh.points
        assert_exact(sample)
        np.testing.assert_allclose(sample.point["laplacian"], problem4.laplacian(points), atol=1e-9)
        assert sample.grid.GetPointData().GetScalars().GetName() == "u"
        assert sample.field["TimeValue"] == [0.0]
        assert sample.cell["area"].sum() == pytest.approx(1.0)
        assert set(sample.cell["region"]) == {0, 1, 2, 3}
        assert 0.05 < sample.cell["error_of_linear"].max() < 0.12  # of 2.5: visibly kinked


@pytest.mark.parametrize("target", meshes.TARGETS)
def test_meshes_of_table_5_7(versions, target):
    for sample in versions(meshes.file_name(target)):
        assert len(sample.mesh.points) == pytest.approx(target, rel=0.01)
        assert common.areas(sample.mesh).sum() == pytest.approx(1.0)
        assert_exact(sample)


def assert_exact(sample) -> None:
    """The values and gradients are those of problem 4's closed form."""
    points, point = sample.mesh.points, sample.point
    np.testing.assert_allclose(point["u"], problem4.solution(points), atol=1e-11)
    np.testing.assert_allclose(point["gradient"], problem4.gradient(points), atol=1e-11)


# Plate with holes


def test_plate_has_converged(versions):
    """Against elements of a quarter of the size."""
    for sample in versions("plate_with_holes.vtu"):
        u, gradient = plate_with_holes.temperature(sample.mesh, refinements=2)
        assert np.abs(sample.point["u"] - u).max() < 2e-4
        assert np.abs(sample.point["grad_u"] - gradient).max() < 0.05
        assert np.abs(sample.point["grad_u"] - gradient).mean() < 1e-3


def test_plate_holds_its_boundary_values(versions):
    for sample in versions("plate_with_holes.vtu"):
        hot, insulated, cold = plate_with_holes.HOLES
        x, u = sample.mesh.points.T, sample.point["u"]
        assert np.all(u[np.abs(hot.distance(x) - hot.radius) < 1e-9] == 1.0)
        assert np.all(u[np.abs(cold.distance(x) - cold.radius) < 1e-9] == 0.0)
        rim = np.abs(insulated.distance(x) - insulated.radius) < 1e-9
        outward = (x[:2, rim] - [[insulated.x], [insulated.y]]) / insulated.radius
        flux = (sample.point["grad_u"][rim, :2] * outward.T).sum(axis=1)
        assert rim.sum() > 8
        assert np.abs(flux).max() < 0.1  # the greatest gradient is 3.9


# Islands


def test_islands_has_converged(versions):
    """Against elements of a quarter of the size: eigenvalue, mode, and its gradients."""
    for sample in versions("islands.vtu"):
        basis = islands.drum_basis(sample.mesh, refinements=2)
        k2, u = islands.mode(basis)
        values, gradients = common.vertex_data(basis, u, len(sample.mesh.points))
        assert sample.field["k2"][0] == pytest.approx(k2, rel=2e-6)
        assert np.abs(sample.point["u"] - values).max() < 2e-4
        assert np.abs(sample.point["Gradients"] - gradients).max() < 0.03


def test_islands_that_linear_contours_miss(versions):
    """At 0.56 the mode has 14 islands, some inside a cell; the linear interpolant has 6."""
    level = 0.56
    for sample in versions("islands.vtu"):
        coarse = len(sample.mesh.triangles)
        linear = cells_of_islands(sample.mesh.triangles, sample.point["u"], level, coarse)
        basis = islands.drum_basis(sample.mesh, refinements=3, element=ElementTriP2())
        fine, _ = common.vertex_data(basis, islands.mode(basis)[1], basis.mesh.nvertices)
        true = cells_of_islands(basis.mesh.t.T, fine, level, coarse)
        assert len(true) == 14
        assert len(linear) < 10
        assert sum(len(cells) == 1 for cells in true) >= 1


def cells_of_islands(triangles, u, level, coarse) -> list[set[int]]:
    """For each connected set of vertices with u > level, the coarse cells that it touches.

    Halving makes the children of triangle i of n the triangles i, i + n, i + 2 n, i + 3 n, so that
    the coarse cell of triangle i is i modulo the number of coarse cells.
    """
    ends = edges(triangles)
    ends = ends[(u[ends] > level).all(axis=1)]
    graph = coo_matrix((np.ones(len(ends)), ends.T), shape=(len(u), len(u)))
    _, label = connected_components(graph, directed=False)
    cells = defaultdict(set)
    for index, corners in enumerate(triangles):
        for vertex in corners[u[corners] > level]:
            cells[label[vertex]].add(index % coarse)
    return list(cells.values())


# Surface


def test_surface_is_a_closed_torus(versions):
    for sample in versions("surface.vtu"):
        mesh = sample.mesh
        np.testing.assert_allclose(surface.project(mesh.points.T).T, mesh.points, atol=1e-11)
        unique, count = np.unique(edges(mesh.triangles), axis=0, return_counts=True)
        assert set(count) == {2}
        euler = len(mesh.points) - len(unique) + len(mesh.triangles)
        assert euler == 0
        normal = common.doubled_normals(mesh.points, mesh.triangles)
        outward = surface.normals(mesh.points)[mesh.triangles[:, 0]]
        assert (normal * outward).sum(axis=1).min() > 0.0


def test_surface_gradients_are_tangential(versions):
    for sample in versions("surface.vtu"):
        normal = surface.normals(sample.mesh.points)
        np.testing.assert_allclose(sample.point["normal"], normal, atol=1e-11)
        assert np.abs((sample.point["gradient"] * normal).sum(axis=1)).max() < 1e-10


def test_surface_has_converged(versions):
    """Against elements of half the size, and the exact area of the torus."""
    for sample in versions("surface.vtu"):
        u, gradient = surface.temperature(sample.mesh, refinements=1)
        assert np.abs(sample.point["u"] - u).max() < 2e-3  # of 5.5
        assert np.abs(sample.point["gradient"] - gradient).max() < 0.06  # of 4.4
        exact = 4.0 * np.pi**2 * surface.MAJOR * surface.MINOR
        assert surface.torus_basis(sample.mesh).dx.sum() == pytest.approx(exact, rel=1e-8)


def test_surface_mapping_matches_finite_differences():
    x, h = np.random.default_rng(1).normal(size=(3, 20, 1)) + [[[1.0]], [[0.0]], [[0.0]]], 1e-6
    for axis, step in enumerate(h * np.eye(3)[:, :, None, None]):
        slope = (surface.project(x + step) - surface.project(x - step)) / (2 * h)
        np.testing.assert_allclose(surface.projection_slope(x)[:, axis], slope, atol=1e-6)


# No gradient


def test_no_gradient_has_only_values_in_single_precision(versions):
    for sample in versions("no_gradient.vtu"):
        assert list(sample.point) == ["u"] and not sample.cell
        assert sample.point["u"].dtype == sample.precision == np.float32
        assert sample.point["u"].min() == 0.0 and sample.point["u"].max() == 1.0


def test_no_gradient_has_converged(versions):
    """Against elements of half the size."""
    for sample in versions("no_gradient.vtu"):
        basis = no_gradient.conductor_basis(sample.mesh, no_gradient.REFINEMENTS + 1)
        _, u = no_gradient.potential(
            basis, no_gradient.upper_electrode, no_gradient.right_electrode
        )
        values, _ = common.vertex_data(basis, u, len(sample.mesh.points))
        assert np.abs(sample.point["u"] - values).max() < 1e-4


def test_no_gradient_resistance_lies_between_its_bounds(versions):
    """Conductance and its conjugate problem's bound the resistance from below and above."""
    for sample in versions("no_gradient.vtu"):
        basis = no_gradient.conductor_basis(sample.mesh)
        conductance, _ = no_gradient.potential(
            basis, no_gradient.upper_electrode, no_gradient.right_electrode
        )
        resistance, _ = no_gradient.potential(
            basis, no_gradient.inner_sides, no_gradient.outer_sides
        )
        assert 1.0 / conductance < 2.55852 < resistance
        assert resistance - 1.0 / conductance < 1e-4
