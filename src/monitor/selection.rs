//! Which cells are to be refined.

use thiserror::Error;

use super::Summary;

/// Which cells are to be refined, by a monitor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Selection {
    /// Those above so many times the average: the thesis' choice, with two.
    AboveAverage(f64),
    /// This part of the cells, those with the greatest numbers.
    Fraction(f64),
    /// The fewest cells that have this part of the sum of all (W. Dörfler, 1996). Of an error
    /// that is a root of a sum of squares, give the squares.
    Bulk(f64),
    /// Those above this number.
    Above(f64),
}

/// A selection that means nothing.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum SelectionError {
    /// Parts are above zero, and one at most.
    #[error("a part of the cells is above 0, and 1 at most, not {0:?}")]
    Part(f64),
    /// Factors and tolerances are not below zero.
    #[error("what cells are compared with is 0 or above it, not {0:?}")]
    Negative(f64),
}

impl Default for Selection {
    fn default() -> Self {
        Self::AboveAverage(2.0)
    }
}

/// Numbers closer than this part of them are the same: those of mirrored cells differ by
/// rounding, and symmetric meshes stay symmetric only if both are selected, or none.
const SAME: f64 = 1e-9;

impl Selection {
    /// The cells to be refined, those with the greatest numbers first, of equal numbers the
    /// lower cell: whoever has no room for all takes the first. Cells whose number is NaN are
    /// never among them; cells that rounding alone tells from the last selected one are.
    ///
    /// # Errors
    /// If a part is not above 0 and up to 1, or another number is below 0 or NaN.
    pub fn select(self, values: &[f64]) -> Result<Vec<u32>, SelectionError> {
        self.check()?;
        let mut order: Vec<u32> = (0..values.len() as u32).collect();
        order.retain(|&cell| !values[cell as usize].is_nan());
        let number = |cell: &u32| values[*cell as usize];
        order.sort_by(|a, b| number(b).total_cmp(&number(a)).then(a.cmp(b)));
        let summary = Summary::new(values);
        let above = |limit: f64| order.partition_point(|cell| number(cell) > limit + SAME * limit);
        let count = match self {
            Self::AboveAverage(factor) => above(factor * summary.average),
            Self::Above(limit) => above(limit),
            Self::Fraction(part) => {
                with_equals(&order, number, (part * order.len() as f64).ceil() as usize)
            }
            Self::Bulk(part) => {
                let mut sum = 0.0;
                let wanted = part * summary.sum * (1.0 - SAME);
                let is_open = |cell: &&u32| {
                    let is_open = sum < wanted;
                    sum += number(cell);
                    is_open
                };
                with_equals(&order, number, order.iter().take_while(is_open).count())
            }
        };
        order.truncate(count);
        Ok(order)
    }

    /// As [`Selection::select`], but where no cell is above so many times the average, those
    /// above the average, and if all are the same, all of them, unless all are zero: for whoever
    /// wants a number of cells, and not that all are alike.
    ///
    /// # Errors
    /// As [`Selection::select`].
    pub fn select_some(self, values: &[f64]) -> Result<Vec<u32>, SelectionError> {
        let selected = self.select(values)?;
        match self {
            Self::AboveAverage(_) if selected.is_empty() => {
                let above = Self::AboveAverage(1.0).select(values)?;
                if above.is_empty() { Self::Above(0.0).select(values) } else { Ok(above) }
            }
            _ => Ok(selected),
        }
    }

    fn check(self) -> Result<(), SelectionError> {
        match self {
            Self::Fraction(part) | Self::Bulk(part) if !(part > 0.0 && part <= 1.0) => {
                Err(SelectionError::Part(part))
            }
            Self::AboveAverage(number) | Self::Above(number) if number.is_nan() || number < 0.0 => {
                Err(SelectionError::Negative(number))
            }
            _ => Ok(()),
        }
    }
}

/// So many cells, and those whose numbers are the same as the last one's.
fn with_equals(order: &[u32], number: impl Fn(&u32) -> f64, count: usize) -> usize {
    let Some(last) = count.checked_sub(1).and_then(|last| order.get(last)) else { return 0 };
    let least = number(last) * (1.0 - SAME);
    count + order[count..].iter().take_while(|cell| number(cell) >= least && least > 0.0).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const VALUES: [f64; 6] = [1.0, 8.0, f64::NAN, 2.0, 4.0, 4.0];

    fn select(selection: Selection) -> Vec<u32> {
        selection.select(&VALUES).unwrap()
    }

    #[test]
    fn by_hand() {
        // the average is 3.8
        assert_eq!(select(Selection::default()), [1]);
        assert_eq!(select(Selection::AboveAverage(1.0)), [1, 4, 5]);
        assert_eq!(select(Selection::Above(3.0)), [1, 4, 5]);
        assert_eq!(select(Selection::Above(4.0)), [1]);
        assert_eq!(select(Selection::Above(0.0)), [1, 4, 5, 3, 0]);
        // 8 of 19, then 12: the second of the two equal ones comes along
        assert_eq!(select(Selection::Bulk(0.4)), [1]);
        assert_eq!(select(Selection::Bulk(0.5)), [1, 4, 5]);
        assert_eq!(select(Selection::Bulk(1.0)), [1, 4, 5, 3, 0]);
        assert_eq!(select(Selection::Fraction(0.2)), [1]);
        assert_eq!(select(Selection::Fraction(0.4)), [1, 4, 5]);
        assert_eq!(select(Selection::Fraction(1.0)), [1, 4, 5, 3, 0]);
    }

    #[test]
    fn equal_cells_are_selected_together() {
        let uniform = [1.0, 1.0 + 1e-15, 1.0 - 1e-15];
        // none is above the average, whatever rounding says
        assert!(Selection::AboveAverage(1.0).select(&uniform).unwrap().is_empty());
        assert_eq!(Selection::Fraction(0.1).select(&uniform).unwrap().len(), 3);
        // where there is no need, there is none to share
        assert!(Selection::Bulk(0.5).select(&[0.0; 3]).unwrap().is_empty());
    }

    #[test]
    fn something_is_selected_while_there_is_any() {
        let some = |values: &[f64]| Selection::AboveAverage(2.0).select_some(values).unwrap();
        assert_eq!(some(&VALUES), [1]);
        assert_eq!(some(&[1.0, 2.0, f64::NAN]), [1]);
        assert_eq!(some(&[3.0, 3.0, 3.0]), [0, 1, 2]);
        assert!(some(&[0.0, 0.0]).is_empty() && some(&[f64::NAN]).is_empty());
        // a tolerance that is met is met
        assert!(Selection::Above(5.0).select_some(&[3.0]).unwrap().is_empty());
    }

    #[test]
    fn nonsense_is_refused() {
        let refused = |selection: Selection| selection.select(&VALUES).unwrap_err();
        assert_eq!(refused(Selection::Fraction(0.0)), SelectionError::Part(0.0));
        assert_eq!(refused(Selection::Bulk(1.5)), SelectionError::Part(1.5));
        assert_eq!(refused(Selection::Above(-1.0)), SelectionError::Negative(-1.0));
        assert!(matches!(refused(Selection::AboveAverage(f64::NAN)), SelectionError::Negative(_)));
    }

    proptest! {
        #[test]
        fn bulk_is_enough_and_no_more(values in prop::collection::vec(0.0..1.0f64, 1..60), part in 0.05..1.0f64) {
            let selected = Selection::Bulk(part).select(&values).unwrap();
            let sum = |cells: &[u32]| cells.iter().map(|&cell| values[cell as usize]).sum::<f64>();
            let all: f64 = values.iter().sum();
            prop_assert!(sum(&selected) >= part * all * (1.0 - 1e-8));
            // without the last it is not enough
            if let Some((_, fewer)) = selected.split_last() {
                prop_assert!(sum(fewer) < part * all);
            }
            for pair in selected.windows(2) {
                prop_assert!(values[pair[0] as usize] >= values[pair[1] as usize]);
            }
        }
    }
}
