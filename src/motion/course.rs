//! Data of a motion: events, contacts, energies, pieces of the stress, and the reason of its end.

use std::fmt;

use serde::Serialize;
use thiserror::Error;

use super::maps::maps;
use crate::number::{Bounded, Scalar};
use crate::reason::{Near, Reason, Warning};

/// One of the two limits at a jump in time.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Serialize,
    strum::Display,
    strum::EnumMessage,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum Side {
    /// The limit from earlier times, `t⁻`; at the start, the given data.
    Left,
    /// The limit from later times, `t⁺`.
    #[default]
    Right,
}

impl Side {
    /// Returns the name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns the other side.
    pub(crate) fn other(self) -> Self {
        if self == Side::Left { Side::Right } else { Side::Left }
    }
}

/// Kind of an event at the ground end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::Display, strum::IntoStaticStr)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum EventKind {
    /// Contact begins: the end lands.
    Impact,
    /// Contact ends: the end leaves the ground.
    Release,
}

impl EventKind {
    /// Returns the name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A change between contact and flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<S> {
    /// Impact or release.
    pub kind: EventKind,
    /// The time `t`.
    pub t: S,
    /// `v_t(0,·)`: just before an impact, just after a release. If a ray turns a landing without speed into an impact,
    /// the `v_t + c v_x < 0` of that ray.
    pub v_end: S,
    /// `h(t)`: the position of the centre of mass, relative to its position in the undeformed rod on the ground.
    pub h: S,
    /// `h′(t)`.
    pub h_rate: S,
    /// Error bound of `t`; zero if `t` is exact.
    pub t_error: f64,
}

/// A period of contact between the end and the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact<S> {
    /// Time of the impact that begins the contact.
    pub impact: S,
    /// Time of the release that ends the contact; `None` if the history ends before.
    pub release: Option<S>,
    /// `−c² ∫ v_x(0,t) dt ≥ 0` over the contact: the momentum that the ground gives, per linear density `ρS`.
    /// [`History::units`](crate::History::units) returns the factor that converts it to the impulse on the rod.
    pub impulse: S,
    /// The most compressive strain `v_x(0,t)` of the contact, `≤ 0`; [`History::units`](crate::History::units) returns
    /// the factors that convert it to a stress and a force.
    pub peak_strain: S,
}

/// The energies (3.54), (3.61)–(3.63), per linear density `ρS`; [`History::units`](crate::History::units) returns the
/// factor that converts them to the energies of the rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy<S> {
    /// `E = E_h + E_z`.
    pub total: S,
    /// `E_h = L h′²/2 + L g h`: energy of the motion of the centre of mass.
    pub translational: S,
    /// `E_z = ½ ∫ ((v_t − h′)² + c² v_x²) dx`, a sum of squares.
    pub vibrational: S,
}

/// A piece of the stress history without jump or kink. Its values are strains `v_x(0,·)`: stress divided by the
/// modulus, see [`StressHistory`].
#[derive(Clone, Debug, PartialEq)]
pub struct StressPiece<S> {
    /// Its first time.
    pub start: S,
    /// Its last time.
    pub end: S,
    /// `v_x(0, start⁺)`.
    pub strain_start: S,
    /// `v_x(0, end⁻)`.
    pub strain_end: S,
    /// Chebyshev coefficients, the first one whole and not halved, of a polynomial near `v_x(0,·)` on the piece; empty
    /// where it is linear.
    ///
    /// In an answer the bound or enclosure of each one holds for that coefficient of `v_x(0,·)` itself. In an engine
    /// the first one alone has the distance of the polynomial from `v_x(0,·)`, as its sums are sharper so.
    pub chebyshev: Vec<S>,
}

maps!(pub Event { t, v_end, h, h_rate } keeps kind, t_error);
maps!(pub Contact { impact, impulse, peak_strain } maps release);
maps!(pub Energy { total, translational, vibrational });

impl<S> Event<S> {
    pub(crate) fn numbers(&self) -> [&S; 4] {
        [&self.t, &self.v_end, &self.h, &self.h_rate]
    }
}

impl<S> Contact<S> {
    /// Returns the times of impact and release.
    pub fn times(&self) -> (&S, Option<&S>) {
        (&self.impact, self.release.as_ref())
    }

    pub(crate) fn numbers(&self) -> Vec<&S> {
        [&self.impact, &self.impulse, &self.peak_strain].into_iter().chain(&self.release).collect()
    }
}

impl<S: Clone> Contact<S> {
    /// Builds the contacts between events; `found` returns impulse and peak of the contact that begins at an event.
    pub(crate) fn between(events: &[Event<S>], mut found: impl FnMut(usize) -> (S, S)) -> Vec<Self> {
        let impacts = events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Impact);
        let contact = |(k, impact): (usize, &Event<S>)| {
            let (impulse, peak_strain) = found(k);
            let to = events.get(k + 1).map(|release| release.t.clone());
            Contact { impact: impact.t.clone(), release: to, impulse, peak_strain }
        };
        impacts.map(contact).collect()
    }
}

impl<S> Energy<S> {
    /// Returns the three numbers, in the order of the fields.
    pub fn numbers(&self) -> [&S; 3] {
        [&self.total, &self.translational, &self.vibrational]
    }
}

impl<S> StressPiece<S> {
    /// Returns the times at which pieces begin and end, and the strains there.
    pub fn numbers(pieces: &[Self]) -> Vec<&S> {
        pieces.iter().flat_map(|piece| [&piece.start, &piece.end, &piece.strain_start, &piece.strain_end]).collect()
    }

    /// Converts the piece to other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> StressPiece<T> {
        StressPiece {
            start: f(self.start),
            end: f(self.end),
            strain_start: f(self.strain_start),
            strain_end: f(self.strain_end),
            chebyshev: self.chebyshev.into_iter().map(f).collect(),
        }
    }
}

impl<N: Bounded> StressPiece<N> {
    /// Widens each coefficient, so that it holds for that of `v_x(0,·)` itself: the bound of the first one holds for
    /// the distance ε of the sum.
    ///
    /// **Source**: `c_k = (2/π) ∫ f(cos θ) cos kθ dθ` over 0 … π, and `∫ |cos kθ| dθ = 2`, so f within ε has `c_k`
    /// within 4ε/π.
    pub(crate) fn with_own_coefficients(mut self) -> Self {
        if let Some((first, others)) = self.chebyshev.split_first_mut() {
            let distance = first.centred().1;
            let wider = distance.ratio(4, 3) * &distance;
            for other in others {
                *other = other.clone().widened(&wider);
            }
        }
        self
    }
}

impl<S: Scalar> StressPiece<S> {
    /// Returns `v_x(0,t)` at a time of the piece: linear between its ends, or the Chebyshev sum.
    ///
    /// **Accuracy**: that of the coefficients, and a rounding for each of them.
    ///
    /// ```
    /// let rod = dalembert::Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
    /// let pieces = rod.doubles()?.stress_history()?.pieces;
    /// // −(μ + g t)/c until the wave comes back.
    /// assert_eq!(pieces[0].eval(&0.5), -3.5);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn eval(&self, time: &S) -> S {
        let width = self.end.clone() - &self.start;
        let share = (time.clone() - &self.start) / &width;
        if self.chebyshev.is_empty() {
            return (self.strain_end.clone() - &self.strain_start) * &share + &self.strain_start;
        }
        // Clenshaw's recurrence on −1 … 1.
        let x = share.int(2) * &share - share.one();
        let (mut b1, mut b2) = (x.zero(), x.zero());
        for c in self.chebyshev.iter().skip(1).rev() {
            let b0 = x.int(2) * &x * &b1 - &b2 + c;
            b2 = std::mem::replace(&mut b1, b0);
        }
        match self.chebyshev.first() {
            Some(first) => x * &b1 - b2 + first,
            None => b1,
        }
    }

    /// Returns `∫ v_x(0,s) ds` from the beginning of the piece to a time of it.
    ///
    /// **Source**: `∫ T_k = T_{k+1}/(2(k+1)) − T_{k−1}/(2(k−1))`, from −1 on.
    ///
    /// **Accuracy**: that of the coefficients, and a few roundings for each of them.
    ///
    /// ```
    /// let rod = dalembert::Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
    /// let pieces = rod.doubles()?.stress_history()?.pieces;
    /// // −∫₀¹ (3 + s) ds.
    /// assert_eq!(pieces[0].integral(&1.0), -3.5);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn integral(&self, time: &S) -> S {
        let passed = time.clone() - &self.start;
        if self.chebyshev.is_empty() {
            return (self.strain_start.clone() + self.eval(time)) * &passed / passed.int(2);
        }
        let coefficient = |k: usize| self.chebyshev.get(k).cloned().unwrap_or_else(|| passed.zero());
        let term = |k: usize| {
            // The first coefficient counts in full, not by half.
            let before = if k == 1 { coefficient(0) * &passed.int(2) } else { coefficient(k - 1) };
            (before - coefficient(k + 1)) / passed.int(2 * k as i64)
        };
        let mut chebyshev: Vec<S> = (1..=self.chebyshev.len()).map(term).collect();
        // The integral is zero at −1, where T_k = (−1)^k.
        let start =
            chebyshev.iter().enumerate().fold(passed.zero(), |sum, (j, c)| if j % 2 == 0 { sum + c } else { sum - c });
        chebyshev.insert(0, start);
        let half = (self.end.clone() - &self.start) / passed.int(2);
        StressPiece { chebyshev, ..self.clone() }.eval(time) * &half
    }
}

/// `v_x(0,·)`: the strain at the ground, piece by piece, from `t = 0` to the end of the history. The paper calls it the
/// stress, which is this strain times the modulus.
#[derive(Clone, Debug, PartialEq)]
pub struct StressHistory<S> {
    /// The pieces, in order and without a gap.
    pub pieces: Vec<StressPiece<S>>,
    /// Reason of the end of the last piece. Before an irrational event, the end is a fraction just below its time.
    pub ending: Ending,
}

/// Prints one line for each piece: `from … to: left … right`, with the number of Chebyshev coefficients unless the
/// piece is linear. The last line states the reason of the end.
impl<S: Scalar> fmt::Display for StressHistory<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, piece) in self.pieces.iter().enumerate() {
            let [from, to, left, right] =
                [&piece.start, &piece.end, &piece.strain_start, &piece.strain_end].map(Scalar::text);
            let to = match &self.ending {
                Ending::ExactnessEnds { time, .. } if k + 1 == self.pieces.len() => format!("just before {time}"),
                _ => to,
            };
            write!(f, "{from} … {to}: {left} … {right}")?;
            match piece.chebyshev.len() {
                0 => writeln!(f)?,
                count => writeln!(f, "  ({count} Chebyshev coefficients)")?,
            }
        }
        writeln!(f, "ends: {}", self.ending)
    }
}

/// Reason of the end of a history.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Ending {
    /// The requested time.
    #[error("the time asked for")]
    Time,
    /// The next impact after the requested contacts.
    #[error("the impact after the last contact asked for")]
    NextImpact,
    /// No impact can follow, for the given reason.
    #[error("no further impact: {0}")]
    NoFurtherImpact(Reason),
    /// No release can follow, for the given reason.
    #[error("no bounce: {0}")]
    NoBounce(Reason),
    /// The rod has come to rest, by the given criterion. A history with a requested time reaches that time, here as
    /// well as with [`Ending::NoBounce`] and [`Ending::NoFurtherImpact`] once the motion has faded below the accuracy.
    #[error("at rest: {0}")]
    Rest(Reason),
    /// The next event has an irrational time.
    #[error("exactness ends before the impact at t = {time} ≈ {near}, which is no fraction")]
    ExactnessEnds {
        /// The event.
        kind: EventKind,
        /// Its time as a surd, `3 + √2`.
        time: String,
        /// The nearest double, or a neighbour of it.
        near: f64,
    },
    /// The first bounce: no proof covers what follows.
    #[error("the first bounce: whether and when the rod lands again is not proved")]
    Bounce,
    /// No proof covers what follows: no affordable number of bits decides whether a close event happens.
    #[error("{} is not proved; velocities may differ by {differ:.1e} from there on", what.question())]
    Unproved {
        /// The undecided event.
        what: Near,
        /// Possible difference of velocities from then on.
        differ: f64,
    },
    /// The requested accuracy or effort does not decide what follows.
    #[error("undecided: {0}")]
    Undecided(Reason),
}

impl Ending {
    /// Returns whether the history may be shorter than requested because the continuation is unknown.
    pub fn is_open(&self) -> bool {
        matches!(self, Ending::ExactnessEnds { .. } | Ending::Undecided(_) | Ending::Bounce | Ending::Unproved { .. })
    }

    /// Returns the reason together with the end time: `ends at t = 12: …`.
    pub fn at(&self, end: &str) -> String {
        match self {
            Ending::ExactnessEnds { .. } => self.to_string(),
            reason => format!("ends at t = {end}: {reason}"),
        }
    }
}

/// Events and contacts up to the end of a history.
#[derive(Clone, Debug)]
pub struct Course<S> {
    /// The last known time.
    pub end: S,
    /// Reason of the end.
    pub ending: Ending,
    /// All impacts and releases, in order.
    pub events: Vec<Event<S>>,
    /// All contacts, in order.
    pub contacts: Vec<Contact<S>>,
    /// Warnings about the numbers.
    pub warnings: Vec<Warning>,
}

maps!(pub Course { end } lists events, contacts keeps ending, warnings);

impl<S> Course<S> {
    /// Returns a course without events, contacts and warnings.
    pub fn new(end: S, ending: Ending) -> Self {
        Course { end, ending, events: Vec::new(), contacts: Vec::new(), warnings: Vec::new() }
    }
}
