#![allow(clippy::unwrap_used)]
use super::*;

fn default_time(scene: &str, quantity: Quantity) -> f64 {
    let question = RouteQuestion::from_scene(&Scene::parse(scene).unwrap(), Some(quantity), None).unwrap();
    question.time().unwrap().to_f64()
}

/// c = L = g = 1, μ = 4, t₁ = 2: on the ground up to t₁, and in the flight after it beyond.
#[test]
fn the_default_time_is_one_at_which_the_quantity_is_not_zero() {
    let scene = "rod = { length = 1, wave_speed = 1 }\ngravity.acceleration = 1\nimpact.speed = 4";
    assert_eq!(default_time(scene, Quantity::Strain), 1.5);
    let flight = default_time(scene, Quantity::EndDisplacement);
    assert!(flight > 2.0, "{flight}");
    let damped = scene.replace("wave_speed = 1", "wave_speed = 1, damping = 0.2");
    assert!(default_time(&damped, Quantity::EndDisplacement) > 2.0);
    // A rod that starts in the air, so high that its first round trip passes there.
    let above = "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = 8 }\n";
    assert_eq!(default_time(above, Quantity::Strain), 9.0);
}
