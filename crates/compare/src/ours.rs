//! The exact side: values, jumps and contacts of a history.

use super::norms::Grid;
use super::samples::Rounding;
use super::touch::{Touch, pressed};
use dalembert::Error;
use dalembert::engine::{Motion, RayRegister};
use dalembert::number::{Estimate, Number, Scalar};
use dalembert::problem::{Material, Parameters};
use dalembert::quantity::{Measure, Quantity};
use dalembert::solve::TypedHistory;
use dalembert::special::gauss_legendre;
use dalembert::{Field, Side, StressPiece};

/// A history with the times at which the end at the ground sees a ray.
#[derive(Debug)]
pub(super) struct Ours<'a> {
    pub(super) history: &'a TypedHistory<f64>,
    rod: Parameters<f64>,
    material: [f64; 3],
    pieces: Vec<StressPiece<f64>>,
    /// Times at which `v_t(0,·)` or `v_x(0,·)` jumps, ascending.
    jumps: Vec<f64>,
    /// Times at which contact begins or ends, and the start.
    switches: Vec<f64>,
    /// Times at which rays leave the ground: the jumps, and for a start that is not uniform rays that have not been
    /// there yet.
    leaves: Vec<f64>,
}

/// Jumps below this share of the scale of velocities are none.
const SMALL: f64 = 1e-9;

impl<'a> Ours<'a> {
    /// The exact side of a history.
    ///
    /// **Source**: the register of rays. A time at which one is at the ground counts where the two limits differ.
    pub(super) fn of(history: &'a TypedHistory<f64>) -> Result<Self, Error> {
        let problem = history.problem();
        let rod = Parameters::<f64>::of(problem, &())?;
        let material = match &problem.rod.material {
            Material::WaveSpeed(_) => [rod.wave_speed * rod.wave_speed, 1.0, 1.0],
            Material::Elastic { modulus, density, area } => {
                [modulus.to_f64(), density.to_f64(), area.as_ref().map_or(1.0, Number::to_f64)]
            }
        };
        let pieces = history.stress_history()?.pieces;
        // At the ground since the start, and before it where rays have not been there yet.
        let at_ground = |from: f64, to: f64| {
            let rays = |motion: &dyn Motion<Estimate<f64>>| {
                Ok(RayRegister::of(motion).passing(&motion.end().zero(), from, to))
            };
            let rays = history.ask(rays, |_| Vec::new())?;
            Ok::<Vec<f64>, Error>(rays.into_iter().map(|ray| ray.time.into_value()).collect())
        };
        let candidates = at_ground(0.0, *history.end())?;
        let seen = [Quantity::EndVelocity, Quantity::Strain];
        let before = history.columns(&seen, &candidates, Some(Side::Left))?;
        let after = history.columns(&seen, &candidates, Some(Side::Right))?;
        let jump = |column: usize, k: usize| (before[column][k] - after[column][k]).abs();
        let least = SMALL * history.scales().velocity;
        let differ = |k: usize| jump(0, k).max(jump(1, k) * rod.wave_speed) > least;
        let jumps: Vec<f64> = candidates.iter().enumerate().filter(|(k, _)| differ(*k)).map(|(_, at)| *at).collect();
        let mut leaves = at_ground(-rod.round_trip(), 0.0)?;
        leaves.retain(|time| *time < 0.0);
        leaves.extend(&jumps);
        let events = history.events().iter().map(|event| event.t);
        let switches = std::iter::once(0.0).chain(events).collect();
        Ok(Ours { history, rod, material, pieces, jumps, switches, leaves })
    }

    /// `ρS`, or 1 where forces are per `ρS`.
    pub(super) fn line(&self) -> f64 {
        self.material[1] * self.material[2]
    }

    /// `ρS L`, `g`, `r`.
    pub(super) fn momentum(&self) -> [f64; 3] {
        [self.line() * self.rod.length, self.rod.gravity, self.rod.damping]
    }

    /// What makes a quantity the force of the ground.
    pub(super) fn force_per(&self, what: Quantity) -> f64 {
        let [modulus, _, area] = self.material;
        match what {
            Quantity::Strain => -modulus * area,
            Quantity::Stress => -area,
            _ => 1.0,
        }
    }

    /// The values of every quantity on `grid`, from later times where there are two.
    pub(super) fn values(&self, whats: &[Quantity], grid: &Grid) -> Result<Vec<Vec<f64>>, Error> {
        self.at(whats, grid.points.as_deref(), &grid.times, Side::Right)
    }

    /// The values of every quantity at these times, for a field each at its point.
    fn at(
        &self,
        whats: &[Quantity],
        points: Option<&[f64]>,
        times: &[f64],
        side: Side,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let Some(points) = points else { return self.history.columns(whats, times, Some(side)) };
        let mut all = vec![Vec::with_capacity(times.len()); whats.len()];
        for (point, time) in points.iter().zip(times) {
            for field in self.history.field(&[*point], &[*time], side)? {
                for (values, what) in all.iter_mut().zip(whats) {
                    values.push(self.part(*what, &field));
                }
            }
        }
        Ok(all)
    }

    fn part(&self, what: Quantity, field: &Field<f64>) -> f64 {
        match what.measure() {
            Some(Measure::Velocity) => field.velocity,
            Some(Measure::Strain) => field.strain,
            Some(Measure::Stress) => self.material[0] * field.strain,
            _ => field.displacement,
        }
    }

    /// Replaces our values at samples on a jump by the limit that their row holds, or the one that is nearer to theirs
    /// where that is not known, and counts those samples.
    pub(super) fn nearer(
        &self,
        what: Quantity,
        grid: &Grid,
        (passing, rounding, sides): (&[f64], &Rounding, &[Option<Side>]),
        theirs: &[f64],
        ours: &mut [f64],
    ) -> Result<usize, Error> {
        let mut count = 0;
        for (k, (jump, time)) in passing.iter().zip(&grid.times).enumerate() {
            if (jump - time).abs() > rounding.most || (jump - time).abs() > rounding.at(*time) {
                continue;
            }
            let point = grid.points.as_ref().map(|points| &points[k..=k]);
            let limit = |time: f64, side| Ok::<f64, Error>(self.at(&[what], point, &[time], side)?[0][0]);
            let limits = |time: f64| Ok::<_, Error>((limit(time, Side::Left)?, limit(time, Side::Right)?));
            let (left, right) = limits(jump.max(0.0))?;
            count += usize::from(left != right);
            if let Some(side) = sides[k] {
                // The jump is where the row says, or a rounding of its time away.
                let own = limits(*time)?;
                let (left, right) = if own.0 == own.1 { (left, right) } else { own };
                ours[k] = if side == Side::Left { left } else { right };
                continue;
            }
            // Or the sample is just beside the jump, whatever its time is worth.
            for limit in [left, right] {
                if (theirs[k] - limit).abs() < (theirs[k] - ours[k]).abs() {
                    ours[k] = limit;
                }
            }
        }
        Ok(count)
    }

    /// For each sample the time nearest to it at which a ray passes the point that the quantity is at; infinite where
    /// none ever does. Empty for what does not jump.
    pub(super) fn passing(&self, what: Quantity, grid: &Grid) -> Vec<f64> {
        let trip = self.rod.round_trip();
        let up_and_down = |travel: f64, time: f64| {
            let ways = [travel, trip - travel].map(|delay| nearest(&self.leaves, time - delay) + delay);
            if (ways[0] - time).abs() < (ways[1] - time).abs() { ways[0] } else { ways[1] }
        };
        let at = |(k, time): (usize, &f64)| match (what, &grid.points) {
            // Contact begins and ends without a jump of the stress too.
            (Quantity::Contact, _) => nearest(&self.switches, *time),
            (Quantity::TopDisplacement | Quantity::TopVelocity, _) => up_and_down(trip / 2.0, *time),
            (_, Some(points)) => up_and_down(points[k] / self.rod.wave_speed, *time),
            _ => nearest(&self.jumps, *time),
        };
        let jumps = what.jumps();
        grid.times.iter().enumerate().filter(|_| jumps).map(at).collect()
    }

    /// What a displacement or a velocity is compared with; zero for what is not told from zero by it.
    pub(super) fn scale(&self, what: Quantity) -> f64 {
        let scales = self.history.scales();
        match what.measure() {
            Some(Measure::Length) => scales.velocity * scales.time,
            Some(Measure::Velocity) => scales.velocity,
            _ => 0.0,
        }
    }

    /// The displacements at `t = 0`, one for all samples or one each; `None` for what is no displacement.
    pub(super) fn start(&self, what: Quantity, points: Option<&[f64]>) -> Result<Option<Vec<f64>>, Error> {
        let times = vec![0.0; points.map_or(1, <[f64]>::len)];
        if what.has_origin() { Ok(self.at(&[what], points, &times, Side::Right)?.pop()) } else { Ok(None) }
    }

    /// Our contacts, with the moments of their force.
    ///
    /// **Accuracy**: pieces of degree n are integrated by a rule that is exact for `t²` times them.
    pub(super) fn touches(&self) -> Vec<Touch> {
        let factor = self.force_per(Quantity::Strain);
        let mut pieces = self.pieces.iter().peekable();
        let mut touches = Vec::new();
        for contact in self.history.contacts() {
            let end = contact.release.unwrap_or(f64::INFINITY);
            let mut force = Vec::new();
            while let Some(piece) = pieces.next_if(|piece| piece.start < end) {
                let (middle, half) = (f64::midpoint(piece.start, piece.end), (piece.end - piece.start) / 2.0);
                let nodes = gauss_legendre(&1.0_f64, piece.chebyshev.len().max(2)).into_iter();
                let nodes = nodes.filter(|_| middle >= contact.impact).map(|(node, weight)| {
                    let time = middle + half * node;
                    [time, factor * piece.eval(&time), half * weight]
                });
                force.extend(nodes);
            }
            let touch = pressed(contact.impact, contact.release, force.into_iter());
            let peak = touch.peak.map(|peak| peak.max(factor * contact.peak_strain));
            touches.push(Touch { impulse: Some(self.line() * contact.impulse), peak, ..touch });
        }
        touches
    }

    /// A separation that is shorter is chatter: a quarter of the round trip, or of our shortest flight.
    pub(super) fn shortest_separation(&self) -> f64 {
        let contacts = self.history.contacts();
        let flights = contacts.windows(2).filter_map(|pair| pair[0].release.map(|to| pair[1].impact - to));
        flights.fold(self.rod.round_trip(), f64::min) / 4.0
    }

    /// Factors that are often forgotten, with the question to ask.
    pub(super) fn factors(&self, what: Quantity) -> Vec<(f64, &'static str)> {
        let [modulus, density, area] = self.material;
        let mut known = match what {
            energy if energy.measure() == Some(Measure::Energy) => {
                vec![(2.0, "is ½ missing?"), (0.5, "is ½ there twice?")]
            }
            Quantity::Force => vec![(1.0 / area, "is it a stress?")],
            Quantity::Stress => vec![(area, "is it a force?"), (1.0 / modulus, "is it a strain?")],
            Quantity::Strain => vec![(modulus, "is it a stress?")],
            _ => Vec::new(),
        };
        known.extend([
            (1.0 / (density * area), "is ρS missing?"),
            (1.0 / density, "is ρ missing?"),
            (1e3, "is it in thousandths of the unit, as mm of m?"),
            (1e-3, "is it in thousands of the unit, as kN of N?"),
            (1e6, "is it in millionths of the unit, as µm of m?"),
            (1e-6, "is it in millions of the unit, as MPa of Pa?"),
        ]);
        known.retain(|(factor, _)| (factor - 1.0).abs() > 0.01);
        known
    }
}

/// The nearest of ascending times; infinite where there is none.
fn nearest(times: &[f64], time: f64) -> f64 {
    let next = times.partition_point(|at| *at < time);
    let after = times.get(next).copied().unwrap_or(f64::INFINITY);
    match next.checked_sub(1).map(|before| times[before]) {
        Some(before) if time - before <= after - time => before,
        _ => after,
    }
}
