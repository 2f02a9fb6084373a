//! Shows what the library reads from `.vtu` and `.vtp` files, and writes them again.
//!
//! ```text
//! vtk_dump FILE...                            one line of JSON a file
//! vtk_dump --rewrite ENCODING INPUT OUTPUT    raw, zlib, lz4, lzma, base64 or ascii
//! ```
//!
//! A file that cannot be read gives `{"error": "..."}`.

use serde_json::{Value, json};
use std::error::Error;
use vtu2contour::vtk::{
    Attributes, CellArray, DataArray, Encoding, PolyData, Selection, UnstructuredGrid, Values,
    VtkError, VtpFile, VtuFile, WriteOptions, write_vtp, write_vtu,
};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [flag, encoding, input, output] if flag == "--rewrite" => {
            rewrite(parse_encoding(encoding)?, input, output)
        }
        files => {
            for file in files {
                let value = dump(file).unwrap_or_else(|e| json!({ "error": e.to_string() }));
                println!("{value}");
            }
            Ok(())
        }
    }
}

fn is_poly_data(path: &str) -> bool {
    path.ends_with(".vtp")
}

fn dump(path: &str) -> Result<Value, VtkError> {
    if is_poly_data(path) {
        let loaded = VtpFile::open(path)?.read(&Selection::All)?;
        return Ok(poly_data(&loaded.data, &loaded.warnings));
    }
    let loaded = VtuFile::open(path)?.read(&Selection::All)?;
    Ok(grid(&loaded.data, &loaded.warnings))
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
    json!({ "offsets": lists.offsets(), "connectivity": lists.connectivity() })
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

fn parse_encoding(name: &str) -> Result<Encoding, String> {
    match name {
        "raw" => Ok(Encoding::Raw),
        "zlib" => Ok(Encoding::Zlib),
        "lz4" => Ok(Encoding::Lz4),
        "lzma" => Ok(Encoding::Lzma),
        "base64" => Ok(Encoding::Base64),
        "ascii" => Ok(Encoding::Ascii),
        _ => Err(format!("unknown encoding '{name}'")),
    }
}

fn rewrite(encoding: Encoding, input: &str, output: &str) -> Result<(), Box<dyn Error>> {
    let options = WriteOptions::from(encoding);
    if is_poly_data(input) {
        let loaded = VtpFile::open(input)?.read(&Selection::All)?;
        write_vtp(output, &loaded.data, options)?;
    } else {
        let loaded = VtuFile::open(input)?.read(&Selection::All)?;
        write_vtu(output, &loaded.data, options)?;
    }
    Ok(())
}
