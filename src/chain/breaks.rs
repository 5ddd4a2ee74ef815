//! Breaks of the signals that arrive at a cluster.

use super::cluster::Cluster;
use super::curve::{greater, upper};
use super::interface::Moment;
use super::node::{Occurrence, Source};
use super::step::refs;
use super::wave::Wave;
use crate::number::{Bounded, is_exact_zero};

/// Roundings of the natural speed up to which a signal may change within a piece that is passed as a break.
const HIDDEN: i64 = 64;

impl<N: Bounded> Cluster<N> {
    /// Looks up the breaks that have left the neighbours since.
    pub(super) fn look_up(&mut self, waves: &[[Wave<N>; 2]]) {
        for interface in &mut self.interfaces {
            for (side, input) in interface.sides.iter_mut().enumerate() {
                input.look_up(waves, side);
            }
        }
    }

    /// Returns the next time at which a signal changes, or up to which signals are known.
    pub(super) fn end(&self, horizon: Option<Moment<N>>) -> Moment<N> {
        let fronts = self.interfaces.iter().flat_map(|interface| &interface.sides).filter_map(|side| side.next.clone());
        let end = horizon.into_iter().fold(self.until.clone(), Moment::earlier);
        // Of times that agree, that of a break has the exact form.
        let sooner = |a: Moment<N>, b: Moment<N>| if b.meets(&a) { b } else { a.earlier(b) };
        fronts.reduce(Moment::earlier).map_or(end.clone(), |front| sooner(end, front))
    }

    /// Passes on to the pieces of all signals that begin at the time that is reached. A break that agrees with the
    /// latest event within their bounds counts as one with it: the result has the rates after it, without a kind.
    pub(super) fn pass_breaks(&mut self, waves: &[[Wave<N>; 2]]) -> Vec<(usize, Occurrence<N>)> {
        let mut occurrences = Vec::new();
        let mut spread = self.reached.late.clone();
        let mut all = Vec::new();
        for j in 0..self.interfaces.len() {
            let mut passed: Vec<(Moment<N>, usize, N)> = Vec::new();
            for side in 0..2 {
                let mut begun: Option<Moment<N>> = None;
                loop {
                    let input = &mut self.interfaces[j].sides[side];
                    let Some(next) = input.next.clone() else { break };
                    if self.reached.at.below(&next.at) == Ok(true) && !next.meets(&self.reached) {
                        break;
                    }
                    // Breaks whose times agree are passed as one, although the signal may change between them.
                    let hidden = match &begun {
                        Some(begun) => {
                            let apart = (next.at.clone() - &begun.at).magnitude();
                            input.signal.variation(&(apart + &next.late + &begun.late))
                        }
                        None => self.norm.zero(),
                    };
                    begun = Some(next.clone());
                    let old = input.signal.value_at(&self.reached.at);
                    input.advance(waves, side);
                    let new = input.signal.value_at(&self.reached.at);
                    let apart = (next.at.clone() - &self.reached.at).magnitude() + &next.late;
                    spread = greater(spread, apart);
                    let allowed = self.speed.clone() * &self.rounding * hidden.int(HIDDEN);
                    if !is_exact_zero(&hidden) && hidden.below(&allowed) != Ok(true) {
                        self.doubts();
                        all.push((next.clone(), j, side, hidden));
                    }
                    let jump = new - old;
                    let is_real = jump.positive() == Ok(true) || jump.negative() == Ok(true);
                    if is_real {
                        passed.push((next, side, jump));
                    }
                }
            }
            if !passed.iter().all(|(moment, ..)| moment.is(&self.reached)) {
                self.reached.exact = None;
            }
            self.jumps[j] = 0;
            let told = passed.iter().all(|(moment, ..)| moment.is(&passed[0].0));
            if !told {
                self.jumps[j] = passed.len();
                if self.hides(j, &passed) {
                    self.doubts();
                }
            }
            if !passed.is_empty()
                && let Some(event) = &self.latest[j]
                && event.meets(&self.reached)
                && !passed.iter().all(|(moment, ..)| moment.is(event))
            {
                let drive = self.arriving(j, 1) - self.arriving(j, 0);
                let t = self.reached.time.clone();
                occurrences.push((self.first + j, Occurrence { kind: None, t, drive: [drive.clone(), drive] }));
                self.doubts();
            }
            all.extend(passed.into_iter().map(|(moment, side, jump)| (moment, j, side, jump)));
        }
        self.note_jolts(&all);
        // A wave that leaves has the breaks that have been passed as one within the bounds of all of them.
        if self.reached.late.below(&spread) == Ok(true) {
            self.reached.time = self.reached.time.clone().widened(&spread);
        }
        self.reached.late = upper(spread);
        occurrences
    }

    /// Notes the rates that breaks whose order is not known may cause between them. Each comes with its interface, its
    /// side and its jump. Opposite forces on a mass are a doubt if a contact beside it touches, which they may close or
    /// release.
    fn note_jolts(&mut self, passed: &[(Moment<N>, usize, usize, N)]) {
        self.jolts.clear();
        if passed.iter().all(|(moment, ..)| moment.is(&passed[0].0)) {
            return;
        }
        let zero = self.norm.zero();
        let mut values = vec![[zero.clone(), zero.clone(), zero.clone()]; self.interfaces.len()];
        let mut accelerations = Vec::new();
        for (_, j, side, jump) in passed {
            let sum = values[*j][*side].clone() + jump.magnitude();
            values[*j][*side] = sum;
            let mut alone = vec![[zero.clone(), zero.clone(), zero.clone()]; self.interfaces.len()];
            alone[*j][*side] = jump.clone();
            accelerations.push(self.rates(&alone, false));
        }
        let is_hidden = |i: usize| {
            let touches = self.interfaces[i..=i + 1].iter().any(|interface| interface.touches || interface.is_fresh);
            touches && oppose(accelerations.iter().map(|rates| &rates[i]))
        };
        if (0..self.masses.len()).any(is_hidden) {
            self.doubts();
        }
        self.jolts = self.rates(&values, true);
    }

    /// Returns the signal that arrives at a side of an interface at the time that is reached.
    pub(super) fn arriving(&self, j: usize, side: usize) -> N {
        let side = &self.interfaces[j].sides[side];
        match &side.source {
            Source::Mass(mass) => {
                let mass = &self.masses[*mass];
                mass.velocity.clone().widened(&mass.error)
            }
            _ => side.signal.value_at(&self.reached.time),
        }
    }

    /// Returns whether breaks that coincide within their bounds may cause more between them than before and after them:
    /// whether they act in opposite directions on the gap, the force, or a wave that leaves. Each comes with its side
    /// and its jump.
    fn hides(&self, j: usize, passed: &[(Moment<N>, usize, N)]) -> bool {
        let interface = &self.interfaces[j];
        let (rows, zero) = (interface.rows(), self.norm.zero());
        let [below, above] = &rows.leaving;
        [interface.drive_row(), &rows.force, below, above].into_iter().any(|row| {
            let acts = |(_, side, jump): &(Moment<N>, usize, N)| {
                let mut values = [zero.clone(), zero.clone(), zero.clone()];
                values[*side] = jump.clone();
                row.of(refs(&values))
            };
            let acts: Vec<N> = passed.iter().map(acts).collect();
            oppose(acts.iter())
        })
    }
}

/// Returns whether one of the numbers is positive and another negative.
fn oppose<'a, N: Bounded + 'a>(numbers: impl Iterator<Item = &'a N> + Clone) -> bool {
    numbers.clone().any(|x| x.positive() == Ok(true)) && numbers.into_iter().any(|x| x.negative() == Ok(true))
}
