//! From tokens to a syntax tree, by precedence climbing.
//!
//! V. R. Pratt, "Top down operator precedence", POPL 1973. From loose to tight:
//! `+ -`, then `* /`, then the sign, then `^`. So `-x^2` is -(x²), `2^-x^2` is
//! 2^(-(x²)), and `^` alone groups from the right: `2^3^2` is 2⁹.

use super::error::{Fault, Problem};
use super::names::{Names, unknown_function};
use super::operation::{Binary, Function, Unary};
use super::token::{Token, TokenKind, tokens};
use super::tree::{Leaf, Node, NodeId, NodeKind, Tree};

/// Deepest nesting; a level takes some hundred bytes of stack, and threads of
/// a pool may have little.
const DEEPEST: usize = 256;

/// Longest text in bytes: bounds the memory that an evaluation takes.
const LONGEST: usize = 1 << 16;

/// Precedence of the sign, between products and powers.
const SIGN: u8 = 30;

/// Reads an equation; `names` gives the meaning of its names and learns which
/// arrays it uses.
pub(super) fn parse(text: &str, names: &mut Names) -> Result<Tree, Fault> {
    if text.len() > LONGEST {
        return Err(Problem::TooLong(LONGEST).into());
    }
    let mut parser = Parser { tokens: tokens(text)?, next: 0, depth: 0, nodes: Vec::new(), names };
    parser.equation()
}

struct Parser<'t, 'n, 'a> {
    /// Ends with [`TokenKind::End`], which is never passed.
    tokens: Vec<Token<'t>>,
    next: usize,
    depth: usize,
    nodes: Vec<Node>,
    names: &'n mut Names<'a>,
}

impl<'t> Parser<'t, '_, '_> {
    fn equation(&mut self) -> Result<Tree, Fault> {
        let left = self.expression(0)?;
        let equals = self.advance();
        match equals.kind {
            TokenKind::Equals => {}
            TokenKind::End => return Err(Fault::at(equals.at, Problem::NoEquals)),
            _ => return Err(no_operator(equals)),
        }
        let right = self.expression(0)?;
        let end = self.peek();
        match end.kind {
            TokenKind::End => {}
            TokenKind::Equals => return Err(Fault::at(end.at, Problem::TwoEquals)),
            _ => return Err(no_operator(end)),
        }
        Ok(Tree { nodes: std::mem::take(&mut self.nodes), left, right })
    }

    /// An expression whose operators all bind at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Result<NodeId, Fault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(Fault::at(self.peek().at, Problem::TooDeep(DEEPEST)));
        }
        let mut left = self.operand()?;
        while let Some((operation, precedence, right)) = self.operator()? {
            if precedence < least {
                break;
            }
            let at = self.advance().at;
            let right = self.expression(right)?;
            left = self.push(at, NodeKind::Binary(operation, left, right));
        }
        self.depth -= 1;
        Ok(left)
    }

    /// The operator that comes next, its precedence and that of its right
    /// operand; `None` where the expression ends.
    fn operator(&self) -> Result<Option<(Binary, u8, u8)>, Fault> {
        let token = self.peek();
        Ok(Some(match token.kind {
            TokenKind::Plus => (Binary::Add, 10, 11),
            TokenKind::Minus => (Binary::Subtract, 10, 11),
            TokenKind::Times => (Binary::Multiply, 20, 21),
            TokenKind::Over => (Binary::Divide, 20, 21),
            TokenKind::Power => (Binary::Power, 40, 40),
            TokenKind::Number(_) | TokenKind::Name(_) | TokenKind::Quoted(_) | TokenKind::Open => {
                return Err(self.side_by_side(token));
            }
            _ => return Ok(None),
        }))
    }

    fn operand(&mut self) -> Result<NodeId, Fault> {
        let token = self.advance();
        match token.kind {
            TokenKind::Number(value) => Ok(self.leaf(token, Leaf::Number(value))),
            TokenKind::Name(name) => self.name(token, name),
            TokenKind::Quoted(name) => self.array(token, name),
            TokenKind::Open => self.parenthesis(token),
            TokenKind::Plus => self.expression(SIGN),
            TokenKind::Minus => {
                let operand = self.expression(SIGN)?;
                Ok(self.push(token.at, NodeKind::Unary(Unary::Negate, operand)))
            }
            _ => Err(Fault::at(token.at, Problem::NoValue(describe(token)))),
        }
    }

    fn name(&mut self, token: Token<'t>, name: &str) -> Result<NodeId, Fault> {
        if self.peek().kind == TokenKind::Open {
            return self.call(token, name);
        }
        match self.names.resolve(name) {
            Some(leaf) => Ok(self.leaf(token, leaf)),
            None if Function::named(name).is_some() || is_laplacian(name) => {
                Err(Fault::at(token.at, Problem::NoArguments(name.to_owned())))
            }
            None => Err(Fault::at(token.at, self.names.unknown(name))),
        }
    }

    fn array(&mut self, token: Token<'t>, name: &str) -> Result<NodeId, Fault> {
        match self.names.array(name) {
            Some(leaf) => Ok(self.leaf(token, leaf)),
            None => Err(Fault::at(token.at, self.names.unknown(name))),
        }
    }

    fn parenthesis(&mut self, open: Token<'t>) -> Result<NodeId, Fault> {
        let inner = self.expression(0)?;
        self.close(open)?;
        Ok(inner)
    }

    fn call(&mut self, token: Token<'t>, name: &str) -> Result<NodeId, Fault> {
        if is_laplacian(name) {
            return self.laplacian(token);
        }
        let Some(function) = Function::named(name) else {
            return Err(Fault::at(token.at, self.no_function(name)));
        };
        let operands = self.arguments()?;
        let kind = match (function, &*operands) {
            (Function::One(operation), &[a]) => NodeKind::Unary(operation, a),
            (Function::Two(operation), &[a, b]) => NodeKind::Binary(operation, a, b),
            _ => {
                let problem = Problem::Arguments {
                    name: name.to_owned(),
                    expected: function.arguments(),
                    found: operands.len(),
                };
                return Err(Fault::at(token.at, problem));
            }
        };
        Ok(self.push(token.at, kind))
    }

    fn arguments(&mut self) -> Result<Vec<NodeId>, Fault> {
        let open = self.advance();
        let mut arguments = Vec::new();
        if self.peek().kind != TokenKind::Close {
            arguments.push(self.expression(0)?);
            while self.peek().kind == TokenKind::Comma {
                self.advance();
                arguments.push(self.expression(0)?);
            }
        }
        self.close(open)?;
        Ok(arguments)
    }

    /// `laplacian(u)` is uxx + uyy + uzz.
    fn laplacian(&mut self, token: Token<'t>) -> Result<NodeId, Fault> {
        self.advance();
        let (u, close) = (self.advance(), self.advance());
        if u.kind != TokenKind::Name("u") || close.kind != TokenKind::Close {
            return Err(Fault::at(u.at, Problem::Laplacian(token.text.to_owned())));
        }
        let [xx, yy, zz] = [0, 1, 2].map(|k| self.leaf(token, Leaf::Second(k)));
        let sum = self.push(token.at, NodeKind::Binary(Binary::Add, xx, yy));
        Ok(self.push(token.at, NodeKind::Binary(Binary::Add, sum, zz)))
    }

    fn close(&mut self, open: Token) -> Result<(), Fault> {
        let token = self.advance();
        match token.kind {
            TokenKind::Close => Ok(()),
            TokenKind::Comma => Err(no_operator(token)),
            _ => Err(Fault::at(open.at, Problem::Unclosed)),
        }
    }

    fn no_function(&mut self, name: &str) -> Problem {
        match self.names.resolve(name) {
            Some(_) => Problem::NotAFunction(name.to_owned()),
            None => unknown_function(name),
        }
    }

    fn side_by_side(&self, token: Token) -> Fault {
        let before = self.tokens[self.next - 1];
        let problem = Problem::SideBySide(before.text.to_owned(), token.text.to_owned());
        Fault::at(token.at, problem)
    }

    fn leaf(&mut self, token: Token, leaf: Leaf) -> NodeId {
        self.push(token.at, NodeKind::Leaf(leaf))
    }

    fn push(&mut self, at: usize, kind: NodeKind) -> NodeId {
        self.nodes.push(Node { at, kind });
        self.nodes.len() - 1
    }

    fn peek(&self) -> Token<'t> {
        self.tokens[self.next]
    }

    fn advance(&mut self) -> Token<'t> {
        let token = self.peek();
        self.next = (self.next + 1).min(self.tokens.len() - 1);
        token
    }
}

fn is_laplacian(name: &str) -> bool {
    matches!(name, "laplacian" | "lap")
}

/// What cannot follow a value: a comma or a closing parenthesis.
fn no_operator(token: Token) -> Fault {
    let problem = match token.kind {
        TokenKind::Close => Problem::Unopened,
        _ => Problem::NoOperator(describe(token)),
    };
    Fault::at(token.at, problem)
}

fn describe(token: Token) -> String {
    match token.kind {
        TokenKind::End => "the end".to_owned(),
        _ => format!("`{}`", token.text),
    }
}
