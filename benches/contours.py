"""Contours, ours and VTK's side by side: times, and errors beside times.

Run by `bash benches/run.sh`, which builds everything and passes its arguments on. Prints a Markdown
table: medians of milliseconds over the rounds, ours and theirs in turn, and ours as a share of
theirs.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--size", type=int, default=1_000_000, help="cells of the large meshes")
    parser.add_argument("--only", default=",".join(CASES), help="cases, of " + ", ".join(CASES))
    parser.add_argument("--program", type=Path, help="the command vtu2contour, for files")
    return parser.parse_args()


CASES = ("solids", "flat", "matplotlib", "equal", "files", "pieces", "paraview")


ARGUMENTS = arguments()
# read when the libraries are loaded
os.environ["RAYON_NUM_THREADS"] = str(ARGUMENTS.threads)
os.environ["VTK_SMP_MAX_THREADS"] = str(ARGUMENTS.threads)
os.environ["VTK_SMP_BACKEND_IN_USE"] = "STDThread"

import numpy as np  # noqa: E402
from vtk.util.numpy_support import (  # noqa: E402
    numpy_to_vtk,
    numpy_to_vtkIdTypeArray,
    vtk_to_numpy,
)

import vtk  # noqa: E402
import vtu2contour as vc  # noqa: E402


def medians(*jobs: Callable[[], object]) -> list[float]:
    """Median seconds of each job; a round runs each once."""
    seconds: list[list[float]] = [[] for _ in jobs]
    for _ in range(ARGUMENTS.rounds):
        for job, taken in zip(jobs, seconds, strict=True):
            start = time.perf_counter()
            job()
            taken.append(time.perf_counter() - start)
    return [statistics.median(taken) for taken in seconds]


# -- meshes and fields


def cube(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of the unit cube and 6 n^3 tetrahedra."""
    line = np.linspace(0, 1, n + 1)
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    i, j, k = np.meshgrid(*3 * [np.arange(n)], indexing="ij")
    corner = (((i * (n + 1) + j) * (n + 1) + k).ravel()[:, None]).astype(np.int64)
    steps = [(n + 1) ** 2, n + 1, 1]
    orders = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
    paths = [corner + np.cumsum([0] + [steps[axis] for axis in order]) for order in orders]
    # the six of a brick stand together
    return points, np.stack(paths, axis=1).reshape(-1, 4)


def square(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of the unit square and 2 n^2 triangles."""
    line = np.linspace(0, 1, n + 1)
    x, y = (a.ravel() for a in np.meshgrid(line, line))
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n)))
    corner = j * (n + 1) + i
    lower = np.stack([corner, corner + 1, corner + n + 2], axis=1)
    upper = np.stack([corner, corner + n + 2, corner + n + 1], axis=1)
    cells = np.stack([lower, upper], axis=1).reshape(-1, 3)
    return np.column_stack([x, y, np.zeros_like(x)]), cells


def waves(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A smooth field and its gradient."""
    sines, cosines = np.sin(p * [3.0, 4.0, 5.0]), np.cos(p * [3.0, 4.0, 5.0])
    return sines.sum(axis=1), cosines * [3.0, 4.0, 5.0]


def grid_of(points: np.ndarray, cells: np.ndarray, u: np.ndarray, grad: np.ndarray):
    """The same as a grid of VTK."""
    corners = cells.shape[1]
    array = vtk.vtkCellArray()
    offsets = np.arange(0, cells.size + 1, corners, dtype=np.int64)
    connectivity = np.ascontiguousarray(cells.ravel(), np.int64)
    array.SetData(*(numpy_to_vtkIdTypeArray(ids, deep=1) for ids in (offsets, connectivity)))
    grid = vtk.vtkUnstructuredGrid()
    place = vtk.vtkPoints()
    place.SetData(numpy_to_vtk(points, deep=1))
    grid.SetPoints(place)
    grid.SetCells(vtk.VTK_TETRA if corners == 4 else vtk.VTK_TRIANGLE, array)
    for name, values in (("u", u), ("grad_u", grad)):
        values = numpy_to_vtk(values, deep=1)
        values.SetName(name)
        grid.GetPointData().AddArray(values)
    grid.GetPointData().SetActiveScalars("u")
    return grid


def vtk_contour(grid, levels: list[float], normals: bool = False):
    contour = vtk.vtkContourFilter()
    contour.SetInputData(grid)
    contour.FastModeOn()
    contour.SetComputeNormals(normals)
    for number, level in enumerate(levels):
        contour.SetValue(number, level)
    contour.Update()
    return contour.GetOutput()


# -- the cases, each with what may be at most


def ten(u: np.ndarray) -> list[float]:
    return list(np.linspace(u.min(), u.max(), 12)[1:-1])


def in_memory() -> None:
    points, cells = cube(round((ARGUMENTS.size / 6) ** (1 / 3)))
    u, grad = waves(points)
    grid = grid_of(points, cells, u, grad)
    cells = cells.astype(np.int32)

    f = vc.Interpolant(points, cells, u, grad)
    one, levels = [float(np.mean(u))], ten(u)
    name = f"{len(cells)} tetrahedra"
    row(f"{name}, one level", 1.3, lambda: f.contour(one, nside=2), lambda: vtk_contour(grid, one))
    row(
        f"{name}, one level, normals",
        1.2,
        lambda: f.contour(one, nside=2, normals=True),
        lambda: vtk_contour(grid, one, normals=True),
    )
    row(
        f"{name}, ten levels",
        0.7,
        lambda: f.contour(levels, nside=2),
        lambda: vtk_contour(grid, levels),
    )
    row(
        f"{name}, the interpolant and one level",
        None,
        lambda: vc.contour_arrays(points, cells, u, grad, one, nside=2),
        lambda: vtk_contour(grid, one),
    )


def in_memory_and_flat() -> None:
    points, cells = square(round((ARGUMENTS.size / 2) ** 0.5))
    u, grad = waves(points)
    grid = grid_of(points, cells, u, grad)
    f = vc.Interpolant(points, cells.astype(np.int32), u, grad)
    # no points but those on the edges
    edges_only = {"spacing": 1.0, "method": "intercept"}
    for name, levels, most in (
        ("one level", [float(np.mean(u))], 0.6),
        ("ten levels", ten(u), 0.8),
    ):
        row(
            f"{len(cells)} triangles, {name}",
            most,
            lambda levels=levels: f.contour(levels, **edges_only),
            lambda levels=levels: vtk_contour(grid, levels),
        )


def matplotlib_at_equal_error() -> None:
    """Ten levels on 10 000 triangles; at most 1e-4 between u and the level in the middle of a
    segment.
    """
    from matplotlib.figure import Figure
    from matplotlib.tri import CubicTriInterpolator, Triangulation, UniformTriRefiner

    points, cells = square(71)
    u, grad = waves(points)
    levels, corners = ten(u), cells.astype(np.int32)
    triangulation = Triangulation(points[:, 0], points[:, 1], cells)
    axes = Figure().subplots()

    def error(lines: list[np.ndarray]) -> float:
        middles = np.concatenate([0.5 * (line[1:] + line[:-1]) for line in lines])
        at = np.column_stack([middles[:, :2], np.zeros(len(middles))])
        return float(np.abs(waves(at)[0][:, None] - levels).min(axis=1).max())

    def theirs(subdivisions: int) -> list[np.ndarray]:
        cubic = CubicTriInterpolator(triangulation, u, kind="user", dz=(grad[:, 0], grad[:, 1]))
        finer, values = UniformTriRefiner(triangulation).refine_field(u, cubic, subdivisions)
        segments = axes.tricontour(finer, values, levels).allsegs
        return [line for of_level in segments for line in of_level]

    def ours(tolerance: float) -> vc.Contours:
        return vc.contour_arrays(points, corners, u, grad, levels, tolerance=tolerance)

    def error_of_ours(tolerance: float) -> float:
        made = ours(tolerance)
        return error([made.points[line] for line in made.lines])

    subdivisions = next(n for n in range(1, 7) if error(theirs(n)) <= 1e-4)
    tolerance = next(t for t in 10.0 ** -np.arange(2, 9, 0.25) if error_of_ours(t) <= 1e-4)
    row(
        f"{len(cells)} triangles, ten levels, error 1e-4 (ours: tolerance {tolerance:.1e}; "
        f"matplotlib: {subdivisions} subdivisions)",
        0.01,
        lambda: ours(tolerance),
        lambda: theirs(subdivisions),
    )


def problem_6(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The thesis' sixth problem, (x^3 - x) (y^3 - y^2) (z^2 + 1), and its gradient."""
    x, y, z = p.T
    a, b, c = x**3 - x, y**3 - y**2, z**2 + 1
    slopes = [(3 * x**2 - 1) * b * c, a * (3 * y**2 - 2 * y) * c, a * b * 2 * z]
    return a * b * c, np.column_stack(slopes)


def vtk_at_equal_error() -> None:
    """The surface of problem 6 on 20^3 bricks with four points a side, and VTK's on the mesh whose
    surface has as small an error: the mean of u less the level in the middle of triangles.
    """
    points, cells = cube(20)
    u, grad = problem_6(points)
    level, corners = 0.5 * float(u.min() + u.max()), cells.astype(np.int32)

    def error(triangles: np.ndarray) -> float:
        return float(np.abs(problem_6(triangles.mean(axis=1))[0] - level).mean())

    def ours() -> vc.Contours:
        return vc.contour_arrays(points, corners, u, grad, [level], nside=4)

    made = ours()
    wanted = error(made.points[made.triangles])
    for n in range(40, 1000, 20):
        finer = cube(n)
        grid = grid_of(*finer, *problem_6(finer[0]))
        found = vtk_contour(grid, [level])
        triangles = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        theirs = error(vtk_to_numpy(found.GetPoints().GetData())[triangles])
        # no finer than memory allows: what VTK would need then is more
        if theirs <= wanted or len(finer[1]) > 12 * ARGUMENTS.size:
            break
    row(
        f"{len(cells)} tetrahedra, error {wanted:.1e} (VTK: {len(finer[1])}, error {theirs:.1e})",
        0.02,
        ours,
        lambda: vtk_contour(grid, [level]),
    )


VTK_PROGRAM = """
import json, re, sys, time
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLPolyDataWriter
from vtkmodules.vtkFiltersCore import vtkContourFilter
import vtkmodules.vtkCommonDataModel

start = time.perf_counter()
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
contour = vtkContourFilter()
contour.SetInputConnection(reader.GetOutputPort())
contour.SetInputArrayToProcess(0, 0, 0, 0, "u")
contour.FastModeOn()
contour.SetComputeNormals(False)
contour.SetValue(0, float(sys.argv[3]))
writer = vtkXMLPolyDataWriter()
writer.SetInputConnection(contour.GetOutputPort())
writer.SetFileName(sys.argv[2])
writer.SetDataModeToAppended()
writer.EncodeAppendedDataOff()
writer.SetCompressor(None)
assert writer.Write() == 1
seconds = time.perf_counter() - start
# what getrusage tells may be the peak of the process that started this one
peak = re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1]
print(json.dumps([seconds, int(peak) / 1024]))
"""

# starts the command, and tells its time from start to end and its memory
OUR_PROGRAM = """
import json, resource, subprocess, sys, time
start = time.perf_counter()
subprocess.run(sys.argv[1:], check=True)
seconds = time.perf_counter() - start
print(json.dumps([seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024]))
"""


def file_to_file() -> None:
    """The command beside a script of VTK that reads, contours and writes: raw appended files. VTK's
    time is without loading Python and VTK, ours is all of the command's.
    """
    if ARGUMENTS.program is None:
        return
    points, cells = cube(round((ARGUMENTS.size / 6) ** (1 / 3)))
    u, grad = waves(points)
    level = float(np.mean(u))
    with tempfile.TemporaryDirectory() as folder:
        source, mine, theirs = (str(Path(folder) / name) for name in ("in.vtu", "a.vtp", "b.vtp"))
        write_raw(grid_of(points, cells, u, grad), source)
        program = [str(ARGUMENTS.program), source, "-o", mine, "-a", "u", "-g", "grad_u"]
        drawing = ["-v", str(level), "--nside", "2", "--quiet", "--threads"]
        ours = [OUR_PROGRAM, *program, *drawing, str(ARGUMENTS.threads)]
        times, peaks = processes([ours, [VTK_PROGRAM, source, theirs, str(level)]])
    name = f"{len(cells)} tetrahedra, file to file"
    table_row(f"{name}, one level", 1.0, *(1e3 * seconds for seconds in times))
    table_row(f"{name}, peak memory in MiB", 1.0, *peaks)


def processes(both: list[list[str]]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Median seconds, and MiB at most, of two programs of Python; a round runs each once."""
    found: list[list[list[float]]] = [[], []]
    for _ in range(ARGUMENTS.rounds):
        for program, results in zip(both, found, strict=True):
            run = subprocess.run(
                [sys.executable, "-c", *program], capture_output=True, text=True, check=True
            )
            results.append(json.loads(run.stdout))
    medians = (map(statistics.median, zip(*of, strict=True)) for of in found)
    times, peaks = zip(*medians, strict=True)
    return times, peaks


def pieces_one_at_a_time() -> None:
    """Eight cubes beside each other as pieces of a .pvtu: taken one at a time, beside (in the place
    of VTK) the same command that joins them.
    """
    if ARGUMENTS.program is None:
        return
    count = 8
    points, cells = cube(round((ARGUMENTS.size / 6 / count) ** (1 / 3)))
    with tempfile.TemporaryDirectory() as folder:
        for n in range(count):
            moved = points + [n, 0.0, 0.0]
            write_raw(grid_of(moved, cells, *waves(moved)), str(Path(folder) / f"{n}.vtu"))
        arrays = '<PDataArray type="Float64" Name="u"/>'
        arrays += '<PDataArray type="Float64" Name="grad_u" NumberOfComponents="3"/>'
        place = '<PDataArray type="Float64" Name="Points" NumberOfComponents="3"/>'
        listed = "".join(f'<Piece Source="{n}.vtu"/>' for n in range(count))
        (Path(folder) / "in.pvtu").write_text(
            '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid>'
            f"<PPointData>{arrays}</PPointData><PPoints>{place}</PPoints>{listed}"
            "</PUnstructuredGrid></VTKFile>"
        )
        command = [
            OUR_PROGRAM,
            str(ARGUMENTS.program),
            f"{folder}/in.pvtu",
            "-o",
            f"{folder}/a.vtp",
        ]
        command += ["-a", "u", "-g", "grad_u", "-v", "0.5", "--nside", "2", "--quiet"]
        command += ["--threads", str(ARGUMENTS.threads)]
        times, peaks = processes([[*command, "--stream"], command])
    name = f"{count * len(cells)} tetrahedra in {count} pieces, one at a time and joined"
    table_row(name, None, *(1e3 * seconds for seconds in times))
    table_row(f"{name}, peak memory in MiB", None, *peaks)


def write_raw(grid, path: str) -> None:
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(path)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressor(None)
    writer.Write()


def in_paraview() -> None:
    """The filter beside ParaView's own, both with normals: levels after the first."""
    program = shutil.which("pvpython")
    if program is None:
        print("| (no pvpython here: ParaView's case is left out) | | | | |")
        return
    points, cells = cube(round((ARGUMENTS.size / 6) ** (1 / 3)))
    here = Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as folder:
        source = str(Path(folder) / "in.vtu")
        write_raw(grid_of(points, cells, *waves(points)), source)
        # alone: ParaView has a numpy and a vtk of its own
        alone = Path(folder) / "python"
        shutil.copytree(Path(vc.__file__).parent, alone / "vtu2contour")
        shutil.copy(here.parent / "paraview" / "sitecustomize.py", alone)
        environment = {**os.environ, "PYTHONPATH": str(alone)}
        plugin = str(here.parent / "paraview" / "vtu2contour_plugin.py")
        script = str(here / "paraview_levels.py")
        run = subprocess.run(
            [program, script, plugin, source, str(ARGUMENTS.rounds)],
            capture_output=True,
            text=True,
            check=True,
            env=environment,
        )
    mine, theirs = (1e3 * seconds for seconds in json.loads(run.stdout.splitlines()[-1]))
    table_row(f"{len(cells)} tetrahedra in ParaView, second and later levels", 0.5, mine, theirs)


def row(name: str, most: float | None, ours: Callable, theirs: Callable) -> None:
    """A row of the table; the ratio may be ``most`` at most."""
    table_row(name, most, *(1e3 * seconds for seconds in medians(ours, theirs)))


def table_row(name: str, most: float | None, mine: float, theirs: float) -> None:
    """A row with what was measured."""
    limit = "" if most is None else f"{most:g}"
    print(f"| {name} | {mine:.1f} | {theirs:.1f} | {mine / theirs:.3f} | {limit} |", flush=True)


def main() -> None:
    version = vtk.vtkVersion().GetVTKVersion()
    print(f"threads: {ARGUMENTS.threads}; rounds: {ARGUMENTS.rounds}; VTK {version}\n")
    print("| case | ours, ms | theirs, ms | ratio | at most |\n|---|---|---|---|---|")
    jobs = (
        in_memory,
        in_memory_and_flat,
        matplotlib_at_equal_error,
        vtk_at_equal_error,
        file_to_file,
        pieces_one_at_a_time,
        in_paraview,
    )
    for case, job in zip(CASES, jobs, strict=True):
        if case in ARGUMENTS.only.split(","):
            job()


if __name__ == "__main__":
    main()
