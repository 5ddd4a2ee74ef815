//! The built-in chains against what others have published of them, and against their closed forms.

use dalembert::Numbers;
use dalembert::Side;
use std::sync::Arc;

use dalembert::chain::{Body, Chain, ChainColumn, ChainHistory, ChainListing, End};
use dalembert::number::{Number, Rational, Scalar};
use dalembert::{ChainScene, builtin};

fn solved(name: &str, numbers: Numbers) -> (ChainHistory, Arc<ChainListing>) {
    let scene = ChainScene::parse(builtin::get(name).unwrap().source).unwrap();
    let history = scene.chain.solve(numbers).unwrap();
    let listing = history.listing().unwrap();
    (history, listing)
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} against {expected}");
}

fn value(history: &ChainHistory, column: &str, time: &str) -> f64 {
    let column = ChainColumn::read(column, history.chain()).unwrap();
    history.value(column, &time.parse().unwrap(), Side::Right).unwrap().to_f64()
}

fn doubles(name: &str) -> (ChainHistory, Arc<ChainListing>) {
    solved(name, Numbers::default())
}

#[test]
fn every_chain_is_read_solved_and_explained() {
    for builtin in builtin::CHAINS {
        let scene = ChainScene::parse(builtin.source).unwrap();
        assert!(scene.title.is_some() && builtin.source.starts_with("# "), "{}", builtin.name);
        assert!(builtin.source.lines().all(|line| line.chars().count() <= 120), "{}", builtin.name);
        assert!(scene.effects().iter().all(|effect| !effect.because.is_empty()), "{}", builtin.name);
        let (history, listing) = doubles(builtin.name);
        assert!(history.warnings().is_empty(), "{}: {:?}", builtin.name, history.warnings());
        assert!(scene.chain.strain_warning().is_none(), "{}", builtin.name);
        // Each number is within 1e-9 of the scale.
        for contact in &listing.contacts {
            assert!(contact.impulse.bound().to_f64() <= 1e-9 * contact.impulse.to_f64().abs(), "{}", builtin.name);
        }
    }
}

#[test]
fn contacts_are_those_published() {
    let exact = |name| solved(name, Numbers::Exact).1;
    let texts = |listing: &ChainListing| -> Vec<String> {
        let contact = |c: &dalembert::chain::ChainContact<_>| {
            let release = c.release.as_ref().map_or("–".into(), ToString::to_string);
            format!("{} {} {} {}", c.node, c.impact, release, c.peak)
        };
        listing.contacts.iter().map(contact).collect()
    };
    assert_eq!(texts(&exact("openfoam-7-1-1")), ["1 1/10 3/10 1/20"]);
    assert_eq!(texts(&exact("openfoam-7-1-2")), ["1 1/10 27/70 7/170"]);
    assert_eq!(texts(&exact("schwarz-two-bars")), ["1 1/10000 3/5000 100"]);
    // The force ends after 2L/c; the bars then move alike, until a wave comes back from the far end of the long one.
    let unequal = exact("schwarz-unequal-bars");
    assert_eq!(texts(&unequal), ["1 1/10000 11/10000 100"]);
    let force: Vec<_> = unequal.forces[1].iter().map(|piece| piece.end.to_string()).collect();
    assert_eq!(force, ["1/10000", "3/5000", "1/500"]);
    assert_eq!(texts(&exact("schwarz-three-bars")), ["1 1/5000 19/20000 100", "2 1/5000 19/20000 100"]);
    assert_eq!(texts(&exact("cirak-west")), ["1 0 20 1/10"]);
    assert_eq!(texts(&exact("hopkinson-striker")), ["0 0 – 9/13"]);
    let (_, abaqus) = doubles("abaqus-1-3-15");
    let contact = &abaqus.contacts[0];
    close(contact.impact.to_f64(), 6.67e-4, 1e-3);
    close(contact.release.as_ref().unwrap().to_f64() - contact.impact.to_f64(), 7.9e-4, 1e-3);
    close(contact.peak.to_f64(), 11.8e6, 5e-3);
    close(contact.impulse.to_f64(), 9360.0, 1e-12);
}

#[test]
fn displacements_are_those_of_sdnl111() {
    let times = ["2e-4", "4e-4", "6e-4", "8e-4", "1e-3"];
    let (a, listing) = doubles("code-aster-sdnl111-a");
    close(listing.contacts[0].release.as_ref().unwrap().to_f64(), 7.8993671e-4, 1e-8);
    for (time, expected) in times.iter().zip([-1e-4, -1.949684e-4, -9.496835e-5, 1.00633e-5, 2.1006329e-4]) {
        close(value(&a, "u_end.2", time), expected, 1e-6);
    }
    let (c, listing) = doubles("code-aster-sdnl111-c");
    close(listing.contacts[0].release.as_ref().unwrap().to_f64(), 6.9083982e-4, 1e-8);
    for (time, expected) in times.iter().zip([-1.05e-4, -1.554199e-4, -5.541991e-5, 9.916018e-5, 2.9916025e-4]) {
        close(value(&c, "u_end.2", time), expected, 1e-6);
    }
}

/// Sums the Fourier series of a bar that is fixed at one end, under a force at the other one that rises linearly.
fn series(x: f64, t: f64, (length, modulus, density): (f64, f64, f64), (force, ramp): (f64, f64)) -> f64 {
    let c = (modulus / density).sqrt();
    let modes = (0..200_000).map(|n| {
        let k = (2.0 * f64::from(n) + 1.0) * std::f64::consts::PI / (2.0 * length);
        let (omega, sign) = (k * c, if n % 2 == 0 { 1.0 } else { -1.0 });
        let response = match ramp {
            0.0 => 1.0 - (omega * t).cos(),
            ramp => {
                let rising = |s: f64| if s <= 0.0 { 0.0 } else { (s - (omega * s).sin() / omega) / ramp };
                rising(t) - rising(t - ramp)
            }
        };
        2.0 * force / (length * density) * sign * (k * x).sin() * response / (omega * omega)
    });
    modes.sum()
}

#[test]
fn end_loads_are_those_of_fourier_series() {
    let modulus = 50e6 * 0.7 / (1.3 * 0.4);
    let bars = [
        ("mpm-py-pile", (15.0, 1e8, 2500.0), (-10e3, 0.0), ["0.1", "0.2", "0.47"]),
        ("kratos-drained-column", (10.0, modulus, 1890.0), (-1000.0, 2.5e-3), ["0.01", "0.11", "0.39"]),
        ("rose-column", (1.0, 2e6, 3.0), (-1000.0, 0.0), ["0.001", "0.004", "0.0093"]),
    ];
    for (name, bar, load, times) in bars {
        let (history, _) = doubles(name);
        for time in times {
            let t: Number = time.parse().unwrap();
            let expected = series(bar.0, t.to_f64(), bar, load);
            // The rest of the series after N terms is below 4FL/(EAπ²N).
            let rest = 4.0 * load.0.abs() * bar.0 / (bar.1 * std::f64::consts::PI.powi(2) * 200_000.0);
            let found = value(&history, "u_top.1", time);
            assert!((found - expected).abs() <= rest + 1e-9 * expected.abs(), "{name} at {time}: {found} {expected}");
        }
    }
}

#[test]
fn values_settle_in_every_number_system() {
    let time = Number::from(1);
    for numbers in [Numbers::default(), Numbers::Digits(30), Numbers::ExactThenDigits(30), Numbers::Certified(30)] {
        let (history, listing) = solved("cirak-west", numbers);
        assert_eq!(listing.contacts.len(), 1, "{numbers:?}");
        let force = ChainColumn::read("force.1", history.chain()).unwrap();
        let force = history.value(force, &time, Side::Right).unwrap();
        assert!((force.to_f64() - 0.1).abs() < 1e-15 && history.warnings().is_empty(), "{numbers:?}: {force}");
    }
    let (steel, listing) = solved("code-aster-sdnl111-a", Numbers::Digits(40));
    let release = listing.contacts[0].release.as_ref().unwrap().to_string();
    // 4L/c = 4 √(7800/2e11), whose square is 16·39e-9.
    let square = release.parse::<Number>().unwrap().to_rational();
    let off = Scalar::square(&square) - "624e-9".parse::<Number>().unwrap().to_rational();
    assert!(Scalar::to_f64(&off).abs() < 1e-45, "{release}");
    assert!(steel.warnings().is_empty());
}

/// Checks that numbers of so many digits that their ratios are no short fractions lose none of them.
#[test]
fn long_numbers_keep_their_digits() {
    let text = |first: &str| format!("{first}.{}", "1234567891".repeat(20));
    let [modulus, density, area] = ["3", "2", "1"].map(|first| text(first).parse::<Number>().unwrap());
    let bar = |area: &Number| {
        Body::elastic(1.into(), modulus.clone(), density.clone(), area.clone()).with_velocity((-1).into())
    };
    let chain = Chain::builder(bar(&area)).bonded(bar(&2.into())).until(1.into());
    let chain = chain.bottom(End::Velocity(Vec::new())).build().unwrap();
    let history = chain.solve(Numbers::Digits(100)).unwrap();
    let force = ChainColumn::read("force.bottom", history.chain()).unwrap();
    let force = history.value(force, &"1/100".parse().unwrap(), Side::Right).unwrap();
    // f = Zv with Z² = A²Mρ.
    let [z2, found] = [
        area.to_rational() * area.to_rational() * modulus.to_rational() * density.to_rational(),
        Scalar::square(&force.to_string().parse::<Number>().unwrap().to_rational()),
    ];
    let off = Scalar::to_f64(&((z2.clone() - found) / z2)).abs();
    assert!(off < 1e-98, "{force}: {off:e}");
    // The wave that a change of the area reflects: r = (Z₁ − Z₂)/(Z₁ + Z₂) is that of the areas.
    let late = ChainColumn::read("v_top.1", history.chain()).unwrap();
    let t = "9/10".parse().unwrap();
    let (velocity, area) = (history.value(late, &t, Side::Right).unwrap(), area.to_rational());
    let two = Rational::from(2);
    // The wave p = 1 of the held end meets q = −1: v = −1 + 2Z₁/(Z₁ + Z₂).
    let expected = area.clone() * &two / (area + &two) - Rational::from(1);
    let off = velocity.to_string().parse::<Number>().unwrap().to_rational() - &expected;
    assert!(Scalar::to_f64(&off).abs() < 1e-98, "{velocity}");
}
