//! Polynomials over a stretch of time with a bound of their error, and the events that they bring.

use std::sync::Arc;

use crate::lattice::Line;
use crate::number::{Bounded, Open, is_exact_zero};

/// A polynomial in the time since an origin, with a bound of its distance from the true signal.
///
/// The polynomial is `Σ cₖ (s/u)ᵏ`. The unit `u` is the power of two next above the width, so that the coefficients
/// neither overflow nor vanish where a signal is fast.
#[derive(Clone, Debug)]
pub(super) struct Curve<N> {
    /// The time from which the polynomial counts, an exact number.
    pub(super) origin: N,
    /// The unit of time, a power of two.
    pub(super) unit: N,
    /// Coefficients from degree zero on, exact numbers; one or more.
    pub(super) terms: Arc<[N]>,
    /// Bound of the distance from the true signal over the width.
    pub(super) error: N,
    /// Length of time over which the bound holds.
    pub(super) width: N,
}

/// A signal between two breaks.
#[derive(Clone, Debug)]
pub(super) enum Signal<N> {
    /// A line, in a chain of bars whose joints are rigid.
    Line(Line<N>),
    /// A polynomial, in a chain with springs, dashpots or masses. It is boxed: lines are stored by the hundred
    /// thousand.
    Curve(Box<Curve<N>>),
}

/// Bits up to which doubles hold the roundings of numbers.
const ROUGH_BITS: u32 = 600;

/// Returns the least power of two that is no less than a width.
pub(super) fn unit_of<N: Bounded>(width: &N) -> N {
    let size = width.to_f64();
    width.double(if size > 0.0 { size.log2().ceil().exp2() } else { 1.0 })
}

/// Returns `log₂` of the size of a number; infinity where it is below the range of doubles.
fn log2_size<N: Bounded>(x: &N) -> f64 {
    let size = x.to_f64().abs();
    if size > 1e-290 { size.log2() } else { f64::INFINITY }
}

/// Returns the value of a polynomial.
pub(super) fn value<N: Bounded>(terms: &[N], at: &N) -> N {
    let (last, others) =
        terms.split_last().map_or_else(|| (at.zero(), &[][..]), |(last, others)| (last.clone(), others));
    others.iter().rev().fold(last, |sum, term| sum * at + term)
}

/// Returns `Σ |cₖ| wᵏ`, which bounds a polynomial over `0 ≤ s ≤ w`.
pub(super) fn bound<N: Bounded>(terms: &[N], width: &N) -> N {
    let (last, others) = terms.split_last().map_or_else(|| (width.zero(), &[][..]), |(l, o)| (l.magnitude(), o));
    others.iter().rev().fold(last, |sum, term| sum * width + term.magnitude())
}

/// Returns a bound of `Σ |cₖ| wᵏ` as a double, where a bound that is a little too great costs nothing.
pub(super) fn rough_bound<N: Bounded>(terms: &[N], width: &N) -> N {
    let reach = width.to_f64().abs() * (1.0 + 4.0 * f64::EPSILON);
    let sum = terms.iter().rev().fold(0.0, |sum, term| sum * reach + term.to_f64().abs());
    // Each step rounds twice, and what underflows is less than the least normal double.
    width.double(sum * (1.0 + 4.0 * f64::EPSILON * (terms.len() as f64 + 1.0)) + 1e-300 * terms.len() as f64)
}

/// Returns `Σ k |cₖ| wᵏ⁻¹`, or with the second order `Σ k(k − 1) |cₖ| wᵏ⁻²`, as [`rough_bound`] does.
pub(super) fn rough_slope<N: Bounded>(terms: &[N], width: &N, order: usize) -> N {
    let reach = width.to_f64().abs() * (1.0 + 4.0 * f64::EPSILON);
    let factor = |k: usize| (0..order).map(|j| (k - j) as f64).product::<f64>();
    let term = |(k, term): (usize, &N)| term.to_f64().abs() * factor(k);
    let sum = terms.iter().enumerate().skip(order).map(term).rev().fold(0.0, |sum, term| sum * reach + term);
    width.double(sum * (1.0 + 8.0 * f64::EPSILON * (terms.len() as f64 + 1.0)) + 1e-300 * terms.len() as f64)
}

/// Returns the slope of a polynomial at a width as a double, and a bound of its rounding.
pub(super) fn rough_slope_at<N: Bounded>(terms: &[N], width: &N) -> [f64; 2] {
    let at = width.to_f64();
    let scaled = terms.iter().enumerate().skip(1).map(|(k, term)| k as f64 * term.to_f64()).rev();
    let sums = |[sum, size]: [f64; 2], term: f64| [sum * at + term, size * at.abs() + term.abs()];
    let [sum, size] = scaled.fold([0.0, 0.0], sums);
    // Each step rounds twice, each term and the width once, and what underflows is less than the least normal double.
    let count = terms.len() as f64 + 1.0;
    [sum, size * 8.0 * f64::EPSILON * count + 1e-300 * count]
}

/// Returns the coefficients of the derivative.
pub(super) fn derivative<N: Bounded>(terms: &[N]) -> Vec<N> {
    let scaled = |(k, term): (usize, &N)| term.clone() * term.int(k as i64);
    terms.iter().enumerate().skip(1).map(scaled).collect()
}

/// Returns the coefficients of the integral from zero.
pub(super) fn primitive<N: Bounded>(terms: &[N]) -> Vec<N> {
    let zero = terms.first().map(N::zero);
    zero.into_iter().chain(terms.iter().enumerate().map(|(k, term)| term.clone() / term.int(k as i64 + 1))).collect()
}

/// Returns the coefficients about `by`.
pub(super) fn shifted<N: Bounded>(terms: &[N], by: &N) -> Vec<N> {
    let mut terms = terms.to_vec();
    if is_exact_zero(by) {
        return terms;
    }
    for first in 0..terms.len().saturating_sub(1) {
        for k in (first..terms.len() - 1).rev() {
            terms[k] = terms[k].clone() + terms[k + 1].clone() * by;
        }
    }
    terms
}

/// Returns the coefficients for a unit of time that is `ratio` as long.
pub(super) fn stretched<N: Bounded>(terms: &[N], ratio: &N) -> Vec<N> {
    let mut power = ratio.one();
    let scaled = |term: &N| {
        let scaled = term.clone() * &power;
        power = power.clone() * ratio;
        scaled
    };
    terms.iter().map(scaled).collect()
}

/// Returns the stored values of coefficients, and a bound of what the polynomial loses with their errors.
pub(super) fn centred<N: Bounded>(terms: Vec<N>, width: &N) -> (Vec<N>, N) {
    let (stored, errors): (Vec<N>, Vec<N>) = terms.iter().map(N::centred).unzip();
    let error = match width.bits() {
        _ if errors.iter().all(is_exact_zero) => width.zero(),
        Some(bits) if bits <= ROUGH_BITS => rough_bound(&errors, width),
        _ => bound(&errors, width),
    };
    (stored, error)
}

/// Returns an upper bound of a number as an exact number.
pub(super) fn upper<N: Bounded>(x: N) -> N {
    let (stored, radius) = x.centred();
    if is_exact_zero(&radius) {
        return stored;
    }
    // The second radius covers the rounding of the sum.
    (stored + radius.doubled()).centred().0
}

/// Returns the greater of two bounds, or a little more if their order is not decided.
pub(super) fn greater<N: Bounded>(a: N, b: N) -> N {
    match (a.below(&b), b.below(&a)) {
        (Ok(true), _) => b,
        (_, Ok(true)) => a,
        _ => {
            let apart = (b - &a).magnitude();
            a + apart
        }
    }
}

/// Returns the smaller of two bounds, or one of them if their order is not decided.
pub(super) fn smaller<N: Bounded>(a: N, b: N) -> N {
    if a.below(&b) == Ok(true) { a } else { b }
}

impl<N: Bounded> Curve<N> {
    /// Returns the polynomial with these coefficients, whose errors enter the bound. Coefficients of a high degree that
    /// are below one rounding of the others are dropped.
    pub(super) fn new((origin, unit): (&N, &N), terms: Vec<N>, error: N, width: &N) -> Self {
        // A power of the width in units is at most one.
        let (mut stored, rounding) = centred(terms, &width.one());
        let mut error = if is_exact_zero(&rounding) { error } else { error + rounding };
        // Less than a quarter of a rounding of the value is dropped.
        let least =
            stored.iter().map(|term| term.to_f64().abs()).fold(0.0, f64::max).log2() + width.log2_roundoff() - 2.0;
        let mut dropped = width.zero();
        while stored.len() > 1 {
            let Some(last) = stored.last() else { break };
            let is_zero = is_exact_zero(last);
            let next = dropped.clone() + last.magnitude();
            if !is_zero && log2_size(&next) > least {
                break;
            }
            dropped = if is_zero { dropped } else { next };
            stored.pop();
        }
        if !is_exact_zero(&dropped) {
            error = error + dropped;
        }
        let (origin, unit) = (origin.clone(), unit.clone());
        Curve { origin, unit, terms: stored.into(), error, width: width.clone() }
    }

    /// Returns a time since the origin in units.
    pub(super) fn in_units(&self, time: &N) -> N {
        time.clone() / &self.unit
    }

    /// Returns the width in units.
    pub(super) fn reach(&self) -> N {
        self.in_units(&self.width)
    }

    /// Returns the curve in another unit.
    pub(super) fn in_unit(&self, unit: &N) -> Self {
        if self.unit.alike(unit) {
            return self.clone();
        }
        let terms = stretched(&self.terms, &(unit.clone() / &self.unit));
        let (terms, error) = centred(terms, &(self.width.clone() / unit));
        let error = if is_exact_zero(&error) { self.error.clone() } else { error + &self.error };
        Curve { unit: unit.clone(), terms: terms.into(), error, ..self.clone() }
    }

    /// Returns the signal that arrives after the time `delay`.
    pub(super) fn delayed(&self, delay: &N) -> Self {
        let (origin, late) = (self.origin.clone() + delay).centred();
        let error = match is_exact_zero(&late) {
            true => self.error.clone(),
            false => rough_slope(&self.terms, &self.reach(), 1) * self.in_units(&late) + &self.error,
        };
        Curve { origin, error, ..self.clone() }
    }

    /// Returns the polynomial about another origin, and over another width.
    pub(super) fn about(&self, origin: &N, width: &N) -> Self {
        let (by, unit) = (origin.clone() - &self.origin, unit_of(width));
        if is_exact_zero(&by) {
            return Curve { width: width.clone(), ..self.clone() }.in_unit(&unit);
        }
        let (terms, error) = centred(shifted(&self.terms, &self.in_units(&by)), &self.in_units(width));
        let error = if is_exact_zero(&error) { self.error.clone() } else { error + &self.error };
        let (origin, width) = (origin.clone(), width.clone());
        Curve { origin, unit: self.unit.clone(), terms: terms.into(), error, width }.in_unit(&unit)
    }

    /// Returns the curve without terms that are below a rounding of the others.
    pub(super) fn trimmed(self) -> Self {
        Curve::new((&self.origin, &self.unit), self.terms.to_vec(), self.error, &self.width)
    }

    /// Returns the value at a time.
    pub(super) fn value_at(&self, time: &N) -> N {
        value(&self.terms, &self.in_units(&(time.clone() - &self.origin))).widened(&self.error)
    }

    /// Returns the integral between the stored values of two times.
    pub(super) fn integral(&self, from: &N, to: &N) -> N {
        let terms = primitive(&self.terms);
        let [from, to] = [from, to].map(|t| self.in_units(&(t.clone().centred().0 - &self.origin)));
        let error = (to.clone() - &from).magnitude() * &self.error * &self.unit;
        let begun = if is_exact_zero(&from) { from.zero() } else { value(&terms, &from) };
        ((value(&terms, &to) - begun) * &self.unit).widened(&error)
    }

    /// Returns the Chebyshev coefficients between the stored values of two times, the first one whole and widened by
    /// the error of the curve; none for a line, which its ends give.
    ///
    /// **Source**: Horner's rule with `x T_k = (T_{k+1} + T_{|k−1|})/2`.
    pub(super) fn chebyshev(&self, from: &N, to: &N) -> Vec<N> {
        let [begin, end] = [from, to].map(|t| t.clone().centred().0);
        let width = end - &begin;
        let own = self.about(&begin, &width.clone().centred().0);
        if own.terms.len() < 3 {
            return Vec::new();
        }
        let half = own.in_units(&width).halved();
        let mut power = half.one();
        let mut terms = shifted(&own.terms, &half);
        for term in &mut terms {
            *term = term.clone() * &power;
            power = power * &half;
        }
        let mut series: Vec<N> = Vec::new();
        for term in terms.into_iter().rev() {
            let mut next = vec![half.zero(); series.len() + 1];
            next[0] = term;
            for (k, found) in series.into_iter().enumerate() {
                match k.checked_sub(1) {
                    None => next[1] = found,
                    Some(below) => {
                        let found = found.halved();
                        next[below] = next[below].clone() + &found;
                        next[k + 1] = next[k + 1].clone() + found;
                    }
                }
            }
            series = next;
        }
        series[0] = series[0].clone().widened(&own.error);
        series
    }

    /// Returns a bound of the magnitude.
    pub(super) fn most(&self) -> N {
        rough_bound(&self.terms, &self.reach()) + &self.error
    }

    /// Returns the integral of the square over the first part of the width.
    pub(super) fn square_integral(&self, width: &N) -> N {
        let square = square(&self.terms);
        let reach = self.in_units(width);
        let most = rough_bound(&self.terms, &reach).doubled() + &self.error;
        (value(&primitive(&square), &reach) * &self.unit).widened(&(most * &self.error * width))
    }

    /// Returns a width over which the polynomial rises; `None` if it does not rise from its origin on.
    pub(super) fn rising_width(&self) -> Option<N> {
        let slopes = derivative(&self.terms);
        let (first, rest) =
            slopes.iter().position(|slope| !is_exact_zero(slope)).and_then(|k| slopes[k..].split_first())?;
        let mut reach = self.reach().centred().0;
        for _ in 0..64 {
            if (first.clone() - rough_bound(rest, &reach) * &reach).positive() == Ok(true) {
                return Some((reach * &self.unit).centred().0);
            }
            reach = reach.halved().centred().0;
        }
        None
    }

    /// Returns whether the curve and its bound are zero.
    pub(super) fn is_zero(&self) -> bool {
        is_exact_zero(&self.error) && self.terms.iter().all(is_exact_zero)
    }

    /// Returns the negative curve.
    pub(super) fn negated(&self) -> Self {
        let terms = self.terms.iter().map(|term| -term.clone()).collect::<Vec<_>>().into();
        Curve { terms, ..self.clone() }
    }
}

/// Returns the coefficients of `P(w − s)`.
pub(super) fn turned<N: Bounded>(terms: &[N], width: &N) -> Vec<N> {
    let signed = |(k, term): (usize, N)| if k % 2 == 1 { -term } else { term };
    shifted(terms, width).into_iter().enumerate().map(signed).collect()
}

/// Returns the coefficients of a square.
fn square<N: Bounded>(terms: &[N]) -> Vec<N> {
    let Some(first) = terms.first() else { return Vec::new() };
    let mut sums = vec![first.zero(); 2 * terms.len() - 1];
    for (i, a) in terms.iter().enumerate() {
        for (j, b) in terms.iter().enumerate().skip(i + 1) {
            sums[i + j] = sums[i + j].clone() + a.clone() * b;
        }
    }
    let doubled = sums.into_iter().map(|sum| if is_exact_zero(&sum) { sum } else { sum.doubled() });
    let mut sums: Vec<N> = doubled.collect();
    for (i, a) in terms.iter().enumerate() {
        sums[2 * i] = sums[2 * i].clone() + a.square();
    }
    sums
}

/// Returns the coefficients of a product.
pub(super) fn product<N: Bounded>(a: &[N], b: &[N]) -> Vec<N> {
    let Some(first) = a.first().filter(|_| !b.is_empty()) else { return Vec::new() };
    let mut terms = vec![first.zero(); a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            terms[i + j] = terms[i + j].clone() + a.clone() * b;
        }
    }
    terms
}

impl<N: Bounded> Signal<N> {
    /// Returns the line of a chain of bars whose joints are rigid, which has no curves.
    pub(super) fn into_line(self) -> Line<N> {
        match self {
            Signal::Line(line) => line,
            Signal::Curve(curve) => Line { intercept: curve.terms[0].clone(), slope: curve.terms[0].zero() },
        }
    }

    /// Returns the signal that arrives after the time `delay`.
    pub(super) fn delayed(&self, delay: &N) -> Self {
        match self {
            Signal::Line(line) => Signal::Line(line.delayed(delay)),
            Signal::Curve(curve) => Signal::Curve(Box::new(curve.delayed(delay))),
        }
    }

    /// Returns the value at a time.
    pub(super) fn value_at(&self, time: &N) -> N {
        match self {
            Signal::Line(line) => line.value_at(time),
            Signal::Curve(curve) => curve.value_at(time),
        }
    }

    /// Returns a bound of the change over the whole piece: of a line, which has no width of its own, over `width`.
    pub(super) fn variation(&self, width: &N) -> N {
        match self {
            Signal::Line(line) => line.slope.magnitude() * width,
            Signal::Curve(curve) => rough_bound(&curve.terms[1..], &curve.reach()) * curve.reach(),
        }
    }

    /// Returns the integral between the stored values of two times.
    pub(super) fn integral(&self, from: &N, to: &N) -> N {
        match self {
            Signal::Line(line) => line.integral(from, to),
            Signal::Curve(curve) => curve.integral(from, to),
        }
    }

    /// Returns the signal as a polynomial from `origin` on, over a width.
    pub(super) fn about(&self, origin: &N, width: &N) -> Curve<N> {
        match self {
            Signal::Line(line) => {
                let mut terms = vec![line.value_at(origin)];
                if !is_exact_zero(&line.slope) {
                    terms.push(line.slope.clone());
                }
                let unit = unit_of(width);
                if let Some(slope) = terms.get_mut(1) {
                    *slope = slope.clone() * &unit;
                }
                let (terms, error) = centred(terms, &width.one());
                Curve { origin: origin.clone(), unit, terms: terms.into(), error, width: width.clone() }
            }
            Signal::Curve(curve) => curve.about(origin, width),
        }
    }
}

/// The first time at which a function that is not negative at the start falls below zero.
#[derive(Clone, Debug)]
pub(super) enum Fall<N> {
    /// The function stays above zero, or returns from it.
    None,
    /// The function falls below zero, after this time since the origin.
    After(N),
    /// The function falls, and is zero within its bound at the end of its width.
    AtEnd,
}

/// Returns the first fall of a curve below zero within its width, and whether a touch is not told from a fall.
///
/// **Source**: an interval on which the curve has no zero, or a derivative of one sign, decides; others are halved.
pub(super) fn first_fall<N: Bounded>(curve: &Curve<N>) -> Result<(Fall<N>, bool), Open> {
    let halvings = curve.width.bits().map_or(64, |bits| bits / 2 + 24);
    let after = |at: N| Fall::After(if is_exact_zero(&at) { at } else { at * &curve.unit });
    let mut stretches = vec![(curve.width.zero(), curve.reach().centred().0, halvings)];
    let mut doubt = false;
    // The beginning of the stretches before the present one on which the curve is zero within its bound.
    let mut unknown: Option<N> = None;
    while let Some((from, width, halvings)) = stretches.pop() {
        let (terms, error) = match is_exact_zero(&from) {
            true => (curve.terms.to_vec(), curve.error.clone()),
            false => {
                let (terms, error) = centred(shifted(&curve.terms, &from), &width);
                (terms, error + &curve.error)
            }
        };
        let (first, rest) = (&terms[0], rough_bound(&terms[1..], &width) * &width);
        if (first.clone() + &error).negative() == Ok(true) {
            let fall = match unknown {
                Some(begun) => between(begun, from),
                None => from,
            };
            return Ok((after(fall), doubt));
        }
        if (first.clone() - &rest - &error).positive() == Ok(true) {
            unknown = None;
            continue;
        }
        let size = rest + first.magnitude();
        if halvings == 0 || error.clone().doubled().below(&size) != Ok(true) {
            // The curve is zero within its bound; a curve that is exactly zero stays there.
            if !(is_exact_zero(&size) && is_exact_zero(&error)) {
                doubt = true;
                unknown = unknown.or(Some(from));
            }
            continue;
        }
        let slope = terms.get(1).map_or_else(|| width.zero(), N::clone);
        let bend = rough_slope(&terms, &width, 2) * &width;
        if (slope.clone() - &bend).positive() == Ok(true) {
            unknown = None;
            continue;
        }
        if (slope.clone() + &bend).negative() == Ok(true) {
            if (first.clone() - &error).positive() != Ok(true) {
                let late = (error / (-slope - &bend)).doubled();
                // Where it does not fall below its bound on the stretch, it may rise again.
                if late.below(&width) == Ok(true) {
                    let fall = match unknown {
                        Some(begun) => between(begun, upper(from + late)),
                        None if is_exact_zero(&late) => from,
                        None => from.widened(&late),
                    };
                    return Ok((after(fall), doubt));
                }
            } else {
                let last = value(&terms, &width);
                if (last.clone() - &error).positive() == Ok(true) {
                    unknown = None;
                    continue;
                }
                if (last + &error).negative() != Ok(true) && stretches.is_empty() {
                    return Ok((Fall::AtEnd, doubt));
                }
                // Without a root of its own the curve flattens where it meets zero.
                if let Some(root) = simple_root(&terms, &width, &error) {
                    return Ok((after(from + root), doubt));
                }
            }
        }
        let half = width.clone().halved().centred().0;
        let middle = (from.clone() + &half).centred().0;
        stretches.push((middle, width - &half, halvings - 1));
        stretches.push((from, half, halvings - 1));
    }
    Ok((Fall::None, doubt))
}

/// Returns the number between two others that is within its bound of both.
fn between<N: Bounded>(least: N, most: N) -> N {
    let half = (most - &least).halved();
    let middle = (least + &half).centred().0;
    // The rounding of the middle is far below a sixteenth of the half.
    let sixteenth = half.clone().halved().halved().halved().halved();
    middle.widened(&(half + sixteenth))
}

/// Returns the root of a falling polynomial in `0 ≤ s ≤ w` within its bound; an end if the root is within the error of
/// it. `None` if the slope at the root is not told from zero.
fn simple_root<N: Bounded>(terms: &[N], width: &N, error: &N) -> Option<N> {
    let slopes = derivative(terms);
    let (mut least, mut most) = (width.zero(), width.clone());
    let mut root = width.clone().halved().centred().0;
    let steps = 2 * width.bits().unwrap_or(64) + 16;
    for _ in 0..steps {
        let found = value(terms, &root);
        if found.clone().centred().0.positive() == Ok(true) {
            least = root.clone()
        } else {
            most = root.clone()
        }
        let next = (root.clone() - found / value(&slopes, &root)).centred().0;
        let inside = least.below(&next) == Ok(true) && next.below(&most) == Ok(true);
        let next = if inside { next } else { (least.clone() + &most).halved().centred().0 };
        if next.alike(&root) || is_exact_zero(&(next.clone() - &root)) {
            break;
        }
        root = next;
    }
    let about = shifted(terms, &root);
    let off = about[0].magnitude() + error;
    let slope = about.get(1)?.magnitude();
    let near = (off.clone() / &slope).doubled();
    let bend = bound(&derivative(&derivative(&about)), &near.clone().magnitude()) * &near;
    let least = slope - bend;
    let late = off / &least;
    let certain = least.positive() == Ok(true) && (late.clone() - near).positive() != Ok(true);
    certain.then(|| root.widened(&late))
}
