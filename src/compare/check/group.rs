//! What belongs together in the catalogue, and what it shows.

/// What belongs together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    /// Bounces that come late.
    Late,
    /// Damping that vanishes.
    Weak,
    /// Damping that overflows.
    Strong,
    /// The threshold of (2.32).
    Threshold,
    /// Landings without speed, and many of them.
    Landings,
    /// Differences of great numbers.
    Small,
    /// Two values at one time.
    Rays,
    /// Section 2 of the paper.
    Contact,
    /// Section 3.1.
    Motion,
    /// Section 3.2.
    Energy,
    /// Section 4.
    Restitution,
}

impl Group {
    /// All of them, in the order in which they are shown.
    pub(crate) const ALL: [Group; 11] = [
        Group::Late,
        Group::Weak,
        Group::Strong,
        Group::Threshold,
        Group::Landings,
        Group::Small,
        Group::Rays,
        Group::Contact,
        Group::Motion,
        Group::Energy,
        Group::Restitution,
    ];

    /// The name on the command line.
    pub(crate) fn name(self) -> &'static str {
        self.texts().0
    }

    /// The heading.
    pub(crate) fn title(self) -> &'static str {
        self.texts().1
    }

    /// What its cases show.
    pub(crate) fn lesson(self) -> &'static str {
        self.texts().2
    }

    fn texts(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Group::Late => (
                "late",
                "Bounces that come late",
                "Without gravity the stress at the ground is a sum of rays whose terms grow like e^{rt} while the sum stays of the \
                 order of t. The closer r t₁ is to π from below, the later the bounce; from π on there is none. A sum in plain \
                 doubles consists of rounding errors and finds a bounce in them. The sum over modes does not cancel there, and longer \
                 numbers have digits to spare.",
            ),
            Group::Weak => (
                "weak",
                "Damping that vanishes",
                "(3.38)–(3.45) and Remark 2 divide by 2r and 4r², and lose twice as many digits as r has zeros. Written with φ \
                 functions and logarithmic means they have no division by r, and their limit r → 0 is the formula of r = 0, which \
                 `remark-2` checks.",
            ),
            Group::Strong => (
                "strong",
                "Damping that overflows",
                "I₀(rt) overflows beyond rt = 713, and e^{−rt} underflows. Their product is of the order of one and has to be formed \
                 before its factors. The rod settles under its weight.",
            ),
            Group::Threshold => (
                "threshold",
                "The threshold of the bounce at t₁",
                "At the threshold (2.32) the bounce leaves t₁: above it the bounce is at t₁ exactly, below it at a root just after t₁. A \
                 speed that differs by 10⁻¹² decides between the two.",
            ),
            Group::Landings => (
                "landings",
                "Landings without speed, and many landings",
                "After some bounces the rod of μ = 1 lands with speed zero, at t = 31. This is a double root, which costs half of the \
                 digits, and no numerical precision distinguishes it from a near miss. The enclosures carry exact numbers a + b√d, \
                 which do. With μ = 3/2 the number of events grows, and each costs the next some digits.",
            ),
            Group::Small => (
                "small",
                "Small differences of great numbers",
                "A fast rod has the vibrational energy E_z = μ₀²L/6 after its bounce, whatever its speed: for steel at 100 m/s that is \
                 5e-10 of the energy. In E − E_h no more than six digits of it are right; a sum of squares has all of them.",
            ),
            Group::Rays => (
                "rays",
                "Two values at one time",
                "When a ray arrives, the stress jumps, and a decimal that is a multiple of t₁ need not be one in doubles. Both limits can \
                 be asked for, and decimals are taken as the fractions that they spell.",
            ),
            Group::Contact => (
                "section-2",
                "Section 2: the contact and how it ends",
                "Lemma 1 to Theorem 1 and Figure 1. All formulas hold; I₀ is called by the wrong name; and the question that section 5 \
                 leaves open has an answer: the stress need not have a root, with gravity or without.",
            ),
            Group::Motion => (
                "section-3.1",
                "Section 3.1: momentum and centre of mass",
                "(3.34)–(3.53) and Remark 2. All formulas hold, those for r = 0 in fractions and to the last digit; (3.42) and the \
                 sentence after it name the wrong times.",
            ),
            Group::Energy => (
                "section-3.2",
                "Section 3.2: energies",
                "(3.54)–(3.70), Theorem 2, Figures 2 and 3. All formulas hold, in fractions where r = 0.",
            ),
            Group::Restitution => (
                "section-4",
                "Section 4: coefficients of restitution",
                "(4.71)–(4.75), Figures 4 to 7. (4.71)–(4.73) hold. The limits (4.74) and (4.75) were read off graphs and are not the \
                 limits: for t_b = t₁ and μ → ∞, exactly e_E → 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}, which is e^{−R}(1 + R³/24 + …), R = r t₁. \
                 Nor do the curves come within 0.001 of e^{−R}, as is said after (4.75). Figure 4 goes on to the left of its dots.",
            ),
        }
    }
}
