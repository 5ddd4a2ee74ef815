//! As many bits as the asked digits need: each run carries the bound of its own error, and is repeated where that is not
//! small enough.

use rug::Float;

use super::{StrippedUndamped, undamped_within};
use crate::damped::{Damped, Joined};
use crate::error::Error;
use crate::first_contact::{Bounce, FirstContact};
use crate::history::History;
use crate::lattice::Limits;
use crate::number::{Number, Scalar, bits_for_digits};
use crate::rod::{Parameters, Problem, Run};

/// Guard bits of the first try. Few runs need more; the bound of each run tells.
const GUARD_BITS: u32 = 64;
/// Digits that must be left beyond those printed, so that a quantity small against its scale still has all of them.
const SPARE_DIGITS: u32 = 8;
const MAX_BITS: u32 = 1 << 22;
/// How often a damped run is repeated with more bits.
const MOST_TRIES: u32 = 6;

/// The digits that stand behind doubles of this accuracy.
pub(super) fn of_accuracy(accuracy: Option<f64>) -> u32 {
    accuracy.map_or(16, |accuracy| (-accuracy.log10()).ceil().clamp(1.0, 300.0) as u32 + 1).max(16)
}

/// The history of an undamped rod with `digits` right digits in every event: precision is added until the error bound that
/// the run itself carries is below `10^−(digits + 8)` of the scale of each quantity, and that of the time of each event,
/// tangential landings included, below `10^−digits` of it.
///
/// **Errors**: [`Error::Unsettled`], and those of the run.
pub fn undamped_to_digits(
    problem: &Problem,
    digits: u32,
    limits: Limits,
    mut observe: impl FnMut(usize, usize),
) -> Result<StrippedUndamped<Float>, Error> {
    let (wanted, spare) = (bits_for_digits(digits), bits_for_digits(SPARE_DIGITS));
    // A tenth more than foreseen is cheaper than a second run.
    let foreseen = (1.1 * bits_lost(problem)).min(f64::from(MAX_BITS)) as u32 + spare;
    let mut bits = wanted + GUARD_BITS.max(foreseen + 8);
    loop {
        let history = undamped_within::<Float>(problem, &bits, limits, &mut observe)?;
        let carried = history.carried();
        let of_values = carried.ground().relative_error.log2() + f64::from(spare);
        // One bit more for half a unit of the last digit; a time scales with itself, or with a round trip.
        let round_trip = carried.units().round_trip.to_f64();
        let of_times = carried.events().iter().map(|event| {
            let scale = event.time.to_f64().max(round_trip);
            (event.time.error() / scale).log2() + 1.0
        });
        let lost = of_times.fold(of_values, f64::max);
        let missing = lost + f64::from(wanted) - f64::from(bits);
        if missing <= 0.0 && carried.undetermined_from().is_none() {
            return Ok(history);
        }
        // A double root needs two bits for each that is missing.
        let more = if missing.is_finite() { 2.0 * missing.max(0.0).ceil() + 8.0 } else { f64::from(bits) };
        if f64::from(bits) + more > f64::from(MAX_BITS) {
            return Err(Error::Unsettled { digits, bits });
        }
        bits += more as u32;
    }
}

/// How many bits the history of an undamped rod loses to rounding: `log₂` of the factor by which its error bound grows.
///
/// **Source**: marches in double precision, each twice as long as the one before, as far as doubles determine
/// the events; where they do not, the loss goes on at the same rate per round trip. In a chaotic history the impacts
/// multiply, and the loss of each becomes smaller, but that of a round trip does not.
///
/// **Accuracy**: *f64 estimate*; zero where the run is not given by a time.
///
/// ```
/// use dalembert::{Problem, rod::Run, solve::bits_lost};
/// let mut problem = Problem::uniform(1.into(), 1.into(), 1.into(), "3/2".parse()?);
/// problem.run = Run::Time(400.into());
/// // About 48 digits.
/// assert!((150.0..180.0).contains(&bits_lost(&problem)));
/// # Ok::<(), dalembert::number::NumberError>(())
/// ```
pub fn bits_lost(problem: &Problem) -> f64 {
    let Run::Time(end) = &problem.run else { return 0.0 };
    let (Ok(rod), end) = (Parameters::<f64>::of(problem, &()), end.to_f64()) else { return 0.0 };
    let (mut time, mut lost) = (end.min(4.0 * rod.round_trip()), 0.0);
    loop {
        let Ok(number) = time.to_string().parse::<Number>() else { return lost };
        let part = Problem { run: Run::Time(number), ..problem.clone() };
        let Ok(history) = undamped_within::<f64>(&part, &(), Limits::keeping_from(problem, time), |_, _| ()) else {
            return lost;
        };
        let found = history.carried().ground().relative_error.max(1.0).log2();
        if history.carried().undetermined_from().is_some() {
            return if lost > 0.0 { lost } else { found * end / time };
        }
        lost = found * end / time;
        if time >= end {
            return lost;
        }
        time = (2.0 * time).min(end);
    }
}

/// The history of a damped rod to `digits` digits: of the natural scales, of what is left of the motion when the first
/// contact ends, and of each quantity that is not much smaller than either.
///
/// **Errors**: [`Error::Unsettled`], and those of the run.
pub fn damped_to_digits(problem: &Problem, digits: u32) -> Result<Box<dyn History<Float>>, Error> {
    damped_unless_faint(problem, digits, f64::INFINITY)
}

/// [`damped_to_digits`], but a motion that has decayed by more than `faintest` powers of e at the bounce ends there.
pub(super) fn damped_unless_faint(
    problem: &Problem,
    digits: u32,
    faintest: f64,
) -> Result<Box<dyn History<Float>>, Error> {
    let fits = problem.has_closed_form();
    let faded = if fits {
        let rod = Parameters::<f64>::of(problem, &())?;
        let bounce = FirstContact::new(&rod).bounce_within(1e-10);
        faded(&rod, &bounce, problem) / std::f64::consts::LN_10
    } else {
        0.0
    };
    // The rays of a contact that has faded by e⁻ᵏ cancel by e⁻ᵏ.
    let mut kept = f64::from(digits + SPARE_DIGITS) + faded;
    let goal = -(f64::from(digits + 1) + faded);
    let follow = faded * std::f64::consts::LN_10 <= faintest;
    let mut bits = bits_for_digits((kept + faded).ceil() as u32) + GUARD_BITS;
    for _ in 0..MOST_TRIES {
        let history: Box<dyn History<Float>> = if fits {
            let rod = Parameters::<Float>::of(problem, &bits)?;
            let bounce = FirstContact::new(&rod).bounce();
            if matches!(bounce, Bounce::Undecided { digits: true, .. }) {
                bits *= 2;
                continue;
            }
            Box::new(Joined::<Float>::solve(problem, &bits, kept, bounce, follow)?)
        } else {
            Box::new(Damped::<Float>::solve(problem, &bits, kept)?)
        };
        let estimate = history.error_estimate();
        let reached = if estimate.is_zero() { f64::NEG_INFINITY } else { estimate.log10().to_f64() };
        let missing = reached - goal;
        if missing <= 0.0 {
            return Ok(history);
        }
        // A tangential landing needs two digits for each that is missing.
        let more = 2.0 * missing.min(kept) + 2.0;
        kept += more;
        bits += bits_for_digits(more.ceil() as u32);
    }
    Err(Error::Unsettled { digits, bits })
}

/// By which power of e the lowest mode has decayed where the first contact ends, or where the run does: underdamped modes
/// decay like `e^{−rt}`, an overdamped one like `e^{−(r − √(r² − ω²)) t}` with `ω = π/t₁`. Under gravity a contact that
/// does not end tends to the static state, and nothing that matters fades.
pub(super) fn faded(rod: &Parameters<f64>, bounce: &Bounce<f64>, problem: &Problem) -> f64 {
    let round_trip = rod.round_trip();
    let lowest = std::f64::consts::PI / round_trip;
    let rate = if rod.damping <= lowest {
        rod.damping
    } else {
        // r − √(r² − ω²), as it adds.
        lowest * lowest / (rod.damping + (rod.damping * rod.damping - lowest * lowest).sqrt())
    };
    let run = match &problem.run {
        Run::Time(time) => time.to_f64(),
        Run::Impacts(_) => f64::INFINITY,
    };
    match bounce {
        Bounce::At { time, .. } => rate * time.min(run),
        Bounce::Never { .. } if rod.gravity > 0.0 => 0.0,
        Bounce::Never { .. } => rate * run.min(8.0 * round_trip),
        Bounce::Undecided { until, .. } => rate * until.min(run),
    }
}
