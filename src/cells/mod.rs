//! The damped rod, any number of impacts: characteristic cells, the contact law, marching.
//!
//! In reading order: `series` holds functions, `cell` carries the invariants through one cell, `march` through one
//! strip, `start` makes the first state from the data at `t = 0` and `bounce` from the closed form of the first contact, `root` finds events, `follow` decides what happens at the ground,
//! `rest` when nothing more can happen, `record` gets the field back, `history` answers questions, and `joined` puts the closed form of the first
//! contact before it.

mod bounce;
mod budget;
mod cell;
mod flight;
mod follow;
mod history;
mod joined;
mod leap;
mod march;
mod record;
mod rest;
mod root;
mod series;
mod start;

pub use history::Damped;
pub use joined::{Joined, Reach};
