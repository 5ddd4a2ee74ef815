//! Which routes fit into the time, and the table of what each took and how far it was off.

use std::time::{Duration, Instant};

use super::clock::{Timing, check_budget, repeat};
use super::ladder::{Candidate, Family, Ladder, ladders};
use crate::quantity::Question;
use crate::truth::Truth;
use crate::value::{NoAnswer, Value};
use dalembert::number::Number;
use dalembert::quantity::Quantity;
use dalembert::solve::Plan;

/// A route at a setting: what it cost and how far it was off.
#[derive(Clone, Debug)]
pub struct Row {
    pub family: Family,
    /// Rows of one family are of one ladder, or of two: of the route by itself, and as the plan takes it.
    pub ladder: usize,
    /// `N = 1024`.
    pub setting: String,
    /// `log₁₀` of the error relative to the truth, −∞ where there is none. Relative to 1 where the truth is zero.
    pub log10_error: f64,
    pub timing: Timing,
    pub chosen: bool,
}

impl Row {
    /// The relative error as a double: zero below what a double holds.
    pub fn error(&self) -> f64 {
        10f64.powf(self.log10_error)
    }
}

/// A route, or a setting of one, that is not in the table.
#[derive(Clone, Debug)]
pub struct LeftOut {
    pub family: Family,
    /// From this setting on; `None` for the whole route.
    pub setting: Option<String>,
    pub why: String,
}

#[derive(Clone, Debug)]
pub struct Table {
    pub quantity: Quantity,
    /// Its unit; empty where there is none or none is known.
    pub unit: &'static str,
    pub time: Option<Number>,
    pub truth: Truth,
    /// By route, and each route's settings in order.
    pub rows: Vec<Row>,
    pub left_out: Vec<LeftOut>,
}

/// What the truth and the last long rows may take of the time.
const FOR_TRUTH: f64 = 2.5;
/// Digits that the truth has beyond the most precise row.
const BEYOND: u32 = 30;
/// The share of the time that repeated runs may take.
const SHARE: f64 = 0.5;

/// Measures `question` by every route that can answer it, in about `seconds`. `observe` gets the share of the time that
/// is spent, and what runs next.
///
/// The plan's own run always is among the rows. All others come the cheapest first, by what the setting before took;
/// one that is not expected to fit is left out, and so are those above it.
pub fn work_precision(
    question: &Question,
    plan: &Plan,
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<Table, NoAnswer> {
    check_budget(seconds)?;
    let start = Instant::now();
    let spent = || start.elapsed().as_secs_f64();
    let (all, without) = ladders(question, plan);
    let count: usize = all.iter().map(Vec::len).sum();
    let slot = SHARE * seconds / count.max(1) as f64;
    let mut left_out: Vec<LeftOut> =
        without.into_iter().map(|(family, why)| LeftOut { family, setting: None, why }).collect();
    let mut taken: Vec<(Candidate, usize, Value, Timing)> = Vec::with_capacity(count);
    // The next setting last.
    let mut waiting: Vec<Ladder> = all.into_iter().map(|ladder| ladder.into_iter().rev().collect()).collect();
    while let Some((candidate, ladder)) = cheapest(&mut waiting) {
        observe(spent() / seconds, &format!("{}, {}", candidate.family.name(), candidate.setting));
        // Rows of long numbers make the truth as dear as they are.
        let share = if candidate.digits > 20 { FOR_TRUTH } else { 1.0 };
        let left = seconds - spent();
        if !candidate.chosen && candidate.expected * share > left {
            left_out.push(candidate.left_out(format!("not expected to fit into {seconds} seconds")));
            waiting[ladder].clear();
            continue;
        }
        let began = Instant::now();
        // A run that can stop itself leaves most of the time to others.
        let answer = candidate.route.run(question, left / 4.0);
        let once = began.elapsed().as_secs_f64();
        let mut took = once;
        match answer {
            Ok(value) => {
                let left = (seconds - spent()).max(0.0);
                // Three samples at least, where that is little of what is left.
                let room = slot.max((4.0 * once).min(left / 8.0)).min(left);
                let timing = repeat(once, Duration::from_secs_f64(room), || candidate.route.run(question, left));
                took = timing.seconds;
                taken.push((candidate, ladder, value, timing));
            }
            // What the plan cannot answer the scene does not have.
            Err(error) if candidate.chosen => return Err(error),
            // A coarser setting may fail where a finer one does not.
            Err(error) => left_out.push(candidate.left_out(error.to_string())),
        }
        if let Some(next) = waiting[ladder].last_mut() {
            next.expected *= took.max(1e-7);
        }
    }
    let truth = loop {
        let digits = taken.iter().map(|row| row.0.digits).max().unwrap_or(0);
        observe(spent() / seconds, &format!("the truth, to {} digits", digits + BEYOND));
        match Truth::computed(question, digits + BEYOND) {
            Ok(truth) => break truth,
            // What nothing can be held against is left out, down to doubles.
            Err(error) if taken.iter().any(|row| row.0.digits < digits) => {
                let (kept, lost): (Vec<_>, Vec<_>) = taken.into_iter().partition(|row| row.0.digits < digits);
                taken = kept;
                let why = format!("no truth to hold it against: {error}");
                left_out.extend(lost.into_iter().map(|(candidate, ..)| candidate.left_out(why.clone())));
            }
            Err(error) => return Err(error),
        }
    };
    let mut rows: Vec<Row> = taken
        .into_iter()
        .map(|(candidate, ladder, value, timing)| Row {
            family: candidate.family,
            ladder,
            setting: candidate.setting,
            log10_error: truth.log10_error(&value),
            timing,
            chosen: candidate.chosen,
        })
        .collect();
    // Settings stay in the order of their ladder.
    rows.sort_by_key(|row| (row.family as u8, row.ladder));
    left_out.sort_by_key(|item| item.family as u8);
    Ok(Table {
        quantity: question.one.quantity,
        unit: question.one.quantity.unit(&question.units),
        time: question.one.time.clone(),
        truth,
        rows,
        left_out,
    })
}

impl Candidate {
    fn left_out(self, why: String) -> LeftOut {
        LeftOut { family: self.family, setting: Some(self.setting), why }
    }
}

/// The setting that is expected to take the least, with the place of its ladder.
fn cheapest(waiting: &mut [Ladder]) -> Option<(Candidate, usize)> {
    let next = waiting.iter().enumerate().filter_map(|(k, rest)| Some((k, rest.last()?.expected)));
    let (k, _) = next.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((waiting[k].pop()?, k))
}
