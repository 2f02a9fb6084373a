"""Lists of pieces and series, VTK's read by us and ours by VTK and PyVista."""

import json
import subprocess

import numpy as np
import pytest
from test_vtk_matrix import assert_dump, dump, dump_program  # noqa: F401
from vtk.util.numpy_support import vtk_to_numpy
from vtk_samples import GRIDS, assert_same, expected_of, is_surface, read, suffix, write, writer_of

import vtk


def write_pieces(data, path, count, ghosts=0):
    writer = writer_of(data, "XMLP", path)
    writer.SetNumberOfPieces(count)
    writer.SetEndPiece(count - 1)
    writer.SetGhostLevel(ghosts)
    assert writer.Write() == 1


@pytest.mark.parametrize("name", ["empty", "small", "blocks", "no_surface", "surface", "polyhedra"])
def test_we_join_the_pieces_vtk_writes(name, dump_program, tmp_path):  # noqa: F811
    data = GRIDS[name]()
    path = tmp_path / f"list{suffix(data).replace('.', '.p')}"
    write_pieces(data, path, 3)
    [line] = dump(dump_program, [path])
    found, joined = json.loads(line), read(path)
    if data.GetNumberOfPoints() == 0:  # then VTK passes over the field data, too
        joined.SetFieldData(data.GetFieldData())
    assert_dump(json.dumps(found), joined, name)


def ghosts_of(size):
    """A surface of triangles with ghost cells, of the strips of a plane."""
    plane = vtk.vtkPlaneSource()
    plane.SetResolution(size, size)
    plane.Update()
    data = plane.GetOutput()
    ghosts = vtk.vtkUnsignedCharArray()
    ghosts.SetName("vtkGhostType")
    for index in range(data.GetNumberOfCells()):
        ghosts.InsertNextValue(index % 4 == 0)
    data.GetCellData().AddArray(ghosts)
    return data


def test_ghosts_are_kept(dump_program, tmp_path):  # noqa: F811
    data = ghosts_of(5)
    path = tmp_path / "ghosts.pvtp"
    write_pieces(data, path, 2)
    [line] = dump(dump_program, [path])
    [ghosts] = json.loads(line)["cell_data"]["arrays"]
    joined = read(path)
    expected = vtk_to_numpy(joined.GetCellData().GetArray("vtkGhostType"))
    assert ghosts["values"] == expected.tolist()


@pytest.mark.parametrize("name", ["blocks", "surface"])
def test_vtk_and_pyvista_read_our_lists(name, dump_program, tmp_path):  # noqa: F811
    pyvista = pytest.importorskip("pyvista")
    data = GRIDS[name]()
    ending = suffix(data)
    (tmp_path / "parts").mkdir()
    pieces = [tmp_path / "parts" / f"a & {index}{ending}" for index in range(3)]
    for piece in pieces:
        write(data, piece, "appended-raw", "None", 64, "Little")
    path = tmp_path / f"list{ending.replace('.', '.p')}"
    subprocess.run([dump_program, "--list", path, *pieces], check=True)
    assert f'type="P{"PolyData" if is_surface(data) else "UnstructuredGrid"}"' in path.read_text()
    joined = read(path)
    assert joined.GetNumberOfPoints() == 3 * data.GetNumberOfPoints()
    assert joined.GetNumberOfCells() == 3 * data.GetNumberOfCells()
    [line] = dump(dump_program, [path])
    assert_dump(line, joined, name)
    if path.suffix == ".pvtp":  # which PyVista does not read
        return
    mesh = pyvista.read(path)
    original = vtk_to_numpy(data.GetPointData().GetArray("UInt16 array"))
    assert np.array_equal(mesh.point_data["UInt16 array"], np.tile(original, (3, 1)))


def test_pyvista_reads_our_series(dump_program, tmp_path):  # noqa: F811
    pyvista = pytest.importorskip("pyvista")
    files = []
    for index, name in enumerate(["small", "surface"]):
        data = GRIDS[name]()
        files.append(tmp_path / f"{index}{suffix(data)}")
        write(data, files[-1], "appended-raw", "None", 64, "Little")
    path = tmp_path / "series.pvd"
    subprocess.run([dump_program, "--list", path, *files], check=True)
    reader = pyvista.get_reader(path)
    assert reader.time_values == [0.0, 0.5]
    for time, file in enumerate(files):
        reader.set_active_time_point(time)
        [block] = reader.read()
        assert_same(expected_of(block), expected_of(read(file)), file.name)


def test_we_read_vtk_series(dump_program, tmp_path):  # noqa: F811
    path = tmp_path / "series.pvd"
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" '
        'byte_order="LittleEndian">\n<Collection>\n'
        '<DataSet timestep="1e-3" group="" part="0" file="a.vtu"/>\n'
        '<DataSet timestep="2" part="1" name="x" file="b/c.pvtu"/>\n</Collection>\n</VTKFile>\n'
    )
    [line] = dump(dump_program, [path])
    entries = [(e["time"], e["part"], e["file"]) for e in json.loads(line)]
    assert entries == [(1e-3, 0, str(tmp_path / "a.vtu")), (2.0, 1, str(tmp_path / "b/c.pvtu"))]
