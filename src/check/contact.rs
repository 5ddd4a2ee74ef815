//! Section 2 of the paper: the contact and how it ends.

use super::Promise::{Bound, Digits, Enclosed, Exact, Less};
#[cfg(feature = "mp")]
use super::Route::Long;
use super::Route::{Cells, Enclosures, Fractions, Lattice, LongRays, Modes, Paper, Plain, Rays, Within};
use super::routes::{Of, Rod, Route};
use super::value::NO_BOUNCE;
use super::{Case, Group, Promise, Question, Verdict, plain};
use crate::history::Side;

const fn unit(damping: &'static str, gravity: &'static str, speed: &'static str) -> Rod {
    Rod { length: "1", wave_speed: "1", damping, gravity, speed, until: "" }
}

/// g = 0, c = t₁ = μ = 1.
const fn figure_1(damping: &'static str) -> Rod {
    Rod { length: "1/2", wave_speed: "1", damping, gravity: "0", speed: "1", until: "" }
}

const NO_ROD: Rod = unit("0", "0", "1");
const INSIDE: Rod = unit("0.5", "1", "3");
const JUMPS: Rod = unit("0.4", "0.6", "1.7");

const FIELD: &[(Route, Promise)] = &[
    (Rays, Bound(12)),
    (Modes, Bound(9)),
    (Cells, Digits(10)),
    (LongRays(50), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];
/// A value that is small against the speed of the rod.
const SMALL_FIELD: &[(Route, Promise)] = &[
    (Rays, Bound(9)),
    (Modes, Bound(6)),
    (Cells, Digits(7)),
    (LongRays(50), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];
const BOUNCE: &[(Route, Promise)] = &[
    (Rays, Digits(9)),
    (Modes, Digits(9)),
    (Cells, Digits(8)),
    (LongRays(60), Digits(36)),
    (Enclosures(36), Enclosed(36)),
];
const UNDAMPED: &[(Route, Promise)] = &[
    (Paper, Exact),
    (Fractions, Exact),
    (Lattice, Digits(14)),
    (Rays, Digits(14)),
    (Modes, Digits(9)),
    (Enclosures(36), Enclosed(36)),
];
const NEVER: &[(Route, Promise)] =
    &[(Rays, Digits(0)), (Within(1e-12), Digits(0)), (LongRays(50), Digits(0)), (Enclosures(36), Digits(0))];

macro_rules! ask {
    ($what:literal, $rod:expr, $of:expr, $truth:expr, $routes:expr) => {
        Question { what: $what, rod: $rod, of: $of, truth: $truth, routes: $routes }
    };
}

macro_rules! claim {
    ($name:literal, $verdict:ident, $source:literal, $about:literal, $questions:expr) => {
        Case {
            name: $name,
            group: Group::Contact,
            source: $source,
            about: $about,
            verdict: Verdict::$verdict,
            questions: $questions,
        }
    };
}

pub(super) const CASES: &[Case] = &[
    claim!(
        "bessel",
        Misprint,
        "(2.16)",
        "I₀ is called the modified Bessel function of the second kind; it is the first kind",
        &[ask!(
            "I₀(2)",
            NO_ROD,
            Of::Constant,
            "2.279585302336067267437204440811533353286",
            &[
                (Plain("K₀, the second kind", || plain::second_kind(2.0)), Less(1)),
                (Plain("the integral (2.16)", || plain::bessel_integral(2.0)), Digits(14)),
                (Plain("series of the first kind", || plain::bessel(0, 2.0)), Digits(14)),
                #[cfg(feature = "mp")]
                (
                    Long("first kind", 36, |bits| {
                        let two = rug::Float::with_val(bits, 2);
                        crate::special::i0_scaled(&two) * two.exp()
                    }),
                    Digits(36),
                ),
            ]
        )]
    ),
    claim!(
        "proposition-1",
        Reproduced,
        "(2.19), (2.22)–(2.24)",
        "displacement, velocity and strain: c = L = g = 1, r = 0.5, μ = 3",
        &[
            ask!(
                "v(0.3, 1.4)",
                INSIDE,
                Of::Displacement("0.3", "1.4"),
                "-0.7716282135252858905122492780782575627506",
                FIELD
            ),
            ask!(
                "v_t(0.3, 1.4)",
                INSIDE,
                Of::Velocity("0.3", "1.4", Side::Right),
                "0.0007223855825310580081664500092873174252066",
                SMALL_FIELD
            ),
            ask!(
                "v_x(0.3, 1.4)",
                INSIDE,
                Of::Strain("0.3", "1.4", Side::Right),
                "-2.427317243447501123991174235476276673384",
                FIELD
            ),
        ]
    ),
    claim!(
        "proposition-2",
        Reproduced,
        "Proposition 2",
        "jumps on the rays, times e^{−rt}: c = L = 1, r = 0.4, g = 0.6, μ = 1.7",
        &[
            ask!(
                "[v_x](0, t₁) = 2μe^{−rt₁}/c",
                JUMPS,
                Of::StressJump("2"),
                "1.527718477998553410862348109052913506176",
                &[
                    (Plain("2μe^{−rt}/c", || 3.4 * (-0.8f64).exp()), Digits(14)),
                    (Rays, Bound(13)),
                    (Modes, Bound(9)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "[v_x](½, ½) = −μe^{−rt}/c",
                JUMPS,
                Of::StrainJump("0.5", "0.5"),
                "-1.391842280232569159738890364652367021410",
                &[
                    (Plain("(ii) [φ]/2c", || -1.7 * (-0.2f64).exp()), Digits(14)),
                    (Rays, Bound(13)),
                    (Modes, Bound(9)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "[v_t](½, ½) = +μe^{−rt}",
                JUMPS,
                Of::VelocityJump("0.5", "0.5"),
                "1.391842280232569159738890364652367021410",
                &[
                    (Plain("(ii) −[φ]/2", || 1.7 * (-0.2f64).exp()), Digits(14)),
                    (Rays, Bound(13)),
                    (Modes, Bound(9)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "[v_x](½, 3/2) = +μe^{−rt}/c",
                JUMPS,
                Of::StrainJump("0.5", "1.5"),
                "0.9329797813598449354683801592953653880649",
                &[
                    (Plain("(i) [φ]/2c", || 1.7 * (-0.6f64).exp()), Digits(14)),
                    (Rays, Bound(13)),
                    (Modes, Bound(9)),
                    (LongRays(50), Digits(36)),
                ]
            ),
            ask!(
                "[v_t](1, 1) = 2μe^{−rt}",
                JUMPS,
                Of::VelocityJump("1", "1"),
                "2.279088156521173622531071945502608644586",
                &[
                    (Plain("(iii) difference of [φ]/2", || 3.4 * (-0.4f64).exp()), Digits(14)),
                    (Rays, Bound(13)),
                    (Modes, Bound(9)),
                    (LongRays(50), Digits(36)),
                ]
            ),
        ]
    ),
    claim!(
        "stress",
        Reproduced,
        "(2.28)",
        "the stress at the ground: c = L = g = μ = 1, r = 0.1",
        &[
            ask!(
                "v_x(0, 1.5)",
                unit("0.1", "1", "1"),
                Of::Stress("1.5", Side::Right),
                "-2.260992914622576187804116950191671018820",
                &[
                    (
                        Plain("(2.28) by quadrature", || plain::Printed { r: 0.1, g: 1.0, mu: 1.0 }.stress(1.5)),
                        Digits(12)
                    ),
                    (Rays, Bound(12)),
                    (Modes, Bound(9)),
                    (Cells, Digits(10)),
                    (LongRays(50), Digits(36)),
                    (Enclosures(36), Enclosed(36)),
                ]
            ),
            ask!(
                "v_x(0, 2.5)",
                unit("0.1", "1", "1"),
                Of::Stress("2.5", Side::Right),
                "-0.6467207086033466335609605663018219594747",
                &[
                    (
                        Plain("(2.28) by quadrature", || plain::Printed { r: 0.1, g: 1.0, mu: 1.0 }.stress(2.5)),
                        Digits(12)
                    ),
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
        "condition-2.31",
        Reproduced,
        "(2.31), (2.33)",
        "r t₁ < I₀⁻¹(2) ≃ 1.8 is necessary for a bounce at t₁",
        &[ask!(
            "I₀⁻¹(2)",
            NO_ROD,
            Of::Constant,
            "1.807896751069102721755315274677652009584",
            &[
                (Plain("1.8 as printed", || 1.8), Digits(2)),
                (Plain("Newton", || plain::inverse_bessel(&1.0)), Digits(14)),
                #[cfg(feature = "mp")]
                (Long("Newton", 36, |bits| plain::inverse_bessel(&rug::Float::with_val(bits, 1))), Digits(36)),
            ]
        )]
    ),
    claim!(
        "condition-2.32",
        Reproduced,
        "(2.32), Figure 4",
        "the least μ that bounces at t₁, c = L = g = 1: the black dots. In closed form μ₀(I₀(R) + I₁(R))/(2 − I₀(R))",
        &[
            ask!(
                "μ, r = 0.1",
                unit("0.1", "1", "1"),
                Of::Constant,
                "2.243543307665501983739440988259595373414",
                &[
                    (Plain("(2.32) by quadrature", || plain::Printed::threshold(0.1)), Digits(13)),
                    (Plain("in closed form", || plain::threshold(&0.1)), Digits(13)),
                    #[cfg(feature = "mp")]
                    (Long("in closed form", 36, |bits| plain::threshold(&plain::decimal("0.1", bits))), Digits(36)),
                ]
            ),
            ask!(
                "μ, r = 0.2",
                unit("0.2", "1", "1"),
                Of::Constant,
                "2.593644954560194303378189874478860701205",
                &[
                    (Plain("(2.32) by quadrature", || plain::Printed::threshold(0.2)), Digits(13)),
                    (Plain("in closed form", || plain::threshold(&0.2)), Digits(13)),
                    #[cfg(feature = "mp")]
                    (Long("in closed form", 36, |bits| plain::threshold(&plain::decimal("0.2", bits))), Digits(36)),
                ]
            ),
            ask!(
                "μ, r = 0.3",
                unit("0.3", "1", "1"),
                Of::Constant,
                "3.096518999245653134301389584742651447991",
                &[
                    (Plain("(2.32) by quadrature", || plain::Printed::threshold(0.3)), Digits(13)),
                    (Plain("in closed form", || plain::threshold(&0.3)), Digits(13)),
                    #[cfg(feature = "mp")]
                    (Long("in closed form", 36, |bits| plain::threshold(&plain::decimal("0.3", bits))), Digits(36)),
                ]
            ),
        ]
    ),
    claim!(
        "corollary-1",
        Reproduced,
        "Corollary 1, Remark 1",
        "r = 0, c = L = 1: t_b = t₁ for μ ≥ g t₁, and 2t₁ − μ/g below",
        &[
            ask!("t_b, g = 1, μ = 3", unit("0", "1", "3"), Of::Bounce, "2", UNDAMPED),
            ask!(
                "t_b, g = 1, μ = 2",
                unit("0", "1", "2"),
                Of::Bounce,
                "2",
                &[(Paper, Exact), (Fractions, Exact), (Rays, Digits(14)), (Enclosures(36), Enclosed(36)),]
            ),
            ask!("t_b, g = 1, μ = 3/2", unit("0", "1", "3/2"), Of::Bounce, "5/2", UNDAMPED),
            ask!("t_b, g = 1, μ = 1/7", unit("0", "1", "1/7"), Of::Bounce, "27/7", UNDAMPED),
            ask!("t_b, g = 0, μ = 1", unit("0", "0", "1"), Of::Bounce, "2", UNDAMPED),
        ]
    ),
    claim!(
        "figure-1",
        Reproduced,
        "Theorem 1, Figure 1",
        "g = 0, c = t₁ = μ = 1: dots in the second, third and fourth round trip",
        &[
            ask!("t_b, r = 2.6", figure_1("2.6"), Of::Bounce, "1.788481033298875451750383805985576233907", BOUNCE),
            ask!("t_b, r = 2.9", figure_1("2.9"), Of::Bounce, "2.553022499313244464898263736352668019062", BOUNCE),
            ask!("t_b, r = 3.0", figure_1("3.0"), Of::Bounce, "3.299026051445772715215013658314402507576", BOUNCE),
        ]
    ),
    claim!(
        "open-question",
        Settled,
        "Theorem 1 (i), section 5",
        "\"we were not able to prove that Ψ must have a root\": it need not, c = L = 1",
        &[
            ask!("t_b, g = 0, r = 1.6", unit("1.6", "0", "1"), Of::Bounce, NO_BOUNCE, NEVER),
            ask!("t_b, g = 1, r = 1, μ = 1", unit("1", "1", "1"), Of::Bounce, NO_BOUNCE, NEVER),
            ask!("t_b, g = 1, r = 5, μ = 100", unit("5", "1", "100"), Of::Bounce, NO_BOUNCE, NEVER),
        ]
    ),
];
