//! Every mistake in a scene is answered with its place, what was found and what was expected.

use dalembert::problem::ProblemErrorKind as Kind;
use dalembert::{Scene, Start};

use crate::command::{run_with, with_snapshots};

/// A scene with a rod that says no more than it must, and this after it.
macro_rules! rod {
    ($rest:literal) => {
        concat!("rod = { length = 1, wave_speed = 1 }\n", $rest)
    };
}

/// A scene with a rod and an impact, and this from line 3 on.
macro_rules! impact {
    ($rest:literal) => {
        concat!(rod!("impact.speed = 1\n"), $rest)
    };
}

/// A rod with a `[[target]]` of these keys, from line 4 on.
macro_rules! target {
    ($keys:literal) => {
        concat!(impact!("[[target]]\n"), $keys)
    };
}

/// A name, a scene with the text that the answer has to point at in «…», and the rule that the scene breaks.
const CASES: &[(&str, &str, Kind)] = &[
    ("empty", "«»", Kind::Missing),
    ("syntax_value", "[rod]\nlength = «»\n", Kind::Syntax),
    ("syntax_table", "[rod«»\nlength = 1\n", Kind::Syntax),
    ("syntax_word", "[rod]\nlength = «one»\n", Kind::Syntax),
    ("syntax_string", "title = \"µ«»\n", Kind::Syntax),
    ("duplicate_key", "[rod]\nlength = 1\n«length» = 2\n", Kind::Syntax),
    ("unknown_table", "[«rood»]\nlength = 1\n", Kind::UnknownKey),
    ("unknown_key", "rod = { length = 1, «wavespeed» = 1 }\n", Kind::UnknownKey),
    ("unknown_key_far", "rod = { length = 1, «colour» = 1 }\n", Kind::UnknownKey),
    ("unknown_first", "«zebra» = 1\napple = 1\n", Kind::UnknownKey),
    ("not_a_table", "rod = «3»\n", Kind::WrongType),
    ("array_of_tables", "«[[rod]]»\nlength = 1\n", Kind::WrongType),
    ("title_number", "title = «3»\nrod = { length = 1, wave_speed = 1 }\n", Kind::WrongType),
    ("missing_length", "[«rod»]\nwave_speed = 1\n", Kind::Missing),
    ("missing_wave_speed", "[«rod»]\nlength = 1\n", Kind::Missing),
    ("missing_density", "[«rod»]\nlength = 1\nmodulus = 1\narea = 1", Kind::Missing),
    ("missing_start", "«»rod = { length = 1, wave_speed = 1 }\n", Kind::Missing),
    ("missing_speed", rod!("[«impact»]\n"), Kind::Missing),
    ("missing_acceleration", rod!("impact = { speed = 1 }\n[«gravity»]\n"), Kind::Missing),
    ("empty_start", rod!("[«start»]\n"), Kind::Missing),
    ("length_true", "rod = { length = «true», wave_speed = 1 }\n", Kind::WrongType),
    ("length_array", "rod = { length = «[1]», wave_speed = 1 }\n", Kind::WrongType),
    ("length_date", "rod = { length = «1979-05-27», wave_speed = 1 }\n", Kind::WrongType),
    ("length_word", "rod = { length = «\"one\"», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_nan", "rod = { length = «nan», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_inf", "rod = { length = «-inf», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_hex", "rod = { length = «0x10», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_octal", "rod = { length = «0o17», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_binary", "rod = { length = «0b11», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_over_zero", "rod = { length = «\"1/0\"», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_huge", "rod = { length = «1e301», wave_speed = 1 }\n", Kind::NotANumber),
    ("length_large", "rod = { length = «1e41», wave_speed = 1 }\n", Kind::OutOfRange),
    ("length_zero", "rod = { length = «0.0», wave_speed = 1 }\n", Kind::OutOfRange),
    ("wave_speed_negative", "rod = { length = 1, wave_speed = «-3» }\n", Kind::OutOfRange),
    ("wave_speed_and_modulus", "[rod]\nlength = 1\n«modulus» = 1\nwave_speed = 1\n", Kind::Contradiction),
    ("wave_speed_and_area", "[rod]\nlength = 1\nwave_speed = 1\n«area» = 1\n", Kind::Contradiction),
    ("round_trip", "rod = { length = «1e30», wave_speed = 1e-30 }\nimpact = { speed = 1 }\n", Kind::Combination),
    ("damping_negative", "rod = { length = 1, wave_speed = 1, damping = «-0.1» }\n", Kind::OutOfRange),
    ("damping_huge", "rod = { length = 1, wave_speed = 1, damping = «1e6» }\n", Kind::Combination),
    ("top", "rod = { length = 1, wave_speed = 1, top = «\"clamped\"» }\n", Kind::OutOfRange),
    ("top_true", "rod = { length = 1, wave_speed = 1, top = «true» }\n", Kind::WrongType),
    ("gravity_negative", rod!("gravity.acceleration = «-9.81»\n"), Kind::OutOfRange),
    (
        "gravity_round_trip",
        "rod = { length = 1e20, wave_speed = 1 }\ngravity.acceleration = «1e30»\n",
        Kind::Combination,
    ),
    ("speed_zero", rod!("impact.speed = «0»\n"), Kind::OutOfRange),
    ("speed_negative", rod!("impact.speed = «\"-1/3\"»\n"), Kind::OutOfRange),
    ("speed_and_drop_height", rod!("impact = { speed = 1, «drop_height» = 2 }\n"), Kind::Contradiction),
    ("drop_height_without_gravity", rod!("impact = { «drop_height» = 2 }\ngravity.acceleration = 0\n"), Kind::Missing),
    ("speed_ratio", rod!("impact = { speed = «1e13» }\ngravity.acceleration = 1\n"), Kind::Combination),
    ("impact_and_start", rod!("impact = { speed = 1 }\n[«start»]\nvelocity = [[0, 0], [1, 0]]\n"), Kind::Contradiction),
    ("start_not_points", rod!("start.velocity = «3»\n"), Kind::WrongType),
    ("start_one_point", rod!("start.velocity = «[[0, 1]]»\n"), Kind::Profile),
    (
        "start_strain_and_displacement",
        rod!("start = { «strain» = [[0, 1], [1, 1]], displacement = [[0, 0], [1, 1]] }\n"),
        Kind::Contradiction,
    ),
    ("start_triple", rod!("start.velocity = [[0, 1], «[1, 2, 3]»]\n"), Kind::WrongType),
    ("start_first", rod!("start.velocity = [[«0.5», 1], [1, 2]]\n"), Kind::Profile),
    (
        "start_last",
        "rod = { length = \"1/3\", wave_speed = 1 }\nstart.velocity = [[0, 1], [«0.33333333333333333333333333», 2]]\n",
        Kind::Profile,
    ),
    ("start_beyond", rod!("start.velocity = [[0, 1], [«2», 2]]\n"), Kind::Profile),
    ("start_backwards", rod!("start.velocity = [[0, 1], [0.5, 0], [«0.4», 0], [1, 2]]\n"), Kind::Profile),
    (
        "start_displacement_jump",
        rod!("start.displacement = [[0, 1], [0.5, 0], [«\"1/2\"», 1], [1, 2]]\n"),
        Kind::Profile,
    ),
    ("start_two_jumps", rod!("start.velocity = [[0, 1], [0.5, 0], [0.5, 1], [«0.5», 2], [1, 2]]\n"), Kind::Profile),
    ("start_jump_at_end", rod!("start.velocity = [[0, 1], [«0», 0], [1, 2]]\n"), Kind::Profile),
    ("start_too_close", rod!("start.velocity = [[0, 1], [«1e-13», 0], [1, 2]]\n"), Kind::Profile),
    ("start_below_ground", rod!("start.displacement = [[0, «-0.5»], [1, 0]]\n"), Kind::OutOfRange),
    ("start_negative_x", rod!("start.displacement = [[«-1», 0.5], [1, 0]]\n"), Kind::OutOfRange),
    ("start_huge", rod!("start.displacement = [[0, «1e50»], [1, 0]]\n"), Kind::OutOfRange),
    ("gap_without_speed", rod!("impact.«gap» = 1\n"), Kind::Missing),
    (
        "gap_and_drop_height",
        rod!("impact = { «gap» = 1, drop_height = 2 }\ngravity.acceleration = 1\n"),
        Kind::Contradiction,
    ),
    ("gap_negative", rod!("impact = { speed = 1, gap = «-1» }\n"), Kind::OutOfRange),
    ("gap_at_rest", rod!("impact = { speed = «0», gap = 1 }\n"), Kind::OutOfRange),
    ("gap_far", rod!("impact = { speed = 1, gap = «1e7» }\n"), Kind::Combination),
    ("gap_word", rod!("impact = { speed = 1, «clearance» = 1 }\n"), Kind::UnknownKey),
    ("units_unknown", "units = «\"mm\"»\nrod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n", Kind::OutOfRange),
    ("target_no_table", impact!("target = «3»\n"), Kind::WrongType),
    ("target_unknown_key", target!("quantity = 'release'\n«value» = 2\n"), Kind::UnknownKey),
    ("target_quantity", target!("quantity = «'u_tip'»\n"), Kind::OutOfRange),
    ("target_without_quantity", impact!("«[[target]]»\npublished = 1\n"), Kind::Missing),
    (
        "target_without_time",
        impact!("«[[target]]»\nquantity = 'u_end'\npublished = 1\nsource = 'here'\n"),
        Kind::Missing,
    ),
    ("target_time_of_a_contact", target!("quantity = 'release'\n«time» = 1\n"), Kind::Contradiction),
    ("target_contact_zero", target!("quantity = 'release'\ncontact = «0»\n"), Kind::WrongType),
    ("target_origin", target!("quantity = 'v_end'\ntime = 1\n«origin» = 'start'\n"), Kind::Contradiction),
    ("target_without_material", impact!("«[[target]]»\nquantity = 'peak_force'\n"), Kind::Missing),
    ("target_without_published", impact!("«[[target]]»\nquantity = 'release'\nsource = 'here'\n"), Kind::Missing),
    ("target_without_source", impact!("«[[target]]»\nquantity = 'release'\npublished = 2\n"), Kind::Missing),
    ("target_number", target!("quantity = 'release'\npublished = «'two'»\nsource = 'here'\n"), Kind::NotANumber),
    ("time_and_impacts", impact!("run = { time = 3, «impacts» = 2 }\n"), Kind::Contradiction),
    ("time_zero", impact!("run.time = «0»\n"), Kind::OutOfRange),
    ("time_long", impact!("run.time = «1e13»\n"), Kind::Combination),
    ("impacts_zero", impact!("run.impacts = «0»\n"), Kind::OutOfRange),
    ("impacts_many", impact!("run.impacts = «10_000_001»\n"), Kind::OutOfRange),
    ("impacts_half", impact!("run.impacts = «1.5»\n"), Kind::WrongType),
    ("accuracy_zero", impact!("run.accuracy = «0»\n"), Kind::OutOfRange),
    ("column_counts_characters", "title = \"µ₀\"\nrod = { length = 1, «\"µ\"» = 1 }\n", Kind::UnknownKey),
    ("meant_modulus", "rod = { length = 1, «youngs_modulus» = 1 }\n", Kind::UnknownKey),
    ("meant_modulus_symbol", "rod = { length = 1, «E» = 1 }\n", Kind::UnknownKey),
    ("meant_damping_symbol", "rod = { length = 1, wave_speed = 1, «r» = 1 }\n", Kind::UnknownKey),
    ("meant_top", "rod = { length = 1, wave_speed = 1, «clamped» = true }\n", Kind::UnknownKey),
    ("meant_drop_height", "rod = {}\nimpact.«height» = 2\n", Kind::UnknownKey),
    ("meant_acceleration", "rod = {}\ngravity.«g» = 9.81\n", Kind::UnknownKey),
    ("meant_another_table", "rod = { «speed» = 3 }\n", Kind::UnknownKey),
    ("material_damping", "rod = { «rayleigh_beta» = 1e-5 }\n", Kind::UnknownKey),
    ("material_damping_elsewhere", "rod = {}\n«kelvin-voigt» = 1\n", Kind::UnknownKey),
    ("meant_no_table", "«length» = 1\n", Kind::UnknownKey),
    ("meant_a_table", "«beam» = { length = 1 }\n", Kind::UnknownKey),
    ("meant_fixed", "rod = { length = 1, top = «\"Fixed end\"» }\n", Kind::OutOfRange),
    ("meant_no_top", "rod = { length = 1, top = «\"glued\"» }\n", Kind::OutOfRange),
    ("unit", "[rod]\nlength = «1 m»\n", Kind::Syntax),
    ("unit_without_space", "rod = { length = «1.5m», wave_speed = 1 }\n", Kind::Syntax),
    ("unit_in_text", "rod = { length = «\"1 m\"» }\n", Kind::NotANumber),
    ("fraction_without_quotes", "[rod]\nlength = «1/3» # L\n", Kind::Syntax),
];

#[test]
fn every_mistake_is_answered_with_its_place() {
    let mut messages = String::new();
    for (name, marked, kind) in CASES {
        let (before, rest) = marked.split_once('«').unwrap();
        let (offending, after) = rest.split_once('»').unwrap();
        let at = (before.matches('\n').count() + 1, before.rsplit('\n').next().unwrap().chars().count() + 1);
        let error = Scene::parse(&[before, offending, after].concat()).expect_err(name);
        assert_eq!(error.kind, *kind, "{name}: {error}");
        assert_eq!((error.line, error.column), at, "{name}: {error}");
        assert_eq!(error.offending(), offending, "{name}: {error}");
        messages.push_str(&format!("{name}\n    {error}\n"));
    }
    with_snapshots(|| insta::assert_snapshot!("scene_error_messages", messages));
}

#[test]
fn what_is_too_large_is_refused() {
    let long = " ".repeat((16 << 20) + 1);
    assert_eq!(Scene::parse(&long).unwrap_err().kind, Kind::TooLong);
    assert_eq!(Scene::parse(&long[1..]).unwrap_err().kind, Kind::Missing);

    let rod = "rod = { length = 1, wave_speed = 1 }\n";
    let points = "[0, 0], ".repeat(100_001);
    let error = Scene::parse(&format!("{rod}start.velocity = [{points}]")).unwrap_err();
    assert_eq!(error.kind, Kind::Profile);
    assert!(error.to_string().len() < 200, "{error}");

    let digits = "1".repeat(30_000);
    let error = Scene::parse(&format!("{rod}impact.speed = 0.{digits}")).unwrap_err();
    assert_eq!(error.kind, Kind::NotANumber);
    assert!(error.to_string().len() < 200, "{error}");
    let deep = "[".repeat(100_000);
    assert_eq!(Scene::parse(&format!("{rod}start.velocity = {deep}")).unwrap_err().kind, Kind::Syntax);
}

/// The limits of the module's documentation, each met from inside and passed.
#[test]
fn limits_are_where_the_documentation_says() {
    let scene = |damping: &str, speed: &str, rest: &str| {
        let rod = format!("rod = {{ length = 0.5, wave_speed = 1, damping = {damping} }}\n");
        Scene::parse(&format!("{rod}impact.speed = {speed}\n{rest}")).map(|_| ()).map_err(|error| error.kind)
    };
    let gravity = "gravity.acceleration = 1\n";
    for damping in ["0", "1e-300", "1e4", "1e6"] {
        assert_eq!(scene(damping, "1", ""), Ok(()), "{damping}");
    }
    assert_eq!(scene("1.1e6", "1", ""), Err(Kind::Combination));
    for speed in ["1e-12", "1e-8", "1e8", "1e12"] {
        assert_eq!(scene("0", speed, gravity), Ok(()), "{speed}");
    }
    assert_eq!(scene("0", "0.9e-12", gravity), Err(Kind::Combination));
    assert_eq!(scene("0", "1.1e12", gravity), Err(Kind::Combination));
    assert_eq!(scene("0", "1e40", ""), Ok(()));
    assert_eq!(scene("0", "1", "run.time = 1e12"), Ok(()));
    assert_eq!(scene("0", "1", "run.impacts = 10_000_000"), Ok(()));
    assert_eq!(scene("0", "1", "run = { impacts = 1, accuracy = 1e-15 }"), Ok(()));
    assert_eq!(scene("0", "1", "run = { impacts = 1, accuracy = 9e-16 }"), Err(Kind::OutOfRange));
}

/// `1/3` and `2/6` are one point; kept as two texts they would be two doubles.
#[test]
fn points_of_equal_value_are_kept_equal() {
    let source = "rod = { length = \"0.6/2\", wave_speed = 1 }
        start.velocity = [[0, 1], [\"0.1\", 2], [\"1/10\", -3], [0.3, 4]]\n";
    let scene = Scene::parse(source).unwrap();
    let Start::Profile(profile) = scene.problem.start() else { panic!("a profile") };
    let kept: Vec<String> = profile.velocity.iter().map(|(x, v)| format!("{x} {v}")).collect();
    assert_eq!(kept, ["0 1", "0.1 2", "0.1 -3", "0.6/2 4"]);
    assert_eq!(scene.line_of("start.velocity"), Some(2));
}

/// Springs stand in several tables, and each error is at the number.
#[test]
fn errors_of_springs_are_at_their_numbers() {
    let rod = "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.time = 1\n";
    let bars = "run.time = 1\n[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n\
                [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n";
    for (scene, wrong) in [
        (format!("{rod}ground.penalty = 1e60\n"), "4:18"),
        (format!("{rod}ground.stiffness = 0\n"), "4:20"),
        (format!("{rod}[ground]\nstiffness = 1\ndamping = 1e50\n"), "6:11"),
        (format!("{bars}joint = {{ stiffness = 0 }}\n"), "10:23"),
        (format!("{bars}joint = {{ penalty = 1e60 }}\n"), "10:21"),
        (format!("{bars}[ends]\nbottom = {{ stiffness = 1e60 }}\n"), "11:24"),
    ] {
        let report = run_with("solve -", &scene).err;
        assert!(report.contains(&format!("standard input:{wrong}\n")), "{wrong}: {report}");
    }
    let report = run_with("solve -", "[rod]\nlength = 1\nwave_speed = 1\nimpedance = 1\n").err;
    assert!(report.contains("expected modulus, density and area; a rod with a bottom"), "{report}");
}

#[test]
fn a_report_shows_the_line() {
    let report = run_with("solve -", "[rod]\nlength = -1 # L\nwave_speed = 1\n").err;
    let place = "standard input:2:10";
    for text in [place, "length = -1 # L", "expected a length above zero", "found length = -1", "^^"] {
        assert_eq!(report.matches(text).count(), 1, "{text} in {report}");
    }
}
