//! A scene: what a person wrote in a file, checked, with the line of every value.
//!
//! A scene is a TOML file. A number in it is a TOML number or a string such as `"1/3"`, and stands for exactly the
//! rational that it spells.
//!
//! ```toml
//! title = "A rod dropped on the ground"
//! [rod]
//! length = 1            # L
//! wave_speed = 1        # c; or modulus, density and area: then c = √(modulus/density)
//! damping = 0           # r; absent or 0: no damping
//! top = "free"          # or "fixed"
//! [impact]
//! speed = 3             # μ; or drop_height, with gravity
//! [gravity]
//! acceleration = 1      # g; absent or 0: no gravity
//! [run]
//! time = 40             # or impacts = 3; absent: the first contact and the flight after it
//! accuracy = 1e-9       # optional
//! ```
//!
//! Instead of `[impact]` a scene may have a `[start]` that is not uniform along the rod, linear between points
//! `[x, value]` that run from `x = 0` to `x = length`; what is left out is zero. A velocity may jump: the same `x`
//! twice.
//!
//! ```toml
//! [start]
//! displacement = [[0, 0.5], [1, 0]]
//! velocity = [[0, 0], ["1/3", 0], ["1/3", -1], [1, -1]]
//! ```
//!
//! # Limits
//! Those of a [problem](crate::problem#limits), an accuracy of 1e-300 … 0.1, and at most 16 MiB of text.

pub mod builtin;
mod effects;
mod error;
mod read;
mod suggest;
mod target;

pub use effects::{Effect, EffectUse};
pub use error::{SceneError, SceneErrorKind};
pub use read::Scene;
pub use target::{Target, TargetQuantity};
