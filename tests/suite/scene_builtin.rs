//! The built-in scenes, and what their comments say as far as it follows from their numbers.

use dalembert::{Effect, Material, Number, Parameters, Problem, Scene, Start, Top, builtin};

fn scene(name: &str) -> Scene {
    Scene::parse(builtin::get(name).expect(name).source).expect(name)
}

fn parameters(scene: &Scene) -> Parameters<f64> {
    Parameters::of(&scene.problem, &()).expect("double precision has every root")
}

/// `ρ c S μ`: the force while a rod without gravity is in contact.
fn force(scene: &Scene) -> f64 {
    let Material::Elastic { density, area, .. } = scene.problem.material() else { panic!("elastic") };
    let p = parameters(scene);
    density.to_f64() * p.wave_speed * area.as_ref().unwrap().to_f64() * p.speed
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
}

#[test]
fn every_scene_is_read_and_says_what_it_is() {
    let names: Vec<&str> = builtin::names().collect();
    assert!(names.len() >= 19);
    for (i, builtin) in builtin::ALL.iter().enumerate() {
        assert!(!names[..i].contains(&builtin.name), "{} twice", builtin.name);
        assert!(builtin.source.starts_with("# ") && !builtin.summary.is_empty(), "{}", builtin.name);
        assert!(scene(builtin.name).title.is_some(), "{}", builtin.name);
        assert!(builtin.source.lines().all(|line| line.chars().count() <= 120), "{}", builtin.name);
    }
    assert_eq!(builtin::get("no-such-scene"), None);
}

/// A scene is the same after it was written as TOML or JSON and read again, and so is its problem alone.
#[test]
fn every_scene_goes_through_serde() {
    for name in builtin::names() {
        let scene = scene(name);
        let again = Scene::parse(&toml::to_string(&scene).unwrap()).expect(name);
        let fields = |scene: &Scene| {
            (scene.title.clone(), scene.units, scene.accuracy, scene.publication.clone(), scene.targets.clone())
        };
        assert_eq!((&again.problem, fields(&again)), (&scene.problem, fields(&scene)), "{name}");
        let read: Scene = toml::from_str(&toml::to_string(&scene).unwrap()).expect(name);
        assert_eq!((&read.problem, fields(&read)), (&scene.problem, fields(&scene)), "{name}");
        let problem: Problem = serde_json::from_value(serde_json::to_value(&scene.problem).unwrap()).expect(name);
        assert_eq!(problem, scene.problem, "{name}");
    }
    let error = toml::from_str::<Problem>("rod = { length = -1, wave_speed = 1 }").unwrap_err().to_string();
    assert!(error.contains("found length = -1, expected a length above zero"), "{error}");
}

#[test]
fn doyen_ern_piperno_is_periodic() {
    let scene = scene("doyen-ern-piperno");
    let p = parameters(&scene);
    assert_eq!((p.wave_speed, p.speed, p.round_trip()), (30.0, 10.0, 2.0 / 3.0));
    // μ is a whole multiple k of gL/c, so that every time is rational and the period is 4(k + 1)L/c.
    let k = p.speed / (p.gravity * p.length / p.wave_speed);
    assert_eq!(k, 3.0);
    close(4.0 * (k + 1.0) * p.length / p.wave_speed, 16.0 / 3.0, 1e-15);
    close(p.critical_speed().powi(2) * p.length / 6.0, 2000.0 / 27.0, 1e-15);
}

#[test]
fn walls_of_the_manuals() {
    for (name, wave_speed, contact, newtons) in [
        ("siconos-impacting-bar", 5188.7, 3.8545e-4, 1270.8),
        ("siconos-impacting-bar-as-run", 5188.7, 3.8160e-4, 1270.8),
        ("ansys-vm265", 202_721.0, 9.866e-5, 29_923.0),
        ("ansys-vm85", 202_721.0, 0.098_657_7, 14_799.0),
        ("code-aster-sdnv100", 5000.0, 8e-5, 1.6e6),
    ] {
        let scene = scene(name);
        let p = parameters(&scene);
        close(p.wave_speed, wave_speed, 1e-4);
        close(p.round_trip(), contact, 1e-4);
        close(force(&scene), newtons, 1e-4);
        use Effect::{InitialGap, SiForces, UnilateralContact};
        assert_eq!(scene.called_effects(), [UnilateralContact, InitialGap, SiForces], "{name}");
    }
}

/// The clock of the manuals starts at the gap: the touch is at gap/μ, the release 2L/c later.
#[test]
fn touches_of_the_manuals() {
    for (name, touch, release) in [
        ("ansys-vm265", 4.9456e-5, 1.48114e-4),
        ("ansys-vm85", 0.0064, 0.1050577),
        ("code-aster-sdnv100", 2e-5, 1e-4),
        ("siconos-impacting-bar", 5e-4, 8.8545e-4),
    ] {
        let history = scene(name).problem.doubles().unwrap();
        let contact = &history.contacts()[0];
        close(contact.impact, touch, 1e-5);
        close(contact.release.unwrap(), release, 1e-5);
    }
}

/// A published value says with its digits, or beside them, how far it may be off; a wrong one would be noticed.
#[test]
fn published_values_can_be_missed() {
    let mut count = 0;
    for builtin in builtin::ALL {
        let scene = scene(builtin.name);
        for target in &scene.targets {
            count += 1;
            let (size, tolerance) = (target.published.value.to_f64().abs(), target.published.tolerance());
            assert!(tolerance <= 0.03 * size || (size == 0.0 && tolerance <= 1e-9), "{}: {target:?}", builtin.name);
            assert!(target.published.source.len() > 3);
        }
    }
    assert!(count >= 30, "{count}");
}

#[test]
fn getfem_starts_compressed_under_a_fixed_top() {
    let scene = scene("getfem-dynamic-contact");
    assert_eq!(scene.problem.top(), Top::Fixed);
    let Start::Profile(profile) = scene.problem.start() else { panic!("a profile") };
    let number = |text: &str| text.parse::<Number>().unwrap();
    assert_eq!(profile.displacement, [(number("0"), number("0.5")), (number("1"), number("0"))]);
    assert!(profile.velocity.is_empty());
    use Effect::{FixedTop, InitialStrain, RepeatedImpacts, UnilateralContact};
    assert_eq!(scene.called_effects(), [UnilateralContact, RepeatedImpacts, FixedTop, InitialStrain]);
    let strain = scene.effects().into_iter().find(|e| e.effect == InitialStrain).unwrap();
    assert_eq!(strain.line, scene.line_of("start.displacement"));
    assert!(scene.source().lines().nth(strain.line.unwrap() - 1).unwrap().starts_with("displacement"));
}

/// The solution that GetFEM's demonstration compares itself with, `uExact`, in three phases of length 1: fractions at
/// 5000 points of the x–t plane.
#[test]
fn getfem_is_its_own_exact_solution() {
    use rug::Rational;
    let history = scene("getfem-dynamic-contact").problem.exact().unwrap();
    let points: Vec<Rational> = (0..50).map(|k| Rational::from((k, 49))).collect();
    let times: Vec<Rational> = (0..100).map(|k| Rational::from((k, 11))).filter(|t| *t <= 9).collect();
    let field = history.field(&points, &times, dalembert::Side::Right).unwrap();
    assert_eq!(field.len(), 50 * 100);
    let places = times.iter().flat_map(|t| points.iter().map(move |x| (x, t)));
    for ((x, t), found) in places.zip(&field) {
        let (age, phase) = t.clone().fract_floor(rug::Integer::new());
        let [up, later] = [x, &age].map(|value| Rational::from(1 - value));
        let twice = match phase.mod_u(3) {
            0 => up.min(later),
            1 => -x.clone().min(age).min(up).min(later),
            _ => age.min(up),
        };
        assert_eq!(found.displacement, twice / 2, "x = {x}, t = {t}");
    }
}

/// Corollary 1: the first contact lasts `t₁` from the critical speed on, and `2t₁ − μ/g` below it.
#[test]
fn first_contacts_without_damping() {
    for (name, bounce_time) in [
        ("paper-strong", 2.0),
        ("figure-2", 2.0),
        ("figure-3", 2.0),
        ("paper-weak", 3.0),
        ("mu-1-period-36", 3.0),
        ("mu-4-3", 8.0 / 3.0),
        ("mu-3-2-chaotic", 2.5),
    ] {
        let p = parameters(&scene(name));
        let t1 = p.round_trip();
        let expected = if p.speed >= p.critical_speed() { t1 } else { 2.0 * t1 - p.speed / p.gravity };
        close(bounce_time, expected, 1e-15);
        assert_eq!(p.damping, 0.0);
    }
    // E_z/E = μ₀²/3μ².
    for (name, ratio) in [("figure-2", 1.0 / 3.0), ("figure-3", 1.0 / 12.0), ("paper-strong", 4.0 / 27.0)] {
        let p = parameters(&scene(name));
        close((p.critical_speed() / p.speed).powi(2) / 3.0, ratio, 1e-15);
    }
}

/// Theorem 1 with (2.32): with damping, the bounce comes at `t₁` exactly when `M > (I₀(R) + I₁(R))/(2 − I₀(R)) > 0`.
#[test]
fn first_contacts_with_damping() {
    for (name, at_round_trip) in [
        ("figure-1-r26", false),
        ("figure-1-r29", false),
        ("figure-1-r30", false),
        ("figure-4-r01", true),
        ("figure-4-r02", true),
        ("figure-4-r03", true),
        ("figure-5", true),
        ("figure-6", true),
        ("figure-7", true),
        ("steel-bar", true),
    ] {
        let scene = scene(name);
        let p = parameters(&scene);
        let group = p.damping * p.round_trip();
        let (i0, i1) = (pxfm::f_i0(group), pxfm::f_i1(group));
        // Without gravity the speed ratio is infinite.
        let ratio = p.speed / p.critical_speed();
        assert_eq!(i0 < 2.0 && ratio > (i0 + i1) / (2.0 - i0), at_round_trip, "{name}");
        assert!(scene.called_effects().contains(&Effect::Damping), "{name}");
    }
    close(parameters(&scene("steel-bar")).round_trip(), 4e-4, 1e-15);
}

#[test]
fn names_in_output_are_those_of_the_library() {
    for effect in Effect::ALL {
        assert_eq!(serde_json::to_value(effect).unwrap(), effect.name());
    }
}
