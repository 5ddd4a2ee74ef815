//! Any bytes: a scene, or an error that points into the source. `cargo +nightly fuzz run scene`
#![no_main]

use dalembert::Scene;

libfuzzer_sys::fuzz_target!(|source: &str| {
    match Scene::parse(source) {
        Ok(scene) => assert_eq!(scene.effects().len(), dalembert::Effect::ALL.len()),
        Err(error) => assert!(source.get(error.span.clone()).is_some()),
    }
});
