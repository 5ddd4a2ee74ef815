//! Special functions, each under one name, implemented for each number system by [`Special`]: scaled Bessel functions,
//! sums over `ψ_n` along a ray, `φ` functions, Gauss–Legendre.

mod bessel;
mod enclosed;
mod estimated;
mod gauss;
mod hypergeometric;
mod long;
mod phi;
mod ray;
mod wide;

pub use bessel::{RoundedSpecial, Special, i0_scaled, i1_scaled};
pub use estimated::BoundedSpecial;
pub use gauss::gauss_legendre;
pub use phi::{log_mean, log_rest, phi1, phi2};
use ray::bits;
pub use ray::{Ray, RaySums, RoundedSums};
