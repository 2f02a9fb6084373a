"""Data sets of VTK for test_vtk_matrix.py, and their description as the example gives it."""

import itertools
import math
import re
from pathlib import Path

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

import vtk

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


def higher_order():
    """Hexahedra whose nodes VTK 9 numbers otherwise than VTK 8 did."""
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points(64, True, np.random.default_rng(6)))
    for kind, size in [(72, 27), (79, 64), (72, 8), (12, 8)]:
        result.InsertNextCell(kind, size, list(range(size)))
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
    "higher_order": higher_order,
}


def is_surface(data):
    return data.IsA("vtkPolyData")


def suffix(data):
    return ".vtp" if is_surface(data) else ".vtu"


def writer_of(data, prefix, path):
    """VTK's writer of that family: XML, XMLP or none for the older format."""
    kind = "PolyData" if is_surface(data) else "UnstructuredGrid"
    writer = getattr(vtk, f"vtk{prefix}{kind}Writer")()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    return writer


def write(data, path, form, compressor, header, order):
    writer = writer_of(data, "XML", path)
    getattr(writer, f"SetDataModeTo{form.split('-')[0].capitalize()}")()
    writer.SetEncodeAppendedData(form == "appended-base64")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    getattr(writer, f"SetHeaderTypeToUInt{header}")()
    getattr(writer, f"SetByteOrderTo{order}Endian")()
    writer.SetBlockSize(1024)
    assert writer.Write() == 1


READERS = {
    ".vtu": vtk.vtkXMLUnstructuredGridReader,
    ".vtp": vtk.vtkXMLPolyDataReader,
    ".pvtu": vtk.vtkXMLPUnstructuredGridReader,
    ".pvtp": vtk.vtkXMLPPolyDataReader,
    "unstructured_grid": vtk.vtkUnstructuredGridReader,
    "polydata": vtk.vtkPolyDataReader,
}

LEGACY_ROLES = ["Scalars", "Vectors", "Normals", "Tensors", "TCoords", "ColorScalars", "Fields"]


def read(path):
    path = Path(path)
    kind = path.suffix
    if kind == ".vtk":
        kind = re.search(rb"(?i)\bdataset\s+(\w+)", path.read_bytes())[1].decode().lower()
    reader = READERS[kind]()
    reader.SetFileName(str(path))
    if path.suffix == ".vtk":
        for role in LEGACY_ROLES:
            getattr(reader, f"ReadAll{role}On")()
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
        "active": {role: array.GetName() for role, array in active.items() if array is not None},
    }


def describe_lists(cells):
    if cells is None or cells.GetNumberOfCells() == 0:
        return {"offsets": [0], "connectivity": []}
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


ROLES = ["Scalars", "Vectors", "Normals", "Tensors", "TCoords", "GlobalIds", "PedigreeIds"]


def describe(data):
    if data.GetNumberOfPoints():
        points = describe_array(data.GetPoints().GetData())
    else:
        points = None
    result = {
        "points": points,
        "point_data": describe_attributes(data.GetPointData(), ROLES),
        "cell_data": describe_attributes(data.GetCellData(), ROLES),
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
        for index, pair in enumerate(zip(found, expected, strict=True)):
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
