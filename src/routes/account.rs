//! The accounts of a motion that can be asked beside a history: the closed form of the first contact, the modal sum,
//! the paper's printed formulas, and finite differences.

use std::cell::OnceCell;
use std::cmp::Ordering;

use super::differences::Marched;
use super::value::NoAnswer;
use crate::first_contact::{Bounce, FirstContact};
use crate::mapped::MapEach;
use crate::modal::Modal;
use crate::motion::{EventKind, Field, Side};
use crate::number::{Estimate, Scalar};
use crate::paper::{Printed, UndampedContact, formulas};
use crate::problem::Parameters;
use crate::special;

/// One number of a motion, or why it is not given.
pub(crate) type Found<S> = Result<S, NoAnswer>;
/// Several at once.
type All<S, const N: usize> = Result<[S; N], NoAnswer>;

/// An account of the first contact of `rod`, and of the flight after it: a few basic quantities, and all others from
/// them where the account has no formula of its own. Energies are per linear density. A number without any bound has an
/// infinite one.
pub(crate) trait Account<S: Scalar> {
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

    /// `t*` and `h(t*)`.
    fn top(&self) -> All<S, 2> {
        not_given()
    }

    /// The last impact or release.
    fn last_event(&self, rod: &Parameters<S>) -> Found<S> {
        self.release(rod)
    }

    fn height(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        self.centre(rod, time).map(|[height, _]| height)
    }

    /// (3.63).
    fn translational_energy(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        self.centre(rod, time).map(|centre| translational(rod, centre))
    }

    fn vibrational_energy(&self, rod: &Parameters<S>, time: &S) -> Found<S> {
        Ok(self.total_energy(time)? - self.translational_energy(rod, time)?)
    }

    /// `e_P = h′(t_b)/μ`.
    fn momentum_restitution(&self, rod: &Parameters<S>) -> Found<S> {
        let [_, velocity] = self.centre(rod, &self.release(rod)?)?;
        Ok(velocity / &rod.speed)
    }

    /// (4.71): `e_E² = E_h(t_b)/E_h(0)`.
    fn restitution(&self, rod: &Parameters<S>) -> Found<S> {
        let first = first_energy(rod);
        if first.positive() != Ok(true) {
            return Err(NoAnswer::none("E_h ≤ 0 where the contact begins: nothing to compare with"));
        }
        let last = translational(rod, self.centre(rod, &self.release(rod)?)?);
        if last.negative() == Ok(true) {
            return Err(NoAnswer::none("E_h < 0 where the contact ends"));
        }
        Ok(last / first)
    }
}

pub(super) fn not_given<T>() -> Result<T, NoAnswer> {
    Err(NoAnswer::gave_up("this route does not give that"))
}

/// `E_h` where the first contact begins: `μ²L/2` for the paper's start.
pub(super) fn first_energy<S: Scalar>(rod: &Parameters<S>) -> S {
    rod.speed.square() * &rod.length / rod.length.int(2)
}

/// `E_h = L h′²/2 + L g h`.
fn translational<S: Scalar>(rod: &Parameters<S>, [height, velocity]: [S; 2]) -> S {
    (velocity.square() / velocity.int(2) + height * &rod.gravity) * &rod.length
}

/// The value of an account that gives no bound.
pub(super) fn unbounded<S>(value: S) -> Estimate<S> {
    Estimate::new(value, f64::INFINITY)
}

/// The closed form of the first contact, and of the flight after it.
pub(crate) struct ByClosedForm<N> {
    contact: FirstContact<N>,
    bounce: OnceCell<Bounce<N>>,
}

impl<N: special::BoundedSpecial> ByClosedForm<N> {
    pub(crate) fn new(rod: &Parameters<N>) -> Self {
        ByClosedForm { contact: FirstContact::new(rod), bounce: OnceCell::new() }
    }

    fn bounce(&self) -> &Bounce<N> {
        self.bounce.get_or_init(|| self.contact.bounce())
    }
}

impl<N: special::BoundedSpecial> Account<N> for ByClosedForm<N> {
    fn release(&self, _: &Parameters<N>) -> Found<N> {
        match self.bounce() {
            Bounce::At { time, .. } => Ok(time.clone()),
            Bounce::Never(reason) => Err(NoAnswer::none(reason.to_string())),
            Bounce::Undecided { why, .. } => Err(NoAnswer::gave_up(why)),
        }
    }

    fn strain(&self, time: &N, side: Side) -> Found<N> {
        Ok(self.contact.strain(time, side))
    }

    fn field(&self, point: &N, time: &N, side: Side) -> All<N, 3> {
        let Field { displacement, velocity, strain } = self.contact.field(point, time, side);
        Ok([displacement, velocity, strain])
    }

    fn centre(&self, rod: &Parameters<N>, time: &N) -> All<N, 2> {
        // No contact is shorter than a round trip.
        if rod.round_trip().below(time) == Ok(true)
            && let Bounce::At { time: end, .. } = self.bounce()
            && end.below(time) == Ok(true)
        {
            return Ok(self.contact.rebound(end).flight(time).into());
        }
        Ok(self.contact.centre(time).into())
    }

    fn total_energy(&self, time: &N) -> Found<N> {
        Ok(self.contact.energy(time).total)
    }

    fn vibrational_energy(&self, _: &Parameters<N>, time: &N) -> Found<N> {
        Ok(self.contact.energy(time).vibrational)
    }

    fn top(&self) -> All<N, 2> {
        let Bounce::At { time: end, .. } = self.bounce() else { return Err(NoAnswer::none("no bounce")) };
        self.contact.rebound(end).highest().map(Into::into).ok_or_else(|| NoAnswer::none("no top"))
    }
}

/// Looks in each round trip by which a release is found that no proof brackets.
const LOOKS: i64 = 8;

fn found(release: Option<f64>) -> Found<Estimate<f64>> {
    release.map(unbounded).ok_or_else(|| NoAnswer::gave_up("no tensile stress in 64 round trips"))
}

impl Account<Estimate<f64>> for Modal<f64> {
    fn release(&self, rod: &Parameters<Estimate<f64>>) -> Found<Estimate<f64>> {
        let trip = rod.round_trip().into_value();
        found(formulas::first_release(trip, LOOKS, |t, side| self.strain(&t, side).into_value()))
    }

    fn strain(&self, time: &Estimate<f64>, side: Side) -> Found<Estimate<f64>> {
        Ok(self.strain(time.value(), side))
    }

    fn field(&self, point: &Estimate<f64>, time: &Estimate<f64>, side: Side) -> All<Estimate<f64>, 3> {
        let Field { displacement, velocity, strain } = self.field(point.value(), time.value(), side);
        Ok([displacement, velocity, strain])
    }

    fn centre(&self, _: &Parameters<Estimate<f64>>, time: &Estimate<f64>) -> All<Estimate<f64>, 2> {
        Ok(self.centre(time.value()).into())
    }

    fn total_energy(&self, time: &Estimate<f64>) -> Found<Estimate<f64>> {
        Ok(self.energy(time.value()))
    }
}

impl Account<Estimate<f64>> for Printed {
    fn release(&self, rod: &Parameters<Estimate<f64>>) -> Found<Estimate<f64>> {
        found(self.release(rod.round_trip().into_value(), LOOKS))
    }

    fn strain(&self, time: &Estimate<f64>, _: Side) -> Found<Estimate<f64>> {
        Ok(unbounded(self.strain(*time.value())))
    }

    fn height(&self, _: &Parameters<Estimate<f64>>, time: &Estimate<f64>) -> Found<Estimate<f64>> {
        Ok(unbounded(self.centre(*time.value())))
    }

    fn centre(&self, rod: &Parameters<Estimate<f64>>, time: &Estimate<f64>) -> All<Estimate<f64>, 2> {
        let time = *time.value();
        Ok([self.centre(time), self.momentum(time) / rod.length.value()].map_each(unbounded))
    }

    fn total_energy(&self, time: &Estimate<f64>) -> Found<Estimate<f64>> {
        Ok(unbounded(self.energy(*time.value())))
    }
}

impl<S: Scalar + PartialOrd> Account<S> for UndampedContact<S> {
    fn release(&self, _: &Parameters<S>) -> Found<S> {
        Ok(self.bounce_time())
    }

    fn strain(&self, time: &S, side: Side) -> Found<S> {
        Ok(self.strain(time, side))
    }

    /// `h′` from the momentum as it is printed.
    fn centre(&self, rod: &Parameters<S>, time: &S) -> All<S, 2> {
        Ok([self.centre(time).0, self.momentum(time) / &rod.length])
    }

    fn total_energy(&self, _: &S) -> Found<S> {
        Ok(self.total_energy())
    }

    fn translational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        Ok(self.translational_energy(time))
    }

    fn vibrational_energy(&self, _: &Parameters<S>, time: &S) -> Found<S> {
        let at_bounce = time.compare(&self.bounce_time()).is_ok_and(Ordering::is_eq);
        if at_bounce { Ok(self.vibrational_energy_at_bounce()) } else { not_given() }
    }

    fn momentum_restitution(&self, _: &Parameters<S>) -> Found<S> {
        Ok(self.momentum_restitution())
    }

    fn restitution(&self, _: &Parameters<S>) -> Found<S> {
        self.energy_restitution_squared().ok_or_else(|| NoAnswer::none("nothing moves"))
    }

    fn top(&self) -> All<S, 2> {
        self.highest().map(Into::into).ok_or_else(|| NoAnswer::none("no top"))
    }
}

impl Account<Estimate<f64>> for Marched {
    fn release(&self, _: &Parameters<Estimate<f64>>) -> Found<Estimate<f64>> {
        let release = self.events.iter().find(|event| event.0 == EventKind::Release);
        release.map(|event| unbounded(event.1)).ok_or_else(|| NoAnswer::gave_up("no release found"))
    }

    fn last_event(&self, _: &Parameters<Estimate<f64>>) -> Found<Estimate<f64>> {
        let last = self.events.last().map(|event| unbounded(event.1));
        last.ok_or_else(|| NoAnswer::gave_up("no event found"))
    }

    fn strain(&self, _: &Estimate<f64>, _: Side) -> Found<Estimate<f64>> {
        Ok(unbounded(self.stress))
    }

    fn centre(&self, _: &Parameters<Estimate<f64>>, time: &Estimate<f64>) -> All<Estimate<f64>, 2> {
        let at = self.at(*time.value()).ok_or_else(|| NoAnswer::gave_up("nothing is kept of that time"))?;
        Ok([at.centre, at.velocity].map_each(unbounded))
    }

    fn total_energy(&self, time: &Estimate<f64>) -> Found<Estimate<f64>> {
        let at = self.at(*time.value()).ok_or_else(|| NoAnswer::gave_up("nothing is kept of that time"))?;
        Ok(unbounded(at.energy))
    }
}
