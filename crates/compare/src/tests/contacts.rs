use super::*;

fn at(from: f64) -> ContactRecord {
    ContactRecord { impact: from, release: Some(from + 1.0), ..ContactRecord::default() }
}

/// A box of force 2 from 1 to 3 in steps of ½, with one separation of a single sample.
#[test]
fn a_box_with_chatter() {
    let times: Vec<f64> = (0..=8).map(|k| f64::from(k) / 2.0).collect();
    let force = [0.0, 0.0, 2.0, 2.0, 0.0, 2.0, 2.0, 0.0, 0.0];
    let found = find_contacts(&times, |k| force[k] > 0.0, Some(&force), 1.5);
    assert_eq!(found.len(), 1);
    let touch = &found[0];
    assert_eq!((touch.impact, touch.release, touch.merged, touch.below_step), (0.75, Some(3.25), 1, false));
    // Four samples of weight ½, and the centroid between them.
    assert_eq!((touch.impulse, touch.centroid, touch.peak_force), (Some(4.0), Some(2.0), Some(2.0)));
    // Told apart where separations of a step count.
    assert_eq!(find_contacts(&times, |k| force[k] > 0.0, None, 0.9).len(), 2);
}

/// A contact that does not end, and none at all.
#[test]
fn open_and_none() {
    let found = find_contacts(&[0.0, 1.0, 2.0], |k| k > 0, None, 0.0);
    assert_eq!(found, [ContactRecord { impact: 0.5, release: None, ..ContactRecord::default() }]);
    assert_eq!(find_contacts(&[0.0, 1.0], |_| false, None, 0.0), []);
}

/// Two of theirs are near one of ours: the one with its impulse is the same, and the clock goes on from it.
#[test]
fn the_impulse_tells() {
    let of = |from: f64, impulse: f64| ContactRecord { impulse: Some(impulse), ..at(from) };
    let ours: Vec<ContactRecord> = [0.0, 4.0, 8.0].map(|from| of(from, 3.0)).into();
    let theirs: Vec<ContactRecord> = [(0.0, 3.0), (2.8, 0.1), (4.4, 2.9), (8.8, 3.0)].map(|(at, i)| of(at, i)).into();
    let rows = match_contacts(&ours, &theirs);
    let places: Vec<_> =
        rows.iter().map(|pair| [&pair.ours, &pair.theirs].map(|contact| contact.as_ref().map(|t| t.impact))).collect();
    let expected = [(Some(0.0), 0.0), (None, 2.8), (Some(4.0), 4.4), (Some(8.0), 8.8)];
    assert_eq!(places, expected.map(|(a, b)| [a, Some(b)]));
    // One of length 1 beside steps of ½ and of 0.51.
    let below =
        |step: f64| at(0.0).sampled_at(&(0..9).map(|k| f64::from(k) * step - 2.0).collect::<Vec<_>>()).below_step;
    assert!(!below(0.5) && below(0.51));
}

/// Contacts every 4; theirs drift by 0.5 each, one is left out, one is added.
#[test]
fn drift_a_gap_and_one_too_many() {
    let ours: Vec<ContactRecord> = (0..6).map(|k| at(4.0 * f64::from(k))).collect();
    let theirs: Vec<ContactRecord> = [0.0, 4.5, 13.5, 15.2, 18.0, 22.5].map(at).into();
    let rows = match_contacts(&ours, &theirs);
    let from = |contact: &Option<ContactRecord>| contact.as_ref().map(|contact| contact.impact);
    let times = |pair: &ContactPair| (from(&pair.ours), from(&pair.theirs));
    let expected = [
        (Some(0.0), Some(0.0)),
        (Some(4.0), Some(4.5)),
        (Some(8.0), None),
        (Some(12.0), Some(13.5)),
        (None, Some(15.2)),
        (Some(16.0), Some(18.0)),
        (Some(20.0), Some(22.5)),
    ];
    assert_eq!(rows.iter().map(times).collect::<Vec<_>>(), expected);
}
