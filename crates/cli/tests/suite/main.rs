//! All tests of the command, one program: it is linked once, and what several files need is compiled once.
//!
//! `cargo test -p dalembert-cli --test suite compare` runs the tests whose path holds that word.
#![allow(clippy::approx_constant, clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::useless_conversion)]

#[cfg(target_os = "linux")]
mod benchmarks;
mod chain_bodies;
mod check_catalogue;
mod command;
mod command_data;
mod command_ends;
mod command_errors;
mod command_samples;
#[path = "../../../../tests/suite/common.rs"]
mod common;
mod compare_bars;
mod compare_command;
mod compare_contacts;
mod compare_fits;
mod compare_reading;
mod compare_soft;
mod cost_measured;
#[path = "../../../../tests/suite/cuts.rs"]
mod cuts;
mod derivatives;
mod derivatives_at;
mod endings;
#[cfg(target_os = "linux")]
mod guide;
mod newcomers;
mod orbits;
mod pictures;
mod reference;
mod scene_errors;
mod schema;
mod sweep;
#[cfg(target_os = "linux")]
mod terminal;
