//! What people should know of cubics that go far beyond the values they are made of.

use super::gradients::GradientOrigin;

/// The cubics may exceed the values at the points by this part of their range before people
/// are told: between points a solution does that by a few hundredths, on coarse meshes by a
/// few tenths.
const BEYOND: f64 = 0.5;

/// Whether gradients were recovered and the range of the cubics made of them goes far beyond that of
/// the values.
pub fn goes_far_beyond(origin: &GradientOrigin, [low, high]: [f64; 2], range: [f64; 2]) -> bool {
    let beyond = (low - range[0]).max(range[1] - high);
    *origin == GradientOrigin::Recovered
        && beyond > BEYOND * (high - low)
        && beyond > f64::EPSILON * low.abs().max(high.abs())
}

/// A line if gradients were recovered and the range of the cubics made of them goes far
/// beyond that of the values.
pub fn range_warning(
    label: &str,
    origin: &GradientOrigin,
    values: [f64; 2],
    range: [f64; 2],
) -> Option<String> {
    let [low, high] = values;
    goes_far_beyond(origin, values, range).then(|| {
        format!(
            "the cubics of '{label}' reach from {:.4} to {:.4}, its values only from {low:.4} to \
             {high:.4}: the mesh is too coarse to recover gradients; give a gradient array \
             (--gradient), or use --interpolant linear",
            range[0], range[1]
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_recovered_gradients_that_go_far_are_told() {
        let told = |origin, range| range_warning("u", &origin, [0.0, 2.0], range);
        let text = told(GradientOrigin::Recovered, [-1.1, 2.0]).unwrap();
        assert!(text.contains("from -1.1000 to 2.0000") && text.contains("--interpolant linear"));
        assert!(told(GradientOrigin::Recovered, [0.0, 3.1]).is_some());
        assert_eq!(told(GradientOrigin::Recovered, [-0.9, 2.9]), None);
        assert_eq!(told(GradientOrigin::Array("g".to_owned()), [-9.0, 9.0]), None);
    }

    #[test]
    fn rounding_of_a_constant_is_no_range() {
        for range in [[1.0, 1.0], [1.0, 1.0 + f64::EPSILON]] {
            assert_eq!(range_warning("u", &GradientOrigin::Recovered, [1.0, 1.0], range), None);
        }
    }
}
