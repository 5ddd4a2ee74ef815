//! The event loop over the nodes of a chain.

use std::ops::ControlFlow;

use super::cluster::Cluster;
use super::definition::{Chain, SOFT};
use super::node::{Node, Occurrence, Source, Stage, Stop};
use super::run::{ChainEvent, ChainRun, Touch};
use super::start::{Nodes, Start};
use super::sums::KeptSums;
use super::varied::Varied;
use super::wave::{Wave, left};
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Bounded, Open, is_exact_zero};
use crate::reason::Reason;

impl<N: Bounded> ChainRun<N> {
    /// Runs `chain`; `observe` receives the number of events and of wave pieces, and may end the run.
    ///
    /// **Accuracy**: *exact* in fractions, *enclosure* in intervals; otherwise *within the bounds* that the numbers
    /// carry.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction cannot hold a wave speed or an impedance;
    /// [`Error::SoftExact`] in fractions, and [`Error::NoChains`] without the feature `chain`, for springs, dashpots
    /// and masses;
    /// [`Error::TooManyPieces`]; [`Error::Interrupted`].
    ///
    /// ```
    /// use dalembert::Rational;
    /// use dalembert::chain::{Body, Chain, ChainRun};
    /// // Two equal bars exchange their velocities: contact for 2L/c.
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// let run = ChainRun::<Rational>::new(&chain, &(), &|_, _| std::ops::ControlFlow::Continue(()))?;
    /// assert_eq!(run.events()[0].t, Rational::from(1));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn new(
        chain: &Chain,
        precision: &N::Precision,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        Self::varied(Varied { now: chain, further: chain, falls: false }, precision, observe)
    }

    /// Runs a chain in numbers that may carry the rates of its values.
    ///
    /// **Errors**: those of [`ChainRun::new`].
    pub(crate) fn varied(
        varied: Varied<'_, Chain>,
        precision: &N::Precision,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let chain = varied.now;
        if chain.is_soft() && !SOFT {
            return Err(Error::NoChains);
        }
        if chain.is_soft() && N::from_number(&chain.until, precision).bits().is_none() {
            return Err(Error::SoftExact);
        }
        let Start { bars, nodes, springs, mut waves, gravity, frame, until } = Start::<N>::new(varied, precision)?;
        let mut nodes = match nodes {
            Nodes::Rigid(nodes) => nodes,
            Nodes::Soft(clusters) => {
                let limits = (chain.max_pieces(), observe);
                let Marched { nodes, events, end, ending, doubt } = march(clusters, &mut waves, until, limits)?;
                let run = ChainRun {
                    bars,
                    nodes,
                    springs,
                    waves,
                    gravity,
                    frame,
                    end,
                    ending,
                    events,
                    touches: Vec::new(),
                    doubt,
                    kept: KeptSums::default(),
                };
                return run.within(chain.max_pieces());
            }
        };
        let (mut events, mut touches) = (Vec::new(), Vec::new());
        let mut ending = Ending::Time;
        let mut end = until.clone();
        let mut record = |node: usize, occurrence: Option<Occurrence<N>>, events: &mut Vec<ChainEvent<N>>| {
            let Some(Occurrence { kind, t, drive: [before, after] }) = occurrence else { return };
            match kind {
                Some(kind) => events.push(ChainEvent { kind, node, t, before, after }),
                None => touches.push(Touch { node, t, before, after }),
            }
        };
        let open = || Ending::Undecided(Reason::Order { bits: until.bits().unwrap_or(0) });
        for (at, node) in nodes.iter_mut().enumerate() {
            match node.begin(&until, &mut waves) {
                Ok(occurrence) => record(at, occurrence, &mut events),
                Err(Stop::Open) => (ending, end) = (open(), until.zero()),
                Err(Stop::Irrational { .. }) => return Err(Error::Open(Open)),
            }
        }
        for node in &mut nodes {
            node.look_up(&waves);
        }
        let last = until.to_f64();
        let mut reached = until.zero();
        let mut steps = 0;
        while ending == Ending::Time {
            let Some(at) = (0..nodes.len()).min_by(|a, b| nodes[*a].key.total_cmp(&nodes[*b].key)) else { break };
            // The double of an enclosure is its outer end.
            if nodes[at].key > last * (1.0 + 1e-12) {
                break;
            }
            match nodes[at].process(&mut waves) {
                Ok(None) => nodes[at].key = f64::INFINITY,
                Ok(Some((t, occurrence))) => {
                    record(at, occurrence, &mut events);
                    reached = t;
                    for near in &mut nodes[at.saturating_sub(1)..(at + 2).min(waves.len() + 1)] {
                        near.look_up(&waves);
                    }
                }
                Err(Stop::Open) => (ending, end) = (open(), reached.clone()),
                Err(Stop::Irrational { kind, surd, near }) => {
                    let before = until.double(near * (1.0 - 4.0 * f64::EPSILON));
                    end = reached.clone().larger(before);
                    ending = Ending::ExactnessEnds { kind, time: surd, near };
                }
            }
            steps += 1;
            if steps % 64 == 0 {
                let pieces = left(&waves);
                if pieces > chain.max_pieces() {
                    return Err(Error::TooManyPieces { limit: chain.max_pieces(), time: reached.to_f64() });
                }
                if observe(events.len(), pieces).is_break() {
                    return Err(Error::Interrupted);
                }
            }
        }
        sort(&mut events, |event| (&event.t, event.node));
        sort(&mut touches, |touch| (&touch.t, touch.node));
        let doubt = nodes.iter().filter_map(|node| node.doubt).min_by(f64::total_cmp);
        let nodes = nodes.into_iter().map(Node::into_stages).collect();
        let kept = KeptSums::default();
        let run = ChainRun { bars, nodes, springs, waves, gravity, frame, end, ending, events, touches, doubt, kept };
        run.within(chain.max_pieces())
    }

    /// Returns the run, unless it has more wave pieces than `limit`: while it goes on they are counted now and then.
    fn within(self, limit: usize) -> Result<Self, Error> {
        match self.pieces() > limit {
            true => Err(Error::TooManyPieces { limit, time: self.end.to_f64() }),
            false => Ok(self),
        }
    }
}

/// The nodes of a chain with springs, dashpots or masses, up to the end of its run.
struct Marched<N> {
    nodes: Vec<Vec<Stage<N>>>,
    events: Vec<ChainEvent<N>>,
    end: N,
    ending: Ending,
    doubt: Option<f64>,
}

/// Runs clusters of nodes up to the end.
fn march<N: Bounded>(
    mut clusters: Vec<Cluster<N>>,
    waves: &mut [[Wave<N>; 2]],
    until: N,
    (limit, observe): (usize, &dyn Fn(usize, usize) -> ControlFlow<()>),
) -> Result<Marched<N>, Error> {
    let owner = |clusters: &[Cluster<N>], node: usize| clusters.partition_point(|cluster| cluster.first <= node) - 1;
    let mut events = Vec::new();
    let mut ending = Ending::Time;
    let record = |(node, occurrence): (usize, Occurrence<N>), events: &mut Vec<ChainEvent<N>>| {
        let Occurrence { kind, t, drive: [before, after] } = occurrence;
        match kind {
            Some(kind) => events.push(ChainEvent { kind, node, t, before, after }),
            // A break that counts as one with the latest event of the node.
            None => {
                let latest = events.iter_mut().rfind(|event| event.node == node);
                let latest = latest.filter(|latest| (latest.t.clone() - &t).vanishes() != Ok(false));
                latest.into_iter().for_each(|latest| latest.after.clone_from(&after));
            }
        }
    };
    let open = || Ending::Undecided(Reason::Order { bits: until.bits().unwrap_or(0) });
    for cluster in &mut clusters {
        match cluster.begin(waves) {
            Ok(found) => found.into_iter().for_each(|occurrence| record(occurrence, &mut events)),
            Err(_) => ending = open(),
        }
    }
    let mut end = if ending == Ending::Time { until.clone() } else { until.zero() };
    let mut steps = 0;
    while ending == Ending::Time {
        let time = |k: &usize| clusters[*k].reached.at.to_f64();
        let Some(at) = (0..clusters.len()).min_by(|a, b| time(a).total_cmp(&time(b))) else { break };
        if clusters[at].is_finished() {
            break;
        }
        // A signal is known up to the time that its origin has reached, and the travel time after it.
        let sides = clusters[at].interfaces.iter().flat_map(|interface| interface.sides.iter().enumerate());
        let known = sides.filter_map(|(side, input)| match input.source {
            Source::Wave(body) => input.after(&clusters[owner(&clusters, body + side)].reached),
            _ => None,
        });
        let horizon = known.reduce(|a, b| if b.time.below(&a.time) == Ok(true) { b } else { a });
        match clusters[at].advance(horizon, waves) {
            Ok(found) => found.into_iter().for_each(|occurrence| record(occurrence, &mut events)),
            Err(_) if until.below(&clusters[at].reached.time) == Ok(true) => break,
            Err(_) => (ending, end) = (open(), clusters[at].reached.time.clone()),
        }
        steps += 1;
        if steps % 64 == 0 {
            let pieces = left(waves);
            if pieces > limit {
                return Err(Error::TooManyPieces { limit, time: clusters[at].reached.at.to_f64() });
            }
            if observe(events.len(), pieces).is_break() {
                return Err(Error::Interrupted);
            }
        }
    }
    // The clusters went on beyond the end.
    let is_over = |t: &N| end.below(t) == Ok(true);
    events.retain(|event: &ChainEvent<N>| !is_over(&event.t));
    sort(&mut events, |event| (&event.t, event.node));
    let last = end.to_f64();
    let mut doubts: Vec<f64> = clusters.iter().filter_map(|cluster| cluster.doubt).collect();
    doubts.retain(|at| *at <= last * (1.0 + 1e-12));
    // An event that agrees with the end within its bounds may be after it.
    let is_at_end = |t: &N| t.below(&end) != Ok(true) && !is_exact_zero(&(t.clone() - &end));
    doubts.extend(events.iter().filter(|event| is_at_end(&event.t)).map(|_| last));
    let stages = clusters.into_iter().flat_map(|cluster| cluster.interfaces).map(|interface| interface.stages);
    let mut nodes: Vec<Vec<Stage<N>>> = stages.collect();
    for stages in &mut nodes {
        while stages.len() > 1 && stages.pop_if(|stage| is_over(&stage.from)).is_some() {}
    }
    for Wave { pieces, given } in waves.iter_mut().flatten() {
        while pieces.len() > *given && pieces.pop_if(|piece| is_over(&piece.from)).is_some() {}
    }
    Ok(Marched { nodes, events, end, ending, doubt: doubts.into_iter().min_by(f64::total_cmp) })
}

/// Sorts a nearly sorted list by time, then by node; an undecided order stays as it is.
fn sort<T, N: Bounded>(items: &mut [T], key: impl Fn(&T) -> (&N, usize)) {
    let precedes = |a: &T, b: &T| {
        let ((t, node), (s, other)) = (key(a), key(b));
        match t.compare(s) {
            Ok(order) => order.is_lt() || order.is_eq() && node < other,
            Err(Open) => false,
        }
    };
    for k in 1..items.len() {
        let mut at = k;
        while at > 0 && precedes(&items[at], &items[at - 1]) {
            items.swap(at, at - 1);
            at -= 1;
        }
    }
}
