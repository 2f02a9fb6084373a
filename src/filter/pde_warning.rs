//! What people should know of a PDE that is hardly the solution's.

use crate::interpolant::PdeFit;

/// A line if the PDE does not fit the values and gradients of what is contoured.
pub fn pde_warning(label: &str, fit: Option<PdeFit>) -> Option<String> {
    let fit = fit.filter(PdeFit::is_poor)?;
    let found = match fit.quotient() {
        Some(quotient) => format!("about {quotient:.2} times what the PDE says"),
        None => "not what the PDE says".to_owned(),
    };
    Some(format!(
        "the PDE does not fit the data: second derivatives of '{label}' by values and gradients \
         are {found}; check its signs, factors and units, or leave --pde out"
    ))
}
