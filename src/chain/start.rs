//! The numbers of a chain in one number system, its nodes, and the waves that are in the bodies at the start.

use super::body::{Body, Points};
use super::cluster::{Cluster, Mass};
use super::curve::Signal;
use super::definition::{Chain, End, Joint, Spring};
use super::interface::{Input, Interface, Soft};
use super::law::{Law, Mix};
use super::march::SOFT;
use super::node::{Node, Source};
use super::wave::{Piece, Wave};
use crate::error::{Error, ProblemError, ProblemErrorKind as Kind};
use crate::lattice::Line;
use crate::number::{Bounded, Number, Rational, Scalar};
use crate::quantity::Measure;

/// A body in the numbers of a run.
#[derive(Clone, Debug)]
pub(super) struct Bar<N> {
    pub(super) length: N,
    pub(super) wave_speed: N,
    pub(super) impedance: N,
    /// `L/c`.
    pub(super) travel: N,
    /// The mass of a rigid body; its length and its impedance are zero.
    pub(super) mass: Option<N>,
}

/// A chain in the numbers of a run, at the start. Velocities are those in the frame that falls with `g` from rest.
#[derive(Clone, Debug)]
pub(super) struct Start<N> {
    pub(super) bars: Vec<Bar<N>>,
    pub(super) nodes: Nodes<N>,
    /// The springs of the nodes.
    pub(super) springs: Vec<Option<Soft<N>>>,
    /// The upward and the downward wave of each body.
    pub(super) waves: Vec<[Wave<N>; 2]>,
    pub(super) gravity: N,
    pub(super) until: N,
}

/// The nodes of a chain.
#[derive(Clone, Debug)]
pub(super) enum Nodes<N> {
    /// Nodes of bars whose joints are rigid.
    Rigid(Vec<Node<N>>),
    /// Clusters of a chain with springs, dashpots or masses.
    Soft(Vec<Cluster<N>>),
}

/// Converts a fraction; rounded once if it is short enough for a [`Number`].
///
/// **Errors**: [`Kind::OutOfRange`] if it is below 1e-300 or above 1e300.
fn lift<N: Bounded>(x: &Rational, precision: &N::Precision) -> Result<N, Error> {
    if let Some(number) = Number::of_rational(x) {
        return Ok(N::from_number(&number, precision));
    }
    // p/q = (P/Q) 10ᵏ, where P and Q have the digits of p and q with a point after the first.
    let text = x.to_string();
    let (p, q) = text.split_once('/').unwrap_or((&text, "1"));
    let (sign, p) = p.strip_prefix('-').map_or(("", p), |p| ("-", p));
    let spelled = |text: String| text.parse::<Number>().map(|number| N::from_number(&number, precision));
    let mantissa = |sign: &str, digits: &str| spelled(format!("{sign}{}.{}", &digits[..1], &digits[1..]));
    let power = spelled(format!("1e{}", p.len() as i64 - q.len() as i64));
    match (mantissa(sign, p), mantissa("", q), power) {
        (Ok(p), Ok(q), Ok(power)) => Ok(p / &q * power),
        _ => {
            let found = format!("a ratio of numbers of {} and {} digits", p.len(), q.len());
            Err(ProblemError::new(Kind::OutOfRange, "body", found, "ratios between 1e-300 and 1e300").into())
        }
    }
}

/// Returns the square root of a fraction.
fn root<N: Bounded>(quantity: &'static str, square: &Rational, precision: &N::Precision) -> Result<N, Error> {
    if let Some(root) = square.try_sqrt() {
        return lift(&root, precision);
    }
    let irrational = || Error::Irrational { quantity, square: square.to_string() };
    lift::<N>(square, precision)?.try_sqrt().ok_or_else(irrational)
}

impl<N: Bounded> Start<N> {
    /// Converts `chain`.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction cannot hold a wave speed or an impedance.
    pub(super) fn new(chain: &Chain, precision: &N::Precision) -> Result<Self, Error> {
        let number = |x: &Number| N::from_number(x, precision);
        let gravity = number(&chain.gravity);
        let mut squares = Vec::new();
        let mut bars = Vec::new();
        for body in &chain.bodies {
            let [impedance, wave_speed] = body.squares();
            if let Some(mass) = body.rigid_mass() {
                let [zero, one] = [gravity.zero(), gravity.one()];
                let [length, travel, force] = [zero.clone(), zero.clone(), zero];
                bars.push(Bar { length, wave_speed: one, impedance: force, travel, mass: Some(number(mass)) });
                squares.push(impedance);
                continue;
            }
            let speed: N = root("wave speed", &wave_speed, precision)?;
            let length = number(&body.length);
            let travel = match wave_speed.try_sqrt() {
                Some(speed) => lift(&(body.length.to_rational() / speed), precision)?,
                None => length.clone() / &speed,
            };
            let force = root("impedance", &impedance, precision)?;
            bars.push(Bar { length, wave_speed: speed, impedance: force, travel, mass: None });
            squares.push(impedance);
        }
        let waves = chain.bodies.iter().zip(&bars).map(|(body, bar)| waves(body, bar, precision));
        let waves = waves.collect::<Result<_, _>>()?;
        let top = bars.len();
        let springs = (0..=top).map(|node| chain.spring(node).map(|spring| soft(spring, precision)).transpose());
        let springs: Vec<Option<Soft<N>>> = springs.collect::<Result<_, _>>()?;
        let is_soft = SOFT && chain.is_soft();
        let mut masses = 0;
        let mut nodes = Vec::with_capacity(top + 1);
        let mut clusters = Vec::new();
        let mut parts: (Vec<Interface<N>>, Vec<Mass<N>>) = Default::default();
        for at in 0..=top {
            let (below, above) = (at.checked_sub(1), (at < top).then_some(at));
            let is_mass = |body: Option<usize>| body.is_some_and(|body| chain.bodies[body].rigid_mass().is_some());
            let own = masses;
            let wave = |body: usize| match is_mass(Some(body)) {
                // The mass below is the one that the interface before has begun.
                true => (Source::Mass(if Some(body) == below { own - 1 } else { own }), None),
                false => (Source::Wave(body), Some(squares[body].clone())),
            };
            // The outer side of an end, with the square of its impedance; a rigid one has none.
            let (outer, law) = match (below, above) {
                (Some(joint), Some(_)) => {
                    let contact = matches!(chain.joints[joint], Joint::Contact { .. });
                    ((Source::Nothing, None), if contact { Law::Contact } else { Law::Held })
                }
                _ => {
                    let signal = |points: &Points, fall: &N| Source::Data(signal(points, fall, precision));
                    let zero = gravity.zero();
                    let own = squares[if at == 0 { 0 } else { top - 1 }].clone();
                    match &chain.ends[usize::from(at == top)] {
                        End::Free => ((Source::Nothing, None), Law::Force),
                        End::Force(points) => ((signal(points, &zero), None), Law::Force),
                        End::Velocity(points) => ((signal(points, &gravity), None), Law::Held),
                        End::Ground { velocity, .. } => ((signal(velocity, &gravity), None), Law::Contact),
                        End::Infinite { impedance, gap } => {
                            let law = if gap.is_some() { Law::Contact } else { Law::Held };
                            let square = impedance.as_ref().map_or(own, |z| Scalar::square(&z.to_rational()));
                            ((signal(&Vec::new(), &gravity), Some(square)), law)
                        }
                    }
                }
            };
            let [(lower, below_square), (upper, above_square)] = match (below, above) {
                (Some(below), Some(above)) => [wave(below), wave(above)],
                (None, Some(above)) => [outer, wave(above)],
                (Some(below), None) => [wave(below), outer],
                (None, None) => [(Source::Nothing, None), outer],
            };
            let impedance = |square: &Option<Rational>| {
                square.as_ref().map(|square| root::<N>("impedance", square, precision)).transpose()
            };
            let impedances = [impedance(&below_square)?, impedance(&above_square)?];
            let reflection = match (&below_square, &above_square) {
                (Some(below), Some(above)) => match (below.clone() / above).try_sqrt() {
                    Some(ratio) => {
                        let one = ratio.one();
                        lift(&((ratio.clone() - &one) / &(ratio + &one)), precision)?
                    }
                    None => {
                        let ratio = lift::<N>(&(below.clone() / above), precision)?;
                        let irrational = || Error::Irrational { quantity: "ratio of impedances", square: ratio.text() };
                        let ratio = ratio.try_sqrt().ok_or_else(irrational)?;
                        (ratio.clone() - ratio.one()) / (ratio.clone() + ratio.one())
                    }
                },
                (None, _) => gravity.one(),
                (_, None) => -gravity.one(),
            };
            let is_bar = |body: Option<usize>| body.filter(|body| !is_mass(Some(*body)));
            let gap = chain.start_gap(at).map_or_else(|| Ok(gravity.zero()), |gap| lift(&gap, precision))?;
            let delays = [below, above].map(|body| is_bar(body).map(|body| bars[body].travel.clone()));
            let mix = Mix::new(reflection, impedances.clone(), &gravity);
            if !is_soft {
                nodes.push(Node::new([lower, upper], delays, law, mix, gap));
                continue;
            }
            let [first, second] = delays;
            let sides = [Input::new(lower, first, &gap), Input::new(upper, second, &gap)];
            let outer = usize::from(at == top && at > 0);
            parts.0.push(Interface::new((law, springs[at].clone()), (sides, impedances), (&mix, outer), &gap));
            if let (Some(body), true) = (above, is_mass(above)) {
                parts.1.push(mass(body, chain, precision)?);
                masses += 1;
                continue;
            }
            let (interfaces, own) = std::mem::take(&mut parts);
            masses = 0;
            let first = at + 1 - interfaces.len();
            let speed = chain.scale(Measure::Velocity);
            // A run that ends at once takes a short step, so that it has a state.
            let shortest = bars.iter().map(|bar| bar.travel.to_f64()).filter(|t| *t > 0.0).fold(1.0, f64::min);
            let until = if chain.until.is_zero() { gravity.double(shortest / 1024.0) } else { number(&chain.until) };
            clusters.push(Cluster::new(first, interfaces, own, speed, &until));
        }
        let nodes = if is_soft { Nodes::Soft(clusters) } else { Nodes::Rigid(nodes) };
        Ok(Start { bars, nodes, springs, waves, gravity, until: number(&chain.until) })
    }
}

/// Converts a spring.
fn soft<N: Bounded>(spring: &Spring, precision: &N::Precision) -> Result<Soft<N>, Error> {
    let [stiffness, damping] = [&spring.stiffness, &spring.damping].map(|x| N::from_number(x, precision));
    let irrational = || Error::Irrational { quantity: "stiffness", square: spring.stiffness.to_string() };
    let root = stiffness.try_sqrt().ok_or_else(irrational)?;
    Ok(Soft { stiffness, root, damping })
}

/// Converts the rigid body with this index.
fn mass<N: Bounded>(body: usize, chain: &Chain, precision: &N::Precision) -> Result<Mass<N>, Error> {
    let of = &chain.bodies[body];
    let mass = N::from_number(of.rigid_mass().unwrap_or(&of.length), precision);
    let velocity = of.velocity.first().map_or_else(|| mass.zero(), |(_, v)| N::from_number(v, precision));
    let root = mass.try_sqrt().ok_or_else(|| Error::Irrational { quantity: "mass", square: mass.text() })?;
    Ok(Mass::new(body, velocity, mass.one() / mass, root))
}

/// Returns the data through `points`, with `fall·t` added: constant after the last point, and zero without points.
fn signal<N: Bounded>(points: &Points, fall: &N, precision: &N::Precision) -> Vec<(N, Line<N>)> {
    let number = |x: &Number| N::from_number(x, precision);
    let constant = |value: N| Line { intercept: value, slope: fall.clone() };
    let Some((last_time, last)) = points.last() else {
        return vec![(fall.zero(), constant(fall.zero()))];
    };
    let mut lines = Vec::new();
    for pair in points.windows(2) {
        let [(from, a), (to, b)] = [&pair[0], &pair[1]];
        if from.compare(to).is_lt() {
            let [time, a, b] = [number(from), number(a), number(b)];
            let slope = (b - &a) / (number(to) - &time);
            let intercept = a - slope.clone() * &time;
            lines.push((time, Line { intercept, slope: slope + fall }));
        }
    }
    lines.push((number(last_time), constant(number(last))));
    lines
}

/// Builds the waves that are in a body at the start.
///
/// **Source**: the upward wave leaves the bottom at `s` with `p(−cs, 0)`, the downward one the top with `q(L + cs, 0)`,
/// for `−L/c ≤ s < 0`. Their integrals are 0 and `2v(0,0)` where the bottom is at the start, so that
/// `v(x,t) = (∫p(t − x/c) + ∫q(t − (L − x)/c) − g t²)/2`.
fn waves<N: Bounded>(body: &Body, bar: &Bar<N>, precision: &N::Precision) -> Result<[Wave<N>; 2], Error> {
    let Bar { length, wave_speed, travel, .. } = bar;
    if bar.mass.is_some() {
        let zero = length.zero();
        let velocity = body.velocity.first().map_or_else(|| zero.clone(), |(_, v)| N::from_number(v, precision));
        let line = Line { intercept: velocity, slope: zero.clone() };
        let still = || wave(vec![(zero.clone(), line.clone())], N::clone, &zero);
        return Ok([still(), still()]);
    }
    let fraction = |x: &Number| x.to_rational();
    // Places at which the start has a break, in exact order.
    let mut places: Vec<Rational> = vec![Rational::default(), fraction(&body.length)];
    places.extend(body.velocity.iter().chain(&body.displacement).chain(&body.strain).map(|(x, _)| fraction(x)));
    places.sort();
    places.dedup();
    let mut up = Vec::new();
    let mut down = Vec::new();
    for pair in places.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        let lists = [&body.velocity, &body.displacement, &body.strain];
        let [(speed, rise), (_, stretch), (strain, bend)] = lists.map(|points| {
            let within = |pair: &&[(Number, Number)]| {
                fraction(&pair[0].0) <= *from && *to <= fraction(&pair[1].0) && pair[0].0.compare(&pair[1].0).is_lt()
            };
            points.windows(2).find(within).map_or_else(Default::default, |pair| {
                let [x, v] = [fraction(&pair[0].0), fraction(&pair[0].1)];
                let slope = (fraction(&pair[1].1) - &v) / (fraction(&pair[1].0) - &x);
                (v - slope.clone() * x, slope)
            })
        });
        // v_t = speed + rise·x and v_x = strain + bend·x, each extrapolated to either end.
        let strain = strain + stretch;
        let numbers = [
            speed.clone(),
            speed + rise.clone() * fraction(&body.length),
            rise,
            strain.clone(),
            strain + bend.clone() * fraction(&body.length),
            bend,
            from.clone(),
            fraction(&body.length) - to,
        ]
        .map(|x| lift::<N>(&x, precision));
        let [speed, at_top, rise, strain, top_strain, bend, from, to] = numbers;
        let (rate, bend) = (rise? * wave_speed, bend? * wave_speed * wave_speed);
        let up_line = Line { intercept: speed? - strain? * wave_speed, slope: bend.clone() - &rate };
        let down_line = Line { intercept: at_top? + top_strain? * wave_speed, slope: rate + bend };
        let [from, to] = [from?, to?];
        // A piece begins where its stretch of the body ends: at −to/c upward, at −(L − from)/c downward.
        let up_from = if to.vanishes() == Ok(true) { -travel.clone() } else { (to - length) / wave_speed };
        let down_from = if from.vanishes() == Ok(true) { -travel.clone() } else { (from - length) / wave_speed };
        up.push((up_from, up_line));
        down.push((down_from, down_line));
    }
    up.reverse();
    let start = body.displacement.first().map_or_else(|| length.zero(), |(_, v)| N::from_number(v, precision));
    let zero = length.zero();
    let up = wave(up, |total| -total.clone(), &zero);
    Ok([up, wave(down, |_| start.doubled(), &zero)])
}

/// Builds a wave from its pieces before the start; `first` returns its integral at the first one, given that of all.
fn wave<N: Bounded>(lines: Vec<(N, Line<N>)>, first: impl FnOnce(&N) -> N, zero: &N) -> Wave<N> {
    let mut sums = vec![zero.clone()];
    let ends = lines.iter().skip(1).map(|(from, _)| from).chain([zero]);
    for ((from, line), to) in lines.iter().zip(ends) {
        let last = &sums[sums.len() - 1];
        sums.push(line.integral(from, to) + last);
    }
    let first = first(&sums[sums.len() - 1]);
    let given = lines.len();
    let piece = |((from, line), sum): ((N, Line<N>), N)| Piece { from, signal: Signal::Line(line), sum: sum + &first };
    let pieces = lines.into_iter().zip(sums).map(piece);
    Wave { pieces: pieces.collect(), given }
}
