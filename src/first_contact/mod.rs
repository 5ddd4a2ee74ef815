//! The first contact in closed form: stress, bounce, motion, energy and field as the paper has them.

mod undamped;

pub use undamped::Undamped;
