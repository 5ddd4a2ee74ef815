//! First-order dependence of a run on its earlier errors, for separated flights.
//!
//! Each error that an event adds is a source. Its effects on later events keep their signs, so that two effects of one
//! source cancel where they do in truth.
//!
//! Without damping the rod hands on `q` unchanged in flight and with the other sign in contact. So the error of the
//! vibration by its own clock is a constant between rays and a mass on each displaced ray: the stripe between its
//! computed and its true place. Damping changes this by the order `R`, which is counted as a bound.

use super::uncertainty::Off;

/// A linear function of the sources, each between −1 and 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Form(Vec<f64>);

impl Form {
    /// Bounds the absolute value.
    pub(super) fn bound(&self) -> f64 {
        self.0.iter().map(|x| x.abs()).sum()
    }

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

    fn depend(&mut self, source: usize, size: f64) {
        if self.0.len() <= source {
            self.0.resize(source + 1, 0.0);
        }
        self.0[source] += size;
    }
}

/// A displaced ray: the place on the circle of a round trip where it passes the ground, its mass, and the error of `q`
/// from it to the next ray, apart from the constant that makes the mean of all vanish.
#[derive(Clone, Debug)]
struct Stripe {
    at: f64,
    mass: Form,
    level: Form,
}

/// Linear dependence of the errors on the sources.
#[derive(Clone, Debug, Default)]
pub(super) struct Dependence {
    sources: usize,
    /// Delay of the clock by which the vibration is compared.
    pub(super) clock: Form,
    /// Delay of the last event by that clock.
    pub(super) late: Form,
    /// Error `δh′` at equal times since the last event.
    pub(super) rate: Form,
    /// Stripes, in order of their places.
    stripes: Vec<Stripe>,
}

/// The end of a contact and the beginning of a flight.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TakeOff {
    /// Place on the circle.
    pub(super) at: f64,
    /// Length of the contact.
    pub(super) len: f64,
    /// Whether the contact lasted a round trip, from the start of a ray to its return.
    pub(super) whole: bool,
    /// Bound of the time error, and the rounding of the time.
    pub(super) off: f64,
    pub(super) rounding: f64,
    /// Slope of the stress at its root, if the release is at a root.
    pub(super) slope: Option<f64>,
    /// Jump of `q` on the ray that arrives, and of `p` on the ray that starts.
    pub(super) jump: (f64, f64),
    /// `z_t(0,·)` of the vibration.
    pub(super) end_rate: f64,
    /// `h″`.
    pub(super) fall: f64,
}

/// The dependence of a landing on the flight before it, and of the contact after it on the landing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// Place on the circle.
    pub(super) at: f64,
    /// `v_t` of the end, its greatest rate of change, and the bound of the time error of the landing.
    pub(super) velocity: f64,
    pub(super) curvature: f64,
    pub(super) off: Off,
    /// Age of the flight, `h′`, and `h″`.
    pub(super) age: f64,
    pub(super) rate: f64,
    pub(super) fall: f64,
    /// Range of `q` of the vibration, its total variation, and its greatest slope between rays.
    pub(super) range: f64,
    pub(super) variation: f64,
    pub(super) slope: f64,
    /// `z_tt` of the end if no ray arrives; otherwise the greatest slope.
    pub(super) bend: f64,
    /// Change of `∫y` of a contact of one round trip with the phase of the vibration, and the bound of its error.
    pub(super) phase: (f64, f64),
}

/// Maximum numbers of stripes and of sources that are followed one by one.
const MOST_STRIPES: usize = 32;
const MOST_SOURCES: usize = 200;
/// Distance, in round trips, below which two rays count as one, and a ray may pass before or after an event.
pub(super) const SAME: f64 = 1e-13;

/// Computes the displacement that a unit mass brings to the ground, `x` round trips after it passed: mean-free.
fn sawtooth(x: f64) -> f64 {
    0.5 - (x - x.floor())
}

/// Computes the integral of [`sawtooth`].
fn arch(x: f64) -> f64 {
    let x = x - x.floor();
    0.5 * x * (1.0 - x)
}

fn distance(a: f64, b: f64) -> f64 {
    0.5 - sawtooth(a - b).abs()
}

impl Dependence {
    /// Bounds the delay of the last event.
    pub(super) fn time(&self) -> f64 {
        let mut time = self.clock.clone();
        time.add(1.0, &self.late);
        time.bound()
    }

    /// Bounds the sum of all masses, and adds the bound between rays.
    pub(super) fn mass(&self) -> f64 {
        let masses: f64 = self.stripes.iter().map(|stripe| stripe.mass.bound()).sum();
        masses + self.level()
    }

    /// Bounds the error between rays.
    pub(super) fn level(&self) -> f64 {
        self.stripes.iter().map(|stripe| stripe.level.bound()).fold(0.0, f64::max)
    }

    /// Returns each stripe with the place and the length of the interval after it.
    fn intervals(&self) -> impl Iterator<Item = (&Stripe, f64, f64)> {
        let count = self.stripes.len();
        self.stripes.iter().enumerate().map(move |(k, stripe)| {
            let next = self.stripes[(k + 1) % count].at;
            let len = if count == 1 { 1.0 } else { (next - stripe.at).rem_euclid(1.0) };
            (stripe, stripe.at, len)
        })
    }

    /// Computes the error of `v(0,·)` at the place `to` on the circle, in a flight that began at `from` and has faded
    /// by `fade`: the effects `by_time` of the last event's delay and `by_rate` of `δh′`, and those of the stripes. The
    /// second value bounds the masses of rays that pass within `near`.
    ///
    /// With `S(x) = ½ − frac x` and its integral `½ frac x (1 − frac x)`, a mass m at the place u and a level k from u
    /// to w bring the mean-free displacements `m S(s − u)` and `k (B(s − u) − B(s − w))` to the ground: Φ. At the age
    /// τ, `s = (1 − e^{−2Rτ})/2R`; ℓ is the delay of the last event and `v_U` the velocity of the end after it:
    ///
    /// ```text
    /// δv(0) = −(z_t(0,U) + h′) ℓ + s δh′ + Σ [e^{−Rτ} Φ(at L) − Φ(at U)]
    /// ```
    ///
    /// Damping leaves all but `e^{−Rτ}` of the masses on the rays; the scattered part is bounded separately.
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

    /// Computes the error of `z(0,·)` at a place on the circle by the clock of the vibration, from stripes and levels.
    fn ground(&self, place: f64) -> Form {
        let mut form = Form::default();
        for (stripe, at, len) in self.intervals() {
            // The stripe of a release at this place has already passed.
            form.add(if distance(at, place) < SAME { 0.5 } else { sawtooth(place - at) }, &stripe.mass);
            form.add(arch(place - at) - arch(place - at - len), &stripe.level);
        }
        form
    }

    /// Bounds the masses of rays that pass a place within `near`.
    fn passing(&self, place: f64, near: f64) -> f64 {
        let passing = self.stripes.iter().filter(|stripe| distance(stripe.at, place) <= near);
        passing.map(|stripe| stripe.mass.bound()).sum()
    }

    /// Bounds the error of `z(0,·)` at the last event, whatever its true time: at the place `at`, where it changes at
    /// `rate`.
    pub(super) fn ground_then(&self, at: f64, rate: f64, near: f64) -> f64 {
        let mut form = self.ground(at);
        form.add(rate, &self.late);
        form.bound() + self.passing(at, near)
    }

    /// Bounds the error of the velocity of the end at the last event, whatever its true time: at the place `at`, on the
    /// side of the flight, where `z_t` changes at the rate `bend`.
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

    /// Bounds the error of `q` between rays, the centre of mass included, by the clock of the vibration.
    pub(super) fn between(&self) -> f64 {
        let mut form = self.rate.clone();
        form.add(-1.0, &self.mean());
        form.bound() + self.level()
    }

    /// Follows a landing with the delay `late`, and `more` from a new source; `h″ = fall`, `δh′` keeps the part `kept`,
    /// and the vibration the part `fade`.
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

    /// Follows a contact of one round trip: `δh′` keeps the part `keeps`, gains `by_late` times the delay of the
    /// landing, and `by_mass` of each mass at the place where it passes. The whole vibration changes its sign.
    ///
    /// The contact begins and ends with one ray, in truth as well: without damping and gravity the motion after it does
    /// not show its time. Momentum: `h′ + 2Rh` changes by `−2∫ y dt`, `∫ y = ∫ w q ds`, `w = e^{−κs} + κ(1 − s) + …`
    /// from the series of `cell::diagonal`. Hence
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

    /// Follows any contact that lasts `len` from a landing at the place `at` with `velocity`, where `h″ = fall`: errors
    /// that pass the ground change their sign, and all fade by `fade`.
    ///
    /// At equal times `δh′ − h″ℓ′` less the mean of the vibration's error is one more level everywhere; the late
    /// landing leaves the mass `2v ℓ′`.
    pub(super) fn contact(&mut self, (at, len): (f64, f64), (velocity, fall): (f64, f64), fade: f64) {
        // The error `δh′` at equal times is a constant in `q`, and the vibration has no mean.
        let mut all = self.rate.clone();
        all.add(-fall, &self.late);
        all.add(-1.0, &self.mean());
        self.cut(at);
        self.cut(at + len);
        let turns = |place: f64| {
            let after = (place - at).rem_euclid(1.0);
            let after = if distance(place, at) < SAME { 1.0 } else { after };
            // An error that arrives at the release has not changed its sign.
            let passed = (len - after - SAME).ceil().max(0.0);
            if passed % 2.0 == 1.0 { -fade } else { fade }
        };
        let middles: Vec<f64> = self.intervals().map(|(_, from, len)| from + 0.5 * len).collect();
        for (stripe, middle) in self.stripes.iter_mut().zip(middles) {
            stripe.level.add(1.0, &all);
            stripe.level = stripe.level.times(turns(middle));
            stripe.mass = stripe.mass.times(turns(stripe.at));
        }
        // While only one of the two motions flies, p is q in one and −q in the other.
        let landing = self.cut(at);
        let late = self.late.times(2.0 * velocity * turns(at));
        self.stripes[landing].mass.add(1.0, &late);
    }

    /// Follows a release after [`Self::contact`] at the place `at`, where `h″ = fall` in flight: at a root of the
    /// stress with this slope, or at an arriving ray, on which `q` jumps by `jump.0`. On the ray that starts p jumps by
    /// `jump.1`. The release has the further delay `more`, and at most `most` in all.
    ///
    /// The delay at a ray is that of the ray by its mass, `−m/(v_U − y(U⁻))`; at a root, the level there over the
    /// slope. The ray that starts has the mass `−(v_U + y(U⁻)) ℓ`, and `δh′` is the mean of all.
    pub(super) fn release(
        &mut self,
        (at, fall): (f64, f64),
        jump: (f64, f64),
        slope: Option<f64>,
        (more, most): (f64, f64),
    ) {
        // A new source may renumber the coefficients of all forms.
        let (source, k) = (self.source(), self.cut(at));
        let before = (k + self.stripes.len() - 1) % self.stripes.len();
        let mut late = match slope {
            // The stress that brings the root has changed its sign.
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

    /// Computes the mean of all masses and levels, which the vibration has to lose for a mean of zero.
    fn mean(&self) -> Form {
        let mut mean = Form::default();
        for (stripe, _, len) in self.intervals() {
            mean.add(1.0, &stripe.mass);
            mean.add(len, &stripe.level);
        }
        mean
    }

    /// Returns the index of the ray at a place, and inserts one if there is none.
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

    /// Compares the vibration from now on at equal times since the last event.
    pub(super) fn reset_clock(&mut self) {
        self.clock.add(1.0, &self.late);
        self.late = Form::default();
    }

    /// Adds a source of `δh′`.
    pub(super) fn add_rate(&mut self, size: f64) {
        let source = self.source();
        self.rate.depend(source, size);
    }

    /// Adds a source of the time of a release before which nothing was followed: `δh′ = h″ ℓ`, with `h″ = fall`.
    pub(super) fn release_late(&mut self, size: f64, fall: f64) {
        let source = self.source();
        self.late.depend(source, size);
        self.rate.add(fall, &self.late);
    }

    /// Starts a ray at the place `at` with the last event, on which p jumps by `jump`.
    pub(super) fn start_stripe(&mut self, at: f64, jump: f64) {
        let mass = self.late.times(-jump);
        let k = self.cut(at);
        self.stripes[k].mass.add(1.0, &mass);
    }

    /// Removes all stripes if there are too many, and returns the bounds [`Self::mass`] and [`Self::level`] of them.
    pub(super) fn thin(&mut self) -> (f64, f64) {
        if self.stripes.len() <= MOST_STRIPES {
            return (0.0, 0.0);
        }
        let given_up = (self.mass(), self.level());
        self.stripes.clear();
        given_up
    }

    /// Adds a source. If there are too many, merges the older half of those of each quantity into one.
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
