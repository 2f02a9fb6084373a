"""Reading and writing files, ours and VTK's side by side.

Run with `python benches/vtk_files.py [--side N] [--rounds N] [--only raw,zlib]`; needs vtk,
numpy and cargo. Prints a Markdown table: medians of seconds and of peak memory, and ours as a
share of VTK's. Every measurement is a process of its own, ours and VTK's in turn, that times
itself; both read the same file of VTK, and write the same grid into the same folder.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

ENCODINGS = ["raw", "lz4", "zlib", "lzma", "base64", "ascii"]

# Each is timed inside its process; numpy and the rest of VTK are not loaded.
VTK_PROGRAM = """
import sys, time
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    start = time.perf_counter()
    reader.Update()
    return time.perf_counter() - start, reader.GetOutput()
if sys.argv[1] == "read":
    print(read(sys.argv[2])[0])
else:
    _, encoding, source, output = sys.argv[1:]
    grid = read(source)[1]
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(output)
    writer.SetHeaderTypeToUInt64()
    writer.SetCompressor(None)
    {"ascii": writer.SetDataModeToAscii, "base64": writer.SetDataModeToBinary}.get(
        encoding, writer.SetDataModeToAppended)()
    writer.EncodeAppendedDataOff()
    kind = {"lz4": "LZ4", "zlib": "ZLib", "lzma": "LZMA"}.get(encoding)
    if kind:
        getattr(writer, f"SetCompressorTypeTo{kind}")()
    start = time.perf_counter()
    assert writer.Write() == 1
    print(time.perf_counter() - start)
"""


def make_grid(side, path):
    """A cube of tetrahedra, six to a brick, with a field and its gradient."""
    import numpy as np
    from vtk.util.numpy_support import numpy_to_vtk

    import vtk

    axis = np.linspace(0.0, 1.0, side + 1)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    xyz = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    number = np.arange((side + 1) ** 3).reshape((side + 1,) * 3)
    corner = [
        number[k : k + side, j : j + side, i : i + side].ravel()
        for k in (0, 1)
        for j in (0, 1)
        for i in (0, 1)
    ]
    bricks = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
    tets = np.concatenate([np.column_stack([corner[i] for i in tet]) for tet in bricks])
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(xyz, deep=1))
    grid.SetPoints(points)
    cells = vtk.vtkCellArray()
    offsets = np.arange(0, 4 * len(tets) + 1, 4)
    as_ids = {"deep": 1, "array_type": vtk.VTK_ID_TYPE}
    cells.SetData(numpy_to_vtk(offsets, **as_ids), numpy_to_vtk(tets.ravel(), **as_ids))
    grid.SetCells(vtk.VTK_TETRA, cells)
    a, b, c = 6.1 * xyz.T
    values = np.sin(a) * np.cos(b) + c**2
    slopes = [np.cos(a) * np.cos(b), -np.sin(a) * np.sin(b), 2 * c]
    for name, array in [("u", values), ("grad u", 6.1 * np.column_stack(slopes))]:
        data = numpy_to_vtk(np.ascontiguousarray(array), deep=1)
        data.SetName(name)
        grid.GetPointData().AddArray(data)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressor(None)
    writer.SetHeaderTypeToUInt64()
    assert writer.Write() == 1
    return grid.GetNumberOfCells()


def build():
    command = ["cargo", "build", "--release", "--example", "vtk_time", "--message-format=json"]
    built = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    messages = [json.loads(line) for line in built.stdout.splitlines()]
    return [m["executable"] for m in messages if m.get("executable")][-1]


def measure(command, threads):
    """Seconds that the process printed, and its peak memory in MiB."""
    environment = dict(os.environ)
    if threads:
        environment |= {"RAYON_NUM_THREADS": str(threads), "VTK_SMP_MAX_THREADS": str(threads)}
    else:
        environment |= {"VTK_SMP_BACKEND_IN_USE": "STDThread"}
    child = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
    seconds = float(child.stdout.read())
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, command
    return seconds, usage.ru_maxrss / 1024


def compare(ours, vtk, threads, rounds, output=None):
    """Medians of (seconds, MiB) of ours and of VTK's."""
    results = [[], []]
    for _ in range(rounds):
        for result, command in zip(results, (ours, vtk), strict=True):
            if output:
                output.unlink(missing_ok=True)
            result.append(measure(command, threads))
    return [[statistics.median(part) for part in zip(*result, strict=True)] for result in results]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--side", type=int, default=55, help="bricks a side (55: 1 M tetrahedra)")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--only", default=",".join(ENCODINGS))
    arguments = parser.parse_args()
    program = build()
    vtk = [sys.executable, "-c", VTK_PROGRAM]
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "source.vtu", Path(folder) / "output.vtu"
        # In a process of its own: the peak memory of a child is at least its parent's.
        make = f"import vtk_files; print(vtk_files.make_grid({arguments.side}, {str(source)!r}))"
        here = Path(__file__).resolve().parent
        made = subprocess.run(
            [sys.executable, "-c", make], cwd=here, check=True, capture_output=True, text=True
        )
        cells = int(made.stdout)
        size = source.stat().st_size / 1e6
        print(f"{cells} tetrahedra, {size:.1f} MB, medians of {arguments.rounds}\n")
        print("| case | threads | ours s | VTK s | ours / VTK | ours MiB | VTK MiB |")
        print("|---|---|---|---|---|---|---|")
        for encoding in arguments.only.split(","):
            file = Path(folder) / f"{encoding}.vtu"
            measure([*vtk, "write", encoding, source, file], 0)
            for threads in (1, 0):
                read = [[program, "read", file], [*vtk, "read", file]]
                write = ["write", encoding, source, output]
                for name, case in [
                    ("read", compare(*read, threads, arguments.rounds)),
                    (
                        "write",
                        compare(
                            [program, *write], [*vtk, *write], threads, arguments.rounds, output
                        ),
                    ),
                ]:
                    (ours, our_peak), (theirs, their_peak) = case
                    print(
                        f"| {name} {encoding} | {threads or 'all'} | {ours:.4f} | {theirs:.4f} "
                        f"| {ours / theirs:.2f} | {our_peak:.0f} | {their_peak:.0f} |",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
