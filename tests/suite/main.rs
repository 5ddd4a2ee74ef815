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
#[cfg(feature = "cli")]
mod check_catalogue;
#[cfg(feature = "mp")]
mod columns;
#[cfg(feature = "cli")]
mod command;
#[cfg(feature = "cli")]
mod command_data;
#[cfg(all(feature = "cli", feature = "mp"))]
mod command_ends;
#[cfg(feature = "cli")]
mod command_errors;
#[cfg(feature = "cli")]
mod command_samples;
mod common;
#[cfg(feature = "cli")]
mod compare_command;
#[cfg(feature = "cli")]
mod compare_contacts;
#[cfg(feature = "cli")]
mod compare_fits;
#[cfg(feature = "cli")]
mod compare_peers;
#[cfg(feature = "cli")]
mod compare_reading;
#[cfg(feature = "cli")]
mod compare_verdicts;
mod conformance;
#[cfg(feature = "cli")]
mod cost_measured;
mod damped_bounce;
mod damped_history;
mod damped_properties;
mod damped_reference;
mod damped_settling;
mod damped_solve;
mod damped_stiff;
#[cfg(all(feature = "cli", feature = "mp"))]
mod derivatives;
#[cfg(all(feature = "cli", feature = "mp"))]
mod derivatives_at;
mod door;
#[cfg(feature = "cli")]
mod endings;
#[cfg(feature = "mp")]
mod examples_run;
mod first_contact_bounce;
mod first_contact_energy;
mod first_contact_paper;
mod first_contact_reference;
mod first_contact_undamped;
#[cfg(all(feature = "cli", feature = "mp", target_os = "linux"))]
mod guide;
mod hard_cases;
#[cfg(feature = "mp")]
mod near_coincidences;
#[cfg(feature = "mp")]
mod near_thresholds;
#[cfg(feature = "mp")]
mod number_interval;
mod paper_claims;
#[cfg(feature = "cli")]
mod peers;
#[cfg(feature = "cli")]
mod pictures;
mod problem_builder;
mod rates;
mod referee;
#[cfg(all(feature = "cli", feature = "mp"))]
mod reference;
#[cfg(feature = "mp")]
mod same_value;
mod scene_builtin;
mod scene_errors;
mod scene_properties;
#[cfg(feature = "cli")]
mod schema;
#[cfg(feature = "mp")]
mod slices_properties;
mod snapshots_stress;
mod start_above;
mod stripped;
#[cfg(feature = "cli")]
mod sweep;
#[cfg(all(feature = "cli", target_os = "linux"))]
mod terminal;
mod three_routes;
#[cfg(feature = "mp")]
mod undamped_bounds;
#[cfg(feature = "mp")]
mod undamped_coincidences;
#[cfg(feature = "mp")]
mod undamped_properties;
mod undamped_reference;
