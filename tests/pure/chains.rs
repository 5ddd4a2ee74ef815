//! Chains in fractions, digits and proofs of pure Rust.

use dalembert::{ChainScene, Numbers, builtin};

/// Returns the contacts of a built-in chain: node, impact, release and peak force.
fn contacts(name: &str, numbers: Numbers) -> Vec<String> {
    let scene = ChainScene::parse(builtin::get(name).unwrap().source).unwrap();
    let listing = scene.chain.solve(numbers).unwrap().listing().unwrap();
    let text = |contact: &dalembert::chain::ChainContact<dalembert::Value>| {
        let release = contact.release.as_ref().map_or("–".into(), ToString::to_string);
        format!("{} {} {release} {}", contact.node, contact.impact, contact.peak)
    };
    listing.contacts.iter().map(text).collect()
}

#[test]
fn fractions_are_those_of_theory() {
    for (name, expected) in [
        ("openfoam-7-1-1", ["1 1/10 3/10 1/20"].as_slice()),
        ("openfoam-7-1-2", &["1 1/10 27/70 7/170"]),
        ("schwarz-three-bars", &["1 1/5000 19/20000 100", "2 1/5000 19/20000 100"]),
        ("norma-three-bars", &["1 0 3/1000000 1", "2 0 3/1000000 1"]),
        ("cirak-west", &["1 0 20 1/10"]),
        ("hopkinson-striker", &["0 0 – 9/13"]),
    ] {
        assert_eq!(contacts(name, Numbers::Exact), expected, "{name}");
    }
}

/// `4L/c = 4 √(7800/2e11)`, in digits and proved.
#[test]
fn a_release_at_a_root_has_its_digits() {
    for numbers in [Numbers::Digits(30), Numbers::Certified(30)] {
        let found = contacts("code-aster-sdnl111-a", numbers);
        let release = found[0].split(' ').nth(2).unwrap();
        assert!(release.starts_with("0.000789936706325259960697538"), "{numbers:?}: {found:?}");
    }
}
