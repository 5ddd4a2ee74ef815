//! The accounts of a motion that can be asked beside a history: the closed form of the first contact, the modal sum,
//! the paper's printed formulas, and finite differences.

use std::cell::OnceCell;
use std::cmp::Ordering;

use super::differences::Marched;
use super::value::NoAnswer;
use crate::modal::Modal;
use crate::paper::{Printed, UndampedContact, formulas};
use dalembert::engine::{Bounce, FirstContact};
use dalembert::number::{Estimate, Scalar};
use dalembert::problem::Parameters;
use dalembert::quantity::Quantity;
use dalembert::special::BoundedSpecial;
use dalembert::{EventKind, Side};

/// One number of a motion, or why it is not given.
pub type Found<S> = Result<S, NoAnswer>;
type Double = Estimate<f64>;

/// Where and when a quantity is asked for; zeros where it has no place or no time.
pub struct At<'a, S> {
    pub rod: &'a Parameters<S>,
    pub point: S,
    pub time: S,
    pub side: Side,
}

/// An account of the first contact of a rod, and of the flight after it.
pub(crate) trait Account<S: Scalar> {
    /// A quantity for which the account has a formula of its own; `None` for any other. Energies are per linear
    /// density. A number without any bound has an infinite one.
    fn own(&self, quantity: Quantity, at: &At<'_, S>) -> Option<Found<S>>;
}

/// A quantity by the formula of an account, or by others that it has.
pub fn find<S: Scalar>(account: &dyn Account<S>, quantity: Quantity, at: &At<'_, S>) -> Found<S> {
    if let Some(found) = account.own(quantity, at) {
        return found;
    }
    let of = |quantity: Quantity| find(account, quantity, at);
    let end = || Ok::<_, NoAnswer>(At { time: of(Quantity::BounceTime)?, point: at.rod.length.zero(), ..*at });
    match quantity {
        Quantity::LastEvent => of(Quantity::BounceTime),
        Quantity::Stress | Quantity::Force => of(Quantity::Strain),
        Quantity::TranslationalEnergy => {
            Ok(translational(at.rod, [of(Quantity::Centre)?, of(Quantity::CentreVelocity)?]))
        }
        Quantity::VibrationalEnergy => Ok(of(Quantity::Energy)? - of(Quantity::TranslationalEnergy)?),
        // `e_P = h′(t_b)/μ`.
        Quantity::MomentumRestitution => Ok(find(account, Quantity::CentreVelocity, &end()?)? / &at.rod.speed),
        // (4.71): `e_E² = E_h(t_b)/E_h(0)`.
        Quantity::EnergyRestitution => {
            let first = first_energy(at.rod);
            if first.positive() != Ok(true) {
                return Err(NoAnswer::none("E_h ≤ 0 where the contact begins: nothing to compare with"));
            }
            let last = find(account, Quantity::TranslationalEnergy, &end()?)?;
            if last.negative() == Ok(true) {
                return Err(NoAnswer::none("E_h < 0 where the contact ends"));
            }
            Ok(last / first)
        }
        Quantity::TranslationalShare => {
            let end = end()?;
            Ok(find(account, Quantity::TranslationalEnergy, &end)? / find(account, Quantity::Energy, &end)?)
        }
        Quantity::EnergyKept => Ok(find(account, Quantity::Energy, &end()?)? / first_energy(at.rod)),
        _ => Err(not_given()),
    }
}

fn not_given() -> NoAnswer {
    NoAnswer::gave_up("this route does not give that")
}

/// `E_h` where the first contact begins: `μ²L/2` for the paper's start.
fn first_energy<S: Scalar>(rod: &Parameters<S>) -> S {
    rod.speed.square() * &rod.length / rod.length.int(2)
}

/// (3.63): `E_h = L h′²/2 + L g h`.
fn translational<S: Scalar>(rod: &Parameters<S>, [height, velocity]: [S; 2]) -> S {
    (velocity.square() / velocity.int(2) + height * &rod.gravity) * &rod.length
}

/// The value of an account that gives no bound.
pub fn unbounded<S>(value: S) -> Estimate<S> {
    Estimate::new(value, f64::INFINITY)
}

/// The closed form of the first contact, and of the flight after it.
pub struct ByClosedForm<N> {
    contact: FirstContact<N>,
    bounce: OnceCell<Bounce<N>>,
}

impl<N: BoundedSpecial> ByClosedForm<N> {
    pub fn new(rod: &Parameters<N>) -> Self {
        ByClosedForm { contact: FirstContact::new(rod), bounce: OnceCell::new() }
    }

    fn bounce(&self) -> &Bounce<N> {
        self.bounce.get_or_init(|| self.contact.bounce())
    }

    fn centre(&self, at: &At<'_, N>) -> (N, N) {
        // No contact is shorter than a round trip.
        if at.rod.round_trip().below(&at.time) == Ok(true)
            && let Bounce::At { time: end, .. } = self.bounce()
            && end.below(&at.time) == Ok(true)
        {
            return self.contact.rebound(end).flight(&at.time);
        }
        self.contact.centre(&at.time)
    }

    fn top(&self) -> Found<(N, N)> {
        let Bounce::At { time: end, .. } = self.bounce() else { return Err(NoAnswer::none("no bounce")) };
        self.contact.rebound(end).highest().ok_or_else(|| NoAnswer::none("no top"))
    }
}

impl<N: BoundedSpecial> Account<N> for ByClosedForm<N> {
    fn own(&self, quantity: Quantity, at: &At<'_, N>) -> Option<Found<N>> {
        let field = || self.contact.field(&at.point, &at.time, at.side);
        Some(Ok(match quantity {
            Quantity::BounceTime => match self.bounce() {
                Bounce::At { time, .. } => time.clone(),
                Bounce::Never(reason) => return Some(Err(NoAnswer::none(reason.to_string()))),
                Bounce::Undecided { why, .. } => return Some(Err(NoAnswer::gave_up(why))),
            },
            Quantity::Strain => self.contact.strain(&at.time, at.side),
            Quantity::PointDisplacement => field().displacement,
            Quantity::PointVelocity => field().velocity,
            Quantity::PointStrain => field().strain,
            Quantity::Centre => self.centre(at).0,
            Quantity::CentreVelocity => self.centre(at).1,
            Quantity::TranslationalEnergy => translational(at.rod, self.centre(at).into()),
            Quantity::Energy => self.contact.energy(&at.time).total,
            Quantity::VibrationalEnergy => self.contact.energy(&at.time).vibrational,
            Quantity::TopTime => return Some(self.top().map(|top| top.0)),
            Quantity::Top => return Some(self.top().map(|top| top.1)),
            _ => return None,
        }))
    }
}

/// Looks in each round trip by which a release is found that no proof brackets.
const LOOKS: i64 = 8;

fn looked_for(release: Option<f64>) -> Found<Double> {
    release.map(unbounded).ok_or_else(|| NoAnswer::gave_up("no tensile stress in 64 round trips"))
}

impl Account<Double> for Modal<f64> {
    fn own(&self, quantity: Quantity, at: &At<'_, Double>) -> Option<Found<Double>> {
        let time = at.time.value();
        let field = || self.field(at.point.value(), time, at.side);
        Some(Ok(match quantity {
            Quantity::BounceTime => {
                let trip = at.rod.round_trip().into_value();
                let stress = |t: f64, side: Side| self.strain(&t, side).into_value();
                return Some(looked_for(formulas::first_release(trip, LOOKS, stress)));
            }
            Quantity::Strain => self.strain(time, at.side),
            Quantity::PointDisplacement => field().displacement,
            Quantity::PointVelocity => field().velocity,
            Quantity::PointStrain => field().strain,
            Quantity::Centre => self.centre(time).0,
            Quantity::CentreVelocity => self.centre(time).1,
            Quantity::TranslationalEnergy => translational(at.rod, self.centre(time).into()),
            Quantity::Energy => self.energy(time),
            _ => return None,
        }))
    }
}

impl Account<Double> for Printed {
    fn own(&self, quantity: Quantity, at: &At<'_, Double>) -> Option<Found<Double>> {
        let time = *at.time.value();
        Some(Ok(unbounded(match quantity {
            Quantity::BounceTime => return Some(looked_for(self.release(at.rod.round_trip().into_value(), LOOKS))),
            Quantity::Strain => self.strain(time),
            Quantity::Centre => self.centre(time),
            Quantity::CentreVelocity => self.momentum(time) / at.rod.length.value(),
            Quantity::Energy => self.energy(time),
            _ => return None,
        })))
    }
}

impl<S: Scalar + PartialOrd> Account<S> for UndampedContact<S> {
    fn own(&self, quantity: Quantity, at: &At<'_, S>) -> Option<Found<S>> {
        let (time, no_top) = (&at.time, || NoAnswer::none("no top"));
        Some(match quantity {
            Quantity::BounceTime => Ok(self.bounce_time()),
            Quantity::Strain => Ok(self.strain(time, at.side)),
            Quantity::Centre => Ok(self.centre(time).0),
            Quantity::CentreVelocity => Ok(self.momentum(time) / &at.rod.length),
            Quantity::Energy => Ok(self.total_energy()),
            Quantity::TranslationalEnergy => Ok(self.translational_energy(time)),
            Quantity::VibrationalEnergy => {
                let at_bounce = time.compare(&self.bounce_time()).is_ok_and(Ordering::is_eq);
                if at_bounce { Ok(self.vibrational_energy_at_bounce()) } else { Err(not_given()) }
            }
            Quantity::MomentumRestitution => Ok(self.momentum_restitution()),
            Quantity::EnergyRestitution => {
                self.energy_restitution_squared().ok_or_else(|| NoAnswer::none("nothing moves"))
            }
            Quantity::TopTime => self.highest().map(|top| top.0).ok_or_else(no_top),
            Quantity::Top => self.highest().map(|top| top.1).ok_or_else(no_top),
            _ => return None,
        })
    }
}

impl Account<Double> for Marched {
    fn own(&self, quantity: Quantity, at: &At<'_, Double>) -> Option<Found<Double>> {
        let of = |value: Option<f64>, missing: &str| value.map(unbounded).ok_or_else(|| NoAnswer::gave_up(missing));
        let kept = |k: usize| of(self.at(*at.time.value()).map(|kept| kept[k]), "nothing is kept of that time");
        Some(match quantity {
            Quantity::BounceTime => {
                let release = self.events.iter().find(|event| event.0 == EventKind::Release);
                of(release.map(|event| event.1), "no release found")
            }
            Quantity::LastEvent => of(self.events.last().map(|event| event.1), "no event found"),
            Quantity::Strain => Ok(unbounded(self.stress)),
            Quantity::Centre => kept(0),
            Quantity::CentreVelocity => kept(1),
            Quantity::Energy => kept(2),
            _ => return None,
        })
    }
}
