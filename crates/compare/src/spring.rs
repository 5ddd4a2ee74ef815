//! The rod on a spring ground, as a penalty contact makes it: a march along the characteristics of a fine grid.

use dalembert::problem::{Parameter, Parameters, Problem, Start, Top};
use dalembert::quantity::Quantity;

/// The state that is recorded at each step.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    end: f64,
    top: f64,
    centre: f64,
    centre_velocity: f64,
    /// Impulse of the ground per mass of the rod.
    impulse: f64,
}

/// A march with a step of the `cells`-th part of the time a wave takes along the rod.
#[derive(Debug)]
pub(super) struct SpringContact {
    step: f64,
    states: Vec<State>,
}

/// Bounds of the number of cells; the greater one has two cells in the front of a contact of `EA/k = L/100`.
const CELLS: [f64; 2] = [20.0, 200.0];
/// Bound of the number of cells times that of steps.
const MOST_CELLS: f64 = 1e6;

impl SpringContact {
    /// Follows the rod to `until` on a ground with the compliance `softness = EA/k`, a length; zero is a rigid ground.
    ///
    /// **Source**: `a = v_t` and `b = c v_x` change along `dx = ±c dt` as `d(a ∓ b) = −(g + 2r a) dt`; the ground has
    /// `b = ω v` with `ω = c/softness` while `v(0,t) < 0`, which is integrated exactly for an incoming wave that is
    /// constant over a step. The impulse of each step is exact for it too.
    ///
    /// **Accuracy**: *estimate*, of first order in the step.
    pub(super) fn solve(problem: &Problem, softness: f64, until: f64) -> Option<Self> {
        let rod = Parameters::<f64>::of(problem, &()).ok()?;
        let height = match problem.start() {
            Start::Profile(_) => return None,
            _ => Parameter::Gap.value(problem).unwrap_or_default(),
        };
        let (crossing, gravity) = (rod.length / rod.wave_speed, rod.gravity);
        let crossings = until / crossing + 1.0;
        let cells = (MOST_CELLS / crossings).sqrt().min(CELLS[1]).floor();
        if cells < CELLS[0] || softness < 0.0 {
            return None;
        }
        let (step, cells) = (crossing / cells, cells as usize);
        let rate = if softness > 0.0 { rod.wave_speed / softness } else { f64::INFINITY };
        // The waves a + b that run down and a − b that run up, at the middle of each cell.
        let (mut down, mut up) = (vec![-rod.speed; cells], vec![-rod.speed; cells]);
        let mut state = State { end: height, top: height, centre: height, centre_velocity: -rod.speed, impulse: 0.0 };
        let mut states = vec![state];
        for _ in 0..(until / step).ceil() as usize + 1 {
            let source: Vec<f64> =
                (0..cells).map(|i| -step * (gravity + 2.0 * rod.damping * f64::midpoint(down[i], up[i]))).collect();
            let (at_end, at_top) = (down[0], up[cells - 1]);
            let end = end_after(state.end, at_end, step, rate);
            let velocity = (end - state.end) / step;
            let force = at_end - velocity;
            state.end = end;
            state.top += if problem.top() == Top::Free { step * at_top } else { 0.0 };
            state.impulse -= force * step * rod.wave_speed / rod.length;
            down.rotate_left(1);
            up.rotate_right(1);
            down[cells - 1] = if problem.top() == Top::Free { at_top } else { -at_top };
            up[0] = velocity - force;
            for i in 0..cells {
                (down[i], up[i]) = (down[i] + source[i], up[i] + source[i]);
            }
            let mean = (0..cells).map(|i| f64::midpoint(down[i], up[i])).sum::<f64>() / cells as f64;
            state.centre += step * f64::midpoint(state.centre_velocity, mean);
            state.centre_velocity = mean;
            states.push(state);
        }
        Some(SpringContact { step, states })
    }

    /// Returns a displacement, the velocity of the centre or the impulse per mass, linear between steps; `None` for
    /// other quantities, which are no part of a [`State`].
    pub(super) fn at(&self, quantity: Quantity, time: f64) -> Option<f64> {
        let value: fn(&State) -> f64 = match quantity {
            Quantity::EndDisplacement => |state| state.end,
            Quantity::TopDisplacement => |state| state.top,
            Quantity::Centre => |state| state.centre,
            Quantity::CentreVelocity => |state| state.centre_velocity,
            Quantity::Impulse => |state| state.impulse,
            _ => return None,
        };
        let place = (time / self.step).clamp(0.0, (self.states.len() - 2) as f64);
        let (k, part) = (place as usize, place.fract());
        Some(value(&self.states[k]) * (1.0 - part) + value(&self.states[k + 1]) * part)
    }
}

/// Returns the place of the end after a step in which the wave `down` arrives, on a ground whose force relaxes at
/// `rate`, or a rigid one where that is infinite.
fn end_after(end: f64, down: f64, step: f64, rate: f64) -> f64 {
    // Free down to the ground.
    let free = if end <= 0.0 { 0.0 } else { (-end / down).clamp(0.0, step) };
    if (end > 0.0 && down >= 0.0) || free == step {
        return end + down * step;
    }
    let (start, rest) = (if end > 0.0 { 0.0 } else { end }, step - free);
    if rate.is_infinite() {
        return if down > 0.0 { start + down * rest } else { 0.0 };
    }
    let balance = down / rate;
    let after = balance + (start - balance) * (-rate * rest).exp();
    if after <= 0.0 {
        return after;
    }
    // The spring lets go within the step.
    let release = (1.0 - start / balance).ln() / rate;
    down * (rest - release)
}

#[cfg(test)]
#[path = "tests/spring.rs"]
mod tests;
