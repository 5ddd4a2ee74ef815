//! How the first contact ends, over the two numbers that decide it: `R = r t₁` and `M = μ/(g t₁)`.

use rayon::prelude::*;

use super::grid::{Axis, Grid, SweepError, values};
use crate::first_contact::{Bounce, FirstContact};
use crate::motion::Ending;
use crate::number::{Estimate, Number};
use crate::problem::written::short;
use crate::problem::{Parameters, Problem};
use crate::solve::DEFAULT_ACCURACY;
use crate::special::{i0_scaled, i1_scaled};

/// How a first contact ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Regime {
    /// With a bounce at so many round trips, `t_b/t₁`.
    Bounce(f64),
    /// It does not end.
    Never,
    /// Neither is shown.
    Undecided,
}

/// The regimes over a grid, `M` by rows and `R` along them.
#[derive(Debug)]
pub(crate) struct Map {
    pub(crate) damping: Vec<Number>,
    pub(crate) speed: Vec<Number>,
    pub(crate) regimes: Vec<Regime>,
}

impl Map {
    /// The map for the ranges `damping` of R and `speed` of M, as [`Axis`] has them; `done` is called after each point.
    ///
    /// **Source**: a rod with `c = g = t₁ = 1` has `R = r` and `M = μ`.
    ///
    /// **Accuracy**: within [`DEFAULT_ACCURACY`]; the same for any number of threads.
    ///
    /// **Errors**: [`SweepError`] for what is no range.
    pub(crate) fn new(damping: &str, speed: &str, done: impl Fn() + Sync) -> Result<Self, SweepError> {
        let half: Number = "1/2".parse().map_err(|_| SweepError::new("1/2", "a number"))?;
        let rod = Problem::uniform(half, 1.into(), 1.into(), 1.into());
        let axis = |path, text| Ok::<_, SweepError>(Axis { path, values: values(text)? });
        let grid = Grid::new(rod, vec![axis("impact.speed", speed)?, axis("rod.damping", damping)?])?;
        // Before any point is solved.
        for (axis, least) in grid.axes.iter().zip([f64::MIN_POSITIVE, 0.0]) {
            let values: Vec<f64> = axis.values.iter().map(Number::to_f64).collect();
            if values.len() < 2 || values[0] < least || !values.is_sorted_by(|a, b| a < b) {
                let found = axis.values.iter().map(Number::to_string).collect::<Vec<_>>().join(",");
                let expected = "two values or more that increase, R from zero and M from above zero";
                return Err(SweepError::new(format!("the values {}", short(&found)), expected));
            }
        }
        let regime = |index: usize| {
            let regime = regime(&grid, index);
            done();
            regime
        };
        let regimes = (0..grid.len()).into_par_iter().map(regime).collect();
        let [speed, damping] = [0, 1].map(|k: usize| grid.axes[k].values.clone());
        Ok(Map { damping, speed, regimes })
    }
}

/// The bounce alone, of the closed form in doubles: the impulse, the peak and the rest of a [`History`](crate::History)
/// take several times as long. Where doubles do not settle it, the history does.
fn regime(grid: &Grid, index: usize) -> Regime {
    let Ok(problem) = grid.problem(index) else { return Regime::Undecided };
    let rod = Parameters::<Estimate<f64>>::of(&problem, &());
    match rod.map(|rod| FirstContact::new(&rod).bounce()) {
        Ok(Bounce::At { time, .. }) if time.bound() <= DEFAULT_ACCURACY * time.value() => Regime::Bounce(*time.value()),
        Ok(Bounce::Never(_)) => Regime::Never,
        _ => by_history(&problem),
    }
}

fn by_history(problem: &Problem) -> Regime {
    let Ok(history) = problem.first_contact() else { return Regime::Undecided };
    match (history.contacts().first().and_then(|contact| contact.to), history.ending()) {
        (Some(time), _) => Regime::Bounce(time),
        (None, Ending::NoBounce(_)) => Regime::Never,
        _ => Regime::Undecided,
    }
}

/// The `M` above which the bounce comes at `t₁`: `(I₀(R) + I₁(R))/(2 − I₀(R))`; infinite from `I₀(R) = 2` on.
///
/// **Source**: (2.32) in closed form.
///
/// **Accuracy**: within `20 (1 + 2I₀/(2 − I₀))` roundings.
pub(crate) fn threshold(damping_ratio: f64) -> f64 {
    let (i0, i1) = (i0_scaled(&damping_ratio), i1_scaled(&damping_ratio));
    let below = 2.0 * (-damping_ratio).exp() - i0;
    if below > 0.0 { (i0 + i1) / below } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `Σ (x/2)^{2k+n}/(k! (k+n)!)`.
    fn bessel(n: i32, x: f64) -> f64 {
        let mut term = (x / 2.0).powi(n);
        let mut sum = term;
        for k in 1..60 {
            term *= x * x / 4.0 / f64::from(k * (k + n));
            sum += term;
        }
        sum
    }

    #[test]
    fn the_threshold_is_the_closed_form() {
        assert_eq!(threshold(0.0), 1.0);
        for k in 1..=1780 {
            let r = 1e-3 * f64::from(k);
            let (i0, i1) = (bessel(0, r), bessel(1, r));
            let truth = (i0 + i1) / (2.0 - i0);
            let condition = 1.0 + 2.0 * i0 / (2.0 - i0);
            assert!((threshold(r) / truth - 1.0).abs() < 1e-12_f64.min(40.0 * condition * f64::EPSILON), "R = {r}");
        }
        assert_eq!(threshold(1.81), f64::INFINITY);
    }

    #[test]
    fn pixels_keep_to_the_curves() {
        let map = Map::new("0..4:33", "0.1..10:24:log", || ()).unwrap();
        for (k, regime) in map.regimes.iter().enumerate() {
            let (m, r) = (map.speed[k / 33].to_f64(), map.damping[k % 33].to_f64());
            match regime {
                // Corollary 1.
                Regime::Bounce(time) if r == 0.0 => assert!((time - (2.0 - m).max(1.0)).abs() < 1e-14, "M = {m}"),
                Regime::Bounce(time) => {
                    assert!(r < std::f64::consts::PI && *time >= 1.0);
                    assert_eq!(*time == 1.0, m > threshold(r), "R = {r}, M = {m}");
                }
                Regime::Never => assert!(m < threshold(r), "R = {r}, M = {m}"),
                Regime::Undecided => panic!("R = {r}, M = {m}"),
            }
            assert!(r < std::f64::consts::PI || *regime == Regime::Never);
            if k % 7 == 0 {
                let rod = Problem::builder().length("1/2").wave_speed(1).gravity(1);
                let rod = rod.impact_speed(&map.speed[k / 33]).damping(&map.damping[k % 33]).build().unwrap();
                match (by_history(&rod), *regime) {
                    (Regime::Bounce(a), Regime::Bounce(b)) => assert!((a - b).abs() <= 2.0 * DEFAULT_ACCURACY * a),
                    (a, b) => assert_eq!(a, b, "R = {r}, M = {m}"),
                }
            }
        }
    }
}
