//! What can be asked of a rod, and how any account of its motion answers.

use clap::ValueEnum;

use super::account::{Account, ByHistory, Found};
use super::value::{Answer, Bounded, NoAnswer, System};
use crate::error::Error;
use crate::motion::{EventKind, Motion, Side};
use crate::number::{Estimate, Number};
use crate::problem::{Parameters, Problem, Run};
use crate::scene::Scene;
use crate::solve::{Plan, Solution, Target};

/// A quantity that is one number. Those that `dalembert cost` offers come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum Quantity {
    /// `t_b`: the first release.
    BounceTime,
    /// `v_x(0,t)`: the strain at the ground, which is the stress divided by the modulus.
    Stress,
    /// `h(t)`: the centre of mass.
    Centre,
    /// `E(t)`.
    Energy,
    /// `E_z(t)`: the vibrational part of the energy.
    Vibrational,
    /// `e_P` of the first contact: the ratio of momenta.
    #[value(name = "e_P")]
    MomentumRestitution,
    /// `e_E²` of the first contact: the ratio of the energies of the centre of mass.
    #[value(name = "e_E2", alias = "restitution")]
    Restitution,
    /// The time of the last impact or release of the run.
    LastEvent,
    /// The impact next to a time.
    #[value(skip)]
    Impact,
    /// The release next to a time.
    #[value(skip)]
    Release,
    /// `v(x,t)`.
    #[value(skip)]
    Displacement,
    /// `v_t(x,t)`.
    #[value(skip)]
    Velocity,
    /// `v_x(x,t)`.
    #[value(skip)]
    Strain,
    /// `P(t) = L h′(t)`.
    #[value(skip)]
    Momentum,
    /// `E_h(t)`.
    #[value(skip)]
    Translational,
    /// `E_h(t_b)/E(t_b)`.
    #[value(skip)]
    TranslationalShare,
    /// `E(t_b)/E(0)`.
    #[value(skip)]
    EnergyLeft,
    /// `E(t_b)/E(0) e^{2r t_b}`.
    #[value(skip)]
    EnergyLeftUndamped,
    /// `e_E − e^{−r t_b}`.
    #[value(skip)]
    BeyondExponential,
    /// `t*`: when the centre of mass is highest.
    #[value(skip)]
    TopTime,
    /// `h_max = h(t*)`.
    #[value(skip)]
    TopHeight,
    /// The length of the shortest piece of the stress history.
    #[value(skip)]
    ShortestPiece,
    /// A number that belongs to no rod; formulas alone give it.
    #[value(skip)]
    Constant,
}

use Quantity::*;

impl Quantity {
    /// The name in output: `bounce_time`.
    pub(crate) fn name(self) -> &'static str {
        self.texts().0
    }

    /// The symbol: `t_b`.
    pub(crate) fn symbol(self) -> &'static str {
        self.texts().1
    }

    fn texts(self) -> (&'static str, &'static str) {
        match self {
            BounceTime => ("bounce_time", "t_b"),
            Stress => ("stress", "v_x(0,t)"),
            Centre => ("centre", "h(t)"),
            Energy => ("energy", "E(t)"),
            Vibrational => ("vibrational", "E_z(t)"),
            MomentumRestitution => ("e_P", "e_P"),
            Restitution => ("e_E2", "e_E²"),
            LastEvent => ("last_event", "time of the last event"),
            _ => ("quantity", ""),
        }
    }

    /// Whether `dalembert cost` asks it at a time.
    pub(crate) fn is_at_a_time(self) -> bool {
        matches!(self, Stress | Centre | Energy | Vibrational)
    }
}

/// Which of two values at a jump, or their difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    /// From earlier or from later times.
    From(Side),
    /// The later limit minus the earlier.
    Jump,
}

/// One number of a problem that is followed as far as the answer needs.
#[derive(Clone, Debug)]
pub(crate) struct Question {
    pub(crate) problem: Problem,
    pub(crate) quantity: Quantity,
    /// x, for a quantity at a point.
    pub(crate) point: Option<Number>,
    /// t, for a quantity at a time; `t_b` where it is `None`.
    pub(crate) time: Option<Number>,
    pub(crate) limit: Limit,
    /// Nothing before this time is asked for.
    pub(crate) from: Option<f64>,
}

impl Question {
    /// `quantity` of `problem` at `time`.
    pub(crate) fn new(problem: Problem, quantity: Quantity, time: Option<Number>) -> Self {
        Question { problem, quantity, point: None, time, limit: Limit::From(Side::Right), from: None }
    }

    /// `quantity` of `scene` at `time`; without one at three quarters of a round trip. Without a quantity it is the
    /// bounce time, or, where the scene calls for more than one contact, the time of the last event.
    ///
    /// **Errors**: [`NoAnswer::Time`] for a time below zero, or for a quantity that is not asked at a time.
    pub(crate) fn of_scene(scene: &Scene, quantity: Option<Quantity>, time: Option<Number>) -> Result<Self, NoAnswer> {
        let mut problem = scene.problem.clone();
        let quantity = quantity.unwrap_or(match problem.run {
            Run::Impacts(1) => BounceTime,
            _ => LastEvent,
        });
        let expected = match &time {
            Some(_) if !quantity.is_at_a_time() => Some(format!("none: {} is not asked at a time", quantity.name())),
            Some(time) if time.to_f64() < 0.0 => Some("one from 0 on".into()),
            _ => None,
        };
        if let (Some(expected), Some(time)) = (expected, &time) {
            return Err(NoAnswer::Time { found: time.to_string(), expected });
        }
        let time = match time {
            None if quantity.is_at_a_time() => Some(default_time(&problem)?),
            other => other,
        };
        match (&time, quantity) {
            (Some(time), _) => problem.run = Run::Time(time.clone()),
            (None, BounceTime | MomentumRestitution | Restitution) => problem.run = Run::Impacts(1),
            (None, _) => (),
        }
        Ok(Question::new(problem, quantity, time))
    }

    /// The answer of one account of the motion of `rod`.
    pub(crate) fn ask<S: System>(&self, rod: &Parameters<S>, motion: &dyn Account<S>) -> Result<Answer, NoAnswer> {
        self.find(rod, motion).map(Bounded::answer)
    }

    /// The answer of a history.
    pub(crate) fn ask_history<S: System>(&self, history: &dyn Motion<S>) -> Result<Answer, NoAnswer> {
        self.find_in_history(history).map(Bounded::answer)
    }

    /// The answer of a solution in any numbers.
    pub(crate) fn ask_solution(&self, solution: &Solution) -> Result<Answer, NoAnswer> {
        match solution {
            Solution::Double(history) => self.ask_motion(history),
            Solution::Digits(history, _) | Solution::DigitsAfter(history, ..) => self.ask_motion(history),
            Solution::Exact(history) => self.ask_motion(history),
            Solution::Certified(history, _) => self.ask_motion(history),
        }
    }

    /// The answer of the public history, settled to its digits.
    fn ask_motion<S: Target<Carried: System>>(&self, history: &crate::solve::History<S>) -> Result<Answer, NoAnswer> {
        self.find_settled(history).map(Bounded::answer)
    }

    /// The same in the numbers of the history.
    pub(crate) fn find_settled<S: Target<Carried: System>>(
        &self,
        history: &crate::solve::History<S>,
    ) -> Found<S::Carried> {
        history.ask(|engine| self.query(engine), |found| found.iter().map(|found| &found.value).collect())?
    }

    /// The answer in doubles by a plan, which works out nothing else.
    pub(super) fn find_planned(&self, plan: &Plan) -> Found<Estimate<f64>> {
        let query = |engine: &dyn Motion<_>| self.query(engine);
        plan.ask::<f64, _>(&self.problem, query, |found| found.iter().map(|found| &found.value).collect())?
    }

    fn query<S: System>(&self, engine: &dyn Motion<S>) -> Result<Found<S>, Error> {
        match self.find_in_history(engine) {
            // More bits may settle it.
            Err(NoAnswer::Solve(error @ (Error::NotDecided { .. } | Error::Open(_)))) => Err(error),
            found => Ok(found),
        }
    }

    /// The answer of an engine in its numbers.
    fn find_in_history<S: System>(&self, history: &dyn Motion<S>) -> Found<S> {
        let rod = Parameters::of(&self.problem, &history.scales().length.precision())?;
        self.find(&rod, &ByHistory(history, &self.problem.run))
    }

    fn find<S: System>(&self, rod: &Parameters<S>, motion: &dyn Account<S>) -> Found<S> {
        let found = match self.limit {
            Limit::From(side) => self.find_on(rod, motion, side),
            Limit::Jump => {
                let earlier = self.find_on(rod, motion, Side::Left);
                self.find_on(rod, motion, Side::Right).and_then(|later| Ok(later.minus(earlier?)))
            }
        };
        found.map_err(|error| match error {
            NoAnswer::NoSuchQuantity { why, .. } => NoAnswer::NoSuchQuantity { quantity: self.quantity.name(), why },
            other => other,
        })
    }

    fn find_on<S: System>(&self, rod: &Parameters<S>, motion: &dyn Account<S>, side: Side) -> Found<S> {
        let precision = rod.length.precision();
        let point = || match &self.point {
            Some(point) => Ok(S::from_number(point, &precision)),
            None => Err(NoAnswer::none("no point is given")),
        };
        let time = || match &self.time {
            Some(time) => Ok(S::from_number(time, &precision)),
            None => motion.release(rod).map(|release| release.value),
        };
        let field = |k: usize| {
            let [v, v_t, v_x] = motion.field(&point()?, &time()?, side)?;
            Ok(if k == 0 {
                v
            } else if k == 1 {
                v_t
            } else {
                v_x
            })
        };
        let exponential = |exponent: S| exponent.exponential().ok_or_else(|| NoAnswer::none("no fraction"));
        let left = || {
            let end = motion.release(rod)?.value;
            Ok::<_, NoAnswer>((motion.total_energy(&end)?.over(motion.first_energy(rod)?), end))
        };
        match self.quantity {
            BounceTime => motion.release(rod),
            LastEvent => motion.last_event(rod),
            Impact => motion.event_near(EventKind::Impact, time()?.to_f64()),
            Release => motion.event_near(EventKind::Release, time()?.to_f64()),
            Stress => motion.strain(&time()?, side),
            Displacement => field(0),
            Velocity => field(1),
            Strain => field(2),
            Centre => motion.height(rod, &time()?),
            Momentum => motion.momentum(rod, &time()?),
            Energy => motion.total_energy(&time()?),
            Translational => motion.translational_energy(rod, &time()?),
            Vibrational => motion.vibrational_energy(rod, &time()?),
            MomentumRestitution => motion.momentum_restitution(rod),
            Restitution => motion.restitution(rod),
            TranslationalShare => {
                let end = motion.release(rod)?.value;
                Ok(motion.translational_energy(rod, &end)?.over(motion.total_energy(&end)?))
            }
            EnergyLeft => Ok(left()?.0),
            EnergyLeftUndamped => {
                let (left, end) = left()?;
                let lost = end.int(2) * &rod.damping * &end;
                Ok(left.times(&exponential(lost)?))
            }
            BeyondExponential => {
                let (squared, end) = (motion.restitution(rod)?, motion.release(rod)?.value);
                let root = squared.value.try_sqrt().ok_or_else(|| NoAnswer::none("no fraction"))?;
                let bound = squared.bound / root.to_f64();
                let decay = exponential(-(end * &rod.damping))?;
                Ok(Bounded::new(root, bound).minus(Bounded::rounded(decay)))
            }
            TopTime => motion.top().map(|[time, _]| time),
            TopHeight => motion.top().map(|[_, height]| height),
            ShortestPiece => motion.shortest_piece(),
            Constant => Err(NoAnswer::none("it belongs to no rod")),
        }
    }
}

/// Three quarters of a round trip, to three digits: an ordinary time within the first contact.
fn default_time(problem: &Problem) -> Result<Number, NoAnswer> {
    let time = 0.75 * Parameters::<f64>::of(problem, &())?.round_trip();
    let text = format!("{time:.2e}");
    text.parse().map_err(|_| NoAnswer::Time { found: text, expected: "a round trip between 1e-300 and 1e300".into() })
}
