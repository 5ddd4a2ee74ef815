//! An engine that carries one bound for all, read as numbers that carry their own.
use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Field, Motion, Scales, Side, StressPiece};
use crate::number::{Estimate, Rounded};

#[derive(Debug)]
pub(crate) struct Raised<S, E> {
    engine: E,
    events: Vec<Event<Estimate<S>>>,
    contacts: Vec<Contact<Estimate<S>>>,
    unit: [f64; 6],
}

impl<S: Rounded, E: Motion<S>> Raised<S, E> {
    pub(crate) fn new(engine: E) -> Self {
        let sc = engine.scales();
        let relative = (engine.error_estimate() / sc.time.roundoff()).to_f64() + 4.0;
        let (t, v, l, c) = (sc.time.to_f64(), sc.velocity.to_f64(), sc.length.to_f64(), sc.wave_speed.to_f64());
        let end = engine.end().to_f64().max(t);
        let unit = [t, v, v * t, v / c, v * v * l, v * l].map(|x| x * relative);
        let e = |x: &S, u: f64| Estimate::new(x.clone(), u + x.to_f64().abs());
        let events = engine
            .events()
            .iter()
            .map(|ev| Event {
                kind: ev.kind,
                time: Estimate::new(
                    ev.time.clone(),
                    (ev.time.double(ev.time_error) / ev.time.roundoff()).to_f64() + ev.time.to_f64() + 0.0 * end,
                ),
                end_velocity: e(&ev.end_velocity, unit[1]),
                centre: e(&ev.centre, unit[2]),
                centre_velocity: e(&ev.centre_velocity, unit[1]),
                time_error: ev.time_error,
            })
            .collect::<Vec<_>>();
        let contacts = engine
            .contacts()
            .iter()
            .map(|k| Contact {
                from: e(&k.from, unit[0]),
                to: k.to.as_ref().map(|x| e(x, unit[0])),
                impulse: e(&k.impulse, unit[5]),
                peak_stress: e(&k.peak_stress, unit[3]),
            })
            .collect();
        Raised { engine, events, contacts, unit }
    }
    fn e(&self, x: S, k: usize) -> Estimate<S> {
        let size = x.to_f64().abs();
        Estimate::new(x, self.unit[k] + size)
    }
    fn p(&self, (a, b): (S, S)) -> (Estimate<S>, Estimate<S>) {
        (self.e(a, 2), self.e(b, 1))
    }
}
impl<S: Rounded, E: Motion<S>> Motion<Estimate<S>> for Raised<S, E> {
    fn end(&self) -> Estimate<S> {
        Estimate::rounded(self.engine.end(), 2.0)
    }
    fn ending(&self) -> &Ending {
        self.engine.ending()
    }
    fn events(&self) -> &[Event<Estimate<S>>] {
        &self.events
    }
    fn contacts(&self) -> &[Contact<Estimate<S>>] {
        &self.contacts
    }
    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        self.engine
            .stress_pieces()
            .into_iter()
            .map(|p| StressPiece {
                from: self.e(p.from, 0),
                to: self.e(p.to, 0),
                left: self.e(p.left, 3),
                right: self.e(p.right, 3),
                chebyshev: p.chebyshev.into_iter().map(|c| self.e(c, 3)).collect(),
            })
            .collect()
    }
    fn stress(&self, t: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        Ok(self.e(self.engine.stress(t.value(), side)?, 3))
    }
    fn ground_end(&self, t: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        Ok(self.p(self.engine.ground_end(t.value(), side)?))
    }
    fn top_end(&self, t: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        Ok(self.p(self.engine.top_end(t.value(), side)?))
    }
    fn centre(&self, t: &Estimate<S>) -> Result<(Estimate<S>, Estimate<S>), Error> {
        Ok(self.p(self.engine.centre(t.value())?))
    }
    fn energy(&self, t: &Estimate<S>) -> Result<Energy<Estimate<S>>, Error> {
        Ok(self.engine.energy(t.value())?.map(|x| self.e(x, 4)))
    }
    fn field(&self, x: &Estimate<S>, t: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let f = self.engine.field(x.value(), t.value(), side)?;
        Ok(Field {
            displacement: self.e(f.displacement, 2),
            velocity: self.e(f.velocity, 1),
            strain: self.e(f.strain, 3),
        })
    }
    fn highest(&self, release: &Event<Estimate<S>>) -> Option<(Estimate<S>, Estimate<S>)> {
        let k = self.events.iter().position(|e| e.time.value() == release.time.value() && e.kind == release.kind)?;
        let (t, h) = self.engine.highest(self.engine.events().get(k)?)?;
        Some((self.e(t, 0), self.e(h, 2)))
    }
    fn scales(&self) -> Scales<Estimate<S>> {
        self.engine.scales().map(|x| Estimate::rounded(x, 8.0))
    }
    fn error_estimate(&self) -> Estimate<S> {
        Estimate::exact(self.engine.error_estimate())
    }
    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.engine.digits_lost()
    }
    fn warnings(&self) -> &[String] {
        self.engine.warnings()
    }
}
