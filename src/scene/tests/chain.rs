#![allow(clippy::unwrap_used)]
use super::*;
use crate::solve::Numbers;

const PILE: &str = "length = 15\nmodulus = 1e8\ndensity = 2500\n";

/// A body in `[rod]`, and the same in `[[body]]`.
#[test]
fn a_rod_with_other_ends_is_a_body() {
    let loaded = "bottom = 'fixed'\ntop = { force = [[0, 0], [1, -10e3]] }\n";
    let stopped = "bottom = { gap = 2 }\ntop = 'ground'\n";
    for (rod, start, body, ends) in [
        (loaded, "", "", loaded),
        (stopped, "[start]\nvelocity = [[0, -1], [15, 0]]\n", "velocity = [[0, -1], [15, 0]]\n", stopped),
        (
            "top = { velocity = 3 }\n",
            "[impact]\nspeed = 2\ngap = 1\n",
            "velocity = -2\ndisplacement = [[0, 1], [15, 1]]\n",
            "bottom = { gap = 1 }\ntop = { velocity = 3 }\n",
        ),
        ("bottom = 'ground'\n", "[impact]\nspeed = '1/3'\n", "velocity = '-1/3'\n", "bottom = 'ground'\n"),
    ] {
        let short = format!("[rod]\n{PILE}{rod}{start}[gravity]\nacceleration = 2\n[run]\ntime = 0.6\n");
        let long = format!("[[body]]\n{PILE}{body}[ends]\n{ends}[gravity]\nacceleration = 2\n[run]\ntime = 0.6\n");
        assert!(ChainScene::is_chain(&short) && ChainScene::is_chain(&long), "{short}");
        let [short, long] =
            [short, long].map(|text| ChainScene::parse(&text).unwrap_or_else(|error| panic!("{error}")));
        assert_eq!(short.chain, long.chain, "{}", short.source());
        assert_eq!(short.line_of("ends.bottom").or(short.line_of("ends.top")), Some(5));
    }
    // Rods on rigid ground stay what they are.
    for rod in ["", "top = 'free'\n", "top = 'fixed'\n", "top = 'fixd'\n"] {
        assert!(!ChainScene::is_chain(&format!("[rod]\n{PILE}{rod}[impact]\nspeed = 1\n")), "{rod}");
    }
}

/// The rod of one engine, and the body of the other.
#[test]
fn a_rod_on_the_ground_moves_alike() {
    let text = |bottom: &str| {
        format!("[rod]\nlength = 2\nmodulus = 9\ndensity = 1\n{bottom}[impact]\nspeed = 3\ngap = 1\n[run]\ntime = 8\n")
    };
    let rod = Scene::parse(&text("")).unwrap().problem.exact().unwrap();
    let body = ChainScene::parse(&text("bottom = 'ground'\n")).unwrap().body(0).unwrap();
    let body = body.problem.exact().unwrap();
    let times = |history: &crate::TypedHistory<Rational>| -> Vec<_> {
        history.contacts().iter().map(|contact| (contact.impact.clone(), contact.release.clone())).collect()
    };
    assert_eq!(times(&rod), times(&body));
    assert_eq!(times(&rod).len(), 1);
    // The gap is a height of both.
    for time in [0, 1, 3] {
        let height = |history: &crate::TypedHistory<Rational>| {
            history
                .columns(&[crate::Quantity::EndDisplacement], &[Rational::from(time)], Some(crate::Side::Right))
                .unwrap()
        };
        assert_eq!(height(&rod), height(&body), "{time}");
    }
}

#[test]
fn published_values_belong_to_bodies() {
    let two = |target: &str| {
        format!(
            "[[body]]\n{PILE}[[body]]\n{PILE}velocity = -1\n[run]\ntime = 1\n[[target]]\n{target}source = 'by hand'\n"
        )
    };
    let duration = "quantity = 'duration'\npublished = 0.15\n";
    let scene = ChainScene::parse(&two(&format!("body = 2\n{duration}"))).unwrap();
    assert_eq!(scene.targets.len(), 1);
    assert_eq!(scene.bodies().unwrap().iter().flatten().map(|scene| scene.targets.len()).collect::<Vec<_>>(), [0, 1]);
    let one = format!(
        "[rod]\n{PILE}bottom = 'fixed'\n[run]\ntime = 1\n[[target]]\nquantity = 'u_top'\ntime = 1\npublished = 0\nsource = 'by hand'\n"
    );
    assert_eq!(ChainScene::parse(&one).unwrap().body(0).unwrap().targets.len(), 1);
    for (target, found) in
        [(duration.to_string(), "no body in [[target]]"), (format!("body = 3\n{duration}"), "body = 3")]
    {
        let error = ChainScene::parse(&two(&target)).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
    }
    // A rigid mass has values in the whole chain alone.
    let struck = |target: &str| {
        format!("[[body]]\n{PILE}[[body]]\nmass = 1\n[run]\ntime = 1\n[[target]]\n{target}source = 'by hand'\n")
    };
    let error = ChainScene::parse(&struck(&format!("body = 2\n{duration}"))).unwrap_err();
    assert!(error.to_string().contains("found the duration of a rigid mass in [[target]]"), "{error}");
    let scene = ChainScene::parse(&struck("quantity = 'v_end.2'\ntime = 1\npublished = 0\n")).unwrap();
    assert_eq!((scene.targets.len(), scene.chain_targets.len()), (0, 1));
}

#[test]
fn contradictions_are_refused_with_their_place() {
    let cases = [
        ("bottom = 'fixed'\n", "[ends]\ntop = 'free'\n", "[ends] beside [rod]", 8),
        ("damping = 0.1\nbottom = 'fixed'\n", "", "damping of [rod]", 5),
        ("bottom = 'fixed'\n", "[impact]\nspeed = 1\ngap = 1\n", "gap of [impact] above another bottom", 10),
        (
            "bottom = 'free'\n",
            "[impact]\nspeed = 1\n[start]\nvelocity = [[0, 1], [15, 1]]\n",
            "[start] beside the speed",
            10,
        ),
        ("bottom = 'fixed'\n", "[impact]\ndrop_height = 1\n", "expected gap, beside speed = 0", 9),
        ("bottom = 'fixed'\n", "impacts = 3\n", "expected time: a chain runs up to a time", 8),
        ("bottom = { force = 1, gap = 2 }\n", "", "bottom of [rod] with force and gap", 5),
        ("bottom = 'fixd'\n", "", "bottom = 'fixd'", 5),
        ("bottom = { force = [[0, nan]] }\n", "", "found force = nan, expected a number such as 3", 5),
        ("bottom = 'fixed'\njoint = 'bonded'\n", "", "unknown key `joint`", 6),
    ];
    for (rod, more, found, line) in cases {
        let text = format!("[rod]\n{PILE}{rod}[run]\ntime = 1\n{more}");
        let error = ChainScene::parse(&text).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
        assert_eq!(error.line, line, "{error}");
    }
    let scene = ChainScene::parse(&format!("[rod]\n{PILE}bottom = 'fixed'\n[run]\ntime = 1\n")).unwrap();
    assert!(scene.chain.solve(Numbers::Exact).is_ok());
}
