use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::motion::{Ending, StressPiece};
use crate::number::{Estimate, Float};
use crate::problem::Problem;

type Long = Estimate<Float>;

/// An engine that counts its grids, and answers no other query.
#[derive(Debug)]
struct Grids(Course<Long>, AtomicUsize);

impl Motion<Long> for Grids {
    fn course(&self) -> &Course<Long> {
        &self.0
    }
    fn scales(&self) -> Scales<Long> {
        let one = || self.0.end.one();
        Scales { time: one(), velocity: one(), length: one(), wave_speed: one(), gravity: one() }
    }
    fn stress_pieces(&self) -> Vec<StressPiece<Long>> {
        Vec::new()
    }
    fn strain(&self, _: &Long, _: Side) -> Result<Long, Error> {
        Err(Error::NoWaves)
    }
    fn pair(&self, _: Pair, _: &Long, _: Side) -> Result<[Long; 2], Error> {
        Err(Error::NoWaves)
    }
    fn field(&self, _: &Long, _: &Long, _: Side) -> Result<Field<Long>, Error> {
        Err(Error::NoWaves)
    }
    fn rates(&self, places: &[(Long, Long)]) -> Result<Vec<[Long; 2]>, Error> {
        self.1.fetch_add(1, Ordering::Relaxed);
        Ok(places.iter().map(|(x, t)| [x.clone(), t.clone()]).collect())
    }
    fn highest(&self, _: usize) -> Option<(Long, Long)> {
        None
    }
    fn error_estimate(&self) -> Long {
        self.0.end.zero()
    }
}

/// Checks that a grid in longer numbers is marched once.
#[test]
fn a_grid_is_asked_of_the_engine_as_a_whole() {
    let end = Estimate::exact(Float::with_val(128, 2));
    let engine = Arc::new(Grids(Course::new(end, Ending::Time), AtomicUsize::new(0)));
    let read = Converted::<_, Estimate<f64>>::new(engine.clone());
    let grid = [0.0, 0.25, 0.5].map(Estimate::exact);
    let places: Vec<_> = grid.iter().flat_map(|t| grid.iter().map(|x| (x.clone(), t.clone()))).collect();
    assert_eq!(read.rates(&places).unwrap().len(), 9);
    assert_eq!(engine.1.load(Ordering::Relaxed), 1);
}

/// Builds a problem under a fixed top, with jumps and kinks.
fn profile() -> Problem {
    let number = |text: &str| text.parse::<crate::number::Number>().unwrap();
    let list = |list: &[(&str, &str)]| list.iter().map(|(x, v)| (number(x), number(v))).collect::<Vec<_>>();
    let velocity = [("0", "-4"), ("1/12", "-3/2"), ("1/12", "-1/2"), ("1/6", "-1"), ("7/12", "-7/2"), ("1", "0")];
    let rod = Problem::builder().length(1).wave_speed(1).gravity(number("1/6")).fixed_top();
    let rod = rod.displacement(list(&[("0", "0"), ("1/4", "1"), ("1", "1")])).velocity(list(&velocity));
    rod.time(number("11/2")).build().unwrap()
}

/// Returns the answers to all queries at a time.
fn asked<S: Scalar>(motion: &dyn Motion<S>, (point, time): (&S, &S), grid: &[S]) -> Vec<S> {
    let mut found = Vec::new();
    for pair in [Pair::GroundEnd, Pair::Centre, Pair::Energy, Pair::EnergyParts] {
        found.extend(motion.pair(pair, time, Side::Right).unwrap());
    }
    let Field { displacement, velocity, strain } = motion.field(point, time, Side::Right).unwrap();
    found.extend([displacement, velocity, strain, motion.strain(time, Side::Right).unwrap()]);
    found.extend(motion.moments(time, grid).unwrap().into_iter().flatten().flatten());
    found
}

/// Checks at points and times that no number of `M` spells that the answers are within their bounds of those in
/// fractions. Returns how many numbers differ by more than their rounding.
fn within<N: crate::number::Bounded, S: crate::number::Rounded>(
    precision: &N::Precision,
    own: &<Estimate<S> as Scalar>::Precision,
    rational: fn(&S) -> rug::Rational,
) -> usize
where
    Estimate<S>: Reads<N>,
{
    let problem = profile();
    let truth = Undamped::<rug::Rational>::solve(&problem, &()).unwrap();
    let engine = Arc::new(Undamped::<N>::solve(&problem, precision).unwrap());
    let read = Converted::<N, Estimate<S>>::new(engine);
    let (mut off, mut compared) = (0, 0);
    for k in 1..60 {
        let time = rug::Rational::from((642 * k + 1, 77255));
        let point = rug::Rational::from((1287 * k + 2, 77256));
        let lift = |x: &rug::Rational| Estimate::<S>::spelling(&x.to_string().parse().unwrap(), own);
        let grid = [rug::Rational::new(), (1, 4).into(), (5, 8).into(), 1.into()];
        let exact = grid.each_ref().map(|x| Estimate::exact(lift(x).into_value()));
        let expected = asked(&truth, (&point, &time), &grid);
        for (j, (found, expected)) in
            asked(&read, (&lift(&point), &lift(&time)), &exact).iter().zip(expected).enumerate()
        {
            let bits = found.bits().unwrap();
            let bound = rug::Rational::from_f64(found.error() * (1.0 + 1e-12)).unwrap() >> bits;
            let away = (rational(found.value()) - &expected).abs();
            assert!(away <= bound, "{j} at {point}, {time}: {found:?}, expected {}", expected.to_f64());
            // Five digits allow for the width of eight enclosures.
            assert!(found.error() < 1e5, "{j} at {point}, {time}: {found:?}");
            off += usize::from(away > rug::Rational::from(expected.abs_ref()) >> bits);
            compared += 1;
        }
    }
    assert_eq!(compared, 59 * 30);
    off
}

/// Checks that a time or a point with more digits than a double counts as known within roundings, which the answers of
/// all number systems carry. The same holds for one that longer numbers round, if enclosures answer.
#[test]
fn what_no_number_spells_is_known_within_a_rounding() {
    let double = |x: &f64| rug::Rational::from_f64(*x).unwrap();
    let long = |x: &Float| x.to_rational().unwrap();
    let off = [
        within::<rug::Rational, f64>(&(), &(), double),
        within::<Estimate<Float>, f64>(&128, &(), double),
        within::<crate::number::Interval, f64>(&crate::number::IntervalPrecision::with_exact(128), &(), double),
        within::<crate::number::Interval, Float>(&crate::number::IntervalPrecision::with_exact(128), &128, long),
    ];
    assert!(off.iter().all(|off| *off > 100), "{off:?}");
}
