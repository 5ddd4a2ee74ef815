#![allow(clippy::unwrap_used)]
use super::*;

/// c = 3: the contact lasts 2/3.
#[test]
fn a_value_agrees_to_its_last_digit_and_no_further() {
    for (published, within, agrees) in [
        ("'2/3'", "", true),
        ("0.667", "", true),
        ("0.666", "", false),
        ("0.66", "within = 0.007", true),
        ("'2/3'", "within = 1e-9", true),
        ("'2001/3000'", "", false),
    ] {
        let text = format!(
            "rod = {{ length = 1, wave_speed = 3 }}\nimpact.speed = 1\n[[target]]\nquantity = 'duration'\n\
             published = {published}\n{within}\nsource = 'by hand'\n"
        );
        let scene = Scene::parse(&text).unwrap();
        let found = PublishedScene::new("it", &scene, dalembert::Numbers::default()).unwrap();
        assert_eq!(PublishedScene::count(&[found]), (1, usize::from(agrees)), "{published} {within}");
    }
}
