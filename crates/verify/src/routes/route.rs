//! Every route to an answer, and the one function that runs it.

use super::differences::march;
use super::method::{ClosedForm, unbounded};
use super::question::RouteQuestion;
use crate::error::VerifyError;
use crate::modal::Modal;
use crate::paper::formulas::Constant;
use crate::paper::{PrintedIntegrals, UndampedContact};
use dalembert::Value;
use dalembert::engine::{Damped, Undamped};
use dalembert::number::{Estimate, Float, Interval, Rational, Scalar};
use dalembert::problem::{Parameters, Problem};
use dalembert::solve::{self, Numbers, Plan, TypedHistory};

/// A route to an answer.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Route {
    /// A named formula in plain doubles, as in print or as a reader would program it.
    Formula(&'static str, fn() -> f64),
    /// A constant of the paper in numbers of 36 digits, by a named method.
    Constant(&'static str, Constant),
    /// The closed form of the first contact, in these numbers alone.
    ClosedForm(Numbers),
    /// The paper's closed forms of `r = 0`, in fractions.
    PrintedForms,
    /// The paper's integrals by quadrature to this tolerance, in doubles.
    PrintedIntegrals(f64),
    /// The sum of this many modes, in doubles.
    Modes(u32),
    /// The lattice, in doubles or in fractions.
    Lattice(Numbers),
    /// Characteristic cells from the start, to this many digits, in doubles.
    Cells(u32),
    /// Finite differences with this many cells.
    Differences(usize),
    /// The plan for these numbers.
    Planned(Numbers),
}

/// A question about one number, which routes answer.
pub(crate) trait Question {
    /// Answers by `route`, in about `seconds` where the route can stop itself.
    fn answer(&self, route: Route, seconds: f64) -> Result<Value, VerifyError>;

    /// Returns the route whose answer is a fraction if there is one; `None` if there is none.
    fn exact_route(&self) -> Option<Route>;
}

impl Question for RouteQuestion {
    fn answer(&self, route: Route, seconds: f64) -> Result<Value, VerifyError> {
        route.run(self, seconds)
    }

    fn exact_route(&self) -> Option<Route> {
        match self.problem.chain() {
            Some(_) => Some(Route::Planned(Numbers::Exact)),
            None => Some(Route::Lattice(Numbers::Exact)).filter(|_| self.problem.damping().is_none()),
        }
    }
}

/// Digits of [`Route::Constant`].
const CONSTANT_DIGITS: u32 = 36;

impl Route {
    /// Answers `question`, in about `seconds` where the route can stop itself.
    pub(crate) fn run(self, question: &RouteQuestion, seconds: f64) -> Result<Value, VerifyError> {
        let problem = &question.problem;
        match self {
            Route::Formula(_, formula) => Ok(unbounded(formula()).into()),
            Route::Constant(..) => in_digits(self, question, CONSTANT_DIGITS),
            Route::ClosedForm(Numbers::Double(_)) => {
                let rod = Parameters::<Estimate<f64>>::of(problem, &())?;
                question.ask(&rod, &ClosedForm::new(&rod))
            }
            Route::ClosedForm(Numbers::Digits(digits)) => in_digits(self, question, digits),
            Route::PrintedForms => {
                let rod = Parameters::<Rational>::of(problem, &())?;
                question.ask(&rod, &UndampedContact::new(&rod).ok_or(VerifyError::NotGiven)?)
            }
            Route::PrintedIntegrals(tolerance) => {
                let printed = PrintedIntegrals::new(&Parameters::of(problem, &())?, tolerance).limited_to(seconds);
                let answer = question.ask(&Parameters::of(problem, &())?, &printed);
                if printed.is_late() { Err(VerifyError::TooSlow) } else { answer }
            }
            Route::Modes(modes) => {
                let modal = Modal::<f64>::new(&Parameters::of(problem, &())?, modes);
                question.ask(&Parameters::of(problem, &())?, &modal)
            }
            Route::Lattice(Numbers::Double(_)) => question.ask_engine(&Undamped::<Estimate<f64>>::solve(problem, &())?),
            Route::Lattice(Numbers::Exact) => question.ask_engine(&Undamped::<Rational>::solve(problem, &())?),
            Route::Cells(digits) => question.ask_engine(&Damped::<f64>::solve(problem, &(), f64::from(digits))?),
            Route::Differences(cells) => question.ask(&Parameters::of(problem, &())?, &march(problem, cells)?),
            Route::Planned(numbers @ Numbers::Double(_)) => question.ask_plan(&question.plan(numbers)?),
            Route::Planned(numbers @ Numbers::Digits(_)) => question.ask_history::<Float>(&question.plan(numbers)?),
            Route::Planned(numbers @ Numbers::Certified(_)) => {
                question.ask_history::<Interval>(&question.plan(numbers)?)
            }
            Route::Planned(numbers @ Numbers::Exact) => question.ask_history::<Rational>(&question.plan(numbers)?),
            Route::Planned(numbers) => question.ask_library(&question.plan(numbers)?),
            Route::ClosedForm(_) | Route::Lattice(_) => Err(VerifyError::NotGiven),
        }
    }
}

/// Answers by `route`, a constant or the closed form, in numbers of `digits` digits.
fn in_digits(route: Route, question: &RouteQuestion, digits: u32) -> Result<Value, VerifyError> {
    // Two bytes to spare.
    let bits = dalembert::number::bits_for_digits(digits) + 16;
    if let Route::Constant(_, constant) = route {
        return Ok(unbounded(constant.value(&Float::new(bits))).into());
    }
    let rod = Parameters::<Estimate<Float>>::of(&question.problem, &bits)?;
    question.ask(&rod, &ClosedForm::new(&rod))
}

/// Runs `problem` in doubles by its plan and returns the end of the run, or the energy there.
pub(crate) fn run_planned(problem: &Problem, numbers: Numbers, energies: bool) -> Result<f64, VerifyError> {
    let history: TypedHistory<f64> = problem.answer(&solve::Question::run(numbers))?;
    Ok(if energies { history.energy(*history.end())?.total } else { *history.end() })
}

/// Runs `problem` by calling the engine of its plan; returns the same as [`run_planned`].
pub(crate) fn run_engine(problem: &Problem, energies: bool) -> Result<f64, VerifyError> {
    let plan = Plan::of(problem, &solve::Question::run(Numbers::Double(None)))?;
    let engine = <f64 as solve::Target>::run(problem, &plan, plan.rung, &solve::unobserved())?;
    let end = engine.end();
    Ok(if energies { engine.energy(&end)?.total.to_f64() } else { end.to_f64() })
}
