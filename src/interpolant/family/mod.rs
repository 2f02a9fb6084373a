//! The family of interpolants among which the thesis chooses (sections 1.5 to 1.8, 5.2).
//!
//! Each has on every cell one polynomial of a [`Space`], which has the values and
//! gradients at the corners and satisfies the PDE at as many points as are missing to
//! determine it. A space is data: [`spaces`] is the table of all of them, and
//! [`Dei`] is the one interpolant that they are data of.
//!
//! Neighbours agree on the corners of a common side, and on the side itself only if its
//! data determine the polynomial there: so for the PCI and the bicubic on rectangles.
//! Only the PCI's and the tri-cubic's pieces are cubics, which contours need; they have
//! forms of their own, [`Pci`](super::Pci) and [`Tricubic`](super::Tricubic).

mod cell;
mod dei;
mod enclosing_box;
mod monomials;
mod points;
mod shape;
mod space;
pub mod spaces;
mod system;

pub use dei::{Dei, DeiOptions};
pub use points::CollocationPoints;
pub use shape::Shape;
pub use space::Space;
