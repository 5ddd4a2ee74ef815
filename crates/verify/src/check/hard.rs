//! Hard cases: rods for which double precision breaks.

use super::case::*;
use super::verdict::NO_BOUNCE;
use super::verdict::Promise::{Bound, Digits, Exact};
use super::verdict::Verdict;
use crate::paper::{PrintedIntegrals, formulas};
use crate::routes::Route;
use dalembert::engine::FirstContact;
use dalembert::problem::Parameters;
use dalembert::quantity::Quantity::{
    BounceTime, Centre, Impact, Release, ShortestPiece, Strain, Top, VibrationalEnergy,
};
use dalembert::solve::Numbers;

const fn hard(
    name: &'static str,
    source: &'static str,
    about: &'static str,
    questions: &'static [CaseQuestion],
) -> Case {
    Case { name, source, about, verdict: Verdict::Holds, questions }
}

/// Builds a rod of `g = 0`, `c = t₁ = μ = 1`, as in Figure 1.
const fn late(damping: &'static str) -> Rod {
    Rod { length: "1/2", ..unit(damping, "1").weightless() }
}

const fn steel(damping: &'static str) -> Rod {
    Rod { wave_speed: "5000", gravity: "9.81", ..unit(damping, "100") }
}

/// A rod with 2400 round trips in the first flight, and ever shorter hops after it.
const STEEL_DROPPED: Rod = Rod::from_scene(
    "[rod]\nlength = 0.5\nmodulus = 210e9\ndensity = 7850\narea = 1e-4\ndamping = 50\n\
     [impact]\ndrop_height = 1\n[gravity]\nacceleration = 9.81\n[run]\nimpacts = 10\n",
);

/// A rod that touches the ground for 3e-7 of a round trip.
const TOUCHING: Rod = Rod::from_scene(
    "[rod]\nlength = 1\nwave_speed = 1\ndamping = 0.3\n\
     [start]\ndisplacement = [[0, \"0.1522081713484600025305355\"], [1, \"0.1522081713484600025305355\"]]\n\
     velocity = [[0, -1], [1, 2.5]]\n[gravity]\nacceleration = 0.5\n[run]\ntime = 1\n",
);
/// A rod that leaves the ground for 2e-7 of a round trip.
const GRAZING: Rod = Rod::from_scene(
    "[rod]\nlength = 1\nwave_speed = 1\ntop = \"fixed\"\ndamping = 4\n\
     [start]\ndisplacement = [[0, 0], [1, \"-0.3\"]]\n\
     velocity = [[0, 0], [\"0.9\", \"2.388476579223269313178295800\"], [1, 0]]\n\
     [gravity]\nacceleration = 0.1\n[run]\ntime = 0.8\n",
);
const STEEL_GRAZING: Rod = Rod::from_scene(
    "[rod]\nmodulus = 210e9\ndensity = 7850\nlength = 1\ndamping = 20\n\
     [impact]\nspeed = \"0.0065539298493806059740412997\"\n[gravity]\nacceleration = 9.81\n[run]\nimpacts = 4\n",
);

const HOPPING: Rod = Rod { length: "1.1", wave_speed: "2.3", gravity: "0.8", ..unit("0.35", "20").until("37") };

const MET: Rod = Rod { length: "3/5", wave_speed: "4/5", gravity: "5/2", ..unit("0", "3/8") };
const STRONG_RELEASE: Rod = Rod { length: "3/5", wave_speed: "1/3", gravity: "3", ..unit("0", "1593/25") };

const ON_A_RAY: Rod = Rod { length: "1/10", ..unit("15", "1").weightless().until("1") };

const BELOW_1E_12: Rod = unit("0.2", "2.59364495455919430337818987448");
const BELOW_1E_9: Rod = unit("0.2", "2.59364495356019430337818987448");
const BELOW_1E_6: Rod = unit("0.2", "2.59364395456019430337818987448");

/// Computes the release by (2.28) for g = 0, searched in steps of a thousandth of a round trip.
fn summed(damping: f64) -> f64 {
    let rod = Parameters { length: 0.5, wave_speed: 1.0, damping, gravity: 0.0, speed: 1.0 };
    PrintedIntegrals::new(&rod, 1e-10).release(1.0, 1000).unwrap_or(f64::NAN)
}

/// Computes `E − E_h` of the steel rod at t₁ as a difference of two sums.
fn energy_difference() -> f64 {
    let rod = Parameters { length: 1.0, wave_speed: 5000.0, damping: 12.0, gravity: 9.81, speed: 100.0 };
    let rod = rod.carry();
    let energy = FirstContact::new(&rod).energy(&rod.round_trip());
    energy.total.value() - energy.translational.value()
}

/// Computes `−e^{−rt} H_r(t)` of [`ON_A_RAY`] at 3t₁.
fn kernel_on_a_ray() -> f64 {
    let rod = Parameters { length: 0.1, wave_speed: 1.0, damping: 15.0, gravity: 0.0, speed: 1.0 };
    -(-9.0f64).exp() * PrintedIntegrals::new(&rod, 1e-13).impact_kernel(0.6)
}

const SUM: &str = "(2.28) summed as printed";
const REMARK: &str = "Remark 2 as printed";

const ACCURATE: PromisedRoute = (accuracy(1e-12), Digits(12));
const LATE_ROUTES: &[PromisedRoute] = &[(CLOSED, Bound(0)), (MODES, Digits(9)), ACCURATE, DIGITS, PROVED];
const LATEST: &[PromisedRoute] = &[(CLOSED, Bound(0)), (MODES, Digits(9)), ACCURATE, (closed(150), Digits(36)), PROVED];
const WEAK_ROUTES: &[PromisedRoute] = &[(CLOSED, Digits(12)), (CELLS, Digits(10)), CLOSED_50];
const STRONG_ROUTES: &[PromisedRoute] = &[(CLOSED, Bound(10)), (MODES, Bound(8)), CLOSED_50, PROVED];
const BELOW: &[PromisedRoute] =
    &[(CLOSED, Bound(9)), (CELLS, Digits(9)), (accuracy(1e-14), Digits(13)), CLOSED_50, PROVED];
const ABOVE: &[PromisedRoute] = &[(CLOSED, Exact), (CELLS, Digits(9)), (closed(50), Exact), PROVED];
const TANGENT: &[PromisedRoute] = &[(LATTICE, Bound(6)), (FRACTIONS, Bound(0)), ACCURATE, DIGITS, (CERTIFIED, Exact)];
const AFTER_TANGENT: &[PromisedRoute] = &[(LATTICE, Bound(12)), DIGITS, (CERTIFIED, Exact)];
const CHAOS: &[PromisedRoute] = &[(LATTICE, Bound(0)), (FRACTIONS, Bound(0)), ACCURATE, DIGITS, PROVED];
const STEEL: &[PromisedRoute] = &[(MODES, Bound(0)), (CLOSED, Bound(12)), CLOSED_50, PROVED];
const STEEL_UNDAMPED: &[PromisedRoute] =
    &[(CLOSED, Bound(12)), (LATTICE, Bound(0)), (FRACTIONS, Exact), PRINTED, PROVED];
const DROPPED: &[PromisedRoute] = &[(PLANNED, Bound(9)), (Route::Planned(Numbers::Digits(20)), Digits(20))];
const HOP: &[PromisedRoute] = &[(PLANNED, Bound(9)), (accuracy(1e-10), Bound(10))];
const SMOOTH: &[PromisedRoute] = &[(PLANNED, Bound(9)), (CELLS, Digits(9)), DIGITS];
const SIDES: &[PromisedRoute] = &[(PLANNED, Bound(12)), (LATTICE, Bound(12)), (FRACTIONS, Exact), DIGITS, PROVED];
const RAY: &[PromisedRoute] = &[(CLOSED, Digits(12)), (CELLS, Digits(9)), CLOSED_50, DIGITS, ACCURATE, PROVED];

#[rustfmt::skip]
pub(super) const LATE: Group = group("late", "Bounces that come late",
    "Without gravity the stress at the ground is a sum of rays whose terms grow like e^{rt} while the sum stays of \
         the order of t. The closer r t₁ is to π from below, the later the bounce; from π on there is none. A sum in \
         plain doubles consists of rounding errors and finds a bounce in them. The sum over modes does not cancel \
         there, and longer numbers have digits to spare.", &[
    hard("late-3.13", "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.13", &[
        ask("t_b", late("3.13"), BounceTime, "11.66136670144388438415940577414071411946", LATE_ROUTES)
            .breaks(SUM, 3, || summed(3.13)),
    ]),
    hard("late-3.135", "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.135", &[
        ask("t_b", late("3.135"), BounceTime, "15.33318837004014558549067344667885556140", LATE_ROUTES)
            .breaks(SUM, 3, || summed(3.135)),
    ]),
    hard("late-3.14", "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.14", &[
        ask("t_b", late("3.14"), BounceTime, "31.40409847658940057227989202780933895332", LATEST)
            .breaks(SUM, 3, || summed(314.0 / 100.0)),
    ]),
    hard("never-3.141593", "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.141593 > π", &[
        ask("t_b", late("3.141593"), BounceTime, NO_BOUNCE, NEVER),
    ]),
    hard("never-3.15", "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.15 > π", &[
        ask("t_b", late("3.15"), BounceTime, NO_BOUNCE, NEVER).breaks(SUM, 1, || summed(3.15)),
    ]),
    hard("never-3.3", "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.3 > π", &[
        ask("t_b", late("3.3"), BounceTime, NO_BOUNCE, NEVER).breaks(SUM, 1, || summed(3.3)),
    ]),
    hard("never-10000", "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r far above π", &[
        ask("t_b, r = 10", late("10"), BounceTime, NO_BOUNCE, NEVER),
        ask("t_b, r = 10000", late("10000"), BounceTime, NO_BOUNCE, NEVER),
    ]),
]);

#[rustfmt::skip]
pub(super) const WEAK: Group = group("weak", "Damping that vanishes",
    "(3.38)–(3.45) and Remark 2 divide by 2r and 4r², and lose twice as many digits as r has zeros. Written with φ \
         functions and logarithmic means they have no division by r, and their limit r → 0 is the formula of r = 0, \
         which `remark-2` checks.", &[
    hard("weak-1e-9", "(3.44), Remark 2", "c = L = g = 1, μ = 4, r = 1e-9", &[
        ask("h_max", unit("1e-9", "4"), Top, "7.333333259333333905999995484844481333944", WEAK_ROUTES)
            .breaks(REMARK, 2, || formulas::top_height(1e-9, 1.0, -2.0 / 3.0, 4.0)),
    ]),
    hard("weak-1e-300", "(3.44), Remark 2", "c = L = g = 1, μ = 4, r = 1e-300", &[
        ask("h_max", unit("1e-300", "4"), Top, "7.333333333333333333333333333333333333333", WEAK_ROUTES)
            .breaks(REMARK, 1, || formulas::top_height(1e-300, 1.0, -2.0 / 3.0, 4.0)),
    ]),
]);

#[rustfmt::skip]
pub(super) const STRONG: Group = group("strong", "Damping that overflows",
    "I₀(rt) overflows beyond rt = 713, and e^{−rt} underflows. Their product is of the order of one and has to be \
         formed before its factors. The rod settles under its weight.", &[
    hard("strong-50", "(2.28)", "c = L = g = μ = 1, r = 25: R = 50", &[
        ask("v_x(0, 5)", unit("25", "1"), Strain, "-0.3921827498005491489803559626221082304965", STRONG_ROUTES).at("5"),
    ]),
    hard("strong-1000", "(2.28)", "c = L = g = μ = 1, r = 500: R = 1000", &[
        ask("v_x(0, 5)", unit("500", "1"), Strain, "-0.08776371099830946838336668658955494142548", STRONG_ROUTES)
            .at("5").breaks(SUM, 1, || printed(500.0, 1.0).strain(5.0)),
    ]),
]);

#[rustfmt::skip]
pub(super) const THRESHOLD: Group = group("threshold", "The threshold of the bounce at t₁",
    "At the threshold (2.32) the bounce leaves t₁: above it the bounce is at t₁ exactly, below it at a root just \
         after t₁. A speed that differs by 10⁻¹² decides between the two.", &[
    hard("threshold-left", "(2.32)",
        "c = L = g = 1, r = 0.2, a speed just below μ = 2.59364495456019430337818987448", &[
        ask("t_b, μ − 1e-12", BELOW_1E_12, BounceTime, "2.000000000001702973905980686180509575700", BELOW),
        ask("t_b, μ − 1e-9", BELOW_1E_9, BounceTime, "2.000000001702973905624873701469302027237", BELOW),
        ask("t_b, μ − 1e-6", BELOW_1E_6, BounceTime, "2.000001702973549812546044874633139569146", BELOW),
    ]),
    hard("threshold-right", "(2.32)",
        "c = L = g = 1, r = 0.2, a speed just above μ = 2.59364495456019430337818987448", &[
        ask("t_b, μ + 1e-12", unit("0.2", "2.59364495456119430337818987448"), BounceTime, "2", ABOVE),
        ask("t_b, μ + 1e-9", unit("0.2", "2.59364495556019430337818987448"), BounceTime, "2", ABOVE),
        ask("t_b, μ + 1e-6", unit("0.2", "2.59364595456019430337818987448"), BounceTime, "2", ABOVE),
    ]),
]);

#[rustfmt::skip]
pub(super) const LANDINGS: Group = group("landings", "Landings without speed, and many landings",
    "After some bounces the rod of μ = 1 lands with speed zero, at t = 31. This is a double root, which costs half of \
         the digits, and no numerical precision distinguishes it from a near miss. The enclosures carry exact numbers \
         a + b√d, which do. With μ = 3/2 the number of events grows, and each costs the next some digits.", &[
    hard("tangent-31", "theory",
        "c = L = g = 1, μ = 1: lands at 31 with speed zero, leaves at 34, and repeats all of it after 36", &[
        ask("impact", unit("0", "1").until("36"), Impact, "31", TANGENT).at("31"),
        ask("release", unit("0", "1").until("36"), Release, "34", AFTER_TANGENT).at("34"),
    ]),
    hard("chaos-100", "theory", "c = L = g = 1, μ = 3/2, followed to t = 100", &[
        ask("h(100)", unit("0", "3/2").until("100"), Centre, "0.4033126336604333388061654478595305043127", CHAOS)
            .at("100"),
    ]),
]);

#[rustfmt::skip]
pub(super) const HOPS: Group = group("hops", "Stiff rods and hop after hop",
    "A rod of steel takes thousands of round trips in its first flight and hops ever lower. The motion is well \
         conditioned; what loses digits is a method that takes small vibrations as differences of great motions. A \
         flight may be as short as 10⁻⁹ of the time, and the piece that a smooth release ends has a width that is no \
         rounding error.", &[
    hard("steel-dropped", "theory",
        "steel: L = 0.5 m, E = 210 GPa, ρ = 7850 kg/m³, r = 50/s, dropped from 1 m, ten impacts", &[
        ask("9th impact", STEEL_DROPPED, Impact, "0.5103899250270393109734401739123350005830", DROPPED).at("0.51039"),
    ]),
    hard("hop-1e-9", "theory", "L = 1.1, c = 2.3, r = 0.35, g = 0.8, μ = 20, followed to t = 37", &[
        ask("impact", HOPPING, Impact, "34.06779612803115148662209116245653308720", HOP).at("34.0678"),
        ask("release", HOPPING, Release, "35.98083960525843926317249301870682548185", HOP).at("35.98"),
        ask("landing 1e-9 later", HOPPING, Impact, "35.98083960631523790340770036395370974312", HOP).at("35.98"),
    ]),
    hard("touch-3e-7", "theory", "L = c = 1, r = 0.3, g = 0.5, from a height at which the end just touches the ground", &[
        ask("impact", TOUCHING, Impact, "0.3199827807688697935886756536602740659665", HOP).at("0.31998"),
        ask("release", TOUCHING, Release, "0.3199830535935373588287297884058403682920", HOP).at("0.31998"),
    ]),
    hard("graze-4e-7", "theory", "L = c = 1, r = 4, g = 0.1, top held, from a strain that just lets go of the ground", &[
        ask("release", GRAZING, Release, "0.5661538704537182854599808048158481366283", HOP).at("0.56615"),
        ask("impact", GRAZING, Impact, "0.5661542230544449026512609177437484900435", HOP).at("0.56615"),
        ask("last release of a steel rod", STEEL_GRAZING, Release, "0.004769822210408391877154892503847012550775",
            HOP).at("0.00477"),
    ]),
    hard("smooth-release", "(2.28), Theorem 1", "rods that leave the ground at a root of the stress", &[
        ask("shortest piece of v_x(0,·) to t = 1.9, r = 2.6, g = 0", late("2.6").until("1.9"), ShortestPiece,
            "0.111518966701124548249616194014423766093", SMOOTH),
        ask("shortest piece to t = 4, c = L = g = 1, r = 0.2, μ = 2", unit("0.2", "2").until("4"), ShortestPiece,
            "0.910267741735481725584624419197439223453", SMOOTH),
    ]),
]);

#[rustfmt::skip]
pub(super) const SMALL: Group = group("small", "Small differences of great numbers",
    "A fast rod has the vibrational energy E_z = μ₀²L/6 after its bounce, whatever its speed: for steel at 100 m/s \
         that is 5e-10 of the energy. In E − E_h no more than six digits of it are right; a sum of squares has all of \
         them.", &[
    hard("steel-100", "(3.61)–(3.63)",
        "steel: c = 5000 m/s, L = 1 m, g = 9.81 m/s², μ = 100 m/s, r = 12/s", &[
        ask("E_z(t_b)", steel("12"), VibrationalEnergy, "0.000003356796289599677190188789542192724001067", STEEL)
            .breaks("E − E_h", 8, energy_difference),
    ]),
    hard("steel-undamped", "(3.69)", "the same without damping: E_z = μ₀²L/6", &[
        ask("E_z(t_b)", steel("0"), VibrationalEnergy, "320787/125000000000", STEEL_UNDAMPED),
    ]),
]);

#[rustfmt::skip]
pub(super) const RAYS: Group = group("rays", "Two values at one time",
    "When a ray arrives, the stress jumps, and a decimal that is a multiple of t₁ need not be one in doubles. Both \
         limits can be asked for, and decimals are taken as the fractions that they spell.", &[
    hard("on-a-ray", "(2.28)",
        "g = 0, c = μ = 1, L = 1/10, r = 15, at t = 3t₁ = 0.6, which is not 3 · 0.2 in doubles", &[
        ask("v_x(0, 0.6⁺)", ON_A_RAY, Strain, "-0.0001890979741652485720935621548163603160316", RAY).at("0.6")
            .breaks("H_r by the k of (2.26)", 1, kernel_on_a_ray),
        ask("v_x(0, 0.6⁻)", ON_A_RAY, Strain, "-0.0004359175823386076710888355362764279681759", RAY).before("0.6"),
    ]),
    hard("sides", "(2.28)", "the limits at a ray's arrival, asked alone and last", &[
        ask("v_x(0, 3/2⁻), L = 3/5, c = 4/5, μ = 3/8, g = 5/2", MET, Strain, "-165/32", SIDES).before("3/2"),
        ask("v_x(0, 18/5⁺), L = 3/5, c = 1/3, μ = 1593/25, g = 3", STRONG_RELEASE, Strain, "0", SIDES).at("18/5"),
    ]),
]);
