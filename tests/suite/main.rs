//! All integration tests, one program: the library is linked once, and what several files need is compiled once.
//!
//! `cargo test --test suite lattice` runs the tests whose path holds that word.
#![allow(clippy::approx_constant, clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::useless_conversion)]

mod any_scene;
mod asked_times;
mod certified_damped;
mod certified_first_contact;
mod certified_undamped;
mod chain_bodies;
mod chain_coincidences;
mod chain_derivatives;
mod chain_masses;
mod chain_published;
mod chain_soft;
mod chain_soft_random;
mod chain_stiff;
mod chain_touching;
// Tests run in the order of their names: the longest one is among the first.
mod chaotic;
mod columns;
mod common;
mod conformance;
mod conformance_long;
mod cuts;
mod damped_bounce;
mod damped_history;
mod damped_properties;
mod damped_reference;
mod damped_settling;
mod damped_solve;
mod damped_stiff;
mod door;
mod examples_run;
mod first_contact_bounce;
mod first_contact_energy;
mod first_contact_paper;
mod first_contact_reference;
mod first_contact_undamped;
mod hard_cases;
mod near_coincidences;
mod near_thresholds;
mod number_interval;
mod paper_claims;
mod piece_ends;
mod problem_builder;
mod random_chain;
mod rates;
mod referee;
mod refused_values;
mod same_value;
mod scene_builtin;
mod scene_properties;
mod slices_properties;
mod snapshots_stress;
mod spelled_times;
mod start_above;
mod strained;
mod stripped;
mod three_routes;
mod undamped_bounds;
mod undamped_coincidences;
mod undamped_properties;
mod undamped_reference;
mod values;
