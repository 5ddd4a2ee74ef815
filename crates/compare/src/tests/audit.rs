use super::*;

/// One trapezoid each, by hand.
#[test]
fn by_hand() {
    let times = [0.0, 1.0, 2.0];
    let input = AuditInput {
        times: &times,
        start: 0,
        displacement: Some(&[-0.5, 1.0, 0.0]),
        force: Some(&[4.0, -1.0, 0.0]),
        energy: Some([&[2.0, 2.0, 2.0], &[4.0, 5.0, 3.5]]),
        centre_velocity: Some(&[-1.0, 0.0, 1.0]),
        momentum: Some(MomentumTerms { mass: 2.0, gravity: 3.0, damping: 0.5 }),
    };
    let audit = input.audit();
    assert_eq!(audit.penetration, Some(Extreme { value: 0.5, time: 0.0 }));
    assert_eq!(audit.tension, Some(Extreme { value: 1.0, time: 1.0 }));
    // |−0.5 · 4| = 2, |1 · −1| = 1, 0.
    assert_eq!(audit.complementarity, Some(2.0));
    let energy = audit.energy_change.unwrap();
    assert_eq!((energy.change, energy.gain.value, energy.loss.value, energy.relative), (-0.5, 1.0, 0.5, Some(-0.25)));
    // 2 (2 + 0 + 3 · 2) − (3/2 − 1/2).
    assert_eq!(audit.momentum, Some(15.0));
    assert_eq!(AuditInput { force: None, ..input }.audit().complementarity, None);
    // Samples at the start do not count: the ground does not act yet.
    assert_eq!(AuditInput { start: 1, ..input }.audit().penetration, Some(Extreme { value: 0.0, time: 0.0 }));
}

#[test]
fn coverage() {
    let covered = |times: &[f64], end: f64| AuditInput { times, ..AuditInput::default() }.not_covered(1.0, end);
    assert_eq!(covered(&[0.0, 1.0, 2.0], 2.0), Vec::<[f64; 2]>::new());
    assert_eq!(covered(&[3.0, 4.0, 5.0, 16.0], 20.0), [[0.0, 3.0], [5.0, 16.0], [16.0, 20.0]]);
}
