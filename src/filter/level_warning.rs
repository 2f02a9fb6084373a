//! Levels that have no contour.

/// What people should know about levels, of all grids that were contoured at them: that some are
/// outside the range of the values and have no contour, or that there are none. The range is that of
/// the values of all grids.
///
/// Levels that `is_drawn` says have a contour are not told: the cubics go a little beyond the values,
/// and a level beside a wall's value, by rounding, has the wall for its contour.
pub fn level_warning(
    label: &str,
    [low, high]: [f64; 2],
    levels: &[f64],
    is_drawn: impl Fn(usize) -> bool,
) -> Option<String> {
    if levels.is_empty() {
        let constant =
            format!("'{label}' is {low:?} at all points: there is no level inside its range");
        return Some(if low < high { "no levels were given".to_owned() } else { constant });
    }
    let is_outside =
        |&(place, &level): &(usize, &f64)| (level < low || level > high) && !is_drawn(place);
    let outside: Vec<f64> =
        levels.iter().enumerate().filter(is_outside).map(|(_, &level)| level).collect();
    (!outside.is_empty()).then(|| {
        let outside = list(&outside);
        format!("no contour at {outside}: outside the range {low:?} to {high:?} of '{label}'")
    })
}

/// Levels in a list that stays short.
fn list(levels: &[f64]) -> String {
    const SHOWN: usize = 5;
    let shown: Vec<String> = levels.iter().take(SHOWN).map(|level| format!("{level:?}")).collect();
    match levels.len().checked_sub(SHOWN) {
        Some(more) if more > 0 => format!("{} and {more} more levels", shown.join(", ")),
        _ => shown.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_outside_and_none_at_all_are_told() {
        assert_eq!(level_warning("u", [0.0, 1.0], &[0.0, 0.5, 1.0], |_| false), None);
        let text = level_warning("u", [0.0, 1.0], &[-1.0, 0.5, 2.0], |_| false).unwrap();
        assert_eq!(text, "no contour at -1.0, 2.0: outside the range 0.0 to 1.0 of 'u'");
        let constant = level_warning("u", [3.0, 3.0], &[], |_| false).unwrap();
        assert_eq!(level_warning("u", [0.0, 1.0], &[], |_| false).unwrap(), "no levels were given");
        assert_eq!(level_warning("u", [0.0, 1.0], &[-1e-9], |_| true), None);
        assert!(constant.starts_with("'u' is 3.0 at all points"), "{constant}");
    }
}
