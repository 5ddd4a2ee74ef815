//! The same hard arguments for every motion, in every number system: both limits at rays and events, the start and the
//! end, both ends of the rod, points on rays, grids, in either order.

use std::fmt::Debug;
use std::sync::Arc;

use dalembert::engine::{ContactHistory, Damped, Limits, Motion, RayRegister, Scales, Undamped, unobserved};
use dalembert::number::{Bounded, Scalar};
use dalembert::special::RoundedSpecial;
use dalembert::{Error, Estimate, Field, Problem, Rational, Run, Side};

/// How many answers have been compared, whose bounds say something.
#[derive(Default)]
struct Tally(usize);

impl Tally {
    /// Two answers are the same within their bounds.
    fn same<S: Scalar>(&mut self, what: &dyn Debug, a: &S, b: &S) {
        let apart = a.clone() - b;
        assert_ne!(apart.vanishes(), Ok(false), "{what:?}: {a:?} and {b:?}");
        // Enclosures that are open at zero are compared as well: they hold it.
        self.0 += usize::from(apart.log2_error() < -20.0);
    }

    fn fields<S: Scalar>(&mut self, what: &dyn Debug, a: &Field<S>, b: &Field<S>) {
        self.same(what, &a.displacement, &b.displacement);
        self.same(what, &a.velocity, &b.velocity);
        self.same(what, &a.strain, &b.strain);
    }
}

/// Times at which limits differ, and others.
pub(crate) fn times<S: Scalar>(motion: &dyn Motion<S>) -> Vec<S> {
    let (end, rays) = (motion.end(), RayRegister::of(motion));
    let mut times = vec![end.zero(), end.clone(), end.clone() * end.ratio(3, 17), end.clone() * end.ratio(7, 9)];
    times.extend(motion.events().iter().map(|event| event.t.clone()));
    for point in [end.zero(), motion.scales().length, motion.scales().length * end.ratio(1, 4)] {
        times.extend(rays.passing(&point, 0.0, end.to_f64()).into_iter().take(9).map(|ray| ray.time));
    }
    times.retain(|time| time.negative() == Ok(false) && end.below(time) != Ok(true));
    times.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    times
}

/// What a motion answers about one time, in words, to compare orders.
pub(crate) fn answers<S: Scalar>(motion: &dyn Motion<S>, points: &[S], time: &S) -> String {
    let ask = |side| {
        let field = |point| motion.field(point, time, side);
        (motion.strain(time, side), motion.ground_end(time, side), points.iter().map(field).collect::<Vec<_>>())
    };
    format!("{:?}", (ask(Side::Left), ask(Side::Right), motion.centre(time), motion.energy(time)))
}

/// Everything that can be asked of `motion` fits together; returns how many answers have been compared.
pub(crate) fn conforms<S: Scalar>(motion: &dyn Motion<S>) -> usize {
    let mut tally = Tally::default();
    let Scales { length, gravity, wave_speed, .. } = motion.scales();
    let (zero, end) = (length.zero(), motion.end());
    let points: Vec<S> = [(0, 1), (1, 4), (3, 8), (1, 2), (1, 1)].map(|(p, q)| length.ratio(p, q) * &length).into();
    let times = times(motion);
    for time in &times {
        let at = |side| (time.clone(), side);
        for side in [Side::Left, Side::Right] {
            // Where enclosures leave a limit open there is none to compare.
            let (Ok(strain), Ok((height, rate))) = (motion.strain(time, side), motion.ground_end(time, side)) else {
                continue;
            };
            let Ok(ground) = motion.field(&zero, time, side) else { continue };
            let ends = Field { displacement: height, velocity: rate, strain };
            tally.fields(&("ground", at(side)), &ground, &ends);
            if let (Ok(top), Ok((height, rate))) = (motion.field(&length, time, side), motion.top_end(time, side)) {
                tally.same(&("v(L)", at(side)), &top.displacement, &height);
                tally.same(&("v_t(L)", at(side)), &top.velocity, &rate);
            }
        }
        let limits = |point: &S| {
            let [left, right] = [Side::Left, Side::Right].map(|side| motion.field(point, time, side));
            Some((left.ok()?, right.ok()?))
        };
        if motion.may_jump(time) == Ok(false) {
            for (left, right) in [&zero, &length].into_iter().filter_map(limits) {
                tally.fields(&("no jump", time), &left, &right);
            }
        }
        if let (Ok((h, rate)), Ok(energy), Ok([kinetic, strain])) =
            (motion.centre(time), motion.energy(time), motion.energy_parts(time))
        {
            let weight = gravity.clone() * &h * &length;
            tally.same(&("E", time), &energy.total, &(energy.translational.clone() + &energy.vibrational));
            tally.same(&("E_h", time), &energy.translational, &(rate.square() * &length / h.int(2) + &weight));
            tally.same(&("parts", time), &energy.total, &(kinetic + strain + weight));
            if let Ok(moments) = motion.moments(time, &points) {
                let whole = |of: usize| moments.iter().fold(zero.clone(), |sum, cell| sum + &cell[of][0]);
                tally.same(&("∫ v", time), &whole(0), &(h * &length));
                tally.same(&("∫ v_t", time), &whole(1), &(rate * &length));
            }
        }
        // What the time of the question is off by makes of velocities, with slopes of at most 1.
        let rounded = time.clone() - time;
        // The data at t = 0 bend where no ray has passed yet.
        let started = time.positive() == Ok(true);
        if let (true, Ok(rates)) = (started, motion.rates(&grid(&points, std::slice::from_ref(time)))) {
            for (point, [velocity, strain]) in points.iter().zip(rates) {
                // On a ray the value of one of its sides, where two cross between them as well: each of both invariants
                // is that of one limit.
                let Some((left, right)) = limits(point) else { continue };
                for sign in [1, -1] {
                    let of = |v_t: &S, v_x: &S| v_x.int(sign) * v_x * &wave_speed + v_t;
                    let off = |field: &Field<S>| of(&field.velocity, &field.strain) - of(&velocity, &strain) + &rounded;
                    let found = [&left, &right].map(|field| off(field).vanishes() != Ok(false));
                    assert!(found[0] || found[1], "{point:?} {time:?}: {velocity:?} {strain:?}, {left:?} {right:?}");
                }
                tally.0 += 1;
            }
        }
    }
    // In one march, and in either order.
    if let Ok(all) = motion.rates(&grid(&points, &times)) {
        for (time, of_time) in times.iter().zip(all.chunks(points.len())) {
            let Ok(alone) = motion.rates(&grid(&points, std::slice::from_ref(time))) else { continue };
            for (a, b) in alone.iter().flatten().zip(of_time.iter().flatten()) {
                tally.same(&("in one march", time), a, b);
            }
        }
    }
    let ask = |time: &S| answers(motion, &points, time);
    let forwards: Vec<String> = times.iter().map(ask).collect();
    let mut backwards: Vec<String> = times.iter().rev().map(ask).collect();
    backwards.reverse();
    assert_eq!(forwards, backwards);
    // Times are known by their events.
    for contact in motion.contacts() {
        let known = |time: &S| motion.events().iter().any(|event| event.t.text() == time.text());
        assert!(known(&contact.impact) && contact.release.as_ref().is_none_or(known), "{contact:?}");
    }
    let pieces = motion.stress_pieces();
    for pair in pieces.windows(2) {
        tally.same(&"pieces without a gap", &pair[0].end, &pair[1].start);
    }
    for (piece, side) in pieces.iter().flat_map(|piece| [(piece, Side::Left), (piece, Side::Right)]) {
        let (time, value) =
            if side == Side::Left { (&piece.end, &piece.strain_start) } else { (&piece.start, &piece.strain_start) };
        let value = if side == Side::Left { &piece.strain_end } else { value };
        if let Ok(strain) = motion.strain(time, side) {
            tally.same(&("stress piece", time, side), &strain, value);
        }
    }
    refuses(motion, &length, &end);
    tally.0
}

/// Returns every point at every time, in the order of time.
pub(crate) fn grid<S: Clone>(points: &[S], times: &[S]) -> Vec<(S, S)> {
    times.iter().flat_map(|time| points.iter().map(|point| (point.clone(), time.clone()))).collect()
}

/// No time or point that is not there is answered.
pub(crate) fn refuses<S: Scalar>(motion: &dyn Motion<S>, length: &S, end: &S) {
    let (beyond, before) = (end.clone() + end.ratio(1, 8) * length, -length.one());
    for time in [beyond, before] {
        let asked = [
            motion.strain(&time, Side::Left).err(),
            motion.ground_end(&time, Side::Right).err(),
            motion.top_end(&time, Side::Right).err(),
            motion.field(length, &time, Side::Left).err(),
            motion.centre(&time).err(),
            motion.energy(&time).err(),
            motion.energy_parts(&time).err(),
            motion.moments(&time, &[length.zero(), length.clone()]).err(),
            motion.rates(&[(length.clone(), time.clone())]).err(),
        ];
        for (k, error) in asked.iter().enumerate() {
            assert!(matches!(error, Some(Error::TimeOutside { .. })), "{k}: {error:?} at {time:?}");
        }
    }
    for point in [length.int(2) * length, -length.one()] {
        let time = end.clone() * end.ratio(1, 3);
        let field = motion.field(&point, &time, Side::Right).err();
        assert!(matches!(field, Some(Error::PointOutside { .. })), "{field:?} at {point:?}");
        let rates = motion.rates(&[(point.clone(), time)]).err();
        assert!(matches!(rates, Some(Error::PointOutside { .. })), "{rates:?} at {point:?}");
    }
}

/// A rod of `c = L = g = 1`.
pub(crate) fn rod(speed: &str, damping: Option<&str>, run: Run) -> Problem {
    let number = |text: &str| text.parse().unwrap();
    let mut problem = Problem::uniform(number("1"), number("1"), number("1"), number(speed));
    problem = problem.to_builder().damping(damping.map_or(0.into(), number)).run(run).build().unwrap();
    problem
}

/// Rods without damping: a uniform start, and data with corners under a held top.
pub(crate) fn undamped() -> [Problem; 2] {
    let mut held = Problem::builder().length(1).wave_speed(1).gravity(1).fixed_top().time(7);
    held = held.displacement([("0", "1/2"), ("1/3", "1/4"), ("1", "0")]);
    let held = held.velocity([("0", "-1"), ("1/2", "-1"), ("1", "0")]).build().unwrap();
    [rod("3/2", None, Run::Impacts(3)), held]
}

pub(crate) fn lattice<N: Bounded>(problem: &Problem, precision: &N::Precision) -> Undamped<N> {
    Undamped::solve_within(problem, precision, Limits::default(), &unobserved).unwrap()
}

pub(crate) fn both<S: RoundedSpecial>(precision: &S::Precision, digits: f64) -> [Arc<dyn Motion<Estimate<S>>>; 2] {
    let problem = rod("3", Some("1/10"), Run::Impacts(3));
    [
        Arc::new(Damped::<S>::solve(&problem, precision, digits).unwrap()),
        Arc::new(ContactHistory::<Estimate<S>>::solve(&problem, precision).unwrap()),
    ]
}

#[test]
fn doubles_conform() {
    for problem in undamped() {
        let compared = conforms(&lattice::<Estimate<f64>>(&problem, &()));
        assert!(compared > 250, "{compared}");
        let mut damped = problem;
        damped = damped.to_builder().damping("1/10").build().unwrap();
        let compared = conforms(&Damped::<f64>::solve(&damped, &(), 13.0).unwrap());
        assert!(compared > 250, "{compared}");
    }
    for motion in both::<f64>(&(), 13.0) {
        let compared = conforms(&*motion);
        assert!(compared > 250, "{compared}");
    }
}

#[test]
fn fractions_conform() {
    for problem in undamped() {
        let compared = conforms(&lattice::<Rational>(&problem, &()));
        assert!(compared > 250, "{compared}");
    }
}
