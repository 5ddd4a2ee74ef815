//! The exact side of a comparison: values, jumps and contacts of a history.

use super::contacts::ContactRecord;
use super::norms::Grid;
use super::samples::TimeRounding;
use dalembert::Error;
use dalembert::engine::{Motion, RayRegister};
use dalembert::number::{Estimate, Number, Scalar};
use dalembert::problem::{Material, Parameters};
use dalembert::quantity::{Measure, Quantity};
use dalembert::solve::TypedHistory;
use dalembert::special::gauss_legendre;
use dalembert::{Field, Side, StressPiece};

/// A history with the times at which rays are at the ground.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    pub(super) history: &'a TypedHistory<f64>,
    rod: Parameters<f64>,
    modulus: f64,
    density: f64,
    area: f64,
    pieces: Vec<StressPiece<f64>>,
    /// The times at which `v_t(0,·)` or `v_x(0,·)` jumps, ascending.
    jumps: Vec<f64>,
    /// The start, and the times at which contact begins or ends.
    switches: Vec<f64>,
    /// The times at which rays leave the ground, and those at which they leave the top, ascending: also times before
    /// the start, for rays that begin inside the rod.
    departures: [Vec<f64>; 2],
}

/// The rays near the samples of a column.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearRays<'a> {
    /// The time of the nearest ray for each sample; empty for a quantity without jumps.
    pub(super) times: &'a [f64],
    pub(super) rounding: &'a TimeRounding,
    /// The limit that each row holds, where that is known.
    pub(super) sides: &'a [Option<Side>],
}

/// A factor that is often forgotten, with the question that asks for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownFactor {
    pub(super) value: f64,
    pub(super) question: &'static str,
}

/// Smallest jump that counts, relative to the scale of velocities.
const LEAST_JUMP: f64 = 1e-9;

impl<'a> Reference<'a> {
    /// Collects the jumps and the pieces of a history.
    ///
    /// **Source**: the register of rays, of which those count at the ground where the two limits differ; for a body of
    /// a chain, the rays that leave its ends.
    pub(super) fn new(history: &'a TypedHistory<f64>) -> Result<Self, Error> {
        let problem = history.problem();
        let rod = Parameters::<f64>::of(problem, &())?;
        let (modulus, density, area) = match problem.material() {
            Material::WaveSpeed(_) => (rod.wave_speed * rod.wave_speed, 1.0, 1.0),
            Material::Elastic { modulus, density, area } => {
                (modulus.to_f64(), density.to_f64(), area.as_ref().map_or(1.0, Number::to_f64))
            }
        };
        let pieces = history.stress_history()?.pieces;
        let half = rod.round_trip() / 2.0;
        let at_ground = |from: f64, to: f64| {
            let rays = |motion: &dyn Motion<Estimate<f64>>| {
                Ok(RayRegister::of(motion).passing(&motion.end().zero(), from, to))
            };
            let rays = history.ask(rays, |_| Vec::new())?;
            Ok::<Vec<f64>, Error>(rays.into_iter().map(|ray| ray.time.into_value()).collect())
        };
        let least = LEAST_JUMP * history.scales().velocity;
        // The rays of a body of a chain come from its neighbours too.
        let own = |motion: &dyn Motion<Estimate<f64>>| match motion.departures() {
            Err(Error::NoWaves) => Ok(None),
            departures => Ok(Some(departures?)),
        };
        let own = history.ask(own, |_| Vec::new())?.map(|ends| {
            ends.map(|rays| {
                let rays = rays.into_iter().filter(|(_, jump)| jump.value().abs() > least);
                rays.map(|(time, _)| time.into_value()).collect::<Vec<f64>>()
            })
        });
        let (jumps, departures) = match own {
            Some([up, down]) => {
                let times = up.iter().copied().chain(down.iter().map(|time| time + half));
                let mut jumps: Vec<f64> = times.filter(|time| (0.0..=*history.end()).contains(time)).collect();
                jumps.sort_by(f64::total_cmp);
                (jumps, [up, down])
            }
            None => {
                let candidates = at_ground(0.0, *history.end())?;
                let seen = [Quantity::EndVelocity, Quantity::Strain];
                let [before, after] =
                    [Side::Left, Side::Right].map(|side| history.columns(&seen, &candidates, Some(side)));
                let (before, after) = (before?, after?);
                let jump = |column: usize, k: usize| (before[column][k] - after[column][k]).abs();
                let differ = |k: usize| jump(0, k).max(jump(1, k) * rod.wave_speed) > least;
                let jumps: Vec<f64> =
                    candidates.iter().enumerate().filter(|(k, _)| differ(*k)).map(|(_, at)| *at).collect();
                let mut up = at_ground(-rod.round_trip(), 0.0)?;
                up.retain(|time| *time < 0.0);
                up.extend(&jumps);
                let down = up.iter().map(|time| time + half).collect();
                (jumps, [up, down])
            }
        };
        let events = history.events().iter().map(|event| event.t);
        let switches = std::iter::once(0.0).chain(events).collect();
        Ok(Reference { history, rod, modulus, density, area, pieces, jumps, switches, departures })
    }

    /// Returns `ρS`, or 1 where forces are per `ρS`.
    pub(super) fn line_density(&self) -> f64 {
        self.density * self.area
    }

    /// Returns `ρS L`, or `L` where forces are per `ρS`.
    pub(super) fn mass(&self) -> f64 {
        self.line_density() * self.rod.length
    }

    /// Returns the values of the rod itself.
    pub(super) fn rod(&self) -> &Parameters<f64> {
        &self.rod
    }

    /// Returns the factor from a stress or strain at the ground to the force of the ground; 1 for other quantities.
    pub(super) fn force_factor(&self, what: Quantity) -> f64 {
        match what {
            Quantity::Strain => -self.modulus * self.area,
            Quantity::Stress => -self.area,
            _ => 1.0,
        }
    }

    /// Returns the values of every quantity on `grid`; the limit from later times at a jump.
    pub(super) fn values(&self, whats: &[Quantity], grid: &Grid) -> Result<Vec<Vec<f64>>, Error> {
        self.values_at(whats, grid.points.as_deref(), &grid.times, Side::Right)
    }

    /// Returns the values of every quantity at `times`; for a field, each at the point of the same place in the list.
    fn values_at(
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
                    values.push(self.component(*what, &field));
                }
            }
        }
        Ok(all)
    }

    fn component(&self, what: Quantity, field: &Field<f64>) -> f64 {
        match what.measure() {
            Some(Measure::Velocity) => field.velocity,
            Some(Measure::Strain) => field.strain,
            Some(Measure::Stress) => self.modulus * field.strain,
            _ => field.displacement,
        }
    }

    /// Replaces the exact values `ours` at samples on a jump by the limit that their row holds, or by the limit nearer
    /// to the data where that is not known, and returns the number of those samples.
    pub(super) fn choose_limits(
        &self,
        what: Quantity,
        grid: &Grid,
        near: NearRays<'_>,
        theirs: &[f64],
        ours: &mut [f64],
    ) -> Result<usize, Error> {
        let mut count = 0;
        for (k, (ray, time)) in near.times.iter().zip(&grid.times).enumerate() {
            if (ray - time).abs() > near.rounding.most || (ray - time).abs() > near.rounding.at(*time) {
                continue;
            }
            let point = grid.points.as_ref().map(|points| &points[k..=k]);
            let limit = |time: f64, side| Ok::<f64, Error>(self.values_at(&[what], point, &[time], side)?[0][0]);
            let limits = |time: f64| Ok::<_, Error>((limit(time, Side::Left)?, limit(time, Side::Right)?));
            let at_ray = limits(ray.max(0.0))?;
            count += usize::from(at_ray.0 != at_ray.1);
            let mut candidates = vec![at_ray.0, at_ray.1];
            if let Some(side) = near.sides[k] {
                let of_side = |(left, right): (f64, f64)| if side == Side::Left { left } else { right };
                let own = limits(*time)?;
                ours[k] = of_side(own);
                // The jump is at the time of the row, or it may be a rounding of it away.
                candidates = if own.0 == own.1 { vec![of_side(at_ray)] } else { Vec::new() };
            }
            for limit in candidates {
                if (theirs[k] - limit).abs() < (theirs[k] - ours[k]).abs() {
                    ours[k] = limit;
                }
            }
        }
        Ok(count)
    }

    /// Returns the time nearest to `time` at which a ray passes the point `travel` in time away from the ground;
    /// infinite where none does.
    fn nearest_ray_at(&self, travel: f64, time: f64) -> f64 {
        let [up, down] = &self.departures;
        let ways = [(up, travel), (down, self.rod.round_trip() / 2.0 - travel)];
        let ways = ways.map(|(departures, delay)| nearest(departures, time - delay) + delay);
        if (ways[0] - time).abs() < (ways[1] - time).abs() { ways[0] } else { ways[1] }
    }

    /// Returns for each sample the time nearest to it at which a ray passes the point of the quantity; infinite where
    /// none does, and no times for a quantity without jumps.
    pub(super) fn nearest_rays(&self, what: Quantity, grid: &Grid) -> Vec<f64> {
        if !what.jumps() {
            return Vec::new();
        }
        let at = |(k, time): (usize, &f64)| match (what, &grid.points) {
            // Contact begins and ends without a jump of the stress too.
            (Quantity::Contact, _) => nearest(&self.switches, *time),
            (Quantity::TopDisplacement | Quantity::TopVelocity | Quantity::TopForce, _) => {
                self.nearest_ray_at(self.rod.round_trip() / 2.0, *time)
            }
            (_, Some(points)) => self.nearest_ray_at(points[k] / self.rod.wave_speed, *time),
            _ => nearest(&self.jumps, *time),
        };
        grid.times.iter().enumerate().map(at).collect()
    }

    /// Returns `time`, or the time `distance` beside the ray at either end of the rod that is nearer than that.
    pub(super) fn away_from_rays(&self, time: f64, distance: f64) -> f64 {
        let end = *self.history.end();
        let moved = |time: f64, ray: f64| match time - ray {
            apart if apart.abs() >= distance => time,
            apart if apart < 0.0 || ray + distance > end => ray - distance,
            _ => ray + distance,
        };
        let time = moved(time, nearest(&self.jumps, time));
        moved(time, self.nearest_ray_at(self.rod.round_trip() / 2.0, time))
    }

    /// Returns the scale of a displacement, a velocity or the force at the top, which is zero where that is free; zero
    /// for other quantities, whose zeros are exact.
    pub(super) fn scale(&self, what: Quantity) -> f64 {
        let scales = self.history.scales();
        match what.measure() {
            Some(Measure::Length) => scales.velocity * scales.time,
            Some(Measure::Velocity) => scales.velocity,
            _ if what == Quantity::TopForce => self.line_density() * scales.wave_speed * scales.velocity,
            _ => 0.0,
        }
    }

    /// Returns the displacements at `t = 0`, one for all samples or one for each; `None` for other quantities.
    pub(super) fn start(&self, what: Quantity, points: Option<&[f64]>) -> Result<Option<Vec<f64>>, Error> {
        let times = vec![0.0; points.map_or(1, <[f64]>::len)];
        if what.has_origin() { Ok(self.values_at(&[what], points, &times, Side::Right)?.pop()) } else { Ok(None) }
    }

    /// Returns the contacts with the moments of their force.
    ///
    /// **Accuracy**: a piece of degree n is integrated by a rule that is exact for `t²` times it.
    pub(super) fn contacts(&self) -> Vec<ContactRecord> {
        let factor = self.force_factor(Quantity::Strain);
        let mut pieces = self.pieces.iter().peekable();
        let mut contacts = Vec::new();
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
            let record = ContactRecord::with_force(contact.impact, contact.release, force.into_iter());
            let peak = record.peak_force.map(|peak| peak.max(factor * contact.peak_strain));
            contacts.push(ContactRecord {
                impulse: Some(self.line_density() * contact.impulse),
                peak_force: peak,
                ..record
            });
        }
        contacts
    }

    /// Returns the shortest separation that is not chatter: a quarter of the round trip, or of the shortest flight that
    /// ends before `last`.
    pub(super) fn shortest_separation(&self, last: f64) -> f64 {
        let contacts = self.history.contacts();
        let contacts = &contacts[..contacts.partition_point(|contact| contact.impact <= last)];
        let flights = contacts.windows(2).filter_map(|pair| pair[0].release.map(|to| pair[1].impact - to));
        flights.fold(self.rod.round_trip(), f64::min) / 4.0
    }

    /// Returns the factors of a quantity that are often forgotten.
    pub(super) fn known_factors(&self, what: Quantity) -> Vec<KnownFactor> {
        let Reference { modulus, density, area, .. } = self;
        let mut known = match what {
            energy if energy.measure() == Some(Measure::Energy) => {
                vec![(2.0, "is ½ missing?"), (0.5, "is ½ there twice?")]
            }
            Quantity::Force | Quantity::TopForce => vec![(1.0 / area, "is it a stress?")],
            Quantity::Stress => vec![(*area, "is it a force?"), (1.0 / modulus, "is it a strain?")],
            Quantity::Strain => vec![(*modulus, "is it a stress?")],
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
        known.into_iter().map(|(value, question)| KnownFactor { value, question }).collect()
    }
}

/// Returns the nearest of ascending times; infinite where there is none.
fn nearest(times: &[f64], time: f64) -> f64 {
    let next = times.partition_point(|at| *at < time);
    let after = times.get(next).copied().unwrap_or(f64::INFINITY);
    match next.checked_sub(1).map(|before| times[before]) {
        Some(before) if time - before <= after - time => before,
        _ => after,
    }
}
