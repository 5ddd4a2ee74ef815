//! What the numbers of a run may be off by: one sum, to which every step adds its own term.
//!
//! Derivations in `docs/bounds.md`. Dimensionless: velocities in `V`, times in `t₁`. There are two accounts, and the
//! better one holds. One compares with the true motion at equal times: short where flights are. The other, where
//! flights are taken apart, compares at equal times since the last landing, and keeps apart by how much that landing
//! may be early or late: a long flight displaces all that follows in time, but changes little of it.

/// By how much a time may be off: in itself, and counted from the last landing.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Off {
    pub(super) fixed: f64,
    pub(super) moving: f64,
}

impl Off {
    /// The greater in both.
    pub(super) fn max(self, other: Off) -> Off {
        Off { fixed: self.fixed.max(other.fixed), moving: self.moving.max(other.moving) }
    }
}

/// The account at equal times.
#[derive(Clone, Copy, Debug, Default)]
struct Fixed {
    /// Of `p` and `q`, but next to rays that are off.
    point: f64,
    /// `Σ |jump| · time` of rays that are off, fading as the jumps do; and the most it was.
    rays: f64,
    most_rays: f64,
    /// Of `v(0,b)`.
    height: f64,
    /// The most that `point`, `height` and the times of events were.
    worst: f64,
}

/// The errors that the state carries.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Budget {
    /// Of `p` and `q`, by truncation and rounding.
    even: f64,
    /// The range of `∫δq` along a characteristic, by a motion that is displaced in time: twice the error of
    /// displacements.
    wave: f64,
    /// Of `p` and `q` between rays, by the same.
    point: f64,
    /// Of `p` and `q`, by what damping scatters from displaced rays.
    scatter: f64,
    /// Of `v(0,·)` in flight by the vibration, now and at the beginning; and of `h′` then, or when the contact began.
    centre: (f64, f64),
    /// By how much the last landing may be early or late.
    pub(super) late: f64,
    /// The most that any of them was.
    worst: f64,
    fixed: Fixed,
}

/// How a landing depends on the flight before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// `|v_t|` of the end, and how far the time of the landing may be off in all.
    pub(super) speed: f64,
    pub(super) off: Off,
    /// `e^{−2Rτ}` and `(1 − e^{−2Rτ})/2R` at the age τ, and `h″`.
    pub(super) kept: f64,
    pub(super) slowed: f64,
    pub(super) fall: f64,
    /// The range of `q` of the vibration, and its greatest slope between rays.
    pub(super) range: f64,
    pub(super) slope: f64,
}

impl Budget {
    /// Adds an error of `p` and `q`.
    pub(super) fn add(&mut self, error: f64) {
        self.even += error;
        self.fixed.point += error;
        self.note();
    }

    /// What is too small to decide anything: what roundings and truncations make of `p` and `q`, and where flights are
    /// not taken apart also what displaced rays scatter.
    pub(super) fn noise(&self, apart: bool) -> f64 {
        if apart { self.even } else { self.fixed.point }
    }

    /// The error of `p` and `q`, but next to rays that are off.
    pub(super) fn point(&self) -> Off {
        Off { fixed: self.fixed.point, moving: self.even + self.point + self.scatter.min(2.0 * self.wave) }
    }

    /// The error of `v(0,·)` in flight, up to `len` from now; `slowed = (1 − e^{−2Rτ})/2R` of the flight that is taken
    /// apart.
    pub(super) fn end(&self, damping: f64, slowed: f64, len: f64) -> Off {
        Off {
            fixed: self.fixed.height + self.fixed.point * len,
            moving: self.centre.0 + slowed * self.centre.1 + 0.5 * damping.exp() * self.even,
        }
    }

    /// The error of all of the run relative to its units, of a run whose flights are taken apart or are not.
    pub(super) fn total(&self, apart: bool) -> f64 {
        let fixed = self.fixed.worst + self.fixed.most_rays;
        if apart { fixed.min(self.worst) } else { fixed }
    }

    /// The better of both accounts of the time of an event.
    pub(super) fn time(&mut self, off: Off, apart: bool) -> f64 {
        let moving = self.late + off.moving;
        self.fixed.worst = self.fixed.worst.max(off.fixed);
        self.worst = self.worst.max(moving);
        if apart { off.fixed.min(moving) } else { off.fixed }
    }

    /// The error of the height at the end of a piece of rest.
    pub(super) fn rest(&mut self, far: f64) {
        self.fixed.height += far;
        self.worst = self.worst.max(far);
        self.note();
    }

    /// A part of a round trip, in contact or in flight, with this error in each cell.
    pub(super) fn strip(&mut self, damping: f64, len: f64, cell: f64, contact: bool) {
        if !contact {
            self.fixed.height += self.fixed.point * len;
        }
        self.even += 2.0 * cell;
        self.scatter += 2.0 * damping * len * self.wave;
        self.fixed.point += 2.0 * cell;
        // A jump of p fades along its ray like p_η = −κp, and η = 2t there.
        self.fixed.rays *= (-damping * len).exp();
        self.note();
    }

    /// A ray that may be off passes the ground in flight, which takes its jump at the wrong time.
    pub(super) fn pass(&mut self, jump: f64, off: Off) {
        self.fixed.height += jump * off.fixed;
    }

    /// A leap, with this error of its own: what vibrates fades. `passing` is `Σ |jump| · time` of all rays, each time
    /// that they pass.
    pub(super) fn leap(&mut self, damping: f64, trips: f64, error: f64, passing: f64) {
        let fade = (damping * (6.0 - 0.75 * trips)).exp().min(1.0);
        self.even = self.even * fade + error;
        self.wave *= fade;
        self.point *= fade;
        self.scatter *= fade;
        self.fixed.height += trips * (self.fixed.point + error + passing);
        self.fixed.point += error;
        self.fixed.rays *= (-damping * trips).exp();
        self.note();
    }

    /// The ground lets go, with this velocity.
    pub(super) fn let_go(&mut self, velocity: f64, off: Off, cell: f64) {
        self.wave += 2.0 * (velocity + 2.0 * self.point().moving) * off.moving;
        self.displace(velocity, off.fixed);
        self.fixed.height = velocity * off.fixed + cell;
        self.note();
    }

    /// A ray that starts off: p goes over from −q to q or back.
    fn displace(&mut self, velocity: f64, fixed: f64) {
        self.fixed.rays += 2.0 * velocity * fixed;
        self.fixed.most_rays = self.fixed.most_rays.max(self.fixed.rays);
    }

    /// The ground is hit. The part of the ray that is off has twice the mass of the error of the height, and scatters
    /// at rate κ.
    pub(super) fn hit(&mut self, damping: f64, velocity: f64, off: Off) {
        self.displace(velocity, off.fixed);
        self.fixed.point += 2.0 * damping * self.fixed.height;
        self.fixed.height = 0.0;
        self.note();
    }

    /// Centre of mass and vibration are taken apart, after a contact of one round trip if `whole`.
    pub(super) fn take_off(&mut self, damping: f64, whole: bool, rounding: f64) {
        let (r, kappa) = (damping, 0.5 * damping);
        self.even += rounding;
        self.fixed.point += rounding;
        let weights = kappa * (1.0 + (1.0 + kappa) * (1.0 + kappa * kappa.exp() + kappa * kappa) * (2.0 * kappa).exp());
        let kept = ((-0.5 * r).exp() * (1.0 + r * r * (r * r).exp())).max(1.0);
        let before = self.wave;
        let from_wave = if whole {
            self.wave = kept * (before + self.centre.1);
            2.0 * (-(-r).exp_m1() + weights)
        } else {
            self.wave = 3.0 * kept * (before + self.centre.1);
            4.0 * r.exp()
        };
        let rest = 2.0 * r * r.exp() * (before + self.wave + self.even);
        self.centre.1 += from_wave * before + rest + 2.0 * r.exp() * self.even;
        self.wave += self.centre.1;
        self.centre.0 = (4.0 * r).exp() * self.wave + 0.5 * r.exp() * self.even;
        self.note();
    }

    /// The landing of a flight that is taken apart. From here on times count from it.
    pub(super) fn land(&mut self, landing: &Landing) {
        let Landing { speed, off, kept, slowed, fall, range, slope } = *landing;
        let time_error = off.moving;
        let by_rate = slowed * self.centre.1 / speed;
        // What h′ makes of itself: the end comes later, and falls faster for it.
        let own = (kept + fall * slowed / speed).abs() * self.centre.1;
        let others = fall.abs() * (time_error - by_rate).max(0.0);
        self.centre.1 = (own + others).min(kept * self.centre.1 + fall.abs() * time_error);
        self.wave += range * time_error;
        self.point += slope * time_error;
        self.late += time_error;
        self.note();
    }

    /// The better of both accounts of a time that is counted from the last landing.
    pub(super) fn better(&self, off: Off, apart: bool) -> f64 {
        if apart { off.fixed.min(off.moving) } else { off.fixed }
    }

    /// Whether both accounts have lost the events.
    pub(super) fn lost(&self, off: Off, apart: bool, most: f64) -> bool {
        off.fixed > most && (!apart || self.late + off.moving > most)
    }

    /// Keeps the greatest.
    fn note(&mut self) {
        let now = self.point().moving + self.wave;
        self.worst = self.worst.max(now).max(self.late).max(self.centre.0).max(self.centre.1);
        self.fixed.worst = self.fixed.worst.max(self.fixed.point).max(self.fixed.height);
    }
}
