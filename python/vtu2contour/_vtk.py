"""Meshes of vtk taken apart into arrays, and put together from them.

Nothing of vtk is imported before a mesh of vtk is given, and nothing of pyvista before one of
pyvista.
"""

from __future__ import annotations

from typing import Any

import numpy as np

#: VTK's roles of arrays, in the order of its attribute types.
ROLES = (
    "Scalars",
    "Vectors",
    "Normals",
    "TCoords",
    "Tensors",
    "GlobalIds",
    "PedigreeIds",
    "EdgeFlag",
    "Tangents",
    "RationalWeights",
    "HigherOrderDegrees",
    "ProcessIds",
)

POLYHEDRON = 42


def is_of_pyvista(mesh: Any) -> bool:
    """Whether a mesh is one of pyvista's classes."""
    return any(cls.__module__.partition(".")[0] == "pyvista" for cls in type(mesh).__mro__)


def is_composite(mesh: Any) -> bool:
    """Whether a mesh is made of blocks."""
    return bool(mesh.IsA("vtkCompositeDataSet"))


def parts_of(mesh: Any) -> dict[str, Any]:
    """A mesh of vtk as arrays, which are views where vtk has them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    grid = _as_grid(mesh)
    points = np.zeros((0, 3))
    if grid.GetPoints() is not None:
        points = vtk_to_numpy(grid.GetPoints().GetData())
    offsets, connectivity = _lists(grid.GetCells(), grid.GetNumberOfCells())
    return {
        "points": ("Points", points, []),
        "offsets": offsets,
        "connectivity": connectivity,
        "types": _types(grid),
        "faces": _faces(grid),
        "point_data": _arrays(grid.GetPointData()),
        "cell_data": _arrays(grid.GetCellData()),
        "field_data": _arrays(grid.GetFieldData()),
        "point_roles": _roles(grid.GetPointData()),
        "cell_roles": _roles(grid.GetCellData()),
    }


def poly_data(parts: dict[str, Any]) -> Any:
    """A ``vtkPolyData`` of arrays."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(parts["points"], deep=True))
    data.SetPoints(points)
    for name, put in (("lines", data.SetLines), ("polys", data.SetPolys)):
        if len(parts[name][0]) > 1:
            put(_cells(*parts[name]))
    _put_data(data, parts)
    return data


def with_cell_arrays(mesh: Any, arrays: dict[str, np.ndarray]) -> Any:
    """A copy of a mesh with further cell arrays; it shares all others with the mesh."""
    copy = mesh.NewInstance()
    copy.ShallowCopy(mesh)
    _put(copy.GetCellData(), [(name, values, []) for name, values in arrays.items()], [])
    return copy


def unstructured_grid(parts: dict[str, Any]) -> Any:
    """A ``vtkUnstructuredGrid`` of arrays."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetData(numpy_to_vtk(parts["points"], deep=True))
    grid.SetPoints(points)
    types = numpy_to_vtk(parts["types"], deep=True, array_type=VTK_UNSIGNED_CHAR)
    grid.SetCells(types, _cells(*parts["cells"]))
    _put_data(grid, parts)
    return grid


def _as_grid(mesh: Any) -> Any:
    """The mesh as a ``vtkUnstructuredGrid``."""
    if mesh.IsA("vtkUnstructuredGrid"):
        return mesh
    if not mesh.IsA("vtkDataSet"):
        raise TypeError(f"a {mesh.GetClassName()} is no mesh that can be contoured")
    from vtkmodules.vtkFiltersCore import vtkAppendFilter

    append = vtkAppendFilter()
    append.AddInputData(mesh)
    append.Update()
    return append.GetOutput()


def _lists(cells: Any, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Offsets and connectivity of a ``vtkCellArray``, 64 bits wide."""
    if cells is None or count == 0:
        return np.zeros(1, np.int64), np.zeros(0, np.int64)
    arrays = (cells.GetOffsetsArray(), cells.GetConnectivityArray())
    offsets, connectivity = (_numbers(array).astype(np.int64, copy=False) for array in arrays)
    return np.ascontiguousarray(offsets), np.ascontiguousarray(connectivity)


def _numbers(array: Any) -> np.ndarray:
    """The numbers of a vtk array, also of one that computes them (VTK 9.5 and later)."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if array.HasStandardMemoryLayout():
        return vtk_to_numpy(array)
    values = range(array.GetNumberOfTuples())
    return np.array([array.GetComponent(n, 0) for n in values]).astype(np.int64)


def _types(grid: Any) -> np.ndarray:
    """The type of each cell."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkVersion

    if grid.GetNumberOfCells() == 0:
        return np.zeros(0, np.uint8)
    version = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion())
    # before VTK 9.6, GetCellTypes is something else
    array = grid.GetCellTypes() if version >= (9, 6) else grid.GetCellTypesArray()
    if array is not None and array.HasStandardMemoryLayout():
        return np.ascontiguousarray(vtk_to_numpy(array), np.uint8)
    # a type that all cells have may be stored once
    return np.fromiter(map(grid.GetCellType, range(grid.GetNumberOfCells())), np.uint8)


def _faces(grid: Any) -> tuple[list[int], list[int]] | None:
    """The faces of polyhedra, as VTK's files listed them before 9.4; nothing without any."""
    types = _types(grid)
    polyhedra = np.flatnonzero(types == POLYHEDRON)
    if not len(polyhedra):
        return None
    from vtkmodules.vtkCommonCore import vtkIdList

    stream: list[int] = []
    ends, faces = np.full(len(types), -1), vtkIdList()
    for cell in polyhedra.tolist():
        grid.GetFaceStream(cell, faces)
        stream.extend(faces.GetId(n) for n in range(faces.GetNumberOfIds()))
        ends[cell] = len(stream)
    return stream, ends.tolist()


def _arrays(data: Any) -> list[tuple[str, Any, list[str]]]:
    """The arrays of points, cells or the field that hold numbers or texts."""
    arrays = (data.GetAbstractArray(n) for n in range(data.GetNumberOfArrays()))
    taken = [(array.GetName() or "", _values(array), _component_names(array)) for array in arrays]
    return [entry for entry in taken if entry[1] is not None]


def _values(array: Any) -> Any:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if array.IsA("vtkStringArray"):
        return [array.GetValue(n) for n in range(array.GetNumberOfValues())]
    if not array.IsA("vtkDataArray"):
        return None
    if array.IsA("vtkBitArray"):
        values = [array.GetValue(n) for n in range(array.GetNumberOfValues())]
        return np.array(values, np.uint8).reshape(-1, array.GetNumberOfComponents())
    return vtk_to_numpy(array)


def _component_names(array: Any) -> list[str]:
    if not array.HasAComponentName():
        return []
    return [array.GetComponentName(n) or "" for n in range(array.GetNumberOfComponents())]


def _roles(data: Any) -> list[tuple[str, str]]:
    """Roles and the names of the arrays that have them."""
    from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

    # older versions know fewer, and look beyond their end for others
    known = ROLES[: vtkDataSetAttributes.NUM_ATTRIBUTES]
    arrays = [(role, data.GetAbstractAttribute(n)) for n, role in enumerate(known)]
    return [(role, array.GetName() or "") for role, array in arrays if array is not None]


def _cells(offsets: np.ndarray, connectivity: np.ndarray) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray

    cells = vtkCellArray()
    arrays = (numpy_to_vtkIdTypeArray(array, deep=True) for array in (offsets, connectivity))
    cells.SetData(*arrays)
    return cells


def _put_data(mesh: Any, parts: dict[str, Any]) -> None:
    _put(mesh.GetPointData(), parts["point_data"], parts["point_roles"])
    _put(mesh.GetCellData(), parts["cell_data"], parts["cell_roles"])
    _put(mesh.GetFieldData(), parts["field_data"], [])


def _put(data: Any, arrays: list[tuple[str, Any, list[str]]], roles: list[tuple[str, str]]) -> None:
    for name, values, component_names in arrays:
        array = _array(values)
        array.SetName(name)
        for n, component in enumerate(component_names):
            array.SetComponentName(n, component)
        data.AddArray(array)
    for role, name in roles:
        data.SetActiveAttribute(name, ROLES.index(role))


def _array(values: Any) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtk

    if isinstance(values, np.ndarray):
        return numpy_to_vtk(values, deep=True)
    from vtkmodules.vtkCommonCore import vtkStringArray

    texts = vtkStringArray()
    for text in values:
        texts.InsertNextValue(text)
    return texts
