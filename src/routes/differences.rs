//! Finite differences at CFL = 1: the Riemann invariants on a grid, carried along the characteristics, damping by the
//! trapezoidal rule. What a careful programmer without a closed form would write.
//!
//! The unknowns stand in the middles of N cells, so that the rays of the lattice run along the edges of cells and a
//! jump is never smeared; but damping sees it a quarter of a step early or late. Events are found between two steps by
//! linear interpolation, and act from a step on.

use crate::error::Error;
use crate::mapped::{CollectVec, mapped};
use crate::motion::EventKind;
use crate::problem::{Parameters, Problem, Profile, Run, Start, Top};

/// What a march leaves: events, and the motion at the first release and at the end.
#[derive(Clone, Debug)]
pub(crate) struct Marched {
    /// Impacts and releases with their times, the start included where the rod stands on the ground.
    pub(crate) events: Vec<(EventKind, f64)>,
    /// `v_x(0,t)` at the end of the run.
    pub(crate) stress: f64,
    kept: Vec<Snapshot>,
}

impl Marched {
    /// The motion at `time`, if that is the first release or the end.
    pub(crate) fn at(&self, time: f64) -> Option<&Snapshot> {
        self.kept.iter().find(|snapshot| snapshot.time == time)
    }
}

/// `h`, `h′` and `E` at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Snapshot {
    time: f64,
    pub(crate) centre: f64,
    pub(crate) velocity: f64,
    pub(crate) energy: f64,
}

impl Snapshot {
    /// Linear in between.
    fn between(self, next: Snapshot, time: f64) -> Snapshot {
        let share = if next.time > self.time { (time - self.time) / (next.time - self.time) } else { 0.0 };
        let mix = |a: f64, b: f64| a + share * (b - a);
        Snapshot {
            time,
            centre: mix(self.centre, next.centre),
            velocity: mix(self.velocity, next.velocity),
            energy: mix(self.energy, next.energy),
        }
    }
}

/// Round trips after which a run that is asked for impacts is given up.
const MOST_TRIPS: f64 = 1e4;

struct Grid<'a> {
    rod: &'a Parameters<f64>,
    fixed: bool,
    step: f64,
    width: f64,
    /// `p = v_t − c v_x` and `q = v_t + c v_x` in the middles of the cells.
    p: Vec<f64>,
    q: Vec<f64>,
    contact: bool,
    /// `v(0,·)`.
    height: f64,
    centre: f64,
    time: f64,
}

/// The motion of `problem` with `cells` cells: up to the time that its run asks for, or to the release from its last
/// contact.
///
/// **Source**: `(∂_t + c∂_x) p = −g − r(p + q)`, `(∂_t − c∂_x) q = −g − r(p + q)`; at the ground p = −q in contact,
/// released when q becomes positive, and p = q in flight.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: an *f64 estimate*, of first order in `1/cells`; without damping the invariants are exact while events
/// fall on steps.
///
/// **Errors**: those of the parameters.
pub(crate) fn march(problem: &Problem, cells: usize) -> Result<Marched, Error> {
    let rod = Parameters::<f64>::of(problem, &())?;
    let mut grid = Grid::new(problem, &rod, cells.max(2));
    let mut marched = Marched { events: Vec::new(), stress: 0.0, kept: Vec::new() };
    if grid.contact {
        marched.events.push((EventKind::Impact, 0.0));
    }
    let (end, impacts) = match &problem.run {
        Run::Time(time) => (time.to_f64(), u32::MAX),
        Run::Impacts(count) => (MOST_TRIPS * rod.round_trip(), *count),
    };
    let mut before = grid.snapshot();
    let mut last_force = [(0.0, 0.0); 2];
    // The stress is known at half steps: one more lets it be asked at the end.
    while grid.time <= end {
        let was = (grid.contact, grid.height);
        let (force, pushed) = grid.advance();
        let now = grid.snapshot();
        let half = grid.time - 0.5 * grid.step;
        last_force = [last_force[1], (half, if grid.contact { force } else { 0.0 })];
        if was.0 && !grid.contact {
            // Between the last half step and this one; a jump may be anywhere between.
            let (from, share) = (last_force[0].0, last_force[0].1 / (last_force[0].1 - pushed));
            let time = from + (half - from) * if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
            if time <= end {
                marched.events.push((EventKind::Release, time));
                if marched.kept.is_empty() {
                    marched.kept.push(before.between(now, time));
                }
            }
            let releases = marched.events.iter().filter(|event| event.0 == EventKind::Release).count();
            if releases as u32 >= impacts {
                break;
            }
        } else if !was.0 && grid.contact {
            let time = now.time - grid.step * (1.0 - (was.1 / (was.1 - pushed)).clamp(0.0, 1.0));
            if time <= end {
                marched.events.push((EventKind::Impact, time));
            }
        }
        if now.time >= end {
            marched.kept.push(before.between(now, end));
        }
        before = now;
    }
    marched.stress = interpolated(last_force, end);
    Ok(marched)
}

/// The stress at `time` from the two half steps around it; from one alone where the rod leaves or lands between.
fn interpolated([(t0, s0), (t1, s1)]: [(f64, f64); 2], time: f64) -> f64 {
    if s0 == 0.0 || s1 == 0.0 || t1 <= t0 {
        return if 2.0 * time < t0 + t1 { s0 } else { s1 };
    }
    s0 + (s1 - s0) * (time - t0) / (t1 - t0)
}

impl<'a> Grid<'a> {
    fn new(problem: &Problem, rod: &'a Parameters<f64>, cells: usize) -> Self {
        let width = rod.length / cells as f64;
        let empty = Profile::default();
        let profile = match &problem.start {
            Start::Uniform(_) | Start::Above { .. } => &empty,
            Start::Profile(profile) => profile,
        };
        let lift = |list: &[(crate::Number, crate::Number)]| -> Vec<(f64, f64)> {
            mapped(list, |(x, v)| (x.to_f64(), v.to_f64()))
        };
        let (mut displacement, velocity) = (lift(&profile.displacement), lift(&profile.velocity));
        displacement.extend(problem.gap().map(|gap| (0.0, gap.to_f64())));
        let middles: Vec<f64> = mapped(0..cells, |k| (k as f64 + 0.5) * width);
        let strain = |x: f64| {
            (between(&displacement, x + 0.5 * width) - between(&displacement, x - 0.5 * width)) * rod.wave_speed / width
        };
        let rate = |x: f64| between(&velocity, x) - rod.speed;
        let centre = middles.iter().map(|x| between(&displacement, *x)).sum::<f64>() / cells as f64;
        let height = between(&displacement, 0.0);
        Grid {
            fixed: problem.rod.top == Top::Fixed,
            step: width / rod.wave_speed,
            p: mapped(&middles, |x| rate(*x) - strain(*x)),
            q: mapped(&middles, |x| rate(*x) + strain(*x)),
            contact: height <= 0.0,
            time: 0.0,
            height,
            centre,
            width,
            rod,
        }
    }

    /// `v_t = s/2`, `c v_x = (q − p)/2`.
    fn snapshot(&self) -> Snapshot {
        let Parameters { length, gravity, .. } = *self.rod;
        let cells = self.p.len() as f64;
        let (mut rate, mut squares) = (0.0, 0.0);
        for (p, q) in self.p.iter().zip(&self.q) {
            rate += 0.5 * (p + q);
            squares += 0.25 * (p * p + q * q);
        }
        let energy = squares * self.width + length * gravity * self.centre;
        Snapshot { time: self.time, centre: self.centre, velocity: rate / cells, energy }
    }

    /// One step. The first number is the stress at the ground half a step on; the second says by how much it was pulled
    /// where it lets go, and how deep it had fallen where it lands.
    fn advance(&mut self) -> (f64, f64) {
        let Parameters { wave_speed: c, damping: r, gravity: g, .. } = *self.rod;
        let (dt, n) = (self.step, self.p.len());
        let fall = g * dt;
        let half = 0.5 * r * dt;
        let old: Vec<f64> = self.p.iter().zip(&self.q).map(|(p, q)| p + q).collect_vec();
        let rate = old.iter().sum::<f64>() / (2 * n) as f64;
        // Down to the ground in half a step, where p + q is 0 in contact and 2q in flight.
        let arriving = self.q[0] - 0.5 * fall - 0.5 * half * old[0];
        let flying = arriving / (1.0 + half);
        let mut moved = 0.0;
        if self.contact && arriving > 0.0 {
            self.contact = false;
            moved = arriving / c;
        } else if !self.contact {
            self.height += dt * flying;
            if self.height < 0.0 {
                moved = self.height;
                self.height = 0.0;
                self.contact = true;
            }
        }
        let (leaving, sum) = if self.contact { (-arriving, 0.0) } else { (flying, 2.0 * flying) };
        let lowest = leaving - 0.5 * fall - 0.5 * half * sum;
        let top = if self.fixed { -1.0 } else { 1.0 };
        // Up to the top and back within one step; held, it sees no sum at the turn.
        let turned = top * (self.p[n - 1] - 0.5 * fall - 0.5 * half * old[n - 1]);
        let (turned, sum) =
            if self.fixed { (turned, 0.0) } else { (turned / (1.0 + half), 2.0 * turned / (1.0 + half)) };
        let highest = turned - 0.5 * fall - 0.5 * half * sum;
        let from_below = |k: usize| self.p[k] - fall - half * old[k];
        let from_above = |k: usize| self.q[k] - fall - half * old[k];
        let next: Vec<(f64, f64)> = mapped(0..n, |k| {
            // At the ends half of the trapezoid is behind already.
            let (up, up_share) = if k == 0 { (lowest, 0.5 * half) } else { (from_below(k - 1), half) };
            let (down, down_share) = if k + 1 == n { (highest, 0.5 * half) } else { (from_above(k + 1), half) };
            let sum = (up + down) / (1.0 + up_share + down_share);
            (up - up_share * sum, down - down_share * sum)
        });
        for (k, (p, q)) in next.into_iter().enumerate() {
            self.p[k] = p;
            self.q[k] = q;
        }
        let after = self.p.iter().zip(&self.q).map(|(p, q)| p + q).sum::<f64>() / (2 * n) as f64;
        self.centre += 0.5 * dt * (rate + after);
        self.time += dt;
        (if self.contact { arriving / c } else { 0.0 }, moved)
    }
}

/// Linear between points, zero without any; the mean of both at a jump.
fn between(points: &[(f64, f64)], x: f64) -> f64 {
    let next = points.partition_point(|(at, _)| *at <= x);
    let low = next.checked_sub(1).and_then(|k| points.get(k));
    match (low, points.get(next)) {
        (Some((x0, v0)), Some((x1, v1))) => v0 + (v1 - v0) * (x - x0) / (x1 - x0),
        (Some((_, v)), None) | (None, Some((_, v))) => *v,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
#[path = "tests/differences.rs"]
mod tests;
