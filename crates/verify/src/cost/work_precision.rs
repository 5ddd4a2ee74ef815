//! The work–precision table: the routes that fit into the time, with the time and the error of each.

use std::time::{Duration, Instant};

use super::family::{Family, OmissionReason};
use super::ladder::{Candidate, Ladder, ladders, of_chain};
use super::timing::{Timing, check_budget, repeat};
use crate::error::VerifyError;
use crate::routes::{ChainQuestion, Question, Route, RouteQuestion, Truth};
use dalembert::Value;
use dalembert::number::Number;
use dalembert::solve::{Numbers, Plan};

/// A route at a setting, with its time and its error.
#[derive(Clone, Debug)]
pub struct CostRow {
    /// The route.
    pub family: Family,
    /// Number of the ladder: a family has one, or two, of the route by itself and as the plan takes it.
    pub ladder: usize,
    /// The setting: `N = 1024`.
    pub setting: String,
    /// `log₁₀` of the error relative to the truth, −∞ for no error. Relative to 1 where the truth is zero.
    pub log10_error: f64,
    /// The time.
    pub timing: Timing,
    /// Whether the plan takes this route.
    pub chosen: bool,
}

impl CostRow {
    /// Returns the relative error as a double: zero below the range of doubles.
    pub fn error(&self) -> f64 {
        10f64.powf(self.log10_error)
    }
}

/// A route, or a setting of one, that is not in the table.
#[derive(Clone, Debug)]
pub struct Omission {
    /// The route.
    pub family: Family,
    /// The first setting that is left out; `None` for the whole route.
    pub setting: Option<String>,
    /// The reason.
    pub why: OmissionReason,
}

/// One quantity by every route.
#[derive(Clone, Debug)]
pub struct CostTable {
    /// The name of the quantity.
    pub quantity: String,
    /// Its symbol.
    pub symbol: String,
    /// Its unit; empty where there is none or none is known.
    pub unit: &'static str,
    /// The time at which it is asked.
    pub time: Option<Number>,
    /// The truth.
    pub truth: Truth,
    /// The rows by route, the settings of each in order.
    pub rows: Vec<CostRow>,
    /// The routes and settings that are left out.
    pub left_out: Vec<Omission>,
}

/// Time of the truth and of the last long rows, in times of the longest row.
const FOR_TRUTH: f64 = 2.5;
/// Digits that the truth has beyond the most precise row.
const BEYOND: u32 = 30;
/// Share of the time that repeated runs may take.
const SHARE: f64 = 0.5;

/// Measures `question` by every route that can answer it, in about `seconds`. `observe` receives the share of the time
/// that is spent, and the name of the next run.
///
/// The plan's own run is always among the rows. The others come the cheapest first, by the time of the setting before;
/// a setting that is not expected to fit is left out, and so are those above it.
pub fn work_precision(
    question: &RouteQuestion,
    plan: &Plan,
    seconds: f64,
    observe: impl FnMut(f64, &str),
) -> Result<CostTable, VerifyError> {
    let (quantity, time) = (question.query.quantity, question.query.time.clone());
    let head = CostHead {
        quantity: quantity.name().into(),
        symbol: quantity.symbol().into(),
        unit: quantity.unit(&question.units),
        time,
    };
    measured(question, head, || ladders(question, plan), seconds, observe)
}

/// Measures `question` about a whole chain in the numbers that it can have, as [`work_precision`] does; `unit` is that
/// of its quantity.
pub fn chain_work_precision(
    question: &ChainQuestion,
    (numbers, unit): (Numbers, &'static str),
    seconds: f64,
    observe: impl FnMut(f64, &str),
) -> Result<CostTable, VerifyError> {
    let (quantity, time) = (question.name(), question.time.clone());
    let head = CostHead { symbol: quantity.clone(), quantity, unit, time };
    measured(question, head, || of_chain(question, numbers), seconds, observe)
}

/// The quantity of a table.
struct CostHead {
    quantity: String,
    symbol: String,
    unit: &'static str,
    time: Option<Number>,
}

fn measured(
    question: &impl Question,
    CostHead { quantity, symbol, unit, time }: CostHead,
    ladders: impl FnOnce() -> (Vec<Ladder>, Vec<(Family, OmissionReason)>),
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<CostTable, VerifyError> {
    check_budget(seconds)?;
    let start = Instant::now();
    let spent = || start.elapsed().as_secs_f64();
    let (all, without) = ladders();
    let count: usize = all.iter().map(Vec::len).sum();
    let slot = SHARE * seconds / count.max(1) as f64;
    let mut left_out: Vec<Omission> =
        without.into_iter().map(|(family, why)| Omission { family, setting: None, why }).collect();
    let mut measured: Vec<Measured> = Vec::with_capacity(count);
    // The next setting of each ladder stands last.
    let mut waiting: Vec<Ladder> = all.into_iter().map(|ladder| ladder.into_iter().rev().collect()).collect();
    while let Some((candidate, ladder)) = cheapest(&mut waiting) {
        observe(spent() / seconds, &format!("{}, {}", candidate.family, candidate.setting));
        // Rows of long numbers make the truth as dear as they are.
        let share = if candidate.digits > 20 { FOR_TRUTH } else { 1.0 };
        let left = seconds - spent();
        if !candidate.chosen && candidate.expected * share > left {
            left_out.push(candidate.left_out(OmissionReason::TooSlow(seconds)));
            waiting[ladder].clear();
            continue;
        }
        let began = Instant::now();
        let answer = measure(question, candidate.route, slot, left);
        let mut took = began.elapsed().as_secs_f64();
        match answer {
            Ok((value, timing)) => {
                took = timing.seconds;
                measured.push(Measured { candidate, ladder, value, timing });
            }
            // The scene has no quantity that its plan cannot answer.
            Err(error) if candidate.chosen => return Err(error),
            // A coarser setting may fail where a finer one does not.
            Err(error) => left_out.push(candidate.left_out(OmissionReason::NoAnswer(error))),
        }
        if let Some(next) = waiting[ladder].last_mut() {
            next.expected *= took.max(1e-7);
        }
    }
    let truth = truth(question, &mut measured, &mut left_out, |digits| {
        observe(spent() / seconds, &format!("the truth, to {digits} digits"));
    })?;
    let mut rows: Vec<CostRow> = measured.into_iter().map(|row| row.into_row(&truth)).collect();
    // Settings stay in the order of their ladder.
    rows.sort_by_key(|row| (row.family as u8, row.ladder));
    left_out.sort_by_key(|item| item.family as u8);
    Ok(CostTable { quantity, symbol, unit, time, truth, rows, left_out })
}

/// Computes the truth to more digits than every row of `measured` has. Rows without a truth are `left_out`, down to
/// doubles. `observe` receives the digits.
fn truth(
    question: &impl Question,
    measured: &mut Vec<Measured>,
    left_out: &mut Vec<Omission>,
    mut observe: impl FnMut(u32),
) -> Result<Truth, VerifyError> {
    loop {
        let digits = measured.iter().map(|row| row.candidate.digits).max().unwrap_or(0);
        observe(digits + BEYOND);
        let why = match Truth::compute(question, digits + BEYOND) {
            Err(error) if measured.iter().any(|row| row.candidate.digits < digits) => OmissionReason::NoTruth(error),
            found => return found,
        };
        let lost = measured.extract_if(.., |row| row.candidate.digits >= digits);
        left_out.extend(lost.map(|row| row.candidate.left_out(why.clone())));
    }
}

/// A candidate that has run.
struct Measured {
    candidate: Candidate,
    ladder: usize,
    value: Value,
    timing: Timing,
}

impl Measured {
    fn into_row(self, truth: &Truth) -> CostRow {
        let Measured { candidate: Candidate { family, setting, chosen, .. }, ladder, value, timing } = self;
        CostRow { family, ladder, setting, log10_error: truth.log10_error(&value), timing, chosen }
    }
}

/// Answers `question` by `route`, in the seconds that are `left`, and repeats the run for about as many seconds as
/// `slot`.
fn measure(question: &impl Question, route: Route, slot: f64, left: f64) -> Result<(Value, Timing), VerifyError> {
    let began = Instant::now();
    // A run that can stop itself leaves most of the time to others.
    let value = question.answer(route, left / 4.0)?;
    let once = began.elapsed().as_secs_f64();
    let left = (left - once).max(0.0);
    // Three samples at least, where that is little of what is left.
    let room = slot.max((4.0 * once).min(left / 8.0)).min(left);
    Ok((value, repeat(once, Duration::from_secs_f64(room), || question.answer(route, left))))
}

impl Candidate {
    fn left_out(self, why: OmissionReason) -> Omission {
        Omission { family: self.family, setting: Some(self.setting), why }
    }
}

/// Takes the setting with the least expected time, and returns it with the place of its ladder.
fn cheapest(waiting: &mut [Ladder]) -> Option<(Candidate, usize)> {
    let next = waiting.iter().enumerate().filter_map(|(k, rest)| Some((k, rest.last()?.expected)));
    let (k, _) = next.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((waiting[k].pop()?, k))
}
