//! The most compressive stress of a contact.

use rug::Float;

use super::closed_form::{ClosedForm, Trips, plain};
use crate::error::Error;
use crate::first_contact::Summit;
use crate::history::Side;
use crate::number::{Interval, Scalar};

/// Cells that are looked at one by one.
const MOST_CELLS: i64 = 32;
/// Steps towards a place where the force is greatest.
const MOST_STEPS: usize = 60;

impl ClosedForm {
    /// The most compressive `v_x(0,·)` up to `end`.
    ///
    /// Without gravity it is `−μ/c` at the start: `|v_t ∓ c v_x|` cannot grow. In the first cell only its ends can be it: there
    /// `−c v_x = e^{−rt}(μ I₀ + g t (I₀ + I₁))` has the derivative `e^{−rt} I₀ (g − μ r (1 − I₁/I₀))`, which rises with `I₁/I₀`
    /// and so has at most one zero, a minimum. In later cells the force is bounded by its Chebyshev sum; what is left where it
    /// may be greatest either rises or falls throughout, or is bent by at least κ: then it is at most `f(τ) + f′(τ)²/2κ` for any
    /// τ. After some cells the static stress and what is left of the transient bound it. Where all of that fails, it is at most
    /// `μ + g t₁`, and the enclosure is wide.
    pub(super) fn peak(&self, end: &Trips) -> Result<Interval, Error> {
        let speeds = plain(&self.exact.speed) + &plain(&self.exact.critical_speed());
        let per_force = -speeds / plain(&self.exact.wave_speed);
        let one = per_force.one();
        let start = self.stress_at(&self.lattice(0), Side::Right)?;
        if self.exact.gravity.lo().is_zero() {
            return Ok(start);
        }
        let first = if end.passed < 1 { end.clone() } else { self.lattice(1) };
        let mut most = greater(start / &per_force, self.stress_at(&first, Side::Left)? / &per_force);
        let last = if end.on_lattice { end.passed - 1 } else { end.passed };
        for k in 1..=last {
            if k.count_ones() == 1 || k > MOST_CELLS {
                let later = self.contact.most_after(k);
                if later.as_ref().is_some_and(|later| later.hi() <= most.lo()) {
                    break;
                }
                if k > MOST_CELLS {
                    most = at_most(most, &later.unwrap_or_else(|| one.clone()));
                    break;
                }
            }
            let (to, stop) = if k == last {
                let inside = (end.plain.clone() - one.int(k)) * one.int(2) - &one;
                ((inside.to_f64() + 1e-12).clamp(-1.0, 1.0), end.clone())
            } else {
                (1.0, self.lattice(k + 1))
            };
            let known = Interval::between(most.lo().clone(), most.lo().clone());
            most = match self.contact.summit(k, to, &known) {
                Summit::Below => most,
                Summit::AtStart => greater(most, self.contact.force_at(&one.int(k), k)),
                Summit::AtEnd => greater(most, self.contact.force_at(&stop.plain, k)),
                Summit::Inside { at, between: [from, to], bend } => {
                    let highest = self.summit_near(&at, &bend, k);
                    // An end that cuts the summit off leaves its height as a bound only.
                    let ends = self.contact.force_at(&stop.plain, k);
                    let bent = highest.place.lo() >= from.hi() && highest.place.hi() <= to.lo();
                    if !bent {
                        most = at_most(greater(most, ends), &one);
                        continue;
                    }
                    let reached = *highest.place.hi() <= *stop.plain.lo() && *highest.place.lo() >= k;
                    if reached { greater(most, highest.value) } else { at_most(greater(most, ends), &highest.value) }
                }
                Summit::AtMost(bound) => at_most(most, &bound),
            };
        }
        Ok(most * per_force)
    }

    /// The height of a summit from the slope beside it, which Newton's method with the secant makes small.
    fn summit_near(&self, at: &Interval, bend: &Interval, k: i64) -> Highest {
        let point = |x: Float| Interval::between(x.clone(), x);
        let rate = |x: &Interval| self.contact.force_rate_at(x, k);
        let mut place = point(at.mid());
        let mut slope = rate(&place);
        let mut next = point((place.clone() + slope.clone() / bend).mid());
        for _ in 0..MOST_STEPS {
            let found = rate(&next);
            if !found.is_finite() || found.mid().abs() >= slope.mid().abs() {
                break;
            }
            let step = found.clone() * &(next.clone() - &place) / (found.clone() - &slope);
            (place, slope) = (next, found);
            if !step.is_finite() || slope.lo().is_sign_negative() != slope.hi().is_sign_negative() {
                break;
            }
            next = point((place.clone() - step).mid());
        }
        let above = slope.square() / &(bend.clone() * bend.int(2));
        let value = self.contact.force_at(&place, k);
        let hi = (value.clone() + above).hi().clone();
        Highest { value: Interval::between(value.lo().clone(), hi), place }
    }
}

struct Highest {
    place: Interval,
    value: Interval,
}

/// The greater of two numbers.
fn greater(a: Interval, b: Interval) -> Interval {
    let max = |x: &Float, y: &Float| if x >= y { x.clone() } else { y.clone() };
    Interval::between(max(a.lo(), b.lo()), max(a.hi(), b.hi()))
}

/// A number that is at least `a`, and at most `a` or `bound`.
fn at_most(a: Interval, bound: &Interval) -> Interval {
    let hi = if a.hi() >= bound.hi() { a.hi().clone() } else { bound.hi().clone() };
    Interval::between(a.lo().clone(), hi)
}
