//! Points as lines of numbers with commas between them.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::Attributes;

/// Reads points. The first line may name the columns: then those called x, y and z (or, as
/// ParaView writes them, Points:0 and so on) are taken, else the first two or three. Empty
/// lines do not count.
pub fn read_points(path: &Path) -> Result<Vec<Vector>> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| anyhow!("cannot read '{}': {error}", path.display()))?;
    parse(&text).map_err(|error| anyhow!("'{}': {error:#}", path.display()))
}

fn parse(text: &str) -> Result<Vec<Vector>> {
    let lines = text.lines().enumerate().map(|(number, line)| (number + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty()).peekable();
    let Some(&(_, first)) = lines.peek() else { bail!("there are no points in it") };
    let columns = match named_columns(first)? {
        Some(columns) => {
            lines.next();
            columns
        }
        None => [0, 1, 2].into_iter().take(fields(first).count().max(2)).collect(),
    };
    lines
        .map(|(number, line)| point(line, &columns).with_context(|| format!("line {number}")))
        .collect()
}

fn fields(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(|field| field.trim().trim_matches('"'))
}

/// The columns of the coordinates, if the line has names.
fn named_columns(line: &str) -> Result<Option<Vec<usize>>> {
    if fields(line).all(|field| field.parse::<f64>().is_ok()) {
        return Ok(None);
    }
    let find = |names: [&str; 2]| {
        fields(line).position(|field| names.iter().any(|name| field.eq_ignore_ascii_case(name)))
    };
    let (x, y) = (find(["x", "Points:0"]), find(["y", "Points:1"]));
    let (Some(x), Some(y)) = (x, y) else {
        bail!("line 1: no columns called x and y (z may follow): '{line}'")
    };
    Ok(Some([Some(x), Some(y), find(["z", "Points:2"])].into_iter().flatten().collect()))
}

fn point(line: &str, columns: &[usize]) -> Result<Vector> {
    let all: Vec<&str> = fields(line).collect();
    let mut point = Vector::zeros();
    for (coordinate, &column) in point.iter_mut().zip(columns) {
        let field = all.get(column).with_context(|| {
            format!("{} columns, and column {} is a coordinate", all.len(), column + 1)
        })?;
        *coordinate = field.parse().with_context(|| format!("'{field}' is no number"))?;
    }
    Ok(point)
}

/// Writes points and their data: x, y and z, then a column for each component.
pub fn write_points(out: &mut impl Write, points: &[Vector], data: &Attributes) -> io::Result<()> {
    let mut names = ["x", "y", "z"].map(String::from).to_vec();
    let mut columns: Vec<Vec<f64>> =
        (0..3).map(|axis| points.iter().map(|point| point[axis]).collect()).collect();
    for array in data {
        for component in 0..array.components {
            let Some(values) = array.component(component) else { continue };
            names.push(match array.components {
                1 => quoted(&array.name),
                _ => quoted(&format!("{}:{component}", array.name)),
            });
            columns.push(values);
        }
    }
    writeln!(out, "{}", names.join(","))?;
    for row in 0..points.len() {
        let fields: Vec<String> = columns.iter().map(|column| column[row].to_string()).collect();
        writeln!(out, "{}", fields.join(","))?;
    }
    Ok(())
}

fn quoted(name: &str) -> String {
    let name = name.replace('"', "\"\"");
    if name.contains([',', '"', '\n']) { format!("\"{name}\"") } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vtu2contour::vtk::DataArray;

    #[test]
    fn with_and_without_names() {
        let expected = [Vector::new(1.0, 2.0, 0.0), Vector::new(0.5, -1e3, 0.0)];
        assert_eq!(parse("1,2\n\n 0.5, -1e3\n").unwrap(), expected);
        assert_eq!(parse("id,Y,\"x\"\n7,2,1\n8,-1000,0.5").unwrap(), expected);
        let solid = parse("\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3").unwrap();
        assert_eq!(solid, [Vector::new(1.0, 2.0, 3.0)]);
        assert_eq!(parse("1,2,3,4").unwrap(), [Vector::new(1.0, 2.0, 3.0)]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let error = |text: &str| format!("{:#}", parse(text).unwrap_err());
        assert_eq!(error("x,y\n1,2\n1,two"), "line 3: 'two' is no number: invalid float literal");
        assert_eq!(error("1,2\n1"), "line 2: 1 columns, and column 2 is a coordinate");
        assert!(error("a,b\n1,2").starts_with("line 1: no columns called x and y"));
        assert_eq!(error(" \n"), "there are no points in it");
    }

    #[test]
    fn written_columns() {
        let data = [
            DataArray::new("a,b", 1, vec![1_i32, 2]),
            DataArray::new("g", 2, vec![0.5, f64::NAN, 3.0, 4.0]),
        ];
        let mut bytes = Vec::new();
        let points = [Vector::x(), Vector::y()];
        write_points(&mut bytes, &points, &data.into_iter().collect()).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(text, "x,y,z,\"a,b\",g:0,g:1\n1,0,0,1,0.5,NaN\n0,1,0,2,3,4\n");
    }
}
