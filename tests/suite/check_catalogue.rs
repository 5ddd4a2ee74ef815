//! The catalogue of hard cases and of the paper's claims: all promises are kept, and the page in the repository says what the
//! program finds.

use dalembert::check::{Case, Outcome, Verdict, catalogue, select};

fn run(cases: Vec<&'static Case>) -> Vec<dalembert::check::Checked> {
    cases.into_iter().map(Case::run).collect()
}

#[test]
fn every_promise_is_kept() {
    let mut broken = Vec::new();
    for checked in run(select(&[]).unwrap()) {
        for asked in &checked.asked {
            for row in asked.rows.iter().filter(|row| row.outcome == Outcome::Failed) {
                let answer = row.found.to_string();
                broken.push(format!(
                    "{}, {}: {} promises {}, answers {answer}",
                    checked.case.name, asked.what, row.route, row.promise
                ));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// The catalogue can fail: a wrong truth is noticed by every route that promises anything.
#[test]
fn a_wrong_truth_is_noticed() {
    use dalembert::check::{Question, Truth};
    let case = select(&["late-3.13".into()]).unwrap()[0];
    let Question { truth, of, rod, routes, what } = &case.questions[0];
    assert_eq!(Truth::new(truth).digits, Some(40));
    let wrong = Question { truth: "11.66136670144388438415940577414171411946", of: *of, rod: *rod, routes, what };
    let wrong = Box::leak(Box::new([wrong]));
    let wrong = Box::leak(Box::new(Case { questions: wrong, name: "wrong", ..*case }));
    if cfg!(feature = "mp") {
        assert_eq!(wrong.run().verdict, Verdict::Failed);
    }
    assert_eq!(case.run().verdict, Verdict::Holds);
}

/// What the theory gives stands in the catalogue to the last digit, and nowhere twice under one name.
#[test]
fn the_catalogue_holds_the_known_truths() {
    let truths: Vec<&str> = catalogue().flat_map(|case| case.questions.iter().map(|question| question.truth)).collect();
    for known in [
        "11.66136670144388438415940577414071411946",
        "15.33318837004014558549067344667885556140",
        "31.40409847658940057227989202780933895332",
    ] {
        assert!(truths.contains(&known), "{known}");
    }
    // (4.75), (4.74) and Figure 7 for r = 0.1, 0.2, 0.3.
    for start in [
        "0.8189908",
        "0.6719489",
        "0.5531313",
        "0.99996647",
        "0.99945549",
        "0.99719065",
        "1.0006689",
        "1.0054134",
        "1.0186658",
    ] {
        let close = |text: &str| {
            text.parse::<dalembert::Number>().is_ok_and(|x| (x.to_f64() - start.parse::<f64>().unwrap()).abs() < 2e-7)
        };
        assert!(truths.iter().any(|text| close(text)), "{start}");
    }
    let mut names: Vec<&str> = catalogue().map(|case| case.name).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[cfg(all(feature = "mp", feature = "cli"))]
#[test]
fn the_page_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/check.md");
    let page = dalembert::output::check_page(&run(select(&[]).unwrap()));
    let stored = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        page == stored,
        "docs/check.md is not what the program finds: `dalembert check --format markdown -o docs/check.md`, and read the difference"
    );
}

#[cfg(feature = "cli")]
#[test]
fn the_command() {
    let run = |args: &[&str]| {
        let output =
            std::process::Command::new(env!("CARGO_BIN_EXE_dalembert")).arg("check").args(args).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, out, err) = run(&["--only", "corollary-1", "--format", "json"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&json["schema"], &json["cases"][0]["verdict"]), (&1.into(), &"reproduced".into()));
    let (code, out, err) = run(&["--only", "corollary-9"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(err.contains("found --only corollary-9, expected a group"), "{err}");
}
