//! A case of the catalogue: its rods, questions and routes.

use std::time::Instant;

use super::verdict::{CheckedRoute, Outcome, Promise, Verdict};
use crate::error::VerifyError;
use crate::paper::PrintedIntegrals;
use crate::paper::formulas::Constant;
use crate::routes::{Route, RouteQuestion, Transform, Truth};
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{Quantity, Units, ValueQuery};
use dalembert::solve::Numbers;
use dalembert::{Scene, Side};

/// A problem of the catalogue, with its numbers as text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rod {
    pub(super) length: &'static str,
    pub(super) wave_speed: &'static str,
    pub(super) damping: &'static str,
    pub(super) gravity: &'static str,
    pub(super) speed: &'static str,
    /// Time up to which the rod is followed; empty for the first contact and the flight after it.
    pub(super) until: &'static str,
    /// A whole scene in place of the other fields, or empty.
    pub(super) scene: &'static str,
}

/// Builds the rod of `c = L = g = 1`.
pub(super) const fn unit(damping: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "", scene: "" }
}

impl Rod {
    pub(super) const fn weightless(self) -> Rod {
        Rod { gravity: "0", ..self }
    }

    pub(super) const fn until(self, until: &'static str) -> Rod {
        Rod { until, ..self }
    }

    pub(super) const fn from_scene(scene: &'static str) -> Rod {
        Rod { scene, ..unit("0", "1") }
    }

    fn problem(&self) -> Result<Problem, VerifyError> {
        if !self.scene.is_empty() {
            return Ok(Scene::parse(self.scene)?.problem);
        }
        let number = |text: &str| text.parse::<Number>();
        let (gravity, speed) = (number(self.gravity)?, number(self.speed)?);
        let mut problem = Problem::uniform(number(self.length)?, number(self.wave_speed)?, gravity, speed);
        problem = problem.to_builder().damping(number(self.damping)?).build()?;
        if !self.until.is_empty() {
            problem = problem.with_run(Run::Time(number(self.until)?))?;
        }
        Ok(problem)
    }
}

/// A route and its promise.
pub(super) type PromisedRoute = (Route, Promise);

const MOST_FORMULAS: usize = 4;

/// A question of the catalogue, its truth, and the routes to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct CaseQuestion {
    /// The question in words: `t_b`, `h(3)`.
    label: &'static str,
    rod: Rod,
    quantity: Quantity,
    /// x, or empty.
    point: &'static str,
    /// t; empty for `t_b`.
    time: &'static str,
    side: Side,
    transform: Transform,
    /// A text for [`Truth::from_text`], or [`super::verdict::NO_BOUNCE`].
    pub(super) truth: &'static str,
    /// Routes of this question alone, shown before the others.
    formulas: [Option<PromisedRoute>; MOST_FORMULAS],
    routes: &'static [PromisedRoute],
}

/// Builds a question at `t_b`, or one without a time.
pub(super) const fn ask(
    label: &'static str,
    rod: Rod,
    quantity: Quantity,
    truth: &'static str,
    routes: &'static [PromisedRoute],
) -> CaseQuestion {
    let (side, transform, formulas) = (Side::Right, Transform::Identity, [None; MOST_FORMULAS]);
    CaseQuestion { label, rod, quantity, point: "", time: "", side, transform, truth, formulas, routes }
}

/// Builds a question about a number that belongs to no rod, and that only formulas give.
pub(super) const fn constant(label: &'static str, truth: &'static str) -> CaseQuestion {
    ask(label, unit("0", "1"), Quantity::BounceTime, truth, &[])
}

impl CaseQuestion {
    /// Asks at `time`, in the limit from later times.
    pub(super) const fn at(self, time: &'static str) -> Self {
        CaseQuestion { time, ..self }
    }

    /// Asks at `time`, in the limit from earlier times.
    pub(super) const fn before(self, time: &'static str) -> Self {
        CaseQuestion { time, side: Side::Left, ..self }
    }

    /// Asks at `point` and `time`.
    pub(super) const fn at_point(self, point: &'static str, time: &'static str) -> Self {
        CaseQuestion { point, time, ..self }
    }

    /// Asks for a function of the answer.
    pub(super) const fn transformed(self, transform: Transform) -> Self {
        CaseQuestion { transform, ..self }
    }

    /// Adds a formula in doubles that gives this many digits.
    pub(super) const fn by(self, name: &'static str, digits: u32, formula: fn() -> f64) -> Self {
        self.with_formula((Route::Formula(name, formula), Promise::Digits(digits)))
    }

    /// Adds a formula in doubles that gives fewer digits than this.
    pub(super) const fn breaks(self, name: &'static str, digits: u32, formula: fn() -> f64) -> Self {
        self.with_formula((Route::Formula(name, formula), Promise::Fewer(digits)))
    }

    /// Adds a constant of the paper in 36 digits.
    pub(super) const fn by_digits(self, name: &'static str, constant: Constant) -> Self {
        self.with_formula((Route::Constant(name, constant), Promise::Digits(36)))
    }

    const fn with_formula(mut self, formula: PromisedRoute) -> Self {
        let mut place = 0;
        while self.formulas[place].is_some() {
            place += 1;
        }
        self.formulas[place] = Some(formula);
        self
    }

    fn question(&self) -> Result<RouteQuestion, VerifyError> {
        let number = |text: &str| (!text.is_empty()).then(|| text.parse::<Number>()).transpose();
        let (point, time) = (number(self.point)?, number(self.time)?);
        let query = ValueQuery { quantity: self.quantity, point, time, side: self.side };
        Ok(RouteQuestion { problem: self.rod.problem()?, query, units: Units::default(), transform: self.transform })
    }

    /// Takes every route.
    pub(super) fn check(&self) -> CheckedQuestion {
        let truth = Truth::from_text(self.truth);
        let question = self.question();
        let routes = self.formulas.iter().flatten().chain(self.routes);
        let routes = routes.map(|(route, promise)| {
            let start = Instant::now();
            let answer =
                question.as_ref().map_err(Clone::clone).and_then(|question| route.run(question, f64::INFINITY));
            let seconds = start.elapsed().as_secs_f64();
            let digits = truth.as_ref().and_then(|truth| Some(truth.right_digits(answer.as_ref().ok()?)));
            let outcome = promise.outcome(truth.as_ref(), &answer, digits.unwrap_or(0.0));
            CheckedRoute { route: description(*route), answer, promise: *promise, digits, outcome, seconds }
        });
        CheckedQuestion { label: self.label, truth: self.truth, routes: routes.collect() }
    }
}

/// Describes a route as the catalogue shows it.
fn description(route: Route) -> String {
    match route {
        Route::Formula(name, _) => format!("{name}, plain doubles"),
        Route::Constant(name, _) => format!("{name}, 36 digits"),
        Route::ClosedForm(Numbers::Digits(digits)) => format!("closed form, {digits} digits"),
        Route::ClosedForm(_) => "closed form, doubles".into(),
        Route::PrintedForms => "printed form, fractions".into(),
        Route::PrintedIntegrals(_) => "printed integrals, doubles".into(),
        Route::Modes(_) => "modal sum, doubles".into(),
        Route::Lattice(Numbers::Exact) => "lattice, fractions".into(),
        Route::Lattice(_) => "lattice, doubles".into(),
        Route::Cells(_) => "cells, doubles".into(),
        Route::Differences(_) => "finite differences".into(),
        Route::Planned(Numbers::Double(Some(accuracy))) => format!("the plan, to {accuracy:e}"),
        Route::Planned(Numbers::Digits(digits)) => format!("the plan, {digits} digits"),
        Route::Planned(Numbers::Certified(digits)) => format!("the plan, {digits} digits proved"),
        Route::Planned(_) => "the plan".into(),
    }
}

pub(super) const CLOSED: Route = Route::ClosedForm(Numbers::Double(None));
pub(super) const CLOSED_50: PromisedRoute = (closed(50), Promise::Digits(36));
pub(super) const MODES: Route = Route::Modes(2048);
pub(super) const LATTICE: Route = Route::Lattice(Numbers::Double(None));
pub(super) const FRACTIONS: Route = Route::Lattice(Numbers::Exact);
pub(super) const CELLS: Route = Route::Cells(13);
pub(super) const PRINTED: PromisedRoute = (Route::PrintedForms, Promise::Exact);
pub(super) const DIGITS: PromisedRoute = (Route::Planned(Numbers::Digits(36)), Promise::Digits(36));
pub(super) const CERTIFIED: Route = Route::Planned(Numbers::Certified(36));
pub(super) const PLANNED: Route = Route::Planned(Numbers::Double(None));
pub(super) const PROVED: PromisedRoute = (CERTIFIED, Promise::Enclosed(36));

/// Routes to values during a contact.
pub(super) const CONTACT: &[PromisedRoute] =
    &[(CLOSED, Promise::Bound(12)), (MODES, Promise::Bound(9)), (CELLS, Promise::Digits(10)), CLOSED_50, PROVED];
/// Routes that show that there is no bounce.
pub(super) const NEVER: &[PromisedRoute] = &[
    (CLOSED, Promise::Digits(0)),
    (accuracy(1e-12), Promise::Digits(0)),
    (closed(50), Promise::Digits(0)),
    (CERTIFIED, Promise::Digits(0)),
];

pub(super) const fn closed(digits: u32) -> Route {
    Route::ClosedForm(Numbers::Digits(digits))
}

/// The route that `--accuracy` takes.
pub(super) const fn accuracy(accuracy: f64) -> Route {
    Route::Planned(Numbers::Double(Some(accuracy)))
}

/// Prepares the printed integrals of a rod with `c = L = g = 1`.
pub(super) fn printed(damping: f64, speed: f64) -> PrintedIntegrals {
    PrintedIntegrals::new(&Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed }, 1e-13)
}

/// Cases that belong together.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// The name on the command line.
    pub name: &'static str,
    /// The title.
    pub title: &'static str,
    /// The lesson of the cases, in a few sentences.
    pub lesson: &'static str,
    /// The cases, in the order in which they are shown.
    pub cases: &'static [Case],
}

pub(super) const fn group(
    name: &'static str,
    title: &'static str,
    lesson: &'static str,
    cases: &'static [Case],
) -> Group {
    Group { name, title, lesson, cases }
}

/// A hard case, or a claim of the paper.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// The name on the command line.
    pub name: &'static str,
    /// The place in the paper or the theory.
    pub source: &'static str,
    /// The rod, or the claim.
    pub about: &'static str,
    /// The verdict when all promises are kept.
    pub(super) verdict: Verdict,
    pub(super) questions: &'static [CaseQuestion],
}

pub(super) const fn claim(
    name: &'static str,
    verdict: Verdict,
    source: &'static str,
    about: &'static str,
    questions: &'static [CaseQuestion],
) -> Case {
    Case { name, source, about, verdict, questions }
}

impl Case {
    /// Takes every route to every question.
    ///
    /// ```
    /// use dalembert_verify::check::{Verdict, select};
    /// // Corollary 1: t_b = t₁ = 2 for μ = 3 ≥ g t₁, and 2t₁ − μ/g = 5/2 for μ = 3/2.
    /// let selected = select(&["corollary-1".into()])?;
    /// let checked = selected[0].cases[0].run();
    /// assert_eq!((checked.questions[2].truth, checked.verdict), ("5/2", Verdict::Reproduced));
    /// # Ok::<(), dalembert_verify::check::UnknownName>(())
    /// ```
    pub fn run(&'static self) -> CheckedCase {
        let questions: Vec<CheckedQuestion> = self.questions.iter().map(CaseQuestion::check).collect();
        let failed =
            questions.iter().flat_map(|question| &question.routes).any(|route| route.outcome == Outcome::Failed);
        CheckedCase { case: self, questions, verdict: if failed { Verdict::Failed } else { self.verdict } }
    }
}

/// A question with the answers of its routes.
#[derive(Clone, Debug)]
pub struct CheckedQuestion {
    /// The question in words: `t_b`, `h(3)`.
    pub label: &'static str,
    /// The truth as the catalogue spells it.
    pub truth: &'static str,
    /// The routes, in the order in which they are shown.
    pub routes: Vec<CheckedRoute>,
}

/// A case with the answers to its questions.
#[derive(Clone, Debug)]
pub struct CheckedCase {
    /// The case.
    pub case: &'static Case,
    /// Its questions, in order.
    pub questions: Vec<CheckedQuestion>,
    /// The verdict; [`Verdict::Failed`] where a promise is broken.
    pub verdict: Verdict,
}
