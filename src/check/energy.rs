//! Section 3.2 of the paper: energies.

use super::Promise::{Bound, Digits, Enclosed, Exact};
use super::Route::{Cells, Enclosures, Fractions, Lattice, LongRays, Modes, Paper, Plain, Rays};
use super::plain;
use super::routes::{AT_BOUNCE, Of, Rod, Route};
use super::{Case, Group, Promise, Question, Verdict};

const fn unit(damping: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity: "1", speed, until: "" }
}

const DAMPED: Rod = unit("0.2", "4");

const EXACT: &[(Route, Promise)] = &[
    (Paper, Exact),
    (Fractions, Exact),
    (Lattice, Digits(13)),
    (Rays, Digits(12)),
    (Modes, Bound(5)),
    (Enclosures(36), Enclosed(36)),
];
const FOUND: &[(Route, Promise)] = &[
    (Rays, Bound(12)),
    (Modes, Bound(5)),
    (Cells, Digits(10)),
    (LongRays(50), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];

macro_rules! ask {
    ($what:literal, $rod:expr, $of:expr, $truth:expr, $routes:expr) => {
        Question { what: $what, rod: $rod, of: $of, truth: $truth, routes: $routes }
    };
}

macro_rules! claim {
    ($name:literal, $source:literal, $about:literal, $questions:expr) => {
        Case {
            name: $name,
            group: Group::Energy,
            source: $source,
            about: $about,
            verdict: Verdict::Reproduced,
            questions: $questions,
        }
    };
}

pub(super) const CASES: &[Case] = &[
    claim!(
        "dissipation",
        "(3.54), (3.55)",
        "what damping takes: c = L = g = 1, r = 0.2, μ = 4",
        &[ask!(
            "E(1.3)",
            DAMPED,
            Of::Energy("1.3"),
            "4.920216049911451993140911184453031949254",
            &[
                (
                    Plain("E(0) − 2r∬v_t² by quadrature", || plain::energy_left(&plain::rod(0.2, 1.0, 4.0), 1.3)),
                    Digits(12)
                ),
                (Rays, Bound(12)),
                (Modes, Bound(5)),
                (Cells, Digits(10)),
                (LongRays(50), Digits(36)),
                (Enclosures(36), Enclosed(36)),
            ]
        )]
    ),
    claim!(
        "decomposition",
        "(3.61)–(3.63)",
        "the same rod when it leaves: E = E_h + E_z",
        &[
            ask!("E(t_b)", DAMPED, Of::Energy(AT_BOUNCE), "3.521671769990876420804814544196481285541", FOUND),
            ask!("E_h(t_b)", DAMPED, Of::Translational(AT_BOUNCE), "2.995692840509782112514328089675433079229", FOUND),
            ask!("E_z(t_b)", DAMPED, Of::Vibrational(AT_BOUNCE), "0.5259789294810943082904864545210482063125", FOUND),
        ]
    ),
    claim!(
        "undamped-energy",
        "(3.66)–(3.68)",
        "r = 0, c = L = g = 1",
        &[
            ask!("E = μ²L/2, μ = 4", unit("0", "4"), Of::Energy("1/3"), "8", EXACT),
            ask!("E_h(1/3), μ = 4", unit("0", "4"), Of::Translational("1/3"), "2057/648", EXACT),
            ask!("E_h(t_b), μ = 4", unit("0", "4"), Of::Translational(AT_BOUNCE), "22/3", EXACT),
            ask!("E_h(5/2), μ = 1", unit("0", "1"), Of::Translational("5/2"), "25/128", EXACT),
            ask!("E_h(t_b), μ = 1", unit("0", "1"), Of::Translational(AT_BOUNCE), "7/24", EXACT),
        ]
    ),
    claim!(
        "theorem-2",
        "Theorem 2, Figures 2 and 3",
        "E_z(t_b), r = 0, c = L = g = 1; the red dot is at μ = μ₀ = 2",
        &[
            ask!("E_z, μ = 1", unit("0", "1"), Of::Vibrational(AT_BOUNCE), "5/24", EXACT),
            ask!("E_z, μ = 4/3", unit("0", "4/3"), Of::Vibrational(AT_BOUNCE), "32/81", EXACT),
            ask!(
                "E_z, μ = 2",
                unit("0", "2"),
                Of::Vibrational(AT_BOUNCE),
                "2/3",
                &[(Paper, Exact), (Fractions, Exact), (Lattice, Digits(13)), (Enclosures(36), Enclosed(36)),]
            ),
            ask!("E_z, μ = 10", unit("0", "10"), Of::Vibrational(AT_BOUNCE), "2/3", EXACT),
            ask!("E_h/E least, μ = 2μ₀/3", unit("0", "4/3"), Of::Share, "5/9", EXACT),
        ]
    ),
];
