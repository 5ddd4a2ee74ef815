//! Solution of the damped problem, and its values.

use super::account::Proof;
use super::budget::AtEvent;
use super::effort::{Effort, Task};
use super::flight::Flight;
use super::follow::Follower;
use super::march::Medium;
use super::piece::{Checkpoint, Found, Mark, Piece};
use super::record::Record;
use super::root::smallest;
use super::series::{at_one, at_zero, evaluate, smaller};
use super::start::{Data, medium};
use super::strips::{Line, Node, Pool};
use super::uncertainty::{Uncertainty, within};
use crate::error::Error;
use crate::motion::{Course, Ending, Event, Field, Scales, Side, StressPiece, moments, unobserved};
use crate::number::{Estimate, Scalar};
use crate::problem::{Problem, Run};
use crate::special::{RoundedSpecial, log_mean, log_rest};

/// The motion of the damped rod through any number of impacts, `r ≥ 0`.
///
/// **Source**: the characteristic cells of `v_tt + 2r v_t − c² v_xx = −g` with the contact law (1.3)–(1.6); derivation
/// in the modules of `cells`. `r → 0` is regular: no formula divides by `r`.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *within its own bound*, which is at most about
/// [`Motion::error_estimate`](crate::engine::Motion::error_estimate) of the quantity's natural scale: `t₁`,
/// `V = max(|data|, g t₁)`, `V t₁`.
///
/// ```
/// use dalembert::engine::Damped;
/// use dalembert::engine::Motion;
/// use dalembert::{Number, Problem};
/// // Without damping a rod with c = L = g = 1 that arrives at μ = 3 leaves after the round trip, t₁ = 2.
/// let mut problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
/// problem = problem.to_builder().damping("1e-300").build()?;
/// let history = Damped::<f64>::solve(&problem, &(), 12.0)?;
/// let release = &history.events()[1];
/// assert!((release.t.value() - 2.0).abs() <= release.t.bound() && release.t.bound() < 1e-12);
/// assert!((release.v_end.value() - 1.0).abs() < 1e-12);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Damped<S: Scalar> {
    pub(super) medium: Medium<S>,
    pub(super) data: Data<S>,
    pub(super) scales: Scales<f64>,
    pieces: Vec<Piece<S>>,
    checkpoints: Vec<Checkpoint<S>>,
    flights: Vec<Flight<S>>,
    pub(super) course: Course<Estimate<S>>,
    /// Error bounds before the first event, and after each event.
    pub(super) uncertain: Vec<Uncertainty>,
    /// Error bounds at each event, where better ones are known.
    pub(super) at_events: Vec<Option<AtEvent>>,
    pub(super) proved: bool,
    /// Whether the end may have risen in the first contact, which begins without a force, within the bounds.
    pub(super) may_rise: bool,
    /// Cells marched by earlier queries.
    pool: Pool<S>,
}

impl<S: RoundedSpecial> Damped<S> {
    /// Solves `problem` up to the end of its `run`, to about `digits` decimal digits of the natural scales.
    ///
    /// The truncation of a cell is at most `2^{−20} 10^{−digits}`, or the roundoff of the number system if that is
    /// greater; every number carries the bound of the resulting error.
    ///
    /// If the goal is a time and the motion fades before it, the state at rest stands for the motion once the motion is
    /// below its own error, by a bound that holds for ever; the ending then says from which time on.
    ///
    /// The history ends early, and says so, beyond 400 000 strips or 4096 segments in a round trip.
    ///
    /// **Errors**: [`Error::DampingTooStrong`] for `r t₁ > 2000`; [`Error::Irrational`] from the parameters.
    pub fn solve(problem: &Problem, precision: &S::Precision, digits: f64) -> Result<Self, Error> {
        Self::march(&Task { problem, precision, effort: Effort::of(digits), observe: &unobserved }, false)
    }

    /// Solves a `task` in the same way; if `proves`, with a proof of its bounds as far as that goes.
    ///
    /// **Errors**: [`Error::NotDecided`] if not even the first strip is proved.
    pub(crate) fn march(task: &Task<'_, S>, proves: bool) -> Result<Self, Error> {
        Self::march_shortened(task, 1, proves)
    }

    /// Solves a `task` as [`Damped::march`], with segments `shorten` times shorter than necessary.
    fn march_shortened(task: &Task<'_, S>, shorten: i64, proves: bool) -> Result<Self, Error> {
        let (medium, data) = medium(task.problem, task.precision, task.effort.digits, shorten)?;
        let found = Follower::new(&medium, &data, proves.then(|| Proof::new(&medium))).run(task)?;
        Self::record_of(task, (medium, data), found)
    }

    pub(super) fn record_of(
        task: &Task<'_, S>,
        (medium, data): (Medium<S>, Data<S>),
        found: Found<S>,
    ) -> Result<Self, Error> {
        let proved = found.proof.is_some();
        let may_rise = found.proof.as_ref().is_some_and(|proof| proof.lifted > 0.0);
        let Found { pieces, checkpoints, flights, marks, mut warnings, unresolved, before, ending, end_error, .. } =
            found.proved(&medium, &data)?;
        warnings.extend(unresolved);
        let (end, late) = match task.problem.run() {
            Run::Time(time) if ending == Ending::Time || pieces.last().is_some_and(|piece| piece.still) => {
                (S::from_number(time, task.precision), 0.0)
            }
            _ => {
                let end = pieces.last().map_or_else(|| data.slope.zero(), Piece::to);
                // Other ends than impacts are at rays, or where the run stops.
                let rays = marks.last().map_or(&before, |mark| &mark.after).rays;
                let at_ray = rays + 16.0 * end.unit() * (1.0 + end.to_f64());
                (end * &data.units.time, if ending == Ending::NextImpact { end_error } else { at_ray })
            }
        };
        let mut history = Damped {
            course: Course { warnings, ..Course::new(within(&end, late * data.units.time.to_f64()), ending) },
            scales: data.units.clone().map(|scale| scale.to_f64()),
            medium,
            data,
            pieces,
            checkpoints,
            flights,
            at_events: marks.iter().map(|mark| mark.at).collect(),
            uncertain: std::iter::once(before).chain(marks.iter().map(|mark| mark.after)).collect(),
            proved,
            may_rise,
            pool: Pool::default(),
        };
        let event = |mark: Mark<S>| {
            let (centre, centre_velocity) = history.centre_at(&mark.time);
            let units = &history.data.units;
            let (mut t, end) = (mark.time * &units.time, history.course.end.value());
            let mut t_error = mark.time_error * units.time.to_f64();
            // The time of an event at the end of the run may be rounded to a later one.
            if t > *end {
                t_error += (t - end).to_f64();
                t = end.clone();
            }
            let event = Event {
                kind: mark.kind,
                t,
                v_end: mark.velocity * &units.velocity,
                h: centre,
                h_rate: centre_velocity,
                t_error,
            };
            event.map(Estimate::exact)
        };
        history.course.events = marks.into_iter().map(event).collect();
        history.with_bounds()
    }

    /// Returns the initial data if `time` is the left limit at the start.
    fn given_at(&self, point: &S, time: &S, side: Side) -> Result<Option<Field<S>>, Error> {
        let before = side == Side::Left && time.is_zero();
        Ok(if before { Some(self.data.given.at(point)?) } else { None })
    }

    fn record(&self) -> Record<'_, S> {
        let Damped { medium, data, pieces, checkpoints, flights, pool, .. } = self;
        Record { medium, data, pieces, checkpoints, flights, pool }
    }

    /// Converts a time to a dimensionless one.
    fn time(&self, time: &S) -> Result<S, Error> {
        if time.is_negative() || time > self.course.end.value() || !time.is_finite() {
            return Err(Error::TimeOutside { found: time.text(), end: self.course.end.value().text() });
        }
        let unit = &self.data.units.time;
        let trips = time.clone() / unit;
        // A time within rounding of a lattice time is that lattice time.
        Ok(match (trips.clone() + trips.ratio(1, 2)).floor_int() {
            Some(k) if time.meets(&(unit.int(k) * unit)) => time.int(k),
            _ => trips,
        })
    }

    fn check(&self, point: &S) -> Result<(), Error> {
        let length = &self.data.units.length;
        let outside = point.is_negative() || point > length || !point.is_finite();
        if outside { Err(Error::PointOutside { found: point.text(), length: length.text() }) } else { Ok(()) }
    }

    /// Computes `h` and `h′` from the nodes of the whole rod: `⟨v⟩ = v(0) + (1/L)∫(L−x) v_x dx`.
    fn mean(&self, t: &S, nodes: &[Node<S>]) -> (S, S) {
        let half = t.ratio(1, 2);
        let (mut mean, mut rate) = (t.zero(), t.zero());
        for node in nodes {
            mean = mean + (half.clone() - &node.x) * &node.strain * &node.weight;
            rate = rate + node.velocity() * &node.weight;
        }
        (mean * t.int(2) + self.record().height(t), rate * t.int(2))
    }

    /// Computes `h` and `h′` at a dimensionless time.
    fn centre_at(&self, t: &S) -> (S, S) {
        let (mean, rate) = match self.record().flight(t, Side::Left) {
            _ if t.is_zero() && self.data.rigid => (self.data.ground.clone(), self.data.end_velocity()),
            Some(flight) => flight.at(&flight.age_at(t)),
            None => self.mean(t, &self.record().whole_line(t)),
        };
        (mean * &self.data.displacement, rate * &self.data.units.velocity)
    }

    /// Computes the dimensionless `v(x,t)`.
    fn displacement(&self, x: &S, t: &S) -> S {
        let height = self.record().height(t);
        let strained = |sum: S, node: &Node<S>| sum + node.strain.clone() * &node.weight;
        match x {
            // The upper end.
            _ if *x == x.ratio(1, 2) => self.record().whole_line(t).iter().fold(height, strained),
            _ if x.is_positive() => self.record().line(t, x).iter().fold(height, strained),
            _ => height,
        }
    }

    pub(super) fn contact_pieces(&self) -> impl Iterator<Item = &[Piece<S>]> {
        self.pieces.chunk_by(|a, b| a.contact == b.contact).filter(|pieces| pieces[0].contact)
    }

    /// Computes the impulse of a contact with these pieces, and its peak within `tolerance`.
    pub(super) fn push_of(&self, pieces: &[Piece<S>], tolerance: f64) -> (S, S) {
        let (units, zero) = (&self.data.units, &self.data.slope);
        let (mut impulse, mut peak) = (zero.zero(), zero.zero());
        // A bound that is no number allows nothing.
        let tolerance = (tolerance * units.wave_speed.to_f64() / units.velocity.to_f64()).max(0.0);
        for piece in pieces {
            let mut area = piece.trace.clone();
            self.medium.basis.integrate(&mut area);
            let push = at_one(&area, &piece.len.zero()) * &piece.len * &self.data.displacement * &units.wave_speed;
            impulse = impulse - push;
            if let Some(least) = smallest(&self.medium.basis, &piece.trace, tolerance) {
                peak = smaller(peak, least * &units.velocity / &units.wave_speed);
            }
        }
        (impulse, peak)
    }

    /// Computes quadrature nodes along the rod, from the ground to the first of `points` and from each to the next, and
    /// counts the rays that cut each of these parts.
    pub(super) fn lines(&self, time: &S, points: &[S]) -> Result<Vec<Cut<S>>, Error> {
        let (t, units) = (self.time(time)?, &self.data.units);
        let cuts: Vec<S> = points.iter().map(|x| x.clone() / &units.length * t.ratio(1, 2)).collect();
        let reach = units.length.int(2) * &units.length;
        let strain = units.velocity.clone() / &units.wave_speed;
        let node = |node: Node<S>| moments::Node {
            velocity: node.velocity() * &units.velocity,
            weight: node.weight * &reach,
            x: node.x * &reach,
            strain: node.strain * &strain,
        };
        let line = |(nodes, parts): Line<S>| (nodes.into_iter().map(node).collect(), parts.saturating_sub(1));
        Ok(self.record().lines(&t, &cuts).into_iter().map(line).collect())
    }

    /// Returns the pieces of the stress: one for each flight, and in contact one between any two arriving rays.
    pub(super) fn pieces_of_stress(&self) -> Vec<StressPiece<S>> {
        let (units, zero) = (&self.data.units, self.data.slope.zero());
        let unit = units.velocity.clone() / &units.wave_speed;
        let parts: Vec<&[Piece<S>]> = self.pieces.chunk_by(|a, b| !a.contact && !b.contact).collect();
        let start = |part: &&[Piece<S>]| part[0].from.clone() * &units.time;
        let ends = parts.iter().skip(1).map(start).chain([self.course.end.value().clone()]);
        let piece = |(part, end): (&&[Piece<S>], S)| {
            let trace = if part[0].contact { part[0].trace.as_slice() } else { &[] };
            let chebyshev: Vec<S> = trace.iter().map(|term| term.clone() * &unit).collect();
            let (strain_start, strain_end) = (at_zero(&chebyshev, &zero), at_one(&chebyshev, &zero));
            StressPiece { start: start(part), end, strain_start, strain_end, chebyshev }
        };
        parts.iter().zip(ends).map(piece).collect()
    }

    /// Returns whether the end lies on the ground at a time of the run; `None` outside of it.
    pub(super) fn presses(&self, time: &S, side: Side) -> Option<bool> {
        let given = side == Side::Left && time.is_zero();
        let time = self.time(time).ok().filter(|_| !given)?;
        self.record().piece(&time, side).map(|(piece, _)| piece.contact)
    }

    pub(super) fn strain_of(&self, time: &S, side: Side) -> Result<S, Error> {
        if let Some(given) = self.given_at(&time.zero(), time, side)? {
            return Ok(given.strain);
        }
        let t = self.time(time)?;
        Ok(match self.record().piece(&t, side) {
            Some((piece, at)) if piece.contact => {
                evaluate(&piece.trace, &at) * &self.data.units.velocity / &self.data.units.wave_speed
            }
            _ => t.zero(),
        })
    }

    pub(super) fn ground_of(&self, time: &S, side: Side) -> Result<[S; 2], Error> {
        if let Some(given) = self.given_at(&time.zero(), time, side)? {
            return Ok([given.displacement, given.velocity]);
        }
        let (height, rate) = self.record().end(&self.time(time)?, side);
        Ok([height * &self.data.displacement, rate * &self.data.units.velocity])
    }

    pub(super) fn centre_of(&self, time: &S) -> Result<[S; 2], Error> {
        Ok(self.centre_at(&self.time(time)?).into())
    }

    pub(super) fn vibration_of(&self, time: &S) -> Result<S, Error> {
        let (t, units) = (self.time(time)?, &self.data.units);
        let nodes = self.record().whole_line(&t);
        let rate = match self.record().flight(&t, Side::Left) {
            Some(flight) => flight.rate_at(&flight.age_at(&t)),
            None => self.mean(&t, &nodes).1,
        };
        // The difference comes first, so that a vibration in flight loses no digits.
        let square = |node: &Node<S>| (node.rigid.clone() - &rate + &node.motion).square() + node.strain.square();
        // dx is c t₁ = 2L times the dimensionless one.
        Ok(summed(&nodes, &t, square) * &units.length * units.velocity.square())
    }

    pub(super) fn parts_of(&self, time: &S) -> Result<[S; 2], Error> {
        let (t, units) = (self.time(time)?, &self.data.units);
        let nodes = self.record().whole_line(&t);
        // The unit is that of the sum of both parts.
        let unit = units.velocity.square() * &units.length;
        let parts =
            [summed(&nodes, &t, |node| node.velocity().square()), summed(&nodes, &t, |node| node.strain.square())];
        Ok(parts.map(|part| part * &unit))
    }

    pub(super) fn field_of(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        let t = self.time(time)?;
        let units = &self.data.units;
        self.check(point)?;
        if let Some(given) = self.given_at(point, time, side)? {
            return Ok(given);
        }
        if point.is_zero() {
            let [displacement, velocity] = self.ground_of(time, side)?;
            return Ok(Field { displacement, velocity, strain: self.strain_of(time, side)? });
        }
        let x = point.clone() / &units.length * t.ratio(1, 2);
        let (velocity, strain) = self.record().at(&x, &t, side);
        Ok(Field {
            displacement: self.displacement(&x, &t) * &self.data.displacement,
            velocity: velocity * &units.velocity,
            strain: strain * &units.velocity / &units.wave_speed,
        })
    }

    pub(super) fn rates_of(&self, places: &[(S, S)]) -> Result<Vec<[S; 2]>, Error> {
        let units = &self.data.units;
        let place = |(x, time): &(S, S)| {
            self.check(x)?;
            Ok((x.clone() / &units.length * x.ratio(1, 2), self.time(time)?))
        };
        let places = places.iter().map(place).collect::<Result<Vec<_>, Error>>()?;
        let scaled =
            |(velocity, strain): (S, S)| [velocity * &units.velocity, strain * &units.velocity / &units.wave_speed];
        Ok(self.record().at_all(&places).into_iter().map(scaled).collect())
    }

    /// Computes `t*` and `h(t*)`, the highest point of the centre of mass, from `t`, `h(t)` and `h′(t)` in the same
    /// flight; `None` without gravity and under a fixed top.
    pub(super) fn turn(&self, [time, height, rate]: [&S; 3]) -> Option<(S, S)> {
        let Scales { gravity, time: trip, .. } = &self.data.units;
        if gravity.is_zero() || !self.medium.free_top {
            return None;
        }
        // Remark 2, with regular forms of the quotients by 2r and 4r².
        let damping = self.data.damping.clone() / trip;
        let rise = rate.clone() / gravity;
        let drag = damping.int(2) * &damping * &rise;
        let climb = log_rest(&drag) * &rise * rate;
        Some((time.clone() + log_mean(&drag) * &rise, height.clone() + climb))
    }
}

/// Nodes along a part of the rod, and the number of rays that cut it.
type Cut<S> = (Vec<moments::Node<S>>, usize);

fn summed<S: RoundedSpecial>(nodes: &[Node<S>], like: &S, part: impl Fn(&Node<S>) -> S) -> S {
    nodes.iter().fold(like.zero(), |sum, node| sum + part(node) * &node.weight)
}

#[cfg(test)]
#[path = "tests/history.rs"]
mod tests;
