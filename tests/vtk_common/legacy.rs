//! Legacy files of every kind, written by hand.

/// Names and bytes of small files in the older format.
#[allow(dead_code)] // each test uses its part
pub fn samples() -> Vec<(String, Vec<u8>)> {
    vec![
        (String::from("old.vtk"), old_grid()),
        (String::from("new.vtk"), new_grid()),
        (String::from("binary.vtk"), binary_grid()),
        (String::from("surface.vtk"), surface()),
        (String::from("polyhedron.vtk"), polyhedron()),
    ]
}

/// Ascii, before version 5, with every keyword.
pub fn old_grid() -> Vec<u8> {
    "# vtk DataFile Version 3.0\nA title: binary\nASCII\nDATASET UNSTRUCTURED_GRID\n\
     FIELD FieldData 2\nTimeValue 1 1 double\n0.25\nnames 1 2 string\na%20b\n\n\
     POINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 1\n\
     CELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10\n5\n\
     CELL_DATA 2\nSCALARS id vtkIdType\nLOOKUP_TABLE default\n7 -8\n\
     FIELD more 2\nNULL_ARRAY\nbits 3 2 bit\n0 1 1\n0 0 1\n\
     POINT_DATA 4\nSCALARS s%201 double 1\nLOOKUP_TABLE table\n1e-3 nan -inf 4\n\
     LOOKUP_TABLE table 2\n0 0 0 1 1 1 1 1\n\
     VECTORS v float\n1 2 3 4 5 6 7 8 9 10 11 12\n\
     METADATA\nCOMPONENT_NAMES\nx\n\nz%20z\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION \
     vtkDataArray\nDATA 2 3.7 19.1\n\n\
     NORMALS n short\n1 2 3 4 5 6 7 8 9 10 11 12\n\
     TENSORS t unsigned_char\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n\
     1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n\
     TEXTURE_COORDINATES uv 2 float\n0 0 0 1 1 0 1 1\n\
     COLOR_SCALARS rgb 3\n0 0.5 1 0 0 0 1 1 1 0.2 0.4 0.6\n\
     SCALARS s2 int 2\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n\
     GLOBAL_IDS g vtktypeint64\n10 11 12 13\n"
        .into()
}

/// Ascii, version 5.1.
pub fn new_grid() -> Vec<u8> {
    "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n\
     POINTS 4 double\n0 0 0 1 0 0 0 1 0\n0 0 1\nMETADATA\nINFORMATION 0\n\n\
     CELLS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2\n\
     CELL_TYPES 2\n10\n5\n\nPOINT_DATA 4\nFIELD FieldData 2\n\
     u 1 4 unsigned_long\n1 2 3 18446744073709551615\nc 2 4 signed_char\n1 -2 3 -4 5 -6 7 -8\n"
        .into()
}

/// Binary, before version 5: numbers are big-endian.
pub fn binary_grid() -> Vec<u8> {
    let mut file =
        b"# vtk DataFile Version 4.2\r\nx\r\nBINARY\nDATASET UNSTRUCTURED_GRID\n".to_vec();
    file.extend(b"POINTS 4 double\n");
    for value in [0.0f64, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0] {
        file.extend(value.to_be_bytes());
    }
    file.extend(b"\nCELLS 1 5\n");
    [4i32, 0, 1, 2, 3].iter().for_each(|value| file.extend(value.to_be_bytes()));
    file.extend(
        b"\nCELL_TYPES 1\n\0\0\0\x0A\nPOINT_DATA 4\nSCALARS s float\nLOOKUP_TABLE default\n",
    );
    [1.5f32, -2.0, 3.0, 0.1].iter().for_each(|value| file.extend(value.to_be_bytes()));
    file.extend(
        b"\nLOOKUP_TABLE default 1\n\x01\x02\x03\x04\nFIELD FieldData 3\ni 1 4 vtkIdType\n",
    );
    [1i32, -1, 1 << 30, 0].iter().for_each(|value| file.extend(value.to_be_bytes()));
    file.extend(b"\nt 1 4 string\n\xC1a\xC0\x80\x01b\x40\0\0\x01c\nb 2 4 bit\n\x55\n");
    file
}

/// Polygonal data of all four kinds.
pub fn surface() -> Vec<u8> {
    "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 int\n\
     0 0 0 1 0 0 0 1 0 1 1 0\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\n\
     TRIANGLE_STRIPS 1 5\n4 0 1 2 3\nCELL_DATA 4\nSCALARS s int\nLOOKUP_TABLE default\n1 2 3 4\n"
        .into()
}

/// A polyhedron, whose list of points holds its faces.
pub fn polyhedron() -> Vec<u8> {
    "# vtk DataFile Version 4.2\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n\
     0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\nCELLS 2 23\n17 4 3 4 2 1 3 4 1 3 3 1 2 3 3 4 3 2\n\
     4 3 2 1 0\nCELL_TYPES 2\n42\n10\n"
        .into()
}
