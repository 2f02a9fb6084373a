//! Which levels to draw.

use thiserror::Error;

/// The levels to draw.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// These levels.
    Explicit(Vec<f64>),
    /// So many levels, equally spaced strictly inside a range: of the solution,
    /// or as given.
    Equal {
        /// How many.
        count: usize,
        /// The range to divide; the solution's own if not given.
        range: Option<[f64; 2]>,
    },
}

/// Why levels cannot be drawn.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LevelError {
    /// A level is infinite or not a number.
    #[error("level {0} is not a finite number")]
    NotFinite(f64),
    /// A range is empty or not finite.
    #[error("the range {low},{high} is empty: give LO,HI with LO < HI")]
    EmptyRange {
        /// The lower end given.
        low: f64,
        /// The upper end given.
        high: f64,
    },
}

impl Levels {
    /// The levels as numbers, ascending and without repeats, if the solution's own range has no say
    /// in them.
    ///
    /// # Errors
    /// If a level is not finite, or the range given is empty.
    pub fn known(&self) -> Result<Option<Vec<f64>>, LevelError> {
        match self {
            Levels::Equal { range: None, .. } => Ok(None),
            _ => self.resolve([0.0, 0.0]).map(Some),
        }
    }

    /// The levels as numbers, ascending and without repeats. `attained` is the
    /// solution's own range. A constant solution has no level inside its range.
    ///
    /// # Errors
    /// If a level is not finite, or the range given is empty.
    pub fn resolve(&self, attained: [f64; 2]) -> Result<Vec<f64>, LevelError> {
        match self {
            Levels::Explicit(levels) => sorted(levels.clone()),
            Levels::Equal { range: None, .. } if attained[0] >= attained[1] => Ok(Vec::new()),
            Levels::Equal { count, range } => divide(*count, range.unwrap_or(attained)),
        }
    }
}

fn divide(count: usize, [low, high]: [f64; 2]) -> Result<Vec<f64>, LevelError> {
    if !(low < high && low.is_finite() && high.is_finite()) {
        return Err(LevelError::EmptyRange { low, high });
    }
    let part = |n: usize| {
        let t = n as f64 / (count + 1) as f64;
        (1.0 - t) * low + t * high
    };
    sorted((1..=count).map(part).collect())
}

fn sorted(mut levels: Vec<f64>) -> Result<Vec<f64>, LevelError> {
    if let Some(&level) = levels.iter().find(|level| !level.is_finite()) {
        return Err(LevelError::NotFinite(level));
    }
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    Ok(levels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_divide_the_range_without_its_ends() {
        let levels = Levels::Equal { count: 3, range: None };
        assert_eq!(levels.resolve([0.0, 4.0]), Ok(vec![1.0, 2.0, 3.0]));
        assert_eq!(levels.known(), Ok(None));
        let levels = Levels::Equal { count: 1, range: Some([0.0, 1.0]) };
        assert_eq!(levels.resolve([5.0, 9.0]), Ok(vec![0.5]));
        assert_eq!(levels.known(), Ok(Some(vec![0.5])));
    }

    #[test]
    fn explicit_levels_are_sorted_and_single() {
        let levels = Levels::Explicit(vec![2.0, 1.0, 2.0]);
        assert_eq!(levels.resolve([0.0, 1.0]), Ok(vec![1.0, 2.0]));
    }

    #[test]
    fn a_constant_solution_has_no_levels() {
        let levels = Levels::Equal { count: 10, range: None };
        assert_eq!(levels.resolve([1.0, 1.0]), Ok(vec![]));
    }

    #[test]
    fn errors() {
        let infinite = Levels::Explicit(vec![f64::INFINITY]);
        assert_eq!(infinite.resolve([0.0, 1.0]), Err(LevelError::NotFinite(f64::INFINITY)));
        let backwards = Levels::Equal { count: 2, range: Some([1.0, 0.0]) };
        assert!(backwards.resolve([0.0, 1.0]).is_err());
    }
}
