//! Which runs fit into the time, the cheapest first, and the table that comes of it.

use std::time::{Duration, Instant};

use super::CostError;
use super::clock::{Timing, repeat};
use super::question::{Quantity, Question};
use super::routes::{Candidate, Expected, Ladder, Route, ladders};
use super::truth::{Truth, truth};
use super::value::Value;
use crate::scene::Plan;

/// A route at a setting: what it cost and how far it was off.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The way taken.
    pub route: Route,
    /// Its setting: `N = 1024`.
    pub setting: String,
    /// `log₁₀` of the error relative to the truth, −∞ where there is none. Relative to 1 where the truth is zero.
    pub log10_error: f64,
    /// How long it took.
    pub timing: Timing,
    /// Whether this is what the plan does.
    pub chosen: bool,
}

impl Row {
    /// The relative error as a double: zero below what a double holds.
    pub fn error(&self) -> f64 {
        10f64.powf(self.log10_error)
    }
}

/// A route, or a setting of one, that is not in the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The way not taken.
    pub route: Route,
    /// From this setting on; `None` for the whole route.
    pub setting: Option<String>,
    /// Why.
    pub why: String,
}

/// Work and precision of one quantity.
#[derive(Clone, Debug)]
pub struct Table {
    /// What was asked.
    pub quantity: Quantity,
    /// When, for a quantity at a time.
    pub time: Option<crate::Number>,
    /// What errors are measured against.
    pub truth: Truth,
    /// By route, and each route's settings in order.
    pub rows: Vec<Row>,
    /// What is not there, and why.
    pub left_out: Vec<LeftOut>,
}

/// What the truth and the last long rows may take of the time.
const FOR_TRUTH: f64 = 2.5;
/// Digits that the truth has beyond the most precise row.
const BEYOND: u32 = 30;
/// The share of the time that repeated runs may take.
const SHARE: f64 = 0.5;

/// Measures `question` by every route that can answer it, in about `seconds`. `observe` is told the share of the time that is
/// spent, and what runs next.
///
/// The plan's own run always is among the rows. All others come the cheapest first, by what the setting before took; one that is not
/// expected to fit is left out, and so are those above it.
///
/// **Accuracy**: times are medians on this machine, now; errors are measured against [`truth`] with thirty digits more than the
/// most precise row.
///
/// **Errors**: [`CostError::Seconds`]; [`CostError::NoSuchQuantity`] where the scene has no such quantity; those of the solver.
pub fn work_precision(
    question: &Question,
    plan: &Plan,
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<Table, CostError> {
    if !(seconds > 0.0 && seconds <= 86_400.0) {
        return Err(CostError::Seconds { found: seconds });
    }
    let start = Instant::now();
    let spent = || start.elapsed().as_secs_f64();
    let (all, without) = ladders(question, plan);
    let count: usize = all.iter().map(Vec::len).sum();
    let slot = SHARE * seconds / count.max(1) as f64;
    let mut left_out: Vec<LeftOut> =
        without.into_iter().map(|(route, why)| LeftOut { route, setting: None, why }).collect();
    let mut taken: Vec<(Candidate<'_>, Value, Timing)> = Vec::with_capacity(count);
    let mut waiting: Vec<Waiting<'_>> = all.into_iter().map(Waiting::new).collect();
    while let Some(next) = cheapest(&mut waiting) {
        let (candidate, expected, ladder) = next;
        observe(spent() / seconds, &format!("{}, {}", candidate.route.name(), candidate.setting));
        // Rows of long numbers make the truth as dear as they are.
        let share = if candidate.digits > 20 { FOR_TRUTH } else { 1.0 };
        let left = seconds - spent();
        if !candidate.chosen && expected * share > left {
            let why = format!("not expected to fit into {seconds} seconds: --seconds gives more");
            left_out.push(LeftOut { route: candidate.route, setting: Some(candidate.setting), why });
            close(&mut waiting, ladder);
            continue;
        }
        let began = Instant::now();
        // A run that can stop itself leaves most of the time to others.
        let answer = (candidate.run)(left / 4.0);
        let once = began.elapsed().as_secs_f64();
        match answer {
            Ok(value) => {
                let left = (seconds - spent()).max(0.0);
                // Three samples at least, where that is little of what is left.
                let room = slot.max((4.0 * once).min(left / 8.0)).min(left);
                let timing = repeat(once, Duration::from_secs_f64(room), || (candidate.run)(left));
                advance(&mut waiting, ladder, timing.seconds.max(1e-7));
                taken.push((candidate, value, timing));
            }
            // What the plan cannot answer the scene does not have.
            Err(error) if candidate.chosen => return Err(error),
            Err(error) => {
                // A coarser setting may fail where a finer one does not.
                advance(&mut waiting, ladder, once.max(1e-7));
                let (route, setting) = (candidate.route, Some(candidate.setting));
                left_out.push(LeftOut { route, setting, why: error.to_string() });
            }
        }
    }
    let truth = loop {
        let digits = taken.iter().map(|row| row.0.digits).max().unwrap_or(0);
        observe(spent() / seconds, &format!("the truth, to {} digits", digits + BEYOND));
        match truth(question, plan, digits + BEYOND) {
            Ok(truth) => break truth,
            // What nothing can be held against is left out, down to doubles.
            Err(error) if taken.iter().any(|row| row.0.digits < digits) => {
                let (kept, lost) = taken.into_iter().partition(|row| row.0.digits < digits);
                taken = kept;
                left_out.extend(lost.into_iter().map(|(candidate, _, _): (Candidate<'_>, _, _)| {
                    let why = format!("no truth to hold it against: {error}");
                    LeftOut { route: candidate.route, setting: Some(candidate.setting), why }
                }));
            }
            Err(error) => return Err(error),
        }
    };
    let scale = truth.value.to_f64().abs().log10();
    let scale = if scale.is_finite() { scale } else { 0.0 };
    let mut rows: Vec<Row> = taken
        .into_iter()
        .map(|(candidate, value, timing)| Row {
            route: candidate.route,
            setting: candidate.setting,
            log10_error: value.log10_apart(&truth.value) - scale,
            timing,
            chosen: candidate.chosen,
        })
        .collect();
    // A stable sort: settings stay in the order of their ladder.
    rows.sort_by_key(|row| row.route);
    left_out.sort_by_key(|item| item.route);
    Ok(Table { quantity: question.quantity, time: question.time.clone(), truth, rows, left_out })
}

/// A ladder whose lowest settings have been taken.
struct Waiting<'a> {
    rest: std::iter::Peekable<std::vec::IntoIter<Candidate<'a>>>,
    /// Seconds that the last setting took.
    before: f64,
}

impl<'a> Waiting<'a> {
    fn new(ladder: Ladder<'a>) -> Self {
        Waiting { rest: ladder.into_iter().peekable(), before: 1.0 }
    }

    fn expected(&mut self) -> Option<f64> {
        let before = self.before;
        self.rest.peek().map(|candidate| match candidate.expected {
            Expected::Seconds(seconds) => seconds,
            Expected::Times(factor) => factor * before,
        })
    }
}

/// The setting that is expected to take the least, with that time and the place of its ladder.
fn cheapest<'a>(waiting: &mut [Waiting<'a>]) -> Option<(Candidate<'a>, f64, usize)> {
    let expected = waiting.iter_mut().enumerate().filter_map(|(k, ladder)| Some((k, ladder.expected()?)));
    let (k, expected) = expected.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let candidate = waiting.get_mut(k)?.rest.next()?;
    Some((candidate, expected, k))
}

fn advance(waiting: &mut [Waiting<'_>], k: usize, seconds: f64) {
    if let Some(ladder) = waiting.get_mut(k) {
        ladder.before = seconds;
    }
}

fn close(waiting: &mut [Waiting<'_>], k: usize) {
    if let Some(ladder) = waiting.get_mut(k) {
        ladder.rest = Vec::new().into_iter().peekable();
    }
}
