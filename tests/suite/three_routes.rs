//! The same first contact by three routes that share no formula: closed sums over rays, sums over modes, and, without
//! damping, the lattice; with damping, the cells. Each value carries a proved bound, and two routes may differ by no
//! more than their bounds.

use crate::common::{number, reference};
use dalembert::engine::{FirstContact, Motion};
use dalembert::number::{Answer, Rounded};
use dalembert::special::RoundedSpecial;
use dalembert::{Estimate, Parameters, Run, Side};
use dalembert_verify::modal::Modal;

/// Two values within their bounds, and bounds that say something: below `useful` of `scale`.
fn agree<S: Rounded>(what: &str, a: &Estimate<S>, b: &Estimate<S>, scale: f64, useful: f64) {
    let apart = (a.value().clone() - b.value()).to_f64().abs();
    assert!(apart <= a.bound() + b.bound(), "{what}: {a:?} and {b:?} are {apart:e} apart");
    assert!(b.bound() <= useful * scale, "{what}: bound {:e} of {scale:e} says nothing", b.bound());
}

/// All that both routes can be asked, at `trips` round trips.
fn compare<S: RoundedSpecial>(rod: &Parameters<S>, trips: &[f64], modes: u32, useful: f64) {
    let (rays, modal) = (FirstContact::new(&rod.carry()), Modal::new(rod, modes));
    let t1 = rod.round_trip();
    let speed = rod.speed.to_f64() + rod.critical_speed().to_f64();
    let strain = speed / rod.wave_speed.to_f64();
    let length = rod.length.to_f64();
    for trips in trips {
        let time = t1.double(*trips) * &t1;
        let name = format!("R = {:e}, M = {:e}, τ = {trips}", rod.damping.to_f64() * t1.to_f64(), rod.speed.to_f64());
        for side in [Side::Left, Side::Right] {
            let (a, b) = (rays.strain(&time.carry(), side), modal.strain(&time, side));
            agree(&format!("{name} stress"), &a, &b, strain, useful);
            for part in [0.0, 0.25, 0.625, 1.0] {
                let x = t1.double(part) * &rod.length;
                let (f, g) = (rays.field(&x.carry(), &time.carry(), side), modal.field(&x, &time, side));
                let pairs = [
                    (f.displacement, g.displacement, speed * t1.to_f64()),
                    (f.velocity, g.velocity, speed),
                    (f.strain, g.strain, strain),
                ];
                for (k, (a, b, scale)) in pairs.into_iter().enumerate() {
                    agree(&format!("{name} x = {part} L field {k}"), &a, &b, scale, useful);
                }
            }
        }
        let ((h, p), (height, rate)) = (rays.centre(&time.carry()), modal.centre(&time));
        agree(&format!("{name} h"), &h, &height, speed * t1.to_f64(), useful);
        agree(&format!("{name} h′"), &p, &rate, speed, useful);
        let closed = rays.energy(&time.carry()).total;
        // The energy falls like N⁻², whatever the numbers hold.
        agree(
            &format!("{name} E"),
            &closed,
            &modal.energy(&time),
            speed * speed * length,
            useful.max(2.0 / f64::from(modes * modes)),
        );
    }
}

fn rod(damping: f64, gravity: f64, speed: f64) -> Parameters<f64> {
    Parameters { length: 0.5, wave_speed: 1.0, damping, gravity, speed }
}

/// On rays and between them; R from nothing to well overdamped; either share of (2.28) negligible.
#[test]
fn rays_and_modes() {
    for damping in [0.0, 1e-300, 1e-9, 0.1, 1.0, std::f64::consts::PI, 10.0] {
        for speed in [1e-8, 1e-4, 0.3, 1.0, 2.5, 1e4, 1e8] {
            compare(&rod(damping, 1.0, speed), &[0.3, 0.875, 1.0, 1.7, 3.25], 1024, 1e-9);
        }
        compare(&rod(damping, 0.0, 1.0), &[0.5, 1.0, 2.0, 2.125], 1024, 1e-9);
    }
}

/// The parameters of the reference, in long numbers too: there nothing but the modes left out remains.
#[test]
fn the_reference_cases() {
    fn all<S: RoundedSpecial>(precision: &S::Precision, modes: u32, useful: f64) {
        for case in reference("first_contact") {
            let read = |key: &str| S::from_number(&number(&case[key]), precision);
            let rod = Parameters {
                length: read("length"),
                wave_speed: read("wave_speed"),
                damping: read("damping"),
                gravity: read("gravity"),
                speed: read("impact_speed"),
            };
            compare(&rod, &[0.375, 1.0, 1.5], modes, useful);
        }
    }
    all::<f64>(&(), 1024, 1e-10);
    all::<rug::Float>(&200, 128, 1e-10);
}

/// The rate that is promised, `N^{1−K−p}`: with K = 8 each doubling divides the bound of the stress by 2⁷.
#[test]
fn the_rate_of_convergence() {
    let lift = |x: f64| rug::Float::with_val(300, x);
    let rod = Parameters {
        length: lift(0.5),
        wave_speed: lift(1.0),
        damping: lift(2.0),
        gravity: lift(0.0),
        speed: lift(1.0),
    };
    let time = lift(1.3);
    let exact = FirstContact::new(&rod.carry()).strain(&time.carry(), Side::Right).into_value();
    let off = |modes: u32| {
        let found = Modal::new(&rod, modes).strain(&time, Side::Right);
        let wrong = (found.value().clone() - &exact).to_f64().abs();
        assert!(wrong <= found.bound(), "{modes}: {wrong:e} {:e}", found.bound());
        found.bound()
    };
    for modes in [16, 64, 256] {
        let ratio = off(modes) / off(2 * modes);
        assert!((ratio / 128.0 - 1.0).abs() < 1e-6, "{modes}: {ratio}");
    }
}

/// Without damping the lattice joins in, which marches instead of adding up; all three to 1e-13.
#[test]
fn rays_modes_and_the_lattice() {
    for (speed, gravity, last) in
        [("3", "1", 0.95), ("1", "1", 1.45), ("0.5", "1", 1.7), ("1e-4", "1", 1.9), ("2", "0", 0.95)]
    {
        let problem = crate::common::uniform("1", "1", gravity, speed, Run::Impacts(1));
        let rod = Parameters::<f64>::of(&problem, &()).unwrap();
        let (rays, modal) = (FirstContact::new(&rod.carry()), Modal::new(&rod, 256));
        let lattice = crate::stripped::undamped::<f64>(&problem, &()).unwrap();
        let scale = rod.speed + rod.critical_speed();
        for part in [0.2, 0.55, 0.8, 1.0] {
            let time = part * last * rod.round_trip();
            let near = |what: &str, truth: f64, a: Estimate<f64>, b: Estimate<f64>| {
                let wrong = (a.value() - truth).abs().max((b.value() - truth).abs());
                assert!(
                    wrong < 1e-13 * scale.max(scale * scale),
                    "μ = {speed}, t = {time}, {what}: {truth} {a:?} {b:?}"
                );
            };
            let stress = lattice.strain(&time, Side::Right).unwrap();
            near("stress", stress, rays.strain(&time.carry(), Side::Right), modal.strain(&time, Side::Right));
            let (h, rate) = lattice.centre(&time).unwrap();
            let ((a, da), (b, db)) = (rays.centre(&time.carry()), modal.centre(&time));
            near("h", h, a, b);
            near("h′", rate, da, db);
            for x in [0.1, 0.6, 0.97] {
                let truth = lattice.field(&x, &time, Side::Right).unwrap();
                let a = rays.field(&x.carry(), &time.carry(), Side::Right);
                let b = modal.field(&x, &time, Side::Right);
                near("v", truth.displacement, a.displacement, b.displacement);
                near("v_t", truth.velocity, a.velocity, b.velocity);
                near("v_x", truth.strain, a.strain, b.strain);
            }
            let energy = lattice.energy(&time).unwrap().total;
            let (found, by_modes) = (rays.energy(&time.carry()).total, modal.energy(&time));
            assert!((found.value() - energy).abs() < 1e-13 * scale.max(scale * scale), "{found:?} {energy}");
            assert!((by_modes.value() - energy).abs() <= by_modes.bound(), "{by_modes:?} {energy}");
        }
    }
}

/// With damping the characteristic cells are the lattice's route: stress, field, centre and energy of the first
/// contact.
#[test]
fn rays_modes_and_the_cells() {
    for (damping, speed, gravity, last) in [
        ("1e-9", "3", "1", 0.95),
        ("0.05", "1", "1", 1.4),
        ("0.2", "5", "1", 0.95),
        ("0.5", "1", "1", 1.9),
        ("1.3", "1", "0", 1.7),
        ("5", "1", "1", 2.2),
    ] {
        let time = (2.0 * last * 1.01).to_string().parse().unwrap();
        let mut problem = crate::common::uniform("1", "1", gravity, speed, Run::Time(time));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let rod = Parameters::<f64>::of(&problem, &()).unwrap();
        let (rays, modal) = (FirstContact::new(&rod.carry()), Modal::new(&rod, 1024));
        let cells = crate::stripped::damped::<f64>(&problem, &(), 13.0).unwrap();
        let scale = rod.speed + rod.critical_speed();
        let slack = 4.0 * cells.error_estimate() * scale;
        assert!(slack < 1e-9 * scale, "{damping}: {slack:e}");
        for part in [0.2, 0.55, 0.8, 1.0] {
            let time = part * last * rod.round_trip();
            if cells.contacts()[0].release.is_some_and(|end| end < time) {
                continue;
            }
            let near = |what: &str, truth: f64, a: &Estimate<f64>, b: &Estimate<f64>| {
                let wrong = [a, b].map(|e| (e.value() - truth).abs() - e.bound());
                let name = format!("r = {damping}, t = {time}, {what}: {truth} {a:?} {b:?}");
                assert!(wrong.iter().all(|w| *w <= slack), "{name}");
            };
            let (a, b) = (rays.strain(&time.carry(), Side::Right), modal.strain(&time, Side::Right));
            near("stress", cells.strain(&time, Side::Right).unwrap(), &a, &b);
            let (h, rate) = cells.centre(&time).unwrap();
            let ((a, da), (b, db)) = (rays.centre(&time.carry()), modal.centre(&time));
            let halved = |x: Estimate<f64>| x * Estimate::exact(0.5);
            near("h", h / 2.0, &halved(a), &halved(b));
            near("h′", rate, &da, &db);
            for x in [0.1, 0.6, 0.97] {
                let truth = cells.field(&x, &time, Side::Right).unwrap();
                let a = rays.field(&x.carry(), &time.carry(), Side::Right);
                let b = modal.field(&x, &time, Side::Right);
                near("v_t", truth.velocity, &a.velocity, &b.velocity);
                near("v_x", truth.strain, &a.strain, &b.strain);
            }
        }
    }
}
