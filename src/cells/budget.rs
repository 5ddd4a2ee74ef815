//! Error bound of a run: one sum, to which every step adds its own term.
//!
//! `docs/bounds.md` has the whole on one page. Dimensionless: velocities in `V`, times in `t₁`. There are two accounts,
//! and the better one holds. One bounds `v` at equal times, and counts every displaced ray separately: it serves any
//! start and any damping. The other, for separated flights, compares the vibration at equal times and the centre of
//! mass at equal times since the last event. It follows, with their signs, the effects of each source of error on the
//! time of that event and on the velocity of the centre.

use super::dependence::{Dependence, Form, Landing, SAME, TakeOff};
use super::effort::LEAST_LEAP;
use super::uncertainty::{Off, Uncertainty};
use crate::special::{phi1, phi2};

/// Error of a state that is interpolated from values, in cell errors.
pub(super) const FIRST_CELLS: f64 = 8.0;
/// Error of a cut, in cell errors: the series is interpolated again.
pub(super) const CUT_CELLS: f64 = 2.0;
/// Error of a leap, a separation or a joining, in cell errors: every coefficient is a sum of some dozen terms, none
/// greater than the greatest `|q|`.
pub(super) const LEAP_CELLS: f64 = 16.0;

/// Largest time uncertainty, in round trips, at which event order is still trusted.
pub(super) const MOST_LATE: f64 = 0.01;

/// Error bounds of the values at an event, whatever its true time, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AtEvent {
    pub(super) rise: f64,
    /// Bound for `h`.
    pub(super) centre: f64,
    /// Bound for velocities and `c v_x`.
    pub(super) speed: f64,
    pub(super) end: f64,
    /// Bound for `h′`.
    pub(super) rate: f64,
    /// Bound for `h′ + 2Rh`, which only the force of the ground and gravity change.
    pub(super) momentum: f64,
}

/// The account at equal times.
#[derive(Clone, Copy, Debug, Default)]
struct Fixed {
    /// Error of `p` and `q`, except next to displaced rays.
    point: f64,
    /// Sum of `|jump| · time error` over the displaced rays, which fades as the jumps do.
    rays: f64,
    /// Masses of all displaced rays; and the error of `p` and `q` that damping has scattered from them.
    mass: f64,
    scatter: f64,
    /// Error of `v(0,b)`.
    height: f64,
    /// Maximum of `point`, `height` and the time errors of events.
    worst: f64,
}

/// Errors that the state carries.
#[derive(Clone, Debug, Default)]
pub(super) struct Budget {
    /// `R`.
    damping: f64,
    /// Whether flights are separated.
    apart: bool,
    /// Error of `p` and `q` by truncation, rounding and undecided events.
    roundoff: f64,
    /// Part of `roundoff` from undecided events. Decisions at the ground are made against `roundoff` without it: it
    /// covers what an event may have changed, and not what rounding hides.
    covered: f64,
    /// First-order effects of the time errors of events.
    events: Dependence,
    rest: Rest,
    /// Error of `p` and `q` that damping has scattered from displaced rays in the leaps of this flight.
    leapt: f64,
    /// `roundoff` and `rest` at the beginning of the flight.
    began: (f64, Rest),
    pub(super) flight: TakeOff,
    landing: Option<Landing>,
    /// Greatest time error of the rays.
    pub(super) rays: f64,
    /// Greatest errors since the last event.
    worst: Uncertainty,
    fixed: Fixed,
}

/// Errors that are not followed with signs: a motion of its own, its centre of mass included. Neither norm of it grows,
/// in flight or in contact.
#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    /// The integral `∫|δq|` along a characteristic.
    wave: f64,
    /// Error of `p` and `q` between rays.
    point: f64,
    /// Error of `p` and `q` that damping scatters from displaced rays.
    scatter: f64,
    /// Part of `wave` in masses of rays whose places are no longer known.
    unplaced_mass: f64,
    /// Bound of `|δh′|` at the last take-off, for the part that `wave` bounds.
    mean: f64,
}

/// Computes `e^{−2Rτ}` and `(1 − e^{−2Rτ})/2R` at the age τ.
fn aged(damping: f64, age: f64) -> (f64, f64) {
    let fall = -2.0 * damping * age;
    (fall.exp(), phi1(&fall) * age)
}

/// Rate of fading: `‖e^{−Rn} e^{nG}‖ ≤ e^{−FADES·Rn}`, as `‖G‖ ≤ R²/8 (1 + R²/150)` and `R ≤ 2`.
const FADES: f64 = 0.74;
/// Largest `|v̇| δt/|v|` at which a landing is treated as a linear function of the errors.
const MOST_BENT: f64 = 0.01;

/// Bounds the difference of `w′` and `−κe^{−κs} − κ`, where `∫₀¹ y dt = ∫₀¹ w(s) q(s) ds` over a contact of one round
/// trip: every factor of [`weight_slope`] except κ itself bounds a quantity between it and its reciprocal.
pub(super) fn weight_rest(kappa: f64) -> f64 {
    weight_slope(kappa) - 2.0 * kappa
}

/// Bounds `|w′|`.
fn weight_slope(kappa: f64) -> f64 {
    kappa * (1.0 + (1.0 + kappa) * (1.0 + kappa * kappa.exp() + kappa * kappa) * (2.0 * kappa).exp())
}

impl Fixed {
    /// Returns the error of `p` and `q`, except next to displaced rays.
    fn points(&self) -> f64 {
        self.point + self.scatter
    }

    /// Adds the error that `trips` round trips scatter from the masses of displaced rays: a path crosses each ray twice
    /// in one round trip, at the cost of a part κ of its mass each time, and at most `e^R` of it in all.
    fn turn(&mut self, damping: f64, trips: f64) {
        self.scatter = (self.scatter + damping * trips * self.mass).min(damping.exp() * self.mass);
    }
}

impl Budget {
    pub(super) fn new(damping: f64, apart: bool) -> Self {
        Budget { damping, apart, ..Budget::default() }
    }

    /// Adds an error of `p` and `q`.
    pub(super) fn add(&mut self, error: f64) {
        self.roundoff += error;
        self.fixed.point += error;
        self.note();
    }

    /// Returns the error below which values decide nothing: that of roundings and truncations in `p` and `q`, and if
    /// flights are not separated also that scattered from displaced rays.
    pub(super) fn noise(&self) -> f64 {
        (if self.apart { self.roundoff } else { self.fixed.points() } - self.covered).max(0.0)
    }

    /// Returns the error of `p` and `q` at the ground, below which the sign of the trace is undecided.
    pub(super) fn trace(&self) -> f64 {
        let Off { fixed, apart } = self.point();
        self.better(Off { fixed, apart: apart + self.worst.slope * self.events.late.bound() })
    }

    /// Bounds the error of `v(0,·)` up to `len` from now; in a separated flight `flown` has the ages and `h′` now and
    /// then. Each term is the greatest value of the corresponding term of [`Self::end`] between these. `passing` is
    /// `Σ |jump| · time error` of the rays that pass in each round trip, which the account at equal times adds each
    /// time; the account by the clock of the vibration has them in the masses of its sources.
    pub(super) fn end_most(&self, flown: Option<[(f64, f64); 2]>, len: f64, passing: f64) -> f64 {
        let apart = flown.map(|[(from, before), (to, after)]| {
            let (start, (_, slowed)) = (self.flight.end_rate, aged(self.damping, to));
            let moves = (start + before).abs().max((start + after).abs());
            let followed =
                moves * self.events.late.bound() + slowed * self.events.rate.bound() + 2.0 * self.events.mass();
            followed + self.not_followed(to) + self.scattered(from, to)
        });
        let fixed = self.fixed.height + (self.fixed.points() + passing) * len;
        apart.map_or(fixed, |apart| apart.min(fixed))
    }

    /// Adds an error that covers both outcomes of an undecided event, which differ by at most `differ` from now on.
    pub(super) fn cover(&mut self, differ: f64) {
        self.add(differ);
        self.covered += differ;
        self.began.0 += differ;
    }

    /// Returns the error of `p` and `q`, except next to displaced rays; in contact at equal times since the landing.
    pub(super) fn point(&self) -> Off {
        let displaced = self.landing.map_or(0.0, |landing| landing.slope * self.events.late.bound());
        Off { fixed: self.fixed.points(), apart: self.loose() + displaced + self.events.between() }
    }

    /// Returns the part of that error that is not followed with signs.
    fn loose(&self) -> f64 {
        let Rest { wave, point, scatter, unplaced_mass, .. } = self.rest;
        // R(T + 1) of the masses of rays that have travelled for T round trips, and at most 1.6 of them in all.
        let masses = wave + self.events.mass();
        let scattered = scatter + self.leapt + self.damping * masses;
        self.roundoff + point + unplaced_mass + scattered.min(2.0 * masses)
    }

    /// Returns the sum of the masses of displaced rays.
    pub(super) fn masses(&self) -> f64 {
        let apart = self.rest.wave + self.rest.unplaced_mass + self.events.mass();
        self.better(Off { fixed: self.fixed.rays, apart })
    }

    /// Returns the error of displacements by the clock of the vibration, at events, where the end is at height zero.
    fn beyond(&self) -> f64 {
        // Displacements about the centre of mass are off by at most ½e^R times the error of `p` and `q`.
        2.0 * self.rest.wave + self.events.mass() + 4.0 * self.roundoff
    }

    /// Returns the error of `h′` in a separated flight and at its ends.
    fn rate(&self) -> f64 {
        self.events.rate.bound() + self.mean_of(self.roundoff) + self.rest.mean
    }

    /// Bounds the error of `h′ = ∫ e^{R(η−b)} q dη` for the error `roundoff` of `q`.
    fn mean_of(&self, roundoff: f64) -> f64 {
        phi1(&self.damping) * roundoff
    }

    /// Returns the errors at the last event, whatever its true time; for a release `begins` has the greatest slope of
    /// the vibration, its variation, and `z_tt` at the end.
    pub(super) fn at_event(&self, begins: Option<(f64, f64, f64)>) -> AtEvent {
        let late = self.events.late.bound();
        let (at, end_rate, near, slope, variation, bend) = match (begins, self.landing) {
            (None, Some(Landing { at, velocity, rate, off, slope, variation, bend, .. })) => {
                (at, velocity - rate, off.apart.max(SAME), slope, variation, bend)
            }
            (begins, _) => {
                let (slope, variation, bend) = begins.unwrap_or_default();
                (self.flight.at, self.flight.end_rate, -1.0, slope, variation, bend)
            }
        };
        let (rate, grown) = (self.rate(), self.damping.exp());
        let rise = self.beyond() + 0.5 * variation * late;
        // h = −z(0,·) follows from the weight that makes the mean of z vanish.
        let rest = 0.5 * grown * (self.rest.wave + self.mean_of(self.roundoff) + self.rest.mean + self.roundoff);
        let centre = rise.min(self.events.ground_then(at, end_rate, near) + rest);
        let (loose, between) = (self.loose(), self.events.between() + slope * late);
        let end = loose + between.min(self.events.velocity_then(at, bend, begins.is_some()));
        AtEvent { rise, centre, speed: loose + between, end, rate, momentum: rate + 2.0 * self.damping * centre }
    }

    /// Bounds the delay of the clock: in contact that of the landing, in flight that of the vibration.
    pub(super) fn clock(&self, contact: bool) -> f64 {
        if contact { self.events.time() } else { self.events.clock.bound() }
    }

    /// Returns the time error of the last event, by the better of both accounts.
    pub(super) fn last(&self, off: Off) -> f64 {
        if self.apart { off.fixed.min(off.apart).min(self.events.time()) } else { off.fixed }
    }

    /// Computes the error of `v(0,·)` in flight, up to `len` from now; in a separated flight `flown` is the age, `h′`
    /// and the place on the circle then.
    pub(super) fn end(&self, flown: Option<(f64, f64, f64)>, len: f64) -> Off {
        let apart = flown.map_or(0.0, |(age, rate, at)| {
            let (form, more) = self.flown((age, rate, at), 0.0);
            form.bound() + more
        });
        Off { fixed: self.fixed.height + self.fixed.points() * len, apart }
    }

    /// Computes that error by the clock of the vibration: a linear function of the sources, and a remainder.
    fn flown(&self, (age, rate, at): (f64, f64, f64), near: f64) -> (Form, f64) {
        let (_, slowed) = aged(self.damping, age);
        let TakeOff { at: from, end_rate, .. } = self.flight;
        let fade = (-self.damping * age).exp();
        let (form, unclear) = self.events.height((-(end_rate + rate), slowed), (from, at), fade, near);
        (form, self.not_followed(age) + unclear + self.scattered(age, age))
    }

    /// Bounds the contribution of the rest to the error of `v(0,·)` at this age: through its centre of mass and its
    /// vibration, or, in a flight without leaps, through the part that reaches the ground in each round trip.
    ///
    /// The first follows from `h′ = ∫ e^{R(η−b)} q dη` and `z(0,b) = −∫ w (q − h′) dη`, `|w| ≤ ½e^R`. The second holds
    /// as the ground receives at most `W/(1 − κ)` in each round trip: the part of `∫|q|` still on its way down falls by
    /// `(1 − κ)|q(0,·)|`.
    fn not_followed(&self, age: f64) -> f64 {
        let ((roundoff, Rest { wave, mean, .. }), grown) = (self.began, self.damping.exp());
        let (_, slowed) = aged(self.damping, age);
        let apart = slowed * (self.mean_of(roundoff) + mean) + grown * (1.0 + grown) * wave + 0.5 * grown * roundoff;
        let left = 1.0 - 0.5 * self.damping;
        let passed = if age < LEAST_LEAP && left > 0.0 {
            grown * (roundoff * age + wave * age.ceil() / left)
        } else {
            f64::INFINITY
        };
        apart.min(passed) + 0.5 * grown * self.roundoff
    }

    /// Bounds the effect of damping on the stripes between these ages, apart from their fading; at most their own size.
    ///
    /// A ray loses `1 − e^{−Rτ} ≤ Rτ` of its mass, and a level changes by R of the levels that it meets: at most `2Rτ`,
    /// whose mean is subtracted; the vibration of a mass is at most twice the mass. Over long flights `Z = e^{Rt} z`
    /// has `Z_tt − Z_xx = R²Z`: a mass m makes `|Z| ≤ ½m`, so that `Z_t + Z_x` is off by `½R²τ m`, growing with itself,
    /// and `z_t + z_x` by `R|Z|` more at either end.
    fn scattered(&self, from: f64, age: f64) -> f64 {
        let left = 2.0 * (self.damping * (6.0 - FADES * from)).exp() + (-self.damping * from).exp();
        let turned = (0.5 * self.damping * self.damping * age).exp_m1() * (2.0 * self.damping).exp();
        self.events.mass() * left.min(2.0 * self.damping + turned).min(2.0 * self.damping * age)
    }

    /// Returns the greatest errors since the last call.
    pub(super) fn since(&mut self) -> Uncertainty {
        let fixed = self.fixed.worst + self.fixed.rays;
        self.fixed.worst = self.fixed.points().max(self.fixed.height);
        let worst = Uncertainty { rays: self.rays, ..std::mem::take(&mut self.worst) };
        self.note();
        if self.apart && worst.rise.max(worst.speed) < fixed {
            return worst;
        }
        // Error of h′ of a separated flight from an error of `q` on its first characteristic.
        let rate = if self.apart { self.damping.exp() * fixed } else { fixed };
        Uncertainty { rise: fixed, speed: fixed, rate, late: 0.0, ..worst }
    }

    /// Records the time error of an event and of the ray that it starts.
    pub(super) fn note_event(&mut self, off: Off) {
        self.fixed.worst = self.fixed.worst.max(off.fixed);
        self.rays = self.rays.max(self.better(off));
    }

    /// Adds the error of the height at the end of a piece of rest.
    pub(super) fn rest(&mut self, far: f64) {
        self.fixed.height += far;
        self.worst.rise = self.worst.rise.max(far);
        self.note();
    }

    /// Adds the errors of a strip, a part of a round trip in contact or in flight, with the error `cell` in each cell.
    pub(super) fn strip(&mut self, len: f64, cell: f64, contact: bool) {
        if !contact {
            self.fixed.height += self.fixed.points() * len;
        }
        self.roundoff += 2.0 * cell;
        self.rest.scatter += 2.0 * self.damping * len * (self.rest.wave + self.events.mass());
        self.fixed.point += 2.0 * cell;
        self.fixed.turn(self.damping, len);
        // A jump of p fades along its ray as in p_η = −κp, with η = 2t there.
        self.fixed.rays *= (-self.damping * len).exp();
        self.note();
    }

    /// Records the error of the end in flight; at any other point `½∫|δp| + |δq| dx` is added.
    pub(super) fn note_end(&mut self, off: Off) {
        let beyond = self.roundoff + self.rest.wave + 2.0 * self.events.mass();
        self.worst.rise = self.worst.rise.max(off.apart + beyond);
    }

    /// Records bounds since the last event: of the slope of velocities between rays and of the jumps at rays, of
    /// velocities and `c v_x` (`most`), and of the invariants (`peak`).
    pub(super) fn note_slope(&mut self, (slope, jumps): (f64, f64), (most, peak): (f64, f64)) {
        self.worst.jumps = self.worst.jumps.max(jumps);
        self.worst.slope = self.worst.slope.max(slope);
        self.worst.most = self.worst.most.max(most);
        self.worst.peak = self.worst.peak.max(peak);
    }

    /// Adds the error of a displaced ray that passes the ground in flight: the velocity jumps at the wrong time.
    pub(super) fn pass(&mut self, jump: f64, off: Off) {
        self.fixed.height += jump * off.fixed;
    }

    /// Adds the errors of a leap, with its own error `error`; the vibration fades. `passing` is `Σ |jump| · time error`
    /// of all rays, each time that they pass.
    ///
    /// The operator `e^{tG}` propagates `Z`, with `‖G‖ ≤ R²/8 (1 + R²/150)`; conversion from and to the characteristic
    /// costs at most the factor `e^{6R}`.
    pub(super) fn leap(&mut self, trips: f64, error: f64, passing: f64) {
        // The centre of mass fades by e^{−2R} in each round trip, and is at most e^R of the whole.
        let fade = ((2.0 + self.damping.exp()) * (self.damping * (6.0 - FADES * trips)).exp()).min(1.0);
        let scattered = 2.0 * self.damping * trips;
        self.leapt += scattered * self.events.mass();
        self.covered *= fade;
        self.roundoff = self.roundoff * fade + error;
        let Rest { wave, point, scatter, unplaced_mass, mean } = self.rest;
        self.rest = Rest {
            wave: wave * fade,
            point: point * fade,
            scatter: (scatter + scattered * wave) * fade,
            unplaced_mass: unplaced_mass * fade,
            mean: mean * fade,
        };
        self.fixed.turn(self.damping, trips);
        self.fixed.height += trips * (self.fixed.points() + error + passing);
        self.fixed.point += error;
        self.fixed.rays *= (-self.damping * trips).exp();
        self.note();
    }

    /// Adds the errors of a release with this velocity.
    pub(super) fn let_go(&mut self, velocity: f64, off: Off, cell: f64) {
        self.displace(velocity, off.fixed);
        self.fixed.height = velocity * off.fixed + cell;
        self.note();
    }

    /// Adds a ray with a time error, on which p changes from −q to q or back.
    fn displace(&mut self, velocity: f64, fixed: f64) {
        self.fixed.rays += 2.0 * velocity * fixed;
        self.fixed.mass += 2.0 * velocity * fixed;
        self.fixed.turn(self.damping, 1.0);
    }

    /// Adds the errors of a landing: the displaced part of its ray has twice the mass of the error of the height.
    pub(super) fn hit(&mut self, velocity: f64, off: Off) {
        // If the velocity is small, it grows by as much again while the end may touch.
        let (drop, height) = (velocity * off.fixed, self.fixed.height);
        let slow = if drop < height { 2.0 * height } else { 0.0 };
        self.fixed.rays += slow;
        self.fixed.mass += slow;
        self.displace(velocity, off.fixed);
        self.fixed.height = 0.0;
        self.note();
    }

    /// Adds the errors of the separation into centre of mass and vibration after a release.
    pub(super) fn take_off(&mut self, flight: TakeOff, rounding: f64) {
        let r = self.damping;
        self.roundoff += rounding;
        self.fixed.point += rounding;
        let more = match self.landing.take() {
            Some(landing) if flight.whole => self.after_round_trip(&landing, &flight),
            Some(landing) => {
                self.after_contact(&landing, &flight);
                0.0
            }
            None => {
                self.events.release_late(flight.off, flight.fall);
                self.events.start_stripe(flight.at, flight.jump.1);
                4.0 * r.exp() * self.events.mass()
            }
        };
        self.events.add_rate(more);
        let (mass, level) = self.events.thin();
        self.rest.wave += 2.0 * mass;
        self.rest.unplaced_mass += mass;
        self.rest.point += level;
        self.began = (self.roundoff, self.rest);
        self.flight = flight;
        self.note();
    }

    /// Follows the errors through a contact of one round trip, which the true motion makes as well: without damping and
    /// gravity it changes the sign of the vibration whenever it begins. Returns the part of the new `δh′` of unknown
    /// sign.
    fn after_round_trip(&mut self, landing: &Landing, flight: &TakeOff) -> f64 {
        let r = self.damping;
        let kappa = 0.5 * r;
        let (late, rate, mass) = (self.events.late.bound(), self.events.rate.bound(), self.events.mass());
        // The ray of the landing returns at the release with e^{−R} of its mass, and the loss is scattered.
        let scattered = r * (2.0 * landing.velocity.abs() * late + mass);
        let rigid = (5.0 * r).min(2.0) * rate;
        let new = scattered + rigid;
        // The rest changes its sign. A part of mean zero before has a mean of order R after.
        let weights = (-r).exp_m1().abs() + weight_slope(kappa);
        let grown = (weights + 2.0 * r * r.exp()) * 2.0 * self.rest.wave;
        self.rest.mean = (self.rest.mean + grown).min(r.exp() * self.rest.wave);
        self.rest.wave += new;
        self.rest.point += new + scattered;
        // The sum h′ + 2Rh changes by −2∫y, and h = −z(0,·) at both ends of the contact.
        let (phase, phase_rest) = landing.phase;
        let heights = 2.0 * r * (flight.end_rate - (landing.velocity - landing.rate));
        let by_rigid = phi1(&-(r + kappa)) + kappa * phi2(&-r);
        let keeps = (1.0 - 2.0 * by_rigid).clamp(-1.0, 1.0);
        let by_mass = |at: f64| {
            let s = (at - landing.at).rem_euclid(1.0);
            -2.0 * ((-kappa * s).exp() + kappa * (1.0 - s) - (r * s).exp() * by_rigid)
        };
        self.events.round_trip((keeps, heights - 2.0 * phase), (-r).exp(), by_mass);
        self.events.start_stripe(flight.at, flight.jump.1);
        2.0 * r * r.exp() * (new + 2.0 * mass)
            + 2.0 * phase_rest * late
            + weight_rest(kappa) * rate
            + 2.0 * (weight_rest(kappa) + r * r) * r.exp() * mass
    }

    /// Follows the errors through any other contact: the part that passes the ground changes its sign.
    fn after_contact(&mut self, landing: &Landing, flight: &TakeOff) {
        let r = self.damping;
        let time = self.events.time();
        let (fade, faded) = ((-r * flight.len).exp(), r * flight.len);
        self.events.contact((landing.at, flight.len), (landing.velocity, landing.fall), fade);
        let (mass, level) = (self.events.mass(), self.events.level());
        // A path crosses a ray twice in a round trip, each time at the cost of κ of its mass.
        let most = (faded + r) * mass + faded * level;
        let Rest { wave, point, scatter, unplaced_mass, .. } = self.rest;
        let loose = self.roundoff + point + unplaced_mass + scatter + r * wave;
        let unknown = flight.slope.map_or(0.0, |slope| (loose + most) / slope.abs());
        let limits = (unknown + flight.rounding, flight.off + time);
        self.events.release((flight.at, flight.fall), flight.jump, flight.slope, limits);
        self.rest.wave += faded / fade * (mass + level);
        self.rest.mean = r.exp() * self.rest.wave;
        self.rest.point += most / fade;
    }

    /// Adds the errors of the landing of a separated flight. Times count from this landing on.
    pub(super) fn land(&mut self, landing: Landing) {
        let Landing { at, velocity, curvature, off, age, rate, fall, range, .. } = landing;
        let (speed, clock) = (velocity.abs(), self.events.clock.bound());
        let (kept, _) = aged(self.damping, age);
        let fade = (-self.damping * age).exp();
        let (form, more) = self.flown((age, rate, at), off.apart.max(SAME));
        let scattered = self.scattered(age, age);
        let bent = curvature * off.apart / speed;
        let linear = bent <= MOST_BENT;
        // The delay δt = −δv/v is by the clock of the vibration; the nonlinear remainder is a new source.
        let mut late = Form::default();
        let others = if linear {
            late.add(-1.0 / velocity, &form);
            bent * off.apart + (off.apart - clock - form.bound() / speed).max(more / speed)
        } else {
            off.apart + clock
        };
        self.events.land((late, others), (kept, fall), fade);
        self.rest.wave += scattered;
        self.rest.point += scattered;
        self.leapt = 0.0;
        // A vibration that has faded is compared from now on by the clock of the landing.
        if range <= self.damping * speed {
            self.rest.wave += landing.variation * self.events.late.bound();
            self.rest.point += landing.slope * self.events.late.bound();
            self.events.reset_clock();
        }
        self.landing = Some(landing);
        self.note();
    }

    pub(super) fn better(&self, off: Off) -> f64 {
        if self.apart { off.fixed.min(off.apart) } else { off.fixed }
    }

    /// Adds the ray of a possible hop, at most `mass`: the end may lie on the ground before another ray releases it.
    pub(super) fn cover_hop(&mut self, mass: f64) {
        self.fixed.rays += mass;
        self.fixed.mass += mass;
        self.fixed.turn(self.damping, 1.0);
        self.rest.wave += mass;
        self.rest.unplaced_mass += mass;
    }

    /// Returns whether both accounts have lost the order of events.
    pub(super) fn lost(&self, off: Off) -> bool {
        off.fixed > MOST_LATE && (!self.apart || off.apart > MOST_LATE)
    }

    fn note(&mut self) {
        let (speed, late) = (self.point().apart, self.events.time().max(self.events.clock.bound()));
        let (mut rise, mut rate) = (self.beyond(), self.rate());
        if let Some(landing) = self.landing {
            // Displacements at equal times since the landing are v(x) = ∫ v_x, and h′ is a mean of `p` and `q`.
            rise += 0.5 * (rate + landing.variation * self.events.late.bound());
            rate = 2.0 * rise;
        }
        self.worst = self.worst.max(Uncertainty { rise, speed, rate, late, ..Uncertainty::default() });
        self.fixed.worst = self.fixed.worst.max(self.fixed.points()).max(self.fixed.height);
    }
}
