//! Bars beside rigid masses, as rods of their own.

use dalembert::chain::ChainColumn;
use dalembert::number::{Number, Value};
use dalembert::{Numbers, Quantity, Side};

use crate::chain_soft::striker;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// The bar below a mass is a rod like others, in doubles and in digits. **Source**: below the first wave of the mass
/// the force is `e^(−(t − (L − x)/c)/m)`.
#[test]
fn a_bar_below_a_mass_is_a_rod() {
    let chain = striker("6", "4");
    assert_eq!(chain.problems().unwrap().iter().map(Option::is_some).collect::<Vec<_>>(), [true, false]);
    let rod = chain.problem(0).unwrap();
    let (doubles, proved) = (rod.doubles().unwrap(), rod.solve_in(Numbers::Certified(20)).unwrap());
    for (place, t) in [("0.5", "0.75"), ("0.9", "0.25"), ("1", "0.5"), ("0.125", "0.9")] {
        let (x, at) = (place.parse::<f64>().unwrap(), t.parse::<f64>().unwrap());
        let expected = -(-(at - 1.0 + x).max(0.0) / 6.0).exp() * f64::from(u8::from(at > 1.0 - x));
        let found = doubles.field(&[x], &[at], Side::Right).unwrap().remove(0).strain;
        assert!((found - expected).abs() < 1e-14, "{found} at {place}, {t}");
    }
    let whole = chain.solve(Numbers::Certified(20)).unwrap();
    for t in ["0.25", "1", "1.75"] {
        let found = rod.doubles().unwrap().columns(&[Quantity::TopForce], &[t.parse().unwrap()], Some(Side::Right));
        let expected = (-t.parse::<f64>().unwrap() / 6.0).exp();
        assert!((found.unwrap()[0][0] - expected).abs() < 1e-14, "at {t}");
    }
    for name in ["u_top", "v_top", "h", "h_rate", "kinetic", "strain_energy", "E_total"] {
        let column = ChainColumn::read(&format!("{name}.1"), &chain).unwrap();
        for t in ["0.3", "1.7", "3.9"] {
            let expected = whole.value(column, &number(t), Side::Right).unwrap();
            let found = proved.at_time(name.parse::<Quantity>().unwrap(), number(t), Side::Right).unwrap();
            let [a, b] = [&found, &expected].map(Value::to_f64);
            assert!((a - b).abs() <= 1e-15 * (1.0 + b.abs()), "{name} at {t}: {found} against {expected}");
        }
    }
}

/// The leapfrog scheme with `c dt = dx` is exact inside the rod; only the mass at its upper node errs, in proportion
/// to the step.
#[test]
fn a_scheme_for_a_mass_on_a_rod_tends_to_the_exact_force() {
    let history = striker("6", "7").problem(0).unwrap().doubles().unwrap();
    let times = [0.7, 2.3, 3.1, 4.6, 5.2, 6.9];
    let exact = history.columns(&[Quantity::TopForce, Quantity::TopDisplacement], &times, Some(Side::Right)).unwrap();
    let error = |elements: usize| -> f64 {
        let dt = 1.0 / elements as f64;
        let top_mass = 6.0 + dt / 2.0;
        let mut now = vec![0.0; elements + 1];
        // One step before the start: the mass shares its momentum with half of an element.
        let mut before = now.clone();
        before[elements] = dt * 6.0 / top_mass;
        let (mut worst, mut k) = (0.0f64, 0);
        for time in times {
            while (k as f64 + 0.5) * dt < time {
                let mut next = now.clone();
                for j in 1..elements {
                    next[j] = now[j + 1] + now[j - 1] - before[j];
                }
                let push = (now[elements - 1] - now[elements]) / dt;
                next[elements] = 2.0 * now[elements] - before[elements] + dt * dt * push / top_mass;
                (before, now) = (now, next);
                k += 1;
            }
            let push = (now[elements - 1] - now[elements]) / dt;
            let place = times.iter().position(|at| *at == time).unwrap();
            worst = worst.max((push - exact[0][place]).abs()).max((now[elements] - exact[1][place]).abs());
        }
        worst
    };
    let [coarse, fine] = [400, 1_600].map(error);
    assert!(fine < 5e-3 && fine < coarse / 3.0, "{coarse:e} {fine:e}");
}
