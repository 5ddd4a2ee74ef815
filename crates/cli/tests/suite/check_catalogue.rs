//! The catalogue of hard cases and of the paper's claims, run once by the command: all promises are kept.

use crate::command::{Run, json, refused, run};

#[test]
fn every_promise_is_kept() {
    let Run { code, out: page, err } = run("check --format markdown");
    let failed: Vec<&str> = page.lines().filter(|line| line.contains("FAILED")).collect();
    assert_eq!((code, err.as_str(), failed), (Some(0), "", Vec::new()));
    // What the theory gives: late bounces to the last digit; (4.75), (4.74) and Figure 7 for r = 0.1, 0.2, 0.3.
    for known in [
        "11.66136670144388438415940577414071411946",
        "15.33318837004014558549067344667885556140",
        "31.40409847658940057227989202780933895332",
        "0.8189908",
        "0.6719489",
        "0.5531313",
        "0.99996646",
        "0.99945549",
        "0.99719064",
        "1.0006689",
        "1.0054133",
        "1.0186658",
    ] {
        assert!(page.contains(&format!("**{known}")), "{known}");
    }
    let (_, cases) = page.split_once("\n**").unwrap();
    let cases: u32 = cases.split_once(' ').unwrap().0.parse().unwrap();
    assert!(cases >= 54, "{cases} cases");
}

#[test]
fn the_command() {
    let json = json("check --only corollary-1");
    assert_eq!((&json["schema"], &json["cases"][0]["verdict"]), (&1.into(), &"reproduced".into()));
    refused("check --only corollary-9", &["found --only corollary-9, expected a group"]);
}
