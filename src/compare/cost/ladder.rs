//! Every route that can answer a question, at every setting, the cheapest first.

use crate::compare::long;
use crate::compare::quantity::{Quantity, Question};
use crate::compare::route::{Numbers, Route, within_first_contact};
use crate::scene::{Engine, Plan};

/// Routes that share a line in a table and a colour in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Family {
    /// The closed form of the first contact.
    ClosedForm,
    /// The lattice: undamped, from event to event.
    Lattice,
    /// What the plan of a damped scene does: the closed form of the first contact, then cells.
    Joined,
    /// Characteristic cells from the start.
    Cells,
    /// The modal sum.
    Modes,
    /// The paper's integrals by adaptive quadrature.
    Printed,
    /// Finite differences at CFL = 1.
    Differences,
    /// Intervals with ends rounded outwards.
    Enclosures,
}

impl Family {
    /// All of them, in the order in which they are shown.
    pub(crate) const ALL: [Family; 8] = [
        Family::ClosedForm,
        Family::Lattice,
        Family::Joined,
        Family::Cells,
        Family::Modes,
        Family::Printed,
        Family::Differences,
        Family::Enclosures,
    ];

    /// The name in output: `closed form`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Family::ClosedForm => "closed form",
            Family::Lattice => "lattice",
            Family::Joined => "closed form, then cells",
            Family::Cells => "cells",
            Family::Modes => "modal sum",
            Family::Printed => "printed integrals",
            Family::Differences => "finite differences",
            Family::Enclosures => "enclosures",
        }
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

/// How long a setting is expected to take.
#[derive(Clone, Copy)]
pub(super) enum Expected {
    /// Seconds.
    Seconds(f64),
    /// Times as long as the setting before it.
    Times(f64),
}
use Expected::{Seconds, Times};

/// Settings of one route, the cheapest first.
pub(super) type Ladder = Vec<Candidate>;

/// Digits that a double holds.
const DOUBLE: u32 = 17;
const LONG: [u32; 4] = [50, 100, 300, 1000];
/// The accuracy that the closed form in doubles is asked for; longer numbers come in where doubles do not reach it.
const ACCURACY: f64 = 1e-13;

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
        Engine::Cells => Family::Joined,
    };
    match family {
        Family::Lattice => {
            take(Family::Joined, Err("the scene has no damping: the plan takes the lattice".into()));
        }
        _ => take(Family::Lattice, Err("the scene has damping, which couples the characteristics".into())),
    }
    match plan.system {
        Numbers::Certified(_) => take(family, Err("the plan takes enclosures".into())),
        _ => take(family, Ok(by_plan(family, question, plan.system))),
    }
    let doubles = |family: Family, first: f64, factor: f64, settings: Vec<(String, Route)>| -> Ladder {
        let step = |(k, (setting, route))| {
            let expected = if k == 0 { Seconds(first) } else { Times(factor) };
            Candidate { family, route, setting, digits: DOUBLE, chosen: false, expected }
        };
        settings.into_iter().enumerate().map(step).collect()
    };
    let cells = [1, 3, 5, 7, 9, 11, 13].map(|digits| (format!("to 1e-{digits}"), Route::Cells(digits)));
    take(Family::Cells, Ok(doubles(Family::Cells, 1e-4, 1.5, cells.into())));
    let whole = match question.quantity {
        Quantity::Vibrational => Err("gives the whole energy; E_z would be the difference of two".into()),
        _ => first,
    };
    let modes = (0..8).map(|k| 4 << (2 * k)).map(|count| (format!("N = {count}"), Route::Modes(count)));
    take(Family::Modes, whole.clone().map(|()| doubles(Family::Modes, 1e-4, 4.0, modes.collect())));
    let printed = [1, 2, 4, 6, 8, 10, 12, 14]
        .map(|digits| (format!("tolerance 1e-{digits}"), Route::PrintedIntegrals(10f64.powi(-digits))));
    let damped = match question.problem.rod.damping {
        Some(_) => whole,
        None => whole.and(Err("without damping the paper itself has done its integrals".into())),
    };
    take(Family::Printed, damped.map(|()| doubles(Family::Printed, 1e-2, 3.0, printed.into())));
    let differences = (0..7).map(|k| 8 << (2 * k)).map(|count| (format!("{count} cells"), Route::Differences(count)));
    take(Family::Differences, Ok(doubles(Family::Differences, 1e-4, 16.0, differences.collect())));
    if long::AVAILABLE {
        take(Family::Enclosures, enclosures(question, plan));
    }
    (ladders, left_out)
}

fn closed_form() -> Ladder {
    let candidate = |setting: String, numbers: Numbers, digits: u32, expected: Expected| {
        let (family, route) = (Family::ClosedForm, Route::ClosedForm(numbers));
        Candidate { family, route, setting, digits, chosen: false, expected }
    };
    let doubles = candidate("double".into(), Numbers::Double(Some(ACCURACY)), DOUBLE, Seconds(1e-6));
    let long = LONG.into_iter().zip([Seconds(0.01), Times(3.0), Times(10.0), Times(20.0)]);
    let long = long
        .map(|(digits, expected)| candidate(format!("{digits} digits"), Numbers::Digits(digits), digits + 6, expected));
    std::iter::once(doubles).chain(long.filter(|_| long::AVAILABLE)).collect()
}

fn by_plan(family: Family, question: &Question, system: Numbers) -> Ladder {
    let candidate = |setting: String, route: Route, digits: u32, expected: Expected| Candidate {
        family,
        route,
        setting,
        digits,
        chosen: false,
        expected,
    };
    let digits = match system {
        Numbers::Digits(digits) | Numbers::Exact(Some(digits)) => digits + 8,
        _ => DOUBLE,
    };
    let chosen = candidate(system.to_string(), Route::Planned(system), digits, Seconds(0.0));
    let mut ladder = vec![Candidate { chosen: true, ..chosen }];
    if !long::AVAILABLE {
        return ladder;
    }
    let fractions = Route::Lattice(Numbers::Exact(None));
    if family == Family::Lattice && fractions.run(question, f64::INFINITY).is_ok() {
        ladder.push(candidate("fractions".into(), fractions, DOUBLE, Times(30.0)));
    }
    // Cells cost about the cube of their digits, of which the plan takes eight more than asked; the lattice hardly more for long numbers.
    let growths = if family == Family::Lattice { [3.0, 1.5, 2.0, 4.0] } else { [30.0, 4.0, 15.0, 30.0] };
    let others = LONG.into_iter().zip(growths.map(Times)).filter(|(digits, _)| system != Numbers::Digits(*digits));
    ladder.extend(others.map(|(digits, growth)| {
        candidate(format!("{digits} digits"), Route::Planned(Numbers::Digits(digits)), digits + 8, growth)
    }));
    ladder
}

/// Enclosures, where they reach: an answer that is wrong by more than it says is impossible.
fn enclosures(question: &Question, plan: &Plan) -> Result<Ladder, String> {
    if question.problem.rod.damping.is_some() {
        within_first_contact(question).map_err(|why| format!("{why}: only that is proved under damping"))?;
    }
    let chosen = match plan.system {
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
        chosen: chosen == Some(digits),
        expected: if k == 0 { Seconds(1e-3) } else { Times(4.0) },
    };
    Ok(settings.into_iter().enumerate().map(candidate).collect())
}
