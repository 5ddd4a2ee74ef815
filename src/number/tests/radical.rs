use super::*;

fn fraction(p: i32, q: i32) -> Radical {
    Radical::rational(Rational::from((p, q))).unwrap()
}

fn root(n: i32) -> Radical {
    fraction(n, 1).sqrt().unwrap()
}

fn equal(a: &Radical, b: &Radical) -> bool {
    a.sub(b).unwrap().vanishes()
}

#[test]
fn a_field_with_an_order() {
    let x = fraction(3, 1).add(&root(2)).unwrap();
    // (3 + √2)(3 − √2) = 7
    assert!(equal(&x.mul(&fraction(3, 1).sub(&root(2)).unwrap()).unwrap(), &fraction(7, 1)));
    assert!(equal(&x.div(&x).unwrap(), &fraction(1, 1)));
    // 7/5 < √2 < 17/12
    assert_eq!(root(2).compare(&fraction(7, 5)), Some(Ordering::Greater));
    assert_eq!(root(2).compare(&fraction(17, 12)), Some(Ordering::Less));
    // √8 = 2√2; sums of several roots.
    assert!(equal(&root(8), &root(2).scaled(&Rational::from(2)).unwrap()));
    let sum = root(2).add(&root(3)).unwrap();
    let square = sum.mul(&sum).unwrap();
    assert!(equal(
        &square,
        &fraction(5, 1).add(&root(2).mul(&root(3)).unwrap().scaled(&Rational::from(2)).unwrap()).unwrap()
    ));
    assert!(equal(&sum.div(&sum).unwrap(), &fraction(1, 1)));
}

#[test]
fn roots_in_the_field_and_beyond() {
    // (1 − √2)² = 3 − 2√2, whose root is √2 − 1.
    let square = fraction(3, 1).sub(&root(8)).unwrap();
    assert!(equal(&square.sqrt().unwrap(), &root(2).sub(&fraction(1, 1)).unwrap()));
    // √(1 + √2) is a new root; its square is not.
    let inner = fraction(1, 1).add(&root(2)).unwrap();
    let nested = inner.sqrt().unwrap();
    assert!(equal(&nested.mul(&nested).unwrap(), &inner));
    assert!(equal(&fraction(1, 1).div(&nested).unwrap().mul(&nested).unwrap(), &fraction(1, 1)));
    // √(4(1 + √2)) is twice the same root.
    let four = inner.scaled(&Rational::from(4)).unwrap().sqrt().unwrap();
    assert!(equal(&four, &nested.scaled(&Rational::from(2)).unwrap()));
}

#[test]
fn a_name_is_the_same_as_itself_only() {
    let (a, b) = (Radical::named(), Radical::named());
    assert_eq!(a.compare(&a), Some(Ordering::Equal));
    assert_eq!(a.compare(&b), None);
    let shifted = a.add(&fraction(1, 2)).unwrap();
    assert_eq!(shifted.sub(&a).unwrap().compare(&fraction(1, 2)), Some(Ordering::Equal));
    // (a + b)² − (a − b)² = 4ab
    let (sum, difference) = (a.add(&b).unwrap(), a.sub(&b).unwrap());
    let squares = sum.mul(&sum).unwrap().sub(&difference.mul(&difference).unwrap()).unwrap();
    assert!(equal(&squares, &a.mul(&b).unwrap().scaled(&Rational::from(4)).unwrap()));
    // √(1 + a²)² = 1 + a²
    let square = a.mul(&a).unwrap().add(&fraction(1, 1)).unwrap();
    let root = square.sqrt().unwrap();
    assert!(equal(&root.mul(&root).unwrap(), &square));
}
