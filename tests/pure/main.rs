//! The tests of `tests/suite` that need no MPFR, and digits and proofs, for the library in pure Rust.
//!
//! `cargo test --package dalembert --test pure` builds neither GMP nor MPFR.
#![allow(dead_code, reason = "a part of what the files share is used")]
#![allow(clippy::approx_constant, clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::useless_conversion)]

mod chains;
#[path = "../suite/common.rs"]
mod common;
#[path = "../suite/conformance.rs"]
mod conformance;
#[path = "../suite/damped_reference.rs"]
mod damped_reference;
#[path = "../suite/first_contact_paper.rs"]
mod first_contact_paper;
#[path = "../suite/first_contact_undamped.rs"]
mod first_contact_undamped;
mod long_numbers;
#[path = "../suite/paper_claims.rs"]
mod paper_claims;
#[path = "../suite/rates.rs"]
mod rates;
#[path = "../suite/referee.rs"]
mod referee;
#[path = "../suite/snapshots_stress.rs"]
mod snapshots_stress;
#[path = "../suite/stripped.rs"]
mod stripped;
#[path = "../suite/values.rs"]
mod values;
