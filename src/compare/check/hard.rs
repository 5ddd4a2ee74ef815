//! Where double precision breaks.

use super::case::*;
use super::group::Group;
use super::verdict::Promise::{Bound, Digits, Exact};
use super::verdict::Verdict;
use crate::compare::quantity::Quantity::{BounceTime, Centre, Impact, Release, Stress, TopHeight, Vibrational};
use crate::first_contact::FirstContact;
use crate::paper::{Printed, formulas};
use crate::rod::Parameters;

const fn hard(name: &'static str, group: Group, source: &'static str, about: &'static str) -> Case {
    Case { name, group, source, about, verdict: Verdict::Holds, questions: &[] }
}

/// g = 0, c = t₁ = μ = 1: Figure 1 and beyond.
const fn late(damping: &'static str) -> Rod {
    Rod { length: "1/2", ..unit(damping, "1").weightless() }
}

const fn steel(damping: &'static str) -> Rod {
    Rod { wave_speed: "5000", gravity: "9.81", ..unit(damping, "100") }
}

const ON_A_RAY: Rod = Rod { length: "1/10", ..unit("15", "1").weightless().until("1") };

/// The first tensile stress of (2.28), g = 0, looked for in steps of a thousandth of a round trip.
fn summed(damping: f64) -> f64 {
    let rod = Parameters { length: 0.5, wave_speed: 1.0, damping, gravity: 0.0, speed: 1.0 };
    Printed::new(&rod, 1e-10).release(1.0, 1000).unwrap_or(f64::NAN)
}

const SUM: &str = "(2.28) summed as printed";
const REMARK: &str = "Remark 2 as printed";

const CLOSED_WITHIN: Promised = (closed_within(1e-9), Bound(9));
const ACCURATE: Promised = (accuracy(1e-12), Digits(12));
const LATE: &[Promised] = &[(CLOSED, Bound(0)), (MODES, Digits(9)), CLOSED_WITHIN, ACCURATE, DIGITS, PROVED];
const LATEST: &[Promised] = &[(CLOSED, Bound(0)), (MODES, Digits(9)), CLOSED_WITHIN, (closed(150), Digits(36)), PROVED];
const WEAK: &[Promised] = &[(CLOSED, Digits(12)), (CELLS, Digits(10)), CLOSED_50];
const STRONG: &[Promised] = &[(CLOSED, Bound(10)), (MODES, Bound(8)), CLOSED_50, PROVED];
const BELOW: &[Promised] =
    &[(closed_within(1e-9), Digits(9)), (CELLS, Digits(9)), (accuracy(1e-14), Digits(13)), CLOSED_50, PROVED];
const ABOVE: &[Promised] =
    &[(CLOSED, Exact), (closed_within(1e-9), Exact), (CELLS, Digits(9)), (closed(50), Exact), PROVED];
const TANGENT: &[Promised] = &[(LATTICE, Bound(6)), (FRACTIONS, Bound(0)), ACCURATE, DIGITS, (CERTIFIED, Exact)];
const AFTER_TANGENT: &[Promised] = &[(LATTICE, Bound(12)), DIGITS, (CERTIFIED, Exact)];
const CHAOS: &[Promised] = &[(LATTICE, Bound(0)), (FRACTIONS, Bound(0)), ACCURATE, DIGITS, PROVED];
const STEEL: &[Promised] = &[(MODES, Bound(0)), (CLOSED, Bound(12)), CLOSED_50, PROVED];
const STEEL_UNDAMPED: &[Promised] = &[(CLOSED, Bound(12)), (LATTICE, Bound(0)), (FRACTIONS, Exact), PRINTED, PROVED];
const RAY: &[Promised] = &[(CLOSED, Digits(12)), (CELLS, Digits(9)), CLOSED_50, DIGITS, ACCURATE, PROVED];

pub(super) const CASES: &[Case] =
    &[
        hard("late-3.13", Group::Late, "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.13").questions(&[ask(
            "t_b",
            late("3.13"),
            BounceTime,
            "11.66136670144388438415940577414071411946",
            LATE,
        )
        .formulas(&[breaks(SUM, 3, || summed(3.13))])]),
        hard("late-3.135", Group::Late, "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.135").questions(&[ask(
            "t_b",
            late("3.135"),
            BounceTime,
            "15.33318837004014558549067344667885556140",
            LATE,
        )
        .formulas(&[breaks(SUM, 3, || summed(3.135))])]),
        hard("late-3.14", Group::Late, "Theorem 1", "g = 0, c = t₁ = μ = 1, r = 3.14").questions(&[ask(
            "t_b",
            late("3.14"),
            BounceTime,
            "31.40409847658940057227989202780933895332",
            LATEST,
        )
        .formulas(&[breaks(SUM, 3, || summed(314.0 / 100.0))])]),
        hard("never-3.141593", Group::Late, "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.141593 > π")
            .questions(&[ask("t_b", late("3.141593"), BounceTime, NO_BOUNCE, NEVER)]),
        hard("never-3.15", Group::Late, "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.15 > π").questions(&[ask(
            "t_b",
            late("3.15"),
            BounceTime,
            NO_BOUNCE,
            NEVER,
        )
        .formulas(&[breaks(SUM, 1, || summed(3.15))])]),
        hard("never-3.3", Group::Late, "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r = 3.3 > π").questions(&[ask(
            "t_b",
            late("3.3"),
            BounceTime,
            NO_BOUNCE,
            NEVER,
        )
        .formulas(&[breaks(SUM, 1, || summed(3.3))])]),
        hard("never-10000", Group::Late, "Theorem 1 (i)", "g = 0, c = t₁ = μ = 1, r far above π").questions(&[
            ask("t_b, r = 10", late("10"), BounceTime, NO_BOUNCE, NEVER),
            ask("t_b, r = 10000", late("10000"), BounceTime, NO_BOUNCE, NEVER),
        ]),
        hard("weak-1e-9", Group::Weak, "(3.44), Remark 2", "c = L = g = 1, μ = 4, r = 1e-9").questions(&[ask(
            "h_max",
            unit("1e-9", "4"),
            TopHeight,
            "7.333333259333333905999995484844481333944",
            WEAK,
        )
        .formulas(&[breaks(REMARK, 2, || formulas::top_height(1e-9, 1.0, -2.0 / 3.0, 4.0))])]),
        hard("weak-1e-300", Group::Weak, "(3.44), Remark 2", "c = L = g = 1, μ = 4, r = 1e-300").questions(&[ask(
            "h_max",
            unit("1e-300", "4"),
            TopHeight,
            "7.333333333333333333333333333333333333333",
            WEAK,
        )
        .formulas(&[breaks(REMARK, 1, || formulas::top_height(1e-300, 1.0, -2.0 / 3.0, 4.0))])]),
        hard("strong-50", Group::Strong, "(2.28)", "c = L = g = μ = 1, r = 25: R = 50").questions(&[ask(
            "v_x(0, 5)",
            unit("25", "1"),
            Stress,
            "-0.3921827498005491489803559626221082304965",
            STRONG,
        )
        .at("5")]),
        hard("strong-1000", Group::Strong, "(2.28)", "c = L = g = μ = 1, r = 500: R = 1000").questions(&[ask(
            "v_x(0, 5)",
            unit("500", "1"),
            Stress,
            "-0.08776371099830946838336668658955494142548",
            STRONG,
        )
        .at("5")
        .formulas(&[breaks(SUM, 1, || printed(500.0, 1.0).stress(5.0))])]),
        hard(
            "threshold-left",
            Group::Threshold,
            "(2.32)",
            "c = L = g = 1, r = 0.2, a speed just below μ = 2.59364495456019430337818987448",
        )
        .questions(&[
            ask("t_b, μ − 1e-12", BELOW_1E_12, BounceTime, "2.000000000001702973905980686180509575700", BELOW),
            ask("t_b, μ − 1e-9", BELOW_1E_9, BounceTime, "2.000000001702973905624873701469302027237", BELOW),
            ask("t_b, μ − 1e-6", BELOW_1E_6, BounceTime, "2.000001702973549812546044874633139569146", BELOW),
        ]),
        hard(
            "threshold-right",
            Group::Threshold,
            "(2.32)",
            "c = L = g = 1, r = 0.2, a speed just above μ = 2.59364495456019430337818987448",
        )
        .questions(&[
            ask("t_b, μ + 1e-12", unit("0.2", "2.59364495456119430337818987448"), BounceTime, "2", ABOVE),
            ask("t_b, μ + 1e-9", unit("0.2", "2.59364495556019430337818987448"), BounceTime, "2", ABOVE),
            ask("t_b, μ + 1e-6", unit("0.2", "2.59364595456019430337818987448"), BounceTime, "2", ABOVE),
        ]),
        hard(
            "tangent-31",
            Group::Landings,
            "theory",
            "c = L = g = 1, μ = 1: lands at 31 with speed zero, leaves at 34, and repeats all of it after 36",
        )
        .questions(&[
            ask("impact", unit("0", "1").until("36"), Impact, "31", TANGENT).at("31"),
            ask("release", unit("0", "1").until("36"), Release, "34", AFTER_TANGENT).at("34"),
        ]),
        hard("chaos-100", Group::Landings, "theory", "c = L = g = 1, μ = 3/2, followed to t = 100").questions(&[ask(
            "h(100)",
            unit("0", "3/2").until("100"),
            Centre,
            "0.4033126336604333388061654478595305043127",
            CHAOS,
        )
        .at("100")]),
        hard(
            "steel-100",
            Group::Small,
            "(3.61)–(3.63)",
            "steel: c = 5000 m/s, L = 1 m, g = 9.81 m/s², μ = 100 m/s, r = 12/s",
        )
        .questions(&[ask(
            "E_z(t_b)",
            steel("12"),
            Vibrational,
            "0.000003356796289599677190188789542192724001067",
            STEEL,
        )
        .formulas(&[breaks("E − E_h", 8, || {
            let rod = Parameters { length: 1.0, wave_speed: 5000.0, damping: 12.0, gravity: 9.81, speed: 100.0 };
            let (energy, _) = FirstContact::new(&rod).energy(&rod.round_trip());
            energy.total - energy.translational
        })])]),
        hard("steel-undamped", Group::Small, "(3.69)", "the same without damping: E_z = μ₀²L/6").questions(&[ask(
            "E_z(t_b)",
            steel("0"),
            Vibrational,
            "320787/125000000000",
            STEEL_UNDAMPED,
        )]),
        hard(
            "on-a-ray",
            Group::Rays,
            "(2.28)",
            "g = 0, c = μ = 1, L = 1/10, r = 15, at t = 3t₁ = 0.6, which is not 3 · 0.2 in doubles",
        )
        .questions(&[
            ask("v_x(0, 0.6⁺)", ON_A_RAY, Stress, "-0.0001890979741652485720935621548163603160316", RAY)
                .at("0.6")
                .formulas(&[breaks("H_r by the k of (2.26)", 1, || {
                    let rod = Parameters { length: 0.1, wave_speed: 1.0, damping: 15.0, gravity: 0.0, speed: 1.0 };
                    -(-9.0f64).exp() * Printed::new(&rod, 1e-13).impact_kernel(0.6)
                })]),
            ask("v_x(0, 0.6⁻)", ON_A_RAY, Stress, "-0.0004359175823386076710888355362764279681759", RAY).before("0.6"),
        ]),
    ];

const BELOW_1E_12: Rod = unit("0.2", "2.59364495455919430337818987448");
const BELOW_1E_9: Rod = unit("0.2", "2.59364495356019430337818987448");
const BELOW_1E_6: Rod = unit("0.2", "2.59364395456019430337818987448");
