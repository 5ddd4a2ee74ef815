//! Contacts of data beside ours: which is which, and what the step of the data does not resolve.

use serde_json::Value;

use crate::command::Folder;

/// Golden files of rods that start under tension or compressed, as they are at any step: nothing pulls, nothing is
/// missed or invented, and contacts that the step does not resolve are named as that.
#[test]
fn starts_with_stress() {
    let folder = Folder::new();
    let held = "[rod]\nlength = 1\nmodulus = 2\ndensity = 2\ntop = 'fixed'\n[run]\ntime = 9\n";
    let free = "[rod]\nlength = 1\nmodulus = 2\ndensity = 2\n[gravity]\nacceleration = 0.2\n[run]\ntime = 9\n";
    let scenes = [
        ("compressed.toml", format!("{held}[start]\ndisplacement = [[0, 0.5], [1, 0]]\n")),
        ("pulled.toml", format!("{held}[start]\ndisplacement = [[0, 0.5], [1, 1]]\n")),
        ("standing.toml", format!("{free}[start]\ndisplacement = [[0, 0], [1, 0.5]]\n")),
    ];
    let columns = ["t,u_end,force", "t,side,u_end,v_end,stress,E_total", "t,side,u_end,strain,contact"];
    let one = ["t,force", "t,strain", "t,u_end,stress"];
    let (mut count, mut below) = (0, 0);
    for (scene, source) in scenes {
        folder.write(scene, source);
        let both = columns.map(|columns| (columns, ""));
        let sides = ["--side left", "--side right"].map(|side| one.map(|columns| (columns, side)));
        for (columns, side) in both.into_iter().chain(sides.into_iter().flatten()) {
            for step in ["0.01", "0.07", "0.3"] {
                let golden = format!("reference {scene} --dt {step} --to 9 --columns {columns} {side} -o golden.csv");
                folder.run(&golden).text(0);
                let report = folder.json(&format!("compare {scene} golden.csv"));
                let audit = &report["audit"];
                let found = [&audit["missed"], &audit["invented"], &audit["tension"]["value"]].map(Value::as_f64);
                assert_eq!(found, [Some(0.0); 3], "{scene} {columns} {step}: {audit}");
                assert_eq!(report["hints"], serde_json::json!([]), "{scene} {columns} {step}");
                below += audit["below_step"].as_u64().unwrap();
                count += 1;
            }
        }
    }
    assert!(count == 81 && below > 0, "{below} of {count}");
}
