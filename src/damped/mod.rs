//! The damped rod, any number of impacts: characteristic cells, the contact law, marching.
//!
//! In reading order: [`series`] holds functions, [`cell`] carries the invariants through one cell, [`march`] through one
//! strip, [`start`] makes the first state, [`root`] finds events, [`follow`] decides what happens at the ground,
//! [`record`] gets the field back, and [`history`] answers questions.

mod cell;
mod follow;
mod history;
mod march;
mod record;
mod root;
mod series;
mod start;

pub use history::Damped;
