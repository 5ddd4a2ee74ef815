//! Strips of cells that one question has marched, kept for the next one: questions about times in order take one march.
//!
//! Strips are kept as they are marched from their checkpoint, so that a question meets the same cells, bit for bit,
//! whatever was asked before it.

use std::num::NonZero;
use std::sync::{Arc, LazyLock, Mutex};

use super::cell::Cell;
use super::flight::Flight;
use super::march::{Medium, State};
use super::piece::{Checkpoint, Piece};
use crate::special::RoundedSpecial;
use crate::threads::locked;

/// A cell, and the data that come into it.
#[derive(Clone, Debug)]
pub(super) struct Kept<S> {
    corner: (S, S),
    size: (S, S),
    depth: (S, S),
    p: Vec<S>,
    q: Vec<S>,
    offset: S,
}

impl<S: Clone> Kept<S> {
    pub(super) fn of(cell: &Cell<'_, S>) -> Self {
        let Cell { corner, size, depth, p, q, offset } = cell;
        let (corner, size, depth, offset) = (corner.clone(), size.clone(), depth.clone(), offset.clone());
        Kept { corner, size, depth, p: p.to_vec(), q: q.to_vec(), offset }
    }

    pub(super) fn cell(&self) -> Cell<'_, S> {
        let Kept { corner, size, depth, p, q, offset } = self;
        let (corner, size, depth, offset) = (corner.clone(), size.clone(), depth.clone(), offset.clone());
        Cell { corner, size, depth, p, q, offset }
    }
}

/// The strips after a checkpoint, one for each piece, as far as they have been asked for.
#[derive(Clone, Debug)]
pub(super) struct Strips<S> {
    /// Which checkpoint.
    start: usize,
    strips: Vec<Vec<Kept<S>>>,
    /// How many coefficients are kept.
    pub(super) size: usize,
    /// What comes after them.
    pub(super) state: State<S>,
    pub(super) flight: Option<usize>,
    pub(super) ground: S,
}

/// The most coefficients that strips keep, 2 MB in doubles: some 50 rays over two round trips.
pub(super) const MOST_KEPT: usize = 1 << 18;

impl<S: RoundedSpecial> Strips<S> {
    pub(super) fn after(start: usize, kept: &Checkpoint<S>) -> Self {
        let Checkpoint { flight, state, ground, .. } = kept.clone();
        Strips { start, strips: Vec::new(), size: 0, state, flight, ground }
    }

    /// What comes after them, alone.
    pub(super) fn ahead(&self) -> Self {
        let Strips { start, flight, .. } = *self;
        let (state, ground) = (self.state.clone(), self.ground.clone());
        Strips { start, strips: Vec::new(), size: 0, state, flight, ground }
    }

    pub(super) fn count(&self) -> usize {
        self.strips.len()
    }

    /// Takes the vibration that is held to `flight`.
    pub(super) fn fly(&mut self, medium: &Medium<S>, flights: &[Flight<S>], flight: Option<usize>) {
        if flight != self.flight {
            let of = |flight: Option<usize>| flight.and_then(|k| flights.get(k));
            medium.convert(&mut self.state, of(self.flight), of(flight));
            self.flight = flight;
        }
    }

    /// Marches over the next piece, and shows its cells.
    pub(super) fn strip(&mut self, medium: &Medium<S>, piece: &Piece<S>, visit: &mut dyn FnMut(&Cell<'_, S>)) {
        if piece.cut {
            medium.cut_first(&mut self.state, &piece.len, Default::default());
        }
        medium.strip(&mut self.state, piece.contact, visit);
    }

    /// Marches over the next piece, and keeps its cells.
    pub(super) fn keep(&mut self, medium: &Medium<S>, flights: &[Flight<S>], piece: &Piece<S>) {
        let mut cells = Vec::with_capacity(self.state.segments.len() + 2);
        self.fly(medium, flights, piece.flight);
        self.strip(medium, piece, &mut |cell| cells.push(Kept::of(cell)));
        self.size += cells.iter().map(|cell| cell.p.len() + cell.q.len()).sum::<usize>();
        self.strips.push(cells);
    }

    /// Shows the cells of a strip that is kept.
    pub(super) fn show(&self, strip: usize, visit: &mut dyn FnMut(&Cell<'_, S>)) {
        self.strips[strip].iter().for_each(|kept| visit(&kept.cell()));
    }
}

/// What was asked for last: each question takes the strips that it needs, and puts them back. The nodes of a line along
/// the whole rod serve all that is asked about one time.
#[derive(Debug)]
pub(super) struct Pool<S> {
    strips: Mutex<Vec<Strips<S>>>,
    lines: Mutex<Vec<(S, Nodes<S>)>>,
}

/// A node of a quadrature along the rod.
#[derive(Clone, Debug)]
pub(super) struct Node<S> {
    pub(super) weight: S,
    pub(super) x: S,
    /// `h′` of the flight that the vibration is taken apart from; zero without one.
    pub(super) rigid: S,
    /// The rest of `v_t`.
    pub(super) motion: S,
    /// `v_x`.
    pub(super) strain: S,
}

impl<S: RoundedSpecial> Node<S> {
    /// `v_t`.
    pub(super) fn velocity(&self) -> S {
        self.motion.clone() + &self.rigid
    }
}

/// The nodes along a part of the rod at a time, and how many parts of it lie between rays.
pub(super) type Line<S> = (Vec<Node<S>>, usize);

/// The nodes along the whole rod at a time.
pub(super) type Nodes<S> = Arc<Vec<Node<S>>>;

/// Each core goes from one checkpoint to the next.
static MOST: LazyLock<usize> = LazyLock::new(|| 2 * std::thread::available_parallelism().map_or(1, NonZero::get));

/// Puts `item` last, and drops the first where there are too many.
fn push<T>(list: &Mutex<Vec<T>>, item: T) {
    let mut all = locked(list);
    if all.len() >= *MOST {
        all.remove(0);
    }
    all.push(item);
}

impl<S> Default for Pool<S> {
    fn default() -> Self {
        Pool { strips: Mutex::default(), lines: Mutex::default() }
    }
}

/// A clone starts empty.
impl<S> Clone for Pool<S> {
    fn clone(&self) -> Self {
        Pool::default()
    }
}

impl<S: PartialEq> Pool<S> {
    /// The strips after checkpoint `start`, if they are kept.
    pub(super) fn take(&self, start: usize) -> Option<Strips<S>> {
        let mut all = locked(&self.strips);
        all.iter().position(|strips| strips.start == start).map(|k| all.remove(k))
    }

    pub(super) fn put(&self, strips: Strips<S>) {
        push(&self.strips, strips);
    }

    /// The nodes at `time`: those that are kept, or those that `find` gives.
    pub(super) fn line(&self, time: &S, find: impl FnOnce() -> Vec<Node<S>>) -> Nodes<S>
    where
        S: Clone,
    {
        let known = locked(&self.lines).iter().find(|(at, _)| at == time).map(|(_, line)| line.clone());
        known.unwrap_or_else(|| {
            let line = Arc::new(find());
            push(&self.lines, (time.clone(), line.clone()));
            line
        })
    }
}
