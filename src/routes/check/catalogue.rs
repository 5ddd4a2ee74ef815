//! The catalogue: all groups of cases, and how they are selected.

use super::case::{Case, Group};
use super::{hard, section_2, section_3, section_4};
use crate::mapped::CollectVec;

/// All groups, in the order in which they are shown.
pub(crate) const CATALOGUE: [Group; 12] = [
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
pub(crate) fn select(names: &[String]) -> Result<Vec<(Group, Vec<&'static Case>)>, String> {
    let named = |name: &String, group: &Group, case: &Case| *name == case.name || *name == group.name;
    let cases = |group: Group, wanted: &dyn Fn(&Case) -> bool| {
        (group, group.cases.iter().filter(|case| wanted(case)).collect_vec())
    };
    let known = |name: &&String| CATALOGUE.iter().any(|group| group.cases.iter().any(|case| named(name, group, case)));
    if let Some(unknown) = names.iter().find(|name| !known(name)) {
        return Err(unknown.clone());
    }
    let wanted =
        |group: Group| cases(group, &|case| names.is_empty() || names.iter().any(|name| named(name, &group, case)));
    Ok(CATALOGUE.into_iter().map(wanted).filter(|(_, cases)| !cases.is_empty()).collect_vec())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::verdict::Outcome;
    use super::*;
    use crate::routes::long;
    use crate::routes::truth::Truth;

    fn selected(name: &str) -> Vec<&'static Case> {
        select(&[name.into()]).unwrap().into_iter().flat_map(|(_, cases)| cases).collect()
    }

    #[test]
    fn cases_are_selected_by_name_or_group() {
        assert_eq!(selected("figure-1").len(), 1);
        assert!(selected("late").len() > 3);
        assert_eq!(select(&["never".into()]).unwrap_err(), "never");
    }

    #[test]
    fn no_name_stands_twice() {
        let mut names: Vec<&str> = CATALOGUE.iter().flat_map(|group| group.cases).map(|case| case.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    /// The catalogue can fail: a truth that is wrong in its 32nd digit is noticed by every route that promises more.
    #[test]
    fn a_wrong_truth_is_noticed() {
        let asked = selected("late-3.13")[0].entries[0];
        assert_eq!(Truth::spelt(asked.truth).unwrap().most_digits(), 39.0);
        let mut wrong = asked;
        wrong.truth = "11.66136670144388438415940577414171411946";
        let wrong = wrong.check();
        let failed: Vec<&str> = wrong.rows.iter().filter(|r| r.outcome == Outcome::Failed).map(|r| &*r.route).collect();
        let expected = ["the plan, 36 digits", "the plan, 36 digits proved"];
        assert_eq!(failed, if long::AVAILABLE { &expected[..] } else { &[] });
        assert!(asked.check().rows.iter().all(|row| row.outcome != Outcome::Failed));
    }
}
