//! The catalogue: all groups of cases, and how they are selected.

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

/// The cases of these names or groups, by group; all of them for none.
///
/// **Errors**: the first name that is neither.
pub fn select(names: &[String]) -> Result<Vec<(Group, Vec<&'static Case>)>, String> {
    let named = |name: &String, group: &Group, case: &Case| *name == case.name || *name == group.name;
    let cases = |group: Group, wanted: &dyn Fn(&Case) -> bool| {
        (group, group.cases.iter().filter(|case| wanted(case)).collect::<Vec<_>>())
    };
    let known = |name: &&String| CATALOGUE.iter().any(|group| group.cases.iter().any(|case| named(name, group, case)));
    if let Some(unknown) = names.iter().find(|name| !known(name)) {
        return Err(unknown.clone());
    }
    let wanted =
        |group: Group| cases(group, &|case| names.is_empty() || names.iter().any(|name| named(name, &group, case)));
    Ok(CATALOGUE.into_iter().map(wanted).filter(|(_, cases)| !cases.is_empty()).collect::<Vec<_>>())
}

#[cfg(test)]
#[path = "tests/catalogue.rs"]
mod tests;
