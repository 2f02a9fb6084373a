//! Colours for values.

use std::fmt;

/// A colour: red, green and blue from 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Colour([red, green, blue]) = self;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}

/// Colours of the map *viridis* at equal steps. Its brightness rises evenly, for
/// readers with any colour vision and on grey paper too.
///
/// Source: S. van der Walt, N. Smith, matplotlib 2.0 (released under CC0).
const VIRIDIS: [[u8; 3]; 10] = [
    [68, 1, 84],
    [72, 40, 120],
    [62, 73, 137],
    [49, 104, 142],
    [38, 130, 142],
    [31, 158, 137],
    [53, 183, 121],
    [110, 206, 88],
    [181, 222, 43],
    [253, 231, 37],
];

/// The bright end of the map, its yellows, cannot be seen as a line on white.
const BRIGHTEST: f64 = 0.88;

/// The colour at `t`, from 0 (dark) to 1 (bright).
pub fn viridis(t: f64) -> Colour {
    let steps = (VIRIDIS.len() - 1) as f64;
    let place = t.clamp(0.0, 1.0) * BRIGHTEST * steps;
    let step = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let part = place - step as f64;
    let mix = |channel: usize| {
        let (from, to) = (VIRIDIS[step][channel], VIRIDIS[step + 1][channel]);
        (f64::from(from) + part * (f64::from(to) - f64::from(from))).round() as u8
    };
    Colour([mix(0), mix(1), mix(2)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_rises() {
        let brightness = |t: f64| {
            let Colour([red, green, blue]) = viridis(t);
            0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
        };
        let values: Vec<f64> = (0..=20).map(|n| brightness(f64::from(n) / 20.0)).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(viridis(0.0).to_string(), "#440154");
    }
}
