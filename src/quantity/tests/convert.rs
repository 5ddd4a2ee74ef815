use super::*;

#[test]
fn by_hand() {
    for (found, expected, one) in [
        ("kN", "N", 1e3),
        ("ms", "s", 1e-3),
        ("µs", "s", 1e-6),
        ("mm/ms", "m/s", 1.0),
        ("N/mm²", "Pa", 1e6),
        ("N/mm^2", "MPa", 1.0),
        ("N mm", "mJ", 1.0),
        ("N·s", "N s", 1.0),
        ("Ns", "N s", 1.0),
        ("kg m s^-1", "N s", 1.0),
        ("kg*m**2/s**2", "J", 1.0),
        ("in", "mm", 25.4),
        ("lbf/in²", "psi", 1.0),
        ("kPa", "N/m²", 1e3),
        ("m s⁻¹", "m/s", 1.0),
        ("m/m", "", 1.0),
        ("%", "", 0.01),
        ("µε", "", 1e-6),
        ("ft", "in", 12.0),
    ] {
        let factor = Conversion::between(found, expected).map(|conversion| conversion.apply(1.0));
        assert!(factor.is_some_and(|factor| (factor / one - 1.0).abs() < 4e-16), "{found} {expected} {factor:?}");
    }
    for (found, expected) in
        [("V", "N"), ("N", "Pa"), ("s", ""), ("m/", "m"), ("N", "per ρS"), ("", "m"), ("N^2000000000", "N")]
    {
        assert_eq!(Conversion::between(found, expected), None, "{found} {expected}");
    }
    // Three tenths of a millisecond are the double next to 0.0003.
    assert_eq!(Conversion::between("ms", "s").map(|to| to.apply(0.3)), Some(0.0003));
}
