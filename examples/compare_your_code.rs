//! A contact code in ten lines, and its output as a file for `dalembert compare`.
//!
//! Nodes on springs at CFL = 1; a node that would go below the ground is put on it. The rod is that of the scene
//! `doyen-ern-piperno`: L = 10, E = 900, ρ = S = 1, g = 10, and it hits at 10.
//!
//! cargo run --example compare_your_code > run.csv
//! dalembert compare doyen-ern-piperno run.csv

fn main() {
    let (elements, length, wave_speed, gravity, speed) = (400, 10.0, 30.0, 10.0, 10.0);
    let width = length / elements as f64;
    let step = width / wave_speed;
    let mut last = vec![speed * step - gravity * step * step / 2.0; elements + 1];
    let mut now = vec![0.0; elements + 1];
    println!("t,u,v,force");
    for n in 0..9000 {
        let fall = gravity * step * step;
        let mut next = vec![0.0; elements + 1];
        for i in 0..=elements {
            // Both ends are free: what is beyond mirrors what is before.
            let (below, above) = (now[i.abs_diff(1).min(elements)], now[if i < elements { i + 1 } else { i - 1 }]);
            next[i] = below + above - last[i] - fall;
        }
        let pushed = (-next[0]).max(0.0);
        next[0] += pushed;
        // Half an element is the mass of the end.
        let force = width / 2.0 * pushed / (step * step);
        println!("{},{},{},{force}", n as f64 * step, now[0], (next[0] - last[0]) / (2.0 * step));
        (last, now) = (now, next);
    }
}
