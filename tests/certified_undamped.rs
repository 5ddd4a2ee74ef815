//! Proved digits of undamped histories.
#![cfg(feature = "mp")]
#![allow(clippy::unwrap_used)]

use dalembert::lattice::Undamped;
use dalembert::number::{Interval, IntervalPrecision, decided};
use dalembert::rod::Run;
use dalembert::{History, Number, Problem};

#[test]
fn try_all() {
    for (mu, time, l, c, g) in [
        ("1", "80", "1", "1", "1"),
        ("1/2", "40", "1", "1", "1"),
        ("4/3", "60", "1", "1", "1"),
        ("3/2", "30", "1", "1", "1"),
        ("3/2", "60", "1", "1", "1"),
        ("2", "60", "1", "1", "1"),
        ("3", "60", "1", "1", "1"),
        ("10", "60", "10", "30", "10"),
    ] {
        let n = |s: &str| -> Number { s.parse().unwrap() };
        let mut problem = Problem::uniform(n(l), n(c), n(g), n(mu));
        problem.run = Run::Time(n(time));
        for bits in [256u32, 1024] {
            let start = std::time::Instant::now();
            let history =
                decided(|| Undamped::<Interval>::solve(&problem, &IntervalPrecision::with_exact(bits)).unwrap());
            let elapsed = start.elapsed();
            match history {
                None => println!("{mu} {bits}: undecided {elapsed:?}"),
                Some(h) => {
                    let d = decided(|| {
                        let e = h.events();
                        e.iter().map(|e| e.time.radius().to_f64().max(e.centre.radius().to_f64())).fold(0.0, f64::max)
                    });
                    println!("{mu} {bits}: events {:?} {elapsed:?}", h.events().len());
                    println!("   {d:?}");
                }
            }
        }
    }
}
