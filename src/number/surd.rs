//! Exact numbers `a + b√d` of one real quadratic field.

use std::cmp::Ordering;

use rug::ops::NegAssign;
use rug::{Integer, Rational};

/// `a + b√d` with fractions `a`, `b` and an integer `d > 1` that is no square; `d = 1` where `b = 0`.
///
/// Operations give `None` where the result leaves the field or outgrows [`MOST_BITS`].
#[derive(Clone, Debug)]
pub(crate) struct Surd {
    a: Rational,
    b: Rational,
    d: Integer,
}

/// Longer fractions are not worth carrying.
const MOST_BITS: u32 = 1 << 13;

impl Surd {
    pub(crate) fn new(a: Rational, b: Rational, d: Integer) -> Option<Self> {
        let bits = |x: &Rational| x.numer().significant_bits() + x.denom().significant_bits();
        if bits(&a) + bits(&b) + d.significant_bits() > MOST_BITS {
            return None;
        }
        let d = if b.is_zero() { Integer::from(1) } else { d };
        Some(Surd { a, b, d })
    }

    pub(crate) fn rational(a: Rational) -> Option<Self> {
        Surd::new(a, Rational::new(), Integer::from(1))
    }

    /// Both in one field: `√e = s√d/d` where `de = s²`.
    fn together(&self, other: &Self) -> Option<(Rational, Integer)> {
        if other.b.is_zero() || self.d == other.d {
            return Some((other.b.clone(), self.d.clone()));
        }
        if self.b.is_zero() {
            return Some((other.b.clone(), other.d.clone()));
        }
        let product = Integer::from(&self.d * &other.d);
        product.is_perfect_square().then(|| {
            let factor = Rational::from((product.sqrt(), self.d.clone()));
            (Rational::from(&other.b * &factor), self.d.clone())
        })
    }

    pub(crate) fn neg(&self) -> Self {
        let mut result = self.clone();
        result.a.neg_assign();
        result.b.neg_assign();
        result
    }

    pub(crate) fn add(&self, other: &Self) -> Option<Self> {
        let (b, d) = self.together(other)?;
        Surd::new(Rational::from(&self.a + &other.a), b + &self.b, d)
    }

    pub(crate) fn sub(&self, other: &Self) -> Option<Self> {
        self.add(&other.neg())
    }

    pub(crate) fn mul(&self, other: &Self) -> Option<Self> {
        let (b, d) = self.together(other)?;
        let root = Rational::from(&self.b * &b) * &d;
        Surd::new(
            Rational::from(&self.a * &other.a) + root,
            Rational::from(&self.a * &b) + Rational::from(&self.b * &other.a),
            d,
        )
    }

    /// `None` also for division by zero.
    pub(crate) fn div(&self, other: &Self) -> Option<Self> {
        let norm = other.norm();
        if norm.is_zero() {
            return None;
        }
        let inverse = Surd::new(Rational::from(&other.a / &norm), -Rational::from(&other.b / &norm), other.d.clone())?;
        self.mul(&inverse)
    }

    /// `a² − b²d`, zero for zero only.
    fn norm(&self) -> Rational {
        Rational::from(self.a.square_ref()) - Rational::from(self.b.square_ref()) * &self.d
    }

    /// The sign, exactly.
    pub(crate) fn sign(&self) -> Ordering {
        let (a, b) = (self.a.cmp0(), self.b.cmp0());
        match (a, b) {
            (_, Ordering::Equal) => a,
            (Ordering::Equal, _) => b,
            _ if a == b => a,
            // Of different signs: the greater square decides.
            _ if self.norm().cmp0().is_gt() => a,
            _ => b,
        }
    }

    pub(crate) fn cmp(&self, other: &Self) -> Option<Ordering> {
        self.sub(other).map(|difference| difference.sign())
    }

    /// `⌊self⌋` where it fits.
    pub(crate) fn floor(&self) -> Option<Integer> {
        self.b.is_zero().then(|| Integer::from(self.a.floor_ref()))
    }

    /// `√self ≥ 0` where it stays in a field of one root.
    ///
    /// `(u + v√d)² = a + b√d` wants `u² = (a ± n)/2` with `n² = a² − b²d`, and `v = b/2u`.
    pub(crate) fn sqrt(&self) -> Option<Self> {
        if self.sign() == Ordering::Less {
            return None;
        }
        if self.b.is_zero() {
            if let Some(root) = rational_root(&self.a) {
                return Surd::rational(root);
            }
            let d = Integer::from(self.a.numer() * self.a.denom());
            let b = Rational::from((1, self.a.denom().clone()));
            return Surd::new(Rational::new(), b, d);
        }
        let n = rational_root(&self.norm())?;
        [Rational::from(&self.a + &n), Rational::from(&self.a - &n)].into_iter().find_map(|twice| {
            let u = rational_root(&(twice / 2u32))?;
            if u.is_zero() {
                return None;
            }
            let v = Rational::from(&self.b / &u) / 2u32;
            let root = Surd::new(u, v, self.d.clone())?;
            Some(if root.sign() == Ordering::Less { root.neg() } else { root })
        })
    }
}

/// `√x` where it is a fraction.
fn rational_root(x: &Rational) -> Option<Rational> {
    (x.cmp0().is_ge() && x.numer().is_perfect_square() && x.denom().is_perfect_square())
        .then(|| Rational::from((x.numer().clone().sqrt(), x.denom().clone().sqrt())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surd(a: (i32, i32), b: (i32, i32), d: i32) -> Surd {
        Surd::new(Rational::from(a), Rational::from(b), Integer::from(d)).unwrap()
    }

    #[test]
    fn a_field_with_an_order() {
        let x = surd((3, 1), (1, 1), 2);
        // (3 + √2)(3 − √2) = 7
        let seven = x.mul(&surd((3, 1), (-1, 1), 2)).unwrap();
        assert_eq!(seven.cmp(&surd((7, 1), (0, 1), 1)), Some(Ordering::Equal));
        assert_eq!(x.div(&x).unwrap().cmp(&surd((1, 1), (0, 1), 1)), Some(Ordering::Equal));
        // 7/5 < √2 < 17/12
        assert_eq!(surd((-7, 5), (1, 1), 2).sign(), Ordering::Greater);
        assert_eq!(surd((-17, 12), (1, 1), 2).sign(), Ordering::Less);
        // √8 = 2√2, √2 + √3 leaves the field.
        let eight = surd((8, 1), (0, 1), 1).sqrt().unwrap();
        assert_eq!(eight.cmp(&surd((0, 1), (2, 1), 2)), Some(Ordering::Equal));
        assert!(eight.add(&surd((0, 1), (1, 1), 3)).is_none());
    }

    #[test]
    fn roots_in_the_field() {
        // (1 − √2)² = 3 − 2√2, whose root is √2 − 1.
        let root = surd((3, 1), (-2, 1), 2).sqrt().unwrap();
        assert_eq!(root.cmp(&surd((-1, 1), (1, 1), 2)), Some(Ordering::Equal));
        assert!(surd((1, 1), (1, 1), 2).sqrt().is_none());
        assert!(surd((-1, 1), (0, 1), 1).sqrt().is_none());
    }
}
