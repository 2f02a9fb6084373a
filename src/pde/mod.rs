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
#![doc = include_str!("language.md")]
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
pub use names::is_free_name;
pub use sample::{Batch, LANES, Sample};

/// The language of equations in one page, for people: plain text that is Markdown too.
pub const LANGUAGE: &str = include_str!("language.md");
