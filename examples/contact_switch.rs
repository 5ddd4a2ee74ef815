//! Contact as a switch: the recursion of the guide's chapter 3, held against the library.
//!
//! What arrives at the ground is q = v_t + c v_x. What leaves is p = −q in contact and p = q in flight, and it is back
//! after the round trip t₁, less g t₁. With c = L = g = 1 and μ = 3 (t₁ = 2) all events are at whole times, and all
//! sums here are exact in doubles, since the step is a power of two.

use dalembert::{Error, EventKind, Problem};

fn main() -> Result<(), Error> {
    let (steps, trip, gravity, speed) = (64, 2.0, 1.0, 3.0);
    let step = trip / steps as f64;
    let (mut sent, mut contact, mut height) = (Vec::new(), true, 0.0);
    let mut events = vec![(EventKind::Impact, 0.0)];
    for k in 0..10 * steps {
        let begin = k as f64 * step;
        // q in the middle of the step: between events it is linear, so that this is its mean.
        let q: f64 = match k {
            first if first < steps => -speed - gravity * (begin + step / 2.0),
            later => sent[later - steps] - gravity * trip,
        };
        if contact && q > 0.0 {
            contact = false;
            events.push((EventKind::Release, begin));
        }
        sent.push(if contact { -q } else { q });
        height += if contact { 0.0 } else { q * step };
        if !contact && height <= 0.0 {
            contact = true;
            events.push((EventKind::Impact, begin + step));
        }
    }
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(20).build()?;
    let theirs: Vec<_> = rod.doubles()?.events().iter().map(|event| (event.kind, event.t)).collect();
    events.iter().for_each(|(kind, time)| println!("{kind:8} {time:4}"));
    assert_eq!(events, theirs);
    Ok(())
}
