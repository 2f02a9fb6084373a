//! Arrays carried from the grid to the contour.

use rayon::prelude::*;

use crate::vtk::{AttributeKind, Attributes, DataArray, Values};

/// A point of the output as a weighted mean of points of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stencil {
    /// The points.
    pub points: [u32; 4],
    /// Their weights, which sum to one.
    pub weights: [f64; 4],
}

/// Applies an expression to the vector of numbers inside `Values`, and wraps the
/// result as the same type.
macro_rules! map_numbers {
    ($values:expr, $numbers:ident => $result:expr, text: $texts:ident => $text:expr) => {
        match $values {
            Values::I8($numbers) => Values::I8($result),
            Values::U8($numbers) => Values::U8($result),
            Values::I16($numbers) => Values::I16($result),
            Values::U16($numbers) => Values::U16($result),
            Values::I32($numbers) => Values::I32($result),
            Values::U32($numbers) => Values::U32($result),
            Values::I64($numbers) => Values::I64($result),
            Values::U64($numbers) => Values::U64($result),
            Values::F32($numbers) => Values::F32($result),
            Values::F64($numbers) => Values::F64($result),
            Values::Strings($texts) => $text,
        }
    };
}

/// Every array of `data` interpolated linearly at the stencils, each of its own
/// type; integers are rounded to the nearest.
///
/// Left out are text, and the numbers that VTK gives to points: a mean of them is
/// no number of a point.
pub fn interpolate(data: &Attributes, stencils: &[Stencil]) -> Attributes {
    let mut output = Attributes::new();
    for array in data.iter().filter(|array| !is_identity(data, array)) {
        if let Some(values) = interpolate_values(array, stencils) {
            output.push(DataArray { values, ..like(array) });
        }
    }
    keep_roles(data, &mut output);
    output
}

/// Every array of `data` at the given tuples, as it is; without VTK's numbers.
pub fn pick(data: &Attributes, tuples: &[u32]) -> Attributes {
    let mut output = Attributes::new();
    for array in data.iter().filter(|array| !is_identity(data, array)) {
        let values = pick_values(array, tuples);
        output.push(DataArray { values, ..like(array) });
    }
    keep_roles(data, &mut output);
    output
}

/// An array with a component of some tuples replaced by numbers; integers are rounded to the
/// nearest. Text stays as it is.
pub fn overwrite(array: &DataArray, component: usize, numbers: &[(u32, f64)]) -> DataArray {
    let components = array.components;
    let values = map_numbers!(
        &array.values,
        values => overwritten(values, components, component, numbers),
        text: texts => Values::Strings(texts.clone())
    );
    DataArray { values, ..like(array) }
}

fn overwritten<T: Number>(
    values: &[T],
    components: usize,
    component: usize,
    numbers: &[(u32, f64)],
) -> Vec<T> {
    let mut values = values.to_vec();
    for &(tuple, number) in numbers {
        values[tuple as usize * components + component] = T::nearest(number);
    }
    values
}

/// Whether an array numbers points or cells of the whole.
fn is_identity(data: &Attributes, array: &DataArray) -> bool {
    let has_role = |kind| data.active(kind).is_some_and(|active| active.name == array.name);
    has_role(AttributeKind::GlobalIds)
        || has_role(AttributeKind::PedigreeIds)
        || array.name == "vtkGhostType"
}

/// An array's name, components and their names, without its values.
fn like(array: &DataArray) -> DataArray {
    DataArray {
        name: array.name.clone(),
        components: array.components,
        component_names: array.component_names.clone(),
        values: Values::F64(Vec::new()),
    }
}

fn keep_roles(from: &Attributes, to: &mut Attributes) {
    for (kind, name) in from.active_names() {
        to.set_active(*kind, name);
    }
}

fn interpolate_values(array: &DataArray, stencils: &[Stencil]) -> Option<Values> {
    let components = array.components;
    let numbers = map_numbers!(
        &array.values,
        numbers => mean(numbers, components, stencils),
        text: _texts => return None
    );
    Some(numbers)
}

/// A number that a mean can be rounded to.
trait Number: Copy + Send + Sync {
    fn to_f64(self) -> f64;
    fn nearest(value: f64) -> Self;
}

macro_rules! numbers {
    ($round:expr => $($number:ty)*) => {
        $(impl Number for $number {
            fn to_f64(self) -> f64 {
                self as f64
            }

            fn nearest(value: f64) -> Self {
                let round: fn(f64) -> f64 = $round;
                round(value) as $number
            }
        })*
    };
}
numbers!(f64::round => i8 u8 i16 u16 i32 u32 i64 u64);
numbers!(|value| value => f32 f64);

fn mean<T: Number>(numbers: &[T], components: usize, stencils: &[Stencil]) -> Vec<T> {
    stencils
        .par_iter()
        .flat_map_iter(|stencil| {
            (0..components).map(move |component| {
                let term = |(&point, &weight): (&u32, &f64)| {
                    // a point without weight has no say, not even as NaN
                    let number = || numbers[point as usize * components + component].to_f64();
                    if weight == 0.0 { 0.0 } else { weight * number() }
                };
                T::nearest(stencil.points.iter().zip(&stencil.weights).map(term).sum())
            })
        })
        .collect()
}

fn pick_values(array: &DataArray, tuples: &[u32]) -> Values {
    let components = array.components;
    map_numbers!(
        &array.values,
        numbers => chosen(numbers, components, tuples),
        text: texts => Values::Strings(chosen(texts, components, tuples))
    )
}

fn chosen<T: Clone>(values: &[T], components: usize, tuples: &[u32]) -> Vec<T> {
    let tuple = |&tuple: &u32| {
        let start = tuple as usize * components;
        values[start..start + components].iter().cloned()
    };
    tuples.iter().flat_map(tuple).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn data() -> Attributes {
        let mut data: Attributes = [
            DataArray::new("float", 1, vec![0.0_f32, 1.0, 2.0]),
            DataArray::new("integer", 1, vec![0_i32, 10, 21]),
            DataArray::new("vector", 2, vec![0.0_f64, 1.0, 2.0, 3.0, f64::NAN, 5.0]),
            DataArray::new("ids", 1, vec![7_i64, 8, 9]),
            DataArray::new("text", 1, ["a", "b", "c"].map(String::from).to_vec()),
        ]
        .into_iter()
        .collect();
        data.set_active(AttributeKind::GlobalIds, "ids");
        data.set_active(AttributeKind::Scalars, "float");
        data
    }

    #[test]
    fn means_keep_their_type() {
        let stencils = [
            Stencil { points: [0, 1, 2, 2], weights: [0.5, 0.5, 0.0, 0.0] },
            Stencil { points: [0, 1, 2, 2], weights: [0.0, 0.5, 0.25, 0.25] },
        ];
        let output = interpolate(&data(), &stencils);
        assert_eq!(output.get("float").unwrap().values, Values::F32(vec![0.5, 1.5]));
        assert_eq!(output.get("integer").unwrap().values, Values::I32(vec![5, 16]));
        assert!(output.get("ids").is_none() && output.get("text").is_none());
        let Values::F64(vector) = &output.get("vector").unwrap().values else { panic!("type") };
        // the NaN of a point without weight does not spread
        assert_eq!(vector[..2], [1.0, 2.0]);
        assert!(vector[2].is_nan());
        assert_eq!(output.active(AttributeKind::Scalars).unwrap().name, "float");
    }

    #[test]
    fn picked_tuples_are_as_they_were() {
        let output = pick(&data(), &[2, 0]);
        assert_eq!(output.get("integer").unwrap().values, Values::I32(vec![21, 0]));
        let text = ["c", "a"].map(String::from).to_vec();
        assert_eq!(output.get("text").unwrap().values, Values::Strings(text));
        assert!(output.get("ids").is_none());
    }
}
