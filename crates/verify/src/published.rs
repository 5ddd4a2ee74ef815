//! Values that others have published of a scene, compared with its history.

use dalembert::engine::Motion;
use dalembert::number::{Estimate, Scalar};
use dalembert::quantity::{Units, columns, contact_value};
use dalembert::reason::Warning;
use dalembert::solve::{Numbers, Question, TypedHistory};
use dalembert::{ChainScene, Error, Scene, Target, builtin};

type Double = Estimate<f64>;

/// The published values of one scene.
#[derive(Clone, Debug)]
pub struct PublishedScene {
    /// The name of the scene.
    pub name: String,
    /// The title of the scene.
    pub title: Option<String>,
    /// The units of its values.
    pub units: Units,
    /// The values, in the order of the scene.
    pub values: Vec<ComparedValue>,
    /// The warnings of the history.
    pub warnings: Vec<Warning>,
}

impl PublishedScene {
    /// Compares the values that `scene` lists with its history in doubles, to the accuracy of the scene.
    ///
    /// ```
    /// use dalembert_verify::published::PublishedScene;
    /// // Corollary 1: a contact of the length L = 1 with c = 3 lasts t₁ = 2/3.
    /// let scene = "rod = { length = 1, wave_speed = 3 }\nimpact.speed = 1\n\
    ///              [[target]]\nquantity = 'duration'\npublished = 0.667\nsource = 'by hand'\n";
    /// let compared = PublishedScene::new("contact", &dalembert::Scene::parse(scene)?)?;
    /// assert!(compared.values[0].agrees());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(name: &str, scene: &Scene) -> Result<Self, Error> {
        let (problem, units) = (&scene.problem, Units::new(&scene.problem, scene.units));
        let history: TypedHistory<f64> = problem.answer(&Question::run(Numbers::Double(scene.accuracy)))?;
        let compare = |motion: &dyn Motion<Double>| {
            scene.targets.iter().map(|target| ComparedValue::new(target, motion, &units)).collect()
        };
        let values = history.ask(compare, |_| Vec::new())?;
        let (name, title) = (name.to_string(), scene.title.clone());
        Ok(PublishedScene { name, title, units, values, warnings: history.warnings() })
    }

    /// Compares the values that `scene` lists of each of its bodies; those of a body are called `NAME body N`.
    pub fn of_bodies(name: &str, scene: &ChainScene) -> Result<Vec<Self>, Error> {
        if scene.targets.is_empty() {
            return Ok(Vec::new());
        }
        let bodies = scene.bodies()?;
        let count = bodies.len();
        let listed = bodies.iter().zip(1..).filter(|(scene, _)| !scene.targets.is_empty());
        let named = |body: i32| if count == 1 { name.to_string() } else { format!("{name} body {body}") };
        listed.map(|(scene, body)| Self::new(&named(body), scene)).collect()
    }

    /// Compares every built-in scene that has published values.
    pub fn builtin() -> Result<Vec<Self>, Error> {
        let rods = builtin::ALL.iter().filter_map(|builtin| Some((builtin.name, Scene::parse(builtin.source).ok()?)));
        let rods = rods.filter(|(_, scene)| !scene.targets.is_empty()).map(|(name, scene)| Self::new(name, &scene));
        let mut all: Vec<Self> = rods.collect::<Result<_, _>>()?;
        let chains = builtin::CHAINS.iter();
        for (name, scene) in chains.filter_map(|it| Some((it.name, ChainScene::parse(it.source).ok()?))) {
            all.extend(Self::of_bodies(name, &scene)?);
        }
        Ok(all)
    }

    /// Returns the number of values of `scenes`, and the number of those that agree.
    pub fn count(scenes: &[Self]) -> (usize, usize) {
        let values = || scenes.iter().flat_map(|scene| &scene.values);
        (values().count(), values().filter(|value| value.agrees()).count())
    }
}

/// A published value beside the one of the history.
#[derive(Clone, Debug)]
pub struct ComparedValue {
    /// The quantity that was published, and its source.
    pub target: Target,
    /// The published value.
    pub published: Double,
    /// The value of the history.
    pub ours: Double,
}

impl ComparedValue {
    fn new(target: &Target, motion: &dyn Motion<Double>, units: &Units) -> Result<Self, Error> {
        let ours = match &target.time {
            None => {
                let contact = target.contact - 1;
                let none = |_| Error::NoContact { contact, found: motion.contacts().len() };
                contact_value(motion, units, target.quantity, contact)?.map_err(none)?
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
        Ok(ComparedValue { target: target.clone(), published: Double::from_number(&target.published, &()), ours })
    }

    /// Returns the value of the history minus the published one.
    pub fn difference(&self) -> Double {
        self.ours.clone() - &self.published
    }

    /// Returns whether the difference is within the tolerance of the published value and its own bound.
    pub fn agrees(&self) -> bool {
        let difference = self.difference();
        difference.value().abs() <= self.target.tolerance() + difference.bound()
    }
}

#[cfg(test)]
#[path = "tests/published.rs"]
mod tests;
