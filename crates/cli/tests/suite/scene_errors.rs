//! Every mistake in a scene is answered with its place, what was found and what was expected.

use dalembert::problem::ProblemErrorKind as Kind;
use dalembert::{Scene, Start};

/// A scene, the rule that it breaks, and the line, column and text that the answer has to point at.
struct Case {
    name: &'static str,
    scene: &'static str,
    kind: Kind,
    at: (usize, usize),
    offending: &'static str,
}

/// A rod with a `[[target]]` of these keys, from line 4 on.
macro_rules! target {
    ($keys:literal) => {
        concat!("rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n[[target]]\n", $keys)
    };
}

const fn case(
    name: &'static str,
    scene: &'static str,
    kind: Kind,
    at: (usize, usize),
    offending: &'static str,
) -> Case {
    Case { name, scene, kind, at, offending }
}

/// Rod and impact stand in one line each where they are not the point.
const CASES: &[Case] = &[
    case("empty", "", Kind::Missing, (1, 1), ""),
    case("syntax_value", "[rod]\nlength = \n", Kind::Syntax, (2, 10), ""),
    case("syntax_table", "[rod\nlength = 1\n", Kind::Syntax, (1, 5), ""),
    case("syntax_word", "[rod]\nlength = one\n", Kind::Syntax, (2, 10), "one"),
    case("syntax_string", "title = \"µ\n", Kind::Syntax, (1, 11), ""),
    case("duplicate_key", "[rod]\nlength = 1\nlength = 2\n", Kind::Syntax, (3, 1), "length"),
    case("unknown_table", "[rood]\nlength = 1\n", Kind::UnknownKey, (1, 2), "rood"),
    case("unknown_key", "rod = { length = 1, wavespeed = 1 }\n", Kind::UnknownKey, (1, 21), "wavespeed"),
    case("unknown_key_far", "rod = { length = 1, colour = 1 }\n", Kind::UnknownKey, (1, 21), "colour"),
    case("unknown_first", "zebra = 1\napple = 1\n", Kind::UnknownKey, (1, 1), "zebra"),
    case("not_a_table", "rod = 3\n", Kind::WrongType, (1, 7), "3"),
    case("array_of_tables", "[[rod]]\nlength = 1\n", Kind::WrongType, (1, 1), "[[rod]]"),
    case("title_number", "title = 3\nrod = { length = 1, wave_speed = 1 }\n", Kind::WrongType, (1, 9), "3"),
    case("missing_length", "[rod]\nwave_speed = 1\n", Kind::Missing, (1, 2), "rod"),
    case("missing_wave_speed", "[rod]\nlength = 1\n", Kind::Missing, (1, 2), "rod"),
    case("missing_density", "[rod]\nlength = 1\nmodulus = 1\narea = 1", Kind::Missing, (1, 2), "rod"),
    case("missing_start", "rod = { length = 1, wave_speed = 1 }\n", Kind::Missing, (1, 1), ""),
    case("missing_speed", "rod = { length = 1, wave_speed = 1 }\n[impact]\n", Kind::Missing, (2, 2), "impact"),
    case(
        "missing_acceleration",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1 }\n[gravity]\n",
        Kind::Missing,
        (3, 2),
        "gravity",
    ),
    case("empty_start", "rod = { length = 1, wave_speed = 1 }\n[start]\n", Kind::Missing, (2, 2), "start"),
    case("length_true", "rod = { length = true, wave_speed = 1 }\n", Kind::WrongType, (1, 18), "true"),
    case("length_array", "rod = { length = [1], wave_speed = 1 }\n", Kind::WrongType, (1, 18), "[1]"),
    case("length_date", "rod = { length = 1979-05-27, wave_speed = 1 }\n", Kind::WrongType, (1, 18), "1979-05-27"),
    case("length_word", "rod = { length = \"one\", wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "\"one\""),
    case("length_nan", "rod = { length = nan, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "nan"),
    case("length_inf", "rod = { length = -inf, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "-inf"),
    case("length_hex", "rod = { length = 0x10, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "0x10"),
    case("length_octal", "rod = { length = 0o17, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "0o17"),
    case("length_binary", "rod = { length = 0b11, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "0b11"),
    case("length_over_zero", "rod = { length = \"1/0\", wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "\"1/0\""),
    case("length_huge", "rod = { length = 1e301, wave_speed = 1 }\n", Kind::NotANumber, (1, 18), "1e301"),
    case("length_large", "rod = { length = 1e41, wave_speed = 1 }\n", Kind::OutOfRange, (1, 18), "1e41"),
    case("length_zero", "rod = { length = 0.0, wave_speed = 1 }\n", Kind::OutOfRange, (1, 18), "0.0"),
    case("wave_speed_negative", "rod = { length = 1, wave_speed = -3 }\n", Kind::OutOfRange, (1, 34), "-3"),
    case(
        "wave_speed_and_modulus",
        "[rod]\nlength = 1\nmodulus = 1\nwave_speed = 1\n",
        Kind::Contradiction,
        (3, 1),
        "modulus",
    ),
    case("wave_speed_and_area", "[rod]\nlength = 1\nwave_speed = 1\narea = 1\n", Kind::Contradiction, (4, 1), "area"),
    case(
        "round_trip",
        "rod = { length = 1e30, wave_speed = 1e-30 }\nimpact = { speed = 1 }\n",
        Kind::Combination,
        (1, 18),
        "1e30",
    ),
    case(
        "damping_negative",
        "rod = { length = 1, wave_speed = 1, damping = -0.1 }\n",
        Kind::OutOfRange,
        (1, 47),
        "-0.1",
    ),
    case("damping_huge", "rod = { length = 1, wave_speed = 1, damping = 1e6 }\n", Kind::Combination, (1, 47), "1e6"),
    case("top", "rod = { length = 1, wave_speed = 1, top = \"clamped\" }\n", Kind::OutOfRange, (1, 43), "\"clamped\""),
    case("top_true", "rod = { length = 1, wave_speed = 1, top = true }\n", Kind::WrongType, (1, 43), "true"),
    case(
        "gravity_negative",
        "rod = { length = 1, wave_speed = 1 }\ngravity.acceleration = -9.81\n",
        Kind::OutOfRange,
        (2, 24),
        "-9.81",
    ),
    case(
        "gravity_round_trip",
        "rod = { length = 1e20, wave_speed = 1 }\ngravity.acceleration = 1e30\n",
        Kind::Combination,
        (2, 24),
        "1e30",
    ),
    case("speed_zero", "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 0\n", Kind::OutOfRange, (2, 16), "0"),
    case(
        "speed_negative",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = \"-1/3\"\n",
        Kind::OutOfRange,
        (2, 16),
        "\"-1/3\"",
    ),
    case(
        "speed_and_drop_height",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, drop_height = 2 }\n",
        Kind::Contradiction,
        (2, 23),
        "drop_height",
    ),
    case(
        "drop_height_without_gravity",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { drop_height = 2 }\ngravity.acceleration = 0\n",
        Kind::Missing,
        (2, 12),
        "drop_height",
    ),
    case(
        "speed_ratio",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1e13 }\ngravity.acceleration = 1\n",
        Kind::Combination,
        (2, 20),
        "1e13",
    ),
    case(
        "impact_and_start",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1 }\n[start]\nvelocity = [[0, 0], [1, 0]]\n",
        Kind::Contradiction,
        (3, 2),
        "start",
    ),
    case(
        "start_not_points",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = 3\n",
        Kind::WrongType,
        (2, 18),
        "3",
    ),
    case(
        "start_one_point",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1]]\n",
        Kind::Profile,
        (2, 18),
        "[[0, 1]]",
    ),
    case(
        "start_strain_and_displacement",
        "rod = { length = 1, wave_speed = 1 }\nstart = { strain = [[0, 1], [1, 1]], displacement = [[0, 0], [1, 1]] }\n",
        Kind::Contradiction,
        (2, 11),
        "strain",
    ),
    case(
        "start_triple",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [1, 2, 3]]\n",
        Kind::WrongType,
        (2, 27),
        "[1, 2, 3]",
    ),
    case(
        "start_first",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0.5, 1], [1, 2]]\n",
        Kind::Profile,
        (2, 20),
        "0.5",
    ),
    case(
        "start_last",
        "rod = { length = \"1/3\", wave_speed = 1 }\nstart.velocity = [[0, 1], [0.33333333333333333333333333, 2]]\n",
        Kind::Profile,
        (2, 28),
        "0.33333333333333333333333333",
    ),
    case(
        "start_beyond",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [2, 2]]\n",
        Kind::Profile,
        (2, 28),
        "2",
    ),
    case(
        "start_backwards",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [0.5, 0], [0.4, 0], [1, 2]]\n",
        Kind::Profile,
        (2, 38),
        "0.4",
    ),
    case(
        "start_displacement_jump",
        "rod = { length = 1, wave_speed = 1 }\nstart.displacement = [[0, 1], [0.5, 0], [\"1/2\", 1], [1, 2]]\n",
        Kind::Profile,
        (2, 42),
        "\"1/2\"",
    ),
    case(
        "start_two_jumps",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [0.5, 0], [0.5, 1], [0.5, 2], [1, 2]]\n",
        Kind::Profile,
        (2, 48),
        "0.5",
    ),
    case(
        "start_jump_at_end",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [0, 0], [1, 2]]\n",
        Kind::Profile,
        (2, 28),
        "0",
    ),
    case(
        "start_too_close",
        "rod = { length = 1, wave_speed = 1 }\nstart.velocity = [[0, 1], [1e-13, 0], [1, 2]]\n",
        Kind::Profile,
        (2, 28),
        "1e-13",
    ),
    case(
        "start_below_ground",
        "rod = { length = 1, wave_speed = 1 }\nstart.displacement = [[0, -0.5], [1, 0]]\n",
        Kind::OutOfRange,
        (2, 27),
        "-0.5",
    ),
    case(
        "start_negative_x",
        "rod = { length = 1, wave_speed = 1 }\nstart.displacement = [[-1, 0.5], [1, 0]]\n",
        Kind::OutOfRange,
        (2, 24),
        "-1",
    ),
    case(
        "start_huge",
        "rod = { length = 1, wave_speed = 1 }\nstart.displacement = [[0, 1e50], [1, 0]]\n",
        Kind::OutOfRange,
        (2, 27),
        "1e50",
    ),
    case("gap_without_speed", "rod = { length = 1, wave_speed = 1 }\nimpact.gap = 1\n", Kind::Missing, (2, 8), "gap"),
    case(
        "gap_and_drop_height",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { gap = 1, drop_height = 2 }\ngravity.acceleration = 1\n",
        Kind::Contradiction,
        (2, 12),
        "gap",
    ),
    case(
        "gap_negative",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = -1 }\n",
        Kind::OutOfRange,
        (2, 29),
        "-1",
    ),
    case(
        "gap_at_rest",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 0, gap = 1 }\n",
        Kind::OutOfRange,
        (2, 20),
        "0",
    ),
    case(
        "gap_far",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, gap = 1e7 }\n",
        Kind::Combination,
        (2, 29),
        "1e7",
    ),
    case(
        "gap_word",
        "rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 1, clearance = 1 }\n",
        Kind::UnknownKey,
        (2, 23),
        "clearance",
    ),
    case(
        "units_unknown",
        "units = \"mm\"\nrod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\n",
        Kind::OutOfRange,
        (1, 9),
        "\"mm\"",
    ),
    case(
        "target_no_table",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\ntarget = 3\n",
        Kind::WrongType,
        (3, 10),
        "3",
    ),
    case("target_unknown_key", target!("quantity = 'release'\nvalue = 2\n"), Kind::UnknownKey, (5, 1), "value"),
    case("target_quantity", target!("quantity = 'u_tip'\n"), Kind::OutOfRange, (4, 12), "'u_tip'"),
    case("target_without_quantity", target!("published = 1\n"), Kind::Missing, (3, 1), "[[target]]"),
    case(
        "target_without_time",
        target!("quantity = 'u_end'\npublished = 1\nsource = 'here'\n"),
        Kind::Missing,
        (3, 1),
        "[[target]]",
    ),
    case("target_time_of_a_contact", target!("quantity = 'release'\ntime = 1\n"), Kind::Contradiction, (5, 1), "time"),
    case("target_contact_zero", target!("quantity = 'release'\ncontact = 0\n"), Kind::WrongType, (5, 11), "0"),
    case(
        "target_origin",
        target!("quantity = 'v_end'\ntime = 1\norigin = 'start'\n"),
        Kind::Contradiction,
        (6, 1),
        "origin",
    ),
    case("target_without_material", target!("quantity = 'peak_force'\n"), Kind::Missing, (3, 1), "[[target]]"),
    case(
        "target_without_published",
        target!("quantity = 'release'\nsource = 'here'\n"),
        Kind::Missing,
        (3, 1),
        "[[target]]",
    ),
    case(
        "target_without_source",
        target!("quantity = 'release'\npublished = 2\n"),
        Kind::Missing,
        (3, 1),
        "[[target]]",
    ),
    case(
        "target_number",
        target!("quantity = 'release'\npublished = 'two'\nsource = 'here'\n"),
        Kind::NotANumber,
        (5, 13),
        "'two'",
    ),
    case(
        "time_and_impacts",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun = { time = 3, impacts = 2 }\n",
        Kind::Contradiction,
        (3, 19),
        "impacts",
    ),
    case(
        "time_zero",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.time = 0\n",
        Kind::OutOfRange,
        (3, 12),
        "0",
    ),
    case(
        "time_long",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.time = 1e13\n",
        Kind::Combination,
        (3, 12),
        "1e13",
    ),
    case(
        "impacts_zero",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.impacts = 0\n",
        Kind::OutOfRange,
        (3, 15),
        "0",
    ),
    case(
        "impacts_many",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.impacts = 10_000_001\n",
        Kind::OutOfRange,
        (3, 15),
        "10_000_001",
    ),
    case(
        "impacts_half",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.impacts = 1.5\n",
        Kind::WrongType,
        (3, 15),
        "1.5",
    ),
    case(
        "accuracy_zero",
        "rod = { length = 1, wave_speed = 1 }\nimpact.speed = 1\nrun.accuracy = 0\n",
        Kind::OutOfRange,
        (3, 16),
        "0",
    ),
    case(
        "column_counts_characters",
        "title = \"µ₀\"\nrod = { length = 1, \"µ\" = 1 }\n",
        Kind::UnknownKey,
        (2, 21),
        "\"µ\"",
    ),
    case("meant_modulus", "rod = { length = 1, youngs_modulus = 1 }\n", Kind::UnknownKey, (1, 21), "youngs_modulus"),
    case("meant_modulus_symbol", "rod = { length = 1, E = 1 }\n", Kind::UnknownKey, (1, 21), "E"),
    case("meant_damping_symbol", "rod = { length = 1, wave_speed = 1, r = 1 }\n", Kind::UnknownKey, (1, 37), "r"),
    case("meant_top", "rod = { length = 1, wave_speed = 1, clamped = true }\n", Kind::UnknownKey, (1, 37), "clamped"),
    case("meant_drop_height", "rod = {}\nimpact.height = 2\n", Kind::UnknownKey, (2, 8), "height"),
    case("meant_acceleration", "rod = {}\ngravity.g = 9.81\n", Kind::UnknownKey, (2, 9), "g"),
    case("meant_another_table", "rod = { speed = 3 }\n", Kind::UnknownKey, (1, 9), "speed"),
    case("material_damping", "rod = { rayleigh_beta = 1e-5 }\n", Kind::UnknownKey, (1, 9), "rayleigh_beta"),
    case("material_damping_elsewhere", "rod = {}\nkelvin-voigt = 1\n", Kind::UnknownKey, (2, 1), "kelvin-voigt"),
    case("meant_no_table", "length = 1\n", Kind::UnknownKey, (1, 1), "length"),
    case("meant_a_table", "beam = { length = 1 }\n", Kind::UnknownKey, (1, 1), "beam"),
    case("meant_fixed", "rod = { length = 1, top = \"Fixed end\" }\n", Kind::OutOfRange, (1, 27), "\"Fixed end\""),
    case("meant_no_top", "rod = { length = 1, top = \"glued\" }\n", Kind::OutOfRange, (1, 27), "\"glued\""),
    case("unit", "[rod]\nlength = 1 m\n", Kind::Syntax, (2, 10), "1 m"),
    case("unit_without_space", "rod = { length = 1.5m, wave_speed = 1 }\n", Kind::Syntax, (1, 18), "1.5m"),
    case("unit_in_text", "rod = { length = \"1 m\" }\n", Kind::NotANumber, (1, 18), "\"1 m\""),
    case("fraction_without_quotes", "[rod]\nlength = 1/3 # L\n", Kind::Syntax, (2, 10), "1/3"),
];

#[test]
fn every_mistake_is_answered_with_its_place() {
    let mut messages = String::new();
    for Case { name, scene, kind, at, offending } in CASES {
        let error = Scene::parse(scene).expect_err(name);
        assert_eq!(error.kind, *kind, "{name}: {error}");
        assert_eq!((error.line, error.column), *at, "{name}: {error}");
        assert_eq!(error.offending(), *offending, "{name}: {error}");
        messages.push_str(&format!("{name}\n    {error}\n"));
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../../snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("scene_error_messages", messages));
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
        let report = crate::command::run_with(&["solve", "-"], &scene).err;
        assert!(report.contains(&format!("standard input:{wrong}\n")), "{wrong}: {report}");
    }
    let report = crate::command::run_with(&["solve", "-"], "[rod]\nlength = 1\nwave_speed = 1\nimpedance = 1\n").err;
    assert!(report.contains("expected modulus, density and area; a rod with a bottom"), "{report}");
}

#[test]
fn a_report_shows_the_line() {
    let report = crate::command::run_with(&["solve", "-"], "[rod]\nlength = -1 # L\nwave_speed = 1\n").err;
    let place = "standard input:2:10";
    for text in [place, "length = -1 # L", "expected a length above zero", "found length = -1", "^^"] {
        assert_eq!(report.matches(text).count(), 1, "{text} in {report}");
    }
}
