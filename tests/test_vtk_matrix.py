"""Files of VTK read by us, and ours read by VTK, PyVista and meshio: every encoding.

Run with `python -m pytest tests/test_vtk_matrix.py`; needs vtk, pyvista, meshio, numpy and
cargo. Ours is the example `vtk_dump`, which is built first.
"""

import itertools
import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from vtk.util.numpy_support import vtk_to_numpy
from vtk_samples import (
    GRIDS,
    assert_same,
    describe_lists,
    expected_of,
    is_surface,
    number_array,
    points,
    read,
    suffix,
    write,
)

import vtk

ROOT = Path(__file__).resolve().parent.parent

FORMATS = ["ascii", "binary", "appended-base64", "appended-raw"]
COMPRESSORS = ["None", "ZLib", "LZ4", "LZMA"]
HEADERS = [32, 64]
ORDERS = ["Little", "Big"]
MATRIX = list(itertools.product(FORMATS, COMPRESSORS, HEADERS, ORDERS))

OUR_ENCODINGS = ["raw", "zlib", "lz4", "lzma", "base64", "ascii"]


@pytest.fixture(scope="session")
def dump_program():
    """Builds the example and returns its path."""
    command = ["cargo", "build", "--example", "vtk_dump", "--message-format=json"]
    built = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    messages = [json.loads(line) for line in built.stdout.splitlines()]
    return [m["executable"] for m in messages if m.get("executable")][-1]


def assert_dump(line, data, name):
    found = json.loads(line)
    assert "error" not in found, (name, found)
    expected = expected_of(data)
    if expected["points"] is None:
        assert found["points"]["values"] == []
        found["points"] = None
    assert_same(found, expected, name)


def dump(program, paths):
    command = [program, *map(str, paths)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return done.stdout.splitlines()


@pytest.mark.parametrize("name", GRIDS)
def test_we_read_what_vtk_writes(name, dump_program, tmp_path):
    data = GRIDS[name]()
    paths = []
    for index, case in enumerate(MATRIX):
        paths.append(tmp_path / ("-".join(map(str, case)) + suffix(data)))
        write(data, paths[index], *case)
    lines = dump(dump_program, paths)
    assert len(lines) == len(MATRIX)
    for path, line in zip(paths, lines, strict=True):
        assert_dump(line, data, path.name)


@pytest.mark.parametrize("version", ["0.1", "1.0", "2.0", "2.1", "2.3"])
def test_nodes_of_old_files_are_renumbered_as_vtk_does(version, dump_program, tmp_path):
    path = tmp_path / "x.vtu"
    write(GRIDS["higher_order"](), path, "ascii", "None", 32, "Little")
    text = path.read_text()
    assert 'version="2.3"' in text
    path.write_text(text.replace('version="2.3"', f'version="{version}"'))
    [line] = dump(dump_program, [path])
    assert_dump(line, read(path), version)


@pytest.mark.parametrize("order", ORDERS)
def test_pieces_are_joined_as_vtk_joins_them(order, dump_program, tmp_path):
    for name in ["blocks", "surface"]:
        data = GRIDS[name]()
        path = tmp_path / f"{name}{suffix(data)}"
        surface = is_surface(data)
        writer = vtk.vtkXMLPolyDataWriter() if surface else vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(data)
        writer.SetFileName(str(path))
        writer.SetNumberOfPieces(3)
        getattr(writer, f"SetByteOrderTo{order}Endian")()
        assert writer.Write() == 1
        joined = read(path)
        if surface:
            # VTK 9.7 itself mixes up the strings of several pieces.
            joined.GetCellData().RemoveArray("texts")
        [line] = dump(dump_program, [path])
        found = json.loads(line)
        if surface:
            arrays = found["cell_data"]["arrays"]
            found["cell_data"]["arrays"] = [a for a in arrays if a["name"] != "texts"]
        assert_dump(json.dumps(found), joined, name)


@pytest.fixture(params=OUR_ENCODINGS)
def rewritten(request, dump_program, tmp_path):
    """Our own files of one encoding, made of VTK's: (name, data, path)."""
    files = []
    for name, make in GRIDS.items():
        data = make()
        source = tmp_path / f"{name}-vtk{suffix(data)}"
        write(data, source, "appended-raw", "None", 64, "Little")
        path = tmp_path / f"{name}{suffix(data)}"
        command = [dump_program, "--rewrite", request.param, str(source), str(path)]
        subprocess.run(command, check=True)
        files.append((name, data, path))
    return request.param, files


def without_bits(data):
    """Bits come back as bytes."""
    for attributes in (data.GetPointData(), data.GetCellData()):
        bits = attributes.GetAbstractArray("bits")
        if bits:
            values = [bits.GetValue(i) for i in range(bits.GetNumberOfTuples())]
            array = vtk.vtkUnsignedCharArray()
            array.SetName("bits")
            for value in values:
                array.InsertNextValue(value)
            index = [attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())]
            assert index[-1] == "bits"
            attributes.RemoveArray("bits")
            attributes.AddArray(array)
    return data


def with_positive_infinity(description):
    """VTK 9.7 writes -inf in ascii, but reads it as inf; so it does ours."""
    for section in ("point_data", "cell_data"):
        for array in description[section]["arrays"]:
            values = array["values"]
            array["values"] = [math.inf if v == -math.inf else v for v in values]
    return description


def test_vtk_reads_what_we_write(rewritten):
    encoding, files = rewritten
    for name, data, path in files:
        expected = expected_of(without_bits(data))
        if encoding == "ascii":
            expected = with_positive_infinity(expected)
        assert_same(expected_of(read(path)), expected, name)


def test_pyvista_reads_what_we_write(rewritten):
    pyvista = pytest.importorskip("pyvista")
    _, files = rewritten
    for name, data, path in files:
        mesh = pyvista.read(path)
        assert mesh.n_points == data.GetNumberOfPoints(), name
        assert mesh.n_cells == data.GetNumberOfCells(), name
        if "UInt16 array" in mesh.point_data and mesh.n_points:
            original = vtk_to_numpy(data.GetPointData().GetArray("UInt16 array"))
            assert np.array_equal(mesh.point_data["UInt16 array"], original), name


def plain_grid(path):
    """Tetrahedra and triangles with numbers only: what meshio can hold."""
    rng = np.random.default_rng(5)
    data = vtk.vtkUnstructuredGrid()
    data.SetPoints(points(30, True, rng))
    for index in range(20):
        kind, size = [(10, 4), (5, 3)][index % 2]
        data.InsertNextCell(kind, size, [int(i) for i in rng.permutation(30)[:size]])
    data.GetPointData().AddArray(number_array("Float64", "a b", 30, 3, rng))
    data.GetCellData().AddArray(number_array("Int32", "c", 20, 1, rng))
    write(data, path, "appended-raw", "None", 64, "Little")
    return data


@pytest.mark.parametrize("encoding", ["raw", "zlib", "lzma", "base64", "ascii"])
def test_meshio_reads_what_we_write(encoding, dump_program, tmp_path):
    meshio = pytest.importorskip("meshio")
    source, path = tmp_path / "vtk.vtu", tmp_path / "ours.vtu"
    data = plain_grid(source)
    subprocess.run([dump_program, "--rewrite", encoding, str(source), str(path)], check=True)
    mesh = meshio.read(path)
    assert np.array_equal(mesh.points, vtk_to_numpy(data.GetPoints().GetData()))
    original = vtk_to_numpy(data.GetPointData().GetArray("a b"))
    assert np.array_equal(mesh.point_data["a b"], original, equal_nan=True)
    cells = [list(map(int, cell)) for block in mesh.cells for cell in block.data]
    lists = describe_lists(data.GetCells())
    ends = lists["offsets"]
    expected = [lists["connectivity"][a:b] for a, b in itertools.pairwise(ends)]
    assert cells == expected


@pytest.mark.parametrize("compression", [None, "zlib", "lzma"])
@pytest.mark.parametrize("binary", [True, False])
def test_we_read_what_meshio_writes(compression, binary, dump_program, tmp_path):
    meshio = pytest.importorskip("meshio")
    path = tmp_path / "meshio.vtu"
    name = "a<b> & 'c' é"  # which meshio writes unescaped
    values = np.arange(4) / 7
    mesh = meshio.Mesh(np.eye(4, 3), [("tetra", [[0, 1, 2, 3]])], point_data={name: values})
    meshio.write(path, mesh, file_format="vtu", binary=binary, compression=compression)
    [line] = dump(dump_program, [path])
    [array] = json.loads(line)["point_data"]["arrays"]
    assert array["name"] == name
    assert np.allclose(array["values"], values, rtol=1e-10)


ODD_NAMES = ["a<b>", "a & b", 'say "x"', "it's", "tab\tnew\nline", "é ∇u", " spaces  ", "]]>"]


@pytest.mark.parametrize("encoding", OUR_ENCODINGS)
def test_vtk_reads_our_odd_names(encoding, dump_program, tmp_path):
    """VTK 9.7 writes names unescaped, so the source is written by hand."""
    from xml.sax.saxutils import quoteattr

    rows = "".join(
        f"<DataArray type='Int8' format='ascii' Name={quoteattr(name)}>{index}</DataArray>"
        for index, name in enumerate(ODD_NAMES)
    )
    source, path = tmp_path / "odd.vtp", tmp_path / "ours.vtp"
    source.write_text(
        "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='1'>"
        f"<PointData Scalars={quoteattr(ODD_NAMES[0])}>{rows}</PointData><Points>"
        "<DataArray type='Float32' NumberOfComponents='3' format='ascii'>1 2 3</DataArray>"
        "</Points></Piece></PolyData></VTKFile>",
        encoding="utf-8",
    )
    subprocess.run([dump_program, "--rewrite", encoding, str(source), str(path)], check=True)
    data = read(path).GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    assert names == ODD_NAMES
    assert data.GetScalars().GetName() == ODD_NAMES[0]
    assert [data.GetArray(i).GetValue(0) for i in range(len(names))] == list(range(len(names)))
