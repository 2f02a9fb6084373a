//! Differential equations given as text.
//!
//! `uxx + uyy = 2*pi*cos(pi*x) - 3*pi^2*u` becomes a [`Pde`]: the coefficients
//! of a linear second-order operator L, and a right-hand side g(x, y, z, u, ux,
//! uy, uz) (thesis eq. 1.1). An interpolant demands L p = g at its collocation
//! points (eq. 1.10). This floor knows no mesh and no file.
//!
//! ```
//! use vtu2contour::pde::{Pde, Sample};
//!
//! let arrays = ["density", "my array"].map(String::from);
//! let pde = Pde::parse("(1 + x^2)*uxx + uyy - ux = density*u", &[], &arrays)?;
//! assert_eq!(pde.operator(&[2.0, 0.0, 0.0])[..2], [5.0, 1.0]);
//! assert_eq!(pde.used_arrays(), [0]);
//!
//! let mut batch = pde.batch();
//! for i in 0..100 {
//!     batch.push(&Sample { u: f64::from(i), arrays: &[0.5], ..Sample::default() });
//! }
//! let mut values = Vec::new();
//! pde.right_hand_sides(&batch, &mut values);
//! assert_eq!(values[99], 49.5);
//! # Ok::<(), vtu2contour::pde::PdeError>(())
//! ```
//!
//! # The language
//!
//! An equation has one `=`. Second derivatives `uxx uyy uzz uxy uxz uyz` (`uyx`
//! is `uxy`) and `laplacian(u)` or `lap(u)`, which is uxx + uyy + uzz, may stand
//! on both sides, added and multiplied by coefficients of x, y, z, parameters
//! and constants. Everything else may stand on both sides too.
//!
//! - Numbers: `1e-3`, `.5`, `2.`; products are written: `2*x`, not `2x`.
//! - Operators, tightest first: `^` or `**` (from the right: `2^3^2` is 512),
//!   the sign (`-x^2` is -(x²)), `* /`, `+ -`.
//! - Names: `x y z u ux uy uz`, then parameters, then point arrays, then the
//!   constants `pi` and `e`: the first meaning found counts. A parameter must
//!   not have the name of a coordinate, of u or of a derivative; an array may,
//!   and is then written between backquotes, as is one whose name is no word:
//!   `` `my array` ``.
//! - Functions: `sin cos tan asin acos atan atan2 sinh cosh tanh exp log ln
//!   log10 log2 sqrt cbrt abs sign min max pow floor ceil hypot erf heaviside`.
//!   `log` is the natural logarithm, `atan2(y, x)` takes y first, `sign(0)` is 0,
//!   `heaviside(0)` is 1/2, `min` and `max` of a NaN are NaN. A function's name
//!   is one only before a parenthesis.
//!
//! # How it works
//!
//! | file | what it holds |
//! |---|---|
//! | `token` | the text cut into tokens |
//! | `names` | what a name stands for |
//! | `tree`, `parser` | the syntax tree, and the way to it |
//! | `graph` | expressions with shared parts, constants folded |
//! | `operator` | the split into L and g |
//! | `derivative` | ∂g/∂u, ∂g/∂ux, ... |
//! | `tape`, `sample` | evaluation, 64 points at once |
//! | `operation` | what each operation computes |
//! | `equation` | [`Pde`] |
//!
//! Tree and graph are vectors with operands before operations, so apart from
//! the parser, whose depth is limited, nothing recurses, and all passes and
//! tapes are linear in the length of the text.

mod derivative;
mod equation;
mod error;
mod graph;
mod names;
mod operation;
mod operator;
mod parser;
mod sample;
mod tape;
mod token;
mod tree;

pub use equation::{Linearization, Pde};
pub use error::{PdeError, Problem};
pub use sample::{Batch, LANES, Sample};
