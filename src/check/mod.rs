//! The catalogue of hard cases and of the paper's claims: each asked of every route that can answer, held against the truth.
//!
//! | module | |
//! |---|---|
//! | `hard` | where double precision breaks |
//! | `contact`, `motion`, `energy`, `restitution` | the paper, section by section |
//! | `routes` | every way to an answer |
//! | `plain` | formulas in plain doubles, as they stand in print |
//! | `row` | promises, and whether they are kept |
//! | `value` | answers, truths, and how many digits are right |
//!
//! The catalogue is data: a [`Case`] holds questions, a [`Question`] its truth and the routes to it, each with what it promises.
//! [`Case::run`] takes the routes.

mod contact;
mod energy;
mod hard;
mod motion;
mod plain;
mod restitution;
mod routes;
mod row;
mod value;

use std::time::Instant;

pub use routes::{Of, Rod, Route};
pub use row::{Outcome, Promise, Row};
pub use value::{Answer, Kept, Truth, Value};

/// What belongs together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
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
    pub const ALL: [Group; 11] = [
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
    pub fn name(self) -> &'static str {
        match self {
            Group::Late => "late",
            Group::Weak => "weak",
            Group::Strong => "strong",
            Group::Threshold => "threshold",
            Group::Landings => "landings",
            Group::Small => "small",
            Group::Rays => "rays",
            Group::Contact => "section-2",
            Group::Motion => "section-3.1",
            Group::Energy => "section-3.2",
            Group::Restitution => "section-4",
        }
    }

    /// The heading.
    pub fn title(self) -> &'static str {
        match self {
            Group::Late => "Bounces that come late",
            Group::Weak => "Damping that vanishes",
            Group::Strong => "Damping that overflows",
            Group::Threshold => "The threshold of the bounce at t₁",
            Group::Landings => "Landings without speed, and many landings",
            Group::Small => "Small differences of great numbers",
            Group::Rays => "Two values at one time",
            Group::Contact => "Section 2: the contact and how it ends",
            Group::Motion => "Section 3.1: momentum and centre of mass",
            Group::Energy => "Section 3.2: energies",
            Group::Restitution => "Section 4: coefficients of restitution",
        }
    }

    /// What it teaches.
    pub fn lesson(self) -> &'static str {
        match self {
            Group::Late => {
                "Without gravity the stress at the ground is a sum of rays whose terms grow like e^{rt} while the sum stays of the \
                 order of t. The closer r t₁ comes to π from below, the later the bounce, and from π on there is none. Plain \
                 doubles sum rounding errors, and find a bounce in them. The modes do not cancel there, and longer numbers do not mind."
            }
            Group::Weak => {
                "(3.38)–(3.45) and Remark 2 divide by 2r and 4r², and lose twice the digits that r is small by. Written with \
                 φ functions and logarithmic means, r → 0 is a value like any other, and the one of r = 0 is its limit."
            }
            Group::Strong => {
                "I₀(rt) overflows beyond rt = 713, and e^{−rt} underflows. The product of both is of the order of one: it has to be \
                 formed before its factors. The rod just settles under its weight."
            }
            Group::Threshold => {
                "At the threshold (2.32) the bounce leaves t₁: from the right it is at t₁ exactly, from the left it is a root just after \
                 it. A millionth of a millionth of the speed decides, and the answer has to fall on the right side."
            }
            Group::Landings => {
                "After some bounces the rod of μ = 1 lands with speed zero, at t = 31: a double root, which costs half of the digits, \
                 and which no numerical precision can tell from a near miss. Exact numbers a + b√d inside the enclosures do. With \
                 μ = 3/2 the events multiply, and each takes some digits away from the next."
            }
            Group::Small => {
                "A fast rod keeps the vibrational energy E_z = μ₀²L/6 after its bounce, however fast it is: for steel at 100 m/s that is \
                 5e-10 of the energy. E − E_h has no digit of it right beyond the sixth; a sum of squares has all of them."
            }
            Group::Rays => {
                "When a ray arrives, the stress jumps, and a time that is a multiple of t₁ in the decimals of a person need not be one in \
                 doubles. Both limits can be asked for, by name, and decimals are taken as what they spell."
            }
            Group::Contact => {
                "Lemma 1 to Theorem 1 and Figure 1. All formulas hold; I₀ is called by the wrong name; and the question that section 5 \
                 leaves open has an answer: the stress need not have a root, with gravity or without."
            }
            Group::Motion => {
                "(3.34)–(3.53) and Remark 2. All formulas hold, those for r = 0 in fractions and to the last digit; (3.42) and the sentence \
                 after it name the wrong times."
            }
            Group::Energy => "(3.54)–(3.70), Theorem 2, Figures 2 and 3. All formulas hold, in fractions where r = 0.",
            Group::Restitution => {
                "(4.71)–(4.75), Figures 4 to 7. (4.71)–(4.73) hold. The limits (4.74) and (4.75) were read off graphs and are not the limits: \
                 for t_b = t₁ and μ → ∞, exactly e_E → 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}, which is e^{−R}(1 + R³/24 + …), R = r t₁. Figure 4 \
                 goes on to the left of its dots."
            }
        }
    }

    /// Whether it is about the paper, and not about numbers.
    pub fn of_paper(self) -> bool {
        matches!(self, Group::Contact | Group::Motion | Group::Energy | Group::Restitution)
    }
}

/// What a case says when all its promises are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every route keeps what it promises.
    Holds,
    /// The paper is right.
    Reproduced,
    /// The paper is off, and here is the truth.
    Corrected,
    /// The paper means the right thing and prints another.
    Misprint,
    /// The paper leaves it open, and here is an answer.
    Settled,
    /// Some route does not keep what it promises.
    Failed,
}

impl Verdict {
    /// The word in output.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Reproduced => "reproduced",
            Verdict::Corrected => "corrected",
            Verdict::Misprint => "misprint",
            Verdict::Settled => "settled",
            Verdict::Failed => "FAILED",
        }
    }
}

/// A question, its truth, and the routes to it.
#[derive(Debug)]
pub struct Question {
    /// In words: `t_b`, `h(3)`.
    pub what: &'static str,
    /// The rod.
    pub rod: Rod,
    /// What is asked.
    pub of: Of,
    /// The truth, see [`Truth`].
    pub truth: &'static str,
    /// The routes, and what each promises.
    pub routes: &'static [(Route, Promise)],
}

/// A hard case, or a claim of the paper.
#[derive(Debug)]
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// Where it belongs.
    pub group: Group,
    /// Where the paper or the theory says it.
    pub source: &'static str,
    /// The rod, or what is claimed.
    pub about: &'static str,
    /// What is said when all promises are kept.
    pub verdict: Verdict,
    /// The questions.
    pub questions: &'static [Question],
}

/// The answers to a question.
#[derive(Clone, Debug)]
pub struct Asked {
    /// In words.
    pub what: &'static str,
    /// The truth.
    pub truth: Truth,
    /// The answers.
    pub rows: Vec<Row>,
}

/// A case that was run.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The case.
    pub case: &'static Case,
    /// Its questions with their answers.
    pub asked: Vec<Asked>,
    /// What it comes to.
    pub verdict: Verdict,
}

/// All cases, in the order in which they are shown.
pub fn catalogue() -> impl Iterator<Item = &'static Case> {
    let parts: [&'static [Case]; 5] = [hard::CASES, contact::CASES, motion::CASES, energy::CASES, restitution::CASES];
    parts.into_iter().flatten()
}

/// The cases of these names or groups; all of them for none.
///
/// **Errors**: the first name that is neither.
///
/// ```
/// use dalembert::check::select;
/// assert_eq!(select(&["figure-1".into()]).unwrap().len(), 1);
/// assert!(select(&["late".into()]).unwrap().len() > 3);
/// assert_eq!(select(&["never".into()]).unwrap_err(), "never");
/// ```
pub fn select(names: &[String]) -> Result<Vec<&'static Case>, String> {
    let known = |name: &str| catalogue().any(|case| case.name == name || case.group.name() == name);
    match names.iter().find(|name| !known(name)) {
        Some(unknown) => Err(unknown.clone()),
        None => {
            let asked = |case: &Case| names.iter().any(|name| name == case.name || name == case.group.name());
            Ok(catalogue().filter(|case| names.is_empty() || asked(case)).collect())
        }
    }
}

impl Case {
    /// Takes every route to every question of the case. Without long numbers those in doubles only, and the truth is the one in
    /// the catalogue; with them the enclosures prove it.
    ///
    /// ```
    /// use dalembert::check::{Verdict, select};
    /// let case = select(&["corollary-1".into()]).unwrap()[0];
    /// assert_eq!(case.run().verdict, Verdict::Reproduced);
    /// ```
    pub fn run(&'static self) -> Checked {
        let asked: Vec<Asked> = self.questions.iter().map(Question::ask).collect();
        let failed = asked.iter().flat_map(|asked| &asked.rows).any(|row| row.outcome == Outcome::Failed);
        Checked { case: self, asked, verdict: if failed { Verdict::Failed } else { self.verdict } }
    }
}

impl Question {
    fn ask(&self) -> Asked {
        let truth = Truth::new(self.truth);
        let taken = self.routes.iter().filter(|(route, _)| cfg!(feature = "mp") || route.in_doubles());
        let rows = taken.map(|(route, promise)| {
            let start = Instant::now();
            let answer = route.answer(&self.rod, self.of);
            Row::judged(route.name(), *promise, &truth, answer, start.elapsed().as_secs_f64())
        });
        let rows = rows.collect();
        Asked { what: self.what, truth, rows }
    }
}
