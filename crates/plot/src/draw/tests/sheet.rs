use super::*;

#[test]
fn long_titles_are_wrapped() {
    assert_eq!(wrapped("one two three", 5.5), ["one two", "three"]);
    assert_eq!(wrapped("one", 0.1), ["one"]);
    assert_eq!(wrapped("", 3.0), [""]);
}
