//! Special functions in any precision: scaled Bessel functions, the sums over `ψ_n` that a ray carries, `φ`
//! functions, Gauss–Legendre.

#[cfg(feature = "mp")]
mod backward;
mod bessel;
mod enclosed;
mod gauss;
#[cfg(feature = "mp")]
mod gauss_enclosed;
#[cfg(feature = "mp")]
mod many;
mod phi;
mod precision;
mod ray;

pub use bessel::{i0_scaled, i1_scaled, in_scaled};
#[cfg(feature = "mp")]
pub(crate) use enclosed::confluent;
pub use gauss::gauss_legendre;
#[cfg(feature = "mp")]
pub use many::{in_bounded, in_scaled_bounded, psi_bounded};
pub use phi::{log_mean, log_rest, phi1, phi2};
use precision::bits;
pub(crate) use precision::{negative_power, roundoff};
pub use ray::{Ray, RaySums};
