use super::*;
use crate::number::Number;

/// Checks that a release displaced by hand moves every later event by at most the bound, and that the bound does not
/// exceed this by orders of magnitude with each impact.
#[test]
fn events_move_with_a_displaced_release_as_the_bound_says() {
    let number = |text: &str| text.parse::<Number>().unwrap_or_else(|error| unreachable!("{error}"));
    // Below g t₁ = 2 the first release is at a root of the stress; a displaced release at a ray would leave a stripe.
    for (damping, speed, displaced) in [
        ("0.0122", "1.41", -1e-7),
        ("0.0122", "1.41", 1e-7),
        ("0.1", "1", 1e-7),
        ("0.05", "1.7", -1e-7),
        ("0.2", "1.2", 1e-7),
        ("0.00001", "1.3", 1e-8),
    ] {
        let mut problem = Problem::uniform(number("1"), number("1"), number("1"), number(speed));
        problem = problem.to_builder().damping(number(damping)).run(Run::Impacts(5)).build().unwrap();
        let solve = || -> Result<_, Error> {
            let rod = Parameters::<f64>::of(&problem, &())?;
            let contact = FirstContact::new(&rod.carry());
            let bounce = contact.bounce();
            let straight = ContactThenCells::<f64>::solve(&problem, &(), 13.0, bounce)?;
            let first = straight.events()[1].clone();
            let (time, leaves) = (first.t.into_value() + displaced, first.v_end.into_value());
            let release = (time, f64::abs(displaced) + first.t_error, leaves);
            let form = straight.contact.form();
            let task = Task { problem: &problem, precision: &(), effort: Effort::of(13.0), observe: &unobserved };
            let nothing = Estimate::new(0.0, f64::INFINITY);
            let off = Damped::after_bounce(&task, form, (&release.0, release.1, &release.2), &nothing)?;
            Ok((straight, off))
        };
        let (straight, off) = solve().unwrap_or_else(|error| unreachable!("{error}"));
        let (ours, theirs) = (&straight.events()[1..], off.events());
        assert_eq!(ours.len(), theirs.len(), "{damping} {speed}");
        for (k, (a, b)) in ours.iter().zip(theirs).enumerate() {
            let moved = (a.t.value() - b.t.value()).abs();
            assert!(moved <= b.t_error, "{damping} {speed}, event {k}: {moved:e} {:e}", b.t_error);
            let most = f64::abs(displaced) * 30f64.powi(k as i32 + 1);
            assert!(b.t_error <= most, "{damping} {speed}, event {k}: {:e} {most:e}", b.t_error);
        }
    }
}
