use super::*;

/// One trapezoid each, by hand.
#[test]
fn by_hand() {
    let times = [0.0, 1.0, 2.0];
    let books = Books {
        times: &times,
        start: 0,
        displacement: Some(&[-0.5, 1.0, 0.0]),
        force: Some(&[4.0, -1.0, 0.0]),
        energy: Some([&[2.0, 2.0, 2.0], &[4.0, 5.0, 3.5]]),
        centre_velocity: Some(&[-1.0, 0.0, 1.0]),
        momentum: Some([2.0, 3.0, 0.5]),
    };
    let audit = books.audit();
    assert_eq!(audit.penetration, Some(Extreme { value: 0.5, time: 0.0 }));
    assert_eq!(audit.tension, Some(Extreme { value: 1.0, time: 1.0 }));
    // |−0.5 · 4| = 2, |1 · −1| = 1, 0.
    assert_eq!(audit.complementarity, Some(2.0));
    let energy = audit.energy_change.unwrap();
    assert_eq!((energy.change, energy.gain.value, energy.loss.value, energy.relative), (-0.5, 1.0, 0.5, Some(-0.25)));
    // 2 (2 + 0 + 3 · 2) − (3/2 − 1/2).
    assert_eq!(audit.momentum, Some(15.0));
    assert_eq!(Books { force: None, ..books }.audit().complementarity, None);
    // What is given at the start is not of the ground's doing.
    assert_eq!(Books { start: 1, ..books }.audit().penetration, Some(Extreme { value: 0.0, time: 0.0 }));
}

#[test]
fn coverage() {
    let covered = |times: &[f64], end: f64| Books { times, ..Books::default() }.not_covered(1.0, end);
    assert_eq!(covered(&[0.0, 1.0, 2.0], 2.0), Vec::<[f64; 2]>::new());
    assert_eq!(covered(&[3.0, 4.0, 5.0, 16.0], 20.0), [[0.0, 3.0], [5.0, 16.0], [16.0, 20.0]]);
}
