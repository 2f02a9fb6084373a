//! Bad input and the exact message: what is wrong, where, and what to do.

use vtu2contour::pde::{Pde, Problem};

const KNOWN: &str = "x, y, z, u, ux, uy, uz, uxx, uyy, uzz, uxy, uxz, uyz, pi, e";

const LINEAR: &str = "second derivatives may only be added and multiplied by coefficients";

const COEFFICIENT: &str = "it may use x, y, z, parameters and constants";

const FUNCTIONS: &str = "sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, ln, \
    log10, log2, sqrt, cbrt, abs, sign, min, max, pow, floor, ceil, hypot, erf, heaviside";

fn message(text: &str) -> String {
    let arrays = ["T", "my array"].map(String::from);
    Pde::parse(text, &[], &arrays).unwrap_err().to_string()
}

fn check(cases: &[(&str, String)]) {
    for (text, expected) in cases {
        assert_eq!(message(text), *expected, "for {text:?}");
    }
}

#[test]
fn characters_and_numbers() {
    check(&[
        (
            "uxx = a::b",
            "character 8: `:` has no meaning here; an array's name with such characters goes between backquotes".into(),
        ),
        ("uxx = 1.2.3", "character 7: `1.2.3` is not a number".into()),
        ("uxx = 1e999", "character 7: `1e999` is too large for a number".into()),
        ("uxx = `my", "character 7: this backquote is not closed".into()),
    ]);
}

#[test]
fn equals_signs() {
    check(&[
        ("", "character 1: expected a number, a name or `(`, found the end".into()),
        (
            "uxx + uyy  ",
            "character 10: there is no `=`; write an equation such as `uxx + uyy = 0`".into(),
        ),
        ("uxx = 1 = 2", "character 9: a second `=`; an equation has one".into()),
        ("uxx == 1", "character 6: expected a number, a name or `(`, found `=`".into()),
        ("uxx =", "character 6: expected a number, a name or `(`, found the end".into()),
    ]);
}

#[test]
fn structure() {
    check(&[
        ("uxx = 2*/3", "character 9: expected a number, a name or `(`, found `/`".into()),
        ("uxx = (1 + 2", "character 7: this `(` is not closed".into()),
        ("(uxx = 2)", "character 1: this `(` is not closed".into()),
        ("uxx = 1)", "character 8: this `)` closes nothing".into()),
        ("uxx) = 1", "character 4: this `)` closes nothing".into()),
        ("uxx = 1, 2", "character 8: expected an operator, found `,`".into()),
        ("uxx = (1, 2)", "character 9: expected an operator, found `,`".into()),
        ("uxx = ()", "character 8: expected a number, a name or `(`, found `)`".into()),
    ]);
}

#[test]
fn implicit_products() {
    check(&[
        ("uxx = 2x", "character 8: `2` and `x` stand side by side; write `2*x`".into()),
        ("uxx = 2 pi", "character 9: `2` and `pi` stand side by side; write `2*pi`".into()),
        ("uxx = 2e", "character 8: `2` and `e` stand side by side; write `2*e`".into()),
        ("uxx = (x)(y)", "character 10: `)` and `(` stand side by side; write `)*(`".into()),
        ("uxx = x(1 + y)", "character 7: `x` is not a function; to multiply, write `x*(`".into()),
    ]);
}

#[test]
fn functions() {
    check(&[
        ("uxx = sin x", "character 7: `sin` is a function; write `sin(...)`".into()),
        ("uxx = atan2(x)", "character 7: `atan2` takes 2 arguments, not 1".into()),
        ("uxx = sin(x, y)", "character 7: `sin` takes 1 argument, not 2".into()),
        ("uxx = sin()", "character 7: `sin` takes 1 argument, not 0".into()),
        (
            "lap(v) = 1",
            "character 5: only `lap(u)` can be read, with nothing else between the parentheses"
                .into(),
        ),
        (
            "uxx = sqr(x)",
            format!(
                "character 7: unknown function `sqr`, did you mean `sqrt`?; known are {FUNCTIONS}"
            ),
        ),
    ]);
}

#[test]
fn unknown_names() {
    check(&[
        ("uxx = w", format!("character 7: unknown name `w`; known are {KNOWN}, T, `my array`")),
        (
            "uxx = my_array",
            format!(
                "character 7: unknown name `my_array`, did you mean `my array`?; known are {KNOWN}, T, `my array`"
            ),
        ),
        (
            "uxx = `temperature`",
            format!("character 7: unknown name `temperature`; known are {KNOWN}, T, `my array`"),
        ),
    ]);
}

#[test]
fn not_linear_in_the_second_derivatives() {
    check(&[
        ("uxx^2 = 1", format!("character 1: `uxx` stands in a power; {LINEAR}")),
        ("2^uxx = 1", format!("character 3: `uxx` stands in a power; {LINEAR}")),
        ("1/uyx = 1", format!("character 3: `uyx` stands in a divisor; {LINEAR}")),
        ("uxx/uyy = 1", format!("character 1: `uxx` stands in a divisor; {LINEAR}")),
        ("1 + sin(uxx) = 1", format!("character 9: `uxx` stands in `sin`; {LINEAR}")),
        ("max(x, uxx) = 1", format!("character 8: `uxx` stands in `max`; {LINEAR}")),
        ("uxx*uyy = 1", format!("character 5: `uxx` is multiplied by `uyy`; {LINEAR}")),
        (
            "uyy + u*uxx = 1",
            format!("character 7: the coefficient of `uxx` depends on `u`; {COEFFICIENT}"),
        ),
        (
            "uxx/(1 + ux^2) = 1",
            format!("character 10: the coefficient of `uxx` depends on `ux`; {COEFFICIENT}"),
        ),
        (
            "1 = x*`my array`*uxx",
            format!("character 7: the coefficient of `uxx` depends on `my array`; {COEFFICIENT}"),
        ),
    ]);
}

#[test]
fn no_operator() {
    let none =
        "there is no second derivative; the equation needs one of uxx, uyy, uzz, uxy, uxz, uyz";
    check(&[
        ("ux = 1", format!("character 7: {none}")),
        (
            "x + uxx - uxx = 1",
            "character 5: the second derivatives cancel: all their coefficients are zero".into(),
        ),
        (
            "uyy = uyy",
            "character 1: the second derivatives cancel: all their coefficients are zero".into(),
        ),
        ("uxx + uyy/0 = 1", "character 7: the coefficient of `uyy` is not a finite number".into()),
        ("log(-1)*uxx = 1", "character 9: the coefficient of `uxx` is not a finite number".into()),
    ]);
}

#[test]
fn depth_and_length() {
    for (open, close) in [("(", ")"), ("-", ""), ("x^", ""), ("sin(", ")"), ("1+2*(", ")")] {
        let nested = format!("uxx = {}x{}", open.repeat(10_000), close.repeat(10_000));
        let error = Pde::parse(&nested, &[], &[]).unwrap_err();
        assert_eq!(*error.problem(), Problem::TooDeep(256), "{open}");
    }
    let long = "1+".repeat(40_000);
    assert_eq!(message(&long), "the equation is longer than 65536 bytes");
}

#[test]
fn parameters() {
    for (name, value, expected) in [
        (
            "ux",
            1.0,
            "the parameter `ux` has the name of a coordinate, of u or of a derivative; rename it",
        ),
        (
            "uyx",
            1.0,
            "the parameter `uyx` has the name of a coordinate, of u or of a derivative; rename it",
        ),
        ("2k", 1.0, "the parameter name `2k` is not a letter followed by letters, digits and `_`"),
        ("k", f64::NAN, "the parameter `k` is not a finite number"),
        ("twice", 1.0, "the parameter `twice` is given twice"),
    ] {
        let parameters = [("twice".to_owned(), 1.0), (name.to_owned(), value)];
        let error = Pde::parse("uxx = 1", &parameters, &[]).unwrap_err();
        assert_eq!(error.to_string(), expected);
        assert_eq!((error.character(), error.caret()), (None, String::new()));
    }
}

#[test]
fn the_caret_stands_under_the_character() {
    let error = Pde::parse("uxx + uyy = sin(pi*x) + 2*bta", &[("beta".into(), 1.0)], &[]);
    let error = error.unwrap_err();
    assert_eq!(error.caret(), "  uxx + uyy = sin(pi*x) + 2*bta\n                            ^");
    assert!(
        error.to_string().starts_with("character 27: unknown name `bta`, did you mean `beta`?")
    );
}

#[test]
fn many_arrays_are_not_all_listed() {
    let arrays: Vec<String> = (0..50).map(|i| format!("array{i}")).collect();
    let error = Pde::parse("uxx = nothing", &[], &arrays).unwrap_err();
    assert!(error.to_string().ends_with("array19, and 30 more"));
}
