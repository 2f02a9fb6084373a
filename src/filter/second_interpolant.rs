//! Interpolants of a field by their names, on triangles and in tetrahedra.

use super::error::FilterError;
use super::family_member::{FamilyMember, HasFamily};
use super::options::InterpolantKind;
use crate::field::Field;
use crate::interpolant::{Equation, Linear, Pci, Pieces, Tricubic};
use crate::mesh::{TetrahedronMesh, TriangleMesh};

/// What the interpolant is compared with, to see how wrong it may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SecondInterpolant {
    /// One that satisfies the PDE at several points of each cell.
    Member(FamilyMember),
    /// The cubic of each cell by itself, without a PDE.
    QuadraticPrecision,
    /// The linear interpolant.
    Linear,
}

impl SecondInterpolant {
    /// The one that is chosen if none is named: of another order than `kind`, and of what is
    /// known.
    pub(super) fn default_for(kind: InterpolantKind, has_pde: bool, corners: usize) -> Self {
        match (kind, has_pde) {
            (InterpolantKind::Pci, true) if corners == 3 => Self::Member(FamilyMember::Fqi),
            (InterpolantKind::Pci, true) => Self::Member(FamilyMember::P3),
            (InterpolantKind::Pci, false) => Self::QuadraticPrecision,
            _ => Self::Linear,
        }
    }

    /// Its name, as options have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Member(member) => member.name(),
            Self::QuadraticPrecision => "quadratic-precision",
            Self::Linear => "linear",
        }
    }
}

/// An interpolant with its cells' polynomials.
pub type AnyPieces<'a, const CORNERS: usize> = Box<dyn Pieces<CORNERS> + 'a>;

/// Interpolants of a field on a mesh, by their names.
pub trait NamedInterpolants<const CORNERS: usize>: HasFamily<CORNERS> {
    /// One of those that are contoured.
    fn interpolant<'a>(
        &'a self,
        kind: InterpolantKind,
        field: Field<'a>,
        equation: Option<&Equation>,
    ) -> AnyPieces<'a, CORNERS>;

    /// The one that the interpolant is compared with.
    ///
    /// # Errors
    /// If there is none of that name on such cells, or it needs a PDE and there is none.
    fn second<'a>(
        &'a self,
        which: SecondInterpolant,
        field: Field<'a>,
        equation: Option<&Equation>,
    ) -> Result<AnyPieces<'a, CORNERS>, FilterError> {
        let kind = match which {
            SecondInterpolant::QuadraticPrecision => InterpolantKind::QuadraticPrecision,
            SecondInterpolant::Linear => InterpolantKind::Linear,
            SecondInterpolant::Member(member) => {
                let what = format!("the second interpolant '{}'", member.name());
                let equation = equation.ok_or(FilterError::NeedsPde { what })?;
                return Ok(self.member(member, field, equation)?.pieces);
            }
        };
        Ok(self.interpolant(kind, field, None))
    }
}

impl NamedInterpolants<3> for TriangleMesh<'_> {
    fn interpolant<'a>(
        &'a self,
        kind: InterpolantKind,
        field: Field<'a>,
        equation: Option<&Equation>,
    ) -> AnyPieces<'a, 3> {
        match (kind, equation) {
            (InterpolantKind::Linear, _) => Box::new(Linear::new(self, field.values)),
            (InterpolantKind::QuadraticPrecision, _) => {
                Box::new(Pci::with_quadratic_precision(self, field))
            }
            (InterpolantKind::Pci, None) => Box::new(Pci::new(self, field)),
            (InterpolantKind::Pci, Some(equation)) => {
                Box::new(Pci::with_pde(self, field, equation))
            }
        }
    }
}

impl NamedInterpolants<4> for TetrahedronMesh<'_> {
    fn interpolant<'a>(
        &'a self,
        kind: InterpolantKind,
        field: Field<'a>,
        equation: Option<&Equation>,
    ) -> AnyPieces<'a, 4> {
        match (kind, equation) {
            (InterpolantKind::Linear, _) => Box::new(Linear::new(self, field.values)),
            (InterpolantKind::QuadraticPrecision, _) => {
                Box::new(Tricubic::with_quadratic_precision(self, field))
            }
            (InterpolantKind::Pci, None) => Box::new(Tricubic::new(self, field)),
            (InterpolantKind::Pci, Some(equation)) => {
                Box::new(Tricubic::with_pde(self, field, equation))
            }
        }
    }
}
