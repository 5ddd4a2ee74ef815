//! The start of the motion where functions are exactly zero: contacts that touch, and springs without a load.
//!
//! **Source**: an analytic solution leaves zero with the sign of its first Taylor coefficient that is not zero. The
//! coefficients follow from the states and from those of the arriving signals, order by order. The bound of a signal
//! enters with its value, before its higher coefficients do. A signal that has just left zero brings its own series.

use std::cmp::Ordering;
use std::sync::Arc;

use super::cluster::{Cluster, Mass};
use super::curve::{Curve, stretched};
use super::interface::{Input, Interface, Mode, Row};
use super::node::Source;
use super::step::{Values, refs};
use crate::number::{Bounded, Open, is_exact_zero};

/// The Taylor series of a signal at a break at which it leaves zero.
#[derive(Debug)]
pub(super) struct Taylor<N> {
    /// The unit of time, a power of two.
    unit: N,
    terms: Vec<N>,
}

impl<N: Bounded> Taylor<N> {
    /// Returns the series with these coefficients, if the first is exactly zero and another one is not.
    pub(super) fn new(unit: N, terms: Vec<N>) -> Option<Arc<Self>> {
        let (first, others) = terms.split_first()?;
        let leaves_zero = is_exact_zero(first) && !others.iter().all(is_exact_zero);
        leaves_zero.then(|| Arc::new(Taylor { unit, terms }))
    }
}

/// The values at the interfaces, order by order in the time since the one that is reached.
pub(super) struct Series<N> {
    /// The unit of time.
    unit: N,
    /// Coefficients of the states.
    states: Vec<Vec<N>>,
    /// Coefficients of the signals and the gap at each interface.
    values: Vec<Vec<Values<N>>>,
}

/// The way in which a function leaves zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Onset {
    /// The function is zero until a signal changes.
    Zero,
    /// The function rises.
    Rise,
    /// The function falls, in this order of the time.
    Fall(usize),
}

impl<N: Bounded> Cluster<N> {
    /// Computes the series at the time that is reached, if a contact touches, a mass is still, or a signal has just
    /// left zero.
    pub(super) fn series(&self, inputs: &[[Curve<N>; 2]]) -> Option<Series<N>> {
        let touches = self.interfaces.iter().any(|interface| interface.touches);
        let unit = &inputs.first()?[0].unit;
        let in_unit = |side: &Input<N>| {
            let taylor = side.taylor.as_ref()?;
            Some(stretched(&taylor.terms, &(unit.clone() / &taylor.unit)))
        };
        let taylors: Vec<[Option<Vec<N>>; 2]> =
            self.interfaces.iter().map(|interface| interface.sides.each_ref().map(in_unit)).collect();
        let known = || taylors.iter().flatten().flatten();
        let is_needed = touches || self.masses.iter().any(|mass| mass.is_still) || known().next().is_some();
        let velocity = |mass: &Mass<N>| match mass.is_still {
            true => mass.velocity.clone(),
            false => mass.velocity.clone().widened(&mass.error),
        };
        let gap = |interface: &Interface<N>| match interface.touches {
            true => self.norm.zero(),
            false => interface.gap.clone().widened(&interface.gap_error),
        };
        let gaps = self.interfaces.iter().map(gap);
        let mut states: Vec<Vec<N>> = self.masses.iter().map(velocity).chain(gaps).map(|state| vec![state]).collect();
        // A linear equation whose solution is zero in this many orders stays there.
        let lengths = inputs.iter().flatten().map(|curve| curve.terms.len()).chain(known().map(Vec::len));
        let orders = lengths.max().unwrap_or(1) + states.len();
        let mut values = Vec::new();
        for k in 0..if is_needed { orders } else { return None } {
            let mut now: Vec<Values<N>> = (0..self.interfaces.len())
                .map(|j| self.values(inputs, j, k, &|state| states[state][k].clone()))
                .collect();
            for (j, values) in now.iter_mut().enumerate() {
                for (side, value) in values.iter_mut().take(2).enumerate() {
                    let is_mass = matches!(self.interfaces[j].sides[side].source, Source::Mass(_));
                    match &taylors[j][side] {
                        Some(terms) => *value = terms.get(k).cloned().unwrap_or_else(|| self.norm.zero()),
                        None if k == 0 && !is_mass => *value = self.arriving(j, side),
                        None => {}
                    }
                }
            }
            for (state, rate) in states.iter_mut().zip(self.rates(&now, false)) {
                state.push(rate.clone() * unit / rate.int(k as i64 + 1));
            }
            values.push(now);
        }
        Some(Series { unit: unit.clone(), states, values })
    }

    /// Closes the contacts that touch at the start and close at once; returns each with its `y`.
    pub(super) fn close_at_start(&mut self) -> Result<Vec<(usize, N)>, Open> {
        let mut impacts = Vec::new();
        let inputs = self.inputs(&self.reached.at, &self.until.at);
        while let Some(series) = self.series(&inputs) {
            let mut falls = Vec::new();
            for (j, interface) in self.interfaces.iter().enumerate() {
                if interface.touches && interface.mode == Mode::Open {
                    let (onset, doubt) = self.onset_of_gap(&series, j)?;
                    falls.extend(onset.order().map(|order| (order, j, doubt)));
                }
            }
            // A contact that has closed pushes the masses beside it.
            let Some(least) = falls.iter().map(|(order, ..)| *order).min() else { break };
            for (_, j, doubt) in falls.into_iter().filter(|(order, ..)| *order == least) {
                if doubt {
                    self.doubts();
                }
                let interface = &mut self.interfaces[j];
                interface.mode = Mode::Closed;
                impacts.push((j, interface.drive.clone()));
            }
            self.relate();
        }
        Ok(impacts)
    }

    /// Returns the way in which the gap of a contact leaves zero, and whether a coefficient is zero within its bound.
    pub(super) fn onset_of_gap(&self, series: &Series<N>, j: usize) -> Result<(Onset, bool), Open> {
        onset(series.states[self.masses.len() + j].iter().cloned())
    }
}

impl<N: Bounded> Series<N> {
    /// Returns whether a state is constant until a signal changes.
    pub(super) fn is_constant(&self, state: usize) -> bool {
        self.states[state].iter().skip(1).all(is_exact_zero)
    }

    /// Returns the Taylor series of a form of the values at an interface, if it leaves zero.
    pub(super) fn taylor(&self, row: &Row<N>, j: usize) -> Option<Arc<Taylor<N>>> {
        Taylor::new(self.unit.clone(), self.values.iter().map(|values| row.of(refs(&values[j]))).collect())
    }

    /// Returns the way in which a form of the values at an interface leaves zero, and whether a coefficient is zero
    /// within its bound.
    pub(super) fn onset(&self, row: &Row<N>, j: usize) -> Result<(Onset, bool), Open> {
        onset(self.values.iter().map(|values| row.of(refs(&values[j]))))
    }
}

impl Onset {
    /// Returns the order in which the function falls.
    pub(super) fn order(self) -> Option<usize> {
        match self {
            Onset::Fall(order) => Some(order),
            _ => None,
        }
    }
}

fn onset<N: Bounded>(coefficients: impl Iterator<Item = N>) -> Result<(Onset, bool), Open> {
    let mut doubt = false;
    for (order, coefficient) in coefficients.enumerate() {
        match coefficient.sign()? {
            Ordering::Greater => return Ok((Onset::Rise, doubt)),
            Ordering::Less => return Ok((Onset::Fall(order), doubt)),
            Ordering::Equal => doubt |= !is_exact_zero(&coefficient),
        }
    }
    Ok((Onset::Zero, doubt))
}
