#![allow(clippy::unwrap_used)]
use super::*;
use crate::check::verdict::Outcome;
use crate::routes::Truth;

fn selected(name: &str) -> Vec<&'static Case> {
    select(&[name.into()]).unwrap().into_iter().flat_map(|selection| selection.cases).collect()
}

#[test]
fn cases_are_selected_by_name_or_group() {
    assert_eq!(selected("figure-1").len(), 1);
    assert!(selected("late").len() > 3);
    assert_eq!(select(&["never".into()]).unwrap_err(), UnknownName("never".into()));
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
    let asked = selected("late-3.13")[0].questions[0];
    assert_eq!(Truth::from_text(asked.truth).unwrap().most_digits(), 39.0);
    let mut wrong = asked;
    wrong.truth = "11.66136670144388438415940577414171411946";
    let wrong = wrong.check();
    let failed: Vec<&str> = wrong.routes.iter().filter(|r| r.outcome == Outcome::Failed).map(|r| &*r.route).collect();
    assert_eq!(failed, ["the plan, 36 digits", "the plan, 36 digits proved"]);
    assert!(asked.check().routes.iter().all(|route| route.outcome != Outcome::Failed));
}
