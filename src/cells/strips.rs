//! Cached strips of cells: a query keeps the strips it has marched, so that queries in order of time need one march.
//!
//! The strips are those marched from their checkpoint, so that a query finds the same cells, bit for bit, whatever
//! queries came before it.

use std::collections::VecDeque;
use std::num::NonZero;
use std::sync::{Arc, LazyLock, Mutex};

use super::cell::Cell;
use super::flight::Flight;
use super::march::{Medium, State};
use super::piece::{Checkpoint, Piece};
use crate::number::Scalar;
use crate::special::RoundedSpecial;
use crate::threads::locked;

/// The strips after a checkpoint, one for each piece, up to the last one queried.
#[derive(Clone, Debug)]
pub(super) struct Strips<S: Scalar> {
    /// Index of the checkpoint.
    start: usize,
    strips: Vec<Vec<Cell<'static, S>>>,
    /// Number of coefficients kept.
    pub(super) size: usize,
    /// State after the last strip.
    pub(super) state: State<S>,
    pub(super) flight: Option<usize>,
    pub(super) ground: S,
}

/// Maximum number of coefficients kept, 2 MB in doubles: some 50 rays over two round trips.
pub(super) const MOST_KEPT: usize = 1 << 18;

impl<S: RoundedSpecial> Strips<S> {
    pub(super) fn after(start: usize, kept: &Checkpoint<S>) -> Self {
        let Checkpoint { flight, state, ground, .. } = kept.clone();
        Strips { start, strips: Vec::new(), size: 0, state, flight, ground }
    }

    /// Returns the state after the last strip, without the strips.
    pub(super) fn ahead(&self) -> Self {
        let Strips { start, flight, .. } = *self;
        let (state, ground) = (self.state.clone(), self.ground.clone());
        Strips { start, strips: Vec::new(), size: 0, state, flight, ground }
    }

    pub(super) fn count(&self) -> usize {
        self.strips.len()
    }

    /// Converts the state to the vibration about `flight`, or to the whole motion.
    pub(super) fn fly(&mut self, medium: &Medium<S>, flights: &[Flight<S>], flight: Option<usize>) {
        if flight != self.flight {
            let of = |flight: Option<usize>| flight.and_then(|k| flights.get(k));
            medium.convert(&mut self.state, of(self.flight), of(flight));
            self.flight = flight;
        }
    }

    /// Marches over the next piece and passes its cells to `visit`.
    pub(super) fn strip(&mut self, medium: &Medium<S>, piece: &Piece<S>, visit: &mut dyn FnMut(&Cell<'_, S>)) {
        if piece.cut {
            medium.cut_first(&mut self.state, &piece.len, Default::default());
        }
        medium.strip(&mut self.state, piece.contact, visit);
    }

    /// Marches over the next piece and keeps its cells.
    pub(super) fn keep(&mut self, medium: &Medium<S>, flights: &[Flight<S>], piece: &Piece<S>) {
        let mut cells = Vec::with_capacity(self.state.segments.len() + 2);
        self.fly(medium, flights, piece.flight);
        self.strip(medium, piece, &mut |cell| cells.push(cell.kept()));
        self.size += cells.iter().map(|cell| cell.p.len() + cell.q.len()).sum::<usize>();
        self.strips.push(cells);
    }

    pub(super) fn show(&self, strip: usize, visit: &mut dyn FnMut(&Cell<'_, S>)) {
        self.strips[strip].iter().for_each(visit);
    }
}

/// Cache of recent queries: each query takes the strips it needs and puts them back. The nodes along the whole rod at
/// one time serve all queries about that time, such as those of the solution and of its lists at an event. A state
/// after a part of a leap serves all queries within a round trip.
#[derive(Debug)]
pub(super) struct Pool<S: Scalar> {
    strips: Mutex<Vec<Strips<S>>>,
    lines: Mutex<VecDeque<(S, Nodes<S>)>>,
    leaps: Mutex<VecDeque<(Leap, State<S>)>>,
}

/// The piece of a leap, and the number of its round trips up to a state.
type Leap = (usize, i64);

/// A node of a quadrature along the rod.
#[derive(Clone, Debug)]
pub(super) struct Node<S> {
    pub(super) weight: S,
    pub(super) x: S,
    /// Velocity `h′` of the centre of mass in a separated flight; zero otherwise.
    pub(super) rigid: S,
    /// Remainder of `v_t`.
    pub(super) motion: S,
    /// `v_x`.
    pub(super) strain: S,
}

impl<S: RoundedSpecial> Node<S> {
    /// Returns `v_t`.
    pub(super) fn velocity(&self) -> S {
        self.motion.clone() + &self.rigid
    }
}

/// The nodes along a part of the rod at a time, and the number of its parts between rays.
pub(super) type Line<S> = (Vec<Node<S>>, usize);

/// The nodes along the whole rod at a time.
pub(super) type Nodes<S> = Arc<Vec<Node<S>>>;

/// Maximum number of nodes kept, 1.3 MB in doubles: some 20 events of a rod with 50 rays.
const MOST_NODES: usize = 1 << 15;

/// Maximum number of strips in the cache: two for each core, since a core marches from one checkpoint to the next.
static MOST: LazyLock<usize> = LazyLock::new(|| 2 * std::thread::available_parallelism().map_or(1, NonZero::get));

impl<S: Scalar> Default for Pool<S> {
    fn default() -> Self {
        Pool { strips: Mutex::default(), lines: Mutex::default(), leaps: Mutex::default() }
    }
}

/// A clone has an empty cache.
impl<S: Scalar> Clone for Pool<S> {
    fn clone(&self) -> Self {
        Pool::default()
    }
}

impl<S: Scalar + PartialEq> Pool<S> {
    /// Takes the strips after checkpoint `start` out of the cache, if they are there.
    pub(super) fn take(&self, start: usize) -> Option<Strips<S>> {
        let mut all = locked(&self.strips);
        all.iter().position(|strips| strips.start == start).map(|k| all.remove(k))
    }

    pub(super) fn put(&self, strips: Strips<S>) {
        let mut all = locked(&self.strips);
        if all.len() >= *MOST {
            all.remove(0);
        }
        all.push(strips);
    }

    /// Returns the nodes at `time`, from the cache or from `find`.
    pub(super) fn line(&self, time: &S, find: impl FnOnce() -> Vec<Node<S>>) -> Nodes<S> {
        let known = locked(&self.lines).iter().rev().find(|(at, _)| at == time).map(|(_, line)| line.clone());
        known.unwrap_or_else(|| {
            let line = Arc::new(find());
            let mut all = locked(&self.lines);
            all.push_back((time.clone(), line.clone()));
            let mut nodes: usize = all.iter().map(|(_, line)| line.len()).sum();
            while nodes > MOST_NODES && all.len() > 1 {
                nodes -= all.pop_front().map_or(0, |(_, line)| line.len());
            }
            line
        })
    }

    /// Returns the state after a part of a leap, from the cache or from `find`.
    pub(super) fn leap(&self, leap: Leap, find: impl FnOnce() -> State<S>) -> State<S> {
        let known = locked(&self.leaps).iter().find(|(at, _)| *at == leap).map(|(_, state)| state.clone());
        known.unwrap_or_else(|| {
            let state = find();
            let mut all = locked(&self.leaps);
            if all.len() >= *MOST {
                all.pop_front();
            }
            all.push_back((leap, state.clone()));
            state
        })
    }
}
