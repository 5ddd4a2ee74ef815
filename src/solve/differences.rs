//! Derivatives as difference quotients of runs in long numbers.
//!
//! With a step `h` of the value, relative to it, and numbers of twice as many digits, `(f(1 + h) − f(1))/h` has half of
//! them. It is off by `h f″/2`, and the quotient to the left, whose step is twice as long, by `−h f″`: what they differ
//! by bounds the error of `(2 right + left)/3`, where `f″` cancels, as long as `f″` does not change by its own size
//! within the steps. The steps are not the same, so that no root or jump that is odd about the value looks smooth.
//! Where the quotients differ by more than a step of the size asked for lets a smooth function differ, the step is
//! squared: the error of a one-sided quotient shrinks with it, and what does not is a kink, a root or a jump.

use super::derivative::{Asked, Derivative, Derivatives, NoDerivative, Rows, at, of_each};
use super::plan::Plan;
use super::question::{Numbers, Question};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::motion::Motion;
use crate::number::{Bounded, Estimate, Float, Number, Scalar, bits_for_digits};
use crate::problem::{Parameter, Problem};
use crate::threads::Threads;

type Long = Estimate<Float>;
type OneSide = Result<Long, NoDerivative>;

/// Beyond these steps have more digits than numbers are written in.
const MOST_DIGITS: u32 = 60;
/// Steps are squared so often.
const LEVELS: u32 = 3;
/// Bits of a quotient beyond the digits of the numbers.
const SPARE_BITS: u32 = 32;
/// Decimal exponent of the first step of a gravity that is zero: one so weak, squared, still brings the rod down.
const WEAKEST: u32 = 6;
/// Digits of a step beyond those wanted: what second derivatives take of a quotient that is settled at once. A greater
/// one costs another run.
const CURVATURE: u32 = 4;

/// The derivatives that are `asked` for, to about so many digits of their natural size.
pub(super) fn of(asked: &Asked<'_>, digits: u32) -> Result<Derivatives<Long>, Error> {
    if digits > MOST_DIGITS {
        return Err(Error::Digits { found: digits, most: MOST_DIGITS });
    }
    let zero = asked.by.value_in::<f64>(asked.problem, &())? == 0.0;
    let first = if zero && asked.by == Parameter::Gravity { WEAKEST } else { digits + CURVATURE };
    let wanted = part(first - CURVATURE.min(first / 2));
    let mut before = None;
    let mut level = Level::of(asked, first, zero)?;
    for doublings in 1.. {
        let (found, settled) = level.derivatives(before.as_ref(), wanted);
        if settled || doublings == LEVELS {
            return Ok(found);
        }
        let finer = Level::of(asked, first << doublings, zero)?;
        before = Some(std::mem::replace(&mut level, finer));
    }
    Ok(Vec::new())
}

/// `10^−exponent`.
fn part(exponent: u32) -> f64 {
    10f64.powf(-f64::from(exponent))
}

/// Runs that are a step apart.
struct Level {
    base: Rows<Long>,
    /// The natural scale of each column.
    scales: Vec<f64>,
    /// Two steps to the left and one to the right; `None` where no problem has such a value.
    moved: [Option<Rows<Long>>; 2],
    /// The step, in the units of the value.
    step: Long,
    /// The same as a part of the value.
    part: f64,
    /// Whether a number that is absent says that there is no such value.
    one_sided: bool,
}

impl Level {
    /// Runs with the step `10^−exponent`.
    fn of(asked: &Asked<'_>, exponent: u32, zero: bool) -> Result<Self, Error> {
        let by: Number = format!("1e-{exponent}").parse().unwrap_or_else(|_| 1.into());
        let step = by.to_rational();
        let problems = [-(step.clone() + &step), step].map(|step| asked.by.moved(asked.problem, &step));
        let bits = bits_for_digits(2 * exponent) + SPARE_BITS;
        let run = |k: usize| match k {
            0 => rows(asked, asked.problem, exponent, bits).map(Some),
            k => problems[k - 1].as_ref().map(|problem| rows(asked, problem, exponent, bits)).transpose(),
        };
        let mut runs = Threads::default().all(3, run)?.into_iter();
        let mut next = || runs.next().flatten();
        let (base, scales) = next().unwrap_or_default();
        let moved = [next(), next()].map(|run| run.map(|(rows, _)| rows));
        let value = match zero {
            true => Long::from_number(&asked.by.scale_of_zero(asked.problem), &bits),
            false => asked.by.value_in(asked.problem, &bits)?,
        };
        let step = value.clone() * Long::from_number(&by, &bits) / value.int(asked.by.power(asked.problem));
        Ok(Level { base, scales, moved, step, part: part(exponent), one_sided: asked.is_stretched() })
    }

    /// The quotients to both sides of a number that there is; `None` where no problem is on that side.
    fn quotients(&self, place: (usize, usize)) -> Option<[Option<OneSide>; 2]> {
        let here = at(&self.base, place)?;
        let [left, right] = self.moved.each_ref().map(|moved| {
            let there = at(moved.as_ref()?, place);
            (there.is_some() || !self.one_sided).then_some(())?;
            Some(there.ok_or(NoDerivative::Jumps).map(|there| (there.clone() - here) / &self.step))
        });
        Some([left.map(|left| left.map(|rise| -rise.halved())), right])
    }

    /// The derivatives by these runs, those with a greater step at hand; and whether all are settled.
    fn derivatives(&self, before: Option<&Level>, wanted: f64) -> (Derivatives<Long>, bool) {
        let mut settled = true;
        let found = of_each(&self.base, |place, number| {
            let natural = size(number).max(self.scales[place.1]);
            let judge = Judge { wanted, natural: natural / size(&self.step) * self.part, step: self.part };
            let before = before.and_then(|before| before.quotients(place));
            let found = self.quotients(place).and_then(|now| judge.derivative(now, before));
            settled &= found.is_some();
            let why = NoDerivative::Unsettled;
            found.unwrap_or(Derivative::Sides { left: Err(why), right: Err(why) })
        });
        (found, settled)
    }
}

/// What settles a derivative.
struct Judge {
    /// So much of its size, or of the natural one, it may be off.
    wanted: f64,
    /// The number itself, or its natural scale where that is greater, divided by the value.
    natural: f64,
    /// The step as a part of the value; that before was its root.
    step: f64,
}

impl Judge {
    fn is_fine(&self, off: f64, size: f64) -> bool {
        off <= self.wanted * (size + self.natural)
    }

    /// The mean of both sides within what they differ by, and within what a second derivative of natural size makes of
    /// the step: where it is not the same on both sides, both may be off alike.
    fn within(&self, mean: Long, apart: &Long) -> Long {
        let bend = mean.double(self.natural * self.step);
        mean.widened(apart).widened(&bend)
    }

    /// From the quotients to both sides, and those of the step before; `None` where a smaller step is needed.
    fn derivative(&self, now: [Option<OneSide>; 2], before: Option<[Option<OneSide>; 2]>) -> Option<Derivative<Long>> {
        if let [Some(Ok(left)), Some(Ok(right))] = &now {
            let (mean, apart) = mean(left, right);
            if self.is_fine(reach(&apart), size(&mean)) {
                return Some(Derivative::One(self.within(mean, &apart)));
            }
        }
        let [before_left, before_right] = before?;
        match now {
            [Some(left), Some(right)] => match [self.side(before_left?, left)?, self.side(before_right?, right)?] {
                [Ok(left), Ok(right)] => {
                    let (mean, apart) = mean(&left, &right);
                    let same = apart.vanishes() == Ok(true);
                    Some(if same { Derivative::One(self.within(mean, &apart)) } else { sides(Ok(left), Ok(right)) })
                }
                [left, right] => Some(sides(left, right)),
            },
            [None, Some(side)] => Some(only(self.side(before_right?, side)?)),
            [Some(side), None] => Some(only(self.side(before_left?, side)?)),
            [None, None] => None,
        }
    }

    /// From two quotients to one side, which differ by the error of the last at least: be it greater as that of the
    /// first, whose step is, or because the last step is short enough to see that the threshold is not met.
    fn side(&self, before: OneSide, now: OneSide) -> Option<OneSide> {
        let (before, now) = match (before, now) {
            (Ok(before), Ok(now)) => (before, now),
            (Err(_), Ok(_)) => return None,
            (_, Err(why)) => return Some(Err(why)),
        };
        let change = now.clone() - &before;
        let [was, is] = [&before, &now].map(size);
        if size(&change) <= f64::max(was, is) / 10.0 + self.wanted * self.natural {
            let found = now.widened(&change);
            return self.is_fine(bound(&found), is).then_some(Ok(found));
        }
        // A jump makes quotients grow as steps shrink, a root as their roots do.
        let growth = (is / was).ln() / -self.step.sqrt().ln();
        let unbounded = if growth > 0.75 { NoDerivative::Jumps } else { NoDerivative::Infinite };
        (growth > 0.25).then_some(Err(unbounded))
    }
}

fn sides(left: OneSide, right: OneSide) -> Derivative<Long> {
    Derivative::Sides { left, right }
}

/// That from the only side.
fn only(side: OneSide) -> Derivative<Long> {
    match side {
        Ok(value) => Derivative::One(value),
        Err(why) => sides(Err(why), Err(why)),
    }
}

/// The mean of quotients to the left and to the right by their steps, and what they differ by.
fn mean(left: &Long, right: &Long) -> (Long, Long) {
    ((right.clone().doubled() + left) / left.int(3), right.clone() - left)
}

fn size(x: &Long) -> f64 {
    x.to_f64().abs()
}

fn bound(x: &Long) -> f64 {
    x.log2_error().exp2()
}

/// How far from zero the number may be.
fn reach(x: &Long) -> f64 {
    size(x) + bound(x)
}

/// The numbers of a run, in numbers of so many bits, and the scale of each column.
fn rows(asked: &Asked<'_>, problem: &Problem, exponent: u32, bits: u32) -> Result<(Rows<Long>, Vec<f64>), Error> {
    let question = Question { want: asked.want.clone(), numbers: Numbers::Digits(2 * exponent) };
    let plan = Plan::of(problem, &question)?;
    let history = TypedHistory::<Float>::solve(problem, &plan, asked.observe.clone())?;
    let query = |motion: &dyn Motion<Long>| Ok((asked.values(problem, motion)?, asked.scales(problem, motion)));
    let (mut rows, scales) = history.ask(query, |(rows, _)| rows.iter().flatten().flatten().collect())?;
    let zero = Long::from_number(&Number::from(0), &bits);
    for number in rows.iter_mut().flatten().flatten() {
        let error = (number.log2_error() + f64::from(bits)).exp2();
        // The left operand has the precision.
        *number = Estimate::new(zero.value().clone() + number.value(), error + size(number));
    }
    Ok((rows, scales))
}
