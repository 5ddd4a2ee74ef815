use super::*;

/// Checks T₂ and T₅ on 1 … 3 at a thousand times: the chords are within a millionth of the peak, and no more than four
/// times as many as equal chords at the greatest curvature.
#[test]
fn straight_pieces_follow_the_curve() {
    let chebyshev = vec![0.25, 0.0, 1.0, 0.0, 0.0, 0.5];
    let curve = StressPiece { start: 1.0, end: 3.0, strain_start: 0.75, strain_end: 1.75, chebyshev };
    let parts = straight(std::slice::from_ref(&curve), 1e-6);
    for k in 0..=1000 {
        let time = 1.0 + f64::from(k) / 500.0;
        let part = parts.iter().find(|part| time <= part.end).unwrap_or(&curve);
        assert!((part.eval(&time) - curve.eval(&time)).abs() <= 1.75e-6, "{time}");
    }
    assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start && pair[0].strain_end == pair[1].strain_start));
    // |f″| ≤ 4 + 0.5 · 200: chords of the width √(8 · 1.75e-6/104).
    assert!(parts.len() < 4 * 5500, "{}", parts.len());
    let line = StressPiece { chebyshev: Vec::new(), ..curve };
    assert_eq!(straight(std::slice::from_ref(&line), 1e-6), [line]);
}
