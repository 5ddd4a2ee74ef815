//! The numbers of a chain in one number system, its nodes, and the waves that are in the bodies at the start.

use std::sync::Arc;

use super::body::{Body, Points};
use super::cluster::{Cluster, Mass};
use super::curve::Signal;
use super::definition::{Chain, End, Joint, SOFT, Spring};
use super::exact::{Exact, Travels, exact, fixed};
use super::interface::{Input, Interface, Soft};
use super::law::{Law, Mix};
use super::node::{DataLine, Node, Source};
use super::varied::{Given, Varied, lift, root};
use super::wave::{Piece, Wave};
use crate::error::Error;
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

impl<N: Bounded> Bar<N> {
    /// Returns the mass of the body.
    pub(super) fn mass(&self) -> N {
        match &self.mass {
            Some(mass) => mass.clone(),
            None => self.impedance.clone() * &self.travel,
        }
    }
}

/// A chain in the numbers of a run, at the start. Velocities are those in the frame.
#[derive(Clone, Debug)]
pub(super) struct Start<N> {
    pub(super) bars: Vec<Bar<N>>,
    pub(super) nodes: Nodes<N>,
    /// The springs of the nodes.
    pub(super) springs: Vec<Option<Soft<N>>>,
    /// The upward and the downward wave of each body.
    pub(super) waves: Vec<[Wave<N>; 2]>,
    pub(super) gravity: N,
    /// The velocity at the start of the frame, which falls with `g`.
    pub(super) frame: N,
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

impl<N: Bounded> Start<N> {
    /// Converts a chain.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction cannot hold a wave speed or an impedance.
    pub(super) fn new(varied: Varied<'_, Chain>, precision: &N::Precision) -> Result<Self, Error> {
        let chain = varied.now;
        let number = |x: Varied<'_, Number>| lift::<N>(&x.given(), precision);
        let gravity = number(varied.part(|chain| &chain.gravity))?;
        let mut squares = Vec::new();
        let (mut bars, mut exact_travels, mut travels) = (Vec::new(), Vec::new(), Travels::default());
        let is_soft = SOFT && chain.is_soft();
        let frame = Given::constant(if is_soft { common_velocity(chain) } else { Rational::default() });
        let bodies: Vec<Varied<'_, Body>> =
            (0..chain.bodies.len()).map(|k| varied.part(|chain| &chain.bodies[k])).collect();
        for body in &bodies {
            let [impedance, wave_speed] = body.squares();
            if let Some(mass) = body.mass() {
                let [zero, one] = [gravity.zero(), gravity.one()];
                let [length, travel, force] = [zero.clone(), zero.clone(), zero];
                bars.push(Bar { length, wave_speed: one, impedance: force, travel, mass: Some(number(mass)?) });
                exact_travels.push(None);
                squares.push(impedance);
                continue;
            }
            let speed: N = root("wave speed", &wave_speed, precision)?;
            let own = body.part(|body| &body.length).given();
            let length: N = lift(&own, precision)?;
            exact_travels.push(if is_soft { travels.exact(&own, &wave_speed) } else { None });
            let travel = match wave_speed.try_sqrt() {
                Some(speed) => lift(&(own / speed), precision)?,
                None => length.clone() / &speed,
            };
            let force = root("impedance", &impedance, precision)?;
            bars.push(Bar { length, wave_speed: speed, impedance: force, travel, mass: None });
            squares.push(impedance);
        }
        let parts = bodies.iter().zip(&bars).zip(&exact_travels);
        let waves = parts.map(|((body, bar), exact)| waves(*body, (bar, exact), &frame, precision));
        let waves = waves.collect::<Result<_, _>>()?;
        let top = bars.len();
        let spring = |node: usize| varied.some(|chain| chain.spring(node));
        let springs = (0..=top).map(|node| spring(node).map(|spring| soft(spring, precision)).transpose());
        let springs: Vec<Option<Soft<N>>> = springs.collect::<Result<_, _>>()?;
        let until = number(varied.part(|chain| &chain.until))?;
        // Clusters go on for a short time, so that events at the end are found whatever the roundings.
        let last = until.to_f64();
        let travels = bars.iter().map(|bar| bar.travel.to_f64()).filter(|t| *t > 0.0);
        let shortest = travels.fold(if last > 0.0 { last } else { 1.0 }, f64::min);
        let beyond = gravity.double(last + (shortest / 1024.0).max(last * f64::EPSILON.sqrt()));
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
                    let side = usize::from(at == top);
                    // An end without points has no signal.
                    let points = || varied.some(|chain| chain.ends[side].points());
                    let signal = |fall: &N, frame: &Given| {
                        let points = points().map_or_else(Vec::new, Varied::<Points>::given);
                        Ok::<_, Error>(Source::Data(signal(&in_frame(points, frame, None), fall, precision)?))
                    };
                    let zero = gravity.zero();
                    let still = Given::constant(Rational::default());
                    let own = squares[if at == 0 { 0 } else { top - 1 }].clone();
                    match &chain.ends[side] {
                        End::Free => ((Source::Nothing, None), Law::Force),
                        End::Force(_) => ((signal(&zero, &still)?, None), Law::Force),
                        End::Velocity(_) => ((signal(&gravity, &frame)?, None), Law::Held),
                        End::Ground { .. } => ((signal(&gravity, &frame)?, None), Law::Contact),
                        End::Infinite { gap, .. } => {
                            let law = if gap.is_some() { Law::Contact } else { Law::Held };
                            let impedance = varied.some(|chain| chain.ends[side].impedance());
                            ((signal(&gravity, &frame)?, Some(impedance.map_or(own, |z| z.given().square()))), law)
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
            let impedance = |square: &Option<Given>| {
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
            let gap = match chain.is_contact(at) {
                true => lift(&varied.number(|chain| chain.start_gap(at).unwrap_or_default()), precision)?,
                false => gravity.zero(),
            };
            let delays = [below, above].map(|body| is_bar(body).map(|body| bars[body].travel.clone()));
            let mix = Mix::new(reflection, impedances.clone(), &gravity);
            if !is_soft {
                nodes.push(Node::new([lower, upper], delays, law, mix, gap));
                continue;
            }
            let [first, second] = delays;
            let exact = |body: Option<usize>| exact_travels.get(body?)?.clone();
            let sides =
                [Input::new(lower, (first, exact(below)), &gap), Input::new(upper, (second, exact(above)), &gap)];
            let outer = usize::from(at == top && at > 0);
            parts.0.push(Interface::new((law, springs[at].clone()), (sides, impedances), (&mix, outer), &gap));
            if let (Some(body), true) = (above, is_mass(above)) {
                parts.1.push(mass(body, bodies[body], &frame, precision)?);
                masses += 1;
                continue;
            }
            let (interfaces, own) = std::mem::take(&mut parts);
            masses = 0;
            let first = at + 1 - interfaces.len();
            let speed = chain.scales().of(Measure::Velocity);
            clusters.push(Cluster::new(first, interfaces, own, speed, &beyond));
        }
        let nodes = if is_soft { Nodes::Soft(clusters) } else { Nodes::Rigid(nodes) };
        Ok(Start { bars, nodes, springs, waves, gravity, frame: lift(&frame, precision)?, until })
    }
}

/// Converts a spring.
fn soft<N: Bounded>(spring: Varied<'_, Spring>, precision: &N::Precision) -> Result<Soft<N>, Error> {
    let [stiffness, damping] = [spring.part(|spring| &spring.stiffness), spring.part(|spring| &spring.damping)]
        .map(|number| lift::<N>(&number.given(), precision));
    let stiffness = stiffness?;
    let irrational = || Error::Irrational { quantity: "stiffness", square: stiffness.text() };
    let root = stiffness.try_sqrt().ok_or_else(irrational)?;
    Ok(Soft { stiffness, root, damping: damping? })
}

/// Converts the rigid body with this index.
fn mass<N: Bounded>(
    index: usize,
    body: Varied<'_, Body>,
    frame: &Given,
    precision: &N::Precision,
) -> Result<Mass<N>, Error> {
    let mass = body.mass().unwrap_or_else(|| body.part(|body| &body.length));
    let mass = lift::<N>(&mass.given(), precision)?;
    let velocity = velocity(body, frame, precision)?;
    let root = mass.try_sqrt().ok_or_else(|| Error::Irrational { quantity: "mass", square: mass.text() })?;
    Ok(Mass::new(index, velocity, mass.one() / mass, root))
}

/// Returns the velocity of a rigid body at the start, in the frame.
fn velocity<N: Bounded>(body: Varied<'_, Body>, frame: &Given, precision: &N::Precision) -> Result<N, Error> {
    let points = body.part(|body| &body.velocity).given();
    let velocity =
        points.first().map_or_else(|| Given::constant(Rational::default()), |(_, velocity)| velocity.clone());
    lift(&(velocity - frame), precision)
}

/// Returns the velocity that neighbours share which touch at the start, if no double holds it: in a frame that has it,
/// theirs is exactly zero. Otherwise zero.
fn common_velocity(chain: &Chain) -> Rational {
    let uniform = |body: &Body| {
        let (_, first) = body.velocity.first()?;
        body.velocity.iter().all(|(_, velocity)| velocity == first).then(|| first.to_rational())
    };
    let shared = |joint: usize| {
        let touches = chain.start_gap(joint + 1).is_some_and(|gap| gap == Rational::default());
        let [below, above] = [&chain.bodies[joint], &chain.bodies[joint + 1]].map(uniform);
        below.filter(|velocity| touches && above.as_ref() == Some(velocity))
    };
    let is_rounded = |velocity: &Rational| Scalar::double(velocity, Scalar::to_f64(velocity)) != *velocity;
    (0..chain.joints.len()).filter_map(shared).find(is_rounded).unwrap_or_default()
}

/// Returns velocities at points in the frame. No points mean zero everywhere: up to `end` in a body, always at an end
/// of the chain.
fn in_frame(points: Vec<(Given, Given)>, frame: &Given, end: Option<&Given>) -> Vec<(Given, Given)> {
    let zero = Given::constant(Rational::default());
    if *frame.value() == Rational::default() {
        return points;
    }
    let still = || [Some(&zero), end].into_iter().flatten().map(|at| (at.clone(), zero.clone())).collect();
    let points: Vec<(Given, Given)> = if points.is_empty() { still() } else { points };
    points.into_iter().map(|(at, velocity)| (at, velocity - frame)).collect()
}

/// Returns the data through `points`, with `fall·t` added: constant after the last point, and zero without points.
fn signal<N: Bounded>(
    points: &[(Given, Given)],
    fall: &N,
    precision: &N::Precision,
) -> Result<Vec<DataLine<N>>, Error> {
    let number = |x: &Given| lift::<N>(x, precision);
    let zero = (Given::constant(Rational::default()), Given::constant(Rational::default()));
    let (last_time, last) = points.last().unwrap_or(&zero);
    let data = |from: &Given, first: N, line: Line<N>| {
        let time = number(from)?;
        let first = first + fall.clone() * &time;
        Ok::<_, Error>(DataLine { from: time, line, exact: exact(from), first })
    };
    let mut lines = Vec::new();
    for pair in points.windows(2) {
        let [(from, a), (to, b)] = [&pair[0], &pair[1]];
        if from.value() < to.value() {
            let [time, a, b] = [number(from)?, number(a)?, number(b)?];
            let slope = (b - &a) / (number(to)? - &time);
            let intercept = a.clone() - slope.clone() * &time;
            lines.push(data(from, a, Line { intercept, slope: slope + fall })?);
        }
    }
    let last = number(last)?;
    lines.push(data(last_time, last.clone(), Line { intercept: last, slope: fall.clone() })?);
    Ok(lines)
}

/// Builds the waves that are in a body at the start.
///
/// **Source**: the upward wave leaves the bottom at `s` with `p(−cs, 0)`, the downward one the top with `q(L + cs, 0)`,
/// for `−L/c ≤ s < 0`. Their integrals are 0 and `2v(0,0)` where the bottom is at the start, so that
/// `v(x,t) = (∫p(t − x/c) + ∫q(t − (L − x)/c) − g t²)/2`.
fn waves<N: Bounded>(
    body: Varied<'_, Body>,
    (bar, exact_travel): (&Bar<N>, &Exact),
    frame: &Given,
    precision: &N::Precision,
) -> Result<[Wave<N>; 2], Error> {
    let Bar { length, wave_speed, travel, .. } = bar;
    if bar.mass.is_some() {
        let zero = length.zero();
        let line = Line { intercept: velocity(body, frame, precision)?, slope: zero.clone() };
        let still = || wave(vec![(zero.clone(), line.clone(), None)], N::clone, &zero);
        return Ok([still(), still()]);
    }
    let top = body.part(|body| &body.length).given();
    let velocity = in_frame(body.part(|body| &body.velocity).given(), frame, Some(&top));
    let displacement = body.part(|body| &body.displacement).given();
    let strain = body.part(|body| &body.strain).given();
    // Places at which the start has a break, in exact order.
    let zero = Given::constant(Rational::default());
    let lists = [&velocity, &displacement, &strain];
    let mut places = vec![zero.clone(), top.clone()];
    places.extend(lists.iter().flat_map(|points| points.iter()).map(|(x, _)| x.clone()));
    places.sort_by(|a, b| a.value().cmp(b.value()));
    places.dedup_by(|a, b| a.value() == b.value());
    let mut up = Vec::new();
    let mut down = Vec::new();
    for pair in places.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        let [(speed, rise), (_, stretch), (strain, bend)] = lists.map(|points| {
            let within = |pair: &&[(Given, Given)]| {
                let [first, last] = [pair[0].0.value(), pair[1].0.value()];
                first <= from.value() && to.value() <= last && first < last
            };
            points.windows(2).find(within).map_or_else(
                || (zero.clone(), zero.clone()),
                |pair| {
                    let [x, v] = [&pair[0].0, &pair[0].1];
                    let slope = (pair[1].1.clone() - v) / (pair[1].0.clone() - x);
                    (v.clone() - slope.clone() * x, slope)
                },
            )
        });
        let exact_before = |way: Given| Some(Arc::new(exact_travel.as_deref()?.scaled(&fixed(&-(way / &top))?)));
        let exact = [exact_before(to.clone()), exact_before(top.clone() - from)];
        // v_t = speed + rise·x and v_x = strain + bend·x, each extrapolated to either end.
        let strain = strain + stretch;
        let numbers = [
            speed.clone(),
            speed + rise.clone() * &top,
            rise,
            strain.clone(),
            strain + bend.clone() * &top,
            bend,
            from.clone(),
            top.clone() - to,
        ]
        .map(|x| lift::<N>(&x, precision));
        let [speed, at_top, rise, strain, top_strain, bend, from, to] = numbers;
        let (rate, bend) = (rise? * wave_speed, bend? * wave_speed * wave_speed);
        let up_line = Line { intercept: speed?, slope: bend.clone() };
        let up_line = up_line.minus(&Line { intercept: strain? * wave_speed, slope: rate.clone() });
        let down_line = Line { intercept: at_top?, slope: rate };
        let down_line = down_line.plus(&Line { intercept: top_strain? * wave_speed, slope: bend });
        let [from, to] = [from?, to?];
        // A piece begins where its stretch of the body ends: at −to/c upward, at −(L − from)/c downward.
        let up_from = if to.vanishes() == Ok(true) { -travel.clone() } else { (to - length) / wave_speed };
        let down_from = if from.vanishes() == Ok(true) { -travel.clone() } else { (from - length) / wave_speed };
        let [up_exact, down_exact] = exact;
        up.push((up_from, up_line, up_exact));
        down.push((down_from, down_line, down_exact));
    }
    up.reverse();
    let start = displacement.first().map_or_else(|| Ok(length.zero()), |(_, v)| lift(v, precision))?;
    let zero = length.zero();
    let up = wave(up, |total| -total.clone(), &zero);
    Ok([up, wave(down, |_| start.doubled(), &zero)])
}

/// Builds a wave from its pieces before the start; `first` returns its integral at the first one, given that of all.
fn wave<N: Bounded>(lines: Vec<(N, Line<N>, Exact)>, first: impl FnOnce(&N) -> N, zero: &N) -> Wave<N> {
    let mut sums = vec![zero.clone()];
    let ends = lines.iter().skip(1).map(|(from, ..)| from).chain([zero]);
    for ((from, line, _), to) in lines.iter().zip(ends) {
        let last = &sums[sums.len() - 1];
        sums.push(line.integral(from, to) + last);
    }
    let first = first(&sums[sums.len() - 1]);
    let given = lines.len();
    let pieces = lines.into_iter().zip(sums).map(|((from, line, exact), sum)| Piece {
        from,
        signal: Signal::Line(line),
        sum: sum + &first,
        exact,
        taylor: None,
    });
    Wave { pieces: pieces.collect(), given }
}
