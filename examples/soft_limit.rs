//! A free rod on a penalty: duration of the contact, depth and peak force, and the rigid limit that they go to.
//!
//! `cargo run --example soft_limit`

use dalembert::Numbers;
use dalembert::chain::{Body, Chain, End, Spring};

fn main() -> Result<(), dalembert::Error> {
    println!(
        "{:>12} {:>18} {:>18} {:>16} {:>16}",
        "k L/EA", "duration c/L", "(t − 2L/c) kc/EA", "depth c/vL", "peak force/Zv"
    );
    for power in 0..10 {
        let stiffness = 10i64.pow(power);
        // L = c = Z = 1, so that EA/L = 1; the rod lands with a speed of one.
        let rod = Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
        let ground = End::Ground { gap: 0.into(), velocity: Vec::new() };
        let spring = Spring { stiffness: stiffness.into(), damping: 0.into() };
        let chain = Chain::builder(rod).bottom(ground).spring(0, spring).until(5.into()).build()?;
        // The part beyond 2L/c is small for a stiff ground: 25 digits leave it 15.
        let listing = chain.solve(Numbers::Digits(25))?.listing()?;
        let contact = &listing.contacts[0];
        let Some(release) = &contact.release else { continue };
        let (whole, rest) = release.to_string().split_once('.').map_or((0.0, 0.0), |(whole, rest)| {
            (whole.parse().unwrap_or(f64::NAN), format!("0.{rest}").parse().unwrap_or(f64::NAN))
        });
        let late = (whole - 2.0 + rest) * stiffness as f64;
        let peak = contact.peak.to_f64();
        let depth = peak / stiffness as f64;
        println!("{stiffness:>12} {:>18.12} {late:>18.12} {depth:>16.6e} {peak:>16.12}", whole + rest);
    }
    println!("{:>12} {:>18.12} {:>18.12} {:>16} {:>16}", "rigid", 2.0, 1.678_346_990_016_661, 0, 1);
    Ok(())
}
