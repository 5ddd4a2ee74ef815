//! Section 4 of the paper: coefficients of restitution.

use super::Promise::{Bound, Digits, Enclosed, Exact, Less};
#[cfg(feature = "mp")]
use super::Route::Long;
use super::Route::{Cells, Enclosures, Fractions, Lattice, LongRays, Modes, Paper, Plain, Rays};
#[cfg(feature = "mp")]
use super::plain;
use super::routes::{Of, Rod, Route};
use super::{Case, Group, Promise, Question, Verdict};

const fn unit(damping: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "" }
}

/// What is left of gravity for μ → ∞: nothing.
const fn limit(damping: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "0", speed: "1", until: "" }
}

const EXACT: &[(Route, Promise)] = &[
    (Paper, Exact),
    (Fractions, Exact),
    (Lattice, Digits(13)),
    (Rays, Digits(12)),
    (Modes, Digits(9)),
    (Enclosures(36), Enclosed(36)),
];
const FOUND: &[(Route, Promise)] = &[
    (Rays, Digits(12)),
    (Modes, Bound(4)),
    (Cells, Digits(10)),
    (LongRays(50), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];
const LEFT: &[(Route, Promise)] = &[
    (Rays, Digits(9)),
    (Modes, Digits(9)),
    (Cells, Digits(9)),
    (LongRays(50), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];

macro_rules! ask {
    ($what:literal, $rod:expr, $of:expr, $truth:expr, $routes:expr) => {
        Question { what: $what, rod: $rod, of: $of, truth: $truth, routes: $routes }
    };
}

macro_rules! claim {
    ($name:literal, $verdict:ident, $source:literal, $about:literal, $questions:expr) => {
        Case {
            name: $name,
            group: Group::Restitution,
            source: $source,
            about: $about,
            verdict: Verdict::$verdict,
            questions: $questions,
        }
    };
}

/// A limit, and what is printed for it.
macro_rules! limit {
    ($what:literal, $r:literal, $of:expr, $truth:literal, $printed:literal, $formula:expr, $less:literal) => {
        ask!(
            $what,
            limit($r),
            $of,
            $truth,
            &[
                (Plain($printed, $formula), Less($less)),
                (Rays, Digits(13)),
                (Modes, Bound(5)),
                (LongRays(50), Digits(36)),
            ]
        )
    };
}

pub(super) const CASES: &[Case] = &[
    claim!(
        "momentum-restitution",
        Reproduced,
        "section 4.1",
        "r = 0, c = L = g = 1: e_P = min(1, μ/μ₀)",
        &[
            ask!("e_P, μ = 1", unit("0", "1"), Of::MomentumRestitution, "1/2", EXACT),
            ask!("e_P, μ = 4", unit("0", "4"), Of::MomentumRestitution, "1", EXACT),
        ]
    ),
    claim!(
        "energy-restitution",
        Reproduced,
        "(4.71), (4.72)",
        "r = 0, c = L = g = 1: e_E² is least, 5/9, at μ = 2μ₀/3",
        &[
            ask!("e_E², μ = 1", unit("0", "1"), Of::Restitution, "7/12", EXACT),
            ask!("e_E², μ = 4/3", unit("0", "4/3"), Of::Restitution, "5/9", EXACT),
            ask!("e_E², μ = 4", unit("0", "4"), Of::Restitution, "11/12", EXACT),
        ]
    ),
    claim!(
        "figure-4",
        Reproduced,
        "Figure 4",
        "right of the black dots, where t_b = t₁: c = L = g = 1, μ = 5",
        &[
            ask!(
                "e_E², r = 0.1",
                unit("0.1", "5"),
                Of::Restitution,
                "0.6202643084571624744481581489946464573244",
                FOUND
            ),
            ask!(
                "e_E², r = 0.2",
                unit("0.2", "5"),
                Of::Restitution,
                "0.4009910890774769182960221839814290930402",
                FOUND
            ),
            ask!(
                "e_E², r = 0.3",
                unit("0.3", "5"),
                Of::Restitution,
                "0.2543430950994055877566630527867066799152",
                FOUND
            ),
        ]
    ),
    claim!(
        "figure-4-left",
        Settled,
        "Figure 4",
        "left of the black dots, \"significantly more difficult to compute\": t_b > t₁",
        &[
            ask!(
                "t_b, r = 0.1, μ = 1.5",
                unit("0.1", "1.5"),
                Of::Bounce,
                "2.890460729168262502823395495175424806531",
                LEFT
            ),
            ask!(
                "e_E², r = 0.1, μ = 1.5",
                unit("0.1", "1.5"),
                Of::Restitution,
                "0.2335750046778280457751702821069789771300",
                LEFT
            ),
            ask!(
                "t_b, r = 0.2, μ = 2.5",
                unit("0.2", "2.5"),
                Of::Bounce,
                "2.156471888994680717981496360752384213616",
                LEFT
            ),
            ask!(
                "e_E², r = 0.2, μ = 2.5",
                unit("0.2", "2.5"),
                Of::Restitution,
                "0.2159298868555963713812142673621205898860",
                LEFT
            ),
            ask!(
                "t_b, r = 0.3, μ = 3",
                unit("0.3", "3"),
                Of::Bounce,
                "2.247803899311644297247506322698188832420",
                LEFT
            ),
            ask!(
                "e_E², r = 0.3, μ = 3",
                unit("0.3", "3"),
                Of::Restitution,
                "0.1098071999264657941087776090813272541222",
                LEFT
            ),
        ]
    ),
    claim!(
        "figure-5",
        Reproduced,
        "(4.73), Figure 5",
        "E_h(t₁)/E(t₁) at both ends of the figure, c = L = g = 1",
        &[
            ask!(
                "r = 0.1, μ = 3.2",
                unit("0.1", "3.2"),
                Of::Share,
                "0.8321745695016716858485197047301930231483",
                FOUND
            ),
            ask!(
                "r = 0.2, μ = 3.2",
                unit("0.2", "3.2"),
                Of::Share,
                "0.7688930123499804751285252658343325816632",
                FOUND
            ),
            ask!(
                "r = 0.1, μ = 12.5",
                unit("0.1", "12.5"),
                Of::Share,
                "0.9882506722173562060847550814809550063253",
                FOUND
            ),
            ask!(
                "r = 0.2, μ = 12.5",
                unit("0.2", "12.5"),
                Of::Share,
                "0.9809255011535142503975229268032649335432",
                FOUND
            ),
            ask!(
                "r = 0.3, μ = 12.5",
                unit("0.3", "12.5"),
                Of::Share,
                "0.9669032493743898642419920790798618615560",
                FOUND
            ),
        ]
    ),
    claim!(
        "figure-6",
        Reproduced,
        "(4.73), Figure 6",
        "E(t₁)/E(0) at both ends of the figure, c = L = g = 1",
        &[
            ask!("r = 0.1, μ = 3.2", unit("0.1", "3.2"), Of::Left, "0.6600180439305823671000960660760858642292", FOUND),
            ask!("r = 0.2, μ = 3.2", unit("0.2", "3.2"), Of::Left, "0.4337168967167036401874864976123601694293", FOUND),
            ask!(
                "r = 0.1, μ = 12.5",
                unit("0.1", "12.5"),
                Of::Left,
                "0.6700636871273743539547723888783507061359",
                FOUND
            ),
            ask!(
                "r = 0.2, μ = 12.5",
                unit("0.2", "12.5"),
                Of::Left,
                "0.4505741116858087570427272109296256120666",
                FOUND
            ),
            ask!(
                "r = 0.3, μ = 12.5",
                unit("0.3", "12.5"),
                Of::Left,
                "0.3052784117418808003456742702611732470791",
                FOUND
            ),
        ]
    ),
    claim!(
        "figure-7",
        Corrected,
        "Figure 7",
        "\"a common limit (approximately C₀ = 1)\" of E(t₁)/E(0) e^{2rt₁}: three limits, none of them 1",
        &[
            limit!(
                "lim, r = 0.1",
                "0.1",
                Of::Retained,
                "1.000668923858792484851230398489368945625",
                "1 as printed",
                || 1.0,
                4
            ),
            limit!(
                "lim, r = 0.2",
                "0.2",
                Of::Retained,
                "1.005413372756512772887143260672753782987",
                "1 as printed",
                || 1.0,
                3
            ),
            limit!(
                "lim, r = 0.3",
                "0.3",
                Of::Retained,
                "1.018665828692668523986377532213577496259",
                "1 as printed",
                || 1.0,
                2
            ),
        ]
    ),
    claim!(
        "limit-4.74",
        Corrected,
        "(4.74)",
        "lim E_h(t₁)/E(t₁) = 1 for μ → ∞ with damping: it is less",
        &[
            limit!(
                "lim, r = 0.1",
                "0.1",
                Of::Share,
                "0.9999664683750782862671076809725956262541",
                "1 as printed",
                || 1.0,
                5
            ),
            limit!(
                "lim, r = 0.2",
                "0.2",
                Of::Share,
                "0.9994554937046419774530239794316805548268",
                "1 as printed",
                || 1.0,
                4
            ),
            limit!(
                "lim, r = 0.3",
                "0.3",
                Of::Share,
                "0.9971906461777625263748854335280289837672",
                "1 as printed",
                || 1.0,
                3
            ),
        ]
    ),
    claim!(
        "limit-4.75",
        Corrected,
        "(4.75)",
        "lim e_E ≃ e^{−r t_b} for μ → ∞: it is 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}",
        &[
            ask!(
                "lim e_E, r = 0.1",
                limit("0.1"),
                Of::MomentumRestitution,
                "0.8189908101753950340025842145684107343192",
                &[
                    (Plain("e^{−rt₁} as printed", || (-0.2f64).exp()), Less(4)),
                    (Rays, Digits(13)),
                    (Modes, Bound(9)),
                    #[cfg(feature = "mp")]
                    (
                        Long("2e^{−R}(I₀ − I₁) − e^{−2R}", 36, |bits| plain::limit(&plain::decimal(
                            "0.1", bits
                        ))),
                        Digits(36)
                    ),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
            ask!(
                "lim e_E, r = 0.2",
                limit("0.2"),
                Of::MomentumRestitution,
                "0.6719489284101864455547377680263498629966",
                &[
                    (Plain("e^{−rt₁} as printed", || (-0.4f64).exp()), Less(3)),
                    (Rays, Digits(13)),
                    (Modes, Bound(9)),
                    #[cfg(feature = "mp")]
                    (
                        Long("2e^{−R}(I₀ − I₁) − e^{−2R}", 36, |bits| plain::limit(&plain::decimal(
                            "0.2", bits
                        ))),
                        Digits(36)
                    ),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
            ask!(
                "lim e_E, r = 0.3",
                limit("0.3"),
                Of::MomentumRestitution,
                "0.5531313551645510878015469360372618990694",
                &[
                    (Plain("e^{−rt₁} as printed", || (-0.6f64).exp()), Less(3)),
                    (Rays, Digits(13)),
                    (Modes, Bound(9)),
                    #[cfg(feature = "mp")]
                    (
                        Long("2e^{−R}(I₀ − I₁) − e^{−2R}", 36, |bits| plain::limit(&plain::decimal(
                            "0.3", bits
                        ))),
                        Digits(36)
                    ),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
        ]
    ),
];
