//! Proved numbers: histories whose every value is an enclosure.

mod closed_form;
mod first_contact;
mod peak;
mod pieces;
mod root;

pub use closed_form::ClosedForm;
pub use first_contact::ProvedContact;
