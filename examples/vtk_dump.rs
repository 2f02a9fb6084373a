//! Shows what the library reads from VTK's files, and writes them again.
//!
//! ```text
//! vtk_dump FILE...                            one line of JSON a file
//! vtk_dump --rewrite ENCODING INPUT OUTPUT    raw, zlib, lz4, lzma, base64 or ascii
//! vtk_dump --list OUTPUT INPUT...             a .pvtu, .pvtp or .pvd of these files
//! ```
//!
//! A file that cannot be read gives `{"error": "..."}`.

use serde_json::{Value, json};
use std::error::Error;
use vtu2contour::vtk::{
    Attributes, CellArray, DataArray, Declaration, Encoding, Floats, LegacyData, LegacyFile,
    PolyData, PvdEntry, PvdFile, PvtpFile, Selection, UnstructuredGrid, Values, VtkError, VtpFile,
    VtuFile, WriteOptions, read_grid, write_pvd, write_pvtp, write_pvtu, write_vtp, write_vtu,
};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [flag, encoding, input, output] if flag == "--rewrite" => {
            rewrite(encoding.parse()?, input, output)
        }
        [flag, output, inputs @ ..] if flag == "--list" => list(output, inputs),
        files => {
            for file in files {
                let value = dump(file).unwrap_or_else(|e| json!({ "error": e.to_string() }));
                println!("{value}");
            }
            Ok(())
        }
    }
}

fn dump(path: &str) -> Result<Value, VtkError> {
    let extension = path.rsplit('.').next().unwrap_or_default();
    let all = &Selection::All;
    match extension {
        "vtp" => VtpFile::open(path)?.read(all).map(|l| poly_data(&l.data, &l.warnings)),
        "pvtp" => PvtpFile::open(path)?.read(all).map(|l| poly_data(&l.data, &l.warnings)),
        "pvd" => PvdFile::open(path).map(|file| series(&file)),
        "vtk" => LegacyFile::open(path)?.read(all).map(|loaded| match &loaded.data {
            LegacyData::Grid(data) => grid(data, &loaded.warnings),
            LegacyData::PolyData(data) => poly_data(data, &loaded.warnings),
        }),
        _ => read_grid(path, all).map(|l| grid(&l.data, &l.warnings)),
    }
}

fn series(file: &PvdFile) -> Value {
    let entry = |entry: &PvdEntry| json!({ "time": entry.time, "part": entry.part, "group": entry.group, "file": entry.file });
    file.entries().iter().map(entry).collect()
}

/// Lists files: pieces, or a series whose times are 0, 0.5, 1, ...
fn list(output: &str, inputs: &[String]) -> Result<(), Box<dyn Error>> {
    let all = &Selection::All;
    let first = inputs.first().ok_or("no files")?;
    if output.ends_with(".pvtu") {
        let piece = VtuFile::open(first)?.read(all)?.data;
        write_pvtu(output, inputs, &Declaration::of_grid(&piece, Floats::AsGiven))?;
    } else if output.ends_with(".pvtp") {
        let piece = VtpFile::open(first)?.read(all)?.data;
        write_pvtp(output, inputs, &Declaration::of_poly_data(&piece, Floats::AsGiven))?;
    } else {
        let entry = |(index, file)| PvdEntry::new(f64::from(index) / 2.0, file);
        let entries: Vec<PvdEntry> = (0u32..).zip(inputs).map(entry).collect();
        write_pvd(output, &entries)?;
    }
    Ok(())
}

fn grid(grid: &UnstructuredGrid, warnings: &[String]) -> Value {
    let polyhedra = grid.polyhedra.as_ref();
    json!({
        "points": array(&grid.points),
        "cells": lists(&grid.cells),
        "types": grid.types,
        "faces": polyhedra.map(|polyhedra| lists(&polyhedra.faces)),
        "cell_faces": polyhedra.map(|polyhedra| lists(&polyhedra.cells)),
        "point_data": attributes(&grid.point_data),
        "cell_data": attributes(&grid.cell_data),
        "field_data": attributes(&grid.field_data),
        "warnings": warnings,
    })
}

fn poly_data(data: &PolyData, warnings: &[String]) -> Value {
    json!({
        "points": array(&data.points),
        "verts": lists(&data.verts),
        "lines": lists(&data.lines),
        "polys": lists(&data.polys),
        "strips": lists(&data.strips),
        "point_data": attributes(&data.point_data),
        "cell_data": attributes(&data.cell_data),
        "field_data": attributes(&data.field_data),
        "warnings": warnings,
    })
}

fn lists(lists: &CellArray) -> Value {
    json!({ "offsets": Vec::from_iter(lists.offsets()), "connectivity": lists.connectivity() })
}

fn attributes(attributes: &Attributes) -> Value {
    let active = attributes.active_names().iter();
    let active = active.map(|(kind, name)| (kind.name().to_owned(), json!(name)));
    json!({
        "arrays": attributes.iter().map(array).collect::<Vec<_>>(),
        "active": Value::Object(active.collect()),
    })
}

fn array(array: &DataArray) -> Value {
    json!({
        "name": array.name,
        "type": array.array_type().name(),
        "components": array.components,
        "component_names": array.component_names,
        "values": values(&array.values),
    })
}

fn values(values: &Values) -> Value {
    match values {
        Values::I8(vector) => json!(vector),
        Values::U8(vector) => json!(vector),
        Values::I16(vector) => json!(vector),
        Values::U16(vector) => json!(vector),
        Values::I32(vector) => json!(vector),
        Values::U32(vector) => json!(vector),
        Values::I64(vector) => json!(vector),
        Values::U64(vector) => json!(vector),
        Values::F32(vector) => vector.iter().map(|v| float(f64::from(*v))).collect(),
        Values::F64(vector) => vector.iter().map(|v| float(*v)).collect(),
        Values::Strings(vector) => json!(vector),
    }
}

/// JSON has no NaN and no infinity: they become texts.
fn float(value: f64) -> Value {
    match value.is_finite() {
        true => json!(value),
        false => json!(value.to_string()),
    }
}

fn rewrite(encoding: Encoding, input: &str, output: &str) -> Result<(), Box<dyn Error>> {
    let options = WriteOptions::from(encoding);
    if input.ends_with(".vtp") {
        let loaded = VtpFile::open(input)?.read(&Selection::All)?;
        write_vtp(output, &loaded.data, options)?;
    } else {
        let loaded = VtuFile::open(input)?.read(&Selection::All)?;
        write_vtu(output, &loaded.data, options)?;
    }
    Ok(())
}
