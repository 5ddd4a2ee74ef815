//! Every route that can answer a question, at every setting, the cheapest first.

use super::family::{Family, OmissionReason};
use crate::error::VerifyError;
use crate::routes::{Question, Route, RouteQuestion};
use dalembert::Ending;
use dalembert::problem::Run;
use dalembert::quantity::Quantity;
use dalembert::solve::{Engine, Numbers, Plan};

/// A route at one setting.
pub(super) struct Candidate {
    pub(super) family: Family,
    pub(super) route: Route,
    pub(super) setting: String,
    /// Decimal digits that the numbers of this setting hold.
    pub(super) digits: u32,
    /// Expected time, seconds; relative to the time of the setting before it until that has run.
    pub(super) expected: f64,
    /// Whether the plan takes this route.
    pub(super) chosen: bool,
}

/// Settings of one route, the cheapest first.
pub(super) type Ladder = Vec<Candidate>;

/// Decimal digits of a double.
const DOUBLE: u32 = 17;
/// Decimal digits of long numbers.
const LONG: [u32; 4] = [50, 100, 300, 1000];

/// Returns the ladders of all routes that can answer, and the reasons of the others.
pub(super) fn ladders(question: &RouteQuestion, plan: &Plan) -> (Vec<Ladder>, Vec<(Family, OmissionReason)>) {
    let numbers = plan.numbers;
    let (mut ladders, mut left_out) = (Vec::new(), Vec::new());
    let mut take = |family: Family, ladder: Result<Ladder, OmissionReason>| match ladder {
        Ok(ladder) => ladders.push(ladder),
        Err(why) => left_out.push((family, why)),
    };
    if plan.engine == Engine::Chain {
        return of_chain(question, numbers);
    }
    let first = covered_by_first_contact(question);
    take(Family::ClosedForm, first.clone().map(|()| closed_form()));
    let family = match plan.engine {
        Engine::Lattice => Family::Lattice,
        Engine::ClosedForm => Family::ClosedForm,
        Engine::Cells => Family::PlannedCells,
        Engine::Chain => Family::Chain,
    };
    let damped = question.problem.damping().is_some();
    if damped {
        take(Family::Lattice, Err(OmissionReason::Damping));
    } else {
        take(Family::PlannedCells, Err(OmissionReason::NoDamping(family)));
    }
    match plan.numbers {
        Numbers::Certified(_) => take(family, Err(OmissionReason::PlanEncloses)),
        // In longer numbers the plan takes the lattice.
        numbers if !damped && family == Family::ClosedForm => {
            let doubles = [("double".into(), Route::Lattice(Numbers::Double(None)))];
            let mut lattice = in_doubles(Family::Lattice, [1e-6, 1.0], doubles);
            let mut planned = by_plan(Family::Lattice, question, numbers);
            take(family, Ok(vec![Candidate { family, ..planned.remove(0) }]));
            lattice.extend(planned);
            take(Family::Lattice, Ok(lattice));
        }
        numbers => take(family, Ok(by_plan(family, question, numbers))),
    }
    let cells = [1, 3, 5, 7, 9, 11, 13].map(|digits| (format!("to 1e-{digits}"), Route::Cells(digits)));
    take(Family::Cells, Ok(in_doubles(Family::Cells, [1e-4, 1.5], cells)));
    let whole = match question.query.quantity {
        Quantity::VibrationalEnergy => Err(OmissionReason::WholeEnergy),
        _ => first.clone(),
    };
    let modes = (0..8).map(|k| 4 << (2 * k)).map(|count| (format!("N = {count}"), Route::Modes(count)));
    take(Family::Modes, whole.clone().map(|()| in_doubles(Family::Modes, [1e-4, 4.0], modes)));
    let whole = if damped { whole } else { whole.and(Err(OmissionReason::IntegralsDone)) };
    let printed = [1, 2, 4, 6, 8, 10, 12, 14]
        .map(|digits| (format!("tolerance 1e-{digits}"), Route::PrintedIntegrals(10f64.powi(-digits))));
    take(Family::Printed, whole.map(|()| in_doubles(Family::Printed, [1e-2, 3.0], printed)));
    let differences = (0..7).map(|k| 8 << (2 * k)).map(|count| (format!("{count} cells"), Route::Differences(count)));
    take(Family::Differences, Ok(in_doubles(Family::Differences, [1e-4, 16.0], differences)));
    take(Family::Enclosures, Ok(enclosures(numbers, first.is_ok())));
    (ladders, left_out)
}

/// Returns the ladders of a question about a chain, and the reasons of the other routes.
pub(super) fn of_chain(question: &impl Question, numbers: Numbers) -> (Vec<Ladder>, Vec<(Family, OmissionReason)>) {
    let others = [Family::ClosedForm, Family::Lattice, Family::Cells, Family::Modes, Family::Differences];
    let left_out = others.map(|family| (family, OmissionReason::InChain)).into();
    let proved = enclosures(numbers, false);
    match numbers {
        // The ladder of the proofs has the choice of the plan.
        Numbers::Certified(_) => (vec![proved], left_out),
        numbers => (vec![by_plan(Family::Chain, question, numbers), proved], left_out),
    }
}

/// Returns settings in doubles: the first takes `first` seconds, each other `growth` times as long as the one before.
fn in_doubles(
    family: Family,
    [first, growth]: [f64; 2],
    settings: impl IntoIterator<Item = (String, Route)>,
) -> Ladder {
    let step = |(k, (setting, route)): (usize, (String, Route))| {
        let expected = if k == 0 { first } else { growth };
        Candidate { family, route, setting, digits: DOUBLE, expected, chosen: false }
    };
    settings.into_iter().enumerate().map(step).collect()
}

/// Returns settings in long numbers, with `spare` digits more.
fn in_digits(
    family: Family,
    growths: [f64; 4],
    spare: u32,
    route: fn(Numbers) -> Route,
) -> impl Iterator<Item = Candidate> {
    LONG.into_iter().zip(growths).map(move |(digits, expected)| {
        let (route, setting) = (route(Numbers::Digits(digits)), format!("{digits} digits"));
        Candidate { family, route, setting, digits: digits + spare, expected, chosen: false }
    })
}

fn closed_form() -> Ladder {
    let double = [("double".into(), Route::ClosedForm(Numbers::Double(None)))];
    let mut ladder = in_doubles(Family::ClosedForm, [1e-6, 1.0], double);
    ladder.extend(in_digits(Family::ClosedForm, [30.0, 3.0, 10.0, 35.0], 6, Route::ClosedForm));
    ladder
}

/// Returns the setting of the plan, and others of the same engine.
fn by_plan(family: Family, question: &impl Question, system: Numbers) -> Ladder {
    let (route, setting) = (Route::Planned(system), system.to_string());
    let digits = match system {
        Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => digits + 8,
        _ => DOUBLE,
    };
    let mut ladder = vec![Candidate { family, route, setting, digits, expected: 0.0, chosen: true }];
    if let Some(exact) = question.exact_route().filter(|_| matches!(family, Family::Lattice | Family::Chain))
        && system != Numbers::Exact
        && question.answer(exact, f64::INFINITY).is_ok()
    {
        ladder.extend(in_doubles(family, [30.0, 1.0], [("fractions".into(), exact)]));
    }
    // Cells cost about the cube of their digits, of which the plan takes eight more than asked; the lattice costs
    // hardly more in long numbers.
    let growths =
        if matches!(family, Family::Lattice | Family::Chain) { [3.0, 1.5, 2.0, 4.0] } else { [30.0, 4.0, 15.0, 30.0] };
    let others = in_digits(family, growths, 8, Route::Planned);
    ladder.extend(others.filter(|other| system != Numbers::Digits(other.digits - 8)));
    ladder
}

/// Returns settings in enclosures. The cells prove several contacts of a damped rod in some twentieth of a second.
fn enclosures(numbers: Numbers, first_contact: bool) -> Ladder {
    let chosen = match numbers {
        Numbers::Certified(digits) => Some(digits),
        _ => None,
    };
    let mut settings: Vec<u32> = LONG.into_iter().chain([15]).chain(chosen).collect();
    settings.sort_unstable();
    settings.dedup();
    let candidate = |(k, digits): (usize, u32)| Candidate {
        family: Family::Enclosures,
        route: Route::Planned(Numbers::Certified(digits)),
        setting: format!("{digits} digits"),
        digits: digits + 9,
        expected: match k {
            0 if first_contact => 1e-3,
            0 => 5e-2,
            _ => 4.0,
        },
        chosen: chosen == Some(digits),
    };
    settings.into_iter().enumerate().map(candidate).collect()
}

/// Checks that the first contact alone answers `question`, and lasts as long as the question asks.
fn covered_by_first_contact(question: &RouteQuestion) -> Result<(), OmissionReason> {
    if !question.problem.has_closed_form() {
        return Err(OmissionReason::NoClosedForm);
    }
    if question.query.quantity == Quantity::LastEvent && *question.problem.run() != Run::Impacts(1) {
        return Err(OmissionReason::LaterEvent);
    }
    let Some(time) = question.time().map(|time| time.to_f64()) else { return Ok(()) };
    let first = question.problem.first_contact().map_err(VerifyError::from)?;
    match (first.contacts().first().and_then(|contact| contact.release), first.ending()) {
        (Some(end), _) if time > end * (1.0 + 1e-12) => Err(OmissionReason::LaterTime(end)),
        (None, Ending::Undecided(_)) if time > *first.end() => Err(OmissionReason::Undecided(*first.end())),
        _ => Ok(()),
    }
}
