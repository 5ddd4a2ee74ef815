//! Natural scales of a chain, which bounds are held against, and the warning of strains beyond them.

use super::body::{Body, BodyMaterial, Points, steepest};
use super::definition::{Chain, End};
use crate::number::{Number, Scalar};
use crate::quantity::Measure;
use crate::reason::Warning;

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

impl Chain {
    /// Returns the warning of a bar with a material that the speeds, strains and loads given would strain above 1: it
    /// would fold, as where a modulus is given in GPa beside a density in kg/m³.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain};
    /// let steel = |modulus: &str| Body::elastic(1.into(), modulus.parse().unwrap(), 7800.into(), 1.into());
    /// let chain = |modulus| {
    ///     let moving = steel(modulus).with_velocity((-1).into());
    ///     Chain::builder(steel(modulus)).contact(0.into(), moving).until(1.into()).build()
    /// };
    /// assert!(chain("210e9")?.strain_warning().is_none());
    /// assert!(chain("210")?.strain_warning().is_some());
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn strain_warning(&self) -> Option<Warning> {
        let size = |points: &Points| points.iter().map(|(_, v)| v.to_f64().abs()).fold(0.0, f64::max);
        let ends = self.ends.iter().map(|end| match end {
            End::Force(points) => [0.0, size(points)],
            End::Velocity(points) | End::Ground { velocity: points, .. } => [size(points), 0.0],
            End::Free | End::Infinite { .. } => [0.0, 0.0],
        });
        let [speed, force] = ends.fold([0.0f64; 2], |[a, b], [c, d]| [a.max(c), b.max(d)]);
        let speed = self.bodies.iter().map(|body| size(&body.velocity)).fold(speed, f64::max);
        let strained = |body: &Body| {
            if !matches!(body.material, BodyMaterial::Elastic { .. }) {
                return 0.0;
            }
            let [impedance, wave_speed] = body.squares().map(|square| Scalar::to_f64(&square).sqrt());
            let slope = steepest(&body.displacement);
            (speed / wave_speed).max(force / (impedance * wave_speed)).max(slope).max(size(&body.strain))
        };
        let strains = self.bodies.iter().map(strained).zip(1..);
        let (strain, body) = strains.max_by(|(a, _), (b, _)| a.total_cmp(b)).filter(|(strain, _)| *strain > 1.0)?;
        Some(Warning::StrainAboveOne { strain, body: Some(body) })
    }
}
