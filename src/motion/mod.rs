//! Data of a motion (events, contacts, endings, fields, waves, moments) and the queries that every engine answers.

mod at_start;
mod course;
mod listed_rays;
mod maps;
pub(crate) mod moments;
mod passing;
mod query;
mod register;
mod repeated_rays;
mod straight;
mod wave;

pub(crate) use at_start::{AtStart, Datum, Segment};
pub use course::{Contact, Course, Ending, Energy, Event, EventKind, Side, StressHistory, StressPiece};
pub(crate) use maps::maps;
pub use passing::Passing;
pub use query::{Motion, Pair, Scales, unobserved};
pub(crate) use query::{by_time, partition};
pub use register::RayRegister;
pub use straight::straight;
pub use wave::{Field, Ray, Stretch, WavePiece, Waves, reflection};
