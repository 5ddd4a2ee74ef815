//! The answers of a run of a chain in any number system, as [`Value`]s.

use std::fmt;

use super::column::{ChainColumn, ChainQuantity};
use super::definition::Chain;
use super::listing::ChainListing;
use super::node::Stage;
use super::numbers::{ChainNumbers, NumberRows};
use super::run::{ChainRun, ForcePiece};
use super::sums::BodySums;
use super::wave::Limit;
use crate::error::Error;
use crate::motion::{Ending, Field, Side};
use crate::number::{
    Bounded, Estimate, Float, Interval, IntervalPrecision, IntoValue, Number, Open, Rational, Value, Wide,
};
use crate::solve::{LONG, Observer, Rung};

/// A time that is asked about.
#[derive(Clone, Copy, Debug)]
pub enum ChainTime<'a> {
    /// The time that a number spells.
    Spelled(&'a Number),
    /// A time that was computed: that of an event, or of another change at a node, within eight roundings of it, or
    /// exactly this one.
    Computed(f64),
    /// The event of the [`listing`](super::ChainHistory::listing) with this index.
    Event(usize),
}

/// A run in any number system.
pub(super) trait Answers: fmt::Debug + Send + Sync {
    fn listing(&self) -> ChainListing;
    fn forces(&self, node: usize) -> Vec<ForcePiece<Value>>;
    fn time(&self, time: ChainTime<'_>) -> Result<Value, Error>;
    /// Returns the value of a column; where a jump is not told from the time, its bound covers both limits. A jump
    /// that agrees with an event to 19 digits within the bounds of both is at the event.
    fn column(&self, column: ChainColumn, time: ChainTime<'_>, side: Side) -> Result<Value, Error>;
    /// Returns numbers that are asked for together.
    fn rows(&self, numbers: ChainNumbers<'_>) -> Result<NumberRows<Value>, Error>;
    /// Returns the field at a point; where a ray is not told from it, the bounds cover both limits.
    fn field(&self, body: usize, point: &Number, time: &Number, side: Side) -> Result<Field<Value>, Error>;
    fn ending(&self) -> &Ending;
    fn doubt(&self) -> Option<f64>;
    fn pieces(&self) -> usize;
}

impl ChainTime<'_> {
    /// Returns the number of digits in which the time is written.
    pub(super) fn digits(self) -> u32 {
        match self {
            ChainTime::Spelled(time) => time.written_digits(),
            ChainTime::Computed(_) => DIGITS_OF_DOUBLES,
            ChainTime::Event(_) => 0,
        }
    }

    /// Returns the time in the numbers of a run, and whether it is that of an event or another change.
    fn in_run<N: Bounded>(self, run: &ChainRun<N>) -> Result<(N, bool), Error> {
        match self {
            ChainTime::Spelled(time) => Ok((N::spelling(time, &run.end.precision()), false)),
            ChainTime::Computed(time) => Ok(match run.change_near(time) {
                Some(change) => (change.clone(), true),
                None => (run.end.double(time), false),
            }),
            ChainTime::Event(event) => Ok((run.events.get(event).ok_or(Error::Open(Open))?.t.clone(), true)),
        }
    }
}

/// Digits of a double.
const DIGITS_OF_DOUBLES: u32 = 17;

/// Number of changes of a node within such a distance that are compared.
const MOST_NEAR: usize = 8;

/// Roundings within which a computed time is that of a change.
const ROUNDINGS: f64 = 8.0;

impl<N: Bounded> ChainRun<N> {
    /// Returns the time of the event that is nearest to a double, within eight roundings, or else that of the nearest
    /// change of a node.
    fn change_near(&self, time: f64) -> Option<&N> {
        let apart = |change: &N| (change.to_f64() - time).abs();
        let is_near = |change: &&N| apart(change) <= ROUNDINGS * f64::EPSILON * time.abs();
        let event = self.events.iter().map(|event| &event.t).filter(is_near);
        let near = time - 2.0 * ROUNDINGS * f64::EPSILON * time.abs();
        let later = |stages: &'_ [Stage<N>]| stages.partition_point(|stage| stage.from.to_f64() < near);
        let of_node = self.nodes.iter().flat_map(|stages| stages[later(stages)..].iter().take(MOST_NEAR));
        let change = of_node.map(|stage| &stage.from).filter(is_near);
        let nearest = |a: &&N, b: &&N| apart(a).total_cmp(&apart(b));
        event.min_by(nearest).or_else(|| change.min_by(nearest))
    }

    /// Returns the value of a column; where a jump is not told from the time, its bound covers both limits.
    pub(super) fn value_within(&self, column: ChainColumn, time: &N, limit: Limit) -> Result<N, Error> {
        let ChainColumn { quantity, place } = column;
        let end = |is_top: bool| self.field_within(place, &self.end_point(place, is_top), time, limit);
        let sums = || self.sums(place, time);
        Ok(match quantity {
            ChainQuantity::EndDisplacement => end(false)?.displacement,
            ChainQuantity::EndVelocity => end(false)?.velocity,
            ChainQuantity::TopDisplacement => end(true)?.displacement,
            ChainQuantity::TopVelocity => end(true)?.velocity,
            ChainQuantity::Centre => sums()?.displacement,
            ChainQuantity::CentreVelocity => sums()?.velocity,
            ChainQuantity::Kinetic => sums()?.kinetic,
            ChainQuantity::StrainEnergy => sums()?.strain,
            ChainQuantity::Energy => {
                let BodySums { kinetic, strain, potential, .. } = sums()?;
                kinetic + strain + potential
            }
            ChainQuantity::Force => self.force_within(place, time, limit)?,
            ChainQuantity::Gap => self.gap(place, time)?,
            ChainQuantity::SpringEnergy => self.spring_energies_within(place, time, limit)?[0].clone(),
            ChainQuantity::Dissipated => self.spring_energies_within(place, time, limit)?[1].clone(),
            ChainQuantity::ChainEnergy => {
                let mut sum = time.zero();
                for body in 0..self.bars.len() {
                    let BodySums { kinetic, strain, potential, .. } = self.sums(body, time)?;
                    sum = sum + kinetic + strain + potential;
                }
                for node in 0..self.nodes.len() {
                    let [stored, lost] = self.spring_energies_within(node, time, limit)?;
                    sum = sum + stored + lost;
                }
                sum
            }
            ChainQuantity::ChainMomentum => {
                let mut sum = time.zero();
                for (body, bar) in self.bars.iter().enumerate() {
                    sum = sum + bar.mass() * self.sums(body, time)?.velocity;
                }
                sum
            }
        })
    }
}

impl<N: IntoValue> Answers for ChainRun<N> {
    fn listing(&self) -> ChainListing {
        let value = N::into;
        let events = self.events().iter().cloned().map(|event| event.map(value)).collect();
        let touches = self.touches().iter().cloned().map(|touch| touch.map(value)).collect();
        let contacts = self.contacts().into_iter().map(|contact| contact.map(value)).collect();
        let forces = |node| if self.is_curved(node) { Vec::new() } else { Answers::forces(self, node) };
        let forces = (0..self.nodes.len()).map(forces).collect();
        let ending = self.ending.clone();
        ChainListing { events, touches, contacts, forces, end: value(self.end().clone()), ending }
    }

    fn forces(&self, node: usize) -> Vec<ForcePiece<Value>> {
        self.force_pieces(node).into_iter().map(|piece| piece.map(N::into)).collect()
    }

    fn time(&self, time: ChainTime<'_>) -> Result<Value, Error> {
        Ok(time.in_run(self)?.0.into())
    }

    fn column(&self, column: ChainColumn, time: ChainTime<'_>, side: Side) -> Result<Value, Error> {
        let (time, is_event) = time.in_run(self)?;
        self.value_within(column, &time, Limit { side, is_event }).map(N::into)
    }

    fn rows(&self, numbers: ChainNumbers<'_>) -> Result<NumberRows<Value>, Error> {
        let row = |row: Vec<Option<N>>| row.into_iter().map(|number| number.map(N::into)).collect();
        Ok(numbers.of(self)?.into_iter().map(row).collect())
    }

    fn field(&self, body: usize, point: &Number, time: &Number, side: Side) -> Result<Field<Value>, Error> {
        let [point, time] = [point, time].map(|x| N::spelling(x, &self.end.precision()));
        Ok(self.field_within(body, &point, &time, Limit::at(side))?.map(N::into))
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn doubt(&self) -> Option<f64> {
        self.undetermined_from()
    }

    fn pieces(&self) -> usize {
        ChainRun::pieces(self)
    }
}

/// Runs `chain` in the numbers of `rung`.
pub(super) fn run(rung: Rung, chain: &Chain, observe: &Observer) -> Result<Box<dyn Answers>, Error> {
    let observe = &|events: usize, pieces: usize| observe(events, pieces);
    Ok(match rung {
        Rung::Double => Box::new(ChainRun::<Estimate<f64>>::new(chain, &(), observe)?),
        Rung::Fractions => Box::new(ChainRun::<Rational>::new(chain, &(), observe)?),
        Rung::Bits(..=128) if LONG => Box::new(ChainRun::<Estimate<Wide<2>>>::confirmed(chain, &(), 128, observe)?),
        Rung::Bits(129..=256) if LONG => Box::new(ChainRun::<Estimate<Wide<4>>>::confirmed(chain, &(), 256, observe)?),
        Rung::Bits(bits) if LONG => Box::new(ChainRun::<Estimate<Float>>::confirmed(chain, &bits, bits, observe)?),
        Rung::Enclosures(bits) if LONG => {
            let precision = IntervalPrecision { bits, exact: true };
            Box::new(ChainRun::<Interval>::new(chain, &precision, observe)?)
        }
        Rung::Bits(bits) | Rung::Enclosures(bits) | Rung::Confirmed(bits) => {
            return Err(Error::NotDecided { what: "what the answer is", bits });
        }
    })
}
