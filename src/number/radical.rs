//! Exact numbers composed of fractions and square roots: `3 + √2`, `1/2 + √(5 + 2√3)`.

use std::cmp::Ordering;
use std::sync::Arc;
use std::sync::atomic::{self, AtomicU64};

use super::Scalar;
use super::float::{Float, down, up};
use super::rational::{self, Integer, Rational};

/// A positive square root, or a named number that equals only itself. Roots are ordered by depth first, so that a
/// radicand contains only roots that precede its own.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Root {
    depth: u32,
    /// The radicand; `None` for a named number.
    radicand: Option<Radical>,
    /// Identifier of a named number; 0 for roots.
    name: u64,
}

/// A product of roots, in order and each once, and of named numbers with multiplicity; empty for 1.
type Product = Vec<Arc<Root>>;

/// A sum `Σ c_k ρ_i ρ_j …` of fractions times products of roots.
///
/// The number is zero if all `c_k` are zero. It may also be zero otherwise, if its roots are dependent in an undetected
/// way. Then only digits could decide, and these never prove zero. A reported sign is therefore never wrong.
///
/// Operations return `None` if the result exceeds [`MOST_TERMS`] or [`MOST_BITS`].
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Radical {
    terms: Vec<(Product, Rational)>,
}

/// Maximum number of terms; longer numbers are not worth carrying.
const MOST_TERMS: usize = 16;
const MOST_BITS: u32 = 1 << 12;
const MOST_DEPTH: u32 = 3;
/// Upper limit of the square factors that leave the root of a fraction.
const SMALL_FACTOR: u32 = 200;
/// Maximum number of bits that are tried to decide a sign.
const MOST_SIGN_BITS: u32 = 4096;

impl Radical {
    pub(super) fn rational(x: Rational) -> Option<Self> {
        Radical::checked(vec![(Vec::new(), x)])
    }

    /// Returns a new named number, of which nothing else is known.
    pub(super) fn named() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let name = NEXT.fetch_add(1, atomic::Ordering::Relaxed);
        Radical::root(Arc::new(Root { depth: 1, radicand: None, name }))
    }

    fn root(root: Arc<Root>) -> Self {
        Radical { terms: vec![(vec![root], Rational::from(1))] }
    }

    fn checked(mut terms: Vec<(Product, Rational)>) -> Option<Self> {
        terms.retain(|(_, c)| rational::sign(c).is_ne());
        let long = |c: &Rational| rational::size(c) > MOST_BITS;
        (terms.len() <= MOST_TERMS && !terms.iter().any(|(_, c)| long(c))).then_some(Radical { terms })
    }

    fn depth(&self) -> u32 {
        self.terms.iter().flat_map(|(product, _)| product.iter().map(|root| root.depth)).max().unwrap_or(0)
    }

    /// Returns whether all coefficients are zero, which makes the number zero.
    pub(super) fn vanishes(&self) -> bool {
        self.terms.is_empty()
    }

    /// Returns the number if it has no roots.
    fn as_rational(&self) -> Option<Rational> {
        match self.terms.as_slice() {
            [] => Some(Rational::from(0)),
            [(product, c)] if product.is_empty() => Some(c.clone()),
            _ => None,
        }
    }

    pub(super) fn scaled(&self, by: &Rational) -> Option<Self> {
        Radical::checked(self.terms.iter().map(|(p, c)| (p.clone(), c.clone() * by)).collect())
    }

    pub(super) fn neg(&self) -> Self {
        Radical { terms: self.terms.iter().map(|(p, c)| (p.clone(), -c.clone())).collect() }
    }

    pub(super) fn add(&self, other: &Self) -> Option<Self> {
        let mut sum = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut ours, mut theirs) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let order = match (ours.peek(), theirs.peek()) {
                (Some((p, _)), Some((q, _))) => p.cmp(q),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return Radical::checked(sum),
            };
            let mut term = match order {
                Ordering::Greater => theirs.next().cloned(),
                _ => ours.next().cloned(),
            };
            if let (Ordering::Equal, Some((_, c)), Some((_, d))) = (order, term.as_mut(), theirs.peek()) {
                *c += d;
                theirs.next();
            }
            sum.extend(term);
        }
    }

    pub(super) fn sub(&self, other: &Self) -> Option<Self> {
        self.add(&other.neg())
    }

    pub(super) fn mul(&self, other: &Self) -> Option<Self> {
        if let Some(c) = other.as_rational() {
            return self.scaled(&c);
        }
        if self.terms.len() * other.terms.len() > 16 * MOST_TERMS {
            return None;
        }
        let mut sum = Radical::default();
        for (p, c) in &self.terms {
            for (q, d) in &other.terms {
                // Roots in both products are replaced by their radicands.
                let (mut product, mut radicands) = (Vec::with_capacity(p.len() + q.len()), Vec::new());
                let mut rest = q.iter().peekable();
                for root in p {
                    while let Some(next) = rest.next_if(|next| *next < root) {
                        product.push(next.clone());
                    }
                    match &root.radicand {
                        Some(radicand) if rest.next_if(|next| *next == root).is_some() => radicands.push(radicand),
                        _ => product.push(root.clone()),
                    }
                }
                product.extend(rest.cloned());
                let mut term = Radical::checked(vec![(product, c.clone() * d)])?;
                for radicand in radicands {
                    term = radicand.mul(&term)?;
                }
                sum = sum.add(&term)?;
            }
        }
        Some(sum)
    }

    /// Returns `(A, B, ρ)` with `self = A + Bρ` for the last of its roots.
    fn split(&self) -> Option<(Self, Self, Arc<Root>)> {
        let roots = self.terms.iter().filter_map(|(product, _)| product.last());
        let last = roots.max()?.clone();
        let has = |product: &Product| product.last() == Some(&last);
        let (with, without): (Vec<_>, Vec<_>) = self.terms.iter().cloned().partition(|(product, _)| has(product));
        let mut factor: Vec<(Product, Rational)> =
            with.into_iter().map(|(product, c)| (product[..product.len() - 1].to_vec(), c)).collect();
        factor.sort();
        Some((Radical { terms: without }, Radical { terms: factor }, last))
    }

    /// Returns `A² − B²ρ²` of [`Radical::split`]; `None` for a named number.
    fn norm(a: &Self, b: &Self, root: &Root) -> Option<Self> {
        a.mul(a)?.sub(&b.mul(b)?.mul(root.radicand.as_ref()?)?)
    }

    /// Returns the quotient; `None` also for division by zero.
    pub(super) fn div(&self, other: &Self) -> Option<Self> {
        self.mul(&other.inverse()?)
    }

    fn inverse(&self) -> Option<Self> {
        if let Some(c) = self.as_rational() {
            return if rational::sign(&c).is_eq() { None } else { Radical::rational(Rational::from(1) / c) };
        }
        let (a, b, root) = self.split()?;
        let conjugate = a.sub(&b.mul(&Radical::root(root.clone()))?)?;
        conjugate.mul(&Radical::norm(&a, &b, &root)?.inverse()?)
    }

    /// Returns the sign; `None` if [`MOST_SIGN_BITS`] bits do not decide it.
    pub(super) fn sign(&self) -> Option<Ordering> {
        if let Some(c) = self.as_rational() {
            return Some(rational::sign(&c));
        }
        let mut bits = 64;
        while bits <= MOST_SIGN_BITS {
            match self.enclosed(bits)?.map(|end| end.cmp0()) {
                [Some(Ordering::Greater), _] => return Some(Ordering::Greater),
                [_, Some(Ordering::Less)] => return Some(Ordering::Less),
                _ => bits *= 2,
            }
        }
        None
    }

    /// Encloses the number between two numbers of this precision; `None` if it contains a named number.
    fn enclosed(&self, bits: u32) -> Option<[Float; 2]> {
        let (mut lo, mut hi) = (Float::new(bits), Float::new(bits));
        for (product, c) in &self.terms {
            // The magnitude of the term is enclosed first; all its roots are positive.
            let negative = rational::sign(c).is_lt();
            let size = if negative { -c.clone() } else { c.clone() };
            let (mut least, mut most) = (down(bits, &size), up(bits, &size));
            for root in product {
                let [below, above] = root.radicand.as_ref()?.enclosed(bits)?;
                if below.cmp0() == Some(Ordering::Greater) {
                    least = down(bits, &least * &down(bits, below.sqrt_ref()));
                } else {
                    least = Float::new(bits);
                }
                most = up(bits, &most * &up(bits, above.sqrt_ref()));
            }
            if negative {
                (least, most) = (-most, -least);
            }
            (lo, hi) = (down(bits, &lo + &least), up(bits, &hi + &most));
        }
        Some([lo, hi])
    }

    pub(super) fn compare(&self, other: &Self) -> Option<Ordering> {
        self.sub(other)?.sign()
    }

    /// Returns `⌊self⌋` of a fraction; `None` if it does not fit.
    pub(super) fn floor(&self) -> Option<i64> {
        self.as_rational().and_then(|c| rational::floor(&c))
    }

    /// Returns `√self ≥ 0` of a number known to be nonnegative.
    pub(super) fn sqrt(&self) -> Option<Self> {
        if let Some(root) = self.root_within()
            && let Some(sign) = root.sign()
        {
            return Some(if sign == Ordering::Less { root.neg() } else { root });
        }
        // √x = s √(x/s²) with integer coefficients under the root that have no easily detected common square.
        let square = |n: &Integer| n.clone() * n;
        let below = self.terms.iter().fold(Integer::from(1), |lcm, (_, c)| {
            let (_, denominator) = rational::parts(c);
            let common = rational::gcd(lcm.clone(), &denominator);
            lcm / common * denominator
        });
        let whole = self.scaled(&Rational::from(square(&below)))?;
        let content =
            whole.terms.iter().fold(Integer::from(0), |gcd, (_, c)| rational::gcd(rational::parts(c).0, &gcd));
        let factor = square_factor(&content, SMALL_FACTOR);
        let radicand = whole.scaled(&rational::quotient(Integer::from(1), square(&factor)))?;
        let scale = rational::quotient(factor, below);
        let root = Root { depth: radicand.depth() + 1, radicand: Some(radicand), name: 0 };
        if root.depth > MOST_DEPTH { None } else { Radical::checked(vec![(vec![Arc::new(root)], scale)]) }
    }

    /// Returns a root of either sign that needs no new root.
    ///
    /// `(u + vρ)² = A + Bρ` requires `u² = (A ± n)/2` with `n² = A² − B²ρ²`, and `v = B/2u`.
    fn root_within(&self) -> Option<Self> {
        if let Some(c) = self.as_rational() {
            return c.try_sqrt().and_then(Radical::rational);
        }
        let (a, b, root) = self.split()?;
        let n = Radical::norm(&a, &b, &root)?.root_within()?;
        let half = rational::half(Rational::from(1));
        [a.add(&n)?, a.sub(&n)?].into_iter().find_map(|twice| {
            let u = twice.scaled(&half)?.root_within()?;
            let v = b.scaled(&half)?.div(&u)?;
            u.add(&v.mul(&Radical::root(root.clone()))?)
        })
    }
}

/// Returns a factor `s` with `s² | n`, `n > 0`: squares of primes below a limit, and a cofactor that is a square.
pub(super) fn square_factor(n: &Integer, limit: u32) -> Integer {
    let (mut rest, mut factor) = (n.clone(), Integer::from(1));
    let zero = Integer::from(0);
    for prime in 2..limit {
        let square = Integer::from(prime * prime);
        if square > rest {
            break;
        }
        while rest.clone() % &square == zero {
            rest /= &square;
            factor *= prime;
        }
    }
    match rational::exact_root(&rest) {
        Some(root) => factor * root,
        None => factor,
    }
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/radical.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
