//! Many bounces in exact fractions: a vibration that one bounce starts and the next one undoes.
//!
//! The bar of Doyen, Ern and Piperno is dropped from the height 5 and hits the ground with μ = 10. While it flies, the
//! vibration left by the first contact goes on; it comes back in phase, so that the second contact takes it all away.

use dalembert::{Ask, Plan, Scene, Solution, scene::builtin, solve};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The scene is one of those that come with the crate; `Scene::parse` reads your own just as well.
    let scene = Scene::parse(builtin::get("doyen-ern-piperno").ok_or("no such scene")?.source)?;
    // The plan says which engine and which numbers: here, exact fractions.
    let plan = Plan::of(&scene, Ask { exact: true, ..Ask::default() })?;
    let Solution::Exact(history, _) = solve(&scene.problem, &plan, |_, _| ())? else {
        return Err("the plan did not choose fractions".into());
    };

    println!("{:>6} {:>6} {:>8} {:>10} {:>10}", "from", "to", "E", "E_h", "E_z");
    let before = history.energy(&history.contacts()[0].from)?.total;
    for contact in history.contacts() {
        let Some(to) = &contact.to else { break };
        let energy = history.energy(to)?;
        // Energy is constant, and not within rounding: as a fraction.
        assert_eq!(energy.total, before);
        assert_eq!(energy.total, energy.translational.clone() + &energy.vibrational);
        let row =
            [&contact.from, to, &energy.total, &energy.translational, &energy.vibrational].map(ToString::to_string);
        println!("{:>6} {:>6} {:>8} {:>10} {:>10}", row[0], row[1], row[2], row[3], row[4]);
    }

    // The motion is periodic: every event comes again after 16/3.
    let period = rug::Rational::from((16, 3));
    for (event, later) in history.events().iter().zip(&history.events()[4..]) {
        assert_eq!(rug::Rational::from(&event.time + &period), later.time);
        assert_eq!(event.end_velocity, later.end_velocity);
    }
    println!("every event returns after {period}");
    Ok(())
}
