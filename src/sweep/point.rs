//! What is asked of a point, and its answer.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::grid::Grid;
use crate::number::{Number, Scalar, bound_json, number_json, shown_bound_text};
use crate::problem::Problem;
use crate::routes::{NoAnswer, Quantity, Question, asked};
use crate::solve::{self, History, Numbers, Plan, Solution, Target, unobserved};

/// The numbers that are asked of every point.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) quantities: Vec<Quantity>,
    /// For quantities at a time; at the first bounce without it.
    pub(crate) time: Option<Number>,
    pub(crate) numbers: Numbers,
}

/// A point and its numbers, in the order of the quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Point {
    pub(crate) index: usize,
    pub(crate) cells: Vec<Cell>,
}

/// One number, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Cell {
    /// As JSON has it: a number for a double, otherwise a text, or an enclosure; null where there is none.
    pub(crate) value: Value,
    /// How far it may be off.
    pub(crate) uncertainty: Value,
    /// Why there is no value, or what a user should know of it: where exactness ends, and warnings of the history.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(crate) note: Option<String>,
}

impl Cell {
    fn none(why: impl std::fmt::Display) -> Self {
        Cell { note: Some(why.to_string()), ..Cell::default() }
    }

    fn noted(self, note: String) -> Self {
        Cell { note: Some(self.note.map_or_else(|| note.clone(), |before| format!("{before}; {note}"))), ..self }
    }
}

impl Asked {
    /// The numbers of a point. What cannot be answered is an answer too.
    pub(crate) fn answer(&self, grid: &Grid, index: usize) -> Point {
        let cells = match grid.problem(index) {
            Ok(problem) => self.cells(&problem),
            Err(error) => vec![Cell::none(error); self.quantities.len()],
        };
        Point { index, cells }
    }

    /// Quantities that the same run answers share it.
    fn cells(&self, problem: &Problem) -> Vec<Cell> {
        let mut runs: Vec<(solve::Question, Result<Solution, String>)> = Vec::new();
        let mut cells = Vec::with_capacity(self.quantities.len());
        for quantity in &self.quantities {
            let time = self.time.clone().filter(|_| quantity.is_at_a_time());
            let question = Question::new(problem.clone(), *quantity, time);
            let run = asked(&question, self.numbers);
            let known = runs.iter().position(|(other, _)| *other == run);
            let known = known.unwrap_or_else(|| {
                let plan = Plan::of(problem, &run);
                let solution = plan.and_then(|plan| plan.solve(problem, unobserved()));
                runs.push((run, solution.map_err(|error| error.to_string())));
                runs.len() - 1
            });
            cells.push(match &runs[known].1 {
                Ok(solution) => in_solution(&question, solution),
                Err(why) => Cell::none(why),
            });
        }
        cells
    }
}

fn in_solution(question: &Question, solution: &Solution) -> Cell {
    match solution {
        Solution::Double(history) => cell(question, history, 0),
        Solution::Exact(history) => cell(question, history, 0),
        Solution::Digits(history, n) => cell(question, history, *n),
        Solution::DigitsAfter(history, n, end) => {
            cell(question, history, *n).noted(format!("{end}; the number is in {n} digits"))
        }
        Solution::Certified(history, n) => cell(question, history, *n),
    }
}

fn cell<S: Target<Carried: crate::routes::System>>(question: &Question, history: &History<S>, digits: u32) -> Cell {
    let cell = match question.find_settled(history) {
        Ok(found) if !found.value.is_finite() => Cell::none("no finite number"),
        Ok(found) => Cell {
            value: number_json(&found.value, digits),
            uncertainty: match bound_json(&found.value, digits) {
                Value::Null => shown_bound_text(&found.value, digits).into(),
                bound => bound,
            },
            note: None,
        },
        Err(NoAnswer::NoSuchQuantity { why, .. }) => Cell::none(why),
        Err(error) => Cell::none(error),
    };
    history.warnings().iter().fold(cell, |cell, warning| cell.noted(warning.to_string()))
}
