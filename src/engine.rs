//! The engines by themselves, and what follows from any of them: for those who build on a motion rather than on a
//! [`History`](crate::History). Each implements [`Motion`], in the numbers that its `impl` names.

pub use crate::cells::Damped;
pub use crate::first_contact::{Bounce, BounceKind, ContactHistory, FirstContact, Kernels, Rebound, Trips};
pub use crate::lattice::{
    GroundEvent, GroundMotion, Halt, Limits, Line, Piece, Scaled, Trace, Undamped, Units, Until, march,
};
pub use crate::motion::{
    Course, Motion, Pair, Passing, RayRegister, Scales, Stretch, WavePiece, Waves, reflection, straight, unobserved,
};
