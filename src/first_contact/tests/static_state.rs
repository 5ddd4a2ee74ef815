use super::*;
use crate::first_contact::FirstContact;
use crate::motion::Side;
use crate::number::Estimate;

#[test]
fn the_closed_form_becomes_the_static_state() {
    for damping in [1.2, 1.6, 2.5] {
        let rod = Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed: 0.5 };
        let k = faded_after(&rod, 1000).unwrap();
        let rod = rod.carry();
        let contact = FirstContact::new(&rod);
        let state = StaticState::of(&rod);
        let known = Estimate::exact;
        let t = known(2.0 * k as f64);
        let same = |a: &Estimate<f64>, b: &Estimate<f64>| {
            assert_eq!(a.compare(b), Ok(std::cmp::Ordering::Equal), "{damping} {k} {a:?} {b:?}");
            assert!((a.value() - b.value()).abs() < 1e-12, "{damping} {k} {a:?} {b:?}");
        };
        let (field, exact) = (contact.field(&known(0.4), &t, Side::Right), state.field(&known(0.4)));
        same(&field.displacement, &exact.displacement);
        same(&field.velocity, &exact.velocity);
        same(&field.strain, &exact.strain);
        let (energy, exact) = (contact.energy(&t), state.energy());
        same(&energy.total, &exact.total);
        same(&energy.vibrational, &exact.vibrational);
        same(&contact.centre(&t).0, &state.centre().0);
    }
    let slow = Parameters { length: 0.5, wave_speed: 1.0, damping: 1e4, gravity: 0.0, speed: 1.0 };
    assert_eq!(faded_after(&slow, 256), None);
}
