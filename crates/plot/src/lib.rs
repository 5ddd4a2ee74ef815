//! Pictures of histories: what is asked of them, and how it is drawn.

mod cells;
pub mod draw;
mod drawing;
mod gather;
mod picture;
mod pictures;
mod rod;

pub use draw::Canvas;
pub use drawing::{Drawing, Drawn, heading};
pub use gather::{Asked, Gathered};
pub use picture::{Along, Picture};
pub use pictures::sheet;
pub use rod::{Pose, Sizes};
