//! Values that others have published of a scene, beside those of its history.

use dalembert::chain::{ChainHistory, ChainQuery};
use dalembert::number::{Estimate, Number, Scalar};
use dalembert::quantity::{Needs, Quantity, Units};
use dalembert::reason::Warning;
use dalembert::solve::{History, Numbers};
use dalembert::{ChainScene, ChainTarget, Error, Publication, Published, Scene, Side, Target, Value, builtin};

type Double = Estimate<f64>;

/// The published values of one scene.
#[derive(Clone, Debug)]
pub struct PublishedScene {
    /// The name of the scene.
    pub name: String,
    /// The title of the scene.
    pub title: Option<String>,
    /// The comment that the file of the scene begins with: paragraphs.
    pub comment: Vec<String>,
    /// The publication of the scene.
    pub publication: Option<Publication>,
    /// The values, in the order of the scene.
    pub values: Vec<ComparedValue>,
    /// The warnings of the history.
    pub warnings: Vec<Warning>,
}

impl PublishedScene {
    /// Compares the values that `scene` lists with its history in `numbers`; in doubles, to the accuracy of the scene.
    ///
    /// ```
    /// use dalembert_verify::published::PublishedScene;
    /// use dalembert::Numbers;
    /// // Corollary 1: a contact of the length L = 1 with c = 3 lasts t₁ = 2/3.
    /// let scene = "rod = { length = 1, wave_speed = 3 }\nimpact.speed = 1\n\
    ///              [[target]]\nquantity = 'duration'\npublished = 0.667\nsource = 'by hand'\n";
    /// let compared = PublishedScene::new("contact", &dalembert::Scene::parse(scene)?, Numbers::Exact)?;
    /// assert!(compared.values[0].agrees());
    /// assert_eq!(compared.values[0].ours.to_string(), "2/3");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(name: &str, scene: &Scene, numbers: Numbers) -> Result<Self, Error> {
        let of = |_: &Target| String::new();
        let mut published = Self::empty(name, (&scene.title, &scene.publication), scene.source());
        published.add_body(scene, numbers, of)?;
        Ok(published)
    }

    /// Compares the values that a chain lists, of its bodies and of the whole chain.
    pub fn of_chain(name: &str, scene: &ChainScene, numbers: Numbers) -> Result<Self, Error> {
        let mut published = Self::empty(name, (&scene.title, &scene.publication), scene.source());
        if !scene.targets.is_empty() {
            let bodies = scene.bodies()?;
            let several = bodies.len() > 1;
            for (body, number) in bodies.iter().zip(1..) {
                // Targets of a rigid body belong to the whole chain.
                let Some(body) = body.as_ref().filter(|body| !body.targets.is_empty()) else { continue };
                let of = |_: &Target| if several { format!(" of body {number}") } else { String::new() };
                published.add_body(body, numbers, of)?;
            }
        }
        if !scene.chain_targets.is_empty() {
            // Springs and masses have no fractions.
            let numbers = match numbers {
                Numbers::ExactThenDigits(digits) if scene.chain.is_soft() => Numbers::Digits(digits),
                numbers => numbers,
            };
            let history = scene.chain.solve(numbers)?;
            for target in &scene.chain_targets {
                published.values.push(ComparedValue {
                    label: target.label(),
                    unit: scene.unit(target.quantity.measure()),
                    time: target.time.clone(),
                    published: target.published.clone(),
                    ours: chain_value(&history, target)?,
                });
            }
            published.warnings.extend(history.warnings());
        }
        Ok(published)
    }

    fn empty(name: &str, (title, publication): (&Option<String>, &Option<Publication>), source: &str) -> Self {
        let (title, publication) = (title.clone(), publication.clone());
        let (values, warnings) = (Vec::new(), Vec::new());
        PublishedScene { name: name.to_string(), title, comment: comment(source), publication, values, warnings }
    }

    /// Compares the values of a rod, or of a body of a chain, whose labels end with `of`.
    fn add_body(&mut self, scene: &Scene, numbers: Numbers, of: impl Fn(&Target) -> String) -> Result<(), Error> {
        let numbers = match numbers {
            Numbers::Double(None) => Numbers::Double(scene.accuracy),
            numbers => numbers,
        };
        let history = scene.problem.solve_in(numbers)?.in_units(scene.units);
        let units = Units::new(&scene.problem, scene.units);
        for target in &scene.targets {
            self.values.push(ComparedValue {
                label: target.label() + &of(target),
                unit: target.quantity.unit(&units),
                time: target.time.clone(),
                published: target.published.clone(),
                ours: rod_value(&history, target)?,
            });
        }
        self.warnings.extend(history.warnings());
        Ok(())
    }

    /// Compares every built-in scene that has published values, in `numbers`.
    pub fn builtin(numbers: Numbers) -> Result<Vec<Self>, Error> {
        let rods = builtin::ALL.iter().filter_map(|builtin| Some((builtin.name, Scene::parse(builtin.source).ok()?)));
        let rods = rods.filter(|(_, scene)| !scene.targets.is_empty());
        let rods = rods.map(|(name, scene)| Self::new(name, &scene, numbers));
        let chains = builtin::CHAINS.iter().filter_map(|it| Some((it.name, ChainScene::parse(it.source).ok()?)));
        let chains = chains.filter(|(_, scene)| !(scene.targets.is_empty() && scene.chain_targets.is_empty()));
        rods.chain(chains.map(|(name, scene)| Self::of_chain(name, &scene, numbers))).collect()
    }

    /// Returns the number of values of `scenes`, and the number of those that are as their scene expects.
    pub fn count(scenes: &[Self]) -> (usize, usize) {
        let values = || scenes.iter().flat_map(|scene| &scene.values);
        (values().count(), values().filter(|value| value.is_expected()).count())
    }
}

/// Returns the paragraphs of the comment that a file begins with.
fn comment(source: &str) -> Vec<String> {
    let lines = source.lines().map_while(|line| line.strip_prefix('#')).map(str::trim);
    let mut paragraphs = vec![String::new()];
    for line in lines {
        match (line, paragraphs.last_mut()) {
            ("", _) => paragraphs.push(String::new()),
            (line, Some(last)) if last.is_empty() => *last += line,
            (line, Some(last)) => *last += &format!(" {line}"),
            (_, None) => (),
        }
    }
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    paragraphs
}

/// A published value beside the one of the history.
#[derive(Clone, Debug)]
pub struct ComparedValue {
    /// The quantity in words: `u_top from the start`, `release.1`.
    pub label: String,
    /// The name of the unit; empty if it is not known or there is none.
    pub unit: &'static str,
    /// The time, for a quantity over time.
    pub time: Option<Number>,
    /// The published value.
    pub published: Published,
    /// The value of the history.
    pub ours: Value,
}

/// Returns the value of the history of a rod.
fn rod_value(history: &History, target: &Target) -> Result<Value, Error> {
    let Some(time) = &target.time else {
        let (contact, mut rows) = (target.contact - 1, history.list(&[target.quantity])?);
        let found = rows.len();
        let none = Error::NoContact { contact, found };
        if contact >= found || target.quantity.needs() != Needs::Contact {
            return Err(none);
        }
        return rows.swap_remove(contact).remove(0).map_err(|_| none);
    };
    let value = at(history, target.quantity, time, target.side)?;
    if !target.from_start {
        return Ok(value);
    }
    Ok(minus(&value, &at(history, target.quantity, &Number::from(0), target.side)?))
}

fn at(history: &History, quantity: Quantity, time: &Number, side: Side) -> Result<Value, Error> {
    history.at_time(quantity, time.clone(), side)
}

/// Returns the value of the history of a chain.
fn chain_value(history: &ChainHistory, target: &ChainTarget) -> Result<Value, Error> {
    match (target.quantity, &target.time) {
        (ChainQuery::Column(column), Some(time)) => history.value(column, time, target.side),
        (ChainQuery::Column(column), None) => history.value(column, &Number::from(0), target.side),
        (ChainQuery::Contact(node, quantity), _) => history.contact_value(node, quantity, target.contact - 1),
    }
}

/// Returns a value in doubles.
fn double(value: &Value) -> Double {
    Double::rounded(value.to_f64(), 1.0).widened(&Double::exact(value.bound().to_f64()))
}

/// Returns the difference of two values: a fraction if both are, or else doubles.
fn minus(a: &Value, b: &Value) -> Value {
    match (a.as_rational(), b.as_rational()) {
        (Some(a), Some(b)) => (a.clone() - b).into(),
        _ => (double(a) - double(b)).into(),
    }
}

impl ComparedValue {
    /// Returns the published value.
    pub fn theirs(&self) -> Double {
        Double::from_number(&self.published.value, &())
    }

    /// Returns the value of the history minus the published one, in doubles.
    pub fn difference(&self) -> Double {
        double(&self.ours) - self.theirs()
    }

    /// Returns whether the difference is within the tolerance of the published value and its own bound.
    pub fn agrees(&self) -> bool {
        let difference = self.difference();
        difference.value().abs() <= self.published.tolerance() + difference.bound()
    }

    /// Returns whether the value agrees, or differs where the scene says so.
    pub fn is_expected(&self) -> bool {
        self.agrees() != self.published.differs
    }
}

#[cfg(test)]
#[path = "tests/published.rs"]
mod tests;
