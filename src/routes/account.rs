//! The accounts that a motion is asked of: a history, the closed form of the first contact, the modal sum, the paper's
//! printed formulas, and finite differences.

use std::cell::OnceCell;
use std::cmp::Ordering;

use super::differences::Marched;
use super::value::{Bounded, NoAnswer, System};
use crate::error::Error;
use crate::first_contact::{Bounce, FirstContact};
use crate::modal::Modal;
use crate::motion::{Ending, Event, EventKind, Field, Motion, Side};
use crate::number::Estimate;
use crate::paper::{Printed, UndampedContact, formulas};
use crate::problem::{Parameters, Run};
use crate::special;

/// One number of a motion, or why it is not given.
pub(crate) type Found<S> = Result<Bounded<S>, NoAnswer>;
/// Several at once.
type All<S, const N: usize> = Result<[Bounded<S>; N], NoAnswer>;

/// An account of the first contact of `rod`, or of its whole run: a few basic quantities, and all others from them
/// where the account has no formula of its own.
pub(crate) trait Account<S: System> {
    /// `t_b`.
    fn release(&self, rod: &Parameters<S>) -> Found<S>;

    /// `v_x(0,t)`.
    fn strain(&self, time: &S, side: Side) -> Found<S>;

    /// `h` and `h′`.
    fn centre(&self, rod: &Parameters<S>, time: &S) -> All<S, 2>;

    /// `E`.
    fn total_energy(&self, time: &S) -> Found<S>;

    /// `v`, `v_t`, `v_x` at `(x,t)`.
    fn field(&self, _point: &S, _time: &S, _side: Side) -> All<S, 3> {
        not_given()
    }

    /// The event of this kind next to `near`.
    fn event_near(&self, _kind: EventKind, _near: f64) -> Found<S> {
        not_given()
    }

    /// `t*` and `h(t*)`.
    fn top(&self) -> All<S, 2> {
        not_given()
    }

    /// The length of the shortest piece of the stress history.
    fn shortest_piece(&self) -> Found<S> {
        not_given()
    }

    /// The last impact or release.
    fn last_event(&self, rod: &Parameters<S>) -> Found<S> {
        self.release(rod)
    }

    fn height(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        self.centre(rod, time).map(|[height, _]| height)
    }

    /// `P = L h′`.
    fn momentum(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        self.centre(rod, time).map(|[_, velocity]| velocity.times(&rod.length))
    }

    /// (3.63).
    fn translational_energy(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        self.centre(rod, time).map(|centre| translational(rod, centre))
    }

    fn vibrational_energy(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        Ok(self.total_energy(time)?.minus(self.translational_energy(rod, time)?))
    }

    /// `E_h` where the first contact begins: `μ²L/2` for the paper's start.
    fn first_energy(&self, rod: &Parameters<S>) -> Found<S> {
        Ok(Bounded::exact(rod.speed.square() * &rod.length / rod.length.int(2)))
    }

    /// `e_P = h′(t_b)/μ`.
    fn momentum_restitution(&self, rod: &Parameters<S>) -> Found<S> {
        let [_, velocity] = self.centre(rod, &self.release(rod)?.value)?;
        Ok(velocity.over(Bounded::exact(rod.speed.clone())))
    }

    /// (4.71): `e_E² = E_h(t_b)/E_h(0)`.
    fn restitution(&self, rod: &Parameters<S>) -> Found<S> {
        let first = self.first_energy(rod)?;
        if first.value.positive() != Ok(true) {
            return Err(NoAnswer::none("E_h ≤ 0 where the contact begins: nothing to compare with"));
        }
        let last = translational(rod, self.centre(rod, &self.release(rod)?.value)?);
        if last.value.negative() == Ok(true) {
            return Err(NoAnswer::none("E_h < 0 where the contact ends"));
        }
        Ok(last.over(first))
    }
}

fn not_given<T>() -> Result<T, NoAnswer> {
    Err(NoAnswer::gave_up("this route does not give that"))
}

/// `E_h = L h′²/2 + L g h`, with the errors of h and h′ and eight roundings of each term.
fn translational<S: System>(rod: &Parameters<S>, [height, velocity]: [Bounded<S>; 2]) -> Bounded<S> {
    let (length, g, speed) = (rod.length.to_f64(), rod.gravity.to_f64(), velocity.value.to_f64().abs());
    let carried = (speed + velocity.bound) * velocity.bound + g * height.bound;
    let rounding = (speed * speed + g * height.value.to_f64().abs()) * 2f64.powf(rod.length.log2_roundoff() + 3.0);
    let kinetic = velocity.value.square() / velocity.value.int(2);
    Bounded::new((kinetic + height.value * &rod.gravity) * &rod.length, length * (carried + rounding))
}

/// A number with the bound that it carries.
fn carried<N: System>(value: N) -> Bounded<N> {
    let bound = value.log2_error().exp2();
    Bounded::new(value, bound)
}

/// A double with the bound that came with it.
fn double(estimate: Estimate<f64>) -> Bounded<f64> {
    let bound = estimate.bound();
    Bounded::new(estimate.into_value(), bound)
}

/// A history, and the run that is asked about.
pub(crate) struct ByHistory<'a, S>(pub(crate) &'a dyn Motion<S>, pub(crate) &'a Run);

impl<S: System> ByHistory<'_, S> {
    /// The answer of the history; one that ends too early gives the reason.
    fn asked<T>(&self, answer: Result<T, Error>) -> Result<T, NoAnswer> {
        answer.map_err(|error| match error {
            Error::TimeOutside { .. } => self.ended(),
            other => other.into(),
        })
    }

    fn ended(&self) -> NoAnswer {
        match self.0.ending() {
            open if open.is_open() => NoAnswer::gave_up(open),
            ending => NoAnswer::none(ending.to_string()),
        }
    }

    fn event(&self, event: Option<&Event<S>>) -> Found<S> {
        event.map(|event| carried(event.time.clone())).ok_or_else(|| self.ended())
    }

    fn first_contact(&self) -> Result<(S, Option<S>), NoAnswer> {
        self.0.contact_times(0).ok_or_else(|| NoAnswer::none("no contact in it"))
    }
}

impl<S: System> Account<S> for ByHistory<'_, S> {
    fn release(&self, _: &Parameters<S>) -> Found<S> {
        self.first_contact().ok().and_then(|(_, to)| to).map(carried).ok_or_else(|| self.ended())
    }

    fn event_near(&self, kind: EventKind, near: f64) -> Found<S> {
        let apart = |event: &Event<S>| (event.time.to_f64() - near).abs();
        let events = self.0.events().iter().filter(|event| event.kind == kind && apart(event) < 0.25);
        self.event(events.min_by(|a, b| apart(a).total_cmp(&apart(b))))
    }

    fn last_event(&self, _: &Parameters<S>) -> Found<S> {
        match (self.0.ending(), self.0.events().last()) {
            // The last event before an open question is not the last of the run.
            (Ending::Undecided(_) | Ending::ExactnessEnds { .. }, _) => Err(self.ended()),
            (Ending::Bounce, _) if *self.1 != Run::Impacts(1) => Err(self.ended()),
            (_, None) => Err(NoAnswer::none("nothing happens in it")),
            (_, last) => self.event(last),
        }
    }

    fn strain(&self, time: &S, side: Side) -> Found<S> {
        Ok(carried(self.asked(self.0.strain(time, side))?))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> All<S, 3> {
        let field = self.asked(self.0.field(point, time, side))?;
        let displacement = carried(field.displacement);
        Ok([displacement, carried(field.velocity), carried(field.strain)])
    }

    fn centre(&self, _: &Parameters<S>, time: &S) -> All<S, 2> {
        let (height, velocity) = self.asked(self.0.centre(time))?;
        Ok([carried(height), carried(velocity)])
    }

    fn total_energy(&self, time: &S) -> Found<S> {
        Ok(carried(self.asked(self.0.energy(time))?.total))
    }

    fn translational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        Ok(carried(self.asked(self.0.energy(time))?.translational))
    }

    fn vibrational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        Ok(carried(self.asked(self.0.energy(time))?.vibrational))
    }

    fn first_energy(&self, rod: &Parameters<S>) -> Found<S> {
        Ok(translational(rod, self.centre(rod, &self.first_contact()?.0)?))
    }

    fn top(&self) -> All<S, 2> {
        let release = self.0.events().iter().position(|event| event.kind == EventKind::Release);
        let top = self.0.highest(release.ok_or_else(|| self.ended())?);
        let (time, height) = top.ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([carried(time), carried(height)])
    }

    fn shortest_piece(&self) -> Found<S> {
        let lengths = self.0.stress_pieces().into_iter().map(|piece| piece.to - &piece.from);
        let shortest = lengths.min_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        shortest.map(carried).ok_or_else(|| self.ended())
    }
}

/// The closed form of the first contact, and of the flight after it.
pub(crate) struct ByClosedForm<N> {
    contact: FirstContact<N>,
    bounce: OnceCell<Bounce<N>>,
}

impl<N: System + special::BoundedSpecial> ByClosedForm<N> {
    pub(crate) fn new(rod: &Parameters<N>) -> Self {
        ByClosedForm { contact: FirstContact::new(rod), bounce: OnceCell::new() }
    }

    fn bounce(&self) -> &Bounce<N> {
        self.bounce.get_or_init(|| self.contact.bounce())
    }
}

impl<N: System + special::BoundedSpecial> Account<N> for ByClosedForm<N> {
    fn release(&self, _: &Parameters<N>) -> Found<N> {
        match self.bounce() {
            Bounce::At { time, .. } => Ok(carried(time.clone())),
            Bounce::Never(reason) => Err(NoAnswer::none(reason.to_string())),
            Bounce::Undecided { why, .. } => Err(NoAnswer::gave_up(why)),
        }
    }

    fn strain(&self, time: &N, side: Side) -> Found<N> {
        Ok(carried(self.contact.strain(time, side)))
    }

    fn field(&self, point: &N, time: &N, side: Side) -> All<N, 3> {
        let Field { displacement, velocity, strain } = self.contact.field(point, time, side);
        Ok([displacement, velocity, strain].map(carried))
    }

    fn centre(&self, rod: &Parameters<N>, time: &N) -> All<N, 2> {
        // No contact is shorter than a round trip.
        if rod.round_trip().below(time) == Ok(true)
            && let Bounce::At { time: end, .. } = self.bounce()
            && end.below(time) == Ok(true)
        {
            let (height, velocity) = self.contact.rebound(end).flight(time);
            return Ok([height, velocity].map(carried));
        }
        let (height, velocity) = self.contact.centre(time);
        Ok([height, velocity].map(carried))
    }

    fn total_energy(&self, time: &N) -> Found<N> {
        Ok(carried(self.contact.energy(time).total))
    }

    fn vibrational_energy(&self, _: &Parameters<N>, time: &N) -> Found<N> {
        Ok(carried(self.contact.energy(time).vibrational))
    }

    fn top(&self) -> All<N, 2> {
        let Bounce::At { time: end, .. } = self.bounce() else { return Err(NoAnswer::none("no bounce")) };
        let (time, height) = self.contact.rebound(end).highest().ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([time, height].map(carried))
    }
}

/// Looks in each round trip by which a release is found that no proof brackets.
const LOOKS: i64 = 8;

fn found(release: Option<f64>) -> Found<f64> {
    release.map(Bounded::unbounded).ok_or_else(|| NoAnswer::gave_up("no tensile stress in 64 round trips"))
}

impl Account<f64> for Modal<f64> {
    fn release(&self, rod: &Parameters<f64>) -> Found<f64> {
        found(formulas::first_release(rod.round_trip(), LOOKS, |t, side| *Estimate::value(&self.strain(&t, side))))
    }

    fn strain(&self, time: &f64, side: Side) -> Found<f64> {
        Ok(double(self.strain(time, side)))
    }

    fn field(&self, point: &f64, time: &f64, side: Side) -> All<f64, 3> {
        let Field { displacement, velocity, strain } = self.field(point, time, side);
        Ok([displacement, velocity, strain].map(double))
    }

    fn centre(&self, _: &Parameters<f64>, time: &f64) -> All<f64, 2> {
        let (height, velocity) = self.centre(time);
        Ok([double(height), double(velocity)])
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        Ok(double(self.energy(time)))
    }
}

impl Account<f64> for Printed {
    fn release(&self, rod: &Parameters<f64>) -> Found<f64> {
        found(self.release(rod.round_trip(), LOOKS))
    }

    fn strain(&self, time: &f64, _: Side) -> Found<f64> {
        Ok(Bounded::unbounded(self.strain(*time)))
    }

    fn height(&self, _: &Parameters<f64>, time: &f64) -> Found<f64> {
        Ok(Bounded::unbounded(self.centre(*time)))
    }

    fn centre(&self, rod: &Parameters<f64>, time: &f64) -> All<f64, 2> {
        Ok([self.centre(*time), self.momentum(*time) / rod.length].map(Bounded::unbounded))
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        Ok(Bounded::unbounded(self.energy(*time)))
    }
}

impl<S: System + PartialOrd> Account<S> for UndampedContact<S> {
    fn release(&self, _: &Parameters<S>) -> Found<S> {
        Ok(Bounded::exact(self.bounce_time()))
    }

    fn strain(&self, time: &S, side: Side) -> Found<S> {
        Ok(Bounded::exact(self.strain(time, side)))
    }

    fn centre(&self, _: &Parameters<S>, time: &S) -> All<S, 2> {
        let (height, velocity) = self.centre(time);
        Ok([height, velocity].map(Bounded::exact))
    }

    fn momentum(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        Ok(Bounded::exact(self.momentum(time)))
    }

    fn total_energy(&self, _: &S) -> Found<S> {
        Ok(Bounded::exact(self.total_energy()))
    }

    fn translational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        Ok(Bounded::exact(self.translational_energy(time)))
    }

    fn vibrational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        let at_bounce = time.compare(&self.bounce_time()).is_ok_and(Ordering::is_eq);
        if at_bounce { Ok(Bounded::exact(self.vibrational_energy_at_bounce())) } else { not_given() }
    }

    fn momentum_restitution(&self, _: &Parameters<S>) -> Found<S> {
        Ok(Bounded::exact(self.momentum_restitution()))
    }

    fn restitution(&self, _: &Parameters<S>) -> Found<S> {
        self.energy_restitution_squared().map(Bounded::exact).ok_or_else(|| NoAnswer::none("nothing moves"))
    }

    fn top(&self) -> All<S, 2> {
        let (time, height) = self.highest().ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([time, height].map(Bounded::exact))
    }
}

impl Account<f64> for Marched {
    fn release(&self, _: &Parameters<f64>) -> Found<f64> {
        let release = self.events.iter().find(|event| event.0 == EventKind::Release);
        release.map(|event| Bounded::unbounded(event.1)).ok_or_else(|| NoAnswer::gave_up("no release found"))
    }

    fn last_event(&self, _: &Parameters<f64>) -> Found<f64> {
        let last = self.events.last().map(|event| Bounded::unbounded(event.1));
        last.ok_or_else(|| NoAnswer::gave_up("no event found"))
    }

    fn strain(&self, _: &f64, _: Side) -> Found<f64> {
        Ok(Bounded::unbounded(self.stress))
    }

    fn centre(&self, _: &Parameters<f64>, time: &f64) -> All<f64, 2> {
        let at = self.at(*time).ok_or_else(|| NoAnswer::gave_up("nothing is kept of that time"))?;
        Ok([at.centre, at.velocity].map(Bounded::unbounded))
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        let at = self.at(*time).ok_or_else(|| NoAnswer::gave_up("nothing is kept of that time"))?;
        Ok(Bounded::unbounded(at.energy))
    }
}
