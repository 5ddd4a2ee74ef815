//! Integrals along the rod during the first contact, by Gauss–Legendre rules between points and rays: energies, `E_z`
//! as a sum of squares, and moments over the cells of a grid.

use std::cmp::Ordering;

use super::field::{FirstContact, Trips, unknown};
use super::rebound::translational;
use crate::motion::{Energy, Side, moments};
use crate::number::Scalar;
use crate::special::BoundedSpecial;

/// A quadrature node: weight in `∫ da`, `v_t − h′`, `c v_x`.
struct Node<N> {
    weight: N,
    deviation: N,
    strain: N,
}

/// A stretch of the rod between two rays, and the numbers of upward and downward rays that have arrived there.
struct Stretch<N> {
    from: N,
    to: N,
    arrived: [i64; 2],
}

/// Parameters of the Bernstein ellipses that are tried.
const RADII: [f64; 11] = [1.1, 1.25, 1.5, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0];

/// Maximum number of nodes between two rays; only damping far beyond `r t₁ = 100` could need more.
const MOST_NODES: usize = 4000;
/// First guess of `E_z`, as `log₂` relative to its natural size.
const FIRST_SIZE: f64 = -12.0;
/// Smallest size for which nodes are added, as `log₂` relative to the natural size.
const LEAST_SIZE: f64 = -960.0;
/// Longest numbers that use the sums without cancellation at the first return; longer ones have bits to spare.
const MOST_BITS_WITHOUT_CANCELLATION: u32 = 64;

/// Largest error of the rule, relative to a roundoff of `μ + μ₀`, as `log₂`.
const LEFT: f64 = -6.0;

impl<N: BoundedSpecial> FirstContact<N> {
    /// Computes `E`, `E_h`, `E_z` at a time of the contact.
    ///
    /// **Source**: (3.54), (3.61)–(3.63), with `E_z = ½∫((v_t − h′)² + c²v_x²)dx`, so that `E_z ≪ E` keeps its digits.
    ///
    /// **Accuracy**: *within its own bound*, which includes rounding and quadrature. In doubles, at `t₁` and `R ≤ 1`,
    /// the parts of `v_t` and `v_x` that do not depend on x are omitted before the summation, and `E_z` is relatively
    /// accurate however small; at other times its error is that of `v_t` and `v_x`, whose accuracy is relative to `μ +
    /// μ₀`.
    ///
    /// ```
    /// # use dalembert::{Estimate, Parameters};
    /// # use dalembert::engine::FirstContact;
    /// // r = 0, μ ≥ μ₀ = 2: E_z(t₁) = μ₀² L/6.
    /// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 1e6 };
    /// let energy = FirstContact::new(&rod.carry()).energy(&Estimate::exact(2.0));
    /// assert!((energy.vibrational.value() - 2.0 / 3.0).abs() < 1e-14);
    /// ```
    pub fn energy(&self, time: &N) -> Energy<N> {
        let unknown = || unknown(time);
        self.trips(time).map_or_else(
            || Energy { total: unknown(), translational: unknown(), vibrational: unknown() },
            |trips| self.energy_at(&trips),
        )
    }

    pub(super) fn energy_at(&self, trips: &Trips<N>) -> Energy<N> {
        let (centre, velocity) = self.centre_at(trips);
        let translational = translational(&self.rod, &centre, &velocity);
        let both = |node: &Node<N>| node.deviation.square() + node.strain.square();
        let vibrational = self.vibrational(trips, &both);
        Energy { total: translational.clone() + &vibrational, translational, vibrational }
    }

    /// Computes the kinetic energy `L h′²/2 + ½ ∫ (v_t − h′)² dx` and the strain energy, the parts of one sum.
    pub(super) fn energy_parts_at(&self, trips: &Trips<N>) -> [N; 2] {
        let (_, velocity) = self.centre_at(trips);
        let whole = velocity.square() * &self.rod.length / velocity.int(2);
        let part = |square: &dyn Fn(&Node<N>) -> N| self.vibrational(trips, square);
        [whole + part(&|node| node.deviation.square()), part(&|node| node.strain.square())]
    }

    /// Computes `E_z`, or the part of it that `square` takes of a node: with the number of nodes for a small part of
    /// its natural size, and once more if the quadrature error exceeds the rounding errors. The rod is undeformed at
    /// the impact.
    fn vibrational(&self, trips: &Trips<N>, square: &dyn Fn(&Node<N>) -> N) -> N {
        if trips.lattice() == Some(0) {
            return self.damping.zero();
        }
        if let Some(faded) = self.faded(trips.number.to_f64()) {
            // Half of v_t² and half of c² v_x² over L.
            let most = self.damping.double((2.0 * faded).exp2().max(f64::MIN_POSITIVE));
            return self.damping.zero().widened(&(most * &self.rod.speed.square() * &self.rod.length));
        }
        let scale = 2.0 * self.total_speed().to_f64().log2() + self.rod.length.to_f64().log2();
        let ellipses = self.ellipses(trips);
        let goal = self.damping.log2_roundoff() + FIRST_SIZE + scale;
        let n = nodes(&ellipses, goal);
        let (value, rest) = (self.integrate(trips, n, square), rest(&ellipses, n));
        let (value, rest) = match nodes(&ellipses, value.log2_error().max(goal + LEAST_SIZE)) {
            more if more > n => (self.integrate(trips, more, square), self::rest(&ellipses, more)),
            _ => (value, rest),
        };
        // A thousandth more, for the doubles in it.
        let two = self.damping.int(2);
        value.widened(&(two.ln() * &two.double(rest + 1e-3)).exp())
    }

    /// Computes, for some ρ, `log₂` of the factor in the quadrature error between two rays, and by how much each node
    /// lowers it.
    ///
    /// The error of n nodes on an interval of half-width w is less than `(64/15) w M ρ^{−2n}/(1 − ρ⁻²)`, where M bounds
    /// the integrand on the Bernstein ellipse ρ, which reaches `δ = (ρ − 1/ρ)w/2` beyond an interval of half-width w.
    /// The error of both stretches together is less than `5 L A² ρ^{−2n}/(1 − ρ⁻²)`.
    fn ellipses(&self, trips: &Trips<N>) -> Vec<[f64; 2]> {
        let tau = trips.number.to_f64();
        let (mu, mu0, length) = (self.speed.to_f64(), self.critical.to_f64(), self.rod.length.to_f64());
        let bound = |rho: f64| {
            // No ray has come farther than a = τ, and the integrand does not depend on a beyond it.
            let beyond = (rho - 1.0 / rho) / 2.0 * (tau / 2.0).min(0.25);
            let amplitude = self.amplitude(tau, beyond, mu, mu0);
            [2.0 * amplitude.log2() + (5.0 * length / (1.0 - 1.0 / (rho * rho))).log2(), 2.0 * rho.log2()]
        };
        RADII.map(bound).to_vec()
    }

    /// Computes the integral with n nodes between two rays.
    fn integrate(&self, trips: &Trips<N>, n: usize, square: &dyn Fn(&Node<N>) -> N) -> N {
        let rule = self.damping.gauss_legendre(n);
        let mut sum = self.damping.zero();
        let (stretches, doubt) = self.stretches(trips);
        for stretch in stretches {
            let half = (stretch.to.clone() - &stretch.from) / sum.int(2);
            let places = rule.iter().map(|(x, w)| ((x.one() + x) * &half + &stretch.from, w.clone() * &half));
            let places: Vec<(N, N)> = places.collect();
            let short = self.damping.bits().is_some_and(|bits| bits <= MOST_BITS_WITHOUT_CANCELLATION);
            let nodes = if short && trips.lattice() == Some(1) && self.damping.to_f64() <= 1.0 {
                self.sample_first_return(places)
            } else {
                self.sample(trips, &stretch, places)
            };
            for node in nodes {
                sum = sum + square(&node) * &node.weight;
            }
        }
        // The size of v_t − h′ is at most twice that of v_t and c v_x.
        let square = self.total_speed().square() * &doubt.int(5);
        // The lengths are dx = c t₁ da = 2L da.
        ((sum.widened(&(doubt * square))) * &self.rod.length).without_exact()
    }

    /// Returns the stretches between the rays in the rod; except at lattice times there is one ray upwards and one
    /// downwards. If a ray is not separated from the top, the stretches end at the ray, and the second number bounds
    /// the length above them.
    fn stretches(&self, trips: &Trips<N>) -> (Vec<Stretch<N>>, N) {
        let (k, zero, half) = (trips.passed, self.damping.zero(), self.damping.ratio(1, 2));
        if trips.on_lattice {
            return (vec![Stretch { from: zero.clone(), to: half, arrived: [k, k] }], zero);
        }
        // The upward ray is at this a in the first half of a round trip, the downward one at the mirror image in the
        // second.
        let past = |trips: &N| trips.clone() - trips.int(k) - &half;
        let (side, late) = (past(&trips.exact).sign(), past(&trips.number).magnitude());
        let (lower, cut) = ([k + 1, k], half.clone() - &late);
        let upper = match side {
            Ok(Ordering::Greater) => [k + 1, k + 1],
            Ok(Ordering::Less) => [k, k],
            _ => return (vec![Stretch { from: zero, to: cut, arrived: lower }], late),
        };
        let lower = Stretch { from: zero.clone(), to: cut.clone(), arrived: lower };
        (vec![lower, Stretch { from: cut, to: half, arrived: upper }], zero)
    }

    fn sample(&self, trips: &Trips<N>, stretch: &Stretch<N>, places: Vec<(N, N)>) -> Vec<Node<N>> {
        let [_, centre] = self.centre_shares(&trips.number, trips.returned(Side::Left));
        let free = self.free_fall(&trips.number);
        let node = |(a, weight): (N, N)| {
            let [_, rate, slope] = self.field_shares(&a, &trips.number, stretch.arrived, &free);
            Node { weight, deviation: self.weighted(&rate.minus(&centre)), strain: self.weighted(&slope) }
        };
        places.into_iter().map(node).collect()
    }

    /// Samples the nodes at `t₁`, for R ≤ 1: the impact's share without the constant part along the rod.
    ///
    /// Two rays are there, `ξ = 1 ∓ a` and `ξ + η = 2`. In powers of R, `∂_tU₁ − RU₁ = 1 − Rξ + R²ξ/2 + T₃(ξ)`, and the
    /// first three add up to a constant; `T₃` is of order R³, `I₀ − 1` of order R². The remainder has no cancellation
    /// except at its own zeros.
    fn sample_first_return(&self, places: Vec<(N, N)>) -> Vec<Node<N>> {
        let one = self.damping.one();
        let [_, centre] = self.centre_shares(&one, 0);
        let (damp, free) = ((-self.damping.clone()).exp(), self.free_fall(&one));
        let both = |a: &N| self.third_order(a) + self.third_order(&(one.clone() - a));
        let rest: Vec<N> = places.iter().map(|(a, _)| both(a)).collect();
        let mean = places
            .iter()
            .zip(&rest)
            .fold(one.zero(), |mean, ((_, weight), value)| mean + weight.clone() * &one.int(2) * value);
        let node = |((a, weight), value): ((N, N), N)| {
            let [_, rate, mut slope] = self.field_shares(&a, &one, [1, 1], &free);
            let mut rate = rate.minus(&centre);
            rate.impact = (value - &mean) * &damp;
            let (near, far) = (self.bessel_rest(&a), self.bessel_rest(&(one.clone() - &a)));
            slope.impact = (far - near) * &damp;
            Node { weight, deviation: self.weighted(&rate), strain: self.weighted(&slope) }
        };
        places.into_iter().zip(rest).map(node).collect()
    }

    /// Computes `I₀(R√(1−a²)) − 1`, for R ≤ 1: terms fall at least fourfold, and the last one bounds the remainder.
    fn bessel_rest(&self, a: &N) -> N {
        let square = (a.one() - a) * &(a.one() + a) * &self.damping.square() / a.int(4);
        let terms = (-a.log2_roundoff() / 4.0) as i64 + 2;
        let mut term = a.one();
        let mut sum = a.zero();
        for m in 1..=terms {
            term = term * &square / a.int(m * m);
            sum = sum + &term;
        }
        sum.widened(&term)
    }

    /// Computes `T₃(a) = Σ_{p≥3} (R/2)^p Σ_{n+2m=p} ±{1,2} ξ^{n+m}η^m/(m!(n+m)!)`, with `ξ = 1 − a`, `η = 1 + a`.
    ///
    /// The terms of order p are at most `R^p/p!` together, since `Σ_ℤ qⁿIₙ = e^R`; the remainder is at most
    /// `2^{−bits−8}` of `R³/6`, and each order is one polynomial in ξ and η, in a form without the quotient η/ξ.
    fn third_order(&self, a: &N) -> N {
        let (xi, eta) = (a.one() - a, a.one() + a);
        let half = self.damping.clone() / a.int(2);
        let reach = self.damping.to_f64().max(1e-30);
        // The factors are x[k] = (Rξ/2)^k/k!, y[k] = (Rη/2)^k/k!, and the term is x[n+m] y[m].
        let (step_x, step_y) = (half.clone() * &xi, half * &eta);
        let goal = a.log2_roundoff() - 8.0;
        let (mut orders, mut log) = (3i64, 0.0f64);
        while log > goal {
            orders += 1;
            log += (reach / orders as f64).log2();
        }
        let powers = |step: &N| {
            let mut list = vec![a.one()];
            for k in 1..=orders {
                let next = step.clone() * &list[list.len() - 1] / a.int(k);
                list.push(next);
            }
            list
        };
        let (x, y) = (powers(&step_x), powers(&step_y));
        let mut sum = a.zero();
        for p in (3..=orders).rev() {
            let mut order = a.zero();
            for m in 0..=p / 2 {
                let n = p - 2 * m;
                let term = x[(n + m) as usize].clone() * &y[m as usize];
                order = order + if n == 0 { term } else { term * &a.int(2) };
            }
            sum = if p % 2 == 0 { sum + &order } else { sum - &order };
        }
        let cube = self.damping.square() * &self.damping * &a.double(goal.exp2() / 6.0);
        sum.widened(&cube)
    }

    /// Computes `∫ f dx` and `∫ f (x − a) dx` over each cell `a … b` between neighbours of `points`, for `f` = `v`,
    /// `v_t`, `v_x`.
    ///
    /// **Accuracy**: *within its own bound*, which includes rounding and quadrature. If a ray is not separated from a
    /// point of the grid or from the top, a cell ends at the ray, and the part between is at most
    /// [`FirstContact::total_speed`] times their distance.
    pub(super) fn moments_at(&self, points: &[N], trips: &Trips<N>) -> Vec<moments::Moments<N>> {
        let (stretches, _) = self.stretches(trips);
        let (zero, reach) = (self.damping.zero(), self.rod.length.clone() * &self.damping.int(2));
        let ends: Vec<N> = std::iter::once(zero.clone()).chain(points.iter().cloned()).collect();
        let places: Vec<N> = ends.iter().map(|x| (x.clone() / &reach).without_exact()).collect();
        let cells: Vec<_> = places.windows(2).map(|pair| parts(&stretches, &pair[0], &pair[1])).collect();

        let moved = cells.iter().flat_map(|(parts, _)| parts).filter(|part| part.arrived[0] > 0);
        let widest = moved.map(|part| (part.to.clone() - &part.from).to_f64() / 2.0).fold(0.0, f64::max);
        let (left, rule) = self.rule(trips, widest);
        let free = self.free_fall(&trips.number);
        let sums = cells.iter().zip(ends.windows(2)).map(|((parts, doubt), pair)| {
            let node = |part: &Stretch<N>, at: &N, weight: &N| {
                let half = (part.to.clone() - &part.from) / zero.int(2);
                let a = (at.one() + at) * &half + &part.from;
                let [_, rate, slope] = self.field_shares(&a, &trips.number, part.arrived, &free);
                moments::Node {
                    weight: weight.clone() * &half * &reach,
                    x: a * &reach,
                    velocity: self.weighted(&rate),
                    strain: self.weighted(&slope) * &self.slowness,
                }
            };
            let nodes = parts.iter().flat_map(|part| rule.iter().map(move |(at, weight)| node(part, at, weight)));
            let width = pair[1].clone() - &pair[0];
            let off = (left.clone() * &width + self.total_speed() * doubt * &reach).without_exact();
            moments::Sums::of(&pair[0], nodes).widened(&width, &off, &(off.clone() * &self.slowness))
        });
        moments::of_sums(sums.collect(), points, zero.clone())
    }

    /// Returns the error of a rule in `v_t` and `c v_x` per length, and the rule, for half-widths up to `half`.
    ///
    /// The error of n nodes on an interval of half-width w is less than `(64/15) w M ρ^{−2n}/(1 − ρ⁻²)`, where M bounds
    /// the integrand on the Bernstein ellipse ρ. There a place relative to a cell that holds the interval, which is
    /// between 0 and 1 inside, is at most ρ; the integrands contain its square at most.
    fn rule(&self, trips: &Trips<N>, half: f64) -> (N, Vec<(N, N)>) {
        let tau = trips.number.to_f64();
        let (mu, mu0) = (self.speed.to_f64(), self.critical.to_f64());
        let ellipses = RADII.map(|rho| {
            let amplitude = self.amplitude(tau, (rho - 1.0 / rho) / 2.0 * half, mu, mu0);
            let factor = 32.0 / 15.0 * rho * rho / (1.0 - 1.0 / (rho * rho));
            [amplitude.log2() + factor.log2(), 2.0 * rho.log2()]
        });
        let n = nodes(&ellipses, self.damping.log2_roundoff() + LEFT + (mu + mu0).log2());
        // A thousandth more, for the doubles in it.
        let two = self.damping.int(2);
        let left = (two.ln() * &two.double(rest(&ellipses, n) + 1e-3)).exp();
        (left, self.damping.gauss_legendre(n))
    }
}

/// Returns the parts of `from … to` between rays, and the possible miss of an end not separated from a ray.
fn parts<N: Scalar>(stretches: &[Stretch<N>], from: &N, to: &N) -> (Vec<Stretch<N>>, N) {
    let mut doubt = from.zero();
    let (Some(lower), Some(upper)) = (stretches.first(), stretches.last()) else { return (Vec::new(), doubt) };
    let part = |from: &N, to: &N, of: &Stretch<N>| Stretch { from: from.clone(), to: to.clone(), ..*of };
    let cut = &lower.to;
    let sides = [from, to].map(|end| match cut.compare(end) {
        Ok(order @ (Ordering::Less | Ordering::Greater)) => Some(order),
        _ => {
            doubt = doubt.clone() + (cut.clone() - end).magnitude();
            None
        }
    });
    let parts = match sides {
        [Some(Ordering::Greater), Some(Ordering::Greater)] => vec![part(from, to, lower)],
        [Some(Ordering::Greater), Some(_)] => vec![part(from, cut, lower), part(cut, to, upper)],
        [Some(Ordering::Greater), None] => vec![part(from, cut, lower)],
        [Some(_), _] => vec![part(from, to, upper)],
        [None, Some(Ordering::Less)] => vec![part(cut, to, upper)],
        // The cell is no wider than the doubt.
        [None, _] => Vec::new(),
    };
    (parts, doubt)
}

/// Returns the number of nodes whose error is less than `2^goal`.
fn nodes(ellipses: &[[f64; 2]], goal: f64) -> usize {
    let best = ellipses.iter().map(|[log, step]| (log - goal) / step).fold(f64::INFINITY, f64::min);
    best.ceil().clamp(2.0, MOST_NODES as f64) as usize
}

/// Computes `log₂` of the error bound of n nodes.
fn rest(ellipses: &[[f64; 2]], n: usize) -> f64 {
    ellipses.iter().map(|[log, step]| log - n as f64 * step).fold(f64::INFINITY, f64::min)
}
