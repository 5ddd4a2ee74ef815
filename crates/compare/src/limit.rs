//! Bounds for the tests of other projects, and the order that several files show.

use std::collections::BTreeMap;

use serde::Serialize;

use super::agree::Agreement;
use super::audit::Extreme;
use super::map::compared;
use super::norms::{NORMS, OfNorms, order};
use super::touch::Touch;
use dalembert::quantity::Quantity;

/// A bound for a test: `u.l2=0.1`, `energy=0.02`, `order.u=0.9`.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    name: String,
    bound: f64,
    /// Whether it fails below the bound, and not above.
    below: bool,
}

/// What comes of one [`Limit`] for one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The source; several for an order.
    pub file: String,
    /// What is expected: `u.l2 ≤ 1e-1`.
    pub expected: String,
    /// What was found, where that is not within the bound.
    pub failure: Option<String>,
}

/// What can be bounded besides the norms of quantities.
const AUDITED: [&str; 8] =
    ["coverage", "energy", "momentum", "impulse", "penetration", "tension", "missed", "invented"];

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {:e}", self.name, if self.below { '≥' } else { '≤' }, self.bound)
    }
}

impl std::str::FromStr for Limit {
    type Err = String;

    /// A bound that fails above.
    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("found `{text}`, expected {FORM}");
        let (name, bound) = text.split_once('=').ok_or_else(form)?;
        Limit::new(name, bound.trim().parse().map_err(|_| form())?, false).map_err(|_| form())
    }
}

const FORM: &str = "QUANTITY.NORM=BOUND with l1, l2, linf or linf_off_jumps, order.QUANTITY=BOUND, or one of coverage, \
                    energy, momentum, impulse, penetration, tension, missed and invented with its bound";

const ORDER: &str = "order.";
/// The place of the norm that is meant where none is named.
const L2: usize = 1;

/// The quantity and the place of the norm in `u.l2`.
fn split(name: &str) -> Option<(&str, usize)> {
    let (quantity, norm) = name.rsplit_once('.')?;
    Some((quantity, NORMS.iter().position(|known| known.0 == norm)?))
}

impl Limit {
    /// A bound of `name`, failing `below` it or above.
    ///
    /// **Errors**: a name that is none, a bound below zero.
    pub fn new(name: &str, bound: f64, below: bool) -> Result<Self, String> {
        let name = name.trim();
        let known = AUDITED.contains(&name) || name.starts_with(ORDER) || split(name).is_some();
        // A bound that is no number is none.
        if !known || bound.is_nan() || bound < 0.0 {
            return Err(format!("found `{name}={bound}`, expected {FORM}"));
        }
        Ok(Limit { name: name.into(), bound, below })
    }

    /// The same bound, failing below it.
    #[must_use]
    pub fn turned(self) -> Self {
        Limit { below: true, ..self }
    }

    fn outcome(&self, file: &str, found: Option<f64>) -> Outcome {
        let within = |found: f64| if self.below { found >= self.bound } else { found <= self.bound };
        let said = || found.map_or_else(|| "none".into(), |found| format!("{found:.3e}"));
        let failure = (!found.is_some_and(within)).then(said);
        Outcome { file: file.into(), expected: self.to_string(), failure }
    }

    /// What a file has of it: a norm relative to ours, or absolute where ours is zero, energy likewise.
    fn found(&self, agreement: &Agreement) -> Result<f64, String> {
        let audit = &agreement.audit;
        let lacks = |needs: &str| format!("found a bound of {}, expected data with {needs}", self.name);
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
                let off = |(a, b): &(Option<Touch>, Option<Touch>)| {
                    let (a, b) = (a.as_ref()?, b.as_ref()?);
                    // Of whole contacts.
                    a.to.zip(b.to)?;
                    Some((b.impulse? / a.impulse? - 1.0).abs())
                };
                let most = agreement.contacts.iter().filter_map(off).reduce(f64::max);
                most.ok_or_else(|| lacks("a force and a whole contact"))?
            }
            name => {
                let (quantity, norm) = split(name).unwrap_or((name, L2));
                let what = compared(quantity, agreement.grid.points.is_some());
                let compared = what.and_then(|what| agreement.column(what)).ok_or_else(|| {
                    let names: Vec<&str> = agreement.quantities.iter().map(|compared| compared.what.name()).collect();
                    format!("found a bound of {quantity}, expected one of {}", names.join(", "))
                })?;
                // Where no sample counts there is no difference.
                NORMS[norm].2(&compared.norms).map_or(0.0, |norm| norm.relative.unwrap_or(norm.absolute))
            }
        })
    }
}

/// What comes of `limits`, for each file and each bound. A run that breaks off fails whatever is bounded.
pub(crate) fn outcomes(
    files: &[(&str, &Agreement)],
    orders: &[Order],
    limits: &[Limit],
) -> Result<Vec<Outcome>, String> {
    let mut all = Vec::new();
    let is_order = |limit: &&Limit| limit.name.starts_with(ORDER);
    for (file, agreement) in files.iter().filter(|_| !limits.is_empty()) {
        let coverage = &agreement.coverage;
        let failure = coverage.breaks_off.then(|| format!("they end at t = {}", coverage.time[0]));
        let expected = format!("data up to t = {}", coverage.time[1]);
        all.push(Outcome { file: (*file).into(), expected, failure });
        for limit in limits.iter().filter(|limit| !is_order(limit)) {
            let found = limit.found(agreement).map_err(|error| format!("{file}: {error}"))?;
            all.push(limit.outcome(file, Some(found)));
        }
    }
    for limit in limits.iter().filter(is_order) {
        let name = limit.name.trim_start_matches(ORDER);
        let (quantity, norm) = split(name).unwrap_or((name, L2));
        let what = compared(quantity, false).map(Quantity::name);
        let rows: Vec<&Order> = orders.iter().filter(|order| Some(order.quantity) == what).collect();
        if rows.is_empty() {
            return Err(format!("found a bound of {}, expected several files with {quantity}", limit.name));
        }
        for order in rows {
            let found = order.orders.get(NORMS[norm].0).copied().flatten();
            let widths = format!("widths {} to {}", order.widths[0], order.widths[1]);
            all.push(limit.outcome(&widths, found.filter(|_| order.meaningless.is_none())));
        }
    }
    Ok(all)
}

/// The order of convergence of a quantity between two files.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Order {
    pub(crate) quantity: &'static str,
    pub(crate) widths: [f64; 2],
    #[serde(flatten)]
    pub(crate) orders: BTreeMap<&'static str, Option<f64>>,
    pub(crate) meaningless: Option<&'static str>,
}

/// Ends that are so many steps apart are not the same.
const LONGER: f64 = 2.0;

/// The observed orders between each file and the next, for every quantity that both have.
pub(crate) fn orders(files: &[&Agreement], widths: &[f64]) -> Vec<Order> {
    let mut rows = Vec::new();
    for compared in files.first().iter().flat_map(|file| &file.quantities) {
        for (pair, widths) in files.windows(2).zip(widths.windows(2)) {
            let [coarse, fine] = [pair[0], pair[1]].map(|file| file.column(compared.what).map(|c| c.norms));
            let Some((coarse, fine)) = coarse.zip(fine) else { continue };
            let between = |norm: OfNorms| {
                let (error, less) = norm(&coarse).zip(norm(&fine))?;
                order((widths[0], error.absolute), (widths[1], less.absolute))
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
                orders: NORMS.into_iter().map(|(name, _, norm)| (name, between(norm))).collect(),
            });
        }
    }
    rows
}
