//! Fits by the command: what data do not tell, and the examples.

use std::fmt::Write as _;

use dalembert::{Problem, Quantity, Side};

use crate::command::{Folder, json};

/// Without a force, a stress or a strain only L/c is told: no numbers are made up.
#[test]
fn what_data_do_not_tell() {
    let problem =
        Problem::builder().length(1).wave_speed(2).gravity(1).impact_speed(1).gap("0.05").time(2).build().unwrap();
    let folder = Folder::new();
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 20.0).collect();
    let data = problem.doubles().unwrap().columns(&[Quantity::EndDisplacement], &times, Some(Side::Right)).unwrap();
    let mut text = String::from("t,u\n");
    times.iter().zip(&data[0]).for_each(|(time, u)| writeln!(text, "{time},{u:e}").unwrap());
    folder.write("run.csv", text);
    let scene =
        "rod = { length = 1, wave_speed = 2.1 }\ngravity.acceleration = 1\nimpact = { speed = 1, gap = 0.05 }\n";
    folder.write("rod.toml", scene);
    let said = ["run.csv: found data that do not tell length, wave_speed apart"];
    folder.refused("compare rod.toml run.csv --fit length,wave_speed", &said);
}

/// The examples: a measured bounce, whose truth is 0.42 and 9.81, and bounds for CI.
#[test]
fn the_examples() {
    let [scene, data] = ["../../examples/bounce.toml", "../../examples/bounce.csv"];
    let report = json(&format!("compare {scene} {data} --fit impact_speed,gravity"));
    for (value, truth) in report["fit"]["values"].as_array().unwrap().iter().zip([0.42, 9.81]) {
        let [value, error] = ["value", "error"].map(|key| value[key].as_f64().unwrap());
        assert!((value - truth).abs() <= 2.0 * error && error < 1e-3 * truth, "{report}");
    }
}
