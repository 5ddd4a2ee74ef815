//! The most compressive stress of a contact.

use super::field::{FirstContact, Trips};
use super::first_root::{derivative, evaluate};
use super::round_trip::{Interpolant, Search};
use crate::motion::Side;
use crate::number::Scalar;
use crate::special::{BoundedSpecial, Ray};

/// Part of a cell on which the force may exceed a given one.
enum Excess<N> {
    /// The force exceeds it nowhere.
    None,
    /// The force rises towards the end on this part.
    AtEnd,
    /// The force falls from the beginning on this part.
    AtStart,
    /// The force has a summit around `at`, in round trips, where its second derivative by these is at most `−bend`.
    Inside {
        /// Approximate place of the summit.
        at: N,
        /// Ends of the part on which the bound of the second derivative holds.
        between: [N; 2],
        bend: N,
    },
    /// The part is unknown, but this bounds the force.
    AtMost(N),
}

/// Number of pieces that a cell is cut into.
const PIECES: usize = 128;
/// Maximum number of cells examined one by one.
const MOST_CELLS: i64 = 32;
/// Maximum number of Newton steps towards a summit of the force.
const MOST_STEPS: usize = 60;

impl<N: BoundedSpecial> FirstContact<N> {
    /// Computes the most compressive `v_x(0,·)` up to `end`.
    ///
    /// Without gravity it is `−μ/c` at the start: `|v_t ∓ c v_x|` cannot grow. In the first cell it is at one of the
    /// ends: there `−c v_x = e^{−rt}(μ I₀ + g t (I₀ + I₁))` has the derivative `e^{−rt} I₀ (g − μ r (1 − I₁/I₀))`,
    /// which rises with `I₁/I₀` and so has at most one zero, a minimum. In later cells the Chebyshev sum bounds the
    /// force. On the remaining part, where it may be greatest, it either rises or falls throughout, or its second
    /// derivative is at most −κ: then it is at most `f(τ) + f′(τ)²/2κ` for any τ. After some cells the static stress
    /// and a bound of the transient bound it. If all of that fails, it is at most `μ + g t₁`, and the bound is wide.
    pub(super) fn peak(&self, end: &Trips<N>) -> N {
        if self.weightless {
            return self.stress_at(&self.lattice(0), Side::Right);
        }
        let one = self.damping.one();
        let at = |trips: &Trips<N>, side: Side| self.force(&trips.number, trips.returned(side));
        let first = if end.passed < 1 { end.clone() } else { self.lattice(1) };
        let mut most = greater(at(&self.lattice(0), Side::Right), at(&first, Side::Left));
        let last = if end.on_lattice { end.passed - 1 } else { end.passed };
        for k in 1..=last {
            if k.count_ones() == 1 || k > MOST_CELLS {
                let later = self.most_after(k);
                if later.as_ref().is_some_and(|later| most.below(later) == Ok(false)) {
                    break;
                }
                if k > MOST_CELLS {
                    most = at_most(most, &later.unwrap_or(one));
                    break;
                }
            }
            let (to, stop) = if k == last {
                let inside = (end.number.clone() - one.int(k)) * one.int(2) - &one;
                ((inside.near().0 + 1e-12).clamp(-1.0, 1.0), end.clone())
            } else {
                (1.0, self.lattice(k + 1))
            };
            most = match self.excess(k, to, &most) {
                Excess::None => most,
                Excess::AtStart => greater(most, self.force(&one.int(k), k)),
                Excess::AtEnd => greater(most, self.force(&stop.number, k)),
                Excess::Inside { at, between: [from, to], bend } => {
                    let (place, value) = self.summit_near(&at, &bend, k);
                    let before = |a: &N, b: &N| b.below(a) == Ok(false);
                    // If an end cuts the summit off, the height of the summit is only a bound.
                    if !(before(&from, &place) && before(&place, &to)) {
                        at_most(greater(most, self.force(&stop.number, k)), &one)
                    } else if before(&place, &stop.number) && before(&one.int(k), &place) {
                        greater(most, value)
                    } else {
                        at_most(greater(most, self.force(&stop.number, k)), &value)
                    }
                }
                Excess::AtMost(bound) => at_most(most, &bound),
            };
        }
        -(most * &self.total_speed() / &self.rod.wave_speed).without_exact()
    }

    /// Finds the part between `k t₁` and the place `to` of `[−1,1]` in its cell on which the force exceeds `known`.
    ///
    /// With the Chebyshev sum p, `|f − p| ≤ e`: on a piece of width w the sum is at most its greater end plus `B₂w²/8`,
    /// its slope is that of the middle within `B₂w/2`, its second derivative that of the middle within `B₃w/2`, where
    /// `B₂ = Σ|c_n| n²(n²−1)/3` and `B₃ = Σ|c_n| n²(n²−1)(n²−4)/15`. The slopes of f and p differ by at most
    /// `4(n+1)²e`, as in the search for the first root; their second derivatives, by Markov's inequality and the same
    /// series with k⁴ for k², by `4(n+1)⁴e`.
    fn excess(&self, k: i64, to: f64, known: &N) -> Excess<N> {
        let search = Search { contact: self, kernels: None };
        let Ok(Interpolant { scale, sum, error }) = search.interpolant(k) else {
            return Excess::AtMost(known.one());
        };
        let (size, doubt) = (known.clone() / &scale).near();
        let level = (size - doubt) * (1.0 - 1e-12) - error;
        let (slopes, bends) = (derivative(&sum), derivative(&derivative(&sum)));
        let weighted = |weight: fn(f64) -> f64| {
            (0u32..).zip(&sum).map(|(n, c)| weight(f64::from(n)) * c.abs()).sum::<f64>() * (1.0 + 1e-9)
        };
        let second = weighted(|n| n * n * (n * n - 1.0) / 3.0);
        let third = weighted(|n| n * n * (n * n - 1.0) * (n * n - 4.0).abs() / 15.0);
        let size = (sum.len() * sum.len()) as f64 * 4.0 * error;
        // A slightly greater width, so that rounding does not exclude the end.
        let width = (to + 1.0) / PIECES as f64 * (1.0 + 1e-12);
        let place = |i: usize| -1.0 + width * i as f64;
        let value = |x: f64| evaluate(&sum, x).0;
        let (mut first, mut last, mut most) = (None, 0, 0.0f64);
        for i in 0..PIECES {
            let above = value(place(i)).max(value(place(i + 1))) + second * width * width / 8.0 + error;
            if above > level {
                first.get_or_insert(i);
                last = i;
                most = most.max(above);
            }
        }
        let Some(first) = first else { return Excess::None };
        let (mut rising, mut falling, mut bend) = (true, true, f64::INFINITY);
        for i in first..=last {
            let middle = place(i) + 0.5 * width;
            let (slope, doubt) = (evaluate(&slopes, middle).0, second * width * 0.5 + size);
            rising &= slope > doubt;
            falling &= slope < -doubt;
            let bent = evaluate(&bends, middle).0;
            bend = bend.min(-bent - third * width * 0.5 - size * (sum.len() * sum.len()) as f64);
        }
        if rising && last + 1 == PIECES {
            return Excess::AtEnd;
        }
        if falling && first == 0 {
            return Excess::AtStart;
        }
        if bend > 0.0 {
            let highest = (first..=last + 1).max_by(|a, b| value(place(*a)).total_cmp(&value(place(*b))));
            let at = self.inside(k, highest.map_or(0.0, place));
            let between = [self.inside(k, place(first)), self.inside(k, place(last + 1))];
            return Excess::Inside { at, between, bend: scale.double(4.0 * bend) * &scale };
        }
        Excess::AtMost(scale.double(most * (1.0 + 1e-12)) * &scale)
    }

    /// Computes a place near a summit, and the height of the summit from the slope there; Newton's method with the
    /// secant makes this slope small.
    fn summit_near(&self, at: &N, bend: &N, k: i64) -> (N, N) {
        let mut place = at.middle();
        let mut slope = self.force_rate(&place, k);
        let mut next = (place.clone() + slope.clone() / bend).middle();
        for _ in 0..MOST_STEPS {
            let found = self.force_rate(&next, k);
            let less = found.middle().magnitude().below(&slope.middle().magnitude());
            if !found.is_finite() || less != Ok(true) {
                break;
            }
            let step = found.middle() * &(next.clone() - &place) / (found.middle() - &slope.middle());
            (place, slope) = (next, found);
            if !step.is_finite() || !matches!(slope.sign(), Ok(order) if order.is_ne()) {
                break;
            }
            next = (place.clone() - step).middle();
        }
        let above = slope.square() / &(bend.clone() * bend.int(2));
        let value = self.force(&place, k);
        (place, value.widened(&above))
    }

    /// Computes the derivative of [`FirstContact::force`] by round trips inside a cell: with `(e^{−rt}G_r)′ =
    /// e^{−rt}H_r`, and for each ray `∂_ξψ₀ + ∂_ηψ₀ = (R²/4)(η/ξ + 1) ψ₁ = (R²/2)(τ/ξ) ψ₁`.
    fn force_rate(&self, trips: &N, k: i64) -> N {
        let (r, half_square) = (&self.damping, self.damping.square() / self.damping.int(2));
        let (mut kernel, mut rate) = (r.zero(), r.zero());
        for j in 0..=k {
            let sums = Ray::new(r, &r.int(j), trips).sums([1], |n| [i64::from(n == 1)]);
            let weight = r.int(if j == 0 { 1 } else { 2 } * if j % 2 == 0 { 1 } else { -1 });
            let lead = half_square.clone() * trips / (trips.clone() - r.int(j));
            rate = rate + (lead * &sums.sums[0] - sums.start.clone() * r) * &weight;
            kernel = kernel + sums.start * weight;
        }
        (rate * &self.speed + kernel * &self.critical) / self.total_speed()
    }

    /// Bounds all forces from `k t₁` on by half the static share of the force plus a bound of the transient.
    fn most_after(&self, k: i64) -> Option<N> {
        let share = self.critical.clone() / self.total_speed() / self.critical.int(2);
        Some(share.double(self.transient(k, None)?) + &share)
    }
}

/// Returns the greater of two numbers: `(a + b + |a − b|)/2` if their order is unknown.
fn greater<N: Scalar>(a: N, b: N) -> N {
    match a.compare(&b) {
        Ok(std::cmp::Ordering::Less) => b,
        Ok(std::cmp::Ordering::Greater) => a,
        _ => (a.clone() + &b + (a - &b).magnitude()) / b.int(2),
    }
}

/// Returns a number that is at least `a`, and at most `a` or `bound`.
fn at_most<N: Scalar>(a: N, bound: &N) -> N {
    let more = bound.clone() - &a;
    if more.positive() == Ok(false) { a } else { a.widened(&more) }
}
