//! The paper's formulas as they are printed: an independent opinion, and the only place where a formula stands a second
//! time.
//!
//! | module | |
//! |---|---|
//! | `undamped` | the closed forms of `r = 0` |
//! | `printed` | the integrals of the damped first contact, by adaptive quadrature |
//! | `formulas` | thresholds, limits and the flight, as printed or as they follow from the print |
//! | `bessel` | Bessel functions by the integral (2.16) |
//! | `quadrature` | adaptive Gauss–Kronrod |

mod bessel;
#[cfg(feature = "cli")]
pub(crate) mod formulas;
mod printed;
mod quadrature;
mod undamped;

pub use printed::Printed;
pub use undamped::UndampedContact;
