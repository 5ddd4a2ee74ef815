//! Ends of the pieces of the stress, and of a run, are within their bounds: against the arrival of the first ray, which
//! is a fraction, and against forty digits of the same run.

use dalembert::number::Scalar;
use dalembert::solve::StressForm;
use dalembert::{Estimate, Number, Numbers, Problem, Scene, Side};
use rug::Float;

const BITS: u32 = 320;

/// The start of a scene, and the times at which the first rays from within the rod arrive at the ground, `x/c`.
const STARTS: [(&str, &[&str]); 3] = [
    (
        "[rod]\nlength = 4\nwave_speed = 1\ndamping = 1.5625e-2\n\
         [start]\ndisplacement = [[0, 0], [\"1/3\", -2], [\"11/3\", -4], [4, 0]]\n\
         [gravity]\nacceleration = \"1/56\"\n[run]\nimpacts = 1\n",
        &["1/3"],
    ),
    (
        "[rod]\nlength = 1.481\nwave_speed = 1\ndamping = 4.4363e-1\n\
         [start]\ndisplacement = [[0, 0], [\"1481/3000\", 0], [1.481, 6.99381516e-1]]\n\
         velocity = [[0, 0], [\"1481/3000\", 0], [1.481, 6.05222e-1]]\n\
         [gravity]\nacceleration = 3.9795e-2\n[run]\nimpacts = 4\n",
        &["1481/3000"],
    ),
    (
        "[rod]\nlength = 1.99e1\nwave_speed = 7.181e-4\ndamping = 2.2873e-7\n\
         [start]\ndisplacement = [[0, 0], [1.99e1, 0]]\n\
         velocity = [[0, -6.4575e-6], [\"199/60\", -1.93725e-5], [\"1393/120\", 1.93725e-5], [1.99e1, -5.166e-5]]\n\
         [gravity]\nacceleration = \"18548523/39800000000000000\"\n[run]\ntime = \"796000000/7181\"\n",
        &["99500000/21543"],
    ),
];

/// Scenes that begin as a whole: a root of the stress ends the first piece, and the run stops at a ray.
const WHOLE: [&str; 2] = [
    "[rod]\nlength = 6\nmodulus = 210000000000\ndensity = 7850\ndamping = 3.1791e2\n\
     [impact]\nspeed = 5.69e-2\n[gravity]\nacceleration = 9.81\n[run]\nimpacts = 4\n",
    "[rod]\nlength = 1.684\nmodulus = 2.578\ndensity = 1.146e-2\narea = 6.851\ndamping = 8.4924\n\
     [start]\ndisplacement = [[0, 0], [1.684, -8.28608319e-2]]\n\
     velocity = [[0, 5.99e-1], [5.18672e-1, -6.2e-2], [5.18672e-1, -1.206], [9.91876e-1, 4.09e-1], \
     [9.91876e-1, -7.88e-1], [1.1788, -1.832], [1.1788, -6.84e-1], [1.684, -1.079]]\n[run]\nimpacts = 1\n",
];

fn problem(text: &str) -> Problem {
    Scene::parse(text).unwrap().problem
}

fn lies_within(number: &Estimate<f64>, truth: &Float, what: &str) {
    let off = Float::with_val(BITS, truth - *number.value()).to_f64().abs();
    assert!(off <= number.bound(), "{what}: {number:?} is off by {off:e}, more than {:e}", number.bound());
}

#[test]
fn the_first_rays_arrive_within_the_bounds_of_the_pieces() {
    for (text, arrivals) in STARTS {
        for accuracy in [None, Some(1e-3)] {
            let history = problem(text).answer::<f64>(&dalembert::Question::run(Numbers::Double(accuracy))).unwrap();
            let pieces = history.ask(|run| Ok(run.stress_pieces()), |_| Vec::new()).unwrap();
            for (k, arrival) in arrivals.iter().enumerate() {
                let truth = Float::with_val(BITS, arrival.parse::<Number>().unwrap().to_rational());
                lies_within(&pieces[k].end, &truth, &format!("end of piece {k}"));
                lies_within(&pieces[k + 1].start, &truth, &format!("start of piece {}", k + 1));
            }
        }
    }
}

#[test]
fn pieces_and_the_end_are_those_of_forty_digits() {
    for text in STARTS.iter().map(|start| start.0).chain(WHOLE) {
        let problem = problem(text);
        let long = problem.digits(40).unwrap();
        let truth = long.ask(|run| Ok((run.end(), run.stress_pieces())), |(end, _)| vec![end]).unwrap();
        for accuracy in [None, Some(1e-3), Some(1e-14)] {
            let history = problem.answer::<f64>(&dalembert::Question::run(Numbers::Double(accuracy))).unwrap();
            let found = history.ask(|run| Ok((run.end(), run.stress_pieces())), |_| Vec::new()).unwrap();
            lies_within(&found.0, truth.0.value(), "end");
            assert_eq!(found.1.len(), truth.1.len());
            for (k, (ours, theirs)) in found.1.iter().zip(&truth.1).enumerate() {
                for (what, ours, theirs) in [
                    ("start", &ours.start, &theirs.start),
                    ("end", &ours.end, &theirs.end),
                    ("strain_start", &ours.strain_start, &theirs.strain_start),
                    ("strain_end", &ours.strain_end, &theirs.strain_end),
                ] {
                    assert!(theirs.log2_error() < -100.0);
                    lies_within(ours, theirs.value(), &format!("{what} of piece {k} of {text}"));
                }
            }
        }
    }
}

/// The Chebyshev coefficients of a contact's stress, from strains at 60 digits at times of their own, against those of
/// the pieces in doubles and in enclosures.
#[test]
fn coefficients_are_those_of_the_stress_itself() {
    let scene = dalembert::builtin::get("figure-4-r02").unwrap().source;
    let long = problem(scene).digits(60).unwrap();
    let piece = &long.stress_history().unwrap().pieces[0];
    let number = |p: i64, q: i64| Float::with_val(BITS, p) / q;
    let (nodes, pi) = (48, Float::with_val(BITS, rug::float::Constant::Pi));
    let angle = |j: i64| Float::with_val(BITS, &pi * number(2 * j + 1, 2 * nodes));
    let strain = |j: i64| {
        let share = (angle(j).cos() + 1) / 2;
        let time = Float::with_val(BITS, &piece.end - &piece.start) * share + &piece.start;
        long.strain(time, Side::Right).unwrap()
    };
    let strains: Vec<Float> = (0..nodes).map(strain).collect();
    let truth = |k: i64| {
        let term = |j: i64| Float::with_val(BITS, angle(j) * k).cos() * &strains[j as usize];
        let sum = (0..nodes).map(term).fold(Float::new(BITS), |sum, term| sum + term);
        sum * number(if k == 0 { 1 } else { 2 }, nodes)
    };
    for numbers in [Numbers::Double(None), Numbers::Certified(20), Numbers::Certified(40)] {
        let history = problem(scene).solve_in(numbers).unwrap();
        let listing = history.listing(Some(StressForm::Series), true).unwrap();
        let coefficients = &listing.stress[0].chebyshev;
        assert!(coefficients.len() > 10);
        for (k, found) in coefficients.iter().enumerate() {
            let value = Float::with_val(BITS, Float::parse(found.to_digits(60)).unwrap());
            let (off, bound) = ((value - truth(k as i64)).to_f64().abs(), found.bound_to_digits(60).to_f64());
            assert!(off <= bound * (1.0 + 1e-6) + 1e-55, "{numbers:?}, {k}: off by {off:e}, more than {bound:e}");
            assert!(bound < 1e-12, "{numbers:?}, {k}: {bound:e}");
        }
    }
}
