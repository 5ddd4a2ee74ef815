//! Section 2 of the paper: the contact and how it ends.

use super::case::*;
use super::verdict::NO_BOUNCE;
use super::verdict::Promise::{Bound, Digits, Exact};
use super::verdict::Verdict::{Misprint, Reproduced, Settled};
use crate::paper::formulas::{self, Constant};
use crate::routes::Transform;
use dalembert::quantity::Quantity::{BounceTime, PointDisplacement, PointStrain, PointVelocity, Strain};

/// Builds the rod of Figure 1: `g = 0`, `c = t₁ = μ = 1`.
const fn figure_1(damping: &'static str) -> Rod {
    Rod { length: "1/2", ..unit(damping, "1").weightless() }
}

const INSIDE: Rod = unit("0.5", "3");
const JUMPS: Rod = Rod { gravity: "0.6", ..unit("0.4", "1.7") };
const SLOW: Rod = unit("0.1", "1");

/// Routes to values that are small against the speed of the rod.
const SMALL: &[PromisedRoute] = &[(CLOSED, Bound(9)), (MODES, Bound(6)), (CELLS, Digits(7)), CLOSED_50, PROVED];
const JUMP: &[PromisedRoute] = &[(CLOSED, Bound(13)), (MODES, Bound(9)), CLOSED_50];
const BOUNCE: &[PromisedRoute] =
    &[(CLOSED, Digits(9)), (MODES, Digits(9)), (CELLS, Digits(8)), (closed(60), Digits(36)), PROVED];
const UNDAMPED: &[PromisedRoute] =
    &[PRINTED, (FRACTIONS, Exact), (LATTICE, Digits(14)), (CLOSED, Digits(14)), (MODES, Digits(9)), PROVED];
/// Routes at the threshold: two others have no digit to spare there.
const UNDAMPED_THRESHOLD: &[PromisedRoute] = &[PRINTED, (FRACTIONS, Exact), (CLOSED, Digits(14)), PROVED];

#[rustfmt::skip]
pub(super) const SECTION_2: Group = group("section-2", "Section 2: the contact and how it ends",
    "Lemma 1 to Theorem 1 and Figure 1. All formulas hold; I₀ is called by the wrong name; and the question that \
         section 5 leaves open has an answer: the stress need not have a root, with gravity or without.", &[
    claim("bessel", Misprint, "(2.16)",
        "I₀ is called the modified Bessel function of the second kind; it is the first kind", &[
        constant("I₀(2)", "2.279585302336067267437204440811533353286")
            .breaks("K₀, the second kind", 1, || formulas::k0(2.0))
            .by("the integral (2.16)", 14, || formulas::i0(2.0))
            .by("series of the first kind", 14, || formulas::i0_series(2.0))
            .by_digits("first kind", Constant::BesselI0([2, 1])),
    ]),
    claim("proposition-1", Reproduced, "(2.19), (2.22)–(2.24)",
        "displacement, velocity and strain: c = L = g = 1, r = 0.5, μ = 3", &[
        ask("v(0.3, 1.4)", INSIDE, PointDisplacement, "-0.7716282135252858905122492780782575627506", CONTACT)
            .at_point("0.3", "1.4"),
        ask("v_t(0.3, 1.4)", INSIDE, PointVelocity, "0.0007223855825310580081664500092873174252066", SMALL)
            .at_point("0.3", "1.4"),
        ask("v_x(0.3, 1.4)", INSIDE, PointStrain, "-2.427317243447501123991174235476276673384", CONTACT)
            .at_point("0.3", "1.4"),
    ]),
    claim("proposition-2", Reproduced, "Proposition 2",
        "jumps on the rays, times e^{−rt}: c = L = 1, r = 0.4, g = 0.6, μ = 1.7", &[
        ask("[v_x](0, t₁) = 2μe^{−rt₁}/c", JUMPS, Strain, "1.527718477998553410862348109052913506176", JUMP)
            .at("2").transformed(Transform::Jump)
            .by("2μe^{−rt}/c", 14, || 3.4 * (-0.8f64).exp()),
        ask("[v_x](½, ½) = −μe^{−rt}/c", JUMPS, PointStrain, "-1.391842280232569159738890364652367021410", JUMP)
            .at_point("0.5", "0.5").transformed(Transform::Jump)
            .by("(ii) [φ]/2c", 14, || -1.7 * (-0.2f64).exp()),
        ask("[v_t](½, ½) = +μe^{−rt}", JUMPS, PointVelocity, "1.391842280232569159738890364652367021410", JUMP)
            .at_point("0.5", "0.5").transformed(Transform::Jump)
            .by("(ii) −[φ]/2", 14, || 1.7 * (-0.2f64).exp()),
        ask("[v_x](½, 3/2) = +μe^{−rt}/c", JUMPS, PointStrain, "0.9329797813598449354683801592953653880649", JUMP)
            .at_point("0.5", "1.5").transformed(Transform::Jump)
            .by("(i) [φ]/2c", 14, || 1.7 * (-0.6f64).exp()),
        ask("[v_t](1, 1) = 2μe^{−rt}", JUMPS, PointVelocity, "2.279088156521173622531071945502608644586", JUMP)
            .at_point("1", "1").transformed(Transform::Jump)
            .by("(iii) difference of [φ]/2", 14, || 3.4 * (-0.4f64).exp()),
    ]),
    claim("stress", Reproduced, "(2.28)", "the stress at the ground: c = L = g = μ = 1, r = 0.1", &[
        ask("v_x(0, 1.5)", SLOW, Strain, "-2.260992914622576187804116950191671018820", CONTACT).at("1.5")
            .by("(2.28) by quadrature", 12, || printed(0.1, 1.0).strain(1.5)),
        ask("v_x(0, 2.5)", SLOW, Strain, "-0.6467207086033466335609605663018219594747", CONTACT).at("2.5")
            .by("(2.28) by quadrature", 12, || printed(0.1, 1.0).strain(2.5)),
    ]),
    claim("condition-2.31", Reproduced, "(2.31), (2.33)", "r t₁ < I₀⁻¹(2) ≃ 1.8 is necessary for a bounce at t₁", &[
        constant("I₀⁻¹(2)", "1.807896751069102721755315274677652009584")
            .by("1.8 as printed", 2, || 1.8)
            .by("Newton", 14, || Constant::InverseI0Of2.value(&1.0))
            .by_digits("Newton", Constant::InverseI0Of2),
    ]),
    claim("condition-2.32", Reproduced, "(2.32), Figure 4",
        "the least μ that bounces at t₁, c = L = g = 1: the black dots. In closed form μ₀(I₀(R) + I₁(R))/(2 − \
         I₀(R))", &[
        constant("μ, r = 0.1", "2.243543307665501983739440988259595373414")
            .by("(2.32) by quadrature", 13, || printed(0.1, 1.0).threshold())
            .by("in closed form", 13, || Constant::Threshold([1, 10]).value(&1.0))
            .by_digits("in closed form", Constant::Threshold([1, 10])),
        constant("μ, r = 0.2", "2.593644954560194303378189874478860701205")
            .by("(2.32) by quadrature", 13, || printed(0.2, 1.0).threshold())
            .by("in closed form", 13, || Constant::Threshold([2, 10]).value(&1.0))
            .by_digits("in closed form", Constant::Threshold([2, 10])),
        constant("μ, r = 0.3", "3.096518999245653134301389584742651447991")
            .by("(2.32) by quadrature", 13, || printed(0.3, 1.0).threshold())
            .by("in closed form", 13, || Constant::Threshold([3, 10]).value(&1.0))
            .by_digits("in closed form", Constant::Threshold([3, 10])),
    ]),
    claim("corollary-1", Reproduced, "Corollary 1, Remark 1",
        "r = 0, c = L = 1: t_b = t₁ for μ ≥ g t₁, and 2t₁ − μ/g below", &[
        ask("t_b, g = 1, μ = 3", unit("0", "3"), BounceTime, "2", UNDAMPED),
        ask("t_b, g = 1, μ = 2", unit("0", "2"), BounceTime, "2", UNDAMPED_THRESHOLD),
        ask("t_b, g = 1, μ = 3/2", unit("0", "3/2"), BounceTime, "5/2", UNDAMPED),
        ask("t_b, g = 1, μ = 1/7", unit("0", "1/7"), BounceTime, "27/7", UNDAMPED),
        ask("t_b, g = 0, μ = 1", unit("0", "1").weightless(), BounceTime, "2", UNDAMPED),
    ]),
    claim("figure-1", Reproduced, "Theorem 1, Figure 1",
        "g = 0, c = t₁ = μ = 1: dots in the second, third and fourth round trip", &[
        ask("t_b, r = 2.6", figure_1("2.6"), BounceTime, "1.788481033298875451750383805985576233907", BOUNCE),
        ask("t_b, r = 2.9", figure_1("2.9"), BounceTime, "2.553022499313244464898263736352668019062", BOUNCE),
        ask("t_b, r = 3.0", figure_1("3.0"), BounceTime, "3.299026051445772715215013658314402507576", BOUNCE),
    ]),
    claim("open-question", Settled, "Theorem 1 (i), section 5",
        "\"we were not able to prove that Ψ must have a root\": it need not, c = L = 1", &[
        ask("t_b, g = 0, r = 1.6", unit("1.6", "1").weightless(), BounceTime, NO_BOUNCE, NEVER),
        ask("t_b, g = 1, r = 1, μ = 1", unit("1", "1"), BounceTime, NO_BOUNCE, NEVER),
        ask("t_b, g = 1, r = 5, μ = 100", unit("5", "100"), BounceTime, NO_BOUNCE, NEVER),
    ]),
]);
