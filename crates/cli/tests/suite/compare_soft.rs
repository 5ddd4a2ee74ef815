//! `compare` with a contact that yields.

use crate::command::{Folder, json, quiet, refused};
use serde_json::Value;

/// Samples of the exact soft solution have no error of a scheme: all that they differ from rigid contact is the
/// contact.
#[test]
fn the_contact_explains_what_a_penalty_does() {
    let folder = Folder::new();
    let data = folder.path("run.csv");
    // Many times are those of rays, where pieces of the exact signals meet.
    let args = "sample getfem-penalty --times 0..3:301 --quantity u_end,v_end,force,E_total";
    quiet(&format!("{args} --format csv -o {data}"));
    let soft = json(&format!("compare getfem-penalty {data}"));
    let given = format!("compare getfem-dynamic-contact {data} --contact-stiffness 20 --to 3");
    let given = json(&given);
    for report in [&soft, &given] {
        let parts = report["softness"].as_array().unwrap();
        assert_eq!(parts.len(), 4);
        for part in parts {
            let norm = |which: &str| part[which]["absolute"].as_f64().unwrap();
            assert!(norm("scheme") < 1e-9, "{part}");
            assert!((norm("from_rigid") - norm("contact")).abs() < 1e-9, "{part}");
            assert!(norm("contact") > 1e-3, "{part}");
        }
        // The end goes (1 − e⁻²⁰)/40 deep, for two travel times: an L² norm between those of a part and of all of them.
        let depth = parts[0]["contact"]["absolute"].as_f64().unwrap();
        assert!((0.02..0.04).contains(&depth), "{depth}");
    }
    let table = quiet(&format!("compare getfem-penalty {data}"));
    assert!(table.contains("theirs − rigid   their contact: soft − rigid   their scheme: theirs − soft"), "{table}");
    // A single rod on a spring is audited as one on rigid ground is, but it goes into the ground.
    for report in [&soft, &given] {
        let audit = &report["audit"];
        let depth = (1.0 - f64::exp(-20.0)) / 40.0;
        for who in ["penetration", "indentation"] {
            assert!((audit[who]["value"].as_f64().unwrap() - depth).abs() < 1e-3, "{audit}");
        }
        assert!(audit["complementarity"].is_null() && !audit["energy_change"].is_null(), "{audit}");
    }
    assert!(table.contains("; ours: 0.025 at t = 2"), "{table}");
    // A stiffer spring is not that of the data.
    let stiff = format!("compare getfem-dynamic-contact {data} --contact-stiffness 200 --to 3");
    let stiff = json(&stiff);
    let scheme = |report: &Value| report["softness"][0]["scheme"]["absolute"].as_f64().unwrap();
    assert!(scheme(&stiff) > 0.01, "{}", scheme(&stiff));
    // Rigid contact has no such parts.
    let rigid = json(&format!("compare getfem-dynamic-contact {data} --to 3"));
    assert_eq!(rigid["softness"], serde_json::json!([]));
    for (scene, said) in [
        ("figure-4-r01", "found a damped rod on a spring, expected a rod without damping"),
        (
            "getfem-penalty",
            "found a body of a chain on a spring, expected a joint with a stiffness in its scene, or a rod by itself",
        ),
    ] {
        refused(&format!("compare {scene} {data} --contact-stiffness 20"), &[said]);
    }
    refused(&format!("compare getfem-dynamic-contact {data} --contact-stiffness -1"), &["stiffness = -1"]);
}

/// A rod by itself and the same rod as a chain of one body are compared alike: samples on rays of the start, which no
/// event begins, count as such.
#[test]
fn a_rod_and_a_chain_of_one_body_are_compared_alike() {
    let folder = Folder::new();
    let (data, chain) = (folder.path("run.csv"), folder.path("chain.toml"));
    let scene = "[rod]\nlength = 1\nwave_speed = 1\nimpedance = 1\ntop = \"fixed\"\nbottom = { gap = 0.5 }\n\
                 [start]\ndisplacement = [[0, 0.5], [1, 0]]\n[run]\ntime = 3\n";
    std::fs::write(&chain, scene).unwrap();
    // The limit from earlier times at each ray, 1e-3 beside the solution elsewhere.
    let rows = (0..=300).map(|k| {
        let (whole, part) = (k / 100, k % 100);
        let before = [0.0, -0.5, 0.0, 0.5][if part == 0 { whole } else { whole + 1 }];
        format!("{},{}\n", f64::from(k as u32) / 100.0, if part == 0 { before } else { before + 1e-3 })
    });
    std::fs::write(&data, format!("t,v_end\n{}", rows.collect::<String>())).unwrap();
    for scene in ["getfem-dynamic-contact", &chain] {
        let report = json(&format!("compare {scene} {data} --to 3"));
        let column = &report["quantities"][0];
        assert_eq!(column["on_jumps"], 4, "{column}");
        for norm in ["linf", "linf_off_jumps"] {
            let found = column[norm]["absolute"].as_f64().unwrap();
            assert!((found - 1e-3).abs() < 1e-9, "{scene}: {norm} {found}");
        }
    }
}

/// A stiffness that differs by less than a step in time shows is named where it explains the data by itself.
#[test]
fn another_stiffness_is_named() {
    let folder = Folder::new();
    let scene = |stiffness: f64| {
        let rod =
            "rod = { length = 1, wave_speed = 1, impedance = 1 }\nimpact.speed = 0.1\ngravity.acceleration = 0.1\n";
        folder.write("rod.toml", format!("{rod}ground.stiffness = {stiffness}\nrun.time = 4\n"));
    };
    for (stiffness, share) in [(49.0, -0.02), (60.0, 0.2), (50.0, 0.0)] {
        scene(stiffness);
        let args = format!("--times 0..4:801 --quantity u_end,v_end,force --format csv -o {}", folder.path("run.csv"));
        quiet(&format!("sample {} {args}", folder.path("rod.toml")));
        scene(50.0);
        let report = json(&format!("compare {} {}", folder.path("rod.toml"), folder.path("run.csv")));
        let hints = report["hints"].as_array().unwrap();
        if share == 0.0 {
            assert!(hints.is_empty(), "{hints:?}");
            continue;
        }
        assert_eq!((hints.len(), hints[0]["kind"].as_str()), (1, Some("contact_stiffness")), "{hints:?}");
        assert!((hints[0]["value"].as_f64().unwrap() - share).abs() < 0.02 * share.abs(), "{hints:?}");
    }
}

/// A free rod on a penalty, by central differences with lumped masses: `t,u_end,force`.
fn penalty_run(elements: usize, stiffness: f64) -> String {
    let h = 1.0 / elements as f64;
    let step = 0.5 * h;
    let (mut u, mut v) = (vec![0.0f64; elements + 1], vec![-1.0; elements + 1]);
    let mass = |k: usize| if k == 0 || k == elements { 0.5 * h } else { h };
    let force = |u: &[f64], k: usize| {
        let below = if k > 0 { (u[k] - u[k - 1]) / h } else { stiffness * u[0].min(0.0) };
        let above = if k < elements { (u[k + 1] - u[k]) / h } else { 0.0 };
        above - below
    };
    let mut out = String::from("t,u_end,force\n");
    let steps = (3.0 / step).round() as usize;
    for n in 0..=steps {
        out += &format!("{},{},{}\n", n as f64 * step, u[0], -stiffness * u[0].min(0.0));
        let push = step * if n == 0 { 0.5 } else { 1.0 };
        for (k, speed) in v.iter_mut().enumerate() {
            *speed += push * force(&u, k) / mass(k);
        }
        u.iter_mut().zip(&v).for_each(|(place, speed)| *place += step * speed);
    }
    out
}

/// On finer meshes the part of the scheme falls, and that of the contact stays.
#[test]
fn finer_meshes_leave_the_part_of_the_contact() {
    let folder = Folder::new();
    let scene = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.time = 3\n";
    let scene = folder.write("rod.toml", scene);
    let parts: Vec<[f64; 2]> = [50, 200]
        .iter()
        .map(|elements| {
            let data = folder.path(&format!("{elements}.csv"));
            std::fs::write(&data, penalty_run(*elements, 20.0)).unwrap();
            let report = json(&format!("compare {scene} {data} --contact-stiffness 20"));
            ["contact", "scheme"].map(|which| report["softness"][0][which]["absolute"].as_f64().unwrap())
        })
        .collect();
    // The stiffness that explains the finer run best is its own.
    let fit = format!("compare {scene} {} --contact-stiffness 10 --fit stiffness", folder.path("200.csv"));
    let fitted = json(&fit);
    let found = fitted["fit"]["values"][0]["value"].as_f64().unwrap();
    assert!((found - 20.0).abs() < 0.2, "{found}");
    // What remains is the error of the scheme, which the standard error does not know.
    assert!(fitted["fit"]["correlation"].as_f64().unwrap() > 0.5, "{}", fitted["fit"]);
    let table = quiet(&fit);
    assert!(table.contains("a finer mesh shows it"), "{table}");
    let [[coarse_contact, coarse], [fine_contact, fine]] = parts[..] else { panic!("{parts:?}") };
    assert!((coarse_contact - fine_contact).abs() < 0.01 * fine_contact, "{parts:?}");
    assert!(fine < 0.5 * coarse && fine < 0.1 * fine_contact, "{parts:?}");
}
