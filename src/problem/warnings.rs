//! Warnings that follow from a problem before it is solved.

use super::parameters::touch_speed;
use super::{Material, Parameter, Parameters, Problem, Run, Speed, Start};
use crate::chain::steepest;
use crate::number::Number;
use crate::reason::Warning;

impl Problem {
    /// Returns the warnings that hold for any answer: drag that a fall from `drop_height` leaves out, or that governs
    /// the flights, and strains of a material above 1.
    ///
    /// ```
    /// use dalembert::{Problem, Warning};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(2).drop_height(1).damping(0.1).build()?;
    /// assert_eq!(rod.warnings(), []); // μ = 2, g/2r = 10
    /// let slowed = rod.to_builder().damping(1).build()?; // g/2r = 1
    /// assert!(matches!(slowed.warnings()[..], [Warning::DragNeglected { .. }]));
    /// // Steel in GPa: c = √(210/7800) = 0.16, and μ/c = 6.
    /// let steel = Problem::builder().length(1).modulus(210).density(7800).impact_speed(1).build()?;
    /// assert!(matches!(steel.warnings()[..], [Warning::StrainAboveOne { .. }]));
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn warnings(&self) -> Vec<Warning> {
        let neglected = self.drag_neglected();
        // A fall that is too fast for the drag says it all.
        let dominates = if neglected.is_some() { None } else { self.drag_dominates() };
        neglected.into_iter().chain(dominates).chain(self.strain_warning(0.0)).collect()
    }

    fn drag_neglected(&self) -> Option<Warning> {
        let (damping, gravity) = (self.damping.as_ref()?.to_f64(), self.gravity.as_ref()?.to_f64());
        let Start::Uniform(speed @ Speed::DropHeight(_)) = &self.start else { return None };
        let (speed, terminal) = (speed.value(gravity), gravity / (2.0 * damping));
        (terminal < speed).then_some(Warning::DragNeglected { speed, terminal })
    }

    /// Drag in flights: `h″ + 2r h′ = −g` with `2r μ > g`, where a flight is part of the run that was asked for.
    fn drag_dominates(&self) -> Option<Warning> {
        let damping = self.damping.as_ref()?.to_f64();
        if self.run == Run::Impacts(1) && self.gap().is_none() {
            return None;
        }
        let gravity = self.gravity.as_ref().map_or(0.0, Number::to_f64);
        let speed = self.touch_speed(gravity)?;
        let terminal = (gravity > 0.0).then(|| gravity / (2.0 * damping));
        let reach = speed / (2.0 * damping);
        terminal.is_none_or(|terminal| terminal < speed).then_some(Warning::DragDominates { speed, terminal, reach })
    }

    /// A warning where a strain of a material is above 1: one that is `known`, that of the impact, `μ/c`, or one of the
    /// start.
    pub(crate) fn strain_warning(&self, known: f64) -> Option<Warning> {
        if !matches!(self.material, Material::Elastic { .. }) {
            return None;
        }
        let rod = Parameters::<f64>::of(self, &()).ok()?;
        let impact = self.touch_speed(rod.gravity).unwrap_or(0.0) / rod.wave_speed;
        let slope = steepest(Parameter::Displacement(None).list(self).unwrap_or_default());
        let given =
            Parameter::Strain(None).list(self).unwrap_or_default().iter().map(|(_, strain)| strain.to_f64().abs());
        let strain = given.fold(known.max(impact).max(slope), f64::max);
        (strain > 1.0).then_some(Warning::StrainAboveOne { strain, body: None })
    }

    /// The speed at the first touch under `gravity`, without drag; `None` for a start that is not uniform.
    pub(super) fn touch_speed(&self, gravity: f64) -> Option<f64> {
        match &self.start {
            Start::Uniform(speed) => Some(speed.value(gravity)),
            Start::Above { gap, speed } => Some(touch_speed(gap, speed, gravity)),
            Start::Profile(_) => None,
        }
    }
}
