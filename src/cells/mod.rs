//! The damped rod, any number of impacts: characteristic cells, the contact law, marching.
//!
//! In reading order: `series` holds functions, `cell` carries the invariants through one cell, `march` through one
//! strip; `start` makes the first state from the data at `t = 0` and `bounce` from the closed form of the first
//! contact; `flight` takes a flight apart into centre of mass and vibration, and `leap` goes over many of its round
//! trips at once. `root` finds events, `near` what the bound leaves open of them, `effort` limits a run, `follow`
//! decides what happens at the ground, `long_flight` where a leap is due, `event` does it, `piece` is what remains of
//! it, `budget` adds up what all of it may be off by, with the signs that `dependence` follows; `proof` proves each
//! event by its `signs`, from the `account` of the `defect` of each step; `rest` says when nothing more can happen.
//! `record` gets the field back, from cells that `strips` keeps for the next question, `history` answers questions,
//! `bounds` gives the answers the bounds that the `uncertainty` of the run makes of them, `contact_then_cells` puts the
//! closed form of the first contact before them.

mod account;
mod bounce;
mod bounds;
mod budget;
mod cell;
mod contact_then_cells;
mod defect;
mod dependence;
#[cfg(test)]
#[path = "tests/displaced.rs"]
mod displaced;
mod effort;
mod event;
mod flight;
mod follow;
mod history;
mod leap;
mod long_flight;
mod march;
mod near;
mod piece;
mod proof;
mod record;
mod rest;
mod root;
mod series;
mod signs;
mod start;
mod strips;
mod uncertainty;
#[cfg(test)]
#[path = "tests/wide.rs"]
mod wide;

pub use contact_then_cells::ContactThenCells;
pub(crate) use effort::{Effort, MARCHED_TRIPS, MOST_DIGITS, Task};
pub use history::Damped;
