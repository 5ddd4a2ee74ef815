//! Chains whose joints close, open and meet waves at times that differ by down to 10⁻³⁰, in every number system against
//! fractions.

use dalembert::chain::{Body, Chain, ChainColumn, ChainListing, End};
use dalembert::number::Scalar;
use dalembert::{Number, Numbers, Rational, Side, Value};

use crate::random_chain::Random;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// Returns `whole + k·10⁻ᵉ`.
fn beside(whole: i64, k: i64, e: u32) -> Number {
    let sum = Rational::from(whole) + number(&format!("{k}e-{e}")).to_rational();
    sum.to_string().parse().unwrap()
}

/// Returns bars of impedance one and two in a row, at velocities and gaps that let all joints act at nearly
/// the same times.
fn chain(random: &mut Random, e: u32) -> Chain {
    let mut off = || random.below(7) as i64 - 3;
    let gaps: Vec<Number> = (0..3).map(|_| beside(1, off(), e)).collect();
    let lengths: Vec<Number> = (0..4).map(|_| beside(1, off() / 2, e)).collect();
    let velocities = [1, 0, -1, -2].map(|v| beside(v, off(), e));
    let wall = off() > 0;
    let bar = |k: usize| {
        let impedance = if random.below(3) == 0 { 2 } else { 1 };
        Body::new(lengths[k].clone(), 1.into(), impedance.into()).with_velocity(velocities[k].clone())
    };
    let mut bars = (0..4).map(bar).collect::<Vec<_>>().into_iter();
    let mut builder = Chain::builder(bars.next().unwrap());
    for (bar, gap) in bars.zip(gaps) {
        builder = builder.contact(gap, bar);
    }
    if wall {
        builder = builder.top(End::Ground { gap: 1.into(), velocity: Vec::new() });
    }
    builder.until(7.into()).build().unwrap()
}

/// Returns whether a number in any system holds the truth.
fn holds(found: &Value, truth: &Rational) -> bool {
    if let Some(enclosure) = found.as_interval() {
        return enclosure.contains(truth);
    }
    let near = match (found.as_rational(), found.as_float()) {
        (Some(found), _) => return found == truth,
        (_, Some(found)) => found.value().to_rational().unwrap(),
        _ => Rational::try_from(found.to_f64()).unwrap(),
    };
    Scalar::to_f64(&(near - truth)).abs() <= found.log2_error().exp2() * (1.0 + 1e-12)
}

/// Returns the listing with the events and contacts of each joint together: doubles do not know the order of those of
/// different joints that are nearer than their bounds.
fn by_joint(mut listing: ChainListing) -> ChainListing {
    listing.events.sort_by_key(|event| event.node);
    listing.contacts.sort_by_key(|contact| contact.node);
    listing
}

fn numbers(listing: &ChainListing) -> Vec<&Value> {
    let events = listing.events.iter().flat_map(|event| [&event.t, &event.before, &event.after]);
    let contacts = listing
        .contacts
        .iter()
        .flat_map(|contact| [&contact.impact, &contact.impulse, &contact.peak].into_iter().chain(&contact.release));
    events.chain(contacts).collect()
}

#[test]
fn joints_that_act_at_nearly_one_time_are_told_apart() {
    let mut random = Random(2_026);
    let mut compared = 0;
    for e in [2, 5, 9, 13, 17, 22, 30] {
        for _ in 0..12 {
            let chain = chain(&mut random, e);
            let exact = chain.solve(Numbers::Exact).unwrap();
            let truths = by_joint(exact.listing().unwrap().as_ref().clone());
            let truth = |value: &Value| value.as_rational().unwrap().clone();
            // Times beside events, on both sides of those that nearly coincide with them.
            let mut times = vec![number("37/29"), number("151/43")];
            for event in truths.events.iter().take(5) {
                for k in [-1, 1] {
                    let shift = number(&format!("{k}e-{}", e + 3)).to_rational();
                    times.extend(
                        (truth(&event.t) + shift).to_string().parse::<Number>().ok().filter(|t| t.to_f64() > 0.0),
                    );
                }
            }
            for asked in [Numbers::default(), Numbers::Digits(40), Numbers::Certified(40)] {
                let history = chain.solve(asked).unwrap();
                let found = by_joint(history.listing().unwrap().as_ref().clone());
                assert!(history.warnings().is_empty(), "{asked}, 1e-{e}: {chain:?}");
                let order = |listing: &ChainListing| -> Vec<String> {
                    let events = listing.events.iter();
                    events.map(|event| format!("{} of {} at {:.9}", event.kind, event.node, event.t.to_f64())).collect()
                };
                assert_eq!(order(&found), order(&truths), "{asked}, 1e-{e}: {chain:?}");
                for (found, expected) in numbers(&found).into_iter().zip(numbers(&truths)) {
                    assert!(holds(found, &truth(expected)), "{asked}, 1e-{e}: {found} {expected} of {chain:?}");
                    compared += 1;
                }
                for name in ["force.1", "force.2", "gap.3", "v_end.2", "u_top.3", "E_total.4"] {
                    let column = ChainColumn::read(name, &chain).unwrap();
                    for time in &times {
                        let expected = exact.value(column, time, Side::Right).unwrap();
                        let found = history.value(column, time, Side::Right).unwrap();
                        assert!(holds(&found, &truth(&expected)), "{asked}, 1e-{e}: {name} at {time} is {found}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// A wave that slows an approach reaches the joint just after or just before it closes. The velocities −1/2 and −1/10
/// at which free ends would close give the forces 1/4 and 1/20 of bars of impedance one.
#[test]
fn a_wave_beside_an_impact_sets_its_force() {
    for e in [6, 12, 18, 25] {
        for (gap, rate) in [(beside(1, -5, e + 1), "-1/2"), (beside(1, 5, e + 1), "-1/10")] {
            let bar = || Body::new(1.into(), 1.into(), 1.into());
            let pulled = [("0", "0"), ("1", "0"), ("1", "-1/5")].map(|(t, v)| (number(t), number(v)));
            let chain = Chain::builder(bar()).bottom(End::Velocity(pulled.to_vec()));
            let chain = chain.contact(gap, bar().with_velocity(number("-1/2"))).until(3.into()).build().unwrap();
            let rate = number(rate).to_rational();
            let peak = rate.clone() / Rational::from(-2);
            for asked in [Numbers::Exact, Numbers::default(), Numbers::Digits(30), Numbers::Certified(30)] {
                let listing = chain.solve(asked).unwrap().listing().unwrap();
                let (event, contact) = (&listing.events[0], &listing.contacts[0]);
                let found = [&event.before, &event.after].map(|found| holds(found, &rate));
                assert!(found == [true; 2] && holds(&contact.peak, &peak), "{asked}, 1e-{e}: {event:?} {contact:?}");
            }
        }
    }
}
