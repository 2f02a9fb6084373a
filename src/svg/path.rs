//! Curves in the plane as SVG path data.

use std::fmt::Write;

/// A point of the picture, in user units: x to the right, y down.
pub type Point = [f64; 2];

/// A cubic Bézier curve by its control points.
pub type Curve = [Point; 4];

/// The straight line between two points as a curve.
pub fn straight(from: Point, to: Point) -> Curve {
    let at = |t: f64| [0, 1].map(|n| from[n] + t * (to[n] - from[n]));
    [from, at(1.0 / 3.0), at(2.0 / 3.0), to]
}

/// Coordinates are written in thousandths of a unit.
const STEPS: f64 = 1000.0;

/// Path data for curves that follow each other, each from where the last one
/// ended; `closed` joins the end to the start.
///
/// Coordinates are relative, which is shorter, but taken from the rounded end of
/// the last curve, so that rounding does not add up.
pub fn path_data(curves: &[Curve], closed: bool) -> String {
    let mut data = String::new();
    let Some(first) = curves.first() else { return data };
    let mut here = rounded(first[0]);
    write_pair(&mut data, 'M', [here]);
    let mut command = 'M';
    for [_, out, back, end] in curves {
        let [out, back, end] = [out, back, end].map(|p| rounded(*p));
        let relative = [out, back, end].map(|p| [p[0] - here[0], p[1] - here[1]]);
        if end == here {
            continue;
        }
        let next = if is_straight(&relative) { 'l' } else { 'c' };
        let lead = if next == command { ' ' } else { next };
        match next {
            'l' => write_pair(&mut data, lead, [relative[2]]),
            _ => write_pair(&mut data, lead, relative),
        }
        (command, here) = (next, end);
    }
    if closed {
        data.push('z');
    }
    data
}

fn rounded(point: Point) -> [i64; 2] {
    point.map(|x| (x * STEPS).round() as i64)
}

/// Whether the handles lie at the thirds of a straight line, to rounding.
fn is_straight([out, back, end]: &[[i64; 2]; 3]) -> bool {
    (0..2).all(|n| (3 * out[n] - end[n]).abs() <= 3 && (3 * back[n] - 2 * end[n]).abs() <= 3)
}

fn write_pair<const N: usize>(data: &mut String, command: char, points: [[i64; 2]; N]) {
    data.push(command);
    for (place, coordinate) in points.iter().flatten().enumerate() {
        // a minus sign separates as well as a space does
        if place > 0 && *coordinate >= 0 {
            data.push(' ');
        }
        write_thousandths(data, *coordinate);
    }
}

/// Writes thousandths without trailing zeros.
fn write_thousandths(data: &mut String, value: i64) {
    let sign = if value < 0 { "-" } else { "" };
    let (whole, part) = (value.abs() / 1000, value.abs() % 1000);
    // writing to a string cannot fail
    let _ = if part == 0 {
        write!(data, "{sign}{whole}")
    } else {
        let digits = format!("{part:03}");
        write!(data, "{sign}{whole}.{}", digits.trim_end_matches('0'))
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_and_curved_pieces() {
        let curves = [
            straight([1.0, 2.0], [3.5, 1.0]),
            straight([3.5, 1.0], [4.5, 1.0]),
            [[4.5, 1.0], [5.0, 1.0], [6.0, 2.0], [6.0, 3.25]],
        ];
        assert_eq!(path_data(&curves, false), "M1 2l2.5-1 1 0c0.5 0 1.5 1 1.5 2.25");
        assert_eq!(path_data(&curves[..1], true), "M1 2l2.5-1z");
        assert_eq!(path_data(&[], true), "");
    }

    #[test]
    fn rounding_does_not_add_up() {
        let step = 0.0004;
        let at = |n: usize| [n as f64 * step, 0.0];
        let curves: Vec<Curve> = (0..1000).map(|n| straight(at(n), at(n + 1))).collect();
        let data = path_data(&curves, false);
        let moved: f64 = data
            .trim_start_matches("M0 0l")
            .split(' ')
            .step_by(2)
            .map(|number| number.parse::<f64>().unwrap())
            .sum();
        assert!((moved - 0.4).abs() < 1e-9);
    }
}
