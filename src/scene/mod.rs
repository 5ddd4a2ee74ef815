//! A scene: what a person wrote in a file, checked, with the line of every value.

pub mod builtin;
mod chain;
mod chain_effects;
mod chain_ends;
mod effects;
mod error;
mod publication;
mod read;
mod reader;
mod serde;
mod suggest;
mod target;

pub use chain::ChainScene;
pub use effects::{Effect, EffectUse};
pub use error::SceneError;
pub use publication::Publication;
pub use read::Scene;
pub use target::{ChainTarget, Published, Target};
