//! The exact solution of an undamped rod as a function for other programs: Python, MATLAB, C.

use super::header::Header;
use dalembert::engine::WavePiece;
use dalembert::number::bound_of_log2;
use dalembert::problem::Top;
use dalembert::solve::History;
use dalembert::{Error, Value};

/// A programming language of functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Language {
    /// A module without dependencies; in fractions where the numbers are
    Python,
    /// A function file
    Matlab,
    /// A header with static functions, C99
    C,
}

/// Comment at the head of every function.
const FORMULA: &[&str] = &[
    "u(x,t) = (P(t - x/c) + sign P(t + x/c - 2L/c))/2 + a + b x + d x^2, d'Alembert's waves, with a",
    "piecewise quadratic function P: each row of the table is from, P, P', P'' there.",
    "d = 0 gives the displacement u, d = 1 the strain du/dx, d = 2 the velocity du/dt; at a jump the limit from",
    "later times, or within rounding of it either one. Times from 0 to the end of the table's history, which like",
    "the length may be passed by a few roundings.",
];

/// Factor by which a time or a point may exceed the end or the length: sums of steps are some roundings off.
const NEAR: &str = "1 + 2e-15";

/// Returns the function `uExact(x, t, d)` of a history of an undamped rod.
pub(crate) fn code(history: &History, language: Language, header: &Header) -> Result<String, Error> {
    let (waves, end) = (history.waves()?, history.end());
    // Fractions stay fractions where the language has them.
    let exact = language == Language::Python && end.as_rational().is_some();
    let number = |x: &Value| match x.as_rational() {
        Some(fraction) if exact => format!("F(\"{fraction}\")"),
        _ => format!("{:?}", x.to_f64() + 0.0),
    };
    let sign = if waves.top == Top::Free { "1" } else { "-1" };
    let constants = [
        ("LENGTH", &waves.length),
        ("WAVE_SPEED", &waves.wave_speed),
        ("ROUND_TRIP", &waves.round_trip),
        ("END", &end),
        ("A", &waves.constant),
        ("B", &waves.linear),
        ("D", &waves.quadratic),
    ]
    .map(|(name, value)| (name, number(value)));
    let mut rows: Vec<[String; 4]> = Vec::with_capacity(waves.pieces.len());
    for WavePiece { from, sum, rate, slope } in &waves.pieces {
        rows.push([number(from), number(sum), number(rate), number(slope)]);
    }
    let mut error = f64::NEG_INFINITY;
    for number in waves.numbers() {
        error = error.max(number.log2_error());
    }
    Ok(written((constants, rows, error), (language, exact, sign), header))
}

/// The numbers as texts: constants by their names, pieces, and `log₂` of the greatest bound.
type Numbers = ([(&'static str, String); 7], Vec<[String; 4]>, f64);

/// The function with these numbers; its sign is that of the wave that comes back from the top.
fn written(
    (constants, rows, error): Numbers,
    (language, exact, sign): (Language, bool, &str),
    header: &Header,
) -> String {
    let worth = match exact {
        true => "The coefficients are exact.".to_string(),
        false => format!("Each coefficient is within {} before it is rounded to a double.", bound_of_log2(error)),
    };
    let lines = header.lines().into_iter().chain(FORMULA.iter().map(|line| line.to_string())).chain([worth]);
    let (mark, template) = match language {
        Language::Python => ("#", include_str!("code/uExact.py")),
        Language::Matlab => ("%", include_str!("code/uExact.m")),
        Language::C => ("//", include_str!("code/uExact.h")),
    };
    let remarks: String = lines.map(|line| format!("{mark} {line}\n")).collect();
    let assigned = constants.iter().map(|(name, value)| format!("{name} = {value}"));
    let constants: String = match language {
        Language::Python => assigned.map(|line| line + "\n").collect(),
        Language::Matlab => assigned.map(|line| line + ";\n").collect(),
        Language::C => assigned.collect::<Vec<_>>().join(", "),
    };
    let row = |row: &[String; 4]| match language {
        Language::Python => format!("    ({}),\n", row.join(", ")),
        Language::Matlab => format!("        {}\n", row.join(" ")),
        Language::C => format!("    {{{}}},\n", row.join(", ")),
    };
    let parts = [
        ("@FRACTIONS@", if exact { "from fractions import Fraction as F\n".into() } else { String::new() }),
        ("@KIND@", if exact { "object".into() } else { "float".into() }),
        ("@CONSTANTS@", constants),
        ("@SIGN@", sign.into()),
        ("@COUNT@", rows.len().to_string()),
        ("@ROWS@", rows.iter().map(row).collect::<Vec<_>>().concat()),
        ("@NEAR@", NEAR.into()),
        // Last, because a title may hold anything.
        ("@REMARKS@", remarks),
    ];
    parts.iter().fold(template.to_string(), |text, (mark, part)| text.replace(mark, part))
}
