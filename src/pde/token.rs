//! The text of an equation cut into tokens, each with its place.

use super::error::{Fault, Problem};

/// A token and the bytes of the text that it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Token<'t> {
    /// Byte where the token starts.
    pub at: usize,
    /// The token as written; empty at the end.
    pub text: &'t str,
    pub kind: TokenKind<'t>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TokenKind<'t> {
    Number(f64),
    /// A letter or `_`, followed by letters, digits and `_`.
    Name(&'t str),
    /// The text between two backquotes.
    Quoted(&'t str),
    Plus,
    Minus,
    Times,
    Over,
    /// `^` or `**`.
    Power,
    Open,
    Close,
    Comma,
    Equals,
    End,
}

/// Cuts a text into tokens; the last one is always [`TokenKind::End`].
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Fault> {
    // Without trailing blanks, so that the end is where a reader sees it.
    let text = text.trim_end();
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(token) = token_at(text, at)? {
        at = token.at + token.text.len();
        tokens.push(token);
    }
    tokens.push(Token { at: text.len(), text: "", kind: TokenKind::End });
    Ok(tokens)
}

/// Whether a text reads as one name.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(begins_name) && name_length(text) == text.len()
}

/// The first token at or after a byte; `None` at the end of the text.
fn token_at(text: &str, from: usize) -> Result<Option<Token<'_>>, Fault> {
    let rest = text[from..].trim_start();
    let at = text.len() - rest.len();
    let Some(first) = rest.chars().next() else {
        return Ok(None);
    };
    let (kind, length) = match first {
        '`' => quoted(rest, at)?,
        _ if begins_number(rest) => number(rest, at)?,
        _ if begins_name(first) => name(rest),
        _ => operator(rest, first, at)?,
    };
    Ok(Some(Token { at, text: &rest[..length], kind }))
}

fn operator(rest: &str, first: char, at: usize) -> Result<(TokenKind<'_>, usize), Fault> {
    if rest.starts_with("**") {
        return Ok((TokenKind::Power, 2));
    }
    let kind = match first {
        '+' => TokenKind::Plus,
        // The signs of a typeset formula, as they come by copy and paste.
        '-' | '\u{2212}' => TokenKind::Minus,
        '*' | '·' | '×' => TokenKind::Times,
        '/' => TokenKind::Over,
        '^' => TokenKind::Power,
        '(' => TokenKind::Open,
        ')' => TokenKind::Close,
        ',' => TokenKind::Comma,
        '=' => TokenKind::Equals,
        _ => return Err(Fault::at(at, Problem::Character(first))),
    };
    Ok((kind, first.len_utf8()))
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn name(rest: &str) -> (TokenKind<'_>, usize) {
    let length = name_length(rest);
    (TokenKind::Name(&rest[..length]), length)
}

fn name_length(rest: &str) -> usize {
    rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len())
}

fn quoted(rest: &str, at: usize) -> Result<(TokenKind<'_>, usize), Fault> {
    let inner = &rest[1..];
    match inner.find('`') {
        Some(length) => Ok((TokenKind::Quoted(&inner[..length]), length + 2)),
        None => Err(Fault::at(at, Problem::OpenQuote)),
    }
}

fn begins_number(rest: &str) -> bool {
    let digits = rest.strip_prefix('.').unwrap_or(rest);
    digits.starts_with(|c: char| c.is_ascii_digit())
}

fn number(rest: &str, at: usize) -> Result<(TokenKind<'_>, usize), Fault> {
    let mantissa = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
    let length = mantissa + exponent_length(&rest[mantissa..]);
    let text = &rest[..length];
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((TokenKind::Number(value), length)),
        Ok(_) => Err(Fault::at(at, Problem::Overflow(text.to_owned()))),
        Err(_) => Err(Fault::at(at, Problem::Number(text.to_owned()))),
    }
}

/// Length of `e-3` and the like; 0 if no digit follows, because `2e` is a
/// forgotten product with the constant e.
fn exponent_length(rest: &str) -> usize {
    let Some(after) = rest.strip_prefix(['e', 'E']) else {
        return 0;
    };
    let digits = after.strip_prefix(['+', '-']).unwrap_or(after);
    let count = digits.bytes().take_while(u8::is_ascii_digit).count();
    if count == 0 {
        return 0;
    }
    rest.len() - digits.len() + count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<TokenKind<'_>> {
        tokens(text).unwrap().iter().map(|t| t.kind).collect()
    }

    #[test]
    fn numbers() {
        for (text, value) in [
            ("1", 1.0),
            ("1e-3", 1e-3),
            (".5", 0.5),
            ("2.", 2.0),
            ("2.e3", 2000.0),
            ("1E+2", 100.0),
        ] {
            assert_eq!(kinds(text), [TokenKind::Number(value), TokenKind::End]);
        }
    }

    #[test]
    fn an_exponent_needs_digits() {
        let e = [
            TokenKind::Number(2.0),
            TokenKind::Name("e"),
            TokenKind::Plus,
            TokenKind::Name("x"),
            TokenKind::End,
        ];
        assert_eq!(kinds("2e+x"), e);
    }

    #[test]
    fn two_ways_to_write_a_power() {
        let power = [TokenKind::Name("x"), TokenKind::Power, TokenKind::Name("y"), TokenKind::End];
        assert_eq!(kinds("x**y"), power);
        assert_eq!(kinds("x ^ y"), power);
    }

    #[test]
    fn signs_of_a_typeset_formula() {
        assert_eq!(kinds("1−2·3×4"), kinds("1-2*3*4"));
    }

    #[test]
    fn places_are_bytes_and_the_end_ignores_blanks() {
        let places: Vec<_> =
            tokens(" ρ +`a b`  ").unwrap().iter().map(|t| (t.at, t.text)).collect();
        assert_eq!(places, [(1, "ρ"), (4, "+"), (5, "`a b`"), (10, "")]);
    }

    #[test]
    fn names() {
        assert!(is_name("beta_2") && is_name("ρ") && is_name("_"));
        assert!(!is_name("") && !is_name("2a") && !is_name("a b") && !is_name("a::b"));
    }
}
