//! The builder, and that it and a scene file end in the same checks.

use dalembert::problem::{Builder, ProblemError, ProblemErrorKind as Kind, Written};
use dalembert::{Material, Number, Problem, Run, Scene, Speed, Start, Top, Warning};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

fn n(text: &str) -> Number {
    text.parse().unwrap()
}

/// A falling rod with `L = c = g = 1` and `μ = 3`.
fn rod() -> Builder {
    Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3)
}

/// Warnings before a run and after it, each on both sides of its limit.
#[test]
fn warnings_name_what_the_theory_leaves_out() {
    let of = |builder: Builder| builder.build().unwrap().warnings();
    let steel = |modulus: f64| Problem::builder().length(1).material(modulus, 7800, 1e-4).impact_speed(1);
    assert_eq!(of(steel(210e9)), []);
    assert!(
        matches!(of(steel(210.0))[..], [Warning::StrainAboveOne { strain, body: None }] if (strain - 6.0945).abs() < 1e-4)
    );
    // Numbers without a material have no units to be wrong in.
    assert_eq!(of(rod()), []);
    // μ/c = 0.9, and g t₁/c = 0.2 more at the end of the contact.
    let weak = Problem::builder().length(1).material(1, 1, 1).impact_speed("0.9").gravity("0.1");
    assert_eq!(of(weak.clone()), []);
    let warnings = weak.build().unwrap().solve().unwrap().warnings();
    assert!(
        matches!(warnings[..], [Warning::StrainAboveOne { strain, body: None }] if (strain - 1.1).abs() < 1e-12),
        "{warnings:?}"
    );
    let pulled = Problem::builder().length(1).material(1, 1, 1).displacement([(0, 0), (1, 2)]);
    assert!(matches!(of(pulled)[..], [Warning::StrainAboveOne { strain, body: None }] if strain == 2.0));

    // μ = 3 against g/2r = 5 and 2.5, where a flight is asked for.
    assert_eq!(of(rod().damping("0.1").impacts(2)), []);
    assert_eq!(of(rod().damping("0.2")), []);
    let expected = Warning::DragDominates { speed: 3.0, terminal: Some(2.5), reach: 7.5 };
    assert_eq!(of(rod().damping("0.2").impacts(2)), std::slice::from_ref(&expected));
    assert!(expected.to_string().contains("above g/2r = 2.5, the greatest speed of a fall"), "{expected}");
    let expected = Warning::DragDominates { speed: 3.0, terminal: None, reach: 7.5 };
    assert_eq!(of(rod().gravity(0).damping("0.2").time(9)), std::slice::from_ref(&expected));
    assert!(expected.to_string().contains("stops a rod at the speed 3 within 7.5"), "{expected}");
}

#[test]
fn a_number_is_given_as_integer_text_number_or_double() {
    let length = |value: Written| rod().gravity(0).length(value).build().map(|problem| problem.length().clone());
    for (value, text) in [
        (Written::from(2), "2"),
        (Written::from(2_u32), "2"),
        (Written::from(2_usize), "2"),
        (Written::from("1/3"), "1/3"),
        (Written::from(" 0.10 "), "0.10"),
        (Written::from(n("2.5/7")), "2.5/7"),
        (Written::from(&n("1e3")), "1e3"),
        (Written::from(0.1), "0.1"),
        (Written::from(2.0), "2"),
        (Written::from(1e30), "1e30"),
        (Written::from(2.5e-7), "2.5e-7"),
    ] {
        assert_eq!(length(value), Ok(n(text)), "{text}");
    }
    {
        assert_eq!(length(rug::Rational::from((2, 6)).into()), Ok(n("1/3")));
        assert_eq!(length(rug::Integer::from(7).into()), Ok(n("7")));
    }
    assert_eq!(rod().damping(-0.0).build().unwrap().damping(), None);
}

#[test]
fn every_setter_sets_its_value() {
    let problem = Problem::builder().length(1).material(2, 3, 4).damping(5).gravity(6).drop_height(7).time(8);
    let problem = problem.fixed_top().build().unwrap();
    let material = Material::Elastic { modulus: n("2"), density: n("3"), area: Some(n("4")) };
    assert_eq!((problem.material(), problem.top()), (&material, Top::Fixed));
    assert_eq!((problem.damping(), problem.gravity()), (Some(&n("5")), Some(&n("6"))));
    assert_eq!((problem.start(), problem.run()), (&Start::Uniform(Speed::DropHeight(n("7"))), &Run::Time(n("8"))));

    let problem =
        Problem::builder().length(1).wave_speed(2).displacement([(0, 3), (1, 4)]).velocity([(0, 0.5), (1, 0.0)]);
    let problem = problem.impacts(9).build().unwrap();
    let Start::Profile(profile) = problem.start() else { panic!("a profile") };
    assert_eq!(profile.displacement, [(n("0"), n("3")), (n("1"), n("4"))]);
    assert_eq!(profile.velocity, [(n("0"), n("0.5")), (n("1"), n("0"))]);
    assert_eq!((problem.material(), problem.run()), (&Material::WaveSpeed(n("2")), &Run::Impacts(9)));
    assert_eq!((problem.damping(), problem.gravity()), (None, None));
}

/// What is set anew replaces what it excludes, and nothing else.
#[test]
fn a_problem_goes_back_to_a_builder() {
    let build = |builder: Builder| builder.build().unwrap();
    let dropped = build(Problem::builder().length(1).material(2, 3, 4).gravity(6).drop_height(7).time(8).fixed_top());
    assert_eq!(*build(dropped.to_builder().wave_speed(2)).material(), Material::WaveSpeed(n("2")));
    assert_eq!(*build(dropped.to_builder().impact_speed(2)).start(), Start::Uniform(Speed::Given(n("2"))));
    assert_eq!(*build(dropped.to_builder().impacts(2)).run(), Run::Impacts(2));
    assert_eq!(build(dropped.to_builder().top(Top::Free)).top(), Top::Free);
    let moving = build(dropped.to_builder().velocity([(0, 1), (1, 2)]));
    let Start::Profile(profile) = moving.start() else { panic!("a profile") };
    assert_eq!((profile.displacement.len(), profile.velocity.len()), (0, 2));
    let strained = build(moving.to_builder().displacement([(0, 1), (1, 2)]));
    let Start::Profile(profile) = strained.start() else { panic!("a profile") };
    assert_eq!((profile.displacement.len(), profile.velocity.len()), (2, 2));
    assert_eq!(build(strained.to_builder().drop_height(7)), dropped);
    // A new length stretches the points of a profile, unless new ones are given.
    let stretched = strained.to_builder().length(2).build().unwrap();
    let ends = |points: &[(Number, Number)]| points.iter().map(|(x, v)| (x.to_f64(), v.to_f64())).collect::<Vec<_>>();
    let Start::Profile(profile) = stretched.start() else { panic!("{stretched:?}") };
    assert_eq!(
        (ends(&profile.displacement), ends(&profile.velocity)),
        (vec![(0.0, 1.0), (2.0, 2.0)], vec![(0.0, 1.0), (2.0, 2.0)])
    );
    let given = strained.to_builder().length(2).velocity([(0, 1), (1, 2)]);
    assert_eq!(given.build().unwrap_err().kind, Kind::Profile);
    assert_eq!(dropped.to_builder().gravity(0).build().unwrap_err().path, "impact.drop_height");
    assert_eq!(
        dropped.with_run(Run::Time(n("-1"))).unwrap_err().to_string(),
        "found time = -1, expected a time above zero"
    );
}

/// E = 4, ρ = 1, so c = 2: the impulse of the first contact is 2ρSLμ, the force at first −ESμ/c, the energy ρSLμ²/2.
/// Without an area S is 1.
#[test]
fn a_material_without_an_area_has_forces_per_area() {
    use dalembert::quantity::UnitSystem;
    use dalembert::{Quantity, Side, Units};
    let rod = Problem::builder().length(2).modulus(4).density(1).impact_speed(3);
    for (rod, area, units) in
        [(rod.clone(), 1.0, ["Pa", "N/m²", "N s/m²", "J/m²"]), (rod.area(5), 5.0, ["Pa", "N", "N s", "J"])]
    {
        let rod = rod.build().unwrap();
        let columns = [Quantity::Stress, Quantity::Force, Quantity::Impulse, Quantity::Energy];
        let found = rod.doubles().unwrap().columns(&columns, &[2.0], Some(Side::Left)).unwrap();
        assert_eq!(found, [[-6.0], [6.0 * area], [12.0 * area], [9.0 * area]]);
        assert_eq!(columns.map(|column| column.unit(&Units::new(&rod, UnitSystem::Si))), units);
        assert_eq!(rod.to_builder().build().unwrap(), rod);
    }
}

#[test]
fn every_mistake_is_answered_with_its_value() {
    let number = "expected a number such as 3, 0.1, 1e-9 or \"1/3\"";
    let cases: [(Builder, Kind, &str, String); 25] = [
        (Problem::builder(), Kind::Missing, "rod", "found no length, expected a length above zero".into()),
        (
            Problem::builder().length(1),
            Kind::Missing,
            "rod",
            "found no wave speed, expected wave_speed, or a material: modulus and density".into(),
        ),
        (
            Problem::builder().length(1).wave_speed(1),
            Kind::Missing,
            "",
            "found no start, expected impact_speed, drop_height, displacement, strain or velocity".into(),
        ),
        (
            Problem::builder().length(1).wave_speed(1).drop_height(1),
            Kind::Missing,
            "impact.drop_height",
            "found drop_height without gravity, expected a gravity above zero, or impact_speed in place of \
            drop_height".into(),
        ),
        (
            rod().length("1 m"),
            Kind::NotANumber,
            "rod.length",
            format!("found length = \"1 m\", {number}, without a unit"),
        ),
        (
            rod().gravity("heavy"),
            Kind::NotANumber,
            "gravity.acceleration",
            format!("found gravity = \"heavy\", {number}, decimal and finite"),
        ),
        (
            rod().impact_speed(f64::NAN),
            Kind::NotANumber,
            "impact.speed",
            format!("found impact_speed = NaN, {number}, decimal and finite"),
        ),
        (
            rod().damping("1/0"),
            Kind::NotANumber,
            "rod.damping",
            "found damping = \"1/0\", expected a fraction whose denominator is not zero".into(),
        ),
        (
            rod().time(1e-310),
            Kind::NotANumber,
            "run.time",
            "found time = 1e-310, expected zero or a magnitude between 1e-300 and 1e300".into(),
        ),
        (rod().length(-1), Kind::OutOfRange, "rod.length", "found length = -1, expected a length above zero".into()),
        (
            Problem::builder().length(1).material(1, 0, 1),
            Kind::OutOfRange,
            "rod.density",
            "found density = 0, expected a density above zero".into(),
        ),
        (
            rod().damping(-0.5),
            Kind::OutOfRange,
            "rod.damping",
            "found damping = -0.5, expected a damping of zero or more".into(),
        ),
        (
            rod().gravity(1e41),
            Kind::OutOfRange,
            "gravity.acceleration",
            "found gravity = 1e41, expected zero or an acceleration between 1e-40 and 1e40".into(),
        ),
        (
            rod().impacts(0),
            Kind::OutOfRange,
            "run.impacts",
            "found impacts = 0, expected a whole number from 1 to 10000000".into(),
        ),
        (
            rod().material(1, 1, 1),
            Kind::Contradiction,
            "rod.modulus",
            "found modulus as well as wave_speed, expected either wave_speed, or a material: modulus and \
             density"
                .into(),
        ),
        (
            rod().drop_height(1),
            Kind::Contradiction,
            "impact.drop_height",
            "found drop_height as well as impact_speed, expected either impact_speed or drop_height".into(),
        ),
        (
            rod().velocity([(0, 1), (1, 1)]),
            Kind::Contradiction,
            "start",
            "found a displacement, strain or velocity as well as an impact, expected either impact_speed or drop_height, \
             for a uniform start, or displacement or strain, and velocity"
                .into(),
        ),
        (
            rod().time(1).impacts(1),
            Kind::Contradiction,
            "run.impacts",
            "found impacts as well as time, expected either time or impacts".into(),
        ),
        (
            rod().damping(1e6),
            Kind::Combination,
            "rod.damping",
            "found damping = 1000000, which makes r t₁ = 2e6, expected zero or a value between 1e-305 and 1e6".into(),
        ),
        (
            rod().impact_speed(1e13),
            Kind::Combination,
            "impact.speed",
            "found impact_speed = 10000000000000, which makes μ/(g t₁) = 5e12, expected a value between 1e-12 and \
            1e12".into(),
        ),
        (
            rod().time("1e13"),
            Kind::Combination,
            "run.time",
            "found time = \"1e13\", which is 5e12 round trips, expected at most 1e12 round trips of 2L/c".into(),
        ),
        (
            Problem::builder().length(1).wave_speed(1).velocity([(0, "1"), (1, "fast")]),
            Kind::NotANumber,
            "start.velocity[1].v",
            format!("found velocity = \"fast\", {number}, decimal and finite"),
        ),
        (
            Problem::builder().length(1).wave_speed(1).velocity([(0, 1), (2, 1)]),
            Kind::Profile,
            "start.velocity[1].x",
            "found the point x = 2 of the velocity, expected a point within the length 1".into(),
        ),
        (
            Problem::builder().length(1).wave_speed(1).velocity([(0, 1)]),
            Kind::Profile,
            "start.velocity",
            "found 1 points of the velocity, expected 2 to 100000 points [x, value] from x = 0 to x = length, such as \
             [[0, 0], [1, -1]]"
                .into(),
        ),
        (
            Problem::builder().length(1).wave_speed(1).displacement([(0, -1), (1, 1)]),
            Kind::OutOfRange,
            "start.displacement[0].v",
            "found the displacement -1 at x = 0, expected zero or more: the ground is at zero".into(),
        ),
    ];
    for (builder, kind, path, message) in cases {
        let error = builder.build().unwrap_err();
        assert_eq!((error.kind, error.path.as_str(), error.to_string()), (kind, path, message));
    }
}

#[test]
fn a_unit_is_recognised_and_other_words_are_not() {
    let message = |text: &str| rod().length(text).build().unwrap_err().expected;
    for text in ["1 m", "1m", "0.5 kg/m3", "1/3 s", "1e2 m", "5 %", "210 GPa", "10 µm"] {
        assert!(message(text).ends_with("without a unit"), "{text}");
    }
    for text in ["", "one", "0x10", "0b11", "1e", "1e-", "1.2.3", "1e9999999", "nan", "-", "3,5", "µ"] {
        assert!(message(text).ends_with("decimal and finite"), "{text}");
    }
}

#[test]
fn a_problem_is_written_in_the_texts_of_its_numbers() {
    let problem = rod().length("1/3").damping(0.1).build().unwrap();
    let expected = serde_json::json!({
        "rod": { "length": "1/3", "wave_speed": "1", "damping": "0.1" },
        "impact": { "speed": "3" },
        "gravity": { "acceleration": "1" },
        "run": { "impacts": 1 },
    });
    assert_eq!(serde_json::to_value(&problem).unwrap(), expected);
    assert_eq!(serde_json::from_value::<Problem>(expected).unwrap(), problem);
}

/// `R = r t₁` and `M = μ/(g t₁)`, by hand.
#[test]
fn dimensionless_numbers() {
    let ratios = |builder: Builder| {
        let numbers = builder.build().unwrap().dimensionless();
        (numbers.damping_ratio, numbers.speed_ratio)
    };
    // t₁ = 2·1/1 = 2: M = 3/(1·2), R = 2r.
    assert_eq!(ratios(rod()), (0.0, Some(1.5)));
    assert_eq!(ratios(rod().damping("1/4")), (0.5, Some(1.5)));
    assert_eq!(ratios(rod().gravity(0)), (0.0, Some(f64::INFINITY)));
    // c = √(16/4) = 2, t₁ = 1, μ = √(2·2·1) = 2, M = 2/(2·1).
    let steel = Problem::builder().length(1).material(16, 4, 1).gravity(2).drop_height(1);
    assert_eq!(ratios(steel), (0.0, Some(1.0)));
    assert_eq!(ratios(Problem::builder().length(1).wave_speed(1).velocity([(0, 1), (1, 2)])), (0.0, None));
}

/// A number as a scene file and as a call of the builder.
#[derive(Clone, Debug)]
enum Value {
    Integer(i64),
    Double(f64),
    Text(&'static str),
}

impl Value {
    fn toml(&self) -> String {
        match self {
            Value::Integer(n) => n.to_string(),
            Value::Double(x) if (1e-5..1e16).contains(&x.abs()) => x.to_string(),
            Value::Double(x) => format!("{x:e}"),
            Value::Text(text) => format!("\"{text}\""),
        }
    }

    fn written(&self) -> Written {
        match self {
            Value::Integer(n) => (*n).into(),
            Value::Double(x) => (*x).into(),
            Value::Text(text) => (*text).into(),
        }
    }
}

/// Values by setter, with their key in a scene file, not all of them possible, not all of them together.
#[derive(Clone, Debug)]
struct Draft {
    numbers: Vec<(Setter, Value)>,
    fixed: bool,
    profiles: Vec<(&'static str, Vec<(Value, Value)>)>,
    impacts: Option<u32>,
}

/// Setter, table and key.
type Setter = (&'static str, &'static str, &'static str);

const LENGTH: Setter = ("length", "rod", "length");
const WAVE_SPEED: Setter = ("wave_speed", "rod", "wave_speed");
const ELASTIC: [Setter; 3] = [("modulus", "rod", "modulus"), ("density", "rod", "density"), ("area", "rod", "area")];
const DAMPING: Setter = ("damping", "rod", "damping");
const GRAVITY: Setter = ("gravity", "gravity", "acceleration");
const SPEED: Setter = ("impact_speed", "impact", "speed");
const GAP: Setter = ("gap", "impact", "gap");
const DROP_HEIGHT: Setter = ("drop_height", "impact", "drop_height");
const TIME: Setter = ("time", "run", "time");

impl Draft {
    fn toml(&self) -> String {
        let mut tables: Vec<(&str, Vec<String>)> = vec![("rod", Vec::new())];
        let mut add = |table, line: String| match tables.iter_mut().find(|(name, _)| *name == table) {
            Some((_, lines)) => lines.push(line),
            None => tables.push((table, vec![line])),
        };
        for ((_, table, key), value) in &self.numbers {
            add(table, format!("{key} = {}", value.toml()));
        }
        if self.fixed {
            add("rod", "top = \"fixed\"".into());
        }
        for (key, points) in &self.profiles {
            let points: Vec<String> = points.iter().map(|(x, v)| format!("[{}, {}]", x.toml(), v.toml())).collect();
            add("start", format!("{key} = [{}]", points.join(", ")));
        }
        if let Some(impacts) = self.impacts {
            add("run", format!("impacts = {impacts}"));
        }
        tables.iter().map(|(name, lines)| format!("[{name}]\n{}\n", lines.join("\n"))).collect()
    }

    fn builder(&self) -> Builder {
        let number = |setter| self.numbers.iter().find(|(set, _)| *set == setter).map(|(_, value)| value.written());
        let mut builder = Problem::builder();
        if let [Some(modulus), Some(density), Some(area)] = ELASTIC.map(number) {
            builder = builder.material(modulus, density, area);
        }
        for ((setter, ..), value) in &self.numbers {
            let value = value.written();
            builder = match *setter {
                "length" => builder.length(value),
                "wave_speed" => builder.wave_speed(value),
                "damping" => builder.damping(value),
                "gravity" => builder.gravity(value),
                "impact_speed" => builder.impact_speed(value),
                "gap" => builder.gap(value),
                "drop_height" => builder.drop_height(value),
                "time" => builder.time(value),
                _ => builder,
            };
        }
        if self.fixed {
            builder = builder.fixed_top();
        }
        for (key, points) in &self.profiles {
            let points = points.iter().map(|(x, v)| (x.written(), v.written()));
            builder = if *key == "velocity" { builder.velocity(points) } else { builder.displacement(points) };
        }
        self.impacts.into_iter().fold(builder, Builder::impacts)
    }
}

/// The words in which the two doors differ, the builder's first.
const WORDS: [(&str, &str); 7] = [
    ("impact_speed, drop_height, displacement, strain or velocity", "[impact] with speed or drop_height, or [start]"),
    (
        "either impact_speed or drop_height, for a uniform start, or displacement or strain, and velocity",
        "either [impact], for a uniform start, or [start]",
    ),
    ("a displacement, strain or velocity as well as an impact", "start as well as [impact]"),
    ("a gravity above zero", "[gravity] with an acceleration above zero"),
    ("found no start", "found neither [impact] nor [start]"),
    ("found gravity = ", "found acceleration = "),
    ("impact_speed", "speed"),
];

/// What the builder makes of a draft, after a scene file of the same values has been found to end in the same way.
fn through_both_doors(draft: &Draft) -> Result<Problem, ProblemError> {
    let toml = draft.toml();
    let built = draft.builder().build();
    match (Scene::parse(&toml), &built) {
        (Ok(scene), Ok(problem)) => assert_eq!(scene.problem, *problem, "{toml}"),
        (Err(scene), Err(error)) => {
            let place = if error.path == "rod" { " in [rod], expected" } else { ", expected" };
            let message = error.to_string().replace(", expected", place);
            let message = WORDS.iter().fold(message, |text, (builder, scene)| text.replace(builder, scene));
            assert_eq!(format!("found {}, expected {}", scene.found, scene.expected), message, "{toml}");
            assert_eq!(scene.kind, error.kind, "{toml}");
        }
        (scene, built) => panic!("{toml}\n{scene:?}\n{built:?}"),
    }
    built
}

fn value() -> impl Strategy<Value = Value> {
    let wrong = [
        Value::Integer(0),
        Value::Integer(-2),
        Value::Text("one"),
        Value::Text("1 m"),
        Value::Text("1/0"),
        Value::Text("-1/3"),
        Value::Double(1e41),
        Value::Double(-1e-41),
        Value::Double(1e-300),
    ];
    prop_oneof![
        24 => (1_i64..10).prop_map(Value::Integer),
        24 => (0.01_f64..10.0).prop_map(Value::Double),
        16 => proptest::sample::select(vec!["1/3", "0.1", "2.50", "7e-2", "1_0", "2/6"]).prop_map(Value::Text),
        1 => proptest::sample::select(wrong.to_vec()),
        1 => proptest::sample::select(vec![1e-30, 1e-13, 1e14, 1e30]).prop_map(Value::Double),
    ]
}

/// Points that more often than not run along a rod of length 1.
fn points() -> impl Strategy<Value = Vec<(Value, Value)>> {
    let inner = ["1/8", "1/4", "0.25", "1/3", "0.5", "1/2", "5/8", "0.75", "7/8", "0.2500000000001", "-1", "2"];
    let inner = proptest::collection::vec((proptest::sample::select(inner.to_vec()), value()), 0..3);
    let first = proptest::sample::select(vec!["0", "0", "0", "0", "0", "0", "0.0", "1/4"]);
    let last = proptest::sample::select(vec!["1", "1", "1", "1", "1", "1", "3/3", "0.9"]);
    (first, value(), inner, last, value(), any::<bool>()).prop_map(|(first, v, mut inner, last, w, sorted)| {
        if sorted {
            inner.sort_by(|(a, _), (b, _)| n(a).compare(&n(b)));
        }
        let inner = inner.into_iter().map(|(x, v)| (Value::Text(x), v));
        [(Value::Text(first), v)].into_iter().chain(inner).chain([(Value::Text(last), w)]).collect()
    })
}

/// A value in so many cases of a hundred.
fn percent<T: Clone + std::fmt::Debug>(
    often: u32,
    value: impl Strategy<Value = T>,
) -> impl Strategy<Value = Option<T>> {
    (0_u32..100, value).prop_map(move |(chance, value)| (chance < often).then_some(value))
}

fn draft() -> impl Strategy<Value = Draft> {
    let set = |setter: Setter, often| percent(often, value().prop_map(move |value| (setter, value)));
    let chances = |chances: &[(u32, u32, u32)]| proptest::sample::select(chances.to_vec());
    let length = prop_oneof![Just(Some((LENGTH, Value::Integer(1)))), set(LENGTH, 97)];
    // Wave speed or elastic, impact speed or drop height or profiles, time or impacts: mostly one of them.
    let material =
        chances(&[(100, 0, 0), (100, 0, 0), (100, 0, 0), (0, 100, 0), (0, 100, 0), (90, 90, 0), (30, 30, 0)])
            .prop_flat_map(move |(c, elastic, _)| (set(WAVE_SPEED, c), percent(elastic, [value(), value(), value()])));
    let start = chances(&[
        (100, 0, 0),
        (100, 0, 0),
        (0, 100, 0),
        (0, 100, 0),
        (0, 0, 80),
        (0, 0, 80),
        (0, 0, 80),
        (50, 50, 30),
    ])
    .prop_flat_map(move |(speed, drop, profile)| {
        let profile = || percent(profile, points());
        (set(SPEED, speed), set(GAP, speed / 3), set(DROP_HEIGHT, drop), profile(), profile())
    });
    let run = chances(&[(0, 50, 0), (0, 50, 0), (100, 0, 0), (100, 0, 0), (50, 50, 0)])
        .prop_flat_map(move |(time, impacts, _)| (set(TIME, time), percent(impacts, 0_u32..40)));
    let rest = (set(DAMPING, 50), set(GRAVITY, 80), any::<bool>());
    (length, material, rest, start, run).prop_map(
        |(length, (c, elastic), (r, g, fixed), (mu, gap, h, u, v), (t, impacts))| {
            let elastic = elastic.into_iter().flat_map(|values| ELASTIC.into_iter().zip(values));
            let numbers = [length, c, r, g, mu, gap, h, t].into_iter().flatten().chain(elastic).collect();
            let profiles = [("displacement", u), ("velocity", v)];
            let profiles = profiles.into_iter().filter_map(|(key, points)| Some((key, points?))).collect();
            Draft { numbers, fixed, profiles, impacts }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2048) })]

    #[test]
    fn a_scene_and_the_builder_end_in_the_same_problem_or_error(draft in draft()) {
        if let Ok(problem) = through_both_doors(&draft) {
            prop_assert_eq!(problem.to_builder().build(), Ok(problem));
        }
    }
}

/// The random drafts hold enough of everything: a third is possible, and each kind of mistake is made.
#[test]
fn random_drafts_are_right_and_wrong_in_every_way() {
    let mut runner = TestRunner::deterministic();
    let drafts = (0..2000).map(|_| draft().new_tree(&mut runner).unwrap().current());
    let answers: Vec<Result<Problem, ProblemError>> = drafts.map(|draft| through_both_doors(&draft)).collect();
    let profiles = answers.iter().flatten().filter(|problem| matches!(problem.start(), Start::Profile(_))).count();
    let right = answers.iter().filter(|answer| answer.is_ok()).count();
    assert!(right > 600 && profiles > 60, "{right} possible, {profiles} of them with a profile");
    for kind in
        [Kind::Missing, Kind::NotANumber, Kind::OutOfRange, Kind::Contradiction, Kind::Profile, Kind::Combination]
    {
        let made = answers.iter().filter(|answer| answer.as_ref().is_err_and(|error| error.kind == kind)).count();
        assert!(made > 10, "{kind:?} {made} times");
    }
}
