//! The first contact in doubles: what the plan takes beside the cheapest route, one stress value, one restitution, one
//! energy, and Figure 4 with the part left of its dots.

#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use dalembert::engine::{Bounce, FirstContact, Motion, Undamped};
use dalembert::number::Scalar;
use dalembert::quantity::restitution;
use dalembert::special::{i0_scaled, i1_scaled};
use dalembert::{Error, Estimate, Numbers, Parameters, Plan, Problem, Question, Scene, Side, builtin};

fn rod(damping: f64, speed: f64) -> Parameters<Estimate<f64>> {
    Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed }.carry()
}

fn squared(damping: f64, speed: f64) -> Option<f64> {
    let contact = FirstContact::new(&rod(damping, speed));
    match contact.bounce() {
        Bounce::At { time, .. } => contact.rebound(&time).energy_restitution_squared().map(Estimate::into_value),
        _ => None,
    }
}

fn first_contact(criterion: &mut Criterion) {
    let contact = FirstContact::new(&rod(0.2, 5.0));
    // What a machine takes for two Bessel functions: the floor of everything below.
    criterion.bench_function("e^{−z} I₀(z) and I₁(z)", |b| {
        b.iter(|| i0_scaled(black_box(&0.26_f64)) + i1_scaled(black_box(&0.26_f64)));
    });
    criterion.bench_function("stress in the first round trip", |b| {
        b.iter(|| contact.strain(black_box(&Estimate::exact(1.3)), Side::Right));
    });
    criterion.bench_function("restitution, bounce at t₁", |b| b.iter(|| squared(black_box(0.2), black_box(5.0))));
    criterion.bench_function("restitution, bounce after t₁", |b| b.iter(|| squared(black_box(0.2), black_box(1.0))));
    criterion.bench_function("energy at t₁", |b| b.iter(|| contact.energy(black_box(&Estimate::exact(2.0)))));
    let late = Problem::uniform("1/2".parse().unwrap(), 1.into(), 0.into(), 1.into());
    let late = late.to_builder().damping(3).build().unwrap();
    let plan = Plan::of(&late, &Question::first_contact(Numbers::Double(Some(1e-12)))).unwrap();
    criterion.bench_function("t_b to 1e-12, g = 0, R = 3", |b| {
        b.iter(|| plan.solve(black_box(&late), Arc::new(dalembert::engine::unobserved)).unwrap());
    });
    criterion.bench_function("figure 4, 4 × 1000 speeds", |b| {
        b.iter(|| {
            let mut sum = 0.0;
            for damping in [0.0, 0.1, 0.2, 0.3] {
                for k in 1..=1000 {
                    sum += squared(damping, 12.5e-3 * f64::from(k)).unwrap_or(0.0);
                }
            }
            sum
        });
    });
}

/// The least time of one call, in seconds, of two functions in turns.
fn least<A, B>(mut a: impl FnMut() -> A, mut b: impl FnMut() -> B) -> [f64; 2] {
    const CALLS: u32 = 200;
    let mut least = [f64::INFINITY; 2];
    for _ in 0..300 {
        let start = Instant::now();
        (0..CALLS).for_each(|_| drop(black_box(a())));
        let middle = Instant::now();
        (0..CALLS).for_each(|_| drop(black_box(b())));
        let times = [middle - start, middle.elapsed()];
        for (least, time) in least.iter_mut().zip(times) {
            *least = least.min(time.as_secs_f64() / f64::from(CALLS));
        }
    }
    least
}

/// The plan against the cheapest route, from a parsed scene on: five questions, each as the ratio of the least times of
/// many runs in turns.
fn plan_against_direct(_: &mut Criterion) {
    let scene = |name: &str| Scene::parse(builtin::get(name).unwrap().source).unwrap().problem;
    let (damped, undamped) = (scene("figure-4-r02"), scene("paper-weak"));
    let show = |name: &str, [plan, direct]: [f64; 2]| {
        println!("{name:<30} plan {:.3} µs, direct {:.3} µs: {:.2} ×", 1e6 * plan, 1e6 * direct, plan / direct);
    };
    type Engine<'a> = &'a dyn Motion<Estimate<f64>>;
    type Query<'q> = dyn Fn(Engine<'_>) -> Result<Option<Estimate<f64>>, Error> + 'q;
    type Direct = fn(&FirstContact<Estimate<f64>>, &Estimate<f64>) -> Option<Estimate<f64>>;
    let ended = |motion: Engine<'_>| motion.contact_times(0).and_then(|(from, to)| Some((from, to?)));
    let ratios = |motion: Engine<'_>| match ended(motion) {
        Some((from, to)) => restitution(motion, (&from, Some(&to))).map(Some),
        None => Ok(None),
    };
    let ask = |query: &Query<'_>| {
        let plan = Plan::of(black_box(&damped), &Question::bounce(Numbers::default())).unwrap();
        plan.ask::<f64, _>(&damped, query, |found| found.iter().collect()).unwrap().unwrap()
    };
    let direct = |question: Direct| {
        let rod = Parameters::<Estimate<f64>>::of(black_box(&damped), &()).unwrap();
        let contact = FirstContact::new(&rod);
        let Bounce::At { time, .. } = contact.bounce() else { unreachable!("above the threshold") };
        question(&contact, &time).unwrap()
    };
    show("t_b", least(|| ask(&|motion| Ok(ended(motion).map(|(_, to)| to))), || direct(|_, time| Some(time.clone()))));
    show(
        "e_P",
        least(
            || ask(&|motion| Ok(ratios(motion)?.and_then(|found| found.e_p.ok()))),
            || direct(|contact, time| contact.rebound(time).momentum_restitution()),
        ),
    );
    show(
        "e_E²",
        least(
            || ask(&|motion| Ok(ratios(motion)?.and_then(|found| found.e_e2.ok()))),
            || direct(|contact, time| contact.rebound(time).energy_restitution_squared()),
        ),
    );
    let impulse: Direct = |contact, time| {
        let (rod, rebound) = (contact.rod(), contact.rebound(time));
        let held = rod.gravity.clone() * time + rebound.centre * time.int(2) * &rod.damping;
        Some((rebound.velocity + &rod.speed + held) * &rod.length)
    };
    show("impulse of the first contact", least(|| ask(&|motion| Ok(motion.impulse(0))), || direct(impulse)));
    let vibration = |motion: Engine<'_>| match ended(motion) {
        Some((_, to)) => motion.energy(&to).map(|energy| Some(energy.vibrational)),
        None => Ok(None),
    };
    show(
        "E_z at the bounce",
        least(|| ask(&vibration), || direct(|contact, time| Some(contact.energy(time).vibrational))),
    );
    let events = |motion: Engine<'_>| Ok((motion.events().len(), motion.contacts()[0].impulse.clone()));
    let whole = || {
        let plan = Plan::of(black_box(&undamped), &Question::first_contact(Numbers::default())).unwrap();
        plan.ask::<f64, _>(&undamped, events, |(_, impulse)| vec![impulse]).unwrap()
    };
    let lattice = || {
        let history = Undamped::<Estimate<f64>>::solve(black_box(&undamped), &()).unwrap();
        (history.events().len(), history.contacts()[0].impulse.clone())
    };
    show("undamped events and contacts", least(whole, lattice));
}

criterion_group!(benches, plan_against_direct, first_contact);
criterion_main!(benches);
