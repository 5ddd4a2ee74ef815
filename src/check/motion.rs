//! Section 3.1 of the paper: momentum and centre of mass.

use super::Promise::{Bound, Digits, Enclosed, Exact, Less};
use super::Route::{Cells, Enclosures, Fractions, Lattice, LongRays, Modes, Paper, Plain, Rays};
use super::plain::{self, Printed};
use super::routes::{AT_BOUNCE, Of, Rod, Route};
use super::{Case, Group, Promise, Question, Verdict};
use crate::history::Side;

const fn unit(damping: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "" }
}

const DAMPED: Rod = unit("0.2", "4");
const PRINTED: Printed = Printed { r: 0.2, g: 1.0, mu: 4.0 };
const LATE: Rod = unit("0.1", "1");
const LATE_PRINTED: Printed = Printed { r: 0.1, g: 1.0, mu: 1.0 };
/// `t_b` of that rod.
const LATE_END: f64 = 3.449451746579489;

const EXACT: &[(Route, Promise)] =
    &[(Paper, Exact), (Fractions, Exact), (Lattice, Digits(13)), (Rays, Digits(12)), (Enclosures(36), Enclosed(36))];

macro_rules! ask {
    ($what:literal, $rod:expr, $of:expr, $truth:expr, $routes:expr) => {
        Question { what: $what, rod: $rod, of: $of, truth: $truth, routes: $routes }
    };
}

macro_rules! claim {
    ($name:literal, $verdict:ident, $source:literal, $about:literal, $questions:expr) => {
        Case {
            name: $name,
            group: Group::Motion,
            source: $source,
            about: $about,
            verdict: Verdict::$verdict,
            questions: $questions,
        }
    };
}

pub(super) const CASES: &[Case] = &[
    claim!(
        "motion-in-contact",
        Reproduced,
        "(3.38), (3.39)",
        "c = L = g = 1, r = 0.2, μ = 4",
        &[
            ask!(
                "P(1.3)",
                DAMPED,
                Of::Momentum("1.3"),
                "0.8171461858116488478511749489110060673511",
                &[
                    (Plain("(3.38) by quadrature", || PRINTED.momentum(1.3)), Digits(11)),
                    (Rays, Bound(12)),
                    (Modes, Bound(9)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
            ask!(
                "h(1.3)",
                DAMPED,
                Of::Centre("1.3"),
                "-1.839128359296928791061499563155118710307",
                &[
                    (Plain("(3.39) by quadrature", || PRINTED.centre(1.3)), Digits(11)),
                    (Rays, Bound(12)),
                    (Modes, Bound(9)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
        ]
    ),
    claim!(
        "motion-in-flight",
        Reproduced,
        "(3.43)–(3.45)",
        "the same after t_b = 2",
        &[
            ask!(
                "P(3)",
                DAMPED,
                Of::Momentum("3"),
                "0.9714201843421907120951441066921296004848",
                &[
                    (Plain("(3.43)", || PRINTED.flying(2.0, 3.0)), Digits(11)),
                    (Rays, Bound(12)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "h(3)",
                DAMPED,
                Of::Centre("3"),
                "1.176166532822276666688664970606027952153",
                &[
                    (Plain("(3.44)", || PRINTED.flight(2.0, 3.0)), Digits(10)),
                    (Rays, Bound(12)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                ]
            ),
        ]
    ),
    claim!(
        "initial-data-3.42",
        Misprint,
        "(3.42)",
        "initial data of the flight are given at t₁; t_b is meant: c = L = g = μ = 1, r = 0.1, where t_b > t₁",
        &[ask!(
            "h(3.5)",
            LATE,
            Of::Centre("3.5"),
            "0.08333350929468396681662492989641095112958",
            &[
                (Plain("(3.44) from t₁ on", || LATE_PRINTED.flight(2.0, 3.5)), Less(2)),
                (Plain("(3.44) from t_b on", || LATE_PRINTED.flight(LATE_END, 3.5)), Digits(9)),
                (Rays, Bound(9)),
                (Cells, Digits(9)),
                (LongRays(50), Digits(36)),
            ]
        )]
    ),
    claim!(
        "stress-free-3.42",
        Misprint,
        "after (3.42)",
        "\"Ψ_r = 0 on (t₁, t_b)\": the rod is pressed to the ground there; (t_b, t₂) is meant",
        &[ask!(
            "v_x(0, 2.5)",
            LATE,
            Of::Stress("2.5", Side::Right),
            "-0.6467207086033466335609605663018219594747",
            &[
                (Plain("0 as printed", || 0.0), Less(1)),
                (Plain("(2.28) by quadrature", || LATE_PRINTED.stress(2.5)), Digits(11)),
                (Rays, Bound(12)),
                (Modes, Bound(9)),
                (LongRays(50), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ]
        )]
    ),
    claim!(
        "undamped-fast",
        Reproduced,
        "(3.47)–(3.51)",
        "r = 0, c = L = g = 1, μ = 4 ≥ g t₁",
        &[
            ask!("P(1/3)", unit("0", "4"), Of::Momentum("1/3"), "-53/18", EXACT),
            ask!("h(1/3)", unit("0", "4"), Of::Centre("1/3"), "-94/81", EXACT),
            ask!("h⁰ = −2gL²/3c²", unit("0", "4"), Of::Centre(AT_BOUNCE), "-2/3", EXACT),
            ask!("h¹ = μ", unit("0", "4"), Of::Momentum(AT_BOUNCE), "4", EXACT),
            ask!("P(3)", unit("0", "4"), Of::Momentum("3"), "3", EXACT),
            ask!("h(3)", unit("0", "4"), Of::Centre("3"), "17/6", EXACT),
        ]
    ),
    claim!(
        "undamped-slow",
        Reproduced,
        "(3.52), (3.53)",
        "r = 0, c = L = g = μ = 1 < g t₁: t_b = 3",
        &[
            ask!("P(1/3)", unit("0", "1"), Of::Momentum("1/3"), "-17/18", EXACT),
            ask!("P(5/2)", unit("0", "1"), Of::Momentum("5/2"), "7/8", EXACT),
            ask!("h(5/2)", unit("0", "1"), Of::Centre("5/2"), "-3/16", EXACT),
            ask!("P(4)", unit("0", "1"), Of::Momentum("4"), "-1/2", EXACT),
            ask!("h(4)", unit("0", "1"), Of::Centre("4"), "1/6", EXACT),
        ]
    ),
    claim!(
        "remark-2",
        Reproduced,
        "Remark 2",
        "the top of the flight, c = L = g = 1",
        &[
            ask!("t*, r = 0, μ = 4", unit("0", "4"), Of::TopTime, "6", EXACT),
            ask!("h_max, r = 0, μ = 4", unit("0", "4"), Of::TopHeight, "22/3", EXACT),
            ask!("t*, r = 0, μ = 1", unit("0", "1"), Of::TopTime, "7/2", EXACT),
            ask!("h_max, r = 0, μ = 1", unit("0", "1"), Of::TopHeight, "7/24", EXACT),
            ask!(
                "t*, r = 0.2, μ = 4",
                DAMPED,
                Of::TopTime,
                "3.820682633452505008314153800573278405844",
                &[
                    (
                        Plain("Remark 2, h¹ by quadrature", || plain::top_time(0.2, 1.0, 2.0, PRINTED.momentum(2.0))),
                        Digits(11)
                    ),
                    (Rays, Bound(12)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "h_max, r = 0.2, μ = 4",
                DAMPED,
                Of::TopHeight,
                "1.553010410046490926141140735903155938755",
                &[
                    (
                        Plain("Remark 2, h⁰ and h¹ by quadrature", || {
                            plain::top_height(0.2, 1.0, PRINTED.centre(2.0), PRINTED.momentum(2.0))
                        }),
                        Digits(10),
                    ),
                    (Rays, Bound(12)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                ]
            ),
        ]
    ),
];
