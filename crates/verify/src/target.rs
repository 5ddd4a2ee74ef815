//! What others have published of a scene, held against its history.

use dalembert::Error;
use dalembert::engine::Motion;
use dalembert::number::{Estimate, Scalar};
use dalembert::quantity::{Units, columns, of_contact};
use dalembert::reason::Warning;
use dalembert::solve::{Numbers, Question, TypedHistory};
use dalembert::{Scene, Target, builtin};

type Double = Estimate<f64>;

#[derive(Clone, Debug)]
pub struct Published {
    pub scene: String,
    pub title: Option<String>,
    pub units: Units,
    pub reached: Vec<Reached>,
    pub warnings: Vec<Warning>,
}

impl Published {
    /// What `scene` lists, beside its history in doubles to its accuracy.
    pub fn of(called: &str, scene: &Scene) -> Result<Self, Error> {
        let (problem, units) = (&scene.problem, Units::of(&scene.problem, scene.units));
        let history: TypedHistory<f64> = problem.answer(&Question::run(Numbers::Double(scene.accuracy)))?;
        let reached = |motion: &dyn Motion<Double>| {
            scene.targets.iter().map(|target| Reached::of(target, motion, &units)).collect()
        };
        let reached = history.ask(reached, |_| Vec::new())?;
        let (scene, title) = (called.to_string(), scene.title.clone());
        Ok(Published { scene, title, units, reached, warnings: history.warnings() })
    }

    /// Every built-in scene that has published values.
    pub fn builtin() -> Result<Vec<Self>, Error> {
        let scenes = builtin::ALL.iter().filter_map(|builtin| Some((builtin.name, Scene::parse(builtin.source).ok()?)));
        scenes.filter(|(_, scene)| !scene.targets.is_empty()).map(|(name, scene)| Self::of(name, &scene)).collect()
    }

    /// How many values there are, and how many of them agree.
    pub fn count(all: &[Self]) -> (usize, usize) {
        let reached = || all.iter().flat_map(|published| &published.reached);
        (reached().count(), reached().filter(|reached| reached.agrees()).count())
    }
}

#[derive(Clone, Debug)]
pub struct Reached {
    pub target: Target,
    /// As a number of the history.
    pub published: Double,
    pub ours: Double,
}

impl Reached {
    fn of(target: &Target, motion: &dyn Motion<Double>, units: &Units) -> Result<Self, Error> {
        let ours = match &target.time {
            None => {
                let contact = target.contact - 1;
                let none = |_| Error::NoContact { contact, found: motion.contacts().len() };
                of_contact(motion, units, target.quantity, contact)?.map_err(none)?
            }
            Some(time) => {
                let at = |time: Double| {
                    columns(motion, units, &[target.quantity], &[time], Some(target.side))
                        .map(|mut t| t.remove(0).remove(0))
                };
                let value = at(Double::from_number(time, &()))?;
                if target.from_start { value - at(Double::exact(0.0))? } else { value }
            }
        };
        Ok(Reached { target: target.clone(), published: Double::from_number(&target.published, &()), ours })
    }

    /// Ours less the published value.
    pub fn difference(&self) -> Double {
        self.ours.clone() - &self.published
    }

    /// Whether the difference is within what the published value may be off, and its own bound.
    pub fn agrees(&self) -> bool {
        let difference = self.difference();
        difference.value().abs() <= self.target.tolerance() + difference.bound()
    }
}

#[cfg(test)]
#[path = "tests/target.rs"]
mod tests;
