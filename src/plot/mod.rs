//! Pictures of histories: what is asked of them, and how it is drawn.

#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports, reason = "the command draws more"))]

mod cells;
mod drawing;
mod gather;
mod picture;
mod pictures;
mod rod;

pub use crate::draw::Canvas;
pub(crate) use drawing::heading;
pub use drawing::{Drawing, Drawn};
pub(crate) use gather::{Asked, Gathered};
pub(crate) use picture::{Along, Picture};
pub(crate) use pictures::sheet;
pub use rod::{Pose, Sizes};
