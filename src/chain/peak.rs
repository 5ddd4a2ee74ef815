//! The greatest value of a signal between two breaks.

use super::curve::{
    Curve, Fall, Signal, centred, derivative, first_fall, rough_bound, rough_slope, shifted, upper, value,
};
use crate::number::{Bounded, is_exact_zero};

/// Number of parts of a width in which [`Curve::mean_fall`] bounds a function.
const FALL_PARTS: i64 = 16;

/// Number of parts of a width in which [`Curve::stays_below`] bounds a signal.
const PARTS: u32 = 8;

impl<N: Bounded> Curve<N> {
    /// Returns the greatest value between the stored values of two times, and the first time of it. `slope` is a curve
    /// and a factor whose product is the slope of the signal, if they are known.
    pub(super) fn greatest(&self, from: &N, to: &N, slope: Option<(&Self, &N)>) -> (N, N) {
        let [begin, end] = [from, to].map(|t| t.clone().centred().0);
        let width = (end.clone() - &begin).centred().0;
        let own = self.about(&begin, &width);
        let mut best = (self.value_at(from), from.clone());
        let last = (self.value_at(to), to.clone());
        // A line may leave out a part of the signal that bends.
        if own.terms.len() < if slope.is_some() && !is_exact_zero(&own.error) { 2 } else { 3 } {
            return highest(best, last);
        }
        let slopes = match slope {
            Some((curve, _)) => curve.about(&begin, &width),
            None => Curve { terms: derivative(&own.terms).into(), error: begin.zero(), ..own.clone() },
        };
        let mut rest = begin.zero();
        let mut falls = slopes.terms[0].negative() == Ok(true);
        // Possible height of maxima that are not found, any of which may be the greatest value.
        let mut spare = begin.zero();
        // Maxima and minima of the curve alternate.
        for turn in 0..own.terms.len() {
            let left = (width.clone() - &rest).centred().0;
            if left.positive() != Ok(true) {
                break;
            }
            let slopes = slopes.about(&(begin.clone() + &rest).centred().0, &left);
            let slopes = if falls { slopes.negated() } else { slopes };
            // A search begins at the zero that the search before has found.
            let zero = if turn == 0 { begin.zero() } else { upper(slopes.terms[0].magnitude()) };
            let error = zero + &slopes.error;
            // The slope of the terms is one per unit of the whole curve.
            let climb = |most: N| match slope {
                Some((_, factor)) => most * factor.magnitude() * &left,
                None => most * own.in_units(&left),
            };
            let searched = Curve { error: error.clone(), ..slopes.clone() };
            let Ok((fall, doubt)) = first_fall(&searched) else {
                spare = spare + climb(searched.mean_fall());
                break;
            };
            if doubt || matches!(fall, Fall::AtEnd) {
                // Where the slope is not told from zero, it is below three times its error.
                spare = spare + climb(error * begin.int(3));
            }
            let Fall::After(at) = fall else { break };
            let (place, late) = at.centred();
            let here = (rest.clone() + &place).centred().0;
            let is_later = !is_exact_zero(&here);
            if !falls && (is_later || (slope.is_some() && !is_exact_zero(&late))) {
                let found = value(&own.terms, &own.in_units(&here)).widened(&own.error);
                let (climb, time) = match slope {
                    Some((_, factor)) => {
                        let climb = slopes.most_about(&place, &late) * factor.magnitude() * &late;
                        let time = if is_later { begin.clone() + &here } else { from.clone() };
                        (climb, time.widened(&late))
                    }
                    None => {
                        let bend = rough_slope(&own.terms, &own.reach(), 2);
                        (bend * own.in_units(&late).square(), own.time_of_maximum(&here))
                    }
                };
                best = highest(best, (found.widened(&climb), time));
            }
            if is_exact_zero(&place) {
                break;
            }
            (rest, falls) = (here, !falls);
        }
        let (value, time) = highest(best, last);
        if is_exact_zero(&spare) { (value, time) } else { (value.widened(&spare), time.widened(&width)) }
    }

    /// Returns whether the curve stays below `least` between the stored values of two times, by a bound in doubles.
    ///
    /// **Source**: `f ≤ d₀ + Σ |dₖ| hᵏ` with the coefficients `dₖ` about the middle of a part of the half-width `h`. The
    /// roundings of `n` coefficients about `m` are below `8 n ε Σ |cₖ| (|m| + h)ᵏ`.
    fn stays_below(&self, least: &N, from: &N, to: &N) -> bool {
        let place = |time: &N| {
            let (stored, error) = self.in_units(&(time.clone().centred().0 - &self.origin)).centred();
            (stored.to_f64(), error.to_f64().abs())
        };
        let ((from, before), (to, after)) = (place(from), place(to));
        let late = 2.0 * (before + after) + 4.0 * f64::EPSILON * (from.abs() + to.abs());
        let half = ((to - from) / f64::from(2 * PARTS)).abs() + late;
        let terms: Vec<f64> = self.terms.iter().map(N::to_f64).collect();
        let count = terms.len() as f64;
        let most = |part: u32| {
            let middle = from + (to - from) * f64::from(2 * part + 1) / f64::from(2 * PARTS);
            let mut about = terms.clone();
            for first in 0..about.len() - 1 {
                for k in (first..about.len() - 1).rev() {
                    about[k] += about[k + 1] * middle;
                }
            }
            let reach = middle.abs() + half;
            let size = terms.iter().rev().fold(0.0, |sum, term| sum * reach + term.abs());
            let others = about[1..].iter().rev().fold(0.0, |sum, term| (sum + term.abs()) * half);
            let rounding = 8.0 * count * f64::EPSILON * size;
            // What underflows is less than the least normal double.
            about[0] + others + rounding + 2.0 * self.error.to_f64().abs() + 1e-290 * count
        };
        (0..PARTS).map(most).all(|most| most.is_finite() && least.double(most).below(least) == Ok(true))
    }

    /// Returns the time of a smooth maximum, which is near the time `here` after the origin, within its bound.
    ///
    /// **Source**: a signal within `e` of the curve has its maximum where the curve is within `2e` of its own. Where
    /// the curve is `2e` lower on either side, the maximum is between.
    fn time_of_maximum(&self, here: &N) -> N {
        let time = (self.origin.clone() + here).centred().0;
        let about = shifted(&self.terms, &self.in_units(here));
        let zero = time.zero();
        let term = |k: usize| about.get(k).map_or_else(|| zero.clone(), N::clone);
        let (rise, bend, others) = (term(1).magnitude(), -term(2), about.get(3..).unwrap_or_default());
        let depth = self.error.clone().doubled() + &rise;
        if is_exact_zero(&depth) {
            return time;
        }
        let near = (depth / &bend).doubled().try_sqrt().map(|near| near.centred().0).filter(|near| {
            let cube = near.square() * near;
            let lower = bend.clone() * near.square() - rise.clone() * near - rough_bound(others, near) * cube;
            let low = lower - self.error.clone().doubled();
            low.positive() == Ok(true)
        });
        let near = near.map(|near| near * &self.unit).filter(|near| near.below(&self.width) == Ok(true));
        time.widened(&near.unwrap_or_else(|| self.width.clone()))
    }

    /// Returns a bound of the mean of `max(0, −f)` over the width.
    ///
    /// **Source**: the sum of such bounds over parts of the width, in which a function that decays fast stays close to
    /// its first value.
    fn mean_fall(&self) -> N {
        let part = (self.reach() / self.width.int(FALL_PARTS)).centred().0;
        // The overlap covers the rounding of where a part begins.
        let width = part.clone() * part.ratio(9, 8);
        let fall = |k: i64| {
            let from = (part.clone() * part.int(k)).centred().0;
            let (terms, error) = centred(shifted(&self.terms, &from), &width);
            let least = terms[0].clone() - rough_bound(&terms[1..], &width) * &width - error - &self.error;
            if least.positive() == Ok(true) { least.zero() } else { upper(least.magnitude()) }
        };
        let sum = (0..FALL_PARTS).fold(self.width.zero(), |sum, k| sum + fall(k));
        sum * self.width.ratio(9, 8 * FALL_PARTS)
    }

    /// Returns a bound of the magnitude within `late` of the time `place` after the origin. Around a zero it is far
    /// below that of a bound of the slope, which a signal that decays fast has at the other end of its width.
    fn most_about(&self, place: &N, late: &N) -> N {
        let late = self.in_units(late);
        // Twice the distance covers the rounding of its beginning.
        let from = (self.in_units(place) - late.clone().doubled()).centred().0;
        let width = late.doubled().doubled();
        let (terms, error) = centred(shifted(&self.terms, &from), &width);
        rough_bound(&terms, &width) + error + &self.error
    }
}

impl<N: Bounded> Signal<N> {
    /// Returns the greatest value between the stored values of two times, and the first time of it. `slope` is a curve
    /// and a factor whose product is the slope of the signal, if they are known.
    pub(super) fn greatest(&self, from: &N, to: &N, slope: Option<(&Curve<N>, &N)>) -> (N, N) {
        match self {
            Signal::Curve(curve) => curve.greatest(from, to, slope),
            Signal::Line(line) => {
                let [first, last] = [from, to].map(|t| line.value_at(t));
                if first.below(&last) == Ok(true) { (last, to.clone()) } else { (first, from.clone()) }
            }
        }
    }

    /// Returns whether the signal stays below `least` between the stored values of two times, by a bound that costs
    /// little.
    pub(super) fn stays_below(&self, least: &N, from: &N, to: &N) -> bool {
        match self {
            Signal::Curve(curve) => curve.stays_below(least, from, to),
            Signal::Line(_) => false,
        }
    }
}

/// Returns the greater of two values with their times, of which the second one is later. Values that agree within their
/// bounds leave the time open between both.
pub(super) fn highest<N: Bounded>(first: (N, N), second: (N, N)) -> (N, N) {
    let apart = second.0.clone() - &first.0;
    match (apart.positive(), apart.negative()) {
        (Ok(true), _) => second,
        (_, Ok(true)) => first,
        _ if is_exact_zero(&apart) => first,
        _ => {
            let wait = (second.1.clone() - &first.1).magnitude();
            let is_second_stored = (second.0.centred().0 - first.0.centred().0).positive() == Ok(true);
            let (value, other, time) =
                if is_second_stored { (second.0, first.0, second.1) } else { (first.0, second.0, first.1) };
            (value.widened(&other.centred().1), time.widened(&wait))
        }
    }
}
