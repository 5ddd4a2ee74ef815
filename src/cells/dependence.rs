//! How a run depends, to first order, on what it was off by before, where flights are taken apart.
//!
//! Each error that an event adds is a source. What later events make of it keeps its sign, so that what one source does
//! in two ways cancels where it does in truth.
//!
//! Without damping the rod hands on `q` unchanged in flight and with the other sign in contact, so the error of the
//! vibration in its own clock is constant between rays, and a mass on each ray that is off in time: the stripe between
//! where it is and where it should be. What damping changes of that is of the order `R`, and counted as a bound.

use super::uncertainty::Off;

/// A linear function of the sources, each between −1 and 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Form(Vec<f64>);

impl Form {
    /// The most that it can be.
    pub(super) fn bound(&self) -> f64 {
        self.0.iter().map(|x| x.abs()).sum()
    }

    /// Adds a multiple of another.
    pub(super) fn add(&mut self, factor: f64, other: &Form) {
        if self.0.len() < other.0.len() {
            self.0.resize(other.0.len(), 0.0);
        }
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x += factor * y;
        }
    }

    fn times(&self, factor: f64) -> Form {
        Form(self.0.iter().map(|x| factor * x).collect())
    }

    /// Adds to the coefficient of a source.
    fn depend(&mut self, source: usize, size: f64) {
        if self.0.len() <= source {
            self.0.resize(source + 1, 0.0);
        }
        self.0[source] += size;
    }
}

/// A ray on its way: where on the circle of a round trip it passes the ground, its mass, and the error of `q` from it
/// to the next, besides what makes the mean of all vanish.
#[derive(Clone, Debug)]
struct Stripe {
    at: f64,
    mass: Form,
    level: Form,
}

/// What depends on the sources.
#[derive(Clone, Debug, Default)]
pub(super) struct Dependence {
    sources: usize,
    /// By how much the clock that the vibration is compared in is late.
    pub(super) clock: Form,
    /// By how much the last event is late in that clock.
    pub(super) late: Form,
    /// `δh′` at equal times since.
    pub(super) rate: Form,
    /// By their places.
    stripes: Vec<Stripe>,
}

/// How a contact ends and a flight begins.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TakeOff {
    /// Where on the circle.
    pub(super) at: f64,
    /// How long the contact was.
    pub(super) len: f64,
    /// Whether that was a round trip, as between one ray's start and return.
    pub(super) whole: bool,
    /// How far the time may be off, and what it is rounded by.
    pub(super) off: f64,
    pub(super) rounding: f64,
    /// The slope of the stress, where it has a root.
    pub(super) slope: Option<f64>,
    /// The jump of `q` on the ray that arrives, and that of `p` on the ray that starts.
    pub(super) jump: (f64, f64),
    /// `z_t(0,·)` of the vibration.
    pub(super) end_rate: f64,
    /// `h″`.
    pub(super) fall: f64,
    /// What `h′` is off by, where it is known otherwise.
    pub(super) known: Option<f64>,
}

/// How a landing depends on the flight before it, and the contact after it on the landing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// Where on the circle.
    pub(super) at: f64,
    /// `v_t` of the end, its greatest rate of change, and how far the time of the landing may be off in all.
    pub(super) velocity: f64,
    pub(super) curvature: f64,
    pub(super) off: Off,
    /// The age of the flight, `h′`, and `h″`.
    pub(super) age: f64,
    pub(super) rate: f64,
    pub(super) fall: f64,
    /// The range of `q` of the vibration, its total variation, and its greatest slope between rays.
    pub(super) range: f64,
    pub(super) variation: f64,
    pub(super) slope: f64,
    /// `z_tt` of the end, where no ray arrives; otherwise the greatest slope.
    pub(super) bend: f64,
    /// By how much `∫y` of a contact of one round trip changes with the phase of the vibration, and how far that may be
    /// off.
    pub(super) phase: (f64, f64),
}

/// So many stripes and sources are followed one by one.
const MOST_STRIPES: usize = 32;
const MOST_SOURCES: usize = 200;
/// Rays are one where they are so close.
const SAME: f64 = 1e-13;

/// What a mass brings to the ground, in displacements, a part `x` of a round trip after it passed: mean-free.
fn sawtooth(x: f64) -> f64 {
    0.5 - (x - x.floor())
}

/// Its integral.
fn arch(x: f64) -> f64 {
    let x = x - x.floor();
    0.5 * x * (1.0 - x)
}

fn distance(a: f64, b: f64) -> f64 {
    0.5 - sawtooth(a - b).abs()
}

impl Dependence {
    /// At most so much is the last event late.
    pub(super) fn time(&self) -> f64 {
        let mut time = self.clock.clone();
        time.add(1.0, &self.late);
        time.bound()
    }

    /// At most so much are all masses, and what is between them, in all.
    pub(super) fn mass(&self) -> f64 {
        let masses: f64 = self.stripes.iter().map(|stripe| stripe.mass.bound()).sum();
        masses + self.level()
    }

    /// At most so much is between the rays.
    pub(super) fn level(&self) -> f64 {
        self.stripes.iter().map(|stripe| stripe.level.bound()).fold(0.0, f64::max)
    }

    /// The places at which the interval after each ray begins and ends.
    fn intervals(&self) -> impl Iterator<Item = (&Stripe, f64, f64)> {
        let count = self.stripes.len();
        self.stripes.iter().enumerate().map(move |(k, stripe)| {
            let next = self.stripes[(k + 1) % count].at;
            let len = if count == 1 { 1.0 } else { (next - stripe.at).rem_euclid(1.0) };
            (stripe, stripe.at, len)
        })
    }

    /// The error of `v(0,·)` at the place `to` on the circle, in a flight that began at `from` and has let the
    /// vibration fade by `fade`: so much by the time of the last event and by `δh′`, and what the stripes bring.
    /// Besides, what rays may add that pass within `near`.
    ///
    /// With `S(x) = ½ − frac x` and its integral `½ frac x (1 − frac x)`, a mass m at the place u and a level k from u
    /// to w bring the mean-free displacements `m S(s − u)` and `k (B(s − u) − B(s − w))` to the ground: Φ. At the age
    /// τ, `s = (1 − e^{−2Rτ})/2R`, where ℓ is how late the last event is and `v_U` the velocity of the end after it,
    ///
    /// ```text
    /// δv(0) = −(z_t(0,U) + h′) ℓ + s δh′ + Σ [e^{−Rτ} Φ(at L) − Φ(at U)]
    /// ```
    ///
    /// Damping leaves all but `e^{−Rτ}` of the masses on the rays; what it scatters of them is a bound.
    pub(super) fn height(
        &self,
        (by_time, by_rate): (f64, f64),
        (from, to): (f64, f64),
        fade: f64,
        near: f64,
    ) -> (Form, f64) {
        let mut form = Form::default();
        form.add(by_time, &self.late);
        form.add(by_rate, &self.rate);
        form.add(fade, &self.ground(to));
        form.add(-1.0, &self.ground(from));
        (form, self.passing(to, near))
    }

    /// The error of `z(0,·)` at a place on the circle, in the clock of the vibration: what stripes and levels bring.
    fn ground(&self, place: f64) -> Form {
        let mut form = Form::default();
        for (stripe, at, len) in self.intervals() {
            // The stripe of a release at this place has been passed.
            form.add(if distance(at, place) < SAME { 0.5 } else { sawtooth(place - at) }, &stripe.mass);
            form.add(arch(place - at) - arch(place - at - len), &stripe.level);
        }
        form
    }

    /// The masses of rays that pass a place within `near`.
    fn passing(&self, place: f64, near: f64) -> f64 {
        let passing = self.stripes.iter().filter(|stripe| distance(stripe.at, place) <= near);
        passing.map(|stripe| stripe.mass.bound()).sum()
    }

    /// At most so much is `z(0,·)` off at the last event, whenever that is: at the place `at`, where it changes at
    /// `rate`.
    pub(super) fn ground_then(&self, at: f64, rate: f64, near: f64) -> f64 {
        let mut form = self.ground(at);
        form.add(rate, &self.late);
        form.bound() + self.passing(at, near)
    }

    /// At most so much is the velocity of the end off at the last event, whenever that is: at the place `at`, on the
    /// side of it where the flight is, where `z_t` changes at the rate `bend`.
    pub(super) fn velocity_then(&self, at: f64, bend: f64, after: bool) -> f64 {
        let mut form = self.rate.clone();
        form.add(-1.0, &self.mean());
        form.add(bend, &self.late);
        let beside = self.intervals().find(|(_, from, len)| {
            let part = (at - from).rem_euclid(1.0);
            if distance(at, *from) < SAME { after } else { part < *len || !after && part <= *len + SAME }
        });
        if let Some((stripe, ..)) = beside {
            form.add(1.0, &stripe.level);
        }
        form.bound()
    }

    /// At most so much is `q` off between rays, the centre of mass included, in the clock of the vibration.
    pub(super) fn between(&self) -> f64 {
        let mut form = self.rate.clone();
        form.add(-1.0, &self.mean());
        form.bound() + self.level()
    }

    /// A landing, late by `late` and by `more` from a new source; `h″ = fall`, and of `δh′` is kept `kept`, of the
    /// vibration `fade`.
    ///
    /// `ℓ′ = −δv(0)/v` and `δh′ = e^{−2Rτ} δh′(0) + h″ (ℓ′ − ℓ)`, as long as `|v̇| δt ≤ |v|/100`; the rest is a new
    /// source.
    pub(super) fn land(&mut self, (late, more): (Form, f64), (kept, fall): (f64, f64), fade: f64) {
        self.rate = self.rate.times(kept);
        self.rate.add(-fall, &self.late);
        self.late = late;
        let source = self.source();
        self.late.depend(source, more);
        self.rate.add(fall, &self.late);
        self.scale_stripes(fade);
    }

    fn scale_stripes(&mut self, factor: f64) {
        for stripe in &mut self.stripes {
            stripe.mass = stripe.mass.times(factor);
            stripe.level = stripe.level.times(factor);
        }
    }

    /// A contact of one round trip: `δh′` keeps so much of itself, gains so much by the time of the landing, and
    /// `by_mass` of each mass by the place where it passes. All of the vibration turns round.
    ///
    /// It begins and ends with one ray, in truth as well: without damping and gravity nothing tells when it was.
    /// Momentum: `h′ + 2Rh` changes by `−2∫ y dt`, `∫ y = ∫ w q ds`, `w = e^{−κs} + κ(1 − s) + …` from the series of
    /// `cell::diagonal`. Hence
    ///
    /// ```text
    /// δh′ ← (1 − 2∫ w e^{−Rs} ds) δh′ + (2R (z_t(0,U) − z_t(0,L)) − 2∫ w dq) ℓ′
    ///       − 2 Σ m_j (w(s_j) − e^{Rs_j} ∫ w e^{−Rs} ds)
    /// ```
    ///
    /// and the mass of the ray that starts is `−ℓ′ (v_U + y(U⁻))`: the late landing and the late release together,
    /// since the ray of the landing comes back to the release.
    pub(super) fn round_trip(&mut self, (keeps, by_late): (f64, f64), fade: f64, by_mass: impl Fn(f64) -> f64) {
        let mut rate = self.rate.times(keeps);
        rate.add(by_late, &self.late);
        for (stripe, at, len) in self.intervals() {
            rate.add(by_mass(at), &stripe.mass);
            rate.add(by_mass(at + 0.5 * len) * len, &stripe.level);
        }
        self.rate = rate;
        self.scale_stripes(-fade);
    }

    /// Any contact that lasts `len` from a landing at the place `at` with `velocity`, where `h″ = fall`: what passes
    /// the ground turns round, and all fades by `fade`.
    ///
    /// At equal times `δh′ − h″ℓ′` less the mean of the vibration's error is one more level everywhere; the late
    /// landing leaves the mass `2v ℓ′`.
    pub(super) fn contact(&mut self, (at, len): (f64, f64), (velocity, fall): (f64, f64), fade: f64) {
        // At equal times `δh′` is a constant of `q`, and the vibration is what has no mean.
        let mut all = self.rate.clone();
        all.add(-fall, &self.late);
        all.add(-1.0, &self.mean());
        self.cut(at);
        self.cut(at + len);
        let turns = |place: f64| {
            let after = (place - at).rem_euclid(1.0);
            let after = if distance(place, at) < SAME { 1.0 } else { after };
            // What arrives at the release has not turned.
            let passed = (len - after - SAME).ceil().max(0.0);
            if passed % 2.0 == 1.0 { -fade } else { fade }
        };
        let middles: Vec<f64> = self.intervals().map(|(_, from, len)| from + 0.5 * len).collect();
        for (stripe, middle) in self.stripes.iter_mut().zip(middles) {
            stripe.level.add(1.0, &all);
            stripe.level = stripe.level.times(turns(middle));
            stripe.mass = stripe.mass.times(turns(stripe.at));
        }
        // Where the true end still flies, or lies already, p is q and not −q.
        let landing = self.cut(at);
        let late = self.late.times(2.0 * velocity * turns(at));
        self.stripes[landing].mass.add(1.0, &late);
    }

    /// A release after [`Self::contact`] at the place `at`, where `h″ = fall` in flight: at a root of the stress with
    /// this slope, or where a ray arrives, on which `q` jumps by `jump.0`. On the ray that starts p jumps by `jump.1`.
    /// The release is late by `more` besides, and by no more than `most` in all.
    ///
    /// At a ray it is as late as the ray is by its mass, `−m/(v_U − y(U⁻))`; at a root, the level there over the slope.
    /// The ray that starts has the mass `−(v_U + y(U⁻)) ℓ`, and `δh′` is the mean of all.
    pub(super) fn release(
        &mut self,
        (at, fall): (f64, f64),
        jump: (f64, f64),
        slope: Option<f64>,
        (more, most): (f64, f64),
    ) {
        // A new source may put the coefficients of all forms in other places.
        let (source, k) = (self.source(), self.cut(at));
        let before = (k + self.stripes.len() - 1) % self.stripes.len();
        let mut late = match slope {
            // The stress that brings the root has turned round.
            Some(slope) => self.stripes[before].level.times(1.0 / slope),
            None => self.stripes[k].mass.times(-1.0 / jump.0),
        };
        if late.bound() + more <= most {
            late.depend(source, more);
        } else {
            late = Form::default();
            late.depend(source, most);
        }
        self.stripes[k].mass = late.times(-jump.1);
        self.late = late;
        self.rate = self.mean();
        self.rate.add(fall, &self.late);
    }

    /// What the vibration lacks to have the mean zero.
    fn mean(&self) -> Form {
        let mut mean = Form::default();
        for (stripe, _, len) in self.intervals() {
            mean.add(1.0, &stripe.mass);
            mean.add(len, &stripe.level);
        }
        mean
    }

    /// The index of the ray at a place, which is put there if there is none.
    fn cut(&mut self, at: f64) -> usize {
        let at = at.rem_euclid(1.0);
        if let Some(k) = self.stripes.iter().position(|stripe| distance(stripe.at, at) < SAME) {
            return k;
        }
        let k = self.stripes.partition_point(|stripe| stripe.at < at);
        let count = self.stripes.len();
        let level = if count == 0 { Form::default() } else { self.stripes[(k + count - 1) % count].level.clone() };
        self.stripes.insert(k, Stripe { at, mass: Form::default(), level });
        k
    }

    /// The vibration is compared from here on at equal times since the last event.
    pub(super) fn reset_clock(&mut self) {
        self.clock.add(1.0, &self.late);
        self.late = Form::default();
    }

    /// Another source of `δh′`.
    pub(super) fn add_rate(&mut self, size: f64) {
        let source = self.source();
        self.rate.depend(source, size);
    }

    /// Another source of the time of the last event.
    pub(super) fn add_late(&mut self, size: f64) {
        let source = self.source();
        self.late.depend(source, size);
    }

    /// A ray starts at the place `at` with the last event, on which p jumps by `jump`.
    pub(super) fn start_stripe(&mut self, at: f64, jump: f64) {
        let mass = self.late.times(-jump);
        let k = self.cut(at);
        self.stripes[k].mass.add(1.0, &mass);
    }

    /// Gives up stripes where there are too many: at most so much were all of them, and what is between them.
    pub(super) fn thin(&mut self) -> (f64, f64) {
        if self.stripes.len() <= MOST_STRIPES {
            return (0.0, 0.0);
        }
        let given_up = (self.mass(), self.level());
        self.stripes.clear();
        given_up
    }

    /// A new source. Where there are too many, the older half of those of each quantity become one.
    fn source(&mut self) -> usize {
        if self.sources >= MOST_SOURCES {
            let half = self.sources / 2;
            let forms = [&mut self.clock, &mut self.late, &mut self.rate].into_iter();
            let stripes = self.stripes.iter_mut().flat_map(|stripe| [&mut stripe.mass, &mut stripe.level]);
            let mut count = self.sources - half;
            for form in forms.chain(stripes) {
                let old: f64 = form.0.iter().take(half).map(|x| x.abs()).sum();
                form.0.drain(..half.min(form.0.len()));
                if old > 0.0 {
                    form.depend(count, old);
                    count += 1;
                }
            }
            self.sources = count;
        }
        self.sources += 1;
        self.sources - 1
    }
}
