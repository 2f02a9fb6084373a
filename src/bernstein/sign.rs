//! The side of a level on which a value lies.

use std::ops::Not;

/// The side of a level on which a value lies.
///
/// A value *on* the level counts as above it. This is VTK's convention, and it
/// makes every contour the border of the region `u >= level`: a border never
/// branches, so the crossings around any triangle come in pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sign {
    /// Value below the level.
    Below,
    /// Value above the level, or on it.
    Above,
}

impl Sign {
    /// The side of `value` relative to the level zero.
    pub fn of(value: f64) -> Self {
        if value < 0.0 { Sign::Below } else { Sign::Above }
    }
}

impl Not for Sign {
    type Output = Sign;

    fn not(self) -> Sign {
        match self {
            Sign::Below => Sign::Above,
            Sign::Above => Sign::Below,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_the_level_counts_as_above() {
        assert_eq!(
            [-1.0, -0.0, 0.0, 1.0].map(Sign::of),
            [Sign::Below, Sign::Above, Sign::Above, Sign::Above]
        );
        assert_eq!(!Sign::Above, Sign::Below);
    }
}
