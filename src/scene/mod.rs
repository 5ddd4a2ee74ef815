//! A scene: what a person wrote in a file, checked, with the line of every value.
//!
//! A scene is a TOML file. A number in it is a TOML number or a string such as `"1/3"`, and stands for exactly the
//! rational that it spells.
//!
//! ```toml
//! title = "A rod dropped on the ground"
//! units = "SI"          # or "in-lbf-s", "mm-N-s", "other": names what is printed, with modulus and density
//! [rod]
//! length = 1            # L
//! wave_speed = 1        # c; or modulus and density: then c = √(modulus/density); area, or else forces are per area
//! damping = 0           # r; absent or 0: no damping
//! top = "free"          # or "fixed"
//! [impact]
//! speed = 3             # μ at the touch, which is t = 0; or drop_height, with gravity
//! gap = 0               # the rod starts so far above the ground, at t = 0, with its speed; absent or 0: at the touch
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
//! # Where the clock starts
//! Every time is counted from the start of the scene. With `speed` or `drop_height` alone that is the first touch of
//! the ground: the fall from `drop_height` is over by then. With a `gap` the undeformed rod is that far above the
//! ground at `t = 0`, every point of it moving down with `speed` (which may be zero under gravity); gravity and damping
//! act while it falls, `h″ + 2r h′ = −g`, and the first impact is the touch. Under a fixed top the rod is stopped there
//! at `t = 0`, and hangs from `v(L,t) = gap`: its lower end may touch or not.
//!
//! ```
//! use dalembert::Scene;
//! let scene = Scene::parse("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 2, gap = 3 }\n")?;
//! let history = scene.problem.solve()?;
//! assert_eq!((history.contacts()[0].from, history.contacts()[0].to), (1.5, Some(3.5))); // gap/μ, and 2L/c more
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Published values
//! A scene may list what others have published of it; `dalembert scenes NAME --targets` prints it beside ours. With a
//! `time` the quantity is a [quantity over time](crate::Quantity) by its name, such as `u_end`, `stress` or `E_total`, but
//! for the impulse; without a time one of a contact, such as `impact` and `release` (times), `duration`, `impulse`,
//! `peak_force` or `e_E2`.
//!
//! ```toml
//! [[target]]
//! quantity = "u_top"
//! time = 8e-5
//! side = "right"        # the limit, where there are two
//! origin = "start"      # displacements are counted from the ground, or from where the rod starts
//! published = -4.0e-3
//! within = 1e-9         # how far it may be off; absent: half a unit of its last digit
//! source = "deck sdnv100a"
//! [[target]]
//! quantity = "release"
//! contact = 2           # absent: the first
//! published = 3.3333
//! source = "by hand"
//! ```
//!
//! # Limits
//! Those of a [problem](crate::problem#limits), an accuracy of 1e-300 … 0.1, and at most 16 MiB of text.

pub mod builtin;
mod effects;
mod error;
mod read;
mod reader;
mod suggest;
mod target;

pub use effects::{Effect, EffectUse};
pub use error::{SceneError, SceneErrorKind};
pub use read::Scene;
pub use target::Target;
