use super::*;

/// Checks that equally spaced decimals are the doubles that a program writes for them.
#[test]
fn decimals_stay_decimals() {
    let of = |list: Result<List, ListError>| list.unwrap().lift::<f64>(&());
    let number = |text: &str| text.parse::<Number>().unwrap();
    assert_eq!(of(List::steps(&number("0.1"), &number("0.3"))), [0.0, 0.1, 0.2, 0.3]);
    assert_eq!(of(List::steps(&number("1e-1"), &number("0.39"))), [0.0, 0.1, 0.2, 0.3]);
    assert_eq!(of(List::equally_spaced("-1..1/5:4")), [-1.0, -0.6, -0.2, 0.2]);
    // A list that does not fit into integers keeps both ends.
    let long = of(List::equally_spaced("0..0.12345678901234567:3"));
    assert_eq!((long[0], long[2]), (0.0, 0.12345678901234567));
}

#[test]
fn what_is_no_list_is_said() {
    let said = |text: &str| List::equally_spaced(text).unwrap_err().to_string();
    for (text, expected) in [
        ("", "expected a number such as"),
        ("1,,2", "found ``"),
        ("0..1", "expected A..B:N"),
        ("0..1:1", "a count of 2 to 10000000"),
        ("0..1:1e3", "a count of 2"),
        ("0..1:3,2", "a count of 2"),
        ("1..2..3:4", "found `2..3`"),
        ("1..2:3:log", "found `1..2:3:log`, expected A..B:N"),
    ] {
        assert!(said(text).contains(expected), "{text}: {}", said(text));
    }
}
