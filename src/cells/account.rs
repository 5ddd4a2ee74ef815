//! The account of a proof: what a run adds up as it goes on.

use super::cell::Cell;
use super::defect::Steps;
use super::march::{Medium, State};
use super::series::Basis;
use super::uncertainty::Uncertainty;
use crate::reason::Near;
use crate::special::RoundedSpecial;

/// Sums of doubles are enlarged by so much for their own roundings.
pub(super) const SLACK: f64 = 1e-9;

/// What is open: of what kind, and by how much velocities may differ from then on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub(super) what: Near,
    pub(super) differ: f64,
}

/// How fast a motion changes: bounds of `|p_t|` and `|q_t|` between rays, and of the sum of the jumps at rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) between: f64,
    pub(super) jumps: f64,
}

/// A release that the first strip of its flight has yet to show.
#[derive(Clone, Debug)]
pub(super) struct Release<S> {
    /// Pieces before the strip that ends with it.
    pub(super) pieces: usize,
    /// The stress there, where it is at a ray.
    pub(super) left: Option<f64>,
    /// How far the time may be off as far as the stress says, and how steep the stress is there.
    pub(super) late: f64,
    pub(super) steep: f64,
    /// How far the ray is off that lets it go, by no clock.
    pub(super) ray: f64,
    pub(super) at: S,
}

/// The account of a run.
#[derive(Clone, Debug)]
pub(super) struct Proof<S> {
    pub(super) steps: Steps,
    pub(super) doubles: Basis<f64>,
    pub(super) even: f64,
    pub(super) masses: f64,
    /// Θ: how far the clock of the true motion may have been set since the start.
    pub(super) clock: f64,
    /// The most that a ray so far is off by that clock, less Θ.
    pub(super) late: f64,
    /// The fastest change of `p` and `q` between rays so far, the sum of their jumps, and the greatest `|q|`.
    pub(super) slope: f64,
    pub(super) jumps: f64,
    pub(super) most: f64,
    /// Where events have started rays, and how far those are off: by the clock, less Θ, and by none.
    pub(super) rays: Vec<(S, [f64; 2])>,
    /// When the last event was.
    pub(super) since: f64,
    /// E when centre of mass and vibration were taken apart.
    pub(super) began: f64,
    /// What `h′` and `z(0)` of this flight are off by as means of the stored `q`: at its beginning, and now.
    pub(super) means: [f64; 2],
    /// E when `z(0)` was last such a mean, and what has been summed up since.
    pub(super) weighed: f64,
    pub(super) trip: f64,
    /// What the heights that this flight has summed up are off by, where it is not taken apart.
    pub(super) summed: f64,
    /// The mass that the last release has left.
    pub(super) left: f64,
    /// The most that `v(0,·)` of the last flight was off by.
    pub(super) height: f64,
    /// The most that a leap has been off by.
    pub(super) leapt: f64,
    /// Whether the end has only risen since its release, and is not clear of the ground.
    pub(super) rising: bool,
    pub(super) release: Option<Release<S>>,
    /// How far the landing is off that has just been shown: see `events`.
    pub(super) landed: Option<[f64; 2]>,
    /// How far the events are off: by no clock, and by the one that holds then.
    pub(super) events: Vec<[f64; 2]>,
    /// How far values may be off before the first event, and after each.
    pub(super) known: Vec<Uncertainty>,
    /// What is open, and how many pieces are shown.
    pub(super) open: Option<(usize, Open)>,
}

impl<S: RoundedSpecial> Proof<S> {
    pub(super) fn new(medium: &Medium<S>) -> Self {
        let steps = Steps::of(medium);
        Proof {
            doubles: Basis::new(&1.0, medium.basis.size(), 1),
            steps,
            even: 0.0,
            masses: 0.0,
            clock: 0.0,
            late: 0.0,
            slope: 0.0,
            jumps: 0.0,
            most: 0.0,
            rays: Vec::new(),
            since: 0.0,
            began: 0.0,
            means: [0.0; 2],
            weighed: 0.0,
            trip: 0.0,
            summed: 0.0,
            left: 0.0,
            height: 0.0,
            leapt: 0.0,
            rising: false,
            release: None,
            landed: None,
            events: Vec::new(),
            known: vec![Uncertainty::default()],
            open: None,
        }
    }

    pub(super) fn add(&mut self, defect: f64) {
        self.even += defect * (1.0 + SLACK);
    }

    pub(super) fn cell(&mut self, medium: &Medium<S>, cell: &Cell<'_, S>) {
        let (defect, most) = self.steps.cell(medium, cell);
        self.most = self.most.max(most);
        self.add(defect);
    }

    /// So many joinings may have been.
    pub(super) fn joins(&mut self, medium: &Medium<S>, joined: usize) {
        let size = 2.0 * self.most + medium.gravity.to_f64() + medium.slope.to_f64().abs();
        let defect = self.steps.joining(medium.least(), size);
        self.add(joined as f64 * defect);
    }

    /// A function of x of this size is added to `q`: the static state, or `h′`.
    pub(super) fn shift(&mut self, state: &State<S>, size: f64) {
        let defect = self.steps.shift(state, size);
        self.add(defect);
    }

    /// A round trip of a flight that is taken apart begins.
    pub(super) fn round(&mut self, state: &State<S>) {
        self.means[1] = self.steps.weighed(state, 0.0);
        (self.weighed, self.trip) = (self.even, 0.0);
    }

    /// Damping and gravity are rounded.
    pub(super) fn drift(&mut self, medium: &Medium<S>, trips: f64) {
        let rate = medium.kappa.to_f64() * self.most + medium.gravity.to_f64() + medium.slope.to_f64().abs();
        self.add(64.0 * self.steps.unit * rate * trips);
    }

    /// A ray starts that is off by so much, by no clock and by the one that holds now, with a mass.
    pub(super) fn starts(&mut self, at: S, time: f64, [off, late]: [f64; 2], mass: f64) {
        self.masses += mass * (1.0 + SLACK);
        self.late = self.late.max(late - self.clock);
        self.rays.push((at, [late - self.clock, off]));
        self.since = time;
    }

    /// The clock of the true motion is set by at most τ, where the motion changes like this.
    pub(super) fn set_clock(&mut self, late: f64, change: Change) {
        self.clock += late * (1.0 + SLACK);
        self.add(late * change.between);
        self.masses += late * change.jumps * (1.0 + SLACK);
    }

    /// How far the ray may be off that comes down here, besides by roundings: by no clock, and by the one that holds
    /// now. Those of the start are where they should be.
    pub(super) fn ray_at(&self, at: &S) -> [f64; 2] {
        let known = self.rays.iter().filter(|(ray, _)| ray == at).map(|(_, off)| *off);
        let [late, off] = known.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]).unwrap_or_default();
        [off, self.clock + late]
    }

    pub(super) fn latest(&self) -> f64 {
        self.clock + self.late
    }

    /// From now on the flight is taken apart: `h′` and the height of its centre are of these sizes.
    pub(super) fn take_off(&mut self, medium: &Medium<S>, state: &State<S>, (rate, height): (f64, f64)) {
        let still = medium.gravity.to_f64() + medium.slope.to_f64().abs();
        let size = still + rate.abs();
        let shifts = self.steps.shift(state, still) + self.steps.shift(state, size);
        self.add(shifts);
        let mean = self.steps.weighed(state, size) + 64.0 * self.steps.unit * (size + height.abs());
        self.means = [mean; 2];
        self.began = self.even - shifts;
        (self.weighed, self.trip) = (self.even, 0.0);
        self.summed = 0.0;
    }
}
