//! The motion of one body of a chain, for the queries of a rod.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

use super::definition::Chain;
use super::run::{ChainContact, ChainEvent, ChainRun};
use super::start::Bar;
use super::sums::BodySums;
use super::wave::Wave;
use crate::error::Error;
use crate::motion::{Contact, Course, Event, EventKind, Field, Motion, Pair, Scales, Side, StressPiece, Stretch};
use crate::number::{Bounded, Open};
use crate::quantity::Measure;
use crate::reason::Warning;
use crate::threads::locked;

/// Runs of the latest chain, one for each number system and precision.
#[derive(Clone, Default)]
pub(crate) struct Runs(Arc<Mutex<Vec<KeptRun>>>);

struct KeptRun {
    chain: Chain,
    bits: u32,
    run: Arc<dyn Any + Send + Sync>,
}

impl fmt::Debug for Runs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} runs", locked(&self.0).len())
    }
}

impl Runs {
    /// Returns the run of `chain` in the numbers `N` of this many bits, which `make` makes if it is not kept.
    pub(crate) fn get<N: Bounded>(
        &self,
        chain: &Chain,
        bits: u32,
        make: impl FnOnce() -> Result<ChainRun<N>, Error>,
    ) -> Result<Arc<ChainRun<N>>, Error> {
        let known = |kept: &KeptRun| Some(kept).filter(|kept| kept.bits == bits && kept.chain == *chain)?.typed();
        if let Some(run) = locked(&self.0).iter().find_map(known) {
            return Ok(run);
        }
        let run = Arc::new(make()?);
        let mut kept = locked(&self.0);
        kept.retain(|kept| kept.chain == *chain);
        kept.push(KeptRun { chain: chain.clone(), bits, run: run.clone() });
        Ok(run)
    }
}

impl KeptRun {
    fn typed<N: Bounded>(&self) -> Option<Arc<ChainRun<N>>> {
        self.run.clone().downcast().ok()
    }
}

/// The motion of a body. Its end at the ground is the lower one, and its events and contacts are those of the node
/// below it.
///
/// **Accuracy**: that of the run.
#[derive(Debug)]
pub(crate) struct BodyMotion<N> {
    run: Arc<ChainRun<N>>,
    body: usize,
    /// The natural speed of the chain.
    speed: f64,
    course: OnceLock<Course<N>>,
}

/// Limit of the distance, in travel times, at which the centre of mass is read beside an event.
const MAX_ASIDE: f64 = 1e-6;

impl<N: Bounded> BodyMotion<N> {
    pub(crate) fn new(chain: &Chain, body: usize, run: Arc<ChainRun<N>>) -> Self {
        let speed = chain.scales().of(Measure::Velocity);
        BodyMotion { run, body, speed, course: OnceLock::new() }
    }

    /// Returns the first time at which events that agree within their bounds count as one.
    pub(crate) fn undetermined_from(&self) -> Option<f64> {
        self.run.undetermined_from()
    }

    fn bar(&self) -> &Bar<N> {
        &self.run.bars[self.body]
    }

    /// Returns `Zc`: the force at a strain of one.
    fn stiffness(&self) -> N {
        let Bar { wave_speed, impedance, .. } = self.bar();
        impedance.clone() * wave_speed
    }

    /// Returns `Z/c`: the mass of a unit of length.
    fn density(&self) -> N {
        let Bar { wave_speed, impedance, .. } = self.bar();
        impedance.clone() / wave_speed
    }

    fn make_course(&self) -> Course<N> {
        let own = |event: &&ChainEvent<N>| event.node == self.body;
        let most = self.greatest_acceleration();
        let events = self.run.events().iter().filter(own).map(|event| self.event(event, &most)).collect();
        let (stiffness, density) = (self.stiffness(), self.density());
        let contact = |contact: ChainContact<N>| Contact {
            impact: contact.impact,
            release: contact.release,
            impulse: contact.impulse / &density,
            peak_strain: -(contact.peak / &stiffness),
        };
        let contacts = self.run.contacts().into_iter().filter(|contact| contact.node == self.body).map(contact);
        Course {
            end: self.run.end().clone(),
            ending: self.run.ending().clone(),
            events,
            contacts: contacts.collect(),
            warnings: self.run.undetermined_from().map(|from| Warning::Coincidence { from }).into_iter().collect(),
        }
    }

    fn event(&self, event: &ChainEvent<N>, most: &N) -> Event<N> {
        let t = event.t.clone();
        let side = if event.kind == EventKind::Impact { Side::Left } else { Side::Right };
        let (h, h_rate) = self.centre_at_event(&t, most);
        Event { kind: event.kind, v_end: self.end_velocity(&t, side), h, h_rate, t_error: t.log2_error().exp2(), t }
    }

    /// Returns the velocity of the lower end on one side of an event. Breaks that agree with the event within their
    /// bounds are at the event.
    fn end_velocity(&self, time: &N, side: Side) -> N {
        let [up, down] = &self.run.waves[self.body];
        let arrived = time.clone() - &self.bar().travel;
        let [rising, falling] = [up.value_beside(time, side), down.value_beside(&arrived, side)];
        let [fall, _] = self.run.fallen(time);
        (rising + falling).halved() - fall
    }

    /// Returns `h` and `h′` at the time of an event, where rays of the same time leave the order of stretches open: the
    /// values beside it, widened by their greatest change.
    ///
    /// **Source**: `|h″| ≤ (F₋ + F₊)/m + g` with the greatest forces of both ends, the bound `most`.
    fn centre_at_event(&self, time: &N, most: &N) -> (N, N) {
        let travel = self.bar().travel.to_f64();
        let roundings = 16.0 * time.log2_roundoff().exp2() * time.to_f64().abs();
        let mut aside = (4.0 * time.log2_error().exp2()).max(roundings);
        let mut at = time.clone();
        loop {
            match self.run.sums(self.body, &at) {
                Ok(BodySums { displacement: height, velocity: rate, .. }) => {
                    let late = (time.clone() - &at).magnitude();
                    let faster = most.clone() * &late;
                    let higher = (rate.magnitude() + &faster) * &late;
                    return (height.widened(&higher), rate.widened(&faster));
                }
                Err(_) if aside <= MAX_ASIDE * travel && aside > 0.0 => {
                    let before = time.clone().nominal() - time.double(aside);
                    at = if before.negative() == Ok(false) { before } else { time.zero() };
                    aside *= 16.0;
                }
                Err(_) => {
                    let unknown = || time.zero().widened(&time.double(f64::MAX));
                    return (unknown(), unknown());
                }
            }
        }
    }

    /// Returns a bound of the acceleration of the centre of mass.
    fn greatest_acceleration(&self) -> N {
        let mass = self.density() * &self.bar().length;
        let force = |node: usize| self.run.greatest_force(node);
        // A force that is known within its bound may be greater by the bound.
        (force(self.body) + force(self.body + 1)).doubled() / &mass + self.run.gravity.magnitude()
    }
}

impl<N: Bounded> Motion<N> for BodyMotion<N> {
    fn course(&self) -> &Course<N> {
        self.course.get_or_init(|| self.make_course())
    }

    fn scales(&self) -> Scales<N> {
        let Bar { length, wave_speed, travel, .. } = self.bar().clone();
        let velocity = length.double(self.speed);
        Scales { time: travel.doubled(), velocity, length, wave_speed, gravity: self.run.gravity.clone() }
    }

    fn stress_pieces(&self) -> Vec<StressPiece<N>> {
        let stiffness = self.stiffness();
        let strain = |force: N| -(force / &stiffness);
        let pieces = self.run.force_pieces(self.body).into_iter();
        pieces
            .map(|piece| StressPiece {
                start: piece.start,
                end: piece.end,
                strain_start: strain(piece.first),
                strain_end: strain(piece.last),
                chebyshev: piece.series.into_iter().map(strain).collect(),
            })
            .collect()
    }

    fn strain(&self, time: &N, side: Side) -> Result<N, Error> {
        if side == Side::Left && time.positive() != Ok(true) {
            // The start need not agree with the forces at the ends.
            return Ok(self.run.end_field(self.body, false, time, side)?.strain);
        }
        Ok(-(self.run.force(self.body, time, side)? / self.stiffness()))
    }

    fn pair(&self, pair: Pair, time: &N, side: Side) -> Result<[N; 2], Error> {
        let sums = || self.run.sums(self.body, time);
        Ok(match pair {
            Pair::GroundEnd => {
                let Field { displacement, velocity, .. } = self.run.end_field(self.body, false, time, side)?;
                [displacement, velocity]
            }
            Pair::Centre => {
                let BodySums { displacement, velocity, .. } = sums()?;
                [displacement, velocity]
            }
            Pair::EnergyParts => {
                let BodySums { kinetic, strain, .. } = sums()?;
                [kinetic / self.density(), strain / self.density()]
            }
            Pair::Energy => {
                let (sums, length) = (sums()?, &self.bar().length);
                let vibration = self.run.vibration(self.body, time, &sums)?;
                let height = sums.displacement * &self.run.gravity;
                [(sums.velocity.square().halved() + height) * length, vibration]
            }
        })
    }

    fn field(&self, point: &N, time: &N, side: Side) -> Result<Field<N>, Error> {
        self.run.field(self.body, point, time, side)
    }

    fn end(&self) -> N {
        self.run.end().clone()
    }

    fn ending(&self) -> &crate::motion::Ending {
        self.run.ending()
    }

    fn in_contact(&self, time: &N, side: Side) -> Result<N, Error> {
        Ok(time.int(self.run.is_closed(self.body, time, side)?.into()))
    }

    fn departures(&self) -> Result<[Vec<(N, N)>; 2], Error> {
        let rays = |wave: &Wave<N>| wave.rays().map(|(from, jump)| (from.clone(), jump.halved())).collect();
        Ok(self.run.waves[self.body].each_ref().map(rays))
    }

    /// Computes the highest point of a body that falls freely; nothing where another body or a load acts on it before.
    fn highest(&self, release: usize) -> Option<(N, N)> {
        let (release, gravity) = (self.course().events.get(release)?, &self.run.gravity);
        let rate = &release.h_rate;
        if gravity.positive() != Ok(true) || rate.negative() == Ok(true) {
            return None;
        }
        let time = release.t.clone() + rate.clone() / gravity;
        let top = || release.h.clone() + (rate.square() / gravity).halved();
        self.run.is_unloaded(self.body + 1, &release.t, &time).then(|| (time, top()))
    }

    fn stretches(&self, time: &N) -> Result<Vec<Stretch<N>>, Error> {
        self.run.stretches(self.body, time)
    }

    fn may_jump(&self, time: &N) -> Result<bool, Error> {
        self.run.check_time(time)?;
        if time.positive() != Ok(true) {
            return Ok(true);
        }
        let earlier = time.clone() - &self.bar().travel;
        let passes = |at: &N| {
            let waves = self.run.waves[self.body].iter();
            waves.map(|wave| wave.may_jump(at)).try_fold(false, |any, jumps| Ok::<_, Open>(any || jumps?))
        };
        let breaks = |node: usize| self.run.may_jump(node, time);
        Ok(breaks(self.body)? || breaks(self.body + 1)? || passes(time)? || passes(&earlier)?)
    }

    /// Returns the greatest relative error of the times of events.
    fn error_estimate(&self) -> N {
        let relative =
            |event: &ChainEvent<N>| event.t.log2_error().exp2() / event.t.to_f64().abs().max(f64::MIN_POSITIVE);
        let events = self.run.events().iter().filter(|event| event.t.to_f64() > 0.0);
        self.run.end().double(events.map(relative).fold(0.0, f64::max))
    }
}
