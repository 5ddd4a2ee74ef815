use super::*;

fn dual(value: (i64, i64), rate: (i64, i64)) -> Dual {
    let fraction = |(p, q): (i64, i64)| Rational::from(p) / Rational::from(q);
    Dual::new(fraction(value), fraction(rate))
}

/// `(x² + 3)/x` at x = 2, whose derivative is `1 − 3/x²`, and `√(x² + 5)`, whose derivative is `x/√(x² + 5)`.
#[test]
fn rates_are_derivatives() {
    let x = dual((2, 1), (1, 1));
    let quotient = (x.square() + x.int(3)) / &x;
    assert_eq!((quotient.value(), quotient.rate()), (dual((7, 2), (0, 1)).value(), dual((0, 1), (1, 4)).rate()));
    let root = (x.square() + x.int(5)).try_sqrt().unwrap();
    assert_eq!((root.value(), root.rate()), (dual((3, 1), (0, 1)).value(), dual((0, 1), (2, 3)).rate()));
}

#[test]
fn rates_decide_between_equal_numbers() {
    let (one, more, less) = (dual((1, 1), (0, 1)), dual((1, 1), (1, 9)), dual((1, 1), (-1, 9)));
    assert_eq!((more.compare(&one), less.compare(&one)), (Ok(Ordering::Greater), Ok(Ordering::Less)));
    assert_eq!([&one, &more, &less].map(Scalar::floor_int), [Some(1), Some(1), Some(0)]);
    // ε/ε is not of first order, and neither is √ε.
    let step = more - &one;
    assert_eq!(((one / &step).sign(), step.try_sqrt().unwrap().sign()), (Err(Open), Err(Open)));
}
