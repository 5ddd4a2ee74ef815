//! The history of an undamped rod, and the positions of its times on the lattice.

use std::ops::ControlFlow;

use super::march::{GroundMotion, Halt, Limits, Until, march};
use super::start::{Scaled, Units};
use super::trace::{Part, Piece, Place};
use crate::error::Error;
use crate::motion::{Course, Ending, Side, unobserved};
use crate::number::{Bounded, Open};
use crate::problem::{Problem, Run, Top};
use crate::reason::Warning;

/// The history of an undamped rod. It implements [`crate::engine::Motion`] by the ground trace of the upward invariant.
///
/// **Accuracy**: *exact* in fractions, *enclosure* in intervals; otherwise *within the bound* that each number carries.
#[derive(Clone, Debug)]
pub struct Undamped<N> {
    pub(super) problem: Scaled<N>,
    pub(super) ground: GroundMotion<N>,
    pub(super) end: Moment<N>,
    pub(super) course: Course<N>,
}

/// A time as a round trip and an age in it. The trip before the start has `index` 0.
#[derive(Clone, Debug)]
pub(super) struct Moment<N> {
    pub(super) index: usize,
    pub(super) age: N,
}

/// The round trip that ends at a moment.
pub(super) struct Trip<N> {
    /// Its beginning, and its end as the limit from the left.
    pub(super) ends: [Place<N>; 2],
    /// Whether the moment is the event's own time, not merely one that is indistinguishable from it.
    pub(super) at_event: bool,
}

/// `h` and `h′` in lattice units.
pub(super) struct Centre<N> {
    pub(super) height: N,
    pub(super) rate: N,
}

impl<N: Bounded> Undamped<N> {
    /// Computes the history of `problem` without its damping; a [`Plan`](crate::Plan) chooses the engine.
    ///
    /// **Errors**: [`Error::Irrational`], [`Error::TooManyPieces`], [`Error::Open`].
    ///
    /// ```
    /// use dalembert::{Estimate, Number, Problem};
    /// use dalembert::engine::{Motion, Undamped};
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
    /// let history = Undamped::<Estimate<f64>>::solve(&problem, &())?;
    /// // Corollary 1: at μ = 3 ≥ g t₁ = 2 the contact lasts exactly t₁ = 2.
    /// let to = history.contacts()[0].release.as_ref().ok_or(dalembert::Error::NoClosedForm)?;
    /// assert_eq!(*to.value(), 2.0);
    /// assert!(to.bound() < 1e-14);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn solve(problem: &Problem, precision: &N::Precision) -> Result<Self, Error> {
        Self::solve_within(problem, precision, Limits::default(), &unobserved)
    }

    /// Computes the history as [`Undamped::solve`] does, with given limits; for `observe` see
    /// [`crate::solve::Observer`].
    pub fn solve_within(
        problem: &Problem,
        precision: &N::Precision,
        limits: Limits,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        Self::solve_scaled(Scaled::of(problem, precision)?, problem.run(), limits, observe)
    }

    /// Computes the history as [`Undamped::solve_within`] does, for a problem in lattice units.
    pub(crate) fn solve_scaled(
        scaled: Scaled<N>,
        run: &Run,
        limits: Limits,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let until = match run {
            Run::Impacts(contacts) => Until::Contacts(*contacts),
            Run::Time(time) => {
                let end = N::from_number(time, &scaled.gravity.precision());
                let Some((trip, age)) = trip_and_age(&end, &scaled.units) else {
                    // An enclosure that overlaps two round trips is undecided.
                    let few = end.to_f64() / scaled.units.round_trip.to_f64() < limits.pieces as f64;
                    return Err(match few {
                        true => Error::not_decided("the round trip at the end of the run", end.bits()),
                        false => Error::TooManyPieces { limit: limits.pieces, time: time.to_f64() },
                    });
                };
                Until::Time { trip, age }
            }
        };
        let ground = march(&scaled, &until, limits, observe)?;
        let (trips, Halt { trip, age, ending }) = (ground.trace.trips(), ground.halt.clone());
        // The history may halt beyond the stored trips; then it ends with the last stored trip.
        let beyond = trip >= trips && ending != Ending::Time;
        let end = if beyond { Moment { index: trips, age: age.one() } } else { Moment { index: trip + 1, age } };
        let course = Course::new(time_of(&end, &scaled.units.round_trip), ending);
        let mut history = Undamped { end, course, problem: scaled, ground };
        history.course.events = history.in_scene_units()?;
        history.course.contacts = history.summed_contacts();
        let undetermined = history.undetermined_from();
        let coincidence = history.ground.coincidence.map(|trip| history.beginning(trip));
        let coincidence = coincidence.filter(|from| undetermined.is_none_or(|lost| *from < lost));
        let warnings = [
            coincidence.map(|from| Warning::Coincidence { from }),
            undetermined.map(|from| Warning::NotDetermined { from }),
        ];
        history.course.warnings = warnings.into_iter().flatten().collect();
        Ok(history)
    }

    /// Returns the motion of the ground end: pieces and events, in lattice units.
    pub fn ground(&self) -> &GroundMotion<N> {
        &self.ground
    }

    /// Returns the time from which this precision does not determine the events; `None` if it determines all.
    pub fn undetermined_from(&self) -> Option<f64> {
        self.ground.undetermined.map(|trip| self.beginning(trip))
    }

    /// Returns whether `exact` has the same pieces and events, one by one. If so, all coincidences of this history are
    /// exact, and the warning of a coincidence is removed.
    pub fn confirm<M: Bounded>(&mut self, exact: &Undamped<M>) -> bool {
        let pieces = |ours: &[Piece<N>], theirs: &[Piece<M>]| {
            ours.len() == theirs.len() && ours.iter().zip(theirs).all(|(a, b)| a.contact == b.contact)
        };
        let (ours, theirs) = (&self.ground, &exact.ground);
        let events = ours.events.len() == theirs.events.len()
            && ours
                .events
                .iter()
                .zip(&theirs.events)
                .all(|(a, b)| (a.kind, a.trip, a.piece, a.incoming) == (b.kind, b.trip, b.piece, b.incoming));
        let (trips, others) = (ours.trace.stored(), theirs.trace.stored());
        let same = events
            && ours.undetermined.is_none()
            && ours.trace.trips() == theirs.trace.trips()
            && trips.zip(others).all(|((k, a), (j, b))| k == j && pieces(a, b));
        if same {
            self.course.warnings.retain(|warning| !matches!(warning, Warning::Coincidence { .. }));
        }
        same
    }

    /// Returns the time at which a round trip begins.
    fn beginning(&self, trip: usize) -> f64 {
        trip as f64 * self.problem.units.round_trip.to_f64()
    }

    pub(super) fn time_of(&self, moment: &Moment<N>) -> N {
        time_of(moment, &self.problem.units.round_trip)
    }

    /// Returns the round trip and the age of `time`.
    pub(super) fn locate(&self, time: &N) -> Result<Moment<N>, Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.course.end.text() };
        let Some((trip, age)) = trip_and_age(time, &self.problem.units) else {
            // An enclosure that overlaps two round trips is undecided, not outside.
            let inside = !time.negative()? && !self.course.end.below(time)?;
            return Err(if inside { Error::Open(Open) } else { outside() });
        };
        let begin = self.ground.trace.begin();
        if trip + 1 < begin {
            let start = self.time_of(&Moment { index: begin, age: age.zero() });
            return Err(Error::TimeForgotten { found: time.text(), start: start.text() });
        }
        let (moment, end) = (Moment { index: trip + 1, age }, &self.end);
        if moment.index < end.index || (moment.index == end.index && !end.age.below(&moment.age)?) {
            return Ok(moment);
        }
        // The end of a whole trip is the beginning of the next trip.
        let whole = moment.index == end.index + 1 && moment.age.vanishes()?;
        if whole && !end.age.below(&end.age.one())? { Ok(end.clone()) } else { Err(outside()) }
    }

    /// Returns the moment shifted by `by`: earlier if negative, later if positive, by less than one round trip.
    pub(super) fn shifted(&self, moment: &Moment<N>, by: &N) -> Result<Moment<N>, Open> {
        let (age, one) = (moment.age.clone() + by, by.one());
        Ok(if age.negative()? {
            Moment { index: moment.index.saturating_sub(1), age: age + &one }
        } else if !age.below(&one)? {
            Moment { index: moment.index + 1, age: age - &one }
        } else {
            Moment { index: moment.index, age }
        })
    }

    pub(super) fn place(&self, moment: &Moment<N>, side: Side) -> Result<Place<N>, Open> {
        self.ground.trace.place(moment.index, &moment.age, side)
    }

    pub(super) fn p_at(&self, moment: &Moment<N>, side: Side) -> Result<N, Open> {
        let place = self.place(moment, side)?;
        Ok(self.ground.trace.piece(&place).line.value_at(&place.age))
    }

    /// Returns `v(0,t)` in lattice units at the end of a window.
    pub(super) fn height_at(&self, place: &Place<N>) -> N {
        // No piece precedes the start.
        if place.index == 0 {
            return self.problem.ground_start.clone();
        }
        let piece = self.ground.trace.piece(place);
        if piece.contact {
            return piece.height.zero();
        }
        let age = place.age.clone() - &piece.age;
        let rise = piece.line.value_at_stored(&piece.age) + (piece.line.slope * &age).halved();
        piece.height + rise * &age
    }

    /// Returns `∫ p` from one moment to another.
    fn integral(&self, from: &Moment<N>, until: &Moment<N>) -> Result<N, Open> {
        let (mut sum, summed) = (from.age.zero(), self.summed(from.index));
        let (from, until) = (self.place(from, Side::Right)?, self.place(until, Side::Left)?);
        self.ground.trace.window(&from, &until, &mut |part| {
            sum = sum.clone() + summed(part).integral();
        });
        Ok(sum)
    }

    /// Returns `v(x,t) − v(0,t)` at `x = 2LX` in lattice units: `½ ∫ (q − p) dX`. The upward wave `p` left the ground
    /// since `t − x/c`; the downward wave left it one round trip before it returns there, up to `t + x/c`.
    pub(super) fn stretched(&self, moment: &Moment<N>, height: &N) -> Result<N, Open> {
        let gravity = &self.problem.gravity;
        let earlier = Moment { index: moment.index - 1, age: moment.age.clone() };
        let up = self.integral(&self.shifted(moment, &-height.clone())?, moment)?;
        let down = self.integral(&earlier, &self.shifted(&earlier, height)?)?;
        let down = match self.problem.top {
            Top::Free => down - gravity.clone() * height,
            Top::Fixed => -down,
        };
        Ok((down - up + gravity.clone() * height.square()).halved())
    }

    /// Returns the map that drops exact numbers from the parts of this round trip if the trip has many pieces.
    fn summed(&self, index: usize) -> fn(Part<N>) -> Part<N> {
        if self.ground.trace.slice(index).len() <= MANY_PARTS { |part| part } else { Part::without_exact }
    }

    /// Visits the waves in the rod at the end of a window of one round trip. With `s` from 0 to 1 backwards from there,
    /// `w(s) = value − g s`: `w` is `p` at `x = 2Ls` for `s < ½`, and `q` at `x = 2L(1 − s)` behind the top.
    ///
    /// **Source**: the delay recursion; gravity subtracts `g s` from the wave that left the ground `s` ago.
    pub(super) fn visit_rod(&self, trip: &Trip<N>, visit: &mut dyn FnMut(Part<N>)) -> Result<(), Open> {
        let (trace, [from, until]) = (&self.ground.trace, &trip.ends);
        let summed = self.summed(until.index);
        match self.problem.top {
            Top::Fixed => self.visit_ways(trip, &mut |_, part| visit(part))?,
            Top::Free => {
                trace.window_from(from, until, self.edge(trip, from, Side::Right), &mut |part| visit(summed(part)));
            }
        }
        // The break at the ground that may precede the end of the window.
        if let Some(edge) = self.edge(trip, until, Side::Left) {
            visit(summed(Part { offset: until.age.one(), ..edge }));
        }
        Ok(())
    }

    /// Visits the same parts as [`Undamped::visit_rod`], cut at the top, with a flag that is true on the way up.
    pub(super) fn visit_ways(&self, trip: &Trip<N>, visit: &mut dyn FnMut(bool, Part<N>)) -> Result<(), Open> {
        let (trace, [from, until]) = (&self.ground.trace, &trip.ends);
        let summed = self.summed(until.index);
        let mut visit = |up: bool, part: Part<N>| visit(up, summed(part));
        let (gravity, half) = (&self.problem.gravity, until.age.one().halved());
        let now = Moment { index: until.index, age: until.age.clone() };
        let middle = self.place(&self.shifted(&now, &-half.clone())?, Side::Right)?;
        let edge = |place| self.edge(trip, place, Side::Right);
        trace.window_from(from, &middle, edge(from), &mut |part| match self.problem.top {
            Top::Free => visit(false, part),
            Top::Fixed => {
                let shift = part.shift.map(|(jump, late)| (-jump, late));
                visit(false, Part { value: gravity.clone() - part.value, slope: -part.slope, shift, ..part });
            }
        });
        let second = edge(&middle);
        trace
            .window_from(&middle, until, second, &mut |part| visit(true, Part { offset: part.offset + &half, ..part }));
        Ok(())
    }

    /// Returns [`Trace::edge`](super::trace::Trace::edge) of a part of a round trip; an event's own moment needs none.
    pub(super) fn edge(&self, trip: &Trip<N>, place: &Place<N>, side: Side) -> Option<Part<N>> {
        if trip.at_event { None } else { self.ground.trace.edge(place, side) }
    }

    /// Returns the round trip that ends at `moment`, the position of `time`.
    pub(super) fn last_trip(&self, moment: &Moment<N>, time: &N) -> Result<Trip<N>, Open> {
        let from = self.ground.trace.place(moment.index - 1, &moment.age, Side::Right)?;
        Ok(Trip { ends: [from, self.place(moment, Side::Left)?], at_event: self.is_event(time) })
    }

    /// Returns whether a time is the time of an event. A spelled number stands for itself and never is.
    fn is_event(&self, time: &N) -> bool {
        let events = &self.course.events;
        let first = events.partition_point(|event| event.t.below(time) == Ok(true));
        let near = events[first..].iter().take_while(|event| time.below(&event.t) != Ok(true));
        time.spelled_as().is_none() && near.into_iter().any(|event| event.t.alike(time))
    }

    /// Computes `h` and `h′` in lattice units at the end of a round trip.
    ///
    /// **Source**: with `w` of [`Undamped::visit_rod`] and times in round trips, `h′ = ∫ w ds` and
    /// `h = v(0,t) + ∫ (s − ½) value ds − g/12`, because `v_x` is integrated from the ground up.
    pub(super) fn centre_at(&self, trip: &Trip<N>) -> Result<Centre<N>, Open> {
        let gravity = &self.problem.gravity;
        let half = gravity.one().halved();
        let (mut rate, mut height) = (-gravity.clone().halved(), self.height_at(&trip.ends[1]));
        height = height - gravity.clone() / gravity.int(12);
        self.visit_rod(trip, &mut |part| {
            let first = part.integral();
            height = height.clone() + first.clone() * (half.clone() - &part.offset) - part.moment();
            rate = rate.clone() + first;
        })?;
        Ok(Centre { height, rate })
    }
}

fn time_of<N: Bounded>(moment: &Moment<N>, round_trip: &N) -> N {
    let trips = moment.age.int(moment.index as i64 - 1);
    (trips + &moment.age) * round_trip
}

/// Returns the round trip, from 0, and the age in it; `None` before the start or where the trip number overflows.
fn trip_and_age<N: Bounded>(time: &N, units: &Units<N>) -> Option<(usize, N)> {
    let age = time.clone() / &units.round_trip;
    let trip = age.floor_int()?;
    Some((usize::try_from(trip).ok()?, age.clone() - age.int(trip)))
}

/// Round trips with more pieces than this are summed without exact numbers.
const MANY_PARTS: usize = 32;
