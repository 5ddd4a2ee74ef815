use super::*;

/// Held against forty digits, up to where `2 − I₀` has lost all that doubles have.
#[test]
fn the_threshold_lies_within_its_bound() {
    use dalembert::number::Float;
    let mut worst = 0.0f64;
    for k in 0..=1807 {
        let r: Number = format!("{k}e-3").parse().unwrap();
        let found = threshold(&Estimate::from_number(&r, &())).unwrap();
        let ThresholdRatio { numerator, denominator } = ThresholdRatio::new(&Float::from_number(&r, &140));
        let truth = numerator / denominator;
        let off = Scalar::to_f64(&(Float::with_val(140, found.value()) - truth)).abs();
        // Each function has some ten roundings, and a part of 2 − I₀ has all of them.
        let condition = 1.0 + 2.0 * found.value();
        assert!(off <= found.bound() && found.bound() < 40.0 * condition * condition * f64::EPSILON, "R = {r}");
        worst = worst.max(off / found.value());
    }
    assert!(worst > 1e-13, "{worst:e}");
    assert_eq!((threshold_near(0.0), threshold_near(1.81)), (1.0, f64::INFINITY));
}

#[test]
fn pixels_keep_to_the_curves() {
    let map = Map::new("0..4:33", "0.1..10:24:log", &|| ()).unwrap();
    for (k, regime) in map.regimes.iter().enumerate() {
        let (m, r) = (map.speed[k / 33].to_f64(), map.damping[k % 33].to_f64());
        let threshold = threshold_near(r);
        match regime {
            // Corollary 1.
            Regime::Bounce(time) if r == 0.0 => assert!((time - (2.0 - m).max(1.0)).abs() < 1e-14, "M = {m}"),
            Regime::Bounce(time) => {
                assert!(r < std::f64::consts::PI && *time >= 1.0);
                assert_eq!(*time == 1.0, m > threshold, "R = {r}, M = {m}");
            }
            Regime::Never => assert!(m < threshold, "R = {r}, M = {m}"),
            Regime::Undecided => panic!("R = {r}, M = {m}"),
        }
        assert!(r < std::f64::consts::PI || *regime == Regime::Never);
        if k % 7 == 0 {
            let rod = Problem::builder().length("1/2").wave_speed(1).gravity(1);
            let rod = rod.impact_speed(&map.speed[k / 33]).damping(&map.damping[k % 33]).build().unwrap();
            let plan = Plan::of(&rod, &Question::first_contact(Numbers::default())).unwrap();
            match (by_plan(&rod, &plan), *regime) {
                (Regime::Bounce(a), Regime::Bounce(b)) => {
                    assert!((a - b).abs() <= 2.0 * dalembert::solve::DEFAULT_ACCURACY * a);
                }
                (a, b) => assert_eq!(a, b, "R = {r}, M = {m}"),
            }
        }
    }
}
