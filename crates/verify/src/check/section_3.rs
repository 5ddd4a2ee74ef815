//! Section 3 of the paper: momentum, centre of mass and energies.

use super::case::*;
use super::verdict::Promise::{Bound, Digits, Exact};
use super::verdict::Verdict::{Misprint, Reproduced};
use crate::paper::formulas::{self, integral};
use dalembert::Side;
use dalembert::engine::FirstContact;
use dalembert::number::Answer;
use dalembert::problem::Parameters;
use dalembert::quantity::Quantity::{
    Centre, CentreVelocity, Energy, Strain, Top, TopTime, TranslationalEnergy, TranslationalShare, VibrationalEnergy,
};

const DAMPED: Rod = unit("0.2", "4");
const LATE: Rod = unit("0.1", "1");
/// `t_b` of [`LATE`].
const LATE_END: f64 = 3.449451746579489;
const FAST: Rod = unit("0", "4");
const SLOW: Rod = unit("0", "1");

const EXACT: &[PromisedRoute] = &[PRINTED, (FRACTIONS, Exact), (LATTICE, Digits(13)), (CLOSED, Digits(12)), PROVED];
const EXACT_ENERGY: &[PromisedRoute] =
    &[PRINTED, (FRACTIONS, Exact), (LATTICE, Digits(13)), (CLOSED, Digits(12)), (MODES, Bound(5)), PROVED];
const EXACT_THRESHOLD: &[PromisedRoute] = &[PRINTED, (FRACTIONS, Exact), (LATTICE, Digits(13)), PROVED];
const FLIGHT: &[PromisedRoute] = &[(CLOSED, Bound(12)), (CELLS, Digits(10)), CLOSED_50];
/// Routes as in [`FLIGHT`]; the bound of the height counts the error of `h¹` three times.
const TOP: &[PromisedRoute] = &[(CLOSED, Bound(11)), (CELLS, Digits(10)), CLOSED_50];
const LATE_FLIGHT: &[PromisedRoute] = &[(CLOSED, Bound(9)), (CELLS, Digits(9)), CLOSED_50];
const ENERGY: &[PromisedRoute] = &[(CLOSED, Bound(12)), (MODES, Bound(5)), (CELLS, Digits(10)), CLOSED_50, PROVED];

fn time_of_top() -> f64 {
    formulas::top_time(0.2, 1.0, 2.0, printed(0.2, 4.0).momentum(2.0))
}

fn height_of_top() -> f64 {
    let printed = printed(0.2, 4.0);
    formulas::top_height(0.2, 1.0, printed.centre(2.0), printed.momentum(2.0))
}

/// Computes `E(0) − 2r ∫₀ᵗ∫ v_t² dx dt`, c = L = g = 1, t₁/2 < t < t₁, cut where the ray runs. **Source**: (3.55),
/// integrated; v_t by the closed form.
fn energy_left(damping: f64, speed: f64, time: f64) -> f64 {
    let rod = Parameters { length: 1.0, wave_speed: 1.0, damping, gravity: 1.0, speed };
    let contact = FirstContact::new(&rod.carry());
    let motion = |t: f64| {
        let ray = if t < 1.0 { t } else { 2.0 - t };
        integral([0.0, 1.0], ray, &|x| {
            let velocity = contact.field(&x.carry(), &t.carry(), Side::Right).velocity;
            velocity.value().powi(2)
        })
    };
    0.5 * speed * speed - 2.0 * damping * integral([0.0, time], 1.0, &motion)
}

#[rustfmt::skip]
pub(super) const SECTION_3_1: Group = group("section-3.1", "Section 3.1: momentum and centre of mass",
    "(3.34)–(3.53) and Remark 2. All formulas hold, those for r = 0 in fractions and to the last digit; (3.42) and \
         the sentence after it name the wrong times.", &[
    claim("motion-in-contact", Reproduced, "(3.38), (3.39)", "c = L = g = 1, r = 0.2, μ = 4", &[
        ask("P(1.3)", DAMPED, CentreVelocity, "0.8171461858116488478511749489110060673511", CONTACT).at("1.3")
            .by("(3.38) by quadrature", 11, || printed(0.2, 4.0).momentum(1.3)),
        ask("h(1.3)", DAMPED, Centre, "-1.839128359296928791061499563155118710307", CONTACT).at("1.3")
            .by("(3.39) by quadrature", 11, || printed(0.2, 4.0).centre(1.3)),
    ]),
    claim("motion-in-flight", Reproduced, "(3.43)–(3.45)", "the same after t_b = 2", &[
        ask("P(3)", DAMPED, CentreVelocity, "0.9714201843421907120951441066921296004848", FLIGHT).at("3")
            .by("(3.43)", 11, || printed(0.2, 4.0).flight_momentum(2.0, 3.0)),
        ask("h(3)", DAMPED, Centre, "1.176166532822276666688664970606027952153", FLIGHT).at("3")
            .by("(3.44)", 10, || printed(0.2, 4.0).flight_centre(2.0, 3.0)),
    ]),
    claim("initial-data-3.42", Misprint, "(3.42)",
        "initial data of the flight are given at t₁; t_b is meant: c = L = g = μ = 1, r = 0.1, where t_b > t₁", &[
        ask("h(3.5)", LATE, Centre, "0.08333350929468396681662492989641095112958", LATE_FLIGHT).at("3.5")
            .breaks("(3.44) from t₁ on", 2, || printed(0.1, 1.0).flight_centre(2.0, 3.5))
            .by("(3.44) from t_b on", 9, || printed(0.1, 1.0).flight_centre(LATE_END, 3.5)),
    ]),
    claim("stress-free-3.42", Misprint, "after (3.42)",
        "\"Ψ_r = 0 on (t₁, t_b)\": the rod is pressed to the ground there; (t_b, t₂) is meant", &[
        ask("v_x(0, 2.5)", LATE, Strain, "-0.6467207086033466335609605663018219594747", CONTACT).at("2.5")
            .breaks("0 as printed", 1, || 0.0)
            .by("(2.28) by quadrature", 11, || printed(0.1, 1.0).strain(2.5)),
    ]),
    claim("undamped-fast", Reproduced, "(3.47)–(3.51)", "r = 0, c = L = g = 1, μ = 4 ≥ g t₁", &[
        ask("P(1/3)", FAST, CentreVelocity, "-53/18", EXACT).at("1/3"),
        ask("h(1/3)", FAST, Centre, "-94/81", EXACT).at("1/3"),
        ask("h⁰ = −2gL²/3c²", FAST, Centre, "-2/3", EXACT),
        ask("h¹ = μ", FAST, CentreVelocity, "4", EXACT),
        ask("P(3)", FAST, CentreVelocity, "3", EXACT).at("3"),
        ask("h(3)", FAST, Centre, "17/6", EXACT).at("3"),
    ]),
    claim("undamped-slow", Reproduced, "(3.52), (3.53)", "r = 0, c = L = g = μ = 1 < g t₁: t_b = 3", &[
        ask("P(1/3)", SLOW, CentreVelocity, "-17/18", EXACT).at("1/3"),
        ask("P(5/2)", SLOW, CentreVelocity, "7/8", EXACT).at("5/2"),
        ask("h(5/2)", SLOW, Centre, "-3/16", EXACT).at("5/2"),
        ask("P(4)", SLOW, CentreVelocity, "-1/2", EXACT).at("4"),
        ask("h(4)", SLOW, Centre, "1/6", EXACT).at("4"),
    ]),
    claim("remark-2", Reproduced, "Remark 2", "the top of the flight, c = L = g = 1", &[
        ask("t*, r = 0, μ = 4", FAST, TopTime, "6", EXACT),
        ask("h_max, r = 0, μ = 4", FAST, Top, "22/3", EXACT),
        ask("t*, r = 0, μ = 1", SLOW, TopTime, "7/2", EXACT),
        ask("h_max, r = 0, μ = 1", SLOW, Top, "7/24", EXACT),
        ask("t*, r = 0.2, μ = 4", DAMPED, TopTime, "3.820682633452505008314153800573278405844", FLIGHT)
            .by("Remark 2, h¹ by quadrature", 11, time_of_top),
        ask("h_max, r = 0.2, μ = 4", DAMPED, Top, "1.553010410046490926141140735903155938755", TOP)
            .by("Remark 2, h⁰ and h¹ by quadrature", 10, height_of_top),
    ]),
]);

#[rustfmt::skip]
pub(super) const SECTION_3_2: Group = group("section-3.2", "Section 3.2: energies",
    "(3.54)–(3.70), Theorem 2, Figures 2 and 3. All formulas hold, in fractions where r = 0.", &[
    claim("dissipation", Reproduced, "(3.54), (3.55)", "what damping takes: c = L = g = 1, r = 0.2, μ = 4", &[
        ask("E(1.3)", DAMPED, Energy, "4.920216049911451993140911184453031949254", ENERGY).at("1.3")
            .by("E(0) − 2r∬v_t² by quadrature", 12, || energy_left(0.2, 4.0, 1.3)),
    ]),
    claim("decomposition", Reproduced, "(3.61)–(3.63)", "the same rod when it leaves: E = E_h + E_z", &[
        ask("E(t_b)", DAMPED, Energy, "3.521671769990876420804814544196481285541", ENERGY),
        ask("E_h(t_b)", DAMPED, TranslationalEnergy, "2.995692840509782112514328089675433079229", ENERGY),
        ask("E_z(t_b)", DAMPED, VibrationalEnergy, "0.5259789294810943082904864545210482063125", ENERGY),
    ]),
    claim("undamped-energy", Reproduced, "(3.66)–(3.68)", "r = 0, c = L = g = 1", &[
        ask("E = μ²L/2, μ = 4", FAST, Energy, "8", EXACT_ENERGY).at("1/3"),
        ask("E_h(1/3), μ = 4", FAST, TranslationalEnergy, "2057/648", EXACT_ENERGY).at("1/3"),
        ask("E_h(t_b), μ = 4", FAST, TranslationalEnergy, "22/3", EXACT_ENERGY),
        ask("E_h(5/2), μ = 1", SLOW, TranslationalEnergy, "25/128", EXACT_ENERGY).at("5/2"),
        ask("E_h(t_b), μ = 1", SLOW, TranslationalEnergy, "7/24", EXACT_ENERGY),
    ]),
    claim("theorem-2", Reproduced, "Theorem 2, Figures 2 and 3",
        "E_z(t_b), r = 0, c = L = g = 1; the red dot is at μ = μ₀ = 2", &[
        ask("E_z, μ = 1", SLOW, VibrationalEnergy, "5/24", EXACT_ENERGY),
        ask("E_z, μ = 4/3", unit("0", "4/3"), VibrationalEnergy, "32/81", EXACT_ENERGY),
        ask("E_z, μ = 2", unit("0", "2"), VibrationalEnergy, "2/3", EXACT_THRESHOLD),
        ask("E_z, μ = 10", unit("0", "10"), VibrationalEnergy, "2/3", EXACT_ENERGY),
        ask("E_h/E least, μ = 2μ₀/3", unit("0", "4/3"), TranslationalShare, "5/9", EXACT_ENERGY),
    ]),
]);
