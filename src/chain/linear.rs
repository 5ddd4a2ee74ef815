//! The linear equation of the states of a cluster that act back on the motion, and the groups of them that decay fast.

use super::cluster::Cluster;
use super::curve::upper;
use super::interface::Interface;
use super::response::Response;
use crate::number::Bounded;

/// A state that acts back on the motion while no contact changes.
#[derive(Clone, Debug)]
pub(super) struct Dynamic<N> {
    pub(super) state: usize,
    /// The root of its weight in the norm.
    pub(super) root: N,
    /// The rate at which it decays if the others are zero; `None` if it does not decay.
    pub(super) decay: Option<N>,
    /// Magnitudes of the factors of these states in its rate; zero for its own.
    pub(super) factors: Vec<N>,
}

/// States that follow the others at once.
#[derive(Clone, Debug)]
pub(super) struct Block<N> {
    pub(super) states: Vec<usize>,
    /// Bounds of the time that each takes to decay.
    pub(super) times: Vec<N>,
    /// Inverse of the matrix of their factors in their rates.
    inverse: Vec<Vec<N>>,
    /// Bounds of the response to a constant rate, and to a distance at the beginning.
    driven: Vec<Vec<N>>,
    left: Vec<Vec<N>>,
    /// Greatest sum of a row of the response to rates, in the norm.
    slowness: f64,
}

/// The linear equation of the states that act back on the motion.
#[derive(Clone, Debug)]
pub(super) struct Linear<N> {
    pub(super) dynamic: Vec<Dynamic<N>>,
    /// A bound of the rates.
    pub(super) rate: f64,
    /// Factors of the states in the rates of each, in the norm.
    scaled: Vec<Vec<f64>>,
    /// Places of the states, the one that decays fastest first.
    pub(super) order: Vec<usize>,
    /// The first states in that order, with one more in each: `None` for those that do not decay together.
    blocks: Vec<Option<Block<N>>>,
    /// The response of all states, if they are few and decay.
    pub(super) response: Option<Response>,
}

/// Greatest number of states whose response is computed.
const MOST_TOGETHER: usize = 12;

/// Greatest product of rate and width for a Taylor step.
pub(super) const WIDEST: f64 = 2.0;

/// Share of the greatest width that a step takes.
const UNEVEN: f64 = 0.971_828_182_845;

/// Returns a width of at most [`WIDEST`] over a rate. A width that is no simple fraction keeps the ends of steps away
/// from times that are asked for.
pub(super) fn even(rate: f64, width: f64) -> f64 {
    let product = rate * width;
    if product > WIDEST { width * UNEVEN / (product / WIDEST).ceil() } else { width }
}

impl<N> Default for Linear<N> {
    fn default() -> Self {
        Linear {
            dynamic: Vec::new(),
            rate: 0.0,
            scaled: Vec::new(),
            order: Vec::new(),
            blocks: Vec::new(),
            response: None,
        }
    }
}

/// Returns `Σ mᵢⱼ xⱼ` for each row.
fn applied<N: Bounded>(matrix: &[Vec<N>], x: &[N]) -> Vec<N> {
    let sum = |row: &Vec<N>| row.iter().zip(x).map(|(m, x)| m.clone() * x).reduce(|sum, term| sum + term);
    matrix.iter().filter_map(sum).collect()
}

impl<N: Bounded> Block<N> {
    /// Returns the solution of `Mx = b` for the matrix of the states.
    pub(super) fn inverse(&self, b: &[N]) -> Vec<N> {
        applied(&self.inverse, b)
    }

    /// Returns the sums of the magnitudes of the terms of that solution.
    pub(super) fn inverse_size(&self, b: &[N]) -> Vec<N> {
        let term = |(m, b): (&N, &N)| m.magnitude() * b.magnitude();
        let sum = |row: &Vec<N>| row.iter().zip(b).map(term).reduce(|sum, term| sum + term);
        self.inverse.iter().filter_map(sum).collect()
    }

    /// Returns bounds of the states that rates within these bounds drive from zero.
    pub(super) fn driven(&self, rates: &[N]) -> Vec<N> {
        applied(&self.driven, rates)
    }

    /// Returns bounds of the states that are left of those at the beginning.
    pub(super) fn left(&self, begun: &[N]) -> Vec<N> {
        applied(&self.left, begun)
    }
}

/// Returns the inverse of a matrix; `None` if a pivot is zero within its bound.
fn inverse<N: Bounded>(mut rows: Vec<Vec<N>>) -> Option<Vec<Vec<N>>> {
    let count = rows.len();
    for (i, row) in rows.iter_mut().enumerate() {
        let (zero, one) = (row[0].zero(), row[0].one());
        row.extend((0..count).map(|j| if i == j { one.clone() } else { zero.clone() }));
    }
    for k in 0..count {
        let size = |i: &usize| rows[*i][k].to_f64().abs();
        let pivot = (k..count).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        rows.swap(k, pivot);
        let own = rows[k].clone();
        if own[k].positive() != Ok(true) && own[k].negative() != Ok(true) {
            return None;
        }
        let own: Vec<N> = own.iter().map(|x| x.clone() / &own[k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[k].clone();
            for (x, own) in row.iter_mut().zip(&own) {
                *x = if i == k { own.clone() } else { x.clone() - own.clone() * &factor };
            }
        }
    }
    Some(rows.into_iter().map(|row| row[count..].to_vec()).collect())
}

/// Leaves a state out of a matrix: it follows the others at once, `x = −Σ mⱼ xⱼ/m` for the factors in its own rate.
fn leave_out(state: usize, matrix: &mut [Vec<f64>]) {
    let own = matrix[state].clone();
    for row in matrix {
        let factor = row[state] / own[state];
        row.iter_mut().zip(&own).for_each(|(x, own)| *x -= factor * own);
    }
}

/// Returns the places of states in the order in which they are left out: next comes the one that decays fastest once
/// those before it follow the others at once. Those that do not decay are missing.
fn order(mut matrix: Vec<Vec<f64>>) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::new();
    loop {
        let left = (0..matrix.len()).filter(|i| !order.contains(i));
        let fastest = left.max_by(|i, j| matrix[*j][*j].total_cmp(&matrix[*i][*i]));
        let Some(fastest) = fastest.filter(|i| matrix[*i][*i] < 0.0) else { return order };
        order.push(fastest);
        leave_out(fastest, &mut matrix);
    }
}

impl<N: Bounded> Linear<N> {
    /// Returns the equation of states, each with the root of its weight, from the factors of all states in their rates.
    fn new(roots: Vec<(usize, N)>, matrix: Vec<Vec<N>>) -> Self {
        let scaled = |i: usize, j: usize| (matrix[i][j].clone() * &roots[i].1 / &roots[j].1).to_f64();
        let count = roots.len();
        let scaled: Vec<Vec<f64>> = (0..count).map(|i| (0..count).map(|j| scaled(i, j)).collect()).collect();
        let size = |row: &Vec<f64>| row.iter().map(|x| x.abs()).sum();
        let rate = scaled.iter().map(size).fold(0.0, f64::max);
        let (mut order, mut blocks, mut response) = (Vec::new(), Vec::new(), None);
        if count <= MOST_TOGETHER {
            order = self::order(scaled.clone());
            let block = |count: usize| Block::new(&order[..count], &roots, &matrix, &scaled);
            blocks = (1..=order.len()).map(block).collect();
            response = Response::new(&scaled).filter(|_| count > 1);
        }
        let dynamic = roots.into_iter().zip(matrix).enumerate().map(|(own, ((state, root), row))| {
            let decay = Some(-row[own].clone()).filter(|decay| decay.positive() == Ok(true));
            let factor = |(j, x): (usize, &N)| if j == own { x.zero() } else { x.magnitude() };
            Dynamic { state, root, decay, factors: row.iter().enumerate().map(factor).collect() }
        });
        Linear { dynamic: dynamic.collect(), rate, scaled, order, blocks, response }
    }

    /// Returns the root of the weight of a state, if it acts back.
    pub(super) fn root(&self, state: usize) -> Option<&N> {
        self.dynamic.iter().find(|own| own.state == state).map(|own| &own.root)
    }

    /// Returns the first states in the order of their decay.
    pub(super) fn block(&self, count: usize) -> Option<&Block<N>> {
        self.blocks.get(count.checked_sub(1)?)?.as_ref()
    }

    /// Returns the greatest number of states, of the first `most` in the order of their decay, that decay much faster
    /// than a step over a width follows the others, and a width over which it does.
    ///
    /// **Source**: they are `M⁻¹` times the rates that the others cause, and slopes of that, which leaves the others
    /// with the matrix `A − B M⁻¹ C`.
    pub(super) fn fast(&self, degree: usize, width: f64, most: usize) -> Option<(usize, f64)> {
        (1..=most.min(self.order.len())).rev().find_map(|count| {
            let least = self.block(count)?.slowness * degree as f64;
            let mut left = self.scaled.clone();
            self.order[..count].iter().for_each(|fast| leave_out(*fast, &mut left));
            let is_fast = |i: &usize| self.order[..count].contains(i);
            let others = (0..left.len()).filter(|i| !is_fast(i));
            let size = |i: usize| (0..left.len()).filter(|j| !is_fast(j)).map(|j| left[i][j].abs()).sum();
            let slow = even(others.map(size).fold(0.0, f64::max), width);
            (least < slow).then_some((count, slow))
        })
    }
}

impl<N: Bounded> Block<N> {
    fn new(places: &[usize], roots: &[(usize, N)], matrix: &[Vec<N>], scaled: &[Vec<f64>]) -> Option<Self> {
        let own = |row: &[f64]| places.iter().map(|j| row[*j]).collect();
        let response = Response::new(&places.iter().map(|i| own(&scaled[*i])).collect())?;
        // A bound in the norm, as one of the states.
        let unscaled = |bounds: &[Vec<f64>]| -> Vec<Vec<N>> {
            let bound = |i: usize, j: usize| {
                let [own, other] = [i, j].map(|k| &roots[places[k]].1);
                upper(own.double(bounds[i][j]) * other / own)
            };
            (0..places.len()).map(|i| (0..places.len()).map(|j| bound(i, j)).collect()).collect()
        };
        let driven = unscaled(&response.integral);
        Some(Block {
            states: places.iter().map(|place| roots[*place].0).collect(),
            times: driven.iter().enumerate().map(|(i, row)| row[i].clone()).collect(),
            inverse: inverse(places.iter().map(|i| places.iter().map(|j| matrix[*i][*j].clone()).collect()).collect())?,
            driven,
            left: unscaled(&response.peak),
            slowness: response.integral.iter().map(|row| row.iter().sum()).fold(0.0, f64::max),
        })
    }
}

impl<N: Bounded> Cluster<N> {
    /// Finds the states that act back on the motion in the present state of the contacts.
    pub(super) fn relate(&mut self) {
        let zero = self.norm.zero();
        let masses = self.masses.iter().map(|mass| mass.root.clone()).enumerate();
        let sprung = self.interfaces.iter().enumerate().filter(|(_, interface)| interface.is_sprung());
        let root = |(j, interface): (usize, &Interface<N>)| {
            Some((self.masses.len() + j, interface.soft.as_ref()?.root.clone()))
        };
        let roots: Vec<(usize, N)> = masses.chain(sprung.filter_map(root)).collect();
        let none = self.inputs_of_zero();
        let column = |of: usize| {
            let state = |k: usize| if k == of { zero.one() } else { zero.zero() };
            self.rates_in_order(&none, 0, &state)
        };
        let columns: Vec<Vec<N>> = roots.iter().map(|(of, _)| column(*of)).collect();
        let row = |(state, _): &(usize, N)| columns.iter().map(|column| column[*state].clone()).collect();
        let matrix = roots.iter().map(row).collect();
        self.linear = Linear::new(roots, matrix);
        self.since = None;
        self.interfaces.iter_mut().for_each(|interface| interface.holds = false);
    }
}
