//! The catalogue of `check` as a page, a table or JSON.

use serde_json::{Value as Json, json};

use super::cost::duration;
use super::target::{published_json, targets_data};
use dalembert_compare::aligned::table;
use dalembert_verify::check::{CheckedCase, CheckedQuestion, Group};
use dalembert_verify::published::PublishedScene;

/// Returns the number of correct digits as text.
fn digits(right: Option<f64>) -> String {
    match right {
        None => "–".into(),
        Some(f64::INFINITY) => "all".into(),
        Some(digits) => format!("{digits:.1}"),
    }
}

pub(crate) type Groups = [(Group, Vec<CheckedCase>)];

/// Returns the number of cases of each verdict, in the order of their first appearance.
fn count(groups: &Groups) -> String {
    let cases: Vec<&CheckedCase> = groups.iter().flat_map(|(_, cases)| cases).collect();
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for checked in &cases {
        let name = <&str>::from(checked.verdict);
        match counts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => counts.push((name, 1)),
        }
    }
    let counts: Vec<String> = counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
    format!("{} cases: {}", cases.len(), counts.join(", "))
}

/// Returns a table of every route: its answer, the number of correct digits, and the time it took.
pub(crate) fn check_table(groups: &Groups, published: &[PublishedScene]) -> String {
    let mut out = String::new();
    for (group, cases) in groups {
        out += &format!("{}\n\n", group.title);
        for checked in cases {
            let case = checked.case;
            out += &format!("{}: {} ({}): {}\n", case.name, case.about, case.source, checked.verdict);
            for CheckedQuestion { label, truth, routes } in &checked.questions {
                let rows = routes.iter().map(|row| {
                    let (found, right) = (row.answer(), digits(row.digits));
                    let outcome = row.outcome.to_string();
                    vec![row.route.clone(), row.promise.to_string(), outcome, found, right, duration(row.seconds)]
                });
                out += &format!("  {label} = {truth}\n");
                let header = ["route", "promises", "", "answers", "digits", "time"];
                let text = table(&header, rows.collect(), 3);
                out += &text.lines().map(|line| format!("    {line}\n")).collect::<String>();
            }
            out += "\n";
        }
    }
    out + &published_and_counts(groups, published)
}

/// Returns a table of the published values, and the numbers of cases of each verdict.
fn published_and_counts(groups: &Groups, published: &[PublishedScene]) -> String {
    let mut out = String::new();
    if PublishedScene::count(published).0 > 0 {
        out += &targets_data(published, true).table();
    }
    if !groups.is_empty() {
        out += &(count(groups) + "\n");
    }
    out
}

/// Returns a line for each case, and the numbers of cases of each verdict.
pub(crate) fn check_summary(groups: &Groups, published: &[PublishedScene]) -> String {
    let cases = groups.iter().flat_map(|(group, cases)| cases.iter().map(move |checked| (group, checked)));
    let rows = cases.map(|(group, checked)| {
        vec![group.name.to_string(), checked.case.name.to_string(), checked.verdict.to_string()]
    });
    let cases = table(&["group", "case", "verdict"], rows.collect(), 3) + "\n\n";
    let below = published_and_counts(groups, published);
    if groups.is_empty() { below } else { cases + &below }
}

/// Returns a page of the catalogue that does not depend on the machine.
pub(crate) fn check_page(groups: &Groups, published: &[PublishedScene]) -> String {
    let mut out = String::from(
        "# Hard cases, and what the paper claims\n\nPrinted by `dalembert check --format markdown`. Each number is \
         asked of several routes that share as little as they can, and each route is held to what it promises. The truth \
         stands in the catalogue, to as many digits as are printed; where a row says *proved*, enclosures prove them. \
         `dalembert check` shows the answers, how many of their digits are right, and what each took on your \
         machine.\n\n",
    );
    if !groups.is_empty() {
        out += &format!("**{}.**\n\n", count(groups));
    }
    for (group, cases) in groups {
        out += &format!("## {}\n\n{}\n\n", group.title, group.lesson);
        for checked in cases {
            let case = checked.case;
            out += &format!("### `{}`: {}\n\n{}: {}.\n\n", case.name, checked.verdict, case.source, case.about);
            for CheckedQuestion { label, truth, routes } in &checked.questions {
                // A jump at a point, `[v_x](0, t₁)`, is no link.
                let label = label.replace("](", "]\\(");
                out += &format!("{label} = **{}**\n\n| route | promises | |\n|---|---|---|\n", truth);
                for row in routes {
                    out += &format!("| {} | {} | {} |\n", row.route, row.promise, row.outcome);
                }
                out += "\n";
            }
        }
    }
    if !published.is_empty() {
        let (count, expected) = PublishedScene::count(published);
        out += &format!(
            "## Published values of other programs\n\n{expected} of {count} published values agree with ours or differ \
             where that is known: [they are listed](benchmarks.md) with their sources.\n"
        );
    }
    out.trim_end().to_string() + "\n"
}

/// Returns the catalogue as JSON, schema 1.
pub(crate) fn check_json(groups: &Groups, published: &[PublishedScene]) -> Json {
    let cases = groups.iter().flat_map(|(group, cases)| cases.iter().map(move |checked| (group, checked)));
    let cases = cases.map(|(group, checked)| {
        let asked = checked.questions.iter().map(|asked| {
            let rows = asked.routes.iter().map(|row| {
                let right = match row.digits {
                    Some(f64::INFINITY) => json!("all"),
                    digits => json!(digits),
                };
                json!({
                    "route": row.route,
                    "promise": row.promise.to_string(),
                    "outcome": row.outcome.to_string(),
                    "found": row.answer(),
                    "digits": right,
                    "seconds": row.seconds,
                })
            });
            json!({ "what": asked.label, "truth": asked.truth, "rows": rows.collect::<Vec<_>>() })
        });
        let case = checked.case;
        json!({
            "name": case.name,
            "group": group.name,
            "source": case.source,
            "about": case.about,
            "verdict": checked.verdict.to_string(),
            "questions": asked.collect::<Vec<_>>(),
        })
    });
    json!({ "schema": 1, "cases": cases.collect::<Vec<_>>(), "targets": published_json(published) })
}
