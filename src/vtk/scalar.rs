//! The ten number types an array can hold.

use super::array_type::ArrayType;
use super::values::Values;
use bytemuck::Pod;

/// A number type of VTK's arrays: the ten below.
pub(super) trait Scalar: Pod + PartialEq + Send + Sync {
    /// The type's tag.
    const TYPE: ArrayType;

    /// The number with its bytes in the opposite order.
    fn swap_bytes(self) -> Self;

    /// The nearest `f64`.
    fn to_f64(self) -> f64;

    /// The same integer as `i64`; `None` for floats and for numbers above `i64::MAX`.
    fn to_i64(self) -> Option<i64>;

    /// Reads one number of an ascii array; `None` where it is not one of this type.
    fn parse(token: &str) -> Option<Self>;

    /// Appends the shortest text that reads back as the same number.
    fn format(self, out: &mut Vec<u8>);

    /// A vector of such numbers as [`Values`].
    fn into_values(vector: Vec<Self>) -> Values;
}

macro_rules! integer {
    ($type:ident, $tag:ident) => {
        impl Scalar for $type {
            const TYPE: ArrayType = ArrayType::$tag;

            fn swap_bytes(self) -> Self {
                $type::swap_bytes(self)
            }

            fn to_f64(self) -> f64 {
                self as f64
            }

            fn to_i64(self) -> Option<i64> {
                i64::try_from(self).ok()
            }

            fn parse(token: &str) -> Option<Self> {
                token.parse().ok()
            }

            fn format(self, out: &mut Vec<u8>) {
                out.extend_from_slice(self.to_string().as_bytes());
            }

            fn into_values(vector: Vec<Self>) -> Values {
                Values::$tag(vector)
            }
        }
    };
}

macro_rules! float {
    ($type:ident, $tag:ident) => {
        impl Scalar for $type {
            const TYPE: ArrayType = ArrayType::$tag;

            fn swap_bytes(self) -> Self {
                $type::from_bits(self.to_bits().swap_bytes())
            }

            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            fn to_i64(self) -> Option<i64> {
                None
            }

            fn parse(token: &str) -> Option<Self> {
                token.parse().ok().or_else(|| parse_special(token).map(|value| value as $type))
            }

            fn format(self, out: &mut Vec<u8>) {
                // VTK writes and reads lower case; Debug switches to exponents where it is shorter.
                let text = if self.is_nan() { String::from("nan") } else { format!("{self:?}") };
                out.extend_from_slice(text.as_bytes());
            }

            fn into_values(vector: Vec<Self>) -> Values {
                Values::$tag(vector)
            }
        }
    };
}

integer!(i8, I8);
integer!(u8, U8);
integer!(i16, I16);
integer!(u16, U16);
integer!(i32, I32);
integer!(u32, U32);
integer!(i64, I64);
integer!(u64, U64);
float!(f32, F32);
float!(f64, F64);

/// The spellings of NaN and infinity that C libraries print and Rust does not read,
/// such as `-nan(ind)` and `1.#INF`.
fn parse_special(token: &str) -> Option<f64> {
    let (sign, rest) = match token.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, token.strip_prefix('+').unwrap_or(token)),
    };
    let rest = rest.to_ascii_lowercase();
    if rest.starts_with("nan(") && rest.ends_with(')') {
        return Some(f64::NAN);
    }
    match rest.strip_prefix("1.#")? {
        tail if tail.starts_with("inf") => Some(sign * f64::INFINITY),
        tail if tail.starts_with("qnan") || tail.starts_with("ind") => Some(f64::NAN),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text<T: Scalar>(value: T) -> String {
        let mut out = Vec::new();
        value.format(&mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn floats_print_short_and_read_back() {
        for value in [0.1, -1e300, 5e-324, f64::MAX, 0.0, -0.0, f64::NEG_INFINITY] {
            assert_eq!(f64::parse(&text(value)), Some(value), "{value}");
        }
        assert_eq!(text(1e300), "1e300");
        assert_eq!(text(f64::NAN), "nan");
        assert_eq!(text(-f64::INFINITY), "-inf");
    }

    #[test]
    fn special_spellings_are_read() {
        for token in ["nan", "NaN", "-nan", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#IND"] {
            assert!(f64::parse(token).is_some_and(f64::is_nan), "{token}");
        }
        assert_eq!(f32::parse("-1.#INF"), Some(f32::NEG_INFINITY));
        assert_eq!(f64::parse("inf"), Some(f64::INFINITY));
        assert_eq!(f64::parse("1.#X"), None);
        assert_eq!(f64::parse("nana"), None);
    }

    #[test]
    fn integers_refuse_what_does_not_fit() {
        assert_eq!(u8::parse("256"), None);
        assert_eq!(i8::parse("-128"), Some(-128));
        assert_eq!(i64::parse("1.5"), None);
        assert_eq!(Scalar::to_i64(u64::MAX), None);
        assert_eq!(Scalar::to_i64(3u8), Some(3));
    }
}
