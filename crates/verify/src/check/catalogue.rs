//! The catalogue: all groups of cases, and their selection by name.

use super::case::{Case, Group};
use super::{hard, section_2, section_3, section_4};

/// All groups, in the order in which they are shown.
pub const CATALOGUE: [Group; 12] = [
    hard::LATE,
    hard::WEAK,
    hard::STRONG,
    hard::THRESHOLD,
    hard::LANDINGS,
    hard::HOPS,
    hard::SMALL,
    hard::RAYS,
    section_2::SECTION_2,
    section_3::SECTION_3_1,
    section_3::SECTION_3_2,
    section_4::SECTION_4,
];

/// Cases of one group that were selected.
#[derive(Clone, Debug)]
pub struct Selection {
    /// The group.
    pub group: Group,
    /// The selected cases, in order.
    pub cases: Vec<&'static Case>,
}

/// A name that is neither a group nor a case of the catalogue.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("found {0}, expected a group or a case of the catalogue")]
pub struct UnknownName(pub String);

/// Selects the cases of these names or groups, by group; all cases for no names.
///
/// **Errors**: [`UnknownName`] for the first name that is neither.
pub fn select(names: &[String]) -> Result<Vec<Selection>, UnknownName> {
    let is_named = |name: &String, group: &Group, case: &Case| *name == case.name || *name == group.name;
    let is_known =
        |name: &String| CATALOGUE.iter().any(|group| group.cases.iter().any(|case| is_named(name, group, case)));
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        return Err(UnknownName(unknown.clone()));
    }
    let selections = CATALOGUE.into_iter().map(|group| {
        let is_selected = |case: &&Case| names.is_empty() || names.iter().any(|name| is_named(name, &group, case));
        Selection { group, cases: group.cases.iter().filter(is_selected).collect() }
    });
    Ok(selections.filter(|selection| !selection.cases.is_empty()).collect())
}

#[cfg(test)]
#[path = "tests/catalogue.rs"]
mod tests;
