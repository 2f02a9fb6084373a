//! A named array of tuples.

use super::array_type::ArrayType;
use super::values::Values;

/// A named array of tuples, as VTK's `vtkDataArray` or `vtkStringArray`.
#[derive(Clone, Debug, PartialEq)]
pub struct DataArray {
    /// The name; may hold any character and may be empty.
    pub name: String,
    /// Values per tuple, at least 1.
    pub components: usize,
    /// Names of the components, in order; an empty text is a component without one.
    /// Shorter than `components`, or empty, where the rest have no name.
    pub component_names: Vec<String>,
    /// The values, tuple after tuple: `components` times [`tuples`](Self::tuples) of them.
    pub values: Values,
}

impl DataArray {
    /// An array without component names. `components` 0 is taken as 1.
    pub fn new(name: impl Into<String>, components: usize, values: impl Into<Values>) -> Self {
        Self {
            name: name.into(),
            components: components.max(1),
            component_names: Vec::new(),
            values: values.into(),
        }
    }

    /// The number of whole tuples.
    pub fn tuples(&self) -> usize {
        self.values.len() / self.components.max(1)
    }

    /// The type of the values.
    pub fn array_type(&self) -> ArrayType {
        self.values.array_type()
    }

    /// Every value as `f64`, tuple after tuple; `None` for strings.
    pub fn to_f64(&self) -> Option<Vec<f64>> {
        self.values.to_f64()
    }

    /// Component `index` (from 0) of every tuple as `f64`; `None` for strings and for a
    /// component the array does not have.
    pub fn component(&self, index: usize) -> Option<Vec<f64>> {
        if index >= self.components {
            return None;
        }
        self.values.convert(index, self.components)
    }

    /// The Euclidean length of every tuple; `None` for strings.
    pub fn magnitude(&self) -> Option<Vec<f64>> {
        let values = self.to_f64()?;
        let tuples = values.chunks_exact(self.components.max(1));
        let length = |tuple: &[f64]| tuple.iter().map(|v| v * v).sum::<f64>().sqrt();
        Some(tuples.map(length).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_and_magnitude() {
        let array = DataArray::new("v", 2, vec![3.0f32, 4.0, 6.0, 8.0]);
        assert_eq!(array.tuples(), 2);
        assert_eq!(array.component(1), Some(vec![4.0, 8.0]));
        assert_eq!(array.component(2), None);
        assert_eq!(array.magnitude(), Some(vec![5.0, 10.0]));
    }

    #[test]
    fn zero_components_are_one() {
        assert_eq!(DataArray::new("s", 0, vec![1i8, 2]).tuples(), 2);
    }

    #[test]
    fn strings_have_no_numbers() {
        let array = DataArray::new("s", 1, vec![String::from("x")]);
        assert_eq!((array.tuples(), array.component(0)), (1, None));
        assert_eq!(array.magnitude(), None);
    }
}
