//! Members of the thesis' family of interpolants by their names, beside those that are contoured.

use super::error::FilterError;
use super::second_interpolant::AnyPieces;
use crate::field::Field;
use crate::interpolant::family::{CollocationPoints, Dei, DeiOptions, Space, spaces};
use crate::interpolant::{Equation, Pieces};
use crate::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh};

/// An interpolant that satisfies the PDE at as many points of each cell as determine its
/// polynomial: a [space](crate::interpolant::family::spaces) of the family by its name.
///
/// Neighbours agree at points only (the bicubic on rectangles also along their sides).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FamilyMember {
    /// The standard DEI: bicubic, on triangles and on rectangles.
    Dei,
    /// The same with its collocation points searched in each cell.
    Adei,
    /// Bicubic of total degree four.
    Dei3_13,
    /// Bicubic of total degree five.
    Dei3_15,
    /// The pure quartic on triangles.
    Pqi,
    /// The full quartic on triangles.
    Fqi,
    /// The thesis' own tri-cubic in tetrahedra.
    P3,
    /// The triquadratic in tetrahedra.
    P2,
    /// The triquadratic of total degree three.
    P2Hat,
}

/// A member's pieces.
pub struct MemberPieces<'a, const CORNERS: usize> {
    /// The pieces.
    pub pieces: AnyPieces<'a, CORNERS>,
    /// Of how many cells the PDE does not determine the polynomial.
    pub singular: usize,
}

impl FamilyMember {
    /// All, those on triangles first.
    pub const ALL: [Self; 9] = [
        Self::Dei,
        Self::Adei,
        Self::Dei3_13,
        Self::Dei3_15,
        Self::Pqi,
        Self::Fqi,
        Self::P3,
        Self::P2,
        Self::P2Hat,
    ];

    /// Its name, as options have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dei => "dei",
            Self::Adei => "adei",
            Self::Dei3_13 => "dei3-13",
            Self::Dei3_15 => "dei3-15",
            Self::Pqi => "pqi",
            Self::Fqi => "fqi",
            Self::P3 => "p3",
            Self::P2 => "p2",
            Self::P2Hat => "p2-hat",
        }
    }

    fn options(self) -> DeiOptions {
        let points = match self {
            Self::Adei => CollocationPoints::Searched { seed: 0 },
            _ => CollocationPoints::Chosen,
        };
        DeiOptions { points, ..DeiOptions::default() }
    }
}

/// Cells on which the family has members.
pub trait HasFamily<const CORNERS: usize> {
    /// A member on these cells.
    ///
    /// # Errors
    /// If there is none of that name on such cells.
    fn member<'a>(
        &'a self,
        which: FamilyMember,
        field: Field<'a>,
        equation: &Equation,
    ) -> Result<MemberPieces<'a, CORNERS>, FilterError>;
}

impl HasFamily<3> for TriangleMesh<'_> {
    fn member<'a>(
        &'a self,
        which: FamilyMember,
        field: Field<'a>,
        equation: &Equation,
    ) -> Result<MemberPieces<'a, 3>, FilterError> {
        let options = which.options();
        Ok(match which {
            FamilyMember::Dei | FamilyMember::Adei => {
                of_space(spaces::DEI, self, field, equation, &options)
            }
            FamilyMember::Dei3_13 => of_space(spaces::DEI3_13, self, field, equation, &options),
            FamilyMember::Dei3_15 => of_space(spaces::DEI3_15, self, field, equation, &options),
            FamilyMember::Pqi => of_space(spaces::DEI4_15, self, field, equation, &options),
            FamilyMember::Fqi => of_space(spaces::FQI, self, field, equation, &options),
            FamilyMember::P3 | FamilyMember::P2 | FamilyMember::P2Hat => {
                return Err(FilterError::NotOnCells {
                    name: which.name(),
                    cells: "two-dimensional",
                    others: "dei, adei, dei3-13, dei3-15, pqi, fqi",
                });
            }
        })
    }
}

impl HasFamily<4> for TetrahedronMesh<'_> {
    fn member<'a>(
        &'a self,
        which: FamilyMember,
        field: Field<'a>,
        equation: &Equation,
    ) -> Result<MemberPieces<'a, 4>, FilterError> {
        let options = which.options();
        match which {
            FamilyMember::P3 => Ok(of_space(spaces::P3, self, field, equation, &options)),
            FamilyMember::P2 => Ok(of_space(spaces::P2, self, field, equation, &options)),
            FamilyMember::P2Hat => Ok(of_space(spaces::P2_HAT, self, field, equation, &options)),
            _ => Err(FilterError::NotOnCells {
                name: which.name(),
                cells: "solid",
                others: "p3, p2, p2-hat",
            }),
        }
    }
}

fn of_space<'a, const CORNERS: usize, const N: usize>(
    space: Space<CORNERS, N>,
    mesh: &'a SimplexMesh<'a, CORNERS>,
    field: Field<'a>,
    equation: &Equation,
    options: &DeiOptions,
) -> MemberPieces<'a, CORNERS>
where
    Dei<'a, CORNERS, N>: Pieces<CORNERS>,
{
    let dei = Dei::new(space, mesh, field, equation, options);
    MemberPieces { singular: dei.singular(), pieces: Box::new(dei) }
}
