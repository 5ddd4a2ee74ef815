//! Natural scales of a chain, which bounds are held against.

use super::body::Body;
use super::definition::{Chain, End};
use crate::number::{Number, Scalar};
use crate::quantity::Measure;

/// The largest numbers that a chain can be expected to have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    time: f64,
    velocity: f64,
    force: f64,
    /// Length of the longest body.
    length: f64,
}

impl Scales {
    /// Returns the largest number of a measure.
    pub(super) fn of(&self, measure: Measure) -> f64 {
        let Scales { time, velocity, force, length } = self;
        match measure {
            Measure::Time => *time,
            Measure::Length => velocity * time,
            Measure::Velocity => *velocity,
            Measure::Force | Measure::Stress => *force,
            Measure::Impulse => force * time,
            Measure::Energy => force * velocity * time,
            Measure::Strain => velocity * time / length,
        }
    }
}

impl Chain {
    /// Returns the largest number of a measure that the chain can be expected to have.
    pub(crate) fn scale(&self, measure: Measure) -> f64 {
        self.scales().of(measure)
    }

    /// Returns the natural scales of the chain.
    pub(super) fn scales(&self) -> Scales {
        let size = |points: &[(Number, Number)]| points.iter().map(|(_, v)| v.to_f64().abs()).fold(0.0, f64::max);
        let mut velocity = self.gravity.to_f64() * self.until.to_f64();
        let (mut impedance, mut length) = (0.0f64, 0.0f64);
        let mut forces = 0.0f64;
        for body in &self.bodies {
            let [z, c] = body.squares().map(|square| Scalar::to_f64(&square).sqrt());
            let strained = match body.rigid_mass() {
                Some(_) => 0.0,
                None => (size(&body.displacement) / body.length.to_f64()).max(size(&body.strain)) * c,
            };
            velocity = velocity.max(size(&body.velocity)).max(strained);
            (impedance, length) = (impedance.max(z), length.max(body.length.to_f64()));
        }
        for end in &self.ends {
            match end {
                End::Force(points) => forces = forces.max(size(points)),
                End::Velocity(points) | End::Ground { velocity: points, .. } => {
                    velocity = velocity.max(size(points));
                }
                _ => (),
            }
        }
        let lightest =
            self.bodies.iter().filter_map(Body::rigid_mass).map(Number::to_f64).fold(f64::INFINITY, f64::min);
        velocity =
            velocity.max(if impedance > 0.0 { forces / impedance } else { forces / lightest * self.until.to_f64() });
        if impedance == 0.0 {
            (impedance, length) = (lightest / self.until.to_f64(), 1.0);
        }
        let time = self.until.to_f64();
        let force = (impedance * velocity).max(forces);
        Scales { time, velocity, force, length }
    }
}
