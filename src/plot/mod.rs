//! Pictures of histories: what is asked of them, and how it is drawn.
//!
//! | file | |
//! |---|---|
//! | `picture` | which pictures there are |
//! | `gather` | answers of a history over the span that is drawn |
//! | `cells` | the field along the rod: polygons between the rays |
//! | `pictures` | panels of answers |
//! | `drawing` | one scene as one SVG |
//! | `rod` | the rod at one time |

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
