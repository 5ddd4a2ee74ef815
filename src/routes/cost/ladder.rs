//! Every route that can answer a question, at every setting, the cheapest first.

use crate::mapped::CollectVec;
use crate::quantity::Quantity;
use crate::routes::long;
use crate::routes::quantity::Question;
use crate::routes::route::{Numbers, Route, within_first_contact};
use crate::solve::{Engine, Plan};

named! {
    /// Routes that share a name in a table and a colour in a picture, in the order in which they are shown.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub(crate) enum Family {
        /// The closed form of the first contact.
        ClosedForm = "closed form",
        /// The lattice: undamped, from event to event.
        Lattice = "lattice",
        /// What the plan of a damped scene does: the closed form of the first contact, then cells.
        ContactThenCells = "closed form, then cells",
        /// Characteristic cells from the start.
        Cells = "cells",
        /// The modal sum.
        Modes = "modal sum",
        /// The paper's integrals by adaptive quadrature.
        Printed = "printed integrals",
        /// Finite differences at CFL = 1.
        Differences = "finite differences",
        /// Intervals with ends rounded outwards.
        Enclosures = "enclosures",
    }
}

/// One route at one setting.
pub(super) struct Candidate {
    pub(super) family: Family,
    pub(super) route: Route,
    pub(super) setting: String,
    /// Decimal digits that the numbers of this setting hold.
    pub(super) digits: u32,
    /// Whether this is what the plan does.
    pub(super) chosen: bool,
    pub(super) expected: Expected,
}

impl Candidate {
    fn new(family: Family, route: Route, setting: String, digits: u32, expected: Expected) -> Self {
        Candidate { family, route, setting, digits, chosen: false, expected }
    }
}

/// How long a setting is expected to take.
#[derive(Clone, Copy)]
pub(super) enum Expected {
    Seconds(f64),
    /// As long as the setting before it, times this.
    Times(f64),
}
use Expected::{Seconds, Times};

/// Settings of one route, the cheapest first.
pub(super) type Ladder = Vec<Candidate>;

/// Digits that a double holds.
const DOUBLE: u32 = 17;
const LONG: [u32; 4] = [50, 100, 300, 1000];

/// Every route that can answer, and why the others cannot.
pub(super) fn ladders(question: &Question, plan: &Plan) -> (Vec<Ladder>, Vec<(Family, String)>) {
    let (mut ladders, mut left_out) = (Vec::new(), Vec::new());
    let mut take = |family: Family, ladder: Result<Ladder, String>| match ladder {
        Ok(ladder) => ladders.push(ladder),
        Err(why) => left_out.push((family, why)),
    };
    let first = within_first_contact(question);
    take(Family::ClosedForm, first.clone().map(|()| closed_form()));
    let family = match plan.engine {
        Engine::Lattice => Family::Lattice,
        Engine::ClosedForm => Family::ClosedForm,
        Engine::ClosedFormThenCells | Engine::Cells => Family::ContactThenCells,
    };
    let damped = question.problem.rod.damping.is_some();
    if damped {
        take(Family::Lattice, Err("the scene has damping, which couples the characteristics".into()));
    } else {
        take(Family::ContactThenCells, Err(format!("the scene has no damping: the plan takes the {}", family.name())));
    }
    match plan.numbers {
        Numbers::Certified(_) => take(family, Err("the plan takes enclosures".into())),
        // In longer numbers the plan takes the lattice.
        numbers if !damped && family == Family::ClosedForm => {
            let mut planned = by_plan(Family::Lattice, question, numbers);
            let doubles = Route::Lattice(Numbers::Double(None));
            let doubles = Candidate::new(Family::Lattice, doubles, "double".into(), DOUBLE, Seconds(1e-6));
            let chosen = std::mem::replace(&mut planned[0], doubles);
            take(family, Ok(vec![Candidate { family, ..chosen }]));
            take(Family::Lattice, Ok(planned));
        }
        numbers => take(family, Ok(by_plan(family, question, numbers))),
    }
    let doubles = |family: Family, first: f64, factor: f64, settings: Vec<(String, Route)>| -> Ladder {
        let expected = std::iter::once(Seconds(first)).chain(std::iter::repeat(Times(factor)));
        let steps = settings.into_iter().zip(expected);
        steps.map(|((setting, route), expected)| Candidate::new(family, route, setting, DOUBLE, expected)).collect_vec()
    };
    let cells = [1, 3, 5, 7, 9, 11, 13].map(|digits| (format!("to 1e-{digits}"), Route::Cells(digits)));
    take(Family::Cells, Ok(doubles(Family::Cells, 1e-4, 1.5, cells.into())));
    let whole = match question.one.quantity {
        Quantity::VibrationalEnergy => Err("gives the whole energy; E_z would be the difference of two".into()),
        _ => first.clone(),
    };
    let modes = (0..8).map(|k| 4 << (2 * k)).map(|count| (format!("N = {count}"), Route::Modes(count)));
    take(Family::Modes, whole.clone().map(|()| doubles(Family::Modes, 1e-4, 4.0, modes.collect_vec())));
    let printed = [1, 2, 4, 6, 8, 10, 12, 14]
        .map(|digits| (format!("tolerance 1e-{digits}"), Route::PrintedIntegrals(10f64.powi(-digits))));
    let damped = match question.problem.rod.damping {
        Some(_) => whole,
        None => whole.and(Err("without damping the paper itself has done its integrals".into())),
    };
    take(Family::Printed, damped.map(|()| doubles(Family::Printed, 1e-2, 3.0, printed.into())));
    let differences = (0..7).map(|k| 8 << (2 * k)).map(|count| (format!("{count} cells"), Route::Differences(count)));
    take(Family::Differences, Ok(doubles(Family::Differences, 1e-4, 16.0, differences.collect_vec())));
    if long::AVAILABLE {
        take(Family::Enclosures, enclosures(question, plan, first));
    }
    (ladders, left_out)
}

/// The settings of long numbers, of which a build without them has none.
fn long_settings(expected: [Expected; 4]) -> impl Iterator<Item = (u32, Expected)> {
    LONG.into_iter().zip(expected).filter(|_| long::AVAILABLE)
}

fn closed_form() -> Ladder {
    let candidate = |numbers: Numbers, setting: String, digits: u32, expected: Expected| {
        Candidate::new(Family::ClosedForm, Route::ClosedForm(numbers), setting, digits, expected)
    };
    let long = long_settings([Seconds(0.01), Times(3.0), Times(10.0), Times(20.0)]);
    let long = long
        .map(|(digits, expected)| candidate(Numbers::Digits(digits), format!("{digits} digits"), digits + 6, expected));
    let doubles = candidate(Numbers::Double(None), "double".into(), DOUBLE, Seconds(1e-6));
    std::iter::once(doubles).chain(long).collect_vec()
}

fn by_plan(family: Family, question: &Question, system: Numbers) -> Ladder {
    let planned = |numbers: Numbers, setting: String, digits: u32, expected: Expected| {
        Candidate::new(family, Route::Planned(numbers), setting, digits, expected)
    };
    let digits = match system {
        Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => digits + 8,
        _ => DOUBLE,
    };
    let chosen = planned(system, system.to_string(), digits, Seconds(0.0));
    let mut ladder = vec![Candidate { chosen: true, ..chosen }];
    let fractions = Route::Lattice(Numbers::Exact);
    if family == Family::Lattice && fractions.run(question, f64::INFINITY).is_ok() {
        ladder.push(Candidate::new(family, fractions, "fractions".into(), DOUBLE, Times(30.0)));
    }
    // Cells cost about the cube of their digits, of which the plan takes eight more than asked; the lattice hardly more
    // for long numbers.
    let growths = if family == Family::Lattice { [3.0, 1.5, 2.0, 4.0] } else { [30.0, 4.0, 15.0, 30.0] };
    let others = long_settings(growths.map(Times)).filter(|(digits, _)| system != Numbers::Digits(*digits));
    ladder.extend(
        others.map(|(digits, growth)| planned(Numbers::Digits(digits), format!("{digits} digits"), digits + 8, growth)),
    );
    ladder
}

/// Enclosures, where they reach: an answer that is wrong by more than it says is impossible.
fn enclosures(question: &Question, plan: &Plan, first: Result<(), String>) -> Result<Ladder, String> {
    if question.problem.rod.damping.is_some() {
        first.map_err(|why| format!("{why}: only that is proved under damping"))?;
    }
    let chosen = match plan.numbers {
        Numbers::Certified(digits) => Some(digits),
        _ => None,
    };
    let mut settings: Vec<u32> = LONG.into_iter().chain([15]).chain(chosen).collect_vec();
    settings.sort_unstable();
    settings.dedup();
    let candidate = |(k, digits): (usize, u32)| {
        let route = Route::Planned(Numbers::Certified(digits));
        let expected = if k == 0 { Seconds(1e-3) } else { Times(4.0) };
        let candidate = Candidate::new(Family::Enclosures, route, format!("{digits} digits"), digits + 9, expected);
        Candidate { chosen: chosen == Some(digits), ..candidate }
    };
    Ok(settings.into_iter().enumerate().map(candidate).collect_vec())
}
