//! All integration tests, one program: the library is linked once, and what several files need is compiled once.
//!
//! `cargo test --test suite lattice` runs the tests whose path holds that word.
#![allow(clippy::approx_constant, clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::useless_conversion)]

#[cfg(feature = "mp")]
mod any_scene;
#[cfg(feature = "mp")]
mod asked_times;
#[cfg(feature = "mp")]
mod certified_damped;
#[cfg(feature = "mp")]
mod certified_first_contact;
#[cfg(feature = "mp")]
mod certified_undamped;
// Tests run in the order of their names: the longest one is among the first.
#[cfg(feature = "mp")]
mod chaotic;
#[cfg(feature = "mp")]
mod columns;
mod common;
mod conformance;
mod damped_bounce;
mod damped_history;
mod damped_properties;
mod damped_reference;
mod damped_settling;
mod damped_solve;
mod damped_stiff;
mod door;
#[cfg(feature = "mp")]
mod examples_run;
mod first_contact_bounce;
mod first_contact_energy;
mod first_contact_paper;
mod first_contact_reference;
mod first_contact_undamped;
mod hard_cases;
#[cfg(feature = "mp")]
mod near_coincidences;
#[cfg(feature = "mp")]
mod near_thresholds;
#[cfg(feature = "mp")]
mod number_interval;
mod paper_claims;
mod problem_builder;
mod rates;
mod referee;
#[cfg(feature = "mp")]
mod same_value;
mod scene_builtin;
mod scene_properties;
#[cfg(feature = "mp")]
mod slices_properties;
mod snapshots_stress;
mod start_above;
mod stripped;
mod three_routes;
#[cfg(feature = "mp")]
mod undamped_bounds;
#[cfg(feature = "mp")]
mod undamped_coincidences;
#[cfg(feature = "mp")]
mod undamped_properties;
mod undamped_reference;
mod values;
