//! Independent opinions on the numbers of `dalembert`.
//!
//! - [`paper`]: the formulas of the paper as printed, by quadrature or in fractions.
//! - [`modal`]: the first contact as a sum over the modes of the rod, with a proved bound.
//! - `routes`: every way to one number of a problem, among them finite differences; [`RouteQuestion`] asks for it, and
//!   [`ChainQuestion`] for one of a whole chain.
//! - [`check`]: the catalogue of hard cases and of the paper's claims, each answered by every route that can.
//! - [`cost`]: the time that accuracy costs on each route, and the time that each effect of a scene costs.
//! - [`published`]: values that others have published of a scene, beside those of its history.
//! - [`figures`]: the numbers of the paper's figures, reproduced and corrected.
//! - [`regimes`]: the map of how the first contact ends, and grids of parameter values.
//!
//! ```
//! use dalembert::{Parameters, Side};
//! use dalembert_verify::{modal::Modal, paper::PrintedIntegrals};
//! // Without damping the stress in the first round trip is −(μ + g t)/c: −(3 + 1)/1 at t = 1.
//! let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 3.0 };
//! let by_modes = Modal::new(&rod, 64).strain(&1.0, Side::Right);
//! assert!((by_modes.value() + 4.0_f64).abs() <= by_modes.bound());
//! assert!((PrintedIntegrals::new(&rod, 1e-10).strain(1.0) + 4.0).abs() < 1e-12);
//! ```

pub mod check;
pub mod cost;
mod error;
pub mod figures;
pub mod modal;
pub mod paper;
pub mod published;
pub mod regimes;
mod routes;

pub use error::VerifyError;
pub use routes::{ChainQuestion, RouteQuestion, Truth};
