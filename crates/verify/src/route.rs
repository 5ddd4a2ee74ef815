//! Every route to an answer, and the one function that runs it.

use super::account::{ByClosedForm, unbounded};
use super::differences::march;
use super::long;
use super::quantity::Question;
use super::value::{NoAnswer, Value};
use crate::paper::{Printed, UndampedContact};
use dalembert::Ending;
use dalembert::engine::Damped;
use dalembert::engine::Modal;
use dalembert::engine::Undamped;
use dalembert::number::{Estimate, Rational, Scalar};
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{One, Quantity};
pub use dalembert::solve::Numbers;
use dalembert::solve::{self, Plan, TypedHistory};

#[derive(Clone, Copy, Debug)]
pub enum Route {
    /// A formula in plain doubles, as it stands in print or as a reader would program it.
    Formula(&'static str, fn() -> f64),
    /// A formula in numbers of 36 digits.
    LongFormula(&'static str, long::Formula),
    /// The closed form of the first contact, in these numbers alone.
    ClosedForm(Numbers),
    /// The paper's closed forms of `r = 0`, in fractions.
    PrintedForms,
    /// The paper's integrals by quadrature to this tolerance, in doubles.
    PrintedIntegrals(f64),
    /// The sum of so many modes, in doubles.
    Modes(u32),
    /// The lattice, in doubles or in fractions.
    Lattice(Numbers),
    /// Characteristic cells from the start, to so many digits, in doubles.
    Cells(u32),
    /// Finite differences with so many cells.
    Differences(usize),
    /// What the plan does when these numbers are asked for.
    Planned(Numbers),
}

impl Route {
    /// The answer of this route to `question`, in about so many seconds where it can stop itself.
    pub fn run(self, question: &Question, seconds: f64) -> Result<Value, NoAnswer> {
        let problem = &question.problem;
        match self {
            Route::Formula(_, formula) => Ok(unbounded(formula()).into()),
            Route::ClosedForm(Numbers::Double(_)) => {
                let rod = Parameters::<Estimate<f64>>::of(problem, &())?;
                question.ask(&rod, &ByClosedForm::new(&rod))
            }
            Route::Lattice(Numbers::Double(_)) => question.ask_engine(&Undamped::<Estimate<f64>>::solve(problem, &())?),
            Route::Cells(digits) => question.ask_engine(&Damped::<f64>::solve(problem, &(), f64::from(digits))?),
            Route::Modes(modes) => {
                let modal = Modal::<f64>::new(&Parameters::of(problem, &())?, modes);
                question.ask(&Parameters::of(problem, &())?, &modal)
            }
            Route::PrintedIntegrals(tolerance) => {
                let printed = Printed::new(&Parameters::of(problem, &())?, tolerance).limited_to(seconds);
                let answer = question.ask(&Parameters::of(problem, &())?, &printed);
                if printed.is_late() { Err(NoAnswer::gave_up("the nested integrals take too long")) } else { answer }
            }
            Route::Differences(cells) => question.ask(&Parameters::of(problem, &())?, &march(problem, cells)?),
            Route::Planned(numbers) => planned(question, numbers),
            Route::LongFormula(_, formula) => Ok(long::formula(36, formula)),
            Route::ClosedForm(Numbers::Digits(digits)) => long::closed_form(question, digits),
            Route::Lattice(Numbers::Exact) => question.ask_engine(&Undamped::<Rational>::solve(problem, &())?),
            Route::PrintedForms => {
                let rod = Parameters::<Rational>::of(problem, &())?;
                let contact =
                    UndampedContact::new(&rod).ok_or_else(|| NoAnswer::gave_up("they are printed for r = 0"))?;
                question.ask(&rod, &contact)
            }
            Route::ClosedForm(_) | Route::Lattice(_) => Err(NoAnswer::gave_up("this route has no such numbers")),
        }
    }
}

/// The plan that answers `question` in these numbers, and no more.
pub fn plan(question: &Question, numbers: Numbers) -> Result<Plan, NoAnswer> {
    let One { quantity, time, .. } = &question.one;
    Ok(Plan::of(&question.problem, &solve::Question::of(*quantity, time.as_ref(), numbers))?)
}

fn planned(question: &Question, numbers: Numbers) -> Result<Value, NoAnswer> {
    let plan = plan(question, numbers)?;
    match numbers {
        Numbers::Double(_) => question.ask_plan(&plan),
        _ => question.ask_solution(&plan.solve_typed(&question.problem, solve::unobserved())?),
    }
}

/// Whether the first contact alone answers, and lasts as long as the question asks.
///
/// **Errors**: why not.
pub fn within_first_contact(question: &Question) -> Result<(), String> {
    if !question.problem.has_closed_form() {
        return Err("the start or the top is not the paper's, so the first contact has no closed form".into());
    }
    if question.one.quantity == Quantity::LastEvent && question.problem.run != Run::Impacts(1) {
        return Err("it covers the first contact only".into());
    }
    let Some(time) = &question.one.time else { return Ok(()) };
    let first = question.problem.first_contact().map_err(|error| error.to_string())?;
    match (first.contacts().first().and_then(|contact| contact.release), first.ending()) {
        (Some(end), _) if time.to_f64() > end * (1.0 + 1e-12) => {
            Err(format!("it covers the first contact only, which ends at t = {end:.6}"))
        }
        (None, Ending::Undecided(_)) if time.to_f64() > *first.end() => {
            Err(format!("it is undecided whether the first contact lasts beyond t = {:.6}", first.end()))
        }
        _ => Ok(()),
    }
}

/// The whole run of `problem` in doubles as its plan does it, with the energy at its end if that is asked for.
pub fn run_planned(problem: &Problem, numbers: Numbers, energies: bool) -> Result<f64, NoAnswer> {
    let history: TypedHistory<f64> = problem.answer(&solve::Question::run(numbers))?;
    Ok(if energies { history.energy(*history.end())?.total } else { *history.end() })
}

/// The same by calling the engine that the plan calls.
pub fn run_engine(problem: &Problem, energies: bool) -> Result<f64, NoAnswer> {
    let plan = Plan::of(problem, &solve::Question::run(Numbers::Double(None)))?;
    let engine = <f64 as solve::Target>::run(problem, &plan, plan.rung, &solve::unobserved())?;
    let end = engine.end();
    Ok(if energies { engine.energy(&end)?.total.to_f64() } else { end.to_f64() })
}
