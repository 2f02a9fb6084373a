//! Splits an equation into the operator L and the right-hand side g of thesis
//! eq. (1.1), L u = g(x, y, u, ux, uy).
//!
//! Every part of the equation is, as far as second derivatives go, a linear
//! form Σ cₖ·u″ₖ + rest. The forms are built from the leaves up; where an
//! operation would make a form that is not linear, that is the error.

use super::error::{Fault, Problem};
use super::graph::{Graph, Id};
use super::names::{SECOND, U};
use super::operation::{Binary, Unary};
use super::token::tokens;
use super::tree::{Leaf, Node, NodeId, NodeKind, Tree};

/// The two sides of L u = g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Split {
    /// Coefficients in the order of [`SECOND`].
    pub coefficients: [Id; 6],
    pub right_hand_side: Id,
}

/// Brings all second derivatives to the left and all else to the right.
pub(super) fn split(text: &str, tree: &Tree, graph: &mut Graph) -> Result<Split, Fault> {
    let mut forms: Vec<Form> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        let form = Builder { text, graph }.form(node, &forms)?;
        forms.push(form);
    }
    let (left, right) = (forms[tree.left], forms[tree.right]);
    // A·u″ + a = B·u″ + b becomes (A - B)·u″ = b - a.
    let second = [0, 1, 2, 3, 4, 5].map(|k| graph.difference(left.second[k], right.second[k]));
    if second == [None; 6] {
        return Err(Fault::at(tokens_end(text), Problem::NoSecondDerivative));
    }
    check_coefficients(second, tree, graph)?;
    let rest = graph.difference(right.rest, left.rest);
    let zero = graph.constant(0.0);
    Ok(Split {
        coefficients: second.map(|coefficient| coefficient.unwrap_or(zero)),
        right_hand_side: rest.unwrap_or(zero),
    })
}

/// Σ cₖ·u″ₖ + rest. `None` is a term that is not there; numbers that happen to
/// be zero are terms like any other.
#[derive(Debug, Clone, Copy, Default)]
struct Form {
    second: [Option<Id>; 6],
    rest: Option<Id>,
    /// Where the first second derivative stands.
    derivative: Option<usize>,
    /// Where the first name stands that no coefficient may use.
    dependent: Option<usize>,
}

struct Builder<'a> {
    text: &'a str,
    graph: &'a mut Graph,
}

impl Builder<'_> {
    fn form(&mut self, node: &Node, forms: &[Form]) -> Result<Form, Fault> {
        match node.kind {
            NodeKind::Leaf(leaf) => Ok(self.leaf(leaf, node.at)),
            NodeKind::Unary(Unary::Negate, a) => {
                Ok(self.map(&forms[a], |graph, term| graph.negate(term)))
            }
            NodeKind::Unary(operation, a) => {
                let a = &forms[a];
                let value = self.plain(a, node)?;
                let rest = self.graph.unary(operation, value);
                Ok(Form { rest: Some(rest), ..*a })
            }
            NodeKind::Binary(operation, a, b) => {
                self.binary(operation, node, [a, b].map(|id: NodeId| &forms[id]))
            }
        }
    }

    fn leaf(&mut self, leaf: Leaf, at: usize) -> Form {
        let mut form = Form::default();
        match leaf {
            Leaf::Number(value) => form.rest = Some(self.graph.constant(value)),
            Leaf::Input(number) => {
                form.rest = Some(self.graph.input(number));
                // A coefficient is a function of place: x, y, z.
                form.dependent = (number >= U).then_some(at);
            }
            Leaf::Second(k) => {
                form.second[k] = Some(self.graph.constant(1.0));
                form.derivative = Some(at);
            }
        }
        form
    }

    fn binary(
        &mut self,
        operation: Binary,
        node: &Node,
        [a, b]: [&Form; 2],
    ) -> Result<Form, Fault> {
        match operation {
            Binary::Add => Ok(self.zip(a, b, |graph, a, b| graph.sum(a, b))),
            Binary::Subtract => Ok(self.zip(a, b, |graph, a, b| graph.difference(a, b))),
            Binary::Multiply if a.derivative.is_some() => self.scale(a, b, Binary::Multiply),
            Binary::Multiply if b.derivative.is_some() => self.scale(b, a, Binary::Multiply),
            Binary::Divide if a.derivative.is_some() && b.derivative.is_none() => {
                self.scale(a, b, Binary::Divide)
            }
            _ => {
                let left = self.plain(a, node)?;
                let right = self.plain(b, node)?;
                let rest = Some(self.graph.binary(operation, left, right));
                let dependent = a.dependent.or(b.dependent);
                Ok(Form { rest, dependent, ..Form::default() })
            }
        }
    }

    /// A form times (or over) a coefficient.
    fn scale(&mut self, form: &Form, factor: &Form, operation: Binary) -> Result<Form, Fault> {
        if let (Some(a), Some(b)) = (form.derivative, factor.derivative) {
            let problem = Problem::Product(self.word(a), self.word(b));
            return Err(Fault::at(b, problem));
        }
        if let (Some(derivative), Some(dependent)) = (form.derivative, factor.dependent) {
            let problem = Problem::Dependent {
                derivative: self.word(derivative),
                name: self.word(dependent),
            };
            return Err(Fault::at(dependent, problem));
        }
        let Some(factor) = factor.rest else {
            return Ok(*form);
        };
        Ok(self.map(form, |graph, term| graph.binary(operation, term, factor)))
    }

    /// The value of a form without second derivatives; with them, the error
    /// that they stand in a function, a power or a divisor.
    fn plain(&mut self, form: &Form, node: &Node) -> Result<Id, Fault> {
        let Some(at) = form.derivative else {
            return Ok(form.rest.unwrap_or_else(|| self.graph.constant(0.0)));
        };
        let place = match node.kind {
            NodeKind::Binary(Binary::Divide, ..) => "a divisor".to_owned(),
            NodeKind::Binary(Binary::Power, ..) => "a power".to_owned(),
            _ => format!("`{}`", self.word(node.at)),
        };
        let derivative = self.word(at);
        Err(Fault::at(at, Problem::NotLinear { derivative, place }))
    }

    fn map(&mut self, form: &Form, mut term: impl FnMut(&mut Graph, Id) -> Id) -> Form {
        Form {
            second: form.second.map(|c| c.map(|c| term(self.graph, c))),
            rest: form.rest.map(|rest| term(self.graph, rest)),
            ..*form
        }
    }

    fn zip(
        &mut self,
        a: &Form,
        b: &Form,
        mut terms: impl FnMut(&mut Graph, Option<Id>, Option<Id>) -> Option<Id>,
    ) -> Form {
        Form {
            second: [0, 1, 2, 3, 4, 5].map(|k| terms(self.graph, a.second[k], b.second[k])),
            rest: terms(self.graph, a.rest, b.rest),
            derivative: a.derivative.or(b.derivative),
            dependent: a.dependent.or(b.dependent),
        }
    }

    /// The name that stands at a place, as written but without backquotes.
    fn word(&self, at: usize) -> String {
        let found = tokens(&self.text[at..]).ok();
        let first = found
            .and_then(|tokens| tokens.first().map(|token| token.text.trim_matches('`').to_owned()));
        first.unwrap_or_default()
    }
}

/// Constant coefficients must be finite, and not all zero.
fn check_coefficients(second: [Option<Id>; 6], tree: &Tree, graph: &Graph) -> Result<(), Fault> {
    let values = second.map(|coefficient| coefficient.map_or(Some(0.0), |c| graph.value(c)));
    for (k, value) in values.iter().enumerate() {
        if value.is_some_and(|value| !value.is_finite()) {
            let problem = Problem::Coefficient(SECOND[k].to_owned());
            return Err(Fault::at(place_of(k, tree), problem));
        }
    }
    if values.iter().all(|&value| value == Some(0.0)) {
        let first = (0..6).filter(|&k| second[k].is_some());
        let at = first.map(|k| place_of(k, tree)).min().unwrap_or(0);
        return Err(Fault::at(at, Problem::Cancelled));
    }
    Ok(())
}

/// Where a second derivative first stands in the text.
fn place_of(k: usize, tree: &Tree) -> usize {
    let leaf = NodeKind::Leaf(Leaf::Second(k));
    let places = tree.nodes.iter().filter(|node| node.kind == leaf);
    places.map(|node| node.at).min().unwrap_or(0)
}

fn tokens_end(text: &str) -> usize {
    text.trim_end().len()
}
