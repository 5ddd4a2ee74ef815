//! The scenes that come with the program: known problems of the literature and the figures of the paper.

/// A scene that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// The name that it is asked for by.
    pub name: &'static str,
    /// A summary, in one line.
    pub summary: &'static str,
    /// The scene file, with comments on its origin and on what to expect.
    pub source: &'static str,
}

/// One entry of the list: the file has the name of the scene.
macro_rules! scene {
    ($name:literal, $summary:literal) => {
        Builtin { name: $name, summary: $summary, source: include_str!(concat!("builtin/", $name, ".toml")) }
    };
}

/// Every built-in scene, the undamped ones first.
pub const ALL: &[Builtin] = &[
    scene!("doyen-ern-piperno", "periodic bounces: every second contact undoes the vibration of the one before"),
    scene!("getfem-dynamic-contact", "a compressed rod under a fixed top, released at rest: period 3"),
    scene!("periodic-free-rod", "a free rod that returns to its impact every 5 L/c"),
    scene!("first-nonsmooth-mode", "a held bar before a stop: the first nonsmooth mode of the period 3.5"),
    scene!("siconos-impacting-bar", "a steel bar falls 0.05 mm on a wall: one contact of 2L/c, 1270.8 N"),
    scene!("siconos-impacting-bar-as-run", "the same with 0.99 m, which is what its reference file has"),
    scene!("ansys-vm265", "an elastic rod against a rigid wall after a gap, in inches and pounds"),
    scene!("ansys-vm85", "a long bar whose front end is suddenly stopped after a gap, in inches and pounds"),
    scene!("code-aster-sdnv100", "a beam against a rigid wall after a gap, as the decks have it"),
    scene!("ansys-copper-rod", "a copper rod against a rigid wall, whose energy others do not keep"),
    scene!("two-equal-bars", "two equal bars collide: one of them, and the mirror plane"),
    scene!("paper-weak", "Corollary 1 below the critical speed: contact outlasts the round trip"),
    scene!("paper-strong", "Corollary 1 above the critical speed: contact for one round trip"),
    scene!("figure-2", "the paper's red dot: the largest vibrational energy, at the critical speed"),
    scene!("figure-3", "one point of the paper's energy ratios: 1/12 of the energy vibrates"),
    scene!("mu-1-period-36", "a tangential landing at t = 31, and then all over again after t = 36"),
    scene!("mu-4-3", "repeated bounces at two thirds of the critical speed"),
    scene!("mu-3-2-chaotic", "repeated bounces whose breakpoints multiply"),
    scene!("figure-1-r26", "strong damping without gravity: the bounce comes in the second round trip"),
    scene!("figure-1-r29", "stronger: the bounce comes in the third round trip"),
    scene!("figure-1-r30", "stronger still: the bounce comes in the fourth round trip"),
    scene!("figure-4-r01", "light damping at a high speed, r = 0.1: the bounce comes after one round trip"),
    scene!("figure-4-r02", "the same with r = 0.2"),
    scene!("figure-4-r03", "the same with r = 0.3"),
    scene!("figure-5", "the translational part of the energy that is left at the bounce, r = 0.2"),
    scene!("figure-6", "the part of the energy that damping leaves at the bounce, r = 0.1"),
    scene!("figure-7", "the same over e^(−2 r t₁), r = 0.3"),
    scene!("solfec-bar-drop", "a fast drop: contact for one round trip, then a long flight"),
    scene!("steel-bar", "a damped steel bar hits at 1 m/s: a contact of 0.4 ms"),
];

/// Every built-in scene with several bodies, or with loads, for [`ChainScene`](crate::ChainScene).
pub const CHAINS: &[Builtin] = &[
    scene!("openfoam-7-1-1", "two equal bars exchange their velocities: contact for 2L/c"),
    scene!("openfoam-7-1-2", "two dissimilar bars: 7/170, then 21/2890, released at 27/70"),
    scene!("code-aster-sdnl111-a", "a bar against a clamped one: contact for 4L/c"),
    scene!("code-aster-sdnl111-c", "the same with sides held, after a gap"),
    scene!("schwarz-two-bars", "two equal bars meet: 100 N for 0.5 ms"),
    scene!("schwarz-unequal-bars", "a long bar against a short one"),
    scene!("schwarz-three-bars", "three bars: 50, 100, 50 N"),
    scene!("cirak-west", "two bars that touch at the start: contact for 2L/c"),
    scene!("abaqus-1-3-15", "a bar against a rigid wall after a gap"),
    scene!("hopkinson-striker", "a striker on a half-infinite bar: a force in steps"),
    scene!("mpm-py-pile", "a pile on a fixed base under a sudden load"),
    scene!("kratos-drained-column", "a soil column, sides held, under a ramped load"),
    scene!("norma-two-bars", "two short bars that touch at the start"),
    scene!("norma-three-bars", "a bar at rest between two moving ones: 50, 100, 50 N"),
    scene!("carpenter-taylor-katona", "two bars in inches and pounds, in rigid contact"),
    scene!("hopkinson-bar", "striker, input bar, specimen and output bar"),
    scene!("rose-column", "a column on a fixed base under a sudden load"),
    scene!("getfem-penalty", "a compressed rod under a fixed top, on a penalty of 20 EA/L"),
    scene!("carpenter-penalty", "two bars in inches and pounds, on their published penalty"),
    scene!("code-aster-sdnl111-a-spring", "a bar against a clamped one, on its spring and dashpot"),
    scene!("ansys-vm85-spring", "a long bar stopped by its gap element, in inches and pounds"),
    scene!("saint-venant-mass", "a mass of six rods strikes a clamped rod: released at 7.4076 L/c"),
    scene!("saint-venant-mass-1", "the same with one rod: released at 3.0677 L/c"),
    scene!("saint-venant-mass-2", "the same with two rods: released at 4.7086 L/c"),
    scene!("saint-venant-mass-4", "the same with four rods: released at 5.8996 L/c"),
    scene!("impact-enforced-velocity", "a free rod whose end moves at a given velocity"),
    scene!("kratos-absorbing-column", "a soil column on an absorbing base under a sudden load"),
    scene!("stem-absorbing-column", "the same with the numbers of STEM, whose values are not converged"),
    scene!("yoong-legrand-spring-bar", "a bar on a spring before a stop"),
];

/// The names of the built-in scenes of a single rod.
///
/// ```
/// assert!(dalembert::builtin::names().any(|name| name == "doyen-ern-piperno"));
/// ```
pub fn names() -> impl Iterator<Item = &'static str> {
    ALL.iter().map(|builtin| builtin.name)
}

/// The built-in scene of this name; `None` where there is none.
///
/// ```
/// use dalembert::{Scene, builtin};
/// let scene = Scene::parse(builtin::get("paper-strong").unwrap().source)?;
/// assert_eq!(scene.problem.length().to_f64(), 1.0);
/// # Ok::<(), dalembert::SceneError>(())
/// ```
pub fn get(name: &str) -> Option<&'static Builtin> {
    ALL.iter().chain(CHAINS).find(|builtin| builtin.name == name)
}
