//! Register of rays: the times at which each ray passes a point.

use super::Motion;
use super::listed_rays::ListedRays;
use super::passing::Passing;
use super::repeated_rays::RepeatedRays;
use crate::number::Scalar;

/// The times at which rays pass the points of a rod or of a body of a chain.
///
/// **Accuracy**: each time is known within the bound that it carries; no other tolerance distinguishes two rays.
#[derive(Clone, Debug)]
pub struct RayRegister<S> {
    rays: Rays<S>,
    end: S,
}

#[derive(Clone, Debug)]
enum Rays<S> {
    /// The rays of a rod by itself.
    Repeated(RepeatedRays<S>),
    /// The rays of a body of a chain.
    Listed(ListedRays<S>),
}

impl<S: Scalar> RayRegister<S> {
    /// Returns the rays of `motion`.
    pub fn of(motion: &dyn Motion<S>) -> Self {
        let rays = match motion.departures() {
            Ok(ends) => Rays::Listed(ListedRays::new(motion, ends)),
            // Only a body of a chain lists its rays.
            Err(_) => Rays::Repeated(RepeatedRays::of(motion)),
        };
        RayRegister { rays, end: motion.end() }
    }

    /// Returns the rays whose times are known to `roundings` roundings, and the displaced rays, those of greater error.
    /// Of a rod by itself the former are the rays of the start.
    pub(crate) fn parted(motion: &dyn Motion<S>, roundings: f64) -> [Self; 2] {
        let parts = match motion.departures() {
            Ok(ends) => ListedRays::new(motion, ends).parted(roundings).map(Rays::Listed),
            Err(_) => RepeatedRays::parted(motion, roundings).map(Rays::Repeated),
        };
        parts.map(|rays| RayRegister { rays, end: motion.end() })
    }

    /// Returns the time of a ray at `point` within `roundings` plus the ray's own bound of `time`, or else `time`.
    pub fn meant(&self, point: &S, time: S, roundings: f64) -> S {
        let known = |(met, _): &(S, bool)| self.end.below(met) != Ok(true);
        self.within(point, &time, roundings).into_iter().find(known).map_or(time, |(met, _)| met)
    }

    /// Returns the point that a ray reaches at `time`, if it passes `point` within `roundings` plus the ray's own bound
    /// of `time`, or else `point`.
    pub(crate) fn reached(&self, point: S, time: &S, roundings: f64) -> S {
        let wave_speed = match &self.rays {
            Rays::Repeated(rays) => &rays.wave_speed,
            Rays::Listed(rays) => &rays.wave_speed,
        };
        match self.within(&point, time, roundings).first() {
            Some((met, true)) => (time.clone() - met) * wave_speed + point,
            Some((met, false)) => (met.clone() - time) * wave_speed + point,
            None => point,
        }
    }

    /// Returns the times of rays at `point` within `roundings` plus the ray's own bound of `time`, each with whether
    /// the ray goes upward.
    fn within(&self, point: &S, time: &S, roundings: f64) -> Vec<(S, bool)> {
        let mut about = match &self.rays {
            Rays::Repeated(rays) => rays.about(point, time, 0.0),
            Rays::Listed(rays) => rays.about(point, time),
        };
        about.retain(|(met, _)| {
            let bound = met.log2_error().exp2();
            let known = roundings + if bound.is_finite() { bound } else { 0.0 };
            (met.clone() - time).to_f64().abs() <= known
        });
        about
    }

    /// Returns the times at which rays pass `point` that are indistinguishable from `time` within both bounds.
    pub fn near(&self, point: &S, time: &S) -> Vec<S> {
        match &self.rays {
            Rays::Repeated(rays) => rays.near(point, time),
            Rays::Listed(rays) => rays.near(point, time),
        }
    }

    /// Returns the rays that pass `point` from one time to another, in order. At the ground a rod by itself has rays
    /// from the start that have never been there, as if they had left it before.
    pub fn passing(&self, point: &S, from: f64, to: f64) -> Vec<Passing<S>> {
        match &self.rays {
            Rays::Repeated(rays) => rays.passing(point, from, to),
            Rays::Listed(rays) => rays.passing(point, from, to),
        }
    }
}
