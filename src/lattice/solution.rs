//! The history of an undamped rod: from a march to events, contacts, and any place in between.

mod answers;

use std::sync::OnceLock;

use super::march::{Halt, Limits, Marched, Until, march};
use super::scaled::{Scaled, Units};
use super::trace::{Occurrence, Part, Piece};
use crate::error::Error;
use crate::history::{Contact, Ending, Event, EventKind, Field, History, Side};
use crate::number::Scalar;
use crate::rod::{Problem, Run, Top};

/// The history of an undamped rod: [`History`] by the ground trace of the upward invariant.
///
/// **Accuracy**: *exact* in fractions; otherwise rounded, with the bound of [`History::error_estimate`].
#[derive(Clone, Debug)]
pub struct Undamped<S> {
    problem: Scaled<S>,
    marched: Marched<S>,
    end: Moment<S>,
    ending: Ending,
    /// Told when first asked for: a sample of the stress needs neither.
    events: OnceLock<Vec<Event<S>>>,
    contacts: OnceLock<Vec<Contact<S>>>,
    warnings: Vec<String>,
}

/// A time as a round trip and an age in it. The trip before the start has `index` 0.
#[derive(Clone, Debug)]
struct Moment<S> {
    index: usize,
    fraction: S,
}

impl<S: Scalar> Undamped<S> {
    /// The history of `problem`, whose damping is ignored: see [`crate::scene::plan`] for the choice of engine.
    ///
    /// **Errors**: [`Error::Irrational`], [`Error::TooManyPieces`].
    ///
    /// ```
    /// use dalembert::{History, Number, Problem, lattice::Undamped};
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
    /// let history = Undamped::<f64>::solve(&problem, &())?;
    /// // Corollary 1: at μ = 3 ≥ g t₁ = 2 the contact lasts exactly t₁ = 2.
    /// assert_eq!(history.contacts()[0].to, Some(2.0));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn solve(problem: &Problem, precision: &S::Precision) -> Result<Self, Error> {
        Self::solve_within(problem, precision, Limits::default(), |_, _| ())
    }

    /// [`Undamped::solve`] with a limit of one's own; `observe` is told the round trip and the pieces so far.
    pub fn solve_within(
        problem: &Problem,
        precision: &S::Precision,
        limits: Limits,
        observe: impl FnMut(usize, usize),
    ) -> Result<Self, Error> {
        let scaled = Scaled::<S>::of(problem, precision)?;
        let until = match &problem.run {
            Run::Impacts(contacts) => Until::Contacts(*contacts),
            Run::Time(time) => {
                let age = S::from_number(time, precision) / &scaled.units.round_trip;
                match age.floor_int().and_then(|trip| usize::try_from(trip).ok()) {
                    Some(trip) => Until::Age(trip, age.clone() - age.int(trip as i64)),
                    None => return Err(Error::TooManyPieces { limit: limits.pieces, time: time.to_f64() }),
                }
            }
        };
        let marched = march(&scaled, &until, limits, observe)?;
        Ok(Self::assemble(scaled, marched, until))
    }

    fn assemble(problem: Scaled<S>, marched: Marched<S>, until: Until<S>) -> Self {
        let trips = marched.trace.trips();
        let moment = |trip: usize, fraction: &S| Moment { index: trip + 1, fraction: fraction.clone() };
        let mut history = Undamped {
            end: moment(trips, &problem.gravity.zero()),
            ending: Ending::Time,
            events: OnceLock::new(),
            contacts: OnceLock::new(),
            warnings: Vec::new(),
            problem,
            marched,
        };
        match (&history.marched.halt, until) {
            (Halt::Time, Until::Age(trip, fraction)) => history.end = Moment { index: trip + 1, fraction },
            (Halt::Time, Until::Contacts(_)) => (),
            (Halt::NextImpact(trip, fraction), _) => {
                history.end = moment(*trip, fraction);
                history.ending = Ending::NextImpact;
            }
            (Halt::NoFurtherImpact, _) => {
                history.ending = Ending::NoFurtherImpact(
                    "the end does not come down in two whole round trips, which repeat for ever".into(),
                );
            }
            (Halt::NoBounce, _) => {
                history.ending = Ending::NoBounce(
                    "the end stays on the ground for two whole round trips, which repeat for ever".into(),
                );
            }
            (Halt::Open(trip, fraction), _) => {
                history.end = moment(*trip, fraction);
                let Units { round_trip, velocity, .. } = &history.problem.units;
                let height = if history.end.index > trips { trips } else { history.end.index };
                let at = Moment {
                    index: height,
                    fraction: if height < history.end.index { fraction.one() } else { fraction.clone() },
                };
                let apart = history.marched.trace.apart(&history.height_at(&at));
                history.ending = Ending::Undecided(format!(
                    "within a round trip comes a touch that {} bits do not tell from a miss; either way v(0,t) is the same up to \
                     {:.1e} for one round trip, and up to three times more after each one more",
                    fraction.bits().unwrap_or(0),
                    apart * (velocity.clone() * round_trip).to_f64(),
                ));
            }
            (Halt::Irrational { .. }, _) => history.stop_before_surd(),
        }
        if history.end.index == trips + 1 && history.end.fraction.is_zero() && !matches!(history.ending, Ending::Time) {
            // The stored trips end where the next begins: the last instant that is known.
            history.end = Moment { index: trips, fraction: history.end.fraction.one() };
        }
        history.warnings = history.tell_warnings();
        history
    }

    /// Everything before the irrational landing is exact; the history ends at a fraction just below it.
    fn stop_before_surd(&mut self) {
        let Halt::Irrational { trip, fraction, q, slope, disc } = &self.marched.halt else { return };
        let unit = &self.problem.units.round_trip;
        let scale = unit.clone() / slope;
        let rational = (q.int(*trip as i64) + fraction) * unit - scale.clone() * q;
        let time = rational.surd(slope.is_negative(), &(scale.square() * disc));
        let (q, slope, disc) = (q.to_f64(), slope.to_f64(), disc.to_f64());
        let age = (-q - disc.sqrt()) / slope;
        let near = (*trip as f64 + fraction.to_f64() + age) * unit.to_f64();
        // A short fraction where one fits between the beginning of the piece and the root.
        let ticks = ((fraction.to_f64() + age) * MILLION as f64 - 1e-3).floor();
        let short = fraction.int(ticks as i64) / fraction.int(MILLION);
        let below = if short > *fraction { short } else { fraction.clone() + fraction.double(age * (1.0 - 1e-9)) };
        self.end = Moment { index: trip + 1, fraction: below };
        self.ending = Ending::ExactnessEnds { kind: EventKind::Impact, time, near };
    }

    fn tell_events(&self) -> Vec<Event<S>> {
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let unit = self.problem.gravity.roundoff().to_f64();
        let rise = velocity.clone() * round_trip;
        let mut events: Vec<Event<S>> = Vec::with_capacity(self.marched.occurrences.len());
        let mut last: Option<(&Occurrence<S>, S, S)> = None;
        for occurrence in &self.marched.occurrences {
            let moment = Moment { index: occurrence.trip + 1, fraction: occurrence.fraction.clone() };
            let (h, rate) = match last {
                Some((before, h, rate)) if before.trip == occurrence.trip && self.problem.top == Top::Free => {
                    self.carried(before, h, rate, occurrence)
                }
                _ => self.centre_at(&moment),
            };
            events.push(Event {
                kind: occurrence.kind,
                time: self.time_of(&moment),
                end_velocity: occurrence.end_velocity.clone() * velocity,
                centre: h.clone() * &rise,
                centre_velocity: rate.clone() * velocity,
                time_error: if S::RIGOROUS { 0.0 } else { occurrence.error * unit * round_trip.to_f64() },
            });
            last = Some((occurrence, h, rate));
        }
        events
    }

    /// `h`, `h′` at the next event of the same round trip, in lattice units: under a free top `h″ = −(c²/L) v_x(0,t) − g`.
    /// Started afresh in every round trip, this costs a piece once and adds no more than one trip's roundings.
    fn carried(&self, before: &Occurrence<S>, h: S, rate: S, now: &Occurrence<S>) -> (S, S) {
        let gravity = &self.problem.gravity;
        let width = now.fraction.clone() - &before.fraction;
        let fall = gravity.clone() * &width;
        let (mut push, mut lift) = (width.zero(), width.zero());
        if before.kind == EventKind::Impact {
            self.marched.trace.window(
                (before.trip + 1, &before.fraction),
                (now.trip + 1, &now.fraction),
                |Part { offset, width: w, value, slope }| {
                    let (first, second) = moments(&w, &value, &slope);
                    push = push.clone() + &first;
                    lift = lift.clone() + (width.clone() - offset) * &first - second;
                },
            );
        }
        let two = width.int(2);
        let h = h + (rate.clone() - fall.clone() / &two) * &width + lift * &two;
        (h, rate + push * two - fall)
    }

    fn tell_contacts(&self) -> Vec<Contact<S>> {
        let units = &self.problem.units;
        let events = self.events();
        let mut contacts = Vec::with_capacity(events.len() / 2 + 1);
        let end = self.end.clone();
        let moment = |k: usize| {
            let at = self.marched.occurrences.get(k)?;
            Some(Moment { index: at.trip + 1, fraction: at.fraction.clone() })
        };
        for (k, event) in events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Impact) {
            let Some(from) = moment(k) else { continue };
            let released = moment(k + 1);
            let until = released.as_ref().unwrap_or(&end);
            let width = until.fraction.int(until.index as i64 - from.index as i64) + &until.fraction - &from.fraction;
            let (mut sum, mut peak) = (width.zero(), width.zero());
            self.marched.trace.window((from.index, &from.fraction), (until.index, &until.fraction), |part| {
                let rise = part.slope.clone() * &part.width;
                let at_end = part.value.clone() + &rise;
                peak = peak.clone().larger(part.value.clone()).larger(at_end);
                sum = sum.clone() + (part.value.clone() + rise / part.value.int(2)) * &part.width;
            });
            contacts.push(Contact {
                from: event.time.clone(),
                to: events.get(k + 1).map(|release| release.time.clone()),
                impulse: sum * width.int(2) * &units.length * &units.velocity,
                peak_stress: -(peak * &units.velocity / &units.wave_speed),
            });
        }
        contacts
    }

    fn tell_warnings(&self) -> Vec<String> {
        let unit = self.problem.gravity.roundoff().to_f64();
        let lost = self.marched.occurrences.iter().find(|event| event.error * unit > LOST);
        let warning = lost.filter(|_| !S::RIGOROUS).map(|event| {
            let round_trip = self.problem.units.round_trip.to_f64();
            let time = (event.trip as f64 + event.fraction.to_f64()) * round_trip;
            let error = event.error * unit * round_trip;
            format!(
                "from t = {time:.6} on, the events are not determined in this precision (error bound {error:.1e}): \
                 ask for more digits"
            )
        });
        warning.into_iter().collect()
    }

    /// The units of the lattice.
    pub fn units(&self) -> &Units<S> {
        &self.problem.units
    }

    /// The end `x = L`.
    pub fn top(&self) -> Top {
        self.problem.top
    }

    /// What the march left: pieces, occurrences, grazes and error bounds, in lattice units.
    pub fn marched(&self) -> &Marched<S> {
        &self.marched
    }

    fn time_of(&self, moment: &Moment<S>) -> S {
        let trips = moment.fraction.int(moment.index as i64 - 1);
        (trips + &moment.fraction) * &self.problem.units.round_trip
    }

    /// Where `time` lies; in rounded numbers a time within rounding of a ray lies on it.
    fn locate(&self, time: &S) -> Result<Moment<S>, Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.end().text() };
        let age = time.clone() / &self.problem.units.round_trip;
        let trip = age.floor_int().and_then(|trip| usize::try_from(trip).ok()).ok_or_else(outside)?;
        let fraction = age.clone() - age.int(trip as i64);
        let begin = self.marched.trace.begin();
        if trip + 1 < begin {
            let start = self.time_of(&Moment { index: begin, fraction: age.zero() });
            return Err(Error::TimeForgotten { found: time.text(), start: start.text() });
        }
        let moment = self.snap(Moment { index: trip + 1, fraction });
        let end = &self.end;
        let later = moment.index > end.index || (moment.index == end.index && moment.fraction > end.fraction);
        let after_whole_trip =
            moment.index == end.index + 1 && moment.fraction.is_zero() && end.fraction == end.fraction.one();
        if later && !after_whole_trip {
            let excess = age.to_f64() - (end.index as f64 - 1.0 + end.fraction.to_f64());
            if S::RIGOROUS || excess > 8.0 * age.roundoff().to_f64() * age.to_f64() {
                return Err(outside());
            }
        }
        Ok(if later { end.clone() } else { moment })
    }

    fn snap(&self, moment: Moment<S>) -> Moment<S> {
        if S::RIGOROUS {
            return moment;
        }
        let Moment { index, fraction } = moment;
        let tolerance = fraction.roundoff() * fraction.double(8.0 * (index as f64 + 1.0));
        if index < self.marched.trace.trips() + 1 && fraction.one() - &fraction <= tolerance {
            return Moment { index: index + 1, fraction: fraction.zero() };
        }
        if index > self.marched.trace.trips() {
            return Moment { index, fraction };
        }
        let near = |at: &S| (at.clone() - &fraction).magnitude() <= tolerance;
        let above = fraction.clone() + &tolerance;
        let (found, piece) = self.marched.trace.find(index, &above, false);
        let fraction = if found == index && near(&piece.fraction) { piece.fraction } else { fraction };
        Moment { index, fraction }
    }

    /// `by` earlier (if negative) or later, less than one round trip.
    fn shifted(&self, moment: &Moment<S>, by: &S) -> Moment<S> {
        let fraction = moment.fraction.clone() + by;
        let one = by.one();
        let moment = if fraction.is_negative() {
            Moment { index: moment.index.saturating_sub(1), fraction: fraction + &one }
        } else if fraction >= one {
            Moment { index: moment.index + 1, fraction: fraction - &one }
        } else {
            Moment { index: moment.index, fraction }
        };
        self.snap(moment)
    }

    /// `v(0,t)` in lattice units.
    fn height_at(&self, moment: &Moment<S>) -> S {
        let (found, piece) = self.marched.trace.find(moment.index, &moment.fraction, true);
        // At the very start there is no piece before.
        if found == 0 {
            return self.problem.ground_start.clone();
        }
        if piece.contact {
            return piece.height.zero();
        }
        let trips = moment.fraction.int(moment.index as i64 - found as i64);
        let age = trips + &moment.fraction - &piece.fraction;
        let rise = piece.at(&piece.fraction) + piece.slope.clone() * &age / age.int(2);
        piece.height.clone() + rise * &age
    }

    /// `p` over `width` before the moment and `q` over `width` after it, part by part: `(offset, width, value, slope)`,
    /// the offset counted from the ground for `q` and from the far end for `p`.
    fn window(&self, moment: &Moment<S>, width: &S, mut upward: impl FnMut([S; 4]), mut downward: impl FnMut([S; 4])) {
        let trace = &self.marched.trace;
        let from = {
            let fraction = moment.fraction.clone() - width;
            if fraction.is_negative() { (moment.index - 1, fraction + width.one()) } else { (moment.index, fraction) }
        };
        // Exact sums of many parts outgrow any use.
        let long = trace.slice(moment.index).len() > MANY_PARTS;
        let carried = |part: [S; 4]| if long { part.map(S::plain) } else { part };
        let (at, earlier) = (&moment.fraction, moment.index - 1);
        trace.window((from.0, &from.1), (moment.index, at), |part| {
            upward(carried([part.offset, part.width, part.value, part.slope]))
        });
        let until = {
            let (fraction, one) = (at.clone() + width, width.one());
            if fraction > one { (moment.index, fraction - one) } else { (earlier, fraction) }
        };
        trace.window((earlier, at), (until.0, &until.1), |part| {
            let (q, slope) = (trace.returned(&part.value), trace.returned_slope(&part.slope));
            downward(carried([part.offset, part.width, q, slope]));
        });
    }

    /// `h`, `h′` in lattice units.
    ///
    /// **Source**: with `X = x/2L` and times in round trips, `h′ = ∫(p + q) dX` and
    /// `h = v(0,t) + ∫ (½ − X)(q − p) dX + g/24` over `0 < X < ½`, from `v_x` integrated from the ground up.
    fn centre_at(&self, moment: &Moment<S>) -> (S, S) {
        let gravity = &self.problem.gravity;
        let half = gravity.ratio(1, 2);
        let (mut up, mut down) = ((half.zero(), half.zero()), (half.zero(), half.zero()));
        self.window(
            moment,
            &half,
            |[offset, w, a, m]| {
                let (first, second) = moments(&w, &a, &m);
                up = (up.0.clone() + &first, up.1.clone() + offset * &first + second);
            },
            |[offset, w, a, m]| {
                let (first, second) = moments(&w, &a, &m);
                down = (down.0.clone() + &first, down.1.clone() + (half.clone() - &offset) * &first - second);
            },
        );
        let h = self.height_at(moment) + gravity.clone() / gravity.int(24) + down.1 - up.1;
        (h, up.0 + down.0)
    }

    fn field_at(&self, moment: &Moment<S>, x: &S, side: Side) -> Field<S> {
        let trace = &self.marched.trace;
        let units = &self.problem.units;
        let gravity = &self.problem.gravity;
        let before = side == Side::Left;
        let height = x.clone() / x.int(2) / &units.length;
        let lift = gravity.clone() * &height;
        let below = self.shifted(moment, &-height.clone());
        let above = self.shifted(moment, &height);
        let p = trace.value(below.index, &below.fraction, before) - &lift;
        let q = trace.returned(&trace.value(above.index - 1, &above.fraction, before)) + &lift;
        let (mut up, mut down) = (x.zero(), x.zero());
        let integral = |[_, w, a, m]: [S; 4]| (a + m * &w / w.int(2)) * &w;
        self.window(
            moment,
            &height,
            |part| up = up.clone() + integral(part),
            |part| down = down.clone() + integral(part),
        );
        let v = self.height_at(moment) + (down - up + lift * height) / x.int(2);
        Field {
            displacement: v * &units.velocity * &units.round_trip,
            velocity: (p.clone() + &q) / x.int(2) * &units.velocity,
            strain: (q - p) / x.int(2) * &units.velocity / &units.wave_speed,
        }
    }

    /// The piece at the asked side of a moment.
    fn piece_at(&self, moment: &Moment<S>, side: Side) -> (usize, Piece<S>) {
        self.marched.trace.find(moment.index, &moment.fraction, side == Side::Left)
    }
}

/// `∫ (a + m s) ds` and `∫ s (a + m s) ds` over `0 < s < w`.
fn moments<S: Scalar>(w: &S, a: &S, m: &S) -> (S, S) {
    let rise = m.clone() * w;
    let first = (a.clone() + rise.clone() / w.int(2)) * w;
    let second = (a.clone() / w.int(2) + rise / w.int(3)) * w * w;
    (first, second)
}

/// An event whose time may be off by this much of a round trip is no longer determined.
const LOST: f64 = 1e-3;
/// Round trips of more pieces are summed without exact numbers.
const MANY_PARTS: usize = 32;
/// Parts of a round trip to which the end of an exact history is rounded down.
const MILLION: i64 = 1_000_000;
