//! Estimates, in doubles, of the bits that a run is going to lose.

use crate::lattice::{Limits, Undamped};
use crate::motion::unobserved;
use crate::number::{Estimate, Number};
use crate::problem::{Parameters, Problem, Run};

/// Estimated cost in bits of the proof of a damped march: through the first flight, per impact, per impact and doubling
/// of the flights; and the maximum number of impacts in the estimate.
const FIRST_PROOF: f64 = 28.0;
const IMPACT: f64 = 2.2;
const LONGER: f64 = 0.45;
const MOST_FORESEEN: f64 = 60.0;

/// Estimates the bits that the proof of a damped march costs; `contacts` estimates the contacts by the round trip.
///
/// **Accuracy**: *estimate*, from the losses of runs: unit rods lost 46 to 73 bits in ten impacts, a steel rod 128 in
/// twenty. An estimate that is too low costs a second run.
pub(super) fn proof_bits(problem: &Problem, contacts: impl FnOnce(f64) -> f64) -> u32 {
    let Ok(rod) = Parameters::<f64>::of(problem, &()) else { return 0 };
    let trip = rod.round_trip();
    let flight = if rod.gravity > 0.0 { 2.0 * rod.speed / (rod.gravity * trip) } else { f64::INFINITY };
    let slowed = (0.5 / (rod.damping * trip)).min(flight.max(1.0));
    let impact = IMPACT + LONGER * (1.0 + slowed).log2();
    (FIRST_PROOF + impact * contacts(trip).min(MOST_FORESEEN)) as u32
}

/// Estimates the bits that the history of an undamped rod loses to rounding until `end`: `log₂` of the growth factor of
/// its error bound.
///
/// **Source**: marches in double precision, each twice as long as the previous one, as far as doubles determine the
/// history. If they do not determine its end, the loss is extrapolated at the same rate per round trip. In a chaotic
/// history the impacts multiply and the loss per impact decreases, but the loss per round trip does not.
///
/// **Accuracy**: *estimate*. A plan with too low an estimate adds bits later.
pub(super) fn bits_lost(problem: &Problem, end: f64) -> f64 {
    let Ok(rod) = Parameters::<f64>::of(problem, &()) else { return 0.0 };
    if end <= 0.0 {
        return 0.0;
    }
    let (mut time, mut lost) = (end.min(4.0 * rod.round_trip()), 0.0);
    loop {
        let Ok(number) = time.to_string().parse::<Number>() else { return lost };
        let part = problem.shortened(Run::Time(number));
        let limits = Limits::keeping_from(problem, time);
        let Ok(history) = Undamped::<Estimate<f64>>::solve_within(&part, &(), limits, &unobserved) else { return lost };
        let found = history.ground().relative_error.max(1.0).log2();
        if history.undetermined_from().is_some() {
            return if lost > 0.0 { lost } else { found * end / time };
        }
        lost = found * end / time;
        if time >= end {
            return lost;
        }
        time = (2.0 * time).min(end);
    }
}
