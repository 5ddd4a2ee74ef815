//! Times of up to sixty digits beside an event: each represents exactly the number that it spells.

use dalembert::{Number, Numbers, Problem, Quantity, Scene, Side, Value};

fn problem(text: &str) -> Problem {
    Scene::parse(text).unwrap().problem
}

/// Returns `time` with its last digit raised by `units`.
fn moved(time: &str, units: i64) -> String {
    let point = time.find('.').unwrap();
    let digits: String = time.chars().filter(char::is_ascii_digit).collect();
    let mut digits: Vec<u8> = digits.bytes().map(|digit| digit - b'0').collect();
    let mut carry = units;
    for digit in digits.iter_mut().rev() {
        let sum = i64::from(*digit) + carry;
        (*digit, carry) = (sum.rem_euclid(10) as u8, sum.div_euclid(10));
    }
    let mut text: String = digits.into_iter().map(|digit| char::from(digit + b'0')).collect();
    text.insert(point, '.');
    text
}

/// Just before each event the rod is in the state that the event ends, and just after it in the one that it begins; the
/// end that lands has fallen as far as its speed says.
#[test]
fn times_beside_events_are_told_apart() {
    let mut compared = 0;
    for scene in [
        "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.1\n[impact]\nspeed = 3\n[gravity]\nacceleration = 1\n",
        "[rod]\nlength = 1.1483\nwave_speed = 1.8219\ndamping = 0.0765\n[impact]\nspeed = 0.887\n\
         [gravity]\nacceleration = 2.324\n",
        "[rod]\nlength = \"4/3\"\nwave_speed = 1.7\n[impact]\nspeed = 0.9\n[gravity]\nacceleration = 0.8\n",
    ] {
        let problem = problem(&format!("{scene}[run]\nimpacts = 3\n"));
        let exact = problem.solve_in(Numbers::Digits(120)).unwrap();
        for numbers in [Numbers::default(), Numbers::Digits(12)] {
            let history = problem.solve_in(numbers).unwrap();
            for event in &exact.events().unwrap()[1..] {
                for places in [28, 44] {
                    let time = event.t.to_digits(places);
                    for (units, before) in [(-2i64, true), (2, false)] {
                        let time = moved(&time, units);
                        let ask = |of: &dalembert::History, quantity| -> Value {
                            of.at_time(quantity, time.parse::<Number>().unwrap(), Side::Right).unwrap()
                        };
                        let lands = event.kind == dalembert::EventKind::Impact;
                        let contact = ask(&history, Quantity::Contact);
                        assert_eq!(contact.to_f64() == 1.0, lands != before, "{scene} {numbers} {time} {contact:?}");
                        for quantity in [Quantity::EndDisplacement, Quantity::EndVelocity, Quantity::Strain] {
                            let (ours, truth) = (ask(&history, quantity), ask(&exact, quantity));
                            let off = (ours.to_f64() - truth.to_f64()).abs();
                            let bound = ours.bound().to_f64() + truth.bound().to_f64();
                            assert!(off <= bound, "{scene} {numbers} {time} {quantity}: {ours:?} {truth:?}");
                            compared += 1;
                        }
                        if lands && before {
                            let height = ask(&history, Quantity::EndDisplacement).to_f64();
                            let fall = -event.v_end.to_f64() * 10f64.powi(1 - places as i32);
                            assert!(height > fall && height < 60.0 * fall, "{scene} {time}: {height:e} {fall:e}");
                        }
                    }
                }
            }
        }
    }
    assert!(compared > 300, "{compared}");
}
