"""The Python module: as the command line, with arrays and meshes in memory."""

from __future__ import annotations

import doctest
import importlib
import os
import re
import signal
import subprocess
import sys
import textwrap
import threading
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv

import vtu2contour as vc

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "samples"


def square(n: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) of the unit square and triangles."""
    grid = pv.ImageData(dimensions=(n + 1, n + 1, 1), spacing=(1 / n, 1 / n, 1)).triangulate()
    return np.array(grid.points[:, :2], float), grid.cells_dict[5]


def wave(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values and gradients of a smooth function that is no cubic."""
    s, c = np.sin(points @ [3.0, 2.0, 1.0]), np.cos(points @ [3.0, 2.0, 1.0])
    return s, c[:, None] * [3.0, 2.0, 1.0]


def solid(cell: str = "tetrahedra", n: int = 5) -> pv.UnstructuredGrid:
    """The unit cube with a wave, as n^3 hexahedra or tetrahedra of them, in double precision."""
    image = pv.ImageData(dimensions=3 * [n + 1], spacing=3 * [1 / n])
    grid = image.triangulate() if cell == "tetrahedra" else image.cast_to_unstructured_grid()
    grid.points = grid.points.astype(float)
    grid["u"], grid["grad_u"] = wave(grid.points)
    grid.point_data["other"] = np.arange(grid.n_points, dtype=np.float32)
    grid.cell_data["number"] = np.arange(grid.n_cells)
    return grid


def triangles(surface: pv.PolyData) -> Counter:
    """The triangles by where their corners are, to 1e-12, each with how often it is there."""
    corners = surface.points[surface.faces.reshape(-1, 4)[:, 1:]].round(12) + 0.0
    return Counter(tuple(sorted(map(tuple, triangle))) for triangle in corners.tolist())


def pieces_with_ghosts(grid: pv.UnstructuredGrid, layers: int) -> list[pv.UnstructuredGrid]:
    """A grid in two pieces, below and above z = 0.4, each with so many layers of the cells of the
    other, by common points, as ghosts."""
    is_above = grid.cell_centers().points[:, 2] > 0.4
    pieces = []
    for own in (~is_above, is_above):
        kept = np.flatnonzero(own)
        for _ in range(layers):
            points = np.unique(np.concatenate([grid.get_cell(n).point_ids for n in kept]))
            kept = grid.extract_points(points, adjacent_cells=True)["vtkOriginalCellIds"]
            kept = np.sort(kept)
        piece = grid.extract_cells(kept)
        is_ghost = ~own[piece.cell_data["vtkOriginalCellIds"]]
        for data in (piece.point_data, piece.cell_data):
            for name in [name for name in data if name.startswith("vtkOriginal")]:
                data.remove(name)
        piece.cell_data["vtkGhostType"] = is_ghost.astype(np.uint8)
        pieces.append(piece)
    return pieces


def same(one: pv.PolyData, other: pv.PolyData) -> None:
    """The same points, cells and data, to the last bit."""
    assert one.n_points > 0 and one.n_cells > 0
    assert np.array_equal(one.points, other.points) and one.points.dtype == other.points.dtype
    assert np.array_equal(one.lines, other.lines) and np.array_equal(one.faces, other.faces)
    for here, there in ((one.point_data, other.point_data), (one.cell_data, other.cell_data)):
        assert sorted(here) == sorted(there)
        for name in here:
            assert np.array_equal(here[name], there[name]), name
            assert here[name].dtype == there[name].dtype, name


@pytest.mark.parametrize(
    ("source", "options", "arguments"),
    [
        ("islands.vtu", {}, []),
        ("islands.vtu", {"pde": "uxx + uyy = -k2*u"}, ["--pde", "uxx + uyy = -k2*u"]),
        ("no_gradient.vtu", {"segments": True}, ["--segments"]),
        ("surface.vtu", {"normals": True, "gradients": True}, ["--normals", "--gradients"]),
        ("plate_with_holes.vtu", {"interpolant": "linear"}, ["--interpolant", "linear"]),
    ],
)
def test_meshes_are_contoured_as_by_the_command_line(contour, source, options, arguments):
    mesh = pv.read(SAMPLES / source)
    written = pv.read(contour(SAMPLES / source, "-n", "7", *arguments))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        same(vc.contour(mesh, 7, **options), written)


@pytest.mark.parametrize("cell", ["tetrahedra", "hexahedra"])
def test_solids_are_contoured_as_by_the_command_line(contour, tmp_path, cell):
    grid = solid(cell)
    grid.save(tmp_path / "solid.vtu")
    options = ["-a", "u", "-v", "0.1,0.5", "--nside", "3", "--normals"]
    written = pv.read(contour(tmp_path / "solid.vtu", *options))
    same(vc.contour(grid, [0.1, 0.5], scalars="u", nside=3, normals=True), written)


def test_vtk_in_vtk_out():
    grid = pv.read(SAMPLES / "islands.vtu")
    from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

    plain = vtkUnstructuredGrid()
    plain.ShallowCopy(grid)
    output = vc.contour(plain, [0.1, 0.2])
    assert type(output) is vtkPolyData
    same(pv.wrap(output), vc.contour(grid, [0.1, 0.2]))


def test_arrays_are_contoured_as_the_mesh_of_them():
    grid = solid()
    f = vc.Interpolant(grid.points, grid.cells_dict[10], grid["u"], grid["grad_u"])
    found = f.contour([0.1, 0.5], nside=3, normals=True)
    mesh = vc.contour(grid, [0.1, 0.5], scalars="u", nside=3, normals=True)
    assert np.array_equal(found.points, mesh.points)
    assert np.array_equal(found.triangles, mesh.faces.reshape(-1, 4)[:, 1:])
    assert np.array_equal(found.values, mesh["u"])
    assert np.array_equal(found.normals.astype(np.float32), mesh.point_data["Normals"])
    again = found.to_pyvista()
    assert np.array_equal(again.faces, mesh.faces) and "Normals" in again.point_data


def test_an_interpolant_is_kept():
    grid = pv.read(SAMPLES / "plate_with_holes.vtu")
    kept = vc.MeshInterpolant(grid, pde="uxx + uyy = -6")
    for level in (0.1, 0.3):
        same(kept.contour([level]), vc.contour(grid, [level], pde="uxx + uyy = -6"))


def test_contours_for_once_are_those_of_a_kept_interpolant():
    # few cells hold one of these levels, so few are computed for once
    grid = solid(n=14)
    kept = vc.MeshInterpolant(grid, scalars="u")
    for levels in ([-0.99], [0.3], [0.95], 3):
        found = vc.contour(grid, levels, scalars="u")
        assert found.n_cells > 0
        same(kept.contour(levels), found)
    with pytest.warns(UserWarning, match="no contour") as once:
        vc.contour(grid, [9.0], scalars="u")
    with pytest.warns(UserWarning) as later:
        kept.contour([9.0])
    assert [str(w.message) for w in once] == [str(w.message) for w in later]


@pytest.mark.parametrize("pde", [None, "uxx + uyy + uzz = -3*u"])
def test_arrays_contoured_once_are_those_of_a_kept_interpolant(pde):
    grid = solid(n=14)
    arrays = (grid.points, grid.cells_dict[10], grid["u"], grid["grad_u"])
    f = vc.Interpolant(*arrays, pde=pde)
    for levels in ([-0.99], [0.3], 3):
        kept, once = (
            f.contour(levels, nside=3),
            vc.contour_arrays(*arrays, levels, pde=pde, nside=3),
        )
        assert len(once.triangles) > 0 and once.counts == kept.counts
        assert np.array_equal(once.points, kept.points)
        assert np.array_equal(once.triangles, kept.triangles)
        assert np.array_equal(once.values, kept.values)
    with pytest.raises(ValueError, match=r"u must have shape \(n,\)"):
        vc.contour_arrays(grid.points, arrays[1], grid.points)


@pytest.mark.parametrize("dtype", [np.int32, np.uint32, np.int64, np.uint64, np.int16])
@pytest.mark.parametrize("real", [np.float64, np.float32])
def test_types(dtype, real):
    points, cells = square()
    u, grad = (points**2).sum(axis=1).astype(real), (2 * points).astype(real)
    f = vc.Interpolant(points.astype(real), cells.astype(dtype), u, grad)
    circle = f.contour([0.25])
    assert np.allclose(np.linalg.norm(circle.points, axis=1), 0.5, atol=1e-6)
    assert len(circle.lines) == 1 and len(circle.triangles) == 0


def test_one_contour_takes_a_third_of_the_arrays_besides_them():
    script = ROOT / "benches" / "memory_of_module.py"
    # Each array has pages of its own, so that none lies in pages that others have left free, by
    # chance; each thread more may keep two megabytes that are free, now and then.
    steady = {**os.environ, "RAYON_NUM_THREADS": "1", "MALLOC_MMAP_THRESHOLD_": "16384"}
    run = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, check=True, env=steady
    )
    found = re.search(r"contoured once.* ([\d.]+) of it", run.stdout)
    # a copy of the values and gradients alone would be 0.23 more, one of the cells 0.6
    assert 1.0 < float(found[1]) <= 1.33, run.stdout


def test_other_orders_in_memory_are_copied():
    points, cells = square()
    u = (points**2).sum(axis=1)
    plain = vc.Interpolant(points, cells, u, 2 * points).contour([0.3])
    shuffled = vc.Interpolant(
        np.asfortranarray(points), np.asfortranarray(cells), np.repeat(u, 2)[::2], 2 * points
    )
    assert np.array_equal(plain.points, shuffled.contour([0.3]).points)


def test_float64_arrays_are_looked_at_where_they_are():
    grid = solid()
    points, cells = np.array(grid.points), grid.cells_dict[10].astype(np.int32)
    f = vc.Interpolant(points, cells, grid["u"], grid["grad_u"])
    moved = f.contour([0.2]).points + 1
    points += 1
    assert np.allclose(f.contour([0.2]).points, moved, atol=1e-12)


def test_values_and_gradients_at_points():
    points, cells = square()
    f = vc.Interpolant(points, cells, (points**2).sum(axis=1), 2 * points)
    at = np.random.default_rng(1).random((1000, 2))
    at = np.vstack([at, points, (points[cells[:, 0]] + points[cells[:, 1]]) / 2])
    assert np.allclose(f(at), (at**2).sum(axis=1), atol=1e-13)
    assert np.allclose(f.gradient(at)[:, :2], 2 * at, atol=1e-12)
    assert np.isnan(f([[1.1, 0.5]])).all() and np.isnan(f.gradient([[0.5, 0.5, 0.1]])).all()


def test_values_converge_with_the_third_order_at_least_and_gradients_with_the_second():
    at = np.random.default_rng(2).random((1000, 3))
    u, grad = wave(at)
    cubes = [vc.MeshInterpolant(solid(n=n), scalars="u") for n in (5, 10)]
    of_values = [np.abs(cube(at) - u).mean() for cube in cubes]
    of_gradients = [np.abs(cube.gradient(at) - grad).mean() for cube in cubes]
    assert of_values[0] > 7 * of_values[1] and of_gradients[0] > 3.5 * of_gradients[1]


def test_pde_with_parameters_and_arrays():
    points, cells = square(6)
    u, grad = np.exp(points[:, 0]), np.column_stack([np.exp(points[:, 0]), 0 * points[:, 0]])
    plain = vc.Interpolant(points, cells, u, grad, interpolant="quadratic-precision")
    of_arrays = vc.Interpolant(
        points, cells, u, grad, pde="a*uxx + uyy = f", parameters={"a": 2.0}, arrays={"f": 2 * u}
    )
    at = np.random.default_rng(3).random((500, 2))
    errors = [np.abs(f(at) - np.exp(at[:, 0])).max() for f in (plain, of_arrays)]
    assert errors[1] < errors[0]
    with pytest.raises(ValueError, match="one of the values of an array"):
        vc.Interpolant(points, cells, u, grad, pde="uxx = f", arrays={"f": [1.0]})
    with pytest.raises(ValueError, match="pde: "):
        vc.Interpolant(points, cells, u, grad, pde="uxx + = 1")


def test_errors_say_what_to_do():
    mesh = pv.read(SAMPLES / "islands.vtu")
    with pytest.raises(vc.MissingArrayError, match="no point array 'v'; the point arrays are 'u'"):
        vc.contour(mesh, [0.1], scalars="v")
    with pytest.raises(ValueError, match="^tolerance must be a positive number"):
        vc.contour(mesh, [0.1], tolerance=-1)
    with pytest.raises(ValueError, match="method must be 'intercept' or"):
        vc.contour(mesh, [0.1], method="other")
    with pytest.raises(TypeError, match="vtu2contour.Interpolant takes NumPy arrays"):
        vc.contour(np.zeros(3), [0.1])
    with pytest.raises(vc.NothingToContourError, match="nothing to contour"):
        vc.contour(
            pv.Line().cast_to_unstructured_grid().point_data_to_cell_data(pass_point_data=True),
            [0.1],
            scalars="Texture Coordinates",
            component=0,
        )
    points, cells = square()
    u = points[:, 0]
    with pytest.raises(ValueError, match="uses point 1000, but there are only 81 points"):
        vc.Interpolant(points, np.array([[0, 1, 1000]]), u)
    with pytest.raises(ValueError, match="counted from 0"):
        vc.Interpolant(points, np.array([[0, 1, -1]]), u)
    with pytest.raises(ValueError, match="one of the values for each point"):
        vc.Interpolant(points, cells, u[1:])
    with pytest.raises(ValueError, match="shape"):
        vc.Interpolant(points, cells, u, points[:, :1])


def test_levels_outside_are_told():
    mesh = pv.read(SAMPLES / "islands.vtu")
    with pytest.warns(UserWarning, match="no contour at 99.0: outside the range") as told:
        assert vc.contour(mesh, [99.0]).n_cells == 0
    assert told[0].filename == __file__


def test_blocks_are_contoured_one_by_one():
    left, right = solid(), solid()
    right.points += [1.0, 0.0, 0.0]
    empty, bare = pv.UnstructuredGrid(), solid()
    bare.point_data.clear()
    blocks = pv.MultiBlock({"left": left, "empty": empty, "inner": pv.MultiBlock([right, bare])})
    output = vc.contour(blocks, 3, scalars="u")
    assert isinstance(output, pv.MultiBlock) and output.keys() == ["left", "empty", "inner"]
    whole = vc.MeshInterpolant(blocks, scalars="u")
    size = whole.info["diagonal"]
    assert np.isclose(size, 6**0.5)
    levels = np.unique(output["left"]["u"])
    assert len(levels) == 3
    alone = vc.MeshInterpolant(left, scalars="u").contour(levels, size=size)
    same(output["left"], alone)
    assert output["inner"][0].n_cells == alone.n_cells and output["inner"][1] is None
    with pytest.raises(vc.MissingArrayError):
        vc.contour(pv.MultiBlock([bare, empty]), [0.1], scalars="u")


def test_the_accessor_is_there_without_an_import():
    program = """
        import pyvista, sys
        mesh = pyvista.read(sys.argv[1])
        assert "vtu2contour" not in sys.modules
        assert mesh.dei.contour([0.1]).n_cells > 0
        assert mesh.dei.interpolant().range == mesh.dei.info()["range"]
    """
    run(program, SAMPLES / "islands.vtu")


def run(program: str, *arguments: object) -> subprocess.CompletedProcess:
    """Runs a program in another interpreter."""
    command = [sys.executable, "-c", textwrap.dedent(program), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


def test_neither_vtk_nor_pyvista_is_imported():
    run("""
        import sys, vtu2contour, numpy
        points = numpy.array([[0.0, 0], [1, 0], [0, 1]])
        vtu2contour.Interpolant(points, [[0, 1, 2]], points[:, 0], 0 * points + [1, 0]).contour(3)
        names = [name.partition(".")[0] for name in sys.modules]
        assert not {"vtk", "vtkmodules", "pyvista"} & set(names)
    """)


def test_other_threads_run_meanwhile():
    grid = pv.ImageData(dimensions=(31, 31, 31)).triangulate()
    points, cells = np.array(grid.points, float), grid.cells_dict[10]
    beats, is_done = 0, threading.Event()

    def work() -> None:
        vc.Interpolant(points, cells, np.sin(points[:, 0]))
        is_done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not is_done.wait(0.001):
        beats += 1
    thread.join()
    assert beats > 10


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on POSIX")
def test_ctrl_c_ends_a_long_job():
    program = textwrap.dedent("""
        import numpy as np, vtu2contour as vc
        n = 140
        i, j, k = np.meshgrid(*3 * [np.arange(n)], indexing="ij")
        corner = ((i * (n + 1) + j) * (n + 1) + k).ravel()
        cells = np.column_stack([corner, corner + (n + 1) ** 2, corner + n + 1, corner + 1])
        points = np.random.default_rng(0).random(((n + 1) ** 3, 3))
        print("begin", flush=True)
        try:
            vc.Interpolant(points, cells, np.sin(9 * points[:, 0]))
        except KeyboardInterrupt:
            print("interrupted", flush=True)
            small = vc.Interpolant(points[:4], [[0, 1, 2, 3]], points[:4, 0], 0 * points[:4])
            print(small.info["tetrahedra"])
        else:
            print("done")
    """)
    process = subprocess.Popen(
        [sys.executable, "-W", "ignore", "-c", program], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begin\n"
    threading.Event().wait(0.5)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=60)
    assert output.split() == ["interrupted", "1"]


@pytest.mark.parametrize(("given", "layers"), [(True, 1), (False, 4)])
def test_pieces_with_ghosts_make_the_contour_of_the_whole(given, layers):
    grid = solid(n=8)
    if not given:
        grid.point_data.remove("grad_u")

    def contour(mesh: pv.UnstructuredGrid) -> Counter:
        return triangles(vc.contour(mesh, [0.5], scalars="u", nside=3))

    whole = contour(grid)
    assert sum(map(contour, pieces_with_ghosts(grid, layers)), Counter()) == whole
    # one layer less does not do
    assert sum(map(contour, pieces_with_ghosts(grid, layers - 1)), Counter()) != whole


@pytest.mark.parametrize(
    "name", ["", ".interpolant", ".mesh_contour", ".refinement", ".contours", ".options"]
)
def test_examples_in_docstrings(name):
    module = importlib.import_module(f"vtu2contour{name}")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        failed, attempted = doctest.testmod(module)
    assert failed == 0 and (attempted > 0 or name in (".contours", ".options"))


def test_the_example_of_the_readme(monkeypatch):
    examples = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert examples
    monkeypatch.chdir(ROOT)
    for example in examples:
        exec(compile(example, "README.md", "exec"), {})


def test_stubs_and_types_are_installed():
    folder = Path(vc.__file__).parent
    assert (folder / "py.typed").exists() and (folder / "_core.pyi").exists()
    from vtu2contour import _core

    told = (folder / "_core.pyi").read_text()
    for name in (name for name in dir(_core) if not name.startswith("_")):
        assert re.search(rf"\b{name}\b", told), name
