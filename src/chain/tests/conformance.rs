//! Every undamped built-in scene of a single rod through the chain and through the lattice.

use std::ops::ControlFlow;

use crate::chain::{Body, BodyMaterial, Chain, ChainRun, End};
use crate::engine::{Motion, Undamped};
use crate::motion::Side;
use crate::number::{Bounded, Estimate, Number, Scalar, Wide};
use crate::problem::{Material, Problem, Speed, Start, Top};
use crate::scene::{Scene, builtin};

type Long = Estimate<Wide<4>>;

/// Returns the rod as a chain up to `until`; `None` if its start has no fraction.
fn chain(problem: &Problem, until: Number) -> Option<Chain> {
    let material = match problem.material().clone() {
        Material::WaveSpeed(wave_speed) => BodyMaterial::Impedance { impedance: wave_speed.clone(), wave_speed },
        Material::Elastic { modulus, density, area } => {
            BodyMaterial::Elastic { modulus, density, area: area.unwrap_or_else(|| 1.into()) }
        }
    };
    let body = Body::with_material(problem.length().clone(), material);
    let falling = |speed: &Number| {
        let speed: Number = format!("-{speed}").parse().ok()?;
        Some(body.clone().with_velocity(speed))
    };
    let (gap, body) = match problem.start() {
        Start::Uniform(Speed::Given(speed)) => (0.into(), falling(speed)?),
        Start::Uniform(Speed::DropHeight(_)) => return None,
        Start::Above { gap, speed } if speed.is_zero() => (gap.clone(), body),
        Start::Above { gap, speed } => (gap.clone(), falling(speed)?),
        Start::Profile(profile) => {
            let gap = profile.displacement.first().map_or_else(|| 0.into(), |(_, v)| v.clone());
            let body = body.clone().with_start(profile.velocity.clone(), profile.displacement.clone());
            (gap, body.with_strain(profile.strain.clone()))
        }
    };
    let top = if problem.top() == Top::Fixed { End::Velocity(Vec::new()) } else { End::Free };
    let gravity = problem.gravity().cloned().unwrap_or_else(|| 0.into());
    let bottom = End::Ground { gap, velocity: Vec::new() };
    Chain::builder(body).bottom(bottom).top(top).gravity(gravity).until(until).build().ok()
}

#[test]
fn single_rods_move_alike() {
    let (mut scenes, mut events) = (0, 0);
    for builtin in builtin::ALL {
        let problem = Scene::parse(builtin.source).unwrap().problem;
        if problem.damping().is_some_and(|r| !r.is_zero()) {
            continue;
        }
        let rod = Undamped::<Long>::solve(&problem, &()).unwrap();
        let until: Number = format!("{:?}", rod.end().to_f64() * (1.0 - 1e-9)).parse().unwrap();
        let Some(chain) = chain(&problem, until.clone()) else { continue };
        let run = ChainRun::<Long>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
        let end = Long::from_number(&until, &());
        let expected: Vec<_> = rod.events().iter().filter(|event| event.t.below(&end) == Ok(true)).collect();
        assert_eq!(run.events().len(), expected.len(), "{}", builtin.name);
        for (event, expected) in run.events().iter().zip(&expected) {
            assert_eq!(event.kind, expected.kind, "{}", builtin.name);
            assert!(
                event.t.same(&expected.t) && event.t.log2_error() < -80.0,
                "{} at {}",
                builtin.name,
                expected.t.text()
            );
        }
        // At places that no ray meets.
        for share in [0.2137, 0.5719, 0.9031] {
            let t = Long::spelling(&format!("{:?}", until.to_f64() * share).parse().unwrap(), &());
            let (ours, theirs) =
                (run.end_field(0, true, &t, Side::Right).unwrap(), rod.top_end(&t, Side::Right).unwrap());
            let start = match problem.start() {
                Start::Above { gap, .. } => Long::from_number(gap, &()),
                _ => t.zero(),
            };
            assert!((ours.displacement + start).same(&theirs.0), "u_top of {}", builtin.name);
            assert!(ours.velocity.same(&theirs.1), "v_top of {}", builtin.name);
        }
        scenes += 1;
        events += expected.len();
    }
    assert!(scenes >= 12 && events > 100, "{scenes} scenes, {events} events");
}
