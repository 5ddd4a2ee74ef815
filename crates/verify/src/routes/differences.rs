//! Finite differences at CFL = 1: the Riemann invariants on a grid, carried along the characteristics, with damping by
//! the trapezoidal rule, as a careful programmer without a closed form would write it.
//!
//! The unknowns stand in the middles of N cells, so that the rays of the lattice run along the edges of cells and no
//! jump is smeared; damping sees a jump a quarter of a step early or late. Events are found between two steps by linear
//! interpolation, and act from the next step on.

use glam::DVec2;

use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Profile, Run, Start, Top};
use dalembert::{Error, EventKind};

/// The result of a march: events, and the motion at the first release and at the end.
#[derive(Clone, Debug)]
pub(super) struct March {
    /// Impacts and releases with their times, the start included where the rod stands on the ground.
    pub(super) events: Vec<(EventKind, f64)>,
    /// `v_x(0,t)` at the end of the run.
    pub(super) strain: f64,
    states: Vec<State>,
}

impl March {
    /// Returns the motion at `time`, if that is the first release or the end.
    pub(super) fn state_at(&self, time: f64) -> Option<State> {
        self.states.iter().find(|state| state.time == time).copied()
    }
}

/// The motion of the whole rod at one time.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    time: f64,
    /// `h`.
    pub(super) centre: f64,
    /// `h′`.
    pub(super) velocity: f64,
    /// `E` per linear density.
    pub(super) energy: f64,
}

impl State {
    /// Interpolates linearly between two states.
    fn interpolate(a: State, b: State, time: f64) -> State {
        let share = (time - a.time) / (b.time - a.time);
        let between = |a: f64, b: f64| a + (b - a) * share;
        State {
            time,
            centre: between(a.centre, b.centre),
            velocity: between(a.velocity, b.velocity),
            energy: between(a.energy, b.energy),
        }
    }
}

/// Round trips after which a run of a number of impacts is given up.
const MOST_TRIPS: f64 = 1e4;

/// The rod in the middle of a march.
struct Grid {
    rod: Parameters<f64>,
    fixed_top: bool,
    step: f64,
    width: f64,
    /// `p = v_t − c v_x` and `q = v_t + c v_x` in the middles of the cells.
    waves: Vec<DVec2>,
    contact: bool,
    /// `v(0,·)`.
    height: f64,
    centre: f64,
    time: f64,
}

/// The events at the ground in one step.
struct Step {
    /// `v_x(0,·)` half a step on.
    strain: f64,
    /// The tensile strain at a release, or the depth below the ground at an impact.
    overshoot: f64,
}

/// Marches `problem` with `cells` cells to the time that its run asks for, or to the release from its last contact.
///
/// **Source**: `(∂_t + c∂_x) p = −g − r(p + q)`, `(∂_t − c∂_x) q = −g − r(p + q)`; at the ground p = −q in contact,
/// released when q becomes positive, and p = q in flight.
///
/// **Accuracy**: an *f64 estimate*, of first order in `1/cells`; without damping the invariants are exact while events
/// fall on steps.
pub(super) fn march(problem: &Problem, cells: usize) -> Result<March, Error> {
    let rod = Parameters::<f64>::of(problem, &())?;
    let (end, impacts) = match problem.run() {
        Run::Time(time) => (time.to_f64(), u32::MAX),
        Run::Impacts(count) => (MOST_TRIPS * rod.round_trip(), *count),
    };
    let mut grid = Grid::new(problem, rod, cells.max(2));
    let mut marched = March { events: Vec::new(), strain: 0.0, states: Vec::new() };
    if grid.contact {
        marched.events.push((EventKind::Impact, 0.0));
    }
    let (mut before, mut releases) = (grid.state(), 0);
    let mut last_strains = [DVec2::ZERO; 2];
    // The strain is known at half steps: one more step brackets the end.
    while grid.time <= end {
        let (contact, height) = (grid.contact, grid.height);
        let Step { strain, overshoot } = grid.advance();
        let now = grid.state();
        let half = grid.time - 0.5 * grid.step;
        last_strains = [last_strains[1], DVec2::new(half, strain)];
        if contact && !grid.contact {
            // The release lies between the last half step and this one; a jump may be anywhere between.
            let [DVec2 { x: from, y: pressed }, _] = last_strains;
            let share = pressed / (pressed - overshoot);
            let time = from + (half - from) * if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
            if time <= end {
                releases += 1;
                marched.events.push((EventKind::Release, time));
                if marched.states.is_empty() {
                    marched.states.push(State::interpolate(before, now, time));
                }
            }
            if releases >= impacts {
                break;
            }
        } else if !contact && grid.contact {
            let time = grid.time - grid.step * (1.0 - (height / (height - overshoot)).clamp(0.0, 1.0));
            if time <= end {
                marched.events.push((EventKind::Impact, time));
            }
        }
        if grid.time >= end {
            marched.states.push(State::interpolate(before, now, end));
        }
        before = now;
    }
    marched.strain = interpolated(last_strains, end);
    Ok(marched)
}

/// Returns the strain at `time` from those at the two half steps around it; from one alone where the rod leaves or
/// lands between.
fn interpolated([DVec2 { x: t0, y: s0 }, DVec2 { x: t1, y: s1 }]: [DVec2; 2], time: f64) -> f64 {
    if s0 == 0.0 || s1 == 0.0 || t1 <= t0 {
        return if 2.0 * time < t0 + t1 { s0 } else { s1 };
    }
    s0 + (s1 - s0) * (time - t0) / (t1 - t0)
}

impl Grid {
    fn new(problem: &Problem, rod: Parameters<f64>, cells: usize) -> Self {
        let width = rod.length / cells as f64;
        let empty = Profile::default();
        let profile = match problem.start() {
            Start::Uniform(_) | Start::Above { .. } => &empty,
            Start::Profile(profile) => profile,
        };
        let lift = |list: &[(Number, Number)]| -> Vec<DVec2> {
            list.iter().map(|(x, v)| DVec2::new(x.to_f64(), v.to_f64())).collect()
        };
        let (mut displacement, velocity) = (lift(&profile.displacement), lift(&profile.velocity));
        displacement.extend(problem.gap().map(|gap| DVec2::new(0.0, gap.to_f64())));
        let strain = lift(&profile.strain);
        let place = |x: f64| if strain.is_empty() { between(&displacement, x) } else { area(&strain, x) };
        let wave = |k: usize| {
            let x = (k as f64 + 0.5) * width;
            let strain = (place(x + 0.5 * width) - place(x - 0.5 * width)) * rod.wave_speed / width;
            let rate = between(&velocity, x) - rod.speed;
            DVec2::new(rate - strain, rate + strain)
        };
        let centre = (0..cells).map(|k| place((k as f64 + 0.5) * width)).sum::<f64>() / cells as f64;
        let (waves, height) = ((0..cells).map(wave).collect(), place(0.0));
        let (fixed_top, step) = (problem.top() == Top::Fixed, width / rod.wave_speed);
        Grid { fixed_top, step, waves, contact: height <= 0.0, time: 0.0, height, centre, width, rod }
    }

    /// Computes `h′`, the mean of `v_t = (p + q)/2`.
    fn velocity(&self) -> f64 {
        self.waves.iter().map(|wave| wave.element_sum()).sum::<f64>() / (2 * self.waves.len()) as f64
    }

    fn state(&self) -> State {
        let squares: f64 = self.waves.iter().map(|wave| 0.25 * wave.length_squared()).sum();
        let energy = squares * self.width + self.rod.length * self.rod.gravity * self.centre;
        State { time: self.time, centre: self.centre, velocity: self.velocity(), energy }
    }

    /// Advances by one step.
    fn advance(&mut self) -> Step {
        let Parameters { wave_speed: c, damping: r, gravity: g, .. } = self.rod;
        let (dt, n, rate) = (self.step, self.waves.len(), self.velocity());
        let (fall, half) = (g * dt, 0.5 * r * dt);
        // A wave after a share of a step that begins with `p + q = sum`, without the final term of the trapezoidal
        // rule.
        let after = |share: f64, wave: f64, sum: f64| wave - share * fall - share * half * sum;
        // The wave that an end reflects half a step later: p + q is 0 at a fixed end, and twice the wave at a free one.
        let reflected = |held: bool, arriving: f64| match held {
            true => after(0.5, -arriving, 0.0),
            false => after(0.5, arriving / (1.0 + half), 2.0 * arriving / (1.0 + half)),
        };
        let arriving = |inner: DVec2, wave: f64| after(0.5, wave, inner.element_sum());
        let (ground, top) = (arriving(self.waves[0], self.waves[0].y), self.waves[n - 1]);
        let mut overshoot = 0.0;
        if self.contact && ground > 0.0 {
            self.contact = false;
            overshoot = ground / c;
        } else if !self.contact {
            self.height += dt * (ground / (1.0 + half));
            if self.height < 0.0 {
                overshoot = self.height;
                self.height = 0.0;
                self.contact = true;
            }
        }
        let (lowest, highest) = (reflected(self.contact, ground), reflected(self.fixed_top, arriving(top, top.x)));
        let from = |cell: usize, wave: f64| (after(1.0, wave, self.waves[cell].element_sum()), half);
        let next = |k: usize| {
            // At the ends half of the trapezoidal rule has been applied already.
            let (up, up_share) = if k == 0 { (lowest, 0.5 * half) } else { from(k - 1, self.waves[k - 1].x) };
            let (down, down_share) = if k + 1 == n { (highest, 0.5 * half) } else { from(k + 1, self.waves[k + 1].y) };
            let sum = (up + down) / (1.0 + up_share + down_share);
            DVec2::new(up - up_share * sum, down - down_share * sum)
        };
        self.waves = (0..n).map(next).collect();
        self.centre += 0.5 * dt * (rate + self.velocity());
        self.time += dt;
        Step { strain: if self.contact { ground / c } else { 0.0 }, overshoot }
    }
}

/// Interpolates linearly between points; zero without any.
fn between(points: &[DVec2], x: f64) -> f64 {
    let next = points.partition_point(|point| point.x <= x);
    let low = next.checked_sub(1).and_then(|k| points.get(k));
    match (low, points.get(next)) {
        (Some(a), Some(b)) => a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x),
        (Some(end), None) | (None, Some(end)) => end.y,
        (None, None) => 0.0,
    }
}

/// Computes the integral from 0 to `x` of the piecewise linear function through `points`.
fn area(points: &[DVec2], x: f64) -> f64 {
    let part = |pair: &[DVec2]| {
        let end = x.clamp(pair[0].x, pair[1].x);
        let share = if pair[1].x > pair[0].x { (end - pair[0].x) / (pair[1].x - pair[0].x) } else { 0.0 };
        (end - pair[0].x) * (pair[0].y + (pair[1].y - pair[0].y) * share / 2.0)
    };
    points.windows(2).map(part).sum()
}

#[cfg(test)]
#[path = "tests/differences.rs"]
mod tests;
