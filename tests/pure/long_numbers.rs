//! Digits and proofs of the library in pure Rust.
//!
//! The expected texts of histories are those of the build with GMP and MPFR, which the suite holds against the
//! references. The integers, fractions and long floats of that build share no code with those here.

use crate::common::{number, problem, reference};
use dalembert::number::Scalar;
use dalembert::reason::NoBounceReason;
use dalembert::{Ending, Problem, Reason, Run};

fn rod(damping: &str, gravity: &str, speed: &str, impacts: u32) -> Problem {
    let rod = Problem::builder().length(1).wave_speed(1).damping(damping).gravity(gravity).impact_speed(speed);
    rod.impacts(impacts).build().unwrap()
}

fn fifty_digits(problem: &Problem, event: usize) -> [String; 4] {
    let history = problem.digits(50).unwrap();
    let event = &history.events()[event];
    [&event.t, &event.v_end, &event.h, &event.h_rate].map(|number| history.text(number))
}

#[test]
fn a_damped_bounce_to_fifty_digits() {
    let found = fifty_digits(&rod("0.1", "1", "3", 2), 2);
    let truth = [
        "6.1132511587537615755482975712929647096012269277471",
        "-2.8024053744983889567462498331361437398679012486405",
        "-0.28137918282472176667602334178397355132211913744099",
        "-1.7256082943003389338124263982849727088220194010210",
    ];
    assert_eq!(found, truth);
}

#[test]
fn an_undamped_run_with_irrational_speeds_to_fifty_digits() {
    let found = fifty_digits(&rod("0", "1", "7/5", 6), 10);
    let truth = [
        "24.539071942966531605629776230169062678730430197591",
        "-1.9390719429665316056297762301690626787304301975909",
        "0.040180276769954154359496086408896966098764568371693",
        "-1.0390719429665316056297762301690626787304301975909",
    ];
    assert_eq!(found, truth);
}

#[test]
fn ten_damped_impacts_are_proved() {
    let history = rod("0.1", "1", "10", 10).certified(15).unwrap();
    let last = history.events().last().unwrap();
    let found = [&last.t, &last.v_end, &last.h, &last.h_rate].map(|number| history.text(number));
    assert_eq!(found, ["53.9294486884784", "0.314439886555234", "-0.305546076082933", "-0.0293671287513257"]);
    // Each number lies in its enclosure as thirty digits of another run say.
    let digits = rod("0.1", "1", "10", 10).digits(30).unwrap();
    assert_eq!(history.events().len(), digits.events().len());
    for (proved, event) in history.events().iter().zip(digits.events()) {
        let near = |x: &dalembert::Float| x.to_rational().unwrap();
        assert!(proved.t.contains(&near(&event.t)) && proved.h.contains(&near(&event.h)), "{}", proved.t);
    }
}

/// The events of `tests/reference`, with every number within a unit of its last digit.
#[test]
fn undamped_references_are_proved_to_fifty_digits() {
    for case in reference("undamped_bounces") {
        let events: Vec<_> =
            case["events"].as_array().unwrap().iter().filter(|event| event["kind"] != "graze").collect();
        let last = number(&events.last().unwrap()["time"]).to_f64();
        let problem = problem(&case, Run::Time((last + 1e-6).to_string().parse().unwrap()));
        let history = problem.certified(50).unwrap();
        assert_eq!(history.events().len(), events.len(), "{}", case["name"]);
        for (event, truth) in history.events().iter().zip(events) {
            for (found, text) in
                [(&event.t, &truth["time"]), (&event.h, &truth["h"]), (&event.h_rate, &truth["h_rate"])]
            {
                let scale = 1.0 + found.to_f64().abs();
                let apart = found.mid().to_rational().unwrap() - number(text).to_rational();
                assert!(found.radius().to_f64() <= scale * 1e-49, "{found}");
                assert!(Scalar::to_f64(&apart).abs() <= scale * 1e-38, "{found} {text}");
            }
        }
    }
}

/// L = 1/2, c = 1, g = 0: t₁ = 1, and the rod bounces where r < π. The late bounce is that of
/// `tests/suite/certified_first_contact.rs`, from a series in forty digits.
#[test]
fn first_contacts_next_to_pi_are_settled() {
    let contact = |damping: &str| {
        let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1);
        rod.build().unwrap()
    };
    let late = contact("3.13");
    let history = late.digits(38).unwrap();
    let release = history.contacts()[0].release.clone().unwrap();
    assert_eq!(history.text(&release), "11.661366701443884384159405774140714119");
    assert!((late.doubles().unwrap().contacts()[0].release.unwrap() - 11.661_366_701_443_885).abs() < 1e-9);
    let never = contact("3.1415926535897932384626433832795028842").certified(20).unwrap();
    let overdamped = matches!(never.ending(), Ending::NoBounce(Reason::NoBounce(NoBounceReason::Overdamped { .. })));
    assert!(overdamped, "{:?}", never.ending());
}
