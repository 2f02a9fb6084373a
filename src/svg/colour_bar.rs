//! The colour bar beside a picture.

use std::fmt::Write;

use super::colour_map::viridis;

/// Where the bar stands.
pub struct Place {
    /// Left edge.
    pub x: f64,
    /// Top edge.
    pub y: f64,
    /// Height.
    pub height: f64,
}

const WIDTH: f64 = 14.0;

/// Labels are at least this far apart.
const LABEL_DISTANCE: f64 = 15.0;

/// The bar for ascending values: its ends are the first and the last of them, and
/// each has a tick.
pub fn colour_bar(values: &[f64], place: &Place) -> String {
    let mut bar = String::new();
    let (Some(&low), Some(&high)) = (values.first(), values.last()) else { return bar };
    let Place { x, y, height } = place;
    // writing to a string cannot fail
    let _ = write!(bar, "<g class=\"bar\">{}", gradient());
    let _ = write!(
        bar,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{height}\" fill=\"url(#map)\"/>"
    );
    let mut last_label = f64::INFINITY;
    for &value in values {
        let at = y + height * (1.0 - fraction(value, low, high));
        let (from, to) = (x + WIDTH, x + WIDTH + 4.0);
        let _ = write!(bar, "<path d=\"M{from} {at:.2}H{to}\" stroke=\"#333\"/>");
        if last_label - at >= LABEL_DISTANCE {
            let label = number(value);
            let _ = write!(bar, "<text x=\"{}\" y=\"{:.2}\">{label}</text>", to + 3.0, at + 4.0);
            last_label = at;
        }
    }
    bar + "</g>\n"
}

/// Where a value stands between two others; the middle if these are equal.
pub fn fraction(value: f64, low: f64, high: f64) -> f64 {
    if low < high { (value - low) / (high - low) } else { 0.5 }
}

fn gradient() -> String {
    let stop = |n: u32| {
        let t = f64::from(n) / 10.0;
        format!("<stop offset=\"{t}\" stop-color=\"{}\"/>", viridis(t))
    };
    let stops: String = (0..=10).map(stop).collect();
    format!(
        "<linearGradient id=\"map\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">{stops}</linearGradient>"
    )
}

/// A number in at most four digits, as people write it.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if !(-4.0..5.0).contains(&exponent) {
        let text = format!("{value:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'));
    }
    let decimals = (3.0 - exponent).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (0.123456, "0.1235"),
            (1234.56, "1235"),
            (100.0, "100"),
            (1e-7, "1e-7"),
            (-1.5e10, "-1.5e10"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn crowded_labels_are_left_out() {
        let values: Vec<f64> = (0..100).map(f64::from).collect();
        let bar = colour_bar(&values, &Place { x: 0.0, y: 0.0, height: 150.0 });
        assert_eq!(bar.matches("<path").count(), 100);
        assert!(bar.matches("<text").count() <= 11);
    }
}
