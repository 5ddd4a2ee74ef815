//! What a case of the catalogue is, and how it is run.

use std::time::Instant;

use super::verdict::{Outcome, Promise, Row, Verdict, outcome};
use crate::long;
use crate::paper::Printed;
use crate::quantity::{Claimed, Question};
use crate::route::{Numbers, Route};
use crate::truth::Truth;
use crate::value::NoAnswer;
use dalembert::Scene;
use dalembert::Side;
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{One, Quantity, Units};

pub type Text = &'static str;

#[derive(Clone, Copy, Debug)]
pub struct Rod {
    pub length: Text,
    pub wave_speed: Text,
    pub damping: Text,
    pub gravity: Text,
    pub speed: Text,
    /// Followed to this time; empty: through the first contact and the flight after it.
    pub until: Text,
    /// A whole scene in place of all that; empty without one.
    pub scene: Text,
}

/// `c = L = g = 1`.
pub const fn unit(damping: Text, speed: Text) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "", scene: "" }
}

impl Rod {
    pub const fn weightless(self) -> Rod {
        Rod { gravity: "0", ..self }
    }

    pub const fn until(self, until: Text) -> Rod {
        Rod { until, ..self }
    }

    pub const fn of(scene: Text) -> Rod {
        Rod { scene, ..unit("0", "1") }
    }

    fn problem(&self) -> Result<Problem, NoAnswer> {
        if !self.scene.is_empty() {
            return Scene::parse(self.scene).map(|scene| scene.problem).map_err(NoAnswer::gave_up);
        }
        let number = |text: &str| text.parse::<Number>();
        let (gravity, speed) = (number(self.gravity)?, number(self.speed)?);
        let mut problem = Problem::uniform(number(self.length)?, number(self.wave_speed)?, gravity, speed);
        problem.rod.damping = Some(number(self.damping)?).filter(|r| !r.is_zero());
        if !self.until.is_empty() {
            problem.run = Run::Time(number(self.until)?);
        }
        Ok(problem)
    }
}

pub type Promised = (Route, Promise);

const MOST_FORMULAS: usize = 4;

/// A question of the catalogue, its truth, and the routes to it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// In words: `t_b`, `h(3)`.
    what: Text,
    rod: Rod,
    quantity: Quantity,
    /// x, and t; `t_b` where it is empty.
    place: (Text, Text),
    side: Side,
    claimed: Claimed,
    /// See [`Truth::spelt`], or [`super::verdict::NO_BOUNCE`].
    pub truth: Text,
    /// Routes of this question alone, shown before the others.
    formulas: [Option<Promised>; MOST_FORMULAS],
    routes: &'static [Promised],
}

/// A question at `t_b`, or that has no time.
pub const fn ask(what: Text, rod: Rod, quantity: Quantity, truth: Text, routes: &'static [Promised]) -> Entry {
    let (place, side, claimed, formulas) = (("", ""), Side::Right, Claimed::Itself, [None; MOST_FORMULAS]);
    Entry { what, rod, quantity, place, side, claimed, truth, formulas, routes }
}

/// A number that belongs to no rod: only formulas give it, and nothing is asked.
pub const fn constant(what: Text, truth: Text) -> Entry {
    ask(what, unit("0", "1"), Quantity::BounceTime, truth, &[])
}

impl Entry {
    /// At this time, in the limit from later times.
    pub const fn at(self, time: Text) -> Entry {
        Entry { place: ("", time), ..self }
    }

    /// At this time, in the limit from earlier times.
    pub const fn before(self, time: Text) -> Entry {
        Entry { place: ("", time), side: Side::Left, ..self }
    }

    pub const fn at_point(self, point: Text, time: Text) -> Entry {
        Entry { place: (point, time), ..self }
    }

    pub const fn claims(self, claimed: Claimed) -> Entry {
        Entry { claimed, ..self }
    }

    /// A formula in doubles that gives so many digits.
    pub const fn by(self, what: Text, digits: u32, formula: fn() -> f64) -> Entry {
        self.first_by((Route::Formula(what, formula), Promise::Digits(digits)))
    }

    /// A formula in doubles that gives fewer digits than this.
    pub const fn breaks(self, what: Text, digits: u32, formula: fn() -> f64) -> Entry {
        self.first_by((Route::Formula(what, formula), Promise::Fewer(digits)))
    }

    /// A formula in 36 digits.
    pub const fn by_digits(self, what: Text, formula: long::Formula) -> Entry {
        self.first_by((Route::LongFormula(what, formula), Promise::Digits(36)))
    }

    const fn first_by(mut self, formula: Promised) -> Entry {
        let mut place = 0;
        while self.formulas[place].is_some() {
            place += 1;
        }
        self.formulas[place] = Some(formula);
        self
    }

    fn question(&self) -> Result<Question, NoAnswer> {
        let number = |text: &str| (!text.is_empty()).then(|| text.parse::<Number>()).transpose();
        let (problem, quantity) = (self.rod.problem()?, self.quantity);
        let (point, time) = (number(self.place.0)?, number(self.place.1)?);
        let one = One { quantity, point, time, side: self.side };
        Ok(Question { problem, one, units: Units::default(), claimed: self.claimed })
    }

    pub fn check(&self) -> CheckedQuestion {
        let truth = Truth::spelt(self.truth);
        let question = self.question();
        let routes = self.formulas.iter().flatten().chain(self.routes);
        let rows = routes.filter_map(|(route, promise)| {
            let ((route_name, long), start) = (described(*route), Instant::now());
            if long && !long::AVAILABLE {
                return None;
            }
            let found = question.as_ref().map_err(Clone::clone).and_then(|asked| route.run(asked, f64::INFINITY));
            let seconds = start.elapsed().as_secs_f64();
            let digits = truth.as_ref().and_then(|truth| Some(truth.right_digits(found.as_ref().ok()?)));
            let outcome = outcome(*promise, truth.as_ref(), &found, digits.unwrap_or(0.0));
            Some(Row { route: route_name, found, promise: *promise, digits, outcome, seconds })
        });
        CheckedQuestion { what: self.what, truth: self.truth, rows: rows.collect() }
    }
}

/// The name of a route in the catalogue, and whether it may need long numbers.
fn described(route: Route) -> (String, bool) {
    match route {
        Route::Formula(what, _) => (format!("{what}, plain doubles"), false),
        Route::LongFormula(what, _) => (format!("{what}, 36 digits"), true),
        Route::ClosedForm(Numbers::Digits(digits)) => (format!("closed form, {digits} digits"), true),
        Route::ClosedForm(_) => ("closed form, doubles".into(), false),
        Route::PrintedForms => ("printed form, fractions".into(), false),
        Route::PrintedIntegrals(_) => ("printed integrals, doubles".into(), false),
        Route::Modes(_) => ("modal sum, doubles".into(), false),
        Route::Lattice(Numbers::Exact) => ("lattice, fractions".into(), false),
        Route::Lattice(_) => ("lattice, doubles".into(), false),
        Route::Cells(_) => ("cells, doubles".into(), false),
        Route::Differences(_) => ("finite differences".into(), false),
        // An accuracy may take more than doubles.
        Route::Planned(Numbers::Double(Some(accuracy))) => (format!("the plan, to {accuracy:e}"), true),
        Route::Planned(Numbers::Digits(digits)) => (format!("the plan, {digits} digits"), true),
        Route::Planned(Numbers::Certified(digits)) => (format!("the plan, {digits} digits proved"), true),
        Route::Planned(_) => ("the plan".into(), false),
    }
}

pub const CLOSED: Route = Route::ClosedForm(Numbers::Double(None));
pub const CLOSED_50: Promised = (closed(50), Promise::Digits(36));
pub const MODES: Route = Route::Modes(2048);
pub const LATTICE: Route = Route::Lattice(Numbers::Double(None));
pub const FRACTIONS: Route = Route::Lattice(Numbers::Exact);
pub const CELLS: Route = Route::Cells(13);
pub const PRINTED: Promised = (Route::PrintedForms, Promise::Exact);
pub const DIGITS: Promised = (Route::Planned(Numbers::Digits(36)), Promise::Digits(36));
pub const CERTIFIED: Route = Route::Planned(Numbers::Certified(36));
pub const PLANNED: Route = Route::Planned(Numbers::Double(None));
pub const PROVED: Promised = (CERTIFIED, Promise::Enclosed(36));

/// Values during a contact.
pub const CONTACT: &[Promised] =
    &[(CLOSED, Promise::Bound(12)), (MODES, Promise::Bound(9)), (CELLS, Promise::Digits(10)), CLOSED_50, PROVED];
/// That there is no bounce.
pub const NEVER: &[Promised] = &[
    (CLOSED, Promise::Digits(0)),
    (accuracy(1e-12), Promise::Digits(0)),
    (closed(50), Promise::Digits(0)),
    (CERTIFIED, Promise::Digits(0)),
];

pub const fn closed(digits: u32) -> Route {
    Route::ClosedForm(Numbers::Digits(digits))
}

/// What `--accuracy` does.
pub const fn accuracy(accuracy: f64) -> Route {
    Route::Planned(Numbers::Double(Some(accuracy)))
}

/// The printed integrals of a rod with `c = L = g = 1`.
pub fn printed(damping: f64, speed: f64) -> Printed {
    Printed::new(&Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed }, 1e-13)
}

#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// The name on the command line.
    pub name: Text,
    pub title: Text,
    pub lesson: Text,
    pub cases: &'static [Case],
}

pub const fn group(name: Text, title: Text, lesson: Text, cases: &'static [Case]) -> Group {
    Group { name, title, lesson, cases }
}

/// A hard case, or a claim of the paper.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub name: Text,
    /// Where the paper or the theory says it.
    pub source: Text,
    /// The rod, or what is claimed.
    pub about: Text,
    /// What the case comes to when all promises are kept.
    pub verdict: Verdict,
    pub entries: &'static [Entry],
}

pub const fn claim(name: Text, verdict: Verdict, source: Text, about: Text, entries: &'static [Entry]) -> Case {
    Case { name, source, about, verdict, entries }
}

impl Case {
    /// Takes every route to every question. A build without long numbers takes those in doubles only.
    pub fn run(&'static self) -> Checked {
        let asked: Vec<CheckedQuestion> = self.entries.iter().map(Entry::check).collect();
        let failed = asked.iter().flat_map(|asked| &asked.rows).any(|row| row.outcome == Outcome::Failed);
        Checked { case: self, asked, verdict: if failed { Verdict::Failed } else { self.verdict } }
    }
}

#[derive(Clone, Debug)]
pub struct CheckedQuestion {
    pub what: Text,
    /// As the catalogue spells it.
    pub truth: Text,
    pub rows: Vec<Row>,
}

#[derive(Clone, Debug)]
pub struct Checked {
    pub case: &'static Case,
    pub asked: Vec<CheckedQuestion>,
    pub verdict: Verdict,
}
