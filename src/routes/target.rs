//! What others have published of a scene, held against its history.

use crate::error::Error;
use crate::mapped::try_mapped;
use crate::motion::Motion;
use crate::number::{Estimate, Number, Scalar};
use crate::quantity::{Units, columns, of_contact};
use crate::reason::Warning;
use crate::scene::{Scene, Target, builtin};
use crate::solve::{Numbers, Plan, Question, Solution, unobserved};

/// A scene with its published values and ours.
#[derive(Clone, Debug)]
pub(crate) struct Published {
    /// What it is called.
    pub(crate) scene: String,
    pub(crate) title: Option<String>,
    pub(crate) units: Units,
    pub(crate) reached: Vec<Reached<Estimate<f64>>>,
    pub(crate) warnings: Vec<Warning>,
}

impl Published {
    /// What `scene` lists, beside its history in doubles to its accuracy.
    ///
    /// **Errors**: those of the run, and [`Error::NoContact`].
    pub(crate) fn of(called: &str, scene: &Scene) -> Result<Self, Error> {
        let (problem, units) = (&scene.problem, Units::of(&scene.problem, scene.units));
        let numbers = Numbers::Double(scene.accuracy.as_ref().map(Number::to_f64));
        let history = match Plan::of(problem, &Question::run(numbers))?.solve(problem, unobserved())? {
            Solution::Double(history) => history,
            _ => return Err(Error::NoMultiprecision),
        };
        let gather = |motion: &dyn Motion<Estimate<f64>>| Reached::all(motion, &scene.targets, &units);
        let reached = history.ask(gather, |_| Vec::new())?;
        let (scene, title) = (called.to_string(), scene.title.clone());
        Ok(Published { scene, title, units, reached, warnings: history.warnings() })
    }

    /// Every built-in scene that has published values.
    ///
    /// **Errors**: those of [`of`](Self::of); no built-in scene has any.
    pub(crate) fn builtin() -> Result<Vec<Self>, Error> {
        let scenes = builtin::ALL.iter().filter_map(|builtin| Some((builtin.name, Scene::parse(builtin.source).ok()?)));
        scenes.filter(|(_, scene)| !scene.targets.is_empty()).map(|(name, scene)| Self::of(name, &scene)).collect()
    }

    /// How many values there are, and how many of them agree.
    pub(crate) fn count(all: &[Self]) -> (usize, usize) {
        let reached = || all.iter().flat_map(|published| &published.reached);
        (reached().count(), reached().filter(|reached| reached.agrees()).count())
    }
}

/// A published value and ours.
#[derive(Clone, Debug)]
pub(crate) struct Reached<S> {
    pub(crate) target: Target,
    /// As a number of the history.
    pub(crate) published: S,
    pub(crate) ours: S,
}

impl<S: Scalar> Reached<S> {
    /// What `motion` has for each of `targets`.
    ///
    /// **Errors**: [`Error::NoContact`], and those of the history.
    pub(crate) fn all(motion: &dyn Motion<S>, targets: &[Target], units: &Units) -> Result<Vec<Self>, Error> {
        let precision = motion.end().precision();
        let reached = |target: &Target| {
            Ok(Reached {
                target: target.clone(),
                published: S::from_number(&target.published, &precision),
                ours: ours(motion, target, units)?,
            })
        };
        try_mapped(targets, reached)
    }

    /// Ours less the published value.
    pub(crate) fn difference(&self) -> S {
        self.ours.clone() - &self.published
    }

    /// Whether the difference is within what the published value may be off, and its own bound.
    pub(crate) fn agrees(&self) -> bool {
        let difference = self.difference();
        difference.to_f64().abs() <= self.target.tolerance() + difference.log2_error().exp2()
    }
}

fn ours<S: Scalar>(motion: &dyn Motion<S>, target: &Target, units: &Units) -> Result<S, Error> {
    let Some(time) = &target.time else {
        let contact = target.contact - 1;
        let none = || Error::NoContact { contact, found: motion.contacts().len() };
        return of_contact(motion, units, target.quantity, contact)?.map_err(|_| none());
    };
    let at = |time: S| {
        let mut table = columns(motion, units, &[target.quantity], &[time], Some(target.side))?;
        Ok::<_, Error>(table.remove(0).remove(0))
    };
    let value = at(S::from_number(time, &motion.end().precision()))?;
    Ok(if target.from_start { value - at(motion.end().zero())? } else { value })
}

#[cfg(test)]
#[path = "tests/target.rs"]
mod tests;
