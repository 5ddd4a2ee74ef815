//! Methods that give values of the first contact without a history: the closed form, the modal sum, the paper's printed
//! formulas, and finite differences.

use std::cell::OnceCell;
use std::cmp::Ordering;

use super::differences::March;
use crate::error::VerifyError;
use crate::modal::Modal;
use crate::paper::{PrintedIntegrals, UndampedContact, first_release};
use dalembert::engine::{Bounce, FirstContact};
use dalembert::number::{Estimate, Scalar};
use dalembert::problem::Parameters;
use dalembert::quantity::Quantity;
use dalembert::special::BoundedSpecial;
use dalembert::{EventKind, Side};

type Double = Estimate<f64>;

/// Place, time and side of a value of `rod`; zeros for a quantity without a place or a time.
pub(super) struct Query<'a, S> {
    pub(super) rod: &'a Parameters<S>,
    pub(super) point: S,
    pub(super) time: S,
    pub(super) side: Side,
}

/// A method that gives values of the first contact of a rod, and of the flight after it.
pub(super) trait Method<S: Scalar> {
    /// Computes `quantity` by a formula of the method itself; `None` where the method has none. Energies are per linear
    /// density. A value without a bound has an infinite one.
    fn formula(&self, quantity: Quantity, query: &Query<'_, S>) -> Option<Result<S, VerifyError>>;
}

/// Computes `quantity` by the method's own formula, or from other quantities that it has.
pub(super) fn evaluate<S: Scalar>(
    method: &dyn Method<S>,
    quantity: Quantity,
    query: &Query<'_, S>,
) -> Result<S, VerifyError> {
    if let Some(value) = method.formula(quantity, query) {
        return value;
    }
    let of = |quantity: Quantity| evaluate(method, quantity, query);
    let end = || {
        let (time, point) = (of(Quantity::BounceTime)?, query.rod.length.zero());
        Ok::<_, VerifyError>(Query { time, point, ..*query })
    };
    match quantity {
        Quantity::LastEvent => of(Quantity::BounceTime),
        Quantity::Stress | Quantity::Force => of(Quantity::Strain),
        Quantity::TranslationalEnergy => {
            Ok(translational(query.rod, [of(Quantity::Centre)?, of(Quantity::CentreVelocity)?]))
        }
        Quantity::VibrationalEnergy => Ok(of(Quantity::Energy)? - of(Quantity::TranslationalEnergy)?),
        // `e_P = h′(t_b)/μ`.
        Quantity::MomentumRestitution => Ok(evaluate(method, Quantity::CentreVelocity, &end()?)? / &query.rod.speed),
        // (4.71): `e_E² = E_h(t_b)/E_h(0)`.
        Quantity::EnergyRestitution => {
            let first = first_energy(query.rod);
            if first.positive() != Ok(true) {
                return Err(VerifyError::none("E_h ≤ 0 where the contact begins: nothing to compare with"));
            }
            let last = evaluate(method, Quantity::TranslationalEnergy, &end()?)?;
            if last.negative() == Ok(true) {
                return Err(VerifyError::none("E_h < 0 where the contact ends"));
            }
            Ok(last / first)
        }
        Quantity::TranslationalShare => {
            let end = end()?;
            Ok(evaluate(method, Quantity::TranslationalEnergy, &end)? / evaluate(method, Quantity::Energy, &end)?)
        }
        Quantity::EnergyKept => Ok(evaluate(method, Quantity::Energy, &end()?)? / first_energy(query.rod)),
        _ => Err(VerifyError::NotGiven),
    }
}

/// Computes `E_h` at the beginning of the first contact: `μ²L/2` for the paper's start.
fn first_energy<S: Scalar>(rod: &Parameters<S>) -> S {
    rod.speed.square() * &rod.length / rod.length.int(2)
}

/// Computes `E_h = L h′²/2 + L g h`. **Source**: (3.63).
fn translational<S: Scalar>(rod: &Parameters<S>, [height, velocity]: [S; 2]) -> S {
    (velocity.square() / velocity.int(2) + height * &rod.gravity) * &rod.length
}

/// Wraps the value of a method that gives no bound.
pub(super) fn unbounded<S>(value: S) -> Estimate<S> {
    Estimate::new(value, f64::INFINITY)
}

/// The closed form of the first contact and of the flight after it.
pub(super) struct ClosedForm<N> {
    contact: FirstContact<N>,
    bounce: OnceCell<Bounce<N>>,
}

impl<N: BoundedSpecial> ClosedForm<N> {
    pub(super) fn new(rod: &Parameters<N>) -> Self {
        ClosedForm { contact: FirstContact::new(rod), bounce: OnceCell::new() }
    }

    fn bounce(&self) -> &Bounce<N> {
        self.bounce.get_or_init(|| self.contact.bounce())
    }

    /// Computes `h` and `h′`.
    fn centre(&self, query: &Query<'_, N>) -> (N, N) {
        // No contact is shorter than a round trip.
        if query.rod.round_trip().below(&query.time) == Ok(true)
            && let Bounce::At { time: end, .. } = self.bounce()
            && end.below(&query.time) == Ok(true)
        {
            return self.contact.rebound(end).flight(&query.time);
        }
        self.contact.centre(&query.time)
    }

    /// Computes the time and the height of the top of the flight.
    fn top(&self) -> Result<(N, N), VerifyError> {
        let Bounce::At { time: end, .. } = self.bounce() else { return Err(VerifyError::none("no bounce")) };
        self.contact.rebound(end).highest().ok_or_else(|| VerifyError::none("no top"))
    }
}

impl<N: BoundedSpecial> Method<N> for ClosedForm<N> {
    fn formula(&self, quantity: Quantity, query: &Query<'_, N>) -> Option<Result<N, VerifyError>> {
        let field = || self.contact.field(&query.point, &query.time, query.side);
        Some(Ok(match quantity {
            Quantity::BounceTime => match self.bounce() {
                Bounce::At { time, .. } => time.clone(),
                Bounce::Never(reason) => return Some(Err(VerifyError::none(reason.to_string()))),
                Bounce::Undecided { why, .. } => return Some(Err(VerifyError::Undecided(why.to_string()))),
            },
            Quantity::Strain => self.contact.strain(&query.time, query.side),
            Quantity::PointDisplacement => field().displacement,
            Quantity::PointVelocity => field().velocity,
            Quantity::PointStrain => field().strain,
            Quantity::Centre => self.centre(query).0,
            Quantity::CentreVelocity => self.centre(query).1,
            Quantity::TranslationalEnergy => translational(query.rod, self.centre(query).into()),
            Quantity::Energy => self.contact.energy(&query.time).total,
            Quantity::VibrationalEnergy => self.contact.energy(&query.time).vibrational,
            Quantity::TopTime => return Some(self.top().map(|top| top.0)),
            Quantity::Top => return Some(self.top().map(|top| top.1)),
            _ => return None,
        }))
    }
}

/// Samples of the stress in each round trip in the search for a release.
const SAMPLES: i64 = 8;

fn searched(release: Option<f64>) -> Result<Double, VerifyError> {
    release.map(unbounded).ok_or(VerifyError::NoTensileStress)
}

impl Method<Double> for Modal<f64> {
    fn formula(&self, quantity: Quantity, query: &Query<'_, Double>) -> Option<Result<Double, VerifyError>> {
        let time = query.time.value();
        let field = || self.field(query.point.value(), time, query.side);
        Some(Ok(match quantity {
            Quantity::BounceTime => {
                let trip = query.rod.round_trip().into_value();
                let stress = |t: f64, side: Side| self.strain(&t, side).into_value();
                return Some(searched(first_release(trip, SAMPLES, stress)));
            }
            Quantity::Strain => self.strain(time, query.side),
            Quantity::PointDisplacement => field().displacement,
            Quantity::PointVelocity => field().velocity,
            Quantity::PointStrain => field().strain,
            Quantity::Centre => self.centre(time).0,
            Quantity::CentreVelocity => self.centre(time).1,
            Quantity::TranslationalEnergy => translational(query.rod, self.centre(time).into()),
            Quantity::Energy => self.energy(time),
            _ => return None,
        }))
    }
}

impl Method<Double> for PrintedIntegrals {
    fn formula(&self, quantity: Quantity, query: &Query<'_, Double>) -> Option<Result<Double, VerifyError>> {
        let time = *query.time.value();
        Some(Ok(unbounded(match quantity {
            Quantity::BounceTime => return Some(searched(self.release(query.rod.round_trip().into_value(), SAMPLES))),
            Quantity::Strain => self.strain(time),
            Quantity::Centre => self.centre(time),
            Quantity::CentreVelocity => self.momentum(time) / query.rod.length.value(),
            Quantity::Energy => self.energy(time),
            _ => return None,
        })))
    }
}

impl<S: Scalar + PartialOrd> Method<S> for UndampedContact<S> {
    fn formula(&self, quantity: Quantity, query: &Query<'_, S>) -> Option<Result<S, VerifyError>> {
        let (time, no_top) = (&query.time, || VerifyError::none("no top"));
        Some(match quantity {
            Quantity::BounceTime => Ok(self.bounce_time()),
            Quantity::Strain => Ok(self.strain(time, query.side)),
            Quantity::Centre => Ok(self.centre(time).0),
            Quantity::CentreVelocity => Ok(self.momentum(time) / &query.rod.length),
            Quantity::Energy => Ok(self.total_energy()),
            Quantity::TranslationalEnergy => Ok(self.translational_energy(time)),
            Quantity::VibrationalEnergy => {
                let at_bounce = time.compare(&self.bounce_time()).is_ok_and(Ordering::is_eq);
                if at_bounce { Ok(self.vibrational_energy_at_bounce()) } else { Err(VerifyError::NotGiven) }
            }
            Quantity::MomentumRestitution => Ok(self.momentum_restitution()),
            Quantity::EnergyRestitution => {
                self.energy_restitution_squared().ok_or_else(|| VerifyError::none("nothing moves"))
            }
            Quantity::TopTime => self.highest().map(|top| top.0).ok_or_else(no_top),
            Quantity::Top => self.highest().map(|top| top.1).ok_or_else(no_top),
            _ => return None,
        })
    }
}

impl Method<Double> for March {
    fn formula(&self, quantity: Quantity, query: &Query<'_, Double>) -> Option<Result<Double, VerifyError>> {
        let state = self.state_at(*query.time.value()).ok_or(VerifyError::TimeNotKept);
        let value = match quantity {
            Quantity::BounceTime => {
                let release = self.events.iter().find(|(kind, _)| *kind == EventKind::Release);
                release.map(|(_, time)| *time).ok_or(VerifyError::NoRelease)
            }
            Quantity::LastEvent => self.events.last().map(|(_, time)| *time).ok_or(VerifyError::NoEvent),
            Quantity::Strain => Ok(self.strain),
            Quantity::Centre => state.map(|state| state.centre),
            Quantity::CentreVelocity => state.map(|state| state.velocity),
            Quantity::Energy => state.map(|state| state.energy),
            _ => return None,
        };
        Some(value.map(unbounded))
    }
}
