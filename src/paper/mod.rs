//! The paper's formulas as they are printed: an independent opinion, and the only place where a formula stands a second
//! time.
//!
//! | module | |
//! |---|---|
//! | `undamped` | the closed forms of `r = 0` |
//! | `printed` | the integrals of the damped first contact, by adaptive quadrature; Bessel functions by (2.16) |
//! | `formulas` | thresholds, limits and the flight, as printed or as they follow from the print |
//! | `quadrature` | adaptive Gauss–Kronrod |

#[cfg(feature = "cli")]
pub(crate) mod formulas;
mod printed;
mod quadrature;
mod undamped;

pub use printed::Printed;
pub use undamped::UndampedContact;
