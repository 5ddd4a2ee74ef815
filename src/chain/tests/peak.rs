use super::super::curve::{Curve, Signal, unit_of, value};
use crate::Estimate;

type Number = Estimate<f64>;

/// Returns a curve with these coefficients over a width.
fn curve(terms: &[f64], width: f64, error: f64) -> Curve<Number> {
    let exact = Estimate::exact;
    let width = exact(width);
    Curve {
        origin: exact(0.0),
        unit: unit_of(&width),
        terms: terms.iter().map(|term| exact(*term)).collect::<Vec<_>>().into(),
        error: exact(error),
        width,
    }
}

/// No curve stays below its own greatest value, or below a value within its error of that; a wave of degree 20 stays
/// below a value that is a twentieth greater.
#[test]
fn curves_stay_below_what_exceeds_them() {
    let mut seed = 1878u64;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut told = 0;
    for _ in 0..500 {
        let (phase, width) = (7.0 * random(), 0.05 + 0.95 * random());
        // sin(2 s/u + phase), which is known to 2²¹/21! < 1e-13.
        let term = |k: u32| {
            let factorial = (1..=k).map(f64::from).product::<f64>();
            (phase + f64::from(k) * std::f64::consts::FRAC_PI_2).sin() * 2f64.powi(k as i32) / factorial
        };
        let curve = curve(&(0..=20).map(term).collect::<Vec<f64>>(), width, 0.01);
        let reach = *curve.reach().value();
        let (from, to) = (0.3 * width * random(), width * (0.5 + 0.5 * random()));
        let at = |k: u32| (from + (to - from) * f64::from(k) / 200.0) / width * reach;
        let values = (0..=200).map(|k| *value(&curve.terms, &Estimate::exact(at(k))).value());
        let most = values.fold(f64::NEG_INFINITY, f64::max);
        let signal = Signal::Curve(Box::new(curve));
        let stays =
            |least: f64| signal.stays_below(&Estimate::exact(least), &Estimate::exact(from), &Estimate::exact(to));
        for least in [most - 0.5, most, most + 0.0099] {
            assert!(!stays(least), "{least}, greatest {most}");
        }
        told += usize::from(stays(most + 0.02 + 0.05));
    }
    assert_eq!(told, 500);
}
