//! The seven test problems of thesis section 5.1: as text against Rust written
//! by hand, and the stated solutions against the text.

use proptest::prelude::*;
use std::f64::consts::PI;
use std::ops::{Add, Mul, Sub};
use vtu2contour::pde::{Pde, Sample};

const ALPHA: f64 = 100.0;
const BETA: f64 = 0.117;

const PROBLEM_1: &str = "uxx + uyy + beta*(1 - exp(2*x))*u = 0";

/// f is the Laplacian of the stated solution (x²-x)(y²-y) exp(-α r²).
const PROBLEM_2: &str = "uxx + uyy = exp(-alpha*((x-.5)^2 + (y-beta)^2))*(\
    (y^2-y)*(2 - 4*alpha*(2*x-1)*(x-.5) + (x^2-x)*(4*alpha^2*(x-.5)^2 - 2*alpha)) + \
    (x^2-x)*(2 - 4*alpha*(2*y-1)*(y-beta) + (y^2-y)*(4*alpha^2*(y-beta)^2 - 2*alpha)))";

const PROBLEM_3: &str = "uxx + uyy = 1";

const PROBLEM_4: &str = "uxx + uyy = -100*exp(-(5-10*x)^2/2) + (50-100*x)*ux \
    - 150*exp(-(5-10*x)^2/2)*exp(-(5-10*y)^2/2) - 75*exp(-(5-10*y)^2/2) + (50-100*y)*uy";

const PROBLEM_5: &str = "uxx + uyy + uzz = 2*pi*cos(pi*x)*sin(pi*y)*sin(pi*z) - 3*pi^2*u";

const PROBLEM_6: &str = "uxx + uyy + uzz = 6*x*(y^3-y^2)*(z^2+1) \
    + (x^3-x)*(6*y-2)*(z^2+1) + 2*(x^3-x)*(y^3-y^2)";

const PROBLEM_7: &str = "laplacian(u) = (x^2*y^2 + x^2*z^2 + y^2*z^2)*exp(x*y*z)";

fn parse(text: &str) -> Pde {
    let parameters: &[(&str, f64)] = match text {
        PROBLEM_1 => &[("beta", 20.0)],
        PROBLEM_2 => &[("alpha", ALPHA), ("beta", BETA)],
        _ => &[],
    };
    let parameters: Vec<_> = parameters.iter().map(|p| (p.0.to_owned(), p.1)).collect();
    Pde::parse(text, &parameters, &[]).unwrap()
}

/// The right-hand sides in Rust, not by way of the text.
fn by_hand(problem: usize, [x, y, z]: [f64; 3], u: f64, [ux, uy, _]: [f64; 3]) -> f64 {
    let bell = |t: f64| (-(5.0 - 10.0 * t).powi(2) / 2.0).exp();
    match problem {
        1 => -20.0 * (1.0 - (2.0 * x).exp()) * u,
        3 => 1.0,
        4 => {
            -100.0 * bell(x) + (50.0 - 100.0 * x) * ux - 150.0 * bell(x) * bell(y) - 75.0 * bell(y)
                + (50.0 - 100.0 * y) * uy
        }
        5 => 2.0 * PI * (PI * x).cos() * (PI * y).sin() * (PI * z).sin() - 3.0 * PI * PI * u,
        6 => {
            6.0 * x * (y.powi(3) - y * y) * (z * z + 1.0)
                + (x.powi(3) - x) * (6.0 * y - 2.0) * (z * z + 1.0)
                + 2.0 * (x.powi(3) - x) * (y.powi(3) - y * y)
        }
        _ => (x * x * y * y + x * x * z * z + y * y * z * z) * (x * y * z).exp(),
    }
}

/// A value with its first two derivatives along one coordinate: exact second
/// derivatives without formulas for them.
#[derive(Clone, Copy)]
struct Jet(f64, f64, f64);

impl Jet {
    /// f(self), given f, f' and f'' there.
    fn chain(self, f: f64, d: f64, dd: f64) -> Jet {
        Jet(f, d * self.1, dd * self.1 * self.1 + d * self.2)
    }

    fn exp(self) -> Jet {
        let e = self.0.exp();
        self.chain(e, e, e)
    }

    fn sin(self) -> Jet {
        let (sin, cos) = self.0.sin_cos();
        self.chain(sin, cos, -sin)
    }
}

impl Add<Jet> for Jet {
    type Output = Jet;
    fn add(self, o: Jet) -> Jet {
        Jet(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
}

impl Sub<Jet> for Jet {
    type Output = Jet;
    fn sub(self, o: Jet) -> Jet {
        self + o * -1.0
    }
}

impl Mul<Jet> for Jet {
    type Output = Jet;
    fn mul(self, o: Jet) -> Jet {
        let d = self.1 * o.0 + self.0 * o.1;
        Jet(self.0 * o.0, d, self.2 * o.0 + 2.0 * self.1 * o.1 + self.0 * o.2)
    }
}

impl Add<f64> for Jet {
    type Output = Jet;
    fn add(self, o: f64) -> Jet {
        Jet(self.0 + o, self.1, self.2)
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;
    fn mul(self, o: f64) -> Jet {
        Jet(self.0 * o, self.1 * o, self.2 * o)
    }
}

/// The stated solutions.
fn solution(problem: usize, [x, y, z]: [Jet; 3]) -> Jet {
    let bell = |t: Jet| {
        let s = t * -10.0 + 5.0;
        (s * s * -0.5).exp()
    };
    match problem {
        2 => {
            let (dx, dy) = (x + -0.5, y + -BETA);
            (x * x - x) * (y * y - y) * ((dx * dx + dy * dy) * -ALPHA).exp()
        }
        4 => bell(x) + bell(y) * 0.75 + bell(x) * bell(y) * 0.75,
        5 => x * (x * PI).sin() * (y * PI).sin() * (z * PI).sin(),
        6 => (x * x * x - x) * (y * y * y - y * y) * (z * z + 1.0),
        _ => (x * y * z).exp(),
    }
}

/// The solution at a point, its derivatives along the three coordinates.
fn jets(problem: usize, at: [f64; 3]) -> [Jet; 3] {
    [0, 1, 2].map(|axis| {
        let seed = |k: usize| Jet(at[k], f64::from(k == axis), 0.0);
        solution(problem, [seed(0), seed(1), seed(2)])
    })
}

fn unit_cube() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(0.0..1.0)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn text_agrees_with_rust(at in unit_cube(), u in -2.0..2.0, gradient in prop::array::uniform3(-9.0..9.0)) {
        let texts = [(1, PROBLEM_1), (3, PROBLEM_3), (4, PROBLEM_4), (5, PROBLEM_5), (6, PROBLEM_6), (7, PROBLEM_7)];
        for (problem, text) in texts {
            let sample = Sample { x: at, u, gradient, arrays: &[] };
            let value = parse(text).right_hand_side(&sample);
            let expected = by_hand(problem, at, u, gradient);
            prop_assert!((value - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "problem {}", problem);
        }
    }

    #[test]
    fn stated_solutions_satisfy_their_equations(at in unit_cube()) {
        let texts = [(2, PROBLEM_2), (4, PROBLEM_4), (5, PROBLEM_5), (6, PROBLEM_6), (7, PROBLEM_7)];
        for (problem, text) in texts {
            let pde = parse(text);
            let jets = jets(problem, at);
            let gradient = jets.map(|jet| jet.1);
            let value = pde.right_hand_side(&Sample { x: at, u: jets[0].0, gradient, arrays: &[] });
            let operator = pde.operator(&at);
            let left: f64 = (0..3).map(|k| operator[k] * jets[k].2).sum();
            // Problem 4 subtracts terms of several hundred.
            prop_assert!((left - value).abs() <= 1e-11 * (100.0 + left.abs()), "problem {}: {} {}", problem, left, value);
        }
    }
}

#[test]
fn the_operators_are_laplacians() {
    for text in [PROBLEM_1, PROBLEM_2, PROBLEM_3, PROBLEM_4] {
        assert!(parse(text).operator_is_constant());
        assert_eq!(parse(text).operator(&[0.3; 3]), [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    }
    for text in [PROBLEM_5, PROBLEM_6, PROBLEM_7] {
        assert_eq!(parse(text).operator(&[0.3; 3]), [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    }
}
