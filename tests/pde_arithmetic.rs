//! The meaning of expressions, on cases small enough to be checked by hand.

use std::f64::consts::{E, PI};
use vtu2contour::pde::{Pde, Sample};

const AT: Sample =
    Sample { x: [3.0, 5.0, 7.0], u: 11.0, gradient: [13.0, 17.0, 19.0], arrays: &[] };

fn pde(expression: &str) -> Pde {
    Pde::parse(&format!("uxx = {expression}"), &[], &[]).unwrap()
}

/// The value of an expression at [`AT`].
fn value(expression: &str) -> f64 {
    pde(expression).right_hand_side(&AT)
}

fn operator(equation: &str) -> [f64; 6] {
    Pde::parse(equation, &[], &[]).unwrap().operator(&AT.x)
}

#[test]
fn precedence() {
    for (expression, expected) in [
        ("2 + 3*4", 14.0),
        ("(2 + 3)*4", 20.0),
        ("2*3^2", 18.0),
        ("10 - 4 - 3", 3.0),
        ("24/4/3", 2.0),
        ("24/4*3", 18.0),
        ("2^3^2", 512.0),
        ("2**3**2", 512.0),
        ("(2^3)^2", 64.0),
        ("2^3*2", 16.0),
    ] {
        assert_eq!(value(expression), expected, "{expression}");
    }
}

#[test]
fn signs() {
    for (expression, expected) in [
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("2^-1", 0.5),
        ("2^-1*x", 1.5),
        ("2^-x^2", 2f64.powf(-9.0)),
        ("2*-3", -6.0),
        ("2--3", 5.0),
        ("--x", 3.0),
        ("+x", 3.0),
        ("2 - +x", -1.0),
        ("-x*y", -15.0),
        ("-2 + 3", 1.0),
        ("-1^2", -1.0),
        ("1 − 2·3×4", -23.0),
    ] {
        assert_eq!(value(expression), expected, "{expression}");
    }
}

#[test]
fn numbers_and_names() {
    for (expression, expected) in [
        ("1e-3*x", 1e-3 * 3.0),
        (".5 + 2.", 2.5),
        ("1E2", 100.0),
        ("pi", PI),
        ("e", E),
        ("e^2", E.powf(2.0)),
        ("x*10000 + y*100 + z", 30507.0),
        ("u*1e6 + ux*1e4 + uy*100 + uz", 11_131_719.0),
    ] {
        let error = (value(expression) - expected).abs();
        assert!(error <= 4.0 * f64::EPSILON * expected, "{expression}");
    }
}

#[test]
fn functions() {
    let a = 0.3_f64;
    for (name, expected) in [
        ("sin(0.3)", a.sin()),
        ("cos(0.3)", a.cos()),
        ("tan(0.3)", a.tan()),
        ("asin(0.3)", a.asin()),
        ("acos(0.3)", a.acos()),
        ("atan(0.3)", a.atan()),
        ("atan2(0.3, -2)", a.atan2(-2.0)),
        ("sinh(0.3)", a.sinh()),
        ("cosh(0.3)", a.cosh()),
        ("tanh(0.3)", a.tanh()),
        ("exp(0.3)", a.exp()),
        ("log(0.3)", a.ln()),
        ("ln(0.3)", a.ln()),
        ("log10(0.3)", a.log10()),
        ("log2(0.3)", a.log2()),
        ("sqrt(0.3)", a.sqrt()),
        ("cbrt(0.3)", a.cbrt()),
        ("abs(-0.3)", a),
        ("sign(-0.3)", -1.0),
        ("min(0.3, 2)", a),
        ("max(0.3, 2)", 2.0),
        ("pow(0.3, 2.5)", a.powf(2.5)),
        ("floor(-0.3)", -1.0),
        ("ceil(0.3)", 1.0),
        ("hypot(3, 4)", 5.0),
        ("heaviside(0.3)", 1.0),
    ] {
        assert_eq!(value(name), expected, "{name}");
        // Not folded: the same with an argument known at run time only.
        let at_run_time = name.replacen("0.3", "(0.3 + 0*x)", 1);
        assert_eq!(value(&at_run_time), expected, "{at_run_time}");
    }
    assert!((value("erf(0.3)") - 0.328_626_759_459_127_4).abs() < 1e-15);
}

#[test]
fn outside_the_domain_is_nan_or_infinite() {
    assert!(value("log(-x)").is_nan());
    assert!(value("sqrt(-1)").is_nan());
    assert!(value("min(x, log(-1))").is_nan());
    assert!(value("0*x/(x - 3)").is_nan());
    assert_eq!(value("1/(x - 3)"), f64::INFINITY);
    assert_eq!(value("log(x - 3)"), f64::NEG_INFINITY);
}

#[test]
fn operators() {
    for (equation, expected) in [
        ("uxx + uyy = 0", [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
        ("laplacian(u) = 0", [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        ("-lap(u)/2 = 0", [-0.5, -0.5, -0.5, 0.0, 0.0, 0.0]),
        ("(1+x^2)*uxx + 2*uyy - y*uxy/3 = 0", [10.0, 2.0, 0.0, -5.0 / 3.0, 0.0, 0.0]),
        ("-(uxx+uyy) = 0", [-1.0, -1.0, 0.0, 0.0, 0.0, 0.0]),
        ("uxx*2 = 0", [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        ("uyx + uxy + 4*uzx - uzy = 0", [0.0, 0.0, 0.0, 2.0, 4.0, -1.0]),
        ("0 = uxx - z*uzz", [-1.0, 0.0, 7.0, 0.0, 0.0, 0.0]),
        ("3*uxx = uxx + uyy", [2.0, -1.0, 0.0, 0.0, 0.0, 0.0]),
        ("2*(x*(uxx - uyy) + u) = 0", [6.0, -6.0, 0.0, 0.0, 0.0, 0.0]),
        ("0*uxx + uyy = 0", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
    ] {
        assert_eq!(operator(equation), expected, "{equation}");
    }
}

#[test]
fn terms_change_sides() {
    for (equation, expected) in [
        ("uxx = u", 11.0),
        ("uxx + u = 0", -11.0),
        ("u = uxx", -11.0),
        ("0 = uxx + u", 0.0 + 11.0),
        ("uxx - ux + 2*u = y", 5.0 + 13.0 - 22.0),
        ("3*(uxx - u)/x = y*z", 35.0 + 11.0),
        ("uxx = 0", 0.0),
        ("uxx = uyy", 0.0),
    ] {
        let pde = Pde::parse(equation, &[], &[]).unwrap();
        assert_eq!(pde.right_hand_side(&AT), expected, "{equation}");
    }
}

#[test]
fn constant_operators() {
    let constant = |equation| {
        let k = [("k".to_owned(), 2.0)];
        Pde::parse(equation, &k, &[]).unwrap().operator_is_constant()
    };
    assert!(constant("uxx + k*pi*uyy/3 = x*u"));
    assert!(!constant("uxx + x*uyy = 0"));
}

#[test]
fn what_the_right_hand_side_uses() {
    assert!(pde("x + u").depends_on_solution());
    assert!(pde("uy").depends_on_solution());
    assert!(!pde("x*sin(y)").depends_on_solution());
}

#[test]
fn arrays_and_parameters() {
    let arrays = ["T", "my array", "u", "a::b", "k"].map(String::from);
    let parameters = [("k".to_owned(), 100.0)];
    let text = "uxx = k*`my array` + T - `my array`*`u` + u + `k`";
    let pde = Pde::parse(text, &parameters, &arrays).unwrap();
    assert_eq!(pde.used_arrays(), [1, 0, 2, 4], "in the order of use");
    let sample = Sample { arrays: &[2.0, 3.0, 5.0, 0.25], ..AT };
    assert_eq!(pde.right_hand_side(&sample), 200.0 + 3.0 - 10.0 + 11.0 + 0.25);
}

#[test]
fn a_missing_array_value_is_nan() {
    let pde = Pde::parse("uxx = T", &[], &["T".to_owned()]).unwrap();
    assert!(pde.right_hand_side(&AT).is_nan());
    let mut batch = self::pde("1").batch();
    batch.push(&AT);
    let mut out = Vec::new();
    pde.right_hand_sides(&batch, &mut out);
    assert!(out[0].is_nan(), "a batch made for another equation");
}

#[test]
fn names_of_functions_are_free_elsewhere() {
    let parameters = [("exp".to_owned(), 2.0)];
    let pde = Pde::parse("uxx = exp*exp(0)", &parameters, &[]).unwrap();
    assert_eq!(pde.right_hand_side(&AT), 2.0);
}

#[test]
fn derivatives_by_hand() {
    let line = pde("u^2*ux + sin(uy) - 3*uz").linearization(&AT);
    assert_eq!(line.value, 121.0 * 13.0 + 17f64.sin() - 57.0);
    assert_eq!(line.u, 22.0 * 13.0);
    assert_eq!(line.gradient, [121.0, 17f64.cos(), -3.0]);
    let zero = pde("x").linearization(&AT);
    assert_eq!((zero.u, zero.gradient), (0.0, [0.0; 3]));
}

#[test]
fn every_function_has_its_derivative() {
    let functions = [
        "-u",
        "sin(u)",
        "cos(u)",
        "tan(u)",
        "asin(u)",
        "acos(u)",
        "atan(u)",
        "sinh(u)",
        "cosh(u)",
        "tanh(u)",
        "exp(u)",
        "log(u)",
        "log10(u)",
        "log2(u)",
        "sqrt(u)",
        "cbrt(u)",
        "abs(u)",
        "abs(-u)",
        "sign(u)",
        "floor(u)",
        "ceil(u)",
        "erf(u)",
        "heaviside(u)",
        "2 + u",
        "2 - u",
        "u - 2",
        "u*u",
        "u/2",
        "2/u",
        "sin(u)/u",
        "u^2",
        "u^3",
        "u^4",
        "u^-1",
        "u^-2",
        "u^0",
        "u^0.5",
        "u^5",
        "2^u",
        "u^u",
        "pow(u, 1.5)",
        "atan2(u, 2)",
        "atan2(2, u)",
        "atan2(u, u^2)",
        "hypot(u, 2)",
        "hypot(2, u)",
        "hypot(u, u^2)",
        "min(u, 2)",
        "min(2, u)",
        "min(u, u^2)",
        "max(u, 2)",
        "max(2, u)",
        "max(u, u^2)",
        "max(u, 0.1)",
        "min(0.1, u)",
    ];
    for function in functions {
        for u in [0.3, 0.7] {
            let pde = pde(function);
            let at = |u: f64| Sample { u, ..AT };
            let h = 1e-5;
            let difference = pde.right_hand_side(&at(u + h)) - pde.right_hand_side(&at(u - h));
            let slope = pde.linearization(&at(u)).u;
            let error = (slope - difference / (2.0 * h)).abs();
            assert!(error < 1e-8 * (1.0 + slope.abs()), "{function} at {u}");
        }
    }
}

#[test]
fn a_base_of_zero_with_a_constant_exponent() {
    let at = Sample { u: 0.0, ..AT };
    for (function, expected) in [("u^2", 0.0), ("u^1", 1.0), ("u^0", 0.0), ("u^2.5", 0.0)] {
        assert_eq!(pde(function).linearization(&at).u, expected, "{function}");
    }
}

#[test]
fn the_branch_not_taken_has_no_say() {
    let at = Sample { u: -1.0, ..AT };
    // log(-1) would be NaN, the derivative of sqrt at 0 infinite.
    let line = pde("max(u, -2)*2 + min(u, sqrt(u + 1))").linearization(&at);
    assert_eq!(line.u, 2.0 + 1.0);
    assert_eq!(pde("abs(u)").linearization(&Sample { u: 0.0, ..AT }).u, 0.0);
    assert_eq!(pde("max(u, 0)").linearization(&Sample { u: 0.0, ..AT }).u, 0.5);
}

#[test]
fn a_batch_of_any_length_and_operators_in_batches() {
    let pde = Pde::parse("x*uxx = x^2", &[], &[]).unwrap();
    for count in [0, 1, 63, 64, 65, 200] {
        let mut batch = pde.batch();
        for i in 0..count {
            let x = [i as f64, 0.0, 0.0];
            batch.push(&Sample { x, ..AT });
        }
        let (mut values, mut operators) = (vec![1.0; 3], Vec::new());
        pde.right_hand_sides(&batch, &mut values);
        pde.operators(&batch, &mut operators);
        assert_eq!((values.len(), operators.len()), (count, count));
        for i in 0..count {
            assert_eq!(values[i], (i * i) as f64);
            assert_eq!(operators[i][0], i as f64);
        }
    }
}

#[test]
fn long_texts_need_no_deep_stack() {
    let sum = pde(&vec!["u"; 20_000].join("+"));
    assert_eq!(sum.right_hand_side(&AT), 220_000.0);
    assert_eq!(sum.linearization(&AT).u, 20_000.0);
    let nested = format!("{}x{}", "(".repeat(250), ")".repeat(250));
    assert_eq!(value(&nested), 3.0);
}

#[test]
fn an_equation_is_shared_between_threads() {
    fn shared<T: Send + Sync + Clone + 'static>() {}
    shared::<Pde>();
    shared::<vtu2contour::pde::PdeError>();
}
