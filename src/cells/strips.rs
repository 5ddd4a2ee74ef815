//! Strips of cells that one question has marched, kept for the next one: questions about times in order take one march.
//!
//! Strips are kept as they are marched from their checkpoint, so that a question meets the same cells, bit for bit,
//! whatever was asked before it.

use std::sync::{Mutex, PoisonError};

use super::cell::Cell;
use super::flight::Flight;
use super::march::{Medium, State};
use super::piece::{Checkpoint, Piece};
use crate::special::RoundedSpecial;

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
    size: usize,
    /// What comes after them.
    pub(super) state: State<S>,
    pub(super) flight: Option<usize>,
    pub(super) ground: S,
}

/// The most coefficients that strips keep, 2 MB in doubles: some 50 rays over two round trips.
const MOST: usize = 1 << 18;

impl<S: RoundedSpecial> Strips<S> {
    /// None yet.
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

    pub(super) fn is_full(&self) -> bool {
        self.size >= MOST
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
    pub(super) fn strip(&mut self, medium: &Medium<S>, piece: &Piece<S>, visit: &mut impl FnMut(&Cell<'_, S>)) {
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
    pub(super) fn show(&self, strip: usize, visit: &mut impl FnMut(&Cell<'_, S>)) {
        self.strips[strip].iter().for_each(|kept| visit(&kept.cell()));
    }
}

/// The strips that were asked for last: each question takes those that it needs, and puts them back.
#[derive(Debug)]
pub(super) struct Pool<S>(Mutex<Vec<Strips<S>>>);

impl<S> Default for Pool<S> {
    fn default() -> Self {
        Pool(Mutex::default())
    }
}

/// Of another history nothing is kept.
impl<S> Clone for Pool<S> {
    fn clone(&self) -> Self {
        Pool::default()
    }
}

impl<S> Pool<S> {
    fn with<T>(&self, work: impl FnOnce(&mut Vec<Strips<S>>) -> T) -> T {
        // Strips are complete whenever they are here.
        work(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The strips after checkpoint `start`, if they are kept.
    pub(super) fn take(&self, start: usize) -> Option<Strips<S>> {
        self.with(|all| all.iter().position(|strips| strips.start == start).map(|k| all.remove(k)))
    }

    /// Keeps strips: for each core those of two checkpoints, which times in order go between.
    pub(super) fn put(&self, strips: Strips<S>) {
        static MOST: std::sync::LazyLock<usize> =
            std::sync::LazyLock::new(|| 2 * std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
        self.with(|all| {
            all.push(strips);
            if all.len() > *MOST {
                all.remove(0);
            }
        });
    }
}
