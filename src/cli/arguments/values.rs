//! Values that options take, read from text.

use vtu2contour::filter::Component;
use vtu2contour::monitor::{SamplePoints, Selection};

/// A time of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Time {
    /// The least.
    First,
    /// The greatest.
    Last,
    /// This one.
    At(f64),
}

/// Reads a time: `first`, `last` or a number.
pub fn time(text: &str) -> Result<Time, String> {
    match text {
        "first" => Ok(Time::First),
        "last" => Ok(Time::Last),
        number => level(number)
            .map(Time::At)
            .map_err(|_| "give a time of the series, 'first' or 'last'".to_owned()),
    }
}

/// Reads a component: its number or `mag`.
pub fn component(text: &str) -> Result<Component, String> {
    match text {
        "mag" => Ok(Component::Magnitude),
        number => number
            .parse()
            .map(Component::Number)
            .map_err(|_| "give the component's number, from 0, or 'mag'".to_owned()),
    }
}

/// Reads a finite number.
pub fn level(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| "not a number".to_owned())?;
    if value.is_finite() { Ok(value) } else { Err("not a finite number".to_owned()) }
}

/// Reads a number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    let value = level(text)?;
    if value > 0.0 { Ok(value) } else { Err("not above zero".to_owned()) }
}

/// Reads a number that is not below zero.
pub fn not_negative(text: &str) -> Result<f64, String> {
    let value = level(text)?;
    if value >= 0.0 { Ok(value) } else { Err("below zero".to_owned()) }
}

/// Reads `LO,HI`.
pub fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once(',').ok_or("give two numbers, as LO,HI")?;
    let (low, high) = (level(low)?, level(high)?);
    if low < high { Ok([low, high]) } else { Err("LO must be below HI".to_owned()) }
}

/// Reads `NX,NY` or `NX,NY,NZ`.
pub fn counts(text: &str) -> Result<[usize; 3], String> {
    const MOST: usize = 1 << 30;
    let count = |text: &str| match text.trim().parse() {
        Ok(count) if count > 0 => Ok(count),
        _ => Err("give two or three whole numbers above zero, as NX,NY or NX,NY,NZ".to_owned()),
    };
    let counts = text.split(',').map(count).collect::<Result<Vec<usize>, String>>()?;
    let counts = match counts[..] {
        [x, y] => [x, y, 1],
        [x, y, z] => [x, y, z],
        _ => return Err("give two or three whole numbers, as NX,NY or NX,NY,NZ".to_owned()),
    };
    let total = counts.iter().try_fold(1_usize, |product, &count| product.checked_mul(count));
    match total {
        Some(total) if total <= MOST => Ok(counts),
        _ => Err(format!("more than {MOST} points")),
    }
}

/// Reads `average:K`, `fraction:F`, `bulk:F` or `tolerance:V`.
pub fn selection(text: &str) -> Result<Selection, String> {
    let known = "give average:K, fraction:F, bulk:F or tolerance:V";
    let (how, number) = text.split_once(':').ok_or(known)?;
    let number = level(number)?;
    let selection = match how.trim() {
        "average" => Selection::AboveAverage(number),
        "fraction" => Selection::Fraction(number),
        "bulk" => Selection::Bulk(number),
        "tolerance" => Selection::Above(number),
        _ => return Err(known.to_owned()),
    };
    selection.select(&[]).map(|_| selection).map_err(|error| error.to_string())
}

/// Reads `fixed`, `random:SEED`, `random:SEED:N` or `N`.
pub fn samples(text: &str) -> Result<SamplePoints, String> {
    let known = "give fixed, random:SEED, random:SEED:N, or N (above 0 and up to 65535)";
    let count = |text: &str| match text.parse() {
        Ok(count) if count > 0 => Ok(count),
        _ => Err(known.to_owned()),
    };
    let seed = |text: &str| text.parse().map_err(|_| known.to_owned());
    let (count, seed) = match text.split(':').collect::<Vec<_>>()[..] {
        ["fixed"] => return Ok(SamplePoints::Fixed),
        ["random", number] => (SamplePoints::DEFAULT_COUNT, seed(number)?),
        ["random", number, points] => (count(points)?, seed(number)?),
        [points] => (count(points)?, 0),
        _ => return Err(known.to_owned()),
    };
    Ok(SamplePoints::Random { count, seed })
}

/// Reads `NAME=V`.
pub fn parameter(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("give a name and a number, as NAME=V")?;
    Ok((name.trim().to_owned(), level(value)?))
}
