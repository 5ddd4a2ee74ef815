//! The elementary functions.
//!
//! Each is computed in a limb more than asked for, `M = N + 1`, and rounded once. There an operation has the roundoff
//! `v = 2^{−64M}`, of which `2⁶⁴` make a unit of the last place of the result, so that whatever is within `2⁵⁶ v` of
//! itself is within `½ + 2^{−8}` units when it is rounded: 0.51. A value that has `N` limbs is met exactly.

use super::float::{MOST, Wide};
use crate::number::Analytic;

/// `π/4`, in 16 limbs.
const QUARTER_PI: Wide<16> = Wide {
    #[rustfmt::skip]
    limbs: [
        0x98da48361c55d39a, 0xc2007cb8a163bf05, 0x49286651ece45b3d, 0xae9f24117c4b1fe6,
        0xee386bfb5a899fa5, 0x0bff5cb6f406b7ed, 0xf44c42e9a637ed6b, 0xe485b576625e7ec6,
        0x4fe1356d6d51c245, 0x302b0a6df25f1437, 0xef9519b3cd3a431b, 0x514a08798e3404dd,
        0x020bbea63b139b22, 0x29024e088a67cc74, 0xc4c6628b80dc1cd1, 0xc90fdaa22168c234,
    ],
    exponent: 0,
    negative: false,
};

/// `ln 2`, in eight limbs.
pub(super) const LN_2: Wide<8> = Wide {
    #[rustfmt::skip]
    limbs: [
        0x27573b291169b825, 0xed2eae35c1382144, 0x559552fb4afa1b10, 0xe7b876206debac98,
        0x8a0d175b8baafa2b, 0x40f343267298b62d, 0xc9e3b39803f2f6af, 0xb17217f7d1cf79ab,
    ],
    exponent: 0,
    negative: false,
};

/// `n!/k!` for n = 20: the coefficients of series with integers, which are divided by `n!` once.
const FALLING: [i64; 21] = {
    let mut list = [1; 21];
    let mut k = 20;
    while k > 0 {
        list[k - 1] = list[k] * k as i64;
        k -= 1;
    }
    list
};

/// The product of the odd numbers up to 33.
const ODD: i64 = 6_332_659_870_762_850_625;

impl<const M: usize> Wide<M> {
    /// Halvings after which 20 terms are enough, for arguments up to `π/4`: at `x ≤ 2^{−3M − 0.3}` the term `x²⁰/21!`
    /// is below `2^{−60M − 72}`, which is below `2^{−64M − 12}` up to `M = 15`.
    const HALVINGS: i32 = 3 * M as i32;

    /// `x⁰ c₀ + x¹ c₁ + …`, by Horner.
    fn polynomial(x: Self, coefficients: impl DoubleEndedIterator<Item = i64>) -> Self {
        coefficients.rev().fold(Wide::ZERO, |sum, c| sum * x + Wide::from(c))
    }

    /// `(eˣ − 1)/x` for `|x| ≤ 2^{−3M − 0.3}`, within `2⁴ v`.
    ///
    /// In Horner's form the last step has two roundings and weighs 1, those before weigh less than `2^{−6}` together;
    /// one for the quotient, and less than one for the rest.
    fn short_exp(x: Self) -> Self {
        // The first term left out is below 2^{exponent · terms}/(terms + 1)!.
        let fall = x.exponent.min(0).unsigned_abs() as usize;
        let factorial = |k: usize| (FALLING[0].ilog2() - FALLING[k].ilog2()).saturating_sub(1) as usize;
        let enough = |terms: &usize| terms.saturating_mul(fall) + factorial(terms + 1) >= 64 * M + 12;
        let terms = (1..20).find(enough).unwrap_or(20);
        Self::polynomial(x, FALLING[1..=terms].iter().copied()) / Wide::from(FALLING[0])
    }

    /// `eˣ`, within `2³⁴ v`; within `2³⁰ v` for `|x| < 1`.
    ///
    /// `x = k ln 2 + r` with `|r| < 0.35`, off by three roundings of `|x| < 2³¹`, which are `2³³ v` of the value.
    /// `e^{r/2^s}` has 18 roundings, and each of `s = 3M ≤ 24` squarings doubles what there is and adds one: less than
    /// `2^{s+5} v`, which is `2²⁹ v` up to M = 8.
    pub(crate) fn raw_exp(self) -> Self {
        if self.exponent > 31 {
            return match self.finite() {
                true if self.negative => Wide::power(-MOST),
                true => Wide::infinity(false),
                false => Wide::from(self.kind().exp()),
            };
        }
        let turns = (self.nearest_double() * std::f64::consts::LOG2_E).round();
        let rest = self - Wide::from(turns) * LN_2.resized::<M>();
        let small = rest.scaled(-Self::HALVINGS);
        let start = Wide::ONE + small * Self::short_exp(small);
        let power = (0..Self::HALVINGS).fold(start, |power, _| power * power);
        // What does not fit an i32 is beyond all exponents.
        power.scaled(turns as i32)
    }

    /// `eˣ − 1`, within `2⁵⁵ v`.
    ///
    /// From `|x| = 2^{−20}/2` on the difference is more than `2^{−22}`, which multiplies the `2³⁰ v` of `eˣ`. Below,
    /// the series has 20 terms of `x < 2^{−20}`, and its rest is below `2^{−400−65}`.
    pub(super) fn raw_exp_m1(self) -> Self {
        if self.exponent > -20 {
            return self.raw_exp() - Wide::ONE;
        }
        self * Self::short_exp(self)
    }

    /// `2 artanh z` for `z² < 2^{−32}`, within `2³ v`: 17 terms, and a rest below `2^{−544}`.
    fn double_artanh(z: Self) -> Self {
        let odd = (0..17).map(|k| ODD / (2 * k + 1));
        z.scaled(1) * Self::polynomial(z * z, odd) / Wide::from(ODD)
    }

    /// `ln x`, within `2⁵⁵ v`.
    ///
    /// `x = 2ᵏ m` with `m` between `√½` and `√2`. Within `2^{−17}` of 1 the difference from 1 is exact. Elsewhere
    /// `ln m = y + ln(m e^{−y})` with the logarithm y in doubles: `m e^{−y}` is within `2^{−50}` of 1, off by `2³⁰ v`
    /// and one rounding because `|y| < 1` there, and the sum is at least `2^{−18}`: `2⁴⁹ v`, which sums with `k ln 2`,
    /// at least `½ ln 2` in all, do not make more than a few greater.
    pub(super) fn raw_ln(self) -> Self {
        if self.is_special() || self.negative {
            return Wide::from(self.kind().ln());
        }
        let below = self.limbs[M - 1] < 0xb504_f333_f9de_6484;
        let power = self.exponent - i32::from(below);
        let m = self.scaled(-power);
        let apart = m - Wide::ONE;
        let log = if apart.exponent < -16 {
            Self::double_artanh(apart / (m + Wide::ONE))
        } else {
            let near = Wide::from(m.nearest_double().ln());
            let rest = m * (-near).raw_exp();
            near + Self::double_artanh((rest - Wide::ONE) / (rest + Wide::ONE))
        };
        if power == 0 { log } else { log + Wide::from(i64::from(power)) * LN_2.resized::<M>() }
    }

    /// `ln(1 + x)`, within `2⁵⁵ v`.
    ///
    /// The sum `1 + x` is rounded once, and where that is not exact the logarithm is more than `2^{−17}`: below, the
    /// series takes x itself.
    pub(super) fn raw_ln_1p(self) -> Self {
        if self.exponent > -16 || !self.finite() {
            return (Wide::ONE + self).raw_ln();
        }
        Self::double_artanh(self / (self + Wide::from(2)))
    }

    /// `sin x` and `cos x` for `|x| ≤ π/4`, within `2¹⁰ v`.
    ///
    /// With `c = cos − 1`, `sin 2θ = 2 sin θ (1 + c)` and `c(2θ) = 2c (2 + c)` have no cancellation, since `1 + c ≥
    /// 0.7`: a doubling adds four roundings to each and to what c passes on to the sine, `|c|/(1 + c) < 0.42`, which
    /// falls by four with each halving. Both series have fewer than eight at the start: `3M` doublings have less than
    /// `2⁸ v`.
    fn near_zero(self) -> (Self, Self) {
        let x = self.scaled(-Self::HALVINGS);
        let square = x * x;
        let sign = |k: usize| if k.is_multiple_of(2) { 1 } else { -1 };
        let terms = |first: usize| (0..10).map(move |k| sign(k) * FALLING[first + 2 * k]);
        let whole = Wide::from(FALLING[0]);
        let sin = x * Self::polynomial(square, terms(1)) / whole;
        let less = -(square * Self::polynomial(square, terms(2)) / whole);
        let double = |(sin, less): (Self, Self)| {
            ((sin * (less + Wide::ONE)).scaled(1), (less * (less + Wide::from(2))).scaled(1))
        };
        let (sin, less) = (0..Self::HALVINGS).fold((sin, less), |pair, _| double(pair));
        (sin, less + Wide::ONE)
    }

    /// `sin(x + q π/2)`, within `2¹¹ v`; no number from `|x| = 2⁶²` on.
    ///
    /// `x − k π/2` is computed in 16 limbs, where it is off by less than `2^{−1020} |x|`. Where that is no longer less
    /// than a rounding of the rest, there is no number.
    pub(super) fn raw_sin(self, quarters: i64) -> Self {
        if self.exponent > 62 {
            return Wide::NAN;
        }
        if self.exponent < 0 {
            return Self::quadrant(self, quarters);
        }
        let half_pi = QUARTER_PI.scaled(1);
        let x = self.resized::<16>();
        // The quotient is right within one: a rest a little beyond π/4 does not matter.
        let turns = (x / half_pi + Wide::from(0.5)).floor();
        let rest = x - Wide::from(turns) * half_pi;
        match rest.exponent >= self.exponent - 1018 + 64 * M as i32 {
            true => Self::quadrant(rest.resized(), turns % 4 + quarters),
            false => Wide::NAN,
        }
    }

    fn quadrant(rest: Self, quarters: i64) -> Self {
        let (sin, cos) = rest.near_zero();
        match quarters.rem_euclid(4) {
            0 => sin,
            1 => cos,
            2 => -sin,
            _ => -cos,
        }
    }
}

impl Wide<16> {
    /// The greatest integer below numbers of less than `2⁶³`.
    fn floor(self) -> i64 {
        crate::number::Scalar::floor_int(&self).unwrap_or_default()
    }
}

macro_rules! rounded {
    ($($name:ident: |$x:ident| $value:expr),*) => {$(
        fn $name(&self) -> Self {
            guarded!(N, M => {
                let $x = self.resized::<M>();
                $value.resized()
            })
        }
    )*};
}

/// **Accuracy**: within 0.51 units in the last place; the square root and π *correctly rounded*.
impl<const N: usize> Analytic for Wide<N> {
    rounded!(
        exp: |x| x.raw_exp(),
        exp_m1: |x| x.raw_exp_m1(),
        ln: |x| x.raw_ln(),
        ln_1p: |x| x.raw_ln_1p(),
        cos: |x| x.raw_sin(1),
        sin: |x| x.raw_sin(0)
    );

    fn sqrt(&self) -> Self {
        self.root()
    }

    fn pi(&self) -> Self {
        QUARTER_PI.scaled(2).resized()
    }
}
