//! Where double precision breaks.

use super::Promise::{Bound, Digits, Enclosed, Exact, Less};
use super::Route::{Accuracy, Cells, Enclosures, Fractions, Lattice, LongRays, Modes, Plain, Rays, Within};
use super::routes::{AT_BOUNCE, Of, Rod, Route};
use super::value::NO_BOUNCE;
use super::{Case, Group, Question, Verdict, plain};
use crate::history::{EventKind, Side};
use crate::rod::Parameters;

/// g = 0, c = t₁ = μ = 1: Figure 1 and beyond.
const fn late(damping: &'static str) -> Rod {
    Rod { length: "1/2", wave_speed: "1", damping, gravity: "0", speed: "1", until: "" }
}

/// c = L = g = 1.
const fn unit(damping: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "" }
}

const fn followed(speed: &'static str, until: &'static str) -> Rod {
    Rod { until, ..unit("0", speed) }
}

/// A case of one question.
macro_rules! hard {
    ($name:literal, $group:ident, $source:literal, $about:literal, $questions:expr) => {
        Case {
            name: $name,
            group: Group::$group,
            source: $source,
            about: $about,
            verdict: Verdict::Holds,
            questions: $questions,
        }
    };
}

const SUM: &str = "(2.28) summed as printed";
const REMARK: &str = "Remark 2 as printed";
const DIFFERENCE: &str = "E − E_h";

pub(super) const CASES: &[Case] = &[
    hard!(
        "late-3.13",
        Late,
        "Theorem 1",
        "g = 0, c = t₁ = μ = 1, r = 3.13",
        &[Question {
            what: "t_b",
            rod: late("3.13"),
            of: Of::Bounce,
            truth: "11.66136670144388438415940577414071411946",
            routes: &[
                (Plain(SUM, || plain::first_tension(3.13, 1.0)), Less(3)),
                (Rays, Bound(0)),
                (Modes, Digits(9)),
                (Within(1e-9), Digits(9)),
                (Accuracy(1e-12), Digits(12)),
                (Route::Digits(36), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "late-3.135",
        Late,
        "Theorem 1",
        "g = 0, c = t₁ = μ = 1, r = 3.135",
        &[Question {
            what: "t_b",
            rod: late("3.135"),
            of: Of::Bounce,
            truth: "15.33318837004014558549067344667885556140",
            routes: &[
                (Plain(SUM, || plain::first_tension(3.135, 1.0)), Less(3)),
                (Rays, Bound(0)),
                (Modes, Digits(9)),
                (Within(1e-9), Digits(9)),
                (Accuracy(1e-12), Digits(12)),
                (Route::Digits(36), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "late-3.14",
        Late,
        "Theorem 1",
        "g = 0, c = t₁ = μ = 1, r = 3.14",
        &[Question {
            what: "t_b",
            rod: late("3.14"),
            of: Of::Bounce,
            truth: "31.40409847658940057227989202780933895332",
            routes: &[
                (Plain(SUM, || plain::first_tension(314.0 / 100.0, 1.0)), Less(3)),
                (Rays, Bound(0)),
                (Modes, Digits(9)),
                (Within(1e-9), Digits(9)),
                (LongRays(150), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "never-3.15",
        Late,
        "Theorem 1 (i)",
        "g = 0, c = t₁ = μ = 1, r = 3.15 > π",
        &[Question {
            what: "t_b",
            rod: late("3.15"),
            of: Of::Bounce,
            truth: NO_BOUNCE,
            routes: &[
                (Plain(SUM, || plain::first_tension(3.15, 1.0)), Less(1)),
                (Rays, Digits(0)),
                (Within(1e-9), Digits(0)),
                (LongRays(50), Digits(0)),
                (Enclosures(36), Digits(0)),
            ],
        }]
    ),
    hard!(
        "never-3.3",
        Late,
        "Theorem 1 (i)",
        "g = 0, c = t₁ = μ = 1, r = 3.3 > π",
        &[Question {
            what: "t_b",
            rod: late("3.3"),
            of: Of::Bounce,
            truth: NO_BOUNCE,
            routes: &[
                (Plain(SUM, || plain::first_tension(3.3, 1.0)), Less(1)),
                (Rays, Digits(0)),
                (Within(1e-9), Digits(0)),
                (LongRays(50), Digits(0)),
                (Enclosures(36), Digits(0)),
            ],
        }]
    ),
    hard!(
        "weak-1e-9",
        Weak,
        "(3.44), Remark 2",
        "c = L = g = 1, μ = 4, r = 1e-9",
        &[Question {
            what: "h_max",
            rod: unit("1e-9", "4"),
            of: Of::TopHeight,
            truth: "7.333333259333333905999995484844481333944",
            routes: &[
                (Plain(REMARK, || plain::top_height(1e-9, 1.0, -2.0 / 3.0, 4.0)), Less(2)),
                (Rays, Digits(12)),
                (Cells, Digits(10)),
                (LongRays(50), Digits(36)),
            ],
        }]
    ),
    hard!(
        "weak-1e-300",
        Weak,
        "(3.44), Remark 2",
        "c = L = g = 1, μ = 4, r = 1e-300",
        &[Question {
            what: "h_max",
            rod: unit("1e-300", "4"),
            of: Of::TopHeight,
            truth: "7.333333333333333333333333333333333333333",
            routes: &[
                (Plain(REMARK, || plain::top_height(1e-300, 1.0, -2.0 / 3.0, 4.0)), Less(1)),
                (Rays, Digits(12)),
                (Cells, Digits(10)),
                (LongRays(50), Digits(36)),
            ],
        }]
    ),
    hard!(
        "undamped-top",
        Weak,
        "Remark 2, r = 0",
        "c = L = g = 1, μ = 4, r = 0",
        &[Question {
            what: "h_max",
            rod: unit("0", "4"),
            of: Of::TopHeight,
            truth: "22/3",
            routes: &[(Rays, Digits(12)), (Lattice, Digits(12)), (Fractions, Exact), (Route::Paper, Exact)],
        }]
    ),
    hard!(
        "strong-50",
        Strong,
        "(2.28)",
        "c = L = g = μ = 1, r = 25: R = 50",
        &[Question {
            what: "v_x(0, 5)",
            rod: unit("25", "1"),
            of: Of::Stress("5", Side::Right),
            truth: "-0.3921827498005491489803559626221082304965",
            routes: &[(Rays, Bound(10)), (Modes, Bound(8)), (LongRays(50), Digits(36)), (Enclosures(36), Enclosed(36)),],
        }]
    ),
    hard!(
        "strong-1000",
        Strong,
        "(2.28)",
        "c = L = g = μ = 1, r = 500: R = 1000",
        &[Question {
            what: "v_x(0, 5)",
            rod: unit("500", "1"),
            of: Of::Stress("5", Side::Right),
            truth: "-0.08776371099830946838336668658955494142548",
            routes: &[
                (Plain(SUM, || plain::Printed { r: 500.0, g: 1.0, mu: 1.0 }.stress(5.0)), Less(1)),
                (Rays, Bound(10)),
                (Modes, Bound(8)),
                (LongRays(50), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "threshold-left",
        Threshold,
        "(2.32)",
        "c = L = g = 1, r = 0.2, μ = 2.59364495456019430337818987448 − 1e-12",
        &[Question {
            what: "t_b",
            rod: unit("0.2", "2.59364495455919430337818987448"),
            of: Of::Bounce,
            truth: "2.000000000001702973905980686180509575700",
            routes: &[
                (Within(1e-9), Digits(9)),
                (Cells, Digits(9)),
                (Accuracy(1e-14), Digits(13)),
                (LongRays(50), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "threshold-right",
        Threshold,
        "(2.32)",
        "c = L = g = 1, r = 0.2, μ = 2.59364495456019430337818987448 + 1e-12",
        &[Question {
            what: "t_b",
            rod: unit("0.2", "2.59364495456119430337818987448"),
            of: Of::Bounce,
            truth: "2",
            routes: &[
                (Rays, Exact),
                (Within(1e-9), Exact),
                (Cells, Digits(9)),
                (LongRays(50), Exact),
                (Enclosures(36), Enclosed(36))
            ],
        }]
    ),
    hard!(
        "tangent-31",
        Landings,
        "theory",
        "c = L = g = 1, μ = 1: lands at 31 with speed zero, leaves at 34, and does it all again after 36",
        &[
            Question {
                what: "impact",
                rod: followed("1", "36"),
                of: Of::Event(EventKind::Impact, 31.0),
                truth: "31",
                routes: &[
                    (Lattice, Bound(6)),
                    (Fractions, Bound(0)),
                    (Accuracy(1e-12), Digits(12)),
                    (Route::Digits(36), Digits(36)),
                    (Enclosures(36), Exact),
                ],
            },
            Question {
                what: "release",
                rod: followed("1", "36"),
                of: Of::Event(EventKind::Release, 34.0),
                truth: "34",
                routes: &[(Lattice, Bound(12)), (Route::Digits(36), Digits(36)), (Enclosures(36), Exact)],
            },
        ]
    ),
    hard!(
        "chaos-100",
        Landings,
        "theory",
        "c = L = g = 1, μ = 3/2, followed to t = 100",
        &[Question {
            what: "h(100)",
            rod: followed("3/2", "100"),
            of: Of::Centre("100"),
            truth: "0.4033126336604333388061654478595305043127",
            routes: &[
                (Lattice, Bound(0)),
                (Fractions, Bound(0)),
                (Accuracy(1e-12), Digits(12)),
                (Route::Digits(36), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "steel-100",
        Small,
        "(3.61)–(3.63)",
        "steel: c = 5000 m/s, L = 1 m, g = 9.81 m/s², μ = 100 m/s, r = 12/s",
        &[Question {
            what: "E_z(t_b)",
            rod: Rod { length: "1", wave_speed: "5000", damping: "12", gravity: "9.81", speed: "100", until: "" },
            of: Of::Vibrational(AT_BOUNCE),
            truth: "0.000003356796289599677190188789542192724001067",
            routes: &[
                (
                    Plain(DIFFERENCE, || {
                        let rod =
                            Parameters { length: 1.0, wave_speed: 5000.0, damping: 12.0, gravity: 9.81, speed: 100.0 };
                        plain::energy_difference(&rod)
                    }),
                    Less(8),
                ),
                (Modes, Bound(0)),
                (Rays, Bound(12)),
                (LongRays(50), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "steel-undamped",
        Small,
        "(3.69)",
        "the same without damping: E_z = μ₀²L/6",
        &[Question {
            what: "E_z(t_b)",
            rod: Rod { length: "1", wave_speed: "5000", damping: "0", gravity: "9.81", speed: "100", until: "" },
            of: Of::Vibrational(AT_BOUNCE),
            truth: "320787/125000000000",
            routes: &[
                (Rays, Bound(12)),
                (Lattice, Bound(0)),
                (Fractions, Exact),
                (Route::Paper, Exact),
                (Enclosures(36), Enclosed(36)),
            ],
        }]
    ),
    hard!(
        "on-a-ray",
        Rays,
        "(2.28)",
        "g = 0, c = μ = 1, L = 1/10, r = 15, at t = 3t₁ = 0.6, which is not 3 · 0.2 in doubles",
        &[
            Question {
                what: "v_x(0, 0.6⁺)",
                rod: Rod { length: "1/10", wave_speed: "1", damping: "15", gravity: "0", speed: "1", until: "1" },
                of: Of::Stress("0.6", Side::Right),
                truth: "-0.0001890979741652485720935621548163603160316",
                routes: &[
                    (
                        Plain("H_r by the k of (2.26)", || -(-9.0f64).exp() * plain::impact_kernel(15.0, 0.2, 0.6)),
                        Less(1)
                    ),
                    (Rays, Digits(12)),
                    (Cells, Digits(9)),
                    (LongRays(50), Digits(36)),
                    (Route::Digits(36), Digits(36)),
                    (Accuracy(1e-12), Digits(12)),
                    (Enclosures(36), Enclosed(36)),
                ],
            },
            Question {
                what: "v_x(0, 0.6⁻)",
                rod: Rod { length: "1/10", wave_speed: "1", damping: "15", gravity: "0", speed: "1", until: "1" },
                of: Of::Stress("0.6", Side::Left),
                truth: "-0.0004359175823386076710888355362764279681759",
                routes: &[
                    (Rays, Digits(12)),
                    (Cells, Digits(9)),
                    (LongRays(50), Digits(36)),
                    (Route::Digits(36), Digits(36)),
                    (Accuracy(1e-12), Digits(12)),
                    (Enclosures(36), Enclosed(36))
                ],
            },
        ]
    ),
];
