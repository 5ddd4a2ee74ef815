//! Section 4 of the paper: coefficients of restitution.

use super::case::*;
use super::verdict::Promise::{Bound, Digits, Exact};
use super::verdict::Verdict::{Corrected, Reproduced, Settled};
use crate::paper::formulas::Constant;
use crate::routes::Transform;
use dalembert::quantity::Quantity::{
    BounceTime, EnergyKept, EnergyRestitution, MomentumRestitution, TranslationalShare,
};

/// Builds the rod of the limit μ → ∞, in which gravity has no share.
const fn limit(damping: &'static str) -> Rod {
    unit(damping, "1").weightless()
}

const LEFT_1: Rod = unit("0.1", "1.5");
const LEFT_2: Rod = unit("0.2", "2.5");
const LEFT_3: Rod = unit("0.3", "3");
const LOW_1: Rod = unit("0.1", "3.2");
const LOW_2: Rod = unit("0.2", "3.2");
const HIGH_1: Rod = unit("0.1", "12.5");
const HIGH_2: Rod = unit("0.2", "12.5");
const HIGH_3: Rod = unit("0.3", "12.5");

const EXACT: &[PromisedRoute] =
    &[PRINTED, (FRACTIONS, Exact), (LATTICE, Digits(13)), (CLOSED, Digits(12)), (MODES, Digits(9)), PROVED];
const AT_T1: &[PromisedRoute] = &[(CLOSED, Digits(12)), (MODES, Bound(4)), (CELLS, Digits(10)), CLOSED_50, PROVED];
const AFTER_T1: &[PromisedRoute] = &[(CLOSED, Digits(9)), (MODES, Digits(9)), (CELLS, Digits(9)), CLOSED_50, PROVED];
const FACTOR: &[PromisedRoute] = &[(CLOSED, Digits(13)), (MODES, Bound(5)), CLOSED_50];
const LIMIT: &[PromisedRoute] = &[(CLOSED, Digits(13)), (MODES, Bound(9)), PROVED];
const FAR: &[PromisedRoute] = &[(CLOSED, Digits(10)), (MODES, Bound(4)), (CELLS, Digits(8)), CLOSED_50, PROVED];
const CLOSED_LIMIT: &str = "2e^{−R}(I₀ − I₁) − e^{−2R}";
const EXPONENTIAL: &str = "e^{−rt₁} as printed";
const WITHIN: &str = "0.001, the bound as printed";

#[rustfmt::skip]
pub(super) const SECTION_4: Group = group("section-4", "Section 4: coefficients of restitution",
    "(4.71)–(4.75), Figures 4 to 7. (4.71)–(4.73) hold. The limits (4.74) and (4.75) were read off graphs and are not \
         the limits: for t_b = t₁ and μ → ∞, exactly e_E → 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}, which is e^{−R}(1 + \
         R³/24 + …), R = r t₁. Nor do the curves come within 0.001 of e^{−R}, as is said after (4.75). Figure 4 goes \
         on to the left of its dots.", &[
    claim("momentum-restitution", Reproduced, "section 4.1", "r = 0, c = L = g = 1: e_P = min(1, μ/μ₀)", &[
        ask("e_P, μ = 1", unit("0", "1"), MomentumRestitution, "1/2", EXACT),
        ask("e_P, μ = 4", unit("0", "4"), MomentumRestitution, "1", EXACT),
    ]),
    claim("energy-restitution", Reproduced, "(4.71), (4.72)",
        "r = 0, c = L = g = 1: e_E² is least, 5/9, at μ = 2μ₀/3", &[
        ask("e_E², μ = 1", unit("0", "1"), EnergyRestitution, "7/12", EXACT),
        ask("e_E², μ = 4/3", unit("0", "4/3"), EnergyRestitution, "5/9", EXACT),
        ask("e_E², μ = 4", unit("0", "4"), EnergyRestitution, "11/12", EXACT),
    ]),
    claim("figure-4", Reproduced, "Figure 4", "right of the black dots, where t_b = t₁: c = L = g = 1, μ = 5", &[
        ask("e_E², r = 0.1", unit("0.1", "5"), EnergyRestitution, "0.6202643084571624744481581489946464573244", AT_T1),
        ask("e_E², r = 0.2", unit("0.2", "5"), EnergyRestitution, "0.4009910890774769182960221839814290930402", AT_T1),
        ask("e_E², r = 0.3", unit("0.3", "5"), EnergyRestitution, "0.2543430950994055877566630527867066799152", AT_T1),
    ]),
    claim("figure-4-left", Settled, "Figure 4",
        "left of the black dots, \"significantly more difficult to compute\": t_b > t₁", &[
        ask("t_b, r = 0.1, μ = 1.5", LEFT_1, BounceTime, "2.890460729168262502823395495175424806531", AFTER_T1),
        ask("e_E², r = 0.1, μ = 1.5", LEFT_1, EnergyRestitution,
            "0.2335750046778280457751702821069789771300", AFTER_T1),
        ask("t_b, r = 0.2, μ = 2.5", LEFT_2, BounceTime, "2.156471888994680717981496360752384213616", AFTER_T1),
        ask("e_E², r = 0.2, μ = 2.5", LEFT_2, EnergyRestitution,
            "0.2159298868555963713812142673621205898860", AFTER_T1),
        ask("t_b, r = 0.3, μ = 3", LEFT_3, BounceTime, "2.247803899311644297247506322698188832420", AFTER_T1),
        ask("e_E², r = 0.3, μ = 3", LEFT_3, EnergyRestitution,
            "0.1098071999264657941087776090813272541222", AFTER_T1),
    ]),
    claim("figure-5", Reproduced, "(4.73), Figure 5", "E_h(t₁)/E(t₁) at both ends of the figure, c = L = g = 1", &[
        ask("r = 0.1, μ = 3.2", LOW_1, TranslationalShare, "0.8321745695016716858485197047301930231483", AT_T1),
        ask("r = 0.2, μ = 3.2", LOW_2, TranslationalShare, "0.7688930123499804751285252658343325816632", AT_T1),
        ask("r = 0.1, μ = 12.5", HIGH_1, TranslationalShare, "0.9882506722173562060847550814809550063253", AT_T1),
        ask("r = 0.2, μ = 12.5", HIGH_2, TranslationalShare, "0.9809255011535142503975229268032649335432", AT_T1),
        ask("r = 0.3, μ = 12.5", HIGH_3, TranslationalShare, "0.9669032493743898642419920790798618615560", AT_T1),
    ]),
    claim("figure-6", Reproduced, "(4.73), Figure 6", "E(t₁)/E(0) at both ends of the figure, c = L = g = 1", &[
        ask("r = 0.1, μ = 3.2", LOW_1, EnergyKept, "0.6600180439305823671000960660760858642292", AT_T1),
        ask("r = 0.2, μ = 3.2", LOW_2, EnergyKept, "0.4337168967167036401874864976123601694293", AT_T1),
        ask("r = 0.1, μ = 12.5", HIGH_1, EnergyKept, "0.6700636871273743539547723888783507061359", AT_T1),
        ask("r = 0.2, μ = 12.5", HIGH_2, EnergyKept, "0.4505741116858087570427272109296256120666", AT_T1),
        ask("r = 0.3, μ = 12.5", HIGH_3, EnergyKept, "0.3052784117418808003456742702611732470791", AT_T1),
    ]),
    claim("figure-7", Corrected, "Figure 7",
        "\"a common limit (approximately C₀ = 1)\" of E(t₁)/E(0) e^{2rt₁}: three limits, none of them 1", &[
        ask("lim, r = 0.1", limit("0.1"), EnergyKept, "1.000668923858792484851230398489368945625", FACTOR)
            .transformed(Transform::TimesGrowth).breaks("1 as printed", 4, || 1.0),
        ask("lim, r = 0.2", limit("0.2"), EnergyKept, "1.005413372756512772887143260672753782987", FACTOR)
            .transformed(Transform::TimesGrowth).breaks("1 as printed", 3, || 1.0),
        ask("lim, r = 0.3", limit("0.3"), EnergyKept, "1.018665828692668523986377532213577496259", FACTOR)
            .transformed(Transform::TimesGrowth).breaks("1 as printed", 2, || 1.0),
    ]),
    claim("limit-4.74", Corrected, "(4.74)", "lim E_h(t₁)/E(t₁) = 1 for μ → ∞ with damping: it is less", &[
        ask("lim, r = 0.1", limit("0.1"), TranslationalShare, "0.9999664683750782862671076809725956262541", FACTOR)
            .breaks("1 as printed", 5, || 1.0),
        ask("lim, r = 0.2", limit("0.2"), TranslationalShare, "0.9994554937046419774530239794316805548268", FACTOR)
            .breaks("1 as printed", 4, || 1.0),
        ask("lim, r = 0.3", limit("0.3"), TranslationalShare, "0.9971906461777625263748854335280289837672", FACTOR)
            .breaks("1 as printed", 3, || 1.0),
    ]),
    claim("limit-4.75", Corrected, "(4.75)",
        "lim e_E ≃ e^{−r t_b} for μ → ∞: it is 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}", &[
        ask("lim e_E, r = 0.1", limit("0.1"), MomentumRestitution, "0.8189908101753950340025842145684107343192", LIMIT)
            .breaks(EXPONENTIAL, 4, || (-0.2f64).exp())
            .by_digits(CLOSED_LIMIT, Constant::RestitutionLimit([1, 10])),
        ask("lim e_E, r = 0.2", limit("0.2"), MomentumRestitution, "0.6719489284101864455547377680263498629966", LIMIT)
            .breaks(EXPONENTIAL, 3, || (-0.4f64).exp())
            .by_digits(CLOSED_LIMIT, Constant::RestitutionLimit([2, 10])),
        ask("lim e_E, r = 0.3", limit("0.3"), MomentumRestitution, "0.5531313551645510878015469360372618990694", LIMIT)
            .breaks(EXPONENTIAL, 3, || (-0.6f64).exp())
            .by_digits(CLOSED_LIMIT, Constant::RestitutionLimit([3, 10])),
    ]),
    claim("within-0.001", Corrected, "after (4.75)",
        "\"verify this numerically … to within 0.001 for each curve\": at the right ends of Figures 5 to 7, μ = \
         12.5, the curves are five times as far from e^{−rt₁}", &[
        ask("e_E − e^{−rt₁}, r = 0.1", HIGH_1, EnergyRestitution, "-0.004979630662738762029319588014749494820138", FAR)
            .transformed(Transform::RootMinusDecay).breaks(WITHIN, 1, || -0.001),
        ask("e_E − e^{−rt₁}, r = 0.2", HIGH_2, EnergyRestitution, "-0.005504555608256541947969599758874854269478", FAR)
            .transformed(Transform::RootMinusDecay).breaks(WITHIN, 1, || -0.001),
        ask("e_E − e^{−rt₁}, r = 0.3", HIGH_3, EnergyRestitution, "-0.005511821740038788683030255217195912212474", FAR)
            .transformed(Transform::RootMinusDecay).breaks(WITHIN, 1, || -0.001),
    ]),
]);
