//! Runs that enclosures confirm, and one that they do not.

use std::ops::ControlFlow;

use crate::ChainScene;
use crate::chain::ChainRun;
use crate::number::{Estimate, Wide};

type Numbers = Estimate<Wide<2>>;

/// Two steel bars with a joint between them: waves from both ends meet there, at irrational times.
fn scene(length: &str, joint: &str) -> ChainScene {
    let bar = "modulus = 2e11\ndensity = 7800\n";
    let text = format!(
        "[[body]]\nlength = 1\n{bar}[[body]]\nlength = \"{length}\"\n{bar}velocity = -1\n\
         {joint}\n[ends]\nbottom = \"fixed\"\n[run]\ntime = 1e-3\n"
    );
    ChainScene::parse(&text).unwrap()
}

#[test]
fn enclosures_confirm_what_coincides_and_nothing_else() {
    let observe = &|_: usize, _: usize| ControlFlow::Continue(());
    for joint in ["joint = { stiffness = 5e9, damping = 2e4 }", "joint = \"contact\""] {
        // The second length differs from the first by less than the bounds of 128 bits tell.
        for (length, is_confirmed) in [("1", true), ("1.00000000000000000000000000000000000000000001", false)] {
            let chain = scene(length, joint).chain;
            let plain = ChainRun::<Numbers>::new(&chain, &(), observe).unwrap();
            // Exact forms of times tell in soft chains that equal bars have one travel time.
            let is_told = joint.contains("stiffness") && is_confirmed;
            assert_eq!(plain.undetermined_from().is_none(), is_told, "{joint} {length}");
            let confirmed = ChainRun::<Numbers>::confirmed(&chain, &(), 128, observe).unwrap();
            assert_eq!(confirmed.undetermined_from().is_none(), is_confirmed, "{joint} {length}");
        }
    }
}
