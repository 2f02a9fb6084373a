"""Files of VTK read by us, and ours read by VTK, PyVista and meshio: every encoding.

Run with `python -m pytest tests/vtk_matrix.py`; needs vtk, pyvista, meshio, numpy and
cargo. Ours is the example `vtk_dump`, which is built first.
"""

import itertools
import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

vtk = pytest.importorskip("vtk")
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent

FORMATS = ["ascii", "binary", "appended-base64", "appended-raw"]
COMPRESSORS = ["None", "ZLib", "LZ4", "LZMA"]
HEADERS = [32, 64]
ORDERS = ["Little", "Big"]
MATRIX = list(itertools.product(FORMATS, COMPRESSORS, HEADERS, ORDERS))

OUR_ENCODINGS = ["raw", "zlib", "lz4", "lzma", "base64", "ascii"]

NUMBERS = {
    "Int8": (vtk.vtkSignedCharArray, np.int8),
    "UInt8": (vtk.vtkUnsignedCharArray, np.uint8),
    "Int16": (vtk.vtkShortArray, np.int16),
    "UInt16": (vtk.vtkUnsignedShortArray, np.uint16),
    "Int32": (vtk.vtkIntArray, np.int32),
    "UInt32": (vtk.vtkUnsignedIntArray, np.uint32),
    "Int64": (vtk.vtkLongLongArray, np.int64),
    "UInt64": (vtk.vtkUnsignedLongLongArray, np.uint64),
    "Float32": (vtk.vtkFloatArray, np.float32),
    "Float64": (vtk.vtkDoubleArray, np.float64),
}


@pytest.fixture(scope="session")
def dump_program():
    """Builds the example and returns its path."""
    command = ["cargo", "build", "--example", "vtk_dump", "--message-format=json"]
    built = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    messages = [json.loads(line) for line in built.stdout.splitlines()]
    return [m["executable"] for m in messages if m.get("executable")][-1]


# --- Making data -----------------------------------------------------------------


def number_array(kind, name, tuples, components, rng):
    """An array of random values that holds the extremes of its type."""
    make, dtype = NUMBERS[kind]
    size = (tuples, components)
    if np.issubdtype(dtype, np.floating):
        values = (rng.standard_normal(size) * 10.0 ** rng.integers(-20, 20, size)).astype(dtype)
        special = [np.nan, np.inf, -np.inf, np.finfo(dtype).max, np.finfo(dtype).tiny, -0.0]
    else:
        info = np.iinfo(dtype)
        values = rng.integers(info.min, info.max, size, dtype=dtype, endpoint=True)
        special = [info.min, info.max, 0]
    flat = values.reshape(-1)
    flat[: len(special)] = np.array(special, dtype=dtype)[: len(flat)]
    array = make()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(tuples)
    if tuples:
        vtk_to_numpy(array).reshape(size)[:] = values
    return array


def add_arrays(data, tuples, rng):
    """Arrays of every type, of one to nine components, strings and bits."""
    for index, kind in enumerate(NUMBERS):
        components = [1, 2, 3, 9][index % 4]
        data.AddArray(number_array(kind, f"{kind} array", tuples, components, rng))
    vectors = number_array("Float32", "vectors::of 'é'", tuples, 3, rng)
    vectors.SetComponentName(0, "x")
    vectors.SetComponentName(2, "z é")
    data.AddArray(vectors)
    data.SetActiveVectors("vectors::of 'é'")
    data.SetActiveScalars("UInt8 array")
    texts = vtk.vtkStringArray()
    texts.SetName("texts")
    for index in range(tuples):
        texts.InsertNextValue(["", "é", "a b<&>"][index % 3])
    data.AddArray(texts)
    bits = vtk.vtkBitArray()
    bits.SetName("bits")
    for index in range(tuples):
        bits.InsertNextValue(index % 3 == 0)
    data.AddArray(bits)


def add_field(data):
    time = vtk.vtkDoubleArray()
    time.SetName("TimeValue")
    time.InsertNextValue(0.1)
    data.GetFieldData().AddArray(time)
    texts = vtk.vtkStringArray()
    texts.SetName("names")
    for text in ["one", "", "drei ß"]:
        texts.InsertNextValue(text)
    data.GetFieldData().AddArray(texts)


def points(count, double, rng):
    array = number_array("Float64" if double else "Float32", "Points", count, 3, rng)
    if count:
        vtk_to_numpy(array)[:] = rng.standard_normal((count, 3))
    result = vtk.vtkPoints()
    result.SetDataType(vtk.VTK_DOUBLE if double else vtk.VTK_FLOAT)
    result.SetData(array)
    return result


CELL_SIZES = [(1, 1), (3, 2), (5, 3), (9, 4), (10, 4), (12, 8), (13, 6), (24, 10), (7, 5)]


def grid(count, cells, double=True, seed=1):
    rng = np.random.default_rng(seed)
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points(count, double, rng))
    for index in range(cells):
        kind, size = CELL_SIZES[index % len(CELL_SIZES)]
        ids = rng.permutation(count)[:size]
        result.InsertNextCell(kind, size, [int(i) for i in ids])
    add_arrays(result.GetPointData(), count, rng)
    add_arrays(result.GetCellData(), cells, rng)
    add_field(result)
    return result


def surface(count, cells, seed=2):
    rng = np.random.default_rng(seed)
    result = vtk.vtkPolyData()
    result.SetPoints(points(count, False, rng))
    arrays = [vtk.vtkCellArray() for _ in range(4)]
    for index in range(cells):
        size = [1, 3, 5, 6][index % 4]
        ids = [int(i) for i in rng.permutation(count)[:size]]
        arrays[index % 4].InsertNextCell(size, ids)
    result.SetVerts(arrays[0])
    result.SetLines(arrays[1])
    result.SetPolys(arrays[2])
    result.SetStrips(arrays[3])
    add_arrays(result.GetPointData(), count, rng)
    add_arrays(result.GetCellData(), cells, rng)
    add_field(result)
    return result


def polyhedra():
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points(9, True, np.random.default_rng(3)))
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    result.InsertNextCell(vtk.VTK_TETRA, 4, [5, 6, 7, 8])
    for shift in (0, 5):
        ids = vtk.vtkIdList()
        ids.InsertNextId(len(faces))
        for face in faces:
            ids.InsertNextId(len(face))
            for point in face:
                ids.InsertNextId(point + shift)
        result.InsertNextCell(vtk.VTK_POLYHEDRON, ids)
    return result


GRIDS = {
    "empty": lambda: grid(0, 0),
    "points": lambda: grid(3, 0),
    "small": lambda: grid(12, 9, double=False),
    # 128 doubles are one block of 1024 bytes exactly.
    "whole_blocks": lambda: grid(128, 128),
    "blocks": lambda: grid(1001, 333),
    "no_surface": lambda: surface(0, 0),
    "surface": lambda: surface(50, 41),
    "polyhedra": polyhedra,
}


def is_surface(data):
    return data.IsA("vtkPolyData")


def suffix(data):
    return ".vtp" if is_surface(data) else ".vtu"


def write(data, path, form, compressor, header, order):
    surface = is_surface(data)
    writer = vtk.vtkXMLPolyDataWriter() if surface else vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    getattr(writer, f"SetDataModeTo{form.split('-')[0].capitalize()}")()
    writer.SetEncodeAppendedData(form == "appended-base64")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    getattr(writer, f"SetHeaderTypeToUInt{header}")()
    getattr(writer, f"SetByteOrderTo{order}Endian")()
    writer.SetBlockSize(1024)
    assert writer.Write() == 1


def read(path):
    surface = str(path).endswith(".vtp")
    reader = vtk.vtkXMLPolyDataReader() if surface else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


# --- Describing data as the example does -----------------------------------------


def number_type(array):
    if array.IsA("vtkStringArray"):
        return "String"
    if array.IsA("vtkBitArray"):
        return "UInt8"
    kind = vtk_to_numpy(array).dtype
    return next(name for name, (_, dtype) in NUMBERS.items() if np.dtype(dtype) == kind)


def array_values(array):
    count = array.GetNumberOfTuples() * array.GetNumberOfComponents()
    if array.IsA("vtkStringArray"):
        return [array.GetValue(i) for i in range(count)]
    if array.IsA("vtkBitArray"):
        return [array.GetValue(i) for i in range(count)]
    return vtk_to_numpy(array).reshape(-1).tolist()


def component_names(array):
    names = [array.GetComponentName(i) or "" for i in range(array.GetNumberOfComponents())]
    while names and not names[-1]:
        names.pop()
    return names


def describe_array(array):
    return {
        "name": array.GetName(),
        "type": number_type(array),
        "components": array.GetNumberOfComponents(),
        "component_names": component_names(array),
        "values": array_values(array),
    }


def describe_attributes(data, roles=()):
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    active = {role: getattr(data, f"Get{role}")() for role in roles}
    return {
        "arrays": [describe_array(array) for array in arrays],
        "active": {
            role: array.GetName() for role, array in active.items() if array is not None
        },
    }


def describe_lists(cells):
    return {
        "offsets": vtk_to_numpy(cells.GetOffsetsArray()).tolist(),
        "connectivity": vtk_to_numpy(cells.GetConnectivityArray()).tolist(),
    }


def describe_faces(data):
    """The points of each face and the faces of each cell, from VTK's face streams."""
    faces, cell_faces = [], []
    for cell in range(data.GetNumberOfCells()):
        first = len(faces)
        if data.GetCellType(cell) == vtk.VTK_POLYHEDRON:
            ids = vtk.vtkIdList()
            data.GetFaceStream(cell, ids)
            stream = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
            at = 1
            for _ in range(stream[0]):
                faces.append(stream[at + 1 : at + 1 + stream[at]])
                at += 1 + stream[at]
        cell_faces.append(list(range(first, len(faces))))
    return as_lists(faces), as_lists(cell_faces)


def as_lists(lists):
    sizes = [len(part) for part in lists]
    return {
        "offsets": [0, *itertools.accumulate(sizes)],
        "connectivity": list(itertools.chain(*lists)),
    }


def describe(data):
    if data.GetNumberOfPoints():
        points = describe_array(data.GetPoints().GetData())
    else:
        points = None
    result = {
        "points": points,
        "point_data": describe_attributes(data.GetPointData(), ["Scalars", "Vectors"]),
        "cell_data": describe_attributes(data.GetCellData(), ["Scalars", "Vectors"]),
        "field_data": describe_attributes(data.GetFieldData()),
        "warnings": [],
    }
    if is_surface(data):
        for kind in ["Verts", "Lines", "Polys", "Strips"]:
            result[kind.lower()] = describe_lists(getattr(data, f"Get{kind}")())
        return result
    result["cells"] = describe_lists(data.GetCells())
    result["types"] = [data.GetCellType(i) for i in range(data.GetNumberOfCells())]
    result["faces"] = result["cell_faces"] = None
    if 42 in result["types"]:
        result["faces"], result["cell_faces"] = describe_faces(data)
    return result


def assert_same(found, expected, place="file"):
    if isinstance(expected, dict):
        assert found.keys() == expected.keys(), place
        for key, value in expected.items():
            assert_same(found[key], value, f"{place}.{key}")
    elif isinstance(expected, list):
        assert len(found) == len(expected), place
        for index, pair in enumerate(zip(found, expected)):
            assert_same(*pair, f"{place}[{index}]")
    elif isinstance(expected, float):
        value = float(found)
        both_nan = math.isnan(value) and math.isnan(expected)
        same = value == expected and math.copysign(1, value) == math.copysign(1, expected)
        assert both_nan or same, (place, found, expected)
    else:
        assert found == expected, (place, found, expected)


def expected_of(data):
    """What is expected of a file of these data; empty points may have any type."""
    expected = describe(data)
    if expected["points"]:
        expected["points"]["name"] = "Points"
    return expected


def assert_dump(line, data, name):
    found = json.loads(line)
    assert "error" not in found, (name, found)
    expected = expected_of(data)
    if expected["points"] is None:
        assert found["points"]["values"] == []
        found["points"] = None
    assert_same(found, expected, name)


# --- Tests -----------------------------------------------------------------------


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
    for path, line in zip(paths, lines):
        assert_dump(line, data, path.name)


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
    expected = [lists["connectivity"][a:b] for a, b in zip(ends, ends[1:])]
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
