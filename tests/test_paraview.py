"""The plugin in ParaView: as the module, in every kind of input, and on two processes."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv
from conftest import ROOT
from test_module import pieces_with_ghosts, same, solid, triangles

import vtu2contour as vc

SCRIPTS = ROOT / "tests" / "paraview"

pytestmark = pytest.mark.skipif(
    shutil.which("pvpython") is None, reason="no ParaView here; tests/run.sh installs Debian's"
)


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    """The folder into which install.sh puts module and plugin."""
    folder = tmp_path_factory.mktemp("installed")
    environment = {
        **os.environ,
        "PYTHON": sys.executable,
        # as the tests' own module was built: nothing is compiled again
        "MATURIN_PEP517_ARGS": "--profile dev",
    }
    command = ["bash", ROOT / "paraview" / "install.sh", folder]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "DEI Contour works in ParaView" in done.stdout
    return folder


def run(installed: Path, command: list[object]) -> str:
    """Runs ParaView with module and plugin; returns what it prints. ParaView's errors do not
    change the exit status, so the text has to be looked at."""
    environment = {**os.environ, "PYTHONPATH": str(installed / "python")}
    environment.pop("VIRTUAL_ENV", None)
    done = subprocess.run(
        list(map(str, command)),
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=300,
    )
    text = done.stdout
    assert done.returncode == 0, text
    assert "Traceback" not in text, text
    return text


def plugin(installed: Path) -> Path:
    return installed / "plugins" / "vtu2contour_plugin.py"


def mixed() -> pv.UnstructuredGrid:
    """Hexahedra, tetrahedra, triangles and a line, side by side."""
    hexahedra = solid("hexahedra", 3)
    tetrahedra = solid(n=3).translate([2, 0, 0])
    triangles = solid(n=4).extract_surface(algorithm=None).translate([4, 0, 0])
    line = pv.Line().translate([8, 0, 0])
    line.clear_data()
    line["u"] = line.points[:, 0].astype(float)
    grid = pv.merge([hexahedra, tetrahedra, triangles, line], merge_points=False)
    return grid.cast_to_unstructured_grid()


def with_arrays(grid: pv.UnstructuredGrid, *names: str) -> pv.UnstructuredGrid:
    """The grid with these point arrays only."""
    kept = grid.copy()
    for name in set(kept.point_data) - set(names):
        kept.point_data.remove(name)
    return kept


def single() -> pv.UnstructuredGrid:
    """All in single precision."""
    grid = solid()
    grid.points = grid.points.astype(np.float32)
    for name in ("u", "grad_u"):
        grid[name] = grid[name].astype(np.float32)
    return grid


def in_pieces(grid: pv.UnstructuredGrid, path: Path) -> Path:
    """A grid in two pieces, each with the cells of the other that share its points, as ghosts."""
    for number, piece in enumerate(pieces_with_ghosts(grid, 1)):
        piece.save(path.with_name(f"{path.stem}_{number}.vtu"))
    path.write_text(
        """<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian">
<PUnstructuredGrid GhostLevel="1">
<PPointData Scalars="u"><PDataArray type="Float64" Name="u"/>
<PDataArray type="Float64" Name="grad_u" NumberOfComponents="3"/>
<PDataArray type="Float32" Name="other"/></PPointData>
<PCellData><PDataArray type="Int64" Name="number"/>
<PDataArray type="UInt8" Name="vtkGhostType"/></PCellData>
<PPoints><PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>
"""
        + "".join(f'<Piece Source="{path.stem}_{number}.vtu"/>\n' for number in (0, 1))
        + "</PUnstructuredGrid></VTKFile>\n"
    )
    return path


PROPERTIES = {"ContourBy": ["POINTS", "u"], "Isosurfaces": [0.1, 0.5]}
OPTIONS = {"scalars": "u", "normals": True}


@pytest.fixture(scope="module")
def results(installed, tmp_path_factory) -> tuple[Path, str]:
    """What the filter makes of all kinds of input, in one run of pvpython, and what that prints."""
    folder = tmp_path_factory.mktemp("results")
    grids = {
        "plain": solid(),
        "mixed": mixed(),
        "single": single(),
        "recovered": with_arrays(solid(), "u"),
        "missing": with_arrays(solid(), "other"),
    }
    for name, grid in grids.items():
        grid.save(folder / f"{name}.vtu")
    moved = solid().translate([1, 0, 0])
    bare = with_arrays(solid(), "other")
    blocks = pv.MultiBlock([solid(), moved, bare, pv.MultiBlock([moved])])
    blocks.save(folder / "blocks.vtm")
    for number, half in enumerate((solid(), moved)):
        half.save(folder / f"pieces_{number}.vtu")
    (folder / "pieces.pvtu").write_text(
        in_pieces(solid(), folder / "ghosts.pvtu")
        .read_text()
        .replace("ghosts_", "pieces_")
        .replace('<PDataArray type="UInt8" Name="vtkGhostType"/>', "")
    )
    step = solid()
    for number in (0, 1):
        step["u"] = step["u"] + 0.1 * number
        step.save(folder / f"step_{number}.vtu")
    (folder / "series.pvd").write_text(
        '<VTKFile type="Collection" version="0.1"><Collection>'
        + "".join(f'<DataSet timestep="{n}" file="step_{n}.vtu"/>' for n in (0, 1))
        + "</Collection></VTKFile>"
    )
    jobs = [
        {"name": n, "file": str(folder / f"{n}.vtu"), "output": str(folder / f"{n}.vtp")}
        for n in grids
    ]
    jobs += [
        {"name": n, "file": str(folder / f"{n}.pvtu"), "output": str(folder / f"{n}.vtp")}
        for n in ("pieces", "ghosts")
    ]
    jobs.append(
        {"name": "blocks", "file": str(folder / "blocks.vtm"), "output": str(folder / "out.vtm")}
    )
    steps = [{"time": n, "output": str(folder / f"series_{n}.vtp")} for n in (0, 1)]
    jobs.append({"name": "series", "file": str(folder / "series.pvd"), "steps": steps})
    levels = [
        {"properties": {"Isosurfaces": [level]}, "output": str(folder / f"level_{level}.vtp")}
        for level in (0.1, 0.2, 0.3)
    ]
    levels.append({**levels[0], "properties": {"PDE": "uxx + ="}, "output": str(folder / "no.vtp")})
    jobs.append({"name": "levels", "file": str(folder / "plain.vtu"), "steps": levels})
    for job in jobs:
        job["properties"] = PROPERTIES
    (folder / "jobs.json").write_text(json.dumps(jobs))
    script = SCRIPTS / "contour_files.py"
    return folder, run(installed, ["pvpython", script, plugin(installed), folder / "jobs.json"])


def told(results: tuple[Path, str], job: str) -> str:
    """What was printed during a job."""
    return results[1].partition(f"job {job}\n")[2].partition(f"made {job} ")[0]


@pytest.mark.parametrize("name", ["plain", "mixed", "single", "recovered"])
def test_files_are_contoured_as_by_the_module(results, name):
    folder, _ = results
    expected = vc.contour(pv.read(folder / f"{name}.vtu"), PROPERTIES["Isosurfaces"], **OPTIONS)
    same(pv.read(folder / f"{name}.vtp"), expected)
    assert told(results, name) == ""


def test_the_filter_the_module_and_the_command_line_agree(results, contour):
    folder, _ = results
    arguments = ["-a", "u", "-v", "0.1,0.5", "--normals"]
    same(pv.read(folder / "mixed.vtp"), pv.read(contour(folder / "mixed.vtu", *arguments)))


def test_pieces_are_contoured_and_ghosts_are_not(results):
    folder, _ = results
    whole = vc.contour(pv.read(folder / "pieces.pvtu"), PROPERTIES["Isosurfaces"], **OPTIONS)
    same(pv.read(folder / "pieces.vtp"), whole)
    ghosts = pv.read(folder / "ghosts.vtp")
    serial = vc.contour(solid(), PROPERTIES["Isosurfaces"], **OPTIONS)
    assert triangles(ghosts) == triangles(serial)


def test_blocks_are_contoured_one_by_one(results):
    folder, _ = results
    # VTK's reader of lists forgets a block after one that is empty
    found = {path.stem: pv.read(path) for path in (folder / "out").glob("*.vtp")}
    blocks = pv.read(folder / "blocks.vtm")
    expected = vc.contour(blocks, PROPERTIES["Isosurfaces"], **OPTIONS)
    assert sorted(found) == ["out_0", "out_1", "out_3"]
    same(found["out_0"], expected[0])
    same(found["out_1"], expected[1])
    same(found["out_3"], expected[3][0])
    assert told(results, "blocks") == ""


def test_every_step_of_a_series_is_contoured(results):
    folder, text = results
    for number in (0, 1):
        step = pv.read(folder / f"step_{number}.vtu")
        expected = vc.contour(step, PROPERTIES["Isosurfaces"], **OPTIONS)
        found = pv.read(folder / f"series_{number}.vtp")
        assert np.array_equal(found.points, expected.points)
        assert np.array_equal(found.faces, expected.faces)
    assert "made series 2" in text


def test_a_missing_array_is_told(results):
    folder, _ = results
    text = told(results, "missing")
    assert "DEI Contour: no point array 'u'; the point arrays are 'other'" in text
    assert pv.read(folder / "missing.vtp").n_points == 0


def test_levels_reuse_the_interpolant_and_errors_leave_nothing(results):
    folder, text = results
    for level in (0.1, 0.2, 0.3):
        mesh = pv.read(folder / "plain.vtu")
        same(pv.read(folder / f"level_{level}.vtp"), vc.contour(mesh, [level], **OPTIONS))
    # one for all levels, and the one that the wrong PDE refuses
    assert "made levels 2\n" in text
    assert "DEI Contour: pde: " in told(results, "levels")
    assert pv.read(folder / "no.vtp").n_points == 0


@pytest.mark.skipif(shutil.which("mpiexec") is None, reason="no MPI here")
@pytest.mark.parametrize(
    ("points", "ranks"),
    [(3, 2), (0, 2), (0, 3)],
    ids=["points per side", "tolerance", "a process without cells"],
)
def test_processes_make_the_serial_contour(installed, tmp_path, points, ranks):
    file, output = in_pieces(solid(n=6), tmp_path / "mesh.pvtu"), tmp_path / "out.pvtp"
    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    mpi = ["mpiexec", *root, "--oversubscribe", "-n", ranks, "-x", "PYTHONPATH"]
    script = [SCRIPTS / "contour_pieces.py", plugin(installed), file, output, points]
    run(installed, [*mpi, "pvbatch", "--symmetric", *script])
    pieces = [pv.read(path) for path in sorted(tmp_path.glob("out*/*.vtp"))]
    pieces = [piece for piece in pieces if piece.n_cells > 0]
    assert len(pieces) == 2
    serial = vc.contour(solid(n=6), [0.5], scalars="u", nside=points or None)
    assert sum(map(triangles, pieces), Counter()) == triangles(serial)
    union = pv.merge(pieces).clean(tolerance=1e-12)
    components = [len(np.unique(s.connectivity()["RegionId"])) for s in (union, serial)]
    assert components[0] == components[1]


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="no xvfb here")
def test_a_picture_beside_paraviews_own_contour(installed, tmp_path):
    path = tmp_path / "contours.png"
    display = ["xvfb-run", "-a", "-s", "-screen 0 1300x700x24"]
    run(installed, [*display, "pvpython", SCRIPTS / "picture.py", plugin(installed), path])
    picture = np.asarray(pv.read(path).point_data["PNGImage"]).reshape(520, 1200, -1)[..., :3]
    for half in (picture[:, :600], picture[:, 600:]):
        is_blue = half[..., 2].astype(int) > half[..., 0].astype(int) + 30
        assert 0.1 < is_blue.mean() < 0.9


def test_files_are_refined_as_by_the_module(installed, tmp_path):
    grid = solid(n=3)
    grid.cell_data["eta"] = np.arange(grid.n_cells, dtype=float) ** 2
    grid.save(tmp_path / "mesh.vtu")
    wanted = {
        "average": ({"Number": 1.5}, {"by": "eta", "select": "average:1.5"}),
        "bulk": (
            {"Select": 2, "Number": 0.25, "MaximumPoints": 100},
            {"by": "eta", "select": "bulk:0.25", "max_points": 100},
        ),
        "marks": ({"Select": 4}, {"marks": "eta", "max_points": 100}),
        "pde": (
            {"MaximumPoints": 0, "PDE": "uxx + uyy + uzz = -14*u"},
            {"marks": "eta", "pde": "uxx + uyy + uzz = -14*u"},
        ),
        "wrong": ({"PDE": "uxx ="}, None),
    }
    always = {"RefineBy": ["CELLS", "eta"], "Solution": "u"}
    jobs = [
        {"output": str(tmp_path / f"{name}.vtu"), "properties": {**always, **properties}}
        for name, (properties, _) in wanted.items()
    ]
    (tmp_path / "jobs.json").write_text(json.dumps(jobs))
    script = [SCRIPTS / "refine_file.py", plugin(installed), tmp_path / "mesh.vtu"]
    text = run(installed, ["pvpython", *script, tmp_path / "jobs.json"])
    for name, (_, options) in wanted.items():
        found = pv.read(tmp_path / f"{name}.vtu")
        if options is None:
            assert found.n_points == 0
            continue
        expected = vc.refine(pv.read(tmp_path / "mesh.vtu"), scalars="u", **options)
        assert found.n_points > grid.n_points
        assert np.array_equal(found.points, expected.points), name
        assert np.array_equal(found.cells_dict[10], expected.cells_dict[10]), name
        for array in ("u", "grad_u", "other", "ParentEdge"):
            assert np.array_equal(found.point_data[array], expected.point_data[array]), name
        for array in ("eta", "number", "OriginalCellIds"):
            assert np.array_equal(found.cell_data[array], expected.cell_data[array]), name
    assert text.count("DEI Refine: ") == 1 and "DEI Refine: pde: " in text


def test_files_are_judged_as_by_the_module(installed, tmp_path):
    grid, file = solid(n=3), tmp_path / "mesh.vtu"
    grid.save(file)
    pv.MultiBlock([grid, with_arrays(grid, "other")]).save(tmp_path / "blocks.vtm")
    pde = "uxx + uyy + uzz = -14*u"
    wanted = {
        "defect": ({"PDE": pde, "Select": 1, "N": 1.5}, {"pde": pde, "select": "average:1.5"}),
        "area": ({"Monitor": 1, "RandomSamples": 5}, {"samples": 5}),
        "stepwise": ({"Monitor": 2, "Select": 3, "N": 0.5}, {"select": "bulk:0.5"}),
        "interpolation": ({"Monitor": 3, "SecondInterpolant": 5}, {"second": "linear"}),
        "missing": ({}, None),
    }
    always = {"Solution": ["POINTS", "u"]}
    jobs = [
        {"output": str(tmp_path / f"{name}.vtu"), "properties": {**always, **properties}}
        for name, (properties, _) in wanted.items()
    ]
    blocks = {"file": str(tmp_path / "blocks.vtm"), "output": str(tmp_path / "out.vtm")}
    jobs.append({**blocks, "properties": {**always, "Monitor": 1}})
    (tmp_path / "jobs.json").write_text(json.dumps(jobs))
    script = [SCRIPTS / "monitor_file.py", plugin(installed), file, tmp_path / "jobs.json"]
    text = run(installed, ["pvpython", *script])
    for name, (_, options) in wanted.items():
        found = pv.read(tmp_path / f"{name}.vtu")
        if options is None:
            assert found.n_points == 0
            continue
        expected = vc.monitor(pv.read(file), name, scalars="u", **options)
        assert sorted(found.cell_data) == sorted(expected.cell_data)
        for array in expected.cell_data:
            assert np.array_equal(found.cell_data[array], expected.cell_data[array]), name
        assert np.array_equal(found.point_data["grad_u"], grid["grad_u"])
    assert text.count("DEI Monitor: ") == 1 and "needs the PDE" in text
    judged = pv.read(tmp_path / "out.vtm")
    area = vc.monitor(grid, "area", scalars="u")["AreaMonitor"]
    assert np.array_equal(judged[0].cell_data["AreaMonitor"], area)
    assert "AreaMonitor" not in judged[1].cell_data
