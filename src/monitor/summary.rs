//! What a monitor says of the mesh as a whole.

/// What a monitor says of the mesh as a whole, as far as it could be computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// The sum over the cells.
    pub sum: f64,
    /// The mean over the cells; zero if there are none.
    pub average: f64,
    /// The greatest; zero if there are none.
    pub maximum: f64,
    /// Cells for which it is NaN.
    pub not_computed: usize,
}

impl Summary {
    /// That of one number a cell.
    pub fn new(values: &[f64]) -> Self {
        let computed = || values.iter().copied().filter(|value| !value.is_nan());
        let (sum, count) = (computed().sum(), computed().count());
        Self {
            sum,
            average: if count == 0 { 0.0 } else { sum / count as f64 },
            maximum: computed().fold(0.0, f64::max),
            not_computed: values.len() - count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_counted_and_left_out() {
        let summary = Summary::new(&[1.0, f64::NAN, 3.0]);
        let expected = Summary { sum: 4.0, average: 2.0, maximum: 3.0, not_computed: 1 };
        assert_eq!(summary, expected);
        assert_eq!(Summary::new(&[]), Summary::default());
    }
}
