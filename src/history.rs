//! The answer as an object: what happened, and what can be asked of it.

use crate::error::Error;
use crate::number::Scalar;

/// Which of two values at a jump: the limit from earlier or from later times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Side {
    /// The limit from earlier times, `t⁻`.
    Left,
    /// The limit from later times, `t⁺`.
    #[default]
    Right,
}

/// What happens to the ground end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// It lands: contact begins.
    Impact,
    /// It leaves: contact ends.
    Release,
}

/// A change between contact and flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<S> {
    /// Landing or leaving.
    pub kind: EventKind,
    /// `t`.
    pub time: S,
    /// `v_t(0,t)`: just before an impact, just after a release. At a landing without speed that a ray turns into an impact,
    /// the `v_t + c v_x < 0` which that ray brings.
    pub end_velocity: S,
    /// `h(t)`: the centre of mass, relative to its place in the undeformed rod on the ground.
    pub centre: S,
    /// `h′(t)`.
    pub centre_velocity: S,
    /// How far `time` may be off, in its own unit: zero where it is exact.
    pub time_error: f64,
}

/// A time on the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact<S> {
    /// Its beginning.
    pub from: S,
    /// Its end; `None` where the history ends before.
    pub to: Option<S>,
    /// `−c² ∫ v_x(0,t) dt ≥ 0` over the contact: momentum per linear density that the ground gives.
    pub impulse: S,
    /// The most compressive `v_x(0,t)` of the contact, `≤ 0`.
    pub peak_stress: S,
}

/// The energies (3.54), (3.61)–(3.63), per linear density.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy<S> {
    /// `E = E_h + E_z`.
    pub total: S,
    /// `E_h = L h′²/2 + L g h`: the motion of the centre of mass.
    pub translational: S,
    /// `E_z = ½ ∫ ((v_t − h′)² + c² v_x²) dx`, a sum of squares.
    pub vibrational: S,
}

/// The displacement and its derivatives at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<S> {
    /// `v`.
    pub displacement: S,
    /// `v_t`.
    pub velocity: S,
    /// `v_x`.
    pub strain: S,
}

/// A stretch of the stress history `v_x(0,·)` without jump or kink.
#[derive(Clone, Debug, PartialEq)]
pub struct StressPiece<S> {
    /// Its beginning.
    pub from: S,
    /// Its end.
    pub to: S,
    /// `v_x(0, from⁺)`.
    pub left: S,
    /// `v_x(0, to⁻)`.
    pub right: S,
    /// Chebyshev coefficients of `v_x(0,·)` on the piece (first one whole, not halved); empty where it is linear.
    pub chebyshev: Vec<S>,
}

/// Why a history ends where it does.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// The time that was asked for.
    Time,
    /// The next impact after the contacts that were asked for.
    NextImpact,
    /// No impact can follow, for the reason that is said.
    NoFurtherImpact(String),
    /// No release can follow, for the reason that is said.
    NoBounce(String),
    /// The rod has come to rest, by the criterion that is said. Where a time was asked for, the history reaches it: as it
    /// does with [`Ending::NoBounce`] and [`Ending::NoFurtherImpact`] once the motion has faded below the accuracy.
    Rest(String),
    /// The next event is at no fraction.
    ExactnessEnds {
        /// The event.
        kind: EventKind,
        /// Its time as a surd, `3 + √2`.
        time: String,
        /// The nearest double.
        near: f64,
    },
    /// The first bounce: what follows it is not proved.
    Bounce,
    /// The asked accuracy or effort does not settle what comes next.
    Undecided(String),
}

impl std::fmt::Display for Ending {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Ending::Time => f.write_str("the time asked for"),
            Ending::NextImpact => f.write_str("the impact after the last contact asked for"),
            Ending::NoFurtherImpact(reason) => write!(f, "no further impact: {reason}"),
            Ending::NoBounce(reason) => write!(f, "no bounce: {reason}"),
            Ending::Rest(reason) => write!(f, "at rest: {reason}"),
            Ending::ExactnessEnds { time, near, .. } => {
                write!(f, "exactness ends before the impact at t = {time} ≈ {near}, which is no fraction")
            }
            Ending::Bounce => f.write_str("the first bounce: whether and when the rod lands again is not proved"),
            Ending::Undecided(reason) => write!(f, "undecided: {reason}"),
        }
    }
}

/// The scales of a motion: what its quantities are to be compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales<S> {
    /// `t₁`, of times; later times scale with themselves.
    pub time: S,
    /// About the greatest speed: `μ`, or `g t₁` where that is greater. Displacements scale with `time · velocity`, or with
    /// the greatest of them.
    pub velocity: S,
    /// `L`.
    pub length: S,
    /// `c`.
    pub wave_speed: S,
}

/// What can be asked of a solution. All times are absolute, in the units of the scene; a time outside of
/// `0 … end()` is [`Error::TimeOutside`], a point outside of the rod is [`Error::PointOutside`].
pub trait History<S: Scalar> {
    /// The last time that is known.
    fn end(&self) -> S;

    /// Why it is the last.
    fn ending(&self) -> &Ending;

    /// All impacts and releases, in order. The start at `t = 0` is the first impact where the rod stands on the ground.
    fn events(&self) -> &[Event<S>];

    /// All contacts, in order.
    fn contacts(&self) -> &[Contact<S>];

    /// `v_x(0,·)` from 0 to the end, pieces in order, canonical: neighbours that continue each other are one.
    fn stress_pieces(&self) -> Vec<StressPiece<S>>;

    /// `v_x(0,t)`: the stress at the ground divided by the modulus; zero in flight.
    fn stress(&self, time: &S, side: Side) -> Result<S, Error>;

    /// `v(0,t)` and `v_t(0,t)`.
    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error>;

    /// `v(L,t)` and `v_t(L,t)`.
    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error>;

    /// `h(t)` and `h′(t)`.
    fn centre(&self, time: &S) -> Result<(S, S), Error>;

    /// `E(t)`, `E_h(t)`, `E_z(t)`.
    fn energy(&self, time: &S) -> Result<Energy<S>, Error>;

    /// `v`, `v_t`, `v_x` at `(x,t)`.
    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error>;

    /// `t*` and `h(t*)`: where the centre of mass turns in the flight after `release`, if nothing ends the flight before.
    /// `None` where it does not turn: without gravity, under a fixed top, or already falling at the release.
    fn highest(&self, release: &Event<S>) -> Option<(S, S)>;

    /// The natural scales of the motion.
    fn scales(&self) -> Scales<S>;

    /// How far any quantity may be off, relative to its natural scale; zero where all is exact. The bound that the run carries,
    /// or, for a damped run in doubles that an accuracy was asked of, sixteen times what separates it from a second one.
    fn error_estimate(&self) -> S;

    /// How many impacts there were and `log₁₀` of the factor by which rounding may have grown over them; `None` where that is
    /// not followed.
    fn digits_lost(&self) -> Option<(u32, f64)> {
        None
    }

    /// What a user should know: events decided by rounding, digits lost. Data, for the caller to print.
    fn warnings(&self) -> &[String];
}
