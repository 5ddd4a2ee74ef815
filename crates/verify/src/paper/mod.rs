//! The paper's formulas as they are printed: an independent opinion, and the only place where a formula stands a second
//! time.
pub mod formulas;
mod printed;
mod quadrature;
mod undamped;

pub use printed::Printed;
pub use undamped::UndampedContact;
