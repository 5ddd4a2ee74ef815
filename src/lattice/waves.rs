//! The solution as two travelling waves: the ground trace integrated once.

use super::history::Undamped;
use super::start::Units;
use super::trace::Place;
use crate::error::Error;
use crate::motion::{WavePiece, Waves};
use crate::number::Bounded;
use crate::problem::Top;

/// More pieces than this are no function to be written into a program.
const MOST_PIECES: usize = 1_000_000;

impl<N: Bounded> Undamped<N> {
    /// With `p` of the ground trace, `v_t − c v_x` is `p(t − x/c) − g x/c`, and `v_t + c v_x` is
    /// `±p(t + x/c − t₁) + g x/c`, less `g t₁` under a free top, which half of it in each `p` stands for.
    pub(super) fn travelling(&self) -> Result<Waves<N>, Error> {
        let Units { round_trip, velocity, wave_speed, length } = &self.problem.units;
        let trace = &self.ground.trace;
        if trace.begin() > 1 {
            let start = (round_trip.int(trace.begin() as i64 - 1) * round_trip).text();
            return Err(Error::TimeForgotten { found: "0".into(), start });
        }
        let pull = match self.problem.top {
            Top::Free => self.problem.gravity.clone().halved(),
            Top::Fixed => velocity.zero(),
        };
        let mut pieces: Vec<WavePiece<N>> = Vec::new();
        for index in 0..=trace.trips() {
            for piece in 0..trace.slice(index).len() {
                let here = trace.piece(&Place { index, piece, age: velocity.zero() });
                let from = (here.age.int(index as i64 - 1) + &here.age) * round_trip;
                let rate = (here.line.value_at(&here.age) - &pull) * velocity;
                let slope = here.line.slope * velocity / round_trip;
                let sum = match pieces.last() {
                    None => velocity.zero(),
                    Some(last) => {
                        let (before, arrived) = last.at(&from);
                        if last.slope.same(&slope) && arrived.same(&rate) {
                            continue;
                        }
                        before
                    }
                };
                pieces.push(WavePiece { from, sum, rate, slope });
            }
            if pieces.len() > MOST_PIECES {
                let time = round_trip.to_f64() * index as f64;
                return Err(Error::TooManyPieces { limit: MOST_PIECES, time });
            }
        }
        // g itself, from that of the lattice.
        let curvature = self.problem.gravity.clone() * velocity / round_trip / wave_speed.square();
        let start = self.problem.ground_start.clone() * velocity * round_trip;
        let zero = velocity.zero();
        let mut waves = Waves {
            linear: match self.problem.top {
                Top::Free => -(curvature.clone() * length),
                Top::Fixed => zero.clone(),
            },
            quadratic: curvature.halved(),
            constant: zero.clone(),
            top: self.problem.top,
            round_trip: round_trip.clone(),
            wave_speed: wave_speed.clone(),
            length: length.clone(),
            pieces,
        };
        waves.constant = start - waves.at(&zero, &zero).displacement;
        Ok(waves)
    }
}
