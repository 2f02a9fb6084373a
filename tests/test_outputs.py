"""What the command line writes, opened by VTK, PyVista and meshio: the same values by all."""

import subprocess
import sys

import meshio
import numpy as np
import pytest
import pyvista
from conftest import ROOT
from vtk_samples import read
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

ENCODINGS = ["raw", "zlib", "lz4", "lzma", "base64", "ascii"]
# LZ4 is unknown to meshio
FOR_MESHIO = [encoding for encoding in ENCODINGS if encoding != "lz4"]

SAMPLES = ["problem4.vtu", "surface.vtu", "no_gradient.vtu"]


def values_of(data):
    """Points, lines and arrays of a data set of VTK."""
    found = {"points": vtk_to_numpy(data.GetPoints().GetData())}
    cells = data.GetLines() if data.IsA("vtkPolyData") else data.GetCells()
    found["connectivity"] = vtk_to_numpy(cells.GetConnectivityArray())
    found["offsets"] = vtk_to_numpy(cells.GetOffsetsArray())
    sections = {
        "point": data.GetPointData(),
        "cell": data.GetCellData(),
        "field": data.GetFieldData(),
    }
    for label, section in sections.items():
        for index in range(section.GetNumberOfArrays()):
            array = section.GetArray(index)
            found[f"{label} {array.GetName()}"] = vtk_to_numpy(array)
        if label != "field" and section.GetScalars():
            found[f"{label} scalars"] = vtk_to_numpy(section.GetScalars())
    return found


def assert_equal(found, expected):
    assert found.keys() == expected.keys()
    for name, values in expected.items():
        assert found[name].dtype == values.dtype, name
        np.testing.assert_array_equal(found[name], values, err_msg=name)


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize("encoding", ENCODINGS)
def test_vtk_and_pyvista_see_the_same_lines(contour, encoding, sample):
    source = ROOT / "samples" / sample
    options = ["--gradients", "--normals"]
    lines = contour(source, *options, "--encoding", encoding)
    grid = contour(source, *options, "--encoding", encoding, name="lines.vtu")
    raw = contour(source, *options, name="raw.vtp")
    expected = values_of(read(raw))
    assert {"point Gradients", "point Normals", "cell OriginalCellIds"} <= expected.keys()
    assert len(expected["offsets"]) > 5
    assert_equal(values_of(read(lines)), expected)
    assert_equal(values_of(read(grid)), expected)
    assert_equal(values_of(pyvista.read(lines)), expected)
    assert_equal(values_of(pyvista.read(grid)), expected)


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize("encoding", FOR_MESHIO)
def test_meshio_sees_the_same_segments(contour, encoding, sample):
    path = contour(
        ROOT / "samples" / sample, "--segments", "--encoding", encoding, name="lines.vtu"
    )
    mesh, expected = meshio.read(path), values_of(read(path))
    np.testing.assert_array_equal(mesh.points, expected["points"])
    [block] = mesh.cells
    assert block.type == "line"
    np.testing.assert_array_equal(block.data.ravel(), expected["connectivity"])
    for name, values in mesh.point_data.items():
        np.testing.assert_array_equal(values, expected[f"point {name}"])
    for name, [values] in mesh.cell_data.items():
        np.testing.assert_array_equal(values, expected[f"cell {name}"])
    labels = [label.split()[0] for label in expected if not label.endswith(" scalars")]
    assert len(mesh.point_data) == labels.count("point")
    assert len(mesh.cell_data) == labels.count("cell")


def pieces_of(folder, count):
    """The parts of the sample to the left and right of vertical lines, and their list."""
    grid = pyvista.read(ROOT / "samples" / "problem4.vtu")
    x = grid.cell_centers().points[:, 0]
    limits = np.linspace(0, 1, count + 1)
    names = [f"part{index}.vtu" for index in range(count)]
    for name, low, high in zip(names, limits, limits[1:], strict=False):
        grid.extract_cells((x >= low) & (x < high)).save(folder / name)
    return list_of(folder, names)


def list_of(folder, names):
    """The list of pieces."""
    sources = "".join(f'<Piece Source="{name}"/>' for name in names)
    path = folder / "in.pvtu"
    path.write_text(
        '<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid GhostLevel="0">'
        f"{sources}</PUnstructuredGrid></VTKFile>"
    )
    return path


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_vtk_joins_our_pieces(contour, encoding, tmp_path):
    source = pieces_of(tmp_path, 3)
    options = ["-a", "u", "-v", "0.3,0.9", "--encoding", encoding, "--tolerance", "1e-4", "-q"]
    listed = values_of(read(contour(source, *options, name="lines.pvtp")))
    append = vtkAppendPolyData()
    for index in range(3):
        append.AddInputData(read(tmp_path / "lines" / f"lines_{index}.vtp"))
    append.Update()
    expected = values_of(append.GetOutput())
    for name in ("points", "connectivity", "offsets", "point u", "cell area"):
        np.testing.assert_array_equal(listed[name], expected[name], err_msg=name)
    # and they are the lines of the joined grid
    joined = values_of(read(contour(source, *options)))
    assert len(joined["offsets"]) == len(listed["offsets"])
    by_place = [np.unique(found["points"], axis=0) for found in (joined, listed)]
    np.testing.assert_array_equal(*by_place)


# runs a command, and tells its memory in KiB; of no other process that was started before
MEASURE = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


def test_pieces_one_at_a_time_take_the_memory_of_one(program, tmp_path):
    block = pyvista.ImageData(dimensions=(31, 31, 31)).to_tetrahedra(5)
    names = [f"part{index}.vtu" for index in range(8)]
    for index, name in enumerate(names):
        part = block.translate((30.0 * index, 0.0, 0.0))
        # a sphere in the third of them
        away = part.points - [75.5, 15.5, 15.5]
        part.point_data["u"] = np.linalg.norm(away, axis=1)
        part.point_data["gradient"] = away / part.point_data["u"][:, None]
        part.save(tmp_path / name)
    list_of(tmp_path, names)

    def memory(*arguments):
        command = [sys.executable, "-c", MEASURE, program, *arguments]
        options = ["-a", "u", "-v", "10", "--nside", "2", "--threads", "1"]
        run = subprocess.run(
            [*command, *options], cwd=tmp_path, capture_output=True, text=True, check=True
        )
        return int(run.stdout)

    one = memory("part2.vtu", "-o", "one.vtp")
    joined = memory("in.pvtu", "-o", "joined.vtp")
    assert joined > 2.5 * one
    for output in ("lines.vtp", "lines.pvtp"):
        assert memory("in.pvtu", "-o", output, "--stream") < 1.6 * one, output
    streamed = pyvista.read(tmp_path / "lines.vtp")
    assert streamed.n_cells == pyvista.read(tmp_path / "joined.vtp").n_cells > 1000


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_pyvista_reads_our_series(program, encoding, tmp_path):
    times = [0.0, 0.5, 1e-3]
    entries = ""
    for index, time in enumerate(times):
        grid = pyvista.read(ROOT / "samples" / "problem4.vtu")
        grid.point_data["u"] *= index + 1
        grid.save(tmp_path / f"step{index}.vtu")
        entries += f'<DataSet timestep="{time}" part="0" file="step{index}.vtu"/>'
    (tmp_path / "in.pvd").write_text(
        f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>'
    )
    options = ["-g", "recover", "--encoding", encoding, "-n", "7"]
    command = [program, tmp_path / "in.pvd", "-o", tmp_path / "out.pvd", *options]
    subprocess.run(command, check=True, capture_output=True)
    reader = pyvista.get_reader(tmp_path / "out.pvd")
    assert reader.time_values == sorted(times)
    levels = set()
    for index, time in enumerate(times):
        reader.set_active_time_value(time)
        [block] = reader.read()
        file = tmp_path / "out" / f"out_{index}.vtp"
        assert_equal(values_of(block), values_of(read(file)))
        levels |= set(np.unique(block.point_data["u"]))
    assert len(levels) == 7
