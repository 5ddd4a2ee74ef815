//! The account of a proof: the sums that a run collects.

use super::cell::Cell;
use super::defect::Steps;
use super::march::{Medium, State};
use super::series::Basis;
use super::uncertainty::Uncertainty;
use crate::reason::Near;
use crate::special::RoundedSpecial;

/// Relative enlargement of sums of doubles, for their own roundings.
///
/// **Source**: a sum of N terms of one sign loses at most `N 2⁻⁵³` of itself. A march adds fewer than 2·10⁹ terms, and
/// 1e-6 covers 9·10⁹.
pub(super) const SLACK: f64 = 1e-6;

/// An open question: its kind, and a bound of the difference of velocities from then on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub(super) what: Near,
    pub(super) differ: f64,
}

/// Rates of change of a motion: bounds of `|p_t|` and `|q_t|` between rays, and of the sum of the jumps at rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) between: f64,
    pub(super) jumps: f64,
}

/// A release that the first strip of its flight has yet to prove.
#[derive(Clone, Debug)]
pub(super) struct Release<S> {
    /// Number of pieces before the strip that ends with the release.
    pub(super) pieces: usize,
    /// Stress at the release, if it is at a ray.
    pub(super) left: Option<f64>,
    /// Bound of the time error from the stress alone, and the slope of the stress.
    pub(super) late: f64,
    pub(super) steep: f64,
    /// Time error of the releasing ray in absolute time.
    pub(super) ray: f64,
    pub(super) at: S,
}

/// The account of a run.
#[derive(Clone, Debug)]
pub(super) struct Proof<S> {
    pub(super) steps: Steps,
    pub(super) doubles: Basis<f64>,
    pub(super) roundoff: f64,
    pub(super) masses: f64,
    /// Θ: bound of the shift of the true motion's clock since the start.
    pub(super) clock: f64,
    /// Greatest time error of a ray so far by that clock, less Θ.
    pub(super) late: f64,
    /// Greatest rate of change of `p` and `q` between rays so far, the sum of their jumps, and the greatest `|q|`.
    pub(super) slope: f64,
    pub(super) jumps: f64,
    pub(super) most: f64,
    /// Places of the rays from the initial data and from events, and their time errors: by the clock, less Θ, and in
    /// absolute time.
    pub(super) rays: Vec<(S, [f64; 2])>,
    /// Time of the last event.
    pub(super) since: f64,
    /// E at the separation into centre of mass and vibration.
    pub(super) began: f64,
    /// Errors of `h′` and `z(0)` of this flight as means of the stored `q`: at its beginning, and now.
    pub(super) means: [f64; 2],
    /// E when `z(0)` was last such a mean, and the errors summed up since.
    pub(super) weighed: f64,
    pub(super) trip: f64,
    /// Error of the heights that this flight has summed up, if it is not separated.
    pub(super) summed: f64,
    /// Mass that the last release has left.
    pub(super) left: f64,
    /// Bound of the height to which the end may have risen in contact without a force.
    pub(super) lifted: f64,
    /// Whether the end has been in contact without a force since the start of the run.
    pub(super) silent: bool,
    /// Greatest error of `v(0,·)` in the last flight.
    pub(super) height: f64,
    /// Greatest defect of a leap.
    pub(super) leapt: f64,
    /// Whether the end has only risen since its release and is not yet clear of the ground.
    pub(super) rising: bool,
    pub(super) release: Option<Release<S>>,
    /// Time errors of the landing that was proved last, as in `events`.
    pub(super) landed: Option<[f64; 2]>,
    /// Time errors of the events: in absolute time, and by the clock at the event.
    pub(super) events: Vec<[f64; 2]>,
    /// Error bounds of values before the first event, and after each event.
    pub(super) known: Vec<Uncertainty>,
    /// Number of proved pieces, and the open question after them.
    pub(super) open: Option<(usize, Open)>,
}

impl<S: RoundedSpecial> Proof<S> {
    pub(super) fn new(medium: &Medium<S>) -> Self {
        let steps = Steps::of(medium);
        Proof {
            doubles: Basis::new(&1.0, medium.basis.size(), 1),
            steps,
            roundoff: 0.0,
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
            lifted: 0.0,
            silent: true,
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
        self.roundoff += defect * (1.0 + SLACK);
    }

    pub(super) fn cell(&mut self, medium: &Medium<S>, cell: &Cell<'_, S>) {
        let (defect, most) = self.steps.cell(medium, cell);
        self.most = self.most.max(most);
        self.add(defect);
    }

    /// Adds the defects of `joined` joinings.
    pub(super) fn joins(&mut self, medium: &Medium<S>, joined: usize) {
        let size = 2.0 * self.most + medium.gravity.to_f64() + medium.slope.to_f64().abs();
        let defect = self.steps.joining(medium.least(), size);
        self.add(joined as f64 * defect);
    }

    /// Adds the defect of adding a function of x of this size to `q`: the static state, or `h′`.
    pub(super) fn shift(&mut self, state: &State<S>, size: f64) {
        let defect = self.steps.shift(state, size);
        self.add(defect);
    }

    /// Begins a round trip of a separated flight.
    pub(super) fn round(&mut self, state: &State<S>) {
        self.means[1] = self.steps.weighed(state, 0.0);
        (self.weighed, self.trip) = (self.roundoff, 0.0);
    }

    /// Adds the error of the rounded damping and gravity.
    pub(super) fn drift(&mut self, medium: &Medium<S>, trips: f64) {
        let rate = medium.kappa.to_f64() * self.most + medium.gravity.to_f64() + medium.slope.to_f64().abs();
        self.add(64.0 * self.steps.unit * rate * trips);
    }

    /// Records a ray that starts with these time errors, in absolute time and by the present clock, and adds its mass.
    pub(super) fn starts(&mut self, at: S, time: f64, [off, late]: [f64; 2], mass: f64) {
        self.masses += mass * (1.0 + SLACK);
        self.late = self.late.max(late - self.clock);
        self.rays.push((at, [late - self.clock, off]));
        self.since = time;
    }

    /// Sets the clock of the true motion by at most `late`, τ, where the motion changes at the rates `change`.
    pub(super) fn set_clock(&mut self, late: f64, change: Change) {
        self.clock += late * (1.0 + SLACK);
        self.add(late * change.between);
        self.masses += late * change.jumps * (1.0 + SLACK);
    }

    /// Returns the time error, apart from roundings, of the ray that arrives here: in absolute time, and by the present
    /// clock. Rays from the initial data have none in absolute time; nothing is known of a ray that was not recorded.
    pub(super) fn ray_at(&self, at: &S) -> [f64; 2] {
        let known = self.rays.iter().filter(|(ray, _)| ray == at).map(|(_, off)| *off);
        let [late, off] = known.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]).unwrap_or([f64::INFINITY; 2]);
        [off, self.clock + late]
    }

    pub(super) fn latest(&self) -> f64 {
        self.clock + self.late
    }

    /// Adds the defects of the separation of a flight, where `h′` and the height of its centre have these sizes.
    pub(super) fn take_off(&mut self, medium: &Medium<S>, state: &State<S>, (rate, height): (f64, f64)) {
        let still = medium.gravity.to_f64() + medium.slope.to_f64().abs();
        let size = still + rate.abs();
        let shifts = self.steps.shift(state, still) + self.steps.shift(state, size);
        self.add(shifts);
        let mean = self.steps.weighed(state, size) + 64.0 * self.steps.unit * (size + height.abs());
        self.means = [mean; 2];
        self.began = self.roundoff - shifts;
        (self.weighed, self.trip) = (self.roundoff, 0.0);
        self.summed = 0.0;
    }
}
