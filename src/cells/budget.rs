//! What the numbers of a run may be off by: one sum, to which every step adds its own term.
//!
//! The whole on one page: `docs/bounds.md`. Dimensionless: velocities in `V`, times in `t₁`. There are two accounts,
//! and the better one holds. One bounds `v` at equal times, and takes every ray that is off for itself: it serves any
//! start and any damping. The other, where flights are taken apart, compares the vibration at equal times and the
//! centre of mass at equal times since the last event, and follows with their signs what the time of that event and the
//! velocity of the centre owe to each source of error.

use super::dependence::{Dependence, Form, Landing, TakeOff};
use super::effort::LEAST_LEAP;
use super::uncertainty::{Off, Uncertainty};
use crate::special::{phi1, phi2};

/// The errors of a cell that a state is off by which is interpolated from values.
pub(super) const FIRST_CELLS: f64 = 8.0;
/// Those that a cut adds, which interpolates anew what a series has already.
pub(super) const CUT_CELLS: f64 = 2.0;
/// Those of a leap, of a separation and of a joining: every coefficient is a sum of some dozen terms, none greater than
/// the greatest `|q|`.
pub(super) const LEAP_CELLS: f64 = 16.0;

/// Where times are in doubt by more than this part of a round trip, so are the events.
pub(super) const MOST_LATE: f64 = 0.01;

/// How far the values at an event may be off, whenever it is, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AtEvent {
    pub(super) rise: f64,
    /// `h`.
    pub(super) centre: f64,
    /// Velocities and `c v_x`.
    pub(super) speed: f64,
    pub(super) end: f64,
    /// `h′`.
    pub(super) rate: f64,
    /// `h′ + 2Rh`, which only the force of the ground and gravity change.
    pub(super) momentum: f64,
}

/// The account at equal times.
#[derive(Clone, Copy, Debug, Default)]
struct Fixed {
    /// Of `p` and `q`, but next to rays that are off.
    point: f64,
    /// `Σ |jump| · time` of rays that are off, fading as the jumps do.
    rays: f64,
    /// Masses of all rays that are off, and what damping has scattered from them into `p` and `q`.
    mass: f64,
    scatter: f64,
    /// Of `v(0,b)`.
    height: f64,
    /// The most that `point`, `height` and the times of events were.
    worst: f64,
}

/// The errors that the state carries.
#[derive(Clone, Debug, Default)]
pub(super) struct Budget {
    /// `R`.
    damping: f64,
    /// Whether flights are taken apart.
    apart: bool,
    /// Of `p` and `q`, by truncation and rounding, and by what was open.
    even: f64,
    /// The latter, by which nothing is decided.
    covered: f64,
    /// What events that are off in time do, to first order.
    events: Dependence,
    rest: Rest,
    /// `even`, and the rest, when the flight began.
    began: (f64, Rest),
    pub(super) flight: TakeOff,
    landing: Option<Landing>,
    /// The most that rays are off in time.
    rays: f64,
    /// The most that was off since the last event.
    worst: Uncertainty,
    fixed: Fixed,
}

/// The errors that are not followed with signs: a motion of its own, its centre of mass included. Neither norm of it
/// grows, in flight or in contact.
#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    /// `∫|δq|` along a characteristic.
    wave: f64,
    /// Of `p` and `q` between rays.
    point: f64,
    /// Of `p` and `q`, by what damping scatters from displaced rays.
    scatter: f64,
    /// The part of `wave` that is masses of rays whose places are no longer known.
    lumps: f64,
    /// A bound of `|δh′|` at the last take-off, of the part that `wave` bounds.
    mean: f64,
}

/// `e^{−2Rτ}` and `(1 − e^{−2Rτ})/2R` at the age τ.
fn aged(damping: f64, age: f64) -> (f64, f64) {
    let fall = -2.0 * damping * age;
    (fall.exp(), phi1(&fall) * age)
}

/// Stripes that pass within so much of a landing may do so before or after it.
const NEAR: f64 = 1e-13;
/// `‖e^{−Rn} e^{nG}‖ ≤ e^{−FADES·Rn}`, as `‖G‖ ≤ R²/8 (1 + R²/150)` and `R ≤ 2`.
const FADES: f64 = 0.74;
/// Where `|v̇| δt` is more than this part of `|v|`, a landing is not taken for a linear function of what is off.
const MOST_BENT: f64 = 0.01;

/// How far `w′` may be off `−κe^{−κs} − κ`, where `∫₀¹ y dt = ∫₀¹ w(s) q(s) ds` over a contact of one round trip: every
/// factor of [`weight_slope`] but κ itself bounds something that lies between it and its reciprocal.
pub(super) fn weight_rest(kappa: f64) -> f64 {
    weight_slope(kappa) - 2.0 * kappa
}

/// `|w′|` at most.
fn weight_slope(kappa: f64) -> f64 {
    kappa * (1.0 + (1.0 + kappa) * (1.0 + kappa * kappa.exp() + kappa * kappa) * (2.0 * kappa).exp())
}

impl Fixed {
    /// The error of `p` and `q`, but next to rays that are off.
    fn points(&self) -> f64 {
        self.point + self.scatter
    }

    /// What so many round trips scatter of the masses of displaced rays: a path crosses each twice in one, at the cost
    /// of a part κ of it each time, and all in all no more than `e^R` of it comes out.
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
        self.even += error;
        self.fixed.point += error;
        self.note();
    }

    /// What is too small to decide anything: what roundings and truncations make of `p` and `q`, and where flights are
    /// not taken apart also what displaced rays scatter.
    pub(super) fn noise(&self) -> f64 {
        (if self.apart { self.even } else { self.fixed.points() } - self.covered).max(0.0)
    }

    /// What nothing is decided by that is less: the error of `p` and `q` at the ground.
    pub(super) fn trace(&self) -> f64 {
        let Off { fixed, apart } = self.point();
        self.better(Off { fixed, apart: apart + self.worst.slope * self.events.late.bound() })
    }

    /// The same of `v(0,·)` up to `len` from now; in a flight that is taken apart `flown` has the ages and `h′` now and
    /// then. It is [`Self::end`] with the greatest that each of its terms is between these.
    pub(super) fn end_most(&self, flown: Option<[(f64, f64); 2]>, len: f64) -> f64 {
        let apart = flown.map(|[(from, before), (to, after)]| {
            let (start, (_, slowed)) = (self.flight.end_rate, aged(self.damping, to));
            let moves = (start + before).abs().max((start + after).abs());
            let followed =
                moves * self.events.late.bound() + slowed * self.events.rate.bound() + 2.0 * self.events.mass();
            followed + self.not_followed(to) + self.scattered(from, to)
        });
        let fixed = self.fixed.height + self.fixed.points() * len;
        apart.map_or(fixed, |apart| apart.min(fixed))
    }

    /// The two motions that an open decision leaves differ by no more than this in `p` and `q` from now on.
    pub(super) fn cover(&mut self, differ: f64) {
        self.add(differ);
        self.covered += differ;
        self.began.0 += differ;
        self.flight.known = None;
    }

    /// The error of `p` and `q`, but next to rays that are off; in contact at equal times since the landing.
    pub(super) fn point(&self) -> Off {
        let displaced = self.landing.map_or(0.0, |landing| landing.slope * self.events.late.bound());
        Off { fixed: self.fixed.points(), apart: self.loose() + displaced + self.events.between() }
    }

    /// The part of that which is not followed with signs.
    fn loose(&self) -> f64 {
        let Rest { wave, point, scatter, lumps, .. } = self.rest;
        self.even + point + lumps + scatter.min(2.0 * (wave + self.events.mass()))
    }

    /// The error of displacements in the clock of the vibration, at events, where the end is at height zero.
    fn beyond(&self) -> f64 {
        // ½e^R of an error of `p` and `q` is the most that displacements about the centre of mass are off by.
        2.0 * self.rest.wave + self.events.mass() + 4.0 * self.even
    }

    /// The error of `h′` in a flight that is taken apart, and at its ends.
    fn rate(&self) -> f64 {
        let since = (self.even - self.began.0).max(0.0);
        let loose = self.mean_of(self.even) + self.rest.mean;
        let known = self.flight.known.map(|known| known + self.mean_of(since));
        self.events.rate.bound() + known.map_or(loose, |known| known.min(loose))
    }

    /// What `h′ = ∫ e^{R(η−b)} q dη` is off by if `q` is off by so much.
    fn mean_of(&self, even: f64) -> f64 {
        phi1(&self.damping) * even
    }

    /// The errors at the last event, whenever that is; if it was a release, with the greatest slope of the vibration,
    /// its variation, and `z_tt` at the end.
    pub(super) fn at_event(&self, begins: Option<(f64, f64, f64)>) -> AtEvent {
        let late = self.events.late.bound();
        let (at, end_rate, near, slope, variation, bend) = match (begins, self.landing) {
            (None, Some(Landing { at, velocity, rate, off, slope, variation, bend, .. })) => {
                (at, velocity - rate, off.apart.max(NEAR), slope, variation, bend)
            }
            (begins, _) => {
                let (slope, variation, bend) = begins.unwrap_or_default();
                (self.flight.at, self.flight.end_rate, -1.0, slope, variation, bend)
            }
        };
        let (rate, grown) = (self.rate(), self.damping.exp());
        let rise = self.beyond() + 0.5 * variation * late;
        // h = −z(0,·), by the weight that makes the mean of z vanish.
        let rest = 0.5 * grown * (self.rest.wave + self.mean_of(self.even) + self.rest.mean + self.even);
        let centre = rise.min(self.events.ground_then(at, end_rate, near) + rest);
        let (loose, between) = (self.loose(), self.events.between() + slope * late);
        let end = loose + between.min(self.events.velocity_then(at, bend, begins.is_some()));
        AtEvent { rise, centre, speed: loose + between, end, rate, momentum: rate + 2.0 * self.damping * centre }
    }

    /// By how much the clock may be late: in contact that of the landing, in flight that of the vibration.
    pub(super) fn clock(&self, contact: bool) -> f64 {
        if contact { self.events.time() } else { self.events.clock.bound() }
    }

    /// The time of the last event, by the better of both accounts.
    pub(super) fn last(&self, off: Off) -> f64 {
        if self.apart { off.fixed.min(off.apart).min(self.events.time()) } else { off.fixed }
    }

    /// The error of `v(0,·)` in flight, up to `len` from now; in a flight that is taken apart `flown` is the age, `h′`
    /// and the place on the circle then.
    pub(super) fn end(&self, flown: Option<(f64, f64, f64)>, len: f64) -> Off {
        let apart = flown.map_or(0.0, |(age, rate, at)| {
            let (form, more) = self.flown((age, rate, at), 0.0);
            form.bound() + more
        });
        Off { fixed: self.fixed.height + self.fixed.points() * len, apart }
    }

    /// The same in the clock of the vibration: as a linear function of the sources, and what is not followed that way.
    fn flown(&self, (age, rate, at): (f64, f64, f64), near: f64) -> (Form, f64) {
        let (_, slowed) = aged(self.damping, age);
        let TakeOff { at: from, end_rate, .. } = self.flight;
        let fade = (-self.damping * age).exp();
        let (form, unclear) = self.events.height((-(end_rate + rate), slowed), (from, at), fade, near);
        (form, self.not_followed(age) + unclear + self.scattered(age, age))
    }

    /// What the rest adds to the error of `v(0,·)` at this age: by its centre of mass and its vibration, or, in a
    /// flight that is not leapt over, by what reaches the ground in each round trip.
    ///
    /// By `h′ = ∫ e^{R(η−b)} q dη` and `z(0,b) = −∫ w (q − h′) dη`, `|w| ≤ ½e^R`; or, as the ground receives at most
    /// `W/(1 − κ)` in each round trip, where what is left of `∫|q|` on its way down falls by `(1 − κ)|q(0,·)|`.
    fn not_followed(&self, age: f64) -> f64 {
        let ((even, Rest { wave, mean, .. }), grown) = (self.began, self.damping.exp());
        let (_, slowed) = aged(self.damping, age);
        let loose = self.mean_of(even) + mean;
        let rate = self.flight.known.map_or(loose, |known| known.min(loose));
        let apart = slowed * rate + grown * (1.0 + grown) * wave + 0.5 * grown * even;
        let left = 1.0 - 0.5 * self.damping;
        let passed = if age < LEAST_LEAP && left > 0.0 {
            grown * (even * age + wave * age.ceil() / left)
        } else {
            f64::INFINITY
        };
        apart.min(passed) + 0.5 * grown * self.even
    }

    /// What damping makes of stripes between these ages, besides letting them fade: no more than they are.
    ///
    /// A ray loses `1 − e^{−Rτ} ≤ Rτ` of its mass, a level R of the levels that it meets: at most `2Rτ`, whose mean is
    /// taken from them. Over long flights `Z = e^{Rt} z` has `Z_tt − Z_xx = R²Z`: a mass m makes `|Z| ≤ ½m`, so that
    /// `Z_t + Z_x` is off by `½R²τ m`, growing with itself, and `z_t + z_x` by `R|Z|` more at either end.
    fn scattered(&self, from: f64, age: f64) -> f64 {
        let left = (self.damping * (6.0 - FADES * from)).exp() + (-self.damping * from).exp();
        let turned = (0.5 * self.damping * self.damping * age).exp_m1() * (2.0 * self.damping).exp();
        self.events.mass() * left.min(2.0 * self.damping + turned).min(2.0 * self.damping * age)
    }

    /// What has been off since this was last asked.
    pub(super) fn since(&mut self) -> Uncertainty {
        let fixed = self.fixed.worst + self.fixed.rays;
        self.fixed.worst = self.fixed.points().max(self.fixed.height);
        let worst = std::mem::take(&mut self.worst);
        self.note();
        if self.apart && worst.rise.max(worst.speed) < fixed {
            return worst;
        }
        // What h′ of a flight that is taken apart owes to an error of `q` on the characteristic that it begins with.
        let rate = if self.apart { self.damping.exp() * fixed } else { fixed };
        Uncertainty { rise: fixed, speed: fixed, rate, late: 0.0, ..worst }
    }

    /// The time of an event, and the ray that it starts, may be off so far.
    pub(super) fn note_event(&mut self, off: Off) {
        self.fixed.worst = self.fixed.worst.max(off.fixed);
        self.rays = self.rays.max(self.better(off));
        self.worst.rays = self.rays;
    }

    /// The error of the height at the end of a piece of rest.
    pub(super) fn rest(&mut self, far: f64) {
        self.fixed.height += far;
        self.worst.rise = self.worst.rise.max(far);
        self.note();
    }

    /// A part of a round trip, in contact or in flight, with this error in each cell.
    pub(super) fn strip(&mut self, len: f64, cell: f64, contact: bool) {
        if !contact {
            self.fixed.height += self.fixed.points() * len;
        }
        self.even += 2.0 * cell;
        self.rest.scatter += 2.0 * self.damping * len * (self.rest.wave + self.events.mass());
        self.fixed.point += 2.0 * cell;
        self.fixed.turn(self.damping, len);
        // A jump of p fades along its ray like p_η = −κp, and η = 2t there.
        self.fixed.rays *= (-self.damping * len).exp();
        self.note();
    }

    /// The end has flown so far, with this error; at any other point `½∫|δp| + |δq| dx` is added.
    pub(super) fn note_end(&mut self, off: Off) {
        let beyond = self.even + self.rest.wave + 2.0 * self.events.mass();
        self.worst.rise = self.worst.rise.max(off.apart + beyond);
    }

    /// Velocities change no faster than this between rays, and neither they nor `c v_x` are greater than `most`, nor
    /// the invariants than `peak`, since the last event.
    pub(super) fn note_slope(&mut self, slope: f64, (most, peak): (f64, f64)) {
        self.worst.slope = self.worst.slope.max(slope);
        self.worst.most = self.worst.most.max(most);
        self.worst.peak = self.worst.peak.max(peak);
    }

    /// A ray that may be off passes the ground in flight, which takes its jump at the wrong time.
    pub(super) fn pass(&mut self, jump: f64, off: Off) {
        self.fixed.height += jump * off.fixed;
    }

    /// A leap, with this error of its own: what vibrates fades. `passing` is `Σ |jump| · time` of all rays, each time
    /// that they pass.
    ///
    /// `Z` moves by `e^{tG}`, `‖G‖ ≤ R²/8 (1 + R²/150)`; going over from and to the characteristic costs at most
    /// `e^{6R}`.
    pub(super) fn leap(&mut self, trips: f64, error: f64, passing: f64) {
        // The centre of mass fades by e^{−2R} in each round trip, and is at most e^R of all.
        let fade = ((2.0 + self.damping.exp()) * (self.damping * (6.0 - FADES * trips)).exp()).min(1.0);
        self.covered *= fade;
        self.even = self.even * fade + error;
        let Rest { wave, point, scatter, lumps, mean } = self.rest;
        self.rest = Rest {
            wave: wave * fade,
            point: point * fade,
            scatter: scatter * fade,
            lumps: lumps * fade,
            mean: mean * fade,
        };
        self.fixed.turn(self.damping, trips);
        self.fixed.height += trips * (self.fixed.points() + error + passing);
        self.fixed.point += error;
        self.fixed.rays *= (-self.damping * trips).exp();
        self.note();
    }

    /// The ground lets go, with this velocity.
    pub(super) fn let_go(&mut self, velocity: f64, off: Off, cell: f64) {
        self.displace(velocity, off.fixed);
        self.fixed.height = velocity * off.fixed + cell;
        self.note();
    }

    /// A ray that starts off: p goes over from −q to q or back.
    fn displace(&mut self, velocity: f64, fixed: f64) {
        self.fixed.rays += 2.0 * velocity * fixed;
        self.fixed.mass += 2.0 * velocity * fixed;
        self.fixed.turn(self.damping, 1.0);
    }

    /// The ground is hit. The part of the ray that is off has twice the mass of the error of the height.
    pub(super) fn hit(&mut self, velocity: f64, off: Off) {
        // Where the velocity is small, it grows by as much again while the end may touch.
        let (drop, height) = (velocity * off.fixed, self.fixed.height);
        self.displace(velocity, off.fixed);
        self.fixed.mass += if drop < height { 2.0 * height } else { 0.0 };
        self.fixed.height = 0.0;
        self.note();
    }

    /// Centre of mass and vibration are taken apart after a release.
    pub(super) fn take_off(&mut self, flight: TakeOff, rounding: f64) {
        let r = self.damping;
        self.even += rounding;
        self.fixed.point += rounding;
        let more = match self.landing.take() {
            Some(landing) if flight.whole => self.after_round_trip(&landing, &flight),
            Some(landing) => {
                self.after_contact(&landing, &flight);
                0.0
            }
            None => {
                self.events.add_late(flight.off);
                self.events.start_stripe(flight.at, flight.jump.1);
                4.0 * r.exp() * self.events.mass()
            }
        };
        self.events.add_rate(more);
        let (mass, level) = self.events.thin();
        self.rest.wave += 2.0 * mass;
        self.rest.lumps += mass;
        self.rest.point += level;
        self.began = (self.even, self.rest);
        self.flight = flight;
        self.note();
    }

    /// After a contact of one round trip, which the true motion makes as well: without damping and gravity it turns the
    /// vibration round whenever it begins. Gives the part of the new `δh′` that has no known sign.
    fn after_round_trip(&mut self, landing: &Landing, flight: &TakeOff) -> f64 {
        let r = self.damping;
        let kappa = 0.5 * r;
        let (late, rate, mass) = (self.events.late.bound(), self.events.rate.bound(), self.events.mass());
        // The ray of the landing comes back to the release with e^{−R} of its mass, and what it has lost is scattered.
        let scattered = r * (2.0 * landing.velocity.abs() * late + mass);
        let rigid = (5.0 * r).min(2.0) * rate;
        let new = scattered + rigid;
        // The rest turns round. What has mean zero before has a mean of order R after.
        let weights = (-r).exp_m1().abs() + weight_slope(kappa);
        let grown = (weights + 2.0 * r * r.exp()) * 2.0 * self.rest.wave;
        self.rest.mean = (self.rest.mean + grown).min(r.exp() * self.rest.wave);
        self.rest.wave += new;
        self.rest.point += new + scattered;
        // h′ + 2Rh changes by −2∫y, and h = −z(0,·) at both ends of the contact.
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

    /// After any other contact: what passes turns round.
    fn after_contact(&mut self, landing: &Landing, flight: &TakeOff) {
        let r = self.damping;
        let time = self.events.time();
        let (fade, faded) = ((-r * flight.len).exp(), r * flight.len);
        self.events.contact((landing.at, flight.len), (landing.velocity, landing.fall), fade);
        let (mass, level) = (self.events.mass(), self.events.level());
        // A path crosses a ray twice in a round trip, each time at the cost of κ of its mass.
        let most = (faded + r) * mass + faded * level;
        let Rest { point, scatter, .. } = self.rest;
        let unknown = flight.slope.map_or(0.0, |slope| (self.even + point + scatter + most) / slope.abs());
        let limits = (unknown + flight.rounding, flight.off + time);
        self.events.release((flight.at, flight.fall), flight.jump, flight.slope, limits);
        self.rest.wave += faded / fade * (mass + level);
        self.rest.mean = r.exp() * self.rest.wave;
        self.rest.point += most / fade;
    }

    /// The landing of a flight that is taken apart. From here on times count from it.
    pub(super) fn land(&mut self, landing: Landing) {
        let Landing { at, velocity, curvature, off, age, rate, fall, range, .. } = landing;
        let (speed, clock) = (velocity.abs(), self.events.clock.bound());
        let (kept, _) = aged(self.damping, age);
        let fade = (-self.damping * age).exp();
        let (form, more) = self.flown((age, rate, at), off.apart.max(NEAR));
        let scattered = self.scattered(age, age);
        let bent = curvature * off.apart / speed;
        let linear = bent <= MOST_BENT;
        // δt = −δv/v, in the clock of the vibration; more than that from what is not linear.
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
        // A vibration that has died out takes its clock from what the landing makes.
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

    /// The end may lie on the ground before a ray lets it go again: a ray of so much mass may start.
    pub(super) fn cover_hop(&mut self, mass: f64) {
        self.fixed.rays += mass;
        self.fixed.mass += mass;
        self.fixed.turn(self.damping, 1.0);
        self.rest.wave += mass;
        self.rest.lumps += mass;
    }

    /// Whether both accounts have lost the events.
    pub(super) fn lost(&self, off: Off) -> bool {
        off.fixed > MOST_LATE && (!self.apart || off.apart > MOST_LATE)
    }

    fn note(&mut self) {
        let (speed, late) = (self.point().apart, self.events.time().max(self.events.clock.bound()));
        let (mut rise, mut rate) = (self.beyond(), self.rate());
        if let Some(landing) = self.landing {
            // At equal times since the landing: v(x) = ∫ v_x, and h′ is a mean of `p` and `q`.
            rise += 0.5 * (rate + landing.variation * self.events.late.bound());
            rate = 2.0 * rise;
        }
        self.worst = self.worst.max(Uncertainty { rise, speed, rate, late, ..Uncertainty::default() });
        self.fixed.worst = self.fixed.worst.max(self.fixed.points()).max(self.fixed.height);
    }
}
