"""What the sample scripts share: meshing, finite elements, gradients at vertices, writing.

Shapes: N vertices, M triangles. Points, gradients: float64 (N, 3); triangles: int64 (M, 3).
Lengths and values are dimensionless unless a script says otherwise.

Everything is deterministic: gmsh runs in one thread with fixed options, and what is written is
rounded to 12 decimals, so that a machine whose `exp` differs in the last bit writes the same bytes.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import gmsh
import meshio
import numpy as np
from numpy.typing import NDArray
from skfem import Basis, ElementTriP3, MeshTri1, MeshTri2
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Arrays = Mapping[str, NDArray]

DECIMALS = 12
FRONTAL_DELAUNAY = 6
GMSH_OPTIONS = {
    "General.Verbosity": 0,
    "General.NumThreads": 1,
    "Mesh.Algorithm": FRONTAL_DELAUNAY,
    "Mesh.RandomSeed": 1,
    "Mesh.RandomFactor": 1e-9,
    "Mesh.Smoothing": 5,
}


@dataclass(frozen=True)
class TriangleMesh:
    """Vertices (N, 3) and triangles (M, 3) of indices into them; in the plane, z = 0 and ccw."""

    points: Array
    triangles: Indices


# Meshing


def generate(build: Callable[[], None], size: float | None = None) -> TriangleMesh:
    """A triangle mesh of the surfaces that `build` adds to the current gmsh model.

    `size` is the length of edges; without it the sizes that `build` gave to its points hold.
    """
    gmsh.initialize(readConfigFiles=False)
    try:
        for name, value in GMSH_OPTIONS.items():
            gmsh.option.setNumber(name, value)
        if size is not None:
            gmsh.option.setNumber("Mesh.MeshSizeMin", size)
            gmsh.option.setNumber("Mesh.MeshSizeMax", size)
            gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
        gmsh.model.add("sample")
        build()
        gmsh.model.mesh.generate(2)
        return _current_mesh()
    finally:
        gmsh.finalize()


def _current_mesh() -> TriangleMesh:
    """The triangles of gmsh's model with the nodes that they use, in gmsh's order."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, corners = gmsh.model.mesh.getElementsByType(2)
    used, triangles = np.unique(corners, return_inverse=True)
    row = np.empty(int(tags.max()) + 1, dtype=np.int64)
    row[tags] = np.arange(len(tags))
    points = np.round(coordinates.reshape(-1, 3)[row[used]], DECIMALS) + 0.0  # no -0.0
    triangles = triangles.reshape(-1, 3).astype(np.int64)
    if np.ptp(points[:, 2]) == 0.0:
        clockwise = doubled_normals(points, triangles)[:, 2] < 0.0
        triangles[clockwise] = triangles[clockwise][:, [0, 2, 1]]
    return TriangleMesh(points, triangles)


def doubled_normals(points: Array, triangles: Indices) -> Array:
    """Normals (M, 3) of the triangles, as long as twice their areas."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def areas(mesh: TriangleMesh) -> Array:
    """Areas (M,) of the triangles."""
    return np.linalg.norm(doubled_normals(mesh.points, mesh.triangles), axis=1) / 2.0


def centroids(mesh: TriangleMesh) -> Array:
    """Centroids (M, 3) of the triangles."""
    return mesh.points[mesh.triangles].mean(axis=1)


# Finite elements


def planar_elements(
    mesh: TriangleMesh,
    snap: Callable[[Array], Array] = lambda p: p,
    refinements: int = 0,
) -> MeshTri2:
    """Six-node elements over a mesh in the plane, halved `refinements` times.

    `snap` moves points (2, K) of the boundary of the mesh to the true, curved boundary. The
    vertices of `mesh` stay the first N vertices, whatever the refinement.
    """
    linear = MeshTri1(mesh.points[:, :2].T.copy(), mesh.triangles.T.copy())
    for _ in range(refinements):
        middle = linear.p.shape[1] + linear.boundary_facets()
        linear = linear.refined()
        linear.doflocs[:, middle] = snap(linear.doflocs[:, middle])
    curved = MeshTri2.from_mesh(linear)
    middle = curved.dofs.get_facet_dofs(curved.boundary_facets()).flatten()
    curved.doflocs[:, middle] = snap(curved.doflocs[:, middle])
    return curved


def vertex_data(basis: Basis, solution: Array, count: int) -> tuple[Array, Array]:
    """Values (count,) and gradients (count, 3) of a solution at the first `count` vertices.

    A gradient of continuous finite elements jumps from cell to cell: the cells around a vertex
    are averaged with their areas as weights.
    """
    corners = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    at_corners = Basis(
        basis.mesh,
        basis.elem,
        mapping=basis.mapping,
        quadrature=(corners, np.full(3, 1.0 / 6.0)),
        disable_doflocs=True,
    )
    gradient = at_corners.interpolate(solution).grad  # (dimensions, cells, 3)
    weight = basis.dx.sum(axis=1)[:, None]
    vertex = basis.mesh.t.T  # (cells, 3), in the order of the corners
    total = np.bincount(vertex.ravel(), np.broadcast_to(weight, vertex.shape).ravel())
    gradients = np.zeros((count, 3))
    for axis, component in enumerate(gradient):
        sums = np.bincount(vertex.ravel(), (weight * component).ravel())
        gradients[:, axis] = (sums / total)[:count]
    return solution[basis.nodal_dofs[0, :count]], gradients


def cubic_basis(elements: MeshTri1, **options) -> Basis:
    """Continuous piecewise cubic functions (P3) over the elements."""
    return Basis(elements, ElementTriP3(), intorder=8, **options)


# Writing


def rounded(arrays: Arrays | None) -> dict[str, NDArray]:
    """The arrays, floating-point ones rounded to DECIMALS and without negative zeros."""
    return {
        name: np.round(array, DECIMALS) + 0.0 if array.dtype.kind == "f" else array
        for name, array in (arrays or {}).items()
    }


def write_meshio(
    path: Path,
    mesh: TriangleMesh,
    point_data: Arrays,
    cell_data: Arrays | None = None,
    *,
    compression: str | None = "zlib",
    precision: type[np.floating] = np.float64,
) -> None:
    """A .vtu by meshio: inline base64, compressed ('zlib', 'lzma') or not (None).

    `precision` is that of the points; other arrays keep their own.
    """
    grid = meshio.Mesh(
        mesh.points.astype(precision),
        [("triangle", mesh.triangles)],
        point_data=rounded(point_data),
        cell_data={name: [array] for name, array in rounded(cell_data).items()},
    )
    meshio.vtu.write(path, grid, binary=True, compression=compression)


def write_vtk(
    path: Path,
    mesh: TriangleMesh,
    point_data: Arrays,
    cell_data: Arrays | None = None,
    *,
    active: str,
    field_data: Arrays | None = None,
    mode: str = "appended",
    compressor: str = "none",
    header_bits: int = 64,
) -> None:
    """A .vtu by VTK, `active` its active scalars and `field_data` what belongs to the whole.

    mode: 'appended' (raw bytes), 'binary' (inline base64) or 'ascii'.
    compressor: 'none', 'zlib' or 'lz4'.
    """
    grid = vtk_grid(mesh, rounded(point_data), rounded(cell_data))
    grid.GetPointData().SetActiveScalars(active)
    for name, array in rounded(field_data).items():
        grid.GetFieldData().AddArray(_vtk_array(name, array))
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.EncodeAppendedDataOff()
    {
        "appended": writer.SetDataModeToAppended,
        "binary": writer.SetDataModeToBinary,
        "ascii": writer.SetDataModeToAscii,
    }[mode]()
    {
        "none": writer.SetCompressorTypeToNone,
        "zlib": writer.SetCompressorTypeToZLib,
        "lz4": writer.SetCompressorTypeToLZ4,
    }[compressor]()
    {32: writer.SetHeaderTypeToUInt32, 64: writer.SetHeaderTypeToUInt64}[header_bits]()
    if writer.Write() != 1:
        raise OSError(f"cannot write {path}")


def vtk_grid(mesh: TriangleMesh, point_data: Arrays, cell_data: Arrays) -> vtkUnstructuredGrid:
    """The mesh and its arrays as VTK's unstructured grid (copies)."""
    points = vtkPoints()
    points.SetData(_vtk_array("Points", mesh.points))
    cells = vtkCellArray()
    offsets = np.arange(0, mesh.triangles.size + 1, 3, dtype=np.int64)
    cells.SetData(
        _vtk_array("offsets", offsets), _vtk_array("connectivity", mesh.triangles.ravel())
    )
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(VTK_TRIANGLE, cells)
    for attributes, arrays in ((grid.GetPointData(), point_data), (grid.GetCellData(), cell_data)):
        for name, array in arrays.items():
            attributes.AddArray(_vtk_array(name, array))
    return grid


def _vtk_array(name: str, array: NDArray):
    """A copy of an array, which VTK owns."""
    result = numpy_to_vtk(np.ascontiguousarray(array), deep=True)
    result.SetName(name)
    return result


# Command line


def command_line(main: Callable[[Path], None], default: Path, description: str) -> None:
    """Run a script's `main` with the path given by --output."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("-o", "--output", type=Path, default=default, help="what to write")
    main(parser.parse_args().output)
