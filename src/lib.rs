//! The exact reference for the bouncing elastic rod: `v_tt + 2r v_t − c² v_xx = −g` on `0 < x < L`, unilateral contact
//! with the ground at `x = 0`, solved by the method of characteristics.
//!
//! ```
//! use dalembert::{Problem, Side};
//!
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
//! let history = rod.solve()?;
//! // Until the wave comes back, v_x(0,t) = −(μ + g t)/c.
//! assert_eq!(history.strain(1, Side::Right)?, -4.0);
//! // Corollary 1: μ = 3 ≥ g t₁ = 2, so the contact lasts exactly t₁ = 2L/c.
//! assert_eq!(rod.exact()?.contacts()[0].release, Some(2.into()));
//! # Ok::<(), dalembert::Error>(())
//! ```
//!
//! A [`Problem`] is the physics in exact numbers, from its builder or a [`Scene`] file. A [`Question`] says what is
//! asked of it and in which [`Numbers`]. The [`Plan`] decides everything before running: engine, numbers, bits, how
//! far. A [`History`] is the answer: events, contacts, and the value of every quantity at any time, each settled to the
//! digits that were asked for.
//!
//! | | in which numbers | what it promises |
//! |---|---|---|
//! | [`Problem::solve`] | doubles | the bound of each number is carried; longer numbers where it is too wide |
//! | [`Problem::digits`] | decimal digits | rounded once from values known to more |
//! | [`Problem::exact`] | fractions | no error, as far as they reach; undamped rods |
//! | [`Problem::certified`] | enclosures | every digit is proved; `docs/proofs.md` says what of |
//!
//! A rod of one's own, here in SI units, through ten impacts, and the force of the ground at the times of a test. What
//! a scene file says is `Scene::parse(&text)?.problem`.
//!
//! ```
//! use dalembert::{Problem, Quantity, Side};
//!
//! let ruler = Problem::builder().length("0.3").material(10e9, 700, "6e-5").gravity("9.81").drop_height("0.1");
//! let history = ruler.impacts(10).build()?.doubles()?;
//! assert_eq!(history.contacts().len(), 10);
//! let force = &history.columns(&[Quantity::Force], &[1e-5, 1e-3], Some(Side::Right))?[0];
//! // (μ + g t) S √(E ρ) with μ = √(2 g 0.1) = 1.400714, and nothing in flight.
//! assert!((force[0] - 222.3720).abs() < 1e-4 && force[1] == 0.0);
//! # Ok::<(), dalembert::Error>(())
//! ```
//!
//! [`Problem::doubles`], [`Problem::exact`], [`Problem::digits`] and [`Problem::certified`] answer in one number
//! system: a [`TypedHistory`] in fractions is asked at fractions, `exact.at("1/2".parse()?, "1".parse()?)?`. An
//! [`Interval`] has its ends, `lo()` and `hi()`, and `{}` prints the digits that both prove.
//!
//! The types in daily use stand at the root. The rest of each subject is in its module: [`problem`], [`solve`],
//! [`quantity`], [`reason`] (reasons for the end of a run, and warnings), [`chain`] (several bodies), [`orbits`]
//! (motions that repeat themselves). [`engine`] has the engines by themselves, [`number`] the number systems,
//! [`special`] the functions of the closed forms.
//!
//! Equation numbers are those of F. Wang and S. W. Hansen, *Explicit solutions and coefficient of restitution for an
//! elastic rod with viscous damping*, IMA Preprint 2473, Institute for Mathematics and its Applications, University of
//! Minnesota, August 2016: "the paper" throughout.
//!
//! The feature `mp` computes fractions and long numbers with GMP and MPFR: faster, above all in hundreds of digits.
//! Without the default feature `long` an answer in doubles takes no longer numbers, or with `wide` those of 128 bits
//! alone, and a program that asks for no others is a third as large, or less than half. Without the default feature
//! `chain` the bodies of a chain are not solved as rods, and [`Error::NoChains`] says so.

#[cfg(test)]
extern crate self as dalembert;

mod cells;
pub mod chain;
pub mod engine;
mod error;
mod first_contact;
mod lattice;
mod motion;
mod names;
pub mod number;
pub mod orbits;
pub mod problem;
pub mod quantity;
pub mod reason;
mod scene;
pub mod solve;
pub mod special;
mod threads;

pub use error::Error;
pub use glam;
pub use motion::{Contact, Ending, Energy, Event, EventKind, Field, Ray, Side, StressHistory, StressPiece};
pub use names::{UnknownName, nearest};
pub use number::{Bound, Estimate, Float, Interval, Number, Rational, Value};
pub use problem::{Material, Parameter, Parameters, Problem, Profile, Run, Speed, Start, Top};
pub use quantity::{Quantity, Units};
pub use reason::{Reason, Warning};
#[cfg(feature = "mp")]
pub use rug;
pub use scene::{
    ChainScene, ChainTarget, Effect, EffectUse, Publication, Published, Scene, SceneError, Target, builtin,
};
pub use solve::{Derivative, Engine, History, Numbers, Observer, Plan, Question, TypedHistory};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
