//! Bounds of responses against exponentials of matrices of two states in closed form.

use crate::chain::response::Response;

/// Returns `e^{At}` for `A = ((−a, w), (−w, −b))`, from `e^{−μt} (cosh(δt) + (A + μ) sinh(δt)/δ)`.
fn exponential([a, w, b]: [f64; 3], t: f64) -> [[f64; 2]; 2] {
    let (mean, half) = ((a + b) / 2.0, (a - b) / 2.0);
    let square = half * half - w * w;
    let [even, odd] = match square {
        _ if square > 0.0 => {
            // Both exponents are negative, so that nothing overflows.
            let root = square.sqrt();
            let slow = -(a * b + w * w) / (mean + root);
            let [fast, slow] = [(-(mean + root) * t).exp(), (slow * t).exp()];
            [(slow + fast) / 2.0, (slow - fast) / (2.0 * root)]
        }
        _ => {
            let root = (-square).sqrt();
            let decay = (-mean * t).exp();
            [decay * (root * t).cos(), decay * if root == 0.0 { t } else { (root * t).sin() / root }]
        }
    };
    [[even - half * odd, w * odd], [-w * odd, even + half * odd]]
}

/// Returns the greatest magnitudes and their integrals over all times, on a grid of times that is fine beside each rate
/// and reaches far beyond the slowest.
fn sampled(system: [f64; 3], slowest: f64) -> [[[f64; 2]; 2]; 2] {
    let (mut peak, mut integral) = ([[0.0f64; 2]; 2], [[0.0; 2]; 2]);
    let [a, w, b] = system;
    let mut t = 0.0;
    let mut step = 1e-3 / (a + w + b);
    while t < 60.0 / slowest {
        let middle = exponential(system, t + step / 2.0);
        for i in 0..2 {
            for j in 0..2 {
                peak[i][j] = peak[i][j].max(middle[i][j].abs());
                integral[i][j] += middle[i][j].abs() * step;
            }
        }
        t += step;
        // Fine beside the time since the beginning, and beside an oscillation.
        step = (1e-3 * t).max(1e-3 / (a + w + b)).min(if 2.0 * w > (a - b).abs() { 0.02 / w } else { f64::INFINITY });
    }
    [peak, integral]
}

#[test]
fn responses_bound_what_they_are_of() {
    // Weakly and strongly damped, near critical, and a light mass beside a soft spring.
    let cases = [
        ([0.3, 1.0, 0.0], 0.15),
        ([2.0, 1.0, 0.0], 1.0),
        ([2.0, 1.0 - 1e-9, 0.0], 0.99),
        ([0.1, 40.0, 0.02], 0.06),
        ([1e6, 1e4, 0.0], 1e2),
        ([1e10, 1e6, 0.0], 1e2),
        ([3.0, 0.0, 5.0], 3.0),
    ];
    for (system, slowest) in cases {
        let [a, w, b] = system;
        let response = Response::new(&vec![vec![-a, w], vec![-w, -b]]).unwrap();
        let [peak, integral] = sampled(system, slowest);
        let left = exponential(system, response.time);
        for i in 0..2 {
            for j in 0..2 {
                let at = format!("{system:?}, element {i}, {j}: {response:?}, sampled {peak:?}, {integral:?}");
                // The sum of the middles is within a few thousandths of the integral.
                assert!(response.peak[i][j] >= peak[i][j] * (1.0 - 1e-9), "{at}");
                assert!(response.integral[i][j] >= integral[i][j] * 0.99, "{at}");
                assert!(response.left[i][j] >= left[i][j].abs(), "{at}");
                assert!(response.peak[i][j] <= 3.0 * peak[i][j] + 1e-12, "{at}");
                assert!(response.integral[i][j] <= 12.0 * integral[i][j] + 1e-12, "{at}");
                assert!(response.left[i][j] <= 1.0 / 32.0, "{at}");
            }
        }
    }
}

#[test]
fn what_does_not_decay_has_no_response() {
    for undamped in [vec![vec![0.0, 1.0], vec![-1.0, 0.0]], vec![vec![0.0]], vec![vec![f64::NAN]]] {
        assert_eq!(Response::new(&undamped), None);
    }
}
