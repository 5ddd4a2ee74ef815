//! The damped rod, any number of impacts: characteristic cells, the contact law, marching.
//!
//! Reading order. `series` holds Chebyshev series, `cell` computes one cell and `march` one strip. `start` builds the
//! first state from the data at `t = 0`. `flight` separates a flight into centre of mass and vibration, `leap` computes
//! many round trips of it in one step. `root` finds events, `near` finds what the error bound leaves undecided about
//! them, `effort` limits a run. `follow` decides the events at the ground, `long_flight` decides when to leap, `event`
//! carries an event out, `piece` stores the result. `budget` adds up the error bound, with the signs that `dependence`
//! follows. `proof` proves each event by the `signs` of its series, from the `account` of the `defect` of each step.
//! `rest` proves that no event can follow. `record` computes the field again, from cells that `strips` caches,
//! `history` answers queries, `bounds` gives each answer the bound that follows from the `uncertainty` of the run.
//! `estimated_contact` is the closed form of a first contact with such bounds.

mod account;
mod bounds;
mod budget;
mod cell;
mod defect;
mod dependence;
#[cfg(test)]
#[path = "tests/displaced.rs"]
mod displaced;
mod effort;
mod estimated_contact;
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

pub(crate) use effort::{Effort, MOST_DIGITS, Task};
pub(crate) use estimated_contact::EstimatedContact;
pub use history::Damped;
