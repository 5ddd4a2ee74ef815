//! The statements that `docs/bounds.md` rests on, held on characteristic grids by a linear program that has no part in
//! the engines: `∂p/∂η = −½R(p + q)`, `∂q/∂ξ = −½R(p + q)` between `ξ = η` at the ground and `η = ξ + 1` at the top, in
//! boxes by the trapezoidal rule. Each test also refutes what an earlier version stated, so that it can tell.

/// `p` and `q` from the characteristic `ξ = 0` on, in flight, for so many round trips of `n` boxes.
struct Grid {
    n: usize,
    /// By columns `ξ = i/n`: at `η = (i + j)/n`, `j = 0 … n`.
    p: Vec<Vec<f64>>,
    q: Vec<Vec<f64>>,
}

impl Grid {
    /// From `q` on the first characteristic, and what comes up there at the ground besides `q`.
    fn flight(damping: f64, first: &[f64], trips: f64) -> Self {
        let n = first.len() - 1;
        let a = damping / (4.0 * n as f64);
        let (mut p, mut q) = (Vec::new(), vec![first.to_vec()]);
        // Along the first characteristic p follows from q.
        let mut up = vec![first[0]];
        for j in 1..=n {
            up.push(((1.0 - a) * up[j - 1] - a * (first[j - 1] + first[j])) / (1.0 + a));
        }
        p.push(up);
        for i in 1..=(trips * n as f64) as usize {
            let (before_p, before_q) = (&p[i - 1], &q[i - 1]);
            let (mut up, mut down): (Vec<f64>, Vec<f64>) = (Vec::with_capacity(n + 1), Vec::with_capacity(n + 1));
            // At the ground: q comes from the column before, and p is q.
            let ground = ((1.0 - a) * before_q[1] - a * before_p[1]) / (1.0 + 2.0 * a);
            up.push(ground);
            down.push(ground);
            for j in 1..=n {
                let from_p = (1.0 - a) * up[j - 1] - a * down[j - 1];
                if j == n {
                    // The top: q is p.
                    let top = from_p / (1.0 + 2.0 * a);
                    up.push(top);
                    down.push(top);
                } else {
                    let from_q = (1.0 - a) * before_q[j + 1] - a * before_p[j + 1];
                    // p + a(p + q) = from_p and q + a(p + q) = from_q.
                    let sum = (from_p + from_q) / (1.0 + 2.0 * a);
                    up.push(from_p - a * sum);
                    down.push(from_q - a * sum);
                }
            }
            p.push(up);
            q.push(down);
        }
        Grid { n, p, q }
    }

    /// At time `k/n`, at the ends of the steps of `1/n` in x from the ground up, `v_t` and `v_x` by trapezoids:
    /// `2 ∫ v_t dx` and `−∫ (1 − 2x) v_x dx`.
    fn means(&self, k: usize) -> [f64; 2] {
        let half = self.n / 2;
        let [mut rate, mut height] = [0.0; 2];
        for m in 0..=half {
            let weight = if m == 0 || m == half { 0.5 } else { 1.0 } / self.n as f64;
            let (p, q) = (self.p[k - m][2 * m], self.q[k - m][2 * m]);
            rate += weight * (p + q);
            height -= weight * (1.0 - 2.0 * m as f64 / self.n as f64) * 0.5 * (q - p);
        }
        [rate, height]
    }
}

/// The greatest `Σ k q` for `|q| ≤ 1` and `Σ h q = 0`: `q` is the sign of `k − λh`.
fn greatest(k: &[f64], h: &[f64]) -> f64 {
    let of = |lambda: f64| k.iter().zip(h).map(|(k, h)| (k - lambda * h).abs()).sum::<f64>();
    // By duality the least over λ, of a convex function.
    let (mut low, mut high) = (-10.0, 10.0);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if of(a) < of(b) { high = b } else { low = a }
    }
    of(0.5 * (low + high))
}

/// `|z(0,b+τ)| ≤ B e^{−Rτ}`: `B = e^{R/2} √((1 + ρ)/(1 − ρ)/12)` holds; without `e^{R/2}` it does not.
#[test]
fn the_end_of_a_vibration_that_fades() {
    let n = 64;
    let mut refuted = Vec::new();
    for damping in [0.3, 1.0, 1.5, 2.0] {
        // Hats of q, one after the other.
        let grids: Vec<Grid> = (0..=n)
            .map(|j| {
                let first: Vec<f64> = (0..=n).map(|k| if j == k { 1.0 } else { 0.0 }).collect();
                Grid::flight(damping, &first, 3.5)
            })
            .collect();
        let rho = damping / (2.0 * std::f64::consts::PI);
        let old = ((1.0 + rho) / (1.0 - rho) / 12.0f64).sqrt();
        let (new, mut worst) = (old * (damping / 2.0f64).exp(), 0.0f64);
        let means = |k: usize| -> Vec<[f64; 2]> { grids.iter().map(|grid| grid.means(k)).collect() };
        let rates: Vec<f64> = means(n / 2).iter().map(|mean| mean[0]).collect();
        for k in n / 2..3 * n {
            let heights: Vec<f64> = means(k).iter().map(|mean| mean[1]).collect();
            let tau = k as f64 / n as f64;
            worst = worst.max(greatest(&heights, &rates) * (damping * tau).exp());
        }
        assert!(worst <= new, "R = {damping}: {worst} {new}");
        if worst > old {
            refuted.push((damping, worst / old));
        }
    }
    assert!(refuted.len() >= 2 && refuted.iter().any(|(_, by)| *by > 1.15), "{refuted:?}");
}

/// A stripe of mass m brings at most `min(R(T + 1), e^R) m` of q beside itself in T round trips; one round trip's
/// worth,
/// `R m`, is not enough.
#[test]
fn what_a_stripe_scatters() {
    let n = 200;
    let mut refuted = 0;
    for (damping, trips) in [(0.01, 100.0), (0.1, 6.0), (0.1, 30.0), (0.5, 5.0), (1.5, 4.0)] {
        // The stripe begins as q just above the ground, with the mass 1: a hat.
        let mut first = vec![0.0; n + 1];
        first[1] = n as f64;
        let grid = Grid::flight(damping, &first, trips);
        let mut most = 0.0f64;
        for (i, (p, q)) in grid.p.iter().zip(&grid.q).enumerate() {
            for j in 0..=n {
                // The ray, of p and of q, and the boxes next to it.
                let beside = |place: usize| (4..n - 4).contains(&(place % n));
                if beside(i) {
                    most = most.max(p[j].abs());
                }
                if beside(i + j) {
                    most = most.max(q[j].abs());
                }
            }
        }
        let bound = f64::min(damping * (trips + 1.0), damping.exp());
        assert!(most <= bound, "R = {damping}, T = {trips}: {most} {bound}");
        refuted += usize::from(most > damping);
    }
    assert!(refuted >= 2, "{refuted}");
}

/// `‖G‖ ≤ R²/8 (1 + R²/150)`, where G takes the k-th mode by `i(√(ω² − R²) − ω)`, `ω = 2πk`, and its norm is the
/// integral of its kernel; `R²/8` alone is not enough.
#[test]
fn what_a_round_trip_adds() {
    let tau = 2.0 * std::f64::consts::PI;
    for damping in [0.2, 1.0, 2.0f64] {
        let square = damping * damping;
        let points = 2000;
        let kernel = |s: f64| {
            // The first order of each mode sums to ½R² (½ − s), and the rest falls like k⁻³.
            let rest = |k: u32| {
                let omega = tau * f64::from(k);
                // ω − √(ω² − R²) − R²/2ω without cancellation.
                let root = (omega * omega - square).sqrt();
                square * (omega - root) / (2.0 * omega * (omega + root)) * 2.0 * (omega * s).sin()
            };
            0.5 * square * (0.5 - s) + (1..=60).map(rest).sum::<f64>()
        };
        let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(points);
        let norm = (0..points).map(|k| kernel(middle(k)).abs()).sum::<f64>() / f64::from(points);
        assert!(norm <= square / 8.0 * (1.0 + square / 150.0), "R = {damping}: {norm}");
        assert!(norm > square / 8.0 * (1.0 + square / 400.0), "R = {damping}: {norm}");
    }
}

/// The longest path of cells to a characteristic of n segments after k strips: at most `2k + n`, and more than `2k`.
#[test]
fn the_longest_path_of_cells() {
    for n in 1..40usize {
        let mut depth = vec![0usize; n];
        for k in 1..200usize {
            // The triangle at the ground, then the cells of the strip, and the triangle at the top.
            let mut path = depth[0] + 1;
            for next in &mut depth[1..] {
                path = path.max(*next) + 1;
                *next = path;
            }
            depth.rotate_left(1);
            depth[n - 1] = path + 1;
            let longest = depth.iter().copied().max().unwrap_or_default();
            assert!(longest <= 2 * k + n, "{n} {k}: {longest}");
            assert!(n == 1 || longest > 2 * k, "{n} {k}: {longest}");
        }
    }
}
