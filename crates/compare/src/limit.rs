//! Bounds for the tests of other projects, and the order of convergence of several files.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::agreement::Agreement;
use super::audit::Extreme;
use super::contacts::ContactPair;
use super::map::compared;
use super::norms::{MeshError, NORMS, NormKind, convergence_order};
use dalembert::quantity::Quantity;

/// A bound for a test: `u.l2=0.1`, `energy=0.02`, `order.u=0.9`.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    name: String,
    bound: f64,
    /// Whether smaller values fail, and not greater ones.
    is_minimum: bool,
}

/// The outcome of one [`Limit`] for one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The source; several for an order.
    pub file: String,
    /// The bound: `u.l2 ≤ 1e-1`.
    pub expected: String,
    /// The value found, where it is not within the bound.
    pub failure: Option<String>,
}

/// The reason why a bound cannot be checked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
pub enum LimitError {
    #[error(
        "found `{0}`, expected QUANTITY.NORM=BOUND with l1, l2, linf or linf_off_jumps, order.QUANTITY=BOUND, or \
         one of coverage, energy, momentum, impulse, penetration, tension, missed and invented with its bound"
    )]
    Form(String),
    #[error("{file}: found a bound of {name}, expected data with {needs}")]
    Lacking { file: String, name: String, needs: &'static str },
    #[error("{file}: found a bound of {quantity}, expected one of {known}")]
    Quantity { file: String, quantity: String, known: String },
    #[error("found a bound of {name}, expected several files with {quantity}")]
    Order { name: String, quantity: String },
}

/// The names that can be bounded besides the norms of quantities.
const AUDITED: [&str; 8] =
    ["coverage", "energy", "momentum", "impulse", "penetration", "tension", "missed", "invented"];

const ORDER: &str = "order.";
/// The place in [`NORMS`] of the norm of a name without one.
const L2: usize = 1;

/// Splits `u.l2` into the quantity and the place of the norm.
fn split(name: &str) -> Option<(&str, usize)> {
    let (quantity, norm) = name.rsplit_once('.')?;
    Some((quantity, NORMS.iter().position(|known| known.name == norm)?))
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {:e}", self.name, if self.is_minimum { '≥' } else { '≤' }, self.bound)
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: expected {}", self.file, self.expected)?;
        self.failure.iter().try_for_each(|found| write!(f, ", found {found}"))
    }
}

impl std::str::FromStr for Limit {
    type Err = LimitError;

    /// Reads an upper bound.
    fn from_str(text: &str) -> Result<Self, LimitError> {
        let form = || LimitError::Form(text.into());
        let (name, bound) = text.split_once('=').ok_or_else(form)?;
        Limit::new(name, bound.trim().parse().map_err(|_| form())?).map_err(|_| form())
    }
}

impl Limit {
    /// Builds the upper bound of `name`.
    ///
    /// **Errors**: [`LimitError::Form`] for an unknown name and for a bound below zero.
    pub fn new(name: &str, bound: f64) -> Result<Self, LimitError> {
        let name = name.trim();
        let is_known = AUDITED.contains(&name) || name.starts_with(ORDER) || split(name).is_some();
        if !is_known || bound.is_nan() || bound < 0.0 {
            return Err(LimitError::Form(format!("{name}={bound}")));
        }
        Ok(Limit { name: name.into(), bound, is_minimum: false })
    }

    /// Returns the same bound as a lower one.
    #[must_use]
    pub fn into_minimum(self) -> Self {
        Limit { is_minimum: true, ..self }
    }

    /// Returns the bound of the quantity that `rename` gives; of an audit, the same. `None` if it gives none.
    pub(crate) fn renamed(&self, rename: impl Fn(&str) -> Option<String>) -> Option<Limit> {
        let (order, name) = match self.name.strip_prefix(ORDER) {
            Some(name) => (ORDER, name),
            None => ("", self.name.as_str()),
        };
        let (quantity, norm) = match split(name) {
            Some((quantity, _)) => name.split_at(quantity.len()),
            None => (name, ""),
        };
        Some(Limit { name: format!("{order}{}{norm}", rename(quantity)?), ..self.clone() })
    }

    fn outcome(&self, file: &str, found: Option<f64>) -> Outcome {
        let is_within = |found: f64| if self.is_minimum { found >= self.bound } else { found <= self.bound };
        let text = || found.map_or_else(|| "none".into(), |found| format!("{found:.3e}"));
        let failure = (!found.is_some_and(is_within)).then(text);
        Outcome { file: file.into(), expected: self.to_string(), failure }
    }

    /// Returns the value of a file that is bounded: a norm relative to the exact values, or absolute where these are
    /// zero, energy likewise.
    fn value(&self, file: &str, agreement: &Agreement) -> Result<f64, LimitError> {
        let audit = &agreement.audit;
        let lacks = |needs| LimitError::Lacking { file: file.into(), name: self.name.clone(), needs };
        let extreme = |extreme: &Option<Extreme>, needs| extreme.map(|most| most.value).ok_or_else(|| lacks(needs));
        Ok(match self.name.as_str() {
            "coverage" => agreement.coverage.share(),
            "missed" => audit.missed as f64,
            "invented" => audit.invented as f64,
            "penetration" => extreme(&audit.penetration, "u_end")?,
            "tension" => extreme(&audit.tension, "force, stress or strain")?,
            "momentum" => audit.momentum.ok_or_else(|| lacks("force, h_rate and a free top"))?.abs(),
            "energy" => {
                let energy = audit.energy_change.ok_or_else(|| lacks("E_total"))?;
                let most = energy.gain.value.max(energy.loss.value);
                if energy.start == 0.0 { most } else { most / energy.start }
            }
            "impulse" => {
                let whole = |pair: &ContactPair| {
                    let (ours, theirs) = (pair.ours.as_ref()?, pair.theirs.as_ref()?);
                    ours.release.zip(theirs.release)?;
                    Some((theirs.impulse? / ours.impulse? - 1.0).abs())
                };
                let most = agreement.contacts.iter().filter_map(whole).reduce(f64::max);
                most.ok_or_else(|| lacks("a force and a whole contact"))?
            }
            name => {
                let (quantity, norm) = split(name).unwrap_or((name, L2));
                let what = compared(quantity, agreement.grid.points.is_some());
                let column = what.and_then(|what| agreement.column(what)).ok_or_else(|| {
                    let names: Vec<&str> = agreement.quantities.iter().map(|compared| compared.what.name()).collect();
                    LimitError::Quantity { file: file.into(), quantity: quantity.into(), known: names.join(", ") }
                })?;
                // There is no difference where no sample counts.
                (NORMS[norm].get)(&column.norms).map_or(0.0, |norm| norm.relative.unwrap_or(norm.absolute))
            }
        })
    }
}

/// Checks `limits` for each file. A run that breaks off fails whatever is bounded.
pub(crate) fn outcomes(
    files: &[(&str, &Agreement)],
    orders: &[Order],
    limits: &[Limit],
) -> Result<Vec<Outcome>, LimitError> {
    let mut all = Vec::new();
    let is_order = |limit: &&Limit| limit.name.starts_with(ORDER);
    for (file, agreement) in files.iter().filter(|_| !limits.is_empty()) {
        let coverage = &agreement.coverage;
        let failure = coverage.breaks_off.then(|| format!("they end at t = {}", coverage.time[0]));
        let expected = format!("data up to t = {}", coverage.time[1]);
        all.push(Outcome { file: (*file).into(), expected, failure });
        for limit in limits.iter().filter(|limit| !is_order(limit)) {
            all.push(limit.outcome(file, Some(limit.value(file, agreement)?)));
        }
    }
    for limit in limits.iter().filter(is_order) {
        let name = limit.name.trim_start_matches(ORDER);
        let (quantity, norm) = split(name).unwrap_or((name, L2));
        let what = compared(quantity, false).map(Quantity::name);
        let rows: Vec<&Order> = orders.iter().filter(|order| Some(order.quantity) == what).collect();
        if rows.is_empty() {
            return Err(LimitError::Order { name: limit.name.clone(), quantity: quantity.into() });
        }
        for order in rows {
            let found = order.orders.get(NORMS[norm].name).copied().flatten();
            let widths = format!("widths {} to {}", order.widths[0], order.widths[1]);
            all.push(limit.outcome(&widths, found.filter(|_| order.meaningless.is_none())));
        }
    }
    Ok(all)
}

/// The order of convergence of a quantity between two files.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Order {
    pub(crate) quantity: &'static str,
    pub(crate) widths: [f64; 2],
    #[serde(flatten)]
    pub(crate) orders: BTreeMap<&'static str, Option<f64>>,
    /// The reason why the orders mean nothing.
    pub(crate) meaningless: Option<&'static str>,
}

/// Number of steps from which on the ends of two files differ.
const LONGER: f64 = 2.0;

/// Returns the observed orders between each file and the next, for every quantity that both have.
pub(crate) fn orders(files: &[&Agreement], widths: &[f64]) -> Vec<Order> {
    let mut rows = Vec::new();
    for compared in files.first().iter().flat_map(|file| &file.quantities) {
        for (pair, widths) in files.windows(2).zip(widths.windows(2)) {
            let [coarse, fine] = [pair[0], pair[1]].map(|file| file.column(compared.what).map(|c| c.norms));
            let Some((coarse, fine)) = coarse.zip(fine) else { continue };
            let between = |norm: &NormKind| {
                let (coarse, fine) = (norm.get)(&coarse).zip((norm.get)(&fine))?;
                let run = |width, error| MeshError { width, error };
                convergence_order(run(widths[0], coarse.absolute), run(widths[1], fine.absolute))
            };
            let apart = |a: f64, b: f64| (a - b).abs() > LONGER * pair[0].step.max(pair[1].step);
            let [coarse_end, fine_end] = [pair[0], pair[1]].map(|file| file.coverage.time[0]);
            let meaningless = if widths[0] == widths[1] {
                Some("the widths are the same")
            } else if pair.iter().any(|file| file.coverage.breaks_off) || apart(coarse_end, fine_end) {
                Some("the files do not cover the same times")
            } else if coarse.l2.relative.is_some_and(|l2| l2 >= 1.0) {
                Some("the coarser one is as far off as no motion at all")
            } else {
                None
            };
            rows.push(Order {
                meaningless,
                quantity: compared.what.name(),
                widths: [widths[0], widths[1]],
                orders: NORMS.iter().map(|norm| (norm.name, between(norm))).collect(),
            });
        }
    }
    rows
}
