//! The exact solution of an undamped rod as a function for other programs: Python, MATLAB, C.

use super::reference::Preamble;
use crate::number::{Scalar, bound_of_log2};
use crate::problem::Top;
use crate::wave::Waves;

/// A language of functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// A module without dependencies; in fractions with --exact
    Python,
    /// A function file
    Matlab,
    /// A header with static functions, C99
    C,
}

/// What every such function says of itself.
const FORMULA: &[&str] = &[
    "u(x,t) = (P(t - x/c) + sign P(t + x/c - 2L/c))/2 + a + b x + d x^2, d'Alembert's waves, with a",
    "piecewise quadratic function P: each row of the table is from, P, P', P'' there.",
    "d = 0 gives the displacement u, d = 1 the strain du/dx, d = 2 the velocity du/dt; at a jump the limit from",
    "later times, or within rounding of it either one. Times from 0 to the end of the table's history, which like",
    "the length may be passed by a few roundings.",
];

/// The length and the end may be passed by this factor: steps that add up to them are some roundings off.
const NEAR: &str = "1 + 2e-15";

/// The function `uExact(x, t, d)` of `waves`, which reach to `end`.
pub fn code<S: Scalar>(waves: &Waves<S>, end: &S, language: Language, preamble: &Preamble<'_>) -> String {
    // Fractions stay fractions where the language has them.
    let exact = language == Language::Python && end.bits().is_none() && end.ends(1).is_none();
    let number = |x: &S| match exact {
        true => format!("F(\"{}\")", x.text()),
        false => format!("{:?}", x.to_f64() + 0.0),
    };
    let sign = if waves.top == Top::Free { "1" } else { "-1" };
    let constants: Vec<(&str, String)> = [
        ("LENGTH", &waves.length),
        ("WAVE_SPEED", &waves.wave_speed),
        ("ROUND_TRIP", &waves.round_trip),
        ("END", end),
        ("A", &waves.constant),
        ("B", &waves.linear),
        ("D", &waves.quadratic),
    ]
    .map(|(name, value)| (name, number(value)))
    .into();
    let rows: Vec<[String; 4]> =
        waves.pieces.iter().map(|piece| [&piece.from, &piece.sum, &piece.rate, &piece.slope].map(number)).collect();
    let error = waves.numbers().map(S::log2_error).fold(f64::NEG_INFINITY, f64::max);
    let worth = match exact {
        true => "The coefficients are exact.".to_string(),
        false => format!("Each coefficient is within {} before it is rounded to a double.", bound_of_log2(error)),
    };
    let remarks: Vec<String> =
        preamble.lines().chain(FORMULA.iter().map(|line| line.to_string())).chain([worth]).collect();
    match language {
        Language::Python => python(&remarks, &constants, sign, &rows, exact),
        Language::Matlab => matlab(&remarks, &constants, sign, &rows),
        Language::C => c(&remarks, &constants, sign, &rows),
    }
}

fn comment(mark: &str, lines: &[String]) -> String {
    lines.iter().map(|line| format!("{mark} {line}\n")).collect()
}

fn python(remarks: &[String], constants: &[(&str, String)], sign: &str, rows: &[[String; 4]], exact: bool) -> String {
    let mut text = comment("#", remarks);
    text += "from bisect import bisect_right\n";
    if exact {
        text += "from fractions import Fraction as F\n";
    }
    text += "\n";
    for (name, value) in constants {
        text += &format!("{name} = {value}\n");
    }
    text += &format!("SIGN = {sign}\nTABLE = [\n");
    for row in rows {
        text += &format!("    ({}),\n", row.join(", "));
    }
    text += "]\n_FROM = [row[0] for row in TABLE]\n";
    text += &format!("_NEAR = {NEAR}\n\n\n");
    text += "def _wave(s):\n    \"\"\"P and P' at s.\"\"\"\n";
    text += "    start, value, rate, slope = TABLE[max(bisect_right(_FROM, s) - 1, 0)]\n    tau = s - start\n";
    text += "    return value + (rate + slope * tau / 2) * tau, rate + slope * tau\n\n\n";
    text += "def uExact(x, t, d=0):\n";
    text += "    \"\"\"The displacement (d=0), the strain (d=1) or the velocity (d=2) at x and t.\n\n";
    text += "    Arrays of NumPy are broadcast against each other.\n    \"\"\"\n";
    text += "    if hasattr(x, \"__iter__\") or hasattr(t, \"__iter__\"):\n        from numpy import vectorize\n\n";
    let kind = if exact { "object" } else { "float" };
    text += &format!("        return vectorize(uExact, otypes=[{kind}])(x, t, d)\n");
    text += "    if not (0 <= x <= LENGTH * _NEAR and 0 <= t <= END * _NEAR):\n";
    text += "        raise ValueError(f\"found x = {x}, t = {t}, expected 0 <= x <= {LENGTH} and 0 <= t <= {END}\")\n";
    text += "    up, rise = _wave(t - x / WAVE_SPEED)\n";
    text += "    down, fall = _wave(t + x / WAVE_SPEED - ROUND_TRIP)\n";
    text += "    if d == 0:\n        return (up + SIGN * down) / 2 + A + (B + D * x) * x\n";
    text += "    if d == 1:\n        return (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x\n";
    text += "    if d == 2:\n        return (rise + SIGN * fall) / 2\n";
    text += "    raise ValueError(f\"found d = {d}, expected 0, 1 or 2\")\n";
    text
}

fn matlab(remarks: &[String], constants: &[(&str, String)], sign: &str, rows: &[[String; 4]]) -> String {
    let mut text = String::from("function value = uExact(x, t, d)\n");
    text += "% uExact  Displacement (d=0), strain (d=1) or velocity (d=2) of the rod at x and t.\n";
    text += "% x and t are numbers or arrays of the same size.\n";
    text += &comment("%", remarks);
    text += "if nargin < 3, d = 0; end\n";
    for (name, value) in constants {
        text += &format!("{name} = {value};\n");
    }
    text += &format!("SIGN = {sign};\n");
    text += "persistent TABLE\nif isempty(TABLE)\n    TABLE = [\n";
    for row in rows {
        text += &format!("        {}\n", row.join(" "));
    }
    text += "    ];\nend\n";
    text += &format!("NEAR = {NEAR};\n");
    text += "if any(x(:) < 0 | x(:) > LENGTH * NEAR) || any(t(:) < 0 | t(:) > END * NEAR)\n";
    text += "    error('expected 0 <= x <= %g and 0 <= t <= %g', LENGTH, END);\nend\n";
    text += "[up, rise] = wave(TABLE, t - x / WAVE_SPEED);\n";
    text += "[down, fall] = wave(TABLE, t + x / WAVE_SPEED - ROUND_TRIP);\n";
    text += "switch d\n    case 0, value = (up + SIGN * down) / 2 + A + (B + D * x) .* x;\n";
    text += "    case 1, value = (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x;\n";
    text += "    case 2, value = (rise + SIGN * fall) / 2;\n";
    text += "    otherwise, error('found d = %g, expected 0, 1 or 2', d);\nend\nend\n\n";
    text += "function [value, rate] = wave(table, s)\n";
    text += "k = reshape(arrayfun(@(s) max(find(table(:, 1) <= s, 1, 'last'), 1), max(s, table(1, 1))), size(s));\n";
    text += "column = @(j) reshape(table(k, j), size(s));\n";
    text += "tau = s - column(1);\nslope = column(4);\n";
    text += "value = column(2) + (column(3) + slope .* tau / 2) .* tau;\nrate = column(3) + slope .* tau;\nend\n";
    text
}

fn c(remarks: &[String], constants: &[(&str, String)], sign: &str, rows: &[[String; 4]]) -> String {
    let mut text = comment("//", remarks);
    text += "#ifndef DALEMBERT_UEXACT_H\n#define DALEMBERT_UEXACT_H\n#include <math.h>\n#include <stddef.h>\n\n";
    text += &format!("static const double uExact_table[{}][4] = {{\n", rows.len());
    for row in rows {
        text += &format!("    {{{}}},\n", row.join(", "));
    }
    text += "};\n\n// P and P' at s.\n";
    text += "static inline void uExact_wave(double s, double *value, double *rate) {\n";
    text += &format!("    size_t from = 0, to = {};\n", rows.len());
    text += "    while (to - from > 1) {\n        const size_t middle = (from + to) / 2;\n";
    text += "        if (uExact_table[middle][0] <= s) from = middle; else to = middle;\n    }\n";
    text += "    const double *row = uExact_table[from];\n    const double tau = s - row[0];\n";
    text += "    *value = row[1] + (row[2] + row[3] * tau / 2) * tau;\n    *rate = row[2] + row[3] * tau;\n}\n\n";
    text += "// The displacement (d = 0), the strain (d = 1) or the velocity (d = 2) at x and t; NAN outside.\n";
    text += "static inline double uExact(double x, double t, int d) {\n    const double ";
    text += &constants.iter().map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ");
    text += &format!(", SIGN = {sign}, NEAR = {NEAR};\n");
    text += "    double up, rise, down, fall;\n";
    text += "    if (!(x >= 0 && x <= LENGTH * NEAR && t >= 0 && t <= END * NEAR) || d < 0 || d > 2) return NAN;\n";
    text += "    uExact_wave(t - x / WAVE_SPEED, &up, &rise);\n";
    text += "    uExact_wave(t + x / WAVE_SPEED - ROUND_TRIP, &down, &fall);\n";
    text += "    if (d == 0) return (up + SIGN * down) / 2 + A + (B + D * x) * x;\n";
    text += "    if (d == 1) return (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x;\n";
    text += "    return (rise + SIGN * fall) / 2;\n}\n\n#endif\n";
    text
}
