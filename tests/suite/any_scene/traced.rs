//! An undamped rod traced back along its characteristics.

use dalembert::{EventKind, Number, Problem, Rational, Side, Start, Top, TypedHistory};

/// The characteristics of an undamped rod, from its start and the times of its events.
pub(super) struct Traced<'a> {
    length: Rational,
    wave_speed: Rational,
    gravity: Rational,
    start: &'a Start,
    speed: Rational,
    free: bool,
    events: Vec<(EventKind, Rational)>,
}

impl<'a> Traced<'a> {
    pub(super) fn of(problem: &'a Problem, history: &TypedHistory<Rational>) -> Self {
        let scales = history.scales();
        Traced {
            length: problem.length().to_rational(),
            wave_speed: scales.wave_speed,
            gravity: scales.gravity,
            start: problem.start(),
            // What the end has just before t = 0.
            speed: -history.ground_end(Rational::new(), Side::Left).unwrap().1,
            free: problem.top() == Top::Free,
            events: history.events().iter().map(|event| (event.kind, event.t.clone())).collect(),
        }
    }

    /// `v_t` and `v_x` of the start at a place, the limit from above or from below.
    fn data(&self, x: &Rational, above: bool) -> (Rational, Rational) {
        let Start::Profile(profile) = self.start else { return (Rational::from(-&self.speed), Rational::new()) };
        let piece = |points: &[(Number, Number)]| {
            let points: Vec<[Rational; 2]> = points.iter().map(|(x, v)| [x.to_rational(), v.to_rational()]).collect();
            let within = |a: &Rational, b: &Rational| if above { a <= x && x < b } else { a < x && x <= b };
            points.windows(2).find(|pair| within(&pair[0][0], &pair[1][0])).map(|pair| {
                let slope: Rational =
                    Rational::from(&pair[1][1] - &pair[0][1]) / Rational::from(&pair[1][0] - &pair[0][0]);
                (Rational::from(x - &pair[0][0]) * &slope + &pair[0][1], slope)
            })
        };
        let velocity = piece(&profile.velocity).map_or_else(Rational::new, |found| found.0);
        (velocity, piece(&profile.displacement).map_or_else(Rational::new, |found| found.1))
    }

    /// `v_t + c v_x` just after a time.
    fn down(&self, x: &Rational, t: &Rational) -> Rational {
        let place = Rational::from(x + &Rational::from(t * &self.wave_speed));
        if place < self.length {
            let (velocity, strain) = self.data(&place, true);
            return velocity + strain * &self.wave_speed - Rational::from(&self.gravity * t);
        }
        let way: Rational = Rational::from(&self.length - x) / &self.wave_speed;
        let up = self.up(&self.length, &Rational::from(t - &way));
        (if self.free { up } else { -up }) - way * &self.gravity
    }

    /// `v_t − c v_x` just after a time.
    fn up(&self, x: &Rational, t: &Rational) -> Rational {
        let place = Rational::from(x - &Rational::from(t * &self.wave_speed));
        if place > 0 {
            let (velocity, strain) = self.data(&place, false);
            return velocity - strain * &self.wave_speed - Rational::from(&self.gravity * t);
        }
        let way: Rational = Rational::from(x / &self.wave_speed);
        let time = Rational::from(t - &way);
        let down = self.down(&Rational::new(), &time);
        let last = self.events.iter().rfind(|event| event.1 <= time);
        let contact = last.is_some_and(|event| event.0 == EventKind::Impact);
        (if contact { -down } else { down }) - way * &self.gravity
    }

    /// `v_t` and `v_x` just after a time.
    pub(super) fn at(&self, x: &Rational, t: &Rational) -> [Rational; 2] {
        let (up, down) = (self.up(x, t), self.down(x, t));
        let rate = Rational::from(&up + &down) / 2u32;
        [rate, (down - up) / 2u32 / &self.wave_speed]
    }
}
