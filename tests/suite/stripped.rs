//! The undamped march of one precision, without plan and ladder, read in numbers without their bounds.

use dalembert::engine::{Course, Damped, Limits, Motion, Pair, Scales, Undamped, unobserved};
use dalembert::number::{Answer, Scalar};
use dalembert::special::RoundedSpecial;
use dalembert::{Error, Estimate, Event, Field, Problem, Ray, Side, StressPiece};

/// An undamped history, computed in numbers that carry their bounds and read without them.
pub(crate) type StrippedUndamped<S> = Stripped<S, Undamped<<S as Answer>::Carried>>;

/// The history of `problem`, whose damping is ignored, in doubles, long numbers, fractions or enclosures.
pub(crate) fn undamped<S: Answer>(problem: &Problem, precision: &S::Precision) -> Result<StrippedUndamped<S>, Error> {
    undamped_within(problem, precision, Limits::default())
}

/// [`undamped`] with a limit of one's own.
pub(crate) fn undamped_within<S: Answer>(
    problem: &Problem,
    precision: &S::Precision,
    limits: Limits,
) -> Result<StrippedUndamped<S>, Error> {
    Undamped::solve_within(problem, precision, limits, &unobserved).map(Stripped::new)
}

/// The history of `problem` in cells, to about `digits` digits.
pub(crate) fn damped<S>(
    problem: &Problem,
    precision: &S::Precision,
    digits: f64,
) -> Result<Stripped<S, Damped<S>>, Error>
where
    S: Answer<Carried = Estimate<S>> + RoundedSpecial,
{
    Damped::<S>::solve(problem, precision, digits).map(Stripped::new)
}

/// A history whose numbers carry their bounds, read without them.
#[derive(Debug)]
pub(crate) struct Stripped<S: Answer, H> {
    history: H,
    course: Course<S>,
}

impl<S: Answer, H: Motion<S::Carried>> Stripped<S, H> {
    /// `history`, read without bounds; those of event times stay in [`Event::time_error`].
    pub(crate) fn new(history: H) -> Self {
        let events = history.events().iter().map(event).collect();
        let course = Course { events, ..history.course().clone().map(S::strip) };
        Stripped { course, history }
    }

    /// The history that carries the bounds.
    pub(crate) fn carried(&self) -> &H {
        &self.history
    }
}

fn event<S: Answer>(event: &Event<S::Carried>) -> Event<S> {
    Event { t_error: event.t.log2_error().exp2(), ..event.clone().map(S::strip) }
}

impl<S: Answer, H: Motion<S::Carried>> Motion<S> for Stripped<S, H> {
    fn course(&self) -> &Course<S> {
        &self.course
    }

    fn stress_pieces(&self) -> Vec<StressPiece<S>> {
        self.history.stress_pieces().into_iter().map(|piece| piece.map(S::strip)).collect()
    }

    fn strain(&self, time: &S, side: Side) -> Result<S, Error> {
        self.history.strain(&time.carry(), side).map(S::strip)
    }

    fn pair(&self, pair: Pair, time: &S, side: Side) -> Result<[S; 2], Error> {
        self.history.pair(pair, &time.carry(), side).map(|pair| pair.map(S::strip))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        self.history.field(&point.carry(), &time.carry(), side).map(|field| field.map(S::strip))
    }

    fn highest(&self, release: usize) -> Option<(S, S)> {
        self.history.highest(release).map(|(time, height)| (S::strip(time), S::strip(height)))
    }

    fn rays(&self, trip: usize) -> Result<Vec<Ray<S>>, Error> {
        Ok(self.history.rays(trip)?.into_iter().map(|ray| ray.map(S::strip)).collect())
    }

    fn scales(&self) -> Scales<S> {
        self.history.scales().map(S::strip)
    }

    fn error_estimate(&self) -> S {
        S::strip(self.history.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.history.digits_lost()
    }
}
