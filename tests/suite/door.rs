//! One door: what a question is planned as, and that every number system gives the same answer through it.

use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::quantity::{Needs, Slice, restitution};
use dalembert::solve::{DEFAULT_ACCURACY, Reach, Rung};
use dalembert::{Engine, Error, Estimate, Numbers, Plan, Problem, Quantity, Question, Side};

fn rod(speed: &str) -> Problem {
    Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(speed).build().unwrap()
}

fn damped(damping: &str, speed: &str) -> Problem {
    Problem::builder().length(1).wave_speed(1).damping(damping).gravity(1).impact_speed(speed).build().unwrap()
}

fn plan(problem: &Problem, question: Question) -> Plan {
    Plan::of(problem, &question).unwrap()
}

/// The plan follows the motion no farther than the question needs, by the cheapest engine that gets there.
#[test]
fn a_plan_reaches_what_is_asked_and_no_more() {
    let doubles = Numbers::default();
    let (undamped, weak) = (rod("3"), damped("0.1", "3"));
    let whole = plan(&undamped, Question::run(doubles));
    assert_eq!((whole.engine, whole.reach, whole.rung), (Engine::Lattice, Reach::Contacts(1), Rung::Double));
    let whole = plan(&weak, Question::run(doubles));
    assert_eq!((whole.engine, whole.reach), (Engine::Cells, Reach::Contacts(1)));
    // The bounce time and the restitution need no flight, and so no cell.
    let first = plan(&weak, Question::first_contact(doubles));
    assert_eq!((first.engine, first.reach), (Engine::ClosedForm, Reach::FirstContact));
    // Single numbers need no list of events, and with the closed form no lattice either.
    for rod in [&undamped, &weak] {
        let single = plan(rod, Question::bounce(doubles));
        assert_eq!((single.engine, single.settles_events, single.cells), (Engine::ClosedForm, false, None));
    }
    assert!(first.settles_events && whole.cells.is_some());
    // Values between two times: nothing beyond the later one, and nothing before the earlier one is kept.
    let between = plan(&undamped, Question::between(5.into(), 7.into(), doubles));
    assert_eq!((between.reach, between.keep_from), (Reach::Time(7.into()), Some(5.0)));
    // A fixed top has no closed form.
    let fixed = weak.to_builder().fixed_top().build().unwrap();
    assert_eq!(plan(&fixed, Question::run(doubles)).engine, Engine::Cells);
    // Proofs of a damped rod go through all of its impacts.
    assert_eq!(plan(&weak, Question::run(Numbers::Certified(20))).engine, Engine::Cells);
    assert_eq!(plan(&fixed, Question::run(Numbers::Certified(20))).engine, Engine::Cells);
}

/// `t_b`, the impulse, `e_E²` and `E_z` that are asked for alone are those of the whole first contact, within the
/// bounds of both.
#[test]
fn single_numbers_are_those_of_the_whole() {
    let mut compared = 0;
    for (damping, speed) in
        [("0", "1"), ("0", "2"), ("0", "5/2"), ("0.1", "1"), ("0.2", "5"), ("0.3", "2"), ("1.2", "9")]
    {
        let rod = damped(damping, speed);
        let query = |motion: &dyn Motion<Estimate<f64>>| {
            let Some((from, Some(to))) = motion.contact_times(0) else { return Ok(Vec::new()) };
            let squared = restitution(motion, (&from, Some(&to)))?.e_e2;
            let vibrational = motion.energy(&to)?.vibrational;
            Ok([Some(to), motion.impulse(0), squared.ok(), Some(vibrational)].into_iter().flatten().collect())
        };
        let found =
            [Question::bounce(Numbers::default()), Question::first_contact(Numbers::default())].map(|question| {
                plan(&rod, question).ask::<f64, Vec<_>>(&rod, query, |found| found.iter().collect()).unwrap()
            });
        assert_eq!(found[0].len(), found[1].len(), "r = {damping}, μ = {speed}");
        for (single, whole) in found[0].iter().zip(&found[1]) {
            assert!(single.compare(whole).unwrap().is_eq(), "r = {damping}, μ = {speed}: {single:?} {whole:?}");
            assert!(single.bound() <= DEFAULT_ACCURACY * found[0][0].value(), "r = {damping}, μ = {speed}: {single:?}");
            compared += 1;
        }
    }
    // One of the seven has no bounce, and one of the others no `e_E²`.
    assert_eq!(compared, 6 * 4 - 1);
}

#[test]
fn what_cannot_be_planned_is_refused_before_it_runs() {
    let refused = |problem: &Problem, numbers| Plan::of(problem, &Question::run(numbers)).unwrap_err();
    assert_eq!(refused(&rod("3"), Numbers::Double(Some(0.5))), Error::Accuracy { found: 0.5 });
    assert_eq!(refused(&rod("3"), Numbers::Digits(0)), Error::Digits { found: 0, most: 100_000 });
    assert!(matches!(refused(&damped("0.1", "3"), Numbers::Exact), Error::DampedExact { .. }));
}

/// A landing as a ray arrives: fractions say that they meet, in every build. Where the time of the meeting is no
/// fraction, only roots do, and a build without them warns.
#[test]
fn a_meeting_is_decided_by_fractions() {
    let solved = |name: &str| {
        let scene = dalembert::builtin::get(name).unwrap();
        dalembert::Scene::parse(scene.source).unwrap().problem.doubles().unwrap()
    };
    let history = solved("doyen-ern-piperno");
    assert_eq!((history.rung(), history.warnings()), (dalembert::solve::Rung::Fractions, vec![]));
    let warnings = solved("mu-1-period-36").warnings();
    let undecided = matches!(warnings[..], [dalembert::Warning::Coincidence { .. }]);
    assert!(!undecided, "{warnings:?}");
    // Corollary 1, without any error.
    let exact = rod("3").exact().unwrap();
    assert_eq!(exact.text(exact.contacts()[0].release.as_ref().unwrap()), "2");
}

/// μ = 1 lands without speed at t = 31: a double root, at which 1000 digits need exact roots. `--digits` has them too.
#[test]
fn digits_never_fail_where_proofs_succeed() {
    let rod = rod("1").to_builder().time(72).build().unwrap();
    let (digits, proved) = (rod.digits(1000).unwrap(), rod.certified(1000).unwrap());
    assert_eq!(digits.events().len(), proved.events().len());
    for (ours, truth) in digits.events().iter().zip(proved.events()) {
        let apart = rug::Float::with_val(3500, &ours.t - truth.t.mid()).abs();
        assert!(apart.is_zero() || apart.log10() < -996.0, "{}", truth.t.mid());
    }
    let touch = digits.events().iter().find(|event| event.t == 31).unwrap();
    assert!(touch.v_end.is_zero());
}

/// What a time gives does not depend on which other times are asked, nor in which order.
#[test]
fn a_value_is_the_same_alone_and_among_others() {
    let history = rod("3/2").to_builder().time(20).build().unwrap().doubles().unwrap();
    let times: Vec<f64> = (0..40).map(|k| f64::from(k) / 2.0).collect();
    let forth: Vec<f64> = times.iter().map(|t| history.strain(*t, Side::Left).unwrap()).collect();
    let mut back: Vec<f64> = times.iter().rev().map(|t| history.strain(*t, Side::Left).unwrap()).collect();
    back.reverse();
    assert_eq!(forth, back);
    let points = [0.0, 0.25, 1.0];
    let together = history.field(&points, &times, Side::Right).unwrap();
    for (k, time) in times.iter().enumerate() {
        for (j, point) in points.iter().enumerate() {
            assert_eq!(history.at(*point, *time).unwrap(), together[k * points.len() + j]);
        }
    }
}

/// Doubles whose bound is above the accuracy take longer numbers: μ = 3/2 has lost all digits of a double by t = 120.
#[test]
fn doubles_turn_to_longer_numbers_by_themselves() {
    let near = rod("3/2").to_builder().time(20).build().unwrap().doubles().unwrap();
    assert_eq!(near.rung(), Rung::Double);
    let problem = rod("3/2").to_builder().time(120).build().unwrap();
    let (far, truth) = (problem.doubles().unwrap(), problem.digits(20).unwrap());
    assert!(matches!(far.rung(), Rung::Bits(_)), "{}", far.rung());
    assert_eq!(far.events().len(), truth.events().len());
    for (ours, truth) in far.events().iter().zip(truth.events()) {
        assert!((ours.t - truth.t.to_f64()).abs() <= DEFAULT_ACCURACY * 120.0);
    }
}

/// What is no number is no time, in whatever build: no longer numbers are asked for.
#[test]
fn no_number_is_no_time() {
    for rod in [rod("3"), damped("0.1", "2"), rod("3").to_builder().impacts(5).build().unwrap()] {
        let history = rod.doubles().unwrap();
        for time in [f64::NAN, f64::INFINITY] {
            let mut said: Vec<Error> = Vec::new();
            for side in [Side::Left, Side::Right] {
                said.extend(history.strain(time, side).err());
                said.extend(history.ground_end(time, side).err());
            }
            said.extend(history.at(0.25, time).err());
            said.extend(history.centre(time).err());
            said.extend(history.energy(time).err());
            let over_time: Vec<Quantity> = Needs::Time.quantities().collect();
            let columns = over_time.iter().map(|quantity| history.columns(&[*quantity], &[0.5, time], None));
            said.extend(columns.filter_map(Result::err));
            let slices = [Slice::Points, Slice::Averages, Slice::P1];
            let grid = |_: &dyn Motion<_>| Ok(([0.0, 1.0].map(Estimate::exact).into(), vec![Estimate::exact(time)]));
            said.extend(slices.iter().filter_map(|slice| history.ask_slices(*slice, None, grid).err()));
            assert_eq!(said.len(), 10 + over_time.len());
            assert!(said.iter().all(|error| matches!(error, Error::TimeOutside { .. })), "{said:?}");
        }
    }
}
