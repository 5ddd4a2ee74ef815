//! Bounds for the tests of other projects, and the order that several files show.

use serde::Serialize;

use super::agree::Agreement;
use super::map::compared;
use super::norms::{Norms, order};

/// A bound of a norm: `u.l2=0.1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    quantity: String,
    norm: NormName,
    bound: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum NormName {
    L1,
    L2,
    Linf,
    LinfOffJumps,
}

const NORMS: [(&str, NormName); 4] =
    [("l1", NormName::L1), ("l2", NormName::L2), ("linf", NormName::Linf), ("linf_off_jumps", NormName::LinfOffJumps)];

impl NormName {
    /// Absolute and relative; `None` where no sample has a say.
    fn of(self, norms: &Norms) -> Option<(f64, Option<f64>)> {
        match self {
            NormName::L1 => Some((norms.l1.absolute, norms.l1.relative)),
            NormName::L2 => Some((norms.l2.absolute, norms.l2.relative)),
            NormName::Linf => Some((norms.linf.absolute, norms.linf.relative)),
            NormName::LinfOffJumps => norms.linf_off_jumps.map(|most| (most.absolute, most.relative)),
        }
    }
}

impl std::str::FromStr for Limit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("found `{text}`, expected QUANTITY.NORM=BOUND with l1, l2, linf or linf_off_jumps");
        let (place, bound) = text.split_once('=').ok_or_else(form)?;
        let (quantity, norm) = place.trim().rsplit_once('.').ok_or_else(form)?;
        let norm = NORMS.iter().find(|(name, _)| *name == norm).ok_or_else(form)?.1;
        let bound = bound.trim().parse().ok().filter(|bound: &f64| *bound >= 0.0).ok_or_else(form)?;
        Ok(Limit { quantity: quantity.into(), norm, bound })
    }
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let norm = NORMS.iter().find(|(_, norm)| *norm == self.norm).map_or("", |(name, _)| name);
        write!(f, "expected {}.{norm} ≤ {:e}", self.quantity, self.bound)
    }
}

impl Limit {
    /// The norm that is above the bound, relative to ours, or absolute where ours is zero.
    ///
    /// **Errors**: a quantity that the data do not have.
    pub(crate) fn above(&self, agreement: &Agreement) -> Result<Option<f64>, String> {
        let what = compared(&self.quantity, agreement.grid.points.is_some());
        let found = agreement.quantities.iter().find(|compared| Some(compared.what) == what);
        let compared = found.ok_or_else(|| {
            let names: Vec<&str> = agreement.quantities.iter().map(|compared| compared.what.name()).collect();
            format!("found a bound of {}, expected one of {}", self.quantity, names.join(", "))
        })?;
        let value = self.norm.of(&compared.norms).map(|(absolute, relative)| relative.unwrap_or(absolute));
        Ok(value.filter(|value| *value > self.bound || value.is_nan()))
    }
}

/// The order of convergence of a quantity between two files.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Order {
    pub(crate) quantity: &'static str,
    pub(crate) widths: [f64; 2],
    pub(crate) l1: Option<f64>,
    pub(crate) l2: Option<f64>,
    pub(crate) linf: Option<f64>,
    pub(crate) linf_off_jumps: Option<f64>,
}

/// The observed orders between each file and the next, for every quantity that both have.
pub(crate) fn orders(files: &[&Agreement], widths: &[f64]) -> Vec<Order> {
    let mut rows = Vec::new();
    for compared in files.first().iter().flat_map(|file| &file.quantities) {
        for (pair, widths) in files.windows(2).zip(widths.windows(2)) {
            let norms = |file: &Agreement| file.quantities.iter().find(|c| c.what == compared.what).map(|c| c.norms);
            let Some((coarse, fine)) = norms(pair[0]).zip(norms(pair[1])) else { continue };
            let between = |name: NormName| {
                let (error, less) = name.of(&coarse).zip(name.of(&fine))?;
                order((widths[0], error.0), (widths[1], less.0))
            };
            rows.push(Order {
                quantity: compared.what.name(),
                widths: [widths[0], widths[1]],
                l1: between(NormName::L1),
                l2: between(NormName::L2),
                linf: between(NormName::Linf),
                linf_off_jumps: between(NormName::LinfOffJumps),
            });
        }
    }
    rows
}
