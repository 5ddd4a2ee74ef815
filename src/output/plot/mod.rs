//! Pictures of histories: what is asked of them, and how it is drawn.
//!
//! | file | |
//! |---|---|
//! | `picture` | which pictures there are |
//! | `gather` | answers of a history over the span that is drawn |
//! | `cells` | the field along the rod: polygons between the rays |
//! | `pictures` | panels of answers |

mod cells;
mod gather;
mod picture;
mod pictures;

pub(crate) use gather::{Asked, Gathered};
pub(crate) use picture::{Along, Picture};
pub use pictures::scene_svg;
pub(crate) use pictures::sheet;
