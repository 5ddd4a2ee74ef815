//! Numbers of a chain that are asked for together.

use std::collections::BTreeMap;

use super::column::ChainColumn;
use super::definition::Chain;
use super::run::{ChainContact, ChainEvent, ChainRun};
use super::wave::Limit;
use crate::error::Error;
use crate::motion::{EventKind, Side};
use crate::number::{Bounded, Number};
use crate::quantity::Measure;

/// Numbers by row and column; `None` for one that is missing.
pub(crate) type NumberRows<N> = Vec<Vec<Option<N>>>;

/// Numbers of a chain by row and column.
#[derive(Clone, Copy, Debug)]
pub enum ChainNumbers<'a> {
    /// The time of each event, and the rates of the gap before and after it.
    Events,
    /// Impact, release, impulse and greatest force of each contact.
    Contacts,
    /// Quantities over time, a row for each time.
    Columns {
        /// The quantities.
        columns: &'a [ChainColumn],
        /// The times.
        times: &'a [Number],
        /// Limit at a jump.
        side: Side,
    },
    /// Displacement, velocity and strain of each body, a row for each time and, within it, each point.
    Fields {
        /// The indices of the bodies, from 0.
        bodies: &'a [usize],
        /// Points, from the lower end of each body.
        points: &'a [Number],
        /// The times.
        times: &'a [Number],
        /// Limit on a ray.
        side: Side,
    },
}

/// Node of the event that a row begins with, whether it is an impact, and its place among those of the node.
pub(crate) type RowKey = (usize, bool, usize);

impl ChainNumbers<'_> {
    /// Returns the name of each number of an event or a contact; none for numbers that are asked for at times.
    pub fn names(&self) -> &'static [&'static str] {
        match self {
            ChainNumbers::Events => &["t", "gap_rate_before", "gap_rate_after"],
            ChainNumbers::Contacts => &["impact", "release", "impulse", "peak_force"],
            ChainNumbers::Columns { .. } | ChainNumbers::Fields { .. } => &[],
        }
    }

    /// Returns the measure of each column.
    pub fn measures(&self) -> Vec<Measure> {
        match self {
            ChainNumbers::Events => vec![Measure::Time, Measure::Velocity, Measure::Velocity],
            ChainNumbers::Contacts => vec![Measure::Time, Measure::Time, Measure::Impulse, Measure::Force],
            ChainNumbers::Columns { columns, .. } => columns.iter().map(|column| column.quantity.measure()).collect(),
            ChainNumbers::Fields { bodies, .. } => {
                [Measure::Length, Measure::Velocity, Measure::Strain].repeat(bodies.len())
            }
        }
    }

    /// Returns whether the numbers are asked for at times, and not those of a list.
    pub(crate) fn is_at_times(&self) -> bool {
        matches!(self, ChainNumbers::Columns { .. } | ChainNumbers::Fields { .. })
    }

    /// Returns the times; none for numbers of a list.
    pub(crate) fn times(&self) -> &[Number] {
        match self {
            ChainNumbers::Events | ChainNumbers::Contacts => &[],
            ChainNumbers::Columns { times, .. } | ChainNumbers::Fields { times, .. } => times,
        }
    }

    /// Returns the points; none for numbers without one.
    pub(crate) fn points(&self) -> &[Number] {
        if let ChainNumbers::Fields { points, .. } = self { points } else { &[] }
    }

    /// Returns the same numbers with the limit from the other side.
    pub(crate) fn with_other_side(self) -> Self {
        match self {
            ChainNumbers::Columns { columns, times, side } => {
                ChainNumbers::Columns { columns, times, side: side.other() }
            }
            ChainNumbers::Fields { bodies, points, times, side } => {
                ChainNumbers::Fields { bodies, points, times, side: side.other() }
            }
            list => list,
        }
    }

    /// Checks that `chain` has the times, points, bodies and columns.
    ///
    /// **Errors**: [`Error::TimeOutside`]; [`Error::PointOutside`]; [`Error::Problem`] for a body or a node that there
    /// is not.
    pub(crate) fn check(&self, chain: &Chain) -> Result<(), Error> {
        let is_outside = |time: &&Number| time.to_f64() < 0.0 || time.compare(chain.until()).is_gt();
        if let Some(time) = self.times().iter().find(is_outside) {
            return Err(Error::TimeOutside { found: time.to_string(), end: chain.until().to_string() });
        }
        let (bodies, points) = match self {
            ChainNumbers::Events | ChainNumbers::Contacts => return Ok(()),
            ChainNumbers::Columns { columns, .. } => return columns.iter().try_for_each(|column| column.check(chain)),
            ChainNumbers::Fields { bodies, points, .. } => (bodies, points),
        };
        bodies.iter().try_for_each(|body| chain.check_body(*body))?;
        for body in bodies.iter().map(|body| &chain.bodies()[*body]) {
            let is_outside = |point: &&Number| point.to_f64() < 0.0 || point.compare(body.length()).is_gt();
            if let Some(point) = points.iter().find(is_outside) {
                return Err(Error::PointOutside { found: point.to_string(), length: body.length().to_string() });
            }
        }
        Ok(())
    }

    /// Returns the key of each row of a list, by which the same event is found in another run; nothing for other
    /// numbers.
    pub(crate) fn keys<N>(&self, events: &[ChainEvent<N>]) -> Vec<RowKey> {
        let is_asked = |is_impact: bool| match self {
            ChainNumbers::Events => true,
            ChainNumbers::Contacts => is_impact,
            ChainNumbers::Columns { .. } | ChainNumbers::Fields { .. } => false,
        };
        let mut counts: BTreeMap<(usize, bool), usize> = BTreeMap::new();
        let kinds = events.iter().map(|event| (event.node, event.kind == EventKind::Impact));
        let key = |(node, is_impact): (usize, bool)| {
            let count = counts.entry((node, is_impact)).or_default();
            *count += 1;
            (node, is_impact, *count)
        };
        kinds.filter(|(_, is_impact)| is_asked(*is_impact)).map(key).collect()
    }

    /// Returns the numbers of a run; `None` for one that is missing, as the end of a contact that lasts, or a number
    /// beyond the end of the run or of a body.
    pub(crate) fn of<N: Bounded>(&self, run: &ChainRun<N>) -> Result<NumberRows<N>, Error> {
        let lift = |list: &[Number]| -> Vec<N> {
            list.iter().map(|number| N::spelling(number, &run.end().precision())).collect()
        };
        let missing = |count: usize, found: Result<Vec<N>, Error>| match found {
            Ok(found) => Ok(found.into_iter().map(Some).collect()),
            Err(Error::TimeOutside { .. } | Error::PointOutside { .. }) => Ok(vec![None; count]),
            Err(error) => Err(error),
        };
        match *self {
            ChainNumbers::Events => {
                let row = |event: &ChainEvent<N>| event.numbers().map(|number| Some(number.clone())).into();
                Ok(run.events().iter().map(row).collect())
            }
            ChainNumbers::Contacts => {
                let row = |contact: ChainContact<N>| contact.numbers(run.ending()).map(Option::<&N>::cloned).into();
                Ok(run.contacts().into_iter().map(row).collect())
            }
            ChainNumbers::Columns { columns, times, side } => {
                let value = |column: &ChainColumn, time: &N| run.value_within(*column, time, Limit::at(side));
                let row = |time: N| missing(columns.len(), columns.iter().map(|column| value(column, &time)).collect());
                lift(times).into_iter().map(row).collect()
            }
            ChainNumbers::Fields { bodies, points, times, side } => {
                let points = lift(points);
                let fields = |time: &N, point: &N| {
                    let field = |body: &usize| {
                        let field = run.field_within(*body, point, time, Limit::at(side));
                        missing(3, field.map(|field| vec![field.displacement, field.velocity, field.strain]))
                    };
                    Ok(bodies.iter().map(field).collect::<Result<Vec<_>, Error>>()?.concat())
                };
                let times = lift(times);
                times
                    .iter()
                    .flat_map(|time| points.iter().map(move |point| (time, point)))
                    .map(|(t, x)| fields(t, x))
                    .collect()
            }
        }
    }
}
