//! The figures of the paper from its parameters: their list, and the numbers of each.

mod data;

pub use data::{DAMPINGS, FigureData, HELD_DAMPINGS, Limits, threshold_speed};

/// A figure of the paper, or one that is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The name on the command line: `4`.
    pub name: &'static str,
    /// The subject.
    pub kind: FigureKind,
    /// The content, in a sentence.
    pub shown: &'static str,
    /// The correction or addition, in a sentence.
    pub corrected: &'static str,
}

/// The subject of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureKind {
    /// Figure 1: the strain at the ground times e^(rt), if the end were held.
    HeldStress,
    /// Figure 2: the vibrational energy at the bounce.
    VibrationalEnergy,
    /// Figure 3: the shares of both energies at the bounce.
    EnergyShares,
    /// Figure 4: `e_E²`.
    Restitution,
    /// Figure 5: `E_h(t₁)/E(t₁)`.
    TranslationalShare,
    /// Figure 6: `E(t₁)/E(0)`.
    EnergyKept,
    /// Figure 7: `E(t₁)/E(0)`, divided by `e^{−2rt₁}`.
    EnergyOverDecay,
    /// Figure 8: the regions of the integrals.
    IntegrationRegions,
    /// The map of regimes.
    Regimes,
    /// `e_E²` of the tenth bounce.
    TenthBounce,
}

/// All figures, in the order in which they are shown.
pub const FIGURES: [Figure; 10] = [
    Figure {
        name: "1",
        kind: FigureKind::HeldStress,
        shown: "Ψ_r(t) = e^(rt) v_x(0,t) for r = 2.6, 2.9, 3.0 with g = 0 and t₁ = μ = c = 1: the strain at the ground, \
                were the end held for ever, times e^(rt).",
        corrected: "The bounce times are numbers: t_b = 1.78848103329888, 2.55302249931324 and 3.29902605144577.",
    },
    Figure {
        name: "2",
        kind: FigureKind::VibrationalEnergy,
        shown: "E_z(t_b) over μ for r = 0 and c = L = g = 1, with the dot at μ = μ₀ = 2.",
        corrected: "Nothing: from μ₀ on it is μ₀²L/6 = 2/3.",
    },
    Figure {
        name: "3",
        kind: FigureKind::EnergyShares,
        shown: "E_h(t_b)/E(0) and E_z(t_b)/E(0) over μ for r = 0 and c = L = g = 1, with dots at μ = μ₀.",
        corrected: "Nothing: E_z/E(0) is greatest at 2μ₀/3, where it is 4/9.",
    },
    Figure {
        name: "4",
        kind: FigureKind::Restitution,
        shown: "e_E² over μ for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1, with black dots where t_b = t₁ begins.",
        corrected: "The curves go on to the left of the dots, where t_b > t₁, down to e_E² = 0; and the limits for \
                    μ → ∞ are true ones.",
    },
    Figure {
        name: "5",
        kind: FigureKind::TranslationalShare,
        shown: "E_h(t₁)/E(t₁) over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2, and the limit is not 1 as (4.74) supposes but 0.99996647, \
                    0.99945549, 0.99719065 for r = 0.1, 0.2, 0.3.",
    },
    Figure {
        name: "6",
        kind: FigureKind::EnergyKept,
        shown: "E(t₁)/E(0) over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2, with the limits for μ → ∞ beside e^{−2rt₁}.",
    },
    Figure {
        name: "7",
        kind: FigureKind::EnergyOverDecay,
        shown: "E(t₁)/E(0) divided by e^{−2rt₁} over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2; there is no common limit C₀ = 1, but 1.00066892, 1.00541337, \
                    1.01866583 for r = 0.1, 0.2, 0.3, so that (4.75) fails as well.",
    },
    Figure {
        name: "8",
        kind: FigureKind::IntegrationRegions,
        shown: "The regions A, B, C of the integrals in the appendix, for the point (L/2, t₁): their borders are the \
                characteristics through it and the lines y = 0 and y = 2L.",
        corrected: "Nothing; no integral over them is needed any more.",
    },
    Figure {
        name: "regimes",
        kind: FigureKind::Regimes,
        shown: "When and whether the first contact ends, over R = r t₁ and M = μ/(g t₁): t_b = t₁ above the curve \
                M = (I₀(R) + I₁(R))/(2 − I₀(R)).",
        corrected: "Not in the paper, which leaves open whether Ψ must have a root: from R = π on it has none.",
    },
    Figure {
        name: "tenth-bounce",
        kind: FigureKind::TenthBounce,
        shown: "e_E² of the tenth bounce over μ for r = 0 and c = L = g = 1, beside that of the first.",
        corrected: "Not in the paper, whose coefficient is that of a first bounce: a later one may give back what the \
                    rod kept as vibration, e_E² > 1. It is empty where the centre of mass never comes back to h = 0.",
    },
];

impl Figure {
    /// Returns the name of the files of the figure, without the ending: `figure-4`.
    pub fn file(&self) -> String {
        if self.name.parse::<u32>().is_ok() { format!("figure-{}", self.name) } else { self.name.into() }
    }
}
