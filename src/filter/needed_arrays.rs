//! Which arrays of a file contouring reads.

use super::cells::GHOSTS;
use super::gradient_arrays::plain;
use super::gradients::GradientSource;
use super::options::ContourOptions;
use crate::vtk::{ArrayInfo, AttributeKind, Description, Selection};

/// The arrays that decide what the contours are, so that the others need not be decoded
/// where none are to travel along. In doubt an array is needed: errors that list arrays
/// list all of them.
pub fn needed_arrays(options: &ContourOptions, file: &Description) -> Selection {
    let named = |wanted: &String| file.point_arrays.iter().any(|array| array.name == *wanted);
    let active = file.point_arrays.iter().find(|array| is(array, AttributeKind::Scalars));
    let chosen = options.array.as_ref().or(active.map(|array| &array.name));
    let gradient: Vec<String> = match &options.gradient {
        GradientSource::Array(name) if options.interpolant.uses_gradients() => {
            if named(name) {
                vec![name.clone()]
            } else {
                parts(name)
            }
        }
        _ => Vec::new(),
    };
    let may_be_gradient = |array: &ArrayInfo| {
        let automatic = options.gradient == GradientSource::Automatic;
        let component = chosen.is_some_and(|name| plain(&array.name).contains(&plain(name)));
        let is_candidate = array.components > 1 || component;
        automatic && options.interpolant.uses_gradients() && is_candidate
    };
    let is_needed = |array: &&ArrayInfo| {
        chosen == Some(&array.name)
            || gradient.contains(&array.name)
            || may_be_gradient(array)
            || options.pde.is_some() && array.components == 1
            || is(array, AttributeKind::RationalWeights)
    };
    let is_known = chosen.is_some_and(named) && gradient.iter().all(named);
    let points = file.point_arrays.iter().filter(|array| !is_known || is_needed(array));
    let shapes_cells =
        |array: &&ArrayInfo| array.name == GHOSTS || is(array, AttributeKind::HigherOrderDegrees);
    let cells = file.cell_arrays.iter().filter(|array| !is_known || shapes_cells(array));
    let names = |array: &ArrayInfo| array.name.clone();
    Selection::AtMost { points: points.map(names).collect(), cells: cells.map(names).collect() }
}

/// The arrays that decide where cells are, whatever is contoured.
pub fn arrays_of_cells(file: &Description) -> Selection {
    let with_role = |arrays: &[ArrayInfo], role| -> Vec<String> {
        let found = arrays.iter().filter(|array| is(array, role));
        found.map(|array| array.name.clone()).collect()
    };
    Selection::AtMost {
        points: with_role(&file.point_arrays, AttributeKind::RationalWeights),
        cells: with_role(&file.cell_arrays, AttributeKind::HigherOrderDegrees),
    }
}

/// The names between the commas of one such as `ux,uy`.
fn parts(name: &str) -> Vec<String> {
    name.split(',').map(|part| part.trim().to_owned()).collect()
}

fn is(array: &ArrayInfo, role: AttributeKind) -> bool {
    array.active.contains(&role)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::InterpolantKind;
    use crate::vtk::ArrayType;

    fn info(name: &str, components: usize, active: &[AttributeKind]) -> ArrayInfo {
        ArrayInfo {
            name: name.to_owned(),
            array_type: ArrayType::F64,
            components,
            component_names: Vec::new(),
            active: active.to_vec(),
        }
    }

    /// The names of the arrays that are read of a file with `u v grad w` at its points.
    fn needed(options: &ContourOptions) -> String {
        let file = Description {
            version: String::new(),
            pieces: Vec::new(),
            point_arrays: vec![
                info("u", 1, &[AttributeKind::Scalars]),
                info("v", 1, &[]),
                info("grad", 3, &[]),
                info("w", 1, &[AttributeKind::RationalWeights]),
            ],
            cell_arrays: vec![
                info("c", 1, &[]),
                info("vtkGhostType", 1, &[]),
                info("d", 3, &[AttributeKind::HigherOrderDegrees]),
            ],
            field_arrays: Vec::new(),
            warnings: Vec::new(),
        };
        match needed_arrays(options, &file) {
            Selection::AtMost { points, cells } => [points, cells].concat().join(" "),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn only_what_the_options_use_is_read() {
        let options = |array: Option<&str>, gradient: GradientSource| ContourOptions {
            array: array.map(str::to_owned),
            gradient,
            ..ContourOptions::default()
        };
        let recovered = || GradientSource::Recovered;
        let array = |name: &str| GradientSource::Array(name.to_owned());
        let cells = "vtkGhostType d";
        assert_eq!(needed(&ContourOptions::default()), format!("u grad w {cells}"));
        assert_eq!(needed(&options(Some("v"), recovered())), format!("v w {cells}"));
        assert_eq!(needed(&options(None, array("v"))), format!("u v w {cells}"));
        let linear = InterpolantKind::Linear;
        let linear = ContourOptions { interpolant: linear, ..options(None, array("grad")) };
        assert_eq!(needed(&linear), format!("u w {cells}"));
        let pde = Some("uxx = v".to_owned());
        let pde = ContourOptions { pde, ..options(None, recovered()) };
        assert_eq!(needed(&pde), format!("u v w {cells}"));
    }

    #[test]
    fn what_is_not_there_is_looked_for_everywhere() {
        let all = "u v grad w c vtkGhostType d";
        let array = Some("c".to_owned());
        assert_eq!(needed(&ContourOptions { array, ..ContourOptions::default() }), all);
        let gradient = GradientSource::Array("none".to_owned());
        assert_eq!(needed(&ContourOptions { gradient, ..ContourOptions::default() }), all);
    }
}
