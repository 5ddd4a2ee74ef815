//! Elementary functions beside digits that are known, and long floats.

use super::Wide;
use super::arithmetic_tests::Awkward;
use crate::number::{Analytic, Scalar};

type Function<const N: usize> = fn(&Wide<N>) -> Wide<N>;

/// All functions with the arguments that they are tried at: `scale` powers of two around 1.
macro_rules! functions {
    ($($name:ident),*) => { [$((stringify!($name), Wide::$name as Function<_>)),*] };
}

#[test]
fn known_digits() {
    let (one, ten) = (Wide::<6>::from(1), Wide::<6>::from(10));
    let known = [
        (
            one.exp(),
            "2.7182818284590452353602874713526624977572470936999595749669676277240766303535475945713821785251664",
        ),
        (
            ten.ln(),
            "2.3025850929940456840179914546843642076011014886287729760333279009675726096773524802359972050895983",
        ),
        (
            one.sin(),
            "0.84147098480789650665250232163029899962256306079837106567275170999191040439123966894863974354305270",
        ),
        (
            one.cos(),
            "0.54030230586813971740093660744297660373231042061792222767009725538110039477447176451795185608718309",
        ),
        (
            Wide::power(-10).exp_m1(),
            "0.00097703949241653524284529261160650646585162918174419940186408264916250428896869173656853690882467186",
        ),
        (
            one.pi(),
            "3.1415926535897932384626433832795028841971693993751058209749445923078164062862089986280348253421171",
        ),
    ];
    for (found, digits) in known {
        assert_eq!(found.decimal(98), digits);
    }
    assert_eq!(Wide::<4>::from(9).ln_1p(), ten.ln().resized());
    assert_eq!(Wide::<2>::from(2).ln(), super::elementary::LN_2.resized());
}

#[test]
fn exact_values_and_ends() {
    let (zero, one) = (Wide::<2>::from(0), Wide::<2>::from(1));
    assert_eq!([zero.exp(), zero.cos(), zero.exp_m1() + one, one.ln() + one, zero.ln_1p() + one], [one; 5]);
    assert_eq!(zero.sin(), zero);
    let tiny = Wide::<2>::power(-1000);
    assert_eq!([tiny.sin(), tiny.exp_m1(), tiny.ln_1p()], [tiny; 3]);
    let far = Wide::<2>::from(3e9);
    assert!(!far.exp().is_finite() && (-far).exp() > zero && (-far).exp() < Wide::power(-1 << 29));
    let infinite = one / zero;
    assert_eq!([(-infinite).exp(), (-infinite).exp_m1() + one], [zero; 2]);
    assert_eq!([infinite.exp(), infinite.ln(), -zero.ln(), -(-one).ln_1p()], [infinite; 4]);
    let none = [(-one).ln(), infinite.sin(), Wide::power(70).cos(), (infinite - infinite).exp(), (-one).sqrt()];
    assert!(none.iter().all(|x| x.is_nan()));
}

/// Arguments of all sizes: tiny, next to 1, next to multiples of π/2, and up to `2^most`.
fn argument<const N: usize>(next: &mut Awkward, most: i32) -> Wide<N> {
    let mut x = next.number::<N>(1);
    x.exponent = most - next.below(most as u64 + 24) as i32;
    match next.below(6) {
        0 => x.exponent -= 64 * N as i32,
        1 => x = Wide::ONE + x.scaled(-30 - most),
        2 => x = Wide::from(next.below(1 << 20) as i64) * x.pi().scaled(-1) + x.scaled(-64 * N as i32),
        _ => {}
    }
    x
}

/// Against the long floats of the build: those of MPFR, or those of `dashu_float`.
mod long {
    use super::super::arithmetic_tests::float;
    use super::*;
    use crate::number::Float;

    fn beside_long<const N: usize>(count: usize) {
        let bits = 64 * N as u32 + 100;
        let mut next = Awkward(0x8765_4321 + N as u64);
        let ours: [(_, Function<N>); 6] = functions!(exp, exp_m1, ln, ln_1p, sin, cos);
        let theirs: [fn(&Float) -> Float; 6] =
            [Analytic::exp, Analytic::exp_m1, Analytic::ln, Analytic::ln_1p, Analytic::sin, Analytic::cos];
        for ((name, ours), theirs) in ours.into_iter().zip(theirs) {
            let (mut most, mut met) = (0.0f64, 0);
            for _ in 0..count {
                let x = argument::<N>(&mut next, 20);
                let sure = theirs(&Float::with_val(bits, float(&x)));
                let found = ours(&x);
                if !sure.is_finite() || found.is_zero() {
                    assert!(!found.is_finite() || sure.is_zero(), "{name} {x:?}");
                    assert!(found.to_f64() == sure.to_f64() || found.is_nan() && sure.is_nan(), "{name} {x:?}");
                    continue;
                }
                let off = Float::with_val(bits, float(&found) - &sure) << (64 * N as i32 - found.exponent);
                (most, met) = (most.max(off.to_f64().abs()), met + 1);
                assert!(most <= 0.51, "{name} {most} {x:?}");
            }
            assert!(most > 0.26 && 3 * met > count, "{name} {most} {met}");
        }
    }

    #[test]
    fn functions_are_those_of_long_floats() {
        beside_long::<2>(1_500);
        beside_long::<3>(1_000);
        beside_long::<4>(1_000);
        beside_long::<6>(800);
    }

    /// `cargo test --release --lib number::wide -- --ignored`: some minutes.
    #[test]
    #[ignore = "minutes: make explore"]
    fn a_million_functions_are_those_of_long_floats() {
        beside_long::<2>(1_000_000);
        beside_long::<3>(1_000_000);
        beside_long::<4>(1_000_000);
        beside_long::<6>(300_000);
    }
}
