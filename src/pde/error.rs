//! What can be wrong with an equation, and where.

use thiserror::Error;

/// Longest text shown around the caret, in characters.
const WINDOW: usize = 72;

/// An equation (or its parameters) that cannot be used.
///
/// [`Display`](std::fmt::Display) is one line that names the character;
/// [`caret`](PdeError::caret) shows it in the text.
///
/// ```
/// use vtu2contour::pde::Pde;
///
/// let error = Pde::parse("uxx + uyy = 2x", &[], &[]).unwrap_err();
/// assert_eq!(error.to_string(), "character 14: `2` and `x` stand side by side; write `2*x`");
/// assert_eq!(error.caret(), "  uxx + uyy = 2x\n               ^");
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}{problem}", place(.text, *.at))]
pub struct PdeError {
    problem: Problem,
    text: String,
    at: Option<usize>,
}

impl PdeError {
    pub(super) fn new(text: &str, fault: Fault) -> PdeError {
        PdeError { problem: fault.problem, text: text.to_owned(), at: fault.at }
    }

    /// What is wrong, without the place.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The character that is wrong, counted from 1; `None` if the fault lies
    /// in a parameter and not in the text.
    pub fn character(&self) -> Option<usize> {
        self.at.map(|at| characters_before(&self.text, at) + 1)
    }

    /// Two indented lines, the text and a `^` under the character that is
    /// wrong; empty if the fault lies in a parameter. Of a long text only the
    /// surroundings are shown, and line breaks and tabs are shown as spaces.
    pub fn caret(&self) -> String {
        let Some(at) = self.at else {
            return String::new();
        };
        let before = characters_before(&self.text, at);
        let start = before.saturating_sub(WINDOW / 2);
        let shown: String = self.text.chars().skip(start).take(WINDOW).collect();
        let shown = shown.replace(char::is_control, " ");
        let dots = if start > 0 { "..." } else { "" };
        let indent = " ".repeat(dots.len() + before - start);
        format!("  {dots}{}\n  {indent}^", shown.trim_end())
    }
}

/// A problem and the byte where it lies, before the text is known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    pub at: Option<usize>,
    pub problem: Problem,
}

impl Fault {
    /// A problem at a byte of the text.
    pub fn at(at: usize, problem: Problem) -> Fault {
        Fault { at: Some(at), problem }
    }
}

impl From<Problem> for Fault {
    fn from(problem: Problem) -> Fault {
        Fault { at: None, problem }
    }
}

/// The kinds of problem; the texts say what is allowed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Problem {
    /// A character that starts no token.
    #[error(
        "`{0}` has no meaning here; an array's name with such characters goes between backquotes"
    )]
    Character(char),
    /// Digits and points that make no number, such as `1.2.3`.
    #[error("`{0}` is not a number")]
    Number(String),
    /// A number beyond the range of a double.
    #[error("`{0}` is too large for a number")]
    Overflow(String),
    /// A backquote without its partner.
    #[error("this backquote is not closed")]
    OpenQuote,
    /// An equation longer than the limit, in bytes.
    #[error("the equation is longer than {0} bytes")]
    TooLong(usize),
    /// Nesting deeper than the limit.
    #[error("nested deeper than {0} levels")]
    TooDeep(usize),
    /// No equals sign.
    #[error("there is no `=`; write an equation such as `uxx + uyy = 0`")]
    NoEquals,
    /// A second equals sign.
    #[error("a second `=`; an equation has one")]
    TwoEquals,
    /// Something else than a value where a value must stand.
    #[error("expected a number, a name or `(`, found {0}")]
    NoValue(String),
    /// A token that cannot follow a value.
    #[error("expected an operator, found {0}")]
    NoOperator(String),
    /// An opening parenthesis without its partner.
    #[error("this `(` is not closed")]
    Unclosed,
    /// A closing parenthesis without its partner.
    #[error("this `)` closes nothing")]
    Unopened,
    /// Two values without an operator; implicit products are not read.
    #[error("`{0}` and `{1}` stand side by side; write `{0}*{1}`")]
    SideBySide(String, String),
    /// A value followed by parentheses.
    #[error("`{0}` is not a function; to multiply, write `{0}*(`")]
    NotAFunction(String),
    /// A function without parentheses.
    #[error("`{0}` is a function; write `{0}(...)`")]
    NoArguments(String),
    /// A function with the wrong number of arguments.
    #[error("`{name}` takes {expected} argument{}, not {found}", plural(*.expected))]
    Arguments {
        /// The function.
        name: String,
        /// How many arguments it takes.
        expected: usize,
        /// How many were written.
        found: usize,
    },
    /// Something else than `u` in `laplacian(...)`.
    #[error("only `{0}(u)` can be read, with nothing else between the parentheses")]
    Laplacian(String),
    /// A name that stands for nothing.
    #[error("unknown name `{name}`{}; known are {known}", suggestion(.nearest))]
    UnknownName {
        /// The name as written.
        name: String,
        /// The known name with nearly the same letters.
        nearest: Option<String>,
        /// The names that can be used, with commas between.
        known: String,
    },
    /// A name before a parenthesis that is no function.
    #[error("unknown function `{name}`{}; known are {known}", suggestion(.nearest))]
    UnknownFunction {
        /// The name as written.
        name: String,
        /// The known function with nearly the same letters.
        nearest: Option<String>,
        /// The functions that can be used, with commas between.
        known: String,
    },
    /// A second derivative in a power, a divisor or a function.
    #[error(
        "`{derivative}` stands in {place}; second derivatives may only be added and multiplied by coefficients"
    )]
    NotLinear {
        /// The second derivative.
        derivative: String,
        /// Where it stands.
        place: String,
    },
    /// A product of two second derivatives.
    #[error(
        "`{0}` is multiplied by `{1}`; second derivatives may only be added and multiplied by coefficients"
    )]
    Product(String, String),
    /// A coefficient that is not a function of place alone.
    #[error(
        "the coefficient of `{derivative}` depends on `{name}`; it may use x, y, z, parameters and constants"
    )]
    Dependent {
        /// The second derivative.
        derivative: String,
        /// The name that the coefficient must not use.
        name: String,
    },
    /// A first-order equation, or none.
    #[error(
        "there is no second derivative; the equation needs one of uxx, uyy, uzz, uxy, uxz, uyz"
    )]
    NoSecondDerivative,
    /// Second derivatives whose coefficients are all zero.
    #[error("the second derivatives cancel: all their coefficients are zero")]
    Cancelled,
    /// A constant coefficient that is infinite or not a number.
    #[error("the coefficient of `{0}` is not a finite number")]
    Coefficient(String),
    /// A parameter whose name has another meaning.
    #[error("the parameter `{0}` has the name of a coordinate, of u or of a derivative; rename it")]
    ReservedParameter(String),
    /// A parameter whose name cannot be written in an equation.
    #[error("the parameter name `{0}` is not a letter followed by letters, digits and `_`")]
    ParameterName(String),
    /// A parameter given twice.
    #[error("the parameter `{0}` is given twice")]
    ParameterTwice(String),
    /// A parameter that is infinite or not a number.
    #[error("the parameter `{0}` is not a finite number")]
    ParameterValue(String),
}

fn place(text: &str, at: Option<usize>) -> String {
    at.map_or(String::new(), |at| format!("character {}: ", characters_before(text, at) + 1))
}

fn characters_before(text: &str, at: usize) -> usize {
    text.char_indices().take_while(|&(i, _)| i < at).count()
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or(String::new(), |name| format!(", did you mean `{}`?", name.trim_matches('`')))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str, at: usize) -> PdeError {
        PdeError::new(text, Fault::at(at, Problem::NoEquals))
    }

    #[test]
    fn the_place_counts_characters_not_bytes() {
        let error = error("ααα", 4);
        assert_eq!(error.character(), Some(3));
        assert_eq!(error.caret(), "  ααα\n    ^");
    }

    #[test]
    fn the_end_of_the_text_is_a_place() {
        assert_eq!(error("ab", 2).caret(), "  ab\n    ^");
        assert_eq!(error("", 0).caret(), "  \n  ^");
    }

    #[test]
    fn of_a_long_text_the_surroundings_are_shown() {
        let text = format!("{}!{}", "a".repeat(500), "b".repeat(500));
        let caret = error(&text, 500).caret();
        let (above, below) = caret.split_once('\n').unwrap();
        assert_eq!(above.find('!'), below.find('^'));
        assert_eq!(above.len(), 2 + 3 + WINDOW);
    }

    #[test]
    fn line_breaks_do_not_move_the_caret() {
        assert_eq!(error("a\n\tb", 3).caret(), "  a  b\n     ^");
    }
}
