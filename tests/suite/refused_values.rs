//! Numbers that a history must not give: a sum up to where a run happened to stop, and an answer to a question that no
//! number spells.

use dalembert::solve::Places;
use dalembert::{Error, Numbers, Problem, Quantity, Scene};

fn problem(text: &str) -> Problem {
    Scene::parse(text).unwrap().problem
}

/// The contact never ends, and each attempt counts to where it stops: 0.1998 in doubles, 0.1487 in twenty digits.
#[test]
fn a_contact_that_does_not_end_has_no_impulse_and_no_peak() {
    let problem = problem(
        "[rod]\nlength = 1\nwave_speed = 2.5\ndamping = \"865/38\"\n\
         [start]\ndisplacement = [[0, 0], [5e-1, 0], [\"2/3\", 5e-2], [7.5e-1, 5e-2], [1, -5e-2]]\n\
         velocity = [[0, 6.25e-2], [\"1/12\", 2.5e-1], [\"5/12\", -5e-1], [1, -1.25e-1]]\n\
         [gravity]\nacceleration = 3.125e-1\n[run]\nimpacts = 2\n",
    );
    for numbers in [Numbers::default(), Numbers::Digits(20)] {
        let rows = problem.solve_in(numbers).unwrap();
        let rows = rows.list(&[Quantity::Impact, Quantity::ContactImpulse, Quantity::PeakStrain]).unwrap();
        let last = rows.last().unwrap();
        assert!(last[0].is_ok() && last[1].is_err() && last[2].is_err(), "{numbers}: {last:?}");
    }
}

/// A fraction holds neither NaN nor an infinity.
#[test]
fn a_time_that_is_no_number_is_refused_in_fractions() {
    let history = problem("[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 1\n[run]\nimpacts = 1\n");
    let history = history.solve_in(Numbers::Exact).unwrap();
    for time in [f64::NAN, f64::INFINITY] {
        let found = history.sample(&[Quantity::Strain], &Places::from(&[time][..]), None);
        assert!(matches!(found, Err(Error::TimeOutside { .. })), "{found:?}");
    }
}

/// The end lies on the boundary of two round trips: `t₁ = √2`, and the run ends 1e-50 from it.
#[test]
fn a_run_to_nearly_a_round_trip_is_proved() {
    let problem = problem(
        "[rod]\nlength = \"1/2\"\nmodulus = 1\ndensity = 2\n[impact]\nspeed = 1\n\
         [run]\ntime = 1.4142135623730950488016887242096980785696718753769\n",
    );
    let history = problem.solve_in(Numbers::Certified(20)).unwrap();
    assert_eq!(history.end().to_string(), "1.4142135623730950488");
}

/// The printed value of a proved number lies between its printed ends.
#[test]
fn a_proved_value_is_printed_within_its_ends() {
    let problem = problem(
        "[rod]\nlength = 6110\nwave_speed = 1.177e1\ndamping = 3.1501e-5\n[impact]\nspeed = 196600\ngap = 21391000\n\
         [gravity]\nacceleration = 1.208e2\n[run]\nimpacts = 2\n",
    );
    let history = problem.solve_in(Numbers::Certified(7)).unwrap();
    let rows = history.list(&[Quantity::EventTime, Quantity::EventCentre, Quantity::EventVelocity]).unwrap();
    let mut compared = 0;
    for value in rows.into_iter().flatten() {
        let printed = serde_json::to_value(value.unwrap()).unwrap();
        let [lo, value, hi] = ["lo", "value", "hi"]
            .map(|key| printed[key].as_str().unwrap().parse::<dalembert::Number>().unwrap().to_rational());
        assert!(lo <= value && value <= hi, "{printed}");
        compared += usize::from(lo < hi);
    }
    assert!(compared > 3, "{compared}");
}
