//! A differential equation ready for evaluation.

use super::error::{Fault, PdeError};
use super::graph::Graph;
use super::names::{INPUTS, Names, U};
use super::operator::split;
use super::parser::parse;
use super::sample::{Batch, Sample};
use super::tape::Tape;

/// A second-order differential equation L u = g, thesis eq. (1.1): L is linear
/// in the second derivatives, with coefficients that depend on place; g depends
/// on place, u, its first derivatives and point arrays.
///
/// See the [module's documentation](super) for the language. Evaluation follows
/// IEEE 754 and never panics: outside a function's domain the result is NaN or
/// infinite, which is for the caller to count.
///
/// ```
/// use vtu2contour::pde::{Pde, Sample};
///
/// let beta = [("beta".to_owned(), 20.0)];
/// let pde = Pde::parse("uxx + uyy + beta*(1 - exp(2*x))*u = 0", &beta, &[])?;
/// assert_eq!(pde.operator(&[0.5, 0.5, 0.0]), [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
/// let sample = Sample { x: [0.5, 0.5, 0.0], u: 2.0, ..Sample::default() };
/// assert_eq!(pde.right_hand_side(&sample), -(20.0 * (1.0 - 1f64.exp()) * 2.0));
/// # Ok::<(), vtu2contour::pde::PdeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Pde {
    text: String,
    arrays: Vec<usize>,
    unused_parameters: Vec<usize>,
    operator: Tape<6>,
    right_hand_side: Tape<1>,
    /// g, then its derivatives with respect to u, ux, uy, uz.
    linearization: Tape<5>,
}

/// The right-hand side g at a point, and its derivatives there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linearization {
    /// g.
    pub value: f64,
    /// ∂g/∂u.
    pub u: f64,
    /// ∂g/∂ux, ∂g/∂uy, ∂g/∂uz.
    pub gradient: [f64; 3],
}

impl Pde {
    /// Reads an equation.
    ///
    /// `parameters` are names with their values, `arrays` the names of the point
    /// arrays that the equation may use. Names are looked up in this order:
    /// coordinates, u and its derivatives; parameters; arrays; constants. An
    /// array hidden by another meaning is reached by backquotes.
    ///
    /// # Errors
    ///
    /// If the text is no equation, is not linear in its second derivatives or
    /// has none, or if a parameter has a reserved name, a name that cannot be
    /// written, the name of another one, or a value that is not finite.
    pub fn parse(
        text: &str,
        parameters: &[(String, f64)],
        arrays: &[String],
    ) -> Result<Pde, PdeError> {
        Pde::compile(text, parameters, arrays).map_err(|fault| PdeError::new(text, fault))
    }

    fn compile(text: &str, parameters: &[(String, f64)], arrays: &[String]) -> Result<Pde, Fault> {
        let mut names = Names::new(parameters, arrays)?;
        let tree = parse(text, &mut names)?;
        let mut graph = Graph::default();
        let sides = split(text, &tree, &mut graph)?;
        let g = sides.right_hand_side;
        let zero = graph.constant(0.0);
        let mut slope = |input| graph.derivative(g, input).unwrap_or(zero);
        let [u, ux, uy, uz] = [U, U + 1, U + 2, U + 3].map(&mut slope);
        let (arrays, unused_parameters) = names.into_used();
        Ok(Pde {
            text: text.to_owned(),
            arrays,
            unused_parameters,
            operator: Tape::compile(&graph, sides.coefficients),
            right_hand_side: Tape::compile(&graph, [g]),
            linearization: Tape::compile(&graph, [g, u, ux, uy, uz]),
        })
    }

    /// The equation as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The coefficients of uxx, uyy, uzz, uxy, uxz, uyz at a point (thesis
    /// eq. (1.1); a mixed derivative stands once, so uxy + uyx has 2).
    pub fn operator(&self, at: &[f64; 3]) -> [f64; 6] {
        // Only coordinates occur in coefficients.
        self.operator.evaluate(|number| at[number.min(2)])
    }

    /// The coefficients at the points of a batch, as by
    /// [`operator`](Pde::operator); `out` is overwritten.
    pub fn operators(&self, batch: &Batch, out: &mut Vec<[f64; 6]>) {
        self.operator.evaluate_batch(batch, out, |c| c);
    }

    /// Whether the coefficients are the same everywhere.
    pub fn operator_is_constant(&self) -> bool {
        self.operator.inputs().is_empty()
    }

    /// The right-hand side g at a point: the collocation value of thesis
    /// eq. (1.10).
    pub fn right_hand_side(&self, at: &Sample) -> f64 {
        let [value] = self.right_hand_side.evaluate(|number| at.input(number));
        value
    }

    /// The right-hand sides at the points of a batch, bit for bit those of
    /// [`right_hand_side`](Pde::right_hand_side); `out` is overwritten.
    pub fn right_hand_sides(&self, batch: &Batch, out: &mut Vec<f64>) {
        self.right_hand_side.evaluate_batch(batch, out, |[value]| value);
    }

    /// Whether g depends on u, ux, uy or uz. If not, the collocation needs no
    /// approximation of the solution.
    pub fn depends_on_solution(&self) -> bool {
        let solution = U..INPUTS.len();
        let inputs = self.right_hand_side.inputs();
        inputs.iter().any(|number| solution.contains(number))
    }

    /// The right-hand side and its derivatives with respect to u, ux, uy, uz at
    /// a point.
    pub fn linearization(&self, at: &Sample) -> Linearization {
        let results = self.linearization.evaluate(|number| at.input(number));
        Linearization::new(results)
    }

    /// The linearizations at the points of a batch, bit for bit those of
    /// [`linearization`](Pde::linearization); `out` is overwritten.
    pub fn linearizations(&self, batch: &Batch, out: &mut Vec<Linearization>) {
        self.linearization.evaluate_batch(batch, out, Linearization::new);
    }

    /// The point arrays that the equation names, as indices into the list given
    /// to [`parse`](Pde::parse), in the order in which [`Sample::arrays`] wants
    /// their values.
    pub fn used_arrays(&self) -> &[usize] {
        &self.arrays
    }

    /// The parameters that the equation does not name, as indices into the list given to
    /// [`parse`](Pde::parse), ascending.
    pub fn unused_parameters(&self) -> &[usize] {
        &self.unused_parameters
    }

    /// An empty batch for this equation.
    pub fn batch(&self) -> Batch {
        Batch::new(self.arrays.len())
    }
}

impl Linearization {
    fn new([value, u, ux, uy, uz]: [f64; 5]) -> Linearization {
        Linearization { value, u, gradient: [ux, uy, uz] }
    }
}
