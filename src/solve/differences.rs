//! Derivatives as difference quotients of runs in long numbers.
//!
//! With a relative step `h` of the value and numbers of twice as many digits, `(f(1 + h) − f(1))/h` has half of these
//! digits. Its error is `h f″/2`, and that of the quotient to the left, with a step twice as long, is `−h f″`. Their
//! difference estimates the error of `(2 right + left)/3`, in which `f″` cancels, as long as `f″` does not change by
//! its own size within the steps. The two steps differ so that no root or jump that is odd about the value looks
//! smooth. If the quotients differ by more than a smooth function allows for a step of the requested size, the step is
//! squared: the error of a one-sided quotient shrinks with the step; otherwise the function has a kink, a root or a
//! jump.

use super::derivative::{Derivative, Derivatives, NoDerivative, Request, Rows, Varying, at, of_each};
use crate::error::Error;
use crate::number::{Bounded, Estimate, Float, Number, Scalar, bits_for_digits};
use crate::threads::Threads;

type Long = Estimate<Float>;
type OneSide = Result<Long, NoDerivative>;

/// Maximum requested digits; steps beyond them would have more digits than numbers can be written with.
const MOST_DIGITS: u32 = 60;
/// Number of levels; each squares the step.
const LEVELS: u32 = 3;
/// Bits of a quotient beyond the digits of the numbers.
const SPARE_BITS: u32 = 32;
/// Digits of a step beyond the requested ones: the loss by second derivatives in a quotient that one level settles. A
/// greater loss costs another run.
const CURVATURE: u32 = 4;

/// Computes the derivatives that are `asked` for, to about this many digits of their natural size.
pub(super) fn of(asked: &impl Request, digits: u32) -> Result<Derivatives<Long>, Error> {
    if digits > MOST_DIGITS {
        return Err(Error::Digits { found: digits, most: MOST_DIGITS });
    }
    let zero = asked.of().value_in::<f64>(asked.by(), &())? == 0.0;
    let first = if zero { asked.of().first_exponent(asked.by()) } else { None }.unwrap_or(digits + CURVATURE);
    let wanted = part(first - CURVATURE.min(first / 2));
    let mut before = None;
    let mut level = Level::of(asked, first, zero)?;
    let mut found: Rows<Option<Derivative<Long>>> = Vec::new();
    for doublings in 1.. {
        // A derivative that a level settles stays: shorter steps pass by thresholds that count as met.
        found = of_each(&level.base, |place, number| {
            let kept = at(&found, place).cloned().flatten();
            kept.or_else(|| level.derivative(place, number, before.as_ref(), wanted))
        });
        if doublings == LEVELS || found.iter().flatten().flatten().all(Option::is_some) {
            break;
        }
        let finer = Level::of(asked, first << doublings, zero)?;
        before = Some(std::mem::replace(&mut level, finer));
    }
    let why = NoDerivative::Unsettled;
    let settled = |found: Option<Derivative<Long>>| found.unwrap_or(sides(Err(why), Err(why)));
    Ok(found.into_iter().map(|row| row.into_iter().map(|cell| cell.map(settled)).collect()).collect())
}

/// Returns `10^−exponent`.
fn part(exponent: u32) -> f64 {
    10f64.powf(-f64::from(exponent))
}

/// Runs with values one step apart.
struct Level {
    base: Rows<Long>,
    /// The natural scale of each column.
    scales: Vec<f64>,
    /// Two steps to the left and one to the right; `None` if no problem has that value.
    moved: [Option<Rows<Long>>; 2],
    /// The step, in units of the value.
    step: Long,
    /// The step relative to the value.
    part: f64,
    /// Whether a missing number means that the value does not exist on that side.
    one_sided: bool,
}

impl Level {
    /// Makes the runs with the step `10^−exponent`.
    fn of(asked: &impl Request, exponent: u32, zero: bool) -> Result<Self, Error> {
        let (of, by) = (asked.of(), asked.by());
        let relative: Number = format!("1e-{exponent}").parse().unwrap_or_else(|_| 1.into());
        let step = relative.to_rational();
        let others = [-(step.clone() + &step), step].map(|step| of.moved(by, &step));
        let bits = bits_for_digits(2 * exponent) + SPARE_BITS;
        let rows = |of| Ok::<_, Error>(widened(asked.long_rows(of, exponent)?, bits));
        let run = |k: usize| match k {
            0 => rows(of).map(Some),
            k => others[k - 1].as_ref().map(rows).transpose(),
        };
        let mut runs = Threads::default().all(3, run)?.into_iter();
        let mut next = || runs.next().flatten();
        let (base, scales) = next().unwrap_or_default();
        let moved = [next(), next()].map(|run| run.map(|(rows, _)| rows));
        let value = match zero {
            true => Long::from_number(&of.scale_of_zero(by), &bits),
            false => of.value_in::<Long>(by, &bits)?.magnitude(),
        };
        let step = value.clone() * Long::from_number(&relative, &bits) / value.int(of.power(by));
        Ok(Level { base, scales, moved, step, part: part(exponent), one_sided: asked.is_stretched() })
    }

    /// Returns the quotients on both sides of an existing number; `None` on a side without a problem.
    fn quotients(&self, place: (usize, usize)) -> Option<[Option<OneSide>; 2]> {
        let here = at(&self.base, place)?;
        let [left, right] = self.moved.each_ref().map(|moved| {
            let there = at(moved.as_ref()?, place);
            (there.is_some() || !self.one_sided).then_some(())?;
            Some(there.ok_or(NoDerivative::Jumps).map(|there| (there.clone() - here) / &self.step))
        });
        Some([left.map(|left| left.map(|rise| -rise.halved())), right])
    }

    /// Computes a derivative from these runs and those with a greater step; `None` if they do not settle it.
    fn derivative(
        &self,
        place: (usize, usize),
        number: &Long,
        before: Option<&Level>,
        wanted: f64,
    ) -> Option<Derivative<Long>> {
        let natural = size(number).max(self.scales[place.1]);
        let judge = Judge { wanted, natural: natural / size(&self.step) * self.part, step: self.part };
        judge.derivative(self.quotients(place)?, before.and_then(|before| before.quotients(place)))
    }
}

/// Criteria that settle a derivative.
struct Judge {
    /// Maximum error, relative to the size plus the natural size.
    wanted: f64,
    /// The number itself, or its natural scale if that is greater, divided by the value.
    natural: f64,
    /// The step relative to the value; the previous step was its square root.
    step: f64,
}

impl Judge {
    fn is_fine(&self, off: f64, size: f64) -> bool {
        off <= self.wanted * (size + self.natural)
    }

    /// Widens the mean of both sides by their difference, and by the effect of a second derivative of natural size: if
    /// it differs between the sides, both may have the same error.
    fn within(&self, mean: Long, apart: &Long) -> Long {
        let bend = mean.double(self.natural * self.step);
        mean.widened(apart).widened(&bend)
    }

    /// Computes the derivative from the quotients of this step and the previous one; `None` if the step is too large.
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

    /// Computes a one-sided derivative from two quotients, whose difference is at least the error of the last one:
    /// either the error of the first is greater, as its step is, or the last step is short enough to show that the
    /// threshold is not met.
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
        // Quotients of a jump grow as the inverse step, those of a root as its square root.
        let growth = (is / was).ln() / -self.step.sqrt().ln();
        let unbounded = if growth > 0.75 { NoDerivative::Jumps } else { NoDerivative::Infinite };
        (growth > 0.25).then_some(Err(unbounded))
    }
}

fn sides(left: OneSide, right: OneSide) -> Derivative<Long> {
    Derivative::Sides { left, right }
}

fn only(side: OneSide) -> Derivative<Long> {
    match side {
        Ok(value) => Derivative::One(value),
        Err(why) => sides(Err(why), Err(why)),
    }
}

/// Returns the mean of the left and the right quotient, weighted by their steps, and their difference.
fn mean(left: &Long, right: &Long) -> (Long, Long) {
    ((right.clone().doubled() + left) / left.int(3), right.clone() - left)
}

fn size(x: &Long) -> f64 {
    x.to_f64().abs()
}

fn bound(x: &Long) -> f64 {
    x.log2_error().exp2()
}

/// Returns an upper bound of the magnitude.
fn reach(x: &Long) -> f64 {
    size(x) + bound(x)
}

/// Returns the numbers of a run in numbers of this many bits, and the scale of each column.
fn widened((mut rows, scales): (Rows<Long>, Vec<f64>), bits: u32) -> (Rows<Long>, Vec<f64>) {
    let zero = Long::from_number(&Number::from(0), &bits);
    for number in rows.iter_mut().flatten().flatten() {
        let error = (number.log2_error() + f64::from(bits)).exp2();
        // The left operand determines the precision.
        *number = Estimate::new(zero.value().clone() + number.value(), error + size(number));
    }
    (rows, scales)
}
