//! The accounts that a motion is asked of: a history, the closed form of the first contact, the modal sum, the paper's printed
//! formulas, and finite differences.

use std::cell::OnceCell;

use super::cost::differences::Marched;
use super::value::{Bounded, NoAnswer, System};
use crate::error::Error;
use crate::first_contact::{Bounce, Estimate, FirstContact};
use crate::history::{Ending, EventKind, History, Side};
use crate::modal::Modal;
use crate::number::Analytic;
use crate::paper::{Printed, UndampedContact, formulas};
use crate::rod::{Parameters, Problem};

/// One number of a motion, or why it is not given.
pub(crate) type Found<S> = Result<Bounded<S>, NoAnswer>;

/// An account of the first contact or of a whole run: a few basic quantities, and all others from them where the account has no
/// formula of its own.
pub(crate) trait Motion<S: System> {
    fn rod(&self) -> &Parameters<S>;

    /// `t_b`.
    fn release(&self) -> Found<S>;

    /// `v_x(0,t)`.
    fn stress(&self, time: &S, side: Side) -> Found<S>;

    /// `h` and `h′`.
    fn centre(&self, time: &S) -> Result<[Bounded<S>; 2], NoAnswer>;

    /// `E`.
    fn total_energy(&self, time: &S) -> Found<S>;

    /// `v`, `v_t`, `v_x` at `(x,t)`.
    fn field(&self, _point: &S, _time: &S, _side: Side) -> Result<[Bounded<S>; 3], NoAnswer> {
        not_given()
    }

    /// The event of this kind next to `near`.
    fn event_near(&self, _kind: EventKind, _near: f64) -> Found<S> {
        not_given()
    }

    /// `t*` and `h(t*)`.
    fn top(&self) -> Result<[Bounded<S>; 2], NoAnswer> {
        not_given()
    }

    /// The last impact or release.
    fn last_event(&self) -> Found<S> {
        self.release()
    }

    fn height(&self, time: &S) -> Found<S> {
        self.centre(time).map(|[height, _]| height)
    }

    /// `P = L h′`.
    fn momentum(&self, time: &S) -> Found<S> {
        Ok(self.centre(time)?[1].clone().times(&self.rod().length))
    }

    /// (3.63): `E_h = L h′²/2 + L g h`.
    fn translational_energy(&self, time: &S) -> Found<S> {
        Ok(translational(self.rod(), self.centre(time)?))
    }

    fn vibrational_energy(&self, time: &S) -> Found<S> {
        Ok(self.total_energy(time)?.minus(self.translational_energy(time)?))
    }

    /// `E_h` where the first contact begins: `μ²L/2` for the paper's start.
    fn first_energy(&self) -> Result<S, NoAnswer> {
        let Parameters { speed, length, .. } = self.rod();
        Ok(speed.square() * length / length.int(2))
    }

    /// `e_P = h′(t_b)/μ`.
    fn momentum_restitution(&self) -> Found<S> {
        let [_, velocity] = self.centre(&self.release()?.value)?;
        Ok(velocity.over(Bounded::new(self.rod().speed.clone(), 0.0)))
    }

    /// (4.71): `e_E² = E_h(t_b)/E_h(0)`.
    fn restitution(&self) -> Found<S> {
        let first = self.first_energy()?;
        if !first.is_positive() {
            return Err(NoAnswer::none("E_h ≤ 0 where the contact begins: nothing to compare with"));
        }
        let last = translational(self.rod(), self.centre(&self.release()?.value)?);
        if last.value.is_negative() {
            return Err(NoAnswer::none("E_h < 0 where the contact ends"));
        }
        Ok(last.over(Bounded::new(first, 0.0)))
    }
}

fn not_given<T>() -> Result<T, NoAnswer> {
    Err(NoAnswer::gave_up("this route does not give that"))
}

/// `L h′²/2 + L g h`, the errors of h and h′ carried on.
fn translational<S: System>(rod: &Parameters<S>, [height, velocity]: [Bounded<S>; 2]) -> Bounded<S> {
    let (length, g, speed) = (rod.length.to_f64(), rod.gravity.to_f64(), velocity.value.to_f64().abs());
    let carried = length * ((speed + velocity.bound) * velocity.bound + g * height.bound);
    let rounding =
        length * (speed * speed + g * height.value.to_f64().abs()) * 2f64.powf(height.value.log2_roundoff() + 3.0);
    let kinetic = velocity.value.square() / velocity.value.int(2);
    Bounded::new((kinetic + height.value * &rod.gravity) * &rod.length, carried + rounding)
}

fn bounded<S: System>(estimate: Estimate<S>) -> Bounded<S> {
    Bounded::new(estimate.value, estimate.error)
}

fn both<S: System>((a, b): (Estimate<S>, Estimate<S>)) -> [Bounded<S>; 2] {
    [bounded(a), bounded(b)]
}

/// A history.
pub(crate) struct ByHistory<'a, S> {
    history: &'a dyn History<S>,
    rod: Parameters<S>,
}

impl<'a, S: System> ByHistory<'a, S> {
    pub(crate) fn of(problem: &Problem, history: &'a dyn History<S>) -> Result<Self, Error> {
        let rod = Parameters::of(problem, &history.scales().length.precision())?;
        Ok(ByHistory { history, rod })
    }

    /// A value with the bound of the history, relative to `scale` of speed, time and length.
    fn within(&self, value: S, scale: impl Fn(f64, f64, f64) -> f64) -> Bounded<S> {
        let scales = self.history.scales();
        let scale = scale(scales.velocity.to_f64(), scales.time.to_f64(), scales.length.to_f64());
        Bounded::new(value, self.history.error_estimate().to_f64() * scale)
    }

    /// A history that ends too early says why.
    fn refused(&self, error: Error) -> NoAnswer {
        match error {
            Error::TimeOutside { .. } => self.ended(),
            other => other.into(),
        }
    }

    fn ended(&self) -> NoAnswer {
        match self.history.ending() {
            undecided @ (Ending::Undecided(_) | Ending::ExactnessEnds { .. }) => NoAnswer::gave_up(undecided),
            ending => NoAnswer::none(ending.to_string()),
        }
    }
}

impl<S: System> Motion<S> for ByHistory<'_, S> {
    fn rod(&self) -> &Parameters<S> {
        &self.rod
    }

    fn release(&self) -> Found<S> {
        let release = self.history.events().iter().find(|event| event.kind == EventKind::Release);
        release.map(|event| Bounded::new(event.time.clone(), event.time_error)).ok_or_else(|| self.ended())
    }

    fn event_near(&self, kind: EventKind, near: f64) -> Found<S> {
        let apart = |time: &S| (time.to_f64() - near).abs();
        let events = self.history.events().iter().filter(|event| event.kind == kind && apart(&event.time) < 0.25);
        let nearest = events.min_by(|a, b| apart(&a.time).total_cmp(&apart(&b.time)));
        nearest.map(|event| Bounded::new(event.time.clone(), event.time_error)).ok_or_else(|| self.ended())
    }

    fn last_event(&self) -> Found<S> {
        // The last event before a doubt is not the last of the run.
        if let undecided @ (Ending::Undecided(_) | Ending::ExactnessEnds { .. }) = self.history.ending() {
            return Err(NoAnswer::gave_up(undecided));
        }
        let last = self.history.events().last();
        last.map(|event| Bounded::new(event.time.clone(), event.time_error))
            .ok_or_else(|| NoAnswer::none("nothing happens in it"))
    }

    fn stress(&self, time: &S, side: Side) -> Found<S> {
        let stress = self.history.stress(time, side).map_err(|error| self.refused(error))?;
        Ok(self.within(stress, |speed, _, _| speed / self.rod.wave_speed.to_f64()))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<[Bounded<S>; 3], NoAnswer> {
        let field = self.history.field(point, time, side).map_err(|error| self.refused(error))?;
        Ok([
            self.within(field.displacement, |speed, time, _| speed * time),
            self.within(field.velocity, |speed, _, _| speed),
            self.within(field.strain, |speed, _, _| speed / self.rod.wave_speed.to_f64()),
        ])
    }

    fn centre(&self, time: &S) -> Result<[Bounded<S>; 2], NoAnswer> {
        let (height, velocity) = self.history.centre(time).map_err(|error| self.refused(error))?;
        Ok([self.within(height, |speed, time, _| speed * time), self.within(velocity, |speed, _, _| speed)])
    }

    fn total_energy(&self, time: &S) -> Found<S> {
        let energy = self.history.energy(time).map_err(|error| self.refused(error))?;
        Ok(self.within(energy.total, |speed, _, length| speed * speed * length))
    }

    fn translational_energy(&self, time: &S) -> Found<S> {
        let energy = self.history.energy(time).map_err(|error| self.refused(error))?;
        Ok(self.within(energy.translational, |speed, _, length| speed * speed * length))
    }

    fn vibrational_energy(&self, time: &S) -> Found<S> {
        let energy = self.history.energy(time).map_err(|error| self.refused(error))?;
        Ok(self.within(energy.vibrational, |speed, _, length| speed * speed * length))
    }

    fn first_energy(&self) -> Result<S, NoAnswer> {
        let contact = self.history.contacts().first().ok_or_else(|| NoAnswer::none("no contact in it"))?;
        Ok(translational(&self.rod, self.centre(&contact.from)?).value)
    }

    fn top(&self) -> Result<[Bounded<S>; 2], NoAnswer> {
        let release = self.history.events().iter().find(|event| event.kind == EventKind::Release);
        let top = self.history.highest(release.ok_or_else(|| self.ended())?);
        let (time, height) = top.ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([self.within(time, |_, time, _| time), self.within(height, |speed, time, _| speed * time)])
    }
}

/// The closed form of the first contact, and of the flight after it.
pub(crate) struct ByClosedForm<'a, S> {
    rod: Parameters<S>,
    contact: FirstContact<S>,
    search: &'a dyn Fn(&FirstContact<S>) -> Bounce<S>,
    bounce: OnceCell<Bounce<S>>,
}

impl<'a, S: System + Analytic> ByClosedForm<'a, S> {
    /// `search` finds the bounce, if a quantity asks for it.
    pub(crate) fn of(
        problem: &Problem,
        precision: &S::Precision,
        search: &'a dyn Fn(&FirstContact<S>) -> Bounce<S>,
    ) -> Result<Self, Error> {
        let rod = Parameters::of(problem, precision)?;
        Ok(ByClosedForm { contact: FirstContact::new(&rod), rod, search, bounce: OnceCell::new() })
    }

    fn bounce(&self) -> &Bounce<S> {
        self.bounce.get_or_init(|| (self.search)(&self.contact))
    }
}

impl<S: System + Analytic> Motion<S> for ByClosedForm<'_, S> {
    fn rod(&self) -> &Parameters<S> {
        &self.rod
    }

    fn release(&self) -> Found<S> {
        match self.bounce() {
            Bounce::At { time, error, .. } => Ok(Bounded::new(time.clone(), *error)),
            Bounce::Never { reason } => Err(NoAnswer::none(reason.clone())),
            Bounce::Undecided { why, .. } => Err(NoAnswer::gave_up(why)),
        }
    }

    fn stress(&self, time: &S, side: Side) -> Found<S> {
        Ok(bounded(self.contact.stress(time, side)))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<[Bounded<S>; 3], NoAnswer> {
        let (field, [v, v_t, v_x]) = self.contact.field(point, time, side);
        Ok([Bounded::new(field.displacement, v), Bounded::new(field.velocity, v_t), Bounded::new(field.strain, v_x)])
    }

    fn centre(&self, time: &S) -> Result<[Bounded<S>; 2], NoAnswer> {
        // No contact is shorter than a round trip.
        if *time > self.rod.round_trip()
            && let Bounce::At { time: end, .. } = self.bounce()
            && time > end
        {
            let (height, velocity) = self.contact.rebound(end).flight(time);
            return Ok([Bounded::rounded(height), Bounded::rounded(velocity)]);
        }
        Ok(both(self.contact.centre(time)))
    }

    fn total_energy(&self, time: &S) -> Found<S> {
        let (energy, [total, ..]) = self.contact.energy(time);
        Ok(Bounded::new(energy.total, total))
    }

    fn vibrational_energy(&self, time: &S) -> Found<S> {
        let (energy, [.., vibrational]) = self.contact.energy(time);
        Ok(Bounded::new(energy.vibrational, vibrational))
    }

    fn top(&self) -> Result<[Bounded<S>; 2], NoAnswer> {
        let top = self.contact.rebound(&self.release()?.value).highest();
        let (time, height) = top.ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([Bounded::rounded(time), Bounded::rounded(height)])
    }
}

/// The modal sum of the first contact.
pub(crate) struct ByModes {
    rod: Parameters<f64>,
    modal: Modal<f64>,
}

impl ByModes {
    pub(crate) fn of(problem: &Problem, modes: u32) -> Result<Self, Error> {
        let rod = Parameters::of(problem, &())?;
        Ok(ByModes { modal: Modal::new(&rod, modes), rod })
    }
}

/// Looks in each round trip by which a release is found that no proof brackets.
const LOOKS: i64 = 8;

fn found(release: Option<f64>) -> Found<f64> {
    let time = release.ok_or_else(|| NoAnswer::gave_up("no tensile stress in 64 round trips"))?;
    Ok(Bounded::new(time, f64::INFINITY))
}

impl Motion<f64> for ByModes {
    fn rod(&self) -> &Parameters<f64> {
        &self.rod
    }

    fn release(&self) -> Found<f64> {
        found(formulas::first_release(self.rod.round_trip(), LOOKS, |t, side| self.modal.stress(&t, side).value))
    }

    fn stress(&self, time: &f64, side: Side) -> Found<f64> {
        Ok(bounded(self.modal.stress(time, side)))
    }

    fn field(&self, point: &f64, time: &f64, side: Side) -> Result<[Bounded<f64>; 3], NoAnswer> {
        let (field, [v, v_t, v_x]) = self.modal.field(point, time, side);
        Ok([Bounded::new(field.displacement, v), Bounded::new(field.velocity, v_t), Bounded::new(field.strain, v_x)])
    }

    fn centre(&self, time: &f64) -> Result<[Bounded<f64>; 2], NoAnswer> {
        Ok(both(self.modal.centre(time)))
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        Ok(bounded(self.modal.energy(time)))
    }
}

/// The paper's integrals as printed.
pub(crate) struct ByPrintedIntegrals {
    pub(crate) rod: Parameters<f64>,
    pub(crate) printed: Printed,
}

impl Motion<f64> for ByPrintedIntegrals {
    fn rod(&self) -> &Parameters<f64> {
        &self.rod
    }

    fn release(&self) -> Found<f64> {
        found(self.printed.release(self.rod.round_trip(), LOOKS))
    }

    fn stress(&self, time: &f64, _: Side) -> Found<f64> {
        Ok(Bounded::new(self.printed.stress(*time), f64::INFINITY))
    }

    fn height(&self, time: &f64) -> Found<f64> {
        Ok(Bounded::new(self.printed.centre(*time), f64::INFINITY))
    }

    fn centre(&self, time: &f64) -> Result<[Bounded<f64>; 2], NoAnswer> {
        let velocity = self.printed.momentum(*time) / self.rod.length;
        Ok([self.height(time)?, Bounded::new(velocity, f64::INFINITY)])
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        Ok(Bounded::new(self.printed.energy(*time), f64::INFINITY))
    }
}

/// The paper's closed forms of `r = 0`.
pub(crate) struct ByPrintedForms<S> {
    rod: Parameters<S>,
    contact: UndampedContact<S>,
}

impl<S: System> ByPrintedForms<S> {
    pub(crate) fn of(problem: &Problem, precision: &S::Precision) -> Result<Self, NoAnswer> {
        let rod = Parameters::of(problem, precision)?;
        let contact = UndampedContact::new(&rod).ok_or_else(|| NoAnswer::gave_up("they are printed for r = 0"))?;
        Ok(ByPrintedForms { rod, contact })
    }
}

fn exact<S: System>(value: S) -> Bounded<S> {
    Bounded::new(value, 0.0)
}

impl<S: System> Motion<S> for ByPrintedForms<S> {
    fn rod(&self) -> &Parameters<S> {
        &self.rod
    }

    fn release(&self) -> Found<S> {
        Ok(exact(self.contact.bounce_time()))
    }

    fn stress(&self, time: &S, side: Side) -> Found<S> {
        Ok(exact(self.contact.stress(time, side)))
    }

    fn centre(&self, time: &S) -> Result<[Bounded<S>; 2], NoAnswer> {
        let (height, velocity) = self.contact.centre(time);
        Ok([exact(height), exact(velocity)])
    }

    fn momentum(&self, time: &S) -> Found<S> {
        Ok(exact(self.contact.momentum(time)))
    }

    fn total_energy(&self, _: &S) -> Found<S> {
        Ok(exact(self.contact.total_energy()))
    }

    fn translational_energy(&self, time: &S) -> Found<S> {
        Ok(exact(self.contact.translational_energy(time)))
    }

    fn vibrational_energy(&self, time: &S) -> Found<S> {
        if *time == self.contact.bounce_time() {
            Ok(exact(self.contact.vibrational_energy_at_bounce()))
        } else {
            not_given()
        }
    }

    fn momentum_restitution(&self) -> Found<S> {
        Ok(exact(self.contact.momentum_restitution()))
    }

    fn restitution(&self) -> Found<S> {
        self.contact.energy_restitution_squared().map(exact).ok_or_else(|| NoAnswer::none("nothing moves"))
    }

    fn top(&self) -> Result<[Bounded<S>; 2], NoAnswer> {
        let (time, height) = self.contact.highest().ok_or_else(|| NoAnswer::none("no top"))?;
        Ok([exact(time), exact(height)])
    }
}

/// Finite differences, which end at the time that is asked for.
pub(crate) struct ByDifferences {
    pub(crate) rod: Parameters<f64>,
    pub(crate) marched: Marched,
}

impl ByDifferences {
    fn event(&self, event: Option<&(EventKind, f64)>) -> Found<f64> {
        let (_, time) = event.ok_or_else(|| NoAnswer::gave_up("no such event found with so few cells"))?;
        Ok(Bounded::new(*time, f64::INFINITY))
    }
}

impl Motion<f64> for ByDifferences {
    fn rod(&self) -> &Parameters<f64> {
        &self.rod
    }

    fn release(&self) -> Found<f64> {
        self.event(self.marched.events.iter().find(|event| event.0 == EventKind::Release))
    }

    fn last_event(&self) -> Found<f64> {
        self.event(self.marched.events.last())
    }

    fn stress(&self, _: &f64, _: Side) -> Found<f64> {
        Ok(Bounded::new(self.marched.stress, f64::INFINITY))
    }

    fn centre(&self, time: &f64) -> Result<[Bounded<f64>; 2], NoAnswer> {
        let at =
            self.marched.at(*time).ok_or_else(|| NoAnswer::gave_up("only the first release and the end are kept"))?;
        Ok([at.centre, at.velocity].map(|value| Bounded::new(value, f64::INFINITY)))
    }

    fn total_energy(&self, time: &f64) -> Found<f64> {
        let at =
            self.marched.at(*time).ok_or_else(|| NoAnswer::gave_up("only the first release and the end are kept"))?;
        Ok(Bounded::new(at.energy, f64::INFINITY))
    }
}
