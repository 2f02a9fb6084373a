//! Times reading and writing inside the process, for `benches/vtk_files.py`.
//!
//! ```text
//! vtk_time read FILE
//! vtk_time write ENCODING INPUT OUTPUT    raw, zlib, lz4, lzma, base64 or ascii
//! ```
//!
//! Prints the seconds that it took.

use std::error::Error;
use std::time::Instant;
use vtu2contour::vtk::{Encoding, Selection, read_grid, write_vtu};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let seconds = match &arguments[..] {
        ["read", file] => read(file)?,
        ["write", encoding, input, output] => write(encoding.parse()?, input, output)?,
        _ => return Err("read FILE, or write ENCODING INPUT OUTPUT".into()),
    };
    println!("{seconds}");
    Ok(())
}

fn read(file: &str) -> Result<f64, Box<dyn Error>> {
    let start = Instant::now();
    let loaded = read_grid(file, &Selection::All)?;
    let seconds = start.elapsed().as_secs_f64();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    Ok(seconds)
}

fn write(encoding: Encoding, input: &str, output: &str) -> Result<f64, Box<dyn Error>> {
    let grid = read_grid(input, &Selection::All)?.data;
    let start = Instant::now();
    write_vtu(output, &grid, encoding.into())?;
    Ok(start.elapsed().as_secs_f64())
}
