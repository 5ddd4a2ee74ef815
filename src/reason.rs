//! Reasons why a history ends, and warnings, as data.

use thiserror::Error;

use crate::number::Scalar;

/// The reason why nothing follows the end of a history, or why it is not known what follows. Times, speeds and heights
/// are in the units of the problem.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Reason {
    /// The first contact has no bounce.
    #[error(transparent)]
    NoBounce(NoBounceReason),
    /// Whether the first contact ends could not be shown.
    #[error(transparent)]
    Doubt(Doubt),
    /// Two whole round trips on the ground, or off it, repeat for ever.
    #[error(
        "the end {} two whole round trips, which repeat for ever",
        if *.contact { "stays on the ground for" } else { "does not come down in" }
    )]
    Repeats {
        /// Whether on the ground.
        contact: bool,
    },
    /// The ground end swings above the ground, from a time on, without ever reaching it.
    #[error(
        "from t = {} on the ground end swings by at most {swing:.3e}, ever less, about a height that is never \
         below {height:.3e}",
        short(.from)
    )]
    StaysAbove {
        /// The first time at which it holds.
        from: f64,
        /// A bound of the swing.
        swing: f64,
        /// A height that the middle of its swing never falls below.
        height: f64,
    },
    /// The waves pull less, from a time on, than the rod presses with at rest.
    #[error(
        "from t = {} on the waves pull with at most {part:.3} of what the rod presses with at rest, and they \
         never grow",
        short(.from)
    )]
    StaysPressed {
        /// The first time at which it holds.
        from: f64,
        /// A bound of the pull, as a part of that pressure.
        part: f64,
    },
    /// No part of the rod moves faster, from a time on, than the accuracy resolves.
    #[error("from t = {} on nothing moves faster than {speed:.1e}, which is within the accuracy{state}", short(.from))]
    Still {
        /// The first time at which it holds.
        from: f64,
        /// A bound of all velocities.
        speed: f64,
        /// The state that follows.
        state: StillState,
    },
    /// The next touch is not told from a miss.
    #[error(
        "within a round trip comes a touch that {bits} bits do not tell from a miss; either way v(0,t) is the same \
         up to {spread:.1e} for one round trip, and up to three times more after each one more"
    )]
    Touch {
        /// Bits of the numbers.
        bits: u32,
        /// Bound of the difference of `v(0,t)` in the round trip that follows.
        spread: f64,
    },
    /// The order of the next events of a chain is open.
    #[error("{bits} bits do not decide the order of the next events")]
    Order {
        /// Bits of the numbers.
        bits: u32,
    },
    /// The motion takes more than is computed of it.
    #[error(
        "after {cells} cells the motion is followed no farther: the rod carries {rays} rays, two for each bounce \
         that has not faded"
    )]
    Effort {
        /// Cells that were crossed.
        cells: u64,
        /// Rays that the rod carries.
        rays: usize,
    },
    /// Digits beyond those that the motion after a damped first contact is computed to.
    #[error("beyond {0} digits only the first contact is computed, not the flight after it")]
    MostDigits(u32),
}

/// The state of a motion below the accuracy.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StillState {
    /// The rod stands on the ground and presses as at rest.
    #[error(": the rod presses on the ground as it does at rest")]
    Pressed,
    /// The ground end stays at a height.
    #[error(": the ground end stays at the height {0:.6e}")]
    Above(f64),
    /// Later events are below the accuracy too.
    #[error(", and so is every event that may still come")]
    Faint,
    /// Whether another event comes takes more digits to tell.
    #[error(": whether the ground end still lets go or lands takes more digits to tell")]
    Open,
}

/// The reason why the stress of a first contact never becomes tensile.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NoBounceReason {
    /// Neither speed nor gravity.
    #[error("neither speed nor gravity: nothing moves")]
    NothingMoves,
    /// `R ≥ π`: the lowest mode is overdamped and outweighs all others from `t₁` on.
    #[error(
        "r t₁ = {damping_ratio:.6} ≥ π: the lowest mode is overdamped; at t₁ it presses {} times as hard as all \
         others together could pull, and it outgrows them from there",
        if *.margin < 1000.0 { format!("{margin:.3}") } else { "more than 1000".into() }
    )]
    Overdamped {
        /// `R = r t₁`.
        damping_ratio: f64,
        /// Ratio at `t₁` of the pressure of the lowest mode to the greatest pull of all others.
        margin: f64,
    },
    /// The transient can no longer lift what the static stress holds down.
    #[error(
        "from t = {trips} t₁ on the transient stays below {part:.4} of the static stress gL/c², and the rod \
         settles under its weight"
    )]
    SettlesUnderWeight {
        /// The first round trip at which it holds.
        trips: i64,
        /// A bound of the transient, as a part of the static stress `gL/c²`.
        part: f64,
    },
}

/// The reason why neither a bounce nor its absence could be shown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Doubt {
    /// An impact speed below zero, or a parameter that is not finite.
    #[error("an impact speed below zero, or a number that is not finite")]
    Parameters,
    /// Whether gravity or damping vanish, or which speed is greater, is not settled.
    #[error("whether a parameter is zero or greater than another one cannot be told")]
    Sizes,
    /// `r t₁` may be on either side of π.
    #[error("r t₁ cannot be told from π, from which on there is no bounce")]
    NearPi,
    /// Just after this lattice time the stress may have either sign.
    #[error("just after t = {0} t₁ the stress cannot be told from zero")]
    AtLattice(i64),
    /// The stress in the cell after this lattice time is below every number that the precision holds.
    #[error("between {} t₁ and {} t₁ the stress is below every number that this precision holds", .0, .0 + 1)]
    Faint(i64),
    /// Rounding reaches this part of the stress in the cell after this lattice time.
    #[error("between {} t₁ and {} t₁ rounding reaches {:.1e} of the stress", .0, .0 + 1, .1)]
    Rounding(i64, f64),
    /// Near this many round trips the stress may have either sign.
    #[error("near t = {0:.9} t₁ the stress cannot be told from zero")]
    NearZero(f64),
    /// `r t₁` is so close below π that the bounce comes after the cells that are searched.
    #[error(
        "r t₁ = {damping_ratio} is just below π: no bounce within the limit of {cells} round trips; without \
         gravity it comes at about {expected:.4e} t₁"
    )]
    Late {
        /// `R = r t₁`.
        damping_ratio: f64,
        /// Cells that are searched.
        cells: i64,
        /// About when it would come without gravity, in round trips.
        expected: f64,
    },
    /// No bounce in so many cells, which is all that are searched.
    #[error("no bounce in {0} round trips, which is the limit")]
    NoneFound(i64),
}

/// A warning that comes with an answer. Times are in the units of the problem.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Warning {
    /// The bound does not tell whether something happens at the ground; later bounds hold either way.
    #[error(
        "at t = {} {what}: the bounds do not tell; from then on velocities may differ by {differ:.1e}, which \
         later bounds include",
        .time.decimal(12)
    )]
    NotTold {
        /// The time.
        time: f64,
        /// The event that may happen.
        what: Near,
        /// Bound of the difference of velocities after it.
        differ: f64,
    },
    /// A time that was asked for is not told from that of an event or a ray; its values cover both sides.
    #[error("t = {time} is not told from the time of an event or a ray: its values cover both sides")]
    TimeNotTold {
        /// The time.
        time: f64,
    },
    /// The bound of the error no longer tells events apart.
    #[error("from t = {from} on the bound of the error no longer tells events apart")]
    EventsOverlap {
        /// The first time at which it holds.
        from: f64,
    },
    /// Events are not determined in the numbers that were asked for.
    #[error("from t = {} on, the events are not determined in this precision: ask for more digits", short(.from))]
    NotDetermined {
        /// The first time at which it holds.
        from: f64,
    },
    /// Two events, or an event and a ray, coincide within their error bounds and are taken for one.
    #[error(
        "from t = {} on, events and rays that coincide within their error bounds are taken for one; later bounds hold if \
         they do",
        short(.from)
    )]
    Coincidence {
        /// The first time at which it holds.
        from: f64,
    },
    /// Hops that are not told apart from contact, or touches from flight; the peak of a contact leaves out what lasts
    /// no longer.
    #[error(
        "from t = {} on hops shorter than {longest:.1e} are not told apart from contact, at {landings} {}",
        .from.decimal(9),
        if *.landings == 1 { "landing" } else { "landings" }
    )]
    HopsUnresolved {
        /// The first time at which it holds.
        from: f64,
        /// Upper bound on their duration.
        longest: f64,
        /// Number of landings that they may belong to.
        landings: usize,
    },
    /// Digits of a damped rod in more bits than its runs are proved in.
    #[error("these digits rest on an estimated bound: runs of a damped rod are proved in up to {most} bits")]
    NotProved {
        /// The greatest number of bits.
        most: u32,
    },
    /// A fall from `drop_height` that the damping would not let become so fast.
    #[error(
        "the speed at impact, √(2 g drop_height) = {}, takes no account of drag; with this damping no fall is \
         faster than g/2r = {}: a gap of this height with speed = 0 falls with the damping",
        .speed.decimal(3),
        .terminal.decimal(3)
    )]
    DragNeglected {
        /// `μ = √(2 g drop_height)`.
        speed: f64,
        /// `g/2r`.
        terminal: f64,
    },
    /// Damping that acts on the flights more than gravity does.
    #[error(
        "the damping 2r v_t acts on the whole rod, in flight as drag: {}; damping of the material, which leaves \
         flights alone, is not solved",
        match .terminal {
            Some(terminal) => format!(
                "the impact speed {} is above g/2r = {}, the greatest speed of a fall", .speed.decimal(3), terminal.decimal(3)
            ),
            None => format!("without gravity, it stops a rod at the speed {} within {}", .speed.decimal(3), .reach.decimal(3)),
        }
    )]
    DragDominates {
        /// `μ`, the speed at the first touch.
        speed: f64,
        /// `g/2r`; `None` without gravity.
        terminal: Option<f64>,
        /// `μ/2r`: the way after which drag alone stops the rod.
        reach: f64,
    },
    /// Derivatives by difference quotients or a cubic, which have no bound.
    #[error("the errors of the derivatives by {parameter} are estimates, no bounds")]
    EstimatedErrors {
        /// The value that was changed.
        parameter: String,
    },
    /// Strains of a material that the theory does not hold for.
    #[error(
        "the strain{} {} {}: beyond 1 the rod would fold, and linear elasticity does not hold; check the units of \
         the material and of velocities, such as GPa in place of Pa",
        .body.map(|body| format!(" of body {body}")).unwrap_or_default(),
        if .body.is_some() { "may reach" } else { "reaches" }, .strain.decimal(3)
    )]
    StrainAboveOne {
        /// The greatest `|v_x|` that is known; in a chain, that of the greatest speed of a body or end against a rigid
        /// wall.
        strain: f64,
        /// The number of the bar in a chain, from 1, the lowest.
        body: Option<usize>,
    },
}

/// An event that the bound of an error does not decide.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum Near {
    /// Whether the end, which comes as close to the ground as its bound, touches it.
    #[error("the end touches the ground or passes just above it")]
    Touch,
    /// Whether the end, where the stress comes as close to zero as its bound, lets go.
    #[error("the ground lets go or just holds")]
    Release,
    /// Whether an event comes before the end of the run.
    #[error("an event comes just before the end of the run or just after it")]
    End,
}

impl Near {
    /// Returns the question that it leaves open.
    pub(crate) fn question(self) -> &'static str {
        match self {
            Near::Touch => "whether the end touches the ground next",
            Near::Release => "whether the end lets go of the ground next",
            Near::End => "what follows the motion that has faded",
        }
    }
}

impl Warning {
    /// Returns whether more bits could settle it in a damped run.
    pub fn needs_bits(&self) -> bool {
        matches!(self, Warning::NotTold { .. } | Warning::HopsUnresolved { .. })
    }
}

impl Doubt {
    /// Returns whether more bits could settle it.
    pub fn needs_bits(&self) -> bool {
        !matches!(self, Doubt::Parameters | Doubt::Late { .. } | Doubt::NoneFound(_))
    }
}

/// Returns a time as text.
fn short(time: &f64) -> String {
    if *time == 0.0 || (1e-3..1e6).contains(time) {
        format!("{}", (time * 1e6).round() / 1e6)
    } else {
        format!("{time:.6e}")
    }
}
