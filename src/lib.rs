//! The exact reference for the bouncing elastic rod: `v_tt + 2r v_t − c² v_xx = −g` on `0 < x < L`, unilateral contact with the
//! ground at `x = 0`, solved by the method of characteristics.
//!
//! The data have one way through, and the modules follow it:
//!
//! | module | what it does |
//! |---|---|
//! | [`number`] | two traits, four number systems, exact text in and rounded text out |
//! | [`problem`] | the problem in exact numbers: rod, gravity, start, run; its builder and its checks |
//! | [`scene`] | from a scene file to a problem; which effects it calls for; the plan |
//! | [`solve`](mod@solve) | the engine that the plan chose, in the numbers that it chose |
//! | [`lattice`] | the undamped rod, from event to event on the characteristic lattice |
//! | [`first_contact`] | the first contact in closed form, the bounce time or why there is none, in estimates and enclosures |
//! | [`cells`] | the damped rod through any number of impacts, in characteristic cells |
//! | [`history`] | what a solution is, and everything that can be asked of it |
//! | [`modal`] | the modal sum of the first contact: a third route to the same numbers |
//! | [`quantity`] | restitution and flights |
//! | [`paper`] | the printed formulas, as an independent opinion |
//! | `compare` | routes held against each other and the truth: `check` and `cost` (feature `cli`) |
//! | `output`, `cli` | tables, JSON, CSV and the command (feature `cli`) |
//! | [`special`] | ψ_n, I_n, φ functions, Gauss–Legendre, in any precision |
//!
//! ```
//! use dalembert::{Ask, Plan, Scene, Solution, solve};
//!
//! let scene = Scene::parse("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 3 }\ngravity = { acceleration = 1 }")?;
//! let plan = Plan::of(&scene, Ask::default())?;
//! if let Solution::Double(history) = solve(&scene.problem, &plan, |_, _| ())? {
//!     // Corollary 1: μ = 3 ≥ g t₁ = 2, so the contact lasts exactly t₁ = 2L/c.
//!     assert_eq!(history.contacts()[0].to, Some(2.0));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod cells;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
mod compare;
pub mod error;
pub mod first_contact;
pub mod history;
pub mod lattice;
pub mod modal;
pub mod motion;
pub mod number;
#[cfg(feature = "cli")]
pub mod output;
pub mod paper;
pub mod problem;
pub mod quantity;
pub mod scene;
pub mod solve;
pub mod special;

pub use error::Error;
pub use glam;
pub use history::{Ending, EventKind, History, Side};
pub use motion::Motion;
pub use number::Number;
#[doc(hidden)]
pub use problem as rod;
pub use problem::{Parameters, Problem};
#[cfg(feature = "mp")]
pub use rug;
pub use scene::Scene;
pub use solve::{
    CERTIFIED_DIGITS, DEFAULT_ACCURACY, Engine, ExactnessEnd, Numbers, Observer, Plan, Question, Reach, Rung, Solution,
    Want,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
