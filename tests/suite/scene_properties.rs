//! Whatever stands in a scene file, reading it ends in a scene or in an error that points into the file.

use dalembert::problem::ProblemErrorKind;
use dalembert::{Material, Number, Run, Scene, Speed, Start, builtin};
use proptest::prelude::*;

/// The error, if there is one, points at characters of the source.
fn check(source: &str) {
    let Err(error) = Scene::parse(source) else { return };
    assert!(error.span.start <= error.span.end && error.span.end <= source.len());
    assert!(source.get(error.span.clone()).is_some());
    let line = source.split('\n').nth(error.line - 1).expect("a line of the source");
    assert!(error.column <= line.chars().count() + 1, "{error}");
    assert!(!error.found.is_empty() && !error.expected.is_empty());
    assert!(error.to_string().lines().count() == 1, "{error}");
}

/// Pieces of scenes, right and wrong.
fn fragment() -> impl Strategy<Value = String> {
    let words = [
        "[rod]",
        "[impact]",
        "[gravity]",
        "[start]",
        "[run]",
        "[[rod]]",
        "length",
        "wave_speed",
        "modulus",
        "density",
        "area",
        "damping",
        "top",
        "speed",
        "drop_height",
        "acceleration",
        "displacement",
        "velocity",
        "time",
        "impacts",
        "accuracy",
        "title",
        "rod",
        "=",
        " = ",
        "\n",
        ",",
        "[",
        "]",
        "{",
        "}",
        "[[0, 0], [1, 1]]",
        "\"fixed\"",
        "\"1/3\"",
        "0.1",
        "-1",
        "1e300",
        "1e-300",
        "nan",
        "inf",
        "0x1F",
        "1_000",
        "'µ'",
        "\"\"\"",
        "#",
        ".",
        "true",
        "1979-05-27",
        "\u{feff}",
    ];
    prop_oneof![
        8 => proptest::sample::select(words.to_vec()).prop_map(str::to_string),
        1 => any::<f64>().prop_map(|x| format!("{x:e}")),
        1 => any::<char>().prop_map(String::from),
    ]
}

/// A positive number of ordinary size, in one of the ways to write it, as it stands in the file and as it is kept.
fn number() -> impl Strategy<Value = (String, String)> {
    let bare = |text: String| (text.clone(), text);
    prop_oneof![
        (1_u32..1_000_000).prop_map(move |n| bare(n.to_string())),
        (1_u32..1000, "[0-9]{1,40}").prop_map(move |(n, fraction)| bare(format!("{n}.{fraction}"))),
        (1_u32..1000, -3..3_i32).prop_map(move |(n, power)| bare(format!("{n}e{power}"))),
        (1_u32..1000, 1_u32..1000).prop_map(|(a, b)| {
            let kept = if b == 1 { a.to_string() } else { format!("{a}/{b}") };
            (format!("\"{a}/{b}\""), kept)
        }),
        (1_u32..1000).prop_map(|n| (format!("{n}_000"), format!("{n}000"))),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2048) })]

    #[test]
    fn any_text_is_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        check(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_words_are_read_or_refused(words in proptest::collection::vec(fragment(), 0..40)) {
        check(&words.concat());
    }

    #[test]
    fn any_change_of_a_scene_is_read_or_refused(
        which in 0..builtin::ALL.len(),
        changes in proptest::collection::vec((any::<prop::sample::Index>(), 0_usize..8, fragment()), 1..4),
    ) {
        let mut chars: Vec<char> = builtin::ALL[which].source.chars().collect();
        for (at, remove, insert) in changes {
            let at = at.index(chars.len() + 1);
            let end = (at + remove).min(chars.len());
            chars.splice(at..end, insert.chars());
        }
        check(&chars.into_iter().collect::<String>());
    }

    #[test]
    fn numbers_are_kept_as_they_were_written(
        length in number(), c in number(), speed in number(), g in number(), time in number(),
    ) {
        let source = format!(
            "[rod]\nlength = {}\nwave_speed = {}\n[impact]\nspeed = {}\n[gravity]\nacceleration = {}\n[run]\ntime = \
            {}\n",
            length.0, c.0, speed.0, g.0, time.0
        );
        let scene = match Scene::parse(&source) {
            Ok(scene) => scene,
            // Numbers of ordinary size can still make a speed ratio that is out of range.
            Err(error) if error.kind == ProblemErrorKind::Combination => {
                return Err(TestCaseError::reject("combination"));
            }
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        let kept = |text: &str| text.parse::<Number>().unwrap();
        prop_assert_eq!(scene.source(), &source);
        prop_assert_eq!(scene.problem.length(), &kept(&length.1));
        prop_assert_eq!(scene.problem.material(), &Material::WaveSpeed(kept(&c.1)));
        prop_assert_eq!(scene.problem.start(), &Start::Uniform(Speed::Given(kept(&speed.1))));
        prop_assert_eq!(scene.problem.gravity(), Some(&kept(&g.1)));
        prop_assert_eq!(scene.problem.run(), &Run::Time(kept(&time.1)));
    }

    #[test]
    fn order_of_numbers_is_that_of_their_values(a in number(), b in number(), negate: (bool, bool)) {
        let signed = |text: &str, negate| format!("{}{text}", if negate { "-" } else { "" }).parse::<Number>().unwrap();
        let (a, b) = (signed(&a.1, negate.0), signed(&b.1, negate.1));
        prop_assert_eq!(a.compare(&b), b.compare(&a).reverse());
        prop_assert!(a.compare(&a).is_eq());
        prop_assert_eq!(a.compare(&b), a.to_rational().cmp(&b.to_rational()));
    }
}
