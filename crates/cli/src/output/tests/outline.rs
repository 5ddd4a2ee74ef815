use super::*;

#[test]
fn four_digits_are_right() {
    assert_eq!([-5.0, 2.0 / 3.0, -1.798e8, 1.93342e-4].map(short), ["-5", "0.6667", "-1.798e8", "1.933e-4"]);
}

/// A contact of a thousandth of the history is seen, in its own place.
#[test]
fn short_contacts_are_seen() {
    let piece = |from: f64, to: f64, value: f64| StressPiece {
        start: from,
        end: to,
        strain_start: value,
        strain_end: value,
        chebyshev: Vec::new(),
    };
    let found = least_values(&[piece(0.0, 500.0, 0.0), piece(500.0, 501.0, -3.0), piece(501.0, 1000.0, 0.0)], 1000.0);
    let pressed: Vec<usize> = (0..BLOCKS).filter(|k| found[*k] < 0.0).collect();
    assert_eq!((pressed, found[BLOCKS / 2]), (vec![BLOCKS / 2], -3.0));
    assert!(least_values(&[piece(0.0, 1.0, 0.0)], 1.0).is_empty());
}
