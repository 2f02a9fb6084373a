//! What must hold for every expression: random trees are printed, read back and
//! compared with the trees.

use proptest::prelude::*;
use vtu2contour::pde::{Pde, Sample};

const NAMES: [&str; 9] = ["x", "y", "z", "u", "ux", "uy", "uz", "T", "`a b`"];

const SECOND: [&str; 6] = ["uxx", "uyy", "uzz", "uxy", "uxz", "uyz"];

type Named = (&'static str, fn(f64) -> f64);

const SMOOTH: [Named; 11] = [
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("atan", f64::atan),
    ("tanh", f64::tanh),
    ("exp", f64::exp),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("log", f64::ln),
    ("sqrt", f64::sqrt),
    ("asin", f64::asin),
    ("log2", f64::log2),
];

const OTHER: [Named; 4] =
    [("abs", f64::abs), ("floor", f64::floor), ("ceil", f64::ceil), ("cbrt", f64::cbrt)];

#[derive(Debug, Clone)]
enum Tree {
    Number(f64),
    Name(usize),
    Negate(Box<Tree>),
    Operator(char, Box<Tree>, Box<Tree>),
    Call(usize, Box<Tree>),
    Hypot(Box<Tree>, Box<Tree>),
}

/// Binding strength of what stands on top of a tree.
fn strength(tree: &Tree) -> u8 {
    match tree {
        Tree::Operator('+' | '-', ..) => 1,
        Tree::Operator('*' | '/', ..) => 2,
        Tree::Negate(_) => 3,
        Tree::Operator(..) => 4,
        _ => 5,
    }
}

/// Prints a tree with no more parentheses than it needs.
fn print(tree: &Tree) -> String {
    let wrapped = |tree: &Tree, least: u8| match strength(tree) >= least {
        true => print(tree),
        false => format!("({})", print(tree)),
    };
    match tree {
        Tree::Number(value) => format!("{value:?}"),
        Tree::Name(k) => NAMES[*k].to_owned(),
        Tree::Negate(a) => format!("-{}", wrapped(a, 3)),
        Tree::Operator('^', a, b) => format!("{}^{}", wrapped(a, 5), wrapped(b, 3)),
        Tree::Operator(c @ ('*' | '/'), a, b) => {
            format!("{} {c} {}", wrapped(a, 2), wrapped(b, 3))
        }
        Tree::Operator(c, a, b) => format!("{} {c} {}", wrapped(a, 1), wrapped(b, 2)),
        Tree::Call(k, a) => format!("{}({})", function(*k).0, print(a)),
        Tree::Hypot(a, b) => format!("hypot({}, {})", print(a), print(b)),
    }
}

fn function(k: usize) -> Named {
    let all = SMOOTH.iter().chain(&OTHER);
    *all.clone().nth(k % (SMOOTH.len() + OTHER.len())).unwrap()
}

/// Small whole powers are products, as the module promises nothing but
/// accuracy about them; the comparison is bit for bit all the same.
fn power(a: f64, b: f64) -> f64 {
    match b {
        -1.0 => 1.0 / a,
        1.0 => a,
        2.0 => a * a,
        3.0 => a * a * a,
        4.0 => (a * a) * (a * a),
        _ => a.powf(b),
    }
}

fn evaluate(tree: &Tree, inputs: &[f64; 9]) -> f64 {
    match tree {
        Tree::Number(value) => *value,
        Tree::Name(k) => inputs[*k],
        Tree::Negate(a) => -evaluate(a, inputs),
        Tree::Operator(c, a, b) => {
            let (a, b) = (evaluate(a, inputs), evaluate(b, inputs));
            match c {
                '+' => a + b,
                '-' => a - b,
                '*' => a * b,
                '/' => a / b,
                _ => power(a, b),
            }
        }
        Tree::Call(k, a) => function(*k).1(evaluate(a, inputs)),
        Tree::Hypot(a, b) => evaluate(a, inputs).hypot(evaluate(b, inputs)),
    }
}

/// Random trees over some of the names and functions.
fn trees(names: usize, functions: usize) -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (0..20u8).prop_map(|n| Tree::Number(f64::from(n) / 4.0)),
        (0..names).prop_map(Tree::Name),
    ];
    leaf.prop_recursive(6, 40, 2, move |inner| {
        let two = (inner.clone(), inner.clone());
        let operators = prop::sample::select(vec!['+', '-', '*', '/', '^']);
        prop_oneof![
            4 => (operators, two.clone()).prop_map(|(c, (a, b))| Tree::Operator(c, a.into(), b.into())),
            1 => inner.clone().prop_map(|a| Tree::Negate(a.into())),
            1 => (0..functions, inner).prop_map(|(k, a)| Tree::Call(k, a.into())),
            1 => two.prop_map(|(a, b)| Tree::Hypot(a.into(), b.into())),
        ]
    })
}

fn inputs() -> impl Strategy<Value = [f64; 9]> {
    prop::array::uniform9(-3.0..3.0)
}

fn sample(v: &[f64; 9]) -> Sample<'_> {
    Sample { x: [v[0], v[1], v[2]], u: v[3], gradient: [v[4], v[5], v[6]], arrays: &v[7..] }
}

/// The equation `uxx = tree`, and its text.
fn equation(tree: &Tree) -> (Pde, String) {
    let text = format!("uxx = {}", print(tree));
    let arrays = ["T", "a b"].map(String::from);
    (Pde::parse(&text, &[], &arrays).unwrap(), text)
}

/// The values of the arrays that an equation uses.
fn arrays(pde: &Pde, v: &[f64; 9]) -> Vec<f64> {
    pde.used_arrays().iter().map(|&k| v[7 + k]).collect()
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_printed_is_read_as_it_was(tree in trees(9, 15), v in inputs()) {
        let (pde, text) = equation(&tree);
        let arrays = arrays(&pde, &v);
        let value = pde.right_hand_side(&Sample { arrays: &arrays, ..sample(&v) });
        let expected = evaluate(&tree, &v);
        prop_assert!(same(value, expected), "{}: {} {}", text, value, expected);
    }

    #[test]
    fn a_batch_has_the_bits_of_single_points(tree in trees(7, 15), points in prop::collection::vec(inputs(), 1..150)) {
        let (pde, text) = equation(&tree);
        let mut batch = pde.batch();
        points.iter().for_each(|v| batch.push(&sample(v)));
        let (mut values, mut lines) = (Vec::new(), Vec::new());
        pde.right_hand_sides(&batch, &mut values);
        pde.linearizations(&batch, &mut lines);
        prop_assert_eq!((values.len(), lines.len()), (points.len(), points.len()));
        for (i, v) in points.iter().enumerate() {
            let line = pde.linearization(&sample(v));
            prop_assert!(same(values[i], pde.right_hand_side(&sample(v))), "{}", text);
            prop_assert!(same(lines[i].value, values[i]), "{}", text);
            prop_assert!(same(lines[i].u, line.u), "{}", text);
            for k in 0..3 {
                prop_assert!(same(lines[i].gradient[k], line.gradient[k]), "{}", text);
            }
        }
    }

    #[test]
    fn derivatives_are_the_limits_of_differences(tree in trees(7, SMOOTH.len()), v in inputs()) {
        let (pde, text) = equation(&tree);
        let line = pde.linearization(&sample(&v));
        let slopes = [line.u, line.gradient[0], line.gradient[1], line.gradient[2]];
        for (k, slope) in slopes.into_iter().enumerate() {
            let Some(expected) = difference(&pde, &v, 3 + k) else { continue };
            // At the edge of a domain, as of u^x at u = 0.
            if !slope.is_finite() {
                continue;
            }
            let error = (slope - expected).abs();
            prop_assert!(error <= 1e-5 * (1.0 + expected.abs()), "{} by {}: {} {}", text, NAMES[3 + k], slope, expected);
        }
    }

    #[test]
    fn any_text_is_read_or_refused(text in "\\PC{0,60}") {
        check_refusal(&text);
    }

    #[test]
    fn any_sequence_of_tokens_is_read_or_refused(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..25)) {
        check_refusal(&words.concat());
    }

    #[test]
    fn splitting_keeps_the_equation(left in sides(), right in sides(), second in prop::array::uniform6(-2.0..2.0), v in inputs()) {
        let text = format!("{} = {}", print_side(&left), print_side(&right));
        let Ok(pde) = Pde::parse(&text, &[], &[]) else {
            // There may be no second derivative, or they cancel, or a coefficient is infinite.
            return Ok(());
        };
        let operator = pde.operator(&[v[0], v[1], v[2]]);
        let split = (0..6).map(|k| operator[k] * second[k]).sum::<f64>() - pde.right_hand_side(&sample(&v));
        let ((a, size_a), (b, size_b)) = (value_side(&left, &second, &v), value_side(&right, &second, &v));
        let size = 1.0 + size_a + size_b;
        if size.is_nan() || size > 1e100 {
            return Ok(());
        }
        prop_assert!((split - (a - b)).abs() <= 1e-12 * size, "{}: {} {}", text, split, a - b);
    }
}

/// Central differences of two steps; `None` where they disagree: the function is
/// then too wild, or not smooth, between the points.
fn difference(pde: &Pde, v: &[f64; 9], input: usize) -> Option<f64> {
    let at = |h: f64| {
        let mut v = *v;
        v[input] += h;
        pde.right_hand_side(&sample(&v))
    };
    let slope = |h: f64| (at(h) - at(-h)) / (2.0 * h);
    let (coarse, fine) = (slope(2e-4), slope(1e-4));
    let agree = (coarse - fine).abs() <= 1e-6 * (1.0 + fine.abs());
    // Large values leave no digits for the difference.
    (agree && at(0.0).abs() < 1e3).then(|| fine + (fine - coarse) / 3.0)
}

const WORDS: [&str; 26] = [
    "uxx", "uxy", "u", "x", "k", "2", ".5", "1e3", "=", "=", "+", "-", "*", "/", "^", "**", "(",
    ")", ",", "sin(", "atan2", "lap(u)", "`", " ", "e", "pi",
];

/// Reading must not panic, and an error must lie inside the text.
fn check_refusal(text: &str) {
    match Pde::parse(text, &[], &[]) {
        Ok(pde) => {
            let sample = Sample::default();
            pde.linearization(&sample);
            pde.operator(&sample.x);
        }
        Err(error) => {
            let character = error.character().unwrap();
            assert!((1..=text.chars().count() + 1).contains(&character));
            assert_eq!(error.caret().lines().count(), 2);
            assert!(!error.to_string().contains('\n'));
        }
    }
}

/// A term: a coefficient of place, perhaps a second derivative, and the ways to
/// write their product.
type Term = (Tree, Option<usize>, u8, bool);

fn sides() -> impl Strategy<Value = Vec<Term>> {
    let with = (trees(3, 15), (0..6usize).prop_map(Some), 0..4u8, any::<bool>());
    let without = (trees(7, 15), Just(None), Just(0u8), any::<bool>());
    prop::collection::vec(prop_oneof![with, without], 1..6)
}

fn print_side(terms: &[Term]) -> String {
    let written = terms.iter().map(|(tree, second, way, minus)| {
        let tree = print(tree);
        let term = match (second.map(|k| SECOND[k]), way) {
            (None, _) => format!("({tree})"),
            (Some(name), 0) => format!("({tree})*{name}"),
            (Some(name), 1) => format!("{name}*({tree})/2"),
            (Some(name), 2) => format!("(-({tree})*(-{name} + 3))"),
            (Some(name), _) => format!("{name}/(({tree})^2 + 1)"),
        };
        format!("{} {term}", if *minus { "-" } else { "+" })
    });
    written.collect::<Vec<_>>().join(" ")
}

/// The value of a side, and the sum of the sizes of its parts.
fn value_side(terms: &[Term], second: &[f64; 6], v: &[f64; 9]) -> (f64, f64) {
    let mut total = (0.0, 0.0);
    for (tree, k, way, minus) in terms {
        let c = evaluate(tree, v);
        let (value, size) = match (k.map(|k| second[k]), way) {
            (None, _) => (c, c.abs()),
            (Some(s), 0) => (c * s, (c * s).abs()),
            (Some(s), 1) => (s * c / 2.0, (s * c).abs()),
            (Some(s), 2) => (-c * (-s + 3.0), c.abs() * (s.abs() + 3.0)),
            (Some(s), _) => (s / (c * c + 1.0), s.abs() + c.abs()),
        };
        total.0 += if *minus { -value } else { value };
        total.1 += size;
    }
    total
}
