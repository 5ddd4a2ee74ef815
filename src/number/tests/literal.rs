use super::*;

#[test]
fn what_is_not_a_number_is_said() {
    for text in ["", "-", ".", "1/", "/2", "nan", "inf", "0x10", "1e", "1e9999999", "1.2.3", "1/2/3", "a"] {
        assert!(matches!(text.parse::<Number>(), Err(NumberError::Unreadable(_))), "{text}");
    }
    assert!(matches!("1/0.0".parse::<Number>(), Err(NumberError::ZeroDenominator(_))));
    for text in ["1e301", "1e-301", "1e400/1e399", "1e-400"] {
        assert!(matches!(text.parse::<Number>(), Err(NumberError::Size(_))), "{text}");
    }
}

#[test]
fn order_is_that_of_the_values() {
    use Ordering::{Equal, Greater, Less};
    let cases = [
        ("1/2", "0.5", Equal),
        ("1e2", "100.00", Equal),
        ("-0", "0e5", Equal),
        ("1/-2", "-5e-1", Equal),
        ("0.1", "0.1000000000000000000000000000000000001", Less),
        ("-0.1", "-0.1000000000000000000000000000000000001", Greater),
        ("2/3", "0.666666666666666666666666666666666666667", Less),
        ("123456789123456789/123456788", "123456789123456788/123456787", Less),
        ("1e300", "-1e300", Greater),
        ("0", "1e-300", Less),
        ("999999999999999999", "1e18", Less),
    ];
    for (a, b, order) in cases {
        let (x, y): (Number, Number) = (a.parse().unwrap(), b.parse().unwrap());
        assert_eq!(x.compare(&y), order, "{a} against {b}");
        assert_eq!(y.compare(&x), order.reverse(), "{b} against {a}");
        assert_eq!(x.to_rational().cmp(&y.to_rational()), order, "{a} against {b}");
    }
}

#[test]
fn a_decimal_is_the_rational_that_it_spells() {
    let cases = [
        ("0.1", (1, 10)),
        ("-2.50", (-5, 2)),
        ("1e-3", (1, 1000)),
        ("1_000", (1000, 1)),
        ("0.5/1.5", (1, 3)),
        (".5", (1, 2)),
        ("+3.", (3, 1)),
    ];
    for (text, (p, q)) in cases {
        let fraction = rational::quotient(p.into(), q.into());
        assert_eq!(text.parse::<Number>().unwrap().to_rational(), fraction, "{text}");
    }
}
