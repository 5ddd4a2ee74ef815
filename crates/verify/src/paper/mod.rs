//! Formulas of the paper as printed: a second opinion on the library, and the only place of the workspace where a
//! formula stands a second time.

pub(crate) mod formulas;
mod integrals;
mod quadrature;
mod release;
mod undamped_contact;

pub use integrals::PrintedIntegrals;
pub(crate) use release::first_release;
pub use undamped_contact::UndampedContact;
