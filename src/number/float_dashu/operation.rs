//! Sums, products, quotients, roots and elementary functions of floats, cut off behind the bits that are asked for.

use dashu_base::Approximation;
use dashu_float::round::Rounding;
use dashu_float::round::mode::Zero;
use dashu_float::{Context, FBig, FpError, Repr};
use dashu_int::ops::{BitTest, DivRem, SquareRootRem, UnsignedAbs};
use dashu_int::{IBig, Sign, UBig};

use super::{Float, MOST_EXPONENT, Round, Unrounded, beside, round};

/// Greatest binary exponent of an angle whose sine and cosine are computed.
const MOST_ANGLE: i64 = 1 << 16;

/// The result of a function, not rounded yet; a function of one number has it twice.
#[derive(Clone, Copy, Debug)]
pub struct Operation<'a>(pub(super) Function, pub(super) &'a Float, pub(super) &'a Float);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Add,
    Sub,
    Mul,
    Div,
    Recip,
    Sqrt,
    Exp,
    ExpM1,
    Ln,
    Ln1p,
    Sin,
    Cos,
}

impl Float {
    pub(crate) fn square_ref(&self) -> Operation<'_> {
        Operation(Function::Mul, self, self)
    }
}

macro_rules! functions {
    ($($name:ident $function:ident),*) => {
        impl Float {
            $(pub(crate) fn $name(&self) -> Operation<'_> {
                Operation(Function::$function, self, self)
            })*
        }
    };
}
functions!(recip_ref Recip, sqrt_ref Sqrt, exp_ref Exp, exp_m1_ref ExpM1, ln_ref Ln, ln_1p_ref Ln1p);
functions!(sin_ref Sin, cos_ref Cos);

impl Unrounded for Operation<'_> {
    fn rounded(self, bits: u32, direction: Round) -> Float {
        match self.cut(bits) {
            Ok((mantissa, exponent)) => round(mantissa, exponent, bits, direction),
            Err(value) => value.rounded(bits, direction),
        }
    }
}

impl Operation<'_> {
    /// Computes the value, cut off; a double if that is exact, infinite or no number.
    fn cut(self, bits: u32) -> Result<(IBig, i64), f64> {
        let Operation(function, x, y) = self;
        let in_doubles = || function.in_doubles(x.kind(), y.kind());
        let ((m, e), (n, f)) = x.finite().zip(y.finite()).ok_or_else(in_doubles)?;
        let room = bits as usize + 2;
        Ok(match function {
            Function::Add | Function::Sub => {
                let minus = if function == Function::Add { Sign::Positive } else { Sign::Negative };
                add((m, e, x.top(), Sign::Positive), (n, f, y.top(), minus), bits)
            }
            Function::Mul => (m * n, e + f),
            _ if n.is_zero() => return Err(in_doubles()),
            Function::Div => quotient((m, e), (n, f), room),
            Function::Recip => quotient((&IBig::ONE, 0), (m, e), room),
            Function::Sqrt | Function::Ln if m.sign() == Sign::Negative => return Err(f64::NAN),
            Function::Sqrt => {
                let by = (2 * room).saturating_sub(m.bit_len());
                let by = by + usize::from((e - by as i64) % 2 != 0);
                let (root, rest) = (m.unsigned_abs() << by).sqrt_rem();
                (marked(root, &rest).into(), (e - by as i64) / 2)
            }
            _ => return function.elementary((m, e), x.top(), bits),
        })
    }
}

/// Returns a magnitude with its last bit set unless the rest is zero.
fn marked(mut size: UBig, rest: &UBig) -> UBig {
    if !rest.is_zero() {
        size.set_bit(0);
    }
    size
}

pub(super) fn quotient((m, e): (&IBig, i64), (n, f): (&IBig, i64), room: usize) -> (IBig, i64) {
    let by = (room + n.bit_len()).saturating_sub(m.bit_len());
    let (size, rest) = (m.unsigned_abs() << by).div_rem(n.unsigned_abs());
    (m.sign() * n.sign() * marked(size, &rest), e - f - by as i64)
}

/// Returns the sum of two numbers, each with the exponent of its magnitude and the sign that it is multiplied by.
fn add(x: (&IBig, i64, i64, Sign), y: (&IBig, i64, i64, Sign), bits: u32) -> (IBig, i64) {
    let ((m, e, _, plus), (n, f, top, minus)) = if x.2 < y.2 { (y, x) } else { (x, y) };
    if n.is_zero() {
        return (m.clone() * plus, e);
    } else if top < e - (i64::from(bits) + 3 - m.bit_len() as i64).max(0) {
        // The lesser number is below the last bit, of so many that it does not matter how far.
        let (sum, exponent) = beside(m, e, m.sign() * plus == n.sign() * minus, bits);
        return (sum * plus, exponent);
    }
    let least = e.min(f);
    ((m << (e - least) as usize) * plus + (n << (f - least) as usize) * minus, least)
}

impl Function {
    fn in_doubles(self, x: f64, y: f64) -> f64 {
        match self {
            Function::Add => x + y,
            Function::Sub => x - y,
            Function::Mul => x * y,
            Function::Div => x / y,
            Function::Recip => x.recip(),
            Function::Sqrt => x.sqrt(),
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Ln => x.ln(),
            Function::Ln1p => x.ln_1p(),
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
        }
    }

    /// Computes an elementary function as [`Operation::cut`].
    fn elementary(self, (m, e): (&IBig, i64), top: i64, bits: u32) -> Result<(IBig, i64), f64> {
        let negative = m.sign() == Sign::Negative;
        if self != Function::Ln && top < -i64::from(bits.max(m.bit_len() as u32)) - 8 {
            return Ok(match self {
                Function::Exp => beside(&IBig::ONE, 0, !negative, bits),
                Function::Cos => beside(&IBig::ONE, 0, false, bits),
                Function::ExpM1 => beside(m, e, !negative, bits),
                Function::Ln1p => beside(m, e, negative, bits),
                _ => beside(m, e, false, bits),
            });
        }
        let (context, x) = (Context::<Zero>::new(bits as usize + 2), Repr::new(m.clone(), e as isize));
        let value = match self {
            Function::Exp if top > 34 && negative => Err(FpError::Underflow(Sign::Positive)),
            Function::Exp | Function::ExpM1 if top > 34 && !negative => Err(FpError::Overflow(Sign::Positive)),
            Function::Exp => context.exp(&x, None),
            Function::ExpM1 => context.exp_m1(&x, None),
            Function::Ln => context.ln(&x, None),
            Function::Ln1p => context.ln_1p(&x, None),
            _ if top > MOST_ANGLE => Err(FpError::OutOfDomain),
            Function::Cos => context.cos(&x, None),
            _ => context.sin(&x, None),
        };
        match value {
            // The logarithm of zero.
            Ok(value) if value.value_ref().repr().is_infinite() => Err(f64::NEG_INFINITY),
            Ok(value) => Ok(parts(value, bits)),
            Err(FpError::Overflow(sign)) => Ok((sign * IBig::ONE, 4 * MOST_EXPONENT)),
            Err(FpError::Underflow(sign)) => Ok((sign * IBig::ONE, -4 * MOST_EXPONENT)),
            Err(_) => Err(f64::NAN),
        }
    }
}

/// Returns mantissa and exponent of a value that `dashu_float` has cut off.
pub(super) fn parts(value: Approximation<FBig<Zero, 2>, Rounding>, bits: u32) -> (IBig, i64) {
    let exact = matches!(value, Approximation::Exact(_));
    let (mantissa, exponent) = value.value().into_repr().into_parts();
    if exact { (mantissa, exponent as i64) } else { beside(&mantissa, exponent as i64, true, bits) }
}
