//! The rays of the first round trips in the x-t plane, and the jumps that they carry.
//!
//! Where v_t or v_x jumps, the jump travels with the speed c along a ray ct = ±(x − 2kL). A ray starts when the rod
//! hits the ground or leaves it, runs up, is reflected at the top, comes back down after t₁ = 2L/c, and so on for ever.
//! Proposition 2 says how large the jumps are: going up [v_t] = −c [v_x], coming down [v_t] = c [v_x].

use dalembert::engine::reflection;
use dalembert::glam::DVec2;
use dalembert::{Error, Problem};

fn main() -> Result<(), Error> {
    // L = c = g = 1 and μ = 3: contact from 0 to 2, then flight until t = 8.
    let history = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(8).build()?.doubles()?;
    // What an end does to a jump ([v_x], [v_t]) is a matrix: a held end turns [v_t] round, a free one [v_x].
    let (ground_in_flight, free_top) = (reflection(false), reflection(false));

    println!("leaves  returns   up: [v_x]  [v_t]    down: [v_x]  [v_t]");
    let mut coming_down = DVec2::ZERO;
    for trip in 0..4 {
        for ray in history.rays(trip)? {
            let (up, down) = (ray.up_vector(), ray.down_vector());
            println!("{:6.2}  {:7.2}  {:10.3} {:6.3}  {:12.3} {:6.3}", ray.from, ray.to, up.x, up.y, down.x, down.y);
            // Along x = ct + const nothing may tear the rod: [v_t] + c [v_x] = 0 with c = 1, and the mirror image going
            // down.
            assert_eq!(up.y, -up.x);
            assert_eq!(down.y, down.x);
            assert_eq!(down, free_top * up);
            if trip >= 2 {
                // In flight the ground end is free too: what came down goes up again, with [v_x] turned round.
                assert_eq!(up, ground_in_flight * coming_down);
            }
            coming_down = down;
        }
    }
    Ok(())
}
