//! What a name in an equation stands for.

use super::error::Problem;
use super::operation::FUNCTIONS;
use super::token::is_name;
use super::tree::Leaf;
use std::f64::consts::{E, PI};

/// The inputs with fixed names; point arrays follow them. The position in this
/// list is the number of the input everywhere on this floor.
pub(super) const INPUTS: [&str; 7] = ["x", "y", "z", "u", "ux", "uy", "uz"];

/// Number of the input `u`; its three first derivatives follow.
pub(super) const U: usize = 3;

/// The second derivatives in the order of the operator's coefficients.
pub(super) const SECOND: [&str; 6] = ["uxx", "uyy", "uzz", "uxy", "uxz", "uyz"];

const CONSTANTS: [(&str, f64); 2] = [("pi", PI), ("e", E)];

/// So many parameters and arrays are listed in a message.
const LISTED: usize = 20;

/// The names of one equation: the fixed ones, its parameters and arrays.
pub(super) struct Names<'a> {
    parameters: &'a [(String, f64)],
    arrays: &'a [String],
    used: Vec<usize>,
    used_parameters: Vec<bool>,
}

impl<'a> Names<'a> {
    /// Checks the parameters.
    pub fn new(
        parameters: &'a [(String, f64)],
        arrays: &'a [String],
    ) -> Result<Names<'a>, Problem> {
        for (i, parameter) in parameters.iter().enumerate() {
            check(parameter, &parameters[..i])?;
        }
        let used_parameters = vec![false; parameters.len()];
        Ok(Names { parameters, arrays, used: Vec::new(), used_parameters })
    }

    /// The meaning of a bare name: a coordinate, `u` or a derivative, else a
    /// parameter, else an array, else a constant.
    pub fn resolve(&mut self, name: &str) -> Option<Leaf> {
        reserved(name)
            .or_else(|| self.parameter(name))
            .or_else(|| self.array(name))
            .or_else(|| number(CONSTANTS.into_iter(), name))
    }

    /// The parameter of this name, which is thereby used.
    fn parameter(&mut self, name: &str) -> Option<Leaf> {
        let place = self.parameters.iter().position(|parameter| parameter.0 == name)?;
        self.used_parameters[place] = true;
        Some(Leaf::Number(self.parameters[place].1))
    }

    /// The point array of this name, which is thereby used.
    pub fn array(&mut self, name: &str) -> Option<Leaf> {
        let index = self.arrays.iter().position(|array| array == name)?;
        let slot = self.used.iter().position(|&used| used == index);
        let slot = slot.unwrap_or_else(|| {
            self.used.push(index);
            self.used.len() - 1
        });
        Some(Leaf::Input(INPUTS.len() + slot))
    }

    /// The arrays used so far, in the order of their first use, and the parameters not
    /// used, as places in the lists given.
    pub fn into_used(self) -> (Vec<usize>, Vec<usize>) {
        let used = self.used_parameters;
        let unused = (0..used.len()).filter(|&place| !used[place]).collect();
        (self.used, unused)
    }

    /// The problem of a name that stands for nothing.
    pub fn unknown(&self, name: &str) -> Problem {
        let parameters = self.parameters.iter().map(|p| p.0.clone());
        let own = parameters.chain(self.arrays.iter().map(|array| as_written(array)));
        let own: Vec<String> = own.collect();
        let fixed = INPUTS.into_iter().chain(SECOND);
        let fixed: Vec<String> = fixed.chain(CONSTANTS.map(|c| c.0)).map(Into::into).collect();
        Problem::UnknownName {
            name: name.to_owned(),
            nearest: nearest(name, own.iter().chain(&fixed)),
            known: listing(fixed, &own),
        }
    }
}

/// The problem of a name that is used as a function and is none.
pub(super) fn unknown_function(name: &str) -> Problem {
    let known: Vec<String> = FUNCTIONS.iter().map(|f| f.0.to_owned()).collect();
    Problem::UnknownFunction {
        name: name.to_owned(),
        nearest: nearest(name, known.iter()),
        known: known.join(", "),
    }
}

fn check((name, value): &(String, f64), earlier: &[(String, f64)]) -> Result<(), Problem> {
    if !is_name(name) {
        return Err(Problem::ParameterName(name.clone()));
    }
    if reserved(name).is_some() {
        return Err(Problem::ReservedParameter(name.clone()));
    }
    if earlier.iter().any(|other| other.0 == *name) {
        return Err(Problem::ParameterTwice(name.clone()));
    }
    if !value.is_finite() {
        return Err(Problem::ParameterValue(name.clone()));
    }
    Ok(())
}

/// Whether a parameter may have this name without hiding a meaning that the name has: a
/// coordinate, `u`, a derivative or a constant.
pub fn is_free_name(name: &str) -> bool {
    let is_constant = CONSTANTS.iter().any(|constant| constant.0 == name);
    is_name(name) && reserved(name).is_none() && !is_constant
}

fn reserved(name: &str) -> Option<Leaf> {
    let input = INPUTS.iter().position(|&input| input == name);
    input.map(Leaf::Input).or_else(|| second(name))
}

/// `uyx` is `uxy`.
fn second(name: &str) -> Option<Leaf> {
    let mut letters: Vec<char> = name.strip_prefix('u')?.chars().collect();
    letters.sort_unstable();
    let name: String = letters.into_iter().collect();
    let index = SECOND.iter().position(|second| second[1..] == *name)?;
    Some(Leaf::Second(index))
}

fn number<'n>(mut from: impl Iterator<Item = (&'n str, f64)>, name: &str) -> Option<Leaf> {
    from.find(|known| known.0 == name).map(|known| Leaf::Number(known.1))
}

/// An array's name as an equation must write it.
fn as_written(array: &str) -> String {
    if is_name(array) && reserved(array).is_none() {
        array.to_owned()
    } else {
        format!("`{array}`")
    }
}

fn listing(mut fixed: Vec<String>, own: &[String]) -> String {
    fixed.extend(own.iter().take(LISTED).cloned());
    if own.len() > LISTED {
        fixed.push(format!("and {} more", own.len() - LISTED));
    }
    fixed.join(", ")
}

/// The candidate with the least edit distance, if that is small for the length
/// of the name; a single letter is like every other.
fn nearest<'c>(name: &str, candidates: impl Iterator<Item = &'c String>) -> Option<String> {
    let slips = match name.chars().count() {
        0 | 1 => 0,
        2..5 => 1,
        _ => 2,
    };
    candidates
        .map(|candidate| (distance(name, candidate.trim_matches('`')), candidate))
        .filter(|&(distance, _)| distance <= slips)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate.clone())
}

/// Levenshtein's edit distance, without regard to case.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.to_lowercase().chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, other) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_resolution() {
        let parameters = [("k".to_owned(), 2.0), ("e".to_owned(), 3.0)];
        let arrays = ["u", "k", "pi", "T"].map(String::from);
        let mut names = Names::new(&parameters, &arrays).unwrap();
        assert_eq!(names.resolve("u"), Some(Leaf::Input(U)));
        assert_eq!(names.resolve("k"), Some(Leaf::Number(2.0)));
        assert_eq!(names.resolve("e"), Some(Leaf::Number(3.0)));
        assert_eq!(names.resolve("pi"), Some(Leaf::Input(7)));
        assert_eq!(names.array("u"), Some(Leaf::Input(8)));
        assert_eq!(names.resolve("nothing"), None);
        assert_eq!(names.into_used(), (vec![2, 0], vec![]));
    }

    #[test]
    fn mixed_derivatives_in_any_order() {
        for (name, index) in [("uxx", 0), ("uxy", 3), ("uyx", 3), ("uzx", 4), ("uzy", 5)] {
            assert_eq!(second(name), Some(Leaf::Second(index)));
        }
        for name in ["u", "ux", "uxxx", "uxw", "xx"] {
            assert_eq!(second(name), None);
        }
    }

    #[test]
    fn edit_distances() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("Pi", "pi"), 0);
    }
}
