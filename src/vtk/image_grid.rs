//! Regular grids of points along the axes, and writing them (`.vti`).

use super::attributes::Attributes;
use super::error::{ArrayError, VtkError};
use super::write_options::WriteOptions;
use super::writing::{write_attributes, write_field};
use super::xml_writer::XmlWriter;
use std::io::{self, Write};

/// Regular points along the axes with data, as VTK's `vtkImageData`.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageGrid {
    /// The first point.
    pub origin: [f64; 3],
    /// The distance of neighbours along each axis.
    pub spacing: [f64; 3],
    /// How many points there are along each axis, one at least.
    pub counts: [usize; 3],
    /// Arrays with one tuple a point, along x first, then y, then z.
    pub point_data: Attributes,
    /// Arrays of any length.
    pub field_data: Attributes,
}

impl ImageGrid {
    /// How many points there are.
    pub fn point_count(&self) -> usize {
        self.counts.iter().product()
    }

    /// The points, in the order of the data.
    pub fn points(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let [nx, ny, _] = self.counts;
        (0..self.point_count()).map(move |n| {
            let place = [n % nx, n / nx % ny, n / (nx * ny)];
            [0, 1, 2].map(|axis| self.origin[axis] + self.spacing[axis] * place[axis] as f64)
        })
    }
}

/// Writes regular points as the bytes of a `.vti` file.
///
/// # Errors
/// [`VtkError::Inconsistent`] if an array has another length than there are points,
/// [`VtkError::Write`] if the file cannot be written.
pub fn write_vti_to(
    out: impl Write,
    image: &ImageGrid,
    options: WriteOptions,
) -> Result<(), VtkError> {
    for array in &image.point_data {
        let (found, expected) = (array.values.len(), image.point_count() * array.components);
        if found != expected {
            let (name, problem) = (array.name.clone(), ArrayError::Count { found, expected });
            return Err(VtkError::Inconsistent { section: "PointData", name, problem });
        }
    }
    write(out, image, options).map_err(VtkError::Write)
}

fn write(out: impl Write, image: &ImageGrid, options: WriteOptions) -> io::Result<()> {
    let mut xml = XmlWriter::begin(out, "ImageData", options)?;
    let extent = image.counts.map(|count| format!("0 {}", count.saturating_sub(1))).join(" ");
    let three = |numbers: [f64; 3]| numbers.map(|x| x.to_string()).join(" ");
    let (origin, spacing) = (three(image.origin), three(image.spacing));
    let head = [("WholeExtent", &extent[..]), ("Origin", &origin), ("Spacing", &spacing)];
    xml.open("ImageData", &head)?;
    write_field(&mut xml, &image.field_data, options)?;
    xml.open("Piece", &[("Extent", &extent)])?;
    write_attributes(&mut xml, "PointData", &image.point_data, options)?;
    xml.close("Piece")?;
    xml.close("ImageData")?;
    xml.finish()?.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::{DataArray, Encoding};

    fn image() -> ImageGrid {
        ImageGrid {
            origin: [1.0, 2.0, 0.0],
            spacing: [0.5, 1.0, 1.0],
            counts: [3, 2, 1],
            point_data: Attributes::new(),
            field_data: Attributes::new(),
        }
    }

    #[test]
    fn points_run_along_x_first() {
        let points: Vec<[f64; 3]> = image().points().collect();
        assert_eq!(points[..2], [[1.0, 2.0, 0.0], [1.5, 2.0, 0.0]]);
        assert_eq!(points[3..5], [[1.0, 3.0, 0.0], [1.5, 3.0, 0.0]]);
        assert_eq!(points.len(), 6);
    }

    #[test]
    fn the_file_says_where_the_points_are() {
        let mut image = image();
        image.point_data.push(DataArray::new("u", 1, vec![0.0; 6]));
        let mut bytes = Vec::new();
        write_vti_to(&mut bytes, &image, Encoding::Ascii.into()).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let head = "<ImageData WholeExtent=\"0 2 0 1 0 0\" Origin=\"1 2 0\" Spacing=\"0.5 1 1\">";
        assert!(text.contains(head) && text.contains("<Piece Extent=\"0 2 0 1 0 0\">"), "{text}");
    }

    #[test]
    fn data_of_another_length_are_refused() {
        let mut image = image();
        image.point_data.push(DataArray::new("u", 1, vec![0.0; 5]));
        let refused = write_vti_to(Vec::new(), &image, WriteOptions::default());
        assert!(matches!(refused, Err(VtkError::Inconsistent { .. })));
    }
}
