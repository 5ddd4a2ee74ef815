//! Places in the rod where rays are.

use dalembert::{Problem, Rational};

/// Where rays are in the rod, its ends included.
pub(crate) fn cuts(rod: &Problem, history: &dalembert::TypedHistory<Rational>, time: &Rational) -> Vec<Rational> {
    let length = rod.length().to_rational();
    let trip = history.rays(0).unwrap()[0].clone();
    let c = length.clone() * 2 / (trip.to.clone() - trip.from);
    let mut cuts = vec![Rational::new(), length.clone()];
    let trips: Rational = time.clone() * &c / (length.clone() * 2);
    let trips = trips.to_f64() as usize;
    for ray in (trips.saturating_sub(1)..=trips).flat_map(|trip| history.rays(trip).unwrap()) {
        cuts.extend([(time.clone() - ray.from) * &c, (ray.to - time.clone()) * &c]);
    }
    // What the start sends: its own corners go up and down from t = 0.
    if let dalembert::Start::Profile(profile) = rod.start() {
        for (x, _) in profile.displacement.iter().chain(&profile.velocity) {
            let x = x.to_rational();
            let way = time.clone() * &c;
            cuts.extend([x.clone() + &way, x.clone() - &way, length.clone() * 2 - &x - &way, way - &x]);
        }
    }
    cuts.retain(|x| *x >= 0 && *x <= length);
    cuts.sort();
    cuts.dedup();
    cuts
}
